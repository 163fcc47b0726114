"""Friction of ball and slewing bearings: slip and spin by quadrature, levels, limits."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.rolling import BallBearing, FrictionOptions, SlewingBearing, ball_friction
from loadflow.rolling.friction import ball_losses
from loadflow.tribology import lubricant

BALL = BallBearing(
    balls=9, ball_diameter=12.7e-3, pitch_diameter=65e-3, groove_radius=0.52 * 12.7e-3
)
ANGULAR = dataclasses.replace(BALL, contact_angle=0.4)
OIL = FrictionOptions(oil=lubricant("iso-vg-68"), temperature=333.15, roughness=0.2e-6)


def _ellipse(a, b, n=400):
    """Points, areas and Hertzian pressures of unit load over an ellipse (x along rolling)."""
    r, w = np.polynomial.legendre.leggauss(n)
    r, w = (r + 1) / 2, w / 2
    angle = np.linspace(0, 2 * np.pi, n, endpoint=False)
    x, y = b * r[:, None] * np.cos(angle), a * r[:, None] * np.sin(angle)
    area = (a * b * r * w)[:, None] * np.full(n, 2 * np.pi / n)
    pressure = 1.5 / (np.pi * a * b) * np.sqrt(1 - r**2)[:, None]
    return x, y, area * pressure


def test_differential_slip_by_integration():
    _, y, load = _ellipse(1.0, 0.1)
    slip = y**2 - 0.34729635533**2
    assert (np.sign(slip) * load).sum() == pytest.approx(0, abs=1e-3)  # no net traction
    assert (np.abs(slip) * load).sum() == pytest.approx(ball_losses._HEATHCOTE, rel=1e-3)


def test_spin_and_hysteresis_of_an_ellipse_by_integration():
    x, y, load = _ellipse(1.0, 0.1)
    assert load.sum() == pytest.approx(1, rel=1e-6)
    moment = (np.hypot(x, y) * load).sum()
    assert moment == pytest.approx(3 / 8, rel=0.03)  # E(k) = 1.016 for b/a = 0.1
    ahead = (np.where(x > 0, x, 0) * load).sum()
    assert ahead == pytest.approx(0.1 * ball_losses._ELLIPSE_HYSTERESIS, rel=1e-4)


def test_a_deep_groove_bearing_is_about_as_rough_as_catalogues_say():
    result = BALL.equilibrium(force=(3500.0, 0, 0))  # a tenth of its capacity
    found = ball_friction(result, 100.0, OIL)
    ratio = found.torque / (3500.0 * 45e-3 / 2)  # on the bore
    assert 0.0003 < ratio < 0.003
    assert found.losses["spin"] == 0
    assert found.losses["differential slip"] > 0


def test_a_contact_angle_brings_spin_in_one_contact_only():
    result = ANGULAR.equilibrium(force=(0, 0, 3000.0))
    found = ball_friction(result, 100.0, OIL)
    angle = float(result.contact_angles[0, 0])
    force = float(result.ball_forces[0, 0])
    semi = [float(ANGULAR.raceway_contact(r, force).semi_axes[0]) for r in ("inner", "outer")]
    most = 9 * 3 / 8 * 0.15 * force * max(semi) * 100.0 * np.sin(angle)
    assert 0 < found.losses["spin"] < most


def test_slewing_bearing_under_moment():
    slewing = SlewingBearing(
        balls=129, rows=2, ball_diameter=0.040, pitch_diameter=1.9, groove_radius=0.0205,
        contact_angle=0.7853981634,
    )  # fmt: skip
    result = slewing.equilibrium(force=(1e5, 0, 5e5), moment=(1e6, 0))
    grease = FrictionOptions(oil=lubricant("lgep-2"), temperature=293.15, roughness=0.6e-6)
    found = ball_friction(result, 0.1, grease)
    ratio = found.torque / (result.force_sum * 0.95)
    assert 0.0005 < ratio < 0.02
    assert found.film.shape == (4, 129, 2)


@settings(max_examples=15, deadline=None)
@given(st.floats(10, 2e4), st.floats(0, 1e4), st.floats(1e-3, 500))
def test_losses_are_finite_and_not_negative(radial, axial, omega):
    found = ball_friction(ANGULAR.equilibrium(force=(radial, 0, axial + radial)), omega, OIL)
    assert all(np.isfinite(p) and p >= 0 for p in found.losses.values())
    assert np.isfinite(found.film).all()


def test_no_load_standstill_and_reversal():
    still = ball_friction(BALL.equilibrium(force=(0.0, 0, 0)), 100.0, OIL)
    assert still.power == 0
    result = BALL.equilibrium(force=(1000.0, 0, 0))
    powers = ball_friction(result, np.array([-50.0, 0.0, 50.0]), OIL).power
    assert powers[0] == pytest.approx(powers[2])
    assert powers[1] == 0
    with pytest.raises(InputError, match="speed"):
        ball_friction(BALL.equilibrium(force=np.ones((4, 3))), np.ones(3), OIL)


def test_boundary_friction_counts_where_films_are_thin():
    result = ANGULAR.equilibrium(force=(0, 0, 3000.0))
    rough = dataclasses.replace(OIL, roughness=5e-6)
    more = ball_friction(result, 1.0, rough).losses
    less = ball_friction(result, 1.0, dataclasses.replace(rough, boundary_friction=0.06)).losses
    for name in ("spin", "differential slip"):
        assert more[name] == pytest.approx(2 * less[name], rel=0.05)
