"""A scene that states an accuracy gets the cheapest models that hold it on its own cases."""

import json

import numpy as np
import pytest
import xarray as xr
from synthetic import cube_file

import loadflow as lf
from loadflow.cli import main
from loadflow.errors import InputError
from loadflow.planning import choice, verification
from loadflow.planning.accuracy import error_by_change, expected_errors, rungs_up
from loadflow.planning.choice import choose
from loadflow.planning.effects import Estimates
from loadflow.planning.ladder import expected_seconds, gains, ladder, measured
from loadflow.planning.plan import make_plan
from loadflow.planning.shortfalls import found_shortfalls
from loadflow.quantities import percent
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import BY_NAME, Scene, make_scene
from loadflow.stages.differences import Difference
from loadflow.stages.registry import STAGES, giving, models


def scene_of(**keys):
    return make_scene({"name": "accurate", "loads": {"wind_speeds": [12.0], "seeds": 1}} | keys)


def film_seconds(scene):
    return expected_seconds(scene, "journal", make_plan(scene).cases)


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    return cube_file(tmp_path_factory.mktemp("cube") / "loads.h5")


def given(cube, **keys):
    loads = {"files": [str(cube)]}
    return make_scene({"name": "given", "loads": loads, "results": ["journal.film"]} | keys)


def test_every_result_says_which_errors_reach_it():
    scene = Scene(name="all")
    given = [result for stage in STAGES.values() for result in stage.results]
    of_pads = "thrust.film"  # of scenes that have a bearing of pads
    assert sorted(given) == sorted([*scene.results, of_pads, *BY_NAME])
    for result in scene.results:
        links = giving(result).results[result](scene)
        assert all(links.values())
        assert bool(links) != (result == "seeds.equality")  # a verdict is no number


def test_models_as_given_stay_as_they_are():
    scene = scene_of(accuracy="given")
    assert make_plan(scene).scene == scene


def test_an_accuracy_of_five_per_cent_holds_where_none_is_said():
    assert scene_of().accuracy == 0.05
    assert make_plan(scene_of()).scene == make_plan(scene_of(accuracy=0.05)).scene


LOADED = ["loads.statistics", "rolling.loads", "rolling.life"]


@pytest.mark.parametrize("accuracy", [0.3, 0.1, 0.05, 0.02, 0.01])
def test_the_expected_error_is_within_the_accuracy_asked_for(accuracy):
    plan = make_plan(scene_of(accuracy=accuracy, results=LOADED))
    assert plan.accurate
    assert max(e for errors in plan.errors.values() for e in errors.values()) <= accuracy
    assert plan.shortfalls == ()


def test_what_cannot_be_had_is_said_and_the_rest_is_held():
    """No scene without a beam knows how its shaft tilts in the film."""
    plan = make_plan(scene_of(accuracy=0.05, results=["journal.film"]))
    assert not plan.accurate
    errors = plan.errors["journal.film"]
    tilt = next(effect for effect in plan.effects if effect.name == "tilt of the shaft")
    assert not tilt.kept
    assert all(error - tilt.indicator[name] <= 0.05 for name, error in errors.items())
    (said,) = plan.shortfalls
    assert "minimum film by up to" in said
    assert "tilt of the shaft left out; what would help: journal.tilt" in said


def test_rigid_rings_are_counted_or_flexible():
    """They are 65 % and 150 % off in the ladder."""
    left = make_plan(scene_of(results=LOADED, rolling={"rings": "rigid"}))
    assert left.errors["rolling.loads"]["maximum force"] > 0.6
    assert left.errors["rolling.life"]["life"] > 1.4
    assert any("elastic rings left out" in said for said in left.shortfalls)
    assert make_plan(scene_of(results=LOADED)).scene.rolling.rings == "flexible"
    given_ = make_plan(scene_of(results=LOADED, accuracy="given"))
    assert given_.scene.rolling.rings == "rigid"
    assert given_.errors["rolling.life"]["life"] > 1.4


