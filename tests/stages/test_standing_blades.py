"""A rotor that stands in a storm: dynamic stall is on by itself, and a swing of its own is told."""

import numpy as np
import pytest
import xarray as xr

from loadflow.planning.plan import make_plan
from loadflow.rotor.standing import LEAST_SWING
from loadflow.scene import make_scene
from loadflow.scene.cases import list_cases
from loadflow.stages.loads import hub_loads, swing_doubt


def storm(yaw, **loads):
    return make_scene(
        {
            "results": ["loads.statistics"],
            "shaft": {"two_point": {}},
            "loads": {
                "dlc": "6.2",
                "steady": True,
                "yaw_errors": [yaw],
                "wind_speeds": [50.0],
                "duration": 40.0,
                "step": 0.05,
                **loads,
            },
        }
    )


def simulated(scene):
    return hub_loads(scene, list_cases(scene)[0], {})


def test_blades_that_an_oblique_storm_drives_are_told_and_others_are_not():
    wild = simulated(storm(0.26, dynamic_stall=False))
    calm = simulated(storm(0.1))
    assert "swing by themselves" in str(wild["doubts"].item())
    assert str(calm["doubts"].item()) == ""
    wild, calm = (float(one["tip_deflection"].std()) / 63.0 for one in (wild, calm))
    assert wild > 2 * LEAST_SWING
    assert calm < 0.5 * LEAST_SWING


def test_a_short_burst_of_swing_is_told_and_a_slow_bend_of_the_same_size_is_not():
    time = 0.05 * np.arange(12000)
    burst = np.exp(-(((time - 300) / 5) ** 2))
    for tip, told in (
        (0.8 * burst * np.sin(2 * np.pi * 1.1 * time), True),
        (0.8 * burst, False),
        (0.2 * burst * np.sin(2 * np.pi * 1.1 * time), False),
    ):
        series = xr.Dataset({"tip_deflection": ("time", tip)}, {"time": time}, {"event": "parked"})
        assert bool(swing_doubt(series, 63.0)) is told
        assert not swing_doubt(series.assign_attrs(event="none"), 63.0)


def test_a_plan_does_not_choose_the_stall_of_a_rotor_that_stands():
    plan = make_plan(storm(0.26))
    assert "dynamic stall" not in {one.name for one in plan.effects}
    assert plan.scene.loads.dynamic_stall is None
    assert not any("dynamic stall" in one for one in plan.shortfalls)


def test_a_stall_that_is_switched_off_there_is_counted():
    plan = make_plan(storm(0.26, dynamic_stall=False))
    assert any("dynamic stall" in one for one in plan.shortfalls)


@pytest.mark.parametrize("dlcs", [["1.1", "6.1"], ["1.1"]])
def test_where_some_rotor_runs_the_plan_chooses_and_standing_ones_keep_it(dlcs):
    scene = make_scene(
        {
            "results": ["loads.statistics"],
            "shaft": {"two_point": {}},
            "loads": {"dlc": dlcs, "seeds": 1, "duration": 60.0},
        }
    )
    plan = make_plan(scene)
    assert "dynamic stall" in {one.name for one in plan.effects}
    assert plan.scene.loads.dynamic_stall in (True, None)
