"""Forces of all contacts of a bearing: what follows from where its inner ring has come to rest."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from loadflow.rolling.contacts import Array, Contacts, Raceway


class ContactForces(Protocol):
    """Forces between rolling elements and raceways, under load cases (...).

    Statistics need no array of all contact forces, so that a series of any length fits in memory.
    """

    @property
    def forces(self) -> Array:
        """Force of each contact at the inner raceway, N, (..., kind, element)."""

    @property
    def angles(self) -> Array:
        """Signed angle of each contact from the radial plane, rad, (..., kind, element)."""

    def largest(self, raceway: Raceway) -> Array:
        """Largest force of each kind of contact, N, (..., kind)."""

    def power_sums(self, raceway: Raceway) -> Array:
        """Sums of powers of the forces, (..., kind, 3).

        The powers are 1, 3, 10/3 of points and 1, 4, 9/2 of lines.
        """

    def grouped(self, groups: int) -> Array:
        """Forces on whole elements, N, (..., group, element): the sum over the kinds of a group."""


@dataclass(frozen=True)
class RigidRingForces:
    """Forces of contacts between two rigid rings.

    Attributes
    ----------
    contacts : Contacts
        The bearing's contacts.
    displacement : ndarray, shape (..., 5)
        (ux, uy, uz, θx, θy) of the inner ring relative to the outer, m and rad.
    """

    contacts: Contacts
    displacement: Array

    @property
    def _cases(self) -> tuple[int, ...]:
        return self.displacement.shape[:-1]

    @cached_property
    def _rows(self) -> Array:
        """Displacements as one series, (case, 5)."""
        return np.ascontiguousarray(self.displacement.reshape(-1, 5))

    @cached_property
    def _state(self) -> tuple[Array, Array]:
        from loadflow.rolling import _forces

        force, angle = _forces.contact_state(self._rows, *self.contacts.arguments)
        shape = (*self._cases, *force.shape[1:])
        return force.reshape(shape), angle.reshape(shape)

    @cached_property
    def _statistics(self) -> tuple[Array, Array]:
        from loadflow.rolling import _forces

        largest, sums = _forces.force_sums(self._rows, *self.contacts.arguments)
        return (
            largest.reshape(*self._cases, largest.shape[-1]),
            sums.reshape(*self._cases, *sums.shape[1:]),
        )

    @property
    def forces(self) -> Array:
        """Force of each contact, N, (..., kind, element)."""
        return self._state[0]

    @property
    def angles(self) -> Array:
        """Signed angle of each contact from the radial plane, rad, (..., kind, element)."""
        return self._state[1]

    def largest(self, raceway: Raceway) -> Array:
        """Largest force of each kind of contact, N, (..., kind); the same at both raceways."""
        return self._statistics[0]

    def power_sums(self, raceway: Raceway) -> Array:
        """Sums of powers of the forces, (..., kind, 3); the same at both raceways."""
        return self._statistics[1]

    def grouped(self, groups: int) -> Array:
        """Forces on whole elements, N, (..., group, element); needs no array of all slices."""
        from loadflow.rolling import _forces

        cos, sin, spans, table, *_ = self.contacts.arguments
        forces = _forces.row_forces(self._rows, cos, sin, spans, table, groups)
        return forces.reshape(*self._cases, *forces.shape[1:])
