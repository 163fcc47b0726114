"""Self-aligning spherical roller bearings."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.rolling.contacts import LINE, Contacts, azimuths
from loadflow.rolling.equilibrium import CHUNK
from loadflow.rolling.roller_raceways import RollerRaceways
from loadflow.rolling.roller_result import RollerResult


@dataclass(frozen=True, kw_only=True)
class SphericalRollerBearing(RollerRaceways):
    """Two rows of barrel rollers in a spherical outer raceway: aligns itself, takes no moment.

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

    def contacts(self, roller_angle: float = 0.0) -> Contacts:
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
            azimuth=azimuths(self.rollers, roller_angle),
            law=LINE,
            spatial=False,
            cap=0.02 * self.roller_diameter,
            lever=radius,
        )

    def equilibrium(
        self,
        force: ArrayLike,
        moment: ArrayLike = (0.0, 0.0),
        *,
        roller_angle: float = 0.0,
        tolerance: float = 1e-10,
        max_iterations: int = 100,
        strict: bool = True,
        chunk: int = CHUNK,
    ) -> RollerResult:
        """As `RollerBearing.equilibrium`; the moment must be zero, and the tilt stays at zero.

        ``singular`` is set: nothing resists a tilt.

        Raises
        ------
        InputError
            If a moment is given, or loads are not finite or have wrong shapes.
        SolverError
            If `strict` and a case has no equilibrium.
        """
        if np.any(np.asarray(moment, float) != 0):
            raise InputError("moment: a self-aligning bearing takes none, it must be 0")
        return super().equilibrium(
            force,
            moment,
            roller_angle=roller_angle,
            tolerance=tolerance,
            max_iterations=max_iterations,
            strict=strict,
            chunk=chunk,
        )
