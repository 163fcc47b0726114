"""Shafts at rest and films at given positions on the grid, as rows of results."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.rows import field_row, static_row
from loadflow.journal.solvers.newton import Solution
from loadflow.journal.solvers.statics import Statics
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require

Array = NDArray[np.float64]


def equilibrium_rows(
    bearing: JournalGeometry,
    options: Film,
    loads: Array,
    speeds: Array,
    line: Line,
    control: Limits,
) -> list[dict[str, Any]]:
    """Rows of `Equilibrium` for `loads` (n, 2), N, and `speeds` (n,), rad/s.

    Raises
    ------
    loadflow.errors.SolverError
        If ``control.strict``, the first load without an answer.
    """
    statics = Statics(bearing, options, line, float(np.abs(speeds).max()))
    if statics.film.pockets.free.size:  # the supply must raise the pressure that carries the load
        statics.raise_scale(loads)
    rows = []
    last: Solution | None = None
    for index, (load, omega) in enumerate(zip(loads, speeds.tolist())):
        used, solution = statics.resolve(index, load, omega, last, control)
        if not solution.converged and control.strict:
            raise SolverError(f"load {index}: {used.message(solution, load)}")
        last = solution if solution.converged and used is statics else last
        rows.append(
            static_row(bearing, used.film, used.gap, load, options.liquid, solution, line.whirl)
        )
    return rows


def field_rows(
    bearing: JournalGeometry,
    options: Film,
    places: Array,
    velocities: Array,
    speeds: Array,
    line: Line,
    control: Limits,
) -> tuple[list[dict[str, Any]], Array]:
    """Rows of `FilmField` and axial places of the cells, m.

    `places` (n, 2) are in clearances, `velocities` (n, 2) in clearances per second.

    Raises
    ------
    loadflow.errors.InputError
        The first position at which the shaft touches the bore.
    loadflow.errors.SolverError
        If ``control.strict``, the first film without an answer.
    """
    require(line.moment is None, "moment", "given", "tilt is given where the position is")
    fastest = np.abs(speeds) + np.hypot(velocities[:, 0], velocities[:, 1])
    statics = Statics(bearing, options, line, float(fastest.max()))
    rows = []
    for index, (place, moving, omega) in enumerate(zip(places, velocities, speeds.tolist())):
        solution = statics.hold(index, place, moving, omega, control)
        if not solution.converged and control.strict:
            raise SolverError(f"film {index}: {statics.message(solution)}")
        rows.append(field_row(statics.film, statics.gap, solution))
    return rows, statics.film.mesh.z * bearing.radius
