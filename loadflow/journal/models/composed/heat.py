"""Heat over the area of a reduced film of cells around and points across, at rest and in motion.

Temperatures are those of strips, see `composed.strip_film`. In motion they are those of the mean
heat of films at rest under loads of the series, as on the grid.
"""

from __future__ import annotations

import warnings
from dataclasses import replace
from functools import partial
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError, ValidityWarning
from loadflow.journal.film.gap.warm import WarmGap
from loadflow.journal.film.heat.temperatures import Warmth
from loadflow.journal.film.linearised import Linear
from loadflow.journal.heat import FilmHeat
from loadflow.journal.models import grid
from loadflow.journal.models.composed.heat_position import films_beside
from loadflow.journal.models.composed.model import build, levels_at_rest, warn_unresolved
from loadflow.journal.models.composed.rest_on_level import Known, RestingFilms, films_at_rest
from loadflow.journal.models.composed.strip_film import SHARP, Made, StripFilm, Tried, with_heat
from loadflow.journal.models.composed.uneven import Thickness
from loadflow.journal.questions import AtRest
from loadflow.journal.rows import answered_rows, columns_of, operating_columns
from loadflow.journal.solvers.motion.start import orbit_film
from loadflow.journal.solvers.newton import Solution
from loadflow.journal.solvers.statics import Statics
from loadflow.journal.solvers.warm.mean import MeanHeat, SeriesLoads, in_balance, mean_heat
from loadflow.journal.solvers.warm.position import WarmFilm, no_warmth, settled_stiffness
from loadflow.journal.solvers.warm.rows import (
    heat_columns,
    in_grown_clearances,
    with_heat_bounds,
)
from loadflow.numerics.lines import on_lines

Array = NDArray[np.float64]


class _Around:
    """Loads on a reduced film with heat, and the films at the temperatures last tried."""

    def __init__(self, asked: AtRest) -> None:
        # what the cells do not resolve is told, not solved on others
        bare = replace(asked.film.isothermal(), grading="uniform")
        limits, self.strict = asked.limits, asked.limits.strict
        sharp = replace(limits, tolerance=min(limits.tolerance, SHARP), strict=False)
        self.asked, self.bearing = replace(asked, film=bare, limits=sharp), asked.bearing
        # the fewest points tell no narrow strips apart
        self.levels = levels_at_rest(bare)[1:]
        given = asked.bearing, bare, asked.speed, asked.line, self.levels[0]
        self.known = dict[int, Known]()  # films of loads at temperatures tried before
        self.heat = cast("FilmHeat", asked.film.heat)
        self.equation = StripFilm(build(*given, at_rest=True), self.heat)

    def film(self, n: int, level: int) -> Tried[RestingFilms]:
        """Film of load `n` on the points of a level."""
        one, equation = np.array([n]), self.equation
        equation.require_gap()
        known, viscosity = self.known.get(n), equation.viscosity
        films = films_at_rest(self.asked.at(one), level, known, viscosity=viscosity)
        if not films.found[0]:
            self.known.pop(n, None)
            return self.tried(films, None, level)
        at, tilt = films.answer["eccentricity"][0], films.answer["tilt"][0] * self.bearing.radius
        place = np.append(at, tilt) / self.bearing.clearance
        self.known[n] = Known({0: (films.model.work.last.copy(), place)}, films.model)
        rubbed = float(films.answer["contact_power"][0]) if self.asked.film.contact else 0.0
        made = equation.made(films.model, float(self.asked.speed[n]), rubbed)
        return self.tried(films, made, level)

    def tried(self, films: RestingFilms, made: Made | None, level: int) -> Tried[RestingFilms]:
        """One of the films, and as those of the grid are told."""
        answer = films.answer
        place = answer["eccentricity"][0] / self.bearing.clearance
        linear = Linear(answer["force"][0], answer["stiffness"][0], answer["damping"][0], place)
        spent, left = int(answer["iterations"][0]), float(answer["residual"][0])
        found = bool(films.found[0])
        solution = Solution(films.model.work.u, place, linear, found, spent, left)
        return Tried(films, solution, made, found and bool(films.left[0]), level)


def equilibrium(asked: AtRest) -> dict[str, Any]:
    """Fields of `FilmHeatEquilibrium`, (n, …), on the strips as cells across.

    Raises
    ------
    loadflow.errors.SolverError
        If ``limits.strict``, the first load without film or temperatures.

    Warns
    -----
    loadflow.errors.ValidityWarning
        Cells, or polynomials, that do not resolve a film; names the first load.
    """
    around, bearing = _Around(asked), asked.bearing
    rows, count = [], asked.speed.size
    coarse, left = np.zeros(count, bool), np.zeros(count, bool)
    last: tuple[Solution, Warmth] | None = None
    for n in range(count):
        tried, found = _at_rest(around, n, last)
        if not found.converged and last is not None:
            tried, found = _at_rest(around, n, None)
        if not found.converged and around.strict:
            one = asked.at(np.array([n]))
            why = no_warmth(found) or grid.why_none(partial(grid.equilibrium, one))
            raise SolverError(f"load {n}: {why}")
        films, row = tried.film, _row(around, n, tried.film, found)
        rows.append(row)
        if found.converged and found.warmth is not None:
            last = found.solution, found.warmth
            left[n] = films.left[0]
            tilt = films.answer["tilt"][0] * bearing.radius / bearing.clearance
            place = np.append(found.solution.position, tilt)
            coarse[n] = not films.model.resolves(place)
            if around.heat.stiffness == "settled":
                row["stiffness"] = _settled(around, n, tried, place, last)
    if left.any():
        warn_unresolved(left, f"load {int(left.argmax())}")
    if coarse.any():
        warnings.warn(
            f"the cells around do not resolve the film of {coarse.sum()} of {count} loads, first "
            f"of number {int(coarse.argmax())}; a finer grid does",
            ValidityWarning,
            stacklevel=4,
        )
    converged = np.array([row["converged"] for row in rows])
    return answered_rows(converged, columns_of(rows))


