"""Newton for the film alone, and for film and shaft together."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import wraps
from typing import Any, ParamSpec, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import EVERY, DiscreteFilm
from loadflow.journal.film.imbalance import flux_of, imbalance, rounding
from loadflow.journal.film.linearised import Linear, SingularFilm
from loadflow.journal.film.rigid_cylinder import Cylinder, as_cylinder
from loadflow.journal.solvers import _newton_kernels as kernel
from loadflow.journal.solvers._newton_kernels import (
    LATE,
    NEARLY,
    PRESSED,
    QUADRATIC,
    STEP_LIMIT,
    WAITS,
)
from loadflow.numerics.convergence import COARSEST, answered, rounding_level

Array = NDArray[np.float64]

_HELD = 1e-5  # share of it that pads must be let go, where they would tilt the other way
_STILL = 1e-13  # Newton step, clearances, that rounding makes: it need not lead anywhere
_STUCK = 1e-3  # share of a Newton step that must be left by an elastic shell
_PRESSING = 4  # steps in a row of which asperities leave less, after which their law has ended
_OVERLOADED = (
    300.0  # of the load, carried by a shell and asperities pressed so that none leads back
)


@dataclass(frozen=True)
class Solution:
    """A solved film: unknowns, position (clearances), last linearisation, convergence.

    `rounding` is the residual that rounding allows, where that was asked; `estimate` the position
    by the closed form, which tells whether the next load is near; `free` are the degrees of freedom
    in balance; `lost` the pads with whose film the load jumps there from too little to too much.
    `unheld` says that no film holds any pad that faces the load, wherever the shaft may be.
    `given_up` says that the search had taken all that it may, before it came to an end.
    """

    u: Array
    position: Array
    linear: Linear
    converged: bool
    iterations: int
    residual: float
    estimate: Array | None = None
    free: slice | NDArray[np.int64] = field(default_factory=lambda: EVERY)
    rounding: float = 0.0
    lost: NDArray[np.int64] = field(default_factory=lambda: np.arange(0))
    unheld: bool = False
    given_up: bool = False


@dataclass(frozen=True)
class Motion:
    """How velocity and storage follow from the position in an implicit step; at rest by default.

    Attributes
    ----------
    rate : float
        1/s; the velocity is ``rate · position − offset``.
    offset : array (m,) or 0
        Clearances per second.
    volume_rate, volume
        The storage of a cell is ``volume_rate · liquid − volume``.
    """

    rate: float = 0.0
    offset: Array | float = 0.0
    volume_rate: float = 0.0
    volume: Array | float = 0.0

    @property
    def moves(self) -> bool:
        """Whether this is a step in time."""
        return self.rate != 0.0 or bool(np.any(self.offset))

    def velocity(self, position: Array) -> Array:
        """Velocity of the shaft, clearances per second."""
        return self.rate * position - self.offset


REST = Motion()


class _Check:
    """Whether the Newton steps of a film have led to an answer, by the rule of `convergence`.

    The residual is looked at after steps that are short enough, its rounding level where the
    tolerance is not met.
    """

    def __init__(
        self,
        film: DiscreteFilm,
        tolerance: float,
        motion: Motion,
        force: Array | None = None,
        free: slice | NDArray[np.int64] = EVERY,
    ) -> None:
        self.film, self.tolerance, self.motion = film, tolerance, motion
        self.force, self.free = force, free
        self.residual, self.rounding = math.inf, 0.0

    def weigh(self, u: Array, position: Array) -> None:
        """Residual at `u` and `position`."""
        motion = self.motion
        velocity, old = motion.velocity(position), (motion.volume_rate, motion.volume)
        where = (u, position, velocity, self.force)
        self.residual = imbalance(self.film, *where, *old, self.free)

    def round(self, position: Array, linear: Linear) -> None:
        """Rounding level of the residual just weighed; `linear` is from nearby."""
        motion = self.motion
        velocity = motion.velocity(position)
        slope = linear.stiffness + motion.rate * linear.damping
        self.rounding = rounding(self.film, position, velocity, slope, self.force, self.free)

    def after(
        self, iteration: int, change: float, u: Array, position: Array, linear: Linear
    ) -> bool:
        """Whether Newton step number `iteration`, of the length `change`, has led to an answer."""
        if not change < (QUADRATIC if iteration <= LATE else COARSEST**0.5):
            return False
        before, finest = self.residual, 0.0
        self.weigh(u, position)
        if self.residual <= self.tolerance and change < QUADRATIC:
            return True  # whatever rounding allows
        self.round(position, linear)
        if change >= QUADRATIC:
            finest = self._finest(u, position, linear)
        level = (self.tolerance, min(self.rounding, COARSEST))
        return answered(self.residual, *level, before, change, QUADRATIC, finest)

    def _finest(self, u: Array, position: Array, linear: Linear) -> float:
        """Step of film and shaft that the last digits of unknowns and gap make."""
        terms = (
            np.abs(linear.columns[1 : 1 + self.film.moves]).sum(axis=0).max(initial=0.0)
            + np.abs(u).max()
        )
        narrow = max(self.film.gap.narrowest(position), PRESSED)
        return rounding_level(float(terms) / self.film.scale + 1.0 / narrow)

    def solution(
        self, u: Array, position: Array, linear: Linear, converged: bool, iterations: int
    ) -> Solution:
        """What has been found, with both residuals."""
        found = (converged, iterations, self.residual)
        return Solution(u, position, linear, *found, free=self.free, rounding=self.rounding)

    def unanswered(self, u: Array, position: Array, linear: Linear, iterations: int) -> Solution:
        """What the last step left."""
        self.weigh(u, position)
        self.round(position, linear)
        return self.solution(u, position, linear, False, iterations)


P = ParamSpec("P")


def _or_from_one_viscosity(start: int) -> Callable[[Callable[P, Solution]], Callable[P, Solution]]:
    """Let a solver that finds no film of a liquid that thickens begin at that of one viscosity.

    On the way to a rupture pressures may pass that thicken a liquid without end. Unknowns and
    position to begin with are the solver's arguments `start` and the next one.
    """

    def either(solve: Callable[P, Solution]) -> Callable[P, Solution]:
        @wraps(solve)
        def solved(*args: P.args, **kwargs: P.kwargs) -> Solution:
            film, found = cast(DiscreteFilm, args[0]), solve(*args, **kwargs)
            if found.converged or film.thickening is None:
                return found
            thick, film.thickening = film.thickening, None
            try:
                thin = solve(*args, **kwargs)
            finally:
                film.thickening = thick
            if not thin.converged:
                return found
            begun: Any = (*args[:start], thin.u, thin.position, *args[start + 2 :])
            again = solve(*begun, **kwargs)
            spent = found.iterations + thin.iterations + again.iterations
            return replace(again, iterations=spent)

        return solved

    return either


@_or_from_one_viscosity(start=1)
@np.errstate(over="ignore", invalid="ignore")  # of an iteration that diverges
def solve_film(
    film: DiscreteFilm,
    u: Array,
    position: Array,
    velocity: Array,
    tolerance: float,
    max_iterations: int,
) -> Solution:
    """Pressure of the film at a given position and velocity."""
    u, motion = u.copy(), Motion(offset=-velocity)
    whole = as_cylinder(film)
    if whole is not None:
        return _at_once(film, whole, None, u, position, tolerance, max_iterations, motion)
    weights, fills = np.ones(1), not motion.moves
    check = _Check(film, tolerance, motion)
    for iteration in range(1, max_iterations + 1):
        try:
            linear = film.linearise(u, position, velocity)
        except SingularFilm:
            if iteration == 1:
                return no_film(film)
            break
        share = film.step_share(u, linear.columns[:1], weights, (position, position), fills)
        if share < _STUCK:
            break
        change = film.correct(u, linear.columns[:1], share * weights, fills)
        if check.after(iteration, change, u, position, linear):
            return check.solution(u, position, linear, True, iteration)
    return check.unanswered(u, position, linear, iteration)


@_or_from_one_viscosity(start=2)
@np.errstate(over="ignore", invalid="ignore")  # of an iteration that diverges
def solve_equilibrium(
    film: DiscreteFilm,
    force: Array,
    u: Array,
    position: Array,
    tolerance: float,
    max_iterations: int,
    motion: Motion = REST,
    free: slice | NDArray[np.int64] = EVERY,
) -> Solution:
    """Position at which the film carries `force`, by one Newton for film and shaft.

    Each step solves the film's linearisation for the pressure and for its derivative by the
    position; the exact stiffness that follows gives the step of the shaft. With `motion` the
    same is one implicit step in time. Only the degrees of freedom `free` move; the others are held.

    Where a law has a kink, a shaft at rest in a rigid bore waits while cells that count as full
    lack far too much: it would follow a load that is not there, and move the rupture to and fro.
    """
    u, whole = u.copy(), as_cylinder(film)
    if whole is not None and free is EVERY:
        return _at_once(film, whole, force, u, position, tolerance, max_iterations, motion)
    scale, gap = film.gap.dof_scale[free], film.gap.narrowest(position)
    pads = film.gap.pads.size > 0
    old = (motion.volume_rate, motion.volume)
    check, change, moving = _Check(film, tolerance, motion, force, free), math.inf, motion.moves
    pressing, most = 0, math.inf
    # in motion the film before is near, and its rupture; a shell moves it though the shaft waits
    at_once = moving or film.softness > 0.0 or film.law.kink == -math.inf
    patience = math.inf if at_once else WAITS * flux_of(film)
    if film.contact is not None and film.elastic:
        most = _OVERLOADED * film.load_scale(force)
    for iteration in range(1, max_iterations + 1):
        velocity = motion.velocity(position)
        damped = moving or change < NEARLY
        try:
            linear = film.linearise(u, position, velocity, *old, damped=damped)
        except SingularFilm:
            if iteration == 1:
                return no_film(film)
            break
        if math.hypot(*linear.load[:2]) > most:
            break
        slope = linear.stiffness + motion.rate * linear.damping
        excess = film.size(linear.columns[0]) / STEP_LIMIT
        step, missing = np.zeros(position.size), force - linear.load
        if linear.lacks <= patience:
            step[free] = _solve(slope[free][:, free], missing[free], scale) / max(excess, 1.0)
        target, weights, share = _moved(film, u, linear, position, step, motion)
        way = math.hypot(*(target - position).tolist())
        length = math.hypot(*step)
        stuck = pads and length > _STILL and way < _HELD * length
        pressing = pressing + 1 if film.contact and way < _STUCK * length else 0
        if share < _STUCK or stuck or pressing > _PRESSING or not math.isfinite(way):
            break
        change = film.correct(u, linear.columns, weights, fills=not moving)
        change = max(change, way / max(gap, PRESSED))
        position, gap = target, film.gap.narrowest(target)
        if not gap > PRESSED and not film.elastic:
            break
        if check.after(iteration, change, u, position, linear):
            if not damped:
                linear = film.linearise(u, position, velocity, *old)
            return check.solution(u, position, linear, True, iteration)
    return check.unanswered(u, position, linear, iteration)


def _at_once(
    film: DiscreteFilm,
    whole: Cylinder,
    force: Array | None,
    u: Array,
    position: Array,
    tolerance: float,
    most: int,
    motion: Motion,
) -> Solution:
    """The answer of the compiled loop; the shaft is held where there is no `force`."""
    place = np.array(position, dtype=float)
    load = np.zeros(2) if force is None else np.array(force, dtype=float)
    offset = np.zeros(2) if isinstance(motion.offset, float) else motion.offset
    volume = np.asarray(motion.volume) if motion.volume_rate else film.given
    ended, iterations, residual, allowed, last, count = kernel.solve(
        whole, u, place, load, force is not None, film.load_scale(load),
        (motion.rate, offset, motion.moves), (motion.volume_rate, volume), tolerance, most,
    )  # fmt: skip
    if ended == kernel.NONE:
        return no_film(film)
    out = whole.found[0].copy()
    linear = Linear(out[0], out[1:3], out[3:5], whole.columns[last, :count].copy())
    found = ended == kernel.ANSWERED, iterations, residual
    return Solution(u, place, linear, *found, rounding=allowed)


def _moved(
    film: DiscreteFilm, u: Array, linear: Linear, position: Array, step: Array, motion: Motion
) -> tuple[Array, Array, float]:
    """Position after the share of `step` that leaves a film, weights of the columns, the share."""
    target = film.target(position, step)
    velocity = motion.velocity(position)
    weights = film.weights(position, velocity, target, motion.velocity(target))
    share = film.step_share(u, linear.columns, weights, (position, target), not motion.moves)
    if share < 1.0:
        target, weights = position + share * (target - position), share * weights
    return target, weights, share


def _solve(matrix: Array, rhs: Array, scale: Array) -> Array:
    """Solve for a step. A singular 2×2 system gives none; a larger one the least, over `scale`.

    The second is a shaft on one single pad, free to go sideways while the pad follows. What is not
    finite gives NaN.
    """
    if rhs.size != 2:
        if not math.isfinite(float(matrix.sum() + rhs.sum())):
            return np.full(rhs.size, np.nan)
        return scale * np.asarray(np.linalg.lstsq(matrix * scale, rhs, rcond=1e-10)[0])
    (a, b), (c, d) = matrix.tolist()
    first, second = rhs.tolist()
    if not math.isfinite(a + b + c + d + first + second):
        return np.full(2, np.nan)
    det = a * d - b * c
    if det == 0.0:
        return np.zeros(2)
    return np.array([(d * first - b * second) / det, (a * second - c * first) / det])


def no_film(film: DiscreteFilm) -> Solution:
    """The answer where there is none: NaN, not converged."""
    nothing = np.full((film.gap.size, film.gap.size), np.nan)
    linear = Linear(nothing[0], nothing, nothing, nothing)
    return Solution(film.start(), nothing[0], linear, False, 0, np.inf)
