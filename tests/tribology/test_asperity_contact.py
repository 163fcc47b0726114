"""Contact of asperities after Greenwood and Tripp, boundary friction and its power."""

import time

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from loadflow.errors import InputError
from loadflow.tribology import (
    AsperityContact,
    FrictionPair,
    asperity_pressure,
    boundary_stress,
    contact_power,
    friction_pair,
    friction_pair_names,
    greenwood_tripp,
    kernels,
)

CONTACT = AsperityContact(roughness=0.5e-6, contact_modulus=115e9, factor=1e-3, crowding=0.05)


def integral(order, u):
    """F_n(u) by quadrature of ∫ t^n φ(t + u) dt."""
    scale = np.exp(-u * u / 2) if u > 0 else 1.0
    found = quad(
        lambda t: t**order * np.exp(-t * t / 2 - u * t + (0 if u > 0 else -u * u / 2)),
        max(0.0, -u - 12), max(-u, 0.0) + 12, epsabs=0, epsrel=1e-13, limit=400,
    )[0]  # fmt: skip
    return found * scale / np.sqrt(2 * np.pi)


@pytest.mark.parametrize("u", [-15.0, -10.01, -9.99, -5.85, -0.3, 0.0, 1.03, 3.3, 5.9, 9.0, 25.0])
def test_compiled_integrals_by_quadrature(u):
    value, slope = kernels.pressure_integral(u)
    assert value == pytest.approx(integral(2.5, u), rel=1e-9)
    assert slope == pytest.approx(-2.5 * integral(1.5, u), rel=1e-9)
    area, fall = kernels.area_integral(u)
    assert area == pytest.approx(integral(2.0, u), rel=1e-9 if u < 16 else 1e-7)
    assert fall == pytest.approx(-2 * integral(1.0, u), rel=1e-9)


@given(st.floats(-9, 12))
def test_compiled_and_special_functions_agree(u):
    assert kernels.pressure_integral(u)[0] == pytest.approx(
        float(greenwood_tripp(2.5, u)), rel=1e-8
    )
    assert kernels.area_integral(u)[0] == pytest.approx(float(greenwood_tripp(2.0, u)), rel=1e-8)


def test_the_integral_is_smooth_over_its_pieces():
    u = np.array([-10.0, -9.9375, 0.0, 2.0, 20.0])
    for at in u:
        left, right = (np.array(kernels.pressure_integral(at + d)) for d in (-1e-12, 1e-12))
        assert left == pytest.approx(right, rel=1e-9)


@pytest.mark.parametrize("u", [38.4, 38.6, 50.0, 1e6, np.inf])
def test_far_surfaces_do_not_touch(u):
    assert kernels.pressure_integral(u)[0] < 1e-300
    if np.isfinite(u):
        assert kernels.area_integral(u)[0] < 1e-300


def test_pressure_slope_and_area_of_a_contact():
    gap, step = np.linspace(-1e-6, 2.5e-6, 15), 1e-12
    slope = (CONTACT.pressure(gap + step) - CONTACT.pressure(gap - step)) / (2 * step)
    assert CONTACT.pressure_slope(gap) == pytest.approx(slope, rel=1e-5)
    assert (CONTACT.pressure_slope(gap) < 0).all()
    expected = (np.pi * 0.05) ** 2 * greenwood_tripp(2.0, gap / 0.5e-6)
    assert CONTACT.area(gap) == pytest.approx(expected, rel=1e-8)


def test_a_contact_of_known_tips_has_the_printed_factor():
    contact = AsperityContact.of_tips(0.5e-6, 115e9, 20e-6, 4e9)
    assert contact.crowding == pytest.approx(0.04)
    assert contact.factor == pytest.approx(4.7391 * 0.04**2 * 0.15811, rel=1e-4)
    found = asperity_pressure([0.0, 1.5], 115e9, 0.5e-6, 20e-6, 4e9)
    assert contact.pressure([0.0, 0.75e-6]) == pytest.approx(found, rel=1e-14)


@given(st.floats(-6, 14))
def test_the_gap_under_a_pressure_is_found_again(u):
    gap = u * CONTACT.roughness
    assert CONTACT.gap(CONTACT.pressure(gap)) == pytest.approx(gap, abs=1e-15)


def test_gaps_of_extreme_pressures():
    assert np.isinf(CONTACT.gap(0.0))
    pressure = np.array([1e-200, 1.0, 1e6, 1e12])
    found = CONTACT.gap(pressure)
    assert (np.diff(found) < 0).all()
    assert CONTACT.pressure(found) == pytest.approx(pressure, rel=1e-9)
    for bad in (-1.0, np.nan, np.inf):
        with pytest.raises(InputError, match="pressure"):
            CONTACT.gap(bad)


@pytest.mark.parametrize(
    "change", [{"roughness": 0.0}, {"contact_modulus": -1.0}, {"factor": np.nan}, {"crowding": 2.0}]
)
def test_an_impossible_contact_is_refused(change):
    fields = {"roughness": 1e-6, "contact_modulus": 1e11, "factor": 1e-3} | change
    with pytest.raises(InputError, match=next(iter(change))):
        AsperityContact(**fields)
    with pytest.raises(InputError, match="density"):
        AsperityContact.of_tips(1e-6, 1e11, 1e-5, 0.0)


def test_ten_million_contact_pressures_a_second():
    @numba.njit
    def total(u):
        found = 0.0
        for at in u:
            value, slope = kernels.pressure_integral(at)
            found += value - slope
        return found

    u = np.linspace(-1, 6, 200_000)
    total(u)
    took = []
    for _ in range(5):
        start = time.perf_counter()
        total(u)
        took.append(time.perf_counter() - start)
    assert min(took) / u.size < 1e-7


def test_pairs_of_the_library_are_those_printed():
    table = {"bronze": (0.15, 0.30, 0.12), "metal-polymer": (0.0007, 0.15, 0.07),
             "polymer": (0.0035, 0.24, 0.10)}  # fmt: skip
    for name, (sliding, static, scatter) in table.items():
        pair = friction_pair(name)
        assert (pair.sliding, pair.static, pair.static_scatter) == (sliding, static, scatter)
        assert pair.boundary_coefficient == static
        assert pair.film == 0.11
    assert friction_pair("engine-bearing").boundary_coefficient == 0.02
    assert all(friction_pair(name).source for name in friction_pair_names())


def test_impossible_pairs_are_refused():
    with pytest.raises(InputError, match="friction_pair"):
        friction_pair("butter")
    with pytest.raises(InputError, match="static"):
        FrictionPair(sliding=0.1)
    with pytest.raises(InputError, match="boundary"):
        FrictionPair(boundary=-0.1)


@given(st.floats(0, 1e9), st.floats(-10, 10))
def test_contact_power_is_never_negative(pressure, sliding):
    power = contact_power(pressure, sliding, 0.1)
    assert power >= 0
    assert power <= 0.1 * pressure * abs(sliding) * (1 + 1e-12)
    assert power == pytest.approx(boundary_stress(pressure, sliding, 0.1) * sliding)
