"""Fits and temperatures of the rings: the clearance that a bearing has at work."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Literal, TypeVar

from annotated_types import Ge, Gt, Le

from loadflow.errors import InputError, SolverError
from loadflow.numerics.fields import check_choice, check_fields
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON

if TYPE_CHECKING:
    from loadflow.rolling.geometry import RollingGeometry

_Bearing = TypeVar("_Bearing", bound="RollingGeometry")

STEEL_EXPANSION = 11.7e-6
"""α of steel, 1/K."""


@dataclass(frozen=True, kw_only=True)
class Mounting:
    """Rings on their shaft and in their housing, by which a bearing at work has another clearance.

    Rings, rolling elements, shaft and housing expand each with its own temperature, and what an
    interference leaves of itself at these temperatures widens the inner ring and presses the outer
    one together (thick-walled cylinders of Lamé, as in [Harris and Kotzalas], ch. 3). A part is
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

    def at_work(self, bearing: _Bearing, temperature: float, ambient: float) -> _Bearing:
        """Return the bearing with the clearance that it has when it is warm.

        Parameters
        ----------
        bearing : RollingBearing
            With its clearance at the reference temperature, not mounted.
        temperature, ambient : float
            Of the bearing (its rolling elements and oil) and of the surroundings, K.

        Raises
        ------
        InputError
            A seat within the raceways, or a kind of bearing that has more than one clearance.
        SolverError
            If the bearing has no such clearance: its balls would be clamped or fall out.
        """
        gap = self.gap_growth(bearing, temperature, ambient)
        try:
            return bearing.opened(gap)
        except InputError as error:
            raise SolverError(
                f"at {temperature:.4g} K contacts open by {gap:.3g} m: {error}"
            ) from error

    def gap_growth(self, bearing: RollingGeometry, temperature: float, ambient: float) -> float:
        """By how much the gap along the normal of a contact grows, over both raceways, m.

        The raceways move with their rings: in the radial direction by strain and fit, along the
        axis, where the rows stand apart, by strain.
        """
        inner, outer, shaft, housing = rises = self._rises(temperature, ambient)
        element, angle = bearing.element_diameter, bearing.nominal_angle
        cos, sin = math.cos(angle), math.sin(angle)
        smaller = bearing.pitch_diameter - element * cos
        larger = bearing.pitch_diameter + element * cos
        widened, narrowed = self._fits(smaller, larger, rises)
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

    def _fits(self, smaller: float, larger: float, rises: tuple[float, ...]) -> tuple[float, float]:
        """Growth of the inner and shrinking of the outer raceway by the fits, on the diameter, m.

        Seats that open as they grow warm are loose and do nothing.
        """
        inner, outer, shaft, housing = rises
        widened = narrowed = 0.0
        if (bore := self.bore) is not None:
            _check_seat("bore", bore < smaller, bore, f"< {smaller:g} m, the inner raceway")
            left = self.inner_interference + bore * (
                self.shaft_expansion * shaft - self.expansion * inner
            )
            thin, wall = (bore / smaller) ** 2, (self.shaft_bore / bore) ** 2
            ring = bore / STEEL_MODULUS * ((1 + thin) / (1 - thin) + STEEL_POISSON)
            within = bore / STEEL_MODULUS * ((1 + wall) / (1 - wall) - STEEL_POISSON)
            pressure = max(left, 0.0) / (ring + within)
            widened = pressure * 2 * thin * smaller / (STEEL_MODULUS * (1 - thin))
        if (outside := self.outside) is not None:
            _check_seat("outside", outside > larger, outside, f"> {larger:g} m, the outer raceway")
            left = self.outer_interference + outside * (
                self.expansion * outer - self.housing_expansion * housing
            )
            thin = (larger / outside) ** 2
            wall = (outside / (self.housing_outside or math.inf)) ** 2
            ring = outside / STEEL_MODULUS * ((1 + thin) / (1 - thin) - STEEL_POISSON)
            around = outside / self.housing_modulus * ((1 + wall) / (1 - wall) + STEEL_POISSON)
            pressure = max(left, 0.0) / (ring + around)
            narrowed = pressure * 2 * larger / (STEEL_MODULUS * (1 - thin))
        return widened, narrowed


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
