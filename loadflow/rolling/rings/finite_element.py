"""Finite-element rings, condensed to their raceway patches, by scikit-fem.

`FiniteElementRing` meshes the section and takes the ring in Fourier harmonics; a force on a patch
is spread evenly over a square of the groove, and its displacement is the mean over the same square,
so that the compliance is symmetric. What a half-space yields under the square is taken off (see
`loadflow.rolling.rings.local_compliance`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
from annotated_types import Ge, Le

from loadflow.errors import InputError
from loadflow.rolling.contacts import Array
from loadflow.rolling.rings.harmonics import (
    Patches,
    RingWave,
    SectionSystem,
    fold,
    harmonic_compliances,
)
from loadflow.rolling.rings.local_compliance import half_space, local_block, semidefinite_factor
from loadflow.rolling.rings.patches import PatchPoints
from loadflow.rolling.rings.solid_section import SolidSection


@dataclass(frozen=True, kw_only=True)
class FiniteElementRing(SolidSection):
    """A rotationally symmetric ring: finite elements over the section, harmonics around it.

    The fields of `SolidSection`, and:

    Attributes
    ----------
    resolution : float
        Highest harmonic around the ring times half the angle of a patch.

    Examples
    --------
    >>> from loadflow.rolling import FiniteElementRing, RingProfile, SlewingBearing
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> profile = RingProfile(bearing=bearing, ring="outer", inside=0.51, outside=0.62,
    ...     bottom=-0.04, top=0.04)
    >>> ring = FiniteElementRing(profile=profile, held="bottom")
    >>> beam = ring.as_beam()
    >>> round(beam.radius, 3)
    0.285
    """

    resolution: Annotated[float, Ge(1), Le(100)] = 8.0

    def flexibility(self, points: PatchPoints) -> Array:
        """Factor Q, (kind, ball, 3, mode), of C = Q Qᵀ; see `RingBeam.flexibility`.

        Raises
        ------
        InputError
            If a patch is not on the raceway side of the section, or balls are not equally spaced.
        """
        kinds, balls = len(points.radius), len(points.azimuth)
        waves = self.waves(SectionSystem(self), points)
        columns = [
            w.factor.reshape(kinds, 1, 3, -1) * w.values(balls)[None, :, :, None] for w in waves
        ]
        return np.concatenate(columns, axis=-1).reshape(kinds, balls, 3, -1)

    def waves(self, system: SectionSystem, points: PatchPoints) -> list[RingWave]:
        """All waves that equally spaced balls tell apart; see `flexibility`."""
        from scipy.linalg import block_diag

        balls = len(points.azimuth)
        turn = np.exp(1j * (points.azimuth - points.azimuth[0]))
        if np.abs(turn - np.exp(2j * np.pi * np.arange(balls) / balls)).max() > 1e-9:
            raise InputError("points: balls must be equally spaced around a FiniteElementRing")
        patches = Patches.on(system, points)
        compliance = self._harmonics(system, patches, float(points.radius.mean()))
        side = patches.length
        half = half_space(side, side, self.elastic_modulus, self.poisson_ratio)
        local = block_diag(*(local_block(normal, half) for normal in patches.normals))
        waves = []
        for m, share, folded in fold(compliance, balls):
            matrix = folded - share * local
            for family in (0, 1):
                wave = RingWave(m, family, patches.loads, matrix)
                seen = wave.components(balls)  # where the wave vanishes at all balls, nothing moves
                factor = np.zeros((len(matrix), int(seen.sum())))
                part = semidefinite_factor(matrix[np.ix_(seen, seen)])
                factor[seen, : part.shape[1]] = part
                waves.append(replace(wave, factor=factor[:, : part.shape[1]]))
        return waves

    def _harmonics(self, system: SectionSystem, patches: Patches, radius: float) -> Array:
        """Displacement of square patches under unit loads spread over them, (n, 3 kind, 3 kind)."""
        width = patches.length / radius
        highest = math.ceil(self.resolution * 2 / width)
        compliance = harmonic_compliances(system, patches, highest)
        n = np.arange(highest + 1)
        spread = np.sinc(n * width / (2 * np.pi)) ** 2
        compliance *= (spread / np.where(n == 0, 2 * math.pi, math.pi))[:, None, None]
        return compliance
