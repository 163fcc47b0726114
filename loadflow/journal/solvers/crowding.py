"""Other cells for a film that those asked for do not resolve, or on which none was found."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from loadflow.journal.solvers.load_stepping import APART, has_touched

if TYPE_CHECKING:
    from loadflow.journal.solvers.newton import Solution
    from loadflow.journal.solvers.statics import Statics

_MOST_AROUND = (120, 240)  # cells, of a shell that gives way all over, and where it is pressed
_SAME = 0.02  # angle, rad, by which the place of the narrowest gap must have moved for another
_HOPELESS = 0.8  # of the load, missing as the shaft touches: on no mesh the film carries it
_NARROW = 0.2  # narrowest gap, in clearances, above which no mesh but that is tried


def may_double(statics: Statics, omega: float) -> bool:
    """Whether a film in an elastic shell may have twice the cells around."""
    shell, around = statics.options.shell, statics.options.cells[0]
    if omega == 0.0 or shell is None or not shell.any_grid:
        return False
    return 2 * around <= _MOST_AROUND[shell.local]


def on_crowded_cells(statics: Statics, solution: Solution) -> Statics | None:
    """The film on cells that crowd where the gap of a `solution` closes; None: as before."""
    if statics.gap.axisymmetric:  # grooves hold the cells in their places
        fed = statics.options.supply is not None and not statics.film.dry(solution.u)
        return statics.on(statics.options, ()) if fed and statics.film.speed != 0.0 else None
    if statics.film.elastic:
        return _on_more_cells(statics, solution)
    if not np.isfinite(solution.position).all():
        return None
    if has_touched(statics.film, solution) and solution.residual > _HOPELESS:
        return None
    crowd, before = statics.gap.closing(solution.position, _NARROW), statics.crowd or ()
    same = len(crowd) == len(before) and np.allclose(crowd, before, atol=_SAME)
    return None if same else statics.on(statics.options, crowd)


def _on_more_cells(statics: Statics, solution: Solution) -> Statics | None:
    """The film in an elastic shell on twice the cells around; None where that is no help.

    Where a shell gives way by much on a cell, its gap follows the pressure from cell to cell
    so fast that the film has no answer on cells as long.
    """
    around, across = statics.options.cells
    if not may_double(statics, statics.film.speed) or statics.film.dry(solution.u):
        return None
    if statics.film.clearance_left(solution.position) <= APART:
        return None
    return statics.on(replace(statics.options, grid=(2 * around, across)))
