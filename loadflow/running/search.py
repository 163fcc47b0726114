"""Batches of designs asked of the fast models: sweep, front, maps; each batch a part on disk."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from scipy.optimize import NonlinearConstraint, differential_evolution
from scipy.stats import qmc

from loadflow.cube import open_cube
from loadflow.errors import InputError, LoadflowError
from loadflow.running.comparison import Means
from loadflow.running.executor import Executor, Lost
from loadflow.running.parts import digest_of, is_sound, save_part
from loadflow.scene.design import Design
from loadflow.studies.design.columns import from_columns, to_columns
from loadflow.studies.design.point import NUMBERS, DesignPoint, judge_design
from loadflow.studies.design.result import Map, best_of
from loadflow.studies.design.space import Space
from loadflow.studies.shaft_through import BentShaft

BATCH = 8
"""Points in a part."""


@dataclass(frozen=True)
class Problem:
    """What a worker must know to judge a design."""

    space: Space
    spectrum: xr.DataTree
    digest: str
    shaft: BentShaft | None = None

    def judged(self, point: Sequence[float]) -> DesignPoint:
        """The design at a point."""
        try:
            candidate, friction = self.space.at(point)
        except InputError as error:
            return DesignPoint(why=str(error))
        return judge_design(candidate, friction, self.spectrum, self.shaft)


@dataclass
class Search:
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
