"""A run computes what is wanted and nothing else, once, and gives the same again."""

import json
import shutil
import sys
import tomllib
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from synthetic import cube_file

import loadflow as lf
from loadflow.cube import open_cube
from loadflow.cube.hdf5 import read_whole
from loadflow.errors import InputError, ValidityWarning
from loadflow.planning.plan import make_plan
from loadflow.running.cases import open_inputs
from loadflow.running.earlier import _as_written, _changed
from loadflow.running.folder import part_file
from loadflow.running.runner import run_on
from loadflow.scene.scene import make_scene, read_scene
from loadflow.stages.films.of_bearing import equilibria

PIPELINES = Path(__file__).parents[2] / "pipelines"


def scene_of(cube, **keys):
    data = {
        "name": "small",
        "accuracy": "given",
        "loads": {"source": "files", "files": [str(cube)]},
        "reduction": {"size": 0.05},
        "journal": {"grid": [24, 8], "bearings": ["N2"]},
    }
    return make_scene(data | keys)


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    return cube_file(tmp_path_factory.mktemp("cube") / "loads.h5")


@pytest.fixture(scope="module")
def shared():
    """Parts of a case that its stages share, as each stage begins, that are not as on disk."""
    return {"looked at": 0, "changed": []}


@pytest.fixture(scope="module")
def finished(cube, tmp_path_factory, shared):
    def watched(step, case, folder, opened):
        for name, data in opened.items():
            shared["looked at"] += 1
            if not data.identical(read_whole(part_file(folder, name, case))):
                shared["changed"].append(f"{name}, before {step.name}")
        return open_inputs(step, case, folder, opened)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("loadflow.running.cases.open_inputs", watched)
        return lf.run(scene_of(cube), out=tmp_path_factory.mktemp("runs"), report=False)


def groups(tree):
    return {node.path: node.to_dataset() for node in tree.subtree if node.data_vars}


def assert_same(first, second):
    assert groups(first).keys() == groups(second).keys()
    for path, dataset in groups(first).items():
        xr.testing.assert_identical(dataset.load(), groups(second)[path].load())


def test_rolling_life_never_touches_the_film_solver(cube):
    plan = make_plan(scene_of(cube, results=["rolling.life"]))
    stages = ["loads", "shaft", "reduction", "rolling", "check"]
    assert [step.name for step in plan.steps] == stages
    assert plan.steps[-1].needs == ("loads", "shaft", "reduction", "rolling")
    assert "journal" in plan.left_out


def test_given_loads_never_touch_wind(cube):
    assert "wind, rotor" in make_plan(scene_of(cube)).left_out


def test_the_plan_says_which_effects_are_off(cube):
    effects = {"heat of the film", "motion of the film", "tilt of the shaft"}
    assert effects <= make_plan(scene_of(cube, results=["journal.film"])).left_out.keys()
    full = {"heat": {}, "motion": "transient", "tilt": True}
    told = make_plan(scene_of(cube, results=["journal.film"], journal=full)).left_out
    assert not effects & told.keys()
    assert not effects & make_plan(scene_of(cube, results=["rolling.life"])).left_out.keys()


def test_the_shares_of_the_lifetime_add_up(cube):
    assert sum(case.weight for case in make_plan(scene_of(cube)).cases) == pytest.approx(1.0)


def test_a_run_answers_all_that_was_asked(finished):
    tree = finished.tree
    assert set(tree.children) == {
        "statistics", "seeds", "journal", "rolling", "friction", "check", "verdicts", "lifetime",
        "loads", "energy", "shaft",
    }  # fmt: skip
    assert tree["energy"]["rotor_power"].dims == ("case",)
    assert np.isfinite(tree["energy"]["journal_loss"]).all()
    journal = tree["journal"].to_dataset()
    assert journal.sizes == {"bearing": 1, "case": 4}
    assert (journal["not_converged"] == 0).all()
    assert (
        (journal["largest_eccentricity_ratio"] > 0.2) & (journal["largest_eccentricity_ratio"] < 1)
    ).all()
    assert (tree["rolling"]["largest_ball_force"] > 1e3).all()
    assert finished.failures == finished.flagged == {}


def test_no_stage_changes_the_parts_that_the_next_one_is_given(finished, shared):
    assert shared["looked at"] >= 8 * len(finished.tree["loads"]["case"])
    assert shared["changed"] == []


def test_every_number_of_the_result_has_units_and_a_meaning(finished):
    for path, dataset in groups(finished.tree).items():
        for name, variable in dataset.data_vars.items():
            if variable.dtype.kind in "fi":
                assert "units" in variable.attrs, f"{path}/{name}"
                assert "long_name" in variable.attrs, f"{path}/{name}"


