"""The rung "reduced" with effects: tilt and bend, asperities, a local shell, turbulent flow.

What `loadflow.journal.models.reduced` says of cells and points holds here, but that the gap changes
across the width: a shaft that tilts or bends takes polynomials over the whole of it.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError, ValidityWarning
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.models import composed_film as at
from loadflow.journal.models._composed_gap_kernels import turn
from loadflow.journal.models._composed_kernels import summarise
from loadflow.journal.models._composed_loops import finish, march, newton
from loadflow.journal.models.composed_model import LEVELS, ComposedFilm, build
from loadflow.journal.models.model import Steps
from loadflow.journal.models.ring import no_start, stopped
from loadflow.journal.models.slow_heat import THIN, cooled, lighter, slow_states
from loadflow.journal.rows import operating_columns
from loadflow.journal.solvers.estimate import NEAR, OFF_THE_BORE
from loadflow.numerics.convergence import Limits

Array = NDArray[np.float64]

_MISSED = 0.6  # of the load where the shaft touches: above 0.46 the grid had a film in no draw


def composes(film: Film, line: Line) -> bool:
    """Whether a film has more than laminar flow in an aligned, smooth, rigid cylinder."""
    effects = film.contact, film.shell, film.turbulence
    return any(effect is not None for effect in effects) or not line.straight


def equilibrium(
    bearing: JournalGeometry, options: Film, force: Array, speed: Array, line: Line, control: Limits
) -> tuple[dict[str, Any], NDArray[np.bool_], NDArray[np.bool_]]:
    """Fields of `Equilibrium`, which loads have an answer, and which surely have none.

    Warns
    -----
    loadflow.errors.ValidityWarning
        A pressure that changes more across the width than the polynomials do; names the load.
    """
    given = bearing, options
    answer, found, left, none = _equilibria(*given, force, speed, line, control, 0)
    for level in LEVELS[1:]:
        again = np.flatnonzero(found & left)
        if again.size:
            more, solved, still, _ = _equilibria(
                *given, force[again], speed[again], line.at(again), control, level
            )
            for name, values in more.items():
                answer[name][again[solved]] = values[solved]
            left[again] = still | ~solved
    if (left & found).any():
        _warn(left & found, f"load {int((left & found).argmax())}")
    return answer, found, none


def _warn(left: NDArray[np.bool_], first: str) -> None:
    """Warn of what is `left` (n,), of which `first` is the first."""
    warnings.warn(
        f'rung "reduced": the pressure at a bearing end is not resolved at {left.sum()} of '
        f'{left.size} samples, first at {first}; "grid" with enough cells across does',
        ValidityWarning,
        stacklevel=5,
    )


def _equilibria(
    bearing: JournalGeometry,
    options: Film,
    force: Array,
    speed: Array,
    line: Line,
    control: Limits,
    level: int,
) -> tuple[dict[str, Any], NDArray[np.bool_], NDArray[np.bool_], NDArray[np.bool_]]:
    """Fields of `Equilibrium`, and which loads: have an answer, ask for more points, have none."""
    model = build(bearing, options, speed, line, level)
    film, work, count = model.film, model.work, speed.size
    rows, lines, loads = np.zeros((count, at.RESULTS)), model.lines(speed.size), model.loads(force)
    places = model.estimates(force, speed, lines)
    both = 4 if model.whole else 2
    stiffness, damping = np.zeros((count, both, both)), np.zeros((count, both, both))
    none = np.zeros(count, dtype=bool)
    last: int | None = None
    for n in range(count):
        spent, converged, residual, rounding = 0, False, np.inf, 0.0
        work.bend[:] = lines[n, 2:]
        work.liquid[:] = 0.0
        turn(film, work, speed[n], 1.0)
        if speed[n] == 0.0 and options.contact is None and loads[n].any():
            rows[n, at.RESIDUAL] = np.inf
            continue  # no film without rotation and squeeze
        for place, first in _starts(model, places, last, n, rows, speed[n], control):
            residual, iterations, answered, rounding = newton(
                film, work, place, loads[n], model.size, speed[n], 0.0,
                control.tolerance, control.max_iterations,
            )  # fmt: skip
            spent += iterations
            converged = answered and (not options.may_grade or model.resolves(place))
            none[n] = first and _MISSED < residual < 1.0 and model.touches(place)
            if converged:
                finish(film, work, place, speed[n], both, rows[n], stiffness[n], damping[n])
                work.last[:] = work.u
                last = n
            if answered or none[n]:
                break
        rows[n, at.RESIDUAL :] = residual, spent, converged, rounding
    lengths = np.array([1.0, 1.0, bearing.radius, bearing.radius])[:both]
    scale = np.outer(lengths, lengths) / bearing.clearance
    position = rows[:, [at.X, at.Y]]
    answer = {
        **operating_columns(bearing, force, speed, options.liquid, position),
        "moment": np.zeros((count, 2)),
        "tilt": np.zeros((count, 2)),
        "pad_tilt": np.zeros((count, 0)),
        **model.results(rows, speed, lines),
        "stiffness": stiffness * scale,
        "damping": damping * scale,
    }
    if options.contact is not None:
        answer["contact_share"] = _share(answer["contact_force"], force)
    return answer, rows[:, at.CONVERGED] > 0, model.unresolved_across(rows), none


def orbit(
    bearing: JournalGeometry,
    options: Film,
    time: Array,
    force: Array,
    speed: Array,
    line: Line,
    control: Limits,
    steps: Steps,
    begin: Callable[[], Array],
) -> dict[str, Any]:
    """Variables of the path over time.

    `begin` finds the first position (4,) where none is given and the film alone does not.

    Raises
    ------
    loadflow.errors.SolverError
        No equilibrium to start from, or a step that fails even when cut to 1/256.

    Warns
    -----
    loadflow.errors.ValidityWarning
        A pressure that changes more across the width than the polynomials do; names the time.
    """
    given = bearing, options, time, force, speed, line, control, steps, begin
    for level in LEVELS[:-1]:
        try:
            values, left = _path(*given, level)
        except SolverError:
            continue
        if not left.any():
            return values
    values, left = _path(*given, LEVELS[-1])
    if left.any():
        _warn(left, f"t = {time[left.argmax()]:.6g} s")
    return values


def _path(
    bearing: JournalGeometry,
    options: Film,
    time: Array,
    force: Array,
    speed: Array,
    line: Line,
    control: Limits,
    steps: Steps,
    begin: Callable[[], Array],
    level: int,
) -> tuple[dict[str, Any], NDArray[np.bool_]]:
    """Variables of the path over time, and at which samples they ask for more points across."""
    model = build(bearing, options, speed, line, level)
    raised = float(np.hypot(*force.T).max()) / (bearing.width * bearing.diameter)
    model.units.raise_scale(raised)
    film = model.film._replace(ring=model.film.ring._replace(scale=model.units.scale))
    model = replace(model, film=film)
    work, rows = model.work, np.zeros((time.size, at.RESULTS))
    lines, loads = model.lines(time.size), model.loads(force)
    work.bend[:] = lines[0, 2:]
    work.u[:] = model.cold()
    place = model.estimates(force[:1], speed[:1], lines[:1])[0]
    size = model.size if steps.start is None else 0
    if steps.start is not None:
        place[:2] = steps.start
    rub = 0.0 if options.contact is None else options.contact.coefficient * bearing.radius
    share = 0.5 if model.whole else 1.0
    warmth, states = slow_states(options, model.units, share, rub, steps.temperature, time.size)
    limits = control.tolerance, 2 * control.max_iterations
    thin, light = float(states[0, THIN]), lighter(warmth, states, 0) if warmth.on else 1.0
    turning = speed[0] * thin
    turn(film, work, speed[0], light / thin)
    first = place.copy()
    residual, iterations, converged, rounding = newton(
        film, work, first, loads[0], size, turning, 0.0, *limits
    )
    if not converged and steps.start is None:
        first = begin()
        work.u[:] = model.cold()
        for moving in (0, size):  # the film first
            residual, iterations, converged, rounding = newton(
                film, work, first, loads[0], moving, turning, 0.0, *limits
            )
    if not converged:
        found = residual, rounding, iterations
        raise no_start(force[0], speed[0], float(np.hypot(*first[:2])), found)
    summarise(film, work, first, 0.5 * film.ring.slope * turning, rows[0])
    rows[0, at.RESIDUAL :] = residual, iterations, converged, rounding
    solved = march(
        film, work, first, model.size, time, loads, lines, speed,
        control.tolerance, control.max_iterations, rows, warmth, states,
    )  # fmt: skip
    last = solved - 1
    if not rows[last, at.CONVERGED]:
        found = tuple(rows[last, [at.RESIDUAL, at.ROUNDING, at.ITERATIONS]])
        ratio = float(np.hypot(rows[last, at.X], rows[last, at.Y]))
        raise stopped(time[last], force[last], speed[last], ratio, found)
    values = model.results(rows, speed * states[:, THIN], lines)
    values |= {"x": rows[:, at.X], "y": rows[:, at.Y]}
    if options.contact is not None:
        values["contact_share"] = _share(values["contact_force"], force)
    return cooled(warmth, states, values), model.unresolved_on_path(rows, force)


def _starts(
    model: ComposedFilm,
    places: Array,
    last: int | None,
    n: int,
    rows: Array,
    speed: float,
    control: Limits,
) -> Iterator[tuple[Array, bool]]:
    """Positions to start load `n` from, and which is the first; sets the unknowns of each.

    The last ones are off the bore with their film solved: near the bore, and without a film, the
    first steps of a shaft lead far away.
    """
    work = model.work
    if last is not None:
        before = rows[last, :4]
        moved, turned = np.hypot(*(places[n] - places[last]).reshape(2, 2).T)
        gap = max(1.0 - np.hypot(*before[:2]), model.film.rough.size)
        given = 0.0 if model.size == 4 else turned * model.film.nodes.z.max()
        if moved + given < NEAR * gap:
            work.u[:] = work.last
            yield np.append(before[:2], (before if model.size == 4 else places[n])[2:]), False
    work.u[:] = model.cold()
    yield places[n].copy(), True
    for share in OFF_THE_BORE:
        work.u[:] = model.cold()
        place = places[n].copy()
        place[:2] *= share
        newton(
            model.film, work, place, np.zeros(4), 0, speed, 0.0,
            control.tolerance, control.max_iterations,
        )  # fmt: skip
        yield place, False


def _share(carried: Array, force: Array) -> Array:
    """Part of loads (n, 2) that asperities carry along them, over their size; 0 without load."""
    size = (force * force).sum(axis=-1)
    along = (carried * force).sum(axis=-1)
    return np.where(size > 0.0, along / np.where(size > 0.0, size, 1.0), 0.0)
