"""Other cells for a film that those asked for do not resolve, or on which none was found."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.gap import BoreGap
from loadflow.journal.film_model import Film
from loadflow.journal.solvers.load_stepping import APART, has_touched
from loadflow.journal.solvers.newton import Solution

Crowd = tuple[float, ...]

_MOST_AROUND = (120, 240)  # cells, of a shell that gives way all over, and where it is pressed
_SAME = 0.02  # angle, rad, by which the place of the narrowest gap must have moved for another
_HOPELESS = 0.8  # of the load, missing as the shaft touches: on no mesh the film carries it
_NARROW = 0.2  # narrowest gap, in clearances, above which no mesh but that is tried


def may_double(options: Film, omega: float) -> bool:
    """Whether a film in an elastic shell may have twice the cells around."""
    shell, around = options.shell, options.cells[0]
    if omega == 0.0 or shell is None or not shell.any_grid:
        return False
    return 2 * around <= _MOST_AROUND[shell.local]


def other_cells(
    film: DiscreteFilm, gap: BoreGap, options: Film, crowd: Crowd | None, solution: Solution
) -> tuple[Film, Crowd | None] | None:
    """Options and crowd of cells that suit the gap of a `solution` better; None: as before.

    Cells crowd where the gap closes; in an elastic shell there are twice as many around.
    """
    if gap.axisymmetric:  # grooves hold the cells in their places
        fed = options.supply is not None and not film.dry(solution.u)
        return (options, ()) if fed and film.speed != 0.0 else None
    if film.elastic:
        more = _on_more_cells(film, options, solution)
        return None if more is None else (more, None)
    if not np.isfinite(solution.position).all():
        return None
    if has_touched(film, solution) and solution.residual > _HOPELESS:
        return None
    closing, before = gap.closing(solution.position, _NARROW), crowd or ()
    same = len(closing) == len(before) and np.allclose(closing, before, atol=_SAME)
    return None if same else (options, closing)


def _on_more_cells(film: DiscreteFilm, options: Film, solution: Solution) -> Film | None:
    """Twice the cells around an elastic shell; None where that is no help.

    Where a shell gives way by much on a cell, its gap follows the pressure from cell to cell so
    fast that the film has no answer on cells as long.
    """
    around, across = options.cells
    if not may_double(options, film.speed) or film.dry(solution.u):
        return None
    if film.clearance_left(solution.position) <= APART:
        return None
    return replace(options, grid=(2 * around, across))
