"""From the displacement of the inner ring to contact forces and static safety."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.rolling.contacts import HEIGHT, RADIUS, Array, Contacts
from loadflow.rolling.equilibrium import RingEquilibrium
from loadflow.rolling.raceways import BallRaceways
from loadflow.rolling.rating import safety


@dataclass(frozen=True)
class ContactResult(RingEquilibrium):
    """Equilibrium with what follows from each contact; quantities are formed when asked for.

    `maximum_force`, `force_sum` and what follows from them need no array of all contact forces,
    so that a series of any length fits in memory.

    Attributes
    ----------
    contacts : Contacts
        The bearing's contacts, with the azimuth of each element.
    """

    contacts: Contacts

    @property
    def cases(self) -> tuple[int, ...]:
        """Shape of the load cases."""
        return self.displacement.shape[:-1]

    @cached_property
    def _state(self) -> tuple[Array, Array]:
        """Force and signed angle of each contact, (..., kind, element)."""
        from loadflow.rolling import _forces

        q = np.ascontiguousarray(self.displacement.reshape(-1, 5))
        force, angle = _forces.contact_state(q, *self.contacts.arguments)
        shape = (*self.cases, *force.shape[1:])
        return force.reshape(shape), angle.reshape(shape)

    @cached_property
    def _statistics(self) -> tuple[Array, Array]:
        """Largest force (..., kind) and sums of powers of the forces (..., kind, 3).

        The powers are 1, 3, 10/3 of points and 1, 4, 9/2 of lines.
        """
        from loadflow.rolling import _forces

        q = np.ascontiguousarray(self.displacement.reshape(-1, 5))
        largest, sums = _forces.force_sums(q, *self.contacts.arguments)
        return (
            largest.reshape(*self.cases, largest.shape[-1]),
            sums.reshape(*self.cases, *sums.shape[1:]),
        )

    @property
    def contact_forces(self) -> Array:
        """Force of each contact, N, (..., kind, element); kinds as in `contacts.table`."""
        return self._state[0]

    @property
    def contact_directions(self) -> Array:
        """Motion v of the inner ring that each contact resists, (..., kind, element, 5).

        The load of all contacts is ΣF v; a stiffness k along each adds Σk v vᵀ.
        """
        table, angle = self.contacts.table, self._state[1]
        radius, height = table[:, RADIUS, None], table[:, HEIGHT, None]
        azimuth = self.contacts.kind_azimuth
        cos, sin = np.cos(azimuth), np.sin(azimuth)
        out, along = np.cos(angle), np.sin(angle)
        lever = height * out - radius * along
        return np.stack([out * cos, out * sin, along, -lever * sin, lever * cos], axis=-1)

    @property
    def secant_stiffness(self) -> Array:
        """Secant stiffness, (..., 5, 5), units as `stiffness`; (2.9)–(2.11) in one matrix.

        Of all symmetric matrices that lead from the centred, unloaded ring to this load,
        ``secant_stiffness @ displacement = load``, the one nearest to the tangent (rotations times
        the pitch radius). So it is load over displacement along the displacement, and the tangent
        in directions without any, or without load.
        """
        scale = self.contacts.scale
        moved = self.displacement / scale
        load = np.concatenate([self.force, self.moment], axis=-1) * scale
        tangent = self.stiffness * np.outer(scale, scale)
        missing = load - np.einsum("...ab,...b->...a", tangent, moved)
        size = np.square(moved).sum(axis=-1, keepdims=True)
        loaded = (np.abs(load).max(axis=-1, keepdims=True) > 0) & (size > 0)
        along = np.divide(moved, size, out=np.zeros_like(moved), where=loaded)
        work = (missing * moved).sum(axis=-1)[..., None, None]
        across = missing[..., :, None] * along[..., None, :]
        update = across + np.swapaxes(across, -1, -2)
        update -= work * along[..., :, None] * along[..., None, :]
        return np.asarray((tangent + update) / np.outer(scale, scale))

    @property
    def force_sum(self) -> Array:
        """Sum ΣF_k of all contact forces, N."""
        return np.asarray(self._statistics[1][..., 0].sum(axis=-1))


@dataclass(frozen=True)
class BallResult(ContactResult):
    """Equilibrium of a ball bearing: pressures and static safety of its contacts.

    Attributes
    ----------
    bearing : BallRaceways
        The bearing.
    """

    bearing: BallRaceways

    @property
    def maximum_force(self) -> Array:
        """Largest contact force, N."""
        return np.asarray(self._statistics[0].max(axis=-1))

    @property
    def raceway_pressure(self) -> tuple[Array, Array]:
        """Largest Hertzian pressure at the inner and at the outer raceway, Pa, (2.1)."""
        force = self.maximum_force
        return (
            self.bearing.raceway_contact("inner", force).pressure,
            self.bearing.raceway_contact("outer", force).pressure,
        )

    @property
    def maximum_pressure(self) -> Array:
        """Largest Hertzian pressure of both raceways, Pa."""
        return np.asarray(np.maximum(*self.raceway_pressure))

    @property
    def pressure_safety(self) -> Array:
        """Allowable over largest pressure, (4.2) put right; infinite without load."""
        bearing = self.bearing
        allowed = bearing.allowable_pressure * safety.hardness_factor(bearing.hardness)
        return safety.ratio(allowed, self.maximum_pressure)

    @property
    def static_safety(self) -> Array:
        """Allowable over largest ball force, (4.1) put right: the cube of `pressure_safety`."""
        return np.asarray(self.pressure_safety**3)

    def _truncated(self, force: Array, angle: Array, axes: tuple[int, ...]) -> NDArray[np.bool_]:
        """Whether a contact ellipse reaches over the shoulder of its raceway."""
        bearing = self.bearing
        if bearing.shoulder_angle is None:
            raise InputError("shoulder_angle: needed to tell whether a contact is cut off")
        reach = np.maximum(
            bearing.raceway_contact("inner", force).semi_axes[0] / bearing.groove("inner"),
            bearing.raceway_contact("outer", force).semi_axes[0] / bearing.groove("outer"),
        )
        edge = angle + np.arcsin(np.minimum(reach, 1.0))
        return np.asarray(((edge > bearing.shoulder_angle) & (force > 0)).any(axis=axes))
