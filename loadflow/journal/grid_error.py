"""How far the cells leave a result from that of ever finer ones, from coarser grids."""

from __future__ import annotations

from dataclasses import replace
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.journal.bearing import JournalBearing
from loadflow.journal.film_model import Film, Keywords, film_and_control
from loadflow.journal.grid_bounds import BOUNDED, GridError
from loadflow.journal.lubricant import Lubricant
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

_SAFETY = 3.0  # error allowed for over a difference from half as many cells [Roache 1994]
_COUPLED = 0.1  # of the largest of all relative errors, that each quantity is given at least


def grid_error(
    bearing: JournalBearing,
    force: ArrayLike,
    speed: ArrayLike,
    film: Film | Lubricant | None = None,
    **keywords: Unpack[Keywords],
) -> GridError:
    """Estimate what the cells of `grid` at most do to a static equilibrium.

    The differences from half as many cells around, and from half as many across, added up as they
    may have opposite signs, and three times that: the factor of [Roache 1994] for two grids, which
    holds errors of the first order, too. One quantity may agree by chance, so that each is given a
    tenth of the largest relative difference of all. It costs about as much as the solution itself,
    and asks other grids, where ``Equilibrium.grid_error`` judges from the one solution alone.

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
    >>> bool(error.eccentricity_ratio < 5e-3)
    True
    """
    film, control = film_and_control(film, (), None, keywords)
    around, across = film.cells
    require(across >= 4, "grid[1]", across, "at least 4 cells across, of which half can be taken")
    film = replace(film, grid=(around, across))
    solved = bearing.equilibrium(force, speed, film, control=control)
    lenient = replace(control, strict=False)
    coarser = [
        bearing.equilibrium(force, speed, replace(film, grid=cells), control=lenient)
        for cells in ((around // 2, across), (around, 2 * (across // 4)))
    ]
    found = np.logical_and.reduce([solved.converged, *(state.converged for state in coarser)])
    names = BOUNDED[1:]
    scales = {name: _scale(name, getattr(solved, name)) for name in names}
    shares = {
        name: sum(_apart(name, getattr(solved, name), getattr(state, name)) for state in coarser)
        / scales[name]
        for name in names
    }
    least = _COUPLED * np.max(list(shares.values()), axis=0)
    return GridError(
        **{
            name: np.where(found, _SAFETY * scales[name] * np.maximum(share, least), np.inf)
            for name, share in shares.items()
        }
    )


def _apart(name: str, one: Array, other: Array) -> Array:
    """Difference of two values; of angles, rad, the lesser way round."""
    way = np.abs(one - other)
    return np.minimum(way, 2.0 * np.pi - way) if name == "attitude_angle" else way


def _scale(name: str, value: Array) -> Array:
    """What the relative error of a quantity is relative to; of an angle a radian."""
    sizes = np.ones_like(value) if name == "attitude_angle" else np.abs(value)
    return np.maximum(sizes, np.finfo(float).tiny)
