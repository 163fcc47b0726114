"""Equilibrium of a slewing bearing with flexible rings: the static state of [Ritzer 2018] ch. 3.

Rigid motion of the rings' structures, ring modes and contacts in one Newton iteration with exact
distances of the groove centres (2.39) and the exact tangent.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.rolling import equilibrium
from loadflow.rolling.contacts import Array
from loadflow.rolling.equilibrium import Control, broadcast_loads, complain
from loadflow.rolling.rings.condensed import FlexibleRings, RingModes, ring_modes
from loadflow.rolling.rings.patches import patch_points
from loadflow.rolling.slewing_result import SlewingResult

if TYPE_CHECKING:
    from loadflow.rolling.bearings.four_point import SlewingBearing

_BLOCK = 512  # cases whose contact forces are formed at once


@dataclass(frozen=True)
class FlexibleResult(SlewingResult):
    """Equilibrium with flexible rings.

    Attributes
    ----------
    rings : FlexibleRings
        The rings.
    ball_angle : float
        Azimuth of the first ball, rad.
    modes : RingModes
        The ring modes of this position.
    amplitudes : ndarray, shape (..., mode)
        Of the ring modes, √(N m).
    """

    rings: FlexibleRings
    ball_angle: float
    modes: RingModes
    amplitudes: Array

    @cached_property
    def _unknowns(self) -> Array:
        """All unknowns, (case, 5 + mode)."""
        rigid = self.displacement / self.contacts.scale
        return np.concatenate([rigid, self.amplitudes], axis=-1).reshape(-1, self.modes.size)

    def _contact_state(self, cases: slice) -> tuple[Array, Array]:
        """Force and signed angle of each contact, (case, kind, ball)."""
        from loadflow.rolling.rings import _ring_kernels

        force, angle = _ring_kernels.contact_state(
            self._unknowns[cases], self.modes.basis, self.contacts.table, self.modes.local
        )
        shape = (len(force), len(self.contacts.table), -1)
        return force.reshape(shape), angle.reshape(shape)

    @cached_property
    def _state(self) -> tuple[Array, Array]:
        force, angle = self._contact_state(slice(None))
        shape = (*self.cases, *force.shape[1:])
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
            np.concatenate(largest).reshape(*self.cases, kinds),
            np.concatenate(sums).reshape(*self.cases, kinds, 3),
        )

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
        return moved.reshape(*self.cases, self.bearing.rows, 2, self.bearing.balls, 3)


def solve_flexible(
    bearing: SlewingBearing,
    rings: FlexibleRings,
    ball_angle: float,
    force: ArrayLike,
    moment: ArrayLike,
    control: Control,
) -> FlexibleResult:
    """Find the equilibrium with flexible rings for all load cases.

    Minimises the convex potential of contacts, ring modes and load. Starts from the equilibrium
    with rigid rings, or inside chunks from the case before.

    Parameters
    ----------
    bearing, rings, ball_angle
        See `SlewingBearing.equilibrium`.
    force, moment : array_like, shape (..., 3) and (..., 2)
        Load on the inner ring, N and N m.
    control : Control
        Tolerance and limits of the iteration. The residual covers the ring modes as well, as forces
        at their largest displacement.

    Returns
    -------
    FlexibleResult
        Over the shape of the load cases.

    Raises
    ------
    InputError
        If loads or rings are unfit.
    SolverError
        If ``control.strict`` and a case does not converge, or its contacts turn beyond 90°, where
        the raceways end.
    """
    from loadflow.rolling.rings import _ring_kernels

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
    x, stiffness, converged, residual, iterations, singular, rounding = _ring_kernels.solve_series(
        loads * contacts.scale,
        (rigid.displacement / contacts.scale).reshape(-1, 5),
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
        complain(loads, converged, residual, rounding, iterations, shape)
    per_length = 1 / contacts.scale
    return FlexibleResult(
        force=f,
        moment=m,
        displacement=(x[:, :5] * contacts.scale).reshape(*shape, 5),
        stiffness=(stiffness * per_length[:, None] * per_length).reshape(*shape, 5, 5),
        converged=converged.reshape(shape),
        residual=residual.reshape(shape),
        iterations=iterations.reshape(shape),
        singular=singular.reshape(shape),
        bearing=bearing,
        contacts=contacts,
        rings=rings,
        ball_angle=ball_angle,
        modes=modes,
        amplitudes=x[:, 5:].reshape(*shape, -1),
    )


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
