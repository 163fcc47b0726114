"""Closed orbits of films whose only history is the path of the shaft: all times at once.

Every time of the period is an implicit step of second order (BDF2) from the two before it, those at
the start from the last ones, and Newton's method solves films and shaft at all times together. So
it takes no more steps where an orbit does not draw others to itself, or does so slowly: the film
that does not rupture hardly damps its whirl, and periods that follow each other circle about it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.gap import KEPT
from loadflow.journal.film.imbalance import imbalance, rounding
from loadflow.journal.film.linearised import Linear, SingularFilm
from loadflow.journal.solvers._newton_kernels import QUADRATIC, STEP_LIMIT
from loadflow.journal.solvers.motion.history import backward_difference
from loadflow.journal.solvers.newton import Solution, solve_equilibrium, solve_film
from loadflow.numerics.convergence import COARSEST, is_small

Array = NDArray[np.float64]

_NEWTON, _HALVINGS = 25, 20  # steps of the whole path, and how often one is halved
_FIRST, _SMALLEST, _SWINGS = 0.25, 0.01, 30  # share of the swing of a load; of it, and tries
_NEARER = (1.0, 0.5, 0.1)  # shares of a mean position, from which that of a mean load is sought
_CELLS = 5_000_000  # of all times, up to which their Newton steps are kept: 160 MB


@dataclass(frozen=True)
class _Rule:
    """Velocities of a path that is closed: ``rate · p_n − last · p_{n−1} − before · p_{n−2}``."""

    rate: Array
    last: Array
    before: Array

    def velocity(self, path: Array) -> Array:
        """Velocities (n, 2), clearances per second, of positions (n, 2)."""
        rate, last, before = (x[:, None] for x in (self.rate, self.last, self.before))
        ahead = last * np.roll(path, 1, axis=0) + before * np.roll(path, 2, axis=0)
        return np.asarray(rate * path - ahead)

    def step(self, linears: list[Linear], force: Array) -> Array:
        """Newton step (n, 2) of all positions, films following."""
        from scipy.sparse import bsr_array
        from scipy.sparse.linalg import spsolve

        count = len(linears)
        damping = np.array([one.damping for one in linears])
        own = np.array([one.stiffness for one in linears]) + self.rate[:, None, None] * damping
        blocks = [own, -self.last[:, None, None] * damping, -self.before[:, None, None] * damping]
        rows = np.arange(count)
        columns = np.concatenate([(rows - back) % count for back in range(3)])
        order = np.argsort(np.tile(rows, 3), kind="stable")
        matrix = bsr_array(
            (np.concatenate(blocks)[order], columns[order], 3 * np.arange(count + 1)),
            shape=(2 * count, 2 * count),
        )
        missing = force - np.array([one.load for one in linears])
        return np.asarray(spsolve(matrix.tocsc(), missing.ravel())).reshape(count, 2)


def _closed(time: Array) -> _Rule:
    """The rule of all times (n + 1,) but the first, which is the last one a period before."""
    steps = np.diff(time)
    return _Rule(*backward_difference(steps, np.roll(steps, 1)))


def can_close_at_once(film: DiscreteFilm, count: int) -> bool:
    """Whether `count` times of a film may be solved together."""
    return film.mesh.polar and count * film.mesh.angle.size * film.mesh.z.size <= _CELLS


@np.errstate(over="ignore", invalid="ignore")  # of an iteration that diverges
def solve_all_times(
    film: DiscreteFilm, path: Array, time: Array, force: Array, speed: Array,
    tolerance: float, max_iterations: int,
) -> list[Solution] | None:  # fmt: skip
    """Films and shaft at all times after the first of a period; None: not found.

    Parameters
    ----------
    film : DiscreteFilm
        On a mesh that turns with the shaft.
    path : array (n, 2)
        Positions to start from, clearances.
    time : array (n + 1,)
        s; the last closes the period.
    force : array (n + 1, 2)
        N.
    speed : array (n + 1,)
        rad/s.
    tolerance, max_iterations
        Of the balance of each film, and Newton steps of a first one.
    """
    rule, path = _closed(time), path.copy()
    films: list[Array] = []
    for place, moving, omega in zip(path, rule.velocity(path), speed[1:].tolist()):
        film.set_speed(omega)
        found = solve_film(film, film.start(), place, moving, tolerance, max_iterations)
        if not found.converged:
            return None
        films.append(found.u)
    for number in range(1, _NEWTON + 1):
        try:
            linears, excess = _linearised(film, films, path, rule, speed)
            step = rule.step(linears, force[1:]) / max(excess, 1.0)
        except SingularFilm:
            return None
        share = _share(film, path, step)
        if share == 0.0 or not math.isfinite(share):
            return None
        target = path + share * step
        change = _correct(film, films, linears, (path, target), rule)
        path = target
        if change < QUADRATIC:
            return _checked(film, films, linears, path, rule, force, speed, tolerance, number)
    return None


def solve_by_swing(
    film: DiscreteFilm, path: Array, time: Array, force: Array, speed: Array,
    tolerance: float, max_iterations: int,
) -> list[Solution] | None:  # fmt: skip
    """As `solve_all_times`, from the shaft at rest under the mean load, which then begins to swing.

    Of the `path` only the mean counts.
    """
    steps = np.diff(time)
    mean = np.average(0.5 * (force[1:] + force[:-1]), axis=0, weights=steps)
    turning = float(np.average(0.5 * (speed[1:] + speed[:-1]), weights=steps))
    film.set_speed(turning)
    for nearer in _NEARER:
        start = film.start(), nearer * path.mean(axis=0)
        rest = solve_equilibrium(film, mean, *start, tolerance, max_iterations)
        if rest.converged:
            break
    else:
        return None
    path, done, step = np.tile(rest.position, (steps.size, 1)), 0.0, _FIRST
    growth = np.zeros_like(path)  # of the path with the share of the swing
    for _ in range(_SWINGS):
        at = min(1.0, done + step)
        load, omega = mean + at * (force - mean), turning + at * (speed - turning)
        ahead = path + _share(film, path, (at - done) * growth) * (at - done) * growth
        found = solve_all_times(film, ahead, time, load, omega, tolerance, max_iterations)
        if found is None:
            step *= 0.5
            if step < _SMALLEST:
                break
            continue
        if at == 1.0:
            return found
        reached = np.array([one.position for one in found])
        path, growth, done, step = reached, (reached - path) / (at - done), at, 1.5 * step
    return None


def _linearised(
    film: DiscreteFilm, films: list[Array], path: Array, rule: _Rule, speed: Array
) -> tuple[list[Linear], float]:
    """Every film linearised, and the largest step of a film over that which is allowed."""
    linears, largest = [], 0.0
    for u, place, moving, omega in zip(films, path, rule.velocity(path), speed[1:].tolist()):
        film.set_speed(omega)
        linears.append(film.linearise(u, place, moving))
        largest = max(largest, film.size(linears[-1].columns[0]) / STEP_LIMIT)
    return linears, largest


def _share(film: DiscreteFilm, path: Array, step: Array) -> float:
    """Share of a step of which every time keeps a third of its gap; 0: none."""
    if not np.isfinite(step).all():
        return 0.0
    least = [KEPT * film.gap.narrowest(place) for place in path]
    share = 1.0
    for _ in range(_HALVINGS):
        ahead = path + share * step
        if all(film.gap.narrowest(place) > kept for place, kept in zip(ahead, least)):
            return share
        share *= 0.5
    return 0.0


def _correct(
    film: DiscreteFilm,
    films: list[Array],
    linears: list[Linear],
    ways: tuple[Array, Array],
    rule: _Rule,
) -> float:
    """Correct `films` for the way from one path to another; largest change of film and gap."""
    largest = 0.0
    speeds = [rule.velocity(path) for path in ways]
    for u, linear, place, target, slow, fast in zip(films, linears, *ways, *speeds):
        weights = film.weights(place, slow, target, fast)
        way = math.hypot(*(target - place)) / film.gap.narrowest(place)
        largest = max(largest, film.correct(u, linear.columns, weights), way)
    return largest


def _checked(
    film: DiscreteFilm,
    films: list[Array],
    linears: list[Linear],
    path: Array,
    rule: _Rule,
    force: Array,
    speed: Array,
    tolerance: float,
    iterations: int,
) -> list[Solution] | None:
    """The films as solutions, where the balance of each is within its tolerance or rounding."""
    found = []
    moving = rule.velocity(path)
    for k, (u, linear) in enumerate(zip(films, linears)):
        film.set_speed(float(speed[k + 1]))
        where = path[k], moving[k]
        residual = imbalance(film, u, *where, force[k + 1])
        slope = linear.stiffness + rule.rate[k] * linear.damping
        level = min(rounding(film, *where, slope, force[k + 1]), COARSEST)
        if not is_small(residual, tolerance, level):
            return None
        found.append(Solution(u, path[k], linear, True, iterations, residual, rounding=level))
    return found
