"""Compiled: linear systems of columns of cells around a ring.

The cells of a column depend on each other, a cell on the one beside it in the next column alone: so
blocks stand on the diagonal, diagonals beside them. The last column, next to the first one, is left
until all others are eliminated. A block is held by its columns, each a row of lanes.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.models._compile import inner
from loadflow.numerics.lanes import LANES, aligned, put, spread, take, with_lane

Array = NDArray[np.float64]


class RingSystem(NamedTuple):
    """A system of nx columns of m cells, L lanes; after `factorise` what solves it.

    Attributes
    ----------
    block : array (nx, m, L)
        Derivatives of a column by its cells, one cell after another; then the inverse.
    left, right : array (nx, L)
        Derivatives by the cells to the left and to the right.
    ahead, behind : array (nx, m, L)
        What the last column adds to a solved one; what an unsolved one takes from the last.
    corner : array (2, m, L)
        Derivatives of the last column by the one that is eliminated, and of that by the last.
    row : array (L,)
        Numbers that are taken one by one.
    """

    block: Array
    left: Array
    right: Array
    ahead: Array
    behind: Array
    corner: Array
    row: Array


def ring_system(around: int, across: int, lanes: int) -> RingSystem:
    """Allocate a system."""
    blocks, rows = (around, across, lanes), (around, lanes)
    shapes = blocks, rows, rows, blocks, blocks, (2, across, lanes), (lanes,)
    return RingSystem._make(aligned(np.zeros(shape)) for shape in shapes)


@inner
def factorise(ring):
    """Eliminate column after column, in place and without pivoting; False if it breaks down.

    The columns of the balance are diagonally dominant but for the axial terms, which are positive
    definite, so that the pivots need no search.
    """
    block, left, right, corner, row = ring.block, ring.left, ring.right, ring.corner, ring.row
    ahead, behind = ring.ahead, ring.behind
    nx, m, wide = block.shape
    last = nx - 1
    corner[:] = 0.0
    for c in range(m):
        corner[0, c, c], corner[1, c, c] = right[last, c], left[0, c]
    for i in range(last):
        here, end = i * m * wide, last * m * wide
        if i == last - 1:
            for c in range(m):
                corner[0, c, c] += left[last, c]
                corner[1, c, c] += right[i, c]
        if not _invert(block, i, row):
            return False
        for at in range(0, wide, LANES):
            for c in range(m):
                onto, by = spread(0.0), spread(0.0)
                for k in range(m):
                    onto = onto + take(block, here + k * wide + at) * corner[1, c, k]
                    by = by + take(corner, k * wide + at) * block[i, c, k]
                put(ahead, here + c * wide + at, onto)
                put(behind, here + c * wide + at, by)
        for at in range(0, wide, LANES):
            for c in range(m):
                rest = take(block, end + c * wide + at)
                for k in range(m):
                    rest = rest - take(corner, k * wide + at) * ahead[i, c, k]
                put(block, end + c * wide + at, rest)
        for at in range(0, wide if i < last - 1 else 0, LANES):
            to_next = take(left, (i + 1) * wide + at)
            for c in range(m):
                place, beside = here + c * wide + at, -right[i, c]
                after = place + m * wide
                put(block, after, take(block, after) + to_next * take(block, place) * beside)
                put(corner, c * wide + at, take(behind, place) * beside)
                put(corner, (m + c) * wide + at, to_next * take(ahead, place) * -1.0)
    return _invert(block, last, row)


@inner
def _invert(block, i, row):
    """Invert the block of a column in place; False if it breaks down."""
    _, m, wide = block.shape
    here = i * m * wide
    for p in range(m):
        pivot = block[i, p, p]
        if not abs(pivot) > 0.0:  # NaN too
            return False
        inverse = 1.0 / pivot
        for c in range(m):
            row[c] = block[i, c, p] * inverse
        for at in range(0, wide, LANES):
            by, holds = take(block, here + p * wide + at), at <= p < at + LANES
            for c in range(m):
                rest = take(block, here + c * wide + at) - by * row[c]
                if holds:
                    rest = with_lane(rest, p - at, row[c])
                put(block, here + c * wide + at, rest)
            by = by * -inverse
            if holds:
                by = with_lane(by, p - at, inverse)
            put(block, here + p * wide + at, by)
    return True


@inner
def substitute(ring, columns, count):
    """Solve for the first `count` of `columns` (c, nx, L) in place, after `factorise`."""
    block, left, right, row = ring.block, ring.left, ring.right, ring.row
    ahead, behind = ring.ahead, ring.behind
    nx, m, wide = block.shape
    last = nx - 1
    for i in range(nx):
        here = i * m * wide
        for column in range(count):
            own, end = (column * nx + i) * wide, (column * nx + last) * wide
            given = columns[column, i]
            for at in range(0, wide, LANES):
                found = spread(0.0)
                for k in range(m):
                    found = found + take(block, here + k * wide + at) * given[k]
                put(row, at, found)
                if i < last:
                    rest = take(columns, end + at)
                    for k in range(m):
                        rest = rest - take(behind, here + k * wide + at) * given[k]
                    put(columns, end + at, rest)
                if i + 1 < last:
                    rest = take(columns, own + wide + at)
                    put(columns, own + wide + at, rest - take(left, (i + 1) * wide + at) * found)
            for at in range(0, wide, LANES):
                put(columns, own + at, take(row, at))
    for i in range(last - 1, -1, -1):
        here = i * m * wide
        for column in range(count):
            beside, end, own = columns[column, i + 1], columns[column, last], right[i]
            for at in range(0, wide, LANES):
                place = (column * nx + i) * wide + at
                found, more = take(columns, place), spread(0.0)
                for k in range(m):
                    found = found - take(ahead, here + k * wide + at) * end[k]
                if i + 1 < last:
                    for k in range(m):
                        more = more + take(block, here + k * wide + at) * (own[k] * beside[k])
                put(columns, place, found - more)
