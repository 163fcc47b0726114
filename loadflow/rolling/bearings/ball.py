"""Deep groove and angular contact ball bearings after ISO/TS 16281."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Literal

import numpy as np

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice
from loadflow.rolling.bearings.elements import BearingOfBalls
from loadflow.rolling.contacts import POINT, Contacts, azimuths, row_sides
from loadflow.rolling.friction.skf import CatalogueKind
from loadflow.rolling.geometry import FacingRows
from loadflow.rolling.raceways import BallRaceways
from loadflow.rolling.rating import capacity


@dataclass(frozen=True, kw_only=True)
class BallBearing(FacingRows, BallRaceways, BearingOfBalls):
    """Deep groove (contact angle 0) or angular contact ball bearing, one groove in each ring.

    The fields of `BallRaceways`, where `clearance` is the radial internal clearance s (on the
    diameter), m, `dynamic_capacity` the radial capacity C_r; and:

    Attributes
    ----------
    contact_angle : float
        Nominal contact angle, rad; 0 for deep groove bearings, whose free contact angle
        arccos(1 - s/2A) follows from the clearance.
    arrangement : {"back-to-back", "face-to-face", "tandem"}
        Of two or more rows with a contact angle. A single row, and in back-to-back the row at -z,
        carries +Fz on the inner ring.
    lever : {"groove", "pitch"}
        Radius at which the inner groove centre sits, in displacements and moments alike: where it
        is, or at D_pw/2 (as some programs take it; 1.3 % more tilt and 3 % less life under a pure
        moment on a 6305).

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    A 6305 under 1 kN radial load (ISO/TS 16281 worked case, 15.11 μm):

    >>> bearing = BallBearing(balls=7, ball_diameter=11.5e-3, pitch_diameter=43.5e-3,
    ...     groove_radius=0.52 * 11.5e-3, outer_groove_radius=0.53 * 11.5e-3,
    ...     dynamic_capacity=23_400)
    >>> result = bearing.equilibrium(force=(1000, 0, 0))
    >>> round(float(result.displacement[0]) * 1e6, 2)
    15.11
    """

    kind: ClassVar[str] = "ball"
    words: ClassVar[str] = "ball bearing"
    element_inertia: ClassVar[bool] = True

    contact_angle: float = 0.0
    arrangement: Literal["back-to-back", "face-to-face", "tandem"] = "back-to-back"
    lever: Literal["groove", "pitch"] = "groove"

    def __post_init__(self) -> None:
        super().__post_init__()
        check_choice(self, "arrangement", ("back-to-back", "face-to-face", "tandem"))
        check_choice(self, "lever", ("groove", "pitch"))
        bound = 2 * self.groove_distance * math.cos(self.contact_angle)
        if abs(self.clearance) >= bound:
            raise InputError(f"clearance: must be within ±{bound:g} m, got {self.clearance:g}")

    @property
    def catalogue_kind(self) -> CatalogueKind:
        """Angular contact where the balls have a contact angle without load."""
        return "angular contact" if self.contact_angle > 0 else "deep groove"

    @cached_property
    def rated_capacity(self) -> float:
        """Dynamic radial capacity C_r, N: `dynamic_capacity` or ISO 281 from the geometry."""
        return self.dynamic_capacity or capacity.radial_ball_capacity(
            balls=self.balls,
            rows=self.rows,
            ball_diameter=self.ball_diameter,
            contact_angle=self.contact_angle,
            gamma=self.gamma,
            inner_groove=self.groove("inner"),
            osculation=self.osculation_ratio,
        )

    @property
    def static_capacity(self) -> float:
        """Basic static radial capacity C₀r of ISO 76, N: Hertz's pressure with Stribeck's 5."""
        radial = self.allowed_force * self.rows * self.balls / 5
        return radial * math.cos(self.contact_angle)

    @cached_property
    def raceway_capacity(self) -> tuple[float, float]:
        """Dynamic capacities Q_ci, Q_ce of the raceways of one row, N (ISO/TS 16281)."""
        return capacity.raceway_capacity_radial(
            self.rated_capacity,
            self.balls,
            self.rows,
            self.contact_angle,
            self.gamma,
            self.osculation_ratio,
        )

    def contacts(self, element_angle: float = 0.0) -> Contacts:
        """All contacts, one kind for each row."""
        cos, sin = math.cos(self.contact_angle), math.sin(self.contact_angle)
        free, half = self.groove_distance, self.clearance / 2
        arm = self.groove("inner") - self.ball_diameter / 2 if self.lever == "groove" else 0.0
        sides = row_sides(self.rows, self.arrangement)
        radial = arm * (1 - half / free if sin == 0 else cos)
        table = [
            [
                self.pitch_diameter / 2 + radial,
                height + side * arm * sin,
                free * cos - half,
                side * free * sin,
                free,
                half**2 - 2 * free * cos * half,
                self.series_stiffness,
            ]
            for height, side in zip(self.row_heights(), sides)
        ]
        return Contacts(
            table=np.array(table),
            azimuth=azimuths(self.balls, element_angle),
            law=POINT,
            spatial=False,
            cap=0.3 * free,
            lever=self.pitch_diameter / 2,
        )