def test_a_lower_accuracy_never_costs_more():
    # all stages together: a coarser wind can be worth a finer film
    plans = [make_plan(scene_of(accuracy=a)) for a in (0.01, 0.02, 0.05, 0.1, 0.3)]
    costs = [
        sum(expected_seconds(plan.scene, stage, plan.cases) or 0.0 for stage in STAGES)
        for plan in plans
    ]
    assert costs == sorted(costs, reverse=True)
    rotors = [expected_seconds(plan.scene, "loads", plan.cases) for plan in plans]
    assert rotors[0] > 2 * rotors[-1]


def test_an_accuracy_out_of_reach_is_said_and_the_best_is_taken():
    plan = make_plan(scene_of(accuracy=1e-6))
    assert not plan.accurate
    worst = {
        name: max(
            entry["errors"][quantity]["max"]
            for quantity in make_plan(scene_of()).errors["journal.film"]
        )
        for name, entry in ladder()["journal, transient"].items()
        if "settings" in entry
    }
    assert models()["journal"].text_of(plan.scene) == min(worst, key=worst.__getitem__)


def test_of_models_that_do_not_go_together_none_is_taken(monkeypatch):
    """Neither where that costs the accuracy; where none at all go together, it is said."""
    scene = make_scene({"results": ["journal.film"], "accuracy": 0.05})
    first = make_plan(scene).scene
    for held in (
        lambda one: one.loads.rung != first.loads.rung,
        lambda one: max(expected_errors(one, Estimates())["journal.film"].values()) > 0.1,
    ):
        monkeypatch.setattr(choice, "is_valid", held)
        found = choose(scene, ["loads", "shaft", "journal"], tuple(list_cases(scene)))
        assert held(found.scene)
        assert found.met == all(x <= 0.05 for x in found.errors["journal.film"].values())
    monkeypatch.setattr(choice, "is_valid", lambda one: False)
    with pytest.raises(InputError, match=r"no models of .*loads.* go together"):
        choose(scene, ["loads", "shaft", "journal"], tuple(list_cases(scene)))


def test_an_error_that_was_not_measured_is_said_and_does_not_force_the_dearest_models():
    """A film grid that the ladder does not hold: the others decide the rest."""
    loose, unknown = (
        make_plan(
            scene_of(
                accuracy=0.3, journal={"grid": grid, "motion": "transient"},
                results=["journal.film", "rolling.life"],
            )
        )
        for grid in ([60, 20], [48, 16])
    )  # fmt: skip
    assert loose.accurate
    assert not unknown.accurate
    assert set(unknown.errors["journal.film"].values()) == {None}
    assert None not in unknown.errors["rolling.life"].values()
    for stage in ("wind", "loads", "rolling"):
        assert models()[stage].text_of(unknown.scene) == models()[stage].text_of(loose.scene)
    assert "by the errors that are known" in unknown.reasons["loads"]


def test_what_one_model_does_not_tell_leaves_what_is_asked_of_the_others():
    """Of the one result of a scene, whose cells were not measured: its loads are accurate."""
    plan = make_plan(scene_of(journal={"grid": [16, 8]}, results=["journal.film"]))
    assert set(plan.errors["journal.film"].values()) == {None}
    kept = {effect.name for effect in plan.effects if effect.kept}
    assert {"dynamic inflow", "motion of the film"} < kept
    assert measured(plan.scene, "wind")["errors"]["radial force max"]["max"] < 0.05
    first, second = plan.shortfalls
    assert "16x8 was not measured" in first
    assert "off, by what is known, in minimum film by up to" in second
    assert "tilt of the shaft left out" in second


def test_of_models_without_measured_errors_as_few_as_can_be_are_taken():
    """Mann's turbulence is not measured, whatever its grid; everything else still is."""
    plan = make_plan(scene_of(accuracy=0.3, loads={"spectrum": "mann"}, results=["journal.film"]))
    assert not plan.accurate
    steps = {step.stage.name: step for step in plan.steps}
    assert "wind: not measured" in steps["loads"].error
    assert set(plan.errors["journal.film"].values()) == {None}


