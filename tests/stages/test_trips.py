"""A run tells of the cases that tripped: its warnings, its report, its cubes."""

import math
from importlib.resources import files

import pytest

import loadflow as lf
from loadflow.cube import open_cube, save_cube
from loadflow.scene.scene import make_scene
from loadflow.stages.loads import trip_warnings
from loadflow.studies.simulated_cube import simulate_cube

SHORT = {"duration": 4.0, "step": 0.05, "seeds": 1, "rung": "tables"}


@pytest.fixture(scope="module")
def touchy(tmp_path_factory):
    """A turbine that trips at 1.04 of the rated speed: at 18 m/s in the run-in, never at 6."""
    text = (files("loadflow.turbines") / "nrel-5mw.toml").read_text(encoding="utf-8")
    assert "overspeed = 1.2 " in text
    path = tmp_path_factory.mktemp("turbine") / "touchy.toml"
    path.write_text(text.replace("overspeed = 1.2 ", "overspeed = 1.04 "), encoding="utf-8")
    return str(path)


@pytest.fixture(scope="module")
def run(touchy, tmp_path_factory):
    scene = make_scene(
        {
            "name": "trips",
            "results": ["loads.statistics"],
            "turbine": {"name": touchy},
            "loads": {"wind_speeds": [6.0, 18.0], **SHORT},
        },
        source="test",
    )
    return lf.run(scene, out=tmp_path_factory.mktemp("runs"))


def test_a_run_warns_of_the_case_and_the_time(run):
    (warning,) = (said for said in run.warnings if "tripped on overspeed" in said)
    assert "dlc1.1_v18_s1 in the run-in" in warning
    assert "v6" not in warning


def test_the_results_and_the_report_hold_the_times(run):
    times = run.tree["loads"].to_dataset()["tripped"]
    assert times.attrs["units"] == "s"
    assert math.isnan(times.sel(case="dlc1.1_v6_s1"))
    assert float(times.sel(case="dlc1.1_v18_s1")) == 0.0
    page = run.report.read_text(encoding="utf-8")
    assert "Tripped on overspeed" in page
    assert "tripped" not in run.tree["statistics"].to_dataset().variables


def test_a_cube_keeps_the_times_and_a_run_that_reads_it_warns_too(touchy, tmp_path):
    settings = {"dlc": ["1.1"], **SHORT}
    cube = simulate_cube(touchy, [6.0, 18.0], [1], settings)
    path = save_cube(cube, tmp_path / "loads.h5")
    assert open_cube(path)["tripped"].dims == ("case",)
    scene = make_scene(
        {"name": "read", "results": ["loads.statistics"], "loads": {"files": [str(path)]}},
        source="test",
    )
    (warning,) = lf.run(scene, out=tmp_path, report=False).warnings
    assert "dlc1.1_v18_s1 in the run-in" in warning


def test_times_are_told_in_seconds_and_without_trips_nothing_is():
    assert trip_warnings({}) == []
    (told,) = trip_warnings({"dlc1.3_v24_s5": 10.625, "dlc1.3_v22_s1": 0.0})
    assert "dlc1.3_v24_s5 at 10.6 s, dlc1.3_v22_s1 in the run-in" in told
