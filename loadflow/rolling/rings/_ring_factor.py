"""Compiled Cholesky factor of the tangent of flexible rings, modes eliminated.

The matrix (row, wide) holds the upper half of the tangent, of the modes first, then of the five
rigid unknowns, filled up with zeros to a multiple of `LANES` both ways; what stands below the
diagonal may be anything. Rows lie along each other, so that eight of them go side by side. On the
diagonal the factor has the inverse of its pivots.

Orders of sums are written out here. Each kernel that calls another holds a copy of it, and where a
compiler may reorder sums, it does so by copy: a process that compiles takes another copy than one
that reads the cache, and rounds differently.
"""

from __future__ import annotations

import math

from loadflow.numerics.lanes import LANES, put, take, total
from loadflow.numerics.linked import LINKED, contracted


@contracted(forceinline=True, **LINKED)
def _pass_on(matrix, b, done):
    """Let eight rows from `b` on follow the first `done` ones."""
    wide = matrix.shape[1]
    first = b * wide
    for at in range(b, wide, LANES):
        here = first + at
        r0, r1 = take(matrix, here), take(matrix, here + wide)
        r2, r3 = take(matrix, here + 2 * wide), take(matrix, here + 3 * wide)
        r4, r5 = take(matrix, here + 4 * wide), take(matrix, here + 5 * wide)
        r6, r7 = take(matrix, here + 6 * wide), take(matrix, here + 7 * wide)
        for k in range(done):
            line, row = matrix[k], take(matrix, k * wide + at)
            r0, r1 = r0 - line[b] * row, r1 - line[b + 1] * row
            r2, r3 = r2 - line[b + 2] * row, r3 - line[b + 3] * row
            r4, r5 = r4 - line[b + 4] * row, r5 - line[b + 5] * row
            r6, r7 = r6 - line[b + 6] * row, r7 - line[b + 7] * row
        put(matrix, here, r0)
        put(matrix, here + wide, r1)
        put(matrix, here + 2 * wide, r2)
        put(matrix, here + 3 * wide, r3)
        put(matrix, here + 4 * wide, r4)
        put(matrix, here + 5 * wide, r5)
        put(matrix, here + 6 * wide, r6)
        put(matrix, here + 7 * wide, r7)


@contracted(**LINKED)
def factorise(matrix, modes):
    """Replace the rows of so many `modes` by those of the factor, the others by what is left."""
    wide, size = matrix.shape[1], modes + 5
    for b in range(0, size, LANES):
        _pass_on(matrix, b, min(b, modes))
        for c in range(b, min(b + LANES, modes)):
            scale = 1.0 / math.sqrt(matrix[c, c])
            for at in range(b, wide, LANES):
                put(matrix, c * wide + at, take(matrix, c * wide + at) * scale)
            matrix[c, c] = scale
            for d in range(c + 1, min(b + LANES, size)):
                amount = matrix[c, d]
                for at in range(b, wide, LANES):
                    place = d * wide + at
                    put(matrix, place, take(matrix, place) - amount * take(matrix, c * wide + at))


@contracted(**LINKED)
def forward(factor, modes, column):
    """Eliminate the modes from a right-hand side (wide,); the five rigid ones stand behind them."""
    wide = factor.shape[1]
    for b in range(0, modes, LANES):
        last = min(b + LANES, modes)
        for k in range(b, last):
            column[k] *= factor[k, k]
            for c in range(k + 1, b + LANES):
                column[c] -= column[k] * factor[k, c]
        for at in range(b + LANES, wide, LANES):
            row = take(column, at)
            for k in range(b, last):
                row = row - column[k] * take(factor, k * wide + at)
            put(column, at, row)


@contracted(**LINKED)
def backward(factor, modes, column):
    """Replace what `forward` left of the modes by the solution; the rigid ones are solved."""
    wide = factor.shape[1]
    for b in range((modes - 1) // LANES * LANES, -1, -LANES):
        for k in range(min(b + LANES, modes) - 1, b - 1, -1):
            value = column[k]
            if b + LANES < wide:
                felt = take(factor, k * wide + b + LANES) * take(column, b + LANES)
                for at in range(b + 2 * LANES, wide, LANES):
                    felt = felt + take(factor, k * wide + at) * take(column, at)
                value -= total(felt)
            for c in range(k + 1, b + LANES):
                value -= factor[k, c] * column[c]
            column[k] = value * factor[k, k]
