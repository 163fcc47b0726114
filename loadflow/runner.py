"""Carries a plan out: in parallel, resumable, with a record of how each number came about.

A run is a folder: ``scene.toml`` as resolved, ``manifest.json``, one file for each finished stage
and case, ``result.h5`` and ``report.html``. A stage reads what it needs from these files, never
from memory, so a run that was killed and started again gives the same numbers.
"""

from __future__ import annotations

import json
import os
import platform
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from importlib import import_module, metadata
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import xarray as xr

import loadflow
from loadflow.cube import open_cube, save_cube
from loadflow.errors import InputError, SolverError
from loadflow.plan import STAGES, Plan, Stage, make_plan
from loadflow.scene import Scene
from loadflow.stages.cases import Case
from loadflow.stages.report import write_report

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
    """

    path: Path
    tree: xr.DataTree
    failures: dict[str, str] = field(default_factory=dict)

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
    started = time.perf_counter()
    plan = make_plan(scene)
    folder = Path(out) / scene.name
    manifest = _prepare(folder, scene, plan, overwrite)
    say = progress or (lambda stage, done, total: None)

    timing: dict[str, float] = {}
    failures: dict[str, str] = {}
    todo = [case for case in plan.cases if _missing(plan, case, folder)]
    work = partial(_do_case, scene=scene, plan=plan, folder=folder)
    done = len(plan.cases) - len(todo)
    say("load cases", done, len(plan.cases))
    with _executor(workers, scheduler) as submit:
        for outcome in _finished(submit, work, todo):
            done += 1
            failures |= outcome.failures
            for stage, seconds in outcome.seconds.items():
                timing[stage] = timing.get(stage, 0.0) + seconds
            say("load cases", done, len(plan.cases))
    if plan.cases and not any((folder / "loads").glob("*.h5")):
        raise SolverError("no load case could be answered:\n" + _lines(failures))

    over_all = [step.stage for step in plan.of_scope("run")]
    for number, whole in enumerate(over_all):
        say(whole.name, number, len(over_all))
        if not (target := _file(folder, whole)).exists():
            begun = time.perf_counter()
            cases = [case for case in plan.cases if _ready(whole, case, folder)]
            inputs = {case.name: _open(whole, case, folder) for case in cases}
            save_cube(_call(whole, scene, cases, inputs), target)
            timing[whole.name] = time.perf_counter() - begun
        say(whole.name, number + 1, len(over_all))
    tree = _collect(plan, folder)
    save_cube(tree, folder / "result.h5")
    _write_manifest(
        folder, manifest, timing, failures, workers=workers, wall=time.perf_counter() - started
    )
    if report:
        say("report", 0, 1)
        write_report(folder)
        say("report", 1, 1)
    return Run(folder, tree, failures)


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
        target = _file(folder, step.stage, case)
        if target.exists() or not _ready(step.stage, case, folder):
            continue
        begun = time.perf_counter()
        try:
            result = _call(step.stage, scene, case, _open(step.stage, case, folder))
        except SolverError as error:
            failures[f"{case.name}, {step.stage.name}"] = str(error)
            continue
        save_cube(result, target)
        seconds[step.stage.name] = time.perf_counter() - begun
    return _Outcome(seconds, failures)


def _call(stage: Stage, *arguments: Any) -> Any:
    module, function = stage.function.split(":")
    return getattr(import_module(module), function)(*arguments)


def _file(folder: Path, stage: Stage, case: Case | None = None) -> Path:
    return folder / f"{stage.name}.h5" if case is None else folder / stage.name / f"{case.name}.h5"


def _missing(plan: Plan, case: Case, folder: Path) -> bool:
    return any(not _file(folder, step.stage, case).exists() for step in plan.of_scope("case"))


def _open(stage: Stage, case: Case, folder: Path) -> dict[str, Any]:
    return {need: open_cube(_file(folder, STAGES[need], case)) for need in stage.needs}


def _ready(stage: Stage, case: Case, folder: Path) -> bool:
    """Whether all that the stage reads of this case is there."""
    return all(_file(folder, STAGES[need], case).exists() for need in stage.needs)


# --- where the cases are worked on -----------------------------------------------------------

Submit = Callable[[Callable[[Case], _Outcome], Case], Any]


@contextmanager
def _executor(workers: int, scheduler: str | None) -> Iterator[Submit | None]:
    """Yield what takes a function and a case and gives a future; None to work in this process."""
    if scheduler is not None:
        try:
            from dask.distributed import Client
        except ImportError as error:
            raise InputError(
                "--scheduler needs the extra dask: pip install loadflow[dask]"
            ) from error
        with Client(scheduler) as client:
            yield partial(client.submit, pure=False)
    elif workers > 1:
        # spawned, not forked: HDF5 and numba hold threads and locks that do not survive a fork
        context = get_context("spawn")
        with ProcessPoolExecutor(workers, context, initializer=_one_thread) as pool:
            yield pool.submit
    else:
        yield None


def _one_thread() -> None:
    """Keep BLAS to one thread in a worker: the cases are what runs in parallel."""
    from threadpoolctl import threadpool_limits

    threadpool_limits(1)


def _finished(
    submit: Submit | None, work: Callable[[Case], _Outcome], cases: Iterable[Case]
) -> Iterator[_Outcome]:
    """Yield the outcomes as they come; what is not begun when one raises is dropped."""
    if submit is None:
        yield from map(work, cases)
        return
    futures: list[Future[_Outcome]] = [submit(work, case) for case in cases]
    completed = as_completed if all(isinstance(f, Future) for f in futures) else _dask_completed
    try:
        for future in completed(futures):
            yield future.result()
    finally:
        for future in futures:
            future.cancel()


def _dask_completed(futures: list[Any]) -> Iterator[Any]:
    from dask.distributed import as_completed as completed

    yield from completed(futures)


# --- the folder of a run ---------------------------------------------------------------------


def _prepare(folder: Path, scene: Scene, plan: Plan, overwrite: bool) -> dict[str, Any]:
    """Make the folder, or check that what is in it belongs to these settings."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "manifest.json"
    manifest = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    digests = {step.stage.name: step.digest for step in plan.steps}
    known = manifest.get("stages", {})
    for name, digest in digests.items():
        parts = [*folder.glob(f"{name}/*.h5"), *folder.glob(f"{name}.h5")]
        if not parts or known.get(name) == digest:
            continue
        if not overwrite:
            raise InputError(
                f"{folder}: holds {len(parts)} finished parts of the stage {name!r} that were made "
                "with other settings or inputs; give the run another name, or overwrite it"
            )
        for part in parts:
            part.unlink()
    for rest in folder.rglob(".*.tmp"):
        rest.unlink()
    (folder / "scene.toml").write_text(scene.to_toml(), encoding="utf-8")
    manifest |= {
        "stages": known | digests,
        "rungs": {
            step.stage.name: {"rung": step.rung, "error": step.error or "not measured"}
            for step in plan.steps
        },
        "inputs": {case.file: case.fingerprint for case in plan.cases if case.file},
        "cases": [case.name for case in plan.cases],
        "versions": {"python": platform.python_version(), "loadflow": loadflow.__version__}
        | {name: metadata.version(name) for name in ("numpy", "scipy", "numba", "xarray")},
    }
    _replace(path, json.dumps(manifest, indent=1))
    return manifest


