"""The closed path of the shaft under a load that repeats."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, Literal, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.line import Line
from loadflow.journal.solvers.motion.all_times import (
    can_close_at_once,
    solve_all_times,
    solve_by_swing,
)
from loadflow.journal.solvers.motion.history import Past
from loadflow.journal.solvers.motion.orbit_error import Extremes
from loadflow.journal.solvers.motion.transient import Marcher, march, orbit_row
from loadflow.journal.solvers.newton import Solution
from loadflow.numerics.anderson import Anderson
from loadflow.numerics.convergence import is_small, rounding_level
from loadflow.numerics.lines import on_lines
from loadflow.tribology.film import effective_speed

Array = NDArray[np.float64]
Method = Literal["direct", "marching"]

DEPTH = 8  # periods that the direct method looks back
_PERIODS = 3  # of it, after which all times are solved at once
_STANDS = 1e-6  # share of the speed below which the effective speed is none


def check_period(time: Array, force: Array, speed: Array, line: Line) -> None:
    """Refuse loads, speeds, tilts and bends that do not end as they begin.

    Raises
    ------
    InputError
        Fewer than four samples, or first and last differ.
    """
    if time.size < 4:
        raise InputError(f"a period of {time.size} samples: give four or more, the last closing it")
    given = {"force": force, "speed": speed, "tilt": line.tilt, "bend": line.bend}
    for name, values in given.items():
        if values is None:
            continue
        gap = np.abs(values[-1] - values[0]).max()
        if gap > 1e-6 * np.abs(values).max():
            raise InputError(
                f"{name} is {values[0]} at the start of the period and {values[-1]} at its end: "
                "the last sample must close it"
            )


def load_speed(time: Array, force: Array) -> float:
    """Mean speed at which the load turns round over a period, rad/s."""
    angle = np.unwrap(np.arctan2(force[:, 1], force[:, 0]))
    return float((angle[-1] - angle[0]) / (time[-1] - time[0]))


def check_half_speed_whirl(time: Array, force: Array, speed: Array) -> None:
    """Name a steady load that turns at half the speed of the shaft: no film carries it.

    Raises
    ------
    SolverError
        The effective speed (3.8) vanishes.
    """
    size, turning, mean = np.hypot(*force.T), load_speed(time, force), float(speed.mean())
    angle = np.unwrap(np.arctan2(force[:, 1], force[:, 0]))
    steady = np.ptp(size) < 1e-6 * size.max() and np.ptp(speed) <= 1e-6 * abs(mean)
    even = np.abs(angle - angle[0] - turning * (time - time[0])).max() < 1e-6
    effective = effective_speed(mean, load=turning)
    if steady and even and abs(effective) < _STANDS * abs(mean) and size.max() > 0:
        raise SolverError(
            f"half-speed whirl: a load of {size[0]:.6g} N turns at {turning:.6g} rad/s, half the "
            f"speed of the shaft ({mean:.6g} rad/s); at the effective speed "
            f"{effective:.3g} rad/s the film carries nothing"
        )


def close_orbit(
    marcher: Marcher,
    start: Solution,
    time: Array,
    force: Array,
    speed: Array,
    method: Method,
    closure: float,
    max_periods: int,
    lines: Array | None = None,
) -> tuple[list[dict[str, Any]], tuple[Past, Past], dict[str, float]]:
    """Rows of the closed orbit, the history at both its ends, and its closure and periods.

    "marching" goes on from period to period; "direct" solves for the state at the start of the
    period that comes back, by Anderson's acceleration of the same map, and where some periods of
    that do not close and the film allows it, for all times at once. `lines` (n, 4) are tilt and
    bend of the shaft where they are given.

    Raises
    ------
    SolverError
        The orbit does not close within `max_periods`, or a step fails.
    """
    period = time[-1] - time[0]
    past = marcher.begin(float(time[0]), start)
    accelerate, residual = Anderson(DEPTH), math.inf
    # both states are within a clearance; every step of the period adds its roundings
    rounding = rounding_level(float(time.size))
    for number in range(1, max_periods + 1):
        rows, end, extremes = march(marcher, past, time, force, speed, lines)
        following = [replace(p, time=p.time - period) for p in end[-2:]]
        last, residual = residual, _distance(marcher, past[-1], following[-1])
        if is_small(residual, closure, rounding):
            about = {"closure": residual, "periods": number} | extremes.bounds()
            return [rows[-1], *rows], (past[-1], end[-1]), about
        if method == "direct" and number == _PERIODS:
            whole = _at_once(marcher, rows, time, force, speed)
            if whole is not None:
                closed, ends, extremes = whole
                about = {"closure": _distance(marcher, *ends), "periods": number}
                return closed, ends, about | extremes.bounds()
        if method == "direct" and len(past) == len(following):
            if residual > 2 * last:
                accelerate.forget()
            past = _mixed(marcher, accelerate, past, following, _bends(time, lines))
        else:
            past = following
    ratio = math.hypot(*past[-1].position)
    raise not_closed(residual, rounding, max_periods, ratio, time, force, speed)


def not_closed(
    residual: float,
    rounding: float,
    periods: int,
    ratio: float,
    time: Array,
    force: Array,
    speed: Array,
) -> SolverError:
    """Say that an orbit does not close; `residual` is what its ends differ by, at `ratio`."""
    return SolverError(
        f"the orbit does not close: its ends differ by {residual:.3g} after {periods} periods, "
        f"where rounding allows {rounding:.3g}, at ε = {ratio:.6g}; effective speed "
        f"{effective_speed(float(speed.mean()), load=load_speed(time, force)):.6g} rad/s"
    )


def _at_once(
    marcher: Marcher, rows: list[dict[str, Any]], time: Array, force: Array, speed: Array
) -> tuple[list[dict[str, Any]], tuple[Past, Past], Extremes] | None:
    """Rows, the history at both ends and extremes of the orbit that is closed at all times at once.

    It begins with the `rows` of a period; None where it is not found, or steps are not given.
    """
    film = marcher.film
    if not (math.isinf(marcher.accuracy) and can_close_at_once(film, len(rows))):
        return None
    path = np.array([[row["x"], row["y"]] for row in rows])
    limits = marcher.tolerance, marcher.max_iterations
    for solve in (solve_all_times, solve_by_swing):
        found = solve(film, path, time, force, speed, *limits)
        if found is not None:
            break
    else:
        return None
    extremes, closed = Extremes(film), []
    film.set_speed(float(speed[0]))
    first = marcher.begin(float(time[0]), found[-1])[0]
    last = first
    for number, solution in enumerate(found, 1):
        film.set_speed(float(speed[number]))
        last = marcher.next(last, float(time[number]), solution)
        closed.append(orbit_row(film, solution, 1))
        extremes.see(closed[-1], solution)
    return [closed[-1], *closed], (first, last), extremes


def _distance(marcher: Marcher, one: Past, other: Past) -> float:
    """Largest difference of two states: of positions, and of unknowns over their scale."""
    film = marcher.film
    moved = float(np.abs(one.position - other.position).max())
    return max(moved, float(np.abs(one.u - other.u).max()) / film.scale)


def _bends(time: Array, lines: Array | None) -> Callable[[float], Array] | None:
    """Bend of the shaft at a time of the period, or of the one before it; None: not given."""
    if lines is None:
        return None

    def bend(at: float) -> Array:
        turn = time[0] + (at - time[0]) % (time[-1] - time[0])
        return on_lines(turn, time, lines[:, 2:])

    return bend


def _mixed(
    marcher: Marcher,
    accelerate: Anderson,
    past: list[Past],
    following: list[Past],
    bend: Callable[[float], Array] | None,
) -> list[Past]:
    """Start of the next period from that of this one and of the `following`."""
    film = marcher.film
    weight = film.scale * math.sqrt(past[-1].u.size)

    def packed(states: list[Past]) -> Array:
        parts = [np.concatenate([p.position, p.u.ravel() / weight]) for p in states]
        return np.concatenate(parts)

    guesses = np.split(accelerate.next(packed(past), packed(following)), len(past))
    size = film.gap.size
    changed = not np.array_equal(past[-1].pads, following[-1].pads)
    if changed or any(film.gap.narrowest(guess[:size]) <= 0 for guess in guesses):
        accelerate.forget()
        return following
    mixed = []
    for p, guess in zip(following, guesses):
        if bend is not None:  # what is in the cells of a film follows its gap
            cast("ShapedGap", film.gap).bend(bend(p.time))
        mixed.append(
            marcher.past(p.time, weight * guess[size:].reshape(p.u.shape), guess[:size], p.pads)
        )
    return mixed
