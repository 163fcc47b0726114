"""Starts and stops of series whose revolutions, time and energy in mixed friction are known.

The film parts the surfaces in proportion to the speed, ε = 1 − |ω|/10 with ω in rad/s: it is mixed
below 0.5 rad/s.
"""

import math

import numpy as np
import pytest
import xarray as xr

from loadflow.stages.films.summary import mixed_friction

STEP = 1e-3  # s; sums of samples are integrals within a step
LOST = 100.0  # W s/rad times the speed


def told(*corners):
    """What is told of a series of speeds that is straight between (time, speed)."""
    when, speeds = np.array(corners, dtype=float).T
    time = np.arange(0.0, when[-1] + 0.5 * STEP, STEP)
    speed = np.interp(time, when, speeds)
    return of_series(time, speed, 1.0 - 0.1 * np.abs(speed))


def of_series(time, speed, ratio):
    columns = {
        "time": time,
        "speed": speed,
        "eccentricity_ratio": ratio,
        "weight": np.ones(time.size),
        "load": np.full(time.size, 1e6),
        "in_contact": np.zeros(time.size, dtype=bool),
        "friction_power": LOST * np.abs(speed),
    }
    about = {"critical_eccentricity_ratio": 0.95, "boundary_friction": 0.1, "radius": 0.7}
    found = mixed_friction(xr.Dataset({k: ("sample", v) for k, v in columns.items()}, attrs=about))
    return {name: float(value) for name, value in found.items()}


def ramps(found, count, standing=math.inf):
    """Time, angle and energy of so many ramps of 1 rad/s², of 0.5 s below the critical speed."""
    assert found["mixed_friction_time"] == pytest.approx(0.5 * count, abs=0.03 * count)
    turns = found["mixed_friction_revolutions"] * 2 * np.pi
    assert turns == pytest.approx(0.125 * count, rel=0.01)
    assert found["mixed_friction_energy"] == pytest.approx(LOST * turns, rel=1e-9)
    assert found["standstill_time"] == pytest.approx(standing, abs=0.02, nan_ok=True)


def test_one_stop_is_told_to_the_last_sample():
    found = told((0, 1), (2, 1), (3, 0))
    ramps(found, 1, standing=3.0)
    assert found["transition_time"] == pytest.approx(2.5, abs=1e-6)
    assert found["transition_speed"] == pytest.approx(0.5, abs=1e-6)
    assert found["film_after_stop"] == pytest.approx(-0.5, abs=0.02)


def test_a_start_from_the_first_sample_has_its_transition():
    found = told((0, 0), (1, 1), (3, 1))
    ramps(found, 1, standing=math.nan)
    assert found["transition_time"] == pytest.approx(0.5, abs=1e-6)


def test_every_stop_and_start_of_a_series_is_counted():
    one = ((0, 1), (1, 0), (2, 0), (3, 1))
    more = [(3 * k + time, speed) for k in range(3) for time, speed in one]
    ramps(told(*dict.fromkeys([*more, (10, 1), (11, 0), (12, 0)])), 7, standing=11.0)


def test_a_shaft_that_starts_and_stops_comes_to_a_stand():
    found = told((0, 0), (1, 1), (2, 1), (3, 0), (5, 0))
    ramps(found, 2, standing=3.0)
    assert math.isnan(found["transition_time"])  # it begins and ends above it


def test_a_shaft_that_never_turns_comes_to_no_stand():
    found = told((0, 0), (5, 0))
    assert math.isnan(found["standstill_time"])
    assert found["mixed_friction_time"] == found["mixed_friction_energy"] == 0.0


def test_a_shaft_that_turns_backwards_or_reverses_counts_as_one_that_does_not():
    ramps(told((0, -1), (1, 0), (2, 0)), 1, standing=1.0)
    ramps(told((0, 1), (2, -1), (3, -1)), 2, standing=math.nan)


def test_a_speed_about_the_critical_one_is_mixed_half_of_the_time():
    time = np.arange(0.0, 10.0, STEP)
    speed = 0.5 + 0.1 * np.sin(2 * np.pi * time)
    found = of_series(time, speed, 1.0 - 0.1 * speed)
    assert found["mixed_friction_time"] == pytest.approx(5.0, abs=10 * STEP)  # ten times below it
    turned = 5.0 * (0.5 - 0.2 / np.pi)
    assert found["mixed_friction_revolutions"] == pytest.approx(turned / (2 * np.pi), rel=2e-3)
    assert math.isnan(found["standstill_time"])
