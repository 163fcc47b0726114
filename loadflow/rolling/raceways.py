"""Balls in grooves: the geometry and contacts that all ball bearings share."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar, Literal

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice, check_fields
from loadflow.rolling.contact_forces import ContactForces
from loadflow.rolling.contacts import Array, Raceway
from loadflow.rolling.geometry import OneClearance
from loadflow.rolling.rating import life, modified_life, safety
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON, hertz_point
from loadflow.tribology.hertz_contact import PointContact


@dataclass(frozen=True, kw_only=True)
class BallRaceways(OneClearance):
    """Balls between the grooves of two rings.

    Attributes
    ----------
    balls : int
        Balls per row.
    ball_diameter, pitch_diameter : float
        m.
    groove_radius : float
        Radius of the raceway grooves across, m; larger than the ball radius.
    contact_angle : float
        Nominal contact angle from the radial plane, rad.
    outer_groove_radius : float, optional
        Groove radius of the outer ring if it differs, m.
    rows : int
        Number of rows, all alike, balls side by side.
    row_spacing : float
        Axial distance of neighbouring rows, m.
    clearance : float
        Internal clearance, m; negative for preload. Its direction is stated by the bearing.
    hardness : float
        Vickers hardness of the raceways; lowers the allowable pressure below 653 HV, (2.8).
    allowable_pressure : float
        Allowable Hertzian pressure at full hardness, Pa (ISO 76: 4.2 GPa).
    dynamic_capacity : float, optional
        Basic dynamic capacity C, N; from the geometry if not given.
    elastic_modulus, poisson_ratio : float
        Of balls and rings, Pa and 1.
    contact_stiffness : float, optional
        Stiffness factor K_A of one ball-raceway contact, N/m^1.5, used for both raceways (the
        source's mean); from Hertz for each raceway if not given.
    curvature : {"exact", "ritzer"}
        Radius of the raceway along the ring: (D_pw/2 ∓ R_w cos α₀)/cos α₀, the normal curvature of
        the torus, or D_pw/2 ∓ R_w as Ritzer.
    shoulder_angle : float, optional
        Angle from the radial plane at which the raceway ends, rad; enables ``truncated``.

    Raises
    ------
    InputError
        If a field is out of its range.
    """

    element: ClassVar[Literal["ball", "roller"]] = "ball"
    life_exponent: ClassVar[float] = life.POINT_EXPONENT
    weibull_slope: ClassVar[float] = modified_life.WEIBULL["ball"]
    static_exponent: ClassVar[int] = 3

    balls: Annotated[int, Ge(2)]
    ball_diameter: Annotated[float, Gt(0)]
    pitch_diameter: Annotated[float, Gt(0)]
    groove_radius: Annotated[float, Gt(0)]
    contact_angle: Annotated[float, Ge(0)]
    outer_groove_radius: Annotated[float, Gt(0)] | None = None
    rows: Annotated[int, Ge(1)] = 1
    row_spacing: Annotated[float, Ge(0)] = 0.0
    clearance: Annotated[float, Gt(-1), Le(1)] = 0.0
    hardness: Annotated[float, Gt(0), Le(1500)] = 700.0
    allowable_pressure: Annotated[float, Gt(0)] = safety.BALL_PRESSURE
    dynamic_capacity: Annotated[float, Gt(0)] | None = None
    elastic_modulus: Annotated[float, Gt(0)] = STEEL_MODULUS
    poisson_ratio: Annotated[float, Ge(0), Le(0.5)] = STEEL_POISSON
    contact_stiffness: Annotated[float, Gt(0)] | None = None
    curvature: Literal["exact", "ritzer"] = "exact"
    shoulder_angle: Annotated[float, Gt(0), Le(math.pi)] | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "curvature", ("exact", "ritzer"))
        radius = self.ball_diameter / 2
        for name in ("groove_radius", "outer_groove_radius"):
            groove = getattr(self, name)
            if groove is not None and groove <= radius:
                raise InputError(
                    f"{name}: must be > half the ball diameter {radius:g} m, got {groove:g}"
                )
        if self.contact_angle >= math.pi / 2:
            raise InputError(f"contact_angle: must be < π/2, got {self.contact_angle:g}")
        if self.pitch_diameter <= self.ball_diameter:
            raise InputError(
                f"pitch_diameter: must be > the ball diameter {self.ball_diameter:g} m, "
                f"got {self.pitch_diameter:g}"
            )
        if self.balls * math.asin(self.ball_diameter / self.pitch_diameter) > math.pi:
            raise InputError(
                f"balls: {self.balls} of {self.ball_diameter:g} m do not fit on a pitch circle of "
                f"{self.pitch_diameter:g} m"
            )

    def groove(self, raceway: Raceway) -> float:
        """Groove radius of a raceway, m."""
        if raceway == "outer" and self.outer_groove_radius is not None:
            return self.outer_groove_radius
        return self.groove_radius

    @property
    def groove_distance(self) -> float:
        """Distance R₀ = r_I + r_A - D_w of the groove centres at touch, m, (2.40)."""
        return self.groove("inner") + self.groove("outer") - self.ball_diameter

    @property
    def gamma(self) -> float:
        """D_w cos α₀/D_pw, (4.10)."""
        return self.ball_diameter * math.cos(self.contact_angle) / self.pitch_diameter

    @property
    def osculation_ratio(self) -> float:
        """r_i (2 r_e - D)/(r_e (2 r_i - D)); 1 for equal grooves."""
        ri, re = self.groove("inner"), self.groove("outer")
        return ri / re * (2 * re - self.ball_diameter) / (2 * ri - self.ball_diameter)

    def raceway_contact(self, raceway: Raceway, force: ArrayLike = 0.0) -> PointContact:
        """Hertzian contact of a ball with one raceway under `force` (N)."""
        sign = 1.0 if raceway == "inner" else -1.0
        along = sign * 2 / self.ball_diameter * self.gamma / (1 - sign * self.gamma)
        if self.curvature == "ritzer":
            along = 2 * sign / (self.pitch_diameter - sign * self.ball_diameter)
        ball = 2 / self.ball_diameter
        return hertz_point(
            ball,
            ball,
            -1 / self.groove(raceway),
            along,
            force=force,
            modulus=self.elastic_modulus,
            poisson=self.poisson_ratio,
        )

    @cached_property
    def series_stiffness(self) -> float:
        """Factor K of F = K ΔR^1.5 for both contacts of a ball in series, N/m^1.5."""
        inner = self.contact_stiffness or float(self.raceway_contact("inner").stiffness)
        outer = self.contact_stiffness or float(self.raceway_contact("outer").stiffness)
        return float((inner ** (-2 / 3) + outer ** (-2 / 3)) ** -1.5)

    def row_heights(self) -> list[float]:
        """Axial position of the rows, m, from the lowest."""
        return [(k - (self.rows - 1) / 2) * self.row_spacing for k in range(self.rows)]

    @property
    def element_diameter(self) -> float:
        """Diameter of the balls, m."""
        return self.ball_diameter

    @property
    def groups(self) -> tuple[int, ...]:
        """The rows."""
        return (self.rows,)

    @property
    def raceway_capacity(self) -> tuple[float, float]:
        """Dynamic capacities Q_ci, Q_ce of the raceways of one row, N (ISO/TS 16281)."""
        raise InputError(f"no capacity of the raceways of a {type(self).__name__}")

    @property
    def allowed_force(self) -> float:
        """Force on a ball at the allowed pressure of the harder loaded raceway, N, (4.3)."""
        unit = max(float(self.raceway_contact(side, 1.0).pressure) for side in ("inner", "outer"))
        return (self.allowed_pressure / unit) ** 3

    @property
    def allowed_pressure(self) -> float:
        """Allowable Hertzian pressure at the hardness of the raceways, Pa, (2.8)."""
        return self.allowable_pressure * safety.hardness_factor(self.hardness)

    def pressure_safety(self, found: ContactForces) -> Array:
        """Allowable over largest pressure; infinite without load."""
        return safety.ratio(self.allowed_pressure, np.max(self.raceway_pressure(found), axis=0))

    def _grouped(self, values: Array) -> Array:
        """Split the axis of kinds into the groups."""
        return values.reshape(*values.shape[:-2], *self.groups, values.shape[-1])

    def element_forces(self, found: ContactForces) -> Array:
        """Contact forces, N, (..., *groups, ball)."""
        return self._grouped(found.forces)

    def contact_angles(self, found: ContactForces) -> Array:
        """Operating contact angles, rad, (..., *groups, ball), positive where they carry +Fz."""
        return self._grouped(found.angles)

    def maximum_force(self, found: ContactForces) -> Array:
        """Largest contact force, N."""
        return np.asarray(found.largest("inner").max(axis=-1))

    def raceway_pressure(self, found: ContactForces) -> tuple[Array, ...]:
        """Largest Hertzian pressure at the inner and at the outer raceway, Pa, (2.1)."""
        return tuple(
            self.raceway_contact(side, found.largest(side).max(axis=-1)).pressure
            for side in ("inner", "outer")
        )

    def reference_life(self, found: ContactForces) -> Array:
        """Reference life L10r of ISO/TS 16281, millions of revolutions; the inner ring turns.

        Each group of contacts has an inner and an outer raceway of its own.
        """
        inner, outer = found.power_sums("inner")[..., 1], found.power_sums("outer")[..., 2]
        return life.ball_reference_life(inner, outer, self.balls, self.raceway_capacity)

    def truncated(self, found: ContactForces) -> NDArray[np.bool_]:
        """Whether a contact ellipse reaches over the shoulder of its raceway.

        Raises
        ------
        InputError
            If the bearing has no `shoulder_angle`.
        """
        if self.shoulder_angle is None:
            raise InputError("shoulder_angle: needed to tell whether a contact is cut off")
        force = self.element_forces(found)
        reach = np.maximum(
            self.raceway_contact("inner", force).semi_axes[0] / self.groove("inner"),
            self.raceway_contact("outer", force).semi_axes[0] / self.groove("outer"),
        )
        edge = self._toward_shoulder(found) + np.arcsin(np.minimum(reach, 1.0))
        axes = tuple(range(-len(self.groups) - 1, 0))
        return np.asarray(((edge > self.shoulder_angle) & (force > 0)).any(axis=axes))

    def _toward_shoulder(self, found: ContactForces) -> Array:
        """Contact angles toward the shoulder that each contact rides on, rad."""
        return np.abs(self.contact_angles(found))
