"""Heat over the area of a reduced film: the energy equation of its strips, beside the grid's."""

from dataclasses import replace

import numpy as np
import pytest
from numba import typeof

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Arc,
    Contact,
    Control,
    Crown,
    Film,
    FilmHeat,
    GasMixture,
    Groove,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    MassConserving,
    RingGrowth,
    Supply,
    TiltingPads,
)
from loadflow.journal.line import Line
from loadflow.journal.models import grid as grid_rung
from loadflow.journal.models.composed.rest_on_level import films_at_rest
from loadflow.journal.models.composed.uneven import EVEN, Thickness
from loadflow.journal.questions import AtRest
from loadflow.journal.solvers.warm.position import coupled
from loadflow.numerics.convergence import Limits
from loadflow.tribology import AsperityContact, ExponentialOil

BEARING = JournalBearing(0.2, 0.15, 1e-3)
LOAD, SPEED = np.array([4e4, 3e3]), 100.0
HEAT = FilmHeat("iso-vg-68", shell_transfer=500.0, shell_temperature=313.15)
ROUGH = Contact(AsperityContact(roughness=2e-6, contact_modulus=115e9, factor=1e-3), friction=0.1)
GROWS = replace(HEAT, growth=RingGrowth(0.3))
POCKET = Supply((Groove(1.57, arc=0.3, length=0.08, pressure=3e5),))
FINE = (96, 24)
TOLD = ("minimum_film", "maximum_pressure", "friction_power")


def film(rung="reduced", grid=(72, 12), heat=HEAT, **more):
    more = {"edge_pressure": 1.5e5, "grading": "uniform", "inlet": None} | more
    return Film(None, GasMixture(5e4), grid=grid, heat=heat, rung=rung, **more)


_AT_REST = {}


def at_rest(rung, more, line):
    """The film at rest on the fine cells, once for all tests that ask for it."""
    asked = repr((rung, more, line))
    if asked not in _AT_REST:
        _AT_REST[asked] = BEARING.equilibrium(LOAD, SPEED, film(rung, FINE, **more), **line)
    return _AT_REST[asked]


@pytest.mark.parametrize(
    ("more", "line"),
    [
        ({}, {}),
        ({"shell": LocalShell(1e-12)}, {}),
        ({"contact": ROUGH}, {"tilt": (0.0, 2e-4)}),
        ({"heat": replace(HEAT, points=3)}, {}),
        ({"heat": replace(HEAT, points=4)}, {}),
        ({"heat": GROWS}, {}),
        ({"heat": GROWS, "shell": LocalShell(1e-12)}, {}),
        ({"heat": replace(GROWS, points=4), "contact": ROUGH}, {"tilt": (0.0, 5e-5)}),
    ],
)
def test_a_film_at_rest_is_that_of_the_grid(more, line):
    """On the same cells, strips as many as rows; what leaves is the friction, to rounding."""
    own, grid = (at_rest(rung, more, line) for rung in ("reduced", "grid"))
    assert own.converged
    assert own.heat_imbalance < 1e-8
    left = own.heat_carried + own.heat_conducted
    assert left == pytest.approx(float(own.friction_power), rel=1e-8)
    grows = more.get("heat", HEAT).growth is not None
    for name, most in zip(TOLD, (0.01 if grows else 0.004, 0.007, 0.0015)):
        assert getattr(own, name) == pytest.approx(float(getattr(grid, name)), rel=most)
    assert own.temperature == pytest.approx(float(grid.temperature), abs=0.05)
    assert own.maximum_temperature == pytest.approx(float(grid.maximum_temperature), abs=0.3)
    if grows:
        assert own.thermal_growth.mean() == pytest.approx(grid.thermal_growth.mean(), rel=5e-3)
        assert own.clearance == pytest.approx(float(grid.clearance), rel=1e-3)
        assert own.eccentricity_ratio == pytest.approx(float(grid.eccentricity_ratio), rel=5e-3)
    assert own.film_temperature.shape == (own.angle.size, own.z.size) == grid.film_temperature.shape
    off = np.linalg.norm(own.moment - grid.moment)
    assert off <= 1e-3 * np.linalg.norm(LOAD) * BEARING.width


