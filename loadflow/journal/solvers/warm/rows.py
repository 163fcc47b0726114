"""Films with heat over their area on the grid, as rows of results; what all of them say of it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.cell_error import warm_errors
from loadflow.journal.film.heat.equation import EnergyEquation
from loadflow.journal.film.heat.temperatures import Temperatures, Warmth
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.questions import AtPosition, AtRest
from loadflow.journal.rows import field_row, static_row
from loadflow.journal.solvers.newton import Solution, solve_film
from loadflow.journal.solvers.search import Search
from loadflow.journal.solvers.statics import Statics
from loadflow.journal.solvers.warm.position import (
    WarmFilm,
    coupled,
    energy_of,
    no_warmth,
    settled_stiffness,
)
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require
from loadflow.numerics.lines import on_lines

Array = NDArray[np.float64]

_MOST_AROUND = 240  # cells, of a film that is not found on fewer


def warm_rows(asked: AtRest) -> list[dict[str, Any]]:
    """Rows of `FilmHeatEquilibrium`.

    Raises
    ------
    loadflow.errors.SolverError
        If ``limits.strict``, the first load without film or temperatures.
    """
    bearing, options, line, control = asked.bearing, asked.film, asked.line, asked.limits
    loads, speeds = asked.force, asked.speed
    statics, equation = _prepared(bearing, options, line, float(np.abs(speeds).max()))
    each = replace(control, strict=False)
    around, across = options.cells
    finer = replace(options, grid=(2 * around, across)) if 2 * around <= _MOST_AROUND else None
    rows = []
    last: tuple[Solution, Warmth] | None = None
    for index, (load, omega) in enumerate(zip(loads, speeds.tolist())):
        search = Search()

        def found_on(
            statics: Statics,
            equation: EnergyEquation,
            last: tuple[Solution, Warmth] | None,
            index: int = index,
            omega: float = omega,
            search: Search = search,
        ) -> WarmFilm:
            def film_of(before: Solution | None) -> Solution:
                effort = search.effort(statics.film, each.max_iterations)
                return statics.solve(index, loads[index], omega, before, each, effort=effort)

            return coupled(equation, film_of, last, equation.alone)

        found = found_on(statics, equation, last)
        if not found.converged and last is not None:
            found = found_on(statics, equation, None)
        used = statics, equation
        if found.lost and finer is not None and not search.over:
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
                row["stiffness"] = _settled(bearing, *used, warm, control, f"load {index}")
            if used[0] is statics:
                last = warm
        rows.append(row if used[0] is statics else _at_angles(row, statics.film.mesh.angle))
    return rows


def warm_fields(asked: AtPosition) -> tuple[list[dict[str, Any]], Array]:
    """Rows of `FilmHeatField` and axial places of the cells, m; errors as of `warm_rows`."""
    bearing, line, control = asked.bearing, asked.line, asked.limits
    places, velocities, speeds = asked.position, asked.velocity, asked.speed
    require(not velocities.any(), "velocity", velocities.tolist(), "0 with heat over the area")
    statics, equation = _prepared(bearing, asked.film, line, float(np.abs(speeds).max()))
    rows = []
    for index, omega in enumerate(speeds.tolist()):

        def film_of(before: Solution | None, index: int = index, omega: float = omega) -> Solution:
            return statics.hold(index, places[index], velocities[index], omega, control)

        found = coupled(equation, film_of, None, equation.alone)
        if not found.converged and control.strict:
            why = found.why or statics.message(found.solution)
            raise SolverError(f"film {index}: {why}")
        row = field_row(statics.film, statics.gap, found.film)
        row = with_heat_bounds(row, equation, found, np.inf)
        row["eccentricity_ratio"] /= 1.0 + equation.mean_growth / bearing.clearance
        row |= heat_columns(equation, found)
        if equation.heat.stiffness == "settled" and found.converged and found.warmth is not None:
            warm, name = (found.solution, found.warmth), f"film {index}"
            row["stiffness"] = _settled(bearing, statics, equation, warm, control, name)
        rows.append(row)
    return rows, statics.film.mesh.z * bearing.radius


def require_apart(
    bearing: JournalGeometry, options: Film, place: Array, speed: float, line: Line, index: int
) -> None:
    """Refuse a shaft that touches the bore at a `place` of number `index`, in oil as it enters.

    Raises
    ------
    loadflow.errors.InputError
        It does.
    """
    statics, equation = _prepared(bearing, options, line, abs(speed))
    equation.thicken(equation.state(None))
    statics.apart(index, place, speed)


def _prepared(
    bearing: JournalGeometry, options: Film, line: Line, rate: float
) -> tuple[Statics, EnergyEquation]:
    """Film and energy equation."""
    statics = Statics(bearing, options, line, rate)
    return statics, energy_of(statics)


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
    row = static_row(bearing, film, statics.gap, load, heat.lubricant(mean), found.film, whirl)
    row = with_heat_bounds(row, equation, found, row["minimum_film"] / bearing.clearance)
    if heat.growth is not None:
        row |= in_grown_clearances(row, bearing, equation, found)
    angle, z = film.mesh.angle, film.mesh.z * bearing.radius
    both = z if z[0] < 0 else np.concatenate([-z[::-1], z])
    return row | heat_columns(equation, found) | {"angle": angle, "z": both}


def _settled(
    bearing: JournalGeometry,
    statics: Statics,
    equation: EnergyEquation,
    last: tuple[Solution, Warmth],
    control: Limits,
    name: str,
) -> Array:
    """`settled_stiffness` of a film on the grid, the `last` one with its temperatures."""
    film, place = statics.film, last[0].position
    limits = control.tolerance, film.newton_steps(control.max_iterations)

    def film_at(place: Array) -> WarmFilm:
        def film_of(before: Solution | None) -> Solution:
            start = film.start() if before is None else before.u
            return solve_film(film, start, place, np.zeros(place.size), *limits)

        return coupled(equation, film_of, last, equation.alone)

    least = film.narrowest(last[0].u, place)
    return settled_stiffness(bearing, film_at, place, least, name, control.strict)


def _at_angles(row: dict[str, Any], angle: Array) -> dict[str, Any]:
    """The row of a film on more cells, its fields at the angles (nx,) of those asked for."""
    own = row["angle"]
    moved = {name: on_lines(angle, own, row[name], period=2.0 * np.pi) for name in OVER_AREA}
    return row | moved | {"angle": angle}


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


def with_heat_bounds(
    row: dict[str, Any], equation: Temperatures, found: WarmFilm, narrow: float
) -> dict[str, Any]:
    """A `row` whose bounds of what cells do count heat, too; `narrow` is that of `warm_errors`."""
    if not found.converged or "relative_grid_error" not in row:
        return row
    given = equation.left_by_cells(), row["eccentricity_ratio"], np.array(narrow)
    return row | {"relative_grid_error": warm_errors(row["relative_grid_error"], *given)}


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
