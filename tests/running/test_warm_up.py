"""Kernels are compiled once, by a case in miniature that every stage can take."""

import pytest
from small_run import small_scene

from loadflow.cube import check_case
from loadflow.planning.pilot import Questions
from loadflow.planning.plan import make_plan
from loadflow.running.warm_up import compile_for_pilot, compile_kernels, made_up_loads


class TwoWorkers:
    """Says that it has two workers, and does the work here."""

    workers, shares_disk = 2, True

    def __init__(self):
        self.jobs = []

    def outcomes(self, work, items):
        for item in items:
            self.jobs.append((item, work(item)))
            yield self.jobs[-1]


@pytest.fixture
def plan(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "kernels"))
    (tmp_path / "kernels").mkdir()
    results = ("reduction.histogram", "rolling.loads", "journal.film")
    return make_plan(small_scene(tmp_path, results, journal={"grid": [24, 8]}))


def test_all_stages_take_the_case_in_miniature_and_it_is_done_once(plan, tmp_path):
    where, told = TwoWorkers(), []
    compile_kernels(plan, where, lambda *what: told.append(what))
    assert where.jobs == [("other", "")]  # given loads: nothing to simulate; nothing failed
    assert told[-1][1:] == (1, 1)
    assert len(list((tmp_path / "kernels").glob("*.compiled"))) == 1
    compile_kernels(plan, where, lambda *what: told.append(what))
    assert len(where.jobs) == 1


def test_questions_of_a_pilot_are_asked_in_miniature_each_model_by_itself(plan, tmp_path):
    """The stages that no question is about are one more job; all are done once."""
    questions = Questions(
        plan.scene, ("motion of the film", "inertia of the balls"), 60.0, plan.cases[:1]
    )
    where, told = TwoWorkers(), []
    for _ in range(2):
        compile_for_pilot(questions, lambda: plan, where, lambda *what: told.append(what))
    assert where.jobs == [("journal", ""), ("rolling", ""), ("other", "")]
    assert [what[1:] for what in told] == [(0, 3), (1, 3), (2, 3), (3, 3)]
    assert len(list((tmp_path / "kernels").glob("*.compiled"))) == 1


def test_a_process_alone_compiles_when_it_calls(plan, tmp_path):
    where = TwoWorkers()
    where.workers = 1
    compile_kernels(plan, where, lambda *what: None)
    assert where.jobs == []
    assert not list((tmp_path / "kernels").iterdir())


def test_made_up_loads_are_those_of_a_load_case(plan):
    series = made_up_loads(plan.scene, plan.cases[0])
    check_case(series)
    assert float(series["hub_force"].sel(axis="z").mean()) == pytest.approx(-1.63e6, rel=0.02)
    assert float(series["speed"].mean()) == pytest.approx(1.267, rel=0.05)