def _write_manifest(
    folder: Path,
    manifest: dict[str, Any],
    timing: dict[str, float],
    failures: dict[str, str],
    workers: int,
    wall: float,
) -> None:
    """Record what it took; a run that is taken up again adds to what it took before."""
    before = manifest.get("seconds", {})
    spent = {k: round(before.get(k, 0.0) + timing.get(k, 0.0), 3) for k in before | timing}
    manifest |= {
        "seconds": spent,
        "wall_seconds": round(manifest.get("wall_seconds", 0.0) + wall, 3),
        "workers": workers,
        "failures": failures,
    }
    _replace(folder / "manifest.json", json.dumps(manifest, indent=1))


def _replace(path: Path, text: str) -> None:
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    temporary.write_text(text, encoding="utf-8")
    os.replace(temporary, path)


def _collect(plan: Plan, folder: Path) -> xr.DataTree:
    """Join what the stages found, reduced to what a reader wants of each case."""
    groups: dict[str, xr.Dataset | xr.DataTree] = {}
    for step in plan.steps:
        module = import_module(step.stage.function.split(":")[0])
        if step.stage.scope == "run":
            groups[step.stage.name] = open_cube(_file(folder, step.stage))
        elif hasattr(module, "summary"):
            files = {case: _file(folder, step.stage, case) for case in plan.cases}
            parts = {case: open_cube(file) for case, file in files.items() if file.exists()}
            if parts:
                groups[step.stage.name] = module.summary(parts)
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
