"""Reduced films with heat over the area at given positions, and the stiffness of slow drift.

Film and temperatures agree at every position as they do at rest, on the same strips.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.cell_error import warm_errors
from loadflow.journal.film.heat.temperatures import Warmth
from loadflow.journal.film.linearised import Linear
from loadflow.journal.heat import FilmHeat
from loadflow.journal.line import Line
from loadflow.journal.models import grid
from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.model import (
    ComposedFilm,
    build,
    levels_at_rest,
    warn_unresolved,
)
from loadflow.journal.models.composed.position import Held, Positions, places_across, told
from loadflow.journal.models.composed.strip_film import SHARP, StripFilm, Tried, with_heat
from loadflow.journal.models.composed.uneven import Thickness
from loadflow.journal.questions import AtPosition
from loadflow.journal.rows import answered_rows, columns_of
from loadflow.journal.solvers.newton import Solution
from loadflow.journal.solvers.warm.position import WarmFilm, no_warmth, settled_stiffness
from loadflow.journal.solvers.warm.rows import OVER_AREA, heat_columns, require_apart
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require

Array = NDArray[np.float64]


class _AtPlaces:
    """Positions of a shaft in a reduced film with heat, and the films at the temperatures tried."""

    def __init__(self, asked: AtPosition, equation: StripFilm) -> None:
        self.asked, self.equation = asked, equation
        self._held = dict[int, Held]()  # films at temperatures tried before
        self.tried = dict[int, Positions]()  # what they are films of

    def film(self, n: int, level: int) -> Tried[Held]:
        """Film at position `n` on the points of a level."""
        self.equation.require_gap()
        here = Positions(self.asked, viscosity=self.equation.viscosity)
        self.tried[n] = here
        model = here.model(self.asked.film.cells[0], level, None)
        held = here.on(n, model, self._held.get(n))
        row, made = held.row, None
        self._held.pop(n, None)
        if held.found:
            self._held[n] = held
            speed, rubbed = float(self.asked.speed[n]), 0.0
            if self.asked.film.contact is not None:
                said = model.results(row[None], np.array([speed]))
                rubbed = float(said["contact_power"][0])
            made = self.equation.made(model, speed, rubbed)
        load = np.append(held.force, row[at.MOMENT_X : at.MOMENT_Y + 1])
        linear = Linear(load, held.slopes[0], held.slopes[1], held.place)
        spent, residual = int(row[at.ITERATIONS]), float(row[at.RESIDUAL])
        solution = Solution(held.unknowns, held.place, linear, held.found, spent, residual)
        return Tried(held, solution, made, held.left, level)

    def found(
        self, n: int, levels: Sequence[int], last: tuple[Solution, Warmth] | None
    ) -> tuple[Tried[Held] | None, WarmFilm]:
        """Film and temperatures at position `n`."""
        return with_heat(self.equation, levels, partial(self.film, n), last)


def pressure(asked: AtPosition) -> tuple[dict[str, Any], Array]:
    """Fields of `FilmHeatField`, (n, …), and places of the points across, m, of films at positions.

    Temperatures are shown at the points across, straight between the strips that they are those of.

    Raises
    ------
    loadflow.errors.InputError
        A velocity; the shaft touches the bore.
    loadflow.errors.SolverError
        If ``limits.strict``, the first position without film or temperatures.

    Warns
    -----
    loadflow.errors.ValidityWarning
        A pressure that changes more across the width than the polynomials do; names the position.
    """
    bearing, speed, line, limits = asked.bearing, asked.speed, asked.line, asked.limits
    still = "0 with heat over the area"
    require(not asked.velocity.any(), "velocity", asked.velocity.tolist(), still)
    bare = replace(asked.film.isothermal(), grading="uniform")
    levels = levels_at_rest(bare)[1:]
    heat = cast("FilmHeat", asked.film.heat)
    each = replace(limits, tolerance=min(limits.tolerance, SHARP), strict=False)
    equation = StripFilm(build(bearing, bare, speed, line, levels[0], at_rest=True), heat)
    cold = replace(asked, film=bare, limits=each)
    places = _AtPlaces(cold, equation)
    films: list[tuple[Positions, Held]] = []
    rows: list[dict[str, Any]] = []
    left, wider = np.zeros(speed.size, bool), np.ones(speed.size)
    thinning = np.zeros(speed.size)
    stiffness: dict[int, Array] = {}
    for n in range(speed.size):
        one = np.array([n])
        tried, found = places.found(n, levels, None)
        if not found.converged:
            require_apart(bearing, asked.film, asked.position[n], float(speed[n]), line, n)
            if limits.strict:
                on_grid = partial(grid.pressure, asked.at(one))
                raise SolverError(f"film {n}: {no_warmth(found) or grid.why_none(on_grid)}")
        if tried is None:  # grown into its shell in oil as it enters: a film without heat
            own = Positions(cold)
            films.append((own, own.on(n, own.model(bare.cells[0], levels[0], None), None)))
        else:
            films.append((places.tried[n], tried.film))
            left[n] = found.converged and tried.left
        wider[n] = 1.0 + equation.mean_growth / bearing.clearance
        rows.append(heat_columns(equation, found) | {"converged": found.converged})
        thinning[n] = equation.left_by_cells() if found.converged else 0.0
        if heat.stiffness == "settled" and tried and found.converged and found.warmth:
            model, place, row = tried.film.model, tried.film.place, tried.film.row
            last = found.solution, found.warmth
            film_at = films_beside(
                model, line.at(one), equation, float(speed[n]), tried.level, last, each
            )
            place = place[: 4 if model.whole else 2]
            given = place, float(row[at.LEAST]), f"film {n}", limits.strict
            stiffness[n] = settled_stiffness(bearing, film_at, *given)
    if left.any():
        warn_unresolved(left, f"position {int(left.argmax())}")
    held = [film for _, film in films]
    shown = [own.shown(held) for own, _ in films]
    answer, z = told(films[0][0], held, shown), places_across(shown[0])
    known = thinning, answer["eccentricity_ratio"], np.full(speed.size, np.inf)
    answer["relative_grid_error"] = warm_errors(answer["relative_grid_error"], *known)
    answer["eccentricity_ratio"] /= wider
    for n, settled in stiffness.items():
        answer["stiffness"][n] = settled
    answer |= _at_points(columns_of(rows), equation.whole_z, z / bearing.radius, heat)
    return answered_rows(answer["converged"], answer), z


def _at_points(
    rows: dict[str, Any], strips: Array, points: Array, heat: FilmHeat
) -> dict[str, Any]:
    """Columns of heat whose fields on `composed.strips` are shown at `points` across."""
    growth = "thermal_growth"
    fields = {
        name: np.array([[np.interp(points, strips, row) for row in film] for film in rows[name]])
        for name in OVER_AREA
        if name != growth
    }
    fields["film_viscosity"] = np.asarray(heat.liquid.viscosity(fields["film_temperature"]))
    grown = Thickness(strips, rows[growth][0])
    fields[growth] = np.array([grown.grown(film, points) for film in rows[growth]])
    return rows | fields


def films_beside(
    film: ComposedFilm,
    line: Line,
    equation: StripFilm,
    speed: float,
    level: int,
    last: tuple[Solution, Warmth],
    limits: Limits,
) -> Callable[[Array], WarmFilm]:
    """Films on the points of a `level` and their temperatures, of places (2,) or (4,) of the shaft.

    The latter where the `film` is one of all the width.
    """
    bearing, rate = film.bearing, np.array([speed])

    def film_at(place: Array) -> WarmFilm:
        there = Line()
        if film.whole:
            there = Line(tilt=place[None, 2:] * bearing.relative_clearance, bend=line.bend)
        at, still = place[None, :2], np.zeros((1, 2))
        asked = AtPosition(bearing, film.options, at, still, rate, there, limits)
        return _AtPlaces(asked, equation).found(0, [level], last)[1]

    return film_at
