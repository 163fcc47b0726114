"""Cylindrical and tapered roller bearings, sliced rollers after ISO/TS 16281."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import numpy as np
from annotated_types import Ge, Lt

from loadflow.numerics.fields import check_choice
from loadflow.rolling.bearings.elements import BearingOfRollers
from loadflow.rolling.contacts import LINE, Contacts, azimuths, row_sides
from loadflow.rolling.friction.skf import CatalogueKind
from loadflow.rolling.geometry import FacingRows
from loadflow.rolling.roller_raceways import RollerRaceways


@dataclass(frozen=True, kw_only=True)
class RollerBearing(FacingRows, RollerRaceways, BearingOfRollers):
    """Roller bearing with one or more rows; rollers are cut into slices with a profile.

    Rollers touch both rings along the same normal (the small angle of tapered rollers and the rib
    force are left out) and tilt half as much as the rings, as ISO/TS 16281 has it. The fields of
    `RollerRaceways`, where `clearance` of a tapered pair stands for the axial clearance s/tan α
    (`axial_clearance`); and:

    Attributes
    ----------
    arrangement : {"back-to-back", "face-to-face", "tandem"}
        Of two or more tapered rows. A single row, and in back-to-back the row at -z, carries +Fz on
        the inner ring.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    A tapered pair of a 1 MW turbine, preloaded:

    >>> pair = RollerBearing(rollers=48, roller_diameter=0.04, roller_length=0.06,
    ...     pitch_diameter=0.8, contact_angle=0.35, rows=2, row_spacing=0.12, clearance=-20e-6)
    >>> result = pair.equilibrium(force=(0, -4e5, 1e5), moment=(2e4, 0))
    >>> result.roller_forces.shape
    (2, 48)
    """

    kind: ClassVar[str] = "roller"
    words: ClassVar[str] = "roller bearing"
    allowed_tilt: ClassVar[float | None] = math.radians(3 / 60)
    """3′ of tapered rollers, as in NREL's WISDEM (`drive_components.py`); cylindrical ones 4′."""

    contact_angle: Annotated[float, Ge(0), Lt(math.pi / 2)] = 0.0
    arrangement: Literal["back-to-back", "face-to-face", "tandem"] = "back-to-back"

    def __post_init__(self) -> None:
        super().__post_init__()
        check_choice(self, "arrangement", ("back-to-back", "face-to-face", "tandem"))

    @property
    def takes_thrust(self) -> bool:
        """Tapered rollers do, cylindrical ones do not."""
        return self.contact_angle > 0

    @property
    def rib_guided(self) -> bool:
        """Whether the rollers are tapered, and so pressed on a rib."""
        return self.contact_angle > 0

    @property
    def catalogue_kind(self) -> CatalogueKind:
        """Tapered where the rollers have a contact angle."""
        return "tapered" if self.rib_guided else "cylindrical"

    @property
    def axial_clearance(self) -> float:
        """Total axial clearance s/tan α of a pair of rows, m; infinite for cylindrical rollers."""
        tan = math.tan(self.contact_angle)
        return self.clearance / tan if tan else math.inf

    def contacts(self, element_angle: float = 0.0) -> Contacts:
        """All contacts; kinds in the order row 0 slice 0, row 0 slice 1, …."""
        cos, sin = math.cos(self.contact_angle), math.sin(self.contact_angle)
        gap = self.clearance / 2 * cos + 2 * self.profile_drop
        table = [
            [
                self.pitch_diameter / 2 - x * side * sin,
                (row - (self.rows - 1) / 2) * self.row_spacing + x * cos,
                cos,
                side * sin,
                1.0,
                slack,
                self.slice_stiffness,
            ]
            for row, side in enumerate(row_sides(self.rows, self.arrangement))
            for x, slack in zip(self.slice_positions, gap)
        ]
        return Contacts(
            table=np.array(table),
            azimuth=azimuths(self.rollers, element_angle),
            law=LINE,
            spatial=False,
            cap=0.02 * self.roller_diameter,
            lever=self.pitch_diameter / 2,
        )
