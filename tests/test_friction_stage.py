"""Friction of rolling bearings as a result of a scene, beside that of journal bearings."""

import numpy as np
import pytest

import loadflow as lf
from loadflow.errors import InputError
from loadflow.planning.plan import make_plan
from loadflow.scene.scene import make_scene


def short(**sections):
    loads = {"wind_speeds": [12.0], "seeds": 1, "duration": 12.0, "step": 0.05, "rung": "tables"}
    return make_scene(
        {"name": "short", "results": ["rolling.friction"], "loads": loads, **sections}
    )


def test_friction_needs_the_series_and_no_reduction():
    plan = make_plan(short())
    assert [step.name for step in plan.steps] == ["loads", "shaft", "friction"]
    assert plan.steps[-1].rung == "balls, every 0.1 s"
    rollers = make_plan(short(rolling={"arrangement": "two-spherical"}))
    assert rollers.steps[-1].rung == "rollers, every 0.1 s"


def test_rollers_of_both_bearings_are_followed(tmp_path):
    scene = short(
        rolling={"arrangement": "two-spherical"},
        shaft={"two_point": {}},
        results=["journal.film", "rolling.friction"],
    )
    run = lf.run(scene, out=tmp_path)
    assert run.failures == {}
    table = run.tree["friction"].to_dataset()
    assert list(table["bearing"].values) == ["N", "N2"]
    assert (table["mean_friction_power"] > 0).all()
    assert (table["mean_friction_power"] < run.tree["journal"]["mean_friction_power"]).all()
    assert float(table["mean_slip"].sel(bearing="N2").max()) > 0.1  # thrust unloads a row
    assert "Friction of rolling bearings" in run.report.read_text(encoding="utf-8")


def test_balls_of_the_moment_bearing_roll_ideally(tmp_path):
    run = lf.run(short(), out=tmp_path, report=False)
    table = run.tree["friction"].to_dataset()
    assert (table["mean_friction_torque"] > 0).all()
    assert (table["mean_slip"] == 0).all()
    assert np.isfinite(table["median_film_parameter"]).all()


def test_an_unknown_lubricant_is_refused_with_those_there_are():
    with pytest.raises(InputError, match=r"friction\.lubricant.*lgep-2"):
        short(friction={"lubricant": "butter"})


def test_a_bearing_without_a_model_is_a_failure_with_its_name(tmp_path):
    scene = short(
        rolling={"geometry": {
            "kind": "crossed", "rollers": 100, "roller_diameter": 0.03, "roller_length": 0.03,
            "pitch_diameter": 1.9, "contact_angle": np.pi / 4,
        }},
    )  # fmt: skip
    run = lf.run(scene, out=tmp_path, report=False)
    assert any("no model of friction" in reason for reason in run.failures.values())
