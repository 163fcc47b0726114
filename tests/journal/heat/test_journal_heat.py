"""The heat balance of the film: temperature and viscosity that its own friction leaves."""

import warnings
from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from loadflow.errors import InputError, SolverError, ValidityWarning
from loadflow.journal import (
    Capillary,
    Control,
    Film,
    GasMixture,
    Groove,
    Growth,
    Heat,
    JournalBearing,
    Orifice,
    Sommerfeld,
    Supply,
    warm_equilibrium,
    warm_orbit,
)
from loadflow.journal.line import Line
from loadflow.journal.thermal import warm_film
from loadflow.journal.warm_orbit import FEW, series_temperature

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
FILM = {"cavitation": GasMixture(0.05e6), "edge_pressure": 0.5e6, "grid": (36, 12)}
QUICK = FILM | {"rung": "reduced"}
LOADS = np.stack([np.linspace(3e5, 3e6, 6), np.full(6, 2e5)], axis=-1)


@pytest.mark.parametrize("supply", [None, Supply([Groove(2.0, arc=0.3, pressure=0.6e6)])])
def test_a_film_at_its_temperature_is_that_of_oil_so_viscous(supply):
    """All answers, friction, flow, stiffness and damping among them, scale exactly."""
    heat = Heat(inlet_temperature=320.0)
    options = FILM | {"supply": supply}
    warm = warm_equilibrium(BEARING, (1e6, 3e5), 1.3, heat, **options)
    oil = heat.lubricant(warm.temperature)
    alone = BEARING.equilibrium((1e6, 3e5), 1.3, oil, **options)
    assert warm.temperature > 320.5
    bounds = "relative_grid_error"  # that of the temperature counts, too
    assert np.all(getattr(warm.film, bounds) >= getattr(alone, bounds))
    for field in fields(alone):
        if field.name not in ("temperature", "residual", "iterations", bounds):
            expected = getattr(alone, field.name)
            if expected is None:  # what only rough surfaces have
                assert field.name.startswith("contact_")
                assert getattr(warm.film, field.name) is None
                continue
            scale = np.max(np.abs(expected), initial=0.0)
            np.testing.assert_allclose(
                getattr(warm.film, field.name),
                expected,
                rtol=1e-8,
                atol=1e-9 * scale,
                err_msg=field.name,
            )


def test_the_heat_that_leaves_is_the_friction():
    """Each load for itself, through oil and housing."""
    heat = Heat(inlet_temperature=315.0, transfer=150.0, ambient_temperature=290.0)
    warm = warm_equilibrium(BEARING, LOADS, 1.3, heat, **QUICK)
    assert warm.film.converged.all()
    density = heat.liquid.density(warm.temperature)
    carried = density * heat.heat_capacity * warm.film.side_flow
    by_oil = carried * (warm.outlet_temperature - heat.inlet_temperature)
    by_housing = heat.transfer * (warm.temperature - heat.ambient_temperature)
    np.testing.assert_allclose(by_oil + by_housing, warm.film.friction_power, rtol=1e-5)
    np.testing.assert_allclose(
        warm.temperature, 0.5 * (warm.outlet_temperature + heat.inlet_temperature)
    )


def test_one_temperature_for_all_loads_carries_their_mean_friction():
    heat, share = Heat(), np.arange(1.0, 7.0)
    warm = warm_equilibrium(BEARING, LOADS, 1.3, heat, weights=share, **QUICK)
    assert np.ptp(warm.temperature) == 0.0
    power, flow = (
        np.average(values, weights=share)
        for values in (warm.film.friction_power, warm.film.side_flow)
    )
    asked = heat.temperature(power, flow, warm.temperature[0])
    assert asked == pytest.approx(warm.temperature[0], abs=1e-5)
    each = warm_equilibrium(BEARING, LOADS, 1.3, heat, **QUICK).temperature
    assert each.min() < warm.temperature[0] < each.max()


