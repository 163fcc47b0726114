"""Slewing ring of crossed rollers."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from loadflow.errors import InputError
from loadflow.rolling.bearings.base import RollingBearing, TorqueModel
from loadflow.rolling.contacts import LINE, Contacts, azimuths
from loadflow.rolling.friction import FRICTION_FACTORS
from loadflow.rolling.rating import capacity
from loadflow.rolling.roller_raceways import RollerRaceways


@dataclass(frozen=True, kw_only=True)
class CrossedRollerBearing(RollerRaceways, RollingBearing):
    """Slewing ring with one circle of rollers whose axes are crossed in turn.

    Each second roller carries +Fz on the inner ring (track 0), the others -Fz (track 1). The fields
    of `RollerRaceways`, where `rollers` counts both tracks, `contact_angle` is 45° unless given,
    `clearance` is radial, and `dynamic_capacity` is the axial capacity C_a of one track.

    Raises
    ------
    InputError
        If a field is out of its range, or rollers cannot be crossed in pairs.

    Examples
    --------
    >>> ring = CrossedRollerBearing(rollers=180, roller_diameter=0.04, roller_length=0.038,
    ...     pitch_diameter=2.6)
    >>> ring.equilibrium(force=(1e5, 0, 5e5), moment=(0, 4e5)).roller_forces.shape
    (2, 90)
    """

    kind: ClassVar[str] = "crossed"
    words: ClassVar[str] = "crossed roller bearing"
    group_dims: ClassVar[tuple[str, ...]] = ("track",)
    rated_axially: ClassVar[bool] = True
    torque_models: ClassVar[Mapping[TorqueModel, float]] = {
        "loads": FRICTION_FACTORS["crossed rollers"]
    }

    contact_angle: float = math.pi / 4

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.rollers % 2 or self.rollers < 6:
            raise InputError(f"rollers: must be even and at least 6, got {self.rollers}")
        if self.rows != 1 or self.row_spacing:
            raise InputError("rows: crossed rollers have one row; leave rows and row_spacing out")
        if not 0 < self.contact_angle < math.pi / 2:
            raise InputError(
                f"contact_angle: must lie between 0 and π/2, got {self.contact_angle:g}"
            )
        if self.roller_length > self.roller_diameter:
            raise InputError(
                f"roller_length: crossed rollers must not be longer than thick, "
                f"{self.roller_diameter:g} m, got {self.roller_length:g}"
            )

    @property
    def tracks(self) -> int:
        """Two: rollers that carry +Fz, and rollers that carry -Fz."""
        return 2

    @property
    def track_rollers(self) -> int:
        """Rollers of each track: every second one."""
        return self.rollers // 2

    @cached_property
    def rated_capacity(self) -> float:
        """Axial capacity C_a of one track, N: `dynamic_capacity` or ISO 281 from the geometry."""
        return self.dynamic_capacity or capacity.thrust_roller_capacity(
            rollers=self.track_rollers,
            roller_diameter=self.roller_diameter,
            roller_length=self.roller_length,
            contact_angle=self.contact_angle,
            gamma=self.gamma,
        )

    @property
    def static_capacity(self) -> float:
        """Basic static axial capacity C₀a of one track, N (ISO 76)."""
        return 220e6 * self.loaded_area / 2 * math.sin(self.contact_angle)

    @property
    def slice_capacity(self) -> tuple[float, float]:
        """Dynamic capacities (q_ci, q_ce) of a slice at the raceways, N (ISO/TS 16281)."""
        return capacity.slice_capacity_thrust(
            self.rated_capacity, self.track_rollers, self.slices, self.contact_angle, self.gamma
        )

    def contacts(self, element_angle: float = 0.0) -> Contacts:
        """All contacts; kinds in the order track 0 slice 0, track 0 slice 1, …."""
        cos, sin = math.cos(self.contact_angle), math.sin(self.contact_angle)
        gap = self.clearance / 2 * cos + 2 * self.profile_drop
        table = [
            [
                self.pitch_diameter / 2 - x * side * sin,
                x * cos,
                cos,
                side * sin,
                1.0,
                slack,
                self.slice_stiffness,
            ]
            for side in (1.0, -1.0)
            for x, slack in zip(self.slice_positions, gap)
        ]
        around = azimuths(self.rollers, element_angle)
        half = self.track_rollers
        spans = np.repeat(np.array([[0, half], [half, 2 * half]]), self.slices, axis=0)
        return Contacts(
            table=np.array(table),
            azimuth=np.concatenate([around[::2], around[1::2]]),
            law=LINE,
            spatial=False,
            cap=0.02 * self.roller_diameter,
            lever=self.pitch_diameter / 2,
            spans=spans,
        )
