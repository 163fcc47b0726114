"""One set of loads, several candidates: a run for each, on the same parts, and what they say."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import xarray as xr

from loadflow.errors import InputError, LoadflowError
from loadflow.planning.plan import Plan, make_plan
from loadflow.report.compare_page import write_comparison
from loadflow.running.folder import answered, finished_parts, open_part, read_manifest
from loadflow.running.parts import digest_of
from loadflow.running.runner import Report, run
from loadflow.scene.as_built import AsBuilt
from loadflow.scene.candidates import candidates_of
from loadflow.scene.design import Design
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Candidate, Scene, make_scene, read_scene
from loadflow.scene.tolerances import Tolerances
from loadflow.scene.wear import check_wear
from loadflow.storage import write_text
from loadflow.studies.compare import Finished, compared
from loadflow.studies.compare_result import Comparison
from loadflow.studies.load_spectrum import load_spectrum
from loadflow.studies.tolerance_bands import CLASSES, with_bands

SHARED = ("loads", "shaft")
"""Stages whose parts are the same for all candidates, unless the shaft feels its bearings."""

ROLLING_SHARE = 0.05
"""Share of the samples in which a rolling bearing is solved, where the scene does not say."""

SHAPED_CLASSES = 5
"""Classes of speed, and of load, of which one sample is solved, the extremes first, in journal
bearings that cannot be followed through the whole series in reasonable time: pads, lobes, elastic
shells, tilted shafts."""


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
    workers, scheduler, overwrite, progress
        As of `loadflow.run`.

    Returns
    -------
    Compared
        The page and the table are written.

    Raises
    ------
    loadflow.errors.InputError
        No candidate that the shaft has places for, or one that is not known.
    loadflow.errors.LoadflowError
        No candidate has an answer.
    """
    known, without_place = candidates_for(scene)
    chosen = _chosen(known, candidates)
    how = Means(workers, scheduler, overwrite, progress)
    loads = shared_loads(scene, out, how)
    finished, failures = run_candidates(loads, chosen, loads.folder / "candidates", how)
    found = compared(loads.scene, finished, loads.folder, failures, without_place)
    if scene.as_built.any:
        found = _banded(found, finished, loads, scene.as_built, how)
    done = Compared(loads.folder, found, failures)
    write_comparison(done.page, found.as_dict())
    write_text(done.table, found.to_csv())
    write_text(done.path / "compare.json", json.dumps(found.as_dict(), indent=1))
    return done


def _banded(
    found: Comparison,
    finished: list[Finished],
    loads: SharedLoads,
    given: AsBuilt,
    how: Means,
) -> Comparison:
    """The comparison with the bands of its numbers by tolerances."""
    by_name, judged = {run.name: run for run in finished}, []
    places = list(dict.fromkeys(b["place"] for one in found.candidates for b in one.bearings))
    spectrum = load_spectrum(loads.scene, finished_cases(loads), places, CLASSES)
    for k, one in enumerate(found.candidates):
        how.say("tolerances", k, len(found.candidates))
        run = by_name[one.name]
        scene = read_scene(run.folder / "scene.toml")
        judged.append(with_bands(one, run, scene, spectrum, given))
    how.say("tolerances", len(judged), len(judged))
    return replace(found, candidates=tuple(judged))


@dataclass(frozen=True)
class Means:
    """How runs are carried out: as of `loadflow.run`."""

    workers: int = 1
    scheduler: str | None = None
    overwrite: bool = False
    progress: Report | None = None

    def say(self, stage: str, done: int, total: int) -> None:
        """Tell of progress, if anybody listens."""
        if self.progress is not None:
            self.progress(stage, done, total)


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
        run(
            base, out=out, workers=how.workers, scheduler=how.scheduler, overwrite=how.overwrite,
            report=False, progress=how.progress,
        )  # fmt: skip
        as_run = _as_run(base, scene, folder) or base
    return SharedLoads(as_run, make_plan(as_run), folder)


def finished_cases(loads: SharedLoads) -> Iterator[tuple[str, xr.Dataset, xr.Dataset]]:
    """Yield name, loads and shaft of each load case that has both."""
    for case in loads.plan.cases:
        if all(answered(loads.folder, stage, [case.name]) for stage in SHARED):
            of_case, shaft = (open_part(loads.folder, stage, case.name) for stage in SHARED)
            yield case.name, of_case.load(), shaft.load()


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
            result = run(
                own, out=below, workers=how.workers, scheduler=how.scheduler,
                overwrite=how.overwrite, report=False, progress=tell,
            )  # fmt: skip
        except LoadflowError as error:
            failures[name] = str(error)
            continue
        manifest = read_manifest(place)
        tables = {key: node.to_dataset().load() for key, node in result.tree.children.items()}
        finished.append(
            Finished(name, candidate.title, candidate.source, own, tables, manifest, place)
        )
    if not finished:
        lines = "\n".join(f"  {name}: {why}" for name, why in failures.items())
        raise LoadflowError(f"no candidate has an answer:\n{lines}")
    return finished, failures


