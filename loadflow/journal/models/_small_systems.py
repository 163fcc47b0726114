"""Compiled: systems of a few unknowns, such as a shaft, or grooves and what feeds them."""

from __future__ import annotations

from loadflow.journal.models._compile import inner, once


@once
def solve_system(system, size):
    """Solve the linear `system` (size, size + 1) in place with pivots; False if it is singular."""
    for j in range(size):
        best = j
        for i in range(j + 1, size):
            if abs(system[i, j]) > abs(system[best, j]):
                best = i
        if not abs(system[best, j]) > 0.0:
            return False
        for k in range(size + 1):
            system[j, k], system[best, k] = system[best, k], system[j, k]
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
        best = j
        for i in range(j + 1, size):
            if abs(matrix[i, j]) > abs(matrix[best, j]):
                best = i
        if not abs(matrix[best, j]) > 0.0:
            return False
        order[j] = best
        for k in range(size):
            matrix[j, k], matrix[best, k] = matrix[best, k], matrix[j, k]
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
