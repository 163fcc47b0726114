"""Rollers in slices with a profile: the geometry and contacts that all roller bearings share."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice, check_fields
from loadflow.rolling.contact_forces import ContactForces
from loadflow.rolling.contacts import Array, Contacts, Raceway
from loadflow.rolling.geometry import OneClearance
from loadflow.rolling.rating import capacity, life, modified_life, safety
from loadflow.tribology.hertz import (
    STEEL_MODULUS,
    STEEL_POISSON,
    effective_modulus,
    hertz_line,
    line_factor,
)
from loadflow.tribology.hertz_contact import LineContact


@dataclass(frozen=True, kw_only=True)
class RollerRaceways(OneClearance):
    """Rollers, cut into slices, between the raceways of two rings.

    Attributes
    ----------
    rollers : int
        Rollers per row.
    roller_diameter : float
        Mean diameter of a roller, m.
    roller_length : float
        Effective length of a roller, m.
    pitch_diameter : float
        Diameter of the circle through the roller centres, m.
    contact_angle : float
        From the radial plane, rad; 0 for cylindrical rollers.
    rows : int
        Number of rows, all alike, rollers side by side.
    row_spacing : float
        Axial distance of neighbouring rows (roller centres), m.
    clearance : float
        Radial internal clearance s (on the diameter), m, negative for preload.
    slices : int
        Slices of a roller.
    profile : {"iso", "crowned", "straight"}
        Drop of the roller's surface: logarithmic after ISO/TS 16281, a circle of `crown_radius`, or
        none.
    crown_radius : float, optional
        Radius of a crowned roller along its axis, m.
    law : {"iso", "palmgren"}
        Deflection of a line contact, see `loadflow.rolling.hertz_line`.
    hardness, allowable_pressure, elastic_modulus, poisson_ratio
        As for ball bearings; the pressure is 4.0 GPa (ISO 76).
    dynamic_capacity : float, optional
        Basic dynamic radial capacity C_r of the bearing, N; ISO 281 from the geometry if not given.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> from loadflow.rolling import RollerRaceways
    >>> row = RollerRaceways(
    ...     rollers=40, roller_diameter=0.04, roller_length=0.038, pitch_diameter=0.9
    ... )
    >>> row.rows, row.slices
    (1, 30)
    """

    element: ClassVar[Literal["ball", "roller"]] = "roller"
    life_exponent: ClassVar[float] = life.LINE_EXPONENT
    weibull_slope: ClassVar[float] = modified_life.WEIBULL["roller"]
    static_exponent: ClassVar[int] = 2

    rollers: Annotated[int, Ge(3)]
    roller_diameter: Annotated[float, Gt(0)]
    roller_length: Annotated[float, Gt(0)]
    pitch_diameter: Annotated[float, Gt(0)]
    contact_angle: Annotated[float, Ge(0), Le(math.pi / 2)] = 0.0
    rows: Annotated[int, Ge(1)] = 1
    row_spacing: Annotated[float, Ge(0)] = 0.0
    clearance: Annotated[float, Gt(-1), Le(1)] = 0.0
    slices: Annotated[int, Ge(1), Le(1000)] = 30
    profile: Literal["iso", "crowned", "straight"] = "iso"
    crown_radius: Annotated[float, Gt(0)] | None = None
    law: Literal["iso", "palmgren"] = "iso"
    hardness: Annotated[float, Gt(0), Le(1500)] = 700.0
    allowable_pressure: Annotated[float, Gt(0)] = safety.ROLLER_PRESSURE
    elastic_modulus: Annotated[float, Gt(0)] = STEEL_MODULUS
    poisson_ratio: Annotated[float, Ge(0), Le(0.5)] = STEEL_POISSON
    dynamic_capacity: Annotated[float, Gt(0)] | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "profile", ("iso", "crowned", "straight"))
        check_choice(self, "law", ("iso", "palmgren"))
        if (self.profile == "crowned") != (self.crown_radius is not None):
            raise InputError("crown_radius: belongs to profile 'crowned', and only to it")
        if self.pitch_diameter <= self.roller_diameter:
            raise InputError(
                f"pitch_diameter: must be > the roller diameter {self.roller_diameter:g} m, "
                f"got {self.pitch_diameter:g}"
            )
        if self.rollers * math.asin(self.roller_diameter / self.pitch_diameter) > math.pi:
            raise InputError(
                f"rollers: {self.rollers} of {self.roller_diameter:g} m do not fit on a pitch "
                f"circle of {self.pitch_diameter:g} m"
            )

    def contacts(self, element_angle: float = 0.0) -> Contacts:
        """All contacts; kinds in the order track 0 slice 0, track 0 slice 1, ….

        Raises
        ------
        InputError
            A row of rollers is no bearing by itself.
        """
        raise InputError(f"{type(self).__name__}: a row of a bearing, no bearing by itself")

    def with_whole_rollers(self) -> Self:
        """Return the rows with rollers of one slice, without profile and tilt."""
        return replace(self, slices=1)

    @property
    def tracks(self) -> int:
        """Sets of rollers that carry alike: the rows."""
        return self.rows

    @property
    def track_rollers(self) -> int:
        """Rollers of each track."""
        return self.rollers

    @property
    def gamma(self) -> float:
        """D_w cos α/D_pw."""
        return self.roller_diameter * math.cos(self.contact_angle) / self.pitch_diameter

    @cached_property
    def slice_positions(self) -> Array:
        """Middles of the slices along the roller, m, from its middle toward +z."""
        return ((np.arange(self.slices) + 0.5) / self.slices - 0.5) * self.roller_length

    @cached_property
    def profile_drop(self) -> Array:
        """Drop P of the roller's surface at each slice, m."""
        return self.drop_at(self.slice_positions)

    def drop_at(self, position: ArrayLike) -> Array:
        """Drop P of the roller's surface at `position` (m) from its middle, m."""
        x, d = np.abs(np.asarray(position, float)), self.roller_diameter
        if self.profile == "straight":
            return np.zeros_like(x)
        if self.crown_radius is not None:
            return x**2 / (2 * self.crown_radius)
        curved, factor = self.roller_length, 0.00035
        if self.roller_length > 2.5 * d:
            curved, factor = 2.5 * d, 0.0005
        inner = np.maximum(2 * x - (self.roller_length - curved), 0.0) / curved
        return factor * d * -np.log1p(-(inner**2))

    @cached_property
    def slice_stiffness(self) -> float:
        """Factor c_s of F = c_s δ^(10/9) of a slice over both contacts, N/m^(10/9)."""
        e_star = effective_modulus(self.elastic_modulus, self.poisson_ratio)
        one = float(line_factor(self.roller_length, e_star, self.law))
        return one * 2 ** (-10 / 9) / self.slices

    @cached_property
    def rated_capacity(self) -> float:
        """Dynamic radial capacity C_r, N: `dynamic_capacity` or ISO 281 from the geometry."""
        return self.dynamic_capacity or capacity.radial_roller_capacity(
            rollers=self.rollers,
            rows=self.rows,
            roller_diameter=self.roller_diameter,
            roller_length=self.roller_length,
            contact_angle=self.contact_angle,
            gamma=self.gamma,
        )

    @property
    def slice_capacity(self) -> tuple[float, float]:
        """Dynamic capacities (q_ci, q_ce) of a slice at the raceways, N (ISO/TS 16281)."""
        return capacity.slice_capacity(
            self.rated_capacity,
            self.rollers,
            self.rows,
            self.slices,
            self.contact_angle,
            self.gamma,
        )

    def slice_contact(self, raceway: Raceway, force: ArrayLike) -> LineContact:
        """Hertzian line contact of a slice under `force` (N) with one raceway."""
        sign = 1.0 if raceway == "inner" else -1.0
        roller = 2 / self.roller_diameter
        return hertz_line(
            roller,
            sign * roller * self.gamma / (1 - sign * self.gamma),
            length=self.roller_length / self.slices,
            force=force,
            modulus=self.elastic_modulus,
            poisson=self.poisson_ratio,
        )

    @property
    def contact_curvature(self) -> float:
        """Curvature of the deformed contacts along the rollers, 1/m; 0 of straight raceways."""
        return 0.0

    @property
    def element_diameter(self) -> float:
        """Diameter of the rollers, m."""
        return self.roller_diameter

    @property
    def groups(self) -> tuple[int, ...]:
        """The tracks."""
        return (self.tracks,)

    @property
    def static_capacity(self) -> float:
        """Basic static radial capacity C₀r of ISO 76, N."""
        return 44e6 * self.loaded_area * math.cos(self.contact_angle) * self.rows

    @property
    def loaded_area(self) -> float:
        """(1 - γ) Z L D of a row, m²."""
        area = self.rollers * self.roller_length * self.roller_diameter
        return (1 - self.gamma) * area

    @property
    def allowed_pressure(self) -> float:
        """Allowable Hertzian pressure at the hardness of the raceways, Pa, (2.8)."""
        return self.allowable_pressure * safety.hardness_factor(self.hardness)

    def pressure_safety(self, found: ContactForces) -> Array:
        """Allowable over largest pressure; infinite without load."""
        return safety.ratio(self.allowed_pressure, np.max(self.raceway_pressure(found), axis=0))

    def element_forces(self, found: ContactForces) -> Array:
        """Forces on the rollers, N, (..., track, roller)."""
        return found.grouped(self.tracks)

    def slice_forces(self, found: ContactForces) -> Array:
        """Forces on the slices, N, (..., track, slice, roller)."""
        forces = found.forces
        return forces.reshape(*forces.shape[:-2], self.tracks, self.slices, self.track_rollers)

    def raceway_pressure(self, found: ContactForces) -> tuple[Array, ...]:
        """Largest Hertzian pressure of a slice at the inner and at the outer raceway, Pa."""
        return tuple(
            self.slice_contact(side, found.largest(side).max(axis=-1)).pressure
            for side in ("inner", "outer")
        )

    def reference_life(self, found: ContactForces) -> Array:
        """Reference life L10r of ISO/TS 16281, millions of revolutions; the inner ring turns.

        From the loads of all slices with the stress concentration of the standard at the ends.
        """
        inner, outer = found.power_sums("inner")[..., 1], found.power_sums("outer")[..., 2]
        concentration = np.tile(capacity.edge_stress(self.slices), self.tracks)
        damage = self.slice_damage(inner, outer, concentration, self.slice_capacity)
        return safety.ratio(1.0, damage) ** (8 / 9)

    def slice_damage(
        self,
        inner: Array,
        outer: Array,
        concentration: Array,
        slice_capacity: tuple[float, float],
    ) -> Array:
        """Sum over the slices of (q/q_c)^4.5 at both raceways, ISO/TS 16281.

        Parameters
        ----------
        inner, outer : ndarray, shape (..., slice)
            ΣF⁴ and ΣF^4.5 over the rollers, N⁴ and N^4.5.
        concentration : ndarray, shape (slice,)
            Stress concentration of each slice.
        slice_capacity : tuple of float
            (q_ci, q_ce), N.
        """
        at_inner, at_outer = slice_capacity
        rotating = (inner / self.track_rollers) ** (1 / 4) * concentration / at_inner
        stationary = (outer / self.track_rollers) ** (2 / 9) * concentration / at_outer
        return np.asarray((rotating**4.5 + stationary**4.5).sum(axis=-1))
