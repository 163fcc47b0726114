"""What a scene can want, and what it wants if it does not say."""

from __future__ import annotations

from typing import Any, Literal, get_args

from pydantic import ValidationError

from loadflow.scene.bearings import Rolling
from loadflow.scene.journal import Journal
from loadflow.scene.shaft import Shaft

Result = Literal[
    "loads.statistics",
    "seeds.equality",
    "reduction.histogram",
    "journal.film",
    "journal.dynamics",
    "journal.wear",
    "rolling.loads",
    "rolling.life",
    "rolling.friction",
    "rolling.dynamics",
    "thrust.film",
]

RESULTS: dict[Result, str] = {
    "loads.statistics": "Statistics, extremes and equivalent loads of every load case.",
    "seeds.equality": "Which seeds of a wind speed are equal, and so may be merged.",
    "reduction.histogram": "Reduced series of speed and load for each bearing.",
    "journal.film": "Film, pressure, friction and flow of journal bearings over the series.",
    "journal.dynamics": "Vibration of the shaft in its films: frequencies, damping, stability.",
    "journal.wear": "Wear of bores over the starts, stops and faults of a lifetime.",
    "rolling.loads": "Forces and pressures of the rolling elements, static safety.",
    "rolling.life": "Rating life and modified life.",
    "rolling.friction": "Friction, film parameter and slip of rolling bearings.",
    "rolling.dynamics": "Vibration of the shaft on its rolling bearings, their K and C over speed.",
    "thrust.film": "Films of thrust collars and pairs of cones.",
}
"""Every result, in words."""

BY_NAME: tuple[Result, ...] = ("journal.dynamics", "journal.wear", "rolling.dynamics")
"""Results that are computed only where a scene asks for them by name."""

OF_PLACES: tuple[Result, ...] = tuple(name for name in get_args(Result) if name not in BY_NAME)
"""Results of a scene that names none, as far as it has bearings for them."""

USUAL: tuple[Result, ...] = tuple(name for name in OF_PLACES if name != "thrust.film")
"""The same of a scene that names no bearings either: no film bearing carries its thrust."""


def has_films(data: dict[str, Any]) -> bool:
    """Whether data of a scene, in sections, want a result of journal bearings."""
    results = data.get("results", USUAL)
    return isinstance(results, (list, tuple)) and any(
        isinstance(name, str) and name.startswith("journal.") for name in results
    )


def that_the_shaft_can_give(data: dict[str, Any], stated: set[str]) -> dict[str, Any]:
    """Without `results`: all, but none of a bearing by default that the shaft does not have."""
    if "results" in data or "shaft" not in data:
        return data
    try:
        there = set(Shaft.model_validate(data["shaft"]).bearings)
    except ValidationError:  # told by the shaft's own check, with its key
        return data
    by_default = {"journal": {*Journal().bearings}, "rolling": {Rolling().bearing}}
    absent = {room for room, own in by_default.items() if room not in stated and own - there}
    wanted = [name for name in USUAL if name.split(".")[0] not in absent]
    return data | {"results": wanted}
