"""How an orbit begins: its film, and the state at its first time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.discretise import is_cylindrical
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.load_stepping import APART
from loadflow.journal.solvers.motion.transient import OrbitStopped
from loadflow.journal.solvers.newton import Solution
from loadflow.journal.solvers.statics import Statics
from loadflow.numerics.convergence import Limits

Array = NDArray[np.float64]


def orbit_film(
    bearing: JournalGeometry, options: Film, loads: Array, speeds: Array, line: Line
) -> tuple[Statics, Array]:
    """Film of an orbit, and its generalised loads (n, m)."""
    if is_cylindrical(bearing, options, line):
        options = options.for_history()
    statics = Statics(bearing, options, line, float(np.abs(speeds).max()))
    return statics, statics.raise_scale(loads)


def orbit_start(
    statics: Statics, load: Array, omega: float, start: Array | None, control: Limits
) -> Solution:
    """First state of an orbit: at `start`, in clearances, or the equilibrium of its first load.

    Raises
    ------
    loadflow.errors.InputError
        A start outside the bore.
    OrbitStopped
        No film to start from.
    loadflow.errors.SolverError
        None, as the shaft meets the elastic shell.
    """
    effort = Effort.of(statics.film, control.max_iterations)
    given = effort.left
    if start is None:
        first = statics.solve(0, load, omega, None, control, effort=effort)
        if not first.converged and statics.gap.axisymmetric:
            first = statics.settled(0, load, omega, control)
    else:
        first = statics.hold(0, start, np.zeros(2), omega, control, name="start")
    if not first.converged:
        why = f"orbit cannot start: {statics.message(first, load)}"
        if statics.film.elastic and statics.film.clearance_left(first.position) <= APART:
            raise SolverError(why)  # which more cells do not change
        # of a shell a step takes more than its cells
        work = max(float(first.iterations * statics.film.mesh.order.size), given - effort.left)
        raise OrbitStopped(why, work=work)
    return first