@pytest.mark.parametrize(
    ("relief", "law"),
    [((Crown(1e-5, 0.02),), GasMixture(5e4)), ((), MassConserving(5e4))],
)
def test_growth_with_a_crown_or_any_law_is_that_of_the_grid(relief, law):
    bearing = replace(BEARING, relief=relief)
    own, grid = (
        bearing.equilibrium(LOAD, SPEED, replace(film(rung, FINE, GROWS), cavitation=law))
        for rung in ("reduced", "grid")
    )
    for name, most in zip(TOLD, (0.006, 0.01, 0.0015)):
        assert getattr(own, name) == pytest.approx(float(getattr(grid, name)), rel=most)


@pytest.mark.parametrize(
    ("shape", "more", "line"),
    [
        (Lobes(2), {}, {}),
        (Lobes(3, preload=0.3), {"heat": GROWS, "contact": ROUGH}, {"tilt": (0.0, 5e-5)}),
        (Arc(0.0, 2.6), {"heat": replace(HEAT, points=4), "shell": LocalShell(1e-12)}, {}),
    ],
)
def test_oil_mixes_between_segments_as_on_the_grid(shape, more, line):
    bearing = replace(BEARING, shape=shape)
    own, grid = (
        bearing.equilibrium(LOAD, SPEED, film(rung, FINE, **more), **line)
        for rung in ("reduced", "grid")
    )
    assert own.heat_imbalance < 1e-8
    for name, most in zip(TOLD, (0.01 if "heat" in more else 0.003, 0.006, 0.001)):
        assert getattr(own, name) == pytest.approx(float(getattr(grid, name)), rel=most)
    assert own.temperature == pytest.approx(float(grid.temperature), abs=0.05)
    for name in ("trailing_temperature", "leading_temperature"):
        np.testing.assert_allclose(getattr(own, name), getattr(grid, name), atol=0.2)


@pytest.mark.parametrize(
    ("supply", "more", "line"),
    [
        (POCKET, {}, {}),
        (Supply((*POCKET.grooves, Groove(-1.57, arc=0.3, pressure=3e5))), {}, {"tilt": (0, 1e-4)}),
        (Supply((Groove(1.57, arc=0.3, length=0.03, axial=0.04, pressure=3e5),)), {}, {}),
        (POCKET, {"heat": replace(GROWS, points=4)}, {}),
    ],
)
def test_fresh_oil_mixes_in_grooves_as_on_the_grid(supply, more, line):
    """In a pocket, one beside a groove of all the width under tilt, and a pair of pockets."""
    own, grid = (at_rest(rung, more | {"supply": supply}, line) for rung in ("reduced", "grid"))
    assert own.heat_imbalance < 1e-8
    for name, most in zip(TOLD, (0.006 if "heat" in more else 0.004, 0.007, 0.004)):
        assert getattr(own, name) == pytest.approx(float(getattr(grid, name)), rel=most)
    assert own.temperature == pytest.approx(float(grid.temperature), abs=0.1)
    assert own.maximum_temperature == pytest.approx(float(grid.maximum_temperature), abs=0.2)
    for name in ("trailing_temperature", "leading_temperature"):
        np.testing.assert_allclose(getattr(own, name), getattr(grid, name), atol=0.3)


@pytest.mark.parametrize("given", [{}, {"step": "adaptive"}, {"periodic": True}])
def test_a_path_beside_a_pocket_is_that_of_the_grid(given):
    time = np.linspace(0.0, 0.1, 11)
    loads = LOAD + np.outer(np.sin(2 * np.pi * time / 0.1), [2e4, 1e4])
    loads[-1] = loads[0]
    own, grid = (
        BEARING.orbit(time, loads, SPEED, film(rung, FINE, supply=POCKET), **given)
        for rung in ("reduced", "grid")
    )
    assert own.attrs["heat_imbalance"] < 1e-8
    for name, most in zip(TOLD, (0.006, 0.007, 0.003)):
        np.testing.assert_allclose(own[name], grid[name], rtol=most)


def test_a_closed_path_between_lobes_is_that_of_the_grid():
    time = np.linspace(0.0, 0.1, 11)
    loads = LOAD + np.outer(np.sin(2 * np.pi * time / 0.1), [2e4, 1e4])
    loads[-1] = loads[0]
    bearing = replace(BEARING, shape=Lobes(2))
    own, grid = (
        bearing.orbit(time, loads, SPEED, film(rung, FINE), periodic=True)
        for rung in ("reduced", "grid")
    )
    assert own.attrs["closure"] < 1e-6
    assert own.attrs["heat_imbalance"] < 1e-8
    for name, most in zip(TOLD, (0.003, 0.006, 0.001)):
        np.testing.assert_allclose(own[name], grid[name], rtol=most)


