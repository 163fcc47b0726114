"""The best crown of a bore for a spectrum of loads and tilts: height and length of its ends.

A crown takes the edge off a shaft that tilts or bends, and takes film from one that does not: under
a spectrum of both there is a best one. The worst load governs, and another one as the crown
changes, so that the aim has kinks: a coarse sweep, then the simplex of [Nelder and Mead 1965]
(`scipy.optimize.minimize`) within bounds, on the loads that govern; those that govern the crown
that is found, but were left out, join until none does.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import product
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import SolverError
from loadflow.journal.bearing import JournalBearing
from loadflow.journal.film_model import Film
from loadflow.journal.relief import Crown
from loadflow.journal.results import Equilibrium
from loadflow.numerics.fields import require

Array = NDArray[np.float64]
Aim = Literal["minimum_film", "maximum_pressure"]

AIMS: dict[str, tuple[float, float]] = {
    "minimum_film": (-1.0, 0.0),
    "maximum_pressure": (1.0, np.inf),
}
"""What a crown may aim at: sign with which it is to be small, and the value of a load without a
film."""

_SHORTEST = 0.05  # length of a crown over half of the width, at least
_HEIGHTS, _LENGTHS = (1 / 16, 1 / 8, 1 / 4, 1 / 2, 1.0), (0.25, 0.5, 1.0)  # of the sweep
_GOVERN = 3  # loads that are looked at first, of those without a crown and with half of the largest
_ROUNDS = 6  # in which loads that were left out may join
_STEPS = 200  # of a simplex
_WORSE = 0.01  # share by which a load that was left out must be worse to join


@dataclass(frozen=True)
class BestCrown:
    """The best crown of a bearing under a spectrum of loads.

    Attributes
    ----------
    crown : Crown or None
        None where the bore is best without.
    bearing : JournalBearing
        With that crown in place of any other.
    aim : {"minimum_film", "maximum_pressure"}
        What was sought.
    value, without : float
        Smallest film, m, or largest pressure, Pa, of all loads with it and without; 0 and infinite
        where some load has no film.
    states, states_without : Equilibrium or None
        All loads with it and without; None where without a crown there is no place for the shaft.
    governs : int
        Number of the load that governs with it.
    converged : bool
        Whether the search ended within its tolerance, and no load that was left out governs.
    residual : float
        Spread of the value over the last simplex, over the value.
    iterations : int
        Crowns that were tried.

    Examples
    --------
    As `best_crown` answers it:

    >>> from loadflow.journal import BestCrown, Crown, JournalBearing
    >>> bearing = JournalBearing(1.0, 1.0, 1e-3, relief=(Crown(height=3e-5),))
    >>> crown, found = bearing.relief[0], (None, None, 0, True, 1e-4, 39)
    >>> best = BestCrown(crown, bearing, "minimum_film", 4.5e-5, 2.5e-5, *found)
    >>> round(best.value / best.without, 1)
    1.8
    """

    crown: Crown | None
    bearing: JournalBearing
    aim: Aim
    value: float
    without: float
    states: Equilibrium
    states_without: Equilibrium | None
    governs: int
    converged: bool
    residual: float
    iterations: int


def best_crown(
    bearing: JournalBearing,
    force: ArrayLike,
    speed: ArrayLike,
    film: Film,
    *,
    moment: ArrayLike | None = None,
    tilt: ArrayLike | None = None,
    bend: ArrayLike | None = None,
    aim: Aim = "minimum_film",
    largest_height: float | None = None,
    exponent: float = 2.0,
    tolerance: float = 1e-3,
    strict: bool = True,
) -> BestCrown:
    """Find the crown with the thickest smallest film, or the least largest pressure.

    Parameters
    ----------
    bearing : JournalBearing
        Any bore that does not tilt; crowns that it has are replaced, other relief stays.
    force : array_like (n, 2)
        Loads, N.
    speed : array_like (n,) or float
        rad/s.
    film : Film
        Its model knows crowns: the rungs "grid" and "reduced".
    moment, tilt, bend : array_like (n, 2), optional
        How the shaft lies under each load, as in `JournalBearing.equilibrium`.
    aim : {"minimum_film", "maximum_pressure"}
        What is to be largest, or least, of the worst load.
    largest_height : float, optional
        m; default the radial clearance.
    exponent : float
        Of the crown, ≥ 1.
    tolerance : float
        Spread of the aim over the last simplex, over its value.
    strict : bool
        Raise where the search does not end.

    Returns
    -------
    BestCrown
        Crown, bearing with it, and what it reaches.

    Raises
    ------
    loadflow.errors.InputError
        An unknown aim, a value out of range, or a film that knows no relief.
    loadflow.errors.SolverError
        No crown leaves each load a film; with `strict`, a search that does not end.

    Examples
    --------
    >>> from loadflow.journal import Film, GasMixture, JournalBearing, Lubricant, best_crown
    >>> bearing = JournalBearing(diameter=0.2, width=0.16, relative_clearance=1e-3)
    >>> film = Film(Lubricant(0.03), GasMixture(5e4), edge_pressure=1.5e5, grid=(24, 8))
    >>> loads, tilts = [(6e3, 0.0), (2e4, 0.0)], [(0.0, 6e-4), (0.0, 4e-4)]
    >>> best = best_crown(bearing, loads, 100.0, film, tilt=tilts, tolerance=0.05)
    >>> bool(best.value > 1.3 * best.without)
    True
    """
    require(aim in AIMS, "aim", aim, " or ".join(AIMS))
    require(0 < tolerance < 1, "tolerance", tolerance, "between 0 and 1")
    limit = bearing.clearance if largest_height is None else largest_height
    require(limit > 0, "largest_height", limit, "must be > 0 m")
    loads, speeds = np.broadcast_arrays(np.atleast_2d(force), np.reshape(speed, (-1, 1)))
    spectrum = _Spectrum(
        replace(bearing, relief=tuple(r for r in bearing.relief if not isinstance(r, Crown))),
        loads.astype(float), speeds[:, 0].astype(float), film,
        {name: np.broadcast_to(rows, loads.shape) for name, rows in
         (("moment", moment), ("tilt", tilt), ("bend", bend)) if rows is not None},
        aim,
    )  # fmt: skip

    def crown_of(point: Array) -> Crown | None:
        height, length = (float(x) for x in point)
        if not height > 0.0:
            return None
        return Crown(height * limit, 0.5 * length * bearing.width, exponent)

    every = np.arange(len(loads))
    middle = spectrum.costs(crown_of(np.array([0.25, 1.0])), every)
    without = spectrum.costs(None, every)
    some = np.union1d(np.argsort(-without)[:_GOVERN], np.argsort(-middle)[:_GOVERN])
    tried, point, residual, ended = 2, np.zeros(2), np.inf, False
    for _ in range(_ROUNDS):

        def cost(point: Array, some: NDArray[np.int64] = some) -> float:
            return float(spectrum.costs(crown_of(point), some).max())

        point, residual, count = _searched(cost, tolerance)
        tried += count
        costs = spectrum.costs(crown_of(point), every)
        worst = float(costs[some].max())
        more = np.flatnonzero(costs > worst + _WORSE * abs(worst))
        ended = more.size == 0
        if ended:
            break
        some = np.union1d(some, more[np.argsort(-costs[more])[:_GOVERN]])
    crown = crown_of(point)
    if without.max() <= costs.max():  # the bore is best as it is
        crown, costs = None, without
    sign, lost = AIMS[aim]
    if costs.max() == sign * lost:
        raise SolverError(f"no crown up to {limit:.4g} m leaves load {int(costs.argmax())} a film")
    converged = bool(ended and residual <= tolerance)
    if strict and not converged:
        raise SolverError(
            f"the crown is not found: {aim} still spreads by {residual:.2g} of its value after "
            f"{tried} crowns"
        )
    states = spectrum.states(crown, every)
    plain = states if crown is None else spectrum.states_if(None, every)
    relief = spectrum.bearing.relief if crown is None else (*spectrum.bearing.relief, crown)
    return BestCrown(
        crown, replace(bearing, relief=relief), aim, float(sign * costs.max()),
        float(sign * without.max()), states, plain, int(costs.argmax()), converged, residual, tried,
    )  # fmt: skip


@dataclass(frozen=True)
class _Spectrum:
    """Loads (n, 2) of a bearing without a crown, and what is asked of them."""

    bearing: JournalBearing
    force: Array
    speed: Array
    film: Film
    line: dict[str, Any]
    aim: Aim

    def states(self, crown: Crown | None, some: NDArray[np.int64]) -> Equilibrium:
        """Films of some of the loads."""
        own = self.bearing.relief if crown is None else (*self.bearing.relief, crown)
        line = {name: rows[some] for name, rows in self.line.items()}
        bearing = replace(self.bearing, relief=own)
        return bearing.equilibrium(
            self.force[some], self.speed[some], self.film, strict=False, **line
        )

    def states_if(self, crown: Crown | None, some: NDArray[np.int64]) -> Equilibrium | None:
        """The same; None where one of them leaves no place for the shaft."""
        try:
            return self.states(crown, some)
        except SolverError:
            return None

    def costs(self, crown: Crown | None, some: NDArray[np.int64]) -> Array:
        """What is to be small of each load."""
        sign, lost = AIMS[self.aim]
        states = self.states_if(crown, some)
        if states is None:
            alone = [self.costs(crown, one) for one in some[:, None]] if some.size > 1 else []
            return np.concatenate(alone) if alone else np.array([sign * lost])
        found = np.asarray(getattr(states, self.aim))
        valid = np.asarray(states.converged) & np.isfinite(found)
        return sign * np.where(valid, found, lost)


def _searched(cost: Callable[[Array], float], tolerance: float) -> tuple[Array, float, int]:
    """Best height and length, over the largest ones; spread of the cost; crowns tried."""
    from scipy.optimize import minimize

    points = [np.zeros(2), *(np.array(pair) for pair in product(_HEIGHTS, _LENGTHS))]
    points[0][1] = 1.0
    costs = [cost(point) for point in points]
    best = points[int(np.argmin(costs))]
    scale = float(np.min(costs))
    if not np.isfinite(scale) or scale == 0.0:
        return best, 0.0, len(points)  # no film with any of them
    away = np.array([0.4 * max(best[0], _HEIGHTS[0]), -0.3 * best[1]])
    away = np.where(best + away > 1.0, -away, away)
    corners = [best, best + away * [1.0, 0.0], best + away * [0.0, 1.0]]
    found = minimize(
        lambda point: min(cost(point) / abs(scale), 1e6),
        best,
        method="Nelder-Mead",
        bounds=[(0.0, 1.0), (_SHORTEST, 1.0)],
        options={
            "initial_simplex": np.clip(corners, [0.0, _SHORTEST], 1.0),
            "xatol": np.inf,
            "fatol": 0.5 * tolerance,
            "maxfev": _STEPS,
        },
    )
    values = found.final_simplex[1]
    spread = float(np.ptp(values) / max(abs(values[0]), 1e-300))
    return np.asarray(found.x), spread, len(points) + int(found.nfev)
