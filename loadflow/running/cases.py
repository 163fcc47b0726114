"""The work on one load case: what of it is missing is done and written; runs in a worker."""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from loadflow.cube.hdf5 import read_whole
from loadflow.errors import InputError, SolverError
from loadflow.numerics.watch import watched
from loadflow.planning.plan import Plan, Step
from loadflow.running.compiling import Compiling
from loadflow.running.folder import part_file
from loadflow.running.parts import save_part
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.storage import write_text

Key = TypeVar("Key")
Place = TypeVar("Place")
Opened = TypeVar("Opened")


@dataclass(frozen=True)
class Outcome:
    """What became of one case.

    Attributes
    ----------
    seconds, compiling, writing, processor : dict
        By stage, s: in all, of it in the compilation of kernels, of it in writing the part; and the
        processor time, which other work on the machine does not lengthen as it does the others.
    parts : dict
        By stage, s: what its rooms name of it, the wind of the loads.
    failures : dict
        Why a part has no answer, by part.
    traces : list of str
        Where in the code it happened, of failures that no solver named.
    """

    seconds: dict[str, float] = field(default_factory=dict)
    compiling: dict[str, float] = field(default_factory=dict)
    writing: dict[str, float] = field(default_factory=dict)
    processor: dict[str, float] = field(default_factory=dict)
    failures: dict[str, str] = field(default_factory=dict)
    traces: list[str] = field(default_factory=list)
    parts: dict[str, dict[str, float]] = field(default_factory=dict)


def do_case(case: Case, scene: Scene, steps: tuple[Step, ...], folder: Path) -> Outcome:
    """Run those of the steps of one case that are missing.

    It is told the steps, not the plan: that has all cases in it, and would go to a worker with each
    of them.

    What fails in one case is kept as its failure, and the other cases go on; bad input and a disk
    that refuses concern them all, and are raised.
    """
    done = Outcome()
    opened: dict[str, Any] = {}  # to read a small part takes longer than many a stage
    for step in steps:
        name, target = step.name, part_file(folder, step.name, case)
        if target.exists() or not is_ready(step, case, folder):
            continue
        begun, worked = time.perf_counter(), time.process_time()
        with Compiling() as compiling, watched() as parts:
            try:
                result = step.stage.run(scene, case, open_inputs(step, case, folder, opened))
            except SolverError as error:
                done.failures[f"{case.name}, {name}"] = str(error)
                continue
            except (InputError, OSError):
                raise
            except Exception as error:
                done.failures[f"{case.name}, {name}"] = f"{type(error).__name__}: {error}"
                done.traces.append(traceback.format_exc())
                continue
        answered = time.perf_counter()
        _export(step, case, result, folder)  # before the part, which says that all is done
        save_part(result, target, step.digest)
        written = time.perf_counter()
        done.seconds[name], done.parts[name] = written - begun, parts
        done.compiling[name] = compiling.seconds
        done.writing[name] = written - answered
        done.processor[name] = time.process_time() - worked
    return done


def _export(step: Step, case: Case, result: Any, folder: Path) -> None:
    """Write what a stage gives as text, for other programs."""
    if step.stage.exports is not None:
        for name, text in step.stage.exports(case, result).items():
            (folder / name).parent.mkdir(exist_ok=True)
            write_text(folder / name, text)


def is_missing(plan: Plan, case: Case, folder: Path) -> bool:
    """Whether a part of this case is yet to be done."""
    return any(not part_file(folder, step.name, case).exists() for step in plan.of_scope("case"))


def is_ready(step: Step, case: Case, folder: Path) -> bool:
    """Whether all that the stage reads of this case is there."""
    return all(part_file(folder, need, case).exists() for need in step.needs)


def open_inputs(
    step: Step, case: Case, folder: Path, opened: dict[str, Any] | None = None
) -> dict[str, Any]:
    """Read what the stage wants of this case; parts were checked when the run began.

    What is in `opened`, by stage, is not read again, and what is read is put there.
    """
    opened = {} if opened is None else opened
    for need in step.needs:
        if need not in opened:
            opened[need] = read_whole(part_file(folder, need, case))
    return {need: opened[need] for need in step.needs}


class OpenedLate(Mapping[Key, Opened]):
    """Parts that are opened each time they are asked for, and not kept: memory stays the same.

    Parameters
    ----------
    places : mapping
        What is opened, by key.
    opening : callable
        Opens one of them.
    """

    def __init__(self, places: Mapping[Key, Place], opening: Callable[[Place], Opened]) -> None:
        self._places, self._opening = places, opening

    def __getitem__(self, key: Key) -> Opened:
        return self._opening(self._places[key])

    def __iter__(self) -> Iterator[Key]:
        return iter(self._places)

    def __len__(self) -> int:
        return len(self._places)
