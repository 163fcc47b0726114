"""Path of a shaft on several films under a load that changes with time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.solvers.assembly.member import AssemblyState
from loadflow.journal.solvers.assembly.solve import Assembly
from loadflow.journal.solvers.motion.history import backward_difference
from loadflow.numerics.convergence import Limits

Array = NDArray[np.float64]

_LEFT = 0.5  # share of the narrowest film that a first guess must leave
_SMALLEST = 1.0 / 256  # of a given step, to which a step that fails may be cut


@dataclass(frozen=True)
class Past:
    """What a step needs of an earlier time: state, and the oil stored in the cells of each film."""

    time: float
    state: AssemblyState
    stored: tuple[Array, ...]


def march(
    assembly: Assembly,
    first: AssemblyState,
    times: Array,
    forces: Array,
    speeds: Array,
    free: NDArray[np.int64],
    limits: Limits,
) -> list[AssemblyState]:
    """States at all `times` (n,) from `first`, by implicit steps of second order.

    Parameters
    ----------
    assembly : Assembly
        Films and shaft.
    first : AssemblyState
        At the first time.
    times, forces, speeds : array (n,), (n, 5), (n,)
        s; N and N m; rad/s. Between them load and speed are straight lines.
    free : array of int
        Degrees of freedom that move.
    limits : Limits
        Of each step.

    Raises
    ------
    loadflow.errors.SolverError
        A step fails even when cut.
    """
    past = [_past(assembly, float(times[0]), first)]
    states = [first]
    for i in range(1, times.size):
        done, share, spent = 0.0, 1.0, 0
        while done < 1.0:
            at = 1.0 if done + 1.01 * share > 1.0 else done + share
            now = float(times[i - 1] + at * (times[i] - times[i - 1]))
            force = forces[i - 1] + at * (forces[i] - forces[i - 1])
            speed = float(speeds[i - 1] + at * (speeds[i] - speeds[i - 1]))
            trial = _step(assembly, past, now, force, speed, free, limits)
            spent += trial.iterations
            if trial.converged:
                past = [*past[-1:], _past(assembly, now, trial)]
                done, share = at, min(2.0 * share, 1.0)
            elif share > _SMALLEST:
                share *= 0.5
            else:
                raise SolverError(
                    f"orbit stops at t = {now:.6g} s: load {force.tolist()}, ω = {speed:.6g} "
                    f"rad/s; residual {trial.residual:.3g} after {spent} Newton steps, narrowest "
                    f"film {assembly.narrowest(past[-1].state):.3g} m"
                )
        states.append(replace(past[-1].state, iterations=spent))
    return states


def _past(assembly: Assembly, time: float, state: AssemblyState) -> Past:
    """History of a solved state."""
    stored = []
    for member, own in zip(assembly.members, state.members):
        member.film.place(own.u, member.place(own, state.position))
        stored.append(member.film.liquid())
    return Past(time, state, tuple(stored))


def _step(
    assembly: Assembly,
    past: Sequence[Past],
    time: float,
    force: Array,
    speed: float,
    free: NDArray[np.int64],
    limits: Limits,
) -> AssemblyState:
    """One implicit step from `past` to `time`: BDF2 of variable step, the first one of order 1."""
    last = past[-1]
    step = time - last.time
    rate, kept = 1.0 / step, [(1.0 / step, last)]
    if len(past) > 1:
        ratio = step / (last.time - past[-2].time)
        rate, *weights = backward_difference(step, last.time - past[-2].time)
        kept = [*zip(weights, (last, past[-2]))]
    ahead = last.state
    if len(past) > 1:
        ahead = _ahead(past[-2].state, last.state, ratio)
        if assembly.narrowest(ahead) < _LEFT * assembly.narrowest(last.state):
            ahead = last.state
    members = []
    for number, (member, own) in enumerate(zip(assembly.members, ahead.members)):
        member.film.set_speed(member.sense * speed)
        old = sum((w * p.stored[number] for w, p in kept), np.zeros(own.u.shape))
        members.append(replace(own, old=old))
    start = replace(ahead, members=tuple(members), rate=rate, velocity=np.zeros(5))
    return assembly.solve(start, force, free, limits)


def _ahead(before: AssemblyState, last: AssemblyState, ratio: float) -> AssemblyState:
    """State on the straight line through two, `ratio` of their distance further."""
    members = tuple(
        replace(b, u=b.u + ratio * (b.u - a.u), pad=b.pad + ratio * (b.pad - a.pad))
        for a, b in zip(before.members, last.members)
    )
    position = last.position + ratio * (last.position - before.position)
    return replace(last, position=position, members=members)


def series(time: Any, force: Any, speed: Any, moment: Any, axes: int) -> tuple[Array, ...]:
    """Times (n,), forces (n, axes), speeds (n,) and moments (n, 2) of an orbit, checked.

    Raises
    ------
    loadflow.errors.InputError
        Misshapen, not finite or not increasing values.
    """
    times = np.atleast_1d(np.asarray(time, dtype=float))
    if times.ndim != 1 or times.size < 2:
        raise InputError(f"time {times.shape}: two times or more in one row")
    shapes = {"force": (times.size, axes), "speed": (times.size,), "moment": (times.size, 2)}
    values = {"force": force, "speed": speed, "moment": (0.0, 0.0) if moment is None else moment}
    found = {}
    for name, shape in shapes.items():
        array = np.asarray(values[name], dtype=float)
        if name == "force" and axes == 1 and array.ndim <= 1:
            array = array[..., None]
        try:
            found[name] = np.broadcast_to(array, shape)
        except ValueError as error:
            raise InputError(f"{name} {array.shape} does not fit time {times.shape}") from error
    for name, array in {"time": times, **found}.items():
        bad = np.argwhere(~np.isfinite(array))
        if bad.size:
            raise InputError(f"{name}{bad[0].tolist()} = {array[tuple(bad[0])]}: must be finite")
    late = np.flatnonzero(~(np.diff(times) > 0))
    if late.size:
        raise InputError(f"time[{late[0] + 1}] = {times[late[0] + 1]} does not increase")
    return times, found["force"], found["speed"], found["moment"]
