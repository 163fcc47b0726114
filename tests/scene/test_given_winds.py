"""Scenes whose rotor flies through wind fields of the user's own."""

import json
from dataclasses import replace

import numpy as np
import pytest

import loadflow as lf
from loadflow.errors import InputError
from loadflow.planning.plan import make_plan
from loadflow.rotor import simulate
from loadflow.scene.given_winds import given_field
from loadflow.scene.scene import make_scene
from loadflow.wind import WindOptions, condition, kaimal_box, read_bts, rotor_grid, write_bts
from loadflow.wind.options import Machine

NREL_5MW = Machine(cut_in=3, rated=11.4, cut_out=25, rotor_diameter=126, hub_height=90)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two fields of 80 s, one with a name that tells its wind speed and seed."""
    place = tmp_path_factory.mktemp("winds")
    for name, seed in (("mine_v9_s7", 1), ("other", 2)):
        line = np.linspace(-65.0, 65.0, 9)
        box = kaimal_box(
            9.2, 1.4, y=line, z=90.0 + line, hub_height=90.0, duration=80.0, dt=0.1, seed=seed
        )
        write_bts(place / f"{name}.bts", box)
    return place


def scene_of(*winds, accuracy=0.05, **loads):
    loads = {"winds": [str(w) for w in winds], "rung": "tables", "duration": 15.0} | loads
    return make_scene(
        {"name": "own-wind", "accuracy": accuracy, "loads": loads, "results": ["loads.statistics"]}
    )


def test_a_field_of_another_hub_is_doubted(folder):
    winds, case = WindOptions(), condition("1.1", NREL_5MW, wind_speed=9.0)
    for hub, said in ((90.0, ""), (95.0, ""), (119.0, "hub of the field at 90 m, that of the")):
        machine = replace(NREL_5MW, hub_height=hub)
        mean, _, doubt = given_field(folder / "other.bts", case, winds, machine, 15.0)
        assert mean.wind_speed == pytest.approx(9.2)
        assert (said in doubt) if said else (doubt == "")


def test_each_field_is_a_case_named_as_its_file_says(folder):
    found = [(c.name, c.weight) for c in make_plan(scene_of(folder / "*.bts")).cases]
    assert [name for name, _ in found] == ["dlc1.1_v9_s7", "dlc1.1_v9.2_s1"]
    assert sum(weight for _, weight in found) == pytest.approx(1)


def test_the_loads_are_those_of_the_rotor_in_that_field(folder, tmp_path):
    scene = scene_of(folder / "mine*.bts", accuracy="given")
    result = lf.run(scene, out=tmp_path, report=False)
    (case,) = (result.path / "loads").glob("*.h5")
    loads = lf.open_cube(case).load()
    box = read_bts(folder / "mine_v9_s7.bts")
    grid = rotor_grid(NREL_5MW, WindOptions())
    alone = simulate(
        wind_speed=box.wind_speed,
        shear=box.shear_exponent,
        duration=15.0,
        rung="tables",
        field=box.to_polar(grid.radius, grid.angle),
    )
    for name in ("speed", "hub_force", "hub_moment"):
        assert np.array_equal(loads[name], alone[name].astype("float32")), name
    manifest = json.loads((result.path / "manifest.json").read_text(encoding="utf-8"))
    (file,) = manifest["inputs"]
    assert file.endswith("mine_v9_s7.bts")


def test_without_a_duration_the_loads_are_as_long_as_the_field_allows(folder, tmp_path):
    scene = scene_of(folder / "other.bts", duration=None)
    result = lf.run(scene, out=tmp_path, report=False)
    (case,) = (result.path / "loads").glob("*.h5")
    time = lf.open_cube(case)["time"]
    assert float(time[-1]) == pytest.approx(80.0 - 60.0 - 0.025)


def test_a_changed_field_is_another_input(folder, tmp_path):
    file = tmp_path / "mine_v9_s7.bts"
    file.write_bytes((folder / "mine_v9_s7.bts").read_bytes())
    before = make_plan(scene_of(file)).steps[0].digest
    file.write_bytes((folder / "other.bts").read_bytes())
    assert make_plan(scene_of(file)).steps[0].digest != before


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"duration": 30.0}, "lasts 80 s; 60 s of run-in and 30 s of loads do not fit"),
        ({"dlc": "1.4"}, "load case 1.4 has a gust, not turbulence"),
        ({"seeds": 3}, "leave out seeds"),
        ({"dlc": ["1.1", "1.3"]}, "all load cases but one"),
        ({"winds": ["none*.bts"]}, r"none\*.bts: no such wind field"),
    ],
)
def test_what_does_not_fit_is_refused(folder, tmp_path, change, message):
    with pytest.raises(InputError, match=message):
        lf.run(scene_of(folder / "other.bts", **change), out=tmp_path)


def test_a_field_narrower_than_the_rotor_is_refused_by_name(tmp_path):
    line = np.linspace(-40.0, 40.0, 5)
    box = kaimal_box(
        9.2, 1.4, y=line, z=90.0 + line, hub_height=90.0, duration=80.0, dt=0.2, seed=1
    )
    write_bts(tmp_path / "small.bts", box)
    with pytest.raises(InputError, match=r"small.bts: the rotor disc, y = -63.00 … 63.00 m"):
        lf.run(scene_of(tmp_path / "small.bts"), out=tmp_path)
