"""Equilibrium of a bearing with flexible rings: of balls the static state of [Ritzer 2018] ch. 3.

Rigid motion of the rings' structures, ring modes and contacts in one Newton iteration with the
exact tangent; balls with exact distances of the groove centres (2.39), rollers with their slices.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.rolling.contacts import Array, Raceway
from loadflow.rolling.equilibrium import (
    Control,
    RingEquilibrium,
    broadcast_loads,
    raise_not_converged,
)
from loadflow.rolling.rings.condensation import ring_modes
from loadflow.rolling.rings.condensed import Coupling, RingModes
from loadflow.rolling.rings.flexible import FlexibleRings

_ROUGHLY = 1e-3  # residual of rigid rings from whose equilibrium a cold start goes
_BLOCK = 512  # cases whose contact forces are formed at once


@dataclass(frozen=True)
class FlexibleRingForces:
    """Forces of contacts between flexible rings.

    Attributes
    ----------
    rings : FlexibleRings
        The rings.
    modes : RingModes
        The ring modes of this position.
    displacement : ndarray, shape (..., 5)
        Of the inner ring's structure, m and rad.
    amplitudes : ndarray, shape (..., mode)
        Of the ring modes, √(N m).
    """

    rings: FlexibleRings
    modes: RingModes
    displacement: Array
    amplitudes: Array

    @property
    def _cases(self) -> tuple[int, ...]:
        return self.displacement.shape[:-1]

    @cached_property
    def _unknowns(self) -> Array:
        """All unknowns, (case, 5 + mode)."""
        rigid = self.displacement / self.modes.coupling.contacts.scale
        return np.concatenate([rigid, self.amplitudes], axis=-1).reshape(-1, self.modes.size)

    def _in_blocks(self) -> Iterator[Array]:
        """Unknowns of some cases at a time, so that arrays of all contacts stay small."""
        for first in range(0, max(len(self._unknowns), 1), _BLOCK):
            yield self._unknowns[first : first + _BLOCK]

    @cached_property
    def _state(self) -> tuple[Array, Array]:
        force, angle = self.modes.coupling.state(self._unknowns, self.modes)
        shape = (*self._cases, *force.shape[1:])
        return force.reshape(shape), angle.reshape(shape)

    @cached_property
    def _statistics(self) -> tuple[Array, Array]:
        coupling = self.modes.coupling
        parts = [coupling.statistics(some, self.modes) for some in self._in_blocks()]
        largest, sums = (np.concatenate(part) for part in zip(*parts))
        kinds = largest.shape[-1]
        return largest.reshape(*self._cases, kinds), sums.reshape(*self._cases, kinds, 3)

    @property
    def forces(self) -> Array:
        """Force of each contact, N, (..., kind, ball)."""
        return self._state[0]

    @property
    def angles(self) -> Array:
        """Signed angle of each contact from the radial plane, rad, (..., kind, ball)."""
        return self._state[1]

    def largest(self, raceway: Raceway) -> Array:
        """Largest force of each kind of contact, N, (..., kind); the same at both raceways."""
        return self._statistics[0]

    def power_sums(self, raceway: Raceway) -> Array:
        """Sums of powers of the forces, (..., kind, 3); the same at both raceways."""
        return self._statistics[1]

    def grouped(self, groups: int) -> Array:
        """Forces summed over the kinds of each group, N, (..., group, ball)."""
        coupling = self.modes.coupling
        parts = [coupling.grouped(some, self.modes, groups) for some in self._in_blocks()]
        force = np.concatenate(parts)
        return force.reshape(*self._cases, *force.shape[1:])

    def stiffness(self) -> Array:
        """Tangent of the rings' structures, ring modes eliminated, (..., 5, 5); N/m, N, N m/rad."""
        from loadflow.rolling.rings import _ring_newton

        found = _ring_newton.stiffness_series(self._unknowns, self.modes.waves, self.modes.law)
        scale = self.modes.coupling.contacts.scale
        found /= np.multiply.outer(scale, scale)
        return np.asarray(found.reshape(*self._cases, 5, 5))

    def ring_displacement(self, ring: Literal["inner", "outer"]) -> Array:
        """Displacement (r, θ, z) of a ring's raceways, m, (..., *groups, element, 3).

        Of balls at each patch, of rollers in their middle. Relative to the ring's structure, from
        the contact forces and the ring's whole compliance rather than from the kept modes.

        Raises
        ------
        InputError
            If the ring is rigid.
        """
        moved = np.einsum("kbcm,...m->...kbc", self._factor(ring), self.modal_force(ring))
        return self.modes.coupling.raceways(moved)

    def modal_force(self, ring: Literal["inner", "outer"]) -> Array:
        """Force of all contacts on the modes of a ring's `flexibility`, √(N m), (..., mode)."""
        coupling, factor = self.modes.coupling, self._factor(ring)
        sign = 1.0 if ring == "outer" else -1.0
        parts = [
            np.einsum("nkbc,kbcm->nm", coupling.pushes(*coupling.state(some, self.modes)), factor)
            for some in self._in_blocks()
        ]
        return sign * np.concatenate(parts).reshape(*self._cases, factor.shape[-1])

    def _factor(self, ring: Literal["inner", "outer"]) -> Array:
        if ring not in self._factors:
            model = self.rings.outer if ring == "outer" else self.rings.inner
            if model is None:
                raise InputError(f"ring: the {ring} ring is rigid")
            self._factors[ring] = model.flexibility(self.modes.coupling.points(ring, self.rings))
        return self._factors[ring]

    @cached_property
    def _factors(self) -> dict[str, Array]:
        """Of each ring that was asked for: its flexibility takes up to seconds."""
        return {}


