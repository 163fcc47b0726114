"""Carries a plan out: in parallel, resumable, with a record of how each number came about.

A run is a folder: ``scene.toml`` as resolved, ``manifest.json``, one file for each finished stage
and case, ``result.h5``, ``report.html`` and ``run.log``. A stage reads what it needs from these
files, never from memory, so a run that was killed and started again gives the same numbers.
"""

from __future__ import annotations

import errno
import logging
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from pathlib import Path

from threadpoolctl import threadpool_limits

import loadflow
from loadflow.errors import LoadflowError, SolverError
from loadflow.planning import verification as check
from loadflow.planning.accuracy import rungs_up
from loadflow.planning.choice import Choice, can_refine, refine
from loadflow.planning.effects import EffectVerdict, concerned
from loadflow.planning.pilot import Questions, pilot
from loadflow.planning.plan import Plan, make_plan, needed_stages, plan_of
from loadflow.planning.shortfalls import found_shortfalls
from loadflow.running.cases import (
    Outcome,
    do_case,
    is_missing,
)
from loadflow.running.earlier import check_settings, finished_run, mark_finished
from loadflow.running.executor import Executor, Lost, executor
from loadflow.running.folder import (
    known_verdict,
    part_files,
    prepare,
    record,
    refinements,
    save_result,
)
from loadflow.running.lock import locked
from loadflow.running.profile import COMPILING, FILE, LOAD_CASES, Profile
from loadflow.running.result import Run, collect, run_of
from loadflow.running.telling import Task, times_left
from loadflow.running.warm_up import (
    adopt,
    compile_for_pilot,
    compile_kernels,
    told_as_called,
)
from loadflow.running.whole import finish_stages
from loadflow.scene.cases import Case, list_cases
from loadflow.scene.scene import Scene
from loadflow.storage import check_name

log = logging.getLogger("loadflow.run")

Report = Callable[[str, int, int], None]
"""Told of progress: what is being done, units done, units in all."""


def run(
    scene: Scene,
    *,
    out: str | Path = "runs",
    workers: int = 1,
    scheduler: str | None = None,
    overwrite: bool = False,
    report: bool = True,
    progress: Report | None = None,
    profile: bool = False,
) -> Run:
    """Carry out what a scene wants.

    Parameters
    ----------
    scene : Scene
        What is wanted, see `loadflow.read_scene`.
    out : path
        Folder in which the folder of the run is made; it bears the scene's name. Finished parts
        that are there already, of the same settings, are used and not computed again.
    workers : int
        Processes on this machine. With more than one, a script must guard its entry with
        ``if __name__ == "__main__"``.
    scheduler : str, optional
        Address of a running Dask scheduler that takes the cases instead; its workers must see
        `out`.
    overwrite : bool
        Whether parts of other settings may be replaced.
    report : bool
        Whether to write the report page.
    progress : callable, optional
        Called with (stage, done, total).
    profile : bool
        Whether to write ``profile.json``: where the time went, also in the report.

    Returns
    -------
    Run
        Results and, where a solver had no answer for a case, the reasons.

    Raises
    ------
    loadflow.errors.InputError
        Bad load files, a bad name, or finished parts of other settings in the folder.
    loadflow.errors.SolverError
        No case at all could be answered.
    loadflow.errors.LoadflowError
        Another process is at work on the run; the disk is full or refuses; the scheduler or all
        workers are lost. What is finished stays, and the run goes on from there.

    Examples
    --------
    >>> import tempfile
    >>> from loadflow.cube import make_case, make_cube, save_cube
    >>> from loadflow.running.runner import run
    >>> from loadflow.scene import make_scene
    >>> data = {"speed": [1.2] * 50, "hub_force": [[3e5] * 50] * 3, "hub_moment": [[1e6] * 50] * 3}
    >>> case = make_case([0.1 * k for k in range(50)], data, dlc="1.1", wind_speed=8.0, seed=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     loads = {"files": [str(save_cube(make_cube([case]), f"{folder}/loads.h5"))]}
    ...     scene = make_scene({"name": "look", "results": ["loads.statistics"], "loads": loads})
    ...     done = run(scene, out=folder, report=False)
    ...     there = (done.path / "manifest.json").exists()
    >>> there, list(done.tree.children)
    (True, ['loads', 'shaft', 'statistics'])
    """
    where = executor(workers, scheduler)
    told = Profile() if profile else None
    return run_on(where, scene, out, overwrite=overwrite, report=report, say=progress, profile=told)


