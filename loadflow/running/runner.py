"""Carries a plan out: in parallel, resumable, with a record of how each number came about.

A run is a folder: ``scene.toml`` as resolved, ``manifest.json``, one file for each finished stage
and case, ``result.h5`` and ``report.html``. A stage reads what it needs from these files, never
from memory, so a run that was killed and started again gives the same numbers.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import xarray as xr
from threadpoolctl import threadpool_limits

from loadflow.cube import open_cube, save_cube
from loadflow.errors import SolverError
from loadflow.planning import verification as check
from loadflow.planning.accuracy import can_refine
from loadflow.planning.effects import Verdict
from loadflow.planning.pilot import pilot
from loadflow.planning.plan import Plan, Step, make_plan
from loadflow.running.executor import executor, finished
from loadflow.running.folder import climbs, known_verdict, part_file, prepare, record
from loadflow.running.report_page import write_report
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.stages.registry import STAGES

Report = Callable[[str, int, int], None]
"""Told of progress: what is being done, units done, units in all."""


@dataclass(frozen=True)
class Run:
    """A finished run.

    Attributes
    ----------
    path : Path
        Its folder.
    tree : xarray.DataTree
        What was wanted: one group for each stage.
    failures : dict
        Load cases that a solver could not answer, and why.
    shortfalls : tuple of str
        Results that are not expected to be as accurate as asked for: how far off, why, what helps.
    """

    path: Path
    tree: xr.DataTree
    failures: dict[str, str] = field(default_factory=dict)
    shortfalls: tuple[str, ...] = ()

    @property
    def flagged(self) -> dict[str, int]:
        """Number of samples without an answer, by stage and case, where there are any."""
        found = {}
        for stage, node in self.tree.children.items():
            if "not_converged" in node:
                flags = node.to_dataset()["not_converged"]
                per_case = flags.sum([dim for dim in flags.dims if dim != "case"])
                for case in per_case["case"].values[per_case.to_numpy() > 0]:
                    found[f"{case}, {stage}"] = int(per_case.sel(case=case))
        return found

    @property
    def warnings(self) -> list[str]:
        """What the run found doubtful about its own models."""
        stages = (*STAGES.values(), check.CHECK)
        return [said for stage in stages for said in stage.warnings(self.tree)]

    @property
    def report(self) -> Path:
        """The report page."""
        return self.path / "report.html"


def run(
    scene: Scene,
    *,
    out: str | Path = "runs",
    workers: int = 1,
    scheduler: str | None = None,
    overwrite: bool = False,
    report: bool = True,
    progress: Report | None = None,
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

    Returns
    -------
    Run
        Results and, where a solver had no answer for a case, the reasons.

    Raises
    ------
    loadflow.errors.InputError
        Bad load files, or finished parts of other settings in the folder.
    loadflow.errors.SolverError
        No case at all could be answered.
    """
    folder = Path(out) / scene.name
    say = progress or (lambda stage, done, total: None)
    climbed = climbs(folder, scene)
    verdict = known_verdict(folder, scene) or pilot(scene, say)
    while True:
        started = time.perf_counter()
        plan = make_plan(scene, climbed, verdict)
        manifest = prepare(folder, scene, plan, climbed, overwrite, verdict)
        timing, failures = _carry_out(plan, folder, workers, scheduler, say, verdict)
        tree = _collect(plan, folder)
        save_cube(tree, folder / "result.h5")
        wall = time.perf_counter() - started
        record(folder, manifest, timing, failures, workers=workers, wall=wall)
        higher = [stage for stage in check.exceeded(tree) if can_refine(scene, plan.scene, stage)]
        if not higher:
            break
        climbed = [*climbed, *higher]
        overwrite = True  # the parts of the coarser models are this run's own
    if report:
        say("report", 0, 1)
        write_report(folder)
        say("report", 1, 1)
    return Run(folder, tree, failures, plan.shortfalls)