def test_more_cells_across_are_more_strips_up_to_the_friction_of_the_grid():
    """What mixes between strips is of first order, as between rows: the same on both rungs."""
    fine = (96, 48)
    own, grid = (BEARING.equilibrium(LOAD, SPEED, film(rung, fine)) for rung in ("reduced", "grid"))
    few = at_rest("reduced", {}, {})
    assert own.friction_power == pytest.approx(float(grid.friction_power), rel=1e-3)
    assert own.temperature > few.temperature + 0.3


def test_with_one_viscosity_it_is_the_isothermal_film():
    even = ExponentialOil(reference_viscosity=0.03, reference_density=870.0)
    warm = BEARING.equilibrium(LOAD, SPEED, film(heat=replace(HEAT, oil=even)))
    cold = replace(film(), heat=None, lubricant=Lubricant(0.03))
    cold = BEARING.equilibrium(LOAD, SPEED, replace(cold, contact=ROUGH))  # on points across
    for name in ("minimum_film", "maximum_pressure", "stiffness", "damping"):
        expected = getattr(cold, name)
        scale = np.abs(expected).max()
        np.testing.assert_allclose(getattr(warm, name), expected, rtol=3e-3, atol=3e-3 * scale)


def test_a_gap_that_grows_unevenly_is_no_other_kind_of_film_to_the_compiler():
    """Else all kernels of films with effects are compiled once more, for 40 s."""
    around, z = np.linspace(0.1, 0.2, 6), np.array([0.0, 0.4, 0.8])
    values = np.outer(1.0 + around, [1.0, 0.9, 0.8])
    grown = Thickness(z, values, growth=0.01 * values)
    places = np.array([0.1, 0.3, 0.5, 0.7])
    assert typeof(grown.at(places, places, around, around)) == typeof(EVEN)


def test_reversed_motion_is_the_mirror_image():
    one, other = (
        BEARING.equilibrium(LOAD * [1, sign], sign * SPEED, film(), tilt=(0.0, 1e-4))
        for sign in (1, -1)
    )
    for name in (*TOLD, "maximum_temperature", "temperature", "side_flow"):
        assert getattr(other, name) == pytest.approx(float(getattr(one, name)), rel=1e-7)


def test_stiffness_is_the_slope_of_the_force_at_the_viscosity_of_the_film():
    """Of films under loads a little apart, with a viscosity that falls threefold around."""
    around = 1.0 + 0.5 * np.cos(np.linspace(0.0, 2 * np.pi, 72, endpoint=False))
    uneven = Thickness(np.array([0.0, 0.8]), around[:, None] * [1.0, 0.8])
    options = replace(film(), heat=None, lubricant=Lubricant(0.03))
    step = np.array([10.0, -20.0])
    loads, speeds = LOAD + np.outer([0.0, 1.0, -1.0], step), np.full(3, SPEED)
    asked = AtRest(BEARING, options, loads, speeds, Line(), Limits(1e-12, 60, True))
    films = films_at_rest(asked, 1, viscosity=uneven)
    _, more, less = films.answer["eccentricity"]
    found = films.answer["stiffness"][0] @ (0.5 * (more - less))
    np.testing.assert_allclose(found, step, rtol=1e-5)


@pytest.mark.parametrize(
    ("heat", "step"), [(HEAT, "given"), (replace(GROWS, points=3), "given"), (GROWS, "adaptive")]
)
def test_a_path_is_that_of_the_grid_and_keeps_its_temperatures(heat, step):
    time = np.linspace(0.0, 0.1, 11)
    loads = LOAD + np.outer(np.sin(2 * np.pi * time / 0.1), [2e4, 1e4])
    own, grid = (
        BEARING.orbit(time, loads, SPEED, film(rung, FINE, heat), step=step)
        for rung in ("reduced", "grid")
    )
    assert own.attrs["heat_imbalance"] < 1e-8
    assert own.attrs["heat_residual"] < 1e-6
    assert np.ptp(own.temperature.values) == 0.0
    assert float(own.temperature[0]) == pytest.approx(float(grid.temperature[0]), abs=0.05)
    assert own.attrs.get("mean_growth", 0.0) == pytest.approx(
        grid.attrs.get("mean_growth", 0.0), rel=5e-3
    )
    for name, most in zip((*TOLD, "eccentricity_ratio"), (0.01, 0.01, 0.002, 0.005)):
        np.testing.assert_allclose(own[name], grid[name], rtol=most)


