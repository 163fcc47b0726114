"""Equilibria of a shaft that is let go in its film, and sinks until the film carries its load.

From where a film carries less to where it carries the load Newton's method knows no way of its own:
it jumps, and a soft shell or asperities throw it back. Time has one. A shaft that is let go sinks
no faster than its film is squeezed out, a shell opens no faster than oil comes to fill it, and each
implicit step begins near its end. As they grow, nothing is left of them but the film at rest
[Kelley and Keyes 1998]. Such steps damp what would whirl, so that a film found so may be unstable,
as any other at rest.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import EVERY, DiscreteFilm
from loadflow.journal.film.linearised import SingularFilm
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.load_stepping import APART, meets
from loadflow.journal.solvers.motion.history import Past
from loadflow.journal.solvers.motion.transient import Marcher
from loadflow.journal.solvers.newton import Solution, solve_equilibrium

if TYPE_CHECKING:
    from loadflow.journal.film.gap.gap import BoreGap
    from loadflow.journal.film.gap.rough import RoughGap, RoughShapedGap

Array = NDArray[np.float64]

_HIGH = 0.5  # of the way from the widest place to the first position, at which a shaft is let go
_FIRST = 0.3  # of the narrowest gap, by which it may sink in the first step
_STEPS, _NEWTON = 80, 30  # steps in time, and Newton steps of each
_ENOUGH = 1e-6  # residual of these
_LONGER, _LONGEST, _CUT = 1.5, 4.0, 0.2  # growth of a step after one that was cut, and of others
_CUTS = 12  # after which the way is given up
_NEARLY = 0.01  # of the narrowest gap, a step below which the shaft is nearly at rest
_ALL = math.nextafter(1.0, 0.0)
_ENDING = 0.1  # of the depth to which rough surfaces may come, from which steps lead to the bore


def solve_by_sinking(
    film: DiscreteFilm,
    force: Array,
    position: Array,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
    free: slice | NDArray[np.int64] = EVERY,
) -> Solution | None:
    """As `solve_equilibrium`, where a rough shaft comes to rest that is let go above `position`.

    None: not found this way. A shaft that sinks to its bore is not converged, and its `residual`
    the part of the load that nothing carries there. It takes no more than the `effort`.
    """
    moving, shell = np.arange(film.gap.size)[free], film.softness
    film.relax()
    wide = cast("BoreGap", film.gap).widest(position, free)
    place = wide + _HIGH * (position - wide)
    if not film.gap.narrowest(place) > 0.0:
        return None
    most = film.newton_steps(_NEWTON)
    marcher = Marcher(film, max(tolerance, _ENOUGH), most, free=free)
    past = marcher.past(0.0, film.start(), place, film.gap.pads[:0])
    try:
        step = _first_step(film, force, past, moving)
    except SingularFilm:
        return None
    growth, cuts, spent, left = _LONGEST, 0, 0, math.inf
    for _ in range(_STEPS):
        if effort.steps(film) < 1:
            effort.left = 0.0
        if cuts > _CUTS or effort.over or not math.isfinite(step):
            break
        marcher = replace(marcher, max_iterations=min(most, effort.steps(film)))
        trial = marcher.attempt([past], step, force)
        effort.take(film, trial.iterations)
        spent += trial.iterations
        met = _touches(film, trial.position)
        if met and left < _nearly(film):
            missing = _missing(film, past, force, moving)
            film.place(trial.u, trial.position)  # the gap by which it is judged
            return replace(trial, converged=False, residual=missing)
        if met or not trial.converged:
            step, growth, cuts = _CUT * step, _LONGER, cuts + 1
            continue
        way = math.hypot(*(trial.position - past.position))
        past = marcher.past(0.0, trial.u, trial.position, past.pads)
        step, growth = growth * step, min(growth * _LONGER, _LONGEST)
        left = _left(film, past.position)
        if way < _NEARLY * max(film.gap.narrowest(past.position), film.gap.roughness):
            limits = tolerance, min(max_iterations, effort.steps(film))
            found = solve_equilibrium(film, force, past.u, past.position, *limits, free=free)
            effort.take(film, found.iterations)
            spent += found.iterations
            if found.converged:
                return replace(found, iterations=spent)
    film.relax(share=shell)
    return None


def _first_step(film: DiscreteFilm, force: Array, past: Past, moving: NDArray[np.int64]) -> float:
    """Time, s, in which a shaft that is let go sinks by a part of its gap."""
    start = past.position
    linear = film.linearise(past.u, start, 0.0 * start)
    damping, missing = linear.damping[np.ix_(moving, moving)], (force - linear.load)[moving]
    pace = math.hypot(*np.linalg.lstsq(damping, missing, rcond=1e-10)[0])
    return _FIRST * film.gap.narrowest(start) / pace if pace > 0.0 else math.inf


def _left(film: DiscreteFilm, position: Array) -> float:
    """Way to the bore, or to the end of its law of contact, clearances."""
    return film.clearance_left(position) if film.elastic else _rough(film).until_end(position)


def _touches(film: DiscreteFilm, position: Array) -> bool:
    """Whether the shaft at `position` meets its bore, where the film was last placed."""
    return _left(film, position) <= APART if film.elastic else meets(film, position)


def _nearly(film: DiscreteFilm) -> float:
    """Way that is left to the bore, clearances, from which steps lead there however short."""
    return _ENDING * max(_rough(film).rough.deepest, film.gap.roughness)


def _rough(film: DiscreteFilm) -> RoughGap | RoughShapedGap:
    return cast("RoughGap | RoughShapedGap", film.gap)


def _missing(film: DiscreteFilm, past: Past, force: Array, moving: NDArray[np.int64]) -> float:
    """Part of the load that nothing carries at a place where the shaft is held; all, if more."""
    linear = film.linearise(past.u, past.position, 0.0 * past.position)
    missing = math.hypot(*(force - linear.load)[moving]) / film.load_scale(force)
    return min(missing, _ALL)