def test_the_wind_is_as_fine_as_the_accuracy_asks_for():
    grids = [
        make_plan(scene_of(accuracy=a, results=["loads.statistics"])).scene.loads.wind_grid
        for a in (0.02, 0.06, 0.3)
    ]
    points = [radii * angles for radii, angles in grids]
    assert points == sorted(points, reverse=True)
    assert points[0] > points[-1]
    named = make_plan(scene_of(accuracy=0.02, loads={"wind_grid": [11, 24]}))
    assert named.scene.loads.wind_grid == (11, 24)
    assert not named.accurate


def test_given_loads_owe_nothing_to_a_wind(cube):
    plan = make_plan(given(cube, results=["loads.statistics"], accuracy=1e-9))
    assert plan.accurate
    assert "wind" not in plan.steps[0].rung


def test_the_error_of_friction_is_known_and_grows_with_its_step():
    errors = [
        expected_errors(scene_of(results=["rolling.friction"], friction={"step": step}))
        for step in (0.1, 0.4, 0.3)
    ]
    usual, coarse, other = (found["rolling.friction"]["friction power"] for found in errors)
    assert 0 < usual < coarse
    assert other is None


def test_a_named_model_is_kept():
    plan = make_plan(scene_of(accuracy=0.01, journal={"grid": [30, 10]}))
    assert plan.scene.journal.grid == (30, 10)
    assert not plan.accurate


def test_only_the_named_result_must_be_accurate():
    strict = make_plan(scene_of(accuracy={"journal.film": 0.005}))
    loose = make_plan(scene_of(accuracy={"rolling.loads": 0.05}))
    assert film_seconds(strict.scene) > 1.5 * film_seconds(loose.scene)


def test_an_error_of_the_load_reaches_the_film_through_its_gain():
    scene = scene_of(loads={"rung": "tables"}, results=["journal.film"])
    top = scene_of(loads={"rung": "tower"}, results=["journal.film"])
    added = {
        name: expected_errors(scene)["journal.film"][name] - error
        for name, error in expected_errors(top)["journal.film"].items()
    }
    load = ladder()["loads"]["tables"]["errors"]["radial force max"]["max"]
    assert added == {name: pytest.approx(load * gains()["journal"][name]) for name in added}


def test_life_answers_the_load_with_about_the_third_power():
    """Somewhat less: the contact angles of the four-point ball grow with the load."""
    assert 2.5 < gains()["rolling"]["life"] < 3.1
    assert gains()["rolling"]["maximum pressure"] == pytest.approx(
        gains()["rolling"]["maximum force"] / 3, rel=0.02
    )
    assert 0 < gains()["journal"]["eccentricity ratio"] < 1


def test_given_series_are_read_without_saying_so(cube):
    assert given(cube).loads.source == "files"


def test_a_run_reports_how_far_better_models_move_it(cube, tmp_path):
    named = {"motion": "quasi-static", "heat": None}
    journal = {"grid": [24, 8], "bearings": ["N2"]} | named
    run = lf.run(given(cube, journal=journal, accuracy=1e-4), out=tmp_path)
    check = run.tree["check"].to_dataset()
    assert {"journal", "reduction", "heat of the film", "motion of the film"} == set(
        check["stage"].values
    )
    film = check["difference"].values[check["stage"].values == "journal"]
    assert np.all((film > 0) & (film < 0.2))
    assert "solved again by better models" in run.report.read_text(encoding="utf-8")
    said = run.shortfalls[0]  # before what was expected
    assert said.startswith("journal.film: the check found it off in")
    worst = check["difference"].values[check["result"].values == "journal.film"].max()
    assert percent(worst) in said
    assert "asked for 0.01 %" in said
    assert "what would help: leave journal.heat to the plan" in said  # of friction the most
    assert "leave journal.motion to the plan" in said
    assert not any("is off by" in warning for warning in run.warnings)
    manifest = json.loads((run.path / "manifest.json").read_text(encoding="utf-8"))
    assert manifest["accurate"] is False
    assert manifest["expected_errors"]["journal.film"]["minimum film"] == "not measured"


