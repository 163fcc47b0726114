"""Tilting pads through time: which of them have a film, and how they begin when they get one.

Pads have no inertia, so that their tilts are unknowns of each time step as the place of the shaft
is, each with the balance of moments about its pivot. What a pad is left away from, where no film
holds it at rest, is oil at the pressure of the bearing ends, and the pad lies still.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.solvers.motion.history import Past
from loadflow.journal.solvers.pads.statics import unload_other_pads

Array = NDArray[np.float64]
Rows = NDArray[np.int64]


FLAT = 1e-3  # tilt, in clearances, below which a film is about to turn its pad the other way
NEAR = 0.1  # gap at the pivot, clearances, beyond what holds a pad at rest, that squeeze may hold
TILT = 0.02  # clearances, at which such a pad begins
LATER = 0.125  # share of a step down to which the pads stay: one that is let go drops the shaft


def other_pads(gap: ShapedGap, last: Past, reached: Array, speed: float) -> Rows:
    """Pads that may have a film in a step from `last` in which Newton ended at `reached`, without.

    Those that the step has left flat lose theirs. If none has, those whose gap is hardly wider
    than that of a pad held at rest get one; on a single pad, where a shaft is free to go sideways,
    all do: what holds it is the squeeze of the others, however far they are.
    """
    if np.isfinite(reached).all():
        flat = [row for row in last.pads.tolist() if abs(gap.lift(row, reached)) < FLAT]
        if flat:
            return np.setdiff1d(last.pads, flat)
    near = gap.pivots @ last.position[:2] > 1.0 - gap.pad_curve(speed).widest - NEAR
    return np.union1d(last.pads, gap.pads[near] if last.pads.size > 1 else gap.pads)


def with_pads(
    film: DiscreteFilm,
    gap: ShapedGap,
    states: list[Past],
    pads: Rows,
    renewed: Callable[[float, Array, Array, Rows], Past],
) -> list[Past]:
    """The same `states`, the last one of today, had `pads` and no other had a film all the time.

    A pad that gets a film begins at the tilt that it takes at rest, one that loses it lies flat;
    both at the pressure of the ends. `renewed` makes a history of
    a time, unknowns, a position and pads.
    """
    last = states[-1]
    gone, new = np.setdiff1d(last.pads, pads), np.setdiff1d(pads, last.pads)
    unload_other_pads(film, gap, pads)
    tilted = gap.lifted(last.position, film.speed)
    for row in new.tolist():
        missing = math.copysign(TILT, film.speed) - gap.lift(row, tilted)
        tilted[row] += missing if abs(gap.lift(row, tilted)) < TILT else 0.0
    bare = gap.columns_of(np.union1d(gone, new))[:, None]
    out = []
    for state in states:
        position = state.position.copy()
        position[gone], position[new] = 0.0, tilted[new]
        fresh = renewed(state.time, np.where(bare, film.start(), state.u), position, pads)
        # oil beside a pad without a film does not count as that of the film; what a film that has
        # not been solved yet gains is not known
        gained = state.gained + fresh.volume - state.volume
        gain = math.nan if new.size else fresh.gain
        out.append(replace(fresh, gain=gain, gained=gained, ahead=state.ahead))
    return out
