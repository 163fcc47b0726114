"""The rung "reduced": few unknowns across the width against the grid and against itself."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
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
from loadflow.journal.film.gap.mesh import build_mesh
from loadflow.journal.models import reduced
from loadflow.journal.models.width_modes import Axial, lobatto
from loadflow.validation.journal import PERIODIC_LOADS, reference_bearing, sines

BEARING, FILM = reference_bearing()
OMEGA = 12.1 * np.pi / 30
COARSE = FILM | {"grid": (36, 8)}
OIL = Lubricant(0.05)
FIELDS = "eccentricity_ratio attitude_angle maximum_pressure friction_power side_flow total_fill"


def both(time, force, speed, **film):
    return (BEARING.orbit(time, force, speed, rung=rung, **film) for rung in ("grid", "reduced"))


def load(time):
    return np.stack([2e6 + 5e5 * np.sin(1.5 * time), 4e5 * np.cos(4 * time)], axis=-1)


def cells(half_width, mesh):
    """The axial operator of the grid: cells of finite volume."""
    stiffness = np.diag(mesh.gz[1:]) + np.diag(np.append(0.0, mesh.gz[1:-1]))
    stiffness -= np.diag(mesh.gz[1:-1], 1) + np.diag(mesh.gz[1:-1], -1)
    first = np.eye(mesh.z.size)[0]
    width = float(mesh.dz.sum()), float(mesh.dz.max())
    return Axial(mesh.z, mesh.dz, stiffness, first, 0.0, *width)


@pytest.mark.parametrize("nodes", [1, 2, 3, 5])
def test_axial_operator_is_exact_for_its_polynomials(nodes):
    half = 0.7
    axial = lobatto(half, nodes)
    polynomial = np.polynomial.Polynomial([1, 0, -1]) * np.polynomial.Polynomial(
        [1.0, 0.0] + [0.3, 0.0] * (nodes - 1)
    )
    value, slope = polynomial, polynomial.deriv()
    q = value(axial.points / half)
    assert axial.weights @ q == pytest.approx(half * (value.integ()(1) - value.integ()(0)))
    square = (slope * slope).integ()
    assert q @ axial.stiffness @ q == pytest.approx((square(1) - square(0)) / half)
    at_end = axial.end_weight * slope.deriv()(1) / half**2  # what the end itself holds back
    assert (axial.stiffness @ q).sum() == pytest.approx(at_end - slope(1) / half)
    assert axial.middle @ q == pytest.approx(value(0))
    assert axial.weights.sum() + axial.end_weight == pytest.approx(half)
    np.testing.assert_array_equal(axial.stiffness, axial.stiffness.T)


def test_with_the_cells_of_the_grid_it_is_the_grid(monkeypatch):
    """Every line of the compiled loops but the polynomials, against the rung "grid".

    As many cells across the half width as there are points: of another count all would be compiled
    again.
    """
    film = FILM | {"grid": (36, 2 * reduced.POINTS)}
    mesh = build_mesh(0.75, film["grid"], False, False, None, 1.5)
    assert mesh.z.size == reduced.POINTS
    monkeypatch.setattr(reduced, "lobatto", lambda half_width, _: cells(half_width, mesh))
    time = np.linspace(0.0, 2.0, 41)
    grid, few = both(time, load(time), OMEGA, tolerance=1e-11, **film)
    for name in (*FIELDS.split(), "minimum_film", "eccentricity"):
        np.testing.assert_allclose(few[name], grid[name], rtol=1e-7, err_msg=name)
    static = [
        BEARING.equilibrium(load(time[::10]), OMEGA, rung=rung, **film)
        for rung in ("grid", "reduced")
    ]
    for name in (*FIELDS.split(), "sommerfeld_number", "reynolds_number", "laminar"):
        one, other = (getattr(state, name) for state in static)
        np.testing.assert_allclose(other, one, rtol=1e-8, err_msg=name)
    for name in ("stiffness", "damping"):
        one, other = (getattr(state, name) for state in static)
        np.testing.assert_allclose(other, one, atol=1e-6 * np.abs(one).max(), err_msg=name)


@pytest.mark.parametrize(("so", "width"), [(0.5, 2.25), (2.0, 2.25), (6.0, 2.25), (2.0, 4.5)])
def test_it_is_the_limit_of_fine_cells_across(so, width):
    """Errors of 80 cells of second order across are below 0.03 % themselves."""
    bearing = JournalBearing(diameter=3.0, width=width, relative_clearance=0.5e-3)
    force = (so / bearing.sommerfeld_number(1.0, OMEGA, 0.05), 0.0)
    fine = bearing.equilibrium(force, OMEGA, **FILM | {"grid": (60, 80)})
    few = bearing.equilibrium(force, OMEGA, rung="reduced", **FILM)
    assert few.eccentricity_ratio == pytest.approx(fine.eccentricity_ratio, rel=5e-4)
    assert few.attitude_angle == pytest.approx(fine.attitude_angle, abs=5e-4)
    assert few.maximum_pressure == pytest.approx(fine.maximum_pressure, rel=5e-3)
    assert few.friction_power == pytest.approx(fine.friction_power, rel=1e-3)
    assert few.side_flow == pytest.approx(fine.side_flow, rel=2e-3)


@pytest.mark.parametrize("seed", [0, 2])
def test_largest_eccentricity_of_a_turbine_load(seed):
    time = np.arange(0.0, 12.0, 0.05)
    force = np.stack([sines(x, time) for x in PERIODIC_LOADS[seed][:2]], axis=-1)
    grid, few = both(time, force, OMEGA, **FILM)
    largest = float(grid.eccentricity_ratio.max())
    assert float(few.eccentricity_ratio.max()) == pytest.approx(largest, rel=5e-3)
    np.testing.assert_allclose(few.eccentricity_ratio, grid.eccentricity_ratio, rtol=5e-3)
    np.testing.assert_allclose(few.maximum_pressure, grid.maximum_pressure, rtol=1e-2)
    assert float(few.residual.max()) < 1e-8


def test_constant_load_stays_at_the_static_equilibrium():
    time = np.arange(6) * 0.1
    orbit = BEARING.orbit(time, np.tile([2e6, 1e5], (6, 1)), OMEGA, rung="reduced", **COARSE)
    static = BEARING.equilibrium((2e6, 1e5), OMEGA, rung="reduced", **COARSE)
    # both are solved to a residual of 1e-8 and 1e-10
    expected = np.tile(static.eccentricity, (6, 1))
    np.testing.assert_allclose(orbit.eccentricity, expected, atol=1e-7 * BEARING.clearance)


def test_second_order_in_time():
    ends = []
    for n in (20, 40, 80):
        time = np.linspace(0.0, 1.0, n + 1)
        force = np.array([2e6, 2e5]) + np.outer(time**3, [6e5, -4e5])  # leaves with zero slope
        orbit = BEARING.orbit(time, force, OMEGA, rung="reduced", tolerance=1e-11, **COARSE)
        ends.append(orbit.eccentricity.values[-1])
    coarse, fine = np.linalg.norm(np.diff(ends, axis=0), axis=1)
    assert np.log2(coarse / fine) > 1.6


def _jump():
    force = np.tile([1e6, 0.0], (8, 1))
    force[4:] = [-2e7, 1.5e7]
    return np.arange(8) * 0.5, force, 1.2


def _reversal():
    time = np.linspace(0.0, 3.0, 31)
    return time, np.stack([2e6 * np.sign(np.sin(5 * time) + 1e-9), 0 * time], axis=-1), 1.2


def _run_down():
    time = np.linspace(0.0, 16.0, 161)
    return time, np.tile([1.5e6, 0.0], (161, 1)), 1.2 * np.clip(1 - time / 8, 0, None)


def _rotating_load():
    time = np.linspace(0.0, 10.0, 51)
    return time, 2e6 * np.stack([np.cos(0.6 * time), np.sin(0.6 * time)], axis=-1), 1.2


def _oscillating_speed():
    time = np.linspace(0.0, 10.0, 51)
    return time, np.tile([2e6, 1e5], (51, 1)), 1.2 * np.cos(0.5 * time)


def _heavy():
    time = np.linspace(0.0, 12.0, 61)
    return time, np.stack([2e6 + 8e7 * np.clip(time / 10, 0, 1), 0 * time], axis=-1), 1.2


@pytest.mark.parametrize(
    "history", [_jump, _reversal, _run_down, _rotating_load, _oscillating_speed, _heavy]
)
def test_hard_histories_agree_with_the_grid(history):
    """With the cells across that uniform cells need, 0.3 % of the clearance is the grid's own."""
    time, force, speed = history()
    grid, few = both(time, force, speed, **FILM | {"grid": (36, 20)})
    np.testing.assert_allclose(few.eccentricity_ratio, grid.eccentricity_ratio, atol=3e-3)
    assert float(few.residual.max()) < 1e-8
    assert float(few.minimum_film.min()) > 0


