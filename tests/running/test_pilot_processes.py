"""What a pilot finds does not depend on the processes of its run."""

import json

import pytest
from synthetic import cube_file

import loadflow as lf
from loadflow.planning import pilot as pilots
from loadflow.planning.plan import make_plan
from loadflow.scene.scene import make_scene
from loadflow.stages.effects.clearances import CLEARANCES
from loadflow.stages.effects.film import MOTION
from loadflow.stages.effects.registry import EFFECTS


def test_two_processes_measure_the_effects_of_the_rotor_as_one_does(tmp_path, monkeypatch):
    """Each case is measured as a whole, in whichever process."""
    monkeypatch.setattr("loadflow.planning.pilot.SHARE", 1e6)  # as in a long run
    loads = {"wind_speeds": [8.0, 24.0], "seeds": 1, "duration": 15.0, "step": 0.05}
    scene = make_scene({"name": "two", "results": ["rolling.loads"], "loads": loads})
    found = []
    for workers in (1, 2):
        run = lf.run(scene, out=tmp_path / str(workers), workers=workers, report=False)
        found.append(json.loads((run.path / "manifest.json").read_text(encoding="utf-8")))
    one, two = found
    rotor = {effect.name for effect in EFFECTS if effect.model == "loads"}
    assert len(rotor & {*one["pilot"]["sizes"]}) >= 3
    assert len(one["pilot"]["cases"]) == 2
    for key in ("refused", "cases"):
        assert two["pilot"][key] == one["pilot"][key]
    assert two["pilot"]["sizes"].keys() == one["pilot"]["sizes"].keys()
    for effect, sizes in one["pilot"]["sizes"].items():  # sums of processes differ in last digits
        assert two["pilot"]["sizes"][effect] == pytest.approx(sizes, rel=1e-9)
    kept = [[(each["name"], each["kept"], each["why"]) for each in run["effects"]] for run in found]
    assert kept[0] == kept[1]
    for key in ("rungs", "shortfalls"):
        assert two[key] == one[key]


def test_a_short_run_asks_what_its_models_hang_on_and_no_more(tmp_path, monkeypatch):
    """A film in motion costs less than one at rest, so that it is followed in any case."""
    without = []

    def seen(probe, effect, *of):
        without.append(effect.name)
        return left_out(probe, effect, *of)

    left_out = pilots.without
    monkeypatch.setattr(pilots, "without", seen)
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,), steps=500)
    shaft = {"two_point": {"beam": {"sections": [{"outer_diameter": 3.0, "inner_diameter": 2.7}]}}}
    loads, wanted = {"files": [str(cube)]}, ["journal.film"]
    scene = make_scene({"name": "short", "results": wanted, "loads": loads, "shaft": shaft})
    whole = pilots.pilot(scene)
    assert {*without} == {*whole.sizes} >= {MOTION.name, CLEARANCES.name}
    without.clear()
    brief = pilots.pilot(scene, brief=True)
    assert {*without} == {*brief.sizes}
    assert CLEARANCES.name in without
    assert MOTION.name not in without
    kept = [
        {one.name for one in make_plan(scene, verdict=verdict).effects if one.kept}
        for verdict in (whole, brief)
    ]
    assert MOTION.name in kept[0]
    assert kept[0] == kept[1]