def test_what_the_check_of_a_run_found_too_far_off_is_told_first_by_run_plan_and_report(
    cube, tmp_path, capsys
):
    text = '[journal]\ngrid = [24, 8]\nmotion = "quasi-static"\nbearings = ["N2"]\n'
    scene = file_of(cube, tmp_path, text)
    scene.write_text(scene.read_text().replace("accuracy = 0.2", "accuracy = 1e-4"))
    runs = str(tmp_path / "runs")
    for words in (("run", str(scene), "--workers", "1"), ("plan", str(scene))):
        with pytest.raises(SystemExit) as ended:
            main([*words, "--out", runs])
        assert ended.value.code == 0
        first = capsys.readouterr().out.splitlines()[0]
        assert first.startswith("not accurate enough: journal.film: the check found it off in")
        assert "what would help: " in first
    page = (tmp_path / "runs" / "given" / "report.html").read_text(encoding="utf-8")
    assert "Not accurate enough: journal.film: the check found it off in" in page


def test_a_run_climbs_where_its_own_cases_need_it_and_gives_the_same_when_taken_up(cube, tmp_path):
    """A bearing far from that of the ladder: its coarse film does not hold what the ladder says."""
    hard = {"geometry": {"diameter": 1.0, "width": 0.4, "relative_clearance": 1e-3}}
    scene = given(cube, accuracy=0.09, journal=hard | {"bearings": ["N2"]})
    assert models()["journal"].text_of(make_plan(scene).scene) == "reduced, 60, 0.05 s"
    run = lf.run(scene, out=tmp_path, report=False)
    manifest = json.loads((run.path / "manifest.json").read_text(encoding="utf-8"))
    assert manifest["refined"][0] == "journal"
    assert "refined" in manifest["rungs"]["journal"]["reason"]
    check = run.tree["check"].to_dataset()
    film = check.isel(check=check["stage"].values == "journal")
    assert (film["difference"] <= 0.09).all()  # on 60 cells around the film is off by more
    before = {part: part.read_bytes() for part in run.path.rglob("journal/*.h5")}
    lf.run(scene, out=tmp_path, report=False)
    assert {part: part.read_bytes() for part in run.path.rglob("journal/*.h5")} == before


def file_of(cube, folder, text=""):
    """A scene as a user writes it."""
    path = folder / "given.toml"
    head = f'results = ["journal.film"]\naccuracy = 0.2\n[loads]\nfiles = ["{cube}"]\n'
    path.write_text(head + text, encoding="utf-8")
    return path


def test_a_finer_model_that_what_cannot_be_helped_outweighs_is_told_beside_what_would_help():
    """It is there, but not taken: equilibria are farther from the film in motion than its cells."""
    wanted = make_scene(
        {"name": "x", "accuracy": 0.05, "results": ["journal.film"], "shaft": {"two_point": {}},
         "journal": {"motion": "quasi-static", "heat": None}}
    )  # fmt: skip
    coarse, *_, finest = choice.choices(wanted, models()["journal"])
    names = ["motion of the film", "journal"]
    check = xr.Dataset(
        {"difference": ("check", [0.3, 0.08]), "allowed": ("check", [0.05, 0.05])},
        {"stage": ("check", names), "result": ("check", ["journal.film"] * 2),
         "quantity": ("check", ["minimum film"] * 2), "case": ("check", ["a, N"] * 2),
         "against": ("check", ["the film in motion", "finer cells"])},
    )  # fmt: skip
    [said] = found_shortfalls(wanted, coarse, check)
    finer = models()["journal"].finer(coarse)
    assert said.endswith(f"; journal as {models()['journal'].text_of(finer)}")
    while (finer := models()["journal"].finer(finest)) is not None:
        finest = finer
    [said] = found_shortfalls(wanted, finest, check)
    assert said.endswith("; nothing, no finer model was measured")


