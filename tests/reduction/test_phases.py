"""Phases of start-up, operation and stop."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.reduction import phases


def names(speed):
    return [phase.name for phase in phases(speed)]


def test_start_and_stop():
    ramp = np.linspace(0, 1.267, 100)
    hold = np.full(200, 1.267)
    start = phases(np.concatenate([np.zeros(50), ramp, hold]))
    assert [p.name for p in start] == ["standstill", "run-up", "operation"]
    assert start[1].start == 51  # the first value above 1 %
    assert start[1].stop == 50 + 90
    assert names(np.concatenate([hold, ramp[::-1], np.zeros(9)])) == [
        "operation",
        "run-down",
        "standstill",
    ]


def test_turbulent_operation_is_one_phase_and_a_cut_out_run_up_is_seen():
    rng = np.random.default_rng(0)
    assert names(1.2 + 0.1 * rng.standard_normal(1000)) == ["operation"]
    assert names(np.linspace(0.3, 1.0, 50)) == ["run-up", "operation"]
    assert names([0.0, 0.02, 0.0, 1.0]) == ["standstill", "part speed", "standstill", "operation"]
    assert names(np.zeros(5)) == ["standstill"]
    assert names(-np.linspace(0.3, 1.0, 50)) == ["run-up", "operation"]


@given(st.lists(st.floats(-2, 2), min_size=1, max_size=60))
def test_phases_leave_no_gap(speed):
    found = phases(speed)
    assert found[0].start == 0
    assert found[-1].stop == len(speed)
    assert all(a.stop == b.start for a, b in pairwise(found))
    assert all(p.start < p.stop for p in found)


def test_bad_input_is_named():
    for call, message in (
        (lambda: phases([]), r"shape \(0,\)"),
        (lambda: phases([1.0, np.nan]), "speed is nan"),
        (lambda: phases([1.0], still=0.95), "still = 0.95, operating = 0.9"),
    ):
        with pytest.raises(InputError, match=message):
            call()
