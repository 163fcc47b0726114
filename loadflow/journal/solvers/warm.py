"""Film and temperature together: the energy equation over the area of a film, at rest.

Two solutions alternate: the film (and the shaft under its load) with the viscosity of every cell
given, by Newton; and the temperatures with flows and gap given, by Newton, the viscosity following
them. What one leaves of the other is a fixed point of the temperatures, accelerated by Anderson's
method. A film so hot that it does not converge is tried by shorter steps, and ends with a reason.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.energy_equation import EnergyEquation, Warmth
from loadflow.journal.film.gap_warm import WarmGap
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.heat import HOTTEST, FilmHeat
from loadflow.journal.line import Line
from loadflow.journal.rows import field_row, static_row
from loadflow.journal.solvers.newton import Solution
from loadflow.journal.solvers.statics import Statics
from loadflow.numerics.anderson import Anderson
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require

Array = NDArray[np.float64]
FilmOf = Callable[["Solution | None"], Solution]
"""The film at given viscosities, from the last solution."""

TOLERANCE, TRIES = 1e-7, 100
"""Largest change of a temperature that is left, K, and the fields of temperature tried."""
_DEPTH = 6  # earlier fields that count
_ACCELERATED, _SHORT = 20, 0.3  # fields after which only this share of each change is made
_NEAR = 0.5  # change, K, below which the method is trusted again
_WORSE = 1.5  # of the smallest change so far, that from which the next field goes back
_TOO_HOT = 10  # fields in a row above the largest temperature, after which none is tried
_HALVINGS = 4  # steps of the temperature that are halved before the film is given up
_WARMS = 10.0  # K, that a film must still warm by where it is lost, to have no temperature at all
_MOST_AROUND = 240  # cells, of a film that is not found on fewer


@dataclass(frozen=True)
class _Warm:
    """A film with its temperatures; the change (K) that is left of them; how many were tried."""

    solution: Solution
    warmth: Warmth | None
    residual: float
    iterations: int
    converged: bool
    why: str = ""

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
    loadflow.errors.InputError
        An elastic shell.
    loadflow.errors.SolverError
        If ``control.strict``, the first load without film or temperatures.
    """
    statics, equation = _prepared(bearing, options, line, float(np.abs(speeds).max()))
    each = replace(control, strict=False)
    around, across = options.cells
    finer = replace(options, grid=(2 * around, across)) if 2 * around <= _MOST_AROUND else None
    rows = []
    last: tuple[Solution, Array] | None = None
    for index, (load, omega) in enumerate(zip(loads, speeds.tolist())):

        def found_on(
            statics: Statics,
            equation: EnergyEquation,
            last: tuple[Solution, Array] | None,
            index: int = index,
            omega: float = omega,
        ) -> _Warm:
            def film_of(before: Solution | None) -> Solution:
                return statics.solve(index, loads[index], omega, before, each)

            return _coupled(equation, film_of, last)

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
            why = _no_warmth(found) or used[0].message(found.solution, load)
            raise SolverError(f"load {index}: {why}")
        if found.converged and found.warmth is not None and used[0] is statics:
            last = found.solution, found.warmth.cells
        row = _row(bearing, *used, load, found, line.whirl)
        rows.append(row if used[0] is statics else _at_angles(row, statics.film.mesh.angle))
    return rows


def _no_warmth(found: _Warm) -> str:
    """Why there are no temperatures; where there is no film, the film says why."""
    if found.lost and found.residual < np.inf and found.residual > _WARMS:
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

    names = ("film_temperature", "surface_temperature", "film_viscosity")
    return row | {name: moved(row[name]) for name in names} | {"angle": angle}


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

        found = _coupled(equation, film_of, None)
        if not found.converged and control.strict:
            why = found.why or statics.message(found.solution)
            raise SolverError(f"film {index}: {why}")
        row = field_row(statics.film, statics.gap, _flagged(found))
        rows.append(row | _heat_columns(equation, found))
    return rows, statics.film.mesh.z * bearing.radius


def _prepared(
    bearing: JournalGeometry, options: Film, line: Line, rate: float
) -> tuple[Statics, EnergyEquation]:
    """Film and energy equation."""
    require(options.shell is None, "shell", options.shell, "None with heat over the area")
    statics = Statics(bearing, options, line, rate)
    gap, heat = cast("WarmGap", statics.gap), cast("FilmHeat", options.heat)
    return statics, EnergyEquation(statics.film, gap, heat)


