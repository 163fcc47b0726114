"""Scenes drawn by seed: some that limits of indicators of rings and rollers were set on, some not.

Every sized arrangement of rolling bearings, some times each: on a turbine larger or smaller than
that for which it was sized (so loads are others), in any wind, with clearances, preloads,
osculations, crowns and sections of its rings of its own.
"""

from __future__ import annotations

import copy
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from benchmarks.ladder.physics_losses import measured_losses
from benchmarks.ladder.physics_sizes import SHORT, TURBINES, Found
from loadflow.scene.candidates import candidates_of
from loadflow.scene.places import GEOMETRIES
from loadflow.scene.scene import Scene, make_scene
from loadflow.turbines import load_turbine

SEEN, HELD_OUT = (20, 21), (22,)
"""Seeds of the scenes that limits were set on, beside all others, and of those kept from that."""

WINDS = (4.0, 8.0, 12.5, 18.0, 24.5)
"""Bounds of the wind speed, m/s: each arrangement has a scene between any two that follow."""


def drawn(seeds: tuple[int, ...]) -> dict[str, Scene]:
    """Scenes by name, `len(WINDS) - 1` of each arrangement for each seed."""
    return {name: scene for seed in seeds for name, scene in _drawn(seed)}


def _drawn(seed: int) -> Iterator[tuple[str, Scene]]:
    draw = np.random.default_rng(seed)
    for calm, strong in pairwise(WINDS):
        for kind in _arrangements():
            known = str(draw.choice([one for one in TURBINES if kind in candidates_of(one)]))
            power = load_turbine(known).rated_power * draw.uniform(0.75, 1.35)
            speed = round(float(draw.uniform(calm, strong)), 1)
            keys = {
                "bearings": _changed(candidates_of(known)[kind], draw),
                "turbine": {"name": f"{known}@{power:.3g}"},
                "loads": SHORT | {"wind_speeds": [speed], "rung": "tables"},
            }
            asked = {"results": ["rolling.friction"], "accuracy": "given"}
            name = f"{kind}, {keys['turbine']['name']}, {speed:g} m/s"
            yield name, make_scene({"name": kind} | asked | keys)


def seen(known: Found) -> Found:
    """What the pilot measures of scenes that limits were set on."""
    yield from measured_losses(drawn(SEEN), known)


def held_out(known: Found) -> Found:
    """The same of those that were kept from that."""
    yield from measured_losses(drawn(HELD_OUT), known)


def _arrangements() -> list[str]:
    """Those with a rolling bearing, in the order of the packages' files."""
    every = (item for turbine in TURBINES for item in candidates_of(turbine).items())
    named = (name for name, one in every if any(map(_rolls, one.values())))
    return list(dict.fromkeys(named))


def _rolls(part: Any) -> bool:
    return isinstance(part, dict) and part.get("kind") in GEOMETRIES


def _changed(candidate: Any, draw: np.random.Generator) -> dict[str, Any]:
    """The bearings of an arrangement, each with lengths of its own."""
    found = {place: copy.deepcopy(part) for place, part in candidate.items() if _rolls(part)}
    for part in found.values():
        geometry = part["geometry"]
        preloaded = geometry.get("clearance", 0.0) < 0.0
        factors = {
            "clearance": draw.uniform(0.2, 2.5) if preloaded else draw.uniform(0.3, 1.8),
            "crown_radius": 2.0 ** draw.uniform(-1.0, 1.0),
            "groove_radius": draw.uniform(0.99, 1.02),
        }
        for name in factors.keys() & geometry.keys():
            geometry[name] *= float(factors[name])
        for ring in ("inner_ring", "outer_ring"):
            part[ring]["section"]["width"] *= float(draw.uniform(0.75, 1.3))
    return found
