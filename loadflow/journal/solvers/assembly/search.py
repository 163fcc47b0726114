"""Where cones carry a load: eccentricity over gap, and size of the gap, by damped steps.

The load of a film goes about with the inverse square of its gap, and its direction with the
eccentricity over the gap. Sought are a direction and the logarithm of a size, both of films around
a shaft that is held: they are smooth from light to heavy loads, and every step is a film that is
there. Where a whole ring without rupture has no axial force at all, its axial position is the
nearest to where the search began. Two cones against each other share the way along the axis
between them, and their tilt is sought, too, where it is free.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.solvers.assembly.balance import imbalance
from loadflow.journal.solvers.assembly.member import BODY, AssemblyState
from loadflow.journal.solvers.assembly.solve import Assembly
from loadflow.numerics.convergence import Limits

Array = NDArray[np.float64]

_HELD = np.array([], dtype=np.int64)
_STEPS = 60  # films of a search from one start
_SPENT = 1000  # Newton steps from all starts
_LARGEST = 0.7  # change of an eccentricity over the gap, or of the gap's logarithm, in a step
_HALVINGS = 12
_RATIOS, _TURNS, _BEST = (0.4, 0.8), 10, 8  # films all around, and those from which it begins
_ALONGS, _ALONG = (0.0, 0.6, -0.6), 1.0 - 1e-9  # ways between two cones
_ROUGH = Limits(1e-3, 20)  # of these
_NEAR = 0.02  # distance to the load below which Newton's method takes over
_DAMPING = 1e-12  # of what the load does not feel
_FAINT = 1e-12  # share of the load wanted that is none: a film without pressure has no direction
_WIDEST, _NARROWEST = math.log(1e3), math.log(1e-4)  # gap over the clearance


@dataclass(frozen=True)
class Chart:
    """Positions of a shaft in a cone.

    Attributes
    ----------
    clearance : float
        Normal gap around the shaft in its middle, m.
    half_angle : float
        rad.
    tilt : array (2,)
        Held, rad.
    """

    clearance: float
    half_angle: float
    tilt: Array

    def position(self, x: Array) -> Array:
        """Position (5,) at an eccentricity over the gap and a logarithm of the gap, (3,)."""
        gap = self.clearance * math.exp(x[2])
        aside = gap / math.cos(self.half_angle) * x[:2]
        axial = (gap - self.clearance) / math.sin(self.half_angle)
        return np.concatenate([aside, [axial], self.tilt])

    def slope(self, x: Array) -> Array:
        """Change of the position by that of `x`, (5, 3)."""
        gap = self.clearance * math.exp(x[2])
        found = np.eye(BODY, 3) * gap / math.cos(self.half_angle)
        found[:2, 2] = gap / math.cos(self.half_angle) * x[:2]
        found[2, 2] = gap / math.sin(self.half_angle)
        return found

    def place(self, position: Array) -> Array:
        """Inverse of `position`."""
        gap = self.clearance + position[2] * math.sin(self.half_angle)
        gap = max(gap, math.exp(_NARROWEST) * self.clearance)
        aside = position[:2] * math.cos(self.half_angle) / gap
        return np.append(aside, math.log(gap / self.clearance))

    def holds(self, x: Array) -> bool:
        """Whether `x` is one of a film."""
        return math.hypot(*x[:2]) < 1.0 and _NARROWEST < x[2] < _WIDEST


@dataclass(frozen=True)
class PairChart:
    """Positions of a shaft between two cones.

    Attributes
    ----------
    low, high : float
        Ends of its way along the axis, m, where either gap is closed.
    aside : float
        Its way across the axis half-way between them, m.
    length : float
        By which a tilt is made a way, m.
    tilt : array (2,)
        Where the search begins, or held, rad.
    free : bool
        Whether the tilt is sought.
    """

    low: float
    high: float
    aside: float
    length: float
    tilt: Array
    free: bool

    def position(self, x: Array) -> Array:
        """Position (5,) at an eccentricity over the gap and a way along the axis, and tilts."""
        narrow = self.aside / math.cosh(x[2]) ** 2
        axial = 0.5 * (self.low + self.high) + 0.5 * (self.high - self.low) * math.tanh(x[2])
        tilt = self.tilt + x[3:] * narrow / self.length if self.free else self.tilt
        return np.concatenate([narrow * x[:2], [axial], tilt])

    def slope(self, x: Array) -> Array:
        """Change of the position by that of `x`, (5, 3) or (5, 5)."""
        steep = 1.0 / math.cosh(x[2]) ** 2
        narrow, shrinks = self.aside * steep, -2.0 * math.tanh(x[2])
        found = np.eye(BODY, x.size) * narrow
        found[:2, 2] = shrinks * narrow * x[:2]
        found[2, 2] = 0.5 * (self.high - self.low) * steep
        if self.free:
            found[3:, 3:] /= self.length
            found[3:, 2] = shrinks * narrow / self.length * x[3:]
        return found

    def place(self, position: Array) -> Array:
        """Inverse of `position`."""
        way = (2.0 * position[2] - self.low - self.high) / (self.high - self.low)
        along = math.atanh(min(max(way, -_ALONG), _ALONG))
        narrow = self.aside / math.cosh(along) ** 2
        x = np.append(position[:2] / narrow, along)
        return np.append(x, (position[3:] - self.tilt) * self.length / narrow) if self.free else x

    def holds(self, x: Array) -> bool:
        """Whether `x` may be one of a film."""
        return math.hypot(*x[:2]) < 2.0 and abs(x[2]) < -_NARROWEST

    def starts(self) -> Iterator[Array]:
        """Places all between the cones, (5,)."""
        for along, ratio in product(_ALONGS, _RATIOS):
            for turn in np.arange(_TURNS) * (2 * math.pi / _TURNS):
                x = np.zeros(BODY if self.free else 3)
                x[:3] = ratio * math.cos(turn), ratio * math.sin(turn), along
                yield self.position(x)


def at_once(
    assembly: Assembly,
    starts: list[AssemblyState],
    wanted: Array,
    free: NDArray[np.int64],
    limits: Limits,
) -> AssemblyState | None:
    """Equilibrium by Newton's method from the first of `starts`, from all without a force.

    None where the load `wanted` (5,) has to be sought by size and direction.
    """
    if not wanted[:3].any():
        return assembly.equilibrium(starts, wanted, free, limits)
    quick = assembly.solve(starts[0], wanted, free, limits)
    return quick if quick.converged else None


def between(
    assembly: Assembly,
    chart: PairChart,
    started: Callable[[Array], AssemblyState],
    force: Array,
) -> Iterator[AssemblyState]:
    """Films all between two cones, those first whose load is nearest to `force`."""
    found: list[tuple[float, int, AssemblyState]] = []
    for place in chart.starts():
        start = started(place)
        if assembly.narrowest(start) <= 0.0:
            continue
        film = assembly.solve(start, np.zeros(BODY), _HELD, _ROUGH)
        if film.converged:
            distance = _distance(assembly, film, force, chart.free)[0]
            found.append((float(np.linalg.norm(distance)), len(found), film))
    for _, _, film in sorted(found, key=lambda each: each[:2])[:_BEST]:
        yield film


def around(
    assembly: Assembly,
    chart: Chart,
    started: Callable[[Array], AssemblyState],
    force: Array,
) -> Iterator[AssemblyState]:
    """Films all around a cone, those first whose load has nearly the direction of `force`.

    `started` gives the films around a shaft at a position (5,).
    """
    found: list[tuple[float, int, Array, float]] = []
    for ratio in _RATIOS:
        for turn in np.arange(_TURNS) * (2 * math.pi / _TURNS):
            x = np.array([ratio * math.cos(turn), ratio * math.sin(turn), 0.0])
            start = started(chart.position(x))
            if assembly.narrowest(start) <= 0.0:
                continue
            film = assembly.solve(start, np.zeros(BODY), _HELD, _ROUGH)
            if film.converged:
                distance = _distance(assembly, film, force, False)[0]
                aside = float(np.linalg.norm(distance[1:]))
                found.append((aside, len(found), x, float(distance[0])))
    for _, _, x, size in sorted(found)[:_BEST]:
        x[2] = np.clip(0.5 * size, 0.9 * _NARROWEST, 0.9 * _WIDEST)
        yield started(chart.position(x))


def search(
    assembly: Assembly,
    chart: Chart | PairChart,
    starts: Iterable[AssemblyState],
    force: Array,
    free: NDArray[np.int64],
    limits: Limits,
    rounds: tuple[int, ...] = (200,),
) -> AssemblyState:
    """Equilibrium under `force` (5,), N and N m, or where the search ended.

    Parameters
    ----------
    assembly : Assembly
        The films.
    chart : Chart
        Positions.
    starts : iterable of AssemblyState
        Where to begin, one after the other; one or more.
    force : array (5,)
        The load.
    free : array of int
        The three shifts, or with them both tilts.
    limits : Limits
        Tolerance on the scaled residual.
    rounds : tuple of int
        Newton steps from each start, round by round: those that have not yet ended go on in the
        next one, the nearest to the load first.
    """
    spent = 0
    for most in rounds:
        short: list[AssemblyState] = []
        for start in starts:
            found = _search_from(assembly, chart, start, force, free, limits, most)
            spent += found.iterations
            if found.converged or spent > _SPENT:
                return replace(found, iterations=spent)
            if found.iterations > most:
                short.append(found)
        starts = sorted(short, key=lambda each: each.residual)
    return replace(found, iterations=spent)


def _search_from(
    assembly: Assembly,
    chart: Chart | PairChart,
    start: AssemblyState,
    force: Array,
    free: NDArray[np.int64],
    limits: Limits,
    most: int,
) -> AssemblyState:
    """Equilibrium from one of the starts, in no more than `most` Newton steps but those begun."""
    x = chart.place(start.position)
    state = _film_at(assembly, replace(start, position=chart.position(x)), limits)
    spent, polished = state.iterations, math.inf
    if not state.converged:
        return state
    tilts = free.size > 3
    distance, change = _distance(assembly, state, force, tilts)
    for _ in range(_STEPS):
        size = float(np.linalg.norm(distance))
        if size < _NEAR and size < 0.1 * polished:
            polished = size
            end = assembly.solve(state, force, free, limits)
            spent += end.iterations
            if end.converged:
                return replace(end, iterations=spent)
        residual = imbalance(assembly.members, assembly.length, state, force, free)[0]
        if residual < limits.tolerance:
            done = replace(state, converged=True, residual=residual, iterations=spent, free=free)
            return done
        if spent > most:
            break
        slope = change @ chart.slope(x)
        if not np.isfinite(slope).all():
            break
        step = _damped(slope, -distance)
        longest = float(np.abs(step).max())
        if longest == 0.0:
            break
        step *= min(1.0, _LARGEST / longest)
        for _ in range(_HALVINGS):
            trial_x = x + step
            if chart.holds(trial_x):
                moved = replace(state, position=chart.position(trial_x))
                if assembly.narrowest(moved) > 0.0:
                    trial = _film_at(assembly, moved, limits)
                    spent += trial.iterations
                    if trial.converged:
                        left, after = _distance(assembly, trial, force, tilts)
                        if float(np.linalg.norm(left)) < size * (1.0 - 1e-4):
                            x, state, distance, change = trial_x, trial, left, after
                            break
            step = 0.5 * step
        else:
            break
    return replace(state, converged=False, iterations=spent, residual=float(np.abs(distance).max()))


def _damped(slope: Array, wanted: Array) -> Array:
    """Step of least size that leads to `wanted`."""
    return np.asarray(np.linalg.lstsq(slope, wanted, rcond=math.sqrt(_DAMPING))[0])


def _film_at(assembly: Assembly, state: AssemblyState, limits: Limits) -> AssemblyState:
    """Films around a shaft that is held, from those of `state` or from none."""
    nothing = np.zeros(BODY)
    found = assembly.solve(state, nothing, _HELD, limits)
    if not found.converged:
        fresh = assembly.start(state.position, [own.pad for own in state.members])
        again = assembly.solve(fresh, nothing, _HELD, limits)
        found = replace(again, iterations=found.iterations + again.iterations)
    return found


def _distance(
    assembly: Assembly, state: AssemblyState, force: Array, tilts: bool
) -> tuple[Array, Array]:
    """Distance of the load to `force`, by size and direction (4,), and its change by the position.

    With `tilts` also that of the moments, over the force and the length of the assembly, (6,).
    """
    load = np.sum([part for pads in assembly.loads(state) for part in pads], axis=0)
    stiffness = assembly.coefficients(state)[0]
    size, wanted = float(np.linalg.norm(load[:3])), float(np.linalg.norm(force[:3]))
    size = max(size, _FAINT * wanted)
    way = load[:3] / size
    distance = np.append(math.log(size / wanted), way - force[:3] / wanted)
    turn = (np.eye(3) - np.outer(way, way)) @ stiffness[:3] / size
    change = np.vstack([way @ stiffness[:3] / size, turn])
    if tilts:
        unit = wanted * assembly.length
        distance = np.append(distance, (load[3:] - force[3:]) / unit)
        change = np.vstack([change, stiffness[3:] / unit])
    return distance, change
