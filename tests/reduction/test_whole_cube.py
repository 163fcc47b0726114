"""Series are reduced with classes of their own or of the whole cube, or a part of them."""

import json

import numpy as np
import pytest
from synthetic import case
from typer.testing import CliRunner

from loadflow.cli import app
from loadflow.cube import make_cube, save_cube
from loadflow.errors import InputError
from loadflow.reduction import number_of_classes, read_parameter_file
from loadflow.studies.bearing_series import iter_bearings
from loadflow.studies.design_loads.reduced_series import reduce_cube
from loadflow.studies.design_loads.whole_cube import common_edges

CUBE = make_cube([case(wind, 1, steps=300) for wind in (8.0, 9.0, 11.0)])


def test_classes_of_the_whole_cube_hold_all_series_and_sum_to_one_histogram(tmp_path):
    made = reduce_cube(CUBE, tmp_path, grid="cube", bearings=["N"])
    files = [read_parameter_file(part.file) for part in made.parts]
    for one in files[1:]:
        np.testing.assert_array_equal(one.edges[0], files[0].edges[0])
        np.testing.assert_array_equal(one.edges[1], files[0].edges[1])
    whole = made.whole["N"]
    assert whole["counts_full"].shape == (number_of_classes(900),) * 2
    assert whole["counts_full"].sum() == 900
    # as one histogram of all pairs counts them
    pairs = [(s.speed, np.hypot(*s.radial.T)) for s in iter_bearings(CUBE, ["N"])]
    expected = np.histogram2d(*map(np.concatenate, zip(*pairs)), bins=files[0].edges)[0]
    np.testing.assert_array_equal(whole["counts_full"], expected)
    # no class that some series has is lost
    assert ((whole["counts_full"] > 0) == (whole["counts_reduced"] > 0)).all()
    kept = sum(part.kept for part in made.parts)
    assert int(whole["counts_reduced"].sum()) == kept
    own = reduce_cube(CUBE, tmp_path / "own", bearings=["N"])
    assert own.whole == {}
    assert own.parts[0].series["counts_full"].shape == (number_of_classes(300),) * 2


def test_classes_may_be_given():
    edges = common_edges(iter_bearings(CUBE), (4, 6))
    assert {name: (a.size, b.size) for name, (a, b) in edges.items()} == {
        "N": (5, 7), "N2": (5, 7)}  # fmt: skip


def test_a_part_of_each_series_is_reduced(tmp_path):
    time = CUBE["time"].values
    start, end = float(time[100]), float(time[200])
    made = reduce_cube(CUBE, tmp_path, between=(start, end), bearings=["N"])
    for part in made.parts:
        assert part.samples == 100
        kept = read_parameter_file(part.file).time
        assert start <= kept.min() <= kept.max() < end
    with pytest.raises(InputError, match="fewer than two samples"):
        reduce_cube(CUBE, tmp_path, between=(end, start))
    with pytest.raises(InputError, match="either a phase or"):
        reduce_cube(CUBE, tmp_path, between=(start, end), phase="operation")


def test_the_command_line_has_both(tmp_path):
    path = tmp_path / "cube.h5"
    save_cube(CUBE, path)
    words = ["reduce", str(path), "-o", str(tmp_path / "out"), "--grid", "cube", "--json"]
    found = json.loads(CliRunner().invoke(app, words).stdout)
    assert found["whole_cube"]["N"]["full"] == 900
    assert "all cases, bearing N" in (tmp_path / "out" / "reduction.html").read_text()
    part = [*words[:-1], "--between", "1", "2", "--json"]
    shorter = json.loads(CliRunner().invoke(app, part).stdout)
    assert shorter["whole_cube"]["N"]["full"] < 900
