"""Cubic B-splines on equidistant knots."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_ENDS = {"smooth": [1.0, -4.0, 6.0, -4.0, 1.0], "even": [-1.0, 0.0, 1.0], "odd": [1.0, -2.0, 1.0]}


def spline(values: Array, axis: int, ends: Literal["smooth", "even", "odd"]) -> Array:
    """Coefficients of the spline through `values`, two more than these along `axis`.

    The value at knot i is (c_i + 4 c_{i+1} + c_{i+2}) / 6. The ends are not-a-knot ("smooth"), or
    both a mirror of the function ("even") or of its negative ("odd").

    Examples
    --------
    >>> c = spline(np.arange(5.0) ** 2, 0, "smooth")
    >>> bool(np.allclose((c[:-2] + 4 * c[1:-1] + c[2:]) / 6, np.arange(5.0) ** 2))
    True
    """
    n = values.shape[axis]
    matrix = np.zeros((n + 2, n + 2))
    for row in range(n):
        matrix[row, row : row + 3] = 1 / 6, 4 / 6, 1 / 6
    rule = _ENDS[ends]
    matrix[n, : len(rule)] = rule
    matrix[n + 1, -len(rule) :] = rule
    inverse = np.linalg.inv(matrix)[:, :n]
    return np.moveaxis(np.tensordot(inverse, values, (1, axis)), 0, axis)
