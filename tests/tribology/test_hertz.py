"""Hertz contacts against exact anchors, the printed values of slewing bearings, and limits."""

from functools import partial

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.integrate import quad

from loadflow.errors import InputError
from loadflow.tribology.contact_ellipse import ellipticity
from loadflow.tribology.hertz import (
    curvature_sum,
    hertz_line,
    hertz_point,
    line_factor,
)


@pytest.mark.parametrize(
    ("ratio", "k"),
    [(1.5, 1.3101029621), (5, 2.8901810398), (10, 4.4994473032), (50, 12.0711467813)],
)
def test_ellipticity_has_the_exact_value(ratio, k):
    assert ellipticity(ratio) == pytest.approx(k, rel=1e-10)


@given(st.floats(1.0, 1e10))
@example(290.0)
def test_ellipticity_solves_the_contact_equation(ratio):
    k = float(ellipticity(ratio))
    # J1 and J2 over the angle: the definition, without elliptic integrals
    whole = partial(quad, a=0, b=np.pi / 2, epsabs=0.0, epsrel=1e-11)
    down = whole(lambda t: np.cos(t) ** 2 / np.hypot(k * np.sin(t), np.cos(t)))[0]
    if k < 50:  # beyond, the quadrature loses digits, not the solution
        up = whole(lambda t: np.sin(t) ** 2 / np.hypot(k * np.sin(t), np.cos(t)))[0]
        assert k**2 * up / down == pytest.approx(ratio, rel=1e-8)
    else:
        assert k == pytest.approx(ratio ** (2 / np.pi), rel=1.0)


def test_equal_spheres_have_the_closed_form_of_a_circular_contact():
    e_star, radius, force = 210e9 / (2 * (1 - 0.09)), 0.01 / 2, 500.0
    contact = hertz_point(100, 100, 100, 100, force=force)
    a = np.cbrt(3 * force * radius / (4 * e_star))
    assert contact.semi_axes[0] == pytest.approx(a, rel=1e-12)
    assert contact.semi_axes[1] == pytest.approx(a, rel=1e-12)
    assert contact.approach == pytest.approx(a**2 / radius, rel=1e-12)
    assert contact.pressure == pytest.approx(1.5 * force / (np.pi * a**2), rel=1e-12)
    assert contact.stiffness == pytest.approx(4 / 3 * e_star * np.sqrt(radius), rel=1e-12)


def test_a_circle_is_reached_without_loss_of_digits():
    near = hertz_point(100, 100 * (1 + 1e-9), 0, 0, force=1.0)
    circle = hertz_point(100, 100, 0, 0, force=1.0)
    assert near.ellipticity - 1 == pytest.approx(2e-9 / 3, rel=1e-5)
    assert near.stiffness == pytest.approx(circle.stiffness, rel=1e-8)


def test_contacts_of_bearings_and_loads_are_labelled_case_by_case():
    """Two loads of three geometries: what depends on the geometry alone stands at each load."""
    contact = hertz_point(50, 50, -1 / 0.0205, [1 / 0.08, -1 / 0.12, 0.0], force=[[1e3], [2e3]])
    data = contact.to_dataset()
    np.testing.assert_array_equal(data["pressure"], np.ravel(contact.pressure))
    np.testing.assert_array_equal(data["stiffness"], np.tile(contact.stiffness, 2))
    axes = data["major_semi_axis"] / data["minor_semi_axis"]
    np.testing.assert_allclose(axes, np.tile(contact.ellipticity, 2), rtol=1e-12)
    assert data["stiffness"].units == "N/m^1.5"
    one = hertz_line(100.0, 0.0, length=0.03, force=2e4)
    alone = one.to_dataset()
    assert not alone.dims
    assert float(alone["semi_width"]) == one.semi_width


def test_stiffness_of_the_worksheet_geometry():
    contact = hertz_point(50, 50, -1 / 0.0205, [1 / 0.08, -1 / 0.12], force=1.0)
    assert contact.coefficient == pytest.approx([0.54061, 0.59540], rel=1e-4)
    assert contact.stiffness / 1e3**1.5 == pytest.approx([2_168_389, 2_286_816], rel=1e-6)