def candidates_for(scene: Scene) -> tuple[dict[str, Candidate], list[str]]:
    """Candidates of a scene, and names of those for which its shaft has no places.

    Raises
    ------
    loadflow.errors.InputError
        There is none at all.
    """
    if scene.candidates:
        return dict(scene.candidates), []
    found: dict[str, Candidate] = {}
    if "journal" in scene.model_fields_set:
        title = "journal bearings of the scene"
        thrust = scene.thrust if scene.thrust.bearings else None
        found["own-journal"] = Candidate(
            title=title,
            journal=scene.journal,
            thrust=thrust,
            tolerances=_of_places(scene, [*scene.journal.bearings, *scene.thrust.bearings]),
        )
    elif scene.thrust.bearings:
        title = "film bearings of the scene"
        found["own-thrust"] = Candidate(
            title=title,
            thrust=scene.thrust,
            tolerances=_of_places(scene, [*scene.thrust.bearings]),
        )
    sized = candidates_of(scene.turbine.name)
    if "rolling" in scene.model_fields_set:
        title = "rolling bearings of the scene"
        found["own-rolling"] = Candidate(
            title=title,
            rolling=scene.rolling,
            tolerances=_of_places(scene, [*scene.rolling.geometries]),
        )
    shell = {
        "turbine": {"name": scene.turbine.name},
        "results": ["loads.statistics"],
        "candidates": {name: {} for name in sized},
        "shaft": {"two_point": {}, "moment": {}},
    }
    found |= make_scene(shell).candidates
    places = set(scene.shaft.bearings)
    usable = {name: one for name, one in found.items() if set(one.places) <= places}
    if not usable:
        raise InputError(
            f"no candidates: the scene states none, and for {scene.turbine.name} with bearings at "
            f"{', '.join(places) or 'no place'} the package has none; write [candidates.NAME.PLACE]"
        )
    return usable, [name for name in found if name not in usable]


def _of_places(scene: Scene, places: list[str]) -> Tolerances:
    return {place: found for place, found in scene.tolerances.items() if place in places}


def candidate_scene(base: Scene, name: str, candidate: Candidate, steps: int) -> Scene:
    """The scene of one candidate: its bearings, by the models that suit a comparison.

    Journal bearings of cylindrical bores are followed in motion through the whole series on the
    rung ``reduced``; others are solved at rest in a few samples, the extremes among them.

    Parameters
    ----------
    base : Scene
        Loads, shaft, friction.
    name : str
        Of the candidate.
    candidate : Candidate
        Its bearings.
    steps : int
        Length of the shortest series.
    """
    results: list[str] = []
    update: dict[str, Any] = {"name": name, "candidates": {}, "tolerances": candidate.tolerances}
    fewer: dict[str, Any] = {"size": ROLLING_SHARE}
    if candidate.journal is not None:
        results.append("journal.film")
        if _wears(base, candidate.journal):
            results.append("journal.wear")
        update["journal"] = journal = _modelled(candidate.journal)
        if not journal.in_motion:
            share = min(1.0, SHAPED_CLASSES**2 / steps)
            fewer = {"size": share, "classes": SHAPED_CLASSES}
    if candidate.rolling is not None:
        results += ["rolling.loads", "rolling.life"]
        update["rolling"] = candidate.rolling
    if candidate.thrust is not None:
        results.append("thrust.film")
        update["thrust"] = candidate.thrust
        fewer = {"size": min(1.0, SHAPED_CLASSES**2 / steps), "classes": SHAPED_CLASSES}
    if not base.reduction.changed:
        update["reduction"] = base.reduction.model_copy(update=fewer)
    return base.model_copy(update=update | {"results": results})


def _wears(base: Scene, journal: Journal) -> bool:
    """Whether the scene says how bores wear, and these can."""
    try:
        check_wear(base.wear, journal, base.shaft)
    except ValueError:
        return False
    return True


def _modelled(journal: Journal) -> Journal:
    """A journal bearing in motion on `reduced`, where that rung knows it and none is named."""
    parts = (journal, *journal.own.values())
    simple = not journal.tilt and all(
        not part.geometry.shape.segments and part.geometry.relief == () and part.shell is None
        for part in parts
    )
    if not simple or {"motion", "rung"} & journal.changed:
        return journal
    fast = {"motion": "transient", "rung": "reduced"}
    own = {place: part.model_copy(update=fast) for place, part in journal.own.items()}
    return journal.model_copy(update=fast | {"own": own})


def _chosen(known: dict[str, Candidate], names: list[str] | None) -> dict[str, Candidate]:
    if names is None:
        return known
    if unknown := [name for name in names if name not in known]:
        raise InputError(f"no candidate {', '.join(unknown)}; there are {', '.join(known)}")
    return {name: known[name] for name in names}


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
    return base.model_copy(update={"loads": stated.loads, "shaft": stated.shaft})


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
