"""A finite-element ring as a scene names it, before it knows the bearing whose grooves it has."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, Literal

from annotated_types import Ge, Gt, Le

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice, check_fields
from loadflow.rolling.contacts import Raceway
from loadflow.rolling.rings.finite_element import FiniteElementRing
from loadflow.rolling.rings.profile import RingProfile
from loadflow.rolling.rings.section import RingSection
from loadflow.rolling.rings.solid import SolidRing
from loadflow.rolling.rings.solid_section import FACES
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON


@dataclass(frozen=True, kw_only=True)
class MeshedRing:
    """A ring of a four-point bearing in finite elements, with the grooves of its bearing.

    Attributes
    ----------
    inside, outside : float
        Diameters, m; the grooves are cut into the side of the balls.
    bottom, top : float
        Axial limits from the middle of the bearing, m.
    held : {"bottom", "top", "back"}
        Face on an elastic bed: below, above, or opposite the raceways.
    bed, grip : float
        Stiffness of the bed across and along the face, N/m³; 1e15 is as good as clamped.
    sectors : tuple of (float, float), optional
        (centre, width) of the sectors in which the face is held, rad, in a scene from y toward z:
        the ring is then meshed all round (`SolidRing`, minutes in place of a second).
    across : int
        Elements across the ring.
    resolution : float
        Highest harmonic around a ring that is held all round, see `FiniteElementRing`.
    elastic_modulus, poisson_ratio : float
        Pa and 1.

    Raises
    ------
    InputError
        A field out of its range, a bearing without grooves for balls, or grooves that do not fit
        into the section.

    Examples
    --------
    >>> from loadflow.rolling import MeshedRing, SlewingBearing
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> ring = MeshedRing(inside=0.51, outside=0.62, bottom=-0.04, top=0.04, held="bottom")
    >>> type(ring.of(bearing, "outer")).__name__
    'FiniteElementRing'
    """

    inside: Annotated[float, Gt(0)]
    outside: Annotated[float, Gt(0)]
    bottom: float
    top: float
    held: Literal["bottom", "top", "back"]
    bed: Annotated[float, Gt(0)] = 1e15
    grip: Annotated[float, Gt(0)] = 1e15
    sectors: tuple[tuple[float, float], ...] | None = None
    across: Annotated[int, Ge(1), Le(40)] = 4
    resolution: Annotated[float, Ge(1), Le(100)] = 8.0
    elastic_modulus: Annotated[float, Gt(0)] = STEEL_MODULUS
    poisson_ratio: Annotated[float, Ge(0), Le(0.49)] = STEEL_POISSON

    kind: ClassVar[str] = "finite-element"

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "held", FACES)
        if self.outside <= self.inside:
            raise InputError(f"outside: must be > inside {self.inside:g} m, got {self.outside:g}")
        if self.top <= self.bottom:
            raise InputError(f"top: must be > bottom {self.bottom:g} m, got {self.top:g}")

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        if self.sectors is not None:
            yield "resolution", "a ring that is held in sectors is meshed all round"

    @property
    def radius(self) -> float:
        """Middle of the section from the axis, m."""
        return (self.inside + self.outside) / 4

    @property
    def section(self) -> RingSection:
        """The section without its grooves."""
        return RingSection.rectangle((self.outside - self.inside) / 2, self.top - self.bottom)

    def of(self, bearing: Any, ring: Raceway) -> FiniteElementRing | SolidRing:
        """The ring with the grooves of a bearing.

        Raises
        ------
        InputError
            A bearing without grooves for balls, or grooves that do not fit into the section.
        """
        if bearing.element != "ball":
            raise InputError(
                "a ring in finite elements has grooves for balls; a beam or a matrix stands for "
                f"the rings of a {bearing.kind} bearing"
            )
        profile = RingProfile(
            bearing=replace(bearing, clearance=0.0),  # that of the mesh, however warm it is
            ring=ring,
            inside=self.inside,
            outside=self.outside,
            bottom=self.bottom,
            top=self.top,
        )
        shared = {
            name: getattr(self, name)
            for name in ("held", "bed", "grip", "across", "elastic_modulus", "poisson_ratio")
        }
        if self.sectors is None:
            return FiniteElementRing(profile=profile, resolution=self.resolution, **shared)
        return SolidRing(profile=profile, sectors=self.sectors, **shared)
