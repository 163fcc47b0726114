"""Film and temperature together: the energy equation over the area of a film, at rest.

Two solutions alternate: the film (and the shaft under its load) with the viscosity of every cell
given, by Newton; and the temperatures with flows and gap given, by Newton, the viscosity following
them. What one leaves of the other is a fixed point of the temperatures, accelerated by Anderson's
method. A film so hot that it does not converge is tried by shorter steps, and ends with a reason.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.warm import WarmGap
from loadflow.journal.film.heat.equation import EnergyEquation
from loadflow.journal.film.heat.temperatures import Warmth
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.heat import HOTTEST, FilmHeat
from loadflow.journal.solvers.newton import Solution, no_film
from loadflow.journal.solvers.statics import Statics
from loadflow.numerics.anderson import Anderson

Array = NDArray[np.float64]
FilmOf = Callable[["Solution | None"], Solution]
"""The film at given viscosities, from the last solution."""
HeatOf = Callable[[Solution, Array], Warmth]
"""Temperatures in balance with the film last solved, from a first guess (nx, nz)."""

TOLERANCE, TRIES = 1e-7, 150
"""Largest change of a temperature that is left, K, and the fields of temperature tried."""
_DRIFT = 2e-3  # share of the narrowest gap, by which the shaft moves for a settled stiffness
_DEPTH = 6  # earlier fields that count
_ACCELERATED, _SHORT = 8, 0.3  # fields after which no more than this share of a change is made
_CUT, _GROWN, _SHORTEST = 0.5, 1.1, 0.01  # of that share: less after a turn, more else, the least
_REGAINED = 1.3  # growth of the share of every change where all are small
_NEAR = 0.5  # change, K, below which the method is trusted again
_WORSE = 1.5  # of the smallest change so far, that from which the next field goes back
_TOO_HOT = 5  # fields in a row that warm beyond the largest temperature: one that settles has one
_HALVINGS = 4  # steps of the temperature that are halved before the film is given up
_WARMS = 10.0  # K, that a film must still warm by where it is lost, to have no temperature at all


@dataclass(frozen=True)
class WarmFilm:
    """A film with its temperatures; the change (K) that is left of them; how many were tried.

    `why` there are none; `seized`: the shaft has grown into its shell.
    """

    solution: Solution
    warmth: Warmth | None
    residual: float
    iterations: int
    converged: bool
    why: str = ""
    seized: bool = False

    @property
    def film(self) -> Solution:
        """The film, converged only with its temperatures."""
        return replace(self.solution, converged=self.converged)

    @property
    def lost(self) -> bool:
        """Whether there is no film at the temperatures that were tried last."""
        return not (self.converged or self.solution.converged)


def settled_stiffness(
    bearing: JournalGeometry,
    film_at: Callable[[Array], WarmFilm],
    place: Array,
    least: float,
    name: str,
    strict: bool,
) -> Array:
    """Stiffness, N/m, of a shaft that moves so slowly that the temperatures follow.

    By differences of the films with temperatures `film_at` places (m,), clearances, beside its
    `place`, where the film is `least` thick. All of it is NaN where one of them has none.

    Raises
    ------
    loadflow.errors.SolverError
        If `strict`, a film beside that `name` has no temperatures.
    """
    size, step = place.size, _DRIFT * least
    loads = np.empty((2, size, size))
    for side, way in np.ndindex(2, size):
        found = film_at(place + step * (1 - 2 * side) * np.eye(size)[way])
        if found.converged:
            loads[side, way] = found.solution.linear.load[:size]
        elif strict:
            why = no_warmth(found) or "no film"
            raise SolverError(f"{name}: no temperatures beside its place: {why}")
        else:
            return np.full((size, size), np.nan)
    lengths = np.where(np.arange(size) < 2, 1.0, bearing.radius)  # those of tilts are arms
    slopes = (loads[0] - loads[1]).T / (2.0 * step)
    return np.asarray(slopes * np.outer(lengths, lengths) / bearing.clearance)


def no_warmth(found: WarmFilm) -> str:
    """Why there are no temperatures; where there is no film, the film says why."""
    if found.lost and not found.seized and _WARMS < found.residual < np.inf:
        return (
            f"no heat balance: at temperatures from which it still warms by {found.residual:.3g} K "
            "the film carries the load no more"
        )
    return found.why


def energy_of(statics: Statics) -> EnergyEquation:
    """Energy equation of a film with heat over its area."""
    gap, heat = cast("WarmGap", statics.gap), cast("FilmHeat", statics.options.heat)
    return EnergyEquation(statics.film, gap, heat)


class Equation(Protocol):
    """An energy equation that is solved beside its film, as `EnergyEquation` has it."""

    film: DiscreteFilm

    def state(self, warmth: Warmth | None) -> Array:
        """Temperatures by which the film is as it is; without `warmth` those of cold oil."""

    def cells_of(self, state: Array) -> Array:
        """Those of the cells (nx, nz)."""

    def thicken(self, state: Array) -> None:
        """Give the film the viscosity that it has at a `state`."""


def coupled(
    equation: Equation,
    film_of: FilmOf,
    last: tuple[Solution, Warmth] | None,
    heat_of: HeatOf,
) -> WarmFilm:
    """Film and temperatures that agree, from those of the `last` load or from cold oil.

    `heat_of` has the temperatures of the film last solved.
    """
    film = equation.film
    cold = equation.state(None)
    before, now = (None, cold) if last is None else (last[0], equation.state(last[1]))
    good, warmth, residual = cold, None, np.inf
    method, halved, spent = Anderson(_DEPTH), 0, 0
    best, share, nearest, too_hot = np.inf, 1.0, (now, now), 0
    way, ways = 0.0 * now, np.ones(now.size)  # last change of each temperature, share that is made
    for iteration in range(1, TRIES + 1):
        equation.thicken(now)
        try:
            solution, seized = film_of(before), ""
        except SolverError as error:  # the shaft has grown into its shell
            solution, seized = no_film(film), str(error)
        spent += solution.iterations
        solution = replace(solution, iterations=spent)
        if not solution.converged:
            halved += 1
            if halved > _HALVINGS or (now is good and before is None):
                break
            method.forget()
            before, now = None, 0.5 * (now + good)
            continue
        try:
            cells = equation.cells_of(now)
            warmth = heat_of(solution, cells)
        except SolverError as error:
            return WarmFilm(solution, None, residual, iteration, False, str(error))
        found = equation.state(warmth)
        before, good = solution, now
        residual = float(np.abs(found - now).max())
        too_hot = too_hot + 1 if float(found.max()) > HOTTEST else 0
        if too_hot >= _TOO_HOT:
            break
        if residual < best:
            best, nearest, share = residual, (now, found), min(1.0, 2.0 * share)
        if residual <= TOLERANCE:
            hottest = max(warmth.hottest, float(warmth.cells.max()))
            hot = f"the film gets hotter than {HOTTEST} K: {hottest:.4g} K"
            fine = hottest < HOTTEST
            return WarmFilm(solution, warmth, residual, iteration, fine, "" if fine else hot)
        if iteration >= _ACCELERATED and residual > _NEAR:
            method.forget()
            ways = _shorter(ways, found - now, way)
            way = found - now
            now = now + ways * way
            continue
        if (
            iteration < _ACCELERATED and residual > _WORSE * best
        ):  # from the best field again, less far
            method.forget()
            share *= 0.5
            now = nearest[0] + share * (nearest[1] - nearest[0])
            continue
        share = share if iteration < _ACCELERATED else _SHORT
        now = method.next(now, now + np.minimum(share, ways) * (found - now))
        ways = np.minimum(_REGAINED * ways, 1.0)
        low, high = found.min() - 5.0, found.max() + 5.0
        now = np.clip(now, low, min(high, HOTTEST + 100.0))
    why = seized
    if warmth is not None and not seized:
        why = f"temperatures: {residual:.3g} K left after {iteration} fields"
    if too_hot and not seized:
        why = f"the film gets hotter than {HOTTEST} K: it warms to {found.max():.4g} K"
    return WarmFilm(solution, warmth, residual, iteration, False, why, bool(seized))


def _shorter(shares: Array, change: Array, before: Array) -> Array:
    """Shares of the `change` to make of each temperature: less where it turned back.

    Where the oil nearly stands, a cell is as warm as one or the other of its neighbours, and which
    of them a small change of the flow decides.
    """
    turned = change * before < 0.0
    return np.clip(np.where(turned, _CUT * shares, _GROWN * shares), _SHORTEST, _SHORT)