def _at_rest(
    around: _Around, n: int, last: tuple[Solution, Warmth] | None
) -> tuple[Tried[RestingFilms], WarmFilm]:
    """Film and temperatures of load `n`, on as many points across as it asks for."""
    tried, found = with_heat(around.equation, around.levels, partial(around.film, n), last)
    if tried is None:  # grown into its shell in oil as it enters: a film without heat, told as none
        one, level = np.array([n]), around.levels[0]
        films = films_at_rest(around.asked.at(one), level)
        tried = around.tried(films, None, level)
    return tried, found


def _settled(
    around: _Around,
    n: int,
    tried: Tried[RestingFilms],
    place: Array,
    last: tuple[Solution, Warmth],
) -> Array:
    """Stiffness of load `n` at a `place` (4,), N/m, of a shaft whose temperatures follow it."""
    films, bearing, here = tried.film, around.bearing, around.asked.at(np.array([n]))
    least = float(films.answer["minimum_film"][0]) / bearing.clearance
    speed, limits = float(here.speed[0]), here.limits
    film_at = films_beside(
        films.model, here.line, around.equation, speed, tried.level, last, limits
    )
    place = place[: 4 if films.model.whole else 2]
    return settled_stiffness(bearing, film_at, place, least, f"load {n}", around.strict)


def _row(around: _Around, n: int, films: RestingFilms, found: WarmFilm) -> dict[str, Any]:
    """One row of `FilmHeatEquilibrium`."""
    bearing, heat, equation = around.bearing, around.heat, around.equation
    mean = heat.inlet_temperature if found.warmth is None else found.warmth.mean
    row = {name: values[0] for name, values in films.answer.items()}
    place = row["eccentricity"] / bearing.clearance
    load = around.asked.force[n], float(around.asked.speed[n])
    operating = operating_columns(bearing, *load, heat.lubricant(mean), place)
    kept = "shell_deformation"
    warm = {name: value for name, value in operating.items() if name != kept}
    where = {"angle": equation.columns.angle, "z": equation.whole_z * bearing.radius}
    row = with_heat_bounds(row, equation, found, row["minimum_film"] / bearing.clearance)
    row |= warm | heat_columns(equation, found) | where
    if heat.growth is not None:
        row |= in_grown_clearances(row, bearing, equation, found)
    return row | {"converged": found.converged, "iterations": found.solution.iterations}


def mean_around(asked: AtRest) -> tuple[MeanHeat, Thickness, Statics | None]:
    """Temperatures of a series of loads, and the viscosity of its film.

    On pads that tilt, whose films at rest are of the grid, also the film there.

    Raises
    ------
    loadflow.errors.SolverError
        No temperatures, or none of the loads has a film at rest.

    Warns
    -----
    loadflow.errors.ValidityWarning
        Many of the loads have no film at rest.
    """
    if asked.bearing.has_pads:
        return _mean_on_pads(asked)
    around = _Around(asked)
    level, equation, some = around.levels[0], around.equation, SeriesLoads.of(asked.speed.size)
    made: list[Made] = []

    def film_of(before: Solution | None) -> Solution:
        made.clear()
        spent, shown = 0, None
        lost = []
        for index in some.asked:
            tried = around.film(index, level)
            spent += tried.solution.iterations
            if shown is None or tried.made is not None:
                shown = tried.solution
            if tried.made is None:
                lost.append(index)
            else:
                made.append(tried.made)
        some.leave(lost)
        assert shown is not None  # a series has loads
        return replace(shown, iterations=spent)

    def heat_of(last: Solution, cells: Array) -> Warmth:
        return equation.of(made, cells)

    return in_balance(equation, film_of, heat_of, made, some), equation.viscosity, None


def _mean_on_pads(asked: AtRest) -> tuple[MeanHeat, Thickness, Statics]:
    """The same by the films of the grid, on the columns of cells that lie alike on the pads."""
    even = replace(asked.film, grading="uniform")
    bearing, force, speed, line = asked.bearing, asked.force, asked.speed, asked.line
    statics, _ = orbit_film(bearing, even, force, speed, line)
    heat = mean_heat(statics, force, speed, asked.limits)
    ring, mesh = build(bearing, even.isothermal(), speed, line).film.ring, statics.film.mesh
    angle = np.arctan2(ring.sin, ring.cos)

    def around(cells: Array) -> Array:
        return on_lines(angle, mesh.angle, cells, period=2.0 * np.pi)

    across = cast("WarmGap", statics.gap).across_film
    found = Thickness(mesh.z, around(across.flow), around(across.shear), around(across.drag))
    return heat, found, statics
