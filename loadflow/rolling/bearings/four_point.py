"""Four-point ball slewing bearing with one or more rows, [Ritzer 2018]."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar, Literal

import numpy as np
from annotated_types import Gt, Le

from loadflow.errors import InputError, ValidityWarning
from loadflow.numerics.fields import check_choice
from loadflow.rolling.bearings.base import TorqueModel
from loadflow.rolling.bearings.elements import BearingOfBalls
from loadflow.rolling.contact_forces import ContactForces
from loadflow.rolling.contacts import POINT, Array, Contacts, azimuths
from loadflow.rolling.friction import FRICTION_FACTORS
from loadflow.rolling.friction.skf import CatalogueKind
from loadflow.rolling.raceways import BallRaceways
from loadflow.rolling.rating import capacity, life, safety
from loadflow.rolling.rings.coupling import PointCoupling

DIAGONALS = (1.0, -1.0)  # diagonal 0 carries +Fz on the inner ring, diagonal 1 carries -Fz


@dataclass(frozen=True, kw_only=True)
class SlewingBearing(BallRaceways, BearingOfBalls):
    """Four-point ball bearing: two grooves in each ring, two diagonals of contact on each ball.

    The fields of `BallRaceways`, where `clearance` is the axial clearance G_a of the centred inner
    ring, total, m, and `dynamic_capacity` the axial capacity C_a; and:

    Attributes
    ----------
    life_hardness_factor : float
        Factor f_H on the dynamic capacity, (4.11); Ritzer uses 0.85 for 55 HRC. `hardness` does not
        set it, as his curve is not at hand: soft raceways with 1 are warned of.
    distance : {"spatial", "meridional"}
        How groove centres move apart. ``"spatial"`` takes the full distance of (2.39), with the
        tangential shift of the rings; ``"meridional"`` takes it within the plane of each ball, as
        Harris and ISO/TS 16281 do, since a ball is free to roll along its groove. They differ
        where radial displacement meets grooves without clearance: for Ritzer's blade bearing
        under 500 kN radial load the spatial distance gives 4 % less force on the hardest loaded
        ball.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> bearing = SlewingBearing(balls=129, rows=2, ball_diameter=0.040, pitch_diameter=1.9,
    ...     groove_radius=0.0205, contact_angle=math.pi / 4)
    >>> result = bearing.equilibrium(force=(0, 0, 2e6))
    >>> round(float(result.ball_forces.max()))
    10438
    """

    kind: ClassVar[str] = "slewing"
    words: ClassVar[str] = "four-point ball bearing"
    group_dims: ClassVar[tuple[str, ...]] = ("row", "diagonal")
    rated_axially: ClassVar[bool] = True
    flexible_rings: ClassVar[bool] = True
    torque_models: ClassVar[Mapping[TorqueModel, float]] = {
        "forces": 0.005,
        "loads": FRICTION_FACTORS["balls with cage"],
        "equivalent": 0.0024,
    }

    life_hardness_factor: Annotated[float, Gt(0), Le(1)] = 1.0
    distance: Literal["spatial", "meridional"] = "spatial"

    def __post_init__(self) -> None:
        super().__post_init__()
        check_choice(self, "distance", ("spatial", "meridional"))
        if self.contact_angle == 0:
            raise InputError("contact_angle: must be > 0 for a four-point bearing, got 0")
        bound = 2 * self.groove_distance * math.sin(self.contact_angle)
        if abs(self.clearance) >= bound:
            raise InputError(f"clearance: |G_a| must be < {bound:g} m, got {self.clearance:g}")

    @property
    def catalogue_kind(self) -> CatalogueKind:
        """Four-point; catalogues have those of one row."""
        return "four-point"

    @cached_property
    def rated_capacity(self) -> float:
        """Dynamic axial capacity f_H C_a, N: `dynamic_capacity` or (4.8), (4.9), times (4.11)."""
        soft = safety.hardness_factor(self.hardness) < 1.0
        if soft and self.life_hardness_factor == 1.0 and self.dynamic_capacity is None:
            warnings.warn(
                f"hardness = {self.hardness:g} HV lowers the static rating, while "
                "life_hardness_factor = 1 leaves the life that of hard raceways; 55 HRC (600 HV) "
                "has 0.85 [Ritzer 2018]",
                ValidityWarning,
                stacklevel=2,
            )
        value = self.dynamic_capacity or capacity.slewing_capacity(
            balls=self.balls,
            rows=self.rows,
            ball_diameter=self.ball_diameter,
            pitch_diameter=self.pitch_diameter,
            contact_angle=self.contact_angle,
            groove_radius=max(self.groove("inner"), self.groove("outer")),
        )
        return self.life_hardness_factor * value

    @property
    def static_capacity(self) -> float:
        """Basic static axial capacity C₀a, N: every ball at the allowed pressure (4.3)."""
        balls = self.rows * self.balls
        return self.allowed_force * balls * math.sin(self.contact_angle)

    @cached_property
    def raceway_capacity(self) -> tuple[float, float]:
        """Dynamic capacities Q_ci, Q_ce of the raceways of one row, N (ISO/TS 16281)."""
        return capacity.raceway_capacity_thrust(
            self.rated_capacity / self.rows**0.7,
            self.balls,
            self.contact_angle,
            self.gamma,
            self.osculation_ratio,
        )

    @property
    def clearance_share(self) -> float:
        """Share of the axial clearance that lies along the normals of both contacts."""
        return math.sin(self.contact_angle)

    def ring_coupling(self, element_angle: float = 0.0) -> PointCoupling:
        """How balls feel flexible rings, the first one of each row at an azimuth, rad."""
        return PointCoupling(self, element_angle)

    @property
    def groups(self) -> tuple[int, ...]:
        """Rows, and the diagonals of each: 0 carries +Fz on the inner ring, 1 carries -Fz."""
        return (self.rows, 2)

    def contacts(self, element_angle: float = 0.0) -> Contacts:
        """All contacts; kinds in the order row 0 diagonal 0, row 0 diagonal 1, row 1 …."""
        cos, sin = math.cos(self.contact_angle), math.sin(self.contact_angle)
        free, arm = self.groove_distance, self.groove("inner") - self.ball_diameter / 2
        half = self.clearance / 2
        table = [
            [
                self.pitch_diameter / 2 + arm * cos,
                height + sign * arm * sin,
                free * cos,
                sign * (free * sin - half),
                free,
                half**2 - 2 * free * sin * half,
                self.series_stiffness,
            ]
            for height in self.row_heights()
            for sign in DIAGONALS
        ]
        return Contacts(
            table=np.array(table),
            azimuth=azimuths(self.balls, element_angle),
            law=POINT,
            spatial=self.distance == "spatial",
            cap=0.3 * free,
            lever=self.pitch_diameter / 2,
        )

    def contact_angles(self, found: ContactForces) -> Array:
        """Operating contact angles, rad, (..., row, diagonal, ball), (2.44).

        Counted from the radial plane, positive toward the side of each diagonal.
        """
        return super().contact_angles(found) * np.array(DIAGONALS)[:, None]

    def _toward_shoulder(self, found: ContactForces) -> Array:
        """Contact angles, which count toward the shoulder of each diagonal already, rad."""
        return self.contact_angles(found)

    def equivalent_load(self, found: ContactForces) -> Array:
        """Equivalent axial load P_ea, N, over all balls and both diagonals, (4.4)."""
        cubes = found.power_sums("inner")[..., 1].sum(axis=-1)
        return life.equivalent_axial_load(cubes, self.balls * self.rows, self.contact_angle)

    def rating_life(self, found: ContactForces) -> Array:
        """Basic rating life L10, millions of revolutions, (2.19), with f_H C_a of (4.8)–(4.11)."""
        return life.rating_life(self.rated_capacity, self.equivalent_load(found))
