"""Loads of a blade at its root, in closed form and as parts of those of the rotor."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.rotor import RotorOptions, simulate
from loadflow.rotor import slots as k
from loadflow.rotor.inflow import steady_inflow
from loadflow.rotor.loop import run, turning_state
from loadflow.rotor.rungs import prepare
from loadflow.turbines import load_turbine

GRAVITY = 9.80665
PLANT = load_turbine("nrel-5mw")


def blade_centre():
    blade = PLANT.blade
    return np.trapezoid(blade.span * blade.mass_density, blade.span) / blade.mass


@pytest.fixture(scope="module")
def alone():
    """A rotor at given speed in the steady wind of a free stream: no tilt, shear, tower or wake."""
    upright = replace(PLANT, rotor=replace(PLANT.rotor, tilt=0.0))
    options = RotorOptions(tower_dam=False, shed_wake=False, skew_factor=0.0)
    m, c = prepare(upright, "bem", options)
    state = turning_state(m, c, 12.0, 1.2, 0.05)
    steps = round(2 * np.pi / 1.2 / 0.02)
    return m, run(m, c, steady_inflow(12.0, steps, 0.0), state, 0.02, steps=steps, controlled=False)


def test_three_blades_make_thrust_and_torque_of_the_rotor(alone):
    m, out = alone
    force, moment = out[:, k.ROOT : k.ROOT + 3], out[:, k.ROOT + 3 : k.ROOT + 6]
    cos, sin = np.cos(m.cone), np.sin(m.cone)
    thrust = force[:, 1] * cos - force[:, 0] * sin
    # about the shaft: moment at the root, and the force against the rotation at the root's radius
    torque = moment[:, 1] * cos - moment[:, 0] * sin - m.hub_radius * cos * force[:, 2]
    # blades differ by their weight, whose mean over a turn is 0
    assert 3 * thrust.mean() == pytest.approx(out[:, k.FX].mean(), rel=2e-3)
    assert 3 * torque.mean() == pytest.approx(out[:, k.MX].mean(), rel=2e-3)


def test_a_blade_pulls_as_it_turns_and_hangs_once_a_turn(alone):
    _, out = alone
    pull = PLANT.blade.mass * 1.2**2 * (PLANT.rotor.hub_radius + blade_centre())
    weight = PLANT.blade.mass * GRAVITY
    azimuth = out[:, k.AZIMUTH]
    outward, edge = out[:, k.ROOT], out[:, k.ROOT + 4]
    assert outward.mean() == pytest.approx(pull, rel=0.05)
    # blade up: its weight presses on the bearing
    assert 2 * (outward * np.cos(azimuth)).mean() == pytest.approx(-weight, rel=0.02)
    # blade on the way down: its weight drives the rotor
    assert 2 * (edge * np.sin(azimuth)).mean() == pytest.approx(weight * blade_centre(), rel=0.05)


def test_a_parked_blade_hangs_on_its_bearing():
    weight = PLANT.blade.mass * GRAVITY
    parked = {"dlc": "6.4", "wind_speed": 4.0, "duration": 1.0, "run_in": 1.0, "rung": "tables"}
    level = simulate(azimuth=np.pi / 2, event="parked", **parked)
    across = level["root_force"].sel(axis="z").values.mean()
    # little wind is left on it
    assert across == pytest.approx(-weight, rel=0.02)
    edge = level["root_moment"].sel(axis="y").values.mean()
    # the spec of the turbine: centre of mass 20.475 m from the root, 17,740 kg
    assert edge == pytest.approx(17740 * GRAVITY * 20.475, rel=0.03)
