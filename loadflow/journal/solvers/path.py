"""Equilibria along the path of films that carry a growing share of a load, by its arc length.

A film may carry a load only beyond a fold: on the way there the share of the load grows, falls and
grows again, as that of a moment does which a full film takes up. Share and position are sought
together, at a given length of step, so that a fold is a point like others
[Keller 1977]. The path
ends at the load, or where the shaft meets the shell: then the film carries no such load on it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import EVERY, DiscreteFilm
from loadflow.journal.film.linearised import Linear, SingularFilm
from loadflow.journal.film.shell.elastic_film import ElasticFilm
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.load_stepping import (
    APART,
    has_touched,
    meets,
    solve_by_stiffness,
    solve_in_load_steps,
)
from loadflow.journal.solvers.newton import Solution, solve_equilibrium, solve_film

if TYPE_CHECKING:
    from loadflow.journal.film.gap.gap import Gap

Array = NDArray[np.float64]

_STEPS, _NEWTON = 100, 10  # steps of a path, and Newton steps of each
_FIRST, _LONGEST, _SHORTEST = 0.1, 4.0, 1e-5  # steps, of the narrowest gap
_NEAR = 1e-4  # Newton step, of the narrowest gap, at which a point of the path is found
_FEW = 4  # Newton steps below which the next step of the path is twice as long
_LEFT = 0.3  # share of the narrowest gap that a step leaves
_ALONG = 5.0  # lengths of a step that the share may change in it


@dataclass
class _Point:
    """A film on the path: unknowns, position, share of the load, linearisation, tangent."""

    u: Array
    position: Array
    share: float
    linear: Linear
    tangent: Array
    weights: Array  # of the lengths of a step, squared


@dataclass
class _Path:
    """Films that carry ``first + share (force − first)``, of whose position `free` moves."""

    film: DiscreteFilm
    first: Array
    change: Array
    free: NDArray[np.int64]
    spent: int = 0

    @property
    def gap(self) -> Gap:
        """The gap of the film."""
        return self.film.gap

    def narrow(self, position: Array) -> float:
        """Length by which steps are measured, clearances."""
        return max(self.gap.narrowest(position), self.gap.roughness, 1e-12)

    def bordered(self, linear: Linear, row: Array, missing: Array, along: float) -> Array:
        """Step of position and share that leaves nothing `missing` and goes on by `along`."""
        size, unit = self.free.size, math.hypot(*self.change)
        matrix = np.empty((size + 1, size + 1))
        matrix[:size, :size] = linear.stiffness[np.ix_(self.free, self.free)] / unit
        matrix[:size, size], matrix[size] = -self.change / unit, row
        rhs = np.append(missing / unit, along)
        if not math.isfinite(float(matrix.sum() + rhs.sum())):
            return np.full(size + 1, np.nan)
        return np.asarray(np.linalg.lstsq(matrix, rhs, rcond=1e-14)[0])

    def linearise(self, u: Array, position: Array) -> Linear:
        """The film at a point."""
        self.spent += 1
        return self.film.linearise(u, position, 0.0 * position, damped=False)

    def point(self, u: Array, position: Array, share: float, before: Array | None) -> _Point:
        """The point with its tangent, which goes on as that `before`, or to a larger share."""
        linear = self.linearise(u, position)
        weights = np.full(self.free.size + 1, self.narrow(position) ** -2.0)
        weights[-1] = max(1.0, abs(share)) ** -2.0  # far from the load only its order counts
        row = np.append(np.zeros(self.free.size), 1.0) if before is None else weights * before
        tangent = self.bordered(linear, row, np.zeros(self.free.size), 1.0)
        return _Point(
            u, position, share, linear, tangent / math.sqrt(weights @ tangent**2), weights
        )

    def moved(self, u: Array, linear: Linear, position: Array, step: Array) -> tuple[Array, float]:
        """Position after a `step` of what is free; corrects `u` and returns the change of it."""
        whole = np.zeros(position.size)
        whole[self.free] = step
        still = 0.0 * position
        target = self.film.target(position, whole)
        weights = self.film.weights(position, still, target, still)
        if self.film.elastic:
            ends = position, target
            if self.film.step_share(u, linear.columns, weights, ends, fills=False) < 1.0:
                return target, math.inf
        change = self.film.correct(u, linear.columns, weights)
        way = math.hypot(*(target - position)) / self.narrow(target)
        return target, max(change, way)

    def after(self, point: _Point, stride: float) -> tuple[_Point, int] | None:
        """The point a `stride` farther on, and its Newton steps; None: not found.

        Raises
        ------
        SingularFilm
            The first steps led far from any film.
        """
        size, row = self.free.size, point.weights * point.tangent
        step = stride * point.tangent
        ahead = point.position.copy()
        ahead[self.free] += step[:size]
        if self.film.elastic:  # its shell opens on the way
            self.film.place(point.u, point.position)
        elif not self.gap.narrowest(ahead) > _LEFT * self.gap.narrowest(point.position):
            return None
        u, share = point.u.copy(), point.share + step[size]
        position, change = self.moved(u, point.linear, point.position, step[:size])
        if not math.isfinite(change):
            return None
        for number in range(1, _NEWTON + 1):
            linear = self.linearise(u, position)
            missing = self.first + share * self.change - linear.load[self.free]
            gone = np.append((position - point.position)[self.free], share - point.share)
            step = self.bordered(linear, row, missing, stride - float(row @ gone))
            if not math.isfinite(float(step.sum())):
                return None
            position, change = self.moved(u, linear, position, step[:size])
            share += step[size]
            if not math.isfinite(change):
                return None
            if change < _NEAR:
                grown = abs(share - point.share) * math.sqrt(point.weights[-1])
                near = grown <= _ALONG * stride
                return (self.point(u, position, share, point.tangent), number) if near else None
        return None


def _at_the_bore(film: DiscreteFilm, position: Array) -> bool:
    """Whether the shaft at `position` meets the bore, rigid or not: the path ends there."""
    return film.clearance_left(position) <= APART if film.elastic else meets(film, position)


def _ends(film: DiscreteFilm, solution: Solution) -> bool:
    """Whether an equilibrium was found, or the shaft has met an elastic shell."""
    return solution.converged or film.clearance_left(solution.position) <= APART


@np.errstate(over="ignore", invalid="ignore")  # of an iteration that diverges
def solve_along_path(
    film: DiscreteFilm,
    force: Array,
    start: Solution,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
    free: slice | NDArray[np.int64] = EVERY,
    until: Callable[[Array], bool] = lambda position: False,
) -> Solution:
    """Equilibrium under `force` on the path from the load that a film carries where it is held.

    Parameters
    ----------
    film : DiscreteFilm
        In a bore that is rigid or gives way.
    force : array (m,)
        Generalised load, N.
    start : Solution
        Film at a given position.
    tolerance, max_iterations
        Of the equilibrium itself.
    effort : Effort
        What the path may take.
    free : slice or array of int
        Degrees of freedom that move.
    until : callable
        Whether the path ends at a position (m,), as where a pad lies flat.

    Returns
    -------
    Solution
        Not converged where the path ends, meets the shell or its steps are used up: with its last
        position, and as `residual` the least part of the load that was missing on it.
    """
    moving = np.arange(film.gap.size)[free]
    linear = film.linearise(start.u, start.position, 0.0 * start.position)
    first = linear.load[moving]
    path = _Path(film, first, force[moving] - first, moving)
    stride, most, most_steps = _FIRST, 0.0, effort.steps(film)
    point = path.point(start.u.copy(), start.position, 0.0, None)
    for _ in range(_STEPS):
        if path.spent >= most_steps:
            break
        try:
            found = path.after(point, stride)
        except SingularFilm:
            found = None
        if found is None:
            stride *= 0.5
            if stride < _SHORTEST:
                break
            continue
        following, number = found
        if (point.share - 1.0) * (following.share - 1.0) <= 0.0:
            ends = following.u, following.position
            answer = solve_equilibrium(film, force, *ends, tolerance, max_iterations, free=free)
            path.spent += answer.iterations
            if answer.converged:
                effort.take(film, path.spent)
                return replace(answer, iterations=path.spent)
        point = following
        if not math.isfinite(float(point.tangent.sum())) or _at_the_bore(film, point.position):
            break
        if until(point.position):
            break
        most = max(most, point.share) if point.share < 1.0 else most
        stride = min(2.0 * stride, _LONGEST) if number < _FEW else stride
    effort.take(film, path.spent)
    missing = (1.0 - most) * math.hypot(*path.change) / film.load_scale(force)
    ended = Solution(point.u, point.position, point.linear, False, path.spent, missing)
    return replace(ended, free=free)


def solve_beyond_fold(
    film: DiscreteFilm,
    force: Array,
    estimate: Array,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
    reached: Solution,
    free: slice | NDArray[np.int64] = EVERY,
) -> Solution:
    """Equilibrium beyond a fold of the load, or the end of the path at the shell.

    It goes on where steps of the load have `reached`, or begins at the `estimate`, where they do;
    what they have reached is what is left where the path neither finds a load nor ends.
    """
    still, limits = 0.0 * estimate, (tolerance, max_iterations)
    for start in ((reached.u, reached.position), (film.start(), estimate)):
        held = solve_film(film, *start, still, *limits)
        effort.take(film, held.iterations)
        if held.converged:
            found = solve_along_path(film, force, held, *limits, effort, free)
            film.place(found.u, found.position)
            if _ends(film, found) or has_touched(film, found):
                return found
            break
    if film.elastic:  # its shell is judged by the gap that it leaves there
        film.place(reached.u, reached.position)
    return reached


def solve_elastic_in_steps(
    film: DiscreteFilm,
    force: Array,
    position: Array,
    tolerance: float,
    max_iterations: int,
    effort: Effort,
    free: slice | NDArray[np.int64] = EVERY,
    rigid: Solution | None = None,
) -> Solution:
    """As `solve_equilibrium`, in an elastic shell: from a light load on, or from a rigid shell.

    Where asperities touch, the second comes first: it takes a third of the time. What steps of the
    load do not reach is sought along its path, but in a shell that spreads what presses it: there
    the narrowest gap goes from cell to cell, and with it the path to and fro. All end with the
    `effort`. What came of Newton's method in a `rigid` shell is not sought again.
    """
    asked = film, force, position, tolerance, effort, free
    spreads = isinstance(film, ElasticFilm) and film.compliance.spreads
    has_path = film.speed != 0.0 and not spreads
    by_shell: Solution | None = None
    if film.contact is not None:
        by_shell = solve_by_stiffness(*asked, rigid)
        if by_shell.converged or effort.over:
            return by_shell
    by_load = solve_in_load_steps(*asked, has_path)
    if has_path and not (_ends(film, by_load) or effort.over):
        limits = tolerance, max_iterations
        by_load = solve_beyond_fold(film, force, position, *limits, effort, by_load, free)
    if _ends(film, by_load):
        return by_load
    if by_shell is None and not effort.over:
        by_shell = solve_by_stiffness(*asked)
        if by_shell.converged or by_shell.residual < by_load.residual:
            return by_shell
    film.relax()
    film.place(by_load.u, by_load.position)  # show the gap that the load steps have left
    return by_load
