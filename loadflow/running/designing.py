"""The search for the best design of a candidate: sweep, front, maps, checked at the end.

Everything is asked in batches of points whose answers are sealed parts on disk. The sequence of
batches follows from the scene alone, so a search that was killed goes on where it was, and gives
the same bits with any number of processes.
"""

from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from loadflow import __version__
from loadflow.cube import open_cube
from loadflow.errors import InputError, LoadflowError
from loadflow.numerics.fields import none_such
from loadflow.report.design_page import write_design
from loadflow.running.candidates import candidate_scene, candidates_for
from loadflow.running.comparison import (
    Means,
    SharedLoads,
    finished_cases,
    run_candidates,
    shared_loads,
)
from loadflow.running.executor import executor
from loadflow.running.lock import locked
from loadflow.running.parts import digest_of, is_sound, save_part
from loadflow.running.search import Problem, Search
from loadflow.scene.design import Design
from loadflow.scene.friction import Friction
from loadflow.scene.scene import Candidate, Scene
from loadflow.stages.effects.clearances import CLEARANCES
from loadflow.stages.effects.situation import situation
from loadflow.storage import write_json, write_text
from loadflow.studies.candidate.result import Judged
from loadflow.studies.compare.comparison import judged
from loadflow.studies.design.point import (
    DesignPoint,
    judge_design,
)
from loadflow.studies.design.result import (
    Designs,
    Front,
    Map,
    best_of,
    check_name,
    front_of,
    most_room,
    scene_of_best,
)
from loadflow.studies.design.space import Space, space_of, start_of, written_collars
from loadflow.studies.lifetime.load_spectrum import VARIABLES, load_spectrum
from loadflow.studies.shaft_through import BentShaft, fitting_shaft

_COUNTS = float(Scene.model_fields["accuracy"].default)
"""Share of a film that counts in any case: the accuracy where nothing is said."""

_NEARER = 0.97  # of what was found, where a design that was checked breaks a limit all the same


@dataclass(frozen=True)
class Designed:
    """A finished search.

    Attributes
    ----------
    path : Path
        Its folder: the page, the table, the scene of the best design and the runs that check it.
    designs : Designs
        All that was found.
    """

    path: Path
    designs: Designs

    @property
    def page(self) -> Path:
        """The page."""
        return self.path / "design.html"

    @property
    def table(self) -> Path:
        """All designs as CSV."""
        return self.path / "designs.csv"

    @property
    def scene(self) -> Path:
        """Scene of the best design, ready to run; missing where no design holds the limits."""
        return self.path / "best.toml"


def design(
    scene: Scene,
    *,
    out: str | Path = "runs",
    workers: int = 1,
    scheduler: str | None = None,
    overwrite: bool = False,
    progress: Any = None,
) -> Designed:
    """Search the best design of a candidate of a scene, as its section ``[design]`` says.

    Parameters
    ----------
    scene : Scene
        Loads, shaft, candidate, limits, and what may vary (`loadflow.scene.design.Design`).
    out : path
        Folder of runs. Loads and shaft are those of the run of the scene's name there, made if they
        are missing; the search is in ``design/CANDIDATE`` of it, taken up again where it was.
    workers, scheduler, overwrite, progress
        As of `loadflow.run`.

    Returns
    -------
    Designed
        Page, table and, where a design holds all limits, its scene are written.

    Raises
    ------
    loadflow.errors.InputError
        No such candidate, a key that no bearing of it has, or no friction model for it.
    loadflow.errors.LoadflowError
        No design has an answer; another process is at work on the search.
    """
    options = scene.design
    name, candidate = chosen_candidate(scene)
    space = space_of(scene, candidate, options)
    with executor(workers, scheduler) as where:
        how = Means(where, overwrite, progress)
        loads = shared_loads(scene, out, how)
        folder = loads.folder / "design" / name
        (folder / "parts").mkdir(parents=True, exist_ok=True)
        with locked(folder):
            problem = _problem(loads, space, candidate, options, folder)
            search = Search(problem, options, folder.absolute() / "parts", where, how)
            search.ask(np.array([start_of(space)]))
            given = judge_design(candidate, scene.friction, problem.spectrum, problem.shaft)
            search.sweep()
            fronts = search.levels()
            best = search.best(options.margin)
            maps = search.maps(best if best is not None else np.array(start_of(space)))
        told = _told(scene, name, candidate, space, search, given, fronts, maps)
        told = replace(told, left_out=_left_out(loads, name, candidate))
        checked = _check(told, loads, candidate, folder, how)
    done = Designed(folder, checked)
    write_text(done.table, checked.to_csv())
    if checked.best is not None:
        best_one, _ = space.at(checked.best.tolist())
        fitting = scene.model_copy(update={"shaft": fitting_shaft(scene, best_one)})
        write_text(done.scene, scene_of_best(fitting, checked))
    elif done.scene.exists():
        done.scene.unlink()  # of other settings
    write_json(folder / "design.json", checked.as_dict())
    write_design(done.page, checked.as_dict())
    return done