def run_on(
    where: AbstractContextManager[Executor],
    scene: Scene,
    out: str | Path,
    *,
    overwrite: bool = False,
    report: bool = True,
    say: Report | None = None,
    profile: Profile | None = None,
) -> Run:
    """Carry out what a scene wants, where it says; else as `run`."""
    # absolute, as the workers of a cluster stand elsewhere
    folder = Path(out).absolute() / check_name(scene.name, "name of the run")
    say = say or (lambda stage, done, total: None)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with locked(folder), _logged(folder):
            if profile is None and (done := finished_run(folder, scene, report)) is not None:
                log.info("%s: finished before, nothing is left to do", folder)
                say(LOAD_CASES, 1, 1)
                return done
            if not overwrite:
                check_settings(folder, scene)
            with where as workers:
                return _run(scene, folder, workers, overwrite, report, say, profile)
    except OSError as error:
        place = error.filename or folder
        way = (
            "out (-o) names another folder for runs"
            if error.errno in _LOCKED
            else "what is finished stays, and the run goes on from there when it is started again"
        )
        raise LoadflowError(f"{error.strerror or error}: {place}; {way}") from error


_LOCKED = {errno.EACCES, errno.EPERM, errno.EROFS}
"""A folder that cannot be written, however often one tries."""


class _LogFile(logging.FileHandler):
    def handleError(self, record: logging.LogRecord) -> None:
        """Go on without the log: a disk that refuses is told of by what matters more."""


@contextmanager
def _logged(folder: Path) -> Iterator[None]:
    """Write what is said of the run into its folder as well."""
    handler = _LogFile(folder / "run.log", encoding="utf-8")
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)-7s %(message)s"))
    level = log.level
    log.addHandler(handler)
    log.setLevel(logging.INFO)
    try:
        yield
    except BaseException as error:
        log.error("stopped: %s", str(error) or type(error).__name__, extra=ONLY_LOGGED)
        raise
    finally:
        log.setLevel(level)
        log.removeHandler(handler)
        handler.close()


ONLY_LOGGED = {"only_logged": True}
"""Of records for the log file, which whoever calls tells in a way of their own."""


def _run(
    scene: Scene,
    folder: Path,
    where: Executor,
    overwrite: bool,
    report: bool,
    say: Report,
    profile: Profile | None,
) -> Run:
    log.info("loadflow %s, %s, %d workers", loadflow.__version__, folder, where.workers)
    refined = refinements(folder, scene)
    compiled = 0.0

    def compiles(questions: Questions, choice: Choice) -> None:
        nonlocal compiled
        started = time.perf_counter()

        def expected() -> Plan:
            solve = any(one.solves for one in concerned(choice.scene, needed_stages(choice.scene)))
            if solve and "thrust" not in questions.models:  # else the pilot measures what they say
                return make_plan(scene, refined)
            return plan_of(scene, refine(choice, refined), tuple(list_cases(scene)))

        compile_for_pilot(questions, expected, where, say, folder)
        compiled = time.perf_counter() - started

    begun = time.perf_counter()
    with told_as_called(where, say):
        pilot_verdict = known_verdict(folder, scene) or pilot(
            scene, say, where.outcomes, before=compiles, brief=True
        )
    if profile:
        profile.add_wall(COMPILING, compiled)
        profile.add_wall("pilot", time.perf_counter() - begun - compiled)
    while True:
        started = time.perf_counter()
        plan = make_plan(scene, refined, pilot_verdict)
        manifest = prepare(folder, scene, plan, refined, overwrite, pilot_verdict)
        adopt(folder, plan)
        with told_as_called(where, say):
            timing, failures = _carry_out(plan, folder, where, say, profile, pilot_verdict)
        begun = time.perf_counter()
        tree = collect(plan, folder, where)
        save_result(folder, tree, plan)
        wall = time.perf_counter() - started
        if profile:
            profile.add_wall("result", time.perf_counter() - begun)
        checked = tree.children.get(check.CHECK.name)
        found = [] if checked is None else found_shortfalls(scene, plan.scene, checked.to_dataset())
        manifest["shortfalls"] = short = (*found, *plan.shortfalls)
        record(folder, manifest, timing, failures, workers=where.workers, wall=wall)
        can, rungs = partial(can_refine, scene, plan.scene), partial(rungs_up, plan.scene)
        higher = check.to_refine(tree, can, rungs)
        if not higher:
            break
        log.info("not accurate enough, better models of: %s", ", ".join(dict.fromkeys(higher)))
        refined = [*refined, *higher]
        overwrite = True  # the parts of the coarser models are this run's own
    if not profile:
        (folder / FILE).unlink(missing_ok=True)  # that of an earlier start
        if not failures:
            mark_finished(folder, scene, plan, manifest)
    if report:
        begun = time.perf_counter()
        say("report", 0, 1)
        if profile:
            profile.write(folder / FILE, where.workers)  # the page shows it
        from loadflow.running.pages.report import write_report  # what draws, only now

        write_report(folder, again=profile is not None)
        say("report", 1, 1)
        if profile:
            profile.add_wall("report", time.perf_counter() - begun)
    if profile:
        profile.write(folder / FILE, where.workers)
    log.info("finished, %d parts have no answer", len(failures))
    return run_of(folder, scene, tree, failures, short, plan.overloaded)


