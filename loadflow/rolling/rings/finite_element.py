"""Finite-element rings, condensed to their raceway patches; needs scikit-fem (``loadflow[fem]``).

`FiniteElementRing` meshes the section and takes the ring in Fourier harmonics; a force on a patch
is spread evenly over a square of the groove, and its displacement is the mean over the same square,
so that the compliance is symmetric. What a half-space yields under the square is taken off (see
`loadflow.rolling.rings.local_compliance`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, Any, Literal

import numpy as np
from annotated_types import Ge, Gt, Le

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice, check_fields
from loadflow.rolling.contacts import Array
from loadflow.rolling.rings.beam import RingBeam
from loadflow.rolling.rings.harmonics import (
    Patches,
    RingWave,
    SectionSystem,
    fold,
    harmonic_compliances,
)
from loadflow.rolling.rings.local_compliance import half_space, local_block, semidefinite_factor
from loadflow.rolling.rings.patches import PatchPoints
from loadflow.rolling.rings.profile import RingProfile
from loadflow.rolling.rings.section import Support
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON

FACES = ("bottom", "top", "back")


@dataclass(frozen=True, kw_only=True)
class SolidSection:
    """What finite-element rings share: section, material, and the face that holds the ring.

    Attributes
    ----------
    profile : RingProfile
        Section with its grooves.
    held : {"bottom", "top", "back"}
        Face on an elastic bed: below, above, or opposite the raceways.
    bed, grip : float
        Stiffness of the bed across and along the face, N/m³; 1e15 is as good as clamped for steel,
        a small `grip` lets the ring slide on its face.
    across : int
        Elements across the ring (quadratic); 3 to 5 suffice.
    elastic_modulus, poisson_ratio : float
        Pa and 1.
    density : float
        kg/m³; for the motion of the ring only.

    Raises
    ------
    InputError
        If a field is out of its range.
    """

    profile: RingProfile
    held: Literal["bottom", "top", "back"]
    bed: Annotated[float, Gt(0)] = 1e15
    grip: Annotated[float, Gt(0)] = 1e15
    across: Annotated[int, Ge(1), Le(40)] = 4
    elastic_modulus: Annotated[float, Gt(0)] = STEEL_MODULUS
    poisson_ratio: Annotated[float, Ge(0), Le(0.49)] = STEEL_POISSON
    density: Annotated[float, Gt(0)] = 7850.0

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "held", FACES)

    @property
    def lame(self) -> tuple[float, float]:
        """Lamé's constants λ, μ, Pa."""
        e, nu = self.elastic_modulus, self.poisson_ratio
        return e * nu / ((1 + nu) * (1 - 2 * nu)), e / (2 * (1 + nu))

    @property
    def springs(self) -> tuple[float, float, float]:
        """Stiffness of the bed in r, θ, z, N/m³."""
        if self.held == "back":
            return self.bed, self.grip, self.grip
        return self.grip, self.grip, self.bed

    def as_beam(self, harmonics: int = 32) -> RingBeam:
        """The same ring as a beam with rigid sections, on the springs of its held face."""
        section, radius, height = self.profile.section()
        inner, outer = self.profile.inside / 2, self.profile.outside / 2
        middle, place = (inner + outer) / 2, (self.profile.bottom + self.profile.top) / 2
        face = {"bottom": self.profile.bottom, "top": self.profile.top, "back": self.profile.back}
        at, radial = face[self.held], self.held == "back"
        support = Support.face(
            radius=(at + radius) / 2 if radial else middle,
            height=place if radial else (at + height) / 2,
            width=self.profile.top - self.profile.bottom if radial else outer - inner,
            depth=abs(at - (radius if radial else height)),
            bed=self.bed,
            grip=self.grip,
            radial=radial,
            elastic_modulus=self.elastic_modulus,
            poisson_ratio=self.poisson_ratio,
        )
        return RingBeam(
            section=section,
            radius=radius,
            height=height,
            supports=(support,),
            elastic_modulus=self.elastic_modulus,
            poisson_ratio=self.poisson_ratio,
            harmonics=harmonics,
        )

    def on_face(self, x: Array) -> Any:
        """Whether places (r, z, …) lie on the held face."""
        profile = self.profile
        size = profile.top - profile.bottom
        place, face = {
            "bottom": (x[1], profile.bottom),
            "top": (x[1], profile.top),
            "back": (x[0], profile.back),
        }[self.held]
        return np.abs(place - face) < 1e-9 * size


@dataclass(frozen=True, kw_only=True)
class FiniteElementRing(SolidSection):
    """A rotationally symmetric ring: finite elements over the section, harmonics around it.

    The fields of `SolidSection`, and:

    Attributes
    ----------
    resolution : float
        Highest harmonic around the ring times half the angle of a patch.
    """

    resolution: Annotated[float, Ge(1), Le(100)] = 8.0

    def flexibility(self, points: PatchPoints) -> Array:
        """Factor Q, (kind, ball, 3, mode), of C = Q Qᵀ; see `RingBeam.flexibility`.

        Raises
        ------
        InputError
            If a patch is not on the raceway side of the section, or balls are not equally spaced.
        ImportError
            Without scikit-fem.
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
