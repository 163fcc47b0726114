"""Films in soft shells, where Newton's method from a cold start leads nowhere: step by step."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import EVERY, DiscreteFilm
from loadflow.journal.film.gap import KEPT
from loadflow.journal.solvers.newton import Solution, solve_equilibrium, solve_film

Array = NDArray[np.float64]

_FIRST_LOAD = 0.2  # share of the load from which it is raised in steps
_LOADS, _BRIEF = 12, 25  # number of those steps, and Newton steps of each
_ROOM = 0.02  # gap, in clearances, that the first position leaves in the shell at rest
_BACK = 0.7  # share of a step, or of the way, that is tried next
_NEAREST = 0.01  # share of the way to a position from which it is approached at least
_APPROACHES = 30  # steps of that
APART = 1e-6  # gap, in clearances, below which an elastic shell has met the shaft


def solve_in_load_steps(
    film: DiscreteFilm,
    force: Array,
    position: Array,
    tolerance: float,
    free: slice | NDArray[np.int64] = EVERY,
) -> Solution:
    """As `solve_equilibrium`, from a light load on: for shells that the load itself must open."""
    film.relax()
    u, place = film.start(), position.copy()
    place[free] = _FIRST_LOAD * position[free]
    done, step, spent = 0.0, _FIRST_LOAD, 0
    for _ in range(_LOADS):
        share = min(1.0, done + step)
        state = solve_equilibrium(film, share * force, u, place, tolerance, _BRIEF, free=free)
        spent += state.iterations
        if not state.converged:
            step *= 0.5
        elif share < 1.0:
            done, step, u, place = share, 1.5 * step, state.u, state.position
        else:
            break
    return replace(state, converged=state.converged and share == 1.0, iterations=spent)


def solve_by_approach(
    film: DiscreteFilm, position: Array, velocity: Array, tolerance: float, max_iterations: int
) -> Solution:
    """As `solve_film`; where the shell at rest would leave no room, the shaft comes in steps."""
    gap, limits = film.gap, (tolerance, max_iterations)
    way = np.where(np.arange(gap.size) < 2, position, 0.0)
    share = 1.0
    while gap.narrowest(position - (1.0 - share) * way) < _ROOM and share > _NEAREST:
        share *= _BACK
    place = position - (1.0 - share) * way
    state = _settled(film, place, *limits)
    spent, u = state.iterations, state.u
    for _ in range(_APPROACHES):
        place = position - (1.0 - share) * way
        moving = velocity if share == 1.0 else 0.0 * velocity
        state = solve_film(film, u, place, moving, *limits)
        spent += state.iterations
        if share == 1.0 or not state.converged:
            break
        room, step, u = gap.narrowest(place), 1.0 - share, state.u
        while gap.narrowest(place + step * way) < KEPT * room and step > _NEAREST:
            step *= _BACK
        share = min(1.0, share + step)
    return replace(state, converged=state.converged and share == 1.0, iterations=spent)


def _settled(
    film: DiscreteFilm, position: Array, tolerance: float, max_iterations: int
) -> Solution:
    """Film at a place with room, from a start at rest or, if that closes it, from a rigid shell."""
    rest, limits = 0.0 * position, (tolerance, max_iterations)
    first = solve_film(film, film.start(), position, rest, *limits)
    if first.converged and film.room_left(position) > APART:
        return first
    film.relax(give=0.0)
    rigid = solve_film(film, film.start(), position, rest, *limits)
    film.relax()
    state = solve_film(film, rigid.u, position, rest, *limits)
    return replace(state, iterations=first.iterations + rigid.iterations + state.iterations)