def test_an_unloaded_film_cooled_by_its_housing_is_as_warm_as_petroff_says():
    """2π η ω² R³ B/c = K (T − T_ambient); no oil leaves a centred shaft."""
    heat = Heat(transfer=400.0, ambient_temperature=300.0)
    radius, speed = BEARING.radius, 2.0
    warm = warm_equilibrium(
        BEARING, (1.0, 0.0), speed, heat, cavitation=Sommerfeld(), grid=(36, 12)
    )

    def missing(temperature):
        viscosity = float(heat.liquid.viscosity(temperature))
        drag = 2 * np.pi * viscosity * speed**2 * radius**3 * BEARING.width / BEARING.clearance
        return drag - 400.0 * (temperature - 300.0)

    assert warm.temperature == pytest.approx(brentq(missing, 300.0, 420.0), abs=0.02)


@settings(max_examples=15, deadline=None)
@given(
    load=st.floats(1e5, 5e6),
    speed=st.floats(0.2, 4.0),
    inlet=st.floats(290.0, 330.0),
    transfer=st.sampled_from([0.0, 100.0, 3000.0]),
)
def test_a_film_is_warmer_than_what_cools_it_and_warmer_still_when_it_turns_faster(
    load, speed, inlet, transfer
):
    heat = Heat(inlet_temperature=inlet, transfer=transfer, ambient_temperature=inlet)
    warm = warm_equilibrium(BEARING, (load, 0.0), [speed, 1.5 * speed], heat, **QUICK)
    assert warm.film.converged.all()
    assert inlet < warm.temperature[0] < warm.temperature[1]


def test_what_gets_too_hot_is_told_with_its_load():
    heat = Heat(transfer=1.0)
    with pytest.raises(SolverError, match=r"load 1, 0 N at 9 rad/s: no heat balance below 423"):
        warm_equilibrium(BEARING, [(1e6, 0.0), (0.0, 0.0)], [1.0, 9.0], heat, **QUICK)
    loose = warm_equilibrium(
        BEARING, [(1e6, 0.0), (0.0, 0.0)], [1.0, 9.0], heat, strict=False, **QUICK
    )
    assert loose.film.converged.tolist() == [True, False]
    for values in (loose.film.minimum_film, loose.film.stiffness, loose.temperature):
        assert np.isfinite(values[0]).all()
        assert np.isnan(values[1]).all()


def test_a_standing_shaft_has_no_heat_balance():
    loose = warm_equilibrium(BEARING, LOADS[:2], [1.0, 0.0], Heat(), strict=False, **QUICK)
    assert loose.film.converged.tolist() == [True, False]
    with pytest.raises(SolverError, match=r"load 1: no film at any .* ω = 0 rad/s: without rot"):
        warm_equilibrium(BEARING, LOADS[:2], [1.0, 0.0], Heat(), **QUICK)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"supply": Supply([Groove(1.0, restrictor=Orifice(1e-3))])}, "or a capillary"),
        ({"lubricant": Heat().lubricant(300.0)}, "lubricant: not given here"),
        ({"weights": [0.0]}, "do not broadcast"),
        ({"weights": 0.0}, "weights"),
    ],
)
def test_what_cannot_be_balanced_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        warm_equilibrium(BEARING, (1e6, 0.0), 1.0, Heat(), **FILM | change)


def test_a_capillary_feeds_a_warm_film():
    """Its flow falls with viscosity as that of the film does."""
    groove = Groove(2.0, arc=0.3, pressure=1e6, restrictor=Capillary(diameter=8e-3, length=1.0))
    options = FILM | {"supply": Supply([groove])}
    heat = Heat()
    warm = warm_equilibrium(BEARING, (1e6, 0.0), 1.3, heat, **options)
    alone = BEARING.equilibrium((1e6, 0.0), 1.3, heat.lubricant(warm.temperature), **options)
    assert warm.film.groove_flow == pytest.approx(alone.groove_flow, rel=1e-7)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"oil": "olive"}, "lubricant: must be one of"),
        ({"inlet_temperature": 500.0}, "inlet_temperature"),
        ({"transfer": -1.0}, "transfer: must be ≥ 0"),
    ],
)
def test_bad_cooling_is_refused(keys, message):
    with pytest.raises(InputError, match=message):
        Heat(**keys)


