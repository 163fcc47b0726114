"""Wear: exact depths and volumes, running-in, worn contours."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from loadflow.errors import InputError
from loadflow.tribology import (
    Archard,
    AsperityContact,
    ConformalWear,
    Fleischer,
    RunningIn,
    ShaftImprint,
    WornArc,
)

CASE = ConformalWear(force=1e5, radius=0.2, width=0.25, coefficient=1e-16, distance=1e3)


def test_conformal_bearing_without_clearance_has_the_exact_numbers():
    assert CASE.largest_pressure == pytest.approx(1.27324e6, rel=5e-6)
    assert CASE.largest_depth == pytest.approx(0.127324e-6, rel=5e-6)
    assert CASE.volume == pytest.approx(12.7324e-9, rel=5e-6)


def test_the_pressure_of_the_conformal_bearing_carries_its_force():
    carried = quad(
        lambda a: float(CASE.pressure(a)) * math.cos(a) * 0.2 * 0.25, -math.pi / 2, math.pi / 2
    )
    assert carried[0] == pytest.approx(1e5, rel=1e-12)
    worn = quad(lambda a: float(CASE.depth(a)) * 0.2 * 0.25, -math.pi / 2, math.pi / 2)
    assert worn[0] == pytest.approx(CASE.volume, rel=1e-12)


def test_a_run_of_archard_finds_the_conformal_bearing():
    """A shaft sinks into an elastic layer of its own radius, which wears; the load is given."""
    n, stiffness, steps = 720, 1e12, 20
    cosine = np.cos((np.arange(n) + 0.5) / n * 2 * math.pi)
    area = 0.2 * 0.25 * 2 * math.pi / n
    law, depth = Archard(1e-16), np.zeros(n)

    def pressure(sunk):
        return stiffness * np.maximum(sunk * cosine - depth, 0.0)

    for _ in range(steps):
        sunk = brentq(lambda v: pressure(v) @ cosine * area - 1e5, 0.0, 1e-3, xtol=1e-18)
        touching = pressure(sunk)
        depth += law.depth(touching, 1e3 / steps)
    assert touching.max() == pytest.approx(CASE.largest_pressure, rel=1e-4)
    assert depth.max() == pytest.approx(CASE.largest_depth, rel=1e-4)
    assert depth.sum() * area == pytest.approx(CASE.volume, rel=1e-4)


@pytest.mark.parametrize(("law", "friction", "k"), [
    (Archard(3e-16), None, 3e-16), (Fleischer(4e14), 0.12, 0.12 / 4e14),
])  # fmt: skip
def test_worn_volume_is_that_of_the_normal_force(law, friction, k):
    """V = k ∬ p dA ds in any run: a wedge of rough surfaces that wears under a shaft that sinks."""
    contact = AsperityContact(roughness=0.4e-6, contact_modulus=1e11, factor=1e-3)
    x = np.linspace(-1, 1, 400)
    area, depth, work = 1e-6, np.zeros(400), 0.0
    for step in range(200):
        gap = 1e-6 * x**2 - 0.2e-6 * math.sin(0.1 * step) + depth
        distance = 5.0 + step % 7
        pressure = contact.pressure(gap)
        depth += law.depth(pressure, distance, friction)
        work += float(pressure.sum()) * area * distance
    assert depth.max() > 1e-8
    assert depth.sum() * area == pytest.approx(k * work, rel=1e-10)


@given(st.floats(0, 1e9), st.floats(0, 1e6), st.floats(0.001, 0.5))
def test_fleischer_at_constant_friction_is_archard(pressure, distance, friction):
    law = Fleischer(1e14)
    expected = law.archard(friction).depth(pressure, distance)
    assert law.depth(pressure, distance, friction) == pytest.approx(expected, rel=1e-13)
    assert law.rate(pressure, friction) * distance == pytest.approx(expected, rel=1e-13)


def test_impossible_wear_is_refused():
    for make in (lambda: Archard(0.0), lambda: Archard(1.0), lambda: Archard(np.nan)):
        with pytest.raises(InputError, match="coefficient"):
            make()
    with pytest.raises(InputError, match="energy_density"):
        Fleischer(-1.0)
    with pytest.raises(InputError, match="friction"):
        Fleischer(1e14).rate(1e6)
    with pytest.raises(InputError, match="pressure"):
        Archard(1e-16).rate([1e6, -1.0])
    with pytest.raises(InputError, match="distance"):
        Archard(1e-16).depth(1e6, np.nan)
    with pytest.raises(InputError, match="largest_depth"):
        WornArc(largest_depth=3e-4, clearance=1e-4)


STATE = RunningIn(initial_roughness=0.8e-6, final_roughness=0.3e-6, depth=0.7e-6, excess=6.0)


def test_running_in_is_the_solution_of_its_rate():
    law, pressure = Archard(2e-16), 4e6
    path = solve_ivp(
        lambda s, d: STATE.rate(law, pressure, np.maximum(d, 0)), (0, 3000), [0.1e-6],
        rtol=1e-11, atol=1e-18,
    )  # fmt: skip
    found = STATE.worn(law, pressure, 3000.0, worn=0.1e-6)
    assert found == pytest.approx(path.y[0, -1], rel=1e-8)


@given(st.floats(0, 1e5), st.floats(0, 1e5), st.floats(0, 1e-5))
def test_running_in_does_not_depend_on_the_steps(first, second, worn):
    law, pressure = Archard(1e-16), 5e6
    once = STATE.worn(law, pressure, first + second, worn)
    twice = STATE.worn(law, pressure, second, STATE.worn(law, pressure, first, worn))
    assert twice == pytest.approx(float(once), rel=1e-12, abs=1e-20)


def test_running_in_ends_at_the_steady_law_and_roughness():
    law = Archard(1e-16)
    assert STATE.roughness([0.0, 1e-4]) == pytest.approx([0.8e-6, 0.3e-6])
    assert STATE.rate(law, 5e6, [0.0, 1e-4]) == pytest.approx([6 * 5e-10, 5e-10])
    # all of the excess is d₀ ln a
    late = STATE.worn(law, 5e6, 1e8) - law.depth(5e6, 1e8)
    assert late == pytest.approx(0.7e-6 * math.log(6), rel=1e-6)
    plain = RunningIn(initial_roughness=1e-6, final_roughness=1e-6, depth=1e-6)
    assert plain.worn(law, 5e6, 2e3, 3e-6) == pytest.approx(3e-6 + 1e-6, rel=1e-14)


@pytest.mark.parametrize("shape", [WornArc, ShaftImprint])
@pytest.mark.parametrize("share", [0.0, 0.01, 0.5, 1.0, 1.7, 2.0])
def test_worn_contours_end_at_their_edges_and_have_their_volume(shape, share):
    contour = shape(largest_depth=share * 1e-4, clearance=1e-4)
    edge = contour.half_angle
    assert contour.depth(0.0) == pytest.approx(share * 1e-4, rel=1e-12)
    assert contour.depth([edge, -edge]) == pytest.approx([0, 0], abs=1e-18)
    if edge < math.pi - 0.1:
        assert (contour.depth([edge + 0.05, -edge - 0.05]) == 0).all()
    worn = quad(lambda a: float(contour.depth(a)) * 0.2 * 0.25, -edge, edge, epsabs=1e-18)[0]
    assert contour.volume(0.2, 0.25) == pytest.approx(worn, rel=1e-9, abs=1e-20)


def test_the_worn_arc_is_that_of_dufrane():
    arc = WornArc(largest_depth=0.4e-4, clearance=1e-4)
    phi = np.linspace(0, 2 * math.pi, 50)  # from the point opposite to the load
    printed = np.maximum(0.4e-4 - 1e-4 * (1 + np.cos(phi)), 0.0)
    assert arc.depth(phi - math.pi) == pytest.approx(printed, abs=1e-18)
    assert math.cos(math.pi - arc.half_angle) == pytest.approx(0.4 - 1)


def test_without_clearance_the_imprint_is_the_conformal_bearing():
    imprint = ShaftImprint(largest_depth=CASE.largest_depth, clearance=0.0)
    angle = np.linspace(-3, 3, 41)
    assert imprint.depth(angle) == pytest.approx(CASE.depth(angle), abs=1e-22)
    assert imprint.volume(0.2, 0.25) == pytest.approx(CASE.volume, rel=1e-12)
    assert ShaftImprint(largest_depth=0.0, clearance=0.0).half_angle == 0.0
