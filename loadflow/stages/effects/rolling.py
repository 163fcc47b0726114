"""Effects of rolling bearings."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from loadflow.data import ladder
from loadflow.rolling import RingBeam, RingSection
from loadflow.rolling.rating.static import static_overload
from loadflow.scene.bearings import FurtherBearing, Rolling
from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import UNSURE, Effect, Sizes
from loadflow.stages.effects.roller_rows import relief
from loadflow.stages.effects.situation import Situation
from loadflow.stages.rolling_at_work import overloaded_words
from loadflow.stages.stage import with_settings

STEEL_DENSITY = 7850.0  # kg/m³
SECTION_SIDE = 2.4
"""Width of a ring's section over the diameter of its elements, where none is stated."""

ROLLER_SIZES = {"maximum force": 0.21, "maximum pressure": 0.065, "life": 0.28}
"""What free rings change of the tapered bearing of `pipelines/dlc_1_1.toml` (docs/rings.md); of the
pressure more, as sized pairs that walls hold lose up to 0.077 (docs/physics.md)."""

LOSSES = {"friction power": 0.2, "film parameter": 0.15, "slip": 0.2}
"""What free rings change of friction: preloaded pairs under load, and others, by 113 machines,
loads and wind speeds (docs/physics.md), within `larger` of the effect. Of a slip as it is."""

PRELOADED = {
    "maximum force": 0.6,
    "maximum pressure": 0.15,
    "life": 0.6,
    "friction power": 0.7,
    "film parameter": 0.25,
    "slip": 0.6,
}
"""What they change besides of a pair of rows that preload alone presses: between rigid rings all of
its rollers bear, and roll along; elastic ones give way, and one row is left to slip. Pairs whose
preload, clearance and rings were drawn lose up to 1.03 of the force and 0.94 of the life."""

PRESSED = 3e-4
"""Approach of a roller over its diameter that its stiffness is taken at, of about 1 GPa."""


def _ring_compliance(part: FurtherBearing) -> float:
    """R⁴ k/(E I), with the contacts' stiffness k of each metre around: rings against contacts.

    Both rings in a row, of the sections stated or of squares with sides of `SECTION_SIDE` elements.
    """
    bearing: Any = part.geometry
    balls = bearing.element == "ball"
    diameter = float(bearing.ball_diameter if balls else getattr(bearing, "roller_diameter", 0.1))
    count = float(bearing.balls if balls else getattr(bearing, "rollers", 60))
    pitch = float(getattr(bearing, "pitch_diameter", 2.0))
    side = SECTION_SIDE * diameter
    square = side**4 / 12
    inertias = [
        ring.section.inertia_axial if ring is not None and ring.section is not None else square
        for ring in (part.inner_ring, part.outer_ring)
    ]
    around = count / (np.pi * pitch) * diameter**0.5
    return float((pitch / 2) ** 4 * around * sum(1 / inertia for inertia in inertias))


def _roller_share(part: FurtherBearing) -> float:
    """Share of the approach that free rings take which bend to ovals, against rollers.

    Each ring yields as R⁴/(9 E I); a section that is not stated is as wide as `SECTION_SIDE`
    rollers and as high beyond the outer rows. Where one ring is stated, the other is rigid.
    """
    bearing: Any = part.geometry
    slope = bearing.slice_stiffness * bearing.slices
    slope *= 10 / 9 * (PRESSED * bearing.roller_diameter) ** (1 / 9)
    radius = bearing.pitch_diameter / 2
    contact = bearing.rows * bearing.rollers * slope / (2 * np.pi * radius)
    side = SECTION_SIDE * bearing.roller_diameter
    high = side + (bearing.rows - 1) * bearing.row_spacing
    assumed = RingBeam(section=RingSection.rectangle(side, high), radius=radius)
    given = [ring for ring in (part.inner_ring, part.outer_ring) if ring is not None]
    stated = [assumed if ring.section is None else ring for ring in given]
    yielding = sum(
        contact * ring.radius**4 / (9 * ring.elastic_modulus * ring.section.inertia_axial)
        for ring in stated or [assumed, assumed]
    )
    return float(yielding / (1 + yielding))


def _of_balls(parts: list[FurtherBearing]) -> Sizes:
    """Ring bending against contact approach, from the bearing of the ladder.

    Its rigid rings were measured against its flexible ones (docs/speed-vs-error.md). The share of
    the approach that the rings take is s/(1 + s), with s over that of the ladder's bearing.
    """
    known = ladder()["rolling"]["rigid"]["errors"]
    share = max((_ring_compliance(part) for part in parts), default=0.0)
    share /= _ring_compliance(Rolling())
    factor = 2.0 * share / (1.0 + share)
    return {name: factor * known[name]["max"] for name in (*ROLLER_SIZES, *LOSSES)}


def _rings(at: Situation) -> Sizes:
    """Rings against contacts: of rollers from the bearing of the main job, of others the ladder's.

    Rollers: `ROLLER_SIZES` and `LOSSES` times the share of the approach that the rings take; of a
    pair of rows also `PRELOADED`, as far as its mean load is short of what lifts rollers off.
    Calibrated on all of docs/physics.md but the scenes that are held out there.
    """
    parts = at.scene.rolling.bearings
    rollers = {
        name: part for name, part in parts.items() if part.geometry.friction_model == "rollers"
    }
    found = [_of_balls([part for name, part in parts.items() if name not in rollers])]
    for name, part in rollers.items():
        share, held = _roller_share(part), _held(at, name)
        sizes = (ROLLER_SIZES | LOSSES).items()
        found.append({what: share * (size + held * PRELOADED[what]) for what, size in sizes})
    return {what: max(one[what] for one in found) for what in found[0]}


