"""Equilibria by way of those under smaller and larger loads of the same direction."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.newton import Solution

Newton = Callable[[float, Solution | None], Solution]
"""Newton's method under a share of the load, from a solution under another one, or cold."""

_SHARES = (1 / 3, 3.0, 0.1, 10.0)  # of the load, under which a film is sought first
_BUDGET = 6  # Newton steps in all, in multiples of those of a solution
_SHORTEST = 0.02  # step of the logarithm of the share below which the way is given up


def solve_from_other_loads(newton: Newton, most: int, effort: Effort) -> Solution | None:
    """Equilibrium that Newton's method from a first position misses; None: not found this way.

    A bore of several lobes has loads at which the first position lies on the far side of a
    ridge; under another load it does not, and the load then goes to its size in steps.

    Parameters
    ----------
    newton : callable
        Newton's method.
    most : int
        Newton steps of one solution.
    effort : Effort
        What the way may take; `newton` notes its steps.
    """
    spent = 0
    for first in _SHARES:
        state = newton(first, None)
        spent += state.iterations
        way = math.log(first)
        step = -way
        while state.converged and way != 0.0 and spent < _BUDGET * most and abs(step) > _SHORTEST:
            if effort.over:
                return None
            target = way + step if abs(step) < abs(way) else 0.0
            trial = newton(math.exp(target), state)
            spent += trial.iterations
            if trial.converged:
                state, way, step = trial, target, -target
            else:
                step *= 0.5
        if state.converged and way == 0.0:
            return replace(state, iterations=spent)
        if spent >= _BUDGET * most or effort.over:
            break
    return None
