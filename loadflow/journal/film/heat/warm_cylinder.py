"""A ring as wide as its bearing that is warm on its bore: finite elements, order by order around.

On the mesh of `loadflow.journal.film.shell.cylinder` first the temperature of the wall, by
Laplace's equation with the bore's temperature given, a transfer at the outside and no flow through
the side faces; then its displacements, by the stress that this temperature would make were no part
to move [Timoshenko and Goodier 1970, art. 151]. Slices that move each on its own, as in plane
stress, are the limit of a narrow ring.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array, kron
from scipy.sparse.linalg import splu

from loadflow.journal.film.shell.cylinder import (
    ACROSS,
    OVER_R,
    SLOPE,
    VALUE,
    U,
    V,
    W,
    lame_constants,
    line_functions,
    products,
    ring_loads,
    stiffness_parts,
    wall_edges,
)

Array = NDArray[np.float64]

_OUTSIDE = -1  # the last function through the wall


def bore_growth(
    orders: tuple[int, ...],
    z_edges: Array,
    outer: float,
    biot: float,
    held: bool,
    poisson_ratio: float,
) -> Array:
    """Growth of the bore of a ring over α a T, T the temperature cos nφ of its bore.

    Parameters
    ----------
    orders : tuple of int (h,)
        n; the first only of a ring that is held, as it would move freely.
    z_edges : array (nz + 1,)
        Edges of the rings whose temperatures are told, over the radius of the bore, from one free
        end to the other; from 0, where only one half of a symmetric temperature is given.
    outer : float
        Radius of the outside over that of the bore, a.
    biot : float
        Transfer at its outside times a over its conductivity.
    held : bool
        Whether the outside stays in place, but for sliding along the axis.
    poisson_ratio : float
        ν, below 0.5.

    Returns
    -------
    array (h, nz, nz)
        Mean growth of each ring over the temperature of each.
    """
    return _cached(orders, tuple(z_edges.tolist()), outer, biot, held, poisson_ratio).copy()


@lru_cache(maxsize=8)
def _cached(
    orders: tuple[int, ...],
    z_edges: tuple[float, ...],
    outer: float,
    biot: float,
    held: bool,
    poisson_ratio: float,
) -> Array:
    from skfem import ElementLineP2, ElementLinePp

    rings = np.array(z_edges)
    walls = wall_edges(1.0, outer, float(np.diff(rings).min()))
    through = line_functions(walls, ElementLinePp(ACROSS))
    along = line_functions(rings, ElementLineP2())
    across, length = products(through, radial=True), products(along, radial=False)
    parts = stiffness_parts(across, length, 1.0, poisson_ratio)
    means = ring_loads(along) / np.diff(rings)[:, None]
    shape = length.shape[-1], across.shape[-1], 3
    found = []
    for n in orders:
        warm = _temperatures(n, across, length, _on_nodes(rings), outer * biot)
        pushed = _pushed(n, across, length, warm, poisson_ratio)
        free = np.ones(shape, dtype=bool)
        if held:
            free[:, _OUTSIDE, :W] = False
        if rings[0] == 0.0:
            free[0, :, W] = False  # the plane of symmetry
        elif n == 0:
            free[shape[0] // 2, 0, W] = False  # it may stand anywhere
        if n == 0:
            free[:, :, V] = False  # it does not turn
        moves = _solved(parts[0] + n * parts[1] + n * n * parts[2], free.ravel(), pushed)
        found.append(means @ moves.reshape(*shape, -1)[:, 0, U])
    return np.array(found)


def _on_nodes(rings: Array) -> Array:
    """Temperature at the nodes along the bore from that of the rings, (node, ring).

    Midway in each ring its own, between two the mean of both.
    """
    count = rings.size - 1
    middles = np.arange(count)
    found = np.zeros((2 * count + 1, count))
    found[2 * middles + 1, middles] = 1.0
    for edge in range(count + 1):
        for beside in (edge - 1, edge):
            found[2 * edge, min(max(beside, 0), count - 1)] += 0.5
    return found


def _temperatures(n: int, across: Array, length: Array, bore: Array, transfer: float) -> Array:
    """Functions of the temperature of the wall, (node, ring), of that at its `bore`."""
    wall = across[SLOPE, SLOPE] + n * n * across[OVER_R, OVER_R]
    wall[_OUTSIDE, _OUTSIDE] += transfer
    conducts = kron(length[VALUE, VALUE], wall) + kron(length[SLOPE, SLOPE], across[VALUE, VALUE])
    nodes = wall.shape[0]
    warm = np.zeros((conducts.shape[0], bore.shape[1]))
    warm[::nodes] = bore
    inside = np.arange(len(warm)) % nodes > 0
    return warm + _solved(conducts, inside, -(conducts @ warm))


def _pushed(n: int, across: Array, length: Array, warm: Array, poisson_ratio: float) -> Array:
    """Work of the stress of a warm wall that does not move on all displacements, over π."""
    lame, shear = lame_constants(1.0, poisson_ratio)
    value = csr_array(length[VALUE, VALUE])
    opens = (
        kron(value, across[SLOPE, VALUE] + across[OVER_R, VALUE]),
        n * kron(value, across[OVER_R, VALUE]),
        kron(length[SLOPE, VALUE], across[VALUE, VALUE]),
    )
    stress = (3.0 * lame + 2.0 * shear) * warm
    return np.stack([part @ stress for part in opens], axis=1).reshape(-1, warm.shape[1])


def _solved(matrix: Any, free: NDArray[np.bool_], loads: Array) -> Array:
    """Solution of a sparse system in its `free` unknowns, the others 0."""
    found, own = np.zeros_like(loads), csc_array(matrix)[free][:, free]
    found[free] = splu(csc_array(own)).solve(loads[free])
    return found
