"""Equilibria on tilting pads that Newton's method misses, and loads that no pad can carry."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.load_stepping import has_touched, solve_from_held
from loadflow.journal.solvers.newton import Solution, no_film
from loadflow.journal.solvers.pads.statics import (
    balanced_film,
    flat_pads,
    solve_with_pads,
    unload_other_pads,
)
from loadflow.journal.solvers.path import solve_along_path

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
    """As `solve_with_pads`; where that leads nowhere, along the path of the load from there on, and
    on the `pads` alone by steps of the load.

    What ends without an answer says whether a film holds any pad that faces the load.
    """
    limits = tolerance, max_iterations
    on_pads = solve_with_pads(film, gap, force, position, shaft, *limits, effort)
    # a step to beyond the bore says nothing of where the shaft comes to
    touched = has_touched(film, on_pads) and gap.narrowest(on_pads.position) > 0.0
    if on_pads.converged or touched:
        return on_pads
    if not on_pads.lost.size:
        for start in (on_pads, _lightly(gap, force, position, on_pads)):
            along = _along_path(film, gap, force, shaft, *limits, effort, start)
            if along is not None:
                return along
    unload_other_pads(film, gap, pads)
    held = solve_from_held(film, force, position, *limits, effort, np.append(shaft, pads))
    if held.converged or has_touched(film, held):
        return held
    if on_pads.lost.size:
        return on_pads
    asked = film, gap, force[:2], position, *limits, effort
    searched = bool(force[:2].any()) and not effort.over
    return replace(held, unheld=searched and _holds_none(*asked))


def _lightly(gap: ShapedGap, force: Array, position: Array, ended: Solution) -> Solution:
    """Where all pads are sought that a film holds, with the shaft on the way along the load.

    `position` (m,) is as of `solve_with_pads`, and `ended` where that has.
    """
    place, size = position.copy(), math.hypot(*force[:2])
    if size > 0.0:
        place[:2] = _along(gap, force[:2] / size, _ALONG[-1])
    return replace(ended, position=place, free=np.append(np.arange(gap.shaft), gap.pads))


def _along(gap: ShapedGap, way: Array, share: float) -> Array:
    """Eccentricity (2,) at a share of the way to the bore, or of the clearance, along `way`."""
    return np.asarray(share * min(gap.reach(way, 0.0), 1.0) * way)


def _along_path(
    film: DiscreteFilm,
    gap: ShapedGap,
    force: Array,
    shaft: Rows,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
    start: Solution,
) -> Solution | None:
    """Equilibrium on the path of the load from `start` on, or its end where a pad meets the shaft.

    Of a shaft that lies aslant a film carries but a certain load, however near one end of a pad
    comes to it. Where the film has turned pads flat, the path goes on without them. None: it leads
    nowhere.
    """
    limits, pads = (tolerance, max_iterations), np.arange(gap.size)[start.free]
    pads = np.intersect1d(gap.pads, pads)
    while not effort.over:
        held, pads = balanced_film(film, gap, start, pads, *limits)
        effort.take(film, held.iterations)
        if not (held.converged and pads.size and gap.narrowest(held.position) > 0.0):
            return None
        free, until = np.append(shaft, pads), partial(_any_flat, film, gap, pads)
        start = solve_along_path(film, force, held, *limits, effort, free, until)
        if start.converged or has_touched(film, start):
            return start
        lost = flat_pads(film, gap, pads, start.position)
        if not lost.size:
            return None
        pads = np.setdiff1d(pads, lost)
    return None


def _any_flat(film: DiscreteFilm, gap: ShapedGap, pads: Rows, position: Array) -> bool:
    """Whether any of `pads` lies flat at `position`."""
    return flat_pads(film, gap, pads, position).size > 0


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
        place[:2] = _along(gap, way, share)
        there = replace(no_film(film), position=place)
        found, held = balanced_film(film, gap, there, facing, tolerance, max_iterations)
        effort.take(film, found.iterations)
        if held.size or not found.converged:
            return False
    return True
