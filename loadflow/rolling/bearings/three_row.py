"""Three-row roller slewing ring: two axial rows and one radial row."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Annotated

import numpy as np
from annotated_types import Gt, Le
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields
from loadflow.rolling.contacts import LINE, Array, Contacts, azimuths
from loadflow.rolling.equilibrium import CHUNK, solve
from loadflow.rolling.rating import capacity, safety
from loadflow.rolling.results import ContactResult
from loadflow.rolling.roller_raceways import RollerRaceways


@dataclass(frozen=True, kw_only=True)
class ThreeRowRollerBearing:
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
    >>> [f.shape for f in ring.equilibrium((2e5, 0, 8e5), (0, 2e6)).roller_forces]
    [(150,), (150,), (160,)]
    """

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

    @cached_property
    def rows(self) -> tuple[RollerRaceways, RollerRaceways, RollerRaceways]:
        """The rows with their contact angles: support, retaining, radial."""
        return (
            replace(self.support, contact_angle=math.pi / 2),
            replace(self.retaining, contact_angle=math.pi / 2),
            replace(self.radial, contact_angle=0.0),
        )

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

    def contacts(self, roller_angle: float = 0.0) -> Contacts:
        """All contacts; kinds in the order support slice 0, 1, …, retaining, radial."""
        lines, around, spans, first = [], [], [], 0
        for row, axial in zip(self.rows, (1.0, -1.0, 0.0)):
            clearance = self.axial_clearance if axial else row.clearance
            around.append(azimuths(row.rollers, roller_angle))
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
    ) -> ThreeRowResult:
        """Roller forces, displacement, stiffness, safety and life, as `RollerBearing.equilibrium`.

        Raises
        ------
        InputError
            If loads are not finite or have wrong shapes.
        SolverError
            If `strict` and a case has no equilibrium.
        """
        contacts = self.contacts(roller_angle)
        state = solve(
            contacts,
            force,
            moment,
            tolerance=tolerance,
            max_iterations=max_iterations,
            strict=strict,
            chunk=chunk,
        )
        return ThreeRowResult(**vars(state), bearing=self, contacts=contacts)


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


@dataclass(frozen=True)
class ThreeRowResult(ContactResult):
    """Equilibrium of a three-row slewing ring; quantities over the shape (...) of the load cases.

    Attributes
    ----------
    bearing : ThreeRowRollerBearing
        The bearing.
    """

    bearing: ThreeRowRollerBearing

    @cached_property
    def _kinds(self) -> list[slice]:
        """Kinds of contact of each row."""
        ends = np.cumsum([0, *(row.slices for row in self.bearing.rows)])
        return [slice(a, b) for a, b in pairwise(ends)]

    @property
    def roller_forces(self) -> tuple[Array, ...]:
        """Forces on the rollers of support, retaining and radial row, N, (..., roller)."""
        forces = self._state[0]
        return tuple(
            forces[..., kinds, : row.rollers].sum(axis=-2)
            for kinds, row in zip(self._kinds, self.bearing.rows)
        )

    @property
    def maximum_force(self) -> Array:
        """Largest force on a roller, N."""
        return np.max([force.max(axis=-1) for force in self.roller_forces], axis=0)

    @property
    def row_pressures(self) -> tuple[Array, ...]:
        """Largest Hertzian pressure of a slice of support, retaining and radial row, Pa."""
        largest = self._statistics[0]
        return tuple(
            row.slice_contact("inner", largest[..., kinds].max(axis=-1)).pressure
            for kinds, row in zip(self._kinds, self.bearing.rows)
        )

    @property
    def maximum_pressure(self) -> Array:
        """Largest Hertzian pressure of all rows, Pa."""
        return np.max(self.row_pressures, axis=0)

    @property
    def pressure_safety(self) -> Array:
        """Smallest of allowable over largest pressure of the rows; infinite without load."""
        allowed = (
            row.allowable_pressure * safety.hardness_factor(row.hardness)
            for row in self.bearing.rows
        )
        return np.min([safety.ratio(a, p) for a, p in zip(allowed, self.row_pressures)], axis=0)

    @property
    def static_safety(self) -> Array:
        """Allowable over largest force on a slice: the square of `pressure_safety`."""
        return np.asarray(self.pressure_safety**2)

    @property
    def reference_life(self) -> Array:
        """Reference life L10r of all raceways of all rows together, millions of revolutions."""
        _, sums = self._statistics
        damage = np.zeros(self.cases)
        for kinds, row, (inner, outer) in zip(
            self._kinds, self.bearing.rows, self.bearing.slice_capacities
        ):
            concentration = capacity.edge_stress(row.slices)
            rotating = (sums[..., kinds, 1] / row.rollers) ** (1 / 4) * concentration / inner
            stationary = (sums[..., kinds, 2] / row.rollers) ** (2 / 9) * concentration / outer
            damage = damage + (rotating**4.5 + stationary**4.5).sum(axis=-1)
        return safety.ratio(1.0, damage) ** (8 / 9)

    @property
    def rating_life(self) -> Array:
        """Rating life in millions of revolutions: the reference life."""
        return self.reference_life

    @property
    def equivalent_load(self) -> Array:
        """Dynamic equivalent reference load P_ref = C_a/L10r^(3/10), N."""
        return np.asarray(self.bearing.rated_capacity / self.reference_life**0.3)
