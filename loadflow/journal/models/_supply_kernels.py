"""Compiled: points of the reduced film with effects that grooves of a supply hold."""

from __future__ import annotations

from loadflow.journal.cavitation import FILL
from loadflow.journal.models._composed_gap_kernels import MEAN, OPEN
from loadflow.journal.models._of_effects import beside


@beside(lambda film, work, first, last, rate: 0.0)
def hold_points(film, work, first, last, rate):
    """Leave the pressure of a supply as it is in the columns `first` … `last`; the largest.

    What its points are missing is what their grooves feed, but for what is stored in them.
    """
    nx, m, largest = film.ring.cos.size, film.nodes.slopes.shape[1], 0.0
    fill, mean, columns = work.state[FILL], work.gap[MEAN], work.columns
    opens, squeeze = work.gap[OPEN], work.squeeze
    if first == 0:
        work.fed[:] = 0.0
    for column in range(first, last):
        for i in range(nx):
            width = film.ring.slope * film.ring.width[i]
            for k in range(m):
                j = film.held.grooves[i, k]
                if j >= 0:
                    if column == 0:
                        stored = rate * mean[i, k] + opens[i, k] * squeeze[i, k]
                        stored = stored * fill[i, k] - work.liquid[0, i, k]
                        stored *= width * film.nodes.weights[k]
                        work.fed[j] += columns[0, i, k] - stored
                    columns[column, i, k] = 0.0
                largest = max(largest, abs(columns[column, i, k]))
    return largest


@beside(lambda film, system: None)
def hold_in_matrix(film, system):
    """The same in the derivatives of the residual."""
    m = film.nodes.slopes.shape[1]
    for i in range(film.ring.cos.size):
        for k in range(m):
            if film.held.grooves[i, k] >= 0:
                system.left[i, k], system.right[i, k] = 0.0, 0.0
                for c in range(m):
                    system.block[i, c, k] = 0.0
                system.block[i, k, k] = 1.0
