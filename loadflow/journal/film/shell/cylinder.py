"""A thick-walled cylinder under pressure on its bore: finite elements, harmonic by harmonic.

Around, everything is a Fourier series: under the pressure p cos nθ the displacements are
u cos nθ (radial), v sin nθ (around), w cos nθ (along), so that (r, z) is all that is meshed
[Wilson 1965, AIAA J. 3]. Orders do not couple, and enter the strains linearly.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded
from scipy.sparse import csr_array, diags_array, kron, tril

Array = NDArray[np.float64]

ACROSS, _ALONG = 3, 2  # degrees of the elements through the wall and along it
_LOW, _BETWEEN = 8, 32  # orders from which on they lie between others, and how many these are
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
        Mean displacement outward of each ring over a pressure cos nθ on each ring, m/Pa. Where
        there are many, those of high orders, which n enters as a real number and smoothly, lie on
        a polynomial in log n through some (Chebyshev's points): to 1e-6 of each.
    """
    rings, words = tuple(z_edges.tolist()), (inner, outer, modulus, poisson_ratio)
    many = orders >= _LOW
    if many.sum() <= _BETWEEN:
        return _cached(tuple(orders.tolist()), rings, *words).copy()
    found = np.empty((orders.size, len(rings) - 1, len(rings) - 1))
    found[~many] = _cached(tuple(orders[~many].tolist()), rings, *words)
    ends = np.log([_LOW, orders.max()])
    nodes = np.polynomial.chebyshev.chebpts1(_BETWEEN)
    at = np.exp(ends[0] + 0.5 * (1.0 + nodes) * (ends[1] - ends[0]))
    values = at[:, None, None] * _cached(tuple(at.tolist()), rings, *words)
    places = 2.0 * (np.log(orders[many]) - ends[0]) / (ends[1] - ends[0]) - 1.0
    series, wanted = (np.polynomial.chebyshev.chebvander(x, _BETWEEN - 1) for x in (nodes, places))
    shares = wanted @ np.linalg.inv(series) / orders[many, None]
    found[many] = np.tensordot(shares, values, axes=1)
    return found


@lru_cache(maxsize=8)
def _cached(
    orders: tuple[float, ...],
    z_edges: tuple[float, ...],
    inner: float,
    outer: float,
    modulus: float,
    poisson_ratio: float,
) -> Array:
    rings = np.array(z_edges)
    walls = wall_edges(inner, outer, float(np.diff(rings).min()))
    parts, along = _stiffness(walls, rings, modulus, poisson_ratio)
    nodes = ACROSS * (walls.size - 1)  # through the wall, without the outside
    at_nodes = np.zeros((*along.shape, nodes, 3))
    at_nodes[:, :, 0, 0] = along  # radially, on the bore
    pushed = at_nodes.reshape(along.shape[0], -1)
    means = pushed / np.diff(rings)[:, None]
    found = []
    for n in orders:
        band = parts[0] + n * parts[1] + n * n * parts[2]
        found.append(means @ solveh_banded(band, inner * pushed.T, lower=True))
    return np.array(found)


def wall_edges(inner: float, outer: float, first: float) -> Array:
    """Edges of the elements through the wall, which lengthen from the bore on."""
    count = 1
    while first * (_COARSER**count - 1) / (_COARSER - 1) < outer - inner:
        count += 1
    shares = _COARSER ** np.arange(count)
    return inner + (outer - inner) * np.append(0.0, np.cumsum(shares)) / shares.sum()


U, V, W = range(3)
VALUE, SLOPE, OVER_R = range(3)

_STRAINS = (
    ((U, SLOPE, VALUE, 0, 1.0),),
    ((U, OVER_R, VALUE, 0, 1.0), (V, OVER_R, VALUE, 1, 1.0)),
    ((W, VALUE, SLOPE, 0, 1.0),),
    ((V, SLOPE, VALUE, 0, 1.0), (V, OVER_R, VALUE, 0, -1.0), (U, OVER_R, VALUE, 1, -1.0)),
    ((U, VALUE, SLOPE, 0, 1.0), (W, SLOPE, VALUE, 0, 1.0)),
    ((V, VALUE, SLOPE, 0, 1.0), (W, OVER_R, VALUE, 1, -1.0)),
)
"""Strains rr, θθ, zz (cos nθ), rθ (sin), rz (cos), θz (sin): sums of a displacement, what is taken
of it through the wall and along, the power of n, and a factor."""


