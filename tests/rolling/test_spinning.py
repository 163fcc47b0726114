"""Ball bearings at speed: limits, balance of every ball, known trends."""

import dataclasses
import math

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rolling import BallBearing

BALL = 22.225e-3
BEARING = BallBearing(  # a 218 angular contact bearing, as Harris's worked example
    balls=16,
    ball_diameter=BALL,
    pitch_diameter=125.26e-3,
    groove_radius=0.5232 * BALL,
    contact_angle=math.radians(40),
)
FAST = 10_000 * math.pi / 30
THRUST = (0.0, 0.0, 17_800.0)


def test_slow_balls_are_those_without_inertia():
    force, moment = (5000.0, 0, 8000), (20.0, 10.0)
    slow, still = (BEARING.equilibrium(force, moment, speed=s) for s in (1e-3, None))
    assert slow.displacement == pytest.approx(still.displacement, rel=1e-6)
    assert slow.ball_forces == pytest.approx(still.ball_forces, rel=1e-6, abs=1e-3)
    assert slow.reference_life == pytest.approx(still.reference_life, rel=1e-6)


def test_every_ball_is_in_balance():
    result = BEARING.equilibrium((5000.0, 0, 12_000), speed=FAST)
    spin = result.spin
    friction = 2 * spin.gyroscopic / BALL
    radial = spin.inner_forces * np.cos(spin.inner_angles) + spin.centrifugal
    radial -= spin.outer_forces * np.cos(spin.outer_angles) + friction * np.sin(spin.outer_angles)
    axial = spin.inner_forces * np.sin(spin.inner_angles)
    axial -= spin.outer_forces * np.sin(spin.outer_angles)
    axial += friction * np.cos(spin.outer_angles)
    assert np.abs(radial).max() < 0.2
    assert np.abs(axial).max() < 0.2
    assert result.residual < 1e-8


def test_outer_ring_carries_more_and_flatter_at_speed():
    still = BEARING.equilibrium(THRUST)
    spins = [BEARING.equilibrium(THRUST, speed=s).spin for s in (0.5 * FAST, FAST, 1.5 * FAST)]
    angle = still.contact_angles[0, 0]
    for spin in spins:
        assert spin.outer_angles[0, 0] < angle < spin.inner_angles[0, 0]
        assert 16 * spin.inner_forces[0, 0] * np.sin(spin.inner_angles[0, 0]) == pytest.approx(
            17_800, rel=1e-6
        )
    apart = [s.inner_angles[0, 0] - s.outer_angles[0, 0] for s in spins]
    assert apart == sorted(apart)
    fast = BEARING.equilibrium(THRUST, speed=FAST)
    assert fast.displacement[2] < still.displacement[2]


def test_centrifugal_force_is_that_of_the_cage_speed():
    deep = dataclasses.replace(BEARING, contact_angle=0.0)
    spin = deep.equilibrium((1e4, 0, 0), speed=FAST).spin
    cage = FAST / 2 * (1 - BALL / 125.26e-3)
    mass = 7850 * math.pi / 6 * BALL**3
    assert spin.centrifugal == pytest.approx(mass * 125.26e-3 / 2 * cage**2, rel=1e-6)
    assert spin.gyroscopic == pytest.approx(0, abs=1e-6)
    unloaded = spin.inner_forces == 0
    assert spin.outer_forces[unloaded] == pytest.approx(spin.centrifugal[unloaded], rel=1e-6)