def _held(at: Situation, name: str) -> float:
    """How far the mean load of a pair of tapered rows is short of what lifts rollers off, most.

    1 of preload alone; 0 where some rollers lift, or without a preload.
    """
    bearing: Any = at.scene.rolling.bearings[name].geometry
    if not bearing.rib_guided or not at.turns.any():
        return 0.0
    loaded = relief(bearing, at.bearings[name])[at.turns]
    return float(np.maximum(1.0 - loaded, 0.0).max())


def _rings_at_most(scene: Scene) -> float:
    """1.25 where all rings lie under two rows of tapered rollers and are held at a face.

    The indicator is that of free rings. Walls took it from 21 % of the largest force to 13 % and
    less, and from 28 % of the life to 5 %; short rings, which tilt, lost more, and so did spherical
    rollers (docs/rings.md). In a stop (DLC 4.2) held ones lost 15 % of the force, 1.16 times what
    is indicated (docs/physics.md).
    """
    return 1.25 if all(map(_is_firm, scene.rolling.bearings.values())) else UNSURE


def _is_firm(part: FurtherBearing) -> bool:
    bearing: Any = part.geometry
    tapered = bearing.kind == "roller" and bearing.rows == 2
    if not (tapered and part.inner_ring and part.outer_ring):
        return False
    rows = bearing.row_spacing + bearing.roller_length * np.cos(bearing.nominal_angle)
    return all(
        isinstance(ring, RingBeam)
        and bool(ring.supports)
        and ring.section is not None
        and np.sqrt(12 * ring.section.inertia_radial / ring.section.area) >= rows
        for ring in (part.inner_ring, part.outer_ring)
    )


def each_bearing(scene: Scene, key: str, settings: Callable[[FurtherBearing], Any]) -> Scene | None:
    """The scene with a key of each of its rolling bearings set."""
    rolling = scene.rolling
    changed: dict[str, Any] = {key: settings(rolling)}
    if rolling.further:
        changed["further"] = [
            part.model_dump(exclude_unset=True) | {key: settings(part)} for part in rolling.further
        ]
    return with_settings(scene, "rolling", changed)


def _with_flexible_rings(scene: Scene, on: bool) -> Scene | None:
    """Switch the rings of all bearings that have sections of theirs."""

    def able(part: FurtherBearing) -> bool:
        return part.geometry.flexible_rings and bool(part.inner_ring or part.outer_ring)

    if on and not any(map(able, scene.rolling.bearings.values())):
        return None
    return each_bearing(scene, "rings", lambda part: "flexible" if on and able(part) else "rigid")


RINGS = Effect(
    "elastic rings",
    model="rolling",
    keys=("rolling.rings",),
    is_on=lambda scene: scene.rolling.rung == "flexible",
    switched=_with_flexible_rings,
    indicator=_rings,
    larger=_rings_at_most,
    smaller=30.0,  # 28 of the pressure of a preloaded pair
    either_way=("life", *LOSSES),
    out='rolling.rings = "rigid"',
    needs=(
        "rolling.inner_ring and rolling.outer_ring, which bearings sized for the turbine bring "
        "along; rings of ball, crossed and three-row bearings are rigid here"
    ),
)


def overloaded(at: Situation) -> list[str]:
    """Say which rolling bearings the estimated loads overload, and by which factor."""
    found = []
    for name, part in at.scene.rolling.bearings.items():
        load = at.bearings[name]
        over = static_overload(
            part.geometry,
            load.radial + load.swing,
            np.abs(load.force[:, 0]) + load.surge,
            np.hypot(load.moment[:, 1], load.moment[:, 2]) + load.turn,
        )
        if (most := float(over.max())) > 1:
            found.append(overloaded_words(f"rolling bearing {name}", most))
    return found


def _centrifugal(at: Situation) -> Sizes:
    """Centrifugal force m r (ω/2)² of an element against its mean share of the load."""
    found = 0.0
    for name, part in at.scene.rolling.bearings.items():
        bearing: Any = part.geometry
        load = at.bearings[name]
        if bearing.element != "ball" or part.oscillation is not None:
            continue
        mass = STEEL_DENSITY * np.pi / 6 * bearing.ball_diameter**3
        force = mass * bearing.pitch_diameter / 2 * (at.speed / 2) ** 2
        mean = np.hypot(load.radial, abs(load.force[:, 0])) + 2 * load.turn / bearing.pitch_diameter
        share = force * bearing.balls / np.maximum(mean, 1.0)
        found = max(found, float(np.max(share)))
    return {
        "maximum force": found,
        "maximum pressure": found / 3,
        "life": 3 * found,
        "friction power": found,
    }


INERTIA_COSTS = 1000.0
"""Time of the equilibrium with the inertia of the balls over that without, same bearing."""


def _with_inertia(scene: Scene, on: bool) -> Scene | None:
    """Switch the inertia of the balls of all bearings that can have it counted."""
    able = [part.bearing for part in scene.rolling.bearings.values() if part.can_have_inertia]
    if on and not able:
        return None
    return each_bearing(scene, "inertia", lambda part: on and part.bearing in able)


CENTRIFUGAL = Effect(
    "inertia of the balls",
    model="rolling",
    keys=("rolling.inertia",),
    is_on=lambda scene: any(part.inertia for part in scene.rolling.bearings.values()),
    switched=_with_inertia,
    indicator=_centrifugal,
    out="centrifugal force and gyroscopic moment of the balls",
    needs="rolling.inertia = true; balls of one diagonal between rigid rings",
    concerns=lambda scene: any(
        part.geometry.element == "ball" for part in scene.rolling.bearings.values()
    ),
    cost=lambda scene: INERTIA_COSTS,
)
