"""Compiled: systems of a few unknowns, such as a shaft, or grooves and what feeds them."""

from __future__ import annotations

from loadflow.journal.models._compile import inner, once


@inner
def _bring_pivot(rows, j, size, wide):
    """Swap with row `j` that of the pivot of its column; the number of that, −1 if none has one.

    Of `size` rows, of `wide` numbers.
    """
    best = j
    for i in range(j + 1, size):
        if abs(rows[i, j]) > abs(rows[best, j]):
            best = i
    if not abs(rows[best, j]) > 0.0:
        return -1
    for k in range(wide):
        rows[j, k], rows[best, k] = rows[best, k], rows[j, k]
    return best


@once
def solve_system(system, size):
    """Solve the linear `system` (size, size + 1) in place with pivots; False if it is singular."""
    for j in range(size):
        if _bring_pivot(system, j, size, size + 1) < 0:
            return False
        for i in range(size):
            if i != j:
                factor = system[i, j] / system[j, j]
                for k in range(j, size + 1):
                    system[i, k] -= factor * system[j, k]
    for j in range(size):
        system[j, size] /= system[j, j]
    return True


@inner
def fill_upper(stiffness):
    """Make a stiffness (4, 4) symmetric by its lower half."""
    for a in range(4):
        for b in range(a):
            stiffness[b, a] = stiffness[a, b]


@once
def eliminate(matrix, order):
    """Factors of a square `matrix`, in place, and the rows taken in turn; False if singular."""
    size = order.size
    for j in range(size):
        order[j] = _bring_pivot(matrix, j, size, size)
        if order[j] < 0:
            return False
        for i in range(j + 1, size):
            matrix[i, j] /= matrix[j, j]
            factor = matrix[i, j]
            for k in range(j + 1, size):
                matrix[i, k] -= factor * matrix[j, k]
    return True


@inner
def substitute_into(matrix, order, values):
    """Solve for `values`, in place, by the factors that `eliminate` has made."""
    size = order.size
    for j in range(size):
        other = order[j]
        values[j], values[other] = values[other], values[j]
    for j in range(size):
        for k in range(j):
            values[j] -= matrix[j, k] * values[k]
    for j in range(size - 1, -1, -1):
        for k in range(j + 1, size):
            values[j] -= matrix[j, k] * values[k]
        values[j] /= matrix[j, j]
