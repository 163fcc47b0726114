"""Loops over large wind fields."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from loadflow.numerics.linked import LINKED

_COLUMNS = 256  # numbers of a row that are worked on at once: all rows of them stay in the cache
_TILE = 32
_WORDS = 1 << 16  # of 64 bits, drawn at a time
_TAIL = 3.6541528853610088  # where the tail of the ziggurat begins


def _ziggurat():
    """Bounds, widths (negative ones behind) and heights of the 256 strips, in single precision."""
    edge, end = np.zeros(257), math.exp(-0.5 * _TAIL**2)
    area = _TAIL * end + math.sqrt(0.5 * math.pi) * math.erfc(_TAIL / math.sqrt(2.0))
    edge[256], edge[255] = area / end, _TAIL
    for i in range(254, 0, -1):
        edge[i] = math.sqrt(-2.0 * math.log(area / edge[i + 1] + math.exp(-0.5 * edge[i + 1] ** 2)))
    width = np.append(edge[256], edge[1:256])  # the lowest strip, which has the tail, comes first
    bound = np.round(np.append(_TAIL, edge[:255]) / width * 2**23).astype(np.uint32)
    width = (np.append(width, -width) / 2**23).astype(np.float32)
    return bound, width, np.exp(-0.5 * edge[:256] ** 2).astype(np.float32)


_BOUND, _WIDTH, _HEIGHT = _ziggurat()


@njit(nogil=True, error_model="numpy", **LINKED)
def _share(word):
    """Number in 0 … 1 of a word of 32 bits."""
    return np.float32(word >> 8) * np.float32(2.0**-24)


@njit(cache=True, nogil=True, error_model="numpy")
def _normal_row(words, place, count, row):
    """Turn `words` of 32 bits from `place` on into `count` normal numbers; `row` takes the first.

    Returns the place behind the last word, and -1 if there are too few of them.
    """
    tail, inverse = np.float32(_TAIL), np.float32(1.0 / _TAIL)
    n = 0
    while n < count:
        if place >= words.size:
            return -1
        word = words[place]
        place += 1
        strip, size = word & 0xFF, (word >> 9) & 0x7FFFFF
        x = np.float32(size) * _WIDTH[word & 0x1FF]
        if size >= _BOUND[strip]:
            if strip == 0:
                beyond, other = np.float32(0.0), np.float32(0.0)
                while not np.float32(other + other) > np.float32(beyond * beyond):
                    if place + 2 > words.size:
                        return -1
                    beyond = np.float32(-inverse * np.float32(math.log1p(-_share(words[place]))))
                    other = -np.float32(math.log1p(-_share(words[place + 1])))
                    place += 2
                x = np.float32(tail + beyond)
                if (size >> 8) & 1:
                    x = -x
            else:
                if place >= words.size:
                    return -1
                low, high = _HEIGHT[strip], _HEIGHT[strip - 1]
                at = (high - low) * _share(words[place]) + low
                place += 1
                if not at < math.exp(-0.5 * float(x) * float(x)):
                    continue
        if n < row.size:
            row[n] = x
        n += 1
    return place


def normal_rows(seed, drawn, rows):
    """Fill `rows` (n, m) of float32 with the first m of `drawn` normal numbers each.

    They are those of ``numpy.random.default_rng(seed).standard_normal(dtype=np.float32)``, bit for
    bit, by the ziggurat of [Marsaglia and Tsang 2000] that numpy takes, in less than half of its
    time: the words come in one call, and nothing is called for each number.
    """
    bits = np.random.default_rng(seed).bit_generator
    words, place = np.empty(0, np.uint32), 0
    for row in rows:
        while (end := _normal_row(words, place, drawn, row)) < 0:
            more = bits.random_raw(_WORDS).astype("<u8", copy=False).view("<u4")  # low half first
            words, place = np.concatenate([words[place:], more]), 0
        place = end


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
