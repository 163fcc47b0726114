"""Equilibria on tilting pads that Newton's method misses, and loads that no pad can carry."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap_shaped import ShapedGap
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.load_stepping import has_touched, solve_from_held
from loadflow.journal.solvers.newton import Solution, no_film
from loadflow.journal.solvers.pads import balanced_film, solve_with_pads, unload_other_pads

Array = NDArray[np.float64]
Rows = NDArray[np.int64]

_ALONG = (0.9, 0.6, 0.3)  # of the way to the bore, at which pads are sought that a film holds


def search_on_pads(
    film: DiscreteFilm,
    gap: ShapedGap,
    force: Array,
    position: Array,
    shaft: Rows,
    pads: Rows,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
) -> Solution:
    """As `solve_with_pads`; where that leads nowhere, on the `pads` alone by steps of the load.

    What ends without an answer says whether a film holds any pad that faces the load.
    """
    limits = tolerance, max_iterations
    on_pads = solve_with_pads(film, gap, force, position, shaft, *limits, effort)
    if on_pads.converged:
        return on_pads
    unload_other_pads(film, gap, pads)
    held = solve_from_held(film, force, position, *limits, effort, np.append(shaft, pads))
    if held.converged or has_touched(film, held):
        return held
    if on_pads.lost.size:
        return on_pads
    asked = film, gap, force[:2], position, *limits, effort
    searched = bool(force[:2].any()) and not effort.over
    return replace(held, unheld=searched and _holds_none(*asked))


def _holds_none(
    film: DiscreteFilm,
    gap: ShapedGap,
    load: Array,
    position: Array,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
) -> bool:
    """Whether no film holds a pad that faces the `load` (2,), with the shaft on the way along it.

    Each turns its pad flat and on until one end meets the shaft, as that of a pad whose pivot lies
    before its middle. `position` (m,) is as of `solve_with_pads`.
    """
    way = load / math.hypot(*load)
    facing = gap.pads[gap.pivots @ way > 0.0]
    for share in _ALONG:
        place = position.copy()
        place[:2] = share * min(gap.reach(way, 0.0), 1.0) * way
        there = replace(no_film(film), position=place)
        found, held = balanced_film(film, gap, there, facing, tolerance, max_iterations)
        effort.take(film, found.iterations)
        if held.size or not found.converged:
            return False
    return True
