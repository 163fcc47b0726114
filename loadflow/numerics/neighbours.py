"""Order of cases in which neighbours follow each other, for solvers that go on from the last."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.linked import LINKED, njit

Array = NDArray[np.float64]

_WORTH = 0.5  # way through cases in another order, over that as they come, that is worth it


@njit(nogil=True, error_model="numpy", **LINKED)
def _square(a: Array, b: Array) -> float:
    """Square of the distance."""
    total = 0.0
    for k in range(a.shape[0]):
        total += (a[k] - b[k]) ** 2
    return total


@njit(cache=True, nogil=True, error_model="numpy")
def near_order(points: Array, chunk: int) -> NDArray[np.int64]:
    """Order (n,) of `points` (n, m) in which each is the nearest of those left to the one before.

    Each `chunk` of them stays together and begins with its first. What is a path already, as a
    series in time, stays as it comes: where the other way is more than half as long.
    """
    n = points.shape[0]
    order = np.arange(n)
    for first in range(0, n, chunk):
        some = order[first : min(first + chunk, n)]
        given, found = 0.0, 0.0
        for i in range(1, some.size):
            given += math.sqrt(_square(points[some[i]], points[some[i - 1]]))
        for i in range(1, some.size):
            nearest, least = i, np.inf
            for j in range(i, some.size):
                square = _square(points[some[j]], points[some[i - 1]])
                if square < least:
                    nearest, least = j, square
            some[i], some[nearest] = some[nearest], some[i]
            found += math.sqrt(least)
        if found > _WORTH * given:
            for i in range(some.size):
                some[i] = first + i
    return order
