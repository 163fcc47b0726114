"""Shafts at rest and films at given positions on the grid, as rows of results."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.questions import AtPosition, AtRest
from loadflow.journal.rows import field_cells, field_row, static_row
from loadflow.journal.solvers.newton import Solution, no_film
from loadflow.journal.solvers.search import Search, goes_on
from loadflow.journal.solvers.statics import Statics
from loadflow.numerics.fields import require
from loadflow.numerics.lines import on_lines

Array = NDArray[np.float64]


def equilibrium_rows(asked: AtRest) -> list[dict[str, Any]]:
    """Rows of `Equilibrium`.

    Raises
    ------
    loadflow.errors.SolverError
        If ``limits.strict``, the first load without an answer.
    """
    bearing, options, line, control = asked.bearing, asked.film, asked.line, asked.limits
    loads, speeds = asked.force, asked.speed
    statics = Statics(bearing, options, line, float(np.abs(speeds).max()))
    if statics.film.pockets.free.size:  # the supply must raise the pressure that carries the load
        statics.raise_scale(loads)
    rows = []
    last: Solution | None = None
    for index, (load, omega) in enumerate(zip(loads, speeds.tolist())):
        search: Search = Search() if line.searches is None else line.searches[index]
        over = search.over
        if control.strict and search.why is not None and (over or search.why[0] == omega):
            raise SolverError(f"load {index}: {search.why[1]}")
        effort = search.effort(statics.film, control.max_iterations)
        if over and index and search.hopeless:
            given = statics.film, statics.gap, load, options.liquid, no_film(statics.film)
            rows.append(static_row(bearing, *given, line.whirl))
            continue
        on, near = statics, last
        if search.last is not None:
            on, near = goes_on(search.last[0], search.last[1], statics)
        used, solution = on.resolve(index, load, omega, near, control, effort=effort)
        if not solution.converged and on is not statics:
            used, solution = statics.resolve(index, load, omega, last, control, effort=effort)
        if not solution.converged and line.start(index) is not None:
            afresh = Statics(bearing, options, replace(line, near=None), statics.rate)
            afresh.film.raise_scale(statics.film.scale)
            used, solution = afresh.resolve(index, load, omega, None, control, effort=effort)
        search.note(solution.converged)
        if not solution.converged:
            if not over or search.why is None:
                search.why = omega, used.message(solution, load)
            if control.strict:
                raise SolverError(f"load {index}: {search.why[1]}")
        else:
            search.last = used, solution
            search.give_back()
            last = solution if used is statics else last
        rows.append(
            static_row(bearing, used.film, used.gap, load, options.liquid, solution, line.whirl)
        )
    return rows


def field_rows(asked: AtPosition) -> tuple[list[dict[str, Any]], Array]:
    """Rows of `FilmField` and axial places of the cells, m.

    Each film is solved on the cells on which an equilibrium would be there; if those of some are
    graded, all are shown on as many.

    Raises
    ------
    loadflow.errors.InputError
        The first position at which the shaft touches the bore.
    loadflow.errors.SolverError
        If ``limits.strict``, the first film without an answer.
    """
    places, velocities, speeds = asked.position, asked.velocity, asked.speed
    bearing, line, control = asked.bearing, asked.line, asked.limits
    require(line.moment is None, "moment", "given", "tilt is given where the position is")
    fastest = np.abs(speeds) + np.hypot(velocities[:, 0], velocities[:, 1])
    statics = Statics(bearing, asked.film, line, float(fastest.max()))
    suited = [statics.suited(place) for place in places]
    shown = next((used for used in suited if used is not statics), statics)
    rows = []
    for index, (used, omega) in enumerate(zip(suited, speeds.tolist())):
        solution = used.hold(index, places[index], velocities[index], omega, control)
        if not solution.converged and control.strict:
            raise SolverError(f"film {index}: {used.message(solution)}")
        row = field_row(used.film, used.gap, solution)
        rows.append(row if used is shown else row | _cells_of(shown, used, solution))
    return rows, shown.film.mesh.z * bearing.radius


def _cells_of(shown: Statics, own: Statics, solution: Solution) -> dict[str, Any]:
    """Cells of a film, solved on its `own` mesh, as they lie on that of `shown`."""
    mesh, film, place = own.film.mesh, shown.film, solution.position
    ends = np.full(mesh.shape[0], own.film.unknown_of(np.array(own.film.p_edge)))
    lines = np.column_stack([solution.u, ends])
    angles, old = film.mesh.angles(place), mesh.angles(place)
    around = on_lines(angles, old, lines, period=2.0 * np.pi)
    u = on_lines(film.mesh.z, np.append(mesh.z, mesh.z_edges[-1]), around.T)
    return field_cells(film, shown.gap, np.ascontiguousarray(u.T), place)
