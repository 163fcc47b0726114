"""Compiled: the linear system of a film's Newton step, in LAPACK's storage of a band.

Of films on "grid"; those of the rung "reduced", which need no exchange of rows, have a storage and
kernels of their own (`loadflow.journal.models._band_kernels`).

`factors` (n, width) hold a column of the band in each row, with room for the fill that an exchange
of rows makes: entry (i, j) of the matrix is ``factors[j, 2 kl + i − j]``, as `dgbtrf` has it, and
all else is 0, see `band_storage`. The balance of a film is dominated by its diagonal in each
column, so that hardly ever a row is exchanged: the upper factor stays as narrow as the matrix, and
`PANEL` columns at a time pass all that stand behind them, and all right-hand sides.
"""

from __future__ import annotations

import numpy as np

from loadflow.numerics.lanes import LANES, lanes_for, larger, largest, magnitude, put, spread, take
from loadflow.numerics.linked import contracted

PANEL = 4  # columns that are eliminated together

# parts that are called at one place are compiled as parts of it
_whole, _part = contracted(cache=True), contracted(inline="always")


def band_storage(count: int, bandwidth: int) -> np.ndarray:
    """Room for the matrix of so many unknowns, (n, width).

    Behind each column there is room for what a panel reads beyond it. Numbers of one row of the
    matrix stand a multiple of `LANES` apart, so that a panel reads whole lines of the cache.
    """
    mid = 2 * bandwidth
    width = lanes_for(mid + lanes_for(bandwidth) + PANEL) + 1
    room = np.zeros(count * width + 2 * LANES)
    begin = -(room.ctypes.data // room.itemsize + mid) % LANES
    return room[begin : begin + count * width].reshape(count, width)


@_whole
def factorise(factors, kl, pivots):
    """LU of a matrix with `kl` bands on each side in place, with the pivots that `dgbtrf` takes.

    `pivots` (n,) are the rows that were exchanged. Returns the number of the first column, from 1
    on, without a pivot; 0 if there is none.
    """
    n, reach, j = factors.shape[0], kl, 0
    length = -(-kl // LANES) * LANES
    while j < n:
        done = 0
        if kl >= PANEL and j + PANEL <= n:
            done, quiet = _panel(factors, kl, pivots, j, length)
            if not quiet:
                _pass_on(factors, kl, j, done, reach, length)
            j += done
        if done < PANEL and j < n:
            reach, found = _column(factors, kl, pivots, j, reach)
            if not found:
                return j + 1
            j += 1
    return 0


@_part
def _panel(factors, kl, pivots, j, length):
    """Eliminate up to `PANEL` columns from `j` on that need no exchange, among themselves.

    Returns how many, and whether none of them has an entry below its pivot.
    """
    width, mid, quiet = factors.shape[1], 2 * kl, True
    for p in range(PANEL):
        first = (j + p) * width + mid + 1
        most = magnitude(take(factors, first))
        for i in range(LANES, length, LANES):
            most = larger(most, magnitude(take(factors, first + i)))
        size, other = abs(factors[j + p, mid]), largest(most)
        if not (other <= size and size > 0.0):
            return p, quiet
        pivots[j + p] = j + p
        if other == 0.0:
            continue
        quiet, inverse = False, 1.0 / factors[j + p, mid]
        for i in range(0, length, LANES):
            put(factors, first + i, take(factors, first + i) * inverse)
        for q in range(p + 1, PANEL):
            factor = factors[j + q, mid + p - q]
            if factor != 0.0:
                rest = (j + q) * width + mid + p - q + 1
                for i in range(0, length, LANES):
                    put(
                        factors,
                        rest + i,
                        take(factors, rest + i) - take(factors, first + i) * factor,
                    )
    return PANEL, quiet


@_part
def _pass_on(factors, kl, j, done, reach, length):
    """Let the columns behind a panel at `j`, of which so many are `done`, follow it."""
    n, width = factors.shape
    mid = 2 * kl
    a1 = factors[j, mid + 1]
    a2 = factors[j, mid + 2]
    a3 = factors[j, mid + 3]
    b2 = factors[j + 1, mid + 1] if done > 1 else 0.0
    b3 = factors[j + 1, mid + 2] if done > 1 else 0.0
    c3 = factors[j + 2, mid + 1] if done > 2 else 0.0
    below = j * width + mid + PANEL
    step = width - 1
    for col in range(j + PANEL, min(j + PANEL + reach, n)):
        at, far = mid + j - col, col - j - reach  # so many rows of the panel lie outside the band
        u0 = factors[col, at] if far <= 0 else 0.0
        u1 = factors[col, at + 1] - a1 * u0 if far <= 1 else 0.0
        u2 = factors[col, at + 2] - a2 * u0 - b2 * u1 if far <= 2 else 0.0
        u3 = factors[col, at + 3] - a3 * u0 - b3 * u1 - c3 * u2
        if far <= 1:
            factors[col, at + 1] = u1
        if far <= 2:
            factors[col, at + 2] = u2
        factors[col, at + 3] = u3
        if done < PANEL:
            u1, u2, u3 = u1 if done > 1 else 0.0, u2 if done > 2 else 0.0, 0.0
        s0, s1, s2, s3 = spread(u0), spread(u1), spread(u2), spread(u3)
        first = col * width + at + PANEL
        for i in range(0, length, LANES):
            row = take(factors, first + i) - take(factors, below + i) * s0
            row = row - take(factors, below + step + i) * s1
            row = row - take(factors, below + 2 * step + i) * s2
            put(factors, first + i, row - take(factors, below + 3 * step + i) * s3)


@_part
def _column(factors, kl, pivots, j, reach):
    """Eliminate column `j`, whose pivot may stand in another row.

    Returns how far the upper factor reaches from now on, and whether there is a pivot.
    """
    n, mid, own = factors.shape[0], 2 * kl, factors[j]
    place = mid
    for i in range(mid + 1, mid + 1 + min(kl, n - 1 - j)):
        if abs(own[i]) > abs(own[place]):
            place = i
    pivots[j] = j + place - mid
    if own[place] == 0.0:
        return reach, False
    if place != mid:
        reach = mid
    end = min(j + reach + 1, n)
    if place != mid:
        for col in range(j, end):
            one, other = mid + j - col, place + j - col
            kept = factors[col, one]
            factors[col, one] = factors[col, other]
            factors[col, other] = kept
    inverse = 1.0 / own[mid]
    for i in range(mid + 1, mid + 1 + kl):
        own[i] *= inverse
    for col in range(j + 1, end):
        factor, rest = factors[col, mid + j - col], factors[col]
        if factor != 0.0:
            for i in range(kl):
                rest[mid + j - col + 1 + i] -= factor * own[mid + 1 + i]
    return reach, True


@_whole
def substitute(factors, kl, pivots, columns):
    """Solve for each of `columns` (l, n) in place, with what `factorise` has left.

    All of them pass the factors together.
    """
    n, mid, reach = factors.shape[0], 2 * kl, kl
    length = -(-kl // LANES) * LANES
    last = n - PANEL - length  # a panel from here on would reach beyond the columns
    j = 0
    while j < n:
        kept = kl >= PANEL and j <= last
        for p in range(PANEL if kept else 1):
            kept = kept and pivots[j + p] == j + p
            reach = reach if pivots[j + p] == j + p else mid
        if kept:
            _lower_panel(factors, kl, j, length, columns)
            j += PANEL
            continue
        below, other = factors[j, mid + 1 : mid + 1 + min(kl, n - 1 - j)], pivots[j]
        for c in range(columns.shape[0]):
            column = columns[c]
            value = column[other]
            column[other] = column[j]
            column[j] = value
            rest = column[j + 1 : j + 1 + below.size]
            for i in range(below.size):
                rest[i] -= value * below[i]
        j += 1
    j = n - 1
    while j >= 0:
        if kl >= PANEL and reach == kl and j >= length + PANEL - 1:
            _upper_panel(factors, kl, j, length, columns)
            j -= PANEL
            continue
        far = min(reach, j)
        above, pivot = factors[j, mid - far : mid], factors[j, mid]
        for c in range(columns.shape[0]):
            value = columns[c, j] / pivot
            columns[c, j] = value
            rest = columns[c, j - far : j]
            for i in range(far):
                rest[i] -= value * above[i]
        j -= 1


@_part
def _lower_panel(factors, kl, j, length, columns):
    """Take what is known from row `j` on of the lower factor to the rows behind a panel."""
    width, mid, n = factors.shape[1], 2 * kl, columns.shape[1]
    a, b, c = factors[j], factors[j + 1], factors[j + 2]
    below = j * width + mid + PANEL
    step = width - 1
    for number in range(columns.shape[0]):
        x = columns[number]
        x0 = x[j]
        x1 = x[j + 1] - a[mid + 1] * x0
        x2 = x[j + 2] - a[mid + 2] * x0 - b[mid + 1] * x1
        x3 = x[j + 3] - a[mid + 3] * x0 - b[mid + 2] * x1 - c[mid + 1] * x2
        x[j + 1], x[j + 2], x[j + 3] = x1, x2, x3
        s0, s1, s2, s3 = spread(x0), spread(x1), spread(x2), spread(x3)
        first = number * n + j + PANEL
        for i in range(0, length, LANES):
            row = take(columns, first + i) - take(factors, below + i) * s0
            row = row - take(factors, below + step + i) * s1
            row = row - take(factors, below + 2 * step + i) * s2
            put(columns, first + i, row - take(factors, below + 3 * step + i) * s3)


@_part
def _upper_panel(factors, kl, j, length, columns):
    """Solve the rows of a panel that ends at `j`, and take them out of those before it."""
    width, mid, n = factors.shape[1], 2 * kl, columns.shape[1]
    a, b, c, d = factors[j], factors[j - 1], factors[j - 2], factors[j - 3]
    step = width - 1
    above = j * width + mid - (PANEL - 1) - length
    for number in range(columns.shape[0]):
        x = columns[number]
        x0 = x[j] / a[mid]
        x1 = (x[j - 1] - a[mid - 1] * x0) / b[mid]
        x2 = (x[j - 2] - a[mid - 2] * x0 - b[mid - 1] * x1) / c[mid]
        x3 = (x[j - 3] - a[mid - 3] * x0 - b[mid - 2] * x1 - c[mid - 1] * x2) / d[mid]
        x[j], x[j - 1], x[j - 2], x[j - 3] = x0, x1, x2, x3
        s0, s1, s2, s3 = spread(x0), spread(x1), spread(x2), spread(x3)
        first = number * n + j - (PANEL - 1) - length
        for i in range(0, length, LANES):
            row = take(columns, first + i) - take(factors, above + i) * s0
            row = row - take(factors, above - step + i) * s1
            row = row - take(factors, above - 2 * step + i) * s2
            put(columns, first + i, row - take(factors, above - 3 * step + i) * s3)
