"""What goes before a series, foretold backwards from it by linear prediction."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def foretell_past(rows: Array, order: int, count: int) -> Array:
    """Return `count` rows that go before `rows`, in their steps, as a process of the same spectrum.

    One filter for all columns, by Burg's method: stable for any series, and what the columns are
    to each other they are before it, too. Sines go on; what is not periodic falls back to its mean.
    Nothing leaves the range of the column.

    Parameters
    ----------
    rows : ndarray, shape (n, k)
        Series in even steps, in any units.
    order : int
        Coefficients of the filter, 1 … n − 2.
    count : int
        How many rows.

    Returns
    -------
    ndarray, shape (count, k)

    References
    ----------
    [Burg 1975], with the reflection coefficient k = 2 Σ f b / Σ (f² + b²) of the errors ahead and
    behind, summed over the columns, too.

    Examples
    --------
    >>> import numpy as np
    >>> wave = np.cos(0.3 * np.arange(-5, 200))[:, None]
    >>> bool(np.abs(foretell_past(wave[5:], 4, 5) - wave[:5]).max() < 0.05)
    True
    """
    mean, size = rows.mean(axis=0), rows.std(axis=0)
    ahead = (rows - mean) / np.where(size > 0.0, size, 1.0)
    ahead, behind = ahead[1:], ahead[:-1]
    filter_ = np.zeros(0)
    for _ in range(order):
        # sums, not products of matrices: threads of these wait for each other on a busy machine
        power = float((ahead * ahead).sum() + (behind * behind).sum())
        share = 2.0 * float((ahead * behind).sum()) / power if power > 0.0 else 0.0
        filter_ = np.append(filter_ - share * filter_[::-1], share)
        ahead, behind = (ahead - share * behind)[1:], (behind - share * ahead)[:-1]
    found = np.concatenate([np.empty((count, rows.shape[1])), rows[:order] - mean])
    for k in range(count - 1, -1, -1):
        found[k] = (filter_[:, None] * found[k + 1 : k + 1 + order]).sum(axis=0)
    return np.clip(found[:count] + mean, rows.min(axis=0), rows.max(axis=0))
