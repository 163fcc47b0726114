"""Energy equation of a film over its area, of its mean temperature across the gap.

    ρ c_p ∇·(q T) = dissipation − α_shell (T − T_shell) − α_shaft (T − T_shaft)

by upwind finite volumes on the cells of the film. What flows over a face has the temperature of the
cell, groove or surroundings that it comes from. T is that of the surfaces, which with three points
across differs from the mean (`surface_temperatures`). Dissipation is that of shear, by the share of
liquid of a cell, and of pressure. The viscosity follows the temperature within the solution; flows
and gap are given.

Every groove is a volume in which all mixes: with q_out of the hot oil that flows into it and q_in
that it gives, λ' = min(λ, q_in/q_out), it has T_in = [λ' q_out T_out + (q_in − λ' q_out) T_sup] /
q_in.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.cavitation import FILL
from loadflow.journal.film import _energy_kernels as kernel
from loadflow.journal.film import _kernels as coefficient
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap_warm import AcrossFilm, WarmGap
from loadflow.journal.film.surface_temperatures import Surfaces
from loadflow.journal.heat import HOTTEST, FilmHeat

if TYPE_CHECKING:
    from scipy.sparse import csc_matrix

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]

_FRESH = -1  # number of what surrounds the film: oil as it is supplied
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


@dataclass(frozen=True)
class _Flows:
    """Flows between numbered volumes, m³/s, all > 0: from `source` to `sink`."""

    source: Numbers
    sink: Numbers
    flow: Array

    def sums(self, by: Numbers, weights: Array, count: int) -> Array:
        """Sum of `weights` over the flows of each of `count` volumes; those of fresh oil aside."""
        inside = by != _FRESH
        return np.bincount(by[inside], weights[inside], count).astype(float)


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
        self.wet = ~film.grooved
        self._cells = np.full(film.mesh.shape, _FRESH, dtype=np.int64)
        self.size = int(self.wet.sum())
        self._cells[self.wet] = np.arange(self.size)
        labels = _grooves(film)
        self.grooves = int(labels.max()) + 1
        self._cells[~self.wet] = self.size + labels[~self.wet]
        self._line = _FRESH
        if film.ends_supply:
            self._line = self.size + self.grooves
            self.grooves += 1
        self.count = self.size + self.grooves + 1  # the last one is the shaft
        area = film.mirrors * film.radius**2 * np.outer(film.mesh.dx, film.mesh.dz)
        self.area = area[self.wet]
        self._shaft = heat.inlet_temperature  # of the last solution
        clearance = film.relative_clearance * film.radius
        self._surfaces = Surfaces.of(heat, np.full(self.size, clearance))

    def thicken(self, temperature: Array) -> None:
        """Give the film the viscosity of its cells at `temperature` (nx, nz), K."""
        plain = self.heat.liquid.viscosity(temperature) / self.film.viscosity
        every = AcrossFilm(plain, plain.copy(), np.ones_like(plain))
        for all_, wet in zip(every, self._ratio(temperature[self.wet], self._shaft)[0]):
            all_[self.wet] = wet
        self.gap.thicken(every)

    def solve(self, u: Array, position: Array, guess: Array) -> Warmth:
        """Temperatures of the film at `u` and `position`.

        Parameters
        ----------
        u : array (nx, nz)
            Unknowns of the film.
        position : array (m,)
            Of the shaft, clearances.
        guess : array (nx, nz)
            Temperatures to start from, K.

        Raises
        ------
        loadflow.errors.SolverError
            No temperature is found.
        """
        flows, shear, pumped = self._given(u, position)
        heat, film = self.heat, self.film
        clearance = film.relative_clearance * film.radius
        self._surfaces = Surfaces.of(heat, clearance * self.gap.films[self.wet])
        fresh = heat.inlet_temperature
        matrix, rhs = self._linear(flows)
        t = np.append(guess[self.wet], np.full(self.grooves + 1, fresh))
        t[-1] = float(np.average(t[: self.size], weights=self.area))
        diagonal = np.arange(self.count)
        drag = film.mirrors * film.viscosity * film.speed**2 * film.radius**4
        drag /= clearance
        residual = np.inf
        for _ in range(_STEPS):
            across, slope = self._ratio(t[: self.size], float(t[-1]))
            source = np.zeros(self.count)
            source[: self.size] = drag * shear * across.shear + pumped
            by_own = np.zeros(self.count)
            by_own[: self.size] = -drag * shear * slope
            missing = matrix @ t - rhs - source
            size = max(float(np.abs(source).max()), 1e-300)
            residual = float(np.abs(missing[: self.size]).max()) / size
            step = _solved(matrix + _sparse(by_own, (diagonal, diagonal)), missing)
            # nothing is colder than what is given; from there Newton rises without overshooting
            step = t - np.maximum(t - step, heat.coldest)
            t = t - step
            if not float(t.max()) < _BURNT:
                raise SolverError(
                    f"the film gets hotter than {HOTTEST} K: some oil does not leave it"
                )
            if float(np.abs(step).max()) < _EXACT * HOTTEST:
                break
        else:
            raise SolverError(f"temperatures of the film: change {np.abs(step).max():.3g} K left")
        self._shaft = float(t[-1])
        return self._told(t, flows, drag * shear, pumped, residual)

    # --- inside ----------------------------------------------------------------------------------
    def _ratio(self, mean: Array, shaft: float) -> tuple[AcrossFilm, Array]:
        """Viscosity of the wet cells at their `mean`, K, and the change of that under shear."""
        return self._surfaces.viscosity(self.heat, self.film.viscosity, mean, shaft)

    def _given(self, u: Array, position: Array) -> tuple[_Flows, Array, Array]:
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
        self._drag_through(around, across, lost, fill)
        unit = film.pockets.flow_unit
        flows = self._numbered(unit * around, unit * across)
        shear = (fill * self.gap.shear * mesh.dz)[self.wet]
        return flows, shear, unit * lost[self.wet]

    def _drag_through(self, around: Array, across: Array, lost: Array, fill: Array) -> None:
        """Let no more oil through the film of a pad without load than its narrowest place drags.

        Its pressure is held, so that its balance of mass is nobody's. Changes all arrays.
        """
        film = self.film
        idle = np.asarray((film.fixed & ~film.grooved).any(axis=1))
        if not idle.any():
            return
        across[idle], lost[idle] = 0.0, 0.0
        rows = film.mesh.shape[1]
        dragged = film.wedge * self.gap.coef[coefficient.E, :, :rows] * film.mesh.area
        edges = np.flatnonzero(np.diff(np.concatenate([[False], idle, [False]]).astype(int)))
        for first, end in edges.reshape(-1, 2):
            faces, cells = slice(first, end + 1), slice(first, end)
            least = np.abs(dragged[faces]).argmin(axis=0)
            through = dragged[faces][least, np.arange(rows)]
            around[faces] = through
            within = 0.5 * (dragged[first:end] + dragged[first + 1 : end + 1])
            fill[cells] = through / np.where(within == 0.0, 1.0, within)

    @cached_property
    def _faces(self) -> tuple[Numbers, Numbers]:
        """Numbers of the volumes before and behind all faces."""
        cells, (nx, nz) = self._cells, self.film.mesh.shape
        line = np.full((1, nz), self._line)
        before = np.concatenate([cells[-1:] if self.film.mesh.closed else line, cells])
        behind = np.concatenate([cells, line])
        side = np.full((nx, 1), _FRESH)
        low = np.concatenate([before.ravel(), np.hstack([side, cells]).ravel()])
        high = np.concatenate([behind.ravel(), np.hstack([cells, side]).ravel()])
        return low, high

    def _numbered(self, around: Array, across: Array) -> _Flows:
        """Flows between volumes; those inside one groove left out."""
        low, high = self._faces
        flow = np.concatenate([around.ravel(), across.ravel()])
        some = (flow != 0.0) & (low != high)
        low, high, flow = low[some], high[some], flow[some]
        on = flow > 0.0
        return _Flows(np.where(on, low, high), np.where(on, high, low), np.abs(flow))

    def _linear(self, flows: _Flows) -> tuple[csc_matrix, Array]:
        """Matrix and right-hand side of all that is linear in the temperatures."""
        heat, count, size = self.heat, self.count, self.size
        heavy, fresh = heat.volume_heat, heat.inlet_temperature
        to_cell = (flows.sink >= 0) & (flows.sink < size)
        to_groove = flows.sink >= size
        shaft = count - 1
        diagonal, rhs = np.zeros(count), np.zeros(count)

        into = heavy * flows.sums(flows.sink, flows.flow, count)
        diagonal[:size] = into[:size]
        new = to_cell & (flows.source == _FRESH)
        rhs[:size] += heavy * fresh * np.bincount(flows.sink[new], flows.flow[new], count)[:size]
        known = to_cell & (flows.source != _FRESH)
        rows, columns = [flows.sink[known]], [flows.source[known]]
        values = [-heavy * flows.flow[known]]

        given = heavy * flows.sums(flows.source, flows.flow, count)[size:shaft]
        taken = into[size:shaft]
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(taken > 0.0, np.minimum(heat.carry_over, given / taken), 0.0)
        unused = given == 0.0
        diagonal[size:shaft] = np.where(unused, 1.0, given)
        rhs[size:shaft] = np.where(unused, 1.0, given - share * taken) * fresh
        mixed = to_groove & (flows.source != _FRESH)
        number = flows.sink[mixed]
        rows.append(number)
        columns.append(flows.source[mixed])
        values.append(-heavy * np.where(unused, 0.0, share)[number - size] * flows.flow[mixed])
        strange = to_groove & (flows.source == _FRESH)
        number = flows.sink[strange]
        np.add.at(rhs, number, heavy * fresh * share[number - size] * flows.flow[strange])

        every = np.arange(count)
        where = np.concatenate([*rows, every]), np.concatenate([*columns, every])
        moving = _sparse(np.concatenate([*values, diagonal]), where)
        if heat.points > 1:
            given, carried = self._carried()
            rhs -= moving @ given
            moving = moving @ carried
        matrix, warm = self._conducting()
        return moving + matrix, rhs + warm

    def _carried(self) -> tuple[Array, csc_matrix]:
        """Temperatures that flows carry from all volumes, by the means: constant and matrix."""
        size, count = self.size, self.count
        oil, every = self._surfaces.carried, np.arange(count)
        given, mean = np.zeros(count), np.ones(count)
        given[:size], mean[:size] = oil.given, oil.mean
        rows, columns = (
            np.append(every, every[:size]),
            np.append(every, np.full(size, count - 1)),
        )
        return given, _sparse(np.append(mean, oil.shaft), (rows, columns))

    def _conducting(self) -> tuple[csc_matrix, Array]:
        """Matrix and right-hand side of what passes into shell and shaft."""
        heat, count, size = self.heat, self.count, self.size
        shaft, cells = count - 1, np.arange(size)
        shell, turns = self._surfaces.shell, self._surfaces.shaft
        out, into = heat.shell_transfer * self.area, heat.shaft_transfer * self.area
        diagonal, rhs = np.zeros(count), np.zeros(count)
        diagonal[:size] = out * shell.mean + into * turns.mean
        rhs[:size] = -out * (shell.given - heat.shell_temperature) - into * turns.given
        rows, columns = [cells], [np.full(size, shaft)]
        values = [out * shell.shaft + into * (turns.shaft - 1.0)]
        if heat.shaft_temperature is not None:
            diagonal[shaft] = float(self.area.sum())
            rhs[shaft] = diagonal[shaft] * heat.shaft_temperature
        else:  # no net heat passes into it; where none passes at all it is as warm as the film
            conducts = heat.shaft_transfer > 0.0
            rows.append(np.full(size, shaft))
            columns.append(cells)
            values.append(-self.area * (turns.mean if conducts else 1.0))
            diagonal[shaft] = float((self.area * (1.0 - turns.shaft * conducts)).sum())
            rhs[shaft] = float((self.area * turns.given).sum()) * conducts
        every = np.arange(count)
        where = np.concatenate([*rows, every]), np.concatenate([*columns, every])
        return _sparse(np.concatenate([*values, diagonal]), where), rhs

    def _told(
        self,
        t: Array,
        flows: _Flows,
        sheared: Array,
        pumped: Array,
        residual: float,
    ) -> Warmth:
        """The temperatures `t` by their names, and where the heat goes."""
        heat, size, shaft = self.heat, self.size, self.count - 1
        heavy, fresh = heat.volume_heat, heat.inlet_temperature
        above = np.append(t - fresh, 0.0)  # the last one is fresh oil
        above[:size] = self._surfaces.carried.at(t[:size], float(t[shaft])) - fresh
        carried = flows.flow * above[flows.source]
        from_cell = (flows.source >= 0) & (flows.source < size)
        leaves = from_cell & ((flows.sink == _FRESH) | (flows.sink >= size))
        given = (flows.source >= size) & (flows.sink >= 0) & (flows.sink < size)
        out = heavy * float(carried[leaves].sum() - carried[given].sum())
        surfaces, turning = self._surfaces, float(t[shaft])
        shell, turns = (one.at(t[:size], turning) for one in (surfaces.shell, surfaces.shaft))
        through = self.area * (shell - heat.shell_temperature) * heat.shell_transfer
        through += self.area * (turns - turning) * heat.shaft_transfer
        middle = 0.25 * (6 * t[:size] - shell - turns)
        ends = from_cell & (flows.sink == _FRESH)
        side = flows.flow[ends].sum()
        grooves = np.full((self.grooves, 2), np.nan)
        for number in range(self.grooves):
            comes = flows.sink == size + number
            if flows.flow[comes].sum() > 0.0:
                grooves[number, 0] = fresh + carried[comes].sum() / flows.flow[comes].sum()
            if (flows.source == size + number).any():
                grooves[number, 1] = t[size + number]
        cells = np.append(t, np.nan)[self._cells]
        return Warmth(
            cells=cells,
            shell=np.append(np.append(shell, t[size:]), np.nan)[self._cells],
            hottest=float(np.max([shell, turns, middle])),
            shaft=float(t[shaft]),
            grooves=grooves,
            side=fresh + float(carried[ends].sum() / side) if side > 0.0 else fresh,
            mean=float(np.average(t[:size], weights=self.area)),
            friction=float((sheared * self._ratio(t[:size], turning)[0].shear + pumped).sum()),
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


def _sparse(entries: Array, where: tuple[Numbers, Numbers]) -> csc_matrix:
    """Square matrix of entries at (rows, columns), the diagonal among them."""
    from scipy.sparse import csc_matrix  # a film without heat starts sooner

    return csc_matrix((entries, where))


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
