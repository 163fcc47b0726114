"""Kernels are compiled once, by a case in miniature that every stage can take."""

from pathlib import Path

import numba
import pytest
from small_run import small_scene

from loadflow.cube import check_case
from loadflow.cube.hdf5 import read_whole
from loadflow.planning.effects import switched
from loadflow.planning.pilot import Questions
from loadflow.planning.plan import make_plan
from loadflow.running import warm_up
from loadflow.running.cases import do_case
from loadflow.running.folder import part_file
from loadflow.running.parts import digest_of, is_sound, save_part
from loadflow.running.warm_up import (
    EARLY,
    adopt,
    compile_for_pilot,
    compile_kernels,
    made_up_loads,
    told_as_called,
    without_own_kernels,
)
from loadflow.scene import make_scene, read_scene
from loadflow.scene.cases import list_cases
from loadflow.stages.effects.film_heat import HEAT
from loadflow.stages.films.of_bearing import surely_carried
from loadflow.stages.shaft import bearing_loads

PIPELINES = Path(__file__).parents[2] / "pipelines"


class TwoWorkers:
    """Says that it has two workers, and does the work here."""

    workers, shares_disk = 2, True

    def __init__(self):
        self.jobs = []

    def outcomes(self, work, items):
        for item in items:
            self.jobs.append((item, work(item)))
            yield self.jobs[-1]


def marks_go_to(folder, monkeypatch):
    """No mark is there yet; kernels stay where they are, as they take minutes to compile again."""
    folder.mkdir(parents=True)
    monkeypatch.setattr(warm_up, "kernel_folders", lambda: [folder])


@pytest.fixture
def plan(tmp_path, monkeypatch):
    marks_go_to(tmp_path / "kernels", monkeypatch)
    results = ("reduction.histogram", "rolling.loads", "journal.film")
    return make_plan(small_scene(tmp_path, results, journal={"grid": [24, 8]}))


def test_all_stages_take_the_case_in_miniature_and_it_is_done_once(plan, tmp_path):
    where, told = TwoWorkers(), []
    compile_kernels(plan, where, lambda *what: told.append(what), tmp_path)
    assert where.jobs == [("other", "")]  # given loads: nothing to simulate; nothing failed
    assert told[-1][1:] == (1, 1)
    assert len(list((tmp_path / "kernels").glob("*.compiled"))) == 1
    compile_kernels(plan, where, lambda *what: told.append(what), tmp_path)
    assert len(where.jobs) == 1


def test_questions_of_a_pilot_are_asked_in_miniature_each_model_by_itself(plan, tmp_path):
    """The stages that no question is about are one more job; all are done once."""
    questions = Questions(
        plan.scene, ("motion of the film", "inertia of the balls"), 60.0, plan.cases[:1]
    )
    where, told = TwoWorkers(), []
    for _ in range(2):
        compile_for_pilot(questions, lambda: plan, where, lambda *what: told.append(what), tmp_path)
    assert where.jobs == [("rolling", ""), ("journal", ""), ("other", "")]  # the longest first
    assert [what[1:] for what in told] == [(0, 3), (1, 3), (2, 3), (3, 3)]
    left = [task.left for task, *_ in told]
    assert left == [29.0, 9.0, 4.0, 0.0]  # s: 29 beside 20 and 5
    assert len(list((tmp_path / "kernels").glob("*.compiled"))) == 1


def test_a_model_with_loops_for_some_effects_is_two_jobs(plan):
    """Of a film around a shaft that tilts, motion and heat are asked without the tilt, too."""
    effects = ("motion of the film", "heat of the film", "tilt of the shaft", "elastic shaft")
    tilted = plan.scene.journal.model_copy(update={"tilt": True})
    scene = plan.scene.model_copy(update={"journal": tilted})
    asked = Questions(scene, effects, 60.0, plan.cases[:1])
    simpler = without_own_kernels(asked, "journal")
    assert simpler.effects == ("motion of the film", "heat of the film")
    assert not simpler.scene.journal.tilt
    assert simpler.models == ("journal",)
    assert without_own_kernels(asked, "shaft") is None  # the same loops
    assert without_own_kernels(simpler, "journal") is None  # there is no simpler one


def test_a_film_that_is_asked_to_lie_aligned_is_one_job(plan):
    """On "reduced" the loops of a shaft that tilts answer all that is asked of it."""
    words = {"tilt": True, "rung": "reduced"}
    tilted = plan.scene.journal.model_copy(update=words)
    scene = plan.scene.model_copy(update={"journal": tilted})
    effects = ("motion of the film", "tilt of the shaft")
    assert without_own_kernels(Questions(scene, effects, 60.0, plan.cases[:1]), "journal") is None


ASPERITIES = {"roughness": 2e-6, "contact_modulus": 115e9, "factor": 1e-3}
CONTACT = {"asperities": ASPERITIES, "friction": 0.15}
THICK = {"kind": "thick", "outer_diameter": 3.5, "modulus": 210e9}
SHELLS = {"local": {"kind": "local", "compliance": 3e-12}, "all over": THICK}


