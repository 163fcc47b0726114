"""The factors give the coherence of the standard: no random number is involved here."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.wind import CoherenceFactors, PointGrid, PolarGrid, iec, polar_angles
from loadflow.wind.coherence import NEGLIGIBLE, ExactFactors
from loadflow.wind.spectra import coherence, coherence_decay, kaimal_spectrum

POLAR = PolarGrid(np.array([0.0, 8.0, 20.0, 41.0, 63.0]), polar_angles(12))


def point_covariance(grid, apply):
    """Covariance of all points at one frequency when `apply` makes blocks coherent in place."""
    size = grid.blocks * grid.order
    unit = np.zeros((grid.blocks, grid.order, size), np.complex64)
    unit[np.arange(size) // grid.order, np.arange(size) % grid.order, np.arange(size)] = 1
    apply(unit)
    response = grid.to_points(unit).reshape(-1, size)
    return response @ response.conj().T


@settings(max_examples=25, deadline=None)
@given(
    st.lists(st.floats(0.5, 20), min_size=1, max_size=6),
    st.integers(3, 17),
    st.floats(0.004, 5),
)
def test_polar_factors_give_the_coherence_of_any_two_points(gaps, count, kappa):
    grid = PolarGrid(np.concatenate([[0.0], np.cumsum(gaps)]), polar_angles(count))
    exact = ExactFactors(grid, 42.0)
    got = point_covariance(grid, lambda x: exact.correlate(x, np.full(x.shape[-1], kappa)))
    points = grid.points.T.ravel()  # `to_points` has the angle first
    expected = np.exp(-kappa * abs(points[:, None] - points))
    np.testing.assert_allclose(got, expected, atol=2e-6)


def test_point_grid_agrees_with_the_polar_grid():
    inner = POLAR.points[1:].ravel()
    points = PointGrid(np.append(inner.real, 0.0), np.append(inner.imag, 0.0))
    kappa = np.array([0.02])
    lower = points.factors(kappa)[0, 0]
    polar = ExactFactors(POLAR, 42.0)
    covariance = point_covariance(POLAR, lambda x: polar.correlate(x, np.full(x.shape[-1], 0.02)))
    ring = covariance.reshape(12, 5, 12, 5)[0, 1:, 0, 1:].real
    first = np.arange(4) * 12  # angle 0 of each ring
    np.testing.assert_allclose((lower @ lower.T)[np.ix_(first, first)], ring, atol=2e-6)


@pytest.mark.parametrize(
    "grid", [POLAR, PointGrid(np.tile([0.0, 9.0, 18.0], 2), np.repeat([0.0, 7.0], 3))]
)
def test_interpolation_error_falls_with_the_square_of_the_knots(grid):
    kappa = np.geomspace(0.0043, -np.log(NEGLIGIBLE) / grid.spacing, 40)[:-1]

    def error(knots):
        fast, exact = CoherenceFactors(grid, 42.0, knots), ExactFactors(grid, 42.0)
        worst = 0.0
        for k in kappa:
            here = lambda x: np.full(x.shape[-1], k)  # noqa: B023, E731
            got = point_covariance(grid, lambda x: fast.correlate(x, here(x)))  # noqa: B023
            want = point_covariance(grid, lambda x: exact.correlate(x, here(x)))  # noqa: B023
            worst = max(worst, abs(got - want).max())
        return worst

    coarse, fine = error(24), error(96)
    assert fine < 1e-3
    assert 8 < coarse / fine < 30  # 16 for second order


def test_far_above_the_cutoff_points_are_independent():
    fast = CoherenceFactors(POLAR, 42.0)
    covariance = point_covariance(POLAR, lambda x: fast.correlate(x, np.full(x.shape[-1], 9.0)))
    hub = np.arange(12) * 5
    expected = np.eye(60)
    expected[np.ix_(hub, hub)] = 1  # the hub is one point
    np.testing.assert_allclose(covariance, expected, atol=1e-6)


def test_one_set_of_factors_serves_all_wind_speeds():
    # the decay at zero frequency, where the table starts, does not depend on speed
    factors = CoherenceFactors(POLAR, 42.0)
    for speed in (4.0, 25.0):
        assert coherence_decay(0.0, speed, 42.0) == pytest.approx(factors.decay[0], rel=1e-12)


def test_coherence_of_the_standard():
    # IEC at 15 m/s, 0.02 Hz, 7 and 35 m: between 0.01 and 0.03 Hz it is 0.891 and 0.565
    r = np.array([7.0, 35.0])
    np.testing.assert_allclose(coherence(0.02, r, 15.0, 42.0), [0.891, 0.562], atol=0.003)


def test_kaimal_spectrum_holds_the_variance_and_the_inertial_range():
    f = np.geomspace(1e-7, 1e5, 200001)
    for k, share in enumerate(iec.COMPONENT_SIGMA):
        density = kaimal_spectrum(f, 12.0, 2.0, 42.0, k)
        variance = np.trapezoid(density * f, np.log(f))
        assert variance == pytest.approx((share * 2.0) ** 2, rel=2e-3)
    high = [float(kaimal_spectrum(50.0, 12.0, 2.0, 42.0, k)) for k in range(3)]
    assert high[0] == pytest.approx(0.05 * 4 * (42 / 12) ** (-2 / 3) * 50 ** (-5 / 3), rel=0.01)
    np.testing.assert_allclose(np.array(high[1:]) / high[0], 4 / 3, rtol=0.02)


def test_coinciding_points_are_refused():
    with pytest.raises(InputError, match="coincide"):
        PointGrid(np.array([0.0, 0.0]), np.array([1.0, 1.0]))