def test_from_the_edge_of_contact():
    time = np.linspace(0.0, 1.0, 11)
    start = np.array([0.99, 0.0]) * BEARING.clearance
    force = np.tile([2e6, 1e5], (11, 1))
    grid, few = both(time, force, 1.2, start=start, **FILM)
    assert float(few.eccentricity_ratio[0]) == pytest.approx(0.99)
    np.testing.assert_allclose(few.eccentricity_ratio, grid.eccentricity_ratio, atol=2e-3)


@pytest.mark.parametrize(
    "law",
    [GasMixture(1e3), GasMixture(1.0), MassConserving(), Sommerfeld(), Guembel(), Reynolds()],
    ids=str,
)
def test_every_law(law):
    time = np.linspace(0.0, 2.0, 21)
    film = {"lubricant": OIL, "cavitation": law, "edge_pressure": 1e5, "grid": (36, 20)}
    grid, few = both(time, load(time), OMEGA, inlet=None, grading="uniform", **film)
    np.testing.assert_allclose(few.eccentricity_ratio, grid.eccentricity_ratio, rtol=5e-3)
    np.testing.assert_allclose(few.friction_power, grid.friction_power, rtol=3e-3)


def test_shaft_without_load_stays_in_the_middle():
    time = np.linspace(0.0, 1.0, 5)
    orbit = BEARING.orbit(time, np.zeros((5, 2)), OMEGA, rung="reduced", **COARSE)
    np.testing.assert_allclose(orbit.eccentricity, 0.0, atol=1e-15)
    rest = BEARING.equilibrium((0.0, 0.0), 0.0, rung="reduced", **COARSE)
    np.testing.assert_array_equal(rest.eccentricity, 0.0)


