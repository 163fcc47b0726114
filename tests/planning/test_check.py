"""A run solves some of its own samples again by better models, and says how far they move."""

import numpy as np
import pytest
import xarray as xr
from synthetic import case, cube_file

import loadflow as lf
from loadflow.cube import make_cube, save_cube
from loadflow.planning.choice import finer
from loadflow.planning.ladder import measured
from loadflow.planning.plan import make_plan
from loadflow.planning.verification import differences, to_refine
from loadflow.scene.cases import Case
from loadflow.scene.scene import make_scene
from loadflow.stages.comparisons import other_cells
from loadflow.stages.differences import Difference
from loadflow.stages.paths_again import remembered

FILM = {"grid": [24, 8], "bearings": ["N2"], "rung": "reduced"}


def scene_of(cube, *results, **keys):
    loads = {"files": [str(cube)]}
    data = {"name": "checked", "accuracy": "given", "loads": loads, "results": list(results)}
    return make_scene(data | keys)


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    folder = tmp_path_factory.mktemp("check")
    return cube_file(folder / "loads.h5", wind_speeds=(8.0,), seeds=(1,), steps=200)


def checked(scene, folder):
    return lf.run(scene, out=folder, report=False).tree["check"].to_dataset()


def test_a_film_in_motion_is_followed_again_where_its_eccentricity_is_largest(cube, tmp_path):
    scene = scene_of(cube, "journal.film", journal=FILM | {"motion": "transient"})
    check = checked(scene, tmp_path)
    assert set(check["stage"].values) == {"journal", "heat of the film"}
    film = check["difference"].values[check["stage"].values == "journal"]
    assert np.all((film > 0) & (film < 0.2))


def test_the_warning_of_a_film_in_motion_shrinks_with_its_grid(cube, tmp_path):
    """The next better grid of a finer film lies nearer to it."""
    moved = []
    for grid in ([24, 8], [48, 16]):
        journal = FILM | {"motion": "transient", "grid": grid}
        check = checked(scene_of(cube, "journal.film", journal=journal), tmp_path / str(grid[0]))
        chosen = (check["stage"] == "journal") & (check["quantity"] == "eccentricity ratio")
        moved.append(float(check["difference"].values[chosen.values].max()))
    assert moved[1] < moved[0]


def test_the_check_goes_to_finer_cells_until_they_hold_the_accuracy(cube, tmp_path):
    """So a run takes these at once, and none of those between that are not good enough."""

    def row(up):
        film = FILM | {"motion": "transient", "grid": [24 * 2**up, 8], "heat": None}
        scene = scene_of(cube, "journal.film", journal=film, accuracy=0.001)
        found = checked(scene, tmp_path / str(up))
        chosen = (found["stage"] == "journal") & (found["quantity"] == "eccentricity ratio")
        return found.isel(check=int(np.flatnonzero(chosen.values)[0]))

    first = row(0)
    up = int(first["rungs"])
    assert up > 1
    assert row(up - 1)["difference"] > 0.001
    assert row(up)["difference"] <= 0.001


def test_a_film_that_started_lately_is_followed_again_from_its_start():
    """Oil that was lacking as it stood comes as fast as the shaft turns."""
    speed = np.concatenate([np.zeros(100), np.full(900, 1.0)])
    film = xr.Dataset({"speed": ("sample", speed), "running": ("sample", speed > 0.0)})
    assert remembered(film, 300, 0.05).size == 300  # 10 rad since then, two turns are 12.6
    assert not remembered(film, 300, 0.05).all()
    assert remembered(film, 600, 0.05).size == pytest.approx(4.0 * np.pi / 0.05, abs=1)
    assert remembered(film, 600, 0.05).all()


