"""Deep groove and angular contact ball bearings after ISO/TS 16281."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice
from loadflow.rolling.contacts import POINT, Array, Contacts, azimuths, row_sides
from loadflow.rolling.equilibrium import CHUNK, solve
from loadflow.rolling.motion.spinning import Spin, spin_equilibrium
from loadflow.rolling.raceways import BallRaceways
from loadflow.rolling.rating import capacity, life
from loadflow.rolling.results import BallResult


@dataclass(frozen=True, kw_only=True)
class BallBearing(BallRaceways):
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

    def contacts(self, ball_angle: float = 0.0) -> Contacts:
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
            azimuth=azimuths(self.balls, ball_angle),
            law=POINT,
            spatial=False,
            cap=0.3 * free,
            lever=self.pitch_diameter / 2,
        )

    def equilibrium(
        self,
        force: ArrayLike,
        moment: ArrayLike = (0.0, 0.0),
        *,
        speed: ArrayLike | None = None,
        ball_angle: float = 0.0,
        tolerance: float = 1e-10,
        max_iterations: int = 100,
        strict: bool = True,
        chunk: int = CHUNK,
    ) -> BallBearingResult:
        """Ball forces, displacement, stiffness, safety and life under given loads.

        Parameters
        ----------
        force : array_like, shape (..., 3)
            (Fx, Fy, Fz) on the inner ring at the bearing centre, N; z is the bearing axis.
        moment : array_like, shape (..., 2)
            (Mx, My) on the inner ring, N m. Broadcasts with `force`.
        speed : array_like, optional
            Of the inner ring, rad/s; switches centrifugal and gyroscopic loads of the balls on.
        ball_angle : float
            Azimuth of the first ball of each row, rad.
        tolerance, max_iterations, strict, chunk
            See `loadflow.rolling.equilibrium.solve`.

        Returns
        -------
        BallBearingResult
            Over the shape of the load cases; a `SpinningResult` at a speed. The axial displacement
            counts from the centred position of a deep groove bearing.

        Raises
        ------
        InputError
            If loads are not finite or have wrong shapes.
        SolverError
            If `strict` and a case has no equilibrium.
        """
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
        if speed is None:
            return BallBearingResult(**vars(state), bearing=self, contacts=contacts)
        rings, spin = spin_equilibrium(
            self,
            contacts,
            state,
            speed,
            tolerance=max(tolerance, 1e-9),
            max_iterations=max_iterations,
        )
        known = vars(state) | rings
        return SpinningResult(**known, bearing=self, contacts=contacts, spin=spin)


@dataclass(frozen=True)
class BallBearingResult(BallResult):
    """Equilibrium of a ball bearing; all quantities over the shape (...) of the load cases.

    Attributes
    ----------
    bearing : BallBearing
        The bearing.
    """

    bearing: BallBearing

    @property
    def ball_forces(self) -> Array:
        """Contact forces, N, (..., row, ball)."""
        return self._state[0]

    @property
    def contact_angles(self) -> Array:
        """Operating contact angles, rad, (..., row, ball), positive where they carry +Fz."""
        return self._state[1]

    @property
    def truncated(self) -> NDArray[np.bool_]:
        """Whether a contact ellipse reaches over the raceway's shoulder.

        Raises
        ------
        InputError
            If the bearing has no `shoulder_angle`.
        """
        return self._truncated(self.ball_forces, np.abs(self.contact_angles), (-2, -1))

    @property
    def reference_life(self) -> Array:
        """Reference life L10r of ISO/TS 16281, millions of revolutions; the inner ring turns."""
        _, sums = self._statistics
        return life.ball_reference_life(
            sums[..., 1], sums[..., 2], self.bearing.balls, self.bearing.raceway_capacity
        )

    @property
    def rating_life(self) -> Array:
        """Rating life in millions of revolutions: the reference life."""
        return self.reference_life

    @property
    def equivalent_load(self) -> Array:
        """Dynamic equivalent reference load P_ref = C/L10r^(1/3), N."""
        return np.asarray(self.bearing.rated_capacity / np.cbrt(self.reference_life))


@dataclass(frozen=True)
class SpinningResult(BallBearingResult):
    """Equilibrium of a ball bearing at speed; contact forces and angles are those of the inner.

    Attributes
    ----------
    spin : Spin
        Forces and angles at both raceways, loads of inertia.
    """

    spin: Spin

    @cached_property
    def _state(self) -> tuple[Array, Array]:
        return self.spin.inner_forces, self.spin.inner_angles

    @cached_property
    def _statistics(self) -> tuple[Array, Array]:
        force = self.spin.inner_forces
        sums = [(force**power).sum(axis=-1) for power in (1, 3, 10 / 3)]
        return force.max(axis=-1), np.stack(sums, axis=-1)

    @property
    def raceway_pressure(self) -> tuple[Array, Array]:
        """Largest Hertzian pressure at the inner and at the outer raceway, Pa."""
        inner, outer = (
            force.max(axis=(-2, -1)) for force in (self.spin.inner_forces, self.spin.outer_forces)
        )
        return (
            self.bearing.raceway_contact("inner", inner).pressure,
            self.bearing.raceway_contact("outer", outer).pressure,
        )

    @property
    def reference_life(self) -> Array:
        """Reference life L10r of ISO/TS 16281 with the forces of each raceway, 10⁶ revolutions."""
        return life.ball_reference_life(
            (self.spin.inner_forces**3).sum(axis=-1),
            (self.spin.outer_forces ** (10 / 3)).sum(axis=-1),
            self.bearing.balls,
            self.bearing.raceway_capacity,
        )
