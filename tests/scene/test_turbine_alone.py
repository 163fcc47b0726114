"""A windIO file on the command line in place of a scene: the loads of its turbine."""

import importlib.resources
import json

import pytest
from typer.testing import CliRunner

import loadflow as lf
from loadflow.cli import app
from loadflow.errors import InputError


@pytest.fixture(scope="module")
def file():
    pytest.importorskip("windIO")
    return importlib.resources.files("windIO") / "examples" / "turbine" / "IEA-15-240-RWT.yaml"


def answered(*line):
    found = CliRunner().invoke(app, list(map(str, line)))
    assert found.exit_code == 0, found.output
    return found.output


def test_the_scene_of_a_turbine_file_has_its_turbine_and_no_bearing_that_nobody_stated(file):
    scene = lf.read_scene(file)
    assert scene.name == "IEA-15-240-RWT"
    assert scene.turbine.name == str(file)
    assert not any(scene.wants(room) for room in ("journal", "thrust", "rolling", "friction"))
    assert "valid" in answered("scene", file)


def test_a_plan_of_a_turbine_file_simulates_its_loads(file):
    plan = json.loads(answered("plan", file, "--json"))
    steps = {step["stage"] for step in plan["steps"]}
    assert {"loads", "shaft", "statistics"} <= steps
    assert not {"journal", "thrust", "rolling"} & steps


def test_the_scene_shown_of_a_turbine_file_is_one_to_go_on_with(file, tmp_path):
    shown = tmp_path / "own.toml"
    shown.write_text(answered("scene", file, "--show"), encoding="utf-8")
    assert lf.read_scene(shown) == lf.read_scene(file)


def test_a_comparison_of_a_turbine_file_says_how_to_state_candidates(file, tmp_path):
    with pytest.raises(InputError, match=r"candidates\.NAME\.PLACE.*loadflow scene --show"):
        CliRunner().invoke(
            app, ["compare", str(file), "--out", str(tmp_path)], catch_exceptions=False
        )


def test_a_file_of_yaml_that_is_no_turbine_is_refused(tmp_path):
    pytest.importorskip("yaml")
    (tmp_path / "farm.yaml").write_text("name: farm\nhub_height: 150.0\n")
    with pytest.raises(InputError, match="windIO_version"):
        lf.read_scene(tmp_path / "farm.yaml")