def test_stiffness_is_the_slope_of_the_load():
    force, step = np.array([2e6, 3e5]), 20.0
    state = BEARING.equilibrium(force, OMEGA, rung="reduced", tolerance=1e-12, **COARSE)
    moved = BEARING.equilibrium(
        force + step * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]]),
        OMEGA,
        rung="reduced",
        tolerance=1e-12,
        **COARSE,
    ).eccentricity
    compliance = np.stack([moved[0] - moved[1], moved[2] - moved[3]], axis=-1) / (2 * step)
    np.testing.assert_allclose(state.stiffness @ compliance, np.eye(2), atol=1e-5)


@settings(max_examples=25, deadline=None)
@given(
    so=st.floats(0.01, 20.0),
    direction=st.floats(-3.1, 3.1),
    speed=st.floats(0.01, 90.0),
)
def test_turning_backwards_is_a_mirror(so, direction, speed):
    size = so / BEARING.sommerfeld_number(1.0, speed, 0.05)
    force = size * np.array([np.cos(direction), np.sin(direction)])
    options = FILM | {"rung": "reduced"}
    forward = BEARING.equilibrium(force, speed, **options)
    mirror = np.array([1.0, -1.0])
    back = BEARING.equilibrium(force * mirror, -speed, **options)
    size = BEARING.clearance * (1 - forward.eccentricity_ratio)
    np.testing.assert_allclose(back.eccentricity * mirror, forward.eccentricity, atol=1e-6 * size)
    assert forward.residual < 1e-10


def test_a_load_that_fails_is_solved_on_the_grid():
    options = {"max_iterations": 1, **COARSE}
    few = BEARING.equilibrium([(2e6, 0.0), (0.0, 0.0)], OMEGA, rung="reduced", **options)
    grid = BEARING.equilibrium((2e6, 0.0), OMEGA, **COARSE)
    assert few.eccentricity_ratio[0] == grid.eccentricity_ratio
    assert few.iterations[0] > grid.iterations  # those of the way tried first count, too
    assert np.all(few.converged)


def test_what_no_film_carries_is_flagged_or_named():
    forces = np.array([(2e6, 0.0), (1e6, 0.0)])
    speeds = np.array([OMEGA, 0.0])
    state = BEARING.equilibrium(forces, speeds, rung="reduced", strict=False, **COARSE)
    assert state.converged.tolist() == [True, False]
    assert np.isnan(state.eccentricity_ratio[1])
    with pytest.raises(SolverError, match=r"load 1: F = \(1e\+06, 0\) N at ω = 0"):
        BEARING.equilibrium(forces, speeds, rung="reduced", **COARSE)


SPOT = Groove(1.57, length=0.1, pressure=6e5, shape="circle")


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"supply": Supply([SPOT])}, InputError, r"supply\.grooves\[0\]"),
        ({"inlet": "widest gap"}, InputError, "inlet = 'widest gap'"),
        ({"cavitation": Reynolds()}, InputError, "inlet = 'auto'"),
        ({"grading": "graded"}, InputError, "grading = 'graded'"),
        ({"rung": "finest"}, InputError, "rung = 'finest'"),
    ],
)
def test_what_it_cannot_do_is_named(options, error, message):
    with pytest.raises(error, match=message):
        BEARING.equilibrium((2e6, 0.0), OMEGA, **COARSE | {"rung": "reduced"} | options)


@pytest.mark.parametrize(
    ("speed", "options", "message"),
    [
        (0.0, {}, r"orbit cannot start: F = \(2e\+06, 0\) N at ω = 0"),
        (1.0, {"max_iterations": 1, "start": (0.0, 0.0)}, r"orbit stops at t = 0\.1 s"),
    ],
)
def test_an_orbit_without_an_answer_is_named(speed, options, message):
    with pytest.raises(SolverError, match=message):
        BEARING.orbit(
            [0.0, 0.1],
            np.tile([2e6, 0.0], (2, 1)),
            speed,
            rung="reduced",
            **COARSE | options,
        )
