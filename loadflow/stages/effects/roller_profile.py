"""Effect of the profile and the tilt of rollers: slices of a roller, or one contact."""

from __future__ import annotations

from typing import Any

import numpy as np

from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.roller_rows import pushes, row_of
from loadflow.stages.effects.rolling import each_bearing
from loadflow.stages.effects.situation import BearingLoad, Situation


def _changes(part: FurtherBearing, load: BearingLoad) -> Sizes:
    """What whole rollers change of a bearing between rigid rings under its estimated load."""
    bearing: Any = part.geometry
    angle = np.pi / 2 if isinstance(bearing.rows, tuple) else float(bearing.nominal_angle)
    sliced, whole = (row_of(one, angle) for one in (bearing, bearing.with_whole_rollers()))
    push = pushes(bearing, angle, load)
    push = push[:, (push > 0.0).all(axis=0)]
    if not push.size:
        return dict.fromkeys(QUANTITIES, 0.0)
    count, hard = sliced.gap.size, push.shape[1]
    of_slices, of_rollers = sliced.slices(push.ravel()), whole.slices(push.ravel())
    force = of_rollers.sum(axis=-1).max(axis=-1) / of_slices.sum(axis=-1).max(axis=-1)
    pressure = np.sqrt(of_rollers.max(axis=(1, 2)) / count / of_slices.max(axis=(1, 2)))
    life = sliced.damage(of_slices) / whole.damage(of_rollers)
    ratios = force[hard:], pressure[hard:], life  # largest ones are those of the largest load
    sizes = {name: float(np.abs(ratio - 1.0).max()) for name, ratio in zip(CONTACTS, ratios)}
    least = EVEN_SO if np.any(bearing.profile_drop) else {}
    sizes = {name: max(size, least.get(name, 0.0)) for name, size in sizes.items()}
    return sizes | (TAPERED_LOSSES if bearing.rib_guided else OTHER_LOSSES)


TAPERED_LOSSES = {"friction power": 0.6, "film parameter": 0.25, "slip": 0.37}
OTHER_LOSSES = {"friction power": 0.08, "film parameter": 0.015, "slip": 0.07}
"""What whole rollers change of friction, of pairs of tapered rows that are preloaded and of others;
of a slip, a share itself, the difference. The first is more than the most between elastic rings in
57 machines and wind speeds, 22, 8 and 28 % (docs/physics.md): between rigid rings the quick look
has 34 % of the power. Without the drop of their profile all rollers of preloaded rows stay pressed,
roll along and hardly slip."""

EVEN_SO = {"maximum force": 0.01, "life": 0.55}
"""What whole rollers are taken to change at least of rows with a profile. Two ways in which it
acts, to its middle and from preload, may cancel in the estimate but not in the bearing: where less
was indicated, drawn machines lost up to 5.4 % of the force and 3.7 times the life
(docs/physics.md), which these times `larger` of the effect cover."""

CONTACTS = ("maximum force", "maximum pressure", "life")
QUANTITIES = (*CONTACTS, *OTHER_LOSSES)


def _sliced(at: Situation) -> Sizes:
    """Rows of rollers with a profile against such without, under the load that each takes.

    Both by the zone that the load presses, and its preload. A profile takes load from the ends of
    a roller to its middle, and the less it is pressed the more; and it gives way to preload. Tilt
    of the rollers, and that of elastic rings, add to it. Friction is that of the table above.
    """
    found = [
        _changes(part, at.bearings[name])
        for name, part in at.scene.rolling.bearings.items()
        if _has_rollers(part)
    ]
    return {name: max((one[name] for one in found), default=0.0) for name in QUANTITIES}


def _has_rollers(part: FurtherBearing) -> bool:
    return part.geometry.element == "roller"


def _with_sliced_rollers(scene: Scene, on: bool) -> Scene | None:
    """Switch all bearings that have rollers between rollers in slices and whole ones."""
    return each_bearing(
        scene,
        "roller_model",
        lambda part: "whole" if not on and _has_rollers(part) else "sliced",
    )


SLICED_COSTS = {"rigid": 15.0, "flexible": 2.3}
"""Time of the equilibrium with rollers in 30 slices over that with whole ones, same bearing."""

SLICED = Effect(
    "profile and tilt of the rollers",
    model="rolling",
    keys=("rolling.roller_model",),
    is_on=lambda scene: any(
        _has_rollers(part) and part.roller_model == "sliced"
        for part in scene.rolling.bearings.values()
    ),
    switched=_with_sliced_rollers,
    indicator=_sliced,
    smaller=15.0,  # 10 of the life of a bearing whose load hardly exceeds its preload
    either_way=("maximum force", *OTHER_LOSSES),
    larger=lambda scene: 7.0,  # 5.4 of the largest force, 6.8 of the life of drawn machines
    out='rolling.roller_model = "whole": each roller is one contact',
    needs='rolling.roller_model = "sliced"',
    concerns=lambda scene: any(map(_has_rollers, scene.rolling.bearings.values())),
    cost=lambda scene: SLICED_COSTS[scene.rolling.rung],
)
