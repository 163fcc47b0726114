"""Flow and friction factors of Patir and Cheng: printed numbers, limits, derivatives, refusals."""

import warnings

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from loadflow.errors import InputError, ValidityWarning
from loadflow.tribology import kernels, mean_gap, patir_cheng

GAMMAS = (1 / 9, 1 / 6, 1 / 3, 1.0, 3.0, 6.0, 9.0)
FACTORS = (
    "pressure_x", "pressure_z", "shear", "friction", "friction_shear", "friction_pressure",
)  # fmt: skip


@pytest.mark.parametrize(
    ("gamma", "c", "r"),
    [
        (1 / 9, 1.48, 0.42),
        (1 / 6, 1.38, 0.42),
        (1 / 3, 1.18, 0.42),
        (1.0, 0.90, 0.56),
        (3.0, 0.225, 1.5),
        (6.0, 0.520, 1.5),
        (9.0, 0.870, 1.5),
    ],
)
def test_pressure_factors_are_the_printed_ones(gamma, c, r):
    h = np.linspace(1.01, 9, 30)
    printed = 1 - c * np.exp(-r * h) if gamma <= 1 else 1 + c * h**-r
    assert patir_cheng(h, gamma).pressure_x == pytest.approx(printed, rel=1e-14)
    assert patir_cheng(h, 1 / gamma).pressure_z == pytest.approx(printed, rel=1e-14)


def test_shear_factors_are_the_printed_ones():
    found = patir_cheng([2.0, 6.0], 1.0)
    assert found.shear == pytest.approx(
        [1.899 * 2**0.98 * np.exp(-1.84 + 0.2), 1.126 * np.exp(-1.5)], rel=1e-14
    )
    assert found.friction_shear == pytest.approx(
        [11.1 * 2**2.31 * np.exp(-4.76 + 0.44), 11.1 * 6**2.31 * np.exp(-14.28 + 3.96)], rel=1e-14
    )
    assert patir_cheng(1.0, 1 / 9).friction_shear == pytest.approx(14.1 * np.exp(-2.2), rel=1e-14)
    assert patir_cheng(1.0, 9.0).friction_shear == pytest.approx(8.7 * np.exp(-2.79), rel=1e-14)
    assert patir_cheng(2.0, 1.0).friction_pressure == pytest.approx(1 - 1.4 * np.exp(-1.32))


def test_both_laws_of_the_shear_factor_meet_at_5():
    middle = (0.5318, 0.5027, 0.4471, 0.3226, 0.1592, 0.1111, 0.0846)
    for gamma, expected in zip(GAMMAS, middle):
        below, above = patir_cheng([5.0, 5.0 + 1e-12], gamma).shear
        assert abs(below - above) < 2e-4
        assert below == pytest.approx(expected, abs=6e-5)


def test_the_shear_stress_of_a_sliding_surface_ends_at_7_with_the_printed_jump():
    jumps = [float(patir_cheng(7 - 1e-9, gamma).friction_shear) for gamma in GAMMAS]
    assert min(jumps) == pytest.approx(0.004, abs=5e-4)
    assert max(jumps) == pytest.approx(0.023, abs=5e-4)
    assert (patir_cheng([7.0, 8.0, 100.0], 1.0).friction_shear == 0).all()


@pytest.mark.parametrize(
    ("h", "expected"),
    [(0.5, 0.907002), (1, 1.636589), (3, 1.166667), (6, 1.029878), (10, 1.010254)],
)
def test_friction_factor_has_the_exact_values(h, expected):
    assert patir_cheng(h, 1.0).friction == pytest.approx(expected, abs=5e-7)


@pytest.mark.parametrize("h", [3.5, 5.9, 6.1, 12.0, 80.0])
def test_friction_factor_is_the_mean_of_the_inverse_gap(h):
    z = h / 3
    mean = quad(lambda t: 35 / 32 * (1 - t * t) ** 3 * z / (z + t), -1, 1, epsabs=1e-13)[0]
    assert patir_cheng(h).friction == pytest.approx(mean, rel=1e-12)


@pytest.mark.parametrize("h", [-2.0, -0.5, 0.0, 1.0, 2.9])
def test_inverse_gap_of_touching_surfaces_by_quadrature(h):
    cut, z = 1 / 300, h / 3
    mean = quad(lambda t: 35 / 96 * (1 - t * t) ** 3 / (z + t), cut - z, 1, epsabs=1e-13)[0]
    # the closed form leaves out what the cut-off does to the polynomial, of first order in it
    assert kernels.inverse_gap(h)[0] == pytest.approx(mean, abs=3 * cut)


def test_smooth_surfaces_are_the_limit():
    for h in (1e4, 1e9, np.inf):
        found = patir_cheng(h, 1 / 9)
        for name in FACTORS:
            expected = 0.0 if "shear" in name else 1.0
            assert getattr(found, name) == pytest.approx(expected, abs=1e-6)
            assert abs(getattr(found.slope, name)) < 1e-6


@given(st.floats(0.5, 12), st.floats(1 / 9, 9), st.floats(1.0, 3.0))
def test_factors_rise_or_fall_with_the_pattern(h, gamma, more):
    first, second = patir_cheng(h, gamma), patir_cheng(h, min(gamma * more, 9.0))
    assert second.pressure_x >= first.pressure_x - 1e-14
    assert second.pressure_z <= first.pressure_z + 1e-14
    assert second.shear <= first.shear + 2e-4  # the step of the printed laws at H = 5


