"""A comparison in words: its conclusion, and what went in."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import xarray as xr

from loadflow.data import evidence
from loadflow.quantities import CELSIUS
from loadflow.scene.places import WRITTEN
from loadflow.scene.scene import Scene
from loadflow.studies.compare_quantities import QUANTITIES
from loadflow.studies.compare_result import Judged
from loadflow.studies.seed_intervals import Groups
from loadflow.verdict import Verdict


def conclusion(judged: Sequence[Judged]) -> str:
    """How many hold, which loses least, what the other kind does; which risks speak against both.

    The second sentence is missing where no rule of practice is broken.
    """
    text, good = _sentence(judged), [one for one in judged if one.holds]
    shown = [good[0], *[one for one in good if one.kind != good[0].kind][:1]] if good else []
    risks = [f"{one.title} ({told})" for one in shown if (told := _risks(one))]
    if not risks:
        return text
    broken = " and ".join(risks)
    return f"{text} Rules of practice, which a rating life does not count, are broken by {broken}."


def _risks(one: Judged) -> str:
    """Rules of thumb that a candidate breaks, which no verdict counts."""
    rules = ((about, one.numbers.get(key)) for key, about in QUANTITIES.items() if about.rule)
    return "; ".join(
        f"{about.name} {number.value:.3g} {number.unit}".removesuffix(" –")
        + f", limit {'≤' if about.at_most else '≥'} {number.limit:.3g} {number.unit}".removesuffix(
            " –"
        )
        for about, number in rules
        if number is not None and number.holds is False
    )


def _sentence(judged: Sequence[Judged]) -> str:
    good = [one for one in judged if one.holds]
    if not good:
        least = max(judged, key=lambda one: _or_zero(one.numbers["load_factor"].value))
        return (
            f"None of the {len(judged)} candidates holds all limits on these loads; nearest are "
            f"{_named(least)}, which break {_listed(least.broken) or 'none that is known'}."
        )
    best = good[0]
    hold = "holds" if len(good) == 1 else "hold"
    least_of = "these, " if len(good) == 1 else "of these, "
    text = (
        f"{len(good)} of {len(judged)} candidates {hold} all limits on these loads; {least_of}"
        f"{_told(best, least=len(good) > 1)}"
    )
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
    energy, factor = one.numbers["energy"], one.numbers["load_factor"]
    if not math.isfinite(energy.value):
        lost = "lose no one knows what,"
    elif least:
        lost = f"lose least, {energy.value:.3g} MWh a year,"
    else:
        lost = f"lose {energy.value:.3g} MWh a year,"
    need = ", but need a thrust bearing of their own" if one.thrust.startswith("none") else ""
    return f"{_named(one)} {lost} with loads to spare by a factor of {factor.value:.3g}{need}"


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
        "References behind the loads": references(["loads"]),
        "Lubricant of rolling bearings": f"{scene.friction.lubricant}, "
        f"{scene.friction.temperature - CELSIUS:.0f} °C, {scene.friction.cleanliness}",
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
                    "kind": WRITTEN.get(bearing.kind, bearing.kind),
                    "measures": f"D_pw {1e3 * bearing.pitch_diameter:.0f} mm, "
                    f"C {bearing.rated_capacity / 1e3:.0f} kN, "
                    f"C₀ {bearing.static_capacity / 1e3:.0f} kN"
                    + (" (axial)" if bearing.rated_axially else ""),
                }
            )
    return found


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
