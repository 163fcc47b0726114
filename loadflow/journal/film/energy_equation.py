"""Energy equation of a film over its area, of its mean temperature across the gap.

    ρ c_p ∇·(q T) = dissipation − α_shell (T − T_shell) − α_shaft (T − T_shaft)

by upwind finite volumes on the cells of the film. What flows over a face has the temperature of the
cell, groove or surroundings that it comes from. T is that of the surfaces, which with three points
across differs from the mean (`surface_temperatures`). Dissipation is that of shear, by the share of
liquid of a cell, of pressure, and of asperities that rub. The viscosity follows the temperature
within the solution; flows and gap are given.

Every groove is a volume in which all mixes: with q_out of the hot oil that flows into it and q_in
that it gives, λ' = min(λ, q_in/q_out), it has T_in = [λ' q_out T_out + (q_in − λ' q_out) T_sup] /
q_in.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.cavitation import FILL
from loadflow.journal.film import _energy_kernels as kernel
from loadflow.journal.film import _kernels as coefficient
from loadflow.journal.film.asperity_load import NodeLoad
from loadflow.journal.film.energy_balance import FRESH, Flows, HeatBalance, Volumes, sparse
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap_warm import AcrossFilm, WarmGap
from loadflow.journal.film.ring_growth import RingExpansion
from loadflow.journal.film.surface_temperatures import Across, Surfaces
from loadflow.journal.heat import HOTTEST, FilmHeat

if TYPE_CHECKING:
    from scipy.sparse import csc_matrix

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]

_STEPS = 60  # Newton steps of the temperatures
_EXACT = 1e-11  # of the largest temperature, a change that is none
_BURNT = 700.0  # K, beyond which no temperature is looked for


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


class EnergyEquation:
    """Energy equation of a film with a `WarmGap`.

    Parameters
    ----------
    film : DiscreteFilm
        Film; its speed may change.
    gap : WarmGap
        Its gap.
    heat : FilmHeat
        Oil and cooling.
    """

    def __init__(self, film: DiscreteFilm, gap: WarmGap, heat: FilmHeat) -> None:
        self.film, self.gap, self.heat = film, gap, heat
        film.sheared_by_fill = True  # heat is made where there is oil, and friction is that heat
        self.wet = ~film.grooved
        self._cells = np.full(film.mesh.shape, FRESH, dtype=np.int64)
        self.size = int(self.wet.sum())
        self._cells[self.wet] = np.arange(self.size)
        labels = _grooves(film)
        self.grooves = int(labels.max()) + 1
        self._cells[~self.wet] = self.size + labels[~self.wet]
        self._line = FRESH
        if film.ends_supply:
            self._line = self.size + self.grooves
            self.grooves += 1
        area = film.mirrors * film.radius**2 * np.outer(film.mesh.dx, film.mesh.dz)
        self.volumes = Volumes(area[self.wet], self.grooves, moments=heat.points == 4)
        self._shaft = heat.inlet_temperature  # of the last solution, as the moments are
        self._skew: Array | float = 0.0
        clearance = film.relative_clearance * film.radius
        self._surfaces = Surfaces.of(heat, np.full(self.size, clearance))
        grows = heat.growth is not None
        self._expansion = RingExpansion(heat, film.mesh, film.radius) if grows else None

    def state(self, warmth: Warmth | None) -> Array:
        """Temperatures, K, by which the film is as it is; without `warmth` those of cold oil.

        Those of the cells, and of a shaft that grows.
        """
        if warmth is None:
            cold = self.heat.inlet_temperature
            cells, shaft = np.full(self.film.mesh.shape, cold), self.heat.shaft_temperature or cold
        else:
            cells, shaft = warmth.cells, warmth.shaft
        return cells.ravel() if self._expansion is None else np.append(cells, shaft)

    def cells_of(self, state: Array) -> Array:
        """Temperatures of the cells (nx, nz) in a `state`, K."""
        shape = self.film.mesh.shape
        return state[: shape[0] * shape[1]].reshape(shape)

    def thicken(self, state: Array) -> None:
        """Give the film the viscosity and the growth of its cells at the temperatures `state`."""
        temperature = self.cells_of(state)
        plain = self.heat.liquid.viscosity(temperature) / self.film.viscosity
        every = AcrossFilm(plain, plain.copy(), np.ones_like(plain))
        if self._expansion is not None:
            self._shaft = float(state[-1])
        across = self._viscosity(temperature[self.wet], self._shaft, self._skew)
        for all_, wet in zip(every, across.film):
            all_[self.wet] = wet
        self.gap.thicken(every)
        if self._expansion is not None:
            shell = temperature.copy()
            shell[self.wet] = self._surfaces.shell.at(shell[self.wet], self._shaft, self._skew)
            growth = self._expansion.of(shell, self._shaft)
            self.gap.expand(growth / (self.film.relative_clearance * self.film.radius))

    @property
    def growth(self) -> Array:
        """Growth of the gap of the cells by heat, (nx, nz), m."""
        return self.gap.expansion * (self.film.relative_clearance * self.film.radius)

    @property
    def mean_growth(self) -> float:
        """The same on average over the cells, m."""
        mesh = self.film.mesh
        return float(np.average(self.growth, weights=np.outer(mesh.dx, mesh.dz)))

    def solve(self, u: Array, position: Array, guess: Array) -> Warmth:
        """Temperatures of the film at unknowns `u` and `position`, as `solve_mean` of one."""
        return self.solve_mean([(u, position, self.film.speed)], guess)

    def solve_mean(self, films: Sequence[tuple[Array, Array, float]], guess: Array) -> Warmth:
        """Temperatures in balance with the mean of the heat that some films make and carry.

        Parameters
        ----------
        films : sequence of (array (nx, nz), array (m,), float)
            Unknowns of the film, position of the shaft in clearances, and speed, rad/s.
        guess : array (nx, nz)
            Temperatures to start from, K.

        Raises
        ------
        loadflow.errors.SolverError
            No temperature is found.
        """
        heat, film = self.heat, self.film
        clearance = film.relative_clearance * film.radius
        unit = film.mirrors * film.viscosity * film.radius**4 / clearance
        each: list[Flows] = []
        gaps, sheared, pumped = (np.zeros(self.size) for _ in range(3))
        for u, position, speed in films:
            film.set_speed(speed)
            own, shear, lost = self._given(u, position)
            each.append(own)
            sheared += unit * speed**2 * shear / len(films)
            pumped += (lost + self._rubbed(position)) / len(films)
            gaps += clearance * self.gap.means[self.wet] / len(films)
        flows = Flows.mean(each)
        self._surfaces = Surfaces.of(heat, gaps)
        volumes, size = self.volumes, self.size
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
        return self._told(t, flows, sheared, pumped, residual)

    # --- inside ----------------------------------------------------------------------------------
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

    def _given(self, u: Array, position: Array) -> tuple[Flows, Array, Array]:
        """Flows; shear and dissipation by pressure of the wet cells."""
        film, mesh = self.film, self.film.mesh
        film.place(u, position)
        nx, nz = mesh.shape
        around, across = np.empty((nx + 1, nz)), np.empty((nx, nz + 1))
        lost = np.empty((nx, nz))
        kernel.flows(
            film.state, self.gap.coef, mesh.dz, mesh.area, mesh.gz, mesh.closed, film.wedge,
            film.p_edge, film.p_line, film.line_fill, film.grooved, around, across, lost,
        )  # fmt: skip
        fill = film.state[FILL].copy()
        dragged = self._dragged(film.state[FILL])
        self._drag_through(around, across, dragged, lost, fill)
        unit = film.pockets.flow_unit
        flows = self._numbered(unit * around, unit * across, unit * dragged)
        shear = (fill * self.gap.shear * mesh.dz)[self.wet]
        return flows, shear, unit * lost[self.wet]

    def _rubbed(self, position: Array) -> Array | float:
        """Heat that asperities make in the wet cells, W; 0 of smooth surfaces."""
        film = self.film
        if film.contact is None:
            return 0.0
        asperities = cast("NodeLoad", film.contact)
        sliding = abs(film.speed) * film.radius
        normal = asperities.forces(position)[self.wet]
        return np.asarray(asperities.contact.coefficient * sliding * normal)

    def _dragged(self, fill: Array) -> Array:
        """Flow over every face around, (nx + 1, nz), that the shaft drags along."""
        film, rows = self.film, self.film.mesh.shape[1]
        every = film.wedge * self.gap.coef[coefficient.E, :, :rows] * film.mesh.area
        line = np.full((1, rows), film.line_fill)
        first, last = (fill[-1:], fill[:1]) if film.mesh.closed else (line, line)
        upstream = np.concatenate([first, fill] if film.wedge > 0 else [fill, last])
        if film.mesh.closed:
            every[-1] = 0.0
        return np.asarray(every * upstream)

    def _drag_through(
        self, around: Array, across: Array, dragged: Array, lost: Array, fill: Array
    ) -> None:
        """Let no more oil through the film of a pad without load than its narrowest place drags.

        Its pressure is held, so that its balance of mass is nobody's. Changes all arrays.
        """
        film = self.film
        idle = np.asarray((film.fixed & ~film.grooved).any(axis=1))
        if not idle.any():
            return
        across[idle], lost[idle] = 0.0, 0.0
        rows = film.mesh.shape[1]
        every = film.wedge * self.gap.coef[coefficient.E, :, :rows] * film.mesh.area
        edges = np.flatnonzero(np.diff(np.concatenate([[False], idle, [False]]).astype(int)))
        for first, end in edges.reshape(-1, 2):
            faces, cells = slice(first, end + 1), slice(first, end)
            least = np.abs(every[faces]).argmin(axis=0)
            through = every[faces][least, np.arange(rows)]
            around[faces] = dragged[faces] = through
            within = 0.5 * (every[first:end] + every[first + 1 : end + 1])
            fill[cells] = through / np.where(within == 0.0, 1.0, within)

    @cached_property
    def _faces(self) -> tuple[Numbers, Numbers]:
        """Numbers of the volumes before and behind all faces."""
        cells, (nx, nz) = self._cells, self.film.mesh.shape
        line = np.full((1, nz), self._line)
        before = np.concatenate([cells[-1:] if self.film.mesh.closed else line, cells])
        behind = np.concatenate([cells, line])
        side = np.full((nx, 1), FRESH)
        low = np.concatenate([before.ravel(), np.hstack([side, cells]).ravel()])
        high = np.concatenate([behind.ravel(), np.hstack([cells, side]).ravel()])
        return low, high

    def _numbered(self, around: Array, across: Array, dragged: Array) -> Flows:
        """Flows between volumes; those inside one groove left out."""
        low, high = self._faces
        flow = np.concatenate([around.ravel(), across.ravel()])
        drag = np.append(dragged.ravel(), np.zeros(across.size))
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


def _grooves(film: DiscreteFilm) -> Numbers:
    """Number of the groove of each cell (nx, nz), those of a supply first; −1 for none."""
    labels = film.pockets.numbers.astype(np.int64).copy()
    own = film.grooved & ~film.pockets.fixed
    columns = np.asarray(own.any(axis=1))
    starts = columns & ~np.append(np.zeros(1, dtype=bool), columns[:-1])
    run = np.cumsum(starts) - 1 + film.pockets.count
    return np.where(own, run[:, None], labels)


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
