"""Loops over large wind fields."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

_COLUMNS = 256  # numbers of a row that are worked on at once: all rows of them stay in the cache
_TILE = 32
SPARE = 256
"""Random words left unread at the end of a bulk; one number takes far fewer."""


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
                for a in range(first, min(na, first + _TILE)):
                    for t in range(start, stop):
                        out[t, r, a] = values[a, r, t]
    return out


@njit(cache=True, nogil=True, error_model="numpy")
def draw_normals(words, start, out, taken, scale, density, edge):
    """Fill `out` (n,) float32 with standard normal numbers of random `words` from `start` on.

    The ziggurat of [Marsaglia and Tsang 2000] with the `layers` of `loadflow.wind.noise`, as numpy
    reads its bits. Returns the next word and how many numbers there are: fewer than n where the
    words end.
    """
    unit = np.float32(1.0 / 16777216.0)
    edge, slope = np.float32(edge), np.float32(1.0 / edge)
    word, made = start, 0
    while made < out.size and word < words.size - SPARE:
        bits = words[word]
        word += 1
        layer, size = bits & np.uint32(0xFF), bits >> np.uint32(9)
        sign = np.float32(1.0) - np.float32((bits >> np.uint32(7)) & np.uint32(2))
        x = np.float32(np.int32(size)) * scale[layer] * sign
        if size < taken[layer]:
            out[made] = x
            made += 1
        elif layer == 0:  # the tail
            while True:
                first = np.float32(words[word] >> np.uint32(8)) * unit
                second = np.float32(words[word + 1] >> np.uint32(8)) * unit
                word += 2
                beyond = -slope * np.float32(math.log1p(-np.float64(first)))
                other = -np.float32(math.log1p(-np.float64(second)))
                if other + other > beyond * beyond:
                    break
            away = edge + beyond
            out[made] = -away if (size >> np.uint32(8)) & np.uint32(1) else away
            made += 1
        else:
            share = np.float32(words[word] >> np.uint32(8)) * unit
            word += 1
            height = (density[layer - 1] - density[layer]) * share + density[layer]
            if height < math.exp(-0.5 * np.float64(x) * np.float64(x)):
                out[made] = x
                made += 1
    return word, made
