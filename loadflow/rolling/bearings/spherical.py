"""Self-aligning spherical roller bearings."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from loadflow.errors import InputError
from loadflow.rolling.bearings.elements import BearingOfRollers
from loadflow.rolling.contacts import LINE, Contacts, azimuths
from loadflow.rolling.friction.skf import CatalogueKind
from loadflow.rolling.roller_raceways import RollerRaceways


@dataclass(frozen=True, kw_only=True)
class SphericalRollerBearing(RollerRaceways, BearingOfRollers):
    """Two rows of barrel rollers in a spherical outer raceway: aligns itself, takes no moment.

    Its tilt stays at zero, and ``singular`` is set: nothing resists a tilt.

    All lines of contact meet the axis in the bearing centre, so that the contact angle sets the
    distance of the rows, D_pw tan α. Rollers follow the tilt of the inner ring, so that their
    slices differ by the profile alone. The fields of `RollerRaceways`; `crown_radius` is the
    relative radius 1/(1/R_roller - 1/R_raceway) of a roller in its raceway, along the roller.

    Attributes
    ----------
    rows : int
        Two, or one (a barrel roller bearing, contact angle 0).

    Raises
    ------
    InputError
        If a field is out of its range, or `row_spacing` is given.

    Examples
    --------
    >>> bearing = SphericalRollerBearing(rollers=28, roller_diameter=0.08, roller_length=0.12,
    ...     pitch_diameter=0.95, contact_angle=0.17)
    >>> result = bearing.equilibrium(force=(0, -2e6, 0.3e6))
    >>> result.roller_forces.shape
    (2, 28)
    """

    kind: ClassVar[str] = "spherical"
    words: ClassVar[str] = "spherical roller bearing"
    takes_moment: ClassVar[bool] = False
    allowed_tilt: ClassVar[float | None] = math.radians(1.5)
    """Of series 231, the least of the wide ones in the makers' catalogues."""

    rows: int = 2

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.rows not in (1, 2):
            raise InputError(f"rows: must be 1 or 2, got {self.rows}")
        if self.row_spacing:
            raise InputError(
                "row_spacing: follows from the contact angle, D_pw tan α; leave it out"
            )
        if (self.contact_angle == 0) != (self.rows == 1) or self.contact_angle >= math.pi / 2:
            raise InputError(
                "contact_angle: must lie between 0 and π/2 for two rows and be 0 for one, "
                f"got {self.contact_angle:g}"
            )

    @property
    def takes_thrust(self) -> bool:
        """Two rows do; one row of barrels stands across the axis, and floats."""
        return self.rows == 2

    @property
    def contact_curvature(self) -> float:
        """Midway between the raceways, the sphere of the outer ring and as curved, and barrels."""
        sphere = self.pitch_diameter / 2 / math.cos(self.contact_angle) + self.roller_diameter / 2
        closer = 0.0 if self.crown_radius is None else 1 / self.crown_radius
        return 1 / sphere + closer / 2

    @property
    def catalogue_kind(self) -> CatalogueKind | None:
        """Of two rows; tables have no constants of barrels in one."""
        return "spherical" if self.rows == 2 else None

    @property
    def row_offset(self) -> float:
        """Axial distance of a row from the bearing centre, outward along its normal, m."""
        return self.pitch_diameter / 2 * math.tan(self.contact_angle)

    def contacts(self, element_angle: float = 0.0) -> Contacts:
        """All contacts; kinds in the order row 0 slice 0, row 0 slice 1, …."""
        cos, sin = math.cos(self.contact_angle), math.sin(self.contact_angle)
        radius = self.pitch_diameter / 2
        height = radius * math.tan(self.contact_angle)
        gap = self.clearance / 2 * cos + 2 * self.profile_drop
        table = [
            [radius, side * height, cos, side * sin, 1.0, slack, self.slice_stiffness]
            for side in ((-1.0, 1.0) if self.rows == 2 else (0.0,))
            for slack in gap
        ]
        return Contacts(
            table=np.array(table),
            azimuth=azimuths(self.rollers, element_angle),
            law=LINE,
            spatial=False,
            cap=0.02 * self.roller_diameter,
            lever=radius,
        )
