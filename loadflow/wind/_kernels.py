"""Loops over large wind fields."""

from __future__ import annotations

import numpy as np

from loadflow.numerics.linked import njit

_COLUMNS = 256  # numbers of a row that are worked on at once: all rows of them stay in the cache
_TILE = 32


@njit(cache=True, nogil=True)
def multiply_banded(rows, share, low, high, reach):
    """Replace the rows x of every block by ((1 − s) L₀ + s L₁) x, with s of each column.

    Parameters
    ----------
    rows : (blocks, order, n) array of float32
    share : (n,) array of float32
        s.
    low, high : (blocks, order, order) array of float32
        Lower factors L₀ and L₁.
    reach : int
        Number of diagonals below the main one that count.
    """
    blocks, order, n = rows.shape
    total = np.empty(_COLUMNS, np.float32)
    for b in range(blocks):
        for start in range(0, n, _COLUMNS):
            stop = min(n, start + _COLUMNS)
            width = stop - start
            s = share[start:stop]
            for i in range(order - 1, -1, -1):  # a row needs those above it as they were
                x = rows[b, i, start:stop]
                base, slope = low[b, i, i], high[b, i, i] - low[b, i, i]
                for c in range(width):
                    total[c] = (base + s[c] * slope) * x[c]
                for j in range(max(0, i - reach), i):
                    y = rows[b, j, start:stop]
                    base, slope = low[b, i, j], high[b, i, j] - low[b, i, j]
                    for c in range(width):
                        total[c] += (base + s[c] * slope) * y[c]
                for c in range(width):
                    x[c] = total[c]


@njit(cache=True, nogil=True)
def time_first(values):
    """Return (a, r, n) float32 as contiguous (n, r, a), in tiles that stay in the cache."""
    na, nr, n = values.shape
    out = np.empty((n, nr, na), np.float32)
    for start in range(0, n, _TILE):
        stop = min(n, start + _TILE)
        for r in range(nr):
            for first in range(0, na, _TILE):
                for t in range(start, stop):  # what is written lies together, not what is read
                    for a in range(first, min(na, first + _TILE)):
                        out[t, r, a] = values[a, r, t]
    return out