@pytest.mark.parametrize("heat", [HEAT, replace(GROWS, points=4)])
def test_a_closed_path_with_shell_and_asperities_closes(heat):
    time = np.linspace(0.0, 0.1, 11)
    loads = LOAD + np.outer(np.sin(2 * np.pi * time / 0.1), [2e4, 1e4])
    loads[-1] = loads[0]
    options = film(heat=heat, contact=ROUGH, shell=LocalShell(1e-12))
    path = BEARING.orbit(time, loads, SPEED, options, periodic=True)
    assert path.attrs["closure"] < 1e-6
    assert path.attrs["heat_imbalance"] < 1e-8


PLACED = [
    ({}, {}),
    ({"heat": GROWS, "shell": LocalShell(1e-12)}, {}),
    ({"contact": ROUGH}, {"tilt": (0.0, 2e-4)}),
    ({"heat": replace(GROWS, points=4), "supply": POCKET}, {}),
]


@pytest.mark.parametrize(("more", "line"), PLACED)
def test_a_film_at_a_place_is_that_of_the_grid_and_carries_the_load_at_rest_there(more, line):
    rest = at_rest("reduced", more, line)
    own, grid = (
        BEARING.pressure(rest.eccentricity, SPEED, film(rung, FINE, **more), **line)
        for rung in ("reduced", "grid")
    )
    np.testing.assert_allclose(own.force, LOAD, atol=1e-6 * np.hypot(*LOAD))
    for name in (*TOLD, "temperature", "heat_carried"):
        assert getattr(own, name) == pytest.approx(float(getattr(rest, name)), rel=1e-6)
    assert own.heat_imbalance < 1e-8
    most = 0.02 if "heat" in more else 0.01
    np.testing.assert_allclose(own.force, grid.force, atol=most * np.hypot(*LOAD))
    for name in TOLD:
        assert getattr(own, name) == pytest.approx(float(getattr(grid, name)), rel=most)
    assert own.temperature == pytest.approx(float(grid.temperature), abs=0.1)
    # fields are those of the points at which the pressure is shown
    around, across = own.angle.size, own.z.size
    assert own.film_temperature.shape == own.pressure.shape == (around, across)
    assert own.to_dataset().sizes["across"] == across
    if "heat" in more:
        middle = np.abs(own.z) < 0.04
        rows = np.array([np.interp(own.z, grid.z, row) for row in grid.thermal_growth])
        about = rows[:, middle].mean()
        assert own.thermal_growth[:, middle].mean() == pytest.approx(about, rel=0.02)


@pytest.mark.parametrize(("more", "line"), PLACED[:1] + PLACED[2:])
def test_a_settled_stiffness_is_that_of_the_grid(more, line):
    """So it is for the tilts of a shaft; at frozen temperatures it is another one."""
    heat = replace(more.get("heat", HEAT), stiffness="settled")
    own, grid = (
        BEARING.equilibrium(LOAD, SPEED, film(rung, FINE, **more | {"heat": heat}), **line)
        for rung in ("reduced", "grid")
    )
    frozen = at_rest("reduced", more, line).stiffness
    for block in (np.s_[:2, :2], np.s_[2:, 2:]):
        if not own.stiffness[block].size:
            continue
        largest = np.abs(grid.stiffness[block]).max()
        apart = np.abs(own.stiffness[block] - grid.stiffness[block]).max()
        assert apart < 0.02 * largest
        assert np.abs(frozen[block] - grid.stiffness[block]).max() > 3.0 * apart
    np.testing.assert_allclose(own.damping, grid.damping, atol=0.02 * np.abs(grid.damping).max())


@pytest.mark.parametrize("rung", ["reduced", "grid"])
@pytest.mark.parametrize(("more", "line"), [PLACED[0], ({}, {"tilt": (0.0, 1e-4)})])
def test_a_settled_stiffness_at_a_place_is_that_of_the_shaft_at_rest_there(more, line, rung):
    settled, frozen = (
        film(rung, heat=replace(HEAT, stiffness=kind), **more) for kind in ("settled", "frozen")
    )
    rest = BEARING.equilibrium(LOAD, SPEED, settled, **line)
    there, cold = (
        BEARING.pressure(rest.eccentricity, SPEED, one, **line) for one in (settled, frozen)
    )
    largest = np.abs(rest.stiffness).max()
    np.testing.assert_allclose(there.stiffness, rest.stiffness, atol=1e-7 * largest)
    assert np.abs(cold.stiffness - rest.stiffness).max() > 0.02 * largest
    np.testing.assert_array_equal(there.damping, cold.damping)


