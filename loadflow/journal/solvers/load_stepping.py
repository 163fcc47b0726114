"""Films from which Newton's method leads nowhere at once: by steps of the load, or of the way."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import EVERY, DiscreteFilm
from loadflow.journal.film.gap.gap import KEPT
from loadflow.journal.film.gap.rough import RoughGap, RoughShapedGap
from loadflow.journal.film.shell.elastic_film import ElasticFilm
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.newton import Solution, no_film, solve_equilibrium, solve_film

if TYPE_CHECKING:
    from loadflow.journal.film.gap.gap import BoreGap

Array = NDArray[np.float64]

_FIRST_LOAD = 0.2  # share of the load from which it is raised in steps
_LEAST_LOAD = 1e-3  # share below which a step of the load is given up
_LEAST_BEFORE_PATH = 0.03  # the same, where the path of the load is followed next
_FIRST_SHARE = 1e-4  # of its compliance, that a shell has first where it is softened in steps
_LEAST_SHARE = 0.01  # of the share that it has, below which such a step is given up
_CLOSING = 1e-3  # gap, in clearances, that is left before steps in which it closes
_CLOSED = 2  # such steps in a row, after which the shaft has met the shell
_STEPS, _STEPS_EACH = 16, 25  # Newton steps of all in multiples of those of each, and of each
_STRIDE = 0.25  # first share of the way from the load at the start to the one that is wanted
_SHORTEST = 1e-3  # of the lesser of both loads, below which such a step is given up
_STEPS_SHORT = 14  # Newton steps of each
_SLOWER = 0.01  # share of the speed that is tried next where none is found beside the standing one
_SLOWEST, _LEAST_GROWTH = 1e-8, 1.02  # of it, and growth in a step, below which it is given up
_BUDGET = 10  # of all, in multiples of those of a solution
_EASED = (0.9, 0.5, 0.1)  # of the way to the first position, at which a lighter film is sought
_FEW = 7  # Newton steps below which the next of these steps is twice as long
_FIRST_GAP = 0.02  # in clearances, that the first position leaves in the shell at rest
_BACK = 0.7  # share of a step, or of the way, that is tried next
_NEAREST = 0.01  # share of the way to a position from which it is approached at least
_APPROACHES = 30  # steps of that
TOUCHING = 1e-4  # gap, in clearances, below which a shaft has met a rigid bore
_NO_FILM = 1e-9  # gap, in clearances, below which there is none to carry more: less than an atom
APART = 1e-6  # gap, in clearances, below which an elastic shell has met the shaft


def has_touched(film: DiscreteFilm, solution: Solution) -> bool:
    """Whether the steps of the load have ended at a rigid bore, or at the end of its contact."""
    if film.contact is not None and not solution.residual < 1.0:
        return False  # what is missing is no rest of the load
    return not film.elastic and meets(film, solution.position)


def ended(film: DiscreteFilm, solution: Solution, effort: Effort) -> bool:
    """Whether a search has come to its end, or may go no farther."""
    return solution.converged or effort.over or has_touched(film, solution)


def meets(film: DiscreteFilm, position: Array) -> bool:
    """Whether the shaft at `position` meets a rigid bore, or its law of contact ends there."""
    if film.contact is None:
        return film.gap.narrowest(position) < TOUCHING
    gap = film.gap
    return isinstance(gap, (RoughGap, RoughShapedGap)) and gap.until_end(position) < TOUCHING * max(
        gap.rough.deepest, gap.roughness
    )


def solve_in_load_steps(
    film: DiscreteFilm,
    force: Array,
    position: Array,
    tolerance: float,
    effort: Effort,
    free: slice | NDArray[np.int64] = EVERY,
    has_path: bool = False,
) -> Solution:
    """As `solve_equilibrium`, from a light load on: for shells that the load itself must open.

    What is not reached ends at the film found last if it `has_path` that goes on there, else where
    the step after it was lost.
    """
    film.relax()
    u, place, state = film.start(), position.copy(), no_film(film)
    done, step, spent, left, closed = 0.0, _FIRST_LOAD, 0, math.inf, 0
    most = film.newton_steps(_STEPS_EACH)
    least = _LEAST_BEFORE_PATH if has_path else _LEAST_LOAD
    while step >= least and spent < _STEPS * most and not effort.over:
        share = min(1.0, done + step)
        if done == 0.0:
            place[free] = share * position[free]
        state = solve_equilibrium(film, share * force, u, place, tolerance, most, free=free)
        effort.take(film, state.iterations)
        spent += state.iterations
        if not state.converged:
            step *= 0.5
        elif share == 1.0:
            return replace(state, iterations=spent)
        else:
            done, u, place = share, state.u, state.position
            before, left = left, film.clearance_left(place)
            closed = closed + 1 if left <= min(before, 0.0) else 0
            if closed >= _CLOSED:  # more load presses the shaft but farther into the shell's ends
                break
            step *= 1.5 if state.iterations < _STEPS_EACH // 2 else 1.0
    if done and has_path:
        state = replace(state, u=u, position=place)
    film.place(state.u, state.position)
    missing = (1.0 - done) * math.hypot(*force[free]) / film.load_scale(force)
    return replace(state, converged=False, iterations=spent, residual=missing)


def in_rigid_bore(
    film: DiscreteFilm,
    force: Array,
    position: Array,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
    free: slice | NDArray[np.int64] = EVERY,
) -> Solution:
    """As `solve_equilibrium`, in an elastic shell that is held rigid."""
    film.relax(share=0.0)
    start = film.start(), position
    state = solve_equilibrium(film, force, *start, tolerance, max_iterations, free=free)
    effort.take(film, state.iterations)
    return state


def solve_by_stiffness(
    film: DiscreteFilm,
    force: Array,
    position: Array,
    tolerance: float,
    effort: Effort,
    free: slice | NDArray[np.int64] = EVERY,
    rigid: Solution | None = None,
) -> Solution:
    """As `solve_equilibrium`, from a `rigid` shell on, whose compliance grows to what it is."""
    most = film.newton_steps(_STEPS_EACH)
    asked = force, position, tolerance, 2 * most, effort, free
    state = rigid or in_rigid_bore(film, *asked)
    film.relax(share=0.0)
    spent = state.iterations
    if not state.converged:
        state = solve_from_held(film, *asked)
        spent += state.iterations
    share, step, left, closed = 0.0, _FIRST_SHARE, film.clearance_left(state.position), 0
    while state.converged and step >= _LEAST_SHARE * max(share, _FIRST_SHARE):
        at = min(1.0, share + step)
        film.relax(share=at)
        start = (state.u, state.position)
        trial = solve_equilibrium(film, force, *start, tolerance, most, free=free)
        effort.take(film, trial.iterations)
        spent += trial.iterations
        if trial.converged:
            if at == 1.0:
                return replace(trial, iterations=spent)
            state, share, left, closed = trial, at, film.clearance_left(trial.position), 0
            step *= 2.0 if trial.iterations < _STEPS_EACH // 2 else 1.2
        else:
            step *= 0.4
            closed = closed + 1 if film.clearance_left(trial.position) <= 0.0 else 0
        if closed >= _CLOSED and left < _CLOSING:  # the shell meets the shaft: show where
            return replace(trial, iterations=spent, residual=1.0 - share)
        if spent > _STEPS * most or effort.over:
            break
    if state.converged:  # show the gap that is left, in the shell that it was found in
        film.relax(share=share)
        film.place(state.u, state.position)
    return replace(state, converged=False, iterations=spent, residual=1.0 - share)


def solve_from_held(
    film: DiscreteFilm,
    force: Array,
    position: Array,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
    free: slice | NDArray[np.int64] = EVERY,
    shortest: float = _SHORTEST,
) -> Solution:
    """As `solve_equilibrium`, from the load that the film carries at `position` held.

    That load is known as soon as the film is solved there, whatever it is; from it the load goes
    straight to `force`, in steps as long as Newton's method follows, down to the `shortest` share,
    while the `effort` lasts.
    """
    state = solve_film(film, film.start(), position, 0.0 * position, tolerance, max_iterations)
    if film.contact is not None or film.thickening is not None:
        state = _eased(film, force, state, tolerance, max_iterations, free)
    effort.take(film, state.iterations)
    if not state.converged:
        return state
    first, spent, share, stride = state.linear.load, state.iterations, 0.0, _STRIDE
    short = max_iterations if film.law.moves_by_cells else _STEPS_SHORT
    trial = state
    lightest = math.hypot(*first[free]) / film.load_scale(force)
    shortest *= min(1.0, max(lightest, _SHORTEST))
    while stride >= shortest and spent < _BUDGET * max_iterations and not effort.over:
        at = min(1.0, share + stride)
        load = force + (1.0 - at) * (first - force)
        steps = max_iterations if at == 1.0 else short
        start = (state.u, state.position)
        trial = solve_equilibrium(film, load, *start, tolerance, steps, free=free)
        effort.take(film, trial.iterations)
        spent += trial.iterations
        if not trial.converged:
            stride *= 0.4
        elif at == 1.0:
            return replace(trial, iterations=spent)
        else:
            state, share = trial, at
            stride *= 2.0 if trial.iterations < _FEW else 1.0
            if film.gap.narrowest(state.position) < _NO_FILM:
                break
    missing = (1.0 - share) * math.hypot(*(force - first)[free]) / film.load_scale(force)
    if meets(film, trial.position):  # what the steps have come to
        state = replace(state, position=trial.position)
    return replace(
        state, converged=False, iterations=spent, residual=missing, rounding=trial.rounding
    )


def _eased(
    film: DiscreteFilm,
    force: Array,
    state: Solution,
    tolerance: float,
    max_iterations: int,
    free: slice | NDArray[np.int64],
) -> Solution:
    """Film no nearer to the shell than where it carries no more than `force`.

    Rough surfaces pressed together farther have pressures from which no step leads back; a liquid
    that pressure thickens has no film at all where one of even viscosity would need more than 1/α.
    """
    wanted, spent = math.hypot(*force[free]), state.iterations
    if state.converged and math.hypot(*state.linear.load[free]) <= wanted:
        return state
    far = state.position
    wide = cast("BoreGap", film.gap).widest(far, free)
    for share in _EASED:
        place = wide + share * (far - wide)
        state = solve_film(film, film.start(), place, 0.0 * place, tolerance, max_iterations)
        spent += state.iterations
        if state.converged and math.hypot(*state.linear.load[free]) <= wanted:
            break
    return replace(state, iterations=spent)


def stands(film: DiscreteFilm) -> bool:
    """Whether its shaft stands on asperities before it turns, where that is quickly found."""
    rough = film.contact is not None and film.speed != 0.0 and not film.gap.pads.size
    return rough and not (isinstance(film, ElasticFilm) and film.compliance.spreads)


def solve_by_speed(
    film: DiscreteFilm,
    force: Array,
    standing: Solution,
    speed: float,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
    free: slice | NDArray[np.int64] = EVERY,
) -> Solution | None:
    """As `solve_equilibrium` at a `speed`, rad/s, from the `standing` shaft, which comes up to it.

    Asperities alone carry a load at one place, as they press the harder the nearer they are, and
    nearer than the law of contact allows the shaft cannot come: what carries it at all speeds
    between is a path that does not end before. None: not found this way.
    """
    state, done, growth, at, spent = standing, 0.0, 1.0 / _SLOWER, 1.0, 0
    while state.converged and spent < _BUDGET * max_iterations:
        if growth < _LEAST_GROWTH or at < _SLOWEST or effort.over:
            break
        film.set_speed(at * speed)
        start = (state.u, state.position)
        trial = solve_equilibrium(film, force, *start, tolerance, max_iterations, free=free)
        effort.take(film, trial.iterations)
        spent += trial.iterations
        if trial.converged and at == 1.0:
            return replace(trial, iterations=spent)
        if trial.converged:
            state, done = trial, at
            growth = growth**2 if trial.iterations < _STEPS_SHORT else growth
        elif done:
            growth = growth**0.4
        at = min(1.0, done * growth) if done else _SLOWER * at
    film.set_speed(speed)
    return None


def solve_by_approach(
    film: DiscreteFilm, position: Array, velocity: Array, tolerance: float, max_iterations: int
) -> Solution:
    """As `solve_film`; where the shell at rest would leave no gap, the shaft comes in steps."""
    gap, limits = film.gap, (tolerance, max_iterations)
    way = np.where(np.arange(gap.size) < 2, position, 0.0)
    share = 1.0
    while gap.narrowest(position - (1.0 - share) * way) < _FIRST_GAP and share > _NEAREST:
        share *= _BACK
    place = position - (1.0 - share) * way
    state = _first_film(film, place, *limits)
    spent, u = state.iterations, state.u
    reached, stride = share if state.converged else 0.0, 1.0
    if not film.law.moves_by_cells:
        limits = (tolerance, min(max_iterations, _STEPS_EACH))
    for _ in range(_APPROACHES):
        place = position - (1.0 - share) * way
        moving = velocity if share == 1.0 else 0.0 * velocity
        state = solve_film(film, u, place, moving, *limits)
        spent += state.iterations
        if not state.converged:
            stride = 0.5 * (share - reached)
            if reached == 0.0 or stride < _SHORTEST:
                break
            share = reached + stride
            continue
        if share == 1.0:
            break
        least, step, u, reached = KEPT * gap.narrowest(place), 1.0 - share, state.u, share
        while gap.narrowest(place + step * way) < least and step > _NEAREST:
            step *= _BACK
        share = min(1.0, share + min(step, stride))
        stride *= 2.0
    return replace(state, converged=state.converged and share == 1.0, iterations=spent)


def _first_film(
    film: DiscreteFilm, position: Array, tolerance: float, max_iterations: int
) -> Solution:
    """Film at a place, from a start at rest or, if that closes the gap, from a rigid shell."""
    rest, limits = 0.0 * position, (tolerance, max_iterations)
    first = solve_film(film, film.start(), position, rest, *limits)
    if first.converged and film.clearance_left(position) > APART:
        return first
    film.relax(share=0.0)
    rigid = solve_film(film, film.start(), position, rest, *limits)
    film.relax()
    state = solve_film(film, rigid.u, position, rest, *limits)
    return replace(state, iterations=first.iterations + rigid.iterations + state.iterations)
