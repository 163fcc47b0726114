"""Temperatures of the numbered volumes of a film: Newton's method, and where the heat goes.

What a film has beside them, its flows, its gap and what it dissipates, is given; the viscosity
follows the temperatures within the solution.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.warm import AcrossFilm
from loadflow.journal.film.heat.balance import FRESH, Flows, HeatBalance, Volumes, sparse
from loadflow.journal.film.heat.ring_growth import RingExpansion
from loadflow.journal.film.heat.surface_temperatures import Across, Surfaces
from loadflow.journal.heat import HOTTEST, FilmHeat

if TYPE_CHECKING:
    from scipy.sparse import csc_matrix

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]

_STEPS = 60  # Newton steps of the temperatures
_EXACT = 1e-11  # of the largest temperature, a change that is none
_BURNT = 700.0  # K, beyond which no temperature is looked for
_UPWIND = 1.5  # of the first-order change of the friction by upwind temperatures, what bounds it


@dataclass(frozen=True)
class Warmth:
    """Temperatures of a film and where its heat goes; heat is counted from that of fresh oil.

    Attributes
    ----------
    cells : array (nx, nz)
        Temperature of the cells, K; in a groove that of the oil which it gives.
    shell : array (nx, nz)
        Temperature of the shell's surface there, K.
    hottest : float
        Largest temperature of film and surfaces, K.
    shaft : float
        Temperature of the shaft, K.
    grooves : array (g, 2)
        Mean temperatures of the oil that flows into each groove and out of it, K.
    side : float
        Mean temperature of the oil that leaves at the ends, K.
    mean : float
        Mean over the area of the film, K.
    friction, carried, conducted : float
        Dissipation; heat that leaves with the oil, and through shell and shaft, W.
    residual : float
        Largest imbalance of a cell, over the largest term.
    """

    cells: Array
    shell: Array
    hottest: float
    shaft: float
    grooves: Array
    side: float
    mean: float
    friction: float
    carried: float
    conducted: float
    residual: float

    @property
    def imbalance(self) -> float:
        """What is missing of the balance of all heat, over the friction."""
        missing = self.friction - self.carried - self.conducted
        return abs(missing) / max(self.friction, 1e-300)


@dataclass(frozen=True)
class _Balanced:
    """Unknowns in balance with some flows and heat, and the matrix of the last Newton step."""

    t: Array
    flows: Flows
    sheared: Array
    pumped: Array
    matrix: csc_matrix


class Temperatures(ABC):
    """Temperatures of the cells and grooves of a film.

    Parameters
    ----------
    film : DiscreteFilm
        Its viscosity is that of the oil as it enters.
    heat : FilmHeat
        Oil and cooling.
    areas : array (nx, nz)
        Of the cells, m².
    labels : array of int (nx, nz)
        Numbers of the grooves that cells belong to; −1: none.
    grooves : int
        Volumes in which oil mixes, those without cells behind the others.

    Attributes
    ----------
    mirrored : bool
        Whether the cells are those of one half of the width.
    """

    mirrored = False

    def __init__(
        self, film: DiscreteFilm, heat: FilmHeat, areas: Array, labels: Numbers, grooves: int
    ) -> None:
        self.film, self.heat, self.grooves = film, heat, grooves
        self.wet = labels < 0
        self.size = int(self.wet.sum())
        self._cells = self.size + labels
        self._cells[self.wet] = np.arange(self.size)
        self.volumes = Volumes(areas[self.wet], grooves, moments=heat.points == 4)
        self._shaft = heat.inlet_temperature  # of the last solution, as the moments are
        self._skew: Array | float = 0.0
        clearance = film.relative_clearance * film.radius
        self._surfaces = Surfaces.of(heat, np.full(self.size, clearance))
        self._expansion: RingExpansion | None = None
        self._balanced: _Balanced | None = None

    @property
    def shape(self) -> tuple[int, int]:
        """Cells around and across."""
        nx, nz = self._cells.shape
        return nx, nz

    @property
    def growth(self) -> Array:
        """Growth of the gap of the cells by heat, (nx, nz), m: none."""
        return np.zeros(self.shape)

    @property
    def mean_growth(self) -> float:
        """The same on average over the cells beside grooves, m."""
        return float(np.average(self.growth[self.wet], weights=self.volumes.area))

    @property
    @abstractmethod
    def way(self) -> float | None:
        """Speed of the shaft, rad/s; None where its sign does not matter: cells go all round."""

    @abstractmethod
    def thicken(self, state: Array) -> None:
        """Give the film what it has of the temperatures `state`: viscosity, and growth if any."""

    def state(self, warmth: Warmth | None) -> Array:
        """Temperatures, K, by which the film is as it is; without `warmth` those of cold oil.

        Those of the cells, and of a shaft that grows.
        """
        heat = self.heat
        cells = np.full(self._cells.size, heat.inlet_temperature)
        cells = cells if warmth is None else warmth.cells.ravel()
        if self._expansion is None:
            return cells
        cold = heat.shaft_temperature or heat.inlet_temperature
        return np.append(cells, cold if warmth is None else warmth.shaft)

    def cells_of(self, state: Array) -> Array:
        """Temperatures of the cells (nx, nz) in a `state`, K."""
        return state[: self._cells.size].reshape(self.shape)

    def balanced(
        self, flows: Flows, gaps: Array, sheared: Array, pumped: Array, guess: Array
    ) -> Warmth:
        """Temperatures in balance with what a film carries and makes.

        Parameters
        ----------
        flows : Flows
            Between the volumes.
        gaps : array (size,)
            Of the wet cells, m.
        sheared, pumped : array (size,)
            Heat of the wet cells, W: by shear at the film's one viscosity, and what is given.
        guess : array (nx, nz)
            Temperatures to start from, K.

        Raises
        ------
        loadflow.errors.SolverError
            No temperature is found.
        """
        heat = self.heat
        self._surfaces = Surfaces.of(heat, gaps)
        volumes, size = self.volumes, self.size
        self._balanced = None
        if not (sheared.any() or flows.flow.any() or heat.shell_transfer or heat.shaft_transfer):
            return self._told(self._as_supplied(), flows, sheared, pumped, 0.0)
        matrix, rhs = HeatBalance(heat, volumes, self._surfaces, flows).linear()
        t = np.full(volumes.unknowns, heat.inlet_temperature)
        t[:size] = guess[self.wet]
        t[volumes.shaft] = float(np.average(t[:size], weights=volumes.area))
        t[volumes.count :] = self._skew
        residual = np.inf
        for _ in range(_STEPS):
            source, slopes = self._sources(t, sheared, pumped)
            missing = matrix @ t - rhs - source
            largest = max(float(np.abs(source).max()), 1e-300)
            residual = float(np.abs(missing[:size]).max()) / largest
            step = _solved(matrix - slopes, missing)
            # nothing is colder than what is given; from there Newton rises without overshooting
            warm = slice(volumes.count)
            step[warm] = t[warm] - np.maximum(t[warm] - step[warm], heat.coldest)
            t = t - step
            if not float(t[warm].max()) < _BURNT:
                raise SolverError(
                    f"the film gets hotter than {HOTTEST} K: some oil does not leave it"
                )
            if float(np.abs(step).max()) < _EXACT * HOTTEST:
                break
        else:
            raise SolverError(f"temperatures of the film: change {np.abs(step).max():.3g} K left")
        self._shaft, self._skew = float(t[volumes.shaft]), volumes.skew(t)
        self._balanced = _Balanced(t, flows, sheared, pumped, matrix - slopes)
        return self._told(t, flows, sheared, pumped, residual)

    def left_by_cells(self) -> float:
        """Bound of what the cells do to the friction by way of the temperatures last balanced.

        As a share of the friction. What flows over a face has the temperature of the cell that it
        comes from; midway between those on both sides it is of second order. The heat that this
        moves, through the balance of all cells, tells how far the temperatures are off, even where
        little oil leaves and small errors add up.
        """
        last = self._balanced
        if last is None:
            return 0.0
        volumes, size, t = self.volumes, self.size, last.t
        moved = self.heat.volume_heat * last.flows.flow * self._over_faces(t, last.flows)
        gained = np.zeros(volumes.unknowns)
        leaves = (last.flows.source >= 0) & (last.flows.source < size)
        enters = (last.flows.sink >= 0) & (last.flows.sink < size)
        np.add.at(gained, last.flows.source[leaves], -moved[leaves])
        np.add.at(gained, last.flows.sink[enters], moved[enters])
        off = _solved(last.matrix, gained)[:size]
        across = self._viscosity(t[:size], float(t[volumes.shaft]), volumes.skew(t))
        friction = float((last.sheared * across.film.shear + last.pumped).sum())
        changed = float(np.abs(last.sheared * across.by_mean * off).sum())
        return _UPWIND * changed / max(friction, 1e-300)

    # --- inside ----------------------------------------------------------------------------------
    def _over_faces(self, t: Array, flows: Flows) -> Array:
        """How much warmer oil is on the face of each flow than in the cell that it leaves, K.

        Half of the change to the next cell; over a bearing end and into a groove half of that from
        the one before, across and around. Of what is no cell it is known.
        """
        size, source, sink = self.size, flows.source, flows.sink
        every = np.append(t[: self.volumes.count], np.nan)
        cell = (source >= 0) & (source < size)
        between, drags = cell & (sink >= 0) & (sink < size), flows.drag != 0.0
        half = np.where(between, 0.5 * (every[sink] - every[source]), 0.0)
        for last, along in ((cell & (sink == FRESH), ~drags), (cell & (sink >= size), drags)):
            some = between & along
            weights = flows.sums(sink[some], flows.flow[some], size)
            rise = flows.sums(sink[some], flows.flow[some] * half[some], size)
            before = np.divide(rise, weights, out=np.zeros(size), where=weights > 0.0)
            half[last] = before[source[last]]
        return half

    def _at_state(self, state: Array) -> tuple[AcrossFilm, Array | None]:
        """Viscosity of the cells (nx, nz) at the temperatures `state`, and what they grow by, m."""
        temperature = self.cells_of(state)
        plain = np.asarray(self.heat.liquid.viscosity(temperature) / self.film.viscosity)
        every = AcrossFilm(plain, plain.copy(), np.ones_like(plain))
        if self._expansion is not None:
            self._shaft = float(state[-1])
        across = self._viscosity(temperature[self.wet], self._shaft, self._skew)
        for all_, wet in zip(every, across.film):
            all_[self.wet] = wet
        if self._expansion is None:
            return every, None
        shell = temperature.copy()
        shell[self.wet] = self._surfaces.shell.at(shell[self.wet], self._shaft, self._skew)
        return every, self._expansion.of(shell, self._shaft, self.way)

    def _flows(self, low: Numbers, high: Numbers, flow: Array, drag: Array) -> Flows:
        """Flows from volumes `low` to `high`, of either sign; those within one volume left out."""
        if self.volumes.moments:  # between cells, what pressure drives back goes its own way
            size = self.size
            apart = (drag * (flow - drag) < 0.0) & (np.maximum(low, high) < size)
            apart &= np.minimum(low, high) >= 0
            low, high = np.append(low, low[apart]), np.append(high, high[apart])
            flow = np.append(np.where(apart, drag, flow), (flow - drag)[apart])
            drag = np.append(drag, np.zeros(int(apart.sum())))
        some = (flow != 0.0) & (low != high)
        low, high, flow, drag = low[some], high[some], flow[some], drag[some]
        on = flow > 0.0
        way = np.where(on, 1.0, -1.0)
        return Flows(np.where(on, low, high), np.where(on, high, low), way * flow, way * drag)

    def _as_supplied(self) -> Array:
        """Unknowns of a film that stands, makes no heat and passes none on."""
        t = np.zeros(self.volumes.unknowns)
        t[: self.volumes.count] = self.heat.inlet_temperature
        return t

    def _sources(self, t: Array, sheared: Array, pumped: Array) -> tuple[Array, csc_matrix]:
        """Heat made in the cells, its first moment, and their changes by the unknowns."""
        volumes, cells = self.volumes, np.arange(self.size)
        across = self._viscosity(t[: self.size], float(t[volumes.shaft]), volumes.skew(t))
        made = sheared * across.film.shear
        source = np.zeros(volumes.unknowns)
        source[: self.size] = made + pumped
        entries = [(sheared * across.by_mean, cells, cells)]
        if volumes.moments:
            source[volumes.count :] = made * across.moment
            behind = volumes.count + cells
            entries.append((sheared * across.by_skew, cells, behind))
            entries.append((sheared * across.by_mean * across.moment, behind, cells))
            entries.append((sheared * across.by_skew * across.moment, behind, behind))
        shape = (volumes.unknowns, volumes.unknowns)
        values, rows, columns = (np.concatenate(x) for x in zip(*entries))
        return source, sparse(values, rows, columns, shape)

    def _viscosity(self, mean: Array, shaft: float, skew: Array | float) -> Across:
        """Viscosity of the wet cells at their `mean` and `skew`, K."""
        return self._surfaces.viscosity(self.heat, self.film.viscosity, mean, shaft, skew)

    def _told(
        self,
        t: Array,
        flows: Flows,
        sheared: Array,
        pumped: Array,
        residual: float,
    ) -> Warmth:
        """The temperatures `t` by their names, and where the heat goes."""
        heat, size, volumes = self.heat, self.size, self.volumes
        heavy, fresh = heat.volume_heat, heat.inlet_temperature
        surfaces, state = self._surfaces, (t[:size], float(t[volumes.shaft]), volumes.skew(t))
        carried = np.zeros_like(flows.flow)
        driven = flows.flow - flows.drag
        for surface, part in ((surfaces.dragged, flows.drag), (surfaces.pressed, driven)):
            above = np.append(t[: volumes.count] - fresh, 0.0)  # the last one is fresh oil
            above[:size] = surface.at(*state) - fresh
            carried += part * above[flows.source]
        from_cell = (flows.source >= 0) & (flows.source < size)
        leaves = from_cell & ((flows.sink == FRESH) | (flows.sink >= size))
        given = (flows.source >= size) & (flows.sink >= 0) & (flows.sink < size)
        out = heavy * float(carried[leaves].sum() - carried[given].sum())
        shell, turns = surfaces.shell.at(*state), surfaces.shaft.at(*state)
        through = volumes.area * (shell - heat.shell_temperature) * heat.shell_transfer
        through += volumes.area * (turns - t[volumes.shaft]) * heat.shaft_transfer
        between = [one.at(*state) for one in surfaces.between]
        ends = from_cell & (flows.sink == FRESH)
        side = flows.flow[ends].sum()
        grooves = np.full((self.grooves, 2), np.nan)
        for number in range(self.grooves):
            comes = flows.sink == size + number
            if flows.flow[comes].sum() > 0.0:
                grooves[number, 0] = fresh + carried[comes].sum() / flows.flow[comes].sum()
            if (flows.source == size + number).any():
                grooves[number, 1] = t[size + number]
        every = np.append(t[: volumes.count], np.nan)
        return Warmth(
            cells=every[self._cells],
            shell=np.append(shell, every[size:])[self._cells],
            hottest=float(np.max([shell, turns, *between])),
            shaft=state[1],
            grooves=grooves,
            side=fresh + float(carried[ends].sum() / side) if side > 0.0 else fresh,
            mean=float(np.average(t[:size], weights=volumes.area)),
            friction=float((sheared * self._viscosity(*state).film.shear + pumped).sum()),
            carried=out,
            conducted=float(through.sum()),
            residual=residual,
        )


def _solved(matrix: csc_matrix, rhs: Array) -> Array:
    """Solution of a sparse system.

    Raises
    ------
    loadflow.errors.SolverError
        The system has none: nothing takes the heat of some cell.
    """
    from scipy.sparse.linalg import splu

    try:
        found = splu(matrix).solve(rhs)
    except RuntimeError as error:
        raise SolverError("temperatures of the film: nothing takes its heat") from error
    if not np.isfinite(found).all():
        raise SolverError("temperatures of the film: nothing takes its heat")
    return np.asarray(found)
