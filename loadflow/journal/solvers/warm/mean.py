"""Temperatures over the area of a film in motion: those of the mean heat of a series of loads.

A bearing warms over minutes and hours while its load changes in seconds, so that in motion the
temperatures stay: those at which the heat that films at rest under loads spread over the series
make on average is the heat that they carry off on average.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Sized
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError, ValidityWarning
from loadflow.journal.film.heat.temperatures import Temperatures, Warmth
from loadflow.journal.heat import HOTTEST
from loadflow.journal.solvers.newton import Solution, no_film
from loadflow.journal.solvers.pads.statics import columns_without_film
from loadflow.journal.solvers.search import Search
from loadflow.journal.solvers.statics import Statics
from loadflow.journal.solvers.warm.position import (
    FilmOf,
    HeatOf,
    WarmFilm,
    coupled,
    energy_of,
    no_warmth,
)
from loadflow.numerics.convergence import Limits
from loadflow.quantities import FILM

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

SAMPLES = 16
"""Loads of a series, spread evenly over it, whose mean heat gives the temperatures."""

LEFT_OUT = 0.1
"""Share of these without a film at rest above which a warning says so."""


@dataclass(frozen=True)
class MeanHeat:
    """Temperatures that a film keeps in motion; what is left of them, K, and fields tried."""

    equation: Temperatures
    warmth: Warmth
    residual: float
    iterations: int

    @property
    def said(self) -> dict[str, float]:
        """What an orbit says of them; `mean_growth` where shaft and shell grow, m."""
        warmth, equation = self.warmth, self.equation
        numbers: dict[str, float] = {
            "maximum_temperature": max(warmth.hottest, float(warmth.cells.max())),
            "shaft_temperature": warmth.shaft,
            "heat_imbalance": warmth.imbalance,
            "heat_residual": self.residual,
            "heat_iterations": self.iterations,
        }
        if equation.heat.growth is not None:
            numbers["mean_growth"] = equation.mean_growth
        return numbers


@dataclass
class SeriesLoads:
    """Numbers of the loads of a series whose mean heat is taken, and which of them have no film.

    A load that none carries at rest, as the squeeze of the motion may, takes many times as long as
    one with a film. So it is `left` out as the temperatures go on, and asked again where they end.
    """

    every: list[int]
    left: set[int] = field(default_factory=set)
    why: str = ""
    """Why the last one has no film, where none has."""

    @classmethod
    def of(cls, count: int) -> SeriesLoads:
        """Those of a series of `count` loads."""
        return cls(np.unique(np.linspace(0, count - 1, SAMPLES).round().astype(int)).tolist())

    @property
    def asked(self) -> list[int]:
        """Those that are asked for a film."""
        return [number for number in self.every if number not in self.left]

    def leave(self, lost: Iterable[int]) -> None:
        """Leave out those that have no film where others have; without any they are asked again."""
        lost = set(lost)
        if len(lost) < len(self.asked):
            self.left |= lost


def in_balance(
    equation: Temperatures, film_of: FilmOf, heat_of: HeatOf, found: Sized, loads: SeriesLoads
) -> MeanHeat:
    """Bring a film to the temperatures of its mean heat.

    Parameters
    ----------
    equation : Temperatures
        Over the area of the film; keeps viscosity and growth.
    film_of, heat_of : callable
        As of `coupled`, over the whole series.
    found : sized
        Films at rest that `film_of` found last.
    loads : SeriesLoads
        Those that it asks for.

    Raises
    ------
    loadflow.errors.SolverError
        No temperatures, or none of the loads has a film at rest.

    Warns
    -----
    loadflow.errors.ValidityWarning
        More than `LEFT_OUT` of the loads have no film at rest.
    """
    warm = coupled(equation, film_of, None, heat_of)
    fields, before, count = warm.iterations, 0, len(found)
    while warm.converged and warm.warmth is not None and loads.left and count > before:
        before = count
        loads.left.clear()
        again = coupled(equation, film_of, (warm.solution, warm.warmth), heat_of)
        fields += again.iterations
        if not again.converged:  # a load that is found and lost in turn: without it there is one
            break
        warm, count = again, len(found)
    if not warm.converged or warm.warmth is None:
        raise SolverError(f"orbit cannot start: {_no_mean(warm, count, loads)}")
    asked = len(loads.every)
    if count < (1.0 - LEFT_OUT) * asked:
        warnings.warn(
            f"temperatures of the film: at rest {asked - count} of {asked} loads of "
            "the series have none; they are those of the others",
            ValidityWarning,
            stacklevel=6,
        )
    equation.thicken(equation.state(warm.warmth))
    return MeanHeat(equation, warm.warmth, warm.residual, fields)


def _no_mean(warm: WarmFilm, found: int, loads: SeriesLoads) -> str:
    """Why a series has no temperatures, how warm it gets, and what would help."""
    if warm.warmth is None and not warm.why:
        return f"no load of the series has a film at rest{loads.why}"
    why = no_warmth(warm) or "at the next temperatures no load of the series has a film at rest"
    reached, hot = "", True
    if warm.warmth is not None:
        hottest = max(warm.warmth.hottest, float(warm.warmth.cells.max()))
        reached, hot = f", {hottest:.4g} K at the last", hottest > HOTTEST or warm.lost
    helps = "heat.shell_transfer, more clearance, more fresh oil" if hot else "other cells (grid)"
    return (
        f"{why}; mean heat of {found} of {len(loads.every)} loads of the series, "
        f"{warm.iterations} fields of temperature{reached}: {helps} may help"
    )


def with_temperatures(path: xr.Dataset, heat: MeanHeat, clearance: float) -> xr.Dataset:
    """The path with the temperature of its film."""
    grown = 1.0 + heat.equation.mean_growth / clearance
    ratio = path["eccentricity_ratio"]
    warm = np.full(path.sizes["time"], heat.warmth.mean)
    return path.assign(
        temperature=("time", warm, FILM["temperature"].attributes),
        eccentricity_ratio=(ratio / grown).assign_attrs(ratio.attrs),
    ).assign_attrs(heat.said)


def mean_heat(statics: Statics, loads: Array, speeds: Array, control: Limits) -> MeanHeat:
    """Bring the film of `statics` to the temperatures of a series of loads (n, 2).

    Parameters
    ----------
    statics : Statics
        With an energy equation over the area of its film; keeps viscosity and growth.
    loads, speeds : array (n, 2), (n,)
        N, rad/s.
    control : Limits
        How hard to solve each film.

    Raises
    ------
    loadflow.errors.SolverError
        No temperatures, or none of the loads has a film at rest.

    Warns
    -----
    loadflow.errors.ValidityWarning
        More than `LEFT_OUT` of the loads have no film at rest.
    """
    equation = energy_of(statics)
    some = SeriesLoads.of(len(loads))
    each = replace(control, strict=False)
    found: dict[int, Solution] = {}
    search = Search(together=True)  # one effort for all loads at all temperatures

    def film_of(before: Solution | None) -> Solution:
        spent, worst = 0, no_film(statics.film)
        asked = some.asked
        beside: Solution | None = None  # of the load before: what is found at once costs little
        for index in asked:
            last = beside if before is None else found.get(index, beside)
            sought, effort = not search.over, search.effort(statics.film, each.max_iterations)
            given = index, loads[index], float(speeds[index]), last, each
            solution = statics.solve(*given, True, effort)
            spent += solution.iterations
            found.pop(index, None)
            if solution.converged:
                found[index] = worst = beside = solution
                search.give_back()
            elif sought:
                some.why = f"; {statics.message(solution, loads[index])}"
        some.leave(set(asked) - set(found))
        return replace(worst, iterations=spent)

    def heat_of(last: Solution, cells: Array) -> Warmth:
        films = [
            (one.u, one.position, float(speeds[index]), columns_without_film(equation.gap, one))
            for index, one in found.items()
        ]
        return equation.solve_mean(films, cells)

    return in_balance(equation, film_of, heat_of, found, some)
