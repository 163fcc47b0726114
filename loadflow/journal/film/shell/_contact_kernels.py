"""Asperities between the cells of a shell, compiled: what presses them, by how far each gives way.

The gap at a node runs straight between the cells around it: `lines` are the rows of the sparse
matrix that takes their growth to the nodes, (starts, cells, shares).
"""

from __future__ import annotations

from loadflow.journal.film.gap._rough_kernels import NO_CONTACT
from loadflow.numerics.linked import njit
from loadflow.tribology import kernels as laws


@njit(cache=True, nogil=True)
def press(rigid, growth, lines, cells, means, s, pressure, slope):
    """Fill the mean `pressure` of the cells (n,), Pa, and its change by the gap of each node (k,).

    The summits are `rigid` (k,) apart where nothing has grown; `means` (k,), Pa, take the unit of
    their pressure to the mean of the cell that a node lies in, 0 where there are none.
    """
    starts, sources, shares = lines
    pressure[:] = 0.0
    slope[:] = 0.0
    for i in range(rigid.size):
        gap = rigid[i]
        for j in range(starts[i], starts[i + 1]):
            gap += shares[j] * growth[sources[j]]
        if means[i] > 0.0 and gap <= NO_CONTACT * s:
            value, rise = laws.pressure_integral(gap / s)
            pressure[cells[i]] += means[i] * value
            slope[i] = means[i] * rise / s


@njit(cache=True, nogil=True)
def add_by_growth(slope, lines, cells, row, change):
    """Add what the growth of all cells changes in the pressure of those that touch, (count, n).

    `row` (n,) is the number of a cell among these; `slope` as of `press`.
    """
    starts, sources, shares = lines
    for i in range(slope.size):
        if slope[i] != 0.0:
            for j in range(starts[i], starts[i + 1]):
                change[row[cells[i]], sources[j]] += slope[i] * shares[j]
