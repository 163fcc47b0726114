"""A thick-walled cylinder under pressure on its bore: finite elements, harmonic by harmonic.

Around, everything is a Fourier series: under the pressure p cos nθ the displacements are
u cos nθ (radial), v sin nθ (around), w cos nθ (along), so that (r, z) is all that is meshed
[Wilson 1965, AIAA J. 3]. Orders do not couple, and enter the strains linearly.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded

Array = NDArray[np.float64]

_ACROSS, _ALONG = 3, 2  # degrees of the elements through the wall and along it
_COARSER = 2.0  # ratio of the lengths of neighbouring elements through the wall


def bore_compliance(
    orders: NDArray[np.int64],
    z_edges: Array,
    inner: float,
    outer: float,
    modulus: float,
    poisson_ratio: float,
) -> Array:
    """Radial displacement of the bore of a cylinder that is held all over its outside.

    Parameters
    ----------
    orders : array of int (h,)
        Harmonics n of pressure around.
    z_edges : array (nz + 1,)
        Edges of the rings that pressure acts on, m, from one free end to the other; from 0, where
        only one half of a symmetric pressure is given.
    inner, outer : float
        Radii, m.
    modulus, poisson_ratio : float
        Young's modulus, Pa, and ν.

    Returns
    -------
    array (h, nz, nz)
        Mean displacement outward of each ring over a pressure cos nθ on each ring, m/Pa.
    """
    words = (inner, outer, modulus, poisson_ratio)
    return _cached(tuple(orders.tolist()), tuple(z_edges.tolist()), *words).copy()


@lru_cache(maxsize=8)
def _cached(
    orders: tuple[int, ...],
    z_edges: tuple[float, ...],
    inner: float,
    outer: float,
    modulus: float,
    poisson_ratio: float,
) -> Array:
    rings = np.array(z_edges)
    walls = _wall(inner, outer, float(np.diff(rings).min()))
    parts = _stiffness(walls, rings, modulus, poisson_ratio)
    nodes = _ACROSS * (walls.size - 1)  # through the wall, without the outside
    at_nodes = np.zeros((rings.size - 1, _ALONG * (rings.size - 1) + 1, nodes, 3))
    _, weights, values, _ = _reference(_ALONG)
    for number, length in enumerate(np.diff(rings)):
        first = _ALONG * number
        at_nodes[number, first : first + _ALONG + 1, 0, 0] = 0.5 * length * (weights @ values)
    pushed = at_nodes.reshape(rings.size - 1, -1)
    means = pushed / np.diff(rings)[:, None]
    found = []
    for n in orders:
        band = parts[0] + n * parts[1] + n * n * parts[2]
        found.append(means @ solveh_banded(band, inner * pushed.T, lower=True))
    return np.array(found)


def _wall(inner: float, outer: float, first: float) -> Array:
    """Edges of the elements through the wall, which lengthen from the bore on."""
    count = 1
    while first * (_COARSER**count - 1) / (_COARSER - 1) < outer - inner:
        count += 1
    shares = _COARSER ** np.arange(count)
    return inner + (outer - inner) * np.append(0.0, np.cumsum(shares)) / shares.sum()


def _reference(degree: int) -> tuple[Array, Array, Array, Array]:
    """Gauss points on −1 … 1 and weights; shape functions and their slopes (points, nodes)."""
    points, weights = np.polynomial.legendre.leggauss(degree + 1)
    nodes = np.linspace(-1.0, 1.0, degree + 1)
    monomials = np.linalg.inv(np.vander(nodes, increasing=True))
    values = np.vander(points, degree + 1, increasing=True) @ monomials
    powers = np.arange(1, degree + 1)
    slopes = (powers * np.vander(points, degree, increasing=True)) @ monomials[1:]
    return points, weights, values, slopes


def _stiffness(walls: Array, rings: Array, modulus: float, poisson_ratio: float) -> Array:
    """Parts K₀, K₁, K₂ of the stiffness K₀ + n K₁ + n² K₂ over π, lower bands (3, band, size)."""
    shear = 0.5 * modulus / (1.0 + poisson_ratio)
    lame = 2.0 * shear * poisson_ratio / (1.0 - 2.0 * poisson_ratio)
    law = np.diag([2 * shear] * 3 + [shear] * 3)
    law[:3, :3] += lame
    nodes = _ACROSS * (walls.size - 1)
    size = 3 * nodes * (_ALONG * (rings.size - 1) + 1)
    band = 3 * nodes * (_ALONG + 1)
    parts = np.zeros((3, band, size))
    local_z, local_r = np.divmod(np.arange((_ALONG + 1) * (_ACROSS + 1)), _ACROSS + 1)
    for j, (z0, z1) in enumerate(pairwise(rings)):
        for i, (r0, r1) in enumerate(pairwise(walls)):
            at_r, at_z = _ACROSS * i + local_r, _ALONG * j + local_z
            numbers = 3 * (nodes * at_z + at_r)[:, None] + np.arange(3)
            held = np.repeat((at_r == nodes)[:, None], 3, axis=1)
            if rings[0] == 0.0:
                held[:, 2] |= at_z == 0  # the plane of symmetry
            free = np.flatnonzero(~held.ravel())
            rows = numbers.ravel()[free]
            strains, weights = _strains(r0, r1, z0, z1)
            strains = strains[..., free]
            own = np.einsum("mqsa,nqsb->mnab", strains, law @ strains * weights, optimize=True)
            below = rows[:, None] - rows[None, :]
            a, b = np.nonzero(below >= 0)
            for part, matrix in zip(parts, (own[0, 0], own[0, 1] + own[1, 0], own[1, 1])):
                np.add.at(part, (below[a, b], rows[b]), matrix[a, b])
    parts[0, 0, parts[0, 0] == 0.0] = 1.0  # held degrees of freedom
    return parts


def _strains(r0: float, r1: float, z0: float, z1: float) -> tuple[Array, Array]:
    """Strains of an element at order 0 and what each order adds, (2, q, 6, dofs); weights.

    rr, θθ, zz (cos nθ), rθ (sin), rz (cos), θz (sin) over (u, v, w) of each node.
    """
    points_r, weights_r, values_r, slopes_r = _reference(_ACROSS)
    _, weights_z, values_z, slopes_z = _reference(_ALONG)
    half_r, half_z = 0.5 * (r1 - r0), 0.5 * (z1 - z0)
    radius = np.tile(r0 + half_r * (1.0 + points_r), weights_z.size)[:, None]
    shape = np.kron(values_z, values_r)
    by_r = np.kron(values_z, slopes_r) / half_r
    by_z = np.kron(slopes_z, values_r) / half_z
    around = shape / radius
    strains = np.zeros((2, radius.size, 6, shape.shape[1], 3))
    still, turning = strains
    still[:, 0, :, 0], still[:, 1, :, 0], still[:, 2, :, 2] = by_r, around, by_z
    still[:, 3, :, 1] = by_r - around
    still[:, 4, :, 0], still[:, 4, :, 2] = by_z, by_r
    still[:, 5, :, 1] = by_z
    turning[:, 1, :, 1], turning[:, 3, :, 0], turning[:, 5, :, 2] = around, -around, -around
    weight = np.kron(weights_z, weights_r)[:, None] * half_r * half_z * radius
    return strains.reshape(2, radius.size, 6, -1), weight[:, :, None]