@threadpool_limits.wrap(limits=1)  # cases are what runs in parallel, here as in other processes
def _carry_out(
    plan: Plan,
    folder: Path,
    workers: int,
    scheduler: str | None,
    say: Report,
    verdict: Verdict | None,
) -> tuple[dict[str, float], dict[str, str]]:
    """Do what is missing of a plan; return seconds by stage, and what has no answer."""
    timing: dict[str, float] = {}
    failures: dict[str, str] = {}
    todo = [case for case in plan.cases if _missing(plan, case, folder)]
    work = partial(_do_case, scene=plan.scene, plan=plan, folder=folder)
    done = len(plan.cases) - len(todo)
    say("load cases", done, len(plan.cases))
    with executor(workers, scheduler) as submit:
        for outcome in finished(submit, work, todo):
            done += 1
            failures |= outcome.failures
            for stage, seconds in outcome.seconds.items():
                timing[stage] = timing.get(stage, 0.0) + seconds
            say("load cases", done, len(plan.cases))
    if plan.cases and not any((folder / "loads").glob("*.h5")):
        raise SolverError("no load case could be answered:\n" + _lines(failures))

    seen = verdict.cases if verdict else ()
    for whole in plan.of_scope("run"):
        say(whole.name, 0, 1)
        if not (target := part_file(folder, whole.name)).exists():
            begun = time.perf_counter()
            cases = _looked_at(whole, plan.cases, folder, seen)
            inputs = {case.name: _open(whole, case, folder) for case in cases}
            save_cube(whole.stage.run(plan.scene, cases, inputs), target)
            timing[whole.name] = time.perf_counter() - begun
        say(whole.name, 1, 1)
    return timing, failures


def _looked_at(
    step: Step, cases: tuple[Case, ...], folder: Path, seen: tuple[str, ...]
) -> list[Case]:
    """Return the cases that a stage over all of them reads: those that are there, or a sample.

    A sample is of other cases than the pilot has `seen`, where there are enough.
    """
    there, count = [case for case in cases if _ready(step, case, folder)], step.stage.sample
    if count is None or len(there) <= count:
        return there
    others = [case for case in there if case.name not in seen]
    some = others if len(others) >= count else there
    last, parts = len(some) - 1, count - 1
    return [some[round(k * last / parts)] for k in range(count)]


# --- one load case ---------------------------------------------------------------------------


@dataclass(frozen=True)
class _Outcome:
    """What became of one case: seconds for each stage, and the failure if there was one."""

    seconds: dict[str, float]
    failures: dict[str, str]


def _do_case(case: Case, scene: Scene, plan: Plan, folder: Path) -> _Outcome:
    """Run the stages of one case that are missing; runs in a worker process."""
    seconds: dict[str, float] = {}
    failures: dict[str, str] = {}
    for step in plan.of_scope("case"):
        target = part_file(folder, step.name, case)
        if target.exists() or not _ready(step, case, folder):
            continue
        begun = time.perf_counter()
        try:
            result = step.stage.run(scene, case, _open(step, case, folder))
        except SolverError as error:
            failures[f"{case.name}, {step.name}"] = str(error)
            continue
        save_cube(result, target)
        seconds[step.name] = time.perf_counter() - begun
    return _Outcome(seconds, failures)


def _missing(plan: Plan, case: Case, folder: Path) -> bool:
    return any(not part_file(folder, step.name, case).exists() for step in plan.of_scope("case"))


def _open(step: Step, case: Case, folder: Path) -> dict[str, Any]:
    return {need: open_cube(part_file(folder, need, case)) for need in step.needs}


def _ready(step: Step, case: Case, folder: Path) -> bool:
    """Whether all that the stage reads of this case is there."""
    return all(part_file(folder, need, case).exists() for need in step.needs)


def _collect(plan: Plan, folder: Path) -> xr.DataTree:
    """Join what the stages found, reduced to what a reader wants of each case."""
    groups: dict[str, xr.Dataset | xr.DataTree] = {}
    for step in plan.steps:
        if step.stage.scope == "run":
            groups[step.name] = open_cube(part_file(folder, step.name))
        elif step.stage.summarise:
            files = {case: part_file(folder, step.name, case) for case in plan.cases}
            parts = {case: open_cube(file) for case, file in files.items() if file.exists()}
            found = step.stage.summarise(parts) if parts else None
            if found is not None:
                groups[step.name] = found
    return xr.DataTree.from_dict(
        {
            f"{name}/{path}".rstrip("/"): node
            for name, data in groups.items()
            for path, node in _nodes(data)
        }
    )


def _nodes(data: xr.Dataset | xr.DataTree) -> Iterator[tuple[str, xr.Dataset]]:
    if isinstance(data, xr.Dataset):
        yield "", data
    else:
        for node in data.subtree:
            yield node.path.strip("/"), node.to_dataset(inherit=False)


def _lines(failures: dict[str, str]) -> str:
    return "\n".join(f"  {name}: {reason}" for name, reason in failures.items())
