"""The energy equation of the film over its area: exact solutions, balances, a large bearing."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Arc,
    Capillary,
    Film,
    FilmHeat,
    GasMixture,
    Groove,
    Heat,
    JournalBearing,
    Lobes,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    Supply,
    TiltingPads,
    Turbulence,
)
from loadflow.scene.journal import make_journal
from loadflow.tribology import ExponentialOil
from loadflow.tribology.couette import adiabatic_rise
from loadflow.validation.film_heat import LADDER, ladder_bearing, ladder_state

SIZE = {"diameter": 0.2, "width": 0.15, "relative_clearance": 1e-3}
LOBES = JournalBearing(**SIZE, shape=Lobes(2))
LOAD, SPEED = (2e4, 3e3), 200.0
TWO_GROOVES = Supply([Groove(s * np.pi / 2, arc=0.3, length=0.1, pressure=1e5) for s in (1, -1)])


def film(heat=None, law=None, **more):
    """Film of the tests, oil of VG 68 at 40 °C."""
    more = {"grid": (48, 8), "edge_pressure": 2e4} | more
    return Film(None, law or MassConserving(), heat=heat or FilmHeat("iso-vg-68"), **more)


def couette(cells, steepness):
    """Rise of a sheared film of 0.1 m between parallel walls without pressure, K; its balance."""
    oil = ExponentialOil(
        reference_viscosity=0.0277,
        constant_steepness=steepness,
        reference_density=860.0,
        constant_specific_heat=1951.8,
    )
    gap, radius = 100e-6, 0.5
    bearing = JournalBearing(2 * radius, 0.1, gap / radius, shape=Arc(0.0, 0.1 / radius))
    heat = FilmHeat(oil, oil.reference_temperature, carry_over=0.0)
    field = bearing.pressure(
        (0.0, 0.0), 10.471976 / radius, Film(None, Sommerfeld(), heat=heat, grid=(cells, 2))
    )
    assert field.converged
    return float(field.trailing_temperature[0] - 313.15), float(field.heat_imbalance)


@pytest.mark.parametrize("steepness", [0.0341, 0.0])
def test_a_sheared_film_warms_as_in_closed_form(steepness):
    exact = adiabatic_rise(
        0.1,
        viscosity=0.0277,
        speed=10.471976,
        gap=1e-4,
        heat_capacity=860 * 1951.8,
        steepness=steepness,
    )
    rise, imbalance = couette(100, steepness)
    assert rise == pytest.approx(float(exact), rel=1e-3)
    assert imbalance < 1e-10


def test_the_temperature_is_of_first_order_in_the_cells():
    exact = 3.267283
    errors = [abs(couette(cells, 0.0341)[0] - exact) for cells in (25, 50, 100)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize(
    ("shape", "more"),
    [
        (Lobes(2), {}),
        (Lobes(3, preload=0.5), {"law": GasMixture(1e4)}),
        (Arc(0.0, 2.6), {}),
        (TiltingPads(4, 1.3, 0.3, angle=np.pi / 4), {}),
        (None, {"supply": TWO_GROOVES}),
    ],
)
@pytest.mark.parametrize("transfer", [0.0, 400.0])
def test_the_heat_that_leaves_is_the_friction(shape, more, transfer):
    """With the oil and, where it may, through shell and shaft; for every bore."""
    bearing = JournalBearing(**SIZE) if shape is None else JournalBearing(**SIZE, shape=shape)
    heat = FilmHeat("iso-vg-68", shell_transfer=transfer, shaft_transfer=transfer)
    state = bearing.equilibrium(LOAD, SPEED, film(heat, **more))
    assert state.converged
    assert state.heat_residual < 1e-6
    assert state.heat_imbalance < 1e-8
    left = state.heat_carried + state.heat_conducted
    assert left == pytest.approx(float(state.friction_power), rel=1e-8)
    assert (state.heat_conducted > 0) == (transfer > 0)
    assert state.maximum_temperature > state.temperature > heat.inlet_temperature


def test_the_balance_closes_as_seen_from_outside():
    """With all hot oil carried over into a film that takes more, heat leaves at the ends alone."""
    bearing, state = ladder_bearing(), ladder_state("adiabatic")
    oil = ExponentialOil(reference_viscosity=0.02, constant_steepness=0.03, reference_density=850.0)
    heat = FilmHeat(oil, 320.0, carry_over=1.0)
    options = Film(None, MassConserving(), edge_pressure=100.0, grid=(40, 8), heat=heat)
    warm = bearing.equilibrium(state.force, state.speed, options)
    ends = heat.volume_heat * warm.side_flow * (warm.outlet_temperature - 320.0)
    assert ends == pytest.approx(float(warm.friction_power), rel=1e-8)
    fresh = replace(options, heat=replace(heat, carry_over=0.0))
    none = bearing.equilibrium(state.force, state.speed, fresh)
    assert none.leading_temperature == pytest.approx(320.0, abs=1e-9)
    assert warm.temperature > none.temperature + 5.0


def test_a_film_of_one_viscosity_is_the_isothermal_one():
    oil = ExponentialOil(reference_viscosity=0.015, reference_density=870.0)
    warm = LOBES.equilibrium(LOAD, SPEED, film(FilmHeat(oil)))
    cold = LOBES.equilibrium(
        LOAD, SPEED, Lubricant(0.015), MassConserving(), edge_pressure=2e4, grid=(48, 8)
    )
    for name in ("eccentricity", "minimum_film", "maximum_pressure", "side_flow", "stiffness"):
        expected = getattr(cold, name)
        scale = np.abs(expected).max()
        np.testing.assert_allclose(getattr(warm, name), expected, rtol=1e-7, atol=1e-9 * scale)
    assert (
        warm.friction_power < cold.friction_power
    )  # a ruptured film is sheared where it is liquid
    assert warm.maximum_temperature > 320.0


def test_a_shaft_without_net_heat_is_as_warm_as_the_film_is_on_average():
    free = LOBES.equilibrium(LOAD, SPEED, film(FilmHeat("iso-vg-68", shaft_transfer=500.0)))
    assert free.shaft_temperature == pytest.approx(float(free.temperature), abs=1e-6)
    assert free.heat_conducted == pytest.approx(0.0, abs=1e-6 * free.friction_power)
    held = FilmHeat("iso-vg-68", shaft_transfer=500.0, shaft_temperature=float(free.temperature))
    same = LOBES.equilibrium(LOAD, SPEED, film(held))
    assert same.eccentricity_ratio == pytest.approx(float(free.eccentricity_ratio), abs=1e-8)


def test_reversed_motion_is_the_mirror_image():
    one, other = (LOBES.equilibrium((2e4, s * 3e3), s * SPEED, film()) for s in (1, -1))
    assert other.maximum_temperature == pytest.approx(float(one.maximum_temperature), abs=1e-5)
    assert other.eccentricity == pytest.approx(one.eccentricity * [1, -1], rel=1e-6)
    assert other.leading_temperature[::-1].sum() == pytest.approx(one.leading_temperature.sum())


def test_position_load_position_closes():
    state = LOBES.equilibrium(LOAD, SPEED, film())
    there = LOBES.pressure(state.eccentricity, SPEED, film())
    assert there.force == pytest.approx(np.array(LOAD), rel=1e-6)
    assert there.film_temperature == pytest.approx(state.film_temperature, abs=1e-5)
    assert there.friction_power == pytest.approx(float(state.friction_power), rel=1e-7)


def test_stiffness_is_the_slope_of_the_force_at_the_same_viscosities():
    """The temperatures are held while the shaft moves."""
    from loadflow.journal.film.heat.equation import EnergyEquation
    from loadflow.journal.line import Line
    from loadflow.journal.solvers.statics import Statics
    from loadflow.numerics.convergence import Limits

    options = film(law=GasMixture(1e4))
    state = LOBES.equilibrium(LOAD, SPEED, options)
    statics = Statics(LOBES, options, Line(), SPEED)
    equation = EnergyEquation(statics.film, statics.gap, options.heat)
    half = state.film_temperature[:, state.film_temperature.shape[1] // 2 :]
    equation.thicken(half.ravel())
    place, step, columns = state.eccentricity / LOBES.clearance, 1e-5, []
    for way in np.eye(2):
        ends = []
        for sign in (1, -1):
            where = place + sign * step * way
            held = statics.hold(0, where, np.zeros(2), SPEED, Limits(1e-12, 60))
            ends.append(statics.film.field(held.u, held.position)[3])
        columns.append((ends[0] - ends[1]) / (2 * step * LOBES.clearance))
    expected = np.array(columns).T
    assert state.stiffness == pytest.approx(expected, abs=1e-5 * np.abs(expected).max())


def test_a_series_does_not_depend_on_its_company():
    loads = np.array([[2e4, 0.0], [5e3, 1e4], [4e4, -1e4]])
    together = LOBES.equilibrium(loads, SPEED, film())
    for index, load in enumerate(loads):
        alone = LOBES.equilibrium(load, SPEED, film())
        assert together.eccentricity_ratio[index] == pytest.approx(
            float(alone.eccentricity_ratio), abs=1e-6
        )
        assert together.maximum_temperature[index] == pytest.approx(
            float(alone.maximum_temperature), abs=1e-4
        )


def test_a_tilted_shaft_is_warmer_where_the_film_is_thinner():
    state = LOBES.equilibrium(LOAD, SPEED, film(), tilt=(0.0, 2e-4))
    low, high = state.film_temperature[:, 0].max(), state.film_temperature[:, -1].max()
    assert high > low + 1.0


def test_what_it_does_not_know_is_refused_by_name():
    with pytest.raises(InputError, match=r"cavitation = Reynolds.* conserves mass"):
        LOBES.equilibrium(LOAD, SPEED, film(law=Reynolds()))
    with pytest.raises(InputError, match="turbulence = Turbulence"):
        LOBES.equilibrium(LOAD, SPEED, film(turbulence=Turbulence()))
    with pytest.raises(InputError, match="weights = "):
        LOBES.equilibrium([LOAD], SPEED, film(), weights=[1.0])
    with pytest.raises(InputError, match="velocity = "):
        LOBES.pressure((0.0, 0.0), SPEED, film(), velocity=(1e-3, 0.0))
    with pytest.raises(InputError, match="carry_over: must be ≤ 1"):
        FilmHeat(carry_over=1.5)
    with pytest.raises(InputError, match="shell_temperature = 500"):
        FilmHeat(shell_temperature=500.0)


def test_a_film_without_an_answer_says_why():
    with pytest.raises(SolverError, match=r"load 0: .* gets hotter than 423"):
        LOBES.equilibrium((5e5, 0.0), SPEED, film())
    with pytest.raises(SolverError, match="gets hotter than 423"):
        JournalBearing(**SIZE).equilibrium(LOAD, SPEED, film())
    with pytest.raises(SolverError, match="without rotation"):
        LOBES.equilibrium(LOAD, 0.0, film())
    state = LOBES.equilibrium([LOAD, (5e5, 0.0)], SPEED, film(), strict=False)
    assert state.converged.tolist() == [True, False]
    assert np.isnan(state.temperature[1])
    assert np.isfinite(state.temperature[0])
    assert np.isnan(state.eccentricity_ratio[1])


def test_a_groove_behind_a_capillary_feeds_a_warm_film():
    fed = Supply(
        [Groove(np.pi, arc=0.4, length=0.1, pressure=3e5, restrictor=Capillary(0.1, 3e-3))]
    )
    state = JournalBearing(**SIZE).equilibrium(LOAD, SPEED, film(supply=fed))
    assert state.converged
    assert state.heat_imbalance < 1e-8


def test_results_have_units_and_names():
    data = LOBES.equilibrium([LOAD, LOAD], SPEED, film()).to_dataset()
    assert data.film_temperature.dims == ("case", "around", "across")
    assert data.leading_temperature.units == "K"
    assert data.heat_carried.units == "W"
    assert all({"units", "long_name"} <= set(data[name].attrs) for name in data.data_vars)


def test_a_scene_has_either_kind_of_heat():
    base = {"cavitation": "mass-conserving", "edge_pressure": 1e4}
    base |= {"geometry": SIZE | {"shape": {"kind": "lobes", "count": 2}}, "grid": (48, 8)}
    section = make_journal(base | {"heat": {"kind": "film", "carry_over": 0.5}}, "journal")
    assert section.film_model.heat == FilmHeat(carry_over=0.5)
    assert make_journal(base | {"heat": {"transfer": 5.0}}, "journal").film_model.heat == Heat(
        transfer=5.0
    )
    again = make_journal(section.model_dump(exclude_unset=True), "journal")
    assert again.heat == section.heat
    for more, words in (
        ({"heat": {"kind": "film", "transfer": 5.0}}, r"journal\.heat\.transfer: unknown key"),
        ({"heat": {"kind": "oven"}}, "kind must be one of balance, film"),
        ({"heat": {"kind": "film"}, "cavitation": "reynolds"}, "a law that conserves mass"),
    ):
        with pytest.raises(InputError, match=words):
            make_journal(base | more, "journal")


@pytest.mark.parametrize("row", LADDER, ids=lambda row: f"{row.rung}: {row.name}")
def test_heat_moves_a_large_bearing_as_in_another_code(row):
    assert row.check(ladder_state(row.rung)).ok


def test_the_ladder_itself():
    cold, warm = (ladder_state(rung) for rung in ("isoviscous", "adiabatic"))
    assert 0.07 - 0.005 < warm.eccentricity_ratio - cold.eccentricity_ratio < 0.09
    assert 0.27 < 1 - warm.friction_power / cold.friction_power < 0.30
    assert ladder_bearing().shape.count == 2
