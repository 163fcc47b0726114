"""Effect of the profile and the tilt of rollers: slices of a roller, or one contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from loadflow.rolling.rating.capacity import edge_stress
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.rolling import each_bearing
from loadflow.stages.effects.situation import BearingLoad, Floats, Situation

_AROUND = np.pi * (np.arange(24) + 0.5) / 24
"""Azimuths of rollers from the load, rad; both halves of a row are alike."""

_DISPLACED = np.geomspace(1e-6, 1.0, 150)
"""Displacements of a row that are tried beyond its gaps, over the diameter of its rollers: further
than any load presses that it carries."""


@dataclass(frozen=True)
class _Row:
    """A row of rollers between rigid rings.

    Attributes
    ----------
    rollers : int
        Of the row.
    stiffness : float
        Of a slice, N/m^(10/9).
    gap : ndarray, shape (slice,)
        Between slice and raceways where the row is not displaced, m; negative: preload.
    concentration : ndarray, shape (slice,)
        Of stress towards the ends.
    diameter : float
        Of a roller, m.
    """

    rollers: int
    stiffness: float
    gap: Floats
    concentration: Floats
    diameter: float

    def slices(self, push: Floats) -> Floats:
        """Forces (n, azimuth, slice), N, of the row under Σ Q cos ψ = `push` (n,), N."""
        displaced = max(float(self.gap.min()), 0.0) + _DISPLACED * self.diameter
        tried = self._forces(displaced)
        row = self.rollers * np.mean(tried.sum(axis=-1) * np.cos(_AROUND), axis=-1)
        return self._forces(np.interp(push, row, displaced))

    def _forces(self, displaced: Floats) -> Floats:
        approach = displaced[:, None, None] * np.cos(_AROUND)[:, None] - self.gap
        return np.asarray(self.stiffness * np.maximum(approach, 0.0) ** (10 / 9))

    def damage(self, slices: Floats) -> Floats:
        """Damage of a ring that turns (n,), up to a factor: that of each slice by ISO/TS 16281."""
        each = np.mean(slices**4, axis=1) ** (1 / 4) * self.concentration
        return np.asarray(np.sum(each**4.5, axis=-1) ** (8 / 9))


def _row(bearing: Any, angle: float) -> _Row:
    """A row of a bearing, or the first axial one of three."""
    one = bearing.rows[0] if isinstance(bearing.rows, tuple) else bearing
    axial = one is not bearing
    slack = 0.5 * (bearing.axial_clearance if axial else bearing.clearance * np.cos(angle))
    count = int(getattr(one, "track_rollers", one.rollers))
    gap = slack + 2.0 * one.profile_drop  # a roller touches both raceways
    # of n slices each has the capacity of the whole roller times n^(−7/9), and 1/n of its force
    concentration = edge_stress(one.slices) * one.slices ** (7 / 9)
    return _Row(count, one.slice_stiffness, gap, concentration, one.roller_diameter)


def _pushes(bearing: Any, angle: float, load: BearingLoad) -> Floats:
    """Σ Q cos ψ of the row that carries most (2, n), N: under the mean, and the largest load."""
    cos, sin = np.cos(angle), np.sin(angle)
    rows = len(bearing.rows) - 1 if isinstance(bearing.rows, tuple) else bearing.tracks
    lever = bearing.pitch_diameter * sin + getattr(bearing, "row_spacing", 0.0) * cos
    radial = load.radial + np.outer((0.0, 1.0), load.swing)
    turn = np.hypot(load.moment[:, 1], load.moment[:, 2]) + np.outer((0.0, 1.0), load.turn)
    push = np.zeros_like(radial)
    if not isinstance(bearing.rows, tuple):
        push = push + radial / (rows * cos)
    if lever > 0.0:
        push = push + 2.0 * turn / (rows * lever)
    return np.asarray(push)


def _changes(part: FurtherBearing, load: BearingLoad) -> Sizes:
    """What whole rollers change of a bearing between rigid rings under its estimated load."""
    bearing: Any = part.geometry
    angle = np.pi / 2 if isinstance(bearing.rows, tuple) else float(bearing.nominal_angle)
    sliced, whole = (_row(one, angle) for one in (bearing, bearing.with_whole_rollers()))
    push = _pushes(bearing, angle, load)
    push = push[:, (push > 0.0).all(axis=0)]
    if not push.size:
        return dict.fromkeys(QUANTITIES, 0.0)
    count, hard = sliced.gap.size, push.shape[1]
    of_slices, of_rollers = sliced.slices(push.ravel()), whole.slices(push.ravel())
    force = of_rollers.sum(axis=-1).max(axis=-1) / of_slices.sum(axis=-1).max(axis=-1)
    pressure = np.sqrt(of_rollers.max(axis=(1, 2)) / count / of_slices.max(axis=(1, 2)))
    life = sliced.damage(of_slices) / whole.damage(of_rollers)
    ratios = force[hard:], pressure[hard:], life  # largest ones are those of the largest load
    return {name: float(np.abs(ratio - 1.0).max()) for name, ratio in zip(QUANTITIES, ratios)}


QUANTITIES = ("maximum force", "maximum pressure", "life")


def _sliced(at: Situation) -> Sizes:
    """Rows of rollers with a profile against such without, under the load that each takes.

    Both by the zone that the load presses, and its preload. A profile takes load from the ends of
    a roller to its middle, and the less it is pressed the more; and it gives way to preload. Tilt
    of the rollers, and that of elastic rings, add to it.
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
    out='rolling.roller_model = "whole": each roller is one contact',
    needs='rolling.roller_model = "sliced"',
    concerns=lambda scene: any(map(_has_rollers, scene.rolling.bearings.values())),
    cost=lambda scene: SLICED_COSTS[scene.rolling.rung],
)
