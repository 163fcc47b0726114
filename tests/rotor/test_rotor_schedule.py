"""Lowest pitch scheduled over the wind, recognised by the power: IEA 15 MW below 7 m/s."""

import dataclasses

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rotor import simulate, steady_state
from loadflow.rotor.schedule import schedule_over_power
from loadflow.turbines import load_turbine

TURBINE = load_turbine("iea-15mw")
LOWEST_SPEED = 5.0 * np.pi / 30


def _unscheduled():
    control = dataclasses.replace(TURBINE.control, scheduled_wind=(), scheduled_pitch=())
    return dataclasses.replace(TURBINE, control=control)


def test_schedule_pitches_a_rotor_that_turns_too_fast_for_the_wind():
    # tip speed ratio 12.7 instead of 9: at fine pitch too much thrust and too little power
    ours, plain = (
        steady_state(t, wind_speed=5.0, shear=0.0, rung="tables").isel(wind_speed=0)
        for t in (TURBINE, _unscheduled())
    )
    assert float(ours["speed"]) == pytest.approx(LOWEST_SPEED, rel=0.02)
    expected = np.interp(5.0, TURBINE.control.scheduled_wind, TURBINE.control.scheduled_pitch)
    assert float(ours["pitch"]) == pytest.approx(expected, abs=1e-3)
    assert float(plain["pitch"]) == 0
    assert ours["power"] > 1.1 * plain["power"]
    assert ours["thrust"] < 0.9 * plain["thrust"]


def test_each_wind_of_the_schedule_is_recognised_by_the_published_power():
    # power coefficients that OpenFAST gives for this turbine, at the winds of the schedule
    published = [0.844e6, 1.318e6, 1.893e6, 2.591e6, 3.427e6, 4.393e6, 4.911e6]
    power, pitch = schedule_over_power(TURBINE)
    assert power[1:] == pytest.approx(published[1:], rel=0.02)
    assert power[0] == pytest.approx(published[0], rel=0.04)  # at the end of the schedule, 4 m/s
    assert tuple(pitch) == TURBINE.control.scheduled_pitch


def test_the_schedule_ends_where_the_power_is_rated():
    control = dataclasses.replace(
        TURBINE.control, scheduled_wind=(7.0, 9.0, 13.0, 15.0), scheduled_pitch=(0.02, 0.01, 0, 0)
    )
    power, pitch = schedule_over_power(dataclasses.replace(TURBINE, control=control))
    assert pitch == pytest.approx([0.02, 0.01])
    assert power[-1] < control.rated_mechanical_power


def test_schedule_follows_a_turbulent_wind_without_limiting_power():
    series = simulate(TURBINE, wind_speed=5.0, seed=1, duration=100.0, rung="tables")
    pitch = series["pitch"].values
    assert pitch.min() >= 0
    assert pitch.max() <= np.radians(3.44)
    assert np.abs(np.gradient(pitch, series["time"].values)).max() < np.radians(0.5)
    # torque by speed, not the constant power of region 3
    assert (series["generator_torque"] * series["speed"]).max() < 0.6 * TURBINE.rated_power


def test_above_its_last_power_the_schedule_leaves_fine_pitch():
    point = steady_state(TURBINE, wind_speed=8.0, shear=0.0, rung="tables")
    assert float(point["pitch"][0]) == 0


@pytest.mark.parametrize(
    ("change", "name"),
    [
        ({"scheduled_wind": (5.0, 4.0)}, "scheduled_wind"),
        ({"scheduled_wind": (-5.0, 4.0)}, "scheduled_wind"),
        ({"scheduled_wind": (5.0,), "scheduled_pitch": ()}, "scheduled_pitch"),
        ({"scheduled_wind": (5.0,), "scheduled_pitch": (-0.1,)}, "scheduled_pitch"),
    ],
)
def test_unsound_schedule_is_refused_by_name(change, name):
    with pytest.raises(InputError, match=name):
        dataclasses.replace(TURBINE.control, **change)
