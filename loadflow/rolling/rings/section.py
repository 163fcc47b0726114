"""Cross sections of bearing rings, and what holds a ring in place."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from annotated_types import Ge, Gt, Le

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON

LARGEST = 1e3
"""Longest side or radius of a ring, m, whose powers are numbers still."""


@dataclass(frozen=True, kw_only=True)
class RingSection:
    """Section of a ring by its constants about axes through its centroid.

    ρ is the radial, ζ the axial distance from the centroid.

    Attributes
    ----------
    area : float
        A, m².
    inertia_axial : float
        ∫ρ² dA, second moment about the axial direction (bending within the plane of the ring), m⁴.
    inertia_radial : float
        ∫ζ² dA, second moment about the radial direction (bending out of the plane; twist of the
        section stretches the ring against it), m⁴.
    inertia_product : float
        ∫ρζ dA, m⁴.
    torsion : float
        St. Venant torsion constant J, m⁴.
    shear_factor : float
        Share of the area that carries shear; 5/6 for a rectangle.

    Raises
    ------
    InputError
        If a constant is out of its range or no section can have these moments.

    Examples
    --------
    >>> from loadflow.rolling import RingSection
    >>> section = RingSection.rectangle(width=0.1, height=0.12)
    >>> round(section.area, 4), section.inertia_product
    (0.012, 0.0)
    """

    area: Annotated[float, Gt(0)]
    inertia_axial: Annotated[float, Gt(0)]
    inertia_radial: Annotated[float, Gt(0)]
    torsion: Annotated[float, Gt(0)]
    inertia_product: float = 0.0
    shear_factor: Annotated[float, Gt(0), Le(1)] = 5 / 6

    def __post_init__(self) -> None:
        check_fields(self)
        if (
            not self.inertia_product * self.inertia_product
            < self.inertia_axial * self.inertia_radial
        ):
            raise InputError(
                f"inertia_product: its square must be < inertia_axial · inertia_radial, "
                f"got {self.inertia_product:g}"
            )

    @classmethod
    def rectangle(cls, width: float, height: float) -> RingSection:
        """Section `width` (radial) by `height` (axial), m.

        Raises
        ------
        InputError
            If a side is not positive, or longer than `LARGEST`.
        """
        for name, side in (("width", width), ("height", height)):
            if not 0 < side <= LARGEST:
                raise InputError(f"{name}: must be > 0 and at most {LARGEST:g} m, got {side!r}")
        short, long = sorted((width, height))
        ratio = short / long
        # series of St. Venant's solution; its terms fall as 1/n⁵
        series = sum(math.tanh(n * math.pi / (2 * ratio)) / n**5 for n in range(1, 12, 2))
        torsion = long * short**3 / 3 * (1 - 192 / math.pi**5 * ratio * series)
        return cls(
            area=width * height,
            inertia_axial=height * width**3 / 12,
            inertia_radial=width * height**3 / 12,
            torsion=torsion,
        )


@dataclass(frozen=True, kw_only=True)
class Support:
    """Elastic foundation of a ring: bolted flange, legs, sectors.

    Springs per length of their own circle act at one point of the section, all round or within
    sectors.

    Attributes
    ----------
    radial, tangential, axial : float
        Stiffness per length of arc, N/m².
    tilt : float
        Stiffness against rotation of the section about the tangent, N m/rad per m of arc.
    radius, height : float
        Where the springs act, m.
    sectors : tuple of (float, float), optional
        (centre, width) of each supported sector, rad; all round if None.

    Raises
    ------
    InputError
        If a stiffness is negative, or a sector has no width or more than a full turn.

    Examples
    --------
    >>> from loadflow.rolling import Support
    >>> wall = Support.wall(radius=0.5, height=0.06, thickness=0.03, length=0.3)
    >>> wall.sectors is None, wall.axial > wall.radial
    (True, True)
    """

    radius: Annotated[float, Gt(0)]
    height: float = 0.0
    radial: Annotated[float, Ge(0)] = 0.0
    tangential: Annotated[float, Ge(0)] = 0.0
    axial: Annotated[float, Ge(0)] = 0.0
    tilt: Annotated[float, Ge(0)] = 0.0
    sectors: tuple[tuple[float, float], ...] | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        for centre, width in self.sectors or ():
            if not (math.isfinite(centre) and 0 < width <= 2 * math.pi):
                raise InputError(f"sectors: widths must be in (0, 2π], got {(centre, width)}")
        if self.sectors == ():
            raise InputError("sectors: must name at least one sector, or be None for all round")

    @property
    def springs(self) -> Support:
        """Itself: of other supports the springs that they are."""
        return self

    @classmethod
    def wall(
        cls,
        radius: float,
        height: float,
        thickness: float,
        length: float,
        elastic_modulus: float = STEEL_MODULUS,
        poisson_ratio: float = STEEL_POISSON,
    ) -> Support:
        """Cylindrical wall that a ring stands on, built in at its far end.

        Radially and against tilt as the edge of a long thin shell (2 D β³ and 2 D β, with
        β⁴ = 3 (1 - ν²)/(R t)²; their coupling is left out), axially E t/L and tangentially G t/L.

        Parameters
        ----------
        radius, height : float
            Middle of the wall, and its upper or lower edge where the ring stands, m.
        thickness, length : float
            Of the wall, m.
        elastic_modulus, poisson_ratio : float
            Pa and 1.

        Raises
        ------
        InputError
            If radius, thickness or length is not positive, or longer than `LARGEST`.
        """
        for name, size in (("radius", radius), ("thickness", thickness), ("length", length)):
            if not 0 < size <= LARGEST:
                raise InputError(f"{name}: must be > 0 and at most {LARGEST:g} m, got {size!r}")
        bending = elastic_modulus * thickness**3 / (12 * (1 - poisson_ratio**2))
        beta = (3 * (1 - poisson_ratio**2)) ** 0.25 / math.sqrt(radius * thickness)
        return cls(
            radius=radius,
            height=height,
            radial=2 * bending * beta**3,
            tangential=elastic_modulus / (2 * (1 + poisson_ratio)) * thickness / length,
            axial=elastic_modulus * thickness / length,
            tilt=2 * bending * beta,
        )

    @classmethod
    def face(
        cls,
        radius: float,
        height: float,
        width: float,
        depth: float,
        *,
        bed: float = 1e15,
        grip: float = 1e15,
        radial: bool = False,
        elastic_modulus: float = STEEL_MODULUS,
        poisson_ratio: float = STEEL_POISSON,
    ) -> Support:
        """Flat face that holds a ring, and what the section yields between face and centroid.

        A beam's section is rigid; the real one is pressed together (E/(1 - ν²) w/h), sheared
        (5/6 G w/h) and bent (E/(1 - ν²) w³/12 h) over the depth h to its centroid. These springs
        stand in series with the bed and act at half that depth.

        Parameters
        ----------
        radius, height : float
            Middle of that part of the section, m.
        width, depth : float
            Of the part: along the face, and from the face to the centroid, m.
        bed, grip : float
            Stiffness across and along the face, N/m³.
        radial : bool
            Whether the face looks along the radius (a cylinder) rather than along the axis.
        elastic_modulus, poisson_ratio : float
            Pa and 1.
        """
        plane = elastic_modulus / (1 - poisson_ratio**2) * width / depth
        shear = 5 / 12 * elastic_modulus / (1 + poisson_ratio) * width / depth
        across = 1 / (1 / (bed * width) + 1 / plane)
        along = 1 / (1 / (grip * width) + 1 / shear)
        tilt = across * width**2 / 12
        return cls(
            radius=radius,
            height=height,
            radial=across if radial else along,
            tangential=along,
            axial=along if radial else across,
            tilt=tilt,
        )


def legs(count: int, width: float, first: float = 0.0) -> tuple[tuple[float, float], ...]:
    """Sectors of `count` equally spaced legs, each `width` rad wide, the first centred at `first`.

    Parameters
    ----------
    count : int
        Legs around the ring.
    width : float
        Of each, rad.
    first : float
        Middle of the first, rad.

    Returns
    -------
    tuple of (float, float)
        Middle and width of each, rad.

    Raises
    ------
    InputError
        If the legs overlap or there are none.

    Examples
    --------
    >>> from loadflow.rolling import legs
    >>> [(round(middle, 2), width) for middle, width in legs(4, 0.8)]
    [(0.0, 0.8), (1.57, 0.8), (3.14, 0.8), (4.71, 0.8)]
    """
    if count < 1 or not 0 < count * width <= 2 * math.pi * (1 + 1e-12):
        raise InputError(f"width: {count} legs of {width:g} rad do not fit round a ring")
    return tuple((first + 2 * math.pi * k / count, width) for k in range(count))