def chosen_candidate(scene: Scene) -> tuple[str, Candidate]:
    """Name and bearings of the candidate that the section ``[design]`` means.

    Where it names none, they are the scene's own bearings, or the first candidate.

    Raises
    ------
    loadflow.errors.InputError
        There is none of that name, or it has neither journal nor rolling bearings.
    """
    known, _ = candidates_for(scene)
    name = scene.design.candidate or next(iter(known))  # own bearings stand before sized ones
    if name not in known:
        raise InputError(f"design.candidate: {none_such('candidate', [name], known)}")
    if known[name].journal is None and known[name].rolling is None:
        raise InputError(
            f"design.candidate = {name!r}: the search has fast models of journal and of rolling "
            "bearings, and none of cones; loadflow compare runs them as they are"
        )
    return name, known[name]


def _problem(
    loads: SharedLoads, space: Space, candidate: Candidate, options: Design, folder: Path
) -> Problem:
    """The spectrum of the loads, with what is asked of it."""
    tree, digest = spectrum_of(loads, candidate, options.classes, folder)
    shaft = BentShaft.of(loads.scene, candidate.places)
    told = [digest, candidate.model_dump_json(), repr(space), repr(shaft)]
    return Problem(space, tree, hashlib.sha256("\n".join(told).encode()).hexdigest(), shaft)


def spectrum_of(
    loads: SharedLoads, candidate: Candidate, classes: int, folder: Path
) -> tuple[Any, str]:
    """Spectrum of the loads of a candidate, made or read from `folder`, and its digest."""
    places, file = candidate.places, folder / "spectrum.h5"
    steps = {step.name: step.digest for step in loads.plan.steps}
    told = [__version__, *VARIABLES, steps["loads"], steps["shaft"], *places, str(classes)]
    told += [loads.scene.digest("loads", "shaft", "turbine")]
    digest = hashlib.sha256("\n".join(told).encode()).hexdigest()
    if not file.exists() or digest_of(file) != digest or not is_sound(file):
        made = load_spectrum(loads.scene, finished_cases(loads), places, classes)
        save_part(made, file, digest)
    tree: Any = open_cube(file)
    return tree.load(), digest


def _told(
    scene: Scene,
    name: str,
    candidate: Candidate,
    space: Space,
    search: Search,
    given: DesignPoint,
    levels: list[float],
    maps: list[Map],
) -> Designs:
    """All that was found, before it is checked."""
    front = Front(tuple(levels), front_of(search.points, search.answers))
    return Designs(
        scene.name, name, candidate.title or name, space, scene.design, given,
        search.points, search.answers, front, tuple(maps),
    )  # fmt: skip


def _left_out(loads: SharedLoads, name: str, candidate: Candidate) -> str:
    """What the fast models leave out of the candidate as given, where it counts."""
    collars = " and ".join(written_collars(candidate))
    told = (
        f"the collar at {collars} stays as it is, and the fast models leave out its loss and its "
        "limits; runs have both"
        if collars
        else ""
    )
    return "; ".join(filter(None, (told, _tilt_left_out(loads, name, candidate))))


