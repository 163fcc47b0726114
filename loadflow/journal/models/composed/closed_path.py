"""The closed path of a reduced film under a load that repeats.

A period is one march of the compiled loops from the state at its start: film, shaft and pads at the
last two times. What comes back after a period is solved for as on the grid, see
`loadflow.journal.solvers.motion.periodic`. All of a path has as many points across as its samples
ask for.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.kernels._pad_kernels import BEFORE, LAST
from loadflow.journal.models.composed.model import contact_share, warn_unresolved
from loadflow.journal.models.composed.path import (
    STEP_BEFORE,
    Drive,
    March,
    State,
    march_of,
)
from loadflow.journal.models.composed.uneven import Thickness
from loadflow.journal.questions import InMotion
from loadflow.journal.solvers.motion.periodic import DEPTH, not_closed
from loadflow.journal.solvers.statics import Statics
from loadflow.numerics.anderson import Anderson
from loadflow.numerics.convergence import is_small, rounding_level

Array = NDArray[np.float64]

_FIRST = 2  # sample that is stepped to first: before it is the first time, and the one before


def orbit(
    asked: InMotion,
    begin: Callable[[], Array],
    viscosity: Thickness | None = None,
    warm: Statics | None = None,
) -> tuple[dict[str, Any], dict[str, float]]:
    """Variables of the closed path over time, and its closure and periods.

    `begin`, `viscosity` and `warm` are those of `composed.path.orbit`.

    Raises
    ------
    loadflow.errors.SolverError
        No equilibrium to start from, a step that fails even when cut to 1/256, or a path that does
        not close.

    Warns
    -----
    loadflow.errors.ValidityWarning
        A pressure that changes more across the width than the polynomials do; names the time.
    """
    time, force, count = asked.time, asked.force, asked.time.size
    past = np.append(0, np.arange(count))  # the first time has one before it
    times = time[past]
    times[0] -= time[-1] - time[-2]
    march = march_of(Drive.of(replace(asked.at(past), time=times), viscosity, warm))
    period = _Period(march)
    for level in march.levels:
        if period.state is None:
            period.state = march.begins(level, begin)
        closes = period.state is not None and period.closes(level)
        if closes and march.resolved(level, _FIRST, count + 1):
            break
    if period.state is None:
        raise march.not_begun()
    if not period.whole:
        raise march.stops(_FIRST, count + 1)
    around = np.append(count, np.arange(_FIRST, count + 1))
    left = march.model.unresolved_on_path(march.rows[around], force)
    if left.any():
        warn_unresolved(left, f"t = {time[left.argmax()]:.6g} s")
    values = march.results() | {"x": march.rows[:, at.X], "y": march.rows[:, at.Y]}
    values = {name: rows[around] for name, rows in values.items()}
    if asked.film.contact is not None:
        values["contact_share"] = contact_share(values["contact_force"], force)
    return values, {"closure": period.residual, "periods": period.number}


class _Period:
    """The state at the start of a period, and what comes back of it.

    Attributes
    ----------
    state : State, optional
        Film, shaft and pads at the start; None: none has been found.
    residual : float
        Largest difference of the state and what has come back.
    number : int
        Periods that have been gone through.
    whole : bool
        Whether the last one has been, to its end.
    """

    def __init__(self, march: March) -> None:
        self.march, self.steps = march, march.drive.steps
        self.state: State | None = None
        self.residual, self.number, self.whole = math.inf, 0, True

    def closes(self, level: int) -> bool:
        """Whether a period on the points across of a level comes back; goes on from the state.

        Where a step fails on a guess, what had come back before is gone on with.

        Raises
        ------
        loadflow.errors.SolverError
            The path does not close within the periods allowed.
        """
        assert self.state is not None
        state = self._following(self.state, level)  # on the points of the level
        if state is None:
            return False
        plain, accelerate, last = state, Anderson(DEPTH), math.inf
        times = self.march.drive.time.size
        rounding = rounding_level(float(times))  # every step of the period adds its own
        while self.number < self.steps.max_periods:
            following = self._following(state, level)
            if following is None and state is plain:
                return False
            if following is None:
                state = plain
                accelerate.forget()
                continue
            last, self.residual = self.residual, self._distance(state, following)
            if is_small(self.residual, self.steps.closure, rounding):
                self.state = following
                return True
            if self.residual > 2.0 * last:
                accelerate.forget()
            before, state, plain = state, following, following
            if self.steps.periodic != "marching":
                state = self._mixed(accelerate, before, following)
        drive, ratio = self.march.drive, float(np.hypot(*plain.place[:2]))
        found = self.residual, rounding, self.number, ratio
        raise not_closed(*found, drive.time[1:], drive.force[1:], drive.speed[1:])

    def _following(self, state: State, level: int) -> State | None:
        """The state after a period; None where a step fails."""
        begin = _FIRST if state.past[STEP_BEFORE] > 0.0 else 1
        following = self.march.goes_on(state, level, begin, self.march.drive.time.size)
        self.number, self.whole = self.number + 1, following is not None
        return following

    def _parts(self, state: State) -> tuple[Array, Array]:
        """Shaft and pads, and the film over its scale, at the last two times, (2, …)."""
        model, size = self.march.drive.model(state.level), self.march.model.size
        moves = np.stack([state.place[:size], state.place_before[:size]])
        if state.tilts is not None:
            moves = np.hstack([moves, state.tilts[[LAST, BEFORE]]])
        inner = model.film.nodes.slopes.shape[1]
        film = np.stack([state.last[:, :inner], state.before[:, :inner]]) / model.film.ring.scale
        return moves, film

    def _distance(self, one: State, other: State) -> float:
        """Largest difference of two states, clearances, and of their films, over the scale."""
        pairs = zip(self._parts(one), self._parts(other))
        return max(float(np.abs(a[0] - b[0]).max()) for a, b in pairs)

    def _mixed(self, accelerate: Anderson, state: State, following: State) -> State:
        """Start of the next period from that of this one and what came back."""
        guess, value = self._parts(state), self._parts(following)
        weight = math.sqrt(value[1][0].size)

        def packed(parts: tuple[Array, Array]) -> Array:
            return np.concatenate([parts[0].ravel(), parts[1].ravel() / weight])

        mixed = accelerate.next(packed(guess), packed(value))
        moves = mixed[: value[0].size].reshape(value[0].shape)
        film = weight * mixed[value[0].size :].reshape(value[1].shape)
        mixture = self._with(following, moves, film)
        alike = state.on is None or bool((state.on == following.on).all())
        if alike and self._has_film(mixture):
            return mixture
        accelerate.forget()
        return following

    def _has_film(self, state: State) -> bool:
        """Whether a rigid shell leaves a gap; one that gives way may."""
        film = self.march.model.film
        return film.give > 0.0 or self.march.least(state) > -film.rough.deepest

    def _with(self, state: State, moves: Array, film: Array) -> State:
        """A state with other places, tilts and films, as `_parts` has them."""
        size, inner = self.march.model.size, film.shape[2]
        places = [state.place.copy(), state.place_before.copy()]
        films = [state.last.copy(), state.before.copy()]
        scale = self.march.drive.model(state.level).film.ring.scale
        for place, unknowns, moved, filled in zip(places, films, moves, film):
            place[:size], unknowns[:, :inner] = moved[:size], scale * filled
        tilts = None if state.tilts is None else state.tilts.copy()
        if tilts is not None:
            tilts[[LAST, BEFORE]] = moves[:, size:]
        return state._replace(
            last=films[0], before=films[1], place=places[0], place_before=places[1], tilts=tilts
        )
