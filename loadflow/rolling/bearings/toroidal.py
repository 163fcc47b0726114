"""Toroidal roller bearings: one row of long barrels that aligns itself and floats."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from annotated_types import Gt, Lt

from loadflow.errors import InputError
from loadflow.rolling.bearings.elements import BearingOfRollers
from loadflow.rolling.contacts import LINE, Contacts, azimuths
from loadflow.rolling.roller_raceways import RollerRaceways


@dataclass(frozen=True, kw_only=True)
class ToroidalRollerBearing(RollerRaceways, BearingOfRollers):
    """One row of long barrels between toroidal raceways: aligns itself, floats, takes no thrust.

    Both raceways are curved along the barrels, by a radius of their own that is larger than that
    of a spherical raceway. Barrels turn in them when a ring tilts or moves along the axis, so that
    neither is resisted: its tilt stays at zero, and ``singular`` is set. What is lost is clearance.
    The fields of `RollerRaceways`; `crown_radius` is the relative radius
    1/(1/R_roller - 1/R_raceway) of a barrel in its raceway, along the barrel; and:

    Attributes
    ----------
    raceway_radius : float
        Radius R of both raceways along the barrels, m; larger than half of the outer raceway's
        diameter, that of a spherical one.
    shift : float
        Axial displacement s of the rings against each other, m. It takes s²/(2R - D) of the
        clearance on the diameter, and turns the barrels by s/(2R - D).

    Raises
    ------
    InputError
        If a field is out of its range, or rows or a contact angle are given.

    Notes
    -----
    The profiles of the raceways are arcs about centres that lie 2R - D less the radial gap apart,
    with the diameter D of a barrel; those of a barrel, 2R - D apart. A displacement s takes the
    centres of the raceways to √((2R - D)² + s²), by s²/2(2R - D) further from each other: that is
    what the gap at each barrel loses, half of what the diameter does. Barrels are as good as the
    raceways' radius here; the edges of raceways that a barrel may reach are not looked at.

    Examples
    --------
    >>> bearing = ToroidalRollerBearing(rollers=26, roller_diameter=0.15, roller_length=0.29,
    ...     pitch_diameter=1.5, raceway_radius=1.8, clearance=4e-4, shift=0.01)
    >>> f"{bearing.lost_clearance:.3g}"
    '2.9e-05'
    >>> bearing.equilibrium(force=(0, -2e6, 0)).roller_forces.shape
    (1, 26)
    """

    kind: ClassVar[str] = "toroidal"
    words: ClassVar[str] = "toroidal roller bearing"
    takes_moment: ClassVar[bool] = False
    allowed_tilt: ClassVar[float | None] = math.radians(0.5)
    """As in NREL's WISDEM (`drive_components.py`, "CARB")."""

    raceway_radius: Annotated[float, Gt(0)]
    shift: Annotated[float, Gt(-1), Lt(1)] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.rows != 1 or self.row_spacing:
            raise InputError("rows: it has one; leave out rows and row_spacing")
        if self.contact_angle:
            raise InputError(
                f"contact_angle: must be 0, barrels lie along the axis, got {self.contact_angle:g}"
            )
        if abs(self.shift) >= self.roller_length / 2:
            raise InputError(
                f"shift: must be less than half the length of a roller, "
                f"{self.roller_length / 2:g} m, got {self.shift:g}"
            )
        sphere = (self.pitch_diameter + self.roller_diameter) / 2
        if self.raceway_radius <= sphere:
            raise InputError(
                f"raceway_radius: must be > {sphere:g} m, that of a spherical raceway, "
                f"got {self.raceway_radius:g}"
            )

    @property
    def takes_thrust(self) -> bool:
        """It does not: barrels turn, and the rings pass each other."""
        return False

    @property
    def lost_clearance(self) -> float:
        """Clearance on the diameter that the axial displacement takes, m."""
        return self.shift**2 / (2 * self.raceway_radius - self.roller_diameter)

    @property
    def contact_curvature(self) -> float:
        """Midway between raceways and barrels, 1/m."""
        closer = 0.0 if self.crown_radius is None else 1 / self.crown_radius
        return 1 / self.raceway_radius + closer / 2

    def contacts(self, element_angle: float = 0.0) -> Contacts:
        """All contacts; kinds are the slices of a barrel."""
        radius = self.pitch_diameter / 2
        gap = (self.clearance - self.lost_clearance) / 2 + 2 * self.profile_drop
        table = [[radius, 0.0, 1.0, 0.0, 1.0, slack, self.slice_stiffness] for slack in gap]
        return Contacts(
            table=np.array(table),
            azimuth=azimuths(self.rollers, element_angle),
            law=LINE,
            spatial=False,
            cap=0.02 * self.roller_diameter,
            lever=radius,
        )