def test_a_run_that_was_killed_goes_on_and_gives_identical_results(cube, finished, tmp_path):
    scene = scene_of(cube)
    folder = tmp_path / "small"
    shutil.copytree(finished.path, folder)
    # as a kill would leave it: parts missing, a temporary file, no result
    stamp = (folder / "journal" / "dlc1.1_v8_s1.h5").stat().st_mtime_ns
    for name in ("journal/dlc1.1_v8_s2.h5", "loads/dlc1.1_v12_s1.h5", "shaft/dlc1.1_v12_s2.h5"):
        (folder / name).unlink()
    for name in ("seeds.h5", "result.h5"):
        (folder / name).unlink()
    (folder / "journal" / ".dlc1.1_v8_s2.h5.99.loadflow-tmp").write_bytes(b"half")
    again = lf.run(scene, out=tmp_path, report=False)
    assert_same(again.tree, finished.tree)
    assert (folder / "journal" / "dlc1.1_v8_s1.h5").stat().st_mtime_ns == stamp
    assert not list(folder.rglob(".*.loadflow-tmp"))


def run_to(scene, out, workers):
    """Run a scene; whether this process has loaded what draws."""
    lf.run(scene, out=out, workers=workers, report=False)
    return "matplotlib" in sys.modules


def test_two_processes_give_the_numbers_of_one(tmp_path):
    """To the bit. The one is new, too: it loads the compiled kernels that the two load."""
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,))
    alone, both = tmp_path / "one", tmp_path / "two"
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as fresh:
        draws = fresh.submit(run_to, scene_of(cube), alone, 1).result()
    assert not draws  # without a page, and before it is written
    run_to(scene_of(cube), both, 2)
    one, two = (xr.open_datatree(next(out.glob("*/result.h5"))) for out in (alone, both))
    assert_same(one, two)


@pytest.mark.slow
def test_a_dask_cluster_gives_the_numbers_of_one_process(cube, finished, tmp_path):
    """Of films, too; `running/test_commands_stop.py` has the shorter one, which loses a worker."""
    distributed = pytest.importorskip("dask.distributed")
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None
    ) as cluster:
        address = cluster.scheduler_address
        run = lf.run(scene_of(cube), out=tmp_path, scheduler=address, report=False)
    assert_same(finished.tree, run.tree)


def test_single_precision_of_stored_loads_moves_the_film_by_less_than_a_millionth(cube):
    options = scene_of(cube).journal
    force = np.random.default_rng(0).normal(0, 1e6, (50, 3))
    speed = np.full(50, 1.2)
    exact = equilibria(options, force, speed)
    stored = equilibria(options, force.astype("f4"), speed.astype("f4"))
    for name in ("eccentricity_ratio", "maximum_pressure", "friction_power"):
        off = np.abs(getattr(stored, name) / getattr(exact, name) - 1)
        assert 0 < off.max() < 1e-6, name


def test_parts_of_other_settings_are_refused_unless_overwritten(cube, tmp_path):
    narrow = {"results": ["reduction.histogram"]}
    lf.run(scene_of(cube, **narrow), out=tmp_path, report=False)
    other = scene_of(cube, **narrow, reduction={"size": 0.2})
    told = r"'reduction' that were made with other settings or inputs \(reduction\.size\)"
    with pytest.raises(InputError, match=told):  # before a process is asked for, or a pilot
        run_on(no_processes(), other, tmp_path)
    lf.run(other, out=tmp_path, overwrite=True, report=False)
    reduced = open_cube(tmp_path / "small" / "reduction" / "dlc1.1_v8_s1.h5")
    assert reduced["N"].sizes["sample"] >= 0.2 * 400


def test_another_lubricant_is_told_of_rolling_bearings_and_not_of_films():
    """A plan that leaves the heat of a film out writes its own viscosity."""
    for section, told in (("friction", ["friction.lubricant"]), ("journal", [])):
        before, stated = ({"lubricant": {"viscosity": value}} for value in (0.1, 0.2))
        if section == "friction":
            before, stated = {"lubricant": "mineral-vg-320"}, {"lubricant": "lgep-2"}
        assert [*_changed(stated, before, section)] == told


def test_load_cases_of_other_content_are_refused_before_anything_works(cube, tmp_path):
    own = tmp_path / "own.h5"
    shutil.copy(cube, own)
    lf.run(scene_of(own, results=["loads.statistics"]), out=tmp_path, report=False)
    own.unlink()
    cube_file(own, wind_speeds=(8.0,))
    with pytest.raises(InputError, match=r"'loads' .* \(the content of .*own\.h5\)"):
        run_on(
            no_processes(),
            scene_of(own, results=["loads.statistics"], seeds={"alpha": 0.1}),
            tmp_path,
        )


@contextmanager
def no_processes():
    pytest.fail("processes are asked for")
    yield


def test_a_finished_run_asks_for_no_processes_until_something_is_left_to_do(
    cube, finished, tmp_path
):
    shutil.copytree(finished.path, tmp_path / "small")
    for _ in range(2):
        again = run_on(no_processes(), scene_of(cube), tmp_path, report=False)
        assert_same(again.tree, finished.tree)
        assert again.warnings == finished.warnings
        assert str(again.verdicts) == str(finished.verdicts)  # NaN is itself there
        assert (again.unused, again.shortfalls) == (finished.unused, finished.shortfalls)
    part = tmp_path / "small/journal/dlc1.1_v8_s2.h5"
    for spoil in (lambda: part.write_bytes(part.read_bytes()[:-200]), part.unlink):
        spoil()
        with pytest.raises(pytest.fail.Exception, match="processes are asked for"):
            run_on(no_processes(), scene_of(cube), tmp_path, report=False)


