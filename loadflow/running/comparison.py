"""One set of loads, several candidates: a run for each, on the same parts, and what they say."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import xarray as xr

from loadflow.cube.hdf5 import read_whole
from loadflow.errors import LoadflowError
from loadflow.planning.accuracy import errors_beside
from loadflow.planning.effects import Estimates
from loadflow.planning.plan import Plan, make_plan
from loadflow.report.compare_page import moments_of, write_comparison
from loadflow.running.candidates import candidate_scene, candidates_for, chosen_of
from loadflow.running.executor import HERE, Executor, Lost, executor
from loadflow.running.folder import answered, finished_parts, part_file, read_manifest
from loadflow.running.kept_numbers import keep, kept, key_of
from loadflow.running.pages.moments import moment_charts
from loadflow.running.parts import digest_of
from loadflow.running.result import Run
from loadflow.running.runner import Report, run_on
from loadflow.scene.as_built import AsBuilt
from loadflow.scene.design import Design
from loadflow.scene.scene import Candidate, Scene, read_scene
from loadflow.storage import write_json, write_text
from loadflow.studies.candidate.numbers import Finished
from loadflow.studies.candidate.result import Comparison, Judged
from loadflow.studies.compare.bands import CLASSES, with_bands
from loadflow.studies.compare.comparison import compared, judged
from loadflow.studies.compare.words import bearings
from loadflow.studies.lifetime.load_spectrum import load_spectrum

Item = TypeVar("Item")
Outcome = TypeVar("Outcome")

SHARED = ("loads", "shaft")
"""Stages whose parts are the same for all candidates, unless the shaft feels its bearings."""


@dataclass(frozen=True)
class Compared:
    """A finished comparison.

    Attributes
    ----------
    path : Path
        Folder of the run whose loads it uses; ``candidates`` in it holds a run for each.
    comparison : Comparison
        Numbers, intervals, verdicts and the conclusion.
    failures : dict
        Why a candidate has no answer at all.
    """

    path: Path
    comparison: Comparison
    failures: dict[str, str]

    @property
    def page(self) -> Path:
        """The page."""
        return self.path / "compare.html"

    @property
    def table(self) -> Path:
        """The numbers as CSV."""
        return self.path / "compare.csv"


def compare(
    scene: Scene,
    *,
    out: str | Path = "runs",
    candidates: list[str] | None = None,
    starts: float | None = None,
    workers: int = 1,
    scheduler: str | None = None,
    overwrite: bool = False,
    progress: Report | None = None,
) -> Compared:
    """Compare candidates for the main bearings of a scene under the same loads.

    Parameters
    ----------
    scene : Scene
        Its ``[candidates]`` are compared; without any, those that are sized for its turbine, as far
        as its shaft has their places, beside the bearings that the scene states itself.
    out : path
        Folder of runs. Loads and shaft are those of the run of the scene's name there, made if they
        are missing; each candidate has a run of its own below it, taken up again where it was.
    candidates : list of str, optional
        Names of those to compare; default all.
    starts : float, optional
        Starts, stops and faults of each design load case in the life, for the wear of the shells,
        in place of ``wear.events`` and ``wear.counts``; what ``lifetime.per_year`` says stays.
    workers, scheduler, overwrite, progress
        As of `loadflow.run`.

    Returns
    -------
    Compared
        The page and the table are written.

    Raises
    ------
    loadflow.errors.InputError
        No candidate that the shaft has places for, or one that is not known; `starts` of a scene
        without a law of wear.
    loadflow.errors.LoadflowError
        No candidate has an answer.
    """
    if starts is not None:
        scene = scene.model_copy(update={"wear": scene.wear.with_events(starts)})
    known, without_place = candidates_for(scene)
    chosen = chosen_of(known, candidates)
    with executor(workers, scheduler) as where:
        how = Means(where, overwrite, progress)
        loads = shared_loads(scene, out, how)
        finished, failures = run_candidates(loads, chosen, loads.folder / "candidates", how)
        answers = _answers(loads, finished, scene.as_built, how)
    found = compared(loads.scene, finished, answers, failures, without_place)
    done = Compared(loads.folder, found, failures)
    told = found.as_dict()
    pictures = {
        one["name"]: [
            *moment_charts(loads.folder / one["folder"], moments_of(one, told), f"{one['name']}.")
        ]
        for one in told["candidates"]
    }
    write_comparison(done.page, told, pictures)
    write_text(done.table, found.to_csv())
    write_json(done.path / "compare.json", told)
    return done


def _answers(
    loads: SharedLoads, finished: Sequence[Finished], given: AsBuilt, how: Means
) -> list[Judged]:
    """What is said of each candidate: found before, or found now and kept as soon as it is."""
    standing = (one for run in finished for one in bearings(run.scene, run.rooms))
    places = [*dict.fromkeys(one["place"] for one in standing)]
    told = {
        "loads": {step.name: step.digest for step in loads.plan.steps},
        "cases": [case.name for case in loads.plan.cases],
        "places": places,
        "as built": given.model_dump(),
    }
    keys = {run.name: key_of(run, **told) for run in finished}
    found = {}
    if not how.overwrite:
        before = {run.name: kept(run, keys[run.name]) for run in finished}
        found = {name: one for name, one in before.items() if one is not None}
    missing = [run for run in finished if run.name not in found]
    if missing:
        judge = _Judge(loads, places, given, keys)
        new = how.outcomes("numbers and tolerances", judge, missing)
        found |= {one.name: one for one in new}
    return [found[run.name] for run in finished]


class _Judge:
    """What is said of a finished candidate, wherever it is asked."""

    def __init__(
        self, loads: SharedLoads, places: Sequence[str], given: AsBuilt, keys: Mapping[str, str]
    ) -> None:
        self.folder, self.given, self.keys = loads.folder, given, keys
        self.spectrum = (
            load_spectrum(loads.scene, finished_cases(loads), places, CLASSES)
            if given.any
            else None
        )

    def __call__(self, run: Finished) -> Judged:
        """Its numbers, with their bands by tolerances where there are any."""
        found = judged(run, self.folder)
        if self.spectrum is not None:
            found = with_bands(found, run, self.spectrum, self.given)
        keep(run, self.keys[run.name], found)
        return found


@dataclass(frozen=True)
class Means:
    """How runs are carried out.

    Attributes
    ----------
    where : Executor
        One for all of them: its processes are started, and import the package, once.
    overwrite, progress
        As of `loadflow.run`.
    """

    where: Executor = HERE
    overwrite: bool = False
    progress: Report | None = None

    def say(self, stage: str, done: int, total: int) -> None:
        """Tell of progress, if anybody listens."""
        if self.progress is not None:
            self.progress(stage, done, total)

    def run(self, scene: Scene, out: str | Path, tell: Report | None) -> Run:
        """Carry out a scene without a report."""
        return run_on(
            nullcontext(self.where), scene, out, overwrite=self.overwrite, report=False, say=tell
        )

    def outcomes(
        self, what: str, work: Callable[[Item], Outcome], items: Sequence[Item]
    ) -> Iterator[Outcome]:
        """What is made of each item, in their order.

        Raises
        ------
        loadflow.errors.LoadflowError
            The worker of an item was killed.
        """
        found: dict[int, Outcome] = {}
        self.say(what, 0, len(items))
        for (k, _), outcome in self.where.outcomes(partial(_numbered, work), [*enumerate(items)]):
            if isinstance(outcome, Lost):
                raise LoadflowError(f"{what}: {outcome.reason}")
            found[k] = outcome
            self.say(what, len(found), len(items))
        return (found[k] for k in range(len(items)))


def _numbered(work: Callable[[Item], Outcome], item: tuple[int, Item]) -> Outcome:
    return work(item[1])


@dataclass(frozen=True)
class SharedLoads:
    """The loads and shaft that all candidates of a scene share, finished.

    Attributes
    ----------
    scene : Scene
        With the models that its loads and shaft were made with, and nothing but these wanted.
    plan : Plan
        Of that scene.
    folder : Path
        Of its run.
    """

    scene: Scene
    plan: Plan
    folder: Path

    @property
    def steps(self) -> int:
        """Length of the shortest series."""
        return min(case.steps for case in self.plan.cases)


def shared_loads(scene: Scene, out: str | Path, how: Means) -> SharedLoads:
    """Loads and shaft of a scene, made if the run of its name below `out` lacks them.

    Raises
    ------
    loadflow.errors.LoadflowError
        As `loadflow.run`.
    """
    folder = Path(out) / scene.name
    base = _base(scene)
    as_run = _as_run(base, scene, folder)
    if as_run is None or not _there(make_plan(as_run), folder):
        how.run(base, out, how.progress)
        as_run = _as_run(base, scene, folder) or base
    return SharedLoads(as_run, make_plan(as_run), folder)


def finished_cases(loads: SharedLoads) -> Iterator[tuple[str, xr.Dataset, xr.Dataset]]:
    """Yield name, loads and shaft of each load case that has both."""
    for case in loads.plan.cases:
        if all(answered(loads.folder, stage, [case.name]) for stage in SHARED):
            parts: list[Any] = [read_whole(part_file(loads.folder, s, case)) for s in SHARED]
            of_case, shaft = parts
            yield case.name, of_case, shaft


def run_candidates(
    loads: SharedLoads, chosen: Mapping[str, Candidate], below: Path, how: Means
) -> tuple[list[Finished], dict[str, str]]:
    """Run each candidate in a folder of its name `below`, on the same loads.

    Returns
    -------
    tuple
        Those that have an answer, and why others have none, by name.

    Raises
    ------
    loadflow.errors.LoadflowError
        None has one.
    """
    finished, failures = [], {}
    for name, candidate in chosen.items():
        own = candidate_scene(loads.scene, name, candidate, loads.steps)
        place = below / name
        _share(loads.plan, make_plan(own), loads.folder, place)

        def tell(stage: str, done: int, total: int, name: str = name) -> None:
            how.say(f"{name}: {stage}", done, total)

        try:
            result = how.run(own, below, tell)
        except LoadflowError as error:
            failures[name] = str(error)
            continue
        ran = read_scene(place / "scene.toml")  # with the effects that were decided on
        manifest = _with_errors_beside(read_manifest(place), ran)
        tables = {key: node.to_dataset().load() for key, node in result.tree.children.items()}
        finished.append(
            Finished(name, candidate.title, candidate.source, ran, tables, manifest, place)
        )
    if not finished:
        lines = "\n".join(f"  {name}: {why}" for name, why in failures.items())
        raise LoadflowError(f"no candidate has an answer:\n{lines}")
    return finished, failures


def _with_errors_beside(manifest: dict[str, Any], ran: Scene) -> dict[str, Any]:
    """A manifest with the errors of what only a comparison tells, too, or tells by few samples."""
    told: dict[str, Any] = dict(manifest.get("expected_errors", {}))
    for result, errors in errors_beside(ran, Estimates.of_manifest(manifest)).items():
        planned = told.get(result, {})
        told[result] = errors | {k: v for k, v in planned.items() if isinstance(v, int | float)}
    return manifest | {"expected_errors": told}


def _base(scene: Scene) -> Scene:
    """The scene with the models of its loads named, so that all candidates share them."""
    loads = make_plan(scene).scene.loads if scene.accuracy is not None else scene.loads
    update = {"loads": loads, "results": ["loads.statistics"], "candidates": {}, "design": Design()}
    update |= {"tolerances": {}, "as_built": AsBuilt()}
    return scene.model_copy(update=update)


def _as_run(base: Scene, scene: Scene, folder: Path) -> Scene | None:
    """The scene with loads and shaft as a run in the folder has them, its effects as decided.

    What a pilot measured for one candidate must not change the loads of it alone. None where the
    run is of another scene, or there is none.
    """
    if not (folder / "manifest.json").exists() or not (folder / "scene.toml").exists():
        return None
    if read_manifest(folder).get("wanted") not in (base.digest(), scene.digest()):
        return None
    stated = read_scene(folder / "scene.toml")
    # all of it named, that which is None, too: what is not is open to the plan of a candidate
    loads = stated.loads.model_copy(update=dict(stated.loads))
    return base.model_copy(update={"loads": loads, "shaft": stated.shaft})


def _there(plan: Plan, folder: Path) -> bool:
    """Whether a run left all loads and shaft parts of these settings."""
    done = finished_parts(folder, plan)
    return all(done[name] == len(plan.cases) for name in SHARED)


def _share(plan: Plan, own: Plan, folder: Path, place: Path) -> None:
    """Give a candidate the parts of the stages that are the same for it."""
    ours = {step.name: step.digest for step in plan.steps}
    theirs = {step.name: step.digest for step in own.steps}
    alike = {name: ours[name] for name in SHARED if name in theirs and ours[name] == theirs[name]}
    for name, digest in alike.items():
        (place / name).mkdir(parents=True, exist_ok=True)
        for part in (folder / name).glob("*.h5"):
            target = place / name / part.name
            if not target.exists() or digest_of(target) != digest:
                target.unlink(missing_ok=True)
                _link(part, target)


def _link(source: Path, target: Path) -> None:
    try:
        os.link(source, target)
    except OSError:  # another disk, or one without links
        shutil.copy2(source, target)
