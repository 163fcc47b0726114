"""Newton for the film alone, and for film and shaft together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film import Film, Linear

Array = NDArray[np.float64]

_QUADRATIC = 1e-7  # a step this small leaves an error near its square: the last factors are exact


@dataclass(frozen=True)
class Solution:
    """A solved film: unknowns, position (clearances), last linearisation, convergence."""

    u: Array
    position: Array
    linear: Linear
    converged: bool
    iterations: int
    residual: float


def solve_film(
    film: Film, u: Array, position: Array, velocity: Array, tolerance: float, max_iterations: int
) -> Solution:
    """Pressure of the film at a given position and velocity."""
    u = u.copy()
    weights = np.ones(1)
    for iteration in range(1, max_iterations + 1):
        linear = film.linearise(u, position, velocity)
        change = film.correct(u, linear.columns[:1], weights)
        if change < _QUADRATIC:
            residual = film.imbalance(u, position, velocity)
            if residual < tolerance:
                return Solution(u, position, linear, True, iteration, residual)
    return Solution(
        u, position, linear, False, max_iterations, film.imbalance(u, position, velocity)
    )


def solve_equilibrium(
    film: Film, force: Array, u: Array, position: Array, tolerance: float, max_iterations: int
) -> Solution:
    """Position at which the film carries `force`, by one Newton for film and shaft.

    Each step solves the film's linearisation for the pressure and for its derivative by the
    position; the exact 2×2 stiffness that follows gives the step of the shaft.
    """
    rest = np.zeros(2)
    u = u.copy()
    for iteration in range(1, max_iterations + 1):
        linear = film.linearise(u, position, rest)
        target = limited(position, _solve2(linear.stiffness, force - linear.load))
        weights = np.concatenate([[1.0], film.coordinates(target) - film.coordinates(position)])
        change = film.correct(u, linear.columns, weights)
        gap = 1.0 - np.hypot(*position)
        change = max(change, float(np.hypot(*(target - position))) / gap)
        position = target
        if change < _QUADRATIC:
            residual = film.imbalance(u, position, rest, force)
            if residual < tolerance:
                return Solution(u, position, linear, True, iteration, residual)
    residual = film.imbalance(u, position, rest, force)
    return Solution(u, position, linear, False, max_iterations, residual)


def limited(position: Array, step: Array) -> Array:
    """Position after `step`, halved until the narrowest gap keeps a third of its height."""
    limit = 1.0 - 0.3 * (1.0 - np.hypot(*position))
    while not np.hypot(*(position + step)) < limit:
        step = 0.5 * step
    return position + step


def _solve2(matrix: Array, rhs: Array) -> Array:
    """Solve a 2×2 system; a singular one gives no step."""
    (a, b), (c, d) = matrix.tolist()
    det = a * d - b * c
    if det == 0.0:
        return np.zeros(2)
    return np.array([(d * rhs[0] - b * rhs[1]) / det, (a * rhs[1] - c * rhs[0]) / det])


def no_film(film: Film) -> Solution:
    """The answer where there is none: NaN, not converged."""
    nothing = np.full((2, 2), np.nan)
    linear = Linear(nothing[0], nothing, nothing, nothing)
    return Solution(film.start(), nothing[0], linear, False, 0, np.inf)