@pytest.mark.parametrize(
    ("rung", "module"),
    [("reduced", "models.composed.strip_film"), ("grid", "solvers.warm.rows")],
)
def test_a_settled_stiffness_of_which_one_film_has_no_temperatures_is_none(
    rung, module, monkeypatch
):
    """All of it, on either rung, and what else is known of the load stays."""
    solve, beside = coupled, []

    def third_is_lost(equation, film_of, last, heat_of):
        found = solve(equation, film_of, last, heat_of)
        if last is None:
            return found
        beside.append(found)
        return replace(found, converged=len(beside) != 3, why="too hot")

    monkeypatch.setattr(f"loadflow.journal.{module}.coupled", third_is_lost)
    options = film(rung, heat=replace(HEAT, stiffness="settled"))
    state = BEARING.equilibrium(LOAD, SPEED, options, strict=False)
    assert len(beside) == 3
    assert state.converged
    assert np.isnan(state.stiffness).all()
    assert np.isfinite([*state.damping.flat, state.minimum_film]).all()
    field = BEARING.pressure(state.eccentricity, SPEED, options, strict=False)
    assert np.isfinite(field.stiffness).all()  # none is lost here
    for verb, where, name in (("equilibrium", LOAD, "load"), ("pressure", (5e-5, 0.0), "film")):
        beside.clear()
        with pytest.raises(SolverError, match=f"{name} 0: no temperatures beside .*: too hot"):
            getattr(BEARING, verb)(where, SPEED, options)


def test_what_has_no_film_at_a_place_says_why():
    with pytest.raises(InputError, match="velocity"):
        BEARING.pressure((1e-5, 0.0), SPEED, film(), velocity=(1e-3, 0.0))
    with pytest.raises(InputError, match=r"eccentricity 1: .*touches the bore"):
        BEARING.pressure([(1e-5, 0.0), (1.1e-4, 0.0)], SPEED, film())
    hot = replace(HEAT, shell_transfer=0.0)
    with pytest.raises(SolverError, match=r"film 0: .*K"):
        BEARING.pressure((9.9e-5, 0.0), 3e3, film(heat=hot))
    flagged = BEARING.pressure(
        [(9.9e-5, 0.0), (1e-5, 0.0)], [3e3, 10.0], film(heat=hot), control=Control(strict=False)
    )
    assert not flagged.converged[0]
    assert np.isnan(flagged.temperature[0])


def test_the_grid_is_not_asked_for_a_reason_that_is_not_told(monkeypatch):
    """A shaft that touches the bore is refused all the same."""
    monkeypatch.setattr(grid_rung, "pressure", lambda *given: pytest.fail("asked"))
    hot, loose = film(heat=replace(HEAT, shell_transfer=0.0)), Control(strict=False)
    found = BEARING.pressure([(9.9e-5, 0.0), (1e-5, 0.0)], [3e3, 10.0], hot, control=loose)
    assert found.converged.tolist() == [False, True]
    for control in (loose, Control()):
        with pytest.raises(InputError, match=r"eccentricity 1: .*touches the bore"):
            BEARING.pressure([(1e-5, 0.0), (1.1e-4, 0.0)], SPEED, film(), control=control)


def test_pads_with_heat_over_the_area_are_those_of_the_grid():
    pads = replace(BEARING, shape=TiltingPads(4, 1.2))
    own, grid = (pads.equilibrium(LOAD, SPEED, film(rung)) for rung in ("reduced", "grid"))
    assert own.converged
    assert own.pad_tilt.shape == (4,)
    for name in (*TOLD, "eccentricity", "pad_tilt", "stiffness", "film_temperature"):
        np.testing.assert_array_equal(getattr(own, name), getattr(grid, name))
    assert own.maximum_temperature > HEAT.inlet_temperature + 5.0


def test_growth_asks_for_a_film_that_runs_round():
    half = replace(BEARING, shape=Arc(0.0, 2.6))
    with pytest.raises(InputError, match="a film runs round"):
        half.equilibrium(LOAD, SPEED, film(heat=GROWS))
