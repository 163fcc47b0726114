"""Heat over the area of a reduced film, of cells around and the points across.

The energy equation is that of the grid (`loadflow.journal.film.energy_equation`) on even strips
around, as many as the grid has cells across: what mixes between cells of first order is then the
same on both. What flows along each strip and over the bearing ends follows from the film, whose
points across share it out by the width that they stand for, and what passes between strips from the
balance of each cell. In motion the temperatures are those of the mean heat of films at rest under
loads of the series, as on the grid.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError, ValidityWarning
from loadflow.journal.cavitation import FILL, LOAD, P
from loadflow.journal.film.energy_balance import FRESH, Flows
from loadflow.journal.film.grooves import groove_numbers
from loadflow.journal.film.linearised import Linear
from loadflow.journal.film.ring_growth import RingExpansion
from loadflow.journal.film.temperatures import Temperatures, Warmth
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.heat import FilmHeat
from loadflow.journal.line import Line
from loadflow.journal.models import grid
from loadflow.journal.models._composed_gap_kernels import (
    CUBE,
    DRAG,
    FACE_PLANES,
    FLOW,
    MEAN,
    PLANES,
)
from loadflow.journal.models.composed_model import (
    ComposedFilm,
    build,
    levels_at_rest,
    warn_unresolved,
)
from loadflow.journal.models.composed_rest import Known, RestingFilms, films_at_rest
from loadflow.journal.models.composed_supply import parted_at
from loadflow.journal.models.composed_uneven import Thickness
from loadflow.journal.models.ring import Ring
from loadflow.journal.models.strips import made_in_film, passed_on, shares_of, strip_edges
from loadflow.journal.rows import answered_rows, columns_of, operating_columns
from loadflow.journal.solvers.newton import Solution
from loadflow.journal.solvers.warm import (
    WarmFilm,
    coupled,
    heat_columns,
    in_grown_clearances,
    no_warmth,
)
from loadflow.journal.solvers.warm_mean import MeanHeat, SeriesLoads, in_balance
from loadflow.numerics.convergence import Limits

Array = NDArray[np.float64]


_LEAST_STRIPS = 4  # over the whole width: growth goes on straight through two in either half


class Made(NamedTuple):
    """What one film carries, and the heat it makes: arguments of `Temperatures.balanced`."""

    flows: Flows
    gaps: Array
    sheared: Array
    pumped: Array


class _Columns(NamedTuple):
    """Columns of cells around, and edges of the strips, as `RingExpansion` asks for them."""

    edges: Array
    angle: Array
    dx: Array
    z_edges: Array

    @classmethod
    def of(cls, ring: Ring, z_edges: Array) -> _Columns:
        """Those of a film, and the grooves between its segments."""
        angle = np.unwrap(np.arctan2(ring.sin, ring.cos))
        edges = np.append(angle - 0.5 * ring.width, angle[-1] + 0.5 * ring.width[-1])
        return cls(edges, angle, ring.width, z_edges)


class StripFilm(Temperatures):
    """Energy equation of the strips of a reduced film, from lower to higher z.

    Parameters
    ----------
    model : ComposedFilm
        The film, with the points across of its level.
    heat : FilmHeat
        Oil and cooling.
    """

    def __init__(self, model: ComposedFilm, heat: FilmHeat) -> None:
        units = model.units
        self.mirrored = not model.whole
        self._share = 0.5 if model.whole else 1.0  # the units are those of half of the width
        end, supply = float(units.mesh.z_edges[-1]), model.options.supply
        across = max(model.options.cells[1], _LEAST_STRIPS)
        marks = () if supply is None else parted_at(supply, model.bearing)
        self._edges = strip_edges(end, across, model.whole, marks)
        self.z = 0.5 * (self._edges[1:] + self._edges[:-1])
        area = self._share * units.mirrors * units.radius**2
        ring = model.film.ring
        areas = area * np.outer(ring.width, np.diff(self._edges))
        self.columns = _Columns.of(ring, self._edges)
        asked = model.options.cells[0], units.radius
        labels = groove_numbers(self.columns.angle, self.z, end, supply, *asked)
        count, own = units.pockets.count, ring.groove & (labels < 0).all(axis=1)
        labels[own] = count + np.cumsum(own)[own, None] - 1  # between segments
        super().__init__(units, heat, areas, labels, count + int(own.sum()))
        if heat.growth is not None:
            self._expansion = RingExpansion(heat, self.columns, units.radius)
        self.thicken(self.state(None))

    def thicken(self, state: Array) -> None:
        """Have the viscosity and the growth of the temperatures `state`, in units of the film."""
        across, growth = self._at_state(state)
        self._grown = np.zeros(self.shape) if growth is None else growth
        grown = None if growth is None else growth / self._clearance
        self.viscosity = Thickness(self.z, across.flow, across.shear, across.drag, grown)

    @property
    def growth(self) -> Array:
        """Growth of the gap of the cells by heat, (nx, nz), m."""
        return self._grown

    @property
    def _clearance(self) -> float:
        """Of the bearing, m."""
        return self.film.relative_clearance * self.film.radius

    def made(self, model: ComposedFilm, speed: float, rubbed: float) -> Made:
        """What the film last solved carries and makes; its asperities make the heat `rubbed`, W."""
        film, work, units = model.film, model.work, self.film
        ring, nodes, shares = film.ring, film.nodes, shares_of(film.nodes, self._edges)
        points, inner = nodes.slopes.shape
        p, fill = (work.state[row, :, :inner] for row in (P, FILL))
        wedge, weights = 0.5 * ring.slope * speed, nodes.weights
        upstream = fill if wedge > 0.0 else np.roll(fill, -1, axis=0)
        dragged = wedge * ring.edge_fill * work.face[FACE_PLANES, :, :points]  # that of the ends
        dragged[:, :inner] = wedge * upstream * work.face[DRAG, :, :inner]
        dragged *= weights
        conducts = np.zeros_like(dragged)
        conducts[:, :inner] = work.face[FLOW, :, :inner] / ring.apart[:, None] * weights[:inner]
        rise, lost = np.zeros_like(dragged), np.zeros_like(dragged)
        rise[:, :inner] = np.roll(p, -1, axis=0) - p
        load = work.state[LOAD, :, :inner]
        lost[:, :inner] = (np.roll(load, -1, axis=0) - load) ** 2
        along = conducts * lost
        crossing = work.slope[:, :points] * work.gap[CUBE, :, :points] * weights
        crossing *= ring.width[:, None]
        carries = np.ones_like(dragged)  # a pressure that is cut off dissipates nothing
        carries[:, :inner] = p >= load
        across = crossing * work.slope[:, :points] * carries
        around = dragged - conducts * rise
        crossing[ring.groove], across[ring.groove] = 0.0, 0.0
        # over an end leaves what reaches its point, but for what that drags
        drags = around[:, -nodes.ends.size :] - np.roll(around[:, -nodes.ends.size :], 1, axis=0)
        drawn = np.where(ring.groove[:, None], 0.0, drags + crossing @ nodes.end_slopes)
        closed = np.repeat(ring.groove[:, None], points, axis=1)
        closed[:, :inner] |= film.held.grooves >= 0
        unit = self._share * units.pockets.flow_unit
        clearance = self._clearance
        drag = self._share * units.mirrors * units.viscosity * units.radius**4 / clearance
        # all of it where the film ends
        ahead, behind = (np.where(np.roll(closed, way, axis=0), 1.0, 0.5) for way in (-1, 1))
        ahead, behind = ahead * ~closed, behind * ~closed
        pumped = unit * (across + ahead * along + behind * np.roll(along, 1, axis=0))
        pumped += self._rubbed(model, rubbed)
        gaps = (clearance * work.gap[MEAN, :, :points] * weights) @ shares / np.diff(self._edges)
        return Made(
            self._between(unit * around @ shares, unit * dragged @ shares, unit * drawn),
            gaps[self.wet],
            made_in_film(drag * speed**2 * work.sheared[:, :points], shares, self.wet)[self.wet],
            made_in_film(pumped, shares, self.wet)[self.wet],
        )

    def of(self, films: Sequence[Made], guess: Array) -> Warmth:
        """Temperatures in balance with the mean of the heat that `films` make and carry."""
        gaps, sheared, pumped = (
            np.mean(parts, axis=0)
            for parts in zip(*((one.gaps, one.sheared, one.pumped) for one in films))
        )
        return self.balanced(Flows.mean([one.flows for one in films]), gaps, sheared, pumped, guess)

    # --- inside ----------------------------------------------------------------------------------
    def _between(self, around: Array, dragged: Array, drawn: Array) -> Flows:
        """Flows along the strips and between them, of which `drawn` (nx, e) come over the ends."""
        cells, fresh = self._cells, np.full((self.shape[0], 1), FRESH)
        gained = np.roll(around, 1, axis=0) - around  # what each passes on to the next strip
        low = np.zeros(self.shape[0]) if self.mirrored else drawn[:, 0]
        passed = passed_on(gained, low, drawn[:, -1], self.wet)
        before = np.append(cells, np.hstack([fresh, cells]))
        behind = np.append(np.roll(cells, -1, axis=0), np.hstack([cells, fresh]))
        flow, drag = np.append(around, passed), np.append(dragged, np.zeros(passed.size))
        return self._flows(before, behind, flow, drag)

    def _rubbed(self, model: ComposedFilm, rubbed: float) -> Array | float:
        """Heat of the asperities at the points, W, shared out as they are pressed there."""
        if rubbed == 0.0:
            return 0.0
        contact, nodes = model.options.contact, model.film.nodes
        assert contact is not None
        gaps = model.work.gap[PLANES, :, : nodes.z.size] * model.bearing.clearance
        pressed = np.asarray(contact.asperities.pressure(gaps)) * nodes.weights
        pressed *= (model.film.ring.width * ~model.film.ring.groove)[:, None]
        pressed[:, : nodes.slopes.shape[1]] *= model.film.held.drags
        if not pressed.any():  # they touch between the cells
            pressed.flat[gaps.argmin()] = 1.0
        return np.asarray(rubbed * pressed / pressed.sum())


class _Around:
    """Loads on a reduced film with heat, and the films at the temperatures last tried."""

    def __init__(
        self,
        bearing: JournalGeometry,
        options: Film,
        force: Array,
        speed: Array,
        line: Line,
        limits: Limits,
    ) -> None:
        # what the cells do not resolve is told, not solved on others
        self.options = replace(options.isothermal(), grading="uniform")
        self.bearing, self.force, self.speed, self.line = bearing, force, speed, line
        self.limits = replace(limits, strict=False)
        # the fewest points tell no narrow strips apart
        self.levels = levels_at_rest(self.options)[1:]
        given = self.bearing, self.options, self.speed, self.line, self.levels[0]
        self.known = dict[int, Known]()  # films of loads at temperatures tried before
        self.heat = cast("FilmHeat", options.heat)
        self.equation = StripFilm(build(*given, at_rest=True), self.heat)

    def film(self, n: int, level: int) -> tuple[RestingFilms, Made | None]:
        """Film of load `n` on the points of a level, and what it makes; None: there is none."""
        one, equation = np.array([n]), self.equation
        closes, clearance = -float(equation.growth.min()), self.bearing.clearance
        if closes >= clearance:
            raise SolverError(
                f"the shaft has grown into its shell: by {closes:.3g} m of {clearance:.3g}"
            )
        films = films_at_rest(
            self.bearing, self.options, self.force[one], self.speed[one], self.line.at(one),
            self.limits, level, self.known.get(n), viscosity=equation.viscosity,
        )  # fmt: skip
        if not films.found[0]:
            self.known.pop(n, None)
            return films, None
        at, tilt = films.answer["eccentricity"][0], films.answer["tilt"][0] * self.bearing.radius
        place = np.append(at, tilt) / clearance
        self.known[n] = Known({0: (films.model.work.last.copy(), place)}, films.model)
        rubbed = float(films.answer["contact_power"][0]) if self.options.contact else 0.0
        return films, equation.made(films.model, float(self.speed[n]), rubbed)

    def solution(self, films: RestingFilms) -> Solution:
        """One of the films as those of the grid are told."""
        answer = films.answer
        place = answer["eccentricity"][0] / self.bearing.clearance
        linear = Linear(answer["force"][0], answer["stiffness"][0], answer["damping"][0], place)
        spent, left = int(answer["iterations"][0]), float(answer["residual"][0])
        return Solution(films.model.work.u, place, linear, bool(films.found[0]), spent, left)


def equilibrium(
    bearing: JournalGeometry, options: Film, force: Array, speed: Array, line: Line, limits: Limits
) -> dict[str, Any]:
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
    around = _Around(bearing, options, force, speed, line, limits)
    rows, count = [], speed.size
    coarse, left = np.zeros(count, bool), np.zeros(count, bool)
    last: tuple[Solution, Warmth] | None = None
    for n in range(count):
        films, found = _at_rest(around, n, last)
        if not found.converged and last is not None:
            films, found = _at_rest(around, n, None)
        if not found.converged and limits.strict:
            why = no_warmth(found) or _why_by_grid(bearing, options, force, speed, line, limits, n)
            raise SolverError(f"load {n}: {why}")
        rows.append(_row(around, n, films, found))
        if found.converged and found.warmth is not None:
            last = found.solution, found.warmth
            left[n] = films.left[0]
            tilt = films.answer["tilt"][0] * bearing.radius / bearing.clearance
            coarse[n] = not films.model.resolves(np.append(found.solution.position, tilt))
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


def _why_by_grid(
    bearing: JournalGeometry,
    options: Film,
    force: Array,
    speed: Array,
    line: Line,
    limits: Limits,
    n: int,
) -> str:
    """Why the grid has no film for load `n` either, or that it has one."""
    one = np.array([n])
    try:
        grid.equilibrium(bearing, options, force[one], speed[one], line.at(one), limits)
    except SolverError as error:
        return str(error).removeprefix("load 0: ")
    return 'no film on rung = "reduced"; "grid" has one'


def _at_rest(
    around: _Around, n: int, last: tuple[Solution, Warmth] | None
) -> tuple[RestingFilms, WarmFilm]:
    """Film and temperatures of load `n`, on as many points across as it asks for."""
    kept: list[tuple[RestingFilms, Made | None]] = []
    for level in around.levels:

        def film_of(before: Solution | None, level: int = level) -> Solution:
            kept[:] = [around.film(n, level)]
            return around.solution(kept[0][0])

        def heat_of(film: Solution, cells: Array) -> Warmth:
            made = kept[0][1]
            assert made is not None  # the film has converged
            return around.equation.of([made], cells)

        found = coupled(around.equation, film_of, last, heat_of)
        if not (found.converged and kept[0][0].left[0] and found.warmth is not None):
            break
        last = found.solution, found.warmth
    if not kept:  # grown into its shell in oil as it enters: a film without heat, told as none
        one = np.array([n])
        load = around.force[one], around.speed[one], around.line.at(one)
        films = films_at_rest(around.bearing, around.options, *load, around.limits, level)
        kept[:] = [(films, None)]
    return kept[0][0], found


def _row(around: _Around, n: int, films: RestingFilms, found: WarmFilm) -> dict[str, Any]:
    """One row of `FilmHeatEquilibrium`."""
    bearing, heat, equation = around.bearing, around.heat, around.equation
    mean = heat.inlet_temperature if found.warmth is None else found.warmth.mean
    row = {name: values[0] for name, values in films.answer.items()}
    place = row["eccentricity"] / bearing.clearance
    load = around.force[n], float(around.speed[n])
    operating = operating_columns(bearing, *load, heat.lubricant(mean), place)
    kept = "shell_deformation"
    warm = {name: value for name, value in operating.items() if name != kept}
    z = np.append(-equation.z[::-1], equation.z) if equation.mirrored else equation.z
    where = {"angle": equation.columns.angle, "z": z * bearing.radius}
    row |= warm | heat_columns(equation, found) | where
    if heat.growth is not None:
        row |= in_grown_clearances(row, bearing, equation, found)
    return row | {"converged": found.converged, "iterations": found.solution.iterations}


def mean_around(
    bearing: JournalGeometry, options: Film, force: Array, speed: Array, line: Line, limits: Limits
) -> tuple[MeanHeat, Thickness]:
    """Temperatures of a series of loads, and the viscosity of its film.

    Raises
    ------
    loadflow.errors.SolverError
        No temperatures, or none of the loads has a film at rest.

    Warns
    -----
    loadflow.errors.ValidityWarning
        Many of the loads have no film at rest.
    """
    around = _Around(bearing, options, force, speed, line, limits)
    level, equation, some = around.levels[0], around.equation, SeriesLoads.of(speed.size)
    made: list[Made] = []

    def film_of(before: Solution | None) -> Solution:
        made.clear()
        spent, shown = 0, None
        lost = []
        for index in some.asked:
            films, own = around.film(index, level)
            solution = around.solution(films)
            spent += solution.iterations
            if shown is None or own is not None:
                shown = solution
            if own is None:
                lost.append(index)
            else:
                made.append(own)
        some.leave(lost)
        assert shown is not None  # a series has loads
        return replace(shown, iterations=spent)

    def heat_of(last: Solution, cells: Array) -> Warmth:
        return equation.of(made, cells)

    return in_balance(equation, film_of, heat_of, made, some), equation.viscosity
