"""Dynamic stall: loops of the right sense, the polar in slow flow, blades that stand."""

import numpy as np
import pytest
from rotor_sections import section_coefficients, section_force

from loadflow.rotor import RotorOptions
from loadflow.rotor.aero._airfoil_kernels import SECTION_STATES, polar
from loadflow.rotor.machine import machine
from loadflow.turbines import load_turbine

TURBINE = load_turbine("nrel-5mw")
MODEL = machine(TURBINE, RotorOptions(modes=(), dynamic_stall=True, shed_wake=False))
OUTER = 12  # NACA64
SPEED, STEP = 60.0, 0.01


def pitching(mean, amplitude, frequency, turns=4):
    """Angle, lift of the model and of the polar over the last of some turns."""
    states = np.zeros(SECTION_STATES)
    attack = mean + amplitude * np.sin(
        2 * np.pi * frequency * STEP * np.arange(round(turns / (frequency * STEP)))
    )
    static = np.array([polar(MODEL.lift, OUTER, a) for a in attack])
    lift = np.array(
        [
            section_coefficients(MODEL, OUTER, a, SPEED, 0.0, STEP if k else 0.0, states)[0]
            for k, a in enumerate(attack)
        ]
    )
    last = slice(-round(1 / (frequency * STEP)), None)
    return attack[last], lift[last], static[last]


def area(x, y):
    """Signed area of a loop, positive counter-clockwise."""
    return 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)


def test_lift_overshoots_on_the_way_up_and_stays_low_on_the_way_down():
    attack, lift, static = pitching(np.radians(14), np.radians(6), 1.0)
    rising = np.gradient(attack) > 0
    at_mean = np.abs(attack - np.radians(14)) < np.radians(1)
    assert lift[rising & at_mean].mean() > lift[~rising & at_mean].mean() + 0.1
    assert lift.max() > static.max() + 0.05
    # clockwise: lift lags less than it leads, and work is taken from a blade that plunges
    assert area(attack, lift) < 0


def test_attached_flow_has_no_loop():
    _, lift, static = pitching(np.radians(2), np.radians(2), 1.0)
    assert np.abs(lift - static).max() < 0.02


def test_slow_changes_follow_the_polar_and_fast_ones_the_slope_of_attached_flow():
    _, slow, static = pitching(np.radians(16), np.radians(2), 0.02, turns=2)
    assert np.abs(slow - static).max() < 0.05
    attack, fast, still = pitching(np.radians(16), np.radians(2), 5.0)
    steep, flat = (np.polyfit(attack, lift, 1)[0] for lift in (fast, still))
    assert steep > flat + 1.0
    assert steep > 0


def test_the_switch_is_off_by_default_and_acts_on_the_force():
    assert RotorOptions().dynamic_stall is None
    wake = np.zeros(SECTION_STATES)
    off = MODEL._replace(dynamic_stall=False)
    jump = (0.0, 15.0, 60.0, 0.0, 0.0)  # pitch, wind, induction
    section_force(MODEL, OUTER, 0.3, 15.0, 60.0, 0.0, 0.0, 0.0, wake)
    delayed = section_force(MODEL, OUTER, *jump, STEP, wake)[0]
    assert delayed > section_force(off, OUTER, *jump, STEP, np.zeros(SECTION_STATES))[0]


@pytest.mark.parametrize(("dlc", "wind", "on"), [("6.1", 50.0, True), ("1.1", 12.0, False)])
def test_by_default_a_rotor_that_stands_has_it_and_one_that_runs_has_not(dlc, wind, on):
    from loadflow.rotor import simulate

    def moment(stall):
        options = RotorOptions(dynamic_stall=stall)
        how = {"duration": 4.0, "run_in": 4.0, "yaw_error": 0.3, "rung": "flap"}
        return simulate(dlc=dlc, wind_speed=wind, options=options, **how)["hub_moment"].values

    assert np.array_equal(moment(None), moment(on))
    assert not np.allclose(moment(None), moment(not on), rtol=1e-6)


@pytest.mark.slow
def test_blades_that_stand_in_an_oblique_storm_swing_less():
    from loadflow.rotor import simulate

    tip = {}
    for stall in (False, True):
        series = simulate(
            dlc="6.1",
            wind_speed=50.0,
            yaw_error=np.radians(25.0),
            steady=True,
            duration=60.0,
            run_in=60.0,
            rung="tower",
            options=RotorOptions(dynamic_stall=stall),
        )
        tip[stall] = float(np.ptp(series["tip_deflection"].values))
    assert tip[True] < 0.6 * tip[False]
