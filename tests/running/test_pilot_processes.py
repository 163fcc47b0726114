"""What a pilot finds does not depend on the processes of its run."""

import json

import pytest

import loadflow as lf
from loadflow.scene.scene import make_scene
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
