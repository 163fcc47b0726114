"""A comparison in words: its conclusion, and what went in."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import xarray as xr

from loadflow.scene.scene import Scene
from loadflow.studies.compare_result import Judged
from loadflow.studies.seed_intervals import Groups
from loadflow.verdict import Verdict


def conclusion(judged: Sequence[Judged]) -> str:
    """One sentence: how many hold, which loses least, what the other kind does."""
    good = [one for one in judged if one.holds]
    count = f"{len(good)} of {len(judged)} candidates hold all limits on these loads"
    if not good:
        least = max(judged, key=lambda one: _or_zero(one.numbers["load_factor"].value))
        return (
            f"None of the {len(judged)} candidates holds all limits on these loads; nearest is "
            f"{least.title}, which breaks {_listed(least.broken) or 'none that is known'}."
        )
    best = good[0]
    text = f"{count}; of these, {_told(best)}"
    others = [one for one in good if one.kind != best.kind]
    if others:
        return f"{text}; the best {others[0].kind} bearings, {_told(others[0])}."
    other = [one for one in judged if one.kind != best.kind]
    if other:
        nearest = max(other, key=lambda one: _or_zero(one.numbers["load_factor"].value))
        what = _listed(nearest.broken) or "has parts without an answer"
        return f"{text}; no {nearest.kind} bearings hold: {nearest.title} breaks {what}."
    return f"{text}."


def _told(one: Judged) -> str:
    energy, factor = one.numbers["energy"], one.numbers["load_factor"]
    lost = (
        f"lose {energy.value:.3g} MWh a year"
        if math.isfinite(energy.value)
        else "lose no one knows what"
    )
    need = ", but need a thrust bearing of their own" if one.thrust.startswith("none") else ""
    return f"{one.title} {lost} with loads to spare by a factor of {factor.value:.3g}{need}"


def _listed(verdicts: Sequence[Verdict]) -> str:
    return ", ".join(dict.fromkeys(f"{v.quantity} ({v.subject})" for v in verdicts[:3]))


def facts(scene: Scene, runs: Sequence[Mapping[str, xr.Dataset]]) -> dict[str, str]:
    """Loads, seeds and lubricant, in words."""
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
    few = min(seeds)
    told = f"{few} … {max(seeds)}" if few != max(seeds) else f"{few}"
    return {
        "Loads": source,
        "Suspension": concepts,
        "Load cases": f"{table.sizes['case']}, {told} seeds at each wind speed",
        "Intervals": (
            "95 % by resampling the seeds of each wind speed"
            + ("; with so few seeds they are too narrow" if 1 < few < 6 else "")
            + ("; one seed has none" if few == 1 else "")
        ),
        "Lubricant of rolling bearings": f"{scene.friction.lubricant}, "
        f"{scene.friction.temperature - 273.15:.0f} °C, {scene.friction.cleanliness}",
    }


def drawn(scene: Scene) -> list[dict[str, Any]]:
    """Suspensions of the shaft, with what a sketch needs."""
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
                    f"{part.lubricant.viscosity:.3g} Pa s",
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
                    "kind": bearing.kind,
                    "measures": f"D_pw {1e3 * bearing.pitch_diameter:.0f} mm, "
                    f"C {bearing.rated_capacity / 1e3:.0f} kN, "
                    f"C₀ {bearing.static_capacity / 1e3:.0f} kN"
                    + (" (axial)" if bearing.rated_axially else ""),
                }
            )
    return found


def kind_of(rooms: Sequence[str]) -> str:
    """Kind of a candidate by the rooms of its bearings; a thrust bearing is no kind of its own."""
    words = {"journal": "journal", "thrust": "conical", "rolling": "rolling"}
    alone = "journal" not in rooms
    return " and ".join(words[room] for room in rooms if room != "thrust" or alone)


def _or_zero(value: float) -> float:
    return value if math.isfinite(value) else 0.0
