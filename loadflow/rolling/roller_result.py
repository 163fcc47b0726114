"""From slice forces of a roller bearing to pressure, safety and life."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from loadflow.rolling.contacts import Array
from loadflow.rolling.rating import capacity, safety
from loadflow.rolling.results import ContactResult

if TYPE_CHECKING:
    from loadflow.rolling.roller_raceways import RollerRaceways


@dataclass(frozen=True)
class RollerResult(ContactResult):
    """Equilibrium of a roller bearing; all quantities over the shape (...) of the load cases.

    Attributes
    ----------
    bearing : RollerRaceways
        The bearing.
    """

    bearing: RollerRaceways

    @property
    def slice_forces(self) -> Array:
        """Forces on the slices, N, (..., row, slice, roller)."""
        shape = (self.bearing.tracks, self.bearing.slices, self.bearing.track_rollers)
        return self._state[0].reshape(*self.cases, *shape)

    @property
    def roller_forces(self) -> Array:
        """Forces on the rollers, N, (..., row, roller); needs no array of all slices."""
        from loadflow.rolling import _forces

        cos, sin, spans, table, *_ = self.contacts.arguments
        q = np.ascontiguousarray(self.displacement.reshape(-1, 5))
        forces = _forces.row_forces(q, cos, sin, spans, table, self.bearing.tracks)
        return forces.reshape(*self.cases, *forces.shape[1:])

    @property
    def maximum_force(self) -> Array:
        """Largest force on a roller, N."""
        return np.asarray(self.roller_forces.max(axis=(-2, -1)))

    @property
    def maximum_pressure(self) -> Array:
        """Largest Hertzian pressure of a slice, Pa, at the inner raceway."""
        largest = self._statistics[0].max(axis=-1)
        return self.bearing.slice_contact("inner", largest).pressure

    @property
    def pressure_safety(self) -> Array:
        """Allowable over largest pressure; infinite without load."""
        bearing = self.bearing
        allowed = bearing.allowable_pressure * safety.hardness_factor(bearing.hardness)
        return safety.ratio(allowed, self.maximum_pressure)

    @property
    def static_safety(self) -> Array:
        """Allowable over largest force on a slice: the square of `pressure_safety`."""
        return np.asarray(self.pressure_safety**2)

    @property
    def reference_life(self) -> Array:
        """Reference life L10r of ISO/TS 16281, millions of revolutions; the inner ring turns.

        From the loads of all slices with the stress concentration of the standard at the ends.
        """
        bearing = self.bearing
        _, sums = self._statistics
        concentration = np.tile(capacity.edge_stress(bearing.slices), bearing.tracks)
        inner, outer = bearing.slice_capacity
        rotating = (sums[..., 1] / bearing.track_rollers) ** (1 / 4) * concentration / inner
        stationary = (sums[..., 2] / bearing.track_rollers) ** (2 / 9) * concentration / outer
        damage = (rotating**4.5 + stationary**4.5).sum(axis=-1)
        return safety.ratio(1.0, damage) ** (8 / 9)

    @property
    def rating_life(self) -> Array:
        """Rating life in millions of revolutions: the reference life."""
        return self.reference_life

    @property
    def equivalent_load(self) -> Array:
        """Dynamic equivalent reference load P_ref = C/L10r^(3/10), N."""
        return np.asarray(self.bearing.rated_capacity / self.reference_life**0.3)
