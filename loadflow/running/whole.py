"""The stages that look at all load cases: which are missing is worked on in pieces, and joined."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import xarray as xr

from loadflow.cube.hdf5 import read_whole
from loadflow.errors import LoadflowError
from loadflow.planning.plan import Plan, Step
from loadflow.running.cases import OpenedLate, is_ready, open_inputs
from loadflow.running.compiling import Compiling
from loadflow.running.executor import Executor, Lost, Outcome
from loadflow.running.folder import part_file
from loadflow.running.parts import save_part
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene

Summary = xr.Dataset | xr.DataTree
Say = Callable[[str, int, int], None]


@dataclass(frozen=True)
class Piece:
    """Cases that a stage over all of them works on together."""

    step: Step
    number: int
    cases: tuple[Case, ...]


@dataclass(frozen=True)
class Found:
    """What a stage made of a piece; seconds in all, and of it in the compilation of kernels."""

    result: Any
    seconds: float
    compiling: float


@dataclass(frozen=True)
class Finished:
    """A stage that is done; seconds of all processes."""

    name: str
    seconds: float
    compiling: float


def finish_stages(
    plan: Plan, folder: Path, where: Executor, say: Say, seen: Sequence[str]
) -> Iterator[Finished]:
    """Do what is missing of the stages over all cases, and yield each that is finished.

    A stage that no case is ready for is not done, and leaves no part.

    Parameters
    ----------
    seen : sequence of str
        Cases that the pilot has looked at; a sample is of others, where there are enough.

    Raises
    ------
    loadflow.errors.LoadflowError
        The worker of a piece was killed.
    """
    left: dict[str, dict[int, Found | None]] = {}
    pieces = []
    for step in plan.of_scope("run"):
        if part_file(folder, step.name).exists():
            say(step.name, 1, 1)
            continue
        cases = _looked_at(step, plan.cases, folder, seen)
        own = [Piece(step, k, tuple(c)) for k, c in enumerate(step.stage.pieces(plan.scene, cases))]
        if not own:
            continue
        left[step.name] = dict.fromkeys(range(len(own)))
        say(step.name, 0, len(own))
        pieces += own
    work = partial(_do_piece, scene=plan.scene, folder=folder)
    for piece, outcome in _done(where, work, pieces):
        step = piece.step
        left[step.name][piece.number] = outcome
        found = [one for one in left[step.name].values() if one is not None]
        say(step.name, len(found), len(left[step.name]))
        if len(found) == len(left[step.name]):
            joined = step.stage.joined(plan.scene, [one.result for one in found])
            save_part(joined, part_file(folder, step.name), step.digest)
            del left[step.name]
            yield Finished(
                step.name,
                sum(one.seconds for one in found),
                sum(one.compiling for one in found),
            )


def summaries(
    plan: Plan, folder: Path, where: Executor
) -> tuple[dict[str, Summary], dict[str, list[str]]]:
    """Return what the stages of a load case gave, summed up by stage, and the cases they lack."""
    steps = [step for step in plan.steps if step.stage.scope == "case" and step.stage.summarise]
    missing: dict[str, list[str]] = {}
    pieces = []
    for step in steps:
        is_there = {case: part_file(folder, step.name, case).exists() for case in plan.cases}
        missing[step.name] = [case.name for case, there in is_there.items() if not there]
        there = tuple(case for case, there in is_there.items() if there)
        if there:
            pieces.append(Piece(step, 0, there))
    done = _done(where, partial(_summary, folder=folder), pieces)
    found = {piece.step.name: outcome for piece, outcome in done if outcome is not None}
    return found, missing


def _done(
    where: Executor, work: Callable[[Piece], Outcome], pieces: Sequence[Piece]
) -> Iterator[tuple[Piece, Outcome]]:
    """Yield each piece with what was made of it, as they are done.

    Raises
    ------
    loadflow.errors.LoadflowError
        The worker of a piece was killed.
    """
    for piece, outcome in where.outcomes(work, pieces):
        if isinstance(outcome, Lost):
            raise LoadflowError(
                f"{piece.step.name}: {outcome.reason}; started again, the run goes on where it was"
            )
        yield piece, outcome


def _summary(piece: Piece, folder: Path) -> Summary | None:
    """Sum up what a stage gave in all cases; loaded, as it may come from another process."""
    summarise = piece.step.stage.summarise
    assert summarise is not None
    files = {case: part_file(folder, piece.step.name, case) for case in piece.cases}
    found = summarise(OpenedLate(files, read_whole))
    return None if found is None else found.load()


def _do_piece(piece: Piece, scene: Scene, folder: Path) -> Found:
    begun = time.perf_counter()
    by_name = {case.name: case for case in piece.cases}
    inputs = OpenedLate(by_name, partial(open_inputs, piece.step, folder=folder))
    with Compiling() as compiling:
        result = piece.step.stage.run(scene, list(piece.cases), inputs)
    return Found(result, time.perf_counter() - begun, compiling.seconds)


def _looked_at(step: Step, cases: Sequence[Case], folder: Path, seen: Sequence[str]) -> list[Case]:
    """Return the cases that a stage over all of them reads: those that are there, or a sample."""
    there, count = [case for case in cases if is_ready(step, case, folder)], step.stage.sample
    if count is None or len(there) <= count:
        return there
    others = [case for case in there if case.name not in seen]
    some = others if len(others) >= count else there
    last, parts = len(some) - 1, count - 1
    return [some[round(k * last / parts)] for k in range(count)]
