"""Section, material and held face of a ring in finite elements."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
from annotated_types import Ge, Gt, Le

from loadflow.numerics.fields import check_choice, check_fields
from loadflow.rolling.contacts import Array
from loadflow.rolling.rings.beam import RingBeam
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
