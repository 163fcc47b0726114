"""Flexible rings as a scene asks for them."""

import pytest
from synthetic import cube_file

import loadflow as lf
from loadflow.errors import InputError
from loadflow.scene import make_scene

GEOMETRY = {
    "balls": 100, "ball_diameter": 0.04, "pitch_diameter": 2.5, "groove_radius": 0.021,
    "contact_angle": 0.7854,
}  # fmt: skip


def test_a_run_with_flexible_rings_keeps_every_sample_and_shifts_the_forces(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(12.0,), seeds=(1,))
    largest = {}
    for rings in ("rigid", "flexible"):
        scene = make_scene(
            {
                "name": rings, "loads": {"source": "files", "files": [str(cube)]},
                "results": ["rolling.life"], "rolling": {"rings": rings},
            }
        )  # fmt: skip
        table = lf.run(scene, out=tmp_path, report=False).tree["rolling"]
        assert int(table["not_converged"].sum()) == 0
        assert float(table["largest_residual"].max()) <= 1e-9
        largest[rings] = float(table["largest_ball_force"].max())
    assert largest["flexible"] != pytest.approx(largest["rigid"], rel=0.01)


@pytest.mark.parametrize(
    "rolling",
    [{"geometry": GEOMETRY}, {"inner_ring": None, "outer_ring": None}],
    ids=["geometry without rings", "no ring"],
)
def test_flexible_rings_without_data_are_refused(rolling):
    with pytest.raises(InputError, match="inner_ring or outer_ring"):
        make_scene({"name": "x", "rolling": {"rings": "flexible"} | rolling})