def _coupled(
    equation: EnergyEquation, film_of: FilmOf, last: tuple[Solution, Array] | None
) -> _Warm:
    """Film and temperatures that agree, from those of the `last` load or from cold oil."""
    film = equation.film
    cold = np.full(film.mesh.shape, equation.heat.inlet_temperature)
    before, now = (None, cold) if last is None else last
    good, warmth, residual = cold, None, np.inf
    method, halved, spent = Anderson(_DEPTH), 0, 0
    best, share, nearest, too_hot = np.inf, 1.0, (now, now), 0
    for iteration in range(1, TRIES + 1):
        equation.thicken(now)
        solution = film_of(before)
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
            warmth = equation.solve(solution.u, solution.position, now)
        except SolverError as error:
            return _Warm(solution, None, residual, iteration, False, str(error))
        before, good = solution, now
        residual = float(np.abs(warmth.cells - now).max())
        too_hot = too_hot + 1 if float(min(now.max(), warmth.cells.max())) > HOTTEST else 0
        if too_hot > _TOO_HOT:
            break
        if residual < best:
            best, nearest, share = residual, (now, warmth.cells), min(1.0, 2.0 * share)
        if residual <= TOLERANCE:
            hottest = max(warmth.hottest, float(warmth.cells.max()))
            hot = f"the film gets hotter than {HOTTEST} K: {hottest:.4g} K"
            fine = hottest < HOTTEST
            return _Warm(solution, warmth, residual, iteration, fine, "" if fine else hot)
        if iteration >= _ACCELERATED and residual > _NEAR:
            method.forget()
            now = now + _SHORT * (warmth.cells - now)
            continue
        if (
            iteration < _ACCELERATED and residual > _WORSE * best
        ):  # from the best field again, less far
            method.forget()
            share *= 0.5
            now = nearest[0] + share * (nearest[1] - nearest[0])
            continue
        share = share if iteration < _ACCELERATED else _SHORT
        relaxed = now + share * (warmth.cells - now)
        now = method.next(now.ravel(), relaxed.ravel()).reshape(now.shape)
        low, high = warmth.cells.min() - 5.0, warmth.cells.max() + 5.0
        now = np.clip(now, low, min(high, HOTTEST + 100.0))
    why = ""
    if warmth is not None:
        why = f"temperatures: {residual:.3g} K left after {iteration} fields"
    if too_hot:
        why = f"the film gets hotter than {HOTTEST} K"
    return _Warm(solution, warmth, residual, iteration, False, why)


def _flagged(found: _Warm) -> Solution:
    """The film, converged only with its temperatures."""
    return replace(found.solution, converged=found.converged)


def _row(
    bearing: JournalGeometry,
    statics: Statics,
    equation: EnergyEquation,
    load: Array,
    found: _Warm,
    whirl: float,
) -> dict[str, Any]:
    """One row of `FilmHeatEquilibrium`."""
    heat, film = equation.heat, equation.film
    mean = heat.inlet_temperature if found.warmth is None else found.warmth.mean
    row = static_row(bearing, film, statics.gap, load, heat.lubricant(mean), _flagged(found), whirl)
    angle, z = film.mesh.angle, film.mesh.z * bearing.radius
    both = z if z[0] < 0 else np.concatenate([-z[::-1], z])
    return row | _heat_columns(equation, found) | {"angle": angle, "z": both}


def _heat_columns(equation: EnergyEquation, found: _Warm) -> dict[str, Any]:
    """What a result says of its temperatures; NaN where there are none."""
    film, oil = equation.film, equation.heat.liquid
    warmth = found.warmth if found.converged else None
    said: dict[str, Any]
    if warmth is None:
        field, grooves = np.full(film.mesh.shape, np.nan), np.full((equation.grooves, 2), np.nan)
        shell = field
        said = dict.fromkeys(_NUMBERS, np.nan)
    else:
        field, grooves, shell = warmth.cells, warmth.grooves, warmth.shell
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
    if film.mesh.half:
        field, shell = (np.concatenate([x[:, ::-1], x], axis=1) for x in (field, shell))
    return said | {
        "film_temperature": field,
        "surface_temperature": shell,
        "film_viscosity": np.asarray(oil.viscosity(field)),
        "trailing_temperature": grooves[:, 0],
        "leading_temperature": grooves[:, 1],
        "heat_residual": found.residual,
        "heat_iterations": found.iterations,
    }


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