@pytest.mark.parametrize(("jump", "answered"), [(1e-6, True), (0.3, False)])
def test_a_balance_that_steps_over_zero_where_a_mesh_changes_is_told(jump, answered):
    """Film of constant friction but for a jump at the speed where another mesh takes over."""
    heat = Heat(inlet_temperature=315.0)
    film = Film(heat=heat, cavitation=Sommerfeld())
    carried = 2.0 * float(heat.liquid.density(320.0)) * heat.heat_capacity

    def at_rest(force, speed, places, temperature):
        scale = speed / 1.0  # what `speed` is over that of the shaft, it is over viscosity
        power = 5.0 * carried * 1e-5 * np.where(speed > changes, 1.0 + jump, 1.0 - jump)
        count = speed.size
        return {
            "friction_power": power * scale, "side_flow": 1e-5 * scale,
            "supply_flow": np.zeros(count), "supply_power": np.zeros(count),
            "groove_flow": np.zeros((count, 0)), "damping": np.zeros((count, 2, 2)),
            "reynolds_number": np.ones(count), "critical_reynolds_number": np.full(count, 2.0),
            "residual": np.zeros(count), "converged": np.ones(count, dtype=bool),
            "force": force, "speed": speed,
        }  # fmt: skip

    oil = heat.liquid
    changes = float(oil.viscosity(320.0) / oil.viscosity(315.0))
    found = warm_film(at_rest, np.array([[1e5, 0.0]]), np.ones(1), film, None, strict=False)
    assert bool(found["converged"][0]) is answered
    assert found["heat_residual"][0] > 1e-6
    if answered:
        assert found["temperature"][0] == pytest.approx(320.0, abs=1e-3)


class _CarriesUpTo:
    """A film whose friction is known, and that carries no load above `most`; it counts its asks."""

    def __init__(self, most: float, refined: float = 0.0) -> None:
        self.most, self.refined, self.asked = most, refined, []

    def equilibrium(self, asked):
        force, speed, refine = asked.force, asked.speed, asked.limits.refine
        self.asked.append((np.hypot(*force.T), refine))
        count, most = speed.size, self.refined if refine else self.most
        return {
            "friction_power": 2e3 * speed**2, "side_flow": 1e-4 * speed,
            "supply_flow": np.zeros(count), "supply_power": np.zeros(count),
            "groove_flow": np.zeros((count, 0)), "damping": np.zeros((count, 2, 2)),
            "reynolds_number": np.ones(count), "critical_reynolds_number": np.full(count, 2.0),
            "residual": np.zeros(count), "converged": np.hypot(*force.T) <= most,
            "force": force, "speed": speed,
        }  # fmt: skip


def _series_temperature(model, most=1e6, count=64):
    force = np.column_stack([np.linspace(1e3, most, count), np.zeros(count)])
    film = Film(heat=Heat(inlet_temperature=315.0), cavitation=Sommerfeld())
    speed = np.linspace(2.0, 1.0, count)
    return series_temperature(model, BEARING, film, force, speed, Line())