def lame_constants(modulus: float, poisson_ratio: float) -> tuple[float, float]:
    """λ and μ of a solid, Pa."""
    shear = 0.5 * modulus / (1.0 + poisson_ratio)
    return 2.0 * shear * poisson_ratio / (1.0 - 2.0 * poisson_ratio), shear


def stiffness_parts(
    across: Array, length: Array, modulus: float, poisson_ratio: float
) -> list[Any]:
    """Parts K₀, K₁, K₂ of the stiffness K₀ + n K₁ + n² K₂ over π, sparse, of no node held.

    `across` and `length` are `products` through the wall and along; unknowns run over the
    displacements, then through the wall, then along.
    """
    lame, shear = lame_constants(modulus, poisson_ratio)
    law = np.diag([2 * shear] * 3 + [shear] * 3)
    law[:3, :3] += lame
    size = 3 * length.shape[-1] * across.shape[-1]
    parts: list[Any] = [csr_array((size, size)) for _ in range(3)]
    for s, t in zip(*np.nonzero(law)):
        for (a, r, z, m, left), (b, p, q, n, right) in product(_STRAINS[s], _STRAINS[t]):
            pair = csr_array(([law[s, t] * left * right], ([a], [b])), shape=(3, 3))
            parts[m + n] = parts[m + n] + kron(length[z, q], kron(across[r, p], pair))
    return parts


def _stiffness(
    walls: Array, rings: Array, modulus: float, poisson_ratio: float
) -> tuple[Array, Array]:
    """Parts K₀, K₁, K₂ of the stiffness K₀ + n K₁ + n² K₂ over π, lower bands (3, band, size).

    The mesh is a product of two lines, and so are the functions: each part is a sum of Kronecker
    products of matrices along the axis and through the wall. And the integrals of the functions
    along each ring (ring, node).
    """
    from skfem import ElementLineP2, ElementLinePp

    through, along = (
        line_functions(walls, ElementLinePp(ACROSS)),
        line_functions(rings, ElementLineP2()),
    )
    across = products(through, radial=True)[:, :, :-1, :-1]  # the outside is held
    length = products(along, radial=False)
    parts = stiffness_parts(across, length, modulus, poisson_ratio)
    free = np.ones((length.shape[-1], across.shape[-1], 3))
    if rings[0] == 0.0:
        free[0, :, W] = 0.0  # the plane of symmetry
    mask = diags_array(free.ravel())
    kept = [mask @ part @ mask for part in parts]
    kept[0] = kept[0] + diags_array(1.0 - free.ravel())
    size = 3 * length.shape[-1] * across.shape[-1]
    bands = np.zeros((3, 3 * across.shape[-1] * (_ALONG + 1), size))
    for band, part in zip(bands, kept):
        lower = tril(part).tocoo()
        band[lower.row - lower.col, lower.col] = lower.data
    return bands, ring_loads(along)


def line_functions(edges: Array, element: Any) -> Any:
    """Functions on the elements between edges, integrated exactly but for what is over r."""
    from skfem import Basis, MeshLine

    return Basis(MeshLine(edges), element, intorder=2 * element.maxdeg + 1)


def _order(basis: Any) -> NDArray[np.int64]:
    """Numbers of the functions from one end to the other."""
    inside = [*basis.interior_dofs.T, np.array([], int)]
    corners = basis.nodal_dofs[0]
    return np.concatenate([np.append(corner, own) for corner, own in zip(corners, inside)])


def products(basis: Any, radial: bool) -> Array:
    """Integrals of the products of value, slope and value over r, (3, 3, node, node).

    Through the wall over r dr; along it, where nothing is divided by r, the last are 0.
    """
    from skfem import BilinearForm

    def taken(u: Any, x: Array) -> tuple[Any, ...]:
        return u, u.grad[0], u / x if radial else 0.0 * u

    order = _order(basis)
    found = np.zeros((3, 3, order.size, order.size))
    for i, j in product(range(3), repeat=2):

        @BilinearForm
        def form(u: Any, v: Any, w: Any, i: int = i, j: int = j) -> Any:
            x = w.x[0]
            return taken(v, x)[i] * taken(u, x)[j] * (x if radial else 1.0)

        found[i, j] = form.assemble(basis).toarray()[np.ix_(order, order)]
    return found


def ring_loads(basis: Any) -> Array:
    """Integral of each function over each element, (element, node)."""
    elements = np.arange(basis.nelems)
    found = np.zeros((basis.nelems, basis.N))
    for (own,), numbers in zip(basis.basis, basis.element_dofs):
        found[elements, numbers] = (own * basis.dx).sum(axis=-1)
    return found[:, _order(basis)]