@threadpool_limits.wrap(limits=1)  # cases are what runs in parallel, here as in other processes
def _carry_out(
    plan: Plan,
    folder: Path,
    where: Executor,
    say: Report,
    profile: Profile | None,
    pilot_verdict: EffectVerdict | None,
) -> tuple[dict[str, float], dict[str, str]]:
    """Do what is missing of a plan; return seconds by stage, and what has no answer."""
    timing: dict[str, float] = {}
    failures: dict[str, str] = {}
    todo = [case for case in plan.cases if is_missing(plan, case, folder)]
    done = len(plan.cases) - len(todo)
    log.info("%d load cases, %d of them finished", len(plan.cases), done)
    begun = time.perf_counter()
    if len(todo) > 1:
        compile_kernels(plan, where, say, folder)
    compiled = time.perf_counter()
    left = iter(_expected(plan, todo, where.workers))
    say(next(left), done, len(plan.cases))
    work = partial(do_case, scene=plan.scene, steps=tuple(plan.of_scope("case")), folder=folder)
    for case, outcome in where.outcomes(work, todo):
        done += 1
        if isinstance(outcome, Lost):
            failures[f"{case.name}, worker"] = outcome.reason
            log.error("%s: %s", case.name, outcome.reason, extra=ONLY_LOGGED)
        else:
            _note(case, outcome, timing, failures, profile)
        say(next(left), done, len(plan.cases))
    if profile:
        profile.add_wall(COMPILING, compiled - begun)
        profile.add_wall(LOAD_CASES, time.perf_counter() - compiled)
    if plan.cases and not any((folder / "loads").glob("*.h5")):
        raise SolverError("no load case could be answered:\n" + _lines(failures))
    _check_there(plan, folder, failures)

    seen = pilot_verdict.cases if pilot_verdict else ()
    begun = time.perf_counter()
    for stage in finish_stages(plan, folder, where, say, seen):
        timing[stage.name] = stage.seconds
        log.info("%s: %.1f s, %.1f s of it compiling", stage.name, stage.seconds, stage.compiling)
    if profile:
        profile.add_wall("stages over all cases", time.perf_counter() - begun)
    return timing, failures


def _expected(plan: Plan, cases: list[Case], workers: int) -> list[str]:
    """What is said before any case is done, and after each: it knows what the ladder does."""
    seconds = sum(step.seconds or 0.0 for step in plan.of_scope("case"))
    if seconds == 0.0 or not all(case.steps for case in plan.cases):
        return [LOAD_CASES] * (len(cases) + 1)
    each = seconds / sum(case.steps for case in plan.cases)
    left = times_left([each * case.steps for case in cases], workers)
    return [Task(LOAD_CASES, rest) for rest in left]


def _note(
    case: Case,
    outcome: Outcome,
    timing: dict[str, float],
    failures: dict[str, str],
    profile: Profile | None,
) -> None:
    """Keep what became of a case."""
    failures |= outcome.failures
    for stage, seconds in outcome.seconds.items():
        timing[stage] = timing.get(stage, 0.0) + seconds
    if profile:
        profile.add(outcome)
    spent = ", ".join(f"{stage} {seconds:.1f} s" for stage, seconds in outcome.seconds.items())
    log.info("%s: %s", case.name, spent or "nothing new")
    for part, why in outcome.failures.items():
        log.error("%s: %s", part, why, extra=ONLY_LOGGED)
    for trace in outcome.traces:
        log.error("%s", trace, extra=ONLY_LOGGED)


def _check_there(plan: Plan, folder: Path, failures: dict[str, str]) -> None:
    """Raise if parts are not where the workers said that they wrote them."""
    failed = {part.rsplit(", ", 1)[0] for part in failures}
    answered = [case for case in plan.cases if case.name not in failed]
    gone = [
        path
        for step in plan.of_scope("case")
        for path in part_files(folder, step.stage, answered)
        if not path.exists()
    ]
    if gone:
        raise LoadflowError(
            f"{len(gone)} finished parts are not in the folder of the run, {gone[0]} among them; "
            "was it changed meanwhile, or do the workers see another one? Started again, the run "
            "goes on where it was"
        )


def _lines(failures: dict[str, str]) -> str:
    return "\n".join(f"  {name}: {reason}" for name, reason in failures.items())
