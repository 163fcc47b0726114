"""Where the film becomes as thin as the surfaces are rough: what a smooth film carries at most."""

from __future__ import annotations

from dataclasses import replace
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.bearing import JournalBearing
from loadflow.journal.film_model import Film, Keywords, film_and_control
from loadflow.journal.grid_bounds import unresolved_counted
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.shapes import Cylindrical
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

_DIRECTIONS = 8  # in which a bore that differs around is asked for its load
_STEPS = 6  # of the search for the position with the wanted film
_SPEEDS = 12  # at which a long series is asked; between them the load is interpolated


def load_capacity(
    bearing: JournalBearing,
    least_film: float,
    speed: ArrayLike,
    film: Film | Lubricant | None = None,
    **keywords: Unpack[Keywords],
) -> Array:
    """Largest load at rest under which the film stays as thick as `least_film`.

    Of a bore that differs around, it is that of the direction which carries most.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.
    least_film : float
        Smallest film, m, between 0 and the clearance.
    speed : array_like, shape (n,)
        rad/s. More than twelve speeds are interpolated between twelve.
    film, **keywords
        As for `JournalBearing.equilibrium`; always on the rung "grid", with heat as the oil enters.

    Returns
    -------
    ndarray, shape (n,)
        N; 0 at standstill, infinite where the film at that position was not found.

    Raises
    ------
    loadflow.errors.InputError
        `least_film` out of its range.

    Examples
    --------
    >>> from loadflow.journal import Guembel, JournalBearing, Lubricant
    >>> bearing = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
    >>> thick, thin = (
    ...     load_capacity(bearing, h, [0.1], lubricant=Lubricant(0.05), cavitation=Guembel())[0]
    ...     for h in (40e-6, 4e-6))
    >>> bool(thin > 5 * thick)
    True
    """
    film, _ = film_and_control(film, (), None, keywords)
    film = replace(film.isothermal(), rung="grid")
    allowed = f"m, between 0 and the clearance {bearing.clearance:g}"
    require(0 < least_film < bearing.clearance, "least_film", least_film, allowed)
    speeds = np.abs(np.asarray(speed, dtype=float))
    turning = speeds > 0
    capacity = np.zeros(speeds.shape)
    if not turning.any():
        return capacity
    asked = np.unique(speeds[turning])
    if asked.size > _SPEEDS:
        asked = np.geomspace(asked[0], asked[-1], _SPEEDS)
    carried = np.array([_carried(bearing, least_film, float(one), film) for one in asked])
    with np.errstate(invalid="ignore"):
        between = np.interp(np.log(speeds[turning]), np.log(asked), np.log(carried))
    capacity[turning] = np.exp(between)
    return capacity


def _carried(bearing: JournalBearing, least_film: float, speed: float, film: Film) -> float:
    """Largest load over the directions at one speed."""
    alike = bearing.shape == Cylindrical() and film.supply is None
    angles = 2 * np.pi * np.arange(1 if alike else _DIRECTIONS) / _DIRECTIONS
    return max(_in_direction(bearing, least_film, speed, angle, film) for angle in angles)


def _in_direction(
    bearing: JournalBearing, least_film: float, speed: float, angle: float, film: Film
) -> float:
    """Load at the eccentricity in one direction whose smallest film is the wanted one."""
    way, away = np.array([np.cos(angle), np.sin(angle)]), bearing.clearance - least_film
    for _ in range(_STEPS):
        try:
            with unresolved_counted():
                found = bearing.pressure(away * way, speed, film, strict=False)
        except (InputError, SolverError):
            return np.inf
        if not bool(found.converged):
            return np.inf
        change = float(found.minimum_film) - least_film
        if abs(change) < 0.05 * least_film:
            return float(np.hypot(*found.force))
        away += change
    return np.inf
