"""The rung "reduced" with effects: tilt, bend, crowns, asperities, a local shell, turbulent flow.

What `loadflow.journal.models.reduced` says of cells and points holds here, but that the gap changes
across the width: a shaft that tilts or bends takes polynomials over the whole of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.models import composed_film as at
from loadflow.journal.models._composed_loops import solve
from loadflow.journal.models.composed_model import (
    ComposedFilm,
    build,
    contact_share,
    levels_of,
    warn_unresolved,
)
from loadflow.journal.models.slow_heat import COLD, standing_states
from loadflow.journal.rows import operating_columns
from loadflow.journal.solvers.estimate import NEAR, OFF_THE_BORE
from loadflow.numerics.convergence import Limits

Array = NDArray[np.float64]

_AT_REST = np.zeros(1)  # one time
_NO_SLOPES = np.zeros((2, 0, 0))
_MISSED = 0.6  # of the load where the shaft touches: above 0.46 the grid had a film in no draw


def composes(bearing: JournalGeometry, film: Film, line: Line) -> bool:
    """Whether a film has more than laminar flow in an aligned, smooth, rigid bore as it is cut."""
    effects = film.contact, film.shell, film.turbulence, film.supply
    more = any(effect is not None for effect in effects) or bool(bearing.relief)
    return more or not line.straight


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
    for level in levels_of(options)[1:]:
        again = np.flatnonzero(found & left)
        if again.size:
            more, solved, still, _ = _equilibria(
                *given, force[again], speed[again], line.at(again), control, level
            )
            for name, values in more.items():
                answer[name][again[solved]] = values[solved]
            left[again] = still | ~solved
    if (left & found).any():
        warn_unresolved(left & found, f"load {int((left & found).argmax())}")
    return answer, found, none


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
    rows, lines, loads = (
        np.zeros((count, model.columns)),
        model.lines(speed.size),
        model.loads(force),
    )
    places = model.estimates(force, speed, lines)
    both = 4 if model.whole else 2
    stiffness, damping = np.zeros((count, both, both)), np.zeros((count, both, both))
    none, slopes = np.zeros(count, dtype=bool), np.zeros((2, both, both))

    def at_rest(place: Array, n: int, size: int, slopes: Array) -> Array:
        """Row of load `n` at rest; `place` moves in `size` coordinates to where it is carried."""
        this, row = slice(n, n + 1), np.zeros((1, model.columns))
        solve(
            film, work, place, size, 0, _AT_REST, loads[this], lines[this], speed[this],
            control.tolerance, control.max_iterations, row, slopes, COLD, standing_states(1),
        )  # fmt: skip
        return row[0]

    last: int | None = None
    for n in range(count):
        spent, converged, residual, rounding = 0, False, np.inf, 0.0
        work.liquid[:] = 0.0
        if speed[n] == 0.0 and options.contact is None and loads[n].any():
            rows[n, at.RESIDUAL] = np.inf
            continue  # no film without rotation and squeeze
        for place, first in _starts(model, places, last, n, rows, at_rest):
            row = at_rest(place, n, model.size, slopes)
            residual, iterations, answered, rounding = row[at.RESIDUAL : at.RESULTS]
            spent += int(iterations)
            converged = answered > 0.0 and (not options.may_grade or model.resolves(place))
            none[n] = first and _MISSED < residual < 1.0 and model.touches(place)
            if converged:
                rows[n], stiffness[n], damping[n] = row, *slopes
                work.last[:] = work.u
                last = n
            if answered or none[n]:
                break
        rows[n, at.RESIDUAL : at.RESULTS] = residual, spent, converged, rounding
    lengths = np.array([1.0, 1.0, bearing.radius, bearing.radius])[:both]
    scale = np.outer(lengths, lengths) / bearing.clearance
    position = rows[:, [at.X, at.Y]]
    answer = {
        **operating_columns(bearing, force, speed, options.liquid, position),
        "moment": np.zeros((count, 2)),
        "tilt": np.zeros((count, 2)),
        "pad_tilt": np.zeros((count, 0)),
        **model.results(rows, speed),
        "stiffness": stiffness * scale,
        "damping": damping * scale,
    }
    if options.contact is not None:
        answer["contact_share"] = contact_share(answer["contact_force"], force)
    return answer, rows[:, at.CONVERGED] > 0, model.unresolved_across(rows), none


def _starts(
    model: ComposedFilm,
    places: Array,
    last: int | None,
    n: int,
    rows: Array,
    at_rest: Callable[[Array, int, int, Array], Array],
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
        at_rest(place, n, 0, _NO_SLOPES)
        yield place, False
