"""Compiled: seats of the shells of two films that one shaft lies in.

A shell turns in its seat by an elastic part, and by what it has slid. The seat holds it by the
moment that would come of the elastic part alone, cut to the one at which it slides: return mapping
of an elastic, perfectly plastic joint, whose tangent makes the steps of Newton's method exact.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.models._compile import inner


@inner
def hold(shared, first, n, to):
    """Put what seats hold beyond the moments of their films into `missing`, between n − 1 and n.

    Unknowns of seats stand from `first` on, those of the moments before them; `held` becomes the
    share of the moment of each that it holds.
    """
    for k in range(shared.held.size):
        a = first + 2 * k
        asked = np.hypot(shared.new[a], shared.new[a + 1])
        most = shared.slip[n - 1, k]
        if most < np.inf:
            most += to * (shared.slip[n, k] - shared.slip[n - 1, k])
        shared.held[k] = most / asked if asked > most else 1.0
        for b in range(a, a + 2):
            shared.missing[b] = shared.held[k] * shared.new[b] - shared.new[b - 4]


@inner
def hold_slopes(shared, first):
    """Fill the rows of the `system` of moments, in those alone, and of seats from `first` on."""
    system = shared.system
    for b in range(first - 4, first):
        system[b, b] = 1.0
    for k in range(shared.held.size):
        a, share = first + 2 * k, shared.held[k]
        x, y = shared.new[a], shared.new[a + 1]
        along = share / (x * x + y * y) if share < 1.0 else 0.0  # a seat that slides gives way
        system[a, a] = share - along * x * x
        system[a, a + 1] = -along * x * y
        system[a + 1, a] = -along * x * y
        system[a + 1, a + 1] = share - along * y * y
        for b in range(a, a + 2):
            system[b, b - 4] = -1.0


@inner
def slide(one, other, shared, first):
    """Add what shells have slid in a step to their `slipped`; what is left, their seats hold."""
    for k in range(shared.held.size):
        side = one if k == 0 else other
        for a in range(2):
            b = first + 2 * k + a
            over = (1.0 - shared.held[k]) * shared.new[b]
            side.slipped[2 + a] -= side.lies[2 + a, b] * over
            shared.new[b] -= over
