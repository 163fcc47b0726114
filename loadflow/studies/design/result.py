"""What a search for the best design gives: all designs, the front, maps, the best one."""

from __future__ import annotations

import csv
import hashlib
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import tomli_w

from loadflow.quantities import HOURS_PER_YEAR, three_digits
from loadflow.scene.design import Design
from loadflow.scene.scene import Scene
from loadflow.storage import plain
from loadflow.studies.candidate.quantities import named_quantities
from loadflow.studies.candidate.result import Judged
from loadflow.studies.design.point import NUMBERS, DesignPoint
from loadflow.studies.design.space import Space

SHOWN = {
    "MWh": (1.0, "MWh"),
    "kW": (1.0, "kW"),
    "1": (1.0, "–"),
    "m": (1e6, "µm"),
    "Pa": (1e-6, "MPa"),
    "m^3/s": (6e4, "l/min"),
    "h": (1 / HOURS_PER_YEAR, "years"),
}
"""Factor and unit in which a number is shown."""

_ALL = 100.0  # %, of the tilt that a bearing allows
_AT_END = 0.02  # share of a range within which a key lies at an end of it


def _short(key: str) -> str:
    return key.replace("geometry.", "")


def check_name(point: np.ndarray) -> str:
    """Name of the run that checks a design."""
    return f"best-{hashlib.sha256(point.tobytes()).hexdigest()[:8]}"


@dataclass(frozen=True)
class Front:
    """Designs of which none loses less energy with as much margin.

    Attributes
    ----------
    levels : tuple of float
        Margins at which the energy was optimised.
    index : tuple of int
        Numbers of the designs, by margin.
    """

    levels: tuple[float, ...]
    index: tuple[int, ...]


@dataclass(frozen=True)
class Map:
    """Designs on a grid over two keys; `answers` run over the first key fastest."""

    keys: tuple[str, str]
    across: np.ndarray
    up: np.ndarray
    answers: list[DesignPoint]

    def values(self, name: str) -> np.ndarray:
        """Number of each design, (up, across)."""
        found = [one.numbers.get(name, math.nan) for one in self.answers]
        return np.array(found).reshape(self.up.size, self.across.size)


