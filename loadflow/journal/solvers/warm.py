"""Film and temperature together: the energy equation over the area of a film, at rest.

Two solutions alternate: the film (and the shaft under its load) with the viscosity of every cell
given, by Newton; and the temperatures with flows and gap given, by Newton, the viscosity following
them. What one leaves of the other is a fixed point of the temperatures, accelerated by Anderson's
method. A film so hot that it does not converge is tried by shorter steps, and ends with a reason.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Protocol, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.energy_equation import EnergyEquation
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap_warm import WarmGap
from loadflow.journal.film.temperatures import Temperatures, Warmth
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.heat import HOTTEST, FilmHeat
from loadflow.journal.line import Line
from loadflow.journal.rows import field_row, static_row
from loadflow.journal.solvers.newton import Solution, no_film, solve_film
from loadflow.journal.solvers.statics import Statics
from loadflow.numerics.anderson import Anderson
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require

Array = NDArray[np.float64]
FilmOf = Callable[["Solution | None"], Solution]
"""The film at given viscosities, from the last solution."""
HeatOf = Callable[[Solution, Array], Warmth]
"""Temperatures in balance with the film last solved, from a first guess (nx, nz)."""

TOLERANCE, TRIES = 1e-7, 150
"""Largest change of a temperature that is left, K, and the fields of temperature tried."""
DRIFT = 2e-3
"""Share of the narrowest gap, by which the shaft moves for a settled stiffness."""
_DEPTH = 6  # earlier fields that count
_ACCELERATED, _SHORT = 8, 0.3  # fields after which no more than this share of a change is made
_CUT, _GROWN, _SHORTEST = 0.5, 1.1, 0.01  # of that share: less after a turn, more else, the least
_REGAINED = 1.3  # growth of the share of every change where all are small
_NEAR = 0.5  # change, K, below which the method is trusted again
_WORSE = 1.5  # of the smallest change so far, that from which the next field goes back
_TOO_HOT = 5  # fields in a row that warm beyond the largest temperature: one that settles has one
_HALVINGS = 4  # steps of the temperature that are halved before the film is given up
_WARMS = 10.0  # K, that a film must still warm by where it is lost, to have no temperature at all
_MOST_AROUND = 240  # cells, of a film that is not found on fewer


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
    def lost(self) -> bool:
        """Whether there is no film at the temperatures that were tried last."""
        return not (self.converged or self.solution.converged)


def warm_rows(
    bearing: JournalGeometry,
    options: Film,
    loads: Array,
    speeds: Array,
    line: Line,
    control: Limits,
) -> list[dict[str, Any]]:
    """Rows of `FilmHeatEquilibrium`.

    Raises
    ------
    loadflow.errors.SolverError
        If ``control.strict``, the first load without film or temperatures.
    """
    statics, equation = _prepared(bearing, options, line, float(np.abs(speeds).max()))
    each = replace(control, strict=False)
    around, across = options.cells
    finer = replace(options, grid=(2 * around, across)) if 2 * around <= _MOST_AROUND else None
    rows = []
    last: tuple[Solution, Warmth] | None = None
    for index, (load, omega) in enumerate(zip(loads, speeds.tolist())):

        def found_on(
            statics: Statics,
            equation: EnergyEquation,
            last: tuple[Solution, Warmth] | None,
            index: int = index,
            omega: float = omega,
        ) -> WarmFilm:
            def film_of(before: Solution | None) -> Solution:
                return statics.solve(index, loads[index], omega, before, each)

            return coupled(equation, film_of, last, equation.alone)

        found = found_on(statics, equation, last)
        if not found.converged and last is not None:
            found = found_on(statics, equation, None)
        used = statics, equation
        if found.lost and finer is not None:
            on_more = _prepared(bearing, finer, line, float(np.abs(speeds).max()))
            better = found_on(*on_more, None)
            if better.converged or not better.lost or found.warmth is None:
                found, used = better, on_more
        if not found.converged and control.strict:
            why = no_warmth(found) or used[0].message(found.solution, load)
            raise SolverError(f"load {index}: {why}")
        row = _row(bearing, *used, load, found, line.whirl)
        if found.converged and found.warmth is not None:
            warm = found.solution, found.warmth
            if equation.heat.stiffness == "settled":
                row["stiffness"] = _settled_stiffness(bearing, *used, warm, control)
            if used[0] is statics:
                last = warm
        rows.append(row if used[0] is statics else _at_angles(row, statics.film.mesh.angle))
    return rows


def _settled_stiffness(
    bearing: JournalGeometry,
    statics: Statics,
    equation: EnergyEquation,
    last: tuple[Solution, Warmth],
    control: Limits,
) -> Array:
    """Stiffness, N/m, of a shaft that moves so slowly that the temperatures follow.

    Raises
    ------
    loadflow.errors.SolverError
        If ``control.strict``, a film beside the equilibrium has no temperatures; else all are NaN.
    """
    film, size = statics.film, statics.gap.size
    step = DRIFT * film.narrowest(last[0].u, last[0].position)
    limits = control.tolerance, film.newton_steps(control.max_iterations)
    columns = np.empty((size, size))
    for way in range(size):
        ends = []
        for sign in (1.0, -1.0):
            place = last[0].position.copy()
            place[way] += sign * step

            def film_of(before: Solution | None, place: Array = place) -> Solution:
                start = film.start() if before is None else before.u
                return solve_film(film, start, place, np.zeros(size), *limits)

            found = coupled(equation, film_of, last, equation.alone)
            if not found.converged:
                if control.strict:
                    raise SolverError(f"no temperatures beside the equilibrium: {found.why}")
                return np.full((size, size), np.nan)
            ends.append(found.solution.linear.load)
        columns[:, way] = (ends[0] - ends[1]) / (2.0 * step)
    lengths = np.where(np.arange(size) < 2, 1.0, film.radius)  # those of tilts are arms
    return columns * np.outer(lengths, lengths) / bearing.clearance


def no_warmth(found: WarmFilm) -> str:
    """Why there are no temperatures; where there is no film, the film says why."""
    if found.lost and not found.seized and _WARMS < found.residual < np.inf:
        return (
            f"no heat balance: at temperatures from which it still warms by {found.residual:.3g} K "
            "the film carries the load no more"
        )
    return found.why


def _at_angles(row: dict[str, Any], angle: Array) -> dict[str, Any]:
    """The row of a film on more cells, its fields at the angles (nx,) of those asked for."""
    own = row["angle"]

    def moved(field: Array) -> Array:
        columns = [np.interp(angle, own, values, period=2.0 * np.pi) for values in field.T]
        return np.stack(columns, axis=1)

    return row | {name: moved(row[name]) for name in OVER_AREA} | {"angle": angle}


def warm_fields(
    bearing: JournalGeometry,
    options: Film,
    places: Array,
    velocities: Array,
    speeds: Array,
    line: Line,
    control: Limits,
) -> tuple[list[dict[str, Any]], Array]:
    """Rows of `FilmHeatField` and axial places of the cells, m; errors as of `warm_rows`."""
    require(not velocities.any(), "velocity", velocities.tolist(), "0 with heat over the area")
    statics, equation = _prepared(bearing, options, line, float(np.abs(speeds).max()))
    rows = []
    for index, omega in enumerate(speeds.tolist()):

        def film_of(before: Solution | None, index: int = index, omega: float = omega) -> Solution:
            return statics.hold(index, places[index], velocities[index], omega, control)

        found = coupled(equation, film_of, None, equation.alone)
        if not found.converged and control.strict:
            why = found.why or statics.message(found.solution)
            raise SolverError(f"film {index}: {why}")
        row = field_row(statics.film, statics.gap, _flagged(found))
        row["eccentricity_ratio"] /= 1.0 + equation.mean_growth / bearing.clearance
        rows.append(row | heat_columns(equation, found))
    return rows, statics.film.mesh.z * bearing.radius


def _prepared(
    bearing: JournalGeometry, options: Film, line: Line, rate: float
) -> tuple[Statics, EnergyEquation]:
    """Film and energy equation."""
    statics = Statics(bearing, options, line, rate)
    return statics, energy_of(statics)


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


def _flagged(found: WarmFilm) -> Solution:
    """The film, converged only with its temperatures."""
    return replace(found.solution, converged=found.converged)


def _row(
    bearing: JournalGeometry,
    statics: Statics,
    equation: EnergyEquation,
    load: Array,
    found: WarmFilm,
    whirl: float,
) -> dict[str, Any]:
    """One row of `FilmHeatEquilibrium`."""
    heat, film = equation.heat, equation.film
    mean = heat.inlet_temperature if found.warmth is None else found.warmth.mean
    row = static_row(bearing, film, statics.gap, load, heat.lubricant(mean), _flagged(found), whirl)
    if heat.growth is not None:
        row |= in_grown_clearances(row, bearing, equation, found)
    angle, z = film.mesh.angle, film.mesh.z * bearing.radius
    both = z if z[0] < 0 else np.concatenate([-z[::-1], z])
    return row | heat_columns(equation, found) | {"angle": angle, "z": both}


def in_grown_clearances(
    row: dict[str, Any], bearing: JournalGeometry, equation: Temperatures, found: WarmFilm
) -> dict[str, Any]:
    """What a `row` says in clearances, in those that shaft and shell have as warm as they are."""
    if not found.converged:
        return {"clearance": np.nan}
    share = 1.0 + equation.mean_growth / bearing.clearance
    reynolds = row["reynolds_number"] * share
    critical = row["critical_reynolds_number"] / np.sqrt(share)
    return {
        "clearance": share * bearing.clearance,
        "eccentricity_ratio": row["eccentricity_ratio"] / share,
        "sommerfeld_number": row["sommerfeld_number"] * share**2,
        "reynolds_number": reynolds,
        "critical_reynolds_number": critical,
        "laminar": reynolds < critical,
    }


def heat_columns(equation: Temperatures, found: WarmFilm) -> dict[str, Any]:
    """What a result says of its temperatures; NaN where there are none."""
    oil = equation.heat.liquid
    warmth = found.warmth if found.converged else None
    said: dict[str, Any]
    if warmth is None:
        field, grooves = np.full(equation.shape, np.nan), np.full((equation.grooves, 2), np.nan)
        shell = growth = field
        said = dict.fromkeys(_NUMBERS, np.nan)
    else:
        field, grooves, shell = warmth.cells, warmth.grooves, warmth.shell
        growth = equation.growth
        said = {
            "friction_power": warmth.friction,
            "temperature": warmth.mean,
            "maximum_temperature": max(warmth.hottest, float(field[equation.wet].max())),
            "outlet_temperature": warmth.side,
            "shaft_temperature": warmth.shaft,
            "viscosity": float(oil.viscosity(warmth.mean)),
            "heat_carried": warmth.carried,
            "heat_conducted": warmth.conducted,
            "heat_imbalance": warmth.imbalance,
        }
    if equation.mirrored:
        field, shell, growth = (
            np.concatenate([x[:, ::-1], x], axis=1) for x in (field, shell, growth)
        )
    return said | {
        "film_temperature": field,
        "surface_temperature": shell,
        "thermal_growth": growth,
        "film_viscosity": np.asarray(oil.viscosity(field)),
        "trailing_temperature": grooves[:, 0],
        "leading_temperature": grooves[:, 1],
        "heat_residual": found.residual,
        "heat_iterations": found.iterations,
    }


OVER_AREA = ("film_temperature", "surface_temperature", "thermal_growth", "film_viscosity")
"""What results say of every cell."""

_NUMBERS = (
    "friction_power",
    "temperature",
    "maximum_temperature",
    "outlet_temperature",
    "shaft_temperature",
    "viscosity",
    "heat_carried",
    "heat_conducted",
    "heat_imbalance",
)
