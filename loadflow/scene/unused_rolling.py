"""Keys of rolling bearings and of their friction that change nothing in a scene, and why."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from pydantic import TypeAdapter

from loadflow.rolling.friction import CatalogueEntry
from loadflow.rolling.mounting import unused_of
from loadflow.scene.bearings import FurtherBearing, Ring
from loadflow.scene.candidates import candidates_of, machine
from loadflow.scene.cooling import Cooling
from loadflow.scene.dynamics import OF_ROLLING, turning
from loadflow.scene.places import GEOMETRIES
from loadflow.scene.scene import Scene
from loadflow.scene.section import keys_of


def of_each_rolling(scene: Scene) -> Iterator[tuple[str, str]]:
    """Keys of any of the rolling bearings, which stand in a list after the first one."""
    for number, part in enumerate(scene.rolling.bearings.values(), -1):
        where = "rolling" if number < 0 else f"rolling.further.{number}"
        if part.geometry.element != "roller" and "roller_model" in part.model_fields_set:
            yield f"{where}.roller_model", f"a {part.geometry.kind} bearing has no rollers"
        unread = "rolling.friction" not in scene.results
        if part.catalogue is not None and unread and not _comes_with(scene, part.catalogue):
            yield f"{where}.catalogue", "the result rolling.friction is not wanted"
        for ring, reason in _of_rings(scene, part):
            yield f"{where}.{ring}", reason
        for key, reason in unused_of(part.mounting, part.geometry) if part.mounting else ():
            yield f"{where}.mounting.{key}", reason
        for key, reason in _of_vibration(scene, part):
            yield f"{where}.{key}", reason
        if reason := _why_not_cooled(scene, part):
            yield f"{where}.cooling", reason


def _sized_cooling(scene: Scene) -> list[Cooling]:
    """Cooling that comes with the bearings sized for the turbine: nobody stated it."""
    stated = machine(scene.turbine.name).get("cooling")
    return [] if stated is None else [Cooling(**stated)]


def _why_not_cooled(scene: Scene, part: FurtherBearing) -> str:
    """Why the cooling that a bearing states changes nothing; empty if it does, or if nobody did."""
    friction = scene.friction
    if part.cooling is None or part.cooling in _sized_cooling(scene):
        return ""
    if friction.cooling_of(part) is not part.cooling:
        return "the section friction states conductance, cooling or temperature, which goes before"
    if part.cooling.temperature is None and not part.balances_heat:
        return "it swings, or has no model of friction, and is as warm as friction.temperature says"
    if not (part.mounting or {"rolling.friction", "rolling.life"} & set(scene.results)):
        return "neither friction nor life of it is wanted"
    return ""


_OTHERS = ("rolling.life", "rolling.loads", "rolling.friction")


def _of_vibration(scene: Scene, part: FurtherBearing) -> Iterator[tuple[str, str]]:
    """Keys of a bearing of which rotor dynamics are wanted, and nothing else."""
    if OF_ROLLING not in scene.results or any(name in scene.results for name in _OTHERS):
        return
    if part.bearing not in turning(scene.rolling, scene.shaft):
        yield "oscillation", f"{OF_ROLLING} is of bearings that turn with the rotor"
    for key in ("limits", "inertia"):
        if getattr(part, key) != keys_of(part)[key]:
            yield key, f"of the results of rolling bearings only {OF_ROLLING} is wanted"
    support = scene.shaft.coupled.get(part.bearing)
    if support is None or support.stiffness != "rolling":
        sized = _sized_rings(scene)
        for key in ("rings", "inner_ring", "outer_ring"):
            value = getattr(part, key)
            if value not in (None, keys_of(part)[key]) and value not in sized:
                yield key, f"{OF_ROLLING} takes rigid rings"


def _comes_with(scene: Scene, entry: CatalogueEntry) -> bool:
    """Whether an entry is one of the bearings that are sized for the turbine: nobody stated it."""
    sized = candidates_of(scene.turbine.name).values()
    parts = (part for one in sized for part in one.values() if isinstance(part, dict))
    return any(
        "catalogue" in part and entry == CatalogueEntry(**part["catalogue"]) for part in parts
    )


def _sized_rings(scene: Scene) -> list[Any]:
    """Rings that come with the bearings sized for the turbine: nobody stated them."""
    sized = candidates_of(scene.turbine.name).values()
    parts = (part for one in sized for part in one.values() if isinstance(part, dict))
    keys = ("inner_ring", "outer_ring")
    return [_RING.validate_python(part[key]) for part in parts for key in keys if key in part]


_RING = TypeAdapter(Ring)


def _of_rings(scene: Scene, part: FurtherBearing) -> Iterator[tuple[str, str]]:
    reason = ""
    if not part.geometry.flexible_rings:
        reason = f"a {part.geometry.kind} bearing has rigid rings only"
    elif part.rings == "rigid" and (not scene.asks or "rings" in part.model_fields_set):
        reason = 'rings = "rigid"'
    sized = _sized_rings(scene) if reason else ()
    for key in ("inner_ring", "outer_ring") if reason else ():
        if (ring := getattr(part, key)) not in (None, keys_of(part)[key]) and ring not in sized:
            yield key, reason


def every_rolling(scene: Scene) -> list[FurtherBearing]:
    """Rolling bearings of the scene and of its candidates."""
    others = (one.rolling for one in scene.candidates.values() if one.rolling is not None)
    return [part for rolling in (scene.rolling, *others) for part in rolling.bearings.values()]


def mounted(scene: Scene) -> bool:
    """Whether a bearing of the scene, or of a candidate, has a clearance that follows its heat."""
    return any(part.mounting is not None for part in every_rolling(scene))


_OF_COOLING = ("conductance", "cooling", "ambient_temperature")
_OF_LIFE = ("lubricant", "temperature", "cleanliness", *_OF_COOLING)
"""Keys of friction that the modified life reads, too."""

_OF_FILMS = ("lubricant", "temperature", "cooling", "starvation")
"""Keys of friction that stiffness and damping of contacts with a film read."""

_OF_CLEARANCE = ("temperature", "cooling", "ambient_temperature")
"""Keys of friction that the clearance of a mounted bearing reads."""


_COMPARED = "; it counts for those that `loadflow compare` takes by itself"


def _has_sized(scene: Scene, place: str) -> bool:
    """Whether a comparison without candidates of the scene has a rolling bearing at a place."""
    taken = {} if scene.candidates else candidates_of(scene.turbine.name)
    parts = [one.get(place, {}) for one in taken.values()]
    return any(isinstance(part, dict) and part.get("kind") in GEOMETRIES for part in parts)


def of_friction(scene: Scene) -> Iterator[tuple[str, str]]:
    """Yield the keys of friction that the rest of a scene leaves without effect, and why."""
    friction = scene.friction
    films = OF_ROLLING in scene.results and scene.dynamics.contact_model == "film"
    if "rolling.friction" not in scene.results:
        vibrate = _OF_FILMS if films else ()
        rated = _OF_LIFE if any(r.startswith("rolling.l") for r in scene.results) else ()
        warm = _OF_CLEARANCE if mounted(scene) else ()
        for key in type(friction).model_fields:
            if key not in (*vibrate, *rated, *warm):
                yield key, "the result rolling.friction is not wanted"
    yield from _of_cooling(scene, films)
    if "rolling.friction" in scene.results:
        yield from _of_rollers(scene)


def _of_cooling(scene: Scene, films: bool) -> Iterator[tuple[str, str]]:
    """Keys of how warm bearings are; their `films` may be read beside their friction."""
    friction = scene.friction
    for place in friction.cooling:
        parts = [part for part in every_rolling(scene) if part.bearing == place]
        if not parts:
            why = "no rolling bearing of the scene stands there, nor of its candidates"
            yield f"cooling.{place}", why + (_COMPARED if _has_sized(scene, place) else "")
        elif "rolling.friction" not in scene.results and not (
            any(friction.states(part) or part.balances_heat for part in parts)
        ):
            why = "it swings, or has no model of friction, and is as warm as stated"
            yield f"cooling.{place}", why
    if not (friction.balances(every_rolling(scene)) or mounted(scene)):
        yield "ambient_temperature", "no cooling of a bearing is stated, and no mounting"
    elif not films and all(
        friction.states(part) or (part.balances_heat and friction.conductance_of(part) is not None)
        for part in scene.rolling.bearings.values()
    ):
        yield "temperature", "with a conductance each bearing has that of its heat balance"


def _of_rollers(scene: Scene) -> Iterator[tuple[str, str]]:
    """Keys of rollers that are followed, and of those on ribs."""
    friction, bearings = scene.friction, scene.rolling.geometries.values()
    if friction.follow_every > 1 and all(b.friction_model != "rollers" for b in bearings):
        yield "follow_every", "no bearing of this scene has rollers whose motion is followed"
    rollers = [b for b in bearings if b.friction_model == "rollers"]
    ribs = ("rib_height", "rib_radius", "rib_friction")
    if not rollers:
        for key in ("rib_angle", *ribs):
            yield key, "no bearing of this scene has rollers on ribs"
    elif friction.rib_angle == 0.0 or (
        friction.rib_angle is None and not any(b.rib_guided for b in rollers)
    ):
        for key in ribs:
            yield key, "the rollers press on no rib: friction.rib_angle is 0"
