"""What rings and slices of rollers change of rolling bearings and their friction; docs/physics.md.

All sized arrangements of rolling bearings of three turbines, each in light, rated and strong wind,
as warm as the housings that come with them leave them.
"""

from __future__ import annotations

import time
from itertools import product

from benchmarks.common import head, row
from benchmarks.ladder.physics_sizes import SHORT, TURBINES, Found
from loadflow.planning.effects import switched
from loadflow.planning.pilot import Questions, measure
from loadflow.quantities import percent
from loadflow.scene.candidates import machine
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import Scene, make_scene
from loadflow.stages.effects.roller_profile import SLICED
from loadflow.stages.effects.rolling import LOSSES, RINGS

SPEEDS = (4.0, 12.0, 24.0)
EFFECTS = (RINGS, SLICED)


def machines() -> dict[str, Scene]:
    """Scenes that ask for the friction of rolling bearings, by what carries them."""
    found = {}
    for turbine, speed in product(TURBINES, SPEEDS):
        for kind in machine(turbine)["candidates"]:
            keys = {"bearings": [kind], "turbine": {"name": turbine}, "accuracy": "given"}
            loads = SHORT | {"wind_speeds": [speed], "rung": "tables"}
            scene = make_scene(
                {"name": kind, "results": ["rolling.friction"], "loads": loads} | keys
            )
            if "rolling" in scene.model_fields_set:
                found[f"{kind}, {turbine}, {speed:g} m/s"] = scene
    return found


def losses(known: Found) -> Found:
    """What the pilot measures of them."""
    yield from measured_losses(machines(), known)


def measured_losses(scenes: dict[str, Scene], known: Found) -> Found:
    """What the pilot measures of `EFFECTS` in scenes by name."""
    done = {one["scene"] for one in known}
    for name, stated in scenes.items():
        if name in done:
            continue
        begun = time.process_time()
        scene = switched(stated, RINGS, True) or stated
        cases = tuple(list_cases(scene))
        asked = tuple(one.name for one in EFFECTS if one.concerns(scene))
        sizes = measure(Questions(scene, asked, SHORT["duration"], cases), cases[0]).sizes
        print(name, f"{time.process_time() - begun:.0f} s", flush=True)
        found = [{"name": effect, "size": dict(size)} for effect, size in sizes.items()]
        yield {"scene": name, "effects": found}


def loss_table(found: Found) -> str:
    """A row for each arrangement: the most that each effect moves, over turbines, by wind speed."""
    lines = [head("bearings", "effect", "answer", *(f"{speed:g} m/s" for speed in SPEEDS))]
    sizes: dict[tuple[str, str, str], dict[str, float]] = {}
    for one in found:
        kind, _, speed = one["scene"].split(", ")
        for effect in one["effects"]:
            for quantity in LOSSES:
                place = sizes.setdefault((kind, effect["name"], quantity), {})
                place[speed] = max(place.get(speed, 0.0), effect["size"][quantity])
    for place, by_speed in sizes.items():
        if max(by_speed.values()) >= 0.01:
            told = (percent(by_speed.get(f"{speed:g} m/s", 0.0)) for speed in SPEEDS)
            lines.append(row(*place, *told))
    return "\n".join(lines)
