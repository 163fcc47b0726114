"""The discrete film at one position of the shaft: balance, linearisation, integrals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import DFILL, DLOAD, DP, FILL, LOAD, SLACK, CavitationLaw, P
from loadflow.journal.film import _band_kernels as band_kernel
from loadflow.journal.film import _kernels as kernel
from loadflow.journal.film._kernels import HM
from loadflow.journal.film.gap.asperity_load import AsperityLoad, Touch
from loadflow.journal.film.gap.gap import Gap, turning_frame
from loadflow.journal.film.groove_pressure import Pockets
from loadflow.journal.film.linearised import Linear, SingularFilm
from loadflow.journal.film.thickening import Thickening
from loadflow.journal.turbulence import Regime

Array = NDArray[np.float64]
Factors = tuple[Array, int, NDArray[np.int32]]
"""A factorised matrix: its band, the half width of that, and the rows that were exchanged."""

AXIS = 1e-8  # eccentricity ratio below which a film that turns with the shaft is linear in it
_CELLS = 0.6  # of the width of the narrowest gap, the widest cell around that resolves it

EVERY = slice(None)  # all degrees of freedom
_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])  # a quarter turn with the rotation


class DiscreteFilm:
    """Film of one bearing, lubricant and law on one mesh; holds the work arrays.

    Positions are in clearances, velocities in clearances per second, pressures in Pa.

    Parameters
    ----------
    gap : Gap
        Gap on its mesh.
    law : CavitationLaw
        Law of the ruptured film.
    viscosity, relative_clearance, radius : float
        η (Pa s), ψ, shaft radius (m).
    edge_pressure : float
        Pressure at the bearing ends and on the inlet line, Pa, absolute.
    pockets : Pockets
        Grooves and what feeds them.
    end_pressure : float, optional
        Pressure of the grooves at both ends of a film that does not run round, Pa; without one
        an open film ends on the inlet line.
    """

    def __init__(
        self,
        gap: Gap,
        law: CavitationLaw,
        viscosity: float,
        relative_clearance: float,
        radius: float,
        edge_pressure: float,
        pockets: Pockets,
        end_pressure: float | None = None,
    ) -> None:
        self.gap = gap
        self.mesh = mesh = gap.mesh
        self.law = law
        self.address, self.numbers = law.address, np.array(law.numbers, dtype=float)
        self.ruptures = law.ruptures
        self.p_edge = float(edge_pressure)
        self.p_line = self.p_edge if end_pressure is None else float(end_pressure)
        self.ends_supply = end_pressure is not None and not gap.mesh.closed
        self.line_fill = float(law.fill_at(self.p_line))
        self.thickening: Thickening | None = None  # of a viscosity that rises with pressure
        self.radius = radius
        self.relative_clearance = relative_clearance
        self.viscosity = viscosity
        self.slope = 12.0 * viscosity / relative_clearance**2  # squeeze pressure per d(FH)/dt
        self.pockets = pockets
        self.fixed = self.grooved = pockets.fixed  # cells held, and those of them without drag
        self.given = pockets.given(edge_pressure)
        self.lifts = pockets.lifts(edge_pressure)  # whether the supply may carry a load at rest
        self.regime: Regime | None = None  # of a flow that may be turbulent
        self.set_scale(0.0)
        self.set_speed(0.0)

        nx, nz = mesh.shape
        self.ab = band_kernel.band_storage(nx * nz, mesh.bandwidth)
        self._still = np.zeros((len(gap.coefs), nx, gap.across.shape[1]))  # growth at rest
        self.state = np.empty((8, nx, nz))
        self.elastic, self.softness = False, 0.0  # if the gap follows p; share of its compliance
        self.mirrors = 2.0 if mesh.half else 1.0
        self.unit = self.mirrors * radius**2  # of loads
        self.ambient: Array | float = 0.0  # of `_load`: what acts outside the film, N
        self.contact: AsperityLoad | None = None  # of rough surfaces, which may touch
        self.sheared_by_fill = False  # whether friction counts the share of liquid, not the gap
        self.whole: Any = None  # what `rigid_cylinder` has handed over

    def driving(self, pressure: Any) -> Any:
        """What drives the flow at a pressure, Pa: it, or less where that thickens the liquid."""
        return pressure if self.thickening is None else self.thickening.liquid.driving(pressure)

    @property
    def edges(self) -> tuple[float, float, float]:
        """What drives the flow at the bearing ends and the line, Pa, and the fill there."""
        plain = self.p_edge, self.p_line, self.line_fill
        return plain if self.thickening is None else self.thickening.edges

    @property
    def pressures(self) -> tuple[Array, Array]:
        """Pressure of the cells, of law and film, and its derivative by the unknowns."""
        own = self.thickening
        return (self.state[P], self.state[DP]) if own is None else (own.pressure, own.slope)

    def set_speed(self, speed: float) -> None:
        """Set the speed of the shaft, rad/s."""
        self.speed = speed
        self.wedge = 0.5 * self.slope * speed
        if self.regime is not None:
            self.gap.regime = self.regime.at(speed)

    def set_scale(self, rate: float) -> None:
        """Set the scale of pressure and unknowns, Pa, from the largest speed or squeeze, 1/s."""
        feed = self.pockets.feed
        fed = max(feed.largest_pressure, feed.largest_flow / self.pockets.flow_unit)
        self.scale = max(0.5 * self.slope * rate, self.p_edge, fed, 1.0)

    def fill(self, columns: NDArray[np.bool_], pressure: float) -> None:
        """Make `columns` (nx,) of cells a groove at `pressure`, Pa."""
        self.given = np.where(columns[:, None] & ~self.grooved, pressure, self.given)
        self.fixed = self.grooved = self.grooved | columns[:, None]

    def unload(self, columns: NDArray[np.bool_]) -> None:
        """Hold `columns` (nx,) of cells at edge pressure: pads without load."""
        self.fixed = self.grooved | columns[:, None]

    def raise_scale(self, pressure: float) -> None:
        """Raise the scale of pressure to at least `pressure`, Pa."""
        self.scale = max(self.scale, pressure)

    # --- state -----------------------------------------------------------------------------------
    def unknown_of(self, pressure: Array) -> Array:
        """Unknowns of a (not ruptured) pressure field."""
        return self.law.unknown_of(pressure, self.scale)

    def start(self) -> Array:
        """Unknowns of a film at edge pressure everywhere but in the grooves."""
        return self.unknown_of(self.given)

    def place(self, u: Array, position: Array) -> Array:
        """Evaluate law and gap at `u` and `position`; returns the axes of the mesh's frame."""
        self._apply_law(u)
        return self.gap.place(position)

    def _apply_law(self, u: Array) -> None:
        """Fill `state` from the unknowns `u`."""
        u = np.ascontiguousarray(u)
        kernel.apply_law(self.address, self.numbers, self.scale, u, self.state)
        if self.law.moves_by_cells and self.pockets.free.size:
            self._keep_full(u)
        if self.thickening is not None:
            self.thickening.apply(self.state)

    def _keep_full(self, u: Array) -> None:
        """Keep the free grooves full: the complementarity has no row for their pressure."""
        cells = self.pockets.free_cells
        for row, value in ((P, u[cells]), (DP, 1.0), (SLACK, 0.0)):
            self.state[row][cells] = value
        self.state[LOAD][cells], self.state[DLOAD][cells] = u[cells], 1.0

    # --- balance ---------------------------------------------------------------------------------
    def storage(self, coefs: Array, modes: Array, velocity: Array, rate: float) -> Array:
        """Growth of the gap volume of each cell, (l, nx, rows), Pa, by coefficients and modes.

        Of these, (l, …) and (≥ 1, m, nx), the first are those of the gap, others their derivatives.
        """
        if rate == 0.0 and not velocity.any():
            return self._still[: len(coefs)]
        gap = self.gap
        growth = rate * coefs[:, HM, :-1, : gap.across.shape[1]]
        for one, around in zip(growth, modes):
            moving = (around.T * velocity) @ gap.across
            if gap.open_share is not None:
                moving *= gap.open_share
            one -= moving
        growth *= self.slope
        return growth

    def balance(
        self,
        coef: Array,
        mass: Array,
        change: Array | None = None,
        out: Array | None = None,
    ) -> Array:
        """Outflow of every cell (nx, nz) at the state last placed, or by a `change` of it.

        It is added to `out`, zeros by default.
        """
        mesh = self.mesh
        field = np.zeros(mesh.shape) if out is None else out
        state, edges = (self.state, self.edges) if change is None else (change, (0.0, 0.0, 0.0))
        kernel.balance(
            state, coef[None], mesh.cells, mesh.closed, self.wedge, edges,
            mass[None], self.fixed, field[None],
        )  # fmt: skip
        return field

    def residual(self, outflow: Array) -> Array:
        """Balance of every cell (nx, nz) of which `outflow` leaves, after `place`."""
        field = outflow + self.state[SLACK]
        field[self.fixed] = 0.0
        return field

    @np.errstate(over="ignore", invalid="ignore")  # of an iteration that diverges
    def linearise(
        self,
        u: Array,
        position: Array,
        velocity: Array,
        rate: float = 0.0,
        old: Array | float = 0.0,
        damped: bool = True,
    ) -> Linear:
        """Newton matrix of the film at `u`, factorised, and what follows from it.

        Parameters
        ----------
        u : array (nx, nz)
            Unknowns.
        position, velocity : array (2,)
            Shaft centre, clearances, and its velocity, clearances per second.
        rate : float
            1/s; with `old` it makes the storage ``rate · F H − old`` of an implicit step.
        old : array (nx, nz)
            Storage of earlier times.
        damped : bool
            Whether the derivatives by velocity are asked, which a step at rest does not need; else
            `damping` is 0 and `columns` have none.
        """
        mesh, gap, free = self.mesh, self.gap, self.pockets.free
        frame = self.place(u, position)
        local = frame.T @ velocity if mesh.polar else velocity
        modes = gap.slopes(position)
        growth, moves = self.storage(gap.coefs, modes, local, rate), len(gap.coefs)
        fields = np.zeros((moves + (gap.size if damped else 0), *mesh.shape))
        kernel.balance(
            self.state, gap.coefs, mesh.cells, mesh.closed, self.wedge, self.edges, growth,
            self.fixed, fields,
        )  # fmt: skip
        if rate != 0.0:
            fields[0] -= old
        self._assemble(growth[0], rate)
        self._add_following(fields[1:moves])
        columns = np.empty((len(fields) + free.size, mesh.angle.size * mesh.z.size))
        kernel.right_hand_sides(
            self.state, fields, moves, modes[0], gap.across, self.slope, mesh.area, gap.open_share,
            mesh.order, self.fixed, columns,
        )  # fmt: skip
        lacks = float(np.abs(columns[0]).max())
        flows = [self.pockets.flows(field)[free] for field in fields] if free.size else []
        for column, number in zip(columns[len(fields) :], free):
            kernel.gather(1.0 * (self.pockets.numbers == number), mesh.order, column)
            column *= self.ab[:, 2 * mesh.bandwidth]  # by what `jacobian` has held the cells
        factors = self.ab, mesh.bandwidth, np.empty(len(self.ab), dtype=np.int32)
        if singular := band_kernel.factorise(*factors):
            why = f"film matrix is singular in row {singular} at eccentricity {position}"
            raise SingularFilm(why)
        self._solve(factors, columns)
        if damped:
            self._add_shell_squeeze(factors, columns, gap.size)
        if free.size:
            columns = self._freed(columns, np.array(flows), growth[0])

        carried, loads = self.unit * self._carried(columns), self.unit * self._loads(modes)
        load = loads[0] - self.ambient - carried[0]
        if not math.isfinite(float(load.sum())):
            raise SingularFilm(f"film matrix has no solution at eccentricity {position}")
        direct = (loads[1:] if len(modes) > 1 else 0.0) - carried[1:moves]
        damping = -carried[moves:].T if damped else np.zeros((gap.size, gap.size))
        stiffness = direct.T
        if mesh.polar:
            ratio = math.hypot(*position.tolist())
            if ratio < AXIS:
                sideways = _TURN @ direct[0]
            else:
                sideways = (_TURN @ load - damping @ (_TURN @ local)) / ratio
            load, damping = frame @ load, frame @ damping @ frame.T
            stiffness = frame @ np.array([direct[0], sideways]).T @ frame.T
        if self.contact is not None:
            touch = self._touched(self.contact, position)
            load, stiffness = load + touch.load, stiffness + touch.stiffness
        return Linear(load, stiffness, damping, columns, lacks)

    def _assemble(self, mass: Array, rate: float) -> None:
        """Write the Newton matrix at the state last placed into the band."""
        mesh = self.mesh
        kernel.jacobian(
            self.state, self.gap.coef, mesh.cells, mesh.closed, self.wedge,
            mass, mesh.order, self.fixed, mesh.bandwidth, self.ab,
        )  # fmt: skip

    def _solve(self, factors: Factors, columns: Array) -> None:
        """Solve the Newton matrix for each of `columns` (l, n), in place."""
        band_kernel.substitute(*factors, columns)

    def _add_shell_squeeze(self, factors: Factors, columns: Array, size: int) -> None:
        """Let the derivatives by velocity know what else moves with the shaft: nothing, if rigid.

        After the Newton step, `columns` hold `size` derivatives by position and `size` by velocity.
        """

    def _add_following(self, fields: Array) -> None:
        """Let derivatives of the balance by position have gaps that follow it: none if rigid."""

    def _freed(self, columns: Array, direct: Array, mass: Array) -> Array:
        """Let the pressure of the free grooves follow their flow in all `columns`."""
        pockets, mesh = self.pockets, self.mesh
        change = np.zeros_like(self.state)
        through = np.empty((columns.shape[0], pockets.free.size))
        for row, column in zip(through, columns):
            field = column.reshape(mesh.shape)[mesh.order]
            change[P] = self.state[DP] * field
            change[FILL] = self.state[DFILL] * field
            change[LOAD] = self.state[DLOAD] * field
            outflow = self.balance(self.gap.coef, mass, change)
            row[:] = pockets.flows(outflow)[pockets.free]
        pressure, slope = (pockets.of_free(field) for field in self.pressures)
        return pockets.eliminate(columns, direct, through, pressure, slope, self.scale)

    def _carried(self, columns: Array) -> Array:
        """Change of ∫ p N_j dA by each of `columns` (l, n), (l, m), in units of R²."""
        gap, mesh = self.gap, self.mesh
        carried = np.empty((columns.shape[0], gap.size))
        slope = self.state[DLOAD]
        kernel.carried_by(slope, gap.around, gap.across, mesh.dz, mesh.order, columns, carried)
        return carried

    def _loads(self, around: Array) -> Array:
        """∫ p N_j dA at the state last placed, (l, m) in units of R², for modes (l, m, nx)."""
        out = np.empty(around.shape[:2])
        kernel.load_of(self.state[LOAD], around, self.gap.across, self.mesh.dz, out)
        return out

    def _touched(self, contact: AsperityLoad, position: Array) -> Touch:
        """What the asperities carry at the state last placed, whose `_carried` is known."""
        return contact.at(position)

    def load_of(self, frame: Array, position: Array) -> Array:
        """Load of film and asperities at the state last placed, N."""
        load = frame @ (self.unit * self._loads(self.gap.around[None])[0] - self.ambient)
        return load if self.contact is None else load + self.contact.at(position).load

    # --- what Newton needs -----------------------------------------------------------------------
    @property
    def moves(self) -> int:
        """Number of `Linear.columns` that are derivatives by the position."""
        return 1 if self.mesh.polar else self.gap.size

    def weights(self, position: Array, velocity: Array, target: Array, speed: Array) -> Array:
        """Weights of `Linear.columns` in a step to position `target` and velocity `speed`."""
        if not self.mesh.polar:
            return np.concatenate([[1.0], target - position, speed - velocity])
        far = math.hypot(*target) - math.hypot(*position)
        turned = turning_frame(target).T @ speed - turning_frame(position).T @ velocity
        return np.array([1.0, far, *turned])

    def size(self, column: Array) -> float:
        """Largest entry of a change of the unknowns over the pressure of the film."""
        return float(np.abs(column).max()) / max(self.scale, float(self.state[LOAD].max()))

    def correct(self, u: Array, columns: Array, weights: Array, fills: bool = False) -> float:
        """Apply a Newton step to `u`, if it `fills` by the law's `filling`; its largest change."""
        filling = self.law.filling(self.scale, limited=fills)
        return kernel.correct(u, columns, weights, self.mesh.order, *filling) / self.scale

    def relax(self, share: float = 1.0) -> None:
        """Undo what pressure has deformed; the shell then has a `share` of its compliance.

        A rigid shell does not deform.
        """

    @property
    def deformation(self) -> Array:
        """Growth of the gap of the cells by the last pressure, (nx, nz), m."""
        return np.zeros(self.mesh.shape)

    def clearance_left(self, position: Array) -> float:
        """Narrowest gap over the clearance, that between cells included; no limit if rigid."""
        return math.inf

    def narrowest(self, u: Array, position: Array) -> float:
        """Narrowest gap over the clearance at any unknowns `u` and `position`."""
        return self.gap.narrowest(position)

    def newton_steps(self, most: int) -> int:
        """Newton steps to allow, at least `most`: a rupture that moves by cells needs one each."""
        return max(most, self.mesh.shape[0]) if self.law.moves_by_cells else most

    def target(self, position: Array, step: Array) -> Array:
        """Where a step of the shaft may lead, before `step_share` shortens it."""
        return self.gap.advance(position, step)

    def step_share(
        self, u: Array, columns: Array, weights: Array, way: tuple[Array, Array], fills: bool
    ) -> float:
        """Share of a Newton step, as `correct` applies it, that leaves a film; `way`: from, to."""
        if self.thickening is None:
            return 1.0
        return self.thickening.share(u, weights[0] * columns[0].reshape(u.shape)[self.mesh.order])

    def load_scale(self, force: Array) -> float:
        """Scale of what is missing of the load, N."""
        return max(math.hypot(*force), self.scale * self.radius**2 * 1e-3)

    def liquid(self) -> Array:
        """Liquid in each cell (nx, nz) times the squeeze pressure, Pa s, at the last state."""
        volume = self.gap.coef[kernel.HM, :-1, : self.gap.across.shape[1]] * self.mesh.area
        return self.slope * self.state[FILL] * volume

    def stock(self) -> tuple[float, float]:
        """Liquid outside the grooves, m³, and what it gains over ends and grooves, m³/s."""
        mass = np.zeros((self.mesh.shape[0], self.gap.across.shape[1]))
        outflow = self.balance(self.gap.coef, mass)
        free = ~self.fixed
        unit = self.pockets.flow_unit
        return unit * float(self.liquid()[free].sum()), -unit * float(outflow[free].sum())

    def resolves(self, position: Array) -> bool:
        """Whether the cells resolve the narrowest gap, which is about √(2 (1 − ε)) rad wide.

        Where they do not, Newton may well converge, to an ε that depends on where the cells lie.
        """
        cell = 2 * np.pi / self.mesh.shape[0]
        gap = max(1 - min(math.hypot(*position), 1.0), self.gap.roughness)
        return bool(cell <= _CELLS * math.sqrt(2 * gap))

    # --- results ---------------------------------------------------------------------------------
    def dry(self, u: Array) -> bool:
        """Whether a fed groove would have to rupture, which only laws with fill can follow."""
        empty = self.pockets.of_free(u) < self.law.floor
        return not self.law.keeps_fill and bool(np.any(empty))

    def field(self, u: Array, position: Array) -> tuple[Array, Array, Array, Array]:
        """Pressure (Pa) and fill of the cells (nx, nz), their angle (nx,), and the load (N)."""
        frame = self.place(u, position)
        load = self.load_of(frame, position)
        angle = self.mesh.angles(position)
        return self.state[LOAD].copy(), self.state[FILL].copy(), angle, load