@pytest.mark.parametrize("name", ["quick_look", "dlc_3_1_startup", "friction"])
def test_a_plan_keeps_the_keys_that_a_scene_states(name):
    """So that a folder of other keys is refused by them before there is a plan."""
    scene = read_scene(PIPELINES / f"{name}.toml")
    planned = make_scene(tomllib.loads(make_plan(scene).scene.to_toml())).model_dump(mode="json")
    stated = scene.model_dump(mode="json", exclude_unset=True)
    rooms = {room: value for room, value in stated.items() if room not in ("name", "candidates")}
    assert [*_changed(rooms, planned, "")] == []


def test_a_further_result_uses_what_is_there(cube, tmp_path):
    lf.run(scene_of(cube, results=["reduction.histogram"]), out=tmp_path, report=False)
    part = tmp_path / "small" / "reduction" / "dlc1.1_v12_s2.h5"
    stamp = part.stat().st_mtime_ns
    lf.run(
        scene_of(cube, results=["reduction.histogram", "rolling.loads"]), out=tmp_path, report=False
    )
    assert part.stat().st_mtime_ns == stamp


def test_the_manifest_records_how_the_numbers_came_about(finished):
    manifest = json.loads((finished.path / "manifest.json").read_text())
    assert len(manifest["cases"]) == 4
    assert manifest["versions"]["loadflow"] == lf.__version__
    assert all(len(digest) == 64 for digest in manifest["inputs"].values())
    assert set(manifest["seconds"]) >= {"loads", "journal", "rolling", "seeds"}


def with_speed(path, **of_case):
    cube = open_cube(path).load()
    for case, (steps, value) in of_case.items():
        cube["speed"].loc[{"case": case}][steps] = value
    cube.to_netcdf(path, engine="h5netcdf")


def test_a_case_without_an_answer_is_reported_and_the_others_are_kept(tmp_path):
    path = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1, 2), steps=120)
    # so fast that the oil finds no heat balance below its largest temperature
    with_speed(path, **{"dlc1.1_v8_s1": (slice(None), 60.0)})
    warm = {"grid": [24, 8], "heat": {"inlet_temperature": 390.0}}
    with pytest.warns(ValidityWarning):
        result = lf.run(scene_of(path, journal=warm), out=tmp_path / "runs")
    (part, reason), *rest = result.failures.items()
    assert part == "dlc1.1_v8_s1, journal"
    assert "no film carries any" in reason
    assert rest == []
    assert result.tree["journal"].sizes["case"] == 1
    assert result.tree["rolling"].sizes["case"] == 2
    assert "no film carries any" in result.report.read_text()
    (verdict,) = (v for v in result.verdicts if v.quantity == "load cases not answered")
    assert (verdict.subject, verdict.value, verdict.answer) == ("journal", 1, "broken")


def test_samples_at_standstill_are_counted_and_the_rest_of_the_series_is_answered(tmp_path):
    path = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,))
    with_speed(path, **{"dlc1.1_v8_s1": (slice(0, 40), 0.0)})
    result = lf.run(scene_of(path, results=["journal.film"]), out=tmp_path, report=False)
    journal = result.tree["journal"].to_dataset().squeeze()
    samples = open_cube(tmp_path / "small" / "journal" / "dlc1.1_v8_s1.h5")["N2"]
    still = samples["speed"].values == 0
    assert still.any()
    assert journal["in_contact"] == still.sum()
    assert journal["not_converged"] == 0
    assert result.flagged == {}
    assert np.isnan(samples["eccentricity_ratio"].values[still]).all()
    assert np.isfinite(samples["eccentricity_ratio"].values[~still]).all()


def test_nan_in_a_series_is_named_before_anything_runs(tmp_path):
    path = cube_file(tmp_path / "loads.h5")
    broken = open_cube(path).load()
    broken["speed"][1, 7] = np.nan
    broken.to_netcdf(path, engine="h5netcdf")
    with pytest.raises(InputError, match=r"loads\.h5.*dlc1\.1_v8_s2.*speed.*7"):
        lf.run(scene_of(path), out=tmp_path / "runs")


def test_keys_that_differ_are_named_as_a_scene_writes_them():
    stated = {"bearings": ["journal-lemon", "tapered-pair"], "loads": {"seeds": 1}}
    keys = ["journal.geometry.diameter", "rolling.geometry.rollers", "loads.seeds"]
    written = ["bearings.N.geometry.diameter", "bearings.M.geometry.rollers", "loads.seeds"]
    assert _as_written(make_scene({"name": "own", **stated}), keys) == written
