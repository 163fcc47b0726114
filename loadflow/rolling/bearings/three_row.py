"""Three-row roller slewing ring: two axial rows and one radial row."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from annotated_types import Gt, Le

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields
from loadflow.rolling.bearings.base import RollingBearing
from loadflow.rolling.contact_forces import ContactForces
from loadflow.rolling.contacts import LINE, Array, Contacts, azimuths
from loadflow.rolling.rating import capacity, life, modified_life, safety
from loadflow.rolling.roller_raceways import RollerRaceways


@dataclass(frozen=True, kw_only=True)
class ThreeRowRollerBearing(RollingBearing):
    """Slewing ring whose two axial rows carry thrust and moment, and whose radial row the rest.

    Attributes
    ----------
    support : RollerRaceways
        Axial row that carries +Fz on the inner ring; its contact angle is 90° whatever it says.
    retaining : RollerRaceways
        Axial row that carries -Fz.
    radial : RollerRaceways
        Radial row, contact angle 0, in the middle; its `clearance` is radial, on the diameter.
    axial_clearance : float
        Total axial clearance between the two axial rows, m; negative for preload.

    Raises
    ------
    InputError
        If a field is out of its range, or a row is more than one.

    Examples
    --------
    >>> axial = RollerRaceways(rollers=150, roller_diameter=0.05, roller_length=0.05,
    ...     pitch_diameter=3.0)
    >>> radial = RollerRaceways(rollers=160, roller_diameter=0.032, roller_length=0.04,
    ...     pitch_diameter=3.0)
    >>> ring = ThreeRowRollerBearing(support=axial, retaining=axial, radial=radial)
    >>> ring.equilibrium((2e5, 0, 8e5), (0, 2e6)).roller_forces.shape
    (3, 160)
    """

    kind: ClassVar[str] = "three-row"
    words: ClassVar[str] = "three-row roller bearing"
    element: ClassVar[Literal["ball", "roller"]] = "roller"
    life_exponent: ClassVar[float] = life.LINE_EXPONENT
    weibull_slope: ClassVar[float] = modified_life.WEIBULL["roller"]
    static_exponent: ClassVar[int] = 2
    rated_axially: ClassVar[bool] = True

    support: RollerRaceways
    retaining: RollerRaceways
    radial: RollerRaceways
    axial_clearance: Annotated[float, Gt(-1), Le(1)] = 0.0

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("support", "retaining", "radial"):
            rows = getattr(self, name).rows
            if rows != 1:
                raise InputError(f"{name}: must have one row, got {rows}")

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        for name, angle in (("support", "90°"), ("retaining", "90°"), ("radial", "0")):
            yield f"{name}.contact_angle", f"the rollers of this row lie at {angle}"
        for name in ("support", "retaining"):
            yield f"{name}.clearance", "axial_clearance is that of both axial rows"

    @cached_property
    def rows(self) -> tuple[RollerRaceways, RollerRaceways, RollerRaceways]:
        """The rows with their contact angles: support, retaining, radial."""
        return (
            replace(self.support, contact_angle=math.pi / 2),
            replace(self.retaining, contact_angle=math.pi / 2),
            replace(self.radial, contact_angle=0.0),
        )

    def with_whole_rollers(self) -> Self:
        """Return the bearing with rollers of one slice, without profile and tilt."""
        rows = ("support", "retaining", "radial")
        return replace(self, **{name: getattr(self, name).with_whole_rollers() for name in rows})

    @property
    def pitch_diameter(self) -> float:
        """Pitch diameter of the support row, m."""
        return self.support.pitch_diameter

    @cached_property
    def rated_capacity(self) -> float:
        """Dynamic axial capacity C_a of the support row, N."""
        return _axial_capacity(self.rows[0])

    @cached_property
    def slice_capacities(self) -> tuple[tuple[float, float], ...]:
        """Dynamic capacities (q_ci, q_ce) of a slice of each row, N (ISO/TS 16281)."""
        *axial, radial = self.rows
        return (
            *(
                capacity.slice_capacity_thrust(
                    _axial_capacity(r), r.rollers, r.slices, r.contact_angle, _gamma(r)
                )
                for r in axial
            ),
            radial.slice_capacity,
        )

    def contacts(self, element_angle: float = 0.0) -> Contacts:
        """All contacts; kinds in the order support slice 0, 1, …, retaining, radial."""
        lines, around, spans, first = [], [], [], 0
        for row, axial in zip(self.rows, (1.0, -1.0, 0.0)):
            clearance = self.axial_clearance if axial else row.clearance
            around.append(azimuths(row.rollers, element_angle))
            for x, drop in zip(row.slice_positions, row.profile_drop):
                radius, height = (x, 0.0) if axial else (0.0, x)
                gap = clearance / 2 + 2 * drop
                place = [row.pitch_diameter / 2 + radius, height, 1.0 - abs(axial), axial]
                lines.append([*place, 1.0, gap, row.slice_stiffness])
                spans.append([first, first + row.rollers])
            first += row.rollers
        return Contacts(
            table=np.array(lines),
            azimuth=np.concatenate(around),
            law=LINE,
            spatial=False,
            cap=0.02 * min(row.roller_diameter for row in self.rows),
            lever=self.pitch_diameter / 2,
            spans=np.array(spans),
        )

    @property
    def groups(self) -> tuple[int, ...]:
        """Support, retaining and radial row."""
        return (3,)

    @property
    def static_capacity(self) -> float:
        """Basic static axial capacity C₀a of the support row, N (ISO 76)."""
        return 220e6 * self.rows[0].loaded_area

    @cached_property
    def _kinds(self) -> list[slice]:
        """Kinds of contact of each row."""
        ends = np.cumsum([0, *(row.slices for row in self.rows)])
        return [slice(a, b) for a, b in pairwise(ends)]

    def row_forces(self, found: ContactForces) -> tuple[Array, ...]:
        """Forces on the rollers of support, retaining and radial row, N, (..., roller)."""
        forces = found.forces
        return tuple(
            forces[..., kinds, : row.rollers].sum(axis=-2)
            for kinds, row in zip(self._kinds, self.rows)
        )

    def element_forces(self, found: ContactForces) -> Array:
        """Forces on the rollers, N, (..., row, roller), short rows padded with zeros."""
        rows = self.row_forces(found)
        most = max(row.shape[-1] for row in rows)
        wide = [np.pad(r, [(0, 0)] * (r.ndim - 1) + [(0, most - r.shape[-1])]) for r in rows]
        return np.stack(wide, axis=-2)

    def maximum_force(self, found: ContactForces) -> Array:
        """Largest force on a roller, N."""
        return np.max([force.max(axis=-1) for force in self.row_forces(found)], axis=0)

    def raceway_pressure(self, found: ContactForces) -> tuple[Array, ...]:
        """Largest Hertzian pressure of a slice of support, retaining and radial row, Pa."""
        largest = found.largest("inner")
        return tuple(
            row.slice_contact("inner", largest[..., kinds].max(axis=-1)).pressure
            for kinds, row in zip(self._kinds, self.rows)
        )

    def pressure_safety(self, found: ContactForces) -> Array:
        """Smallest of allowable over largest pressure of the rows; infinite without load."""
        rows = zip(self.rows, self.raceway_pressure(found))
        return np.min([safety.ratio(row.allowed_pressure, p) for row, p in rows], axis=0)

    def reference_life(self, found: ContactForces) -> Array:
        """Reference life L10r of all raceways of all rows together, millions of revolutions."""
        inner, outer = found.power_sums("inner")[..., 1], found.power_sums("outer")[..., 2]
        damage = sum(
            row.slice_damage(
                inner[..., kinds], outer[..., kinds], capacity.edge_stress(row.slices), rated
            )
            for kinds, row, rated in zip(self._kinds, self.rows, self.slice_capacities)
        )
        return safety.ratio(1.0, np.asarray(damage)) ** (8 / 9)


def _gamma(row: RollerRaceways) -> float:
    """D_w/D_pw of an axial row, which at 90° stands for D_w cos α/D_pw."""
    return row.roller_diameter / row.pitch_diameter


def _axial_capacity(row: RollerRaceways) -> float:
    return row.dynamic_capacity or capacity.thrust_roller_capacity(
        rollers=row.rollers,
        roller_diameter=row.roller_diameter,
        roller_length=row.roller_length,
        contact_angle=row.contact_angle,
        gamma=_gamma(row),
    )
