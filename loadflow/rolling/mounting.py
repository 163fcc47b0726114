"""Fits and temperatures of the rings: the clearance that a bearing has at work."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Literal, Protocol, TypeVar

from annotated_types import Ge, Gt, Le

from loadflow.errors import InputError, SolverError
from loadflow.numerics.fields import check_choice, check_fields
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON

if TYPE_CHECKING:
    from loadflow.rolling.geometry import RollingGeometry
    from loadflow.rolling.rings.section import RingSection

_Bearing = TypeVar("_Bearing", bound="RollingGeometry")

STEEL_EXPANSION = 11.7e-6
"""α of steel, 1/K."""
_ASTRAY = 0.25
"""Share of a ring's wall by which a seat may lie beside its face: sections stated by their moments
have a wall only as a rectangle of the same moments."""


class SectionedRing(Protocol):
    """A ring of which the section is known, as `RingBeam` and `MeshedRing`."""

    @property
    def section(self) -> RingSection:
        """Constants of the section."""

    @property
    def radius(self) -> float | None:
        """Of its centroid, m."""

    @property
    def elastic_modulus(self) -> float:
        """Pa."""

    @property
    def poisson_ratio(self) -> float:
        """Of the ring."""


@dataclass(frozen=True)
class _Tube:
    """A ring as a thick-walled cylinder: diameters m, modulus Pa."""

    inside: float
    outside: float
    modulus: float = STEEL_MODULUS
    poisson: float = STEEL_POISSON

    @property
    def thin(self) -> float:
        return (self.inside / self.outside) ** 2

    @property
    def widening(self) -> float:
        """Growth of the bore per pressure in it, m/Pa."""
        thin = self.thin
        return self.inside / self.modulus * ((1 + thin) / (1 - thin) + self.poisson)

    @property
    def narrowing(self) -> float:
        """Shrinking of the outer diameter per pressure on it, m/Pa."""
        thin = self.thin
        return self.outside / self.modulus * ((1 + thin) / (1 - thin) - self.poisson)

    def widened(self, diameter: float) -> float:
        """Growth of a diameter within the wall per pressure in the bore, m/Pa."""
        share = self.thin / (self.modulus * (1 - self.thin))
        inner = (1 - self.poisson) * diameter
        return share * (inner + (1 + self.poisson) * self.outside**2 / diameter)

    def narrowed(self, diameter: float) -> float:
        """Shrinking of a diameter within the wall per pressure from outside, m/Pa."""
        share = 1 / (self.modulus * (1 - self.thin))
        outer = (1 - self.poisson) * diameter
        return share * (outer + (1 + self.poisson) * self.inside**2 / diameter)


@dataclass(frozen=True, kw_only=True)
class Mounting:
    """Rings on their shaft and in their housing, by which a bearing at work has another clearance.

    Rings, rolling elements, shaft and housing expand each with its own temperature, and what an
    interference leaves of itself at these temperatures widens the inner ring and presses the outer
    one together (thick-walled cylinders of Lamé, as in [Harris and Kotzalas 2006], ch. 3). A ring
    reaches from its seat to its raceway, or, where its section is given, over all of it. A part is
    warmer than the surroundings by its share of what the bearing is; its temperature may be given
    instead.

    Attributes
    ----------
    expansion, shaft_expansion, housing_expansion : float
        α of bearing, shaft and housing, 1/K; of steel by default.
    inner_share, outer_share, shaft_share, housing_share : float
        Rise of a part above ambient over that of the bearing: 1 if all are as warm; in a housing
        that is cooled the inner ring has more than 1, outer ring and housing less.
    inner_temperature, outer_temperature, shaft_temperature, housing_temperature : float, optional
        K, in place of the shares.
    row_distance : {"rings", "seats"}
        What holds rows apart and expands with them: the rings of one bearing, or shaft and housing
        between two bearings that count as one here.
    reference_temperature : float
        At which clearance and interferences are those stated, K.
    bore, outside : float, optional
        Diameters of the inner ring's and the outer ring's seat, m. A seat that is left out is
        loose: its ring expands freely.
    inner_interference, outer_interference : float
        On the diameter of a seat, m; negative of a loose fit.
    shaft_bore : float
        Of a hollow shaft, m.
    housing_outside : float, optional
        Diameter of the housing, m; much larger than the seat if not given.
    housing_modulus : float
        Pa.

    Raises
    ------
    InputError
        A field out of its range, an interference without the diameter of its seat, a shaft or
        housing without a wall.

    Examples
    --------
    The inner ring of a double-row spherical bearing is 10 K warmer than the outer one:

    >>> from loadflow.rolling import Mounting, SphericalRollerBearing
    >>> bearing = SphericalRollerBearing(rollers=28, roller_diameter=0.08, roller_length=0.12,
    ...     pitch_diameter=0.95, contact_angle=0.17, clearance=400e-6)
    >>> mounting = Mounting(inner_temperature=328.15, outer_temperature=318.15)
    >>> warm = mounting.at_work(bearing, temperature=323.15, ambient=293.15)
    >>> round((warm.clearance - bearing.clearance) * 1e6)  # µm
    -114
    """

    expansion: Annotated[float, Ge(0), Le(1e-4)] = STEEL_EXPANSION
    shaft_expansion: Annotated[float, Ge(0), Le(1e-4)] = STEEL_EXPANSION
    housing_expansion: Annotated[float, Ge(0), Le(1e-4)] = STEEL_EXPANSION
    inner_share: Annotated[float, Ge(0), Le(3)] = 1.0
    outer_share: Annotated[float, Ge(0), Le(3)] = 1.0
    shaft_share: Annotated[float, Ge(0), Le(3)] = 1.0
    housing_share: Annotated[float, Ge(0), Le(3)] = 1.0
    inner_temperature: Annotated[float, Gt(200), Le(600)] | None = None
    outer_temperature: Annotated[float, Gt(200), Le(600)] | None = None
    shaft_temperature: Annotated[float, Gt(200), Le(600)] | None = None
    housing_temperature: Annotated[float, Gt(200), Le(600)] | None = None
    row_distance: Literal["rings", "seats"] = "rings"
    reference_temperature: Annotated[float, Gt(200), Le(600)] = 293.15
    bore: Annotated[float, Gt(0)] | None = None
    outside: Annotated[float, Gt(0)] | None = None
    inner_interference: Annotated[float, Ge(-0.1), Le(0.1)] = 0.0
    outer_interference: Annotated[float, Ge(-0.1), Le(0.1)] = 0.0
    shaft_bore: Annotated[float, Ge(0)] = 0.0
    housing_outside: Annotated[float, Gt(0)] | None = None
    housing_modulus: Annotated[float, Gt(0)] = STEEL_MODULUS

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "row_distance", ("rings", "seats"))
        for name, seat in (("inner_interference", "bore"), ("outer_interference", "outside")):
            if getattr(self, name) and getattr(self, seat) is None:
                raise InputError(f"{name}: give {seat}, too, the diameter of its seat")
        for name, wall in (("shaft_bore", "bore"), ("housing_outside", "outside")):
            if getattr(self, name) and getattr(self, wall) is None:
                raise InputError(f"{name}: give {wall}, too, the diameter of the seat")
        if self.bore is not None and self.shaft_bore >= self.bore:
            raise InputError(f"shaft_bore: must be < bore {self.bore:g} m, got {self.shaft_bore:g}")
        if self.housing_outside is not None and self.housing_outside <= (self.outside or 0.0):
            raise InputError(
                f"housing_outside: must be > outside {self.outside:g} m, "
                f"got {self.housing_outside:g}"
            )

    def at_work(
        self,
        bearing: _Bearing,
        temperature: float,
        ambient: float,
        inner_ring: SectionedRing | None = None,
        outer_ring: SectionedRing | None = None,
    ) -> _Bearing:
        """Return the bearing with the clearance that it has when it is warm.

        Parameters
        ----------
        bearing : RollingBearing
            With its clearance at the reference temperature, not mounted.
        temperature, ambient : float
            Of the bearing (its rolling elements and oil) and of the surroundings, K.
        inner_ring, outer_ring : RingBeam or MeshedRing, optional
            Whose sections the fits stretch, in place of walls that end at the raceways.

        Raises
        ------
        InputError
            A seat within the raceways or beside the section of its ring, or a kind of bearing that
            has more than one clearance.
        SolverError
            If the bearing has no such clearance: its balls would be clamped or fall out.
        """
        gap = self.gap_growth(bearing, temperature, ambient, inner_ring, outer_ring)
        try:
            return bearing.opened(gap)
        except InputError as error:
            raise SolverError(
                f"at {temperature:.4g} K contacts open by {gap:.3g} m: {error}"
            ) from error

    def gap_growth(
        self,
        bearing: RollingGeometry,
        temperature: float,
        ambient: float,
        inner_ring: SectionedRing | None = None,
        outer_ring: SectionedRing | None = None,
    ) -> float:
        """By how much the gap along the normal of a contact grows, over both raceways, m.

        The raceways move with their rings: in the radial direction by strain and fit, along the
        axis, where the rows stand apart, by strain.
        """
        inner, outer, shaft, housing = rises = self._rises(temperature, ambient)
        element, angle = bearing.element_diameter, bearing.nominal_angle
        cos, sin = math.cos(angle), math.sin(angle)
        smaller = bearing.pitch_diameter - element * cos
        larger = bearing.pitch_diameter + element * cos
        widened = self._widened(smaller, rises, inner_ring)
        narrowed = self._narrowed(larger, rises, outer_ring)
        strain, other = self.expansion * outer, self.expansion * inner
        radial = 0.5 * (larger * strain - narrowed - smaller * other - widened)
        apart = strain - other
        if self.row_distance == "seats":
            apart = self.housing_expansion * housing - self.shaft_expansion * shaft
        # a contact point lies half an element beyond the middle of its row, along the normal
        axial = bearing.row_offset * apart + 0.5 * element * sin * (strain + other)
        swollen = self.expansion * (temperature - self.reference_temperature) * element
        return cos * radial + sin * axial - swollen

    def _rises(self, temperature: float, ambient: float) -> tuple[float, ...]:
        """Temperatures of inner ring, outer ring, shaft and housing above the reference, K."""
        stated = (
            (self.inner_temperature, self.inner_share),
            (self.outer_temperature, self.outer_share),
            (self.shaft_temperature, self.shaft_share),
            (self.housing_temperature, self.housing_share),
        )
        return tuple(
            (ambient + share * (temperature - ambient) if given is None else given)
            - self.reference_temperature
            for given, share in stated
        )

    def _widened(
        self, raceway: float, rises: tuple[float, ...], ring: SectionedRing | None
    ) -> float:
        """Growth of the inner raceway's diameter by its fit, m; none of a seat that grows loose."""
        inner, _, shaft, _ = rises
        if (bore := self.bore) is None:
            return 0.0
        _check_seat("bore", bore < raceway, bore, f"< {raceway:g} m, the inner raceway")
        tube = _Tube(bore, raceway)
        if ring is not None:
            tube = _Tube(bore, _faces(ring, "bore", bore)[1], *_steel(ring))
        left = self.inner_interference + bore * (
            self.shaft_expansion * shaft - self.expansion * inner
        )
        wall = (self.shaft_bore / bore) ** 2
        within = bore / STEEL_MODULUS * ((1 + wall) / (1 - wall) - STEEL_POISSON)
        pressure = max(left, 0.0) / (tube.widening + within)
        return pressure * tube.widened(min(raceway, tube.outside))

    def _narrowed(
        self, raceway: float, rises: tuple[float, ...], ring: SectionedRing | None
    ) -> float:
        """Shrinking of the outer raceway's diameter by its fit, m."""
        _, outer, _, housing = rises
        if (outside := self.outside) is None:
            return 0.0
        _check_seat("outside", outside > raceway, outside, f"> {raceway:g} m, the outer raceway")
        tube = _Tube(raceway, outside)
        if ring is not None:
            tube = _Tube(_faces(ring, "outside", outside)[0], outside, *_steel(ring))
        left = self.outer_interference + outside * (
            self.expansion * outer - self.housing_expansion * housing
        )
        wall = (outside / (self.housing_outside or math.inf)) ** 2
        around = outside / self.housing_modulus * ((1 + wall) / (1 - wall) + STEEL_POISSON)
        pressure = max(left, 0.0) / (tube.narrowing + around)
        return pressure * tube.narrowed(max(raceway, tube.inside))