@pytest.mark.parametrize(("shell", "jobs"), [(None, 1), ("local", 1), ("all over", 2)])
def test_films_around_a_tilted_shaft_are_one_job_but_for_a_shell_all_over(plan, shell, jobs):
    """They have the same loops with asperities and without: nothing is gained beside them."""
    words = {"tilt": True, "rung": "reduced", "contact": CONTACT, "shell": SHELLS.get(shell)}
    journal = {key: value for key, value in words.items() if value is not None}
    scene = make_scene({"results": ["journal.film"], "journal": journal})
    effects = ("motion of the film", "contact of asperities", "elastic shell")
    asked = Questions(scene, effects, 60.0, plan.cases[:1])
    assert (without_own_kernels(asked, "journal") is None) == (jobs == 1)


def test_a_process_alone_compiles_when_it_calls(plan, tmp_path):
    where = TwoWorkers()
    where.workers = 1
    compile_kernels(plan, where, lambda *what: None, tmp_path)
    assert where.jobs == []
    assert not list((tmp_path / "kernels").iterdir())


def test_marks_lie_beside_the_files_of_numba(monkeypatch, tmp_path):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    assert warm_up.kernel_folders() == [tmp_path]
    monkeypatch.delenv("NUMBA_CACHE_DIR")
    for folder in warm_up.kernel_folders():
        assert folder == Path(warm_up.__file__).with_name("__pycache__")


def test_made_up_loads_are_those_of_a_load_case(plan):
    series = made_up_loads(plan.scene, plan.cases[0])
    check_case(series)
    assert float(series["hub_force"].sel(axis="z").mean()) == pytest.approx(-1.63e6, rel=0.02)
    assert float(series["speed"].mean()) == pytest.approx(1.267, rel=0.05)


def test_a_film_surely_carries_some_made_up_loads_with_and_without_heat():
    """Else the pilot in miniature asks a grid what films carry at most, which compiles for 14 s."""
    scene = make_plan(read_scene(PIPELINES / "quick_look.toml")).scene
    for one in (scene, switched(scene, HEAT, False)):
        series = made_up_loads(one, list_cases(one)[0])
        shaft = bearing_loads(one, list_cases(one)[0], {"loads": series})
        for place in one.journal.bearings:
            force = shaft["force"].sel(bearing=place).transpose("time", "axis").values
            assert surely_carried(one.journal.at(place), force, series["speed"].values).any()


def test_a_process_alone_says_that_it_compiles_when_it_does():
    where, told = TwoWorkers(), []
    where.workers = 1
    kernel = numba.njit(lambda x: x + 1)  # not kept on the disk
    for _ in range(2):
        with told_as_called(where, lambda *what: told.append(what[1:])):
            kernel(1)
            kernel(1)
    assert told == [(0, 1), (1, 1)]


@pytest.fixture
def simulated(tmp_path):
    loads = {"wind_speeds": [12.0], "seeds": 2, "duration": 2.0, "rung": "tables"}
    loads |= {"wind_grid": [3, 8]}
    return make_plan(make_scene({"name": "s", "results": ["loads.statistics"], "loads": loads}))


def test_the_rotor_is_compiled_by_the_first_case_that_lacks_its_loads(
    simulated, tmp_path, monkeypatch
):
    """The part that the run keeps is the one that it would make itself."""
    first = simulated.steps[0]
    for k, case in enumerate(simulated.cases):
        marks_go_to(tmp_path / f"kernels/{k}", monkeypatch)
        compile_kernels(simulated, TwoWorkers(), lambda *what: None, tmp_path / "run")
        made = part_file(tmp_path / "run", "loads", case)
        assert is_sound(made)
        assert digest_of(made) == first.digest
    (tmp_path / "again/loads").mkdir(parents=True)
    do_case(case, simulated.scene, (first,), tmp_path / "again")
    assert read_whole(made).identical(read_whole(part_file(tmp_path / "again", "loads", case)))


def test_loads_and_half_of_the_rotor_are_the_first_jobs(simulated, tmp_path, monkeypatch):
    """Two processes compile the loop of the rotor at once, so that the first case is soon there."""
    marks_go_to(tmp_path / "kernels", monkeypatch)
    where = TwoWorkers()
    compile_kernels(simulated, where, lambda *what: None, tmp_path / "run")
    assert where.jobs == [("loads", ""), ("rotor", ""), ("other", "")]


def test_early_parts_are_taken_if_the_plan_has_their_settings(simulated, tmp_path):
    first, (one, two) = simulated.steps[0], simulated.cases
    series = made_up_loads(simulated.scene, one)
    for digest, taken in (("0" * 64, [one]), (first.digest, [one, two])):
        early = tmp_path / f"{EARLY}1"
        for place in (early, tmp_path):
            (place / "loads").mkdir(parents=True, exist_ok=True)
        save_part(series, part_file(tmp_path, "loads", one), first.digest)  # there already
        before = part_file(tmp_path, "loads", one).read_bytes()
        for case in (one, two):
            save_part(series, part_file(early, "loads", case), digest)
        adopt(tmp_path, simulated)
        assert not early.exists()
        assert part_file(tmp_path, "loads", one).read_bytes() == before
        there = [case for case in (one, two) if part_file(tmp_path, "loads", case).exists()]
        assert there == taken


def test_a_mark_is_kept_where_python_writes_no_bytecode(monkeypatch, tmp_path):
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setattr(warm_up, "__file__", str(tmp_path / "warm_up.py"))
    mark = warm_up.kernel_folders()[0] / "x.compiled"
    warm_up._compile(lambda job: "", {"other"}, [mark], TwoWorkers(), lambda *told: None)
    assert mark.exists()
