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
