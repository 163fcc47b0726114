"""What carries the force along the shaft where no result of a run says it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from loadflow.scene.scene import Scene
from loadflow.verdict import Verdict

SLIGHT = 1e-6
"""Of the radial load: a force along the shaft below this is none."""

_ROOMS = ("journal", "rolling", "thrust")


@dataclass(frozen=True)
class Located:
    """A place that locates a shaft, of whose bearing there the run has no result.

    Attributes
    ----------
    place : str
        Its name.
    force : float
        Largest force along the shaft there, N.
    case, time
        Where and when, s.
    subject : str
        What the verdict on it is about.
    carried : bool
        Whether a bearing of the scene carries the force.
    note : str
        What does, in words.
    """

    place: str
    force: float
    case: str
    time: float
    subject: str
    carried: bool
    note: str


def located(scene: Scene, tables: Mapping[str, xr.Dataset]) -> Iterator[Located]:
    """Yield what carries the force along each shaft of which no result says it.

    Where the locating bearing has results, its own verdict does. A suspension none of whose
    bearings is solved has no arrangement to be judged.
    """
    solved = {
        room: {*map(str, tables[room]["bearing"].values)} for room in _ROOMS if room in tables
    }
    if "shaft" not in tables:
        return
    rooms, anywhere = _stated(scene), set().union(*solved.values())
    for concept in scene.shaft.concepts:
        place = concept.bearings[concept.locating]
        if not anywhere & {*concept.bearings}:
            continue
        if any(place in solved.get(room, ()) for room in ("thrust", "rolling")):
            continue
        if place in solved.get("journal", ()) and place not in rooms["thrust"]:
            continue
        table = tables["shaft"].sel(bearing=place)
        forces = table["largest_axial_load"].values
        k = int(np.nanargmax(forces))
        force, case = float(forces[k]), str(table["case"].values[k])
        if force > SLIGHT * float(table["largest_load"].max()):
            time = float(table["largest_axial_load_time"].values[k])
            yield _at(scene, place, rooms, next(iter(solved)), force, case, time)


def uncarried(scene: Scene, tables: Mapping[str, xr.Dataset]) -> Iterator[Verdict]:
    """Yield a verdict on the force along the shaft at each place that `located` names.

    The loop over the solved bearings of a scene does not see such a place.
    """
    for one in located(scene, tables):
        yield Verdict(
            one.subject, "force along the shaft without a bearing",
            0.0 if one.carried else one.force, 0.0, "at most", "N", "equilibrium of the shaft",
            one.case, one.time, one.note,
        )  # fmt: skip


def has_collar(scene: Scene, place: str) -> bool:
    """Whether a film bearing of the scene carries the thrust of a place, wanted or not."""
    return place in _stated(scene)["thrust"]


def _stated(scene: Scene) -> dict[str, Mapping[str, object]]:
    """Bearings by room and place; defaults of a room neither stated nor wanted do not count."""
    rooms: dict[str, Mapping[str, object]] = {
        "journal": dict.fromkeys(scene.journal.bearings),
        "rolling": scene.rolling.geometries,
        "thrust": scene.thrust.bearings,
    }
    return {
        name: there if name in scene.model_fields_set or scene.wants(name) else {}
        for name, there in rooms.items()
    }


def _at(
    scene: Scene,
    place: str,
    rooms: Mapping[str, Mapping[str, object]],
    room: str,
    force: float,
    case: str,
    time: float,
) -> Located:
    """What a scene has at a place without a result, and whether it carries the force."""
    size, subject = f"{force / 1e3:.0f} kN along the shaft", f"{room} arrangement"
    unjudged = "no result of it is wanted, so that it is not judged itself"
    if place in rooms["thrust"]:
        part = scene.thrust.bearings[place]
        note = f"{size} is carried by {place}, a {part.words}; {unjudged} (thrust.film)"
        return Located(place, force, case, time, f"{part.kind} {place}", True, note)
    if place in rooms["rolling"]:
        bearing = scene.rolling.geometries[place]
        if bearing.takes_thrust:
            note = f"{size} is carried by {place}, a {bearing.words}; {unjudged}"
            note += " (rolling.life)"
            return Located(place, force, case, time, f"rolling {place}", True, note)
        kind = f"a {bearing.words}"
    elif place in rooms["journal"]:
        kind = "a journal bearing"
    else:
        note = (
            f"{size} loads place {place}, which locates it; place {place} has no bearing in "
            "this scene, and nothing in the scene carries it"
        )
        return Located(place, force, case, time, subject, False, note)
    note = (
        f"{size} loads place {place}, which locates it; {kind} stands there, which carries "
        "no thrust: it needs a thrust bearing"
    )
    return Located(place, force, case, time, subject, False, note)
