"""The search for the best design of a candidate: sweep, front, maps, checked at the end.

Everything is asked in batches of points whose answers are sealed parts on disk. The sequence of
batches follows from the scene alone, so a search that was killed goes on where it was, and gives
the same bits with any number of processes.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from scipy.optimize import NonlinearConstraint, differential_evolution
from scipy.stats import qmc

from loadflow import __version__
from loadflow.cube import open_cube
from loadflow.errors import InputError, LoadflowError
from loadflow.report.design_page import write_design
from loadflow.running.comparison import (
    Means,
    SharedLoads,
    candidates_for,
    run_candidates,
    shared_loads,
)
from loadflow.running.executor import Executor, Lost, executor
from loadflow.running.lock import locked
from loadflow.running.parts import digest_of, is_sound, save_part
from loadflow.scene.design import Design
from loadflow.scene.friction import Friction
from loadflow.scene.scene import Candidate, Scene
from loadflow.storage import write_text
from loadflow.studies.compare import compared
from loadflow.studies.compare_result import Judged
from loadflow.studies.design_point import (
    NUMBERS,
    DesignPoint,
    from_columns,
    judge_design,
    to_columns,
)
from loadflow.studies.design_result import Designs, Front, Map, best_of, front_of, scene_of_best
from loadflow.studies.design_space import Space, space_of, start_of
from loadflow.studies.load_spectrum import load_spectrum

BATCH = 8
"""Points in a part."""

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


@dataclass(frozen=True)
class Problem:
    """What a worker must know to judge a design."""

    space: Space
    spectrum: xr.DataTree
    digest: str

    def judged(self, point: Sequence[float]) -> DesignPoint:
        """The design at a point."""
        try:
            candidate, friction = self.space.at(point)
        except InputError as error:
            return DesignPoint(why=str(error))
        return judge_design(candidate, friction, self.spectrum)


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
    how = Means(workers, scheduler, overwrite, progress)
    loads = shared_loads(scene, out, how)
    folder = loads.folder / "design" / name
    (folder / "parts").mkdir(parents=True, exist_ok=True)
    with locked(folder), executor(workers, scheduler) as where:
        problem = _problem(loads, space, candidate, options, folder)
        search = _Search(problem, options, folder.absolute() / "parts", where, how)
        search.ask(np.array([start_of(space)]))
        given = judge_design(candidate, scene.friction, problem.spectrum)
        search.sweep()
        fronts = search.levels()
        best = search.best(options.margin)
        maps = search.maps(best if best is not None else np.array(start_of(space)))
    told = _told(scene, name, candidate, space, search, given, fronts, maps)
    checked = _check(told, loads, candidate, folder, how)
    done = Designed(folder, checked)
    write_text(done.table, checked.to_csv())
    if checked.best is not None:
        write_text(done.scene, scene_of_best(scene, checked))
    elif done.scene.exists():
        done.scene.unlink()  # of other settings
    write_text(folder / "design.json", json.dumps(checked.as_dict(), indent=1))
    write_design(done.page, checked.as_dict())
    return done


def chosen_candidate(scene: Scene) -> tuple[str, Candidate]:
    """Name and bearings of the candidate that the section ``[design]`` means.

    Raises
    ------
    loadflow.errors.InputError
        There is none of that name, or several and none is named.
    """
    known, _ = candidates_for(scene)
    name = scene.design.candidate
    own = [one for one in known if one.startswith("own-")]
    if name is None and len(known) == 1:
        name = next(iter(known))
    elif name is None and len(own) == 1 and not scene.candidates:
        name = own[0]
    if name is None or name not in known:
        said = "which candidate?" if name is None else f"no candidate {name!r};"
        raise InputError(f"design.candidate: {said} there are {', '.join(known)}")
    return name, known[name]


def _problem(
    loads: SharedLoads, space: Space, candidate: Candidate, options: Design, folder: Path
) -> Problem:
    """The spectrum of the loads, made or read, with what is asked of it."""
    places, file = candidate.places, folder / "spectrum.h5"
    steps = {step.name: step.digest for step in loads.plan.steps}
    told = [__version__, steps["loads"], steps["shaft"], *places, str(options.classes)]
    told += [loads.scene.digest("loads", "shaft", "turbine")]
    digest = hashlib.sha256("\n".join(told).encode()).hexdigest()
    if not file.exists() or digest_of(file) != digest or not is_sound(file):
        made = load_spectrum(loads.scene, _cases(loads), places, options.classes)
        save_part(made, file, digest)
    tree: Any = open_cube(file)
    told = [digest, candidate.model_dump_json(), repr(space)]
    return Problem(space, tree.load(), hashlib.sha256("\n".join(told).encode()).hexdigest())


def _cases(loads: SharedLoads) -> Iterator[tuple[str, xr.Dataset, xr.Dataset]]:
    for case in loads.plan.cases:
        files = [loads.folder / stage / f"{case.name}.h5" for stage in ("loads", "shaft")]
        if all(file.exists() for file in files):
            of_case, shaft = (open_cube(file) for file in files)
            yield case.name, of_case.load(), shaft.load()  # type: ignore[misc]


@dataclass
class _Search:
    """Points that were asked, and the parts that hold their answers."""

    problem: Problem
    options: Design
    folder: Path
    where: Executor
    how: Means
    known: dict[bytes, DesignPoint] = field(default_factory=dict)
    points: list[np.ndarray] = field(default_factory=list)

    def ask(self, points: np.ndarray, stage: str = "") -> list[DesignPoint]:
        """Designs at points (n, keys), each of them judged once."""
        rounded = [self._legal(point) for point in points]
        new = {point.tobytes(): point for point in rounded if point.tobytes() not in self.known}
        todo = list(new.values())
        batches = [todo[k : k + BATCH] for k in range(0, len(todo), BATCH)]
        work = partial(_judge, problem=self.problem, folder=self.folder)
        answers: dict[int, list[DesignPoint]] = {}
        for (number, _), judged in self.where.outcomes(work, [*enumerate(batches)]):
            if isinstance(judged, Lost):
                raise LoadflowError(f"designs were lost: {judged.reason}")
            answers[number] = judged
            if stage:
                done = sum(map(len, answers.values()))
                self.how.say(stage, done, len(todo))
        for number, batch in enumerate(batches):
            for point, answer in zip(batch, answers[number]):
                self.known[point.tobytes()] = answer
                self.points.append(point)
        return [self.known[point.tobytes()] for point in rounded]

    def _legal(self, point: np.ndarray) -> np.ndarray:
        """Coordinates as the values have them, so that what is judged is what is written."""
        found = []
        for axis, x in zip(self.problem.space.axes, point):
            value = axis.value(float(x))
            found.append(float(round(x)) if axis.values or axis.whole else float(value))
        return np.array(found)

    @property
    def answers(self) -> list[DesignPoint]:
        """Of all points, in the order in which they were asked."""
        return [self.known[point.tobytes()] for point in self.points]

    def sweep(self) -> None:
        """Spread designs over all keys."""
        bounds = np.array(self.problem.space.bounds)
        wide = np.array([axis.whole for axis in self.problem.space.axes])
        low, high = bounds[:, 0] - 0.499 * wide, bounds[:, 1] + 0.499 * wide
        drawn = qmc.LatinHypercube(len(bounds), rng=self.options.seed).random(self.options.sweep)
        self.ask(low + drawn * (high - low), "sweep")
        if all(answer.why for answer in self.answers):
            raise LoadflowError(f"no design has an answer; the first: {self.answers[0].why}")

    def levels(self) -> list[float]:
        """Optimise the energy at some margins.

        The method of ε-constraints [Haimes, Lasdon and Wismer 1971].
        """
        required = self.options.margin
        holding = [a.load_factor for a in self.answers if a.condition >= 1]
        widest = max([*holding, required])
        levels = np.geomspace(required, max(0.97 * widest, required), self.options.levels)
        levels = np.unique(np.round(levels, 3)) if widest > required else np.array([required])
        for k, level in enumerate(levels):
            self._optimise(float(level), k, len(levels))
        return [float(level) for level in levels]

    def _optimise(self, level: float, k: int, count: int) -> None:
        space = self.problem.space
        stage = f"front, margin {level:.3g} ({k + 1} of {count})"

        def asked(x: np.ndarray) -> list[DesignPoint]:
            return self.ask(np.atleast_2d(x.T))

        def energy(x: np.ndarray) -> Any:
            found = np.array([min(a.energy, 1e12) for a in asked(x)])
            return found if x.ndim > 1 else found[0]

        def limits(x: np.ndarray) -> Any:
            found = np.array([[a.load_factor, min(a.condition, 1e3)] for a in asked(x)]).T
            return found if x.ndim > 1 else found[:, 0]

        def told(intermediate_result: Any) -> None:
            self.how.say(stage, int(intermediate_result.nit), self.options.generations)

        self.how.say(stage, 0, self.options.generations)
        differential_evolution(
            energy,
            space.bounds,
            constraints=NonlinearConstraint(limits, [level, 1.0], np.inf),
            integrality=[axis.whole for axis in space.axes],
            init=self._population(level),
            maxiter=self.options.generations,
            tol=1e-3,
            polish=False,
            vectorized=True,
            updating="deferred",
            callback=told,
            rng=np.random.default_rng([self.options.seed, k]),
        )
        self.how.say(stage, self.options.generations, self.options.generations)

    def _population(self, level: float) -> np.ndarray:
        """The best designs so far to begin with: those that hold first, by energy."""

        def rank(one: tuple[np.ndarray, DesignPoint]) -> tuple[float, float]:
            answer = one[1]
            lack = max(0.0, level - answer.load_factor) + max(0.0, 1.0 - answer.condition)
            return (math.inf if answer.why else lack, answer.energy)

        rows = sorted(zip(self.points, self.answers), key=rank)
        # half of them the best, the others spread over the rest, so that it does not narrow at once
        half = self.options.population // 2
        rest = rows[half:]
        spread = np.linspace(0, len(rest) - 1, self.options.population - half).round().astype(int)
        chosen = [point for point, _ in rows[:half]] + [rest[k][0] for k in np.unique(spread)]
        bounds = np.array(self.problem.space.bounds)
        return np.clip(np.array(chosen), bounds[:, 0], bounds[:, 1])

    def best(self, margin: float, passed: Sequence[bytes] = (), share: float = 1.0) -> Any:
        """Point of the least energy that holds, but for those `passed`; None where none does."""
        return best_of(self.points, self.answers, margin, passed, share)

    def maps(self, at: np.ndarray) -> list[Map]:
        """Maps over pairs of keys, the others as they are at a point."""
        axes = self.problem.space.axes
        names = [axis.key for axis in axes]
        pairs = self.options.maps or ([(names[0], names[1])] if len(names) > 1 else [])
        found = []
        for pair in pairs:
            i, j = (names.index(key) for key in pair)
            across, up = (_ticks(axes[k], self.options.cells) for k in (i, j))
            points = np.repeat(at[None], across.size * up.size, axis=0)
            points[:, i] = np.tile(across, up.size)
            points[:, j] = np.repeat(up, across.size)
            answers = self.ask(points, f"map of {pair[0]} and {pair[1]}")
            found.append(Map(pair, across, up, answers))
        return found


def _ticks(axis: Any, cells: int) -> np.ndarray:
    if axis.whole:
        count = min(cells, int(axis.high - axis.low) + 1)
        return np.unique(np.linspace(axis.low, axis.high, count).round())
    return np.linspace(axis.low, axis.high, cells)


def _judge(
    numbered: tuple[int, list[np.ndarray]], problem: Problem, folder: Path
) -> list[DesignPoint]:
    """Judge a batch of points, or read what was found of it before."""
    points = np.array(numbered[1])
    digest = hashlib.sha256(problem.digest.encode() + points.tobytes()).hexdigest()
    file = folder / f"{digest[:20]}.h5"
    if file.exists() and digest_of(file) == digest and is_sound(file):
        table: Any = open_cube(file)
        return from_columns({name: table[name].values for name in table.data_vars})
    answers = [problem.judged(point) for point in points]
    columns = to_columns(answers)
    about = {name: dict(zip(("units", "long_name"), NUMBERS[name])) for name in NUMBERS}
    words = {"units": "1", "long_name": "words"}
    data = {name: ("design", values, about.get(name, words)) for name, values in columns.items()}
    save_part(xr.Dataset(data), file, digest)
    return answers


def _told(
    scene: Scene,
    name: str,
    candidate: Candidate,
    space: Space,
    search: _Search,
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


def _check(
    told: Designs, loads: SharedLoads, candidate: Candidate, folder: Path, how: Means
) -> Designs:
    """Run the best design, and that which was given, by the models that a plan takes.

    Where the margin is smaller than the fast models said, the next best design is one that has
    more of it by as much.
    """
    share, passed = 1.0, list[bytes]()
    judged: dict[str, Judged] = {}
    start = candidate.model_copy(update={"title": "as given"})
    failures: dict[str, str] = {}
    best = None
    for _ in range(told.options.checks):
        point = best_of(told.points, told.answers, told.options.margin, passed, share)
        if point is None:
            break
        passed.append(point.tobytes())
        one, friction = told.space.at(point.tolist())
        key = f"best-{hashlib.sha256(point.tobytes()).hexdigest()[:8]}"
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
    known = {key: one for key, one in judged.items() if one is not None}
    return told.checked(best, known, failures | failed, len(passed))


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
    scene = loads.scene.model_copy(update={"friction": friction})
    of_scene = SharedLoads(scene, loads.plan, loads.folder)
    try:
        finished, failures = run_candidates(of_scene, chosen, folder / "checks", how)
    except LoadflowError as error:
        return None, dict.fromkeys(chosen, str(error))
    return compared(scene, finished, folder, failures, []).candidates[0], failures
