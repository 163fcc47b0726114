"""Strips of a reduced film that its heat is balanced on: what the film carries and makes on them.

The energy equation is that of the grid (`loadflow.journal.film.heat.equation`) on even strips
around, as many as the grid has cells across: what mixes between cells of first order is then the
same on both. What flows along each strip and over the bearing ends follows from the film, whose
points across share it out by the width that they stand for, and what passes between strips from the
balance of each cell.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.cavitation import FILL, LOAD, P
from loadflow.journal.film.gap.grooves import groove_numbers
from loadflow.journal.film.heat.balance import FRESH, Flows
from loadflow.journal.film.heat.ring_growth import RingExpansion
from loadflow.journal.film.heat.temperatures import Temperatures, Warmth
from loadflow.journal.heat import FilmHeat
from loadflow.journal.models.composed.kernels._gap_kernels import (
    CUBE,
    DRAG,
    FACE_PLANES,
    FLOW,
    MEAN,
    PLANES,
)
from loadflow.journal.models.composed.model import ComposedFilm
from loadflow.journal.models.composed.strips import made_in_film, passed_on, shares_of, strip_edges
from loadflow.journal.models.composed.supply import parted_at
from loadflow.journal.models.composed.uneven import Thickness
from loadflow.journal.models.ring import Ring
from loadflow.journal.solvers.newton import Solution
from loadflow.journal.solvers.warm.position import WarmFilm, coupled

Array = NDArray[np.float64]
Kind = TypeVar("Kind")

SHARP = 1e-12
"""Tolerance of films between fields of temperature: what they leave keeps these from settling."""
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

    @property
    def whole_z(self) -> Array:
        """Places of the strips across the whole width, shaft radii."""
        return np.append(-self.z[::-1], self.z) if self.mirrored else self.z

    @property
    def way(self) -> None:
        """None: its columns go all round, those of grooves between segments among them."""

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

    def require_gap(self) -> None:
        """Refuse a shaft that has grown into its shell.

        Raises
        ------
        loadflow.errors.SolverError
            By how much it has grown.
        """
        closes, clearance = -float(self._grown.min()), self._clearance
        if closes >= clearance:
            raise SolverError(
                f"the shaft has grown into its shell: by {closes:.3g} m of {clearance:.3g}"
            )

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


class Tried(NamedTuple, Generic[Kind]):
    """A film on the points of one level at given temperatures.

    Attributes
    ----------
    film
        As its maker tells it.
    solution : Solution
        The same as films of the grid are told.
    made : Made, optional
        What it carries and makes; None: there is no film.
    left : bool
        Whether its pressure asks for more points across.
    level : int
        Of these points.
    """

    film: Kind
    solution: Solution
    made: Made | None
    left: bool
    level: int


def with_heat(
    equation: StripFilm,
    levels: Sequence[int],
    film_at: Callable[[int], Tried[Kind]],
    last: tuple[Solution, Warmth] | None,
) -> tuple[Tried[Kind] | None, WarmFilm]:
    """Film and temperatures that agree, on the points of the first level that resolves it.

    They begin from those of `last`, or from cold oil; there is no film where that has grown shut.
    """
    kept: list[Tried[Kind]] = []
    for level in levels:

        def film_of(before: Solution | None, level: int = level) -> Solution:
            kept[:] = [film_at(level)]
            return kept[0].solution

        def heat_of(film: Solution, cells: Array) -> Warmth:
            made = kept[0].made
            assert made is not None  # the film has converged
            return equation.of([made], cells)

        found = coupled(equation, film_of, last, heat_of)
        if not (found.converged and kept[0].left and found.warmth is not None):
            break
        last = found.solution, found.warmth
    return (kept[0] if kept else None), found
