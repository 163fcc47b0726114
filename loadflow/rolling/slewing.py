"""Four-point ball slewing bearing with one or more rows, [Ritzer 2018]."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Literal

import numpy as np
from annotated_types import Ge, Gt, Le, Lt
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.rolling import life, safety
from loadflow.rolling.contact import Contacts, azimuths
from loadflow.rolling.equilibrium import CHUNK, solve
from loadflow.rolling.options import check_fields
from loadflow.rolling.slewing_result import SlewingResult
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON, PointContact, hertz_point

POINT = 0
DIAGONALS = (1.0, -1.0)  # diagonal 0 carries +Fz on the inner ring, diagonal 1 carries -Fz


@dataclass(frozen=True, kw_only=True)
class SlewingBearing:
    """Geometry, material and limits of a four-point ball bearing.

    Attributes
    ----------
    balls : int
        Balls per row.
    rows : int
        Number of rows, all alike, balls side by side.
    ball_diameter, pitch_diameter : float
        m.
    groove_radius : float
        Radius of the raceway grooves across, m; larger than the ball radius.
    contact_angle : float
        Nominal contact angle from the radial plane, rad.
    row_spacing : float
        Axial distance of neighbouring rows, m.
    clearance : float
        Axial clearance G_a of the centred inner ring, total, m; negative for preload.
    hardness : float
        Vickers hardness of the raceways; lowers the allowable pressure below 653 HV, (2.8).
    allowable_pressure : float
        Allowable Hertzian pressure at full hardness, Pa (ISO 76: 4.2 GPa).
    life_hardness_factor : float
        Factor f_H on the dynamic capacity, (4.11); the source uses 0.85 for 55 HRC.
    dynamic_capacity : float, optional
        Basic dynamic axial capacity C_a, N; from (4.8), (4.9) if not given.
    elastic_modulus, poisson_ratio : float
        Of balls and rings, Pa and 1.
    contact_stiffness : float, optional
        Stiffness factor K_A of one ball-raceway contact, N/m^1.5, used for both raceways (the
        source's mean); from Hertz for each raceway if not given.
    curvature : {"harris", "ritzer"}
        Radius of the raceway along the ring: D_pw/2 ∓ R_w cos α₀ or, as the source, ∓ R_w.
    distance : {"spatial", "meridional"}
        How groove centres move apart. ``"spatial"`` takes the full distance of (2.39), with the
        tangential shift of the rings; ``"meridional"`` takes it within the plane of each ball, as
        Harris and ISO/TS 16281 do, since a ball is free to roll along its groove. They differ
        where radial displacement meets clearance-free grooves: for the source's blade bearing under
        500 kN radial load the spatial distance gives 4 % less force on the hardest loaded ball.
    shoulder_angle : float, optional
        Angle from the radial plane at which the raceway ends, rad; enables `truncated`.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> bearing = SlewingBearing(balls=129, rows=2, ball_diameter=0.040, pitch_diameter=1.9,
    ...     groove_radius=0.0205, contact_angle=math.pi / 4)
    >>> result = bearing.equilibrium(force=(0, 0, 2e6), moment=(0, 0))
    >>> round(float(result.ball_forces.max()))
    10438
    """

    balls: Annotated[int, Ge(3)]
    ball_diameter: Annotated[float, Gt(0)]
    pitch_diameter: Annotated[float, Gt(0)]
    groove_radius: Annotated[float, Gt(0)]
    contact_angle: Annotated[float, Gt(0), Lt(math.pi / 2)]
    rows: Annotated[int, Ge(1)] = 1
    row_spacing: Annotated[float, Ge(0)] = 0.0
    clearance: Annotated[float, Gt(-1)] = 0.0
    hardness: Annotated[float, Gt(0), Le(1500)] = 700.0
    allowable_pressure: Annotated[float, Gt(0)] = safety.BALL_PRESSURE
    life_hardness_factor: Annotated[float, Gt(0), Le(1)] = 1.0
    dynamic_capacity: Annotated[float, Gt(0)] | None = None
    elastic_modulus: Annotated[float, Gt(0)] = STEEL_MODULUS
    poisson_ratio: Annotated[float, Ge(0), Le(0.5)] = STEEL_POISSON
    contact_stiffness: Annotated[float, Gt(0)] | None = None
    curvature: Literal["harris", "ritzer"] = "harris"
    distance: Literal["spatial", "meridional"] = "spatial"
    shoulder_angle: Annotated[float, Gt(0), Le(math.pi)] | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        if self.groove_radius <= self.ball_diameter / 2:
            raise InputError(
                f"groove_radius: must be > half the ball diameter {self.ball_diameter / 2:g} m, "
                f"got {self.groove_radius:g}"
            )
        if self.pitch_diameter <= self.ball_diameter:
            raise InputError(
                f"pitch_diameter: must be > the ball diameter {self.ball_diameter:g} m, "
                f"got {self.pitch_diameter:g}"
            )
        if self.balls * self.ball_diameter > math.pi * self.pitch_diameter:
            raise InputError(
                f"balls: {self.balls} of {self.ball_diameter:g} m do not fit on a pitch circle of "
                f"{self.pitch_diameter:g} m"
            )
        if abs(self.clearance) >= 2 * self.groove_distance * math.sin(self.contact_angle):
            raise InputError(
                f"clearance: |G_a| must be < {2 * self.groove_distance:g} sin α₀ m, "
                f"got {self.clearance:g}"
            )
        for name, allowed in (
            ("curvature", ("harris", "ritzer")),
            ("distance", ("spatial", "meridional")),
        ):
            if getattr(self, name) not in allowed:
                raise InputError(f"{name}: must be one of {allowed}, got {getattr(self, name)!r}")

    @property
    def groove_distance(self) -> float:
        """Distance R₀ of the groove centres at touch, m, (2.40)."""
        return 2 * self.groove_radius - self.ball_diameter

    @property
    def gamma(self) -> float:
        """D_w cos α₀/D_pw, (4.10)."""
        return self.ball_diameter * math.cos(self.contact_angle) / self.pitch_diameter

    def raceway_contact(
        self, raceway: Literal["inner", "outer"], force: ArrayLike = 0.0
    ) -> PointContact:
        """Hertzian contact of a ball with one raceway under `force` (N)."""
        lever = 1.0 if self.curvature == "ritzer" else math.cos(self.contact_angle)
        sign = -1.0 if raceway == "inner" else 1.0
        radius = self.pitch_diameter / 2 + sign * self.ball_diameter / 2 * lever
        ball = 2 / self.ball_diameter
        return hertz_point(
            ball,
            ball,
            -1 / self.groove_radius,
            -sign / radius,
            force=force,
            modulus=self.elastic_modulus,
            poisson=self.poisson_ratio,
        )

    @cached_property
    def series_stiffness(self) -> float:
        """Factor K of F = K ΔR^1.5 for both contacts of a ball in series, N/m^1.5."""
        inner, outer = (
            self.contact_stiffness or float(self.raceway_contact(r).stiffness)
            for r in ("inner", "outer")
        )
        return float((inner ** (-2 / 3) + outer ** (-2 / 3)) ** -1.5)

    @cached_property
    def rated_capacity(self) -> float:
        """Dynamic axial capacity f_H C_a, N: `dynamic_capacity` or (4.8), (4.9), times (4.11)."""
        capacity = self.dynamic_capacity or life.slewing_capacity(
            balls=self.balls,
            rows=self.rows,
            ball_diameter=self.ball_diameter,
            pitch_diameter=self.pitch_diameter,
            contact_angle=self.contact_angle,
            groove_radius=self.groove_radius,
        )
        return self.life_hardness_factor * capacity

    @cached_property
    def raceway_capacity(self) -> tuple[float, float]:
        """Dynamic capacities Q_ci, Q_ce of an inner and an outer raceway, N (ISO/TS 16281).

        The capacity of one row; rows combine in `SlewingResult.reference_life`.
        """
        return life.raceway_capacity_thrust(
            self.rated_capacity / self.rows**0.7, self.balls, self.contact_angle, self.gamma
        )

    def contacts(self, ball_angle: float = 0.0) -> Contacts:
        """All contacts; kinds in the order row 0 diagonal 0, row 0 diagonal 1, row 1 …."""
        cos, sin = math.cos(self.contact_angle), math.sin(self.contact_angle)
        free, arm = self.groove_distance, self.groove_radius - self.ball_diameter / 2
        half = self.clearance / 2
        table = [
            [
                self.pitch_diameter / 2 + arm * cos,
                (row - (self.rows - 1) / 2) * self.row_spacing + sign * arm * sin,
                free * cos,
                sign * (free * sin - half),
                free,
                half**2 - 2 * free * sin * half,
                self.series_stiffness,
            ]
            for row in range(self.rows)
            for sign in DIAGONALS
        ]
        return Contacts(
            table=np.array(table),
            azimuth=azimuths(self.balls, ball_angle),
            law=POINT,
            spatial=self.distance == "spatial",
            cap=0.3 * free,
            lever=self.pitch_diameter / 2,
        )

    def equilibrium(
        self,
        force: ArrayLike,
        moment: ArrayLike = (0.0, 0.0),
        *,
        rings: Literal["rigid"] = "rigid",
        ball_angle: float = 0.0,
        tolerance: float = 1e-10,
        max_iterations: int = 100,
        strict: bool = True,
        chunk: int = CHUNK,
    ) -> SlewingResult:
        """Ball forces, displacement, stiffness, safety and life under given loads.

        Parameters
        ----------
        force : array_like, shape (..., 3)
            (Fx, Fy, Fz) on the inner ring at the bearing centre, N; z is the bearing axis.
        moment : array_like, shape (..., 2)
            (Mx, My) on the inner ring, N m. Broadcasts with `force`.
        rings : {"rigid"}
            How the rings deform.
        ball_angle : float
            Azimuth of the first ball of each row, rad.
        tolerance, max_iterations, strict, chunk
            See `loadflow.rolling.equilibrium.solve`.

        Returns
        -------
        SlewingResult
            Over the shape of the load cases.

        Raises
        ------
        InputError
            If loads are not finite or have wrong shapes, or `rings` is unknown.
        SolverError
            If `strict` and a case has no equilibrium.
        """
        if rings != "rigid":
            raise InputError(f"rings: must be 'rigid', got {rings!r}")
        contacts = self.contacts(ball_angle)
        state = solve(
            contacts,
            force,
            moment,
            tolerance=tolerance,
            max_iterations=max_iterations,
            strict=strict,
            chunk=chunk,
        )
        return SlewingResult(**vars(state), bearing=self, contacts=contacts)
