"""Equilibrium of a bearing with rigid rings in five degrees of freedom, for arrays of cases."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.numerics.convergence import unresolved
from loadflow.rolling.contacts import Array, Contacts

COMPONENTS = ("Fx", "Fy", "Fz", "Mx", "My")
CHUNK = 512


@dataclass(frozen=True)
class Control:
    """How an equilibrium is sought; the fields are described at `solve`."""

    tolerance: float = 1e-10
    max_iterations: int = 100
    strict: bool = True
    chunk: int = CHUNK


@dataclass(frozen=True)
class FormedStiffness:
    """A stiffness that the iteration has anyway, shape (..., 5, 5)."""

    value: Array

    def __call__(self) -> Array:
        """Return it."""
        return self.value


@dataclass(frozen=True)
class RingEquilibrium:
    """Where the inner ring comes to rest under each load.

    Attributes
    ----------
    force, moment : ndarray, shape (..., 3) and (..., 2)
        Load on the inner ring at the bearing centre, N and N m.
    displacement : ndarray, shape (..., 5)
        (ux, uy, uz, θx, θy) of the inner ring relative to the outer, m and rad.
    form_stiffness : callable
        Forms `stiffness`, which costs more than the equilibrium where rings are flexible.
    converged : ndarray of bool
        Whether every component is balanced within the tolerance.
    residual : ndarray
        Largest unbalanced component (moments over the pitch radius) over the largest load, or over
        1e-4 of the sum of the contact forces if that is larger.
    iterations : ndarray of int
        Newton steps.
    singular : ndarray of bool
        Whether a motion meets no resistance (no contact, clearance across the load, ...). The
        displacement in that direction is then arbitrary; the forces are not.
    """

    force: Array
    moment: Array
    displacement: Array
    form_stiffness: Callable[[], Array]
    converged: NDArray[np.bool_]
    residual: Array
    iterations: NDArray[np.int64]
    singular: NDArray[np.bool_]

    @cached_property
    def stiffness(self) -> Array:
        """Tangent d(Fx, Fy, Fz, Mx, My)/d(ux, uy, uz, θx, θy), (..., 5, 5); N/m, N, N m/rad."""
        return self.form_stiffness()


def solve(
    contacts: Contacts,
    force: ArrayLike,
    moment: ArrayLike,
    *,
    tolerance: float = 1e-10,
    max_iterations: int = 100,
    strict: bool = True,
    chunk: int = CHUNK,
) -> RingEquilibrium:
    """Find the rigid-ring equilibrium (2.39)–(2.49) of [Ritzer 2018] for all load cases.

    Minimises the convex potential (elastic energy less work of the load) by Newton's method with
    the exact tangent. Neighbouring cases start from one another inside fixed chunks.

    Parameters
    ----------
    contacts : Contacts
        The bearing's contacts.
    force : array_like, shape (..., 3)
        Force on the inner ring, N.
    moment : array_like, shape (..., 2)
        Moment (Mx, My) on the inner ring about the bearing centre, N m. Broadcasts with `force`.
    tolerance : float
        Largest allowed residual.
    max_iterations : int
        Newton steps allowed for a case.
    strict : bool
        Raise if a case has no equilibrium; otherwise flag it in ``converged``.
    chunk : int
        Cases between two cold starts; 1 solves each case cold.

    Returns
    -------
    RingEquilibrium
        Displacements, stiffness and outcome of the iteration.

    Raises
    ------
    InputError
        If the loads are not finite or have wrong shapes.
    SolverError
        If `strict` and a case does not converge; names the first one.
    """
    from loadflow.rolling import _kernels

    f, m = broadcast_loads(force, moment)
    shape = f.shape[:-1]
    loads = np.concatenate([f, m], axis=-1).reshape(-1, 5)
    if chunk < 1:
        raise InputError(f"chunk: must be at least 1, got {chunk}")
    q, stiffness, converged, residual, iterations, singular, rounding = _kernels.solve_series(
        np.ascontiguousarray(loads),
        *contacts.arguments,
        contacts.scale,
        contacts.cap,
        tolerance,
        max_iterations,
        contacts.unit_compliance(),
        chunk,
    )
    if strict and not converged.all():
        raise_not_converged(loads, converged, residual, rounding, iterations, shape)
    return RingEquilibrium(
        force=f,
        moment=m,
        displacement=q.reshape(*shape, 5),
        form_stiffness=FormedStiffness(stiffness.reshape(*shape, 5, 5)),
        converged=converged.reshape(shape),
        residual=residual.reshape(shape),
        iterations=iterations.reshape(shape),
        singular=singular.reshape(shape),
    )


def broadcast_loads(force: ArrayLike, moment: ArrayLike) -> tuple[Array, Array]:
    """Broadcast force (..., 3) and moment (..., 2) against each other."""
    f, m = np.asarray(force, float), np.asarray(moment, float)
    for name, value, size in (("force", f, 3), ("moment", m, 2)):
        if value.ndim == 0 or value.shape[-1] != size:
            raise InputError(
                f"{name}: the last axis must have {size} components, got {value.shape}"
            )
        if not np.isfinite(value).all():
            where = np.argwhere(~np.isfinite(value))[0].tolist()
            raise InputError(f"{name}: must be finite, got {value[tuple(where)]} at {where}")
    try:
        shape = np.broadcast_shapes(f.shape[:-1], m.shape[:-1])
    except ValueError:
        raise InputError(f"force {f.shape} and moment {m.shape} do not broadcast") from None
    return np.broadcast_to(f, (*shape, 3)), np.broadcast_to(m, (*shape, 2))


def raise_not_converged(
    loads: Array,
    converged: NDArray[np.bool_],
    residual: Array,
    rounding: Array,
    iterations: NDArray[np.int64],
    shape: tuple[int, ...],
) -> None:
    """Raise a SolverError that names the first case without equilibrium."""
    first = int(np.flatnonzero(~converged)[0])
    load = ", ".join(f"{n} = {v:.6g}" for n, v in zip(COMPONENTS, loads[first]))
    index = tuple(int(i) for i in np.unravel_index(first, shape)) if shape else ()
    raise SolverError(
        f"no equilibrium for {np.count_nonzero(~converged)} of {converged.size} cases; first: "
        f"index {index}, {load} (N, N m): "
        f"{unresolved(residual[first], rounding[first], iterations[first])}. "
        "No contact may resist this load."
    )