def test_rigid_rings_are_compared_with_flexible_ones(cube, tmp_path):
    thin = {"bearing": "M"}  # the ring of the source, of which its rings are known
    scene = scene_of(cube, "rolling.life", shaft={"moment": {}}, rolling=thin)
    check = checked(scene, tmp_path)
    rolling = check.isel(check=check["stage"].values == "elastic rings")
    assert set(rolling["quantity"].values) == {"maximum force", "maximum pressure", "life"}
    assert (rolling["difference"] > 0.05).all()  # thin rings: rigid ones are no answer
    flexible = finer(scene, "elastic rings")
    assert flexible.rolling.rings == "flexible"
    assert finer(flexible, "elastic rings") is None


def test_bearings_without_flexible_rings_have_no_better_model(cube):
    scene = scene_of(cube, "rolling.life", rolling={"arrangement": "two-spherical"})
    assert finer(scene, "elastic rings") is None


def test_an_accuracy_stated_later_is_held_against_the_answers_that_are_there(cube, tmp_path):
    """The allowed difference is not that of the run before."""
    film = FILM | {"motion": "quasi-static", "heat": None}
    same = {"journal": film, "reduction": {"pick": "extremes", "size": 0.1}}
    loose = checked(scene_of(cube, "journal.film", **same), tmp_path)
    assert np.isnan(loose["allowed"]).all()
    strict = checked(scene_of(cube, "journal.film", **same, accuracy=0.5), tmp_path)
    assert (strict["allowed"] == 0.5).all()


def test_films_are_not_checked_where_the_shaft_only_stands(tmp_path):
    standing = case(8.0, 1)
    standing["speed"][:] = 0.0
    file = save_cube(make_cube([standing]), tmp_path / "loads.h5")
    scene = scene_of(file, "journal.film", journal=FILM)
    result = lf.run(scene, out=tmp_path, report=False)
    assert (result.tree["journal"]["in_contact"] > 0).all()
    assert np.isnan(result.tree["journal"]["smallest_film"]).all()
    assert "journal.film" not in result.tree["check"]["result"].values
    assert result.warnings == []


def test_a_film_whose_ends_touch_is_told_as_not_checked(cube, tmp_path):
    own = {"stiffness": "journal", "takes_moment": True}
    wide = {"diameter": 3.0, "width": 2.25, "relative_clearance": 0.5e-3}
    film = {"geometry": wide, "tilt": True, "motion": "transient", "rung": "reduced"}
    shaft = {"two_point": {"beam": {"supports": [own, own]}}}
    journal = film | {"grid": [24, 8], "lubricant": {"viscosity": 0.003}}
    scene = scene_of(cube, "journal.film", journal=journal, shaft=shaft)
    result = lf.run(scene, out=tmp_path)
    check, films = (result.tree[name].to_dataset() for name in ("check", "journal"))
    assert 0 < films["in_contact"].max() < 200
    assert set(check["quantity"].values[check["stage"].values == "journal"]) == {"minimum film"}
    assert np.isnan(check["difference"].values[check["stage"].values == "journal"]).all()
    assert any("is not checked" in text and "touch in" in text for text in result.warnings)
    assert "not solved" in (tmp_path / "checked" / "report.html").read_text()


def test_loads_given_to_a_scene_keep_how_it_reads_them(cube):
    from loadflow.scene.changed import with_loads

    loads = {"files": ["none.h5"], "pattern": r"v(?P<wind_speed>\d+)", "wind_class": "II"}
    scene = with_loads(scene_of(cube, "journal.film", loads=loads), [str(cube)])
    assert scene.loads.files == [str(cube)]
    assert scene.loads.pattern == loads["pattern"]
    assert scene.loads.wind_class == "II"


def test_loads_that_a_better_model_could_move_are_checked_only_where_a_bearing_reads_them(cube):
    plan = make_plan(scene_of(cube, "loads.statistics"))
    assert "check" not in [step.name for step in plan.steps]


