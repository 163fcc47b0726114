"""Stiffness and damping of films, and the shaft line on them, from scene and command line."""

import io
import json

import numpy as np
import pandas as pd
import pytest
from synthetic import case, cube_file
from typer.testing import CliRunner

import loadflow as lf
from loadflow.cli import app
from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Film,
    Guembel,
    JournalBearing,
    Lubricant,
    TiltingPads,
    coefficient_table,
    rotor_coefficients,
)
from loadflow.planning.plan import make_plan
from loadflow.scene.scene import make_scene
from loadflow.stages import dynamics, shaft

BEARING = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
FILM = Film(Lubricant(0.03), Guembel(), grid=(48, 12))
LOAD = (8e3, 0.0)


def test_the_coefficients_are_the_derivatives_of_the_film_force():
    found = rotor_coefficients(BEARING, LOAD, [100.0], FILM)
    place = BEARING.equilibrium(LOAD, 100.0, FILM).eccentricity
    step = 1e-9
    for k in range(2):
        for name, move in (("stiffness", {}), ("damping", {"velocity": step * np.eye(2)[k]})):
            there = place + (0 if move else step * np.eye(2)[k])
            before = BEARING.pressure(place, 100.0, FILM).force
            after = BEARING.pressure(there, 100.0, FILM, **move).force
            np.testing.assert_allclose(
                found[name].values[0, :, k], (after - before) / step, rtol=2e-3, atol=2e4
            )


def test_the_table_reads_as_a_bearing_of_rotor_dynamics():
    found = rotor_coefficients(BEARING, LOAD, [150.0, 50.0], FILM)
    table = pd.read_csv(io.StringIO(coefficient_table(found)))
    assert list(table) == ["frequency", *(f"{m}{a}{b}" for m in "kc" for a in "xy" for b in "xy")]
    assert table["frequency"].tolist() == [50.0, 150.0]
    assert table["kxy"][0] == pytest.approx(float(found.stiffness[1, 0, 1]))
    assert table["cyy"][1] == pytest.approx(float(found.damping[0, 1, 1]))


def test_tilting_pads_are_stiffer_against_the_grain_of_fast_vibration():
    pads = JournalBearing(
        diameter=0.2, width=0.1, relative_clearance=1e-3, shape=TiltingPads(count=4, arc=1.2)
    )
    film = Film(Lubricant(0.03), Guembel(), grid=(48, 8))
    slow, same = (rotor_coefficients(pads, LOAD, [100.0], film, whirl=w) for w in (1e-3, 1.0))
    assert not np.allclose(slow.stiffness, same.stiffness, rtol=1e-3)
    for one in (slow, same):  # pads do not couple the axes of a symmetric load
        assert abs(one.stiffness[0, 0, 1]) < 0.05 * one.stiffness[0, 0, 0]


@pytest.mark.parametrize("speed", [[0.0], [[1.0]], [np.inf]])
def test_speeds_without_a_film_are_refused(speed):
    with pytest.raises(InputError):
        rotor_coefficients(BEARING, LOAD, speed, FILM)


def scene_of(file, **more):
    data = {
        "name": "line",
        "accuracy": "given",
        "loads": {"source": "files", "files": [str(file)]},
        "results": ["journal.dynamics"],
        "shaft": {"two_point": {"beam": {}}},
        "bearings": {
            "N": {"kind": "journal", "grid": [24, 8]},
            "N2": {"kind": "journal", "grid": [24, 8],
                   "geometry": {"diameter": 2.0, "width": 1.2, "relative_clearance": 8e-4}},
        },
    }  # fmt: skip
    return make_scene(data | more)


def test_a_run_tabulates_each_bearing_and_the_line_on_them(tmp_path):
    scene = scene_of(
        cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,)),
        dynamics={"unbalance": 100.0, "points": 3},
    )
    result = lf.run(scene, out=tmp_path)
    found = result.tree["dynamics"].to_dataset()
    name = str(found["case"].values[0])
    assert result.failures == {}
    assert float(found["residual"].max()) < 1e-8
    assert float(found["unbalance_amplitude"].max()) > 0
    assert all(found[name].attrs["units"] and found[name].attrs["long_name"] for name in found)
    # each bearing has its own film
    for bearing in ("N", "N2"):
        table = pd.read_csv(result.path / f"coefficients/{name}_{bearing}.csv")
        assert len(table) == 3
        there = found.sel(bearing=bearing, case=name)
        middle = table.iloc[1]  # 0.5, 1.0, 1.5 of the mean speed
        assert middle["frequency"] == pytest.approx(float(there["mean_speed"]), rel=1e-6)
        assert middle["kxy"] == pytest.approx(float(there["stiffness"][0, 1]), rel=1e-6)
    assert not np.allclose(found["stiffness"][0], found["stiffness"][1], rtol=0.1)
    assert "Rotor dynamics" in result.report.read_text(encoding="utf-8")


def test_the_result_is_computed_only_where_it_is_asked_for():
    assert "journal.dynamics" not in make_scene({"name": "x"}).results
    assert "dynamics" not in [step.name for step in make_plan(make_scene({"name": "x"})).steps]


HUB = case(8.0, 1, steps=60)


def test_rolling_bearings_and_given_stiffness_stand_beside_films():
    balls = {"kind": "ball", "balls": 30, "ball_diameter": 0.15, "pitch_diameter": 2.0,
             "groove_radius": 0.078}  # fmt: skip
    supports = {"given": {"radial": 4e9}, "rolling": {"stiffness": "rolling"}, "rigid": {}}
    lowest = {}
    for name, support in supports.items():
        scene = make_scene(
            {
                "name": "mixed",
                "results": ["journal.dynamics"],
                "shaft": {"two_point": {"beam": {"supports": [{}, support]}}},
                "journal": {"bearings": ["N"], "grid": [24, 8]},
                "rolling": {"bearing": "N2", "geometry": balls},
            }
        )
        inputs = {"loads": HUB, "shaft": shaft.bearing_loads(scene, None, {"loads": HUB})}
        tree = dynamics.dynamics(scene, None, inputs)
        lowest[name] = float(tree["two_point"]["natural_frequency"][2])
    assert lowest["given"] < lowest["rigid"]
    assert lowest["rolling"] < lowest["rigid"]


def test_a_shaft_that_stands_is_told():
    scene = scene_of("none.h5", loads={})
    standing = HUB.assign(speed=0 * HUB["speed"])
    inputs = {"loads": standing, "shaft": shaft.bearing_loads(scene, None, {"loads": HUB})}
    with pytest.raises(SolverError, match="stands"):
        dynamics.dynamics(scene, None, inputs)


def test_the_command_line_writes_the_table(tmp_path):
    file = tmp_path / "film.csv"
    line = ["journal", "--diameter", "0.2", "--width", "0.1", "--relative-clearance", "1e-3"]
    line += ["--viscosity", "0.03", "--force-x", "8000", "--grid", "24", "8"]
    line += ["--coefficients", str(file), "--json"]
    answer = CliRunner().invoke(app, [*line, "--over-rpm", "500", "1500", "3"])
    assert answer.exit_code == 0, answer.output
    assert len(json.loads(answer.stdout)["rows"]) == len(pd.read_csv(file)) == 3
    for wrong in (
        ["--over-rpm", "5", "1", "3"],
        [],
        ["--over-rpm", "1", "2", "3", "--speed-rpm", "3"],
    ):
        assert isinstance(CliRunner().invoke(app, [*line, *wrong]).exception, InputError)
