"""The rung "map": the mobility of the film against the grid, its laws, its limits."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks.peers.journal_map import held_out
from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Film,
    GasMixture,
    Groove,
    Guembel,
    JournalBearing,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    Supply,
)
from loadflow.journal.models import mobility
from loadflow.numerics.splines import spline

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
OIL = Lubricant(0.05)
OMEGA = 1.2
SCALE_FREE = {"lubricant": OIL, "cavitation": Reynolds(), "inlet": None, "grid": (40, 12)}
MIXTURE = {"lubricant": OIL, "cavitation": GasMixture(5e4), "edge_pressure": 5e5, "grid": (36, 8)}
LAWS = {
    "mixture": MIXTURE,
    "mass conserving": MIXTURE | {"cavitation": MassConserving()},
    "inlet line": SCALE_FREE | {"inlet": "widest gap"},
    "free": SCALE_FREE,
    "half": SCALE_FREE | {"cavitation": Guembel()},
    "full": SCALE_FREE | {"cavitation": Sommerfeld()},
}


def load(time):
    return np.stack([2e6 + 5e5 * np.sin(1.5 * time), 4e5 * np.cos(4 * time)], axis=-1)


@pytest.mark.parametrize("name", LAWS)
def test_orbit_is_that_of_the_grid(name):
    film, time = LAWS[name], np.linspace(0.0, 10.0, 201)
    grid = BEARING.orbit(time, load(time), OMEGA, **film)
    quick = BEARING.orbit(time, load(time), OMEGA, rung="map", **film)
    assert set(quick.data_vars) == {*grid.data_vars, "in_range"}
    assert quick.in_range.all()
    late = slice(60, None)  # a mixture's fill at the start is that of rest
    for field, share in {"eccentricity_ratio": 0.01, "maximum_pressure": 0.02}.items():
        largest = [float(orbit[field][late].max()) for orbit in (grid, quick)]
        assert largest[1] == pytest.approx(largest[0], rel=share), field
    power = [float(orbit.friction_power[late].mean()) for orbit in (grid, quick)]
    assert power[1] == pytest.approx(power[0], rel=0.01)


@pytest.mark.parametrize("name", LAWS)
def test_equilibrium_is_that_of_the_grid(name):
    film = LAWS[name]
    force = load(np.linspace(0.0, 3.0, 4)) * np.array([0.5, 1.0, 1.5, 2.0])[:, None]
    speed = np.array([OMEGA, -OMEGA, 0.7, 1.4])
    grid = BEARING.equilibrium(force, speed, grading="graded", **film)
    quick = BEARING.equilibrium(force, speed, rung="map", **film)
    assert quick.converged.all()
    near = {"eccentricity": 1e-2, "maximum_pressure": 0.01, "friction_power": 5e-3}
    near |= {"side_flow": 0.01, "total_fill": 5e-3, "sommerfeld_number": 1e-12}
    near |= {"reynolds_number": 1e-12, "minimum_film": 0.01}
    slopes = 0.1 if name == "mass conserving" else 0.03  # its rupture jumps from cell to cell
    near |= {"stiffness": slopes, "damping": slopes}
    for field, share in near.items():
        one, other = getattr(grid, field), getattr(quick, field)
        assert one.shape == other.shape
        np.testing.assert_allclose(other, one, atol=share * np.abs(one).max(), err_msg=field)
    np.testing.assert_allclose(quick.attitude_angle, grid.attitude_angle, atol=0.01)


@pytest.mark.parametrize("name", ["mixture", "inlet line"])
def test_map_between_its_nodes(name):
    """Held-out sample of loads within 90° of the eccentricity, up to ε = 0.95."""
    film = {k: v for k, v in LAWS[name].items() if k != "lubricant"}
    options, _ = mobility.scaled(Film(OIL, grading="graded", **film))
    table = mobility.tabulate(0.75, options, 1.0 if name == "mixture" else 0.0)
    points = np.random.default_rng(7).uniform((0, 0, 0.1), (0.95, np.pi / 2, 1), (40, 3))
    errors = held_out(table, 0.75, options, points)
    assert np.median(errors) < 0.01
    assert np.quantile(errors, 0.9) < 0.08  # worst where light eccentricity meets a starved film


def test_constant_load_stays_at_the_static_equilibrium():
    orbit = BEARING.orbit(
        np.arange(6) * 0.1, np.tile([2e6, 1e5], (6, 1)), OMEGA, rung="map", **MIXTURE
    )
    assert np.ptp(orbit.eccentricity.values, axis=0).max() < 1e-9 * BEARING.clearance
    assert orbit.attitude_angle[0] > 0


def test_very_long_steps_follow_the_static_equilibrium():
    """Stiff: the film settles within a second, the steps take a thousand."""
    time = np.linspace(0.0, 2e4, 21)
    force = load(time / 1000)
    orbit = BEARING.orbit(time, force, OMEGA, rung="map", **MIXTURE)
    static = BEARING.equilibrium(force, OMEGA, rung="map", **MIXTURE)
    np.testing.assert_allclose(orbit.eccentricity_ratio, static.eccentricity_ratio, atol=1e-3)
    assert float(orbit.iterations.max()) < 200


def test_steps_are_as_small_as_the_tolerance_asks():
    time = np.linspace(0.0, 2.0, 5)
    ends = [
        BEARING.orbit(time, load(time), OMEGA, rung="map", tolerance=tolerance, **SCALE_FREE)
        for tolerance in (1e-8, 1e-12, 1e-16)
    ]
    usual, sharp, exact = (end.eccentricity.values[-1] / BEARING.clearance for end in ends)
    assert np.hypot(*(usual - exact)) < 1e-4
    assert np.hypot(*(sharp - exact)) < 0.1 * np.hypot(*(usual - exact))
    assert float(ends[1].residual.max()) <= 1e-6


@settings(max_examples=15, deadline=None)
@given(st.floats(-3.1, 3.1), st.floats(0.05, 20.0), st.booleans())
def test_the_law_of_a_scale_free_film(angle, faster, mirror):
    """Turning, mirroring or hurrying load and shaft does the same to the path."""
    time = np.linspace(0.0, 3.0, 31)
    plain = BEARING.orbit(time, load(time), OMEGA, rung="map", **SCALE_FREE).eccentricity.values
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    turn = np.diag([1.0, -1.0 if mirror else 1.0]) @ turn
    speed = faster * (-OMEGA if mirror else OMEGA)
    other = BEARING.orbit(
        time / faster, faster * load(time) @ turn, speed, rung="map", **SCALE_FREE
    )
    np.testing.assert_allclose(other.eccentricity, plain @ turn, atol=1e-7 * BEARING.clearance)


@settings(max_examples=25, deadline=None)
@given(st.floats(-4, 1.0), st.floats(-3.1, 3.1), st.floats(0.01, 50.0))
def test_what_rests_is_what_the_map_says(power, angle, speed):
    """Any load: an equilibrium that the path does not leave, or a refusal with numbers."""
    size = 10**power * 0.05 * speed * BEARING.width * BEARING.diameter / 0.5e-3**2
    force = size * np.array([np.cos(angle), np.sin(angle)])
    state = BEARING.equilibrium(force, speed, rung="map", strict=False, **SCALE_FREE)
    assert state.converged
    time = np.linspace(0.0, 5.0 / speed, 6)
    orbit = BEARING.orbit(time, np.tile(force, (6, 1)), speed, rung="map", **SCALE_FREE)
    gap = state.minimum_film
    assert np.abs(orbit.eccentricity - state.eccentricity).max() < 1e-6 * gap
    eigenvalues = np.linalg.eigvalsh(state.damping + state.damping.T)
    assert eigenvalues[0] > 0


def test_a_path_beyond_the_map_is_flagged_and_stays_in_the_bearing():
    time = np.linspace(0.0, 200.0, 101)
    speed = OMEGA * np.clip(1 - time / 50, 0, None)
    orbit = BEARING.orbit(time, np.tile([3e6, 0.0], (101, 1)), speed, rung="map", **MIXTURE)
    assert orbit.in_range[0]
    assert not orbit.in_range[-1]
    assert 0.995 < float(orbit.eccentricity_ratio[-1]) < 1.0
    assert np.all(np.diff(orbit.eccentricity_ratio[-40:]) > 0)
    assert not any(np.isnan(orbit[name]).any() for name in orbit.data_vars)


def test_a_load_that_turns_round_at_once():
    time = np.arange(60) * 0.1
    force = np.tile([2e6, 0.0], (60, 1))
    force[20:] *= -1
    grid = BEARING.orbit(time, force, OMEGA, **SCALE_FREE)
    quick = BEARING.orbit(time, force, OMEGA, rung="map", **SCALE_FREE)
    after = slice(23, None)  # between two times the load is linear here, new at once on the grid
    np.testing.assert_allclose(
        quick.eccentricity[after], grid.eccentricity[after], atol=0.02 * BEARING.clearance
    )


def test_no_load_and_no_speed():
    force = [(0.0, 0.0), (0.0, 0.0), (2e6, 0.0)]
    idle = BEARING.equilibrium(force, [OMEGA, 0.0, OMEGA], rung="map", **MIXTURE)
    np.testing.assert_allclose(idle.eccentricity_ratio[:2], 0.0, atol=1e-12)
    assert idle.friction_power[0] > 0
    with pytest.raises(SolverError, match=r"load 1: F = \(2e\+06, 0\) N at ω = 0 rad/s"):
        BEARING.equilibrium((2e6, 0.0), [OMEGA, 0.0], rung="map", **MIXTURE)
    state = BEARING.equilibrium((2e6, 0.0), [OMEGA, 0.0], rung="map", strict=False, **MIXTURE)
    assert state.converged.tolist() == [True, False]
    assert np.isnan(state.eccentricity_ratio[1])
    assert np.isnan(state.damping[1]).all()


def test_what_a_map_cannot_have_is_named():
    with pytest.raises(InputError, match="supply"):
        BEARING.equilibrium((2e6, 0.0), 1.0, rung="map", supply=Supply([Groove(1.0)]), **SCALE_FREE)
    with pytest.raises(InputError, match=r"edge_pressure = 0\.0 .* no oil enters"):
        BEARING.equilibrium((2e6, 0.0), 1.0, rung="map", **MIXTURE | {"edge_pressure": 0.0})
    with pytest.raises(InputError, match=r"grid\[1\] = 7"):
        BEARING.equilibrium((2e6, 0.0), 1.0, rung="map", **MIXTURE | {"grid": (36, 7)})


def test_a_load_beyond_the_map_is_solved_on_the_grid_of_the_map():
    beyond = BEARING.equilibrium([(3e6, 0.0), (1e6, 0.0)], [1e-4, 1.0], rung="map", **MIXTURE)
    grid = BEARING.equilibrium((3e6, 0.0), 1e-4, grading="graded", **MIXTURE)
    assert beyond.converged.all()
    assert beyond.eccentricity_ratio[0] > 0.995
    assert beyond.eccentricity_ratio[0] == pytest.approx(float(grid.eccentricity_ratio), rel=1e-9)


def test_a_film_that_ambient_pressure_feeds_on_one_side_of_a_cell_of_the_map_has_an_answer():
    bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    film = {"cavitation": GasMixture(5e4), "edge_pressure": 1.5e5, "grid": (48, 10)}
    by_map = bearing.equilibrium((8000.0, 1000.0), 100.0, Lubricant(0.03), rung="map", **film)
    grid = bearing.equilibrium((8000.0, 1000.0), 100.0, Lubricant(0.03), **film)
    assert by_map.eccentricity_ratio == pytest.approx(float(grid.eccentricity_ratio), rel=0.01)


@pytest.mark.parametrize(("ends", "function"), [("even", np.cos), ("odd", np.sin)])
def test_splines_are_of_fourth_order(ends, function):
    errors = []
    for n in (9, 17):
        knots = np.linspace(0.0, np.pi, n)
        c = spline(function(knots), 0, ends)
        middle = (c[:-3] + 23 * c[1:-2] + 23 * c[2:-1] + c[3:]) / 48
        errors.append(np.abs(middle - function(knots[:-1] + 0.5 * knots[1])).max())
    assert np.log2(errors[0] / errors[1]) > 3.8
