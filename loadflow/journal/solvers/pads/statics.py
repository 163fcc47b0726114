"""Films on tilting pads, step by step: each pad between bounds, then the shaft on all of them.

Between pads lie grooves of known pressure, so that with the shaft held the moment of each pad's
film depends on its own tilt alone. It falls from one side of zero to the other as the pad lifts
from flat to where its end meets the shaft, but not steadily: a Newton step from a tilt that is too
small leads to none at all.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.rows import following
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.newton import (
    Motion,
    Solution,
    no_film,
    solve_equilibrium,
    solve_film,
)

Array = NDArray[np.float64]
Rows = NDArray[np.int64]
_Place = tuple[Solution, Rows]  # film at a position of the shaft, and the pads that it holds

_ROUNDS = 40  # films of a shaft that is held
_FLATTEST, _STEEPEST = 1e-4, 0.999  # share of the lift at which a pad meets the shaft
_FLAT = 1e-3  # share of the same below which a film turns its pad the other way, flat as it is
_STEEP = (0.97, 0.9, 0.75, 0.5, 0.25)  # shares of it at which pads are tried that lie flat
_STEEP_TRIED = 0.3  # share of it at which pads without a film are tried in an equilibrium
_BALANCED = 1e-6  # moment of a pad over load scale and arm, at which its tilt is good enough
_TOUCHING = 1e-9  # gap, in clearances, that is none
_KEPT = 0.5  # of the effort, for other searches
_LEFT = 1e-4  # moment, in the same unit, above which a pad is not held
_SHAFTS, _HALVINGS = 40, 12  # positions of the shaft, and how often a step to one is halved
_LOOSE = 1e4  # condition of the stiffness above which a shaft may go aside
_ASIDE = 1e-3  # stiffness that a shaft has sideways on a single pad, loads over clearance
_BACK_ON = 0.97  # share of the gap at which a pad has come off, below which it is tried again
_NEAR = 1e-3  # share of the load that may be missing for Newton's method to take over
_BESIDE = 1e-3  # way, in clearances, to a place that is just beside


def balance_pads(
    film: DiscreteFilm,
    gap: ShapedGap,
    start: Solution,
    pads: Rows,
    tolerance: float,
    max_iterations: int,
) -> tuple[Solution, NDArray[np.bool_]]:
    """Film at the position of `start`, the `pads` tilted until they have no moment, and which do.

    A pad that its film turns the other way, even where it lies flat, has none that holds it.
    """
    position, u, spent = start.position.copy(), start.u, 0
    if not pads.size:
        still = solve_film(film, film.start(), position, 0.0 * position, tolerance, max_iterations)
        return still, np.ones(0, dtype=bool)
    sign = math.copysign(1.0, film.speed)
    lifts, most = _lifts(film, gap, pads, position)
    if not (most > 0.0).all():  # a pad that meets the shaft however it tilts
        return replace(start, converged=False, iterations=0), np.zeros(pads.size, dtype=bool)
    low, high = _FLATTEST * most, _STEEPEST * most
    lifts = np.where((lifts > low) & (lifts < high), lifts, np.sqrt(low * high))
    scale = film.load_scale(np.zeros(1))
    state, moments, flat = start, np.zeros(pads.size), np.zeros(pads.size, dtype=bool)
    for _ in range(_ROUNDS):
        for row, lift in zip(pads.tolist(), lifts.tolist()):
            position[row] += sign * lift - gap.lift(row, position)
        state = solve_film(film, u, position, 0.0 * position, tolerance, max_iterations)
        spent += state.iterations
        if not state.converged:
            state = solve_film(film, film.start(), position, 0.0 * position, tolerance, 200)
            spent += state.iterations
            if not state.converged:
                break
        u = state.u
        moments = sign * state.linear.load[pads]
        scale = max(scale, math.hypot(*state.linear.load[: gap.shaft]))
        flat = (moments > 0) & (lifts < _FLAT * most)
        left = (np.abs(moments) >= _BALANCED * scale) & (high - low >= 1e-9 * most)
        if not np.any(left & ~flat):
            break
        low, high = np.where(moments < 0, lifts, low), np.where(moments > 0, lifts, high)
        slopes = np.diag(state.linear.stiffness)[pads]
        with np.errstate(divide="ignore", invalid="ignore"):
            aim = lifts - moments / slopes
        good = (slopes > 0) & (aim > low) & (aim < high)
        middle = np.where(high > 4 * low, np.sqrt(low * high), 0.5 * (low + high))
        lifts = np.where(good, aim, middle)
    return replace(state, iterations=spent), (np.abs(moments) < _LEFT * scale) & ~flat


def _lifts(film: DiscreteFilm, gap: ShapedGap, pads: Rows, position: Array) -> tuple[Array, Array]:
    """Lifts of `pads` the way that a film tilts them, and those at which they meet the shaft."""
    sign = math.copysign(1.0, film.speed)
    lifts = [sign * gap.lift(row, position) for row in pads.tolist()]
    most = [gap.widest_lift(row, position, sign) for row in pads.tolist()]
    return np.array(lifts), np.array(most)


def _over_pivots(gap: ShapedGap, position: Array) -> Array:
    """Gaps over the pivots of flat pads, clearances, without relief."""
    return np.asarray(1.0 - gap.pivots @ position[:2])


def flat_pads(film: DiscreteFilm, gap: ShapedGap, pads: Rows, position: Array) -> Rows:
    """Those of `pads` that lie flat at `position`, as a film turns them that does not hold them."""
    lifts, most = _lifts(film, gap, pads, position)
    return pads[lifts < _FLAT * most]


def unload_other_pads(film: DiscreteFilm, gap: ShapedGap, pads: Rows) -> None:
    """Take the film off all pads that tilt but `pads`."""
    film.unload(gap.columns_of(np.setdiff1d(gap.pads, pads)))


def columns_without_film(gap: ShapedGap, found: Solution) -> NDArray[np.bool_]:
    """Columns of cells (nx,) of the pads that have no film in a solution."""
    return gap.columns_of(np.setdiff1d(gap.pads, np.arange(gap.size)[found.free]))


def _without(film: DiscreteFilm, gap: ShapedGap, start: Solution, pads: Rows) -> Solution:
    """`start` with no film on, and no tilt of, all pads but `pads`."""
    others = np.setdiff1d(gap.pads, pads)
    position = start.position.copy()
    position[others] = 0.0
    u = np.where(gap.columns_of(others)[:, None], film.start(), start.u)
    return replace(start, u=u, position=position)


def balanced_film(
    film: DiscreteFilm,
    gap: ShapedGap,
    start: Solution,
    some: Rows,
    tolerance: float,
    max_iterations: int,
) -> tuple[Solution, Rows]:
    """Film at the position of `start` on those of `some` pads that it holds, and these."""
    pads, spent = np.intersect1d(some, gap.may_hold(start.position, film.speed)), 0
    while True:
        unload_other_pads(film, gap, pads)
        start = _without(film, gap, start, pads)
        state, held = balance_pads(film, gap, start, pads, tolerance, max_iterations)
        spent += state.iterations
        if state.converged and not held.all():
            start, steps = _steeper(film, gap, state, pads[~held], tolerance, max_iterations)
            state, held = balance_pads(film, gap, start, pads, tolerance, max_iterations)
            spent += steps + state.iterations
        if held.all() or not state.converged:
            return replace(state, iterations=spent), pads
        pads = pads[held]


def _steeper(
    film: DiscreteFilm,
    gap: ShapedGap,
    state: Solution,
    pads: Rows,
    tolerance: float,
    max_iterations: int,
) -> tuple[Solution, int]:
    """`state` with `pads` as steep as their film tilts them farther, and the Newton steps for it.

    Of two tilts without moment the larger is stable: a pad turned flat by a small tilt may be held
    by a large one, all the more where its surface is not an arc.
    """
    sign, spent, best = math.copysign(1.0, film.speed), 0, state
    most = np.array([gap.widest_lift(row, state.position, sign) for row in pads])
    found = np.zeros(pads.size, dtype=bool)
    for share in _STEEP:
        position = best.position.copy()
        for row, lift in zip(pads[~found].tolist(), (share * most)[~found].tolist()):
            position[row] += sign * lift - gap.lift(row, position)
        trial = solve_film(film, film.start(), position, 0.0 * position, tolerance, max_iterations)
        spent += trial.iterations
        if trial.converged:
            found |= sign * trial.linear.load[pads] < 0.0
            best = trial
        if found.all():
            break
    return best, spent


def film_on_pads(
    film: DiscreteFilm,
    gap: ShapedGap,
    position: Array,
    velocity: Array,
    pads: Rows,
    tolerance: float,
    max_iterations: int,
) -> Solution:
    """Film at a given position of the shaft, `pads` without moment; they follow its `velocity`."""
    limits, nothing = (tolerance, max_iterations), np.zeros(gap.size)
    first, may_hold = replace(no_film(film), position=position), gap.may_hold(position, film.speed)
    if np.array_equal(pads, may_hold):
        first = solve_film(film, film.start(), position, nothing, *limits)
        if pads.size:
            first = solve_equilibrium(film, nothing, first.u, position, *limits, free=pads)
    if not first.converged:
        first, pads = balanced_film(film, gap, replace(first, position=position), may_hold, *limits)
        if first.converged and pads.size:
            where = (first.u, first.position)
            first = solve_equilibrium(film, nothing, *where, *limits, free=pads)
    first = replace(first, free=pads)
    if not velocity.any() or not first.converged:
        return first
    every, moving = np.append(np.arange(gap.shaft), pads), velocity.copy()
    stiffness = first.linear.stiffness[np.ix_(every, every)]
    moving[pads] = -following(stiffness, gap.shaft) @ moving[: gap.shaft]
    start, motion = (first.u, first.position), Motion(offset=-moving)
    return solve_equilibrium(film, nothing, *start, *limits, motion, pads)


def with_further_pads(
    film: DiscreteFilm,
    gap: ShapedGap,
    force: Array,
    found: Solution,
    pads: Rows,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
) -> Solution:
    """The equilibrium `found` on `pads`, on further ones, too, if a film holds such at its place.

    The curve of one pad, by which `pads` were chosen, knows no relief. Others are tried that a film
    tilts farther from where they are steep already: where no film holds a pad it turns it flat.
    """
    if not (found.converged and gap.pads.size > pads.size and gap.bore.relief):
        return found
    limits, sign = (tolerance, max_iterations), math.copysign(1.0, film.speed)
    others, position = np.setdiff1d(gap.pads, pads), found.position.copy()
    for row in others.tolist():
        lift = sign * _STEEP_TRIED * gap.widest_lift(row, position, sign)
        position[row] += lift - gap.lift(row, position)
    unload_other_pads(film, gap, gap.pads)
    trial = solve_film(film, found.u, position, 0.0 * position, *limits)
    effort.take(film, trial.iterations)
    likely = others[sign * trial.linear.load[others] < 0.0]
    if trial.converged and likely.size:
        state, held = balanced_film(film, gap, trial, np.union1d(pads, likely), *limits)
        effort.take(film, state.iterations)
        if state.converged and held.size > pads.size and np.isin(pads, held).all():
            free = np.union1d(np.arange(gap.size)[found.free], held)
            state = solve_equilibrium(film, force, state.u, state.position, *limits, free=free)
            effort.take(film, state.iterations)
            if state.converged and gap.narrowest(state.position) > _TOUCHING:
                return state
    unload_other_pads(film, gap, pads)
    return found


def solve_with_pads(
    film: DiscreteFilm,
    gap: ShapedGap,
    force: Array,
    position: Array,
    shaft: Rows,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
) -> Solution:
    """As `solve_equilibrium`, the pads in balance at every position of the shaft.

    Parameters
    ----------
    film, gap : DiscreteFilm, ShapedGap
        The film.
    force : array (m,)
        N, without moments of the pads.
    position : array (m,)
        Where to start.
    shaft : array of int
        Degrees of freedom of the shaft that move.
    tolerance, max_iterations
        Of each film.
    effort : Effort
        What all films may take, but for a share that is kept.

    Returns
    -------
    Solution
        Not converged, its `lost` are pads that a film holds at its position alone, or just beside
        it alone, so that one place carries too little and the other too much: a film holds a pad
        only where it carries some least force.
    """
    reach = np.full(gap.pads.size, np.inf)  # gap over its pivot below which a pad is tried

    def balanced(start: Solution) -> tuple[Solution, Rows]:
        some = gap.pads[_over_pivots(gap, start.position) < reach]
        found, held = balanced_film(film, gap, start, some, tolerance, max_iterations)
        effort.take(film, found.iterations)
        return found, held

    def drop(pads: Rows, position: Array) -> None:
        """Leave those off that have come off, at the limit they would go on and off."""
        gaps = _over_pivots(gap, position)
        tried = gap.may_hold(position, film.speed)
        off = np.isin(gap.pads, np.setdiff1d(tried, pads)) & (gaps < reach)
        reach[off] = _BACK_ON * gaps[off]

    effort.kept, begun = _KEPT * effort.left, effort.spent
    state, pads = balanced(replace(no_film(film), position=position))
    drop(pads, state.position)
    scale = film.load_scale(force)
    missing = force[shaft] - state.linear.load[shaft]
    across: tuple[_Place, _Place] | None = None
    least = math.inf  # of the jumps of the load between two such places
    for _ in range(_SHAFTS):
        touching = not gap.narrowest(state.position) > _TOUCHING
        if not state.converged or touching or effort.over:
            break
        if math.hypot(*missing) < _NEAR * scale:
            every = np.append(shaft, pads)
            start = (state.u, state.position)
            end = solve_equilibrium(film, force, *start, tolerance, max_iterations, free=every)
            effort.take(film, end.iterations)
            if end.converged:
                effort.kept = 0.0
                return replace(end, iterations=effort.spent - begun)
        stiffness = _condensed(state, shaft, pads)
        steady = np.linalg.cond(stiffness) < _LOOSE
        step = np.zeros(position.size)
        step[shaft] = np.linalg.lstsq(stiffness + _ASIDE * scale * np.eye(shaft.size), missing)[0]
        step = gap.advance(state.position, step) - state.position
        for _ in range(_HALVINGS):
            trial, some = balanced(replace(state, position=state.position + step))
            left = force[shaft] - trial.linear.load[shaft]
            jump = math.hypot(*(left - missing))
            opposite = trial.converged and missing @ left < 0.0 and not np.array_equal(pads, some)
            if opposite and jump < least:
                across, least = ((state, pads), (trial, some)), jump
            allowed = 1.0 if steady else 2.0
            if trial.converged and math.hypot(*left) < allowed * math.hypot(*missing):
                break
            step = 0.5 * step
        else:
            break
        state, pads, missing = trial, some, left
        drop(pads, state.position)
    free = np.append(shaft, pads)
    found = math.hypot(*missing) / scale if state.converged else math.inf
    ended = replace(state, converged=False, residual=found, free=free)
    if across is not None:
        told = film, gap, ended, across, force[shaft], tolerance, max_iterations
        ended = _with_lost(*told, effort)
    effort.kept = 0.0
    return replace(ended, iterations=effort.spent - begun)


def _with_lost(
    film: DiscreteFilm,
    gap: ShapedGap,
    ended: Solution,
    across: tuple[_Place, _Place],
    force: Array,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
) -> Solution:
    """What has `ended`, with its `lost` pads if there are two places beside each other that a
    film holds them at and does not, and the load `force` of the shaft lies between those of both.

    Sought by halves between the two places `across`.
    """
    (near, held), (far, others) = across
    every = np.union1d(held, others)
    while True:
        way = far.position - near.position
        short = [force - each.linear.load[: force.size] for each in (near, far)]
        if not short[0] @ short[1] < 0.0:
            return ended
        if math.hypot(*way[: gap.shaft]) < _BESIDE:
            return replace(ended, u=near.u, position=near.position, lost=np.setxor1d(held, others))
        middle = replace(near, position=near.position + 0.5 * way)
        state, pads = balanced_film(film, gap, middle, every, tolerance, max_iterations)
        effort.take(film, state.iterations)
        if not state.converged:
            return ended
        if np.array_equal(pads, held):
            near = state
        else:
            far, others = state, pads


def _condensed(state: Solution, shaft: Rows, pads: Rows) -> Array:
    """Stiffness of the shaft while the pads follow it without moment."""
    k = state.linear.stiffness
    if not pads.size:
        return np.asarray(k[np.ix_(shaft, shaft)])
    follow = np.linalg.lstsq(k[np.ix_(pads, pads)], k[np.ix_(pads, shaft)])[0]
    return np.asarray(k[np.ix_(shaft, shaft)] - k[np.ix_(shaft, pads)] @ follow)