def test_a_film_at_rest_is_compared_with_the_orbit_of_the_whole_series(cube, tmp_path):
    journal = FILM | {"motion": "transient"}
    moving = scene_of(cube, "journal.film", journal=journal)
    orbit = lf.run(moving, out=tmp_path / "moving", report=False)
    still = scene_of(cube, "journal.film", journal=FILM)
    run = lf.run(still, out=tmp_path / "still", report=False)
    check = run.tree["check"].to_dataset()
    found = check.isel(check=check["stage"].values == "motion")
    ratio = found["difference"].values[(found["quantity"] == "eccentricity ratio").values]
    ours, theirs = (
        part.tree["journal"]["largest_eccentricity_ratio"].item() for part in (run, orbit)
    )
    assert ratio == pytest.approx(abs(ours / theirs - 1), rel=1e-9)


def test_a_model_is_refined_only_where_nothing_that_stays_is_further_off():
    rows = [
        ("journal", "journal.film", "maximum pressure", 0.11),
        ("motion of the film", "journal.film", "maximum pressure", 0.94),
        ("journal", "journal.film", "minimum film", 0.02),
        ("rolling", "rolling.life", "life", 0.2),
    ]
    names = ("stage", "result", "quantity")
    texts = {name: ("check", [row[k] for row in rows]) for k, name in enumerate(names)}
    values = {
        "difference": ("check", [row[3] for row in rows]),
        "allowed": ("check", [0.05] * len(rows)),
    }
    tree = xr.DataTree.from_dict({"check": xr.Dataset(values, texts)})
    stays = "motion of the film"
    assert to_refine(tree, lambda stage: stage != stays, lambda *row: 1) == ["rolling"]
    every = to_refine(tree, lambda stage: True, lambda stage, *row: 2 if stage == "journal" else 1)
    assert every == ["journal", "journal", stays, "rolling"]
    values["rungs"] = "check", [3, 0, 0, 0]  # those that the check solved, too
    tree = xr.DataTree.from_dict({"check": xr.Dataset(values, texts)})
    every = to_refine(tree, lambda stage: True, lambda stage, *row: 1)
    assert every == ["journal"] * 3 + [stays, "rolling"]


def test_a_film_is_off_by_more_than_the_next_cells_move_it_and_other_models_by_what_they_do(
    monkeypatch,
):
    film = {"motion": "transient", "rung": "reduced", "grid": (60, 20)}
    scene = make_scene({"accuracy": "given", "journal": film, "shaft": {"two_point": {}}})
    rows = [
        Difference(stage, "journal.film", "minimum film", "case", "another", 0.03)
        for stage in ("journal", "heat of the film")
    ]
    monkeypatch.setattr("loadflow.planning.verification.compare", lambda *given: iter(rows))
    one = Case("1.1", 12.0, 1)
    found = differences(scene, [one], {one.name: {}})["difference"].values
    coarse, fine = (
        measured(scene, "journal", f"reduced, {cells}")["errors"]["minimum film"]["max"]
        for cells in (60, 120)
    )
    assert found[0] == pytest.approx(0.03 / (1.0 - fine / coarse))
    assert found[1] == 0.03


@pytest.mark.parametrize(
    ("film", "grid", "said"),
    [
        ({"motion": "transient", "rung": "reduced", "grid": (240, 20)}, (480, 20), "reduced, 480"),
        ({"motion": "transient", "rung": "reduced", "grid": (480, 20)}, (240, 20), "half as fine"),
        ({"rung": "grid", "grid": (480, 160)}, (240, 80), "half as fine"),
    ],
)
def test_the_finest_cells_are_held_against_half_as_many(film, grid, said):
    scene = make_scene({"accuracy": "given", "journal": film, "shaft": {"two_point": {}}})
    other, against = other_cells(scene)
    assert other.journal.grid == grid
    assert said in against


def test_a_film_without_cells_is_held_against_none():
    film = {"rung": "map", "grid": (480, 160)}
    scene = make_scene({"accuracy": "given", "journal": film, "shaft": {"two_point": {}}})
    assert other_cells(scene) == (None, "")
