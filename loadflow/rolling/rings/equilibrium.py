"""Equilibrium of a slewing bearing with flexible rings: the static state of [Ritzer 2018] ch. 3.

Rigid motion of the rings' structures, ring modes and contacts in one Newton iteration with exact
distances of the groove centres (2.39) and the exact tangent.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.rolling import equilibrium
from loadflow.rolling.contacts import Array, Contacts, Raceway
from loadflow.rolling.equilibrium import (
    Control,
    RingEquilibrium,
    broadcast_loads,
    raise_not_converged,
)
from loadflow.rolling.raceways import BallRaceways
from loadflow.rolling.rings.condensed import FlexibleRings, RingModes, ring_modes
from loadflow.rolling.rings.patches import patch_points

_BLOCK = 512  # cases whose contact forces are formed at once


@dataclass(frozen=True)
class FlexibleRingForces:
    """Forces of contacts between flexible rings.

    Attributes
    ----------
    bearing : BallRaceways
        The bearing.
    contacts : Contacts
        Its contacts.
    rings : FlexibleRings
        The rings.
    modes : RingModes
        The ring modes of this position.
    displacement : ndarray, shape (..., 5)
        Of the inner ring's structure, m and rad.
    amplitudes : ndarray, shape (..., mode)
        Of the ring modes, √(N m).
    """

    bearing: BallRaceways
    contacts: Contacts
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
        rigid = self.displacement / self.contacts.scale
        return np.concatenate([rigid, self.amplitudes], axis=-1).reshape(-1, self.modes.size)

    def _contact_state(self, cases: slice) -> tuple[Array, Array]:
        """Force and signed angle of each contact, (case, kind, ball)."""
        from loadflow.rolling.rings import _ring_kernels

        force, angle = _ring_kernels.contact_state(
            self._unknowns[cases], self.modes.waves, self.contacts.table, self.modes.local
        )
        return force, angle

    @cached_property
    def _state(self) -> tuple[Array, Array]:
        force, angle = self._contact_state(slice(None))
        shape = (*self._cases, *force.shape[1:])
        return force.reshape(shape), angle.reshape(shape)

    @cached_property
    def _statistics(self) -> tuple[Array, Array]:
        largest, sums = [], []
        for first in range(0, len(self._unknowns), _BLOCK):
            force, _ = self._contact_state(slice(first, first + _BLOCK))
            largest.append(force.max(axis=-1))
            sums.append(np.stack([(force**p).sum(axis=-1) for p in (1, 3, 10 / 3)], axis=-1))
        kinds = len(self.contacts.table)
        return (
            np.concatenate(largest).reshape(*self._cases, kinds),
            np.concatenate(sums).reshape(*self._cases, kinds, 3),
        )

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
        """Sums of the forces, their cubes and 10/3 powers, (..., kind, 3)."""
        return self._statistics[1]

    def grouped(self, groups: int) -> Array:
        """Forces summed over the kinds of each group, N, (..., group, ball)."""
        force = self.forces
        return force.reshape(*self._cases, groups, -1, force.shape[-1]).sum(axis=-2)

    def stiffness(self) -> Array:
        """Tangent of the rings' structures, ring modes eliminated, (..., 5, 5); N/m, N, N m/rad."""
        from loadflow.rolling.rings import _ring_newton

        found = _ring_newton.stiffness_series(
            self._unknowns, self.modes.waves, self.modes.basis, self.contacts.table,
            self.modes.local,
        )  # fmt: skip
        found /= np.multiply.outer(self.contacts.scale, self.contacts.scale)
        return np.asarray(found.reshape(*self._cases, 5, 5))

    def ring_displacement(self, ring: Literal["inner", "outer"]) -> Array:
        """Displacement (r, θ, z) of a ring's raceway patches, m, (..., row, diagonal, ball, 3).

        Relative to the ring's structure, from the contact forces and the ring's whole compliance
        rather than from the kept modes.

        Raises
        ------
        InputError
            If the ring is rigid.
        """
        model = self.rings.outer if ring == "outer" else self.rings.inner
        if model is None:
            raise InputError(f"ring: the {ring} ring is rigid")
        turn = self.rings.outer_angle if ring == "outer" else self.rings.inner_angle
        azimuth = self.contacts.azimuth - turn
        points = patch_points(
            self.bearing, ring, azimuth, self.rings.shell, self.rings.turning_patches
        )
        factor = model.flexibility(points)
        force, angle = self._state
        sign = 1.0 if ring == "outer" else -1.0
        push = sign * np.stack(
            [force * np.cos(angle), np.zeros_like(force), force * np.sin(angle)], axis=-1
        )
        modal = np.einsum("...kbc,kbcm->...m", push, factor)
        moved = np.einsum("kbcm,...m->...kbc", factor, modal)
        return moved.reshape(*self._cases, *self.bearing.groups, self.bearing.balls, 3)


def solve_flexible(
    bearing: BallRaceways,
    rings: FlexibleRings,
    ball_angle: float,
    force: ArrayLike,
    moment: ArrayLike,
    control: Control,
) -> tuple[RingEquilibrium, FlexibleRingForces]:
    """Find the equilibrium with flexible rings for all load cases.

    Minimises the convex potential of contacts, ring modes and load. Starts from the equilibrium
    with rigid rings, or inside chunks from the case before.

    Parameters
    ----------
    bearing, rings, ball_angle
        See `RollingBearing.equilibrium`.
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
    from loadflow.rolling.rings import _ring_newton

    f, m = broadcast_loads(force, moment)
    shape = f.shape[:-1]
    contacts = bearing.contacts(ball_angle)
    modes = ring_modes(bearing, rings, ball_angle)
    loads = np.concatenate([f, m], axis=-1).reshape(-1, 5)
    rigid = equilibrium.solve(
        contacts,
        f,
        m,
        tolerance=1e-3,
        max_iterations=control.max_iterations,
        strict=False,
        chunk=control.chunk,
    )
    x, converged, residual, iterations, singular, rounding = _ring_newton.solve_series(
        loads * contacts.scale,
        (rigid.displacement / contacts.scale).reshape(-1, 5),
        modes.waves,
        modes.basis,
        contacts.table,
        modes.local,
        modes.reach,
        contacts.cap,
        control.tolerance,
        control.max_iterations,
        control.chunk,
    )
    if control.strict and not converged.all():
        _refuse_exit(loads, converged, residual, control.tolerance)
        raise_not_converged(loads, converged, residual, rounding, iterations, shape)
    displacement = (x[:, :5] * contacts.scale).reshape(*shape, 5)
    amplitudes = x[:, 5:].reshape(*shape, -1)
    elements = FlexibleRingForces(bearing, contacts, rings, modes, displacement, amplitudes)
    found = RingEquilibrium(
        force=f,
        moment=m,
        displacement=displacement,
        form_stiffness=elements.stiffness,
        converged=converged.reshape(shape),
        residual=residual.reshape(shape),
        iterations=iterations.reshape(shape),
        singular=singular.reshape(shape),
    )
    return found, elements


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
