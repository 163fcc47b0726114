"""Unsteady attached flow: parameters from the polar, steps, oscillations, limits."""

import numpy as np
import pytest

from loadflow.rotor.aero._airfoil_kernels import SECTION_STATES, coefficients, polar
from loadflow.rotor.airfoils import attached_flow
from loadflow.rotor.machine import machine
from loadflow.rotor.options import RotorOptions
from loadflow.turbines import load_turbine

TURBINE = load_turbine("nrel-5mw")
MACHINE = machine(TURBINE, RotorOptions(modes=()))
OUTER = 13  # NACA 64-618 at 52.75 m
SPEED, STEP = 60.0, 0.005
SEMICHORDS = 2 * SPEED * STEP / MACHINE.chord[OUTER]  # travelled in one step


def _series(attack, section=OUTER):
    states = np.zeros(SECTION_STATES)
    return np.array(
        [
            coefficients(MACHINE, section, a, SPEED, STEP if k else 0.0, states)
            for k, a in enumerate(attack)
        ]
    )


def test_parameters_are_those_of_the_polar():
    zero, slope, friction = attached_flow(TURBINE.airfoils["NACA64"])
    assert np.degrees(zero) == pytest.approx(-3.84, abs=0.01)  # −0.017 at −4°, 0.088 at −3°
    assert slope == pytest.approx(7.0, rel=0.01)  # −0.264 at −6°, −0.375 at −7°
    assert friction == pytest.approx(0.0071, abs=1e-4)
    assert attached_flow(TURBINE.airfoils["cylinder1"]) == (0.0, 0.0, 0.0)


def test_steady_lift_is_that_of_the_polar_at_every_angle():
    for attack in np.radians([-150.0, -60.0, -10.0, -3.0, 2.0, 8.0, 15.0, 30.0, 90.0]):
        lift, _ = _series([attack])[0]
        assert lift == pytest.approx(polar(MACHINE.lift, OUTER, attack), abs=2e-3)


def test_chord_force_is_bounded_by_the_suction_of_potential_flow():
    # the polar has 0.0052 in its laminar bucket, 0.0071 at zero lift; past stall nothing changes
    drag = {a: _series([np.radians(a)])[0][1] for a in (-2.0, 0.0, 1.0, 15.0, 30.0, 90.0)}
    for degrees, value in drag.items():
        bucket = polar(MACHINE.drag, OUTER, np.radians(degrees))
        if degrees < 10:
            assert bucket < value < 0.008
        else:
            assert value == pytest.approx(bucket, rel=1e-6)
    assert drag[0.0] == pytest.approx(0.0071, rel=0.02)  # chord and flow coincide: no suction


def test_lift_after_a_step_grows_as_the_shed_wake_leaves():
    # (1.13): 1 − 0.3 exp(−0.14 β² s) − 0.7 exp(−0.53 β² s) of the change, s in semi-chords
    before, after = np.radians(1.0), np.radians(3.0)
    lift = _series(np.r_[before, np.full(800, after)])[:, 0]
    square = 1 - (SPEED / 340) ** 2
    travelled = (np.arange(1, 801) - 0.5) * SEMICHORDS
    grown = 1 - 0.3 * np.exp(-0.14 * square * travelled) - 0.7 * np.exp(-0.53 * square * travelled)
    share = (lift[1:] - lift[0]) / (lift[-1] - lift[0])
    assert share[1:] == pytest.approx(grown[1:], abs=0.01)  # the first step holds the inertia


@pytest.mark.parametrize("reduced", [0.01, 0.03, 0.1])
def test_oscillating_lift_has_the_phase_of_theory(reduced):
    # lag of the shed wake against the lead of the inertia, both of linear theory
    amplitude = np.radians(0.5)
    rate = 2 * SPEED * reduced / MACHINE.chord[OUTER]
    time = np.arange(0, 8 * 2 * np.pi / rate, STEP)
    lift = _series(np.radians(2.0) + amplitude * np.sin(rate * time))[:, 0]
    last = time > time[-1] - 2 * 2 * np.pi / rate
    wave = np.exp(-1j * rate * time[last])
    got = 2j * np.mean((lift[last] - lift[last].mean()) * wave) / amplitude
    mach, slope = SPEED / 340, np.degrees(0.114)  # slope of the polar between 0° and 4°
    square = 1 - mach * mach
    k = 1j * reduced
    wake = 0.3 * k / (k + 0.14 * square) + 0.7 * k / (k + 0.53 * square)
    fading = 0.3 * 0.14 + 0.7 * 0.53
    curve = MACHINE.lift_slope[OUTER]
    stiffening = 1 - mach + 0.5 * curve * mach**2 * np.sqrt(square) * fading
    theory = slope * (1 - wake) + 6 * k / stiffening
    assert abs(got) == pytest.approx(abs(theory), rel=0.02)
    assert np.degrees(np.angle(got / theory)) == pytest.approx(0, abs=0.5)


def test_angle_that_jumps_over_half_a_turn_stays_finite():
    angles = np.radians(np.r_[np.linspace(170, 180, 20), np.linspace(-180, -170, 20)])
    series = _series(angles)
    assert np.isfinite(series).all()
    assert np.abs(np.diff(series, axis=0)).max() < 0.1
