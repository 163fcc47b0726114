"""How accurate a wanted result is, end to end, and the cheapest models that are accurate enough.

The error of a result is the sum of what each stage on the way to it adds, at its largest in the
ladder. An error of the load reaches a bearing's answer through the gain d ln(answer)/d ln(load)
of that answer, which is measured too.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np

from loadflow.ladder import (
    choices,
    expected_seconds,
    finest,
    gains,
    is_open,
    measured,
    rung_of,
    with_settings,
)
from loadflow.scene import Scene
from loadflow.stages.cases import Case

OPEN_STAGES = ("loads", "reduction", "journal", "rolling")
"""Stages that offer more than one model of the same thing."""

FINEST_GRID = 480
"""Cells around that a run goes up to by itself."""


@dataclass(frozen=True)
class Link:
    """What a stage adds to the error of an answer.

    `error` is the quantity in the ladder's entry of the stage; `of_load` says that it is an error
    of the load, which the bearing answers with its gain.
    """

    stage: str
    error: str
    of_load: bool = False


def _film(reduction: str, journal: str) -> tuple[Link, ...]:
    return (
        Link("loads", "bearing load max", of_load=True),
        Link("reduction", reduction),
        Link("journal", journal),
    )


def _contact(quantity: str) -> tuple[Link, ...]:
    return (
        Link("loads", "bearing load max", of_load=True),
        Link("reduction", "largest load", of_load=True),
        Link("rolling", quantity),
    )


CHAINS: dict[str, dict[str, tuple[Link, ...]]] = {
    "loads.statistics": {
        "bearing load max": (Link("loads", "bearing load max"),),
        "bearing force DEL": (Link("loads", "bearing force DEL"),),
    },
    "seeds.equality": {},
    "rolling.friction": {},
    "reduction.histogram": {
        "largest load": (Link("loads", "bearing load max"), Link("reduction", "largest load")),
    },
    "journal.film": {
        "eccentricity ratio": _film("E_max", "eccentricity ratio"),
        "minimum film": _film("h_min", "minimum film"),
        "maximum pressure": _film("p_max", "maximum pressure"),
        "friction power": _film("friction power", "friction power"),
    },
    "rolling.loads": {
        "maximum force": _contact("maximum force"),
        "maximum pressure": _contact("maximum pressure"),
    },
    "rolling.life": {
        "life": (
            Link("loads", "bearing force DEL", of_load=True),
            Link("reduction", "life"),
            Link("rolling", "life"),
        ),
    },
}
"""For each result, what users read of it, and the stages whose errors reach it."""


@dataclass(frozen=True)
class Choice:
    """Models for a scene: the scene with all of them named, and what to expect of it.

    Attributes
    ----------
    scene : Scene
        With the rung of every stage set.
    reasons : dict
        Why each rung was taken, by stage.
    errors : dict
        Expected error of what users read, by result and quantity; None where not measured.
    met : bool
        Whether every expected error is known and within the accuracy that is asked for.
    """

    scene: Scene
    reasons: dict[str, str]
    errors: dict[str, dict[str, float | None]]
    met: bool = True


def expected_errors(scene: Scene) -> dict[str, dict[str, float | None]]:
    """Return the error to expect of each wanted result, by quantity; None where not measured."""
    return {
        result: {
            name: _total(scene, (result.split(".")[0], name), links)
            for name, links in CHAINS[result].items()
        }
        for result in scene.results
    }


def _total(scene: Scene, answer: tuple[str, str], links: tuple[Link, ...]) -> float | None:
    """Add up what the links bring to an answer, which is a room and a quantity."""
    parts = [_added(scene, answer, link) for link in links]
    return None if None in parts else float(sum(part for part in parts if part is not None))


def _added(scene: Scene, answer: tuple[str, str], link: Link) -> float | None:
    if link.stage == "reduction" and answer[0] == "journal" and scene.journal.in_motion:
        return 0.0  # a film in motion reads the whole series
    known = measured(scene, link.stage)
    if known is None:
        return None
    if not known["errors"]:
        return 0.0  # the top rung, or exact
    if link.error not in known["errors"]:
        return None
    error = known["errors"][link.error]["max"]
    room, quantity = answer
    return error * gains()[room][quantity] if link.of_load else error


def choose(scene: Scene, stages: Iterable[str], cases: tuple[Case, ...]) -> Choice:
    """Choose the cheapest models that hold the accuracy that the scene asks for.

    Parameters
    ----------
    scene : Scene
        What is wanted. Without `accuracy` its rungs stay as they are.
    stages : iterable of str
        Stages that will run.
    cases : tuple of Case
        Load cases, for the expected time.

    Returns
    -------
    Choice
        Where no combination is accurate enough, the most accurate one, `met` False.
    """
    stages = tuple(stages)
    options = {stage: choices(scene, stage) for stage in OPEN_STAGES if stage in stages}
    if scene.accuracy is None:
        return Choice(scene, dict.fromkeys(options, "as the scene says"), expected_errors(scene))
    candidates = list(_combinations(scene, options))
    excess = [_excess(candidate) for candidate in candidates]
    good = [k for k, ratio in enumerate(excess) if ratio <= 1.0]
    best = (
        min(good, key=lambda k: _seconds(candidates[k], stages, cases))
        if good
        else int(np.argmin(excess))
    )
    why = "cheapest that is accurate enough" if good else "most accurate that was measured"
    reasons = {
        stage: why if len(found) > 1 else "as the scene says" for stage, found in options.items()
    }
    return Choice(candidates[best], reasons, expected_errors(candidates[best]), met=bool(good))


def _combinations(scene: Scene, options: dict[str, list[Scene]]) -> Iterator[Scene]:
    for picked in product(*options.values()):
        sections = {stage: getattr(one, stage) for stage, one in zip(options, picked)}
        yield scene.model_copy(update=sections)


def _excess(scene: Scene) -> float:
    """Largest ratio of expected error to what is allowed; infinite where one is not known."""
    ratios = [
        float("inf") if error is None else error / allowed
        for result, errors in expected_errors(scene).items()
        if (allowed := scene.allowed_error(result)) is not None
        for error in errors.values()
    ]
    return max(ratios, default=0.0)


def _seconds(scene: Scene, stages: tuple[str, ...], cases: tuple[Case, ...]) -> float:
    costs = [expected_seconds(scene, stage, cases) for stage in stages]
    return sum(float("inf") if cost is None else cost for cost in costs)


def finer(scene: Scene, stage: str) -> Scene | None:
    """Return the scene with the next more accurate model of a stage; None at the top.

    A film has no top: its grid is doubled, up to what a scene may ask for.
    """
    around, across = scene.journal.grid
    settings: dict[str, Any] = {}
    if stage == "journal" and 2 * around <= FINEST_GRID:
        settings = {"rung": "grid", "grid": (2 * around, 2 * across)}
    elif stage == "loads" and rung_of(scene, "loads") not in ("files", finest(scene)):
        settings = {"rung": finest(scene)}
    elif stage == "rolling" and scene.rolling.rings == "rigid":
        settings = {"rings": "flexible"}
    elif stage == "reduction" and scene.reduction.size < 1.0:
        settings = {"size": min(1.0, 2 * scene.reduction.size)}
    return with_settings(scene, stage, settings) if settings else None


def climb(choice: Choice, stages: Iterable[str]) -> Choice:
    """Return the choice with the model of a stage one better for each mention of it."""
    scene, reasons = choice.scene, dict(choice.reasons)
    for stage in stages:
        scene = finer(scene, stage) or scene
        reasons[stage] = "climbed: the coarser model differs too much on cases of this run"
    return replace(choice, scene=scene, reasons=reasons, errors=expected_errors(scene))


def may_climb(wanted: Scene, chosen: Scene, stage: str) -> bool:
    """Whether a stage's model is the plan's to choose, and there is a better one."""
    return stage in OPEN_STAGES and is_open(wanted, stage) and finer(chosen, stage) is not None