@dataclass(frozen=True)
class Designs:
    """All that a search found.

    Attributes
    ----------
    name, candidate, title : str
        Of the scene and of the candidate.
    space : Space
        What varied.
    options : Design
        What was asked.
    given : DesignPoint
        The candidate as it is.
    points, answers : list
        Every design.
    front : Front
        The front of energy against margin.
    maps : tuple of Map
        Maps about the best design.
    best : ndarray or None
        Point of the best design that holds all limits when it was run by the models of a plan.
    judged : dict
        Numbers of the runs that check: ``start`` and those of the best designs, the last one last.
    failures : dict
        Runs without an answer.
    tried : int
        Number of designs that were checked.
    left_out : str
        What the fast models leave out of the films of the candidate, in words; empty: nothing that
        counts.
    """

    name: str
    candidate: str
    title: str
    space: Space
    options: Design
    given: DesignPoint
    points: list[np.ndarray]
    answers: list[DesignPoint]
    front: Front
    maps: tuple[Map, ...]
    best: np.ndarray | None = None
    judged: dict[str, Judged] = field(default_factory=dict)
    failures: dict[str, str] = field(default_factory=dict)
    tried: int = 0
    left_out: str = ""

    def answer_at(self, point: np.ndarray) -> DesignPoint:
        """Answer of a point that was asked."""
        known = {one.tobytes(): answer for one, answer in zip(self.points, self.answers)}
        return known[point.tobytes()]

    def checked(
        self,
        best: np.ndarray | None,
        judged: dict[str, Judged],
        failures: dict[str, str],
        tried: int,
    ) -> Designs:
        """The same with what its check found."""
        return replace(self, best=best, judged=judged, failures=failures, tried=tried)

    @property
    def of_best(self) -> Judged | None:
        """Numbers of the run of the best design."""
        names = [name for name in self.judged if name != "start"]
        return self.judged[names[-1]] if self.best is not None and names else None

    @property
    def told_by_runs(self) -> list[dict[str, Any]]:
        """Margin of each design that was run, by the fast models and by its run, in that order."""
        fast = {check_name(p): one.load_factor for p, one in zip(self.points, self.answers)}
        fast["start"] = self.given.load_factor
        return [
            {
                "name": name,
                "fast": plain(fast[name]),
                "run": plain(one.numbers["load_factor"].value),
                "holds": one.holds,
                "broken": one.as_dict()["broken"],
            }
            for name, one in self.judged.items()
        ]

    @property
    def settings(self) -> dict[str, str]:
        """Keys of the best design and their values in words."""
        if self.best is None:
            return {}
        return {
            axis.key: f"{axis.shown(x)} {axis.unit}".strip()
            for axis, x in zip(self.space.axes, self.best)
        }

    @property
    def at_ends(self) -> tuple[str, ...]:
        """Keys of the best design that lie at an end of their range: beyond it may be a better."""
        if self.best is None:
            return ()
        ranges = (pair for pair in zip(self.space.axes, self.best) if not pair[0].values)
        return tuple(
            axis.key
            for axis, x in ranges
            if min(x - axis.low, axis.high - x) < _AT_END * (axis.high - axis.low)
        )

    @property
    def conclusion(self) -> str:
        """What was found, as a sentence or two."""
        asked = f"loads to spare by a factor of {self.options.margin:.3g}"
        found = self.of_best
        if found is None:
            holding = [a.load_factor for a in self.answers if a.condition >= 1]
            most = max(holding, default=math.nan)
            count = f"{len(self.answers)} designs of {self.title}"
            told = f"None of {count} holds all limits with {asked}"
            if self.tried:
                fast = sum(
                    a.load_factor >= self.options.margin and a.condition >= 1 for a in self.answers
                )
                return (
                    f"{told}: by the fast models {fast} do, but none of the {self.tried} of them "
                    "that were run."
                )
            if math.isfinite(most):
                return f"{told}; the widest margin that was found is {three_digits(most)}."
            return f"{told}."
        words = ", ".join(f"{_short(key)} {v}" for key, v in self.settings.items())
        energy, factor = (found.numbers[key].value for key in ("energy", "load_factor"))
        text = (
            f"The best of {len(self.answers)} designs of {self.title} ({words}) loses "
            f"{three_digits(energy)} MWh a year with loads to spare by a factor of "
            f"{three_digits(factor)}, governed by: {found.governs}."
        )
        if self.at_ends:
            text += f" At an end of its range: {', '.join(map(_short, self.at_ends))}."
        tilt = found.numbers.get("tilt")
        if tilt is not None and tilt.value > _ALL:
            text += (
                f" But the shaft in it bends: it tilts by {tilt.value / _ALL:.3g} times what "
                "the bearing allows"
            )
            text += (
                f", no limit here ({tilt.note}); state a beam, or a larger diameter."
                if tilt.note
                else "."
            )
        start = self.judged.get("start")
        if start is None:
            return text
        before = start.numbers["energy"].value
        state = "holds" if start.holds else "breaks"
        return (
            f"{text} As given it loses {three_digits(before)} MWh and {state} "
            f"{'all' if start.holds else 'some'} limits."
        )

    def to_csv(self) -> str:
        """All designs, in SI units but for energy and friction, one in a line."""
        text = io.StringIO()
        rows = csv.writer(text, lineterminator="\n")
        heads = [f"{name} [{units}]" for name, (units, _) in NUMBERS.items()]
        keys = [axis.key for axis in self.space.axes]
        rows.writerow([*keys, *heads, "front", "best", "governs", "condition of", "why"])
        front = {*self.front.index}
        best = None if self.best is None else self.best.tobytes()
        for k, (point, answer) in enumerate(zip(self.points, self.answers)):
            values = [axis.shown(x) for axis, x in zip(self.space.axes, point)]
            numbers = [plain(answer.numbers.get(name, math.nan)) for name in NUMBERS]
            told = ["" if v is None else repr(v) for v in numbers]
            marks = [int(k in front), int(point.tobytes() == best)]
            rows.writerow([*values, *told, *marks, answer.governs, answer.lacks, answer.why])
        return text.getvalue()

    def as_dict(self) -> dict[str, Any]:
        """All of it in plain values for JSON; what is not known is None."""
        axes = [
            {
                "key": axis.key, "unit": axis.unit, "low": axis.low, "high": axis.high,
                "values": [axis.shown(k) for k in range(len(axis.values))],
            }
            for axis in self.space.axes
        ]  # fmt: skip
        designs = [
            {
                "settings": [axis.shown(x) for axis, x in zip(self.space.axes, point)],
                "point": point.tolist(),
                "numbers": {name: plain(v) for name, v in answer.numbers.items()},
                "governs": answer.governs,
                "lacks": answer.lacks,
                "why": answer.why,
            }
            for point, answer in zip(self.points, self.answers)
        ]
        return {
            "name": self.name,
            "candidate": self.candidate,
            "title": self.title,
            "conclusion": self.conclusion,
            "left_out": self.left_out,
            "margin": self.options.margin,
            "axes": axes,
            "numbers": {
                name: {"units": units, "meaning": meaning, "shown": SHOWN[units]}
                for name, (units, meaning) in NUMBERS.items()
            },
            "quantities": named_quantities(),
            "given": {name: plain(v) for name, v in self.given.numbers.items()},
            "best": None if self.best is None else self.index_of(self.best),
            "settings": self.settings,
            "at_ends": list(self.at_ends),
            "front": {"levels": list(self.front.levels), "index": list(self.front.index)},
            "designs": designs,
            "maps": [
                {
                    "keys": list(one.keys),
                    "across": one.across.tolist(),
                    "up": one.up.tolist(),
                    "values": {
                        name: [[plain(float(v)) for v in row] for row in one.values(name)]
                        for name in ("energy", "load_factor", "condition")
                    },
                }
                for one in self.maps
            ],
            "told_by_runs": self.told_by_runs,
            "checks": {name: one.as_dict() for name, one in self.judged.items()},
            "failures": self.failures,
        }

    def index_of(self, point: np.ndarray) -> int:
        """Number of a design."""
        return next(k for k, one in enumerate(self.points) if one.tobytes() == point.tobytes())


