"""Functions known at scattered places: which places tell most, and values between them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Rows = NDArray[np.int64]

_SHADES = 1e-6  # of the largest, by which a column or a direction must vary to matter


def evened(values: Floats) -> Floats:
    """Columns of `values` (n, d) between −½ and ½, without those that hardly vary."""
    low, high = values.min(axis=0), values.max(axis=0)
    varies = high - low > _SHADES * np.abs(values).max(axis=0)
    return ((values - (low + high) / 2)[:, varies]) / (high - low)[varies]


def farthest(places: Floats, most: int) -> Rows:
    """Rows of `places` (n, d), each the farthest from those before it; the first is the oddest.

    There are as many as are different, and `most` of them at most.
    """
    away = np.square(places - places.mean(axis=0)).sum(axis=1)
    rows = [int(np.argmax(away))]
    away = np.full(len(places), np.inf)
    while len(rows) < most:
        away = np.minimum(away, np.square(places - places[rows[-1]]).sum(axis=1))
        if not away.any():
            break
        rows.append(int(np.argmax(away)))
    return np.array(rows)


def nearest(places: Floats, known: Floats) -> Rows:
    """Number of the nearest of `known` (k, d) for each of `places` (n, d)."""
    from scipy.spatial import KDTree

    return np.asarray(KDTree(known).query(places)[1])


def interpolation(known: Floats, values: Floats) -> Callable[[Floats], Floats]:
    """Function from places (n, d) to values (n, m), through `values` (k, m) at `known` (k, d).

    By cubic radial basis functions, which give straight functions exactly; k > d is needed. Along
    directions in which the known places hardly differ the function does not change: two columns
    that say the same, or one that no longer varies among these places, leave no system to solve.
    """
    from scipy.interpolate import RBFInterpolator

    middle = known.mean(axis=0)
    _, spread, axes = np.linalg.svd(known - middle, full_matrices=False)
    varies = axes[spread > _SHADES * spread[0]].T
    function = RBFInterpolator((known - middle) @ varies, values, kernel="cubic")

    def at(places: Floats) -> Floats:
        return np.asarray(function((places - middle) @ varies))

    return at
