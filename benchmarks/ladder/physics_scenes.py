"""The scenes on which the sizes of effects are measured, and the state in which they were."""

from __future__ import annotations

import hashlib
import json
import tomllib
from collections.abc import Callable, Mapping
from functools import cache, partial
from importlib import resources
from typing import Any

from benchmarks.common import ROOT
from benchmarks.ladder import physics_sizes as parts
from benchmarks.ladder.physics_drawn import HELD_OUT, SEEN, drawn
from benchmarks.ladder.physics_losses import machines
from benchmarks.ladder.physics_sizes import SHORT, STOP, TURBINES, scene_of
from benchmarks.ladder.whole_runs import whole_runs
from loadflow.scene.scene import Scene, read_scene


def ten_scenes() -> dict[str, Scene]:
    """Power production, start, stop, parked; small and large turbine; stiff and soft housing.

    Shells align themselves, as those of the main job and the sized ones are built to. In shells
    that stay, wide bearings near each other would touch at their ends.
    """
    production = {"wind_speeds": [12.0]} | SHORT
    small, usual, large = TURBINES
    built = {"self_aligning": True}
    running = {"loads": production, "film": built}
    still = {"results": ["loads.statistics", "rolling.loads"], "film": built}
    parked = {"dlc": "6.1"} | SHORT
    stop = tomllib.loads(STOP.read_text(encoding="utf-8"))["bearings"]["N"]
    touching = {key: stop[key] for key in ("contact", "shell")}
    events = {"results": ["journal.film"], "film": built | touching}
    soft = built | {"shell": {"kind": "local", "compliance": 1e-11}}
    return {
        "power production, 1.5 MW": scene_of(small, **running),
        "power production, 5 MW": scene_of(usual, **running),
        "power production, 15 MW": scene_of(large, **running),
        "20 % asked for, 5 MW": scene_of(usual, accuracy=0.2, **running),
        "stiff housing, sized bearings, 5 MW": scene_of(usual, sized=True, **running),
        "soft housing (10 µm/MPa), 5 MW": scene_of(usual, loads=production, film=soft),
        "start, 5 MW": scene_of(usual, loads={"dlc": "3.1", "wind_speeds": [4.0]}, **events),
        "stop, 5 MW": scene_of(usual, loads={"dlc": "4.1", "wind_speeds": [24.0]}, **events),
        "parked, 5 MW": scene_of(usual, loads=parked, **still),
        "parked, 15 MW": scene_of(large, loads=parked, **still),
    }


JOBS = ("quick_look", "dlc_1_1", "dlc_3_1_startup", "dlc_4_2_shutdown", "dlc_6_4_idling")
"""Pipelines whose pilots are measured beside the ten scenes, with all their effects."""


def jobs_asked() -> dict[str, Scene]:
    """The pipelines of `JOBS`, as they are."""
    return {name: read_scene(ROOT / "pipelines" / f"{name}.toml") for name in JOBS}


PER_PLACE = {
    "sizes": parts.at_work,
    "elements": parts.on_rollers,
    "films": parts.touching,
    "oil": parts.grooved,
    "clearances": parts.in_clearances,
    "lateral": parts.realised,
}
"""Scene of a part of the measurements, of a turbine and a wind speed; of effects of the plan."""

AT = PER_PLACE | {"rotors": parts.in_one_wind}
"""The same of what no plan leaves out, too."""


def seated(turbine: str, speed: float) -> dict[str, Scene]:
    """Scenes of the part ``fed_back``, by suspension."""
    return {name: parts.on_seat(turbine, speed, seat) for name, seat in parts.SEATS.items()}


BY_NAME: dict[str, tuple[str, Callable[[], dict[str, Scene]]]] = {
    "scenes": ("scene", ten_scenes),
    "jobs": ("scene", jobs_asked),
    "losses": ("scene", machines),
    "drawn": ("scene", partial(drawn, SEEN)),
    "held_out": ("scene", partial(drawn, HELD_OUT)),
    "runs": ("run", whole_runs),
}
"""Key under which a finding of a part names its scene, and all scenes of that part."""


def scenes_of(part: str, found: Mapping[str, Any]) -> list[Scene]:
    """Scenes on which a part has found something."""
    if part in BY_NAME:
        return [one for name, one in _named(part).items() if name == found[BY_NAME[part][0]]]
    place = found["turbine"], found["speed"]
    return [*seated(*place).values()] if part == "fed_back" else [AT[part](*place)]


@cache
def _named(part: str) -> dict[str, Scene]:
    return BY_NAME[part][1]()


def rests_on(part: str, found: Mapping[str, Any]) -> str:
    """Digest of all that the scenes of a finding state, machines, and of their turbines.

    Defaults are left out, so that a new key leaves what was measured without it; so is the code.
    """
    told = [
        (one.model_dump(mode="json", exclude_unset=True), _turbine(one.turbine.name))
        for one in scenes_of(part, found)
    ]
    return hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()[:16]


def _turbine(name: str) -> Any:
    """What the file of a turbine of the package states, also of one that is scaled."""
    file = resources.files("loadflow.turbines") / f"{name.partition('@')[0]}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))