def _tilt_left_out(loads: SharedLoads, name: str, candidate: Candidate) -> str:
    """How much of its films the tilt in the clearances takes, which fast models leave out.

    They bend the shaft. How it tilts in the clearances hangs on both films at once, and is in the
    runs that check, or in their errors.
    """
    shaft = fitting_shaft(loads.scene, candidate)
    base = loads.scene.model_copy(update={"shaft": shaft})
    scene = candidate_scene(base, name, candidate, loads.steps)
    if not CLEARANCES.concerns(scene):
        return ""
    sizes = CLEARANCES.indicator(situation(scene, loads.plan.cases))
    size = sizes.get("minimum film", 0.0)
    if size <= min(scene.allowed("journal.film"), _COUNTS):
        return ""
    places = " and ".join(scene.journal.tilting)
    return (
        f"the shaft tilts in the clearances of {places}, which do not align themselves: by its "
        f"estimate that leaves 1/{1.0 + size:.3g} of the smallest film of the candidate as given. "
        "Runs follow it, or count it in their errors"
    )


def _check(
    told: Designs, loads: SharedLoads, candidate: Candidate, folder: Path, how: Means
) -> Designs:
    """Run the best design, and that which was given, by the models that a plan takes.

    Where the margin is smaller than the fast models said, the next best design is one that has
    more of it by as much; where none has, it is the one that is furthest from its limits.
    """
    share, passed = 1.0, list[bytes]()
    judged: dict[str, Judged] = {}
    start = candidate.model_copy(update={"title": "as given"})
    failures: dict[str, str] = {}
    best = None
    for _ in range(told.options.checks):
        known = told.points, told.answers, told.options.margin, passed
        point = best_of(*known, share)
        point = most_room(*known) if point is None else point
        if point is None:
            break
        passed.append(point.tobytes())
        one, friction = told.space.at(point.tolist())
        key = check_name(point)
        chosen = {key: one.model_copy(update={"title": "best design"})}
        judged[key], failed = _run(loads, chosen, friction, folder, how)
        failures |= failed
        if judged[key] is None:
            share *= _NEARER
            continue
        left = _left(judged[key], told.answer_at(point))
        if judged[key].holds and left * told.answer_at(point).load_factor >= told.options.margin:
            best = point
            break
        share = min(_NEARER * share, left)
    judged["start"], failed = _run(loads, {"start": start}, loads.scene.friction, folder, how)
    there = {key: one for key, one in judged.items() if one is not None}
    return told.checked(best, there, failures | failed, len(passed))


def _left(run: Judged, fast: DesignPoint) -> float:
    """Share of margin and conditions of the fast models that is left when a design is run."""
    factor = run.numbers["load_factor"].value
    shares = [factor / fast.load_factor] if math.isfinite(factor) and fast.load_factor else []
    for verdict in run.broken:
        both = verdict.value, verdict.limit
        if all(math.isfinite(one) and one > 0 for one in both):
            value, limit = both
            shares.append(limit / value if verdict.sense == "at most" else value / limit)
    return min(shares, default=1.0)


def _run(
    loads: SharedLoads, chosen: dict[str, Candidate], friction: Friction, folder: Path, how: Means
) -> tuple[Any, dict[str, str]]:
    """The numbers of a candidate as a comparison has them, or None and why there are none."""
    (candidate,) = chosen.values()
    update = {"friction": friction, "shaft": fitting_shaft(loads.scene, candidate)}
    scene = loads.scene.model_copy(update=update)
    of_scene = SharedLoads(scene, loads.plan, loads.folder)
    try:
        finished, failures = run_candidates(of_scene, chosen, folder / "checks", how)
    except LoadflowError as error:
        return None, dict.fromkeys(chosen, str(error))
    return judged(finished[0], folder), failures