def front_of(points: Sequence[np.ndarray], answers: Sequence[DesignPoint]) -> tuple[int, ...]:
    """Numbers of the designs that hold, of which none loses less with as much margin.

    Examples
    --------
    >>> import numpy as np
    >>> def one(energy, margin):
    ...     return DesignPoint({"energy": energy, "load_factor": margin, "condition": 2.0})
    >>> front_of([np.zeros(1)] * 3, [one(3.0, 1.0), one(5.0, 2.0), one(4.0, 0.9)])
    (0, 1)
    """
    order = sorted(
        (k for k, a in enumerate(answers) if not a.why and a.condition >= 1),
        key=lambda k: (-answers[k].load_factor, answers[k].energy),
    )
    found, least = [], math.inf
    for k in order:
        if answers[k].energy < least:
            least = answers[k].energy
            found.append(k)
    return tuple(reversed(found))


def best_of(
    points: Sequence[np.ndarray],
    answers: Sequence[DesignPoint],
    margin: float,
    passed: Sequence[bytes] = (),
    share: float = 1.0,
) -> np.ndarray | None:
    """Point of the least energy that holds; None where none does.

    Parameters
    ----------
    points, answers
        Of all designs.
    margin : float
        That it must have.
    passed : sequence of bytes
        Points that are no longer asked.
    share : float
        Share of margin and conditions of the fast models that is left when a design is run.
    """
    holding = [
        (answer.energy, k)
        for k, answer in enumerate(answers)
        if not answer.why
        and share * answer.load_factor >= margin
        and min(1.0, share) * answer.condition >= 1
        and math.isfinite(answer.energy)
        and points[k].tobytes() not in passed
    ]
    return points[min(holding)[1]] if holding else None


def most_room(
    points: Sequence[np.ndarray],
    answers: Sequence[DesignPoint],
    margin: float,
    passed: Sequence[bytes] = (),
) -> np.ndarray | None:
    """Point of the design that is furthest from its nearest limit; None where none holds.

    Parameters
    ----------
    points, answers, margin, passed
        As of `best_of`.
    """
    rooms = [
        (min(answer.load_factor / margin, answer.condition), k)
        for k, answer in enumerate(answers)
        if not answer.why and math.isfinite(answer.energy) and points[k].tobytes() not in passed
    ]
    room, k = max(rooms, default=(0.0, -1))
    return points[k] if room >= 1 else None


def scene_of_best(scene: Scene, designs: Designs) -> str:
    """The scene with the best design as its bearings, as TOML, ready to run."""
    assert designs.best is not None
    places, friction = designs.space.data(designs.best.tolist())
    name = f"{scene.name}-{designs.candidate}"
    return scene_with_bearings(scene, name, places, friction, designs.conclusion)


def scene_with_bearings(
    scene: Scene, name: str, places: Mapping[str, Any], friction: Mapping[str, Any], words: str
) -> str:
    """The scene with other bearings, as TOML that begins with `words`."""
    data = scene.model_dump(mode="json", exclude_unset=True, exclude_none=True)
    for part in ("candidates", "design", "journal", "thrust", "rolling", "results"):
        data.pop(part, None)
    data["name"] = name
    if friction:
        data["friction"] = dict(friction)
    data["shaft"] = scene.shaft.model_dump(mode="json", exclude_none=True)
    data["bearings"] = dict(places)
    return f"# {words}\n{tomli_w.dumps(data)}"
