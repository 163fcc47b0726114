"""Static equilibrium of the gas-mixture film on the grid of the source."""

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import GasMixture, JournalBearing, Lubricant

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
FILM = {
    "lubricant": Lubricant(0.05),
    "cavitation": GasMixture(0.05e6),
    "edge_pressure": 0.5e6,
    "grid": (60, 20),
}
LOAD, OMEGA = np.array([2.0e6, 0.3e6]), 1.2


def test_film_carries_the_load():
    state = BEARING.equilibrium(LOAD, OMEGA, **FILM)
    film = BEARING.pressure(state.eccentricity, OMEGA, **FILM)
    np.testing.assert_allclose(film.force, LOAD, rtol=1e-8)
    np.testing.assert_allclose(film.film_force, -LOAD, rtol=1e-8)
    assert state.converged
    assert state.residual < 1e-10


def test_film_force_is_the_integral_of_the_pressure():
    film = BEARING.pressure((0.3e-3, 0.2e-3), OMEGA, **FILM)
    area = (2 * np.pi / 60) * 1.5 * (2.25 / 20)
    around = film.pressure.sum(axis=1) * area
    force = np.array([around @ np.cos(film.angle), around @ np.sin(film.angle)])
    np.testing.assert_allclose(film.force, force, rtol=1e-12)


def test_stiffness_and_damping_are_the_slopes_of_the_film_force():
    state = BEARING.equilibrium(LOAD, OMEGA, **FILM)
    step = 1e-5 * BEARING.clearance
    for matrix, name in ((state.stiffness, "eccentricity"), (state.damping, "velocity")):
        slopes = np.empty((2, 2))
        for j in range(2):
            shift = step * np.eye(2)[j]
            forces = []
            for sign in (1, -1):
                point = {"eccentricity": state.eccentricity, "velocity": np.zeros(2)}
                point[name] = point[name] + sign * shift
                forces.append(BEARING.pressure(speed=OMEGA, **point, **FILM).film_force)
            slopes[:, j] = -(forces[0] - forces[1]) / (2 * step)
        np.testing.assert_allclose(matrix, slopes, rtol=1e-5)


def test_turning_backwards_mirrors_everything():
    forward = BEARING.equilibrium(LOAD, OMEGA, **FILM)
    backward = BEARING.equilibrium(LOAD * [1, -1], -OMEGA, **FILM)
    np.testing.assert_allclose(backward.eccentricity, forward.eccentricity * [1, -1], rtol=1e-8)
    assert backward.attitude_angle == pytest.approx(forward.attitude_angle)
    assert forward.attitude_angle > 0
    mirror = np.outer([1, -1], [1, -1])
    np.testing.assert_allclose(backward.stiffness, forward.stiffness * mirror, rtol=1e-6)


def test_rows_do_not_depend_on_their_order():
    rng = np.random.default_rng(3)
    forces = LOAD + 4e5 * rng.standard_normal((20, 2))
    speeds = rng.uniform(0.4, 1.3, 20)
    together = BEARING.equilibrium(forces, speeds, **FILM)
    back = BEARING.equilibrium(forces[::-1], speeds[::-1], **FILM)
    np.testing.assert_allclose(
        back.eccentricity_ratio[::-1], together.eccentricity_ratio, atol=1e-10
    )
    alone = BEARING.equilibrium(forces[7], speeds[7], **FILM)
    assert alone.eccentricity_ratio == pytest.approx(together.eccentricity_ratio[7], abs=1e-10)


def test_shapes_follow_the_input():
    forces = np.broadcast_to(LOAD, (3, 1, 2))
    state = BEARING.equilibrium(forces, [1.0, 1.2], **FILM)
    assert state.eccentricity_ratio.shape == (3, 2)
    assert state.stiffness.shape == (3, 2, 2, 2)
    assert np.ndim(BEARING.equilibrium(LOAD, OMEGA, **FILM).minimum_film) == 0


def test_without_load_the_shaft_is_centred():
    state = BEARING.equilibrium((0.0, 0.0), OMEGA, **FILM)
    assert state.eccentricity_ratio < 1e-12
    assert state.attitude_angle == pytest.approx(np.pi / 2)
    assert state.maximum_pressure == pytest.approx(0.5e6)
    assert BEARING.equilibrium((0.0, 0.0), 0.0, **FILM).friction_power == 0.0


def test_a_load_at_rest_is_refused_with_its_numbers():
    with pytest.raises(SolverError, match=r"load 1: F = \(2e\+06, 300000\) N at ω = 0"):
        BEARING.equilibrium(LOAD, [1.0, 0.0], **FILM)
    state = BEARING.equilibrium(LOAD, [1.0, 0.0], strict=False, **FILM)
    assert state.converged.tolist() == [True, False]
    assert np.isnan(state.eccentricity_ratio[1])
    assert np.isnan(state.stiffness[1]).all()


@pytest.mark.parametrize("share", [0.0005, 0.01, 0.1, 1.0, 5.0, 20.0])
def test_newton_converges_from_light_to_very_heavy_loads(share):
    state = BEARING.equilibrium(LOAD * share, OMEGA, **FILM)
    assert state.converged
    assert 0 < state.eccentricity_ratio < 1
    assert state.iterations <= 25


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: Lubricant(-0.05), r"viscosity = -0.05 .* > 0"),
        (lambda: GasMixture(0.0), r"mixing_constant = 0.0"),
        (lambda: JournalBearing(3.0, -1.0, 1e-3), r"width = -1.0"),
        (lambda: BEARING.equilibrium((1.0, np.nan), 1.0, **FILM), r"force\[1\] = nan"),
        (lambda: BEARING.equilibrium(np.empty((0, 2)), 1.0, **FILM), "force is empty"),
        (lambda: BEARING.equilibrium((1.0, 2.0, 3.0), 1.0, **FILM), r"shape \(3,\)"),
        (lambda: BEARING.equilibrium(LOAD, 1.0, **FILM | {"grid": (60, 7)}), r"grid\[1\] = 7"),
        (lambda: BEARING.equilibrium(LOAD, 1.0, **FILM | {"edge_pressure": 0.0}), "no oil"),
        (lambda: BEARING.pressure((0.8e-3, 0.0), 1.0, **FILM), r"ε = 1.06667 is not allowed"),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call()


def test_reynolds_number_against_the_critical_one():
    fast = BEARING.equilibrium(
        LOAD, [1.2, 300.0], **FILM | {"lubricant": Lubricant(0.05, density=870)}
    )
    np.testing.assert_allclose(
        fast.reynolds_number, 870 * np.array([1.2, 300]) * 1.5 * 0.75e-3 / 0.05
    )
    assert fast.laminar.tolist() == [True, False]


@pytest.mark.parametrize("speed", [1e-2, 5e-3, 1e-3, 1e-4])
def test_a_mixture_film_is_resolved_down_to_a_crawl(speed):
    """ω → 0 under load: ε → 1, where the source's 60 × 20 cells no longer resolve the gap."""
    state = BEARING.equilibrium(
        (1.47e6, -1.1e5),
        speed,
        Lubricant(0.05),
        cavitation=GasMixture(0.05e6),
        edge_pressure=0.5e6,
        grid=(60, 20),
    )
    assert state.converged
    assert state.residual < 1e-10
    assert 0.99 < state.eccentricity_ratio < 1.0