def _faces(ring: SectionedRing, name: str, seat: float) -> tuple[float, float]:
    """Inner and outer diameter of a ring, m, whose seat is where a mounting has it."""
    section, middle = ring.section, 2 * (ring.radius or 0.0)
    # radial side of the rectangle with the same area and moment; of a rectangle its own
    side = math.sqrt(12 * section.inertia_axial / section.area)
    faces = middle - side, middle + side
    face = faces[0] if name == "bore" else faces[1]
    _check_seat(
        name, abs(seat - face) <= 2 * _ASTRAY * side, seat,
        f"the face of the ring's section, {face:g} m",
    )  # fmt: skip
    return faces


def _steel(ring: SectionedRing) -> tuple[float, float]:
    return ring.elastic_modulus, ring.poisson_ratio


def unused_of(mounting: Mounting, bearing: RollingGeometry) -> Iterator[tuple[str, str]]:
    """Yield the fields of a mounting that its other fields, or the bearing, leave without effect.

    Examples
    --------
    >>> from loadflow.rolling import Mounting, RollerBearing
    >>> from loadflow.rolling.mounting import unused_of
    >>> row = RollerBearing(rollers=24, roller_diameter=0.04, roller_length=0.06,
    ...     pitch_diameter=0.5)
    >>> dict(unused_of(Mounting(shaft_share=0.8), row))
    {'shaft_share': 'there is no bore'}
    """
    apart = mounting.row_distance == "seats" and bearing.row_offset != 0
    if mounting.row_distance == "seats" and not apart:
        yield "row_distance", "the bearing has no rows that face each other"
    loose = {"shaft": mounting.bore is None, "housing": mounting.outside is None}
    seats = {"shaft": "bore", "housing": "outside"}
    for part in ("inner", "outer", "shaft", "housing"):
        idle = loose.get(part, False) and not apart
        for name in ("expansion", "share", "temperature"):
            key = f"{part}_{name}"
            if getattr(mounting, key, None) == getattr(_PLAIN, key, None):
                continue
            if idle:
                yield key, f"there is no {seats[part]}"
            elif name == "share" and getattr(mounting, f"{part}_temperature") is not None:
                yield key, f"{part}_temperature is given"
    if loose["housing"] and mounting.housing_modulus != _PLAIN.housing_modulus:
        yield "housing_modulus", "there is no outside"


_PLAIN = Mounting()


def _check_seat(name: str, fits: bool, value: float, allowed: str) -> None:
    if not fits:
        raise InputError(f"{name}: must be {allowed}, got {value:g}")
