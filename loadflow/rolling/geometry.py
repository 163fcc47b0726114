"""What a kind of rolling bearing says of itself; everything else is the same for all of them."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.rolling.contact_forces import ContactForces
from loadflow.rolling.contacts import Array, Contacts, mean_offset

if TYPE_CHECKING:
    from loadflow.rolling.friction.skf import CatalogueKind


class RollingGeometry(ABC):
    """Geometry of a rolling bearing: its contacts, how they group, its capacities and ratings.

    A kind of bearing is a frozen dataclass that inherits this and states the members below; its
    verbs come from `loadflow.rolling.bearings.base.RollingBearing`. Methods that take ``found``
    read the forces of all contacts (`ContactForces`).

    Attributes
    ----------
    kind : str
        Name in scenes and on the command line.
    element : {"ball", "roller"}
        What rolls.
    group_dims : tuple of str
        Names of the groups of `element_forces`, as dimensions of a Dataset.
    life_exponent, weibull_slope : float
        p of L10 = (C/P)^p, and slope of the scatter of lives.
    static_exponent : int
        Force over pressure: 3 of points, 2 of lines.
    rated_axially : bool
        Whether its capacities are axial (slewing rings) or radial.
    takes_moment : bool
        Whether it resists a tilting moment.
    allowed_tilt : float or None
        Tilt of the shaft in it that its contacts bear, rad; None of bearings for moments.
    """

    kind: ClassVar[str]
    element: ClassVar[Literal["ball", "roller"]]
    group_dims: ClassVar[tuple[str, ...]] = ("row",)
    life_exponent: ClassVar[float]
    weibull_slope: ClassVar[float]
    static_exponent: ClassVar[int]
    rated_axially: ClassVar[bool] = False
    takes_moment: ClassVar[bool] = True
    allowed_tilt: ClassVar[float | None] = None

    if TYPE_CHECKING:  # a field of most kinds, so that no property may stand before it

        @property
        def pitch_diameter(self) -> float:
            """Pitch diameter D_pw, m."""

    @abstractmethod
    def contacts(self, element_angle: float = 0.0) -> Contacts:
        """All contacts with the first element of each row at the azimuth `element_angle`, rad."""

    @property
    @abstractmethod
    def groups(self) -> tuple[int, ...]:
        """Size of each of `group_dims`."""

    @property
    @abstractmethod
    def rated_capacity(self) -> float:
        """Basic dynamic capacity, N: radial, or axial of slewing rings."""

    @property
    @abstractmethod
    def static_capacity(self) -> float:
        """Basic static capacity C₀ of ISO 76, N: radial, or axial of slewing rings."""

    @property
    def takes_thrust(self) -> bool:
        """Whether it carries a force along its axis: all but rollers on cylinders do."""
        return True

    @abstractmethod
    def element_forces(self, found: ContactForces) -> Array:
        """Forces on the rolling elements, N, (..., *groups, element)."""

    @abstractmethod
    def raceway_pressure(self, found: ContactForces) -> tuple[Array, ...]:
        """Largest Hertzian pressure at each raceway, Pa."""

    @abstractmethod
    def pressure_safety(self, found: ContactForces) -> Array:
        """Allowable over largest pressure; infinite without load."""

    @abstractmethod
    def reference_life(self, found: ContactForces) -> Array:
        """Reference life L10r of ISO/TS 16281, millions of revolutions; the inner ring turns."""

    # --- of bearings whose clearance follows the temperature of their rings ----------------------
    @property
    def element_diameter(self) -> float:
        """Diameter of the rolling elements, m."""
        raise InputError(f"mounting: a {type(self).__name__} has more than one clearance")

    @property
    def nominal_angle(self) -> float:
        """Contact angle of a row from the radial plane, rad."""
        raise InputError(f"mounting: a {type(self).__name__} has more than one clearance")

    @property
    def row_offset(self) -> float:
        """Axial distance of a row from the bearing centre along its contact normal outward, m.

        Where rows are not alike in it the mean: 0 of rows in tandem and of two diagonals.
        """
        return 0.0

    def opened(self, gap: float) -> Self:
        """Return the bearing with `gap`, m, more along the normal of each contact.

        Raises
        ------
        InputError
            If it cannot have such a clearance.
        """
        raise InputError(f"mounting: a {type(self).__name__} has more than one clearance")

    # --- of bearings with rollers ----------------------------------------------------------------
    def with_whole_rollers(self) -> Self:
        """Return the bearing with rollers of one slice, without profile and tilt.

        Raises
        ------
        InputError
            If it has no rollers.
        """
        raise InputError(f"whole rollers: a {type(self).__name__} has none")

    # --- the same unless a kind says otherwise ---------------------------------------------------
    @property
    def rib_guided(self) -> bool:
        """Whether its rollers are pressed on a rib, as tapered ones are."""
        return False

    @property
    def catalogue_kind(self) -> CatalogueKind | None:
        """Type of bearing in catalogues of friction; None where they have no constants here."""
        return None

    def contact_angles(self, found: ContactForces) -> Array:
        """Operating contact angles, rad, (..., *groups, element); of balls, whose angle moves."""
        raise InputError(f"contact_angles: fixed by the geometry of a {type(self).__name__}")

    def maximum_force(self, found: ContactForces) -> Array:
        """Largest force on a rolling element, N."""
        axes = tuple(range(-len(self.groups) - 1, 0))
        return np.asarray(self.element_forces(found).max(axis=axes))

    def slice_forces(self, found: ContactForces) -> Array:
        """Forces on the slices of rollers, N, (..., track, slice, roller)."""
        raise InputError(f"slice_forces: not of a {type(self).__name__}")

    def truncated(self, found: ContactForces) -> NDArray[np.bool_]:
        """Whether a contact reaches over the shoulder of its raceway; of balls only."""
        raise InputError(f"truncated: a matter of balls, not of a {type(self).__name__}")

    def rating_life(self, found: ContactForces) -> Array:
        """Basic rating life, millions of revolutions: the reference life."""
        return self.reference_life(found)

    def equivalent_load(self, found: ContactForces) -> Array:
        """Dynamic equivalent reference load P_ref = C/L10r^(1/p), N."""
        life = self.reference_life(found)
        return np.asarray(self.rated_capacity / life ** (1 / self.life_exponent))


@dataclass(frozen=True, kw_only=True)
class OneClearance(RollingGeometry):
    """Geometry of rows of one contact angle and one clearance, which fits and heat change."""

    if TYPE_CHECKING:  # fields of each kind, with bounds and defaults of their own
        contact_angle: float
        clearance: float
        rows: int

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        if self.rows == 1:
            yield "row_spacing", "the bearing has one row"

    @property
    def nominal_angle(self) -> float:
        """Contact angle of a row from the radial plane, rad."""
        return self.contact_angle

    @property
    def clearance_share(self) -> float:
        """Share of the clearance that lies along the normals of both contacts."""
        return math.cos(self.contact_angle)

    def opened(self, gap: float) -> Self:
        """Return the bearing with `gap`, m, more along the normal of each contact."""
        return replace(self, clearance=self.clearance + 2 * gap / self.clearance_share)


class FacingRows(OneClearance):
    """Rows of which an arrangement says which way they face."""

    if TYPE_CHECKING:  # fields of each kind
        row_spacing: float
        arrangement: str

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        yield from super().idle()
        if self.rows == 1:
            yield "arrangement", "the bearing has one row"
        elif self.contact_angle == 0:
            yield "arrangement", "rows without a contact angle face neither way"

    @property
    def row_offset(self) -> float:
        """Axial distance of a row from the bearing centre along its normal outward, m; mean."""
        return mean_offset(self.rows, self.row_spacing, self.arrangement)