def test_a_model_jumps_to_the_first_rung_that_the_ladder_lets_expect_to_hold():
    film = {"motion": "transient", "rung": "reduced", "grid": (60, 20)}
    scene = make_scene({"journal": film, "shaft": {"two_point": {}}})
    errors = [
        measured(scene, "journal", f"reduced, {cells}")["errors"]["minimum film"]["max"]
        for cells in (60, 120, 240, 480)
    ]
    # were the next rung to move the film by as much as in the ladder, each rung has its error
    own = error_by_change(scene, "journal", "minimum film", errors[0] - errors[1])
    assert own == pytest.approx(errors[0])
    for up in (1, 2, 3):
        assert rungs_up(scene, "journal", "minimum film", own, 1.01 * errors[up]) == up
    assert rungs_up(scene, "journal", "minimum film", own, 0.1 * errors[3]) == 3
    assert rungs_up(scene, "journal", "not measured", own, 1e-9) == 1
    assert rungs_up(scene, "journal", "minimum film", float("inf"), 0.05) == 1
    assert error_by_change(scene, "journal", "not measured", 0.03) == 0.03


def test_the_check_counts_what_cells_of_collars_are_off_not_only_what_the_next_ones_move(
    monkeypatch,
):
    """On 20 × 10 cells p_max of the ladder's collar is off by 2.1 times what 40 × 20 move it."""
    collar = {"kind": "thrust", "play": 6e-4}
    pads = {"pads": 18, "inner_radius": 1.6, "outer_radius": 1.9, "pad_angle": 0.3, "taper": 8e-5}
    places = {"N": {"kind": "journal"}, "N2": [{"kind": "journal"}, collar | {"geometry": pads}]}
    keys = {"results": ["thrust.film"], "shaft": {"two_point": {}}}
    scene = make_scene({"name": "x", "bearings": places} | keys)
    known = ladder()["thrust"]
    coarse, fine = (
        known[f"grid, {cells}"]["errors"]["maximum pressure"]["max"] for cells in ("20x10", "40x20")
    )
    moved = coarse - fine
    row = Difference("thrust", "thrust.film", "maximum pressure", "x, N2", "finer", moved)
    monkeypatch.setattr(verification, "compare", lambda *about: [row])
    [case] = list_cases(scene)[:1]
    found = verification.differences(scene, [case], {case.name: {}})
    assert found["difference"].item() == pytest.approx(coarse)
    assert coarse > 2.0 * moved


def test_plan_prints_choice_error_and_what_is_on_disk(cube, tmp_path, capsys):
    scene = file_of(cube, tmp_path)
    lf.run(lf.read_scene(scene), out=tmp_path / "runs", report=False)
    with pytest.raises(SystemExit) as ended:
        main(["plan", str(scene), "--out", str(tmp_path / "runs"), "--json"])
    assert ended.value.code == 0
    found = json.loads(capsys.readouterr().out)
    assert all(step["finished"] == step["runs"] for step in found["steps"])
    assert found["accurate"]
    assert found["errors"]["journal.film"]["eccentricity ratio"] > 0


def test_plan_says_what_was_not_measured(cube, tmp_path, capsys):
    scene = file_of(cube, tmp_path, '[journal]\ngrid = [24, 8]\nbearings = ["N2"]\n')
    with pytest.raises(SystemExit) as ended:
        main(["plan", str(scene)])
    assert ended.value.code == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "minimum film not measured" in said
    assert said.startswith("not accurate enough: journal.film: eccentricity ratio, minimum film")
    assert "not known to hold: journal as grid, 24x8 was not measured" in said


def test_bench_shows_every_rung_of_a_stage(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["bench", "journal", "--json"])
    assert ended.value.code == 0
    assert set(json.loads(capsys.readouterr().out)["journal"]) == set(ladder()["journal"])