@given(st.floats(0, 20), st.floats(1 / 9, 9))
def test_the_conductance_stays_positive(h, gamma):
    found = patir_cheng(h, gamma)
    assert found.pressure_x > 0.02
    assert found.pressure_z > 0.02


def test_between_two_rows_the_factors_lie_between():
    h = np.linspace(0.1, 10, 40)
    low, high, middle = (patir_cheng(h, g) for g in (3.0, 6.0, np.sqrt(18.0)))
    for name in FACTORS:
        mean = (getattr(low, name) + getattr(high, name)) / 2
        assert getattr(middle, name) == pytest.approx(mean, rel=1e-12)


@pytest.mark.parametrize("smooth", [False, True])
def test_slopes_are_the_derivatives(smooth):
    h, step = np.linspace(0.06, 30, 601) + 0.0037, 4e-6
    for gamma in (1 / 9, 0.2, 1.0, 1.7, 9.0):
        below, here, above = (patir_cheng(h + d, gamma, smooth=smooth) for d in (-step, 0, step))
        for name in FACTORS:
            # differences of values good to 1e-14 over 8e-6
            difference = (getattr(above, name) - getattr(below, name)) / (2 * step)
            assert getattr(here.slope, name) == pytest.approx(difference, abs=3e-9), name


def test_the_smooth_form_has_no_jump_and_differs_little():
    h = np.linspace(4, 8, 40001)
    for gamma in GAMMAS:
        printed, smooth = patir_cheng(h, gamma), patir_cheng(h, gamma, smooth=True)
        for name in ("shear", "friction_shear"):
            steps = np.abs(np.diff(getattr(smooth, name)))
            assert steps.max() < 1e-4 * np.abs(getattr(smooth.slope, name)).max() * 1.01
            # also the slope is continuous
            bends = np.abs(np.diff(getattr(smooth.slope, name)))
            assert bends.max() < 1e-4
        assert np.abs(smooth.shear - printed.shear).max() < 3e-3
        outside = (h < 6) | (h >= 7)
        assert (smooth.friction_shear[outside] == printed.friction_shear[outside]).all()
        assert (smooth.friction_shear <= printed.friction_shear).all()


def test_broadcasting_gives_the_numbers_of_single_calls():
    h, gamma = np.array([[0.3], [2.0], [6.5]]), np.array([0.2, 1.0, 4.0, 9.0])
    together = patir_cheng(h, gamma)
    for i, j in np.ndindex(3, 4):
        alone = patir_cheng(h[i, 0], gamma[j])
        for name in FACTORS:
            assert getattr(together, name)[i, j] == getattr(alone, name)
            assert getattr(together.slope, name)[i, j] == getattr(alone.slope, name)
    assert patir_cheng(2.0).pressure_x.shape == ()


def test_patterns_beyond_the_table_take_its_end_and_say_so():
    with pytest.warns(ValidityWarning, match="12"):
        beyond = patir_cheng(3.0, 12.0)
    assert beyond.pressure_x == patir_cheng(3.0, 9.0).pressure_x
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        patir_cheng(3.0, [1 / 9, 9.0])


@pytest.mark.parametrize(
    ("h", "gamma", "key"),
    [
        (-0.1, 1.0, "film_parameter"),
        (np.nan, 1.0, "film_parameter"),
        (1.0, 0.0, "pattern"),
        (1.0, -3.0, "pattern"),
        (1.0, np.inf, "pattern"),
        (1.0, np.nan, "pattern"),
    ],
)
def test_impossible_input_is_refused(h, gamma, key):
    with pytest.raises(InputError, match=key):
        patir_cheng([1.0, h], gamma)


def test_kernels_are_finite_where_mean_planes_overlap():
    rows = kernels.flow_rows(2.0)
    for h in (-50.0, -3.0, -2.999, -1.0, 0.0):
        for kernel in (
            kernels.pressure_factor,
            kernels.shear_factor,
            kernels.friction_shear_factor,
            kernels.friction_pressure_factor,
        ):
            value, slope = kernel(h, rows)
            assert np.isfinite(value)
            assert slope == 0.0
        assert np.isfinite(kernels.inverse_gap(h)).all()
        assert kernels.inverse_gap(h)[0] >= 0
        assert kernels.mean_gap(h)[0] >= 0


def test_mean_gap_by_quadrature_and_its_slope():
    for h in (-6.0, -1.0, 0.0, 2.0, 7.0):
        mean = quad(
            lambda s, h=h: max(h + s, 0.0) * np.exp(-s * s / 2) / np.sqrt(2 * np.pi),
            -12, 12, points=[-h], epsabs=1e-13,
        )[0]  # fmt: skip
        gap, factor = mean_gap(h)
        assert gap == pytest.approx(mean, rel=1e-7, abs=1e-13)
        step = 1e-5
        slope = (mean_gap(h + step)[0] - mean_gap(h - step)[0]) / (2 * step)
        assert factor == pytest.approx(slope, rel=1e-6, abs=1e-11)


def test_kernels_serve_in_compiled_loops():
    @numba.njit
    def total(h, gamma):
        rows = kernels.flow_rows(gamma)
        found = 0.0
        for at in h:
            found += kernels.pressure_factor(at, rows)[0] + kernels.shear_factor(at, rows, True)[1]
        return found

    h = np.linspace(0.2, 8, 50)
    found = patir_cheng(h, 2.5, smooth=True)
    expected = (found.pressure_x + found.slope.shear).sum()
    assert total(h, 2.5) == pytest.approx(expected, rel=1e-13)
