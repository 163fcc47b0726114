"""Rows of rollers between rigid rings under estimated loads: what presses on them, and preload."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from loadflow.rolling.rating.capacity import edge_stress
from loadflow.stages.effects.situation import BearingLoad, Floats

_AROUND = np.pi * (np.arange(24) + 0.5) / 24
"""Azimuths of rollers from the load, rad; both halves of a row are alike."""

_DISPLACED = np.geomspace(1e-6, 1.0, 150)
"""Displacements of a row that are tried beyond its gaps, over the diameter of its rollers: further
than any load presses that it carries."""


@dataclass(frozen=True)
class Row:
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


def row_of(bearing: Any, angle: float) -> Row:
    """A row of a bearing, or the first axial one of three."""
    one = bearing.rows[0] if isinstance(bearing.rows, tuple) else bearing
    axial = one is not bearing
    slack = 0.5 * (bearing.axial_clearance if axial else bearing.clearance * np.cos(angle))
    count = int(getattr(one, "track_rollers", one.rollers))
    gap = slack + 2.0 * one.profile_drop  # a roller touches both raceways
    # of n slices each has the capacity of the whole roller times n^(−7/9), and 1/n of its force
    concentration = edge_stress(one.slices) * one.slices ** (7 / 9)
    return Row(count, one.slice_stiffness, gap, concentration, one.roller_diameter)


def pushes(bearing: Any, angle: float, load: BearingLoad) -> Floats:
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


def relief(bearing: Any, load: BearingLoad) -> Floats:
    """Mean load of a pair of rows over that which lifts the first roller off its preload (n,).

    The sum of what pushes a row sideways over what its preload presses on all of it, and half of
    the thrust over the same along the axis, as it presses one row and relieves the other. Infinite
    without a preload.
    """
    angle = float(bearing.nominal_angle)
    row = row_of(bearing, angle)
    pressed = np.maximum(-row.gap, 0.0) ** (10 / 9)
    held = float(row.rollers * row.stiffness * pressed.sum())
    along = held * np.sin(angle)
    if along <= 0.0:
        return np.full(load.radial.shape, np.inf)
    thrust = np.abs(load.force[:, 0])
    return np.asarray(pushes(bearing, angle, load)[0] / held + 0.5 * thrust / along)
