"""A scene of HAWC2 or Bladed files runs through to its report, and finds what the cube finds."""

from pathlib import Path

import numpy as np
import pytest
from test_readers_bladed import HUB, write_group
from test_readers_hawc2 import CHANNELS, write

import loadflow as lf
from loadflow.cube import open_cube
from loadflow.scene import make_scene

CUBE = Path(__file__).parents[2] / "data" / "synthetic" / "dlc_1_1.h5"
NAME, STEM = "dlc1.1_v12_s1", "dlc11_v12_s1"


def series():
    return open_cube(CUBE).sel(case=NAME).load()


def as_hawc2(folder):
    hub = series()
    fx, fy, fz = hub["hub_force"].transpose("axis", "time").values.astype(float) / 1e3
    mx, my, mz = hub["hub_moment"].transpose("axis", "time").values.astype(float) / 1e3
    time = hub["time"].values + 100.0
    columns = [time, hub["speed"], np.full(time.size, 12.0), fy, -fz, -fx, my, -mz, -mx]
    write(folder / STEM, binary=False, values=np.column_stack(columns))
    return {"files": [str(folder / f"{STEM}.sel")], "channels": CHANNELS}


def as_bladed(folder):
    hub = series()
    force, moment = (
        hub[name].transpose("time", "axis").values.astype(float)
        for name in ("hub_force", "hub_moment")
    )
    step, stem = float(hub["time"][1]), folder / STEM
    write_group(
        stem, "23", HUB, ["FL"] * 3 + ["F"] * 3, np.column_stack([moment, force]), step=step
    )
    drive = np.column_stack([hub["speed"], hub["azimuth"]])
    write_group(stem, "05", ["Rotor speed", "Rotor azimuth angle"], ["A/T", "A"], drive, step=step)
    return {"files": [str(folder / f"{STEM}.%23")]}


def as_cube(folder):
    path = folder / "one.h5"
    lf.cube.save_cube(lf.cube.make_cube([series()]), path)
    return {"files": [str(path)]}


def found(folder, told):
    scene = make_scene(
        {
            "name": "run",
            "accuracy": "given",
            "results": ["loads.statistics", "journal.film", "rolling.life"],
            "loads": {"source": "files"} | told,
            "shaft": {"two_point": {}},
            "bearings": {
                "N": {"kind": "journal", "rung": "reduced"},
                "N2": {
                    "kind": "spherical",
                    "geometry": {
                        "rollers": 28, "roller_diameter": 0.09, "roller_length": 0.12,
                        "pitch_diameter": 1.1, "contact_angle": 0.15,
                    },
                },
            },
        }
    )  # fmt: skip
    return lf.run(scene, out=folder / "out")


@pytest.mark.parametrize("program", [as_hawc2, as_bladed])
def test_files_of_programs_run_through_as_the_cube_does(program, tmp_path):
    (tmp_path / "known").mkdir()
    known = found(tmp_path / "known", as_cube(tmp_path / "known"))
    run = found(tmp_path, program(tmp_path))
    assert run.failures == {}
    assert "Verdicts" in run.report.read_text(encoding="utf-8")
    for group, name in (
        ("journal", "largest_eccentricity_ratio"),
        ("journal", "mean_friction_power"),
        ("rolling", "bearing_life"),
        ("energy", "rotor_power"),
    ):
        ours, theirs = (np.ravel(one.tree[group][name].values) for one in (run, known))
        np.testing.assert_allclose(ours, theirs, rtol=2e-4, err_msg=f"{group} {name}")
