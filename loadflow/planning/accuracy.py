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

from loadflow.planning.ladder import (
    choices,
    expected_seconds,
    finest,
    gains,
    is_open,
    measured,
    rung_of,
    section_of,
    with_settings,
)
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene

OPEN_STAGES = ("wind", "loads", "reduction", "journal", "rolling")
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


def _load(quantity: str, of_load: bool = True) -> tuple[Link, ...]:
    """What a load brings: the error of the wind and that of the rotor."""
    return Link("wind", quantity, of_load), Link("loads", quantity, of_load)


def _film(reduction: str, journal: str) -> tuple[Link, ...]:
    return *_load("bearing load max"), Link("reduction", reduction), Link("journal", journal)


def _contact(quantity: str) -> tuple[Link, ...]:
    return (
        *_load("bearing load max"),
        Link("reduction", "largest load", of_load=True),
        Link("rolling", quantity),
    )


def _friction(quantity: str) -> tuple[Link, ...]:
    return *_load("bearing load max"), Link("friction", quantity)


CHAINS: dict[str, dict[str, tuple[Link, ...]]] = {
    "loads.statistics": {
        "bearing load max": _load("bearing load max", of_load=False),
        "bearing force DEL": _load("bearing force DEL", of_load=False),
    },
    "seeds.equality": {},
    "reduction.histogram": {
        "largest load": (
            *_load("bearing load max", of_load=False),
            Link("reduction", "largest load"),
        ),
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
            *_load("bearing force DEL"),
            Link("reduction", "life"),
            Link("rolling", "life"),
        ),
    },
    "rolling.friction": {
        quantity: _friction(quantity) for quantity in ("friction power", "film parameter", "slip")
    },
}
"""For each result, what users read of it, and the stages whose errors reach it.

A verdict on seeds is no number, and has no error.
"""


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
    if link.stage == "wind" and not scene.loads.makes_wind:
        return 0.0  # it is given
    known = measured(scene, link.stage)
    if known is None or known["errors"] is None:
        return None
    if not known["errors"]:
        return 0.0  # the top rung, or exact
    if link.error not in known["errors"]:
        return None
    error = known["errors"][link.error]["max"]
    if not link.of_load:
        return error
    room, quantity = answer
    gain = gains()[room].get(quantity)
    return None if gain is None else error * gain


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
        Where no combination is accurate enough, the most accurate one; where some errors were not
        measured, one with as few of these as can be, chosen by the others. `met` is False in both.
    """
    stages = tuple(stages)
    chosen = [stage for stage in OPEN_STAGES if stage in (*stages, *_within(stages))]
    reasons = dict.fromkeys(map(section_of, chosen), "as the scene says")
    if scene.accuracy is None:
        return Choice(scene, reasons, expected_errors(scene))
    candidates = list(_combinations(scene, chosen))
    rank = [_unknown_and_excess(candidate) for candidate in candidates]
    unknown = min(found[0] for found in rank)
    good = [k for k, found in enumerate(rank) if found[0] == unknown and found[1] <= 1.0]
    best = (
        min(good, key=lambda k: _unknown_and_seconds(candidates[k], stages, cases))
        if good
        else min(range(len(rank)), key=rank.__getitem__)
    )
    why = "cheapest that is accurate enough" if good else "most accurate that was measured"
    if unknown:
        why += ", by the errors that are known"
    reasons |= {section_of(stage): why for stage in chosen if is_open(scene, stage)}
    errors = expected_errors(candidates[best])
    return Choice(candidates[best], reasons, errors, met=bool(good) and not unknown)


def _within(stages: tuple[str, ...]) -> tuple[str, ...]:
    """Stages of the ladder that run inside one of the plan."""
    return ("wind",) if "loads" in stages else ()


def _combinations(scene: Scene, stages: Iterable[str]) -> Iterator[Scene]:
    sections: dict[str, list[Scene]] = {}
    for stage in stages:
        name = section_of(stage)
        before = sections.get(name, [scene])
        sections[name] = [one for other in before for one in choices(other, stage)]
    for picked in product(*sections.values()):
        yield scene.model_copy(
            update={name: getattr(one, name) for name, one in zip(sections, picked)}
        )


def _unknown_and_excess(scene: Scene) -> tuple[int, float, float]:
    """How many errors are not known; of the others, over what is allowed, the largest and all."""
    ratios = [
        None if error is None else error / allowed
        for result, errors in expected_errors(scene).items()
        if (allowed := scene.allowed_error(result)) is not None
        for error in errors.values()
    ]
    known = [ratio for ratio in ratios if ratio is not None]
    return ratios.count(None), max(known, default=0.0), sum(known)


def _unknown_and_seconds(
    scene: Scene, stages: tuple[str, ...], cases: tuple[Case, ...]
) -> tuple[int, float]:
    """How many times are not known, and the sum of those that are."""
    costs = [expected_seconds(scene, stage, cases) for stage in stages]
    return costs.count(None), sum(cost for cost in costs if cost is not None)


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
