"""A case that trips on overspeed says so, and only such a case."""

import dataclasses

import numpy as np
import pytest

from loadflow.rotor import simulate
from loadflow.rotor.control.constants import STATES
from loadflow.turbines import load_turbine

SOUND = load_turbine("nrel-5mw")
TOUCHY = dataclasses.replace(
    SOUND, supervision=dataclasses.replace(SOUND.supervision, overspeed=1.04)
)
"""It trips wherever turbulence takes the speed to 1.04 of rated."""


def tripped(turbine, dlc="1.1", run_in=5.0, duration=40.0, **more):
    wanted = {"wind_speed": 18, "seed": 1, "rung": "tables", **more}
    series = simulate(turbine, dlc=dlc, run_in=run_in, duration=duration, **wanted)
    return series.attrs["tripped"], series


def test_the_time_is_that_at_which_the_state_run_ends():
    time, series = tripped(TOUCHY)
    left = series["state"].values != STATES.index("run")
    assert left.any()
    assert not left.all()
    assert time == pytest.approx(float(series["time"][np.argmax(left)]))
    assert STATES[int(series["state"].values[np.argmax(left)])] == "fault"


@pytest.mark.parametrize("dlc", ["1.1", "2.1", "5.1"])
def test_a_trip_in_the_run_in_is_told_as_zero_whatever_should_happen_later(dlc):
    time, series = tripped(TOUCHY, dlc, run_in=40.0, event_time=10.0)
    assert time == 0.0
    assert STATES[int(series["state"].values[0])] in ("fault", "park")


def test_a_turbine_that_runs_through_has_not_tripped():
    time, series = tripped(SOUND)
    assert np.isnan(time)
    assert (series["state"] == STATES.index("run")).all()


@pytest.mark.parametrize(
    "event", ["start", "stop", "emergency stop", "grid loss", "blade stuck", "pitch runaway"]
)
def test_what_a_load_case_asks_for_is_no_trip(event):
    dlc = "3.1" if event == "start" else "4.1"
    time, series = tripped(SOUND, dlc, event=event, event_time=5.0, wind_speed=14)
    assert np.isnan(time)
    assert np.unique(series["state"]).size > 1


@pytest.mark.slow
def test_extreme_turbulence_at_high_wind_can_trip():
    """A standing turbine for 589 of 600 s: this one load case is known for it."""
    time, series = tripped(
        SOUND, "1.3", run_in=60.0, duration=600.0, wind_speed=24, category="A", seed=5, rung="tower"
    )
    assert 5.0 < time < 20.0
    assert float(abs(series["speed"])[-1]) < 0.01
