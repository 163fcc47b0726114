"""The formulas of IEC 61400-1: oracle values, laws between them, and refusal of nonsense."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.validation import all_checks
from loadflow.wind import iec

GEOMETRY = (126.0, 90.0)
speeds = st.floats(0, 35)
classes = st.sampled_from(["I", "II", "III", "T"])
categories = st.sampled_from(["A+", "A", "B", "C"])
diameters = st.floats(20, 300)
heights = st.floats(20, 200)


@pytest.mark.parametrize("check", list(all_checks("wind")), ids=lambda c: c.name)
def test_oracle_values(check):
    assert check.ok, f"{check.name}: expected {check.expected}, got {check.got}"


def test_arrays_give_what_numbers_give():
    v = np.array([[3.0, 8.0], [12.0, 25.0]])
    for f in (
        lambda v: iec.ntm_sigma(v, "B"),
        lambda v: iec.etm_sigma(v, "II", "B"),
        lambda v: iec.eog_amplitude(v, "II", "B", *GEOMETRY),
        lambda v: iec.edc_angle(v, "B", *GEOMETRY),
        lambda v: iec.ecd_angle(v, "II"),
        lambda v: iec.ews_amplitude(v, "B", *GEOMETRY),
        lambda v: iec.bin_probability(v, 8.5),
        lambda v: iec.ntm_sigma_quantile(0.5, v, "B"),
    ):
        expected = [[f(x) for x in row] for row in v]
        assert f(v).shape == v.shape
        np.testing.assert_array_equal(f(v), expected)
        assert np.ndim(f(7.0)) == 0


@given(speeds, speeds, categories, diameters, heights)
def test_stronger_wind_turns_less_but_shears_and_fluctuates_more(a, b, category, d, z):
    low, high = sorted((a, b))
    assert iec.ntm_sigma(high, category) >= iec.ntm_sigma(low, category)
    assert iec.ews_amplitude(high, category, d, z) >= iec.ews_amplitude(low, category, d, z)
    assert iec.edc_angle(high, category, d, z) <= iec.edc_angle(low, category, d, z)
    assert iec.ecd_angle(high, "III") <= iec.ecd_angle(low, "III")


@given(speeds, classes, diameters, heights)
def test_everything_scales_with_the_reference_intensity(v, name, d, z):
    ratio = 0.18 / 0.12
    assert iec.ntm_sigma(v, "A+") == pytest.approx(ratio * iec.ntm_sigma(v, "C"))
    assert iec.etm_sigma(v, name, "A+") == pytest.approx(ratio * iec.etm_sigma(v, name, "C"))
    bracket = iec.ews_amplitude(v, "A+", d, z) - 2.5
    assert bracket == pytest.approx(ratio * (iec.ews_amplitude(v, "C", d, z) - 2.5))


@given(speeds, classes, categories, diameters, heights)
def test_operating_gust_is_bounded_by_the_yearly_extreme(v, name, category, d, z):
    gust = iec.eog_amplitude(v, name, category, d, z)
    extreme = iec.ewm_speed(z, name, z, return_period=1)
    assert 0 <= gust <= 1.35 * (extreme - v) + 1e-12
    assert gust <= 3.3 * iec.ntm_sigma(v, category)


def test_operating_gust_near_the_yearly_extreme_takes_the_first_branch():
    # class III: V_e1 = 0.8 * 1.4 * 37.5 = 42 m/s, 2 m/s above; the factor is 1.35, not 1.5
    assert iec.eog_amplitude(40.0, "III", "A", *GEOMETRY) == pytest.approx(2.7)


def test_direction_change_in_calm_air_is_half_a_turn():
    assert iec.edc_angle(0.0, "A", *GEOMETRY) == pytest.approx(np.pi)
    assert iec.ecd_angle([0.0, 3.9, 4.0], "I") == pytest.approx([np.pi] * 3)


@given(heights)
def test_length_scale_is_continuous_and_capped(z):
    assert iec.length_scale(z) == pytest.approx(min(0.7 * z, 42.0))


def test_extreme_speeds():
    z = np.array([45.0, 90.0])
    steady = iec.ewm_speed(z, "II", 90.0)
    assert steady == pytest.approx([1.4 * 42.5 * 0.5**0.11, 59.5])
    assert iec.ewm_speed(z, "II", 90.0, return_period=1) == pytest.approx(0.8 * steady)
    assert iec.ewm_speed(90.0, "II", 90.0, steady=False) == pytest.approx(42.5)
    assert iec.ewm_speed(90.0, "T", 90.0, steady=False) == pytest.approx(57.0)
    assert iec.ewm_sigma(50.0) == pytest.approx(5.5)


def test_normal_profile():
    assert iec.nwp([0.0, 45.0, 90.0], 10.0, 90.0) == pytest.approx([0.0, 10 * 0.5**0.2, 10.0])


@given(st.floats(0.1, 10), st.floats(1, 5))
def test_bins_partition_all_speeds(v_ave, shape):
    edges = np.arange(0.5, 400.0)
    share = iec.bin_probability(edges, v_ave, width=1.0, shape=shape)
    assert share.sum() == pytest.approx(1.0, abs=1e-9)
    assert np.all(share >= 0)


def test_weibull_with_shape_two_is_rayleigh_and_has_the_stated_mean():
    v = np.linspace(0, 60, 6001)
    rayleigh = 1 - np.exp(-np.pi * (v / 20) ** 2)
    np.testing.assert_allclose(iec.weibull_cdf(v, 10.0), rayleigh, atol=1e-15)
    for shape in (1.5, 2.0, 3.0):
        mean = np.trapezoid(1 - iec.weibull_cdf(np.linspace(0, 500, 50001), 8.5, shape), dx=0.01)
        assert mean == pytest.approx(8.5, rel=1e-5)


@given(st.floats(0.01, 0.99), st.floats(1, 35), categories, st.sampled_from([3, 4]))
def test_quantile_inverts_the_distribution_of_sigma(p, v, category, edition):
    sigma = iec.ntm_sigma_quantile(p, v, category, edition)
    assert iec.ntm_sigma_cdf(sigma, v, category, edition) == pytest.approx(p, abs=1e-9)


def test_edition_3_quantile_is_the_design_value():
    # the standard rounds: 3.8 + 1.28 * 1.4 = 5.59, given as 5.6
    v = np.array([4.0, 15.0, 25.0])
    quantile = iec.ntm_sigma_quantile(0.9, v, "A", edition=3)
    np.testing.assert_allclose(quantile, iec.ntm_sigma(v, "A"), rtol=0.01)
    assert iec.ntm_sigma_cdf(0.0, 10.0, "A", edition=3) == 0


def test_class_s_is_the_designers():
    own = iec.WindClass("S", v_ref=45.0, v_ave=9.2)
    assert iec.etm_sigma(12.0, own, 0.17) == pytest.approx(
        2 * 0.17 * (0.072 * (9.2 / 2 + 3) * (12 / 2 - 4) + 10)
    )


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: iec.ntm_sigma(-1.0, "A"), "wind speed = -1"),
        (lambda: iec.ntm_sigma([5.0, np.nan], "A"), "wind speed = nan"),
        (lambda: iec.ntm_sigma(5.0, "D"), "category 'D'"),
        (lambda: iec.ntm_sigma(5.0, 16.0), "in \\(0, 1\\)"),
        (lambda: iec.etm_sigma(5.0, "IV", "A"), "class 'IV'"),
        (lambda: iec.etm_sigma(5.0, "S", "A"), "WindClass"),
        (lambda: iec.WindClass("S", v_ref=-1.0, v_ave=1.0), "v_ref = -1"),
        (lambda: iec.eog_amplitude(5.0, "I", "A", -126.0, 90.0), "rotor_diameter = -126"),
        (lambda: iec.eog_amplitude(60.0, "I", "A", 126.0, 90.0), "V_e1"),
        (lambda: iec.ecd_angle(60.0, "I"), "V_ref"),
        (lambda: iec.ews_amplitude(5.0, "A", 126.0, 0.0), "hub_height = 0"),
        (lambda: iec.ntm_sigma_quantile(1.0, 5.0, "A"), "probability"),
        (lambda: iec.ntm_sigma_cdf(1.0, 5.0, "A", edition=2), "edition = 2"),
        (lambda: iec.ewm_speed(90.0, "I", 90.0, return_period=10), "return_period"),
        (lambda: iec.nwp(-1.0, 10.0, 90.0), "height -1"),
        (lambda: iec.bin_probability(5.0, 10.0, width=0.0), "width"),
        (lambda: iec.weibull_cdf(5.0, 0.0), "v_ave"),
    ],
)
def test_nonsense_is_refused_by_name_and_value(call, message):
    with pytest.raises(InputError, match=message):
        call()