def test_pressure_of_the_blade_bearing():
    contact = hertz_point(50, 50, -1 / 0.0205, [1 / 0.93, -1 / 0.97], force=28_800)
    assert contact.pressure == pytest.approx([2238.4e6, 2195.4e6], rel=1e-4)
    assert contact.semi_axes[0][0] == pytest.approx(8.17e-3, rel=1e-3)


@given(st.floats(1e-6, 1e9), st.floats(1.0, 300), st.floats(1.0, 300), st.floats(-0.99, 3))
def test_force_approach_and_pressure_belong_together(force, r11, r12, share):
    contact = hertz_point(r11, r12, share * r11, 0, force=force)
    a, b = contact.semi_axes
    assert contact.stiffness * contact.approach**1.5 == pytest.approx(force, rel=1e-12)
    assert contact.pressure == pytest.approx(1.5 * force / (np.pi * a * b), rel=1e-12)
    swapped = hertz_point(share * r11, 0, r11, r12, force=force)
    assert swapped.approach == pytest.approx(contact.approach, rel=1e-14)


def test_zero_force_gives_zero_not_nan():
    contact = hertz_point(50, 50, 0, 0, force=[0.0, 1.0])
    assert contact.pressure[0] == contact.approach[0] == contact.semi_axes[0][0] == 0


def test_softer_second_body():
    rigid = hertz_point(50, 50, 0, 0, force=1.0, second_modulus=1e30)
    equal = hertz_point(50, 50, 0, 0, force=1.0)
    assert rigid.stiffness == pytest.approx(2 * equal.stiffness, rel=1e-12)


def test_line_pressure_carries_the_force():
    contact = hertz_line(100, 20, length=0.02, force=3e4)
    carried = np.pi / 2 * contact.pressure * contact.semi_width * 0.02
    assert carried == pytest.approx(3e4, rel=1e-12)


@pytest.mark.parametrize("law", ["iso", "palmgren"])
def test_line_stiffness_is_the_slope_of_the_force(law):
    contact = hertz_line(100, 0, length=0.02, force=3e4, law=law)
    factor = line_factor(0.02, law=law)
    above, below = (factor * (contact.approach * s) ** (10 / 9) for s in (1 + 1e-6, 1 - 1e-6))
    slope = (above - below) / (2e-6 * contact.approach)
    assert contact.stiffness == pytest.approx(slope, rel=1e-8)


def test_palmgren_in_its_own_units():
    approach = hertz_line(100, 0, length=0.012, force=5000, law="palmgren").approach
    assert approach * 1e3 == pytest.approx(3.84e-5 * 5000**0.9 / 12**0.8, rel=1e-12)


def test_curvature_sum_of_the_worksheet():
    total, cos_tau = curvature_sum(50, 50, -1 / 0.0205, [12.5, -1e3 / 120])
    assert total == pytest.approx([63.71951, 42.88618], rel=1e-7)
    assert cos_tau == pytest.approx([0.96172, 0.94313], rel=1e-5)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: hertz_point(50, 50, -50, 0, force=1), "curvatures"),
        (lambda: hertz_point(50, 50, 0, 0, force=-1), "force"),
        (lambda: hertz_point(50, 50, 0, 0, force=np.nan), "force"),
        (lambda: hertz_point(50, 50, 0, 0, force=1, modulus=0), "modulus"),
        (lambda: hertz_point(50, 50, 0, 0, force=1, poisson=0.6), "poisson"),
        (lambda: hertz_line(50, -50, length=0.01, force=1), "curvatures"),
        (lambda: hertz_line(50, 0, length=0, force=1), "length"),
        (lambda: hertz_line(50, 0, length=0.01, force=1, law="hertz"), "law"),
    ],
)
def test_nonsense_is_refused_by_name(call, words):
    with pytest.raises(InputError, match=words):
        call()