def test_a_series_is_as_warm_as_those_of_its_loads_that_have_a_film():
    """Those without are asked once, by the own model alone, and once at the end."""
    model = _CarriesUpTo(0.5e6)
    with pytest.warns(ValidityWarning, match="32 of 64 .* up to 4.9"):
        warm = _series_temperature(model)
    few = [force for force, _ in model.asked if force.size <= FEW]
    every = [force for force, _ in model.asked if force.size > FEW]
    for asked, lost in ((few, FEW // 2), (every, 32)):
        heavy = [np.count_nonzero(force > 0.5e6) for force in asked]
        assert heavy == [lost, *[0] * (len(heavy) - 2), lost]
    assert len(few) > 3  # about how warm is known from these
    assert len(every) < len(few)
    assert not any(refine for _, refine in model.asked)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        all_of_them = _series_temperature(_CarriesUpTo(1e6))
    assert warm > all_of_them > 315.0  # the mild loads turn faster


def test_loads_on_a_shaft_that_has_stopped_are_not_asked_for_their_heat():
    speed = np.append(np.full(32, 1.0), np.full(32, 1e-3))
    force = np.column_stack([np.append(np.full(32, 1e5), np.full(32, 1e6)), np.zeros(64)])
    film = Film(heat=Heat(inlet_temperature=315.0), cavitation=Sommerfeld())
    model = _CarriesUpTo(5e5)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        stopped = series_temperature(model, BEARING, film, force, speed, Line())
    assert {size.size for size, _ in model.asked} == {FEW, 32}
    running = series_temperature(model, BEARING, film, force[:32], speed[:32], Line())
    assert stopped == pytest.approx(running, rel=1e-12)


def test_all_loads_are_asked_where_a_few_of_them_hardly_miss_their_balance(monkeypatch):
    sizes = []

    def of_mean(model, asked, start, tolerance):
        count = asked.speed.size
        sizes.append(count)
        few = count <= FEW
        return {
            "converged": np.full(count, not few), "temperature": np.full(count, 330.0),
            "heat_residual": np.full(count, 5.0 if few else 0.0),
        }  # fmt: skip

    monkeypatch.setattr(warm_orbit, "_of_mean", of_mean)
    assert _series_temperature(_CarriesUpTo(1e6)) == 330.0
    assert sizes == [FEW, 64]


def test_where_no_load_has_a_film_the_mildest_are_asked_of_a_finer_model():
    model = _CarriesUpTo(0.0, refined=4e4)
    with pytest.warns(ValidityWarning, match="1 of 4"):
        _series_temperature(model)
    assert {force.size for force, refine in model.asked if refine} <= {1, 3, 4}
    assert max(force.size for force, refine in model.asked if refine) == 4
    with pytest.raises(SolverError, match="no film carries its mildest loads, from 1000 N on"):
        _series_temperature(_CarriesUpTo(0.0))


SMALL = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
WARM = {"oil": "iso-vg-68", "inlet_temperature": 313.15}
MIXED = FILM | {"edge_pressure": 1.5e5, "grid": (60, 20)}


@pytest.mark.parametrize("rung", ["grid", "reduced", "chart"])
def test_shaft_and_shell_grow_as_iso_7902_says(rung):
    """Δψ = (α_shell − α_shaft)(T − 20 °C), and the film is that of a bearing made with it."""
    growth = Growth(shaft_expansion=11e-6, shell_expansion=18e-6)
    film = MIXED | {"rung": rung}
    if rung == "chart":
        film = {"rung": rung}
    loads = np.array([[1e4, 0.0], [4e4, 0.0]])
    found = SMALL.equilibrium(loads, 100.0, heat=Heat(**WARM, growth=growth), **film)
    psi = 1e-3 + (18e-6 - 11e-6) * (found.temperature - 293.15)
    assert found.clearance == pytest.approx(psi * 0.1, rel=1e-12)
    for load, one, warm, ratio, thin in zip(
        loads, psi, found.temperature, found.eccentricity_ratio, found.minimum_film
    ):
        made = JournalBearing(0.2, 0.1, float(one))
        alike = made.equilibrium(load, 100.0, heat=Heat(**WARM), **film)
        assert alike.temperature == pytest.approx(warm, abs=1e-4)
        assert ratio == pytest.approx(alike.eccentricity_ratio, rel=1e-5)
        assert thin == pytest.approx(alike.minimum_film, rel=1e-5)


def test_growth_alike_changes_nothing_and_a_cool_shell_narrows_the_gap():
    loads = np.array([[1e4, 0.0], [4e4, 0.0]])

    def solved(**more):
        return SMALL.equilibrium(loads, 60.0, heat=Heat(**WARM, **more), **MIXED, rung="reduced")

    none, alike = solved(), solved(growth=Growth())
    assert alike.temperature == pytest.approx(none.temperature, rel=1e-12)
    assert none.clearance is None
    cool = solved(growth=Growth(shell_share=0.8))
    lost = 11.7e-6 * 0.1 * 0.2 * (cool.temperature - 293.15)
    assert cool.clearance == pytest.approx(1e-4 - lost, rel=1e-12)
    assert (cool.temperature > none.temperature).all()
    given = solved(growth=Growth(shaft_temperature=330.0, shell_temperature=310.0))
    assert given.clearance == pytest.approx(1e-4 - 11.7e-6 * 0.1 * 20.0, rel=1e-12)


def test_a_shaft_that_grows_into_its_shell_has_no_balance():
    heat = Heat(**WARM, growth=Growth(shell_share=0.2))
    with pytest.raises(SolverError, match="no heat balance"):
        SMALL.equilibrium((1e4, 0.0), 100.0, heat=heat, **MIXED, rung="reduced")


def test_oil_that_goes_round_enters_as_warm_as_its_sump():
    """Sump and housing give off all of the friction: a balance of three temperatures."""
    heat = Heat(**WARM, sump_transfer=300.0, transfer=20.0, ambient_temperature=290.0)
    loads = np.array([[1e4, 0.0], [4e4, 0.0]])
    found = SMALL.equilibrium(loads, 60.0, heat=heat, **MIXED, rung="reduced")
    inlet, warm = found.inlet_temperature, found.temperature
    by_sump, by_housing = 300.0 * (inlet - 290.0), 20.0 * (warm - 290.0)
    assert by_sump + by_housing == pytest.approx(found.friction_power, rel=1e-6)
    carried = heat.liquid.density(warm) * heat.heat_capacity * found.side_flow
    assert carried * (found.outlet_temperature - inlet) == pytest.approx(by_sump, rel=1e-6)
    assert 0.5 * (inlet + found.outlet_temperature) == pytest.approx(warm)
    cold = SMALL.equilibrium(
        loads, 60.0, heat=Heat(**WARM, sump_transfer=1e9, ambient_temperature=313.15), **MIXED,
        rung="reduced",
    )  # fmt: skip
    fresh = SMALL.equilibrium(loads, 60.0, heat=Heat(**WARM), **MIXED, rung="reduced")
    assert cold.temperature == pytest.approx(fresh.temperature, abs=1e-4)


def test_a_series_grows_to_the_clearance_of_its_temperature():
    heat = Heat(**WARM, growth=Growth(shell_expansion=18e-6))
    time = np.linspace(0.0, 0.2, 21)
    force = np.stack([3e4 + 5e3 * np.sin(30 * time), np.zeros(21)], axis=-1)
    path = SMALL.orbit(time, force, 60.0, heat=heat, **MIXED, rung="reduced")
    warm = float(path["temperature"][0])
    made = JournalBearing(0.2, 0.1, 1e-3 + (18e-6 - 11.7e-6) * (warm - 293.15))
    alone = made.orbit(time, force, 60.0, heat.lubricant(warm), **MIXED, rung="reduced")
    assert path["minimum_film"].values == pytest.approx(alone["minimum_film"].values, rel=1e-9)


@pytest.mark.parametrize(
    ("keys", "film", "named"),
    [
        ({"sump_transfer": 1e2, "capacity": 1e5}, {}, "sump_transfer"),
        ({"growth": Growth()}, {"rung": "map"}, "heat.growth"),
    ],
)
def test_what_does_not_grow_says_so(keys, film, named):
    with pytest.raises(InputError, match=named):
        SMALL.equilibrium((1e4, 0.0), 60.0, heat=Heat(**WARM, **keys), **MIXED | film)


@pytest.mark.filterwarnings("ignore:the cells do not resolve")
def test_many_loads_that_are_found_leave_a_hard_one_of_their_mean_its_search():
    """They have one effort, of which only what is sought in vain counts; few are allowed here."""
    bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    load = np.column_stack([np.linspace(2e3, 2e4, 240), np.linspace(-1e3, 1e3, 240)])
    speed, tilt = np.linspace(100.0, 250.0, 240), np.tile((0.0, 4e-4), (240, 1))
    load[-1], speed[-1] = (9.05e4, 0.0), 60.0
    film = Film(heat=Heat(oil="iso-vg-68"), grid=(40, 8), rung="grid")
    control = Control(strict=False, max_iterations=12)
    given = {"control": control, "weights": np.ones(240), "tilt": tilt}
    found = bearing.equilibrium(load, speed, film, **given)
    assert found.converged.all()
