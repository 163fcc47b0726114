"""A comparison in words: its conclusion, and what went in."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from typing import Any

import xarray as xr

from loadflow.data import evidence
from loadflow.quantities import CELSIUS, percent, three_digits
from loadflow.rolling import RollerBearing, RollingBearing
from loadflow.scene.as_built import AsBuilt
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.cooling import Cooling
from loadflow.scene.friction import Friction
from loadflow.scene.scene import Scene
from loadflow.studies.candidate.factor import oil_told
from loadflow.studies.candidate.result import UNCARRIED, Judged
from loadflow.studies.seeds.intervals import Groups
from loadflow.verdict import Verdict


def conclusion(judged: Sequence[Judged], without_answer: Collection[str] = ()) -> str:
    """How many hold, which loses least, what the other kind does; last, what has no answer.

    Parameters
    ----------
    judged : sequence of Judged
        By their rank: the best is one without reservations wherever there is one.
    without_answer : collection of str
        Names of candidates that could not be solved; they count among none.
    """
    text = _sentence(judged)
    if without_answer:
        text += f" Without an answer, and not counted: {', '.join(without_answer)}."
    return text


def reservations(judged: Sequence[Judged]) -> str:
    """What speaks against candidates that hold their limits; empty where nothing does.

    Parameters
    ----------
    judged : sequence of Judged
        In the order in which they are named.
    """
    against: dict[str, list[str]] = {}
    for one in judged:
        for name, what in one.reservations.items() if one.holds else ():
            against.setdefault(name, []).append(f"{one.title} ({what})")
    parts = (f"{name}: {'; '.join(those)}" for name, those in against.items())
    return f"Reservations: {'; and '.join(parts)}." if against else ""


def _sentence(judged: Sequence[Judged]) -> str:
    good = [one for one in judged if one.holds]
    if not good:
        least = max(judged, key=lambda one: _or_zero(one.numbers["load_factor"].value))
        why = f"break {_listed(least.broken)}" if least.broken else "have parts without an answer"
        return (
            f"None of the {len(judged)} candidates holds all limits on these loads; nearest are "
            f"{_named(least)}, which {why}."
        )
    count, best = len(good), good[0]
    reserved = sum(bool(one.reservations) for one in good)
    hold = "holds its limits" if count == 1 else "hold their limits"
    text = f"{count} of {len(judged)} candidates {hold} on these loads"
    if reserved:
        some = f"of which {reserved}" if reserved < count else "all" if count > 1 else "though"
        text += f", {some} with reservations"
    left = count - reserved or count
    whose = "of these, " if left == count else "of the others, "
    text += f"; {whose if left > 1 else ''}{_told(best, least=left > 1)}"
    others = [one for one in good if one.kind != best.kind]
    if others:
        return f"{text}; the best {_told(others[0])}."
    other = [one for one in judged if one.kind != best.kind]
    if other:
        nearest = max(other, key=lambda one: _or_zero(one.numbers["load_factor"].value))
        what = _listed(nearest.broken) or "parts without an answer"
        return f"{text}; no {nearest.kind} bearings hold, the nearest ({nearest.title}) for {what}."
    return f"{text}."


def _named(one: Judged) -> str:
    return f"{one.kind} bearings ({one.title})"


def _told(one: Judged, least: bool = False) -> str:
    energy, factor = one.numbers["energy"].value, one.numbers["load_factor"].value
    if not math.isfinite(energy) and not math.isfinite(factor):
        return f"{_named(one)} tell neither of a year nor of a margin"
    if not math.isfinite(energy):
        most = "most, " if least else ""
        return f"{_named(one)} have {most}{three_digits(factor)} times these loads to their limits"
    lost = f"{three_digits(energy)} MWh a year"
    if least:
        lost = f"least, {lost}"
    if UNCARRIED in one.reservations:
        lost += " without that of a thrust bearing, which they need"
    return f"{_named(one)} lose {lost}, with a capacity margin of {three_digits(factor)}"


def _listed(verdicts: Sequence[Verdict]) -> str:
    return ", ".join(dict.fromkeys(f"{v.quantity} ({v.subject})" for v in verdicts[:3]))


def facts(
    scene: Scene, runs: Sequence[Mapping[str, xr.Dataset]], parts: Collection[FurtherBearing] = ()
) -> dict[str, str]:
    """Loads, seeds and lubricant, in words; `parts` are all rolling bearings that are compared."""
    loads = scene.loads
    table = next(
        tables[name]
        for tables in runs
        for name in ("journal", "rolling", "thrust")
        if name in tables
    )
    seeds = Groups.of(table).sizes
    source = (
        f"simulated, DLC {', '.join(loads.dlcs)}, {scene.turbine.name}, class {loads.wind_class}, "
        f"category {loads.category}"
        if loads.source == "simulate"
        else f"files, {scene.turbine.name}"
    )
    concepts = ", ".join(
        f"{name.replace('_', ' ')} ({concept.integration})"
        for name, concept in scene.shaft.suspensions.items()
    )
    few, most = min(seeds), max(seeds)
    told = f"{few} … {most} seeds" if few != most else f"{few} seed{'s' * (few != 1)}"
    return {
        "Loads": source,
        "Suspension": concepts,
        **_beams(scene),
        "Load cases": f"{table.sizes['case']}: {_at_speeds(table)}; {told} at each"
        + ("" if loads.duration is None else f", {loads.duration:g} s"),
        "Intervals": (
            "95 % by resampling the seeds of each wind speed"
            + ("; with so few seeds they are too narrow" if 1 < few < 6 else "")
            + ("; one seed has none" if few == 1 else "")
        ),
        "References behind the loads": references(["loads"]),
        "Tolerances": _tolerances(scene.as_built),
        "Lubricant of rolling bearings": f"{scene.friction.lubricant}, "
        f"{_warm(scene.friction, parts)}, {scene.friction.cleanliness}",
    }


def _at_speeds(table: xr.Dataset) -> str:
    """Design load cases with their wind speeds, in words."""
    found: dict[str, set[float]] = {}
    for dlc, speed in zip(table["dlc"].values.tolist(), table["wind_speed"].values.tolist()):
        found.setdefault(f"DLC {dlc}" if dlc else "of no design load case", set()).add(speed)
    told = {
        dlc: ", ".join(f"{speed:g}" for speed in sorted(speeds) if math.isfinite(speed))
        for dlc, speeds in found.items()
    }
    return "; ".join(f"{dlc} at {speeds} m/s" if speeds else dlc for dlc, speeds in told.items())


def _tolerances(assumed: AsBuilt) -> str:
    """How far what is built may be off where no bearing says it, in words."""
    gap = assumed.clearance
    parts = {
        "oil viscosity": (assumed.viscosity, percent(assumed.viscosity)),
        "oil temperature": (assumed.temperature, f"{assumed.temperature:g} K"),
        "roughness": (assumed.roughness, percent(assumed.roughness)),
        "alignment": (assumed.alignment, f"{1e6 * assumed.alignment:g} µrad"),
        "clearance": (gap, "half of ISO 286 grades" if gap is None else f"{1e6 * gap:g} µm"),
    }
    told = [f"{name} ± {size}" for name, (given, size) in parts.items() if given != 0]
    return ", ".join(told) or "none"


def _warm(options: Friction, parts: Collection[FurtherBearing] = ()) -> str:
    """How warm the oil of rolling bearings is, in words."""
    air, stated = (t - CELSIUS for t in (options.ambient_temperature, options.temperature))
    cooled = [f"{place} {_one(cooling)}" for place, cooling in options.cooling.items()]
    own = [part for part in parts if part.bearing not in options.cooling]
    stated_by = [one for part in own if (one := options.cooling_of(part)) is not None]
    housed = {_one(one) for one in stated_by}
    if options.conductance is not None:
        cooled.append(f"{'others ' if cooled else ''}{options.conductance:g} W/K")
    elif housed:
        cooled += [f"{'others ' if cooled else ''}{told}" for told in sorted(housed)]
    elif cooled:
        cooled.append(f"others {stated:.0f} °C as stated")
    if not cooled:
        return f"{stated:.0f} °C"
    every = (*options.cooling.values(), *stated_by)
    if options.conductance is None and all(one.temperature is not None for one in every):
        return ", ".join(cooled)
    return f"as warm as its heat balance has it, {', '.join(cooled)}; the air {air:.0f} °C"


def _one(cooling: Cooling) -> str:
    if cooling.temperature is not None:
        return f"{cooling.temperature - CELSIUS:.0f} °C as stated"
    if cooling.transfer is None:
        return f"{cooling.conductance:g} W/K"
    if cooling.area is None:
        return f"{cooling.transfer:g} W/(m² K) of each housing"
    return f"{cooling.area * cooling.transfer:g} W/K"


def _beams(scene: Scene) -> dict[str, str]:
    """Sections of each shaft that bends, in words; nothing of a rigid one."""
    told = {
        name: ", ".join(
            f"{1e3 * one.outer_diameter:.0f} mm outside, {1e3 * one.inner_diameter:.0f} mm inside"
            for one in dict.fromkeys(concept.beam.sections)
        )
        for name, concept in scene.shaft.suspensions.items()
        if concept.beam is not None
    }
    some = (f"{name.replace('_', ' ')}: {sections}" for name, sections in told.items())
    return {"Shaft that bends": "; ".join(some)} if told else {}


def drawn(scene: Scene, places: Collection[str] | None = None) -> list[dict[str, Any]]:
    """Suspensions of the shaft, or those with a bearing at `places`, with what a sketch needs."""
    return [
        {
            "name": name,
            "bearings": list(concept.bearings),
            "positions": list(concept.positions),
            "integration": concept.integration,
            "locating": concept.bearings[concept.locating],
            "masses": [[float(at), float(mass)] for at, mass in concept.masses if mass > 0],
        }
        for name, concept in scene.shaft.suspensions.items()
        if places is None or {*concept.bearings} & {*places}
    ]


def bearings(scene: Scene, rooms: Sequence[str]) -> list[dict[str, Any]]:
    """What stands at each place, in the words of scenes."""
    found = []
    if "journal" in rooms:
        for place in scene.journal.bearings:
            part = scene.journal.at(place)
            size = part.geometry
            found.append(
                {
                    "place": place,
                    "kind": f"journal, {size.shape.kind}",
                    "measures": f"D {1e3 * size.diameter:.0f} × B {1e3 * size.width:.0f} mm, "
                    f"clearance {1e3 * size.relative_clearance:.2f} ‰, "
                    f"{oil_told(part)}",
                }
            )
    if "thrust" in rooms:
        for place, one in scene.thrust.bearings.items():
            found.append({"place": place, "kind": one.words, "measures": one.measures})
    if "rolling" in rooms:
        for place, bearing in scene.rolling.geometries.items():
            found.append(
                {
                    "place": place,
                    "kind": _kind_in_words(bearing),
                    "measures": f"D_pw {1e3 * bearing.pitch_diameter:.0f} mm, "
                    f"C {bearing.rated_capacity / 1e3:.0f} kN, "
                    f"C₀ {bearing.static_capacity / 1e3:.0f} kN"
                    + (" (axial)" if bearing.rated_axially else ""),
                }
            )
    return found


def _kind_in_words(bearing: RollingBearing) -> str:
    """Kind of a rolling bearing: rollers with a contact angle are tapered."""
    words, rows = bearing.words, getattr(bearing, "rows", 1)
    if isinstance(bearing, RollerBearing):
        words = f"{bearing.catalogue_kind} {words}"
    return f"{_ROWS[rows]} {words}" if rows in _ROWS else words


_ROWS = {2: "double-row", 4: "four-row"}


_BEHIND = {
    "journal": ("journal", "film_charts", "film_heat", "supply", "shell", "mixed", "stribeck"),
    "thrust": ("thrust",),
    "rolling": ("rolling", "rings", "friction", "friction_rig"),
    "loads": ("wind", "loads", "turbines", "towers", "shaft"),
}
"""Tables of `loadflow validate` that stand behind a room."""


def references(rooms: Sequence[str]) -> str:
    """Numbers of others that the models of some rooms are held against, by what they are.

    Examples
    --------
    >>> references(["thrust"])
    '60 in closed form (thrust)'
    """
    tables = [name for room in rooms for name in _BEHIND[room]]
    known = evidence()
    total = Counter[str]()
    for name in tables:
        total.update(known[name])
    told = [f"{total[kind]} {words}" for kind, words in _HELD.items() if total[kind]]
    missed = f"; {total['missed']} of them missed" if total["missed"] else ""
    return f"{', '.join(told)}{missed} ({', '.join(tables)})"


_HELD = {
    "measured elsewhere": "measured elsewhere",
    "another code": "by another code",
    "closed form": "in closed form",
    "print of the source": "as the source prints",
}
"""Kinds of evidence that say something about the world, in words."""


def kind_of(rooms: Sequence[str]) -> str:
    """Kind of a candidate by the rooms of its bearings; a thrust bearing is no kind of its own."""
    words = {"journal": "journal", "thrust": "conical", "rolling": "rolling"}
    alone = "journal" not in rooms
    return " and ".join(words[room] for room in rooms if room != "thrust" or alone)


def _or_zero(value: float) -> float:
    return value if math.isfinite(value) else 0.0
