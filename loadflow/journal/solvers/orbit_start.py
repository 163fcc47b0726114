"""How an orbit begins: its film, and the state at its first time."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.discretise import is_cylindrical
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.solvers.newton import Solution
from loadflow.journal.solvers.statics import Statics
from loadflow.journal.solvers.transient import OrbitStopped
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require

Array = NDArray[np.float64]


def orbit_start(
    bearing: JournalGeometry,
    options: Film,
    loads: Array,
    speeds: Array,
    line: Line,
    start: Array | None,
    control: Limits,
    prepare: Callable[[Statics], None] | None = None,
) -> tuple[Statics, Solution, Array]:
    """Film, first state and generalised loads (n, m) of an orbit.

    It begins at `start`, in clearances, or at the equilibrium of the first load; what there is to
    `prepare` of the film comes before.

    Raises
    ------
    loadflow.errors.InputError
        Pads that tilt; a start outside the bore.
    loadflow.errors.SolverError
        No film to start from.
    """
    if is_cylindrical(bearing, options, line):
        options = options.for_history()
    statics = Statics(bearing, options, line, float(np.abs(speeds).max()))
    require(not statics.gap.pads.size, "shape", bearing.shape.kind, "a fixed bore for an orbit")
    forces = statics.raise_scale(loads)
    if prepare is not None:
        prepare(statics)
    omega = float(speeds[0])
    if start is None:
        first = statics.solve(0, loads[0], omega, None, control)
        if not first.converged and statics.gap.axisymmetric:
            first = statics.settled(0, loads[0], omega, control)
    else:
        first = statics.hold(0, start, np.zeros(2), omega, control, name="start")
    if not first.converged:
        raise OrbitStopped(f"orbit cannot start: {statics.message(first, loads[0])}")
    return statics, first, forces
