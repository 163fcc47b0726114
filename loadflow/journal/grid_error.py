"""How far the cells leave a result from that of ever finer ones, from two grids."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.journal.bearing import JournalBearing
from loadflow.journal.film_model import Film, Keywords, film_and_control
from loadflow.journal.lubricant import Lubricant

Array = NDArray[np.float64]


@dataclass(frozen=True)
class GridError:
    """Estimated errors of the fields of `Equilibrium` of the same names, in their units.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lubricant, grid_error
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> error = grid_error(bearing, (1e4, 0.0), 100.0, Lubricant(0.02))
    >>> bool(0.0 < error.maximum_pressure < 1e5)  # Pa
    True
    """

    eccentricity_ratio: Array
    attitude_angle: Array
    minimum_film: Array
    maximum_pressure: Array
    friction_power: Array
    side_flow: Array


def grid_error(
    bearing: JournalBearing,
    force: ArrayLike,
    speed: ArrayLike,
    film: Film | Lubricant | None = None,
    **keywords: Unpack[Keywords],
) -> GridError:
    """Estimate what the cells of `grid` do to a static equilibrium.

    The difference from half as many cells each way, which costs a quarter of the solution on top of
    it. It is three times the error where that falls with the square of the cell, as it does on the
    default grids of the sharp laws. A gas mixture, whose fill is carried upwind, mixes both orders:
    there it tells the order of magnitude.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.
    force, speed, film, **keywords
        As in `JournalBearing.equilibrium`.

    Returns
    -------
    GridError

    Raises
    ------
    loadflow.errors.InputError, loadflow.errors.SolverError
        As `JournalBearing.equilibrium`; a grid too coarse to be halved.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lubricant, grid_error
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> error = grid_error(bearing, (1e4, 0.0), 100.0, Lubricant(0.02))
    >>> bool(error.eccentricity_ratio < 1e-3)
    True
    """
    film, control = film_and_control(film, (), None, keywords)
    around, across = film.cells
    half = (around // 2, max(2 * (across // 4), 2))
    fine, coarse = (
        bearing.equilibrium(force, speed, replace(film, grid=cells), control=control)
        for cells in ((around, across), half)
    )
    names = [part.name for part in fields(GridError)]
    return GridError(*(np.abs(getattr(fine, name) - getattr(coarse, name)) for name in names))
