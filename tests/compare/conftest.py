"""What tests of comparisons share."""

import pytest
from synthetic import cube_file

from loadflow.cube import open_cube
from loadflow.running.comparison import compare
from loadflow.scene.scene import make_scene, read_scene


@pytest.fixture(scope="module")
def cooled_run(tmp_path_factory):
    """Comparison of one candidate without tolerances, from sections of a scene.

    Folder, scene, results of its rolling bearings and numbers of the candidate, and facts.
    """

    def run(**sections):
        cube = cube_file(tmp_path_factory.mktemp("cube") / "loads.h5", steps=200)
        none = {"roughness": 0.0, "alignment": 0.0, "clearance": 0.0, "viscosity": 0.0}
        data = {"name": "cooled", "loads": {"files": [str(cube)]}, "as_built": none}
        found = compare(make_scene(data | sections), out=tmp_path_factory.mktemp("runs"))
        one = found.comparison.candidates[0]
        folder = found.path / one.folder
        table = open_cube(folder / "result.h5")["rolling"].to_dataset().load()
        return folder, read_scene(folder / "scene.toml"), table, one.numbers, found.comparison.facts

    return run
