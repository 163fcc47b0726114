"""The shaft as an elastic beam on elastic supports, and what carries those."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, Literal

import numpy as np
from annotated_types import Ge, Gt, Lt, MinLen
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.former_names import renamed
from loadflow.numerics.fields import check_fields, check_one_of
from loadflow.shaft.frame import FrameMatrix

_ROUNDING = 1e-9
"""Of the length of a shaft, by which the sum of its sections may miss it."""


@dataclass(frozen=True)
class ShaftSection:
    """A stretch of the shaft with one hollow circular cross-section.

    Attributes
    ----------
    outer_diameter, inner_diameter : float
        m.
    length : float, optional
        m; only the last section may leave it out, and then reaches to the end of the shaft.

    Examples
    --------
    >>> from loadflow.shaft import ShaftSection
    >>> round(ShaftSection(outer_diameter=1.0, inner_diameter=0.5).inertia, 4)  # m⁴
    0.046
    """

    outer_diameter: Annotated[float, Gt(0)]
    inner_diameter: Annotated[float, Ge(0)] = 0.0
    length: Annotated[float, Gt(0)] | None = None

    def __post_init__(self) -> None:
        if not 0 <= self.inner_diameter < self.outer_diameter < math.inf:
            raise InputError(
                f"outer_diameter = {self.outer_diameter} m, inner_diameter = "
                f"{self.inner_diameter} m: 0 <= inner < outer is needed"
            )
        if self.length is not None and not 0 < self.length < math.inf:
            raise InputError(f"length = {self.length} m: must be greater than 0")

    @property
    def area(self) -> float:
        """Cross-section, m²."""
        return math.pi / 4 * (self.outer_diameter**2 - self.inner_diameter**2)

    @property
    def inertia(self) -> float:
        """Second moment of area, m⁴."""
        return math.pi / 64 * (self.outer_diameter**4 - self.inner_diameter**4)

    def shear_coefficient(self, poisson: float) -> float:
        """Shear coefficient of a hollow circle after Cowper (1966), J. Appl. Mech. 33, 335."""
        m2 = (self.inner_diameter / self.outer_diameter) ** 2
        both = (1 + m2) ** 2
        return 6 * (1 + poisson) * both / ((7 + 6 * poisson) * both + (20 + 12 * poisson) * m2)


@dataclass(frozen=True)
class BearingSupport:
    """Stiffness of a bearing and of its housing, in series; one that is left out is rigid.

    Attributes
    ----------
    radial, housing_lateral, housing_vertical : float, optional
        Of the bearing in every direction, of the housing along y and z, N/m.
    takes_moment : bool
        Whether the bearing resists tilting.
    tilt, housing_tilt : float, optional
        Of a bearing that does, and of its housing, against rotation across the shaft, N m/rad.
    stiffness : {"given", "journal", "rolling"}
        Whether `radial` and `tilt` say how stiff the bearing is, or whether it follows, under each
        load, from the journal or the rolling bearing that stands there.
    housing : FrameMatrix, optional
        The housing, (6, 6), in place of its numbers.

    Examples
    --------
    >>> from loadflow.shaft import BearingSupport
    >>> BearingSupport(radial=2e9, housing_lateral=1e10).takes_moment
    False
    """

    radial: Annotated[float, Gt(0)] | None = None
    housing_lateral: Annotated[float, Gt(0)] | None = None
    housing_vertical: Annotated[float, Gt(0)] | None = None
    takes_moment: bool = False
    tilt: Annotated[float, Gt(0)] | None = None
    housing_tilt: Annotated[float, Gt(0)] | None = None
    stiffness: Literal["given", "journal", "rolling"] = "given"
    housing: FrameMatrix | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        check_one_of("stiffness", self.stiffness, ("given", "journal", "rolling"))
        if self.stiffness != "given" and (self.radial or self.tilt):
            raise InputError(
                f"stiffness = {self.stiffness!r} with radial = {self.radial} N/m, tilt = "
                f"{self.tilt} N m/rad: leave them out, they follow from the bearing"
            )
        if not self.takes_moment and (self.tilt or self.housing_tilt):
            raise InputError(
                f"takes_moment = False with tilt = {self.tilt}, housing_tilt = "
                f"{self.housing_tilt} N m/rad: a bearing that takes no moment has none"
            )
        if self.housing is None:
            return
        if self.housing.supports != 1:
            size = 6 * self.housing.supports
            raise InputError(
                f"housing.file = {self.housing.file!r}: (6, 6) is needed for one support, got "
                f"({size}, {size}); the matrix of all supports is `frame` of the beam"
            )
        if self.housing_lateral or self.housing_vertical or self.housing_tilt:
            raise InputError(
                f"housing_lateral = {self.housing_lateral}, housing_vertical = "
                f"{self.housing_vertical} N/m, housing_tilt = {self.housing_tilt} N m/rad: leave "
                f"them out, housing.file = {self.housing.file!r} says it all"
            )

    @property
    def housing_compliance(self) -> NDArray[np.float64]:
        """Motion of the bore by unit loads on it, (6, 6), in the order of `FrameMatrix`."""
        if self.housing is not None:
            return self.housing.compliance
        stiffness = (
            None, self.housing_lateral, self.housing_vertical,
            None, self.housing_tilt, self.housing_tilt,
        )  # fmt: skip
        return np.diag([0.0 if k is None else 1 / k for k in stiffness])


@renamed(seats="supports")
@dataclass(frozen=True)
class Beam:
    """Elastic shaft from the hub centre on, and the supports that it rests on.

    The default section is the main shaft of the WindPACT 5 MW turbine (NREL/SR-500-32495).

    Attributes
    ----------
    sections : tuple of ShaftSection
        From the hub centre downwind.
    supports : tuple of BearingSupport
        Bearing supports, one for each bearing; none: rigid, and free to tilt where there are two
        bearings.
    youngs_modulus : float
        Pa.
    poisson : float
        Poisson's ratio.
    shear : bool
        Timoshenko's beam; without, that of Euler and Bernoulli.
    frame : FrameMatrix, optional
        What carries all housings, (6 n, 6 n) of n supports, so that a load on one moves the
        others, too; without, it is rigid.

    Examples
    --------
    >>> from loadflow.shaft import Beam, ShaftSection
    >>> beam = Beam(sections=(ShaftSection(outer_diameter=1.0, inner_diameter=0.5),))
    >>> beam.shear
    True
    """

    sections: Annotated[tuple[ShaftSection, ...], MinLen(1)] = (ShaftSection(1.04, 0.52),)
    supports: tuple[BearingSupport, ...] = ()
    youngs_modulus: Annotated[float, Gt(0)] = 2.1e11
    poisson: Annotated[float, Ge(0), Lt(0.5)] = 0.3
    shear: bool = True
    frame: FrameMatrix | None = None

    def __post_init__(self) -> None:
        if not self.sections:
            raise InputError("sections = (): a beam needs at least one")
        for number, section in enumerate(self.sections[:-1]):
            if section.length is None:
                raise InputError(f"sections[{number}].length: only the last may leave it out")
        if not 0 < self.youngs_modulus < math.inf or not 0 <= self.poisson < 0.5:
            raise InputError(
                f"youngs_modulus = {self.youngs_modulus} Pa must be greater than 0, poisson = "
                f"{self.poisson} within 0 … 0.5"
            )

    def supports_of(self, bearings: int) -> tuple[BearingSupport, ...]:
        """The supports, or rigid ones for that many bearings.

        Raises
        ------
        loadflow.errors.InputError
            Another number of supports than of bearings, also of those of the frame; a single
            bearing that takes no moment.
        """
        supports = self.supports or (BearingSupport(takes_moment=bearings == 1),) * bearings
        if len(supports) != bearings:
            raise InputError(
                f"supports: {len(supports)} are given, the shaft has {bearings} bearings"
            )
        if bearings == 1 and not supports[0].takes_moment:
            raise InputError(
                "supports[0].takes_moment = False: a single bearing must take the moment"
            )
        if self.frame is not None and self.frame.supports != bearings:
            needed, given = 6 * bearings, 6 * self.frame.supports
            raise InputError(
                f"frame.file = {self.frame.file!r}: ({needed}, {needed}) is needed for {bearings} "
                f"bearings, got ({given}, {given})"
            )
        return supports

    @property
    def matrices(self) -> tuple[str, ...]:
        """Keys of the beam that are matrices of files."""
        found = {f"supports[{k}].housing": one.housing for k, one in enumerate(self.supports)}
        return tuple(key for key, part in ({"frame": self.frame} | found).items() if part)

    def compliance_of_bores(self, bearings: int) -> NDArray[np.float64]:
        """Motion of all bores by unit loads on them, (6 n, 6 n): housings on the frame."""
        total = np.zeros((6 * bearings, 6 * bearings))
        if self.frame is not None:
            total += self.frame.compliance
        for number, support in enumerate(self.supports_of(bearings)):
            own = slice(6 * number, 6 * number + 6)
            total[own, own] += support.housing_compliance
        return total

    def on_rigid_bearings(self) -> Beam:
        """The beam with rigid bearings in place of those that are solved, in their housings."""
        return replace(self, supports=tuple(replace(s, stiffness="given") for s in self.supports))

    def free_in_films(self) -> Beam:
        """The beam with rigid bearings in place of its films, in which it turns freely.

        As films that give way under a moment let it; rigid bearings that take one would clamp it.
        A single bearing holds the shaft by its moment alone, and is rigid against it, too.
        """
        if len(self.supports) == 1:
            return self.on_rigid_bearings()
        supports = tuple(
            replace(one, stiffness="given", takes_moment=False, housing_tilt=None)
            if one.stiffness == "journal"
            else one
            for one in self.supports
        )
        return replace(self, supports=supports)

    def stretches(self, end: float) -> list[tuple[float, float, ShaftSection]]:
        """Start, end (m from the hub centre) and section of each stretch up to `end`.

        Raises
        ------
        loadflow.errors.InputError
            The sections stop short of `end`.
        """
        found, start = [], 0.0
        for section in self.sections:
            stop = end if section.length is None else start + section.length
            if stop > end * (1 - _ROUNDING):  # lengths add up to the shaft's but for rounding
                stop = end
            if stop > start:
                found.append((start, stop, section))
            start = stop
        if start < end:
            raise InputError(f"sections reach to {start:g} m, the shaft to {end:g} m")
        return found
