"""Tolerances of the bearings' values: how far the answers of a run move at both ends of each band.

A few samples of the load cases of the largest estimated loads are solved with the models of the
run, then with one value at a time at an end of its band, in all bearings that have it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import LoadflowError
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.scene.tolerances import ALIGNMENT
from loadflow.stages.effects.film_tilt import TILT
from loadflow.stages.labelling import label
from loadflow.stages.probes import PROBES, Answers, hardest
from loadflow.stages.stage import Rungs, Stage

ROOMS = {"journal": "journal.film", "thrust": "thrust.film", "rolling": "rolling.l"}
"""Rooms of bearings that have probes, and how the results begin that these answer."""

MARGIN = "minimum film over its limit"
"""Of journal and thrust bearings: the limit rises with the roughness."""

ENDS = {"low": -1, "high": 1}


@dataclass(frozen=True)
class Change:
    """How an answer of a bearing moves at both ends of the band of a value.

    Attributes
    ----------
    room, bearing, key, quantity, case : str
        Of which bearing, by which value, what, and in which load case; the room is that of the
        bearing's kind: journal, thrust, rolling.
    low, high : float
        Relative change at the lower and the upper end; NaN where the bearing has no answer there.
    """

    room: str
    bearing: str
    key: str
    quantity: str
    case: str
    low: float
    high: float


def is_asked(scene: Scene) -> bool:
    """Whether a value has a tolerance that an answer of the scene depends on."""
    return bool(scene.tolerances) and bool(_rooms(scene))


def _rooms(scene: Scene) -> list[str]:
    """Rooms of the answers that are wanted."""
    return [
        room
        for room, begins in ROOMS.items()
        if any(result.startswith(begins) for result in scene.results)
    ]


def changes(scene: Scene, cases: list[Case], inputs: Mapping[str, Any]) -> xr.Dataset:
    """How answers move at the ends of all bands; dimension ``change``."""
    rows = [row for case in cases for row in _of_case(scene, case, inputs[case.name])]
    text = ("room", "bearing", "key", "quantity", "case")
    return xr.Dataset(
        {
            end: (
                "change",
                np.array([getattr(row, end) for row in rows], float),
                label("1", f"relative change with the value at the {name} end of its band"),
            )
            for end, name in (("low", "lower"), ("high", "upper"))
        },
        {name: ("change", np.array([getattr(row, name) for row in rows], str)) for name in text},
    )


def _of_case(scene: Scene, case: Case, parts: Mapping[str, Any]) -> Iterator[Change]:
    if any(key.split(".")[0] == ALIGNMENT for key in scene.toleranced.keys):
        scene = TILT.switched(scene, True) or scene
    known: dict[str, Answers] = {}
    bearings = scene.toleranced
    for key in bearings.keys:
        ends = [bearings.at_end(key, sign) for sign in ENDS.values()]
        for room in _rooms(scene):
            sections = [getattr(end, room) for end in ends]
            if all(section == getattr(scene, room) for section in sections):
                continue
            if room not in known:
                known[room] = _answers(scene, room, case, parts)
            found = [
                _or_none(partial(_answers, there, room, case, parts), known[room])
                for there in (scene.model_copy(update={room: section}) for section in sections)
            ]
            for (bearing, quantity), before in known[room].items():
                if key in scene.tolerances.get(bearing, {}):
                    after = [answers[bearing, quantity] for answers in found]
                    low, high = (value / before - 1.0 if before else np.nan for value in after)
                    yield Change(room, bearing, key, quantity, case.name, low, high)


def _answers(scene: Scene, room: str, case: Case, parts: Mapping[str, Any]) -> Answers:
    """What a probe answers, and the film over its limit."""
    found = PROBES[room].answers(scene, case, parts)
    for (bearing, quantity), value in tuple(found.items()):
        if quantity == "minimum film":
            thrust = scene.thrust.bearings
            options = thrust[bearing] if room == "thrust" else scene.journal.at(bearing)
            found[bearing, MARGIN] = value / options.least_film
    return found


def _or_none(answers: Any, before: Answers) -> Answers:
    """What a probe answers; NaN where it does not."""
    try:
        found: Answers = answers()
    except LoadflowError:
        return dict.fromkeys(before, np.nan)
    return found


def warnings(tree: xr.DataTree) -> list[str]:
    """Return a sentence on each value at an end of whose band a bearing has no answer."""
    if STAGE.name not in tree.children:
        return []
    table = tree[STAGE.name].to_dataset()
    without = table.isel(change=(table["low"].isnull() | table["high"].isnull()).values)
    pairs = zip(without["bearing"].values.tolist(), without["key"].values.tolist())
    return [
        f"tolerances: bearing {bearing} has no answer at an end of the band of {key}"
        for bearing, key in dict.fromkeys(pairs)
    ]


STAGE = Stage(
    "tolerances",
    run=changes,
    needs=lambda scene: (
        "loads",
        "shaft",
        *(("reduction",) if scene.reduction.method != "histogram" else ()),
    ),
    scope="run",
    sections=lambda scene: ("tolerances", "journal", "rolling", "thrust", "friction", "reduction"),
    models=(Rungs("tolerances", section="tolerances", key=lambda s: "-", exact=lambda s: True),),
    warnings=warnings,
    pieces=lambda scene, cases: [[case] for case in hardest(scene, tuple(cases))],
    joined=lambda scene, found: xr.concat(found, "change"),
    work=lambda scene, cases, measured: None,
    left_out=lambda scene: {},
    asked=is_asked,
)
