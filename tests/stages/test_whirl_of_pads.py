"""Tilting pads in rotor dynamics: K and C belong to a frequency of vibration, which is told."""

import json

import numpy as np
import pandas as pd
import pytest
from synthetic import case, cube_file
from typer.testing import CliRunner

import loadflow as lf
from loadflow.cli import app
from loadflow.errors import InputError
from loadflow.planning.plan import make_plan
from loadflow.scene.scene import make_scene
from loadflow.scene.unused import unused_keys
from loadflow.stages import dynamics, shaft

HUB = case(8.0, 1, steps=60)
PADS = {"kind": "tilting pads", "count": 4, "arc": 1.2, "preload": 0.3}
LINE = {
    "name": "pads",
    "accuracy": "given",
    "results": ["journal.dynamics"],
    "shaft": {"two_point": {"beam": {}}},
    "journal": {
        "grid": [24, 8],
        "geometry": {"diameter": 2.0, "width": 1.2, "relative_clearance": 8e-4, "shape": PADS},
    },
}


def vibration(**asked):
    scene = make_scene(LINE | {"dynamics": {"points": 2, "modes": 3} | asked})
    inputs = {"loads": HUB, "shaft": shaft.bearing_loads(scene, None, {"loads": HUB})}
    return dynamics.dynamics(scene, None, inputs)


def test_a_mode_on_pads_is_the_one_on_pads_condensed_at_its_frequency():
    own, speed = vibration()["two_point"], float(HUB["speed"].mean())
    synchronous = vibration(whirl=1.0)["two_point"]
    for mode in range(3):
        frequency = float(own["natural_frequency"][mode])
        there = vibration(whirl=frequency / speed)["two_point"]
        for name in ("natural_frequency", "damping_ratio"):
            assert float(there[name][mode]) == pytest.approx(float(own[name][mode]), rel=1e-6)
    # the modes are many times as fast as the shaft turns, where pads hold it otherwise
    assert not np.allclose(own["damping_ratio"], synchronous["damping_ratio"], rtol=0.05)
    np.testing.assert_array_equal(own["vibration_frequency"], own["natural_frequency"])
    np.testing.assert_allclose(synchronous["vibration_frequency"], speed)


def test_the_response_to_unbalance_is_synchronous_whatever_the_modes_have():
    own, half = (
        vibration(unbalance=100.0, **more)["two_point"]["amplitude"]
        for more in ({}, {"whirl": 0.5})
    )
    np.testing.assert_allclose(half, own, rtol=1e-9)


@pytest.mark.parametrize(("asked", "end", "words"), [
    ({}, "", "Modes have K and C of their own frequencies"),
    ({"whirl": 0.5}, "_whirl_0.5", "vibration at 0.5 of the speed of the shaft. Marked"),
])  # fmt: skip
def test_a_run_says_of_which_vibration_its_coefficients_are(tmp_path, asked, end, words):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,))
    loads = {"source": "files", "files": [str(cube)]}
    result = lf.run(
        make_scene(LINE | {"loads": loads, "dynamics": {"points": 2} | asked}), out=tmp_path
    )
    assert result.failures == {}
    found = result.tree["dynamics"].to_dataset()
    assert float(found["whirl"].max()) == asked.get("whirl", 1.0)
    name = str(found["case"].values[0])
    table = pd.read_csv(result.path / f"coefficients/{name}_N{end}.csv")
    there = found.sel(bearing="N", case=name)
    assert table["cxx"][1] == pytest.approx(float(there["damping"][0, 0]), rel=1e-6)
    assert words in result.report.read_text(encoding="utf-8")


def test_the_plan_says_it_also_where_no_accuracy_is_stated():
    for asked, words in (({}, "own frequency"), ({"whirl": 0.5}, "0.5 of the speed")):
        scene = make_scene({**LINE, "accuracy": 0.05, "dynamics": asked})
        (step,) = (one for one in make_plan(scene).steps if one.name == "dynamics")
        assert words in step.rung


def test_a_ratio_for_bores_without_pads_is_said_to_do_nothing():
    fixed = LINE | {"journal": {"grid": [24, 8]}, "dynamics": {"whirl": 0.5}}
    assert "dynamics.whirl" in unused_keys(make_scene(fixed))
    assert "dynamics.whirl" not in unused_keys(make_scene(LINE | {"dynamics": {"whirl": 0.5}}))


def test_a_ratio_for_rollers_that_damp_in_proportion_is_said_to_do_nothing():
    rollers = {"name": "x", "results": ["rolling.dynamics"], "shaft": {"moment": {}}}
    for model, idle in (("proportional", True), ("dry", False)):
        scene = make_scene(rollers | {"dynamics": {"whirl": 0.5, "contact_model": model}})
        assert ("dynamics.whirl" in unused_keys(scene)) == idle


def test_the_command_line_condenses_pads_at_the_vibration_asked_for(tmp_path):
    line = ["journal", "--diameter=0.2", "--width=0.1", "--relative-clearance=1e-3", "--json"]
    line += ["--viscosity=0.03", "--force-x=8000", "--grid", "24", "8", "--speed-rpm=1000"]
    line += [f"--coefficients={tmp_path / 'film.csv'}"]
    pads = ["--set", 'geometry.shape={kind="tilting pads", count=4, arc=1.2}']
    rows = {}
    for whirl in ("1", "0.5"):
        answer = CliRunner().invoke(app, [*line, *pads, f"--whirl={whirl}"])
        assert answer.exit_code == 0, answer.output
        told = json.loads(answer.stdout)
        assert told["whirl"] == float(whirl)
        rows[whirl] = told["rows"][0]
    assert abs(rows["1"]["cxx"] / rows["0.5"]["cxx"] - 1) > 0.01
    for wrong in (["--whirl=0.5"], [*pads, "--whirl=0"]):
        assert isinstance(CliRunner().invoke(app, [*line, *wrong]).exception, InputError)