def solve_flexible(
    coupling: Coupling,
    rings: FlexibleRings,
    force: ArrayLike,
    moment: ArrayLike,
    control: Control,
) -> tuple[RingEquilibrium, FlexibleRingForces]:
    """Find the equilibrium with flexible rings for all load cases.

    Minimises the convex potential of contacts, ring modes and load. Starts from the equilibrium
    with rigid rings, or inside chunks from a case near by.

    Parameters
    ----------
    coupling : Coupling
        How the contacts of the bearing feel its rings.
    rings : FlexibleRings
        The rings.
    force, moment : array_like, shape (..., 3) and (..., 2)
        Load on the inner ring, N and N m.
    control : Control
        Tolerance and limits of the iteration. The residual covers the ring modes as well, as forces
        at their largest displacement.

    Returns
    -------
    RingEquilibrium, FlexibleRingForces
        Over the shape of the load cases.

    Raises
    ------
    InputError
        If loads or rings are unfit.
    SolverError
        If ``control.strict`` and a case does not converge, or its contacts turn beyond 90°, where
        the raceways end.
    """
    from loadflow.numerics.neighbours import near_order
    from loadflow.rolling.rings import _ring_newton

    f, m = broadcast_loads(force, moment)
    shape = f.shape[:-1]
    modes = ring_modes(coupling, rings)
    contacts = coupling.contacts
    loads = np.concatenate([f, m], axis=-1).reshape(-1, 5)
    rigid = (
        *contacts.arguments, contacts.scale, contacts.cap, _ROUGHLY, control.max_iterations,
        contacts.unit_compliance(), 1,
    )  # fmt: skip
    lengths = np.ascontiguousarray(loads * contacts.scale)  # else kernels compile for each order
    order = near_order(lengths, control.chunk)
    found = _ring_newton.solve_series(
        _ring_newton.newton_entry(modes.waves, modes.basis, modes.law, modes.reach),
        lengths[order],
        (rigid, contacts.scale),
        modes.waves,
        modes.basis,
        modes.law,
        modes.reach,
        contacts.cap,
        control.tolerance,
        control.max_iterations,
        control.chunk,
    )
    back = np.argsort(order)
    x, converged, residual, iterations, singular, rounding = (one[back] for one in found)
    if control.strict and not converged.all():
        _refuse_exit(loads, converged, residual, control.tolerance)
        raise_not_converged(loads, converged, residual, rounding, iterations, shape)
    displacement = (x[:, :5] * contacts.scale).reshape(*shape, 5)
    amplitudes = x[:, 5:].reshape(*shape, -1)
    elements = FlexibleRingForces(rings, modes, displacement, amplitudes)
    equilibrium = RingEquilibrium(
        force=f,
        moment=m,
        displacement=displacement,
        form_stiffness=elements.stiffness,
        converged=converged.reshape(shape),
        residual=residual.reshape(shape),
        iterations=iterations.reshape(shape),
        singular=singular.reshape(shape),
    )
    return equilibrium, elements


def _refuse_exit(
    loads: Array, converged: NDArray[np.bool_], residual: Array, tolerance: float
) -> None:
    """Raise a SolverError if the first case without answer is balanced beyond the raceway."""
    first = int(np.flatnonzero(~converged)[0])
    if residual[first] <= tolerance:
        load = ", ".join(f"{v:.6g}" for v in loads[first])
        raise SolverError(
            f"case {first}, (Fx, Fy, Fz, Mx, My) = ({load}) N, N m: the rings give way until "
            "loaded contacts turn beyond 90°, where the raceways end. Stiffen or support the rings."
        )