@pytest.mark.parametrize("speed", [FAST, 2 * FAST])
def test_balls_roll_on_both_raceways_and_do_not_spin_on_the_outer_one(speed):
    """Slip at the middle of both contacts, and spin at the outer one, in the frame of the cage."""
    spin = BEARING.equilibrium(THRUST, speed=speed).spin
    inner, outer = spin.inner_angles[0, 0], spin.outer_angles[0, 0]
    assert inner - outer > math.radians(2)
    mass, pitch = 7850 * math.pi / 6 * BALL**3, 125.26e-3
    orbit = math.sqrt(spin.centrifugal[0, 0] / (mass * pitch / 2))
    # gyroscopic moment = J × the ball's own speed across the axis × that of its orbit
    across = spin.gyroscopic[0, 0] / (mass * BALL**2 / 10 * orbit)
    along = orbit + across / math.tan(outer)  # no spin there
    slip = {
        "outer": orbit * (pitch + BALL * math.cos(outer))
        - BALL * (along * math.cos(outer) + across * math.sin(outer)),
        "inner": (speed - orbit) * (pitch - BALL * math.cos(inner))
        - BALL * (along * math.cos(inner) + across * math.sin(inner)),
    }
    assert slip == pytest.approx(dict.fromkeys(slip, 0.0), abs=1e-6 * speed * pitch)


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0, 1.5])
@pytest.mark.parametrize("load", [(3000.0, 0, 12_000, 0, 0), (6000.0, -2000.0, 5000, 40, -60)])
def test_stiffness_at_speed_is_the_slope_of_the_force(load, share):
    """Centrifugal forces and gyroscopic moments follow the contact angles, as in the force."""
    step = np.diag([1.0, 1.0, 2.0, 0.1, 0.1])
    loads = np.array(load) + np.concatenate([step, -step, np.zeros((1, 5))])
    found = BEARING.equilibrium(loads[:, :3], loads[:, 3:], speed=share * FAST)
    moved = (found.displacement[:5] - found.displacement[5:10]).T / 2
    scale = np.array([1, 1, 1, *(2 / BEARING.pitch_diameter,) * 2])
    error = (found.stiffness[10] @ moved - step) * scale[:, None] / np.diag(step * scale)
    assert np.abs(error).max() < 1e-5


def test_secant_stiffness_at_speed_is_symmetric_and_leads_to_the_load():
    found = BEARING.equilibrium((6000.0, -2000.0, 5000), (40, -60), speed=FAST)
    unlike = found.stiffness - found.stiffness.T
    assert np.abs(unlike).max() > 1e-3 * np.abs(found.stiffness).max()  # inertia has no potential
    secant = found.secant_stiffness
    assert secant == pytest.approx(secant.T, rel=1e-12)
    load = np.append(found.force, found.moment)
    assert secant @ found.displacement == pytest.approx(load, rel=1e-9)


def test_series_of_random_loads_comes_to_rest():
    rng = np.random.default_rng(1)
    force, moment = rng.normal(size=(50, 3)) * [4e3, 4e3, 6e3], rng.normal(size=(50, 2)) * 50
    result = BEARING.equilibrium(force, moment, speed=rng.uniform(100, 1200, 50))
    assert result.residual.max() < 1e-8
    assert result.reference_life.shape == result.maximum_pressure.shape == (50,)


def test_speeds_must_be_finite():
    with pytest.raises(InputError, match="speed"):
        BEARING.equilibrium(THRUST, speed=math.nan)


@pytest.mark.parametrize("seed", range(12))
def test_slow_balls_come_to_rest(seed):
    """Unloaded balls of an angular contact swing out by the little that their inertia is.

    Drawn as main bearings are, with n D_pw of 1,000 to 10,000 mm/min; inertia then is rounding
    beside the load: its share of C₀-like forces is below 1e-3.
    """
    rng = np.random.default_rng(seed)
    diameter = 10 ** rng.uniform(-2, -1)
    pitch = diameter * rng.uniform(8, 20)
    bearing = BallBearing(
        balls=int(2.5 * pitch / diameter), ball_diameter=diameter, pitch_diameter=pitch,
        groove_radius=0.52 * diameter, contact_angle=rng.uniform(0.2, 0.8),
    )  # fmt: skip
    capacity = float(bearing.rated_capacity)
    force = rng.normal(size=3) * 0.1 * capacity
    speed = 10 ** rng.uniform(3, 4) / (1e3 * pitch) * 2 * np.pi / 60
    turning = bearing.equilibrium(force, speed=speed)
    still = bearing.equilibrium(force)
    assert turning.converged
    near = np.abs(turning.contact_forces - still.contact_forces).max()
    assert near < 1e-2 * float(still.maximum_force)


def test_a_bearing_without_load_comes_to_rest_within_its_clearance():
    """No ball touches the inner ring: the rings meet no resistance, beside a case that does."""
    loose = dataclasses.replace(BEARING, contact_angle=0.0, clearance=1e-4)
    found = loose.equilibrium([(0, 0, 0), (2500.0, 40.0, -3000.0)], [(0, 0), (80, 100)], speed=10.0)
    assert found.converged.all()
    assert found.residual.max() < 1e-8
    assert found.maximum_force[0] < 1e-6 < found.maximum_force[1]
