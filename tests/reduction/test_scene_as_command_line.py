"""A scene's keys `between` and `grid` keep the samples that `loadflow reduce` keeps of the cube."""

import json

import numpy as np
import pytest
import xarray as xr
from synthetic import case
from typer.testing import CliRunner

from loadflow.cli import app
from loadflow.cube import make_cube, save_cube
from loadflow.errors import InputError
from loadflow.reduction import number_of_classes, read_parameter_file
from loadflow.running.runner import run
from loadflow.scene.scene import make_scene
from loadflow.scene.unused import unused_keys
from loadflow.stages.kept_samples import stretch

WINDS = (8.0, 9.0, 11.0)


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    path = tmp_path_factory.mktemp("cube") / "cube.h5"
    save_cube(make_cube([case(wind, 1, steps=300) for wind in WINDS]), path)
    return path


def scene_of(cube, reduction, results=("reduction.histogram",), **more):
    data = {"name": "keys", "accuracy": "given", "results": [*results]}
    data |= {"loads": {"files": [str(cube)]}, "shaft": {"two_point": {}}, "reduction": reduction}
    return make_scene(data | more)


def ran(folder, scene, stage="reduction"):
    """What a stage gives in a run, by case."""
    run(scene, out=folder, report=False)
    found = {}
    for file in sorted((folder / "keys" / stage).glob("*.h5")):
        with xr.open_datatree(file, engine="h5netcdf") as tree:
            found[file.stem] = tree.load()
    assert len(found) == len(WINDS)
    return found


@pytest.mark.parametrize(
    ("words", "keys"),
    [
        (["--grid", "cube"], {"grid": "cube"}),
        (["--between", "20", "50"], {"between": [20.0, 50.0]}),
        (
            ["--grid", "cube", "--between", "20", "50", "--classes", "6", "6"],
            {"grid": "cube", "between": [20.0, 50.0], "classes": 6},
        ),
    ],
)
def test_a_scene_keeps_the_samples_that_the_command_line_keeps(cube, tmp_path, words, keys):
    command = ["reduce", str(cube), "-o", str(tmp_path / "cli"), "--json", *words]
    parts = json.loads(CliRunner().invoke(app, command).stdout)["series"]
    trees = ran(tmp_path / "run", scene_of(cube, keys))
    full = make_cube([case(wind, 1, steps=300) for wind in WINDS])["time"].values
    assert len(parts) == 2 * len(WINDS)
    for part in parts:
        theirs = read_parameter_file(part["file"])
        ours = trees[part["case"]][part["bearing"]].to_dataset()
        np.testing.assert_array_equal(ours["time"], theirs.time)
        np.testing.assert_array_equal(full[ours["index"].values], theirs.time)
        np.testing.assert_array_equal(ours["weight"], theirs.weight)
        np.testing.assert_array_equal(ours["counts_full"], theirs.counts_full)
        # the scene keeps loads in single precision
        for name, edges in zip(("speed_edges", "load_edges"), theirs.edges):
            np.testing.assert_allclose(ours[name], edges, rtol=1e-6)


def test_cases_of_a_cube_share_their_classes(cube, tmp_path):
    trees = [tree["N"] for tree in ran(tmp_path, scene_of(cube, {"grid": "cube"})).values()]
    assert trees[0]["counts_full"].shape == (number_of_classes(900),) * 2
    for tree in trees[1:]:
        np.testing.assert_array_equal(tree["speed_edges"], trees[0]["speed_edges"])
        np.testing.assert_array_equal(tree["load_edges"], trees[0]["load_edges"])


def test_films_are_those_of_the_times_that_are_wanted(cube, tmp_path):
    keys = {"grid": "cube", "between": [20.0, 50.0], "size": 0.02, "classes": 2}
    films = ran(
        tmp_path, scene_of(cube, keys, ["journal.film"], journal={"grid": [24, 8]}), "journal"
    )
    for tree in films.values():
        time = tree["N"]["time"].values
        assert 20.0 <= time.min() <= time.max() < 50.0
        assert (tree["N"]["converged"].values > 0).any()


def test_thrust_bearings_take_the_same_times_and_classes(cube, tmp_path):
    collar = {"pads": 12, "inner_radius": 0.8, "outer_radius": 1.2, "pad_angle": 0.45,
              "taper": 1e-4}  # fmt: skip
    thrust = {"bearings": {"N2": {"kind": "thrust", "geometry": collar, "grid": [12, 6]}}}
    keys = {"between": [20.0, 50.0], "size": 0.02, "classes": 2}
    times = {}
    for grid in ("each", "cube"):
        scene = scene_of(cube, keys | {"grid": grid}, ["thrust.film"], thrust=thrust)
        trees = ran(tmp_path / grid, scene, "thrust")
        times[grid] = [tree["N2"]["time"].values for tree in trees.values()]
        assert all(20.0 <= time.min() <= time.max() < 50.0 for time in times[grid])
    assert any(not np.array_equal(*pair) for pair in zip(times["each"], times["cube"]))


def test_times_and_cubes_that_are_not_there_are_refused(cube, tmp_path):
    with pytest.raises(InputError, match="the second must be the larger one"):
        scene_of(cube, {"between": [50.0, 20.0]})
    with pytest.raises(InputError, match=r"did you mean.*between"):
        scene_of(cube, {"betwen": [20.0, 50.0]})
    simulated = {"name": "s", "loads": {"wind_speeds": [12.0], "duration": 30.0}}
    with pytest.raises(InputError, match=r"reduction\.grid = .cube.*loads\.files"):
        make_scene(simulated | {"reduction": {"grid": "cube"}})
    with pytest.raises(InputError, match=r"reduction\.between.*30 s"):
        make_scene(simulated | {"reduction": {"between": [30.0, 40.0]}})
    with pytest.raises(InputError, match="fewer than two samples; the series runs from 0 to"):
        run(scene_of(cube, {"between": [500.0, 600.0]}), out=tmp_path)
    with pytest.raises(InputError, match="fewer than two samples"):
        stretch(np.arange(3.0), (0.5, 1.5), "three samples")


def test_other_methods_and_films_in_motion_say_that_they_read_neither(cube):
    keys = {"between": [20.0, 50.0], "grid": "cube"}
    told = unused_keys(scene_of(cube, keys | {"method": "stationary"}))
    assert {"reduction.between", "reduction.grid"} <= {*told}
    motion = {"grid": [24, 8], "motion": "transient", "rung": "reduced"}
    told = unused_keys(scene_of(cube, keys, ["journal.film"], journal=motion))
    assert {"reduction.between", "reduction.grid"} <= {*told}
