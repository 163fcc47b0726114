"""Airfoils in flow that changes: parameters, steady limits, steps, oscillations, turns."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numba import njit
from rotor_sections import section_coefficients

from loadflow.errors import InputError
from loadflow.rotor.aero._airfoil_kernels import SECTION_STATES, angle_of, polar
from loadflow.rotor.airfoils import potential_flow, separation
from loadflow.rotor.machine import machine
from loadflow.rotor.options import RotorOptions
from loadflow.turbines import load_turbine

TURBINE = load_turbine("nrel-5mw")
# potential flow found in the polars, not stated beside them
FOUND = dataclasses.replace(
    TURBINE,
    airfoils={
        name: dataclasses.replace(foil, zero_lift=None, lift_slope=None)
        for name, foil in TURBINE.airfoils.items()
    },
)
MACHINE = machine(FOUND, RotorOptions(modes=()))
STATED = machine(TURBINE, RotorOptions(modes=()))
OUTER = 13  # NACA 64-618 at 52.75 m
SPEED, STEP = 60.0, 0.005
HALF_CHORDS = 2 * SPEED * STEP / MACHINE.chord[OUTER]  # travelled in one step


def _series(attack, section=OUTER, model=MACHINE, turn=0.0):
    states = np.zeros(SECTION_STATES)
    return np.array(
        [
            section_coefficients(model, section, a, SPEED, turn, STEP if k else 0.0, states)
            for k, a in enumerate(attack)
        ]
    )


def test_potential_flow_is_found_in_the_polar():
    flow = potential_flow(FOUND.airfoils["NACA64"])
    assert np.degrees(flow.zero) == pytest.approx(-3.84, abs=0.01)  # −0.017 at −4°, 0.088 at −3°
    assert flow.slope == pytest.approx(6.6, rel=0.01)  # 0.213 at −2°, 0.328 at −1°
    assert flow.friction == pytest.approx(0.0071, abs=1e-4)
    assert potential_flow(FOUND.airfoils["cylinder1"]) == (0.0, 0.0, 0.0)


def test_potential_flow_that_a_file_states_is_taken():
    flow = potential_flow(TURBINE.airfoils["NACA64"])
    assert (np.degrees(flow.zero), flow.slope) == (pytest.approx(-4.432), 6.635)
    assert flow.friction == potential_flow(FOUND.airfoils["NACA64"]).friction


@pytest.mark.parametrize("turbine", ["iea-15mw", "windpact-1.5mw"])
def test_steady_lift_is_the_polar_where_nothing_is_stated(turbine):
    # the polars of the WindPACT drop by half their slope's worth 2° below zero lift
    model = machine(load_turbine(turbine), RotorOptions(modes=()))
    angle = np.radians(np.arange(-40.0, 40.1, 0.5))
    for i, slope in enumerate(model.lift_slope):
        if slope > 0:
            assert slope < 9
            lift = [
                section_coefficients(model, i, a, SPEED, 0.0, 0.0, np.zeros(5))[0] for a in angle
            ]
            assert lift == pytest.approx([polar(model.lift, i, a) for a in angle], abs=1e-9)


@pytest.mark.parametrize(("key", "value"), [("zero_lift", 0.5), ("lift_slope", 0.1)])
def test_stated_potential_flow_out_of_range_is_refused(key, value):
    with pytest.raises(InputError, match=key):
        dataclasses.replace(TURBINE.airfoils["NACA64"], **{key: value})


@settings(deadline=None, max_examples=100)
@given(st.floats(-179.0, 179.0), st.integers(0, 16), st.booleans())
def test_steady_flow_has_lift_and_drag_of_the_polars(degrees, section, stall):
    model = MACHINE._replace(dynamic_stall=stall)
    attack = np.radians(degrees)
    lift, drag = _series(np.full(400, attack), section, model)[-1]
    assert lift == pytest.approx(polar(MACHINE.lift, section, attack), abs=0.02)
    assert drag == pytest.approx(polar(MACHINE.drag, section, attack), abs=1e-6)


def test_lift_near_zero_is_flatter_where_the_stated_potential_flow_has_another_zero():
    low, high = np.radians([-6.0, -2.0])
    (below, _), (above, _) = _series([low], model=STATED)[0], _series([high], model=STATED)[0]
    polars = [polar(STATED.lift, OUTER, a) for a in (low, high)]
    assert (above - below) / (polars[1] - polars[0]) == pytest.approx(0.83, abs=0.02)
    for degrees in (-3.0, 0.0, 5.0, 10.0, 20.0):
        lift = _series([np.radians(degrees)], model=STATED)[0, 0]
        assert lift == pytest.approx(polar(STATED.lift, OUTER, np.radians(degrees)), abs=1e-9)


def test_lift_after_a_step_grows_as_the_shed_wake_leaves():
    # 1 − 0.3 exp(−0.14 s) − 0.7 exp(−0.53 s) of the change, s in half chords
    before, after = np.radians(1.0), np.radians(3.0)
    lift = _series(np.r_[before, np.full(800, after)])[:, 0]
    travelled = (np.arange(1, 801) - 0.5) * HALF_CHORDS  # the angle rises during the first step
    grown = 1 - 0.3 * np.exp(-0.14 * travelled) - 0.7 * np.exp(-0.53 * travelled)
    share = (lift[1:] - lift[0]) / (lift[-1] - lift[0])
    assert share == pytest.approx(grown, abs=0.01)


@pytest.mark.parametrize("reduced", [0.01, 0.03, 0.1])
def test_oscillating_lift_has_the_amplitude_and_phase_of_theory(reduced):
    amplitude = np.radians(0.5)
    rate = 2 * SPEED * reduced / MACHINE.chord[OUTER]
    time = np.arange(0, 8 * 2 * np.pi / rate, STEP)
    lift = _series(np.radians(2.0) + amplitude * np.sin(rate * time))[:, 0]
    last = time > time[-1] - 2 * 2 * np.pi / rate
    wave = np.exp(-1j * rate * time[last])
    got = 2j * np.mean((lift[last] - lift[last].mean()) * wave) / amplitude
    k = 1j * reduced
    theory = np.degrees(0.114) * (1 - 0.3 * k / (k + 0.14) - 0.7 * k / (k + 0.53))
    assert abs(got) == pytest.approx(abs(theory), rel=0.02)
    assert np.degrees(np.angle(got / theory)) == pytest.approx(0, abs=0.5)


def test_a_section_that_turns_nose_up_meets_the_flow_at_three_quarters_of_its_chord():
    attack, turn = np.radians(2.0), 0.2
    half = 0.5 * MACHINE.chord[OUTER] / SPEED
    still, turning = (_series(np.full(400, attack), turn=t)[-1, 0] for t in (0.0, turn))
    expected = (np.degrees(0.114) + np.pi) * half * turn
    assert turning - still == pytest.approx(expected, rel=0.02)


@settings(deadline=None, max_examples=50)
@given(st.lists(st.floats(-180.0, 180.0), min_size=2, max_size=40), st.floats(-0.5, 0.5))
def test_any_angles_in_any_order_give_finite_coefficients(degrees, turn):
    series = _series(np.radians(degrees), model=STATED._replace(dynamic_stall=True), turn=turn)
    assert np.isfinite(series).all()
    assert np.abs(series).max() < 10


@pytest.mark.parametrize("name", sorted(TURBINE.airfoils))
def test_flow_is_attached_around_zero_lift_and_separated_far_from_it(name):
    angle = np.radians(np.arange(-180, 180.5, 0.5))
    foil = FOUND.airfoils[name]
    flow = potential_flow(foil)
    split = separation(foil, flow, angle)
    lift = np.interp(angle, foil.angle, foil.lift)
    assert np.all((split.attached >= 0) & (split.attached <= 1))
    assert np.all(split.attached[np.abs(angle) > np.radians(60)] == 0)
    again = split.attached * flow.slope * (angle - flow.zero)
    again += (1 - split.attached) * split.separated
    assert again == pytest.approx(lift, abs=0.02)
    if not name.startswith("cylinder"):
        usual = (angle > np.radians(2)) & (angle < np.radians(7))
        assert split.attached[usual].min() > 0.5
        # where the flow is attached, separation would halve the lift
        firm = (split.attached > 0.999) & (angle > np.radians(1))
        assert split.separated[firm] == pytest.approx(0.5 * lift[firm], rel=0.03)


def test_angles_are_those_of_arctan2_in_all_directions():
    @njit
    def angles(up, along, out):
        for k in range(up.size):
            out[k] = angle_of(up[k], along[k])

    turn = np.concatenate([np.linspace(-np.pi, np.pi, 4001), np.geomspace(1e-300, 1e-3, 50)])
    length = np.geomspace(1e-5, 1e5, turn.size)
    up, along = length * np.sin(turn), length * np.cos(turn)
    up[:3], along[:3] = (0.0, 0.0, 2.0), (0.0, -2.0, 0.0)
    found = np.full(turn.size, np.nan)
    angles(up, along, found)
    assert np.abs(found - np.arctan2(up, along)).max() < 1e-12
