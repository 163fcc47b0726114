"""The discrete film at one position of the shaft: balance, linearisation, integrals."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgbtrf, dgbtrs

from loadflow.errors import SolverError
from loadflow.journal import _kernels as kernel
from loadflow.journal.mesh import GrooveCells, Mesh
from loadflow.journal.options import (
    Cavitation,
    GasMixture,
    Guembel,
    MassConserving,
    Reynolds,
    Sommerfeld,
)

Array = NDArray[np.float64]

_KIND = {
    Sommerfeld: kernel.FULL,
    Guembel: kernel.GUEMBEL,
    Reynolds: kernel.REYNOLDS,
    MassConserving: kernel.MASS_CONSERVING,
    GasMixture: kernel.GAS_MIXTURE,
}
_SHELL = np.eye(2)
_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])  # a quarter turn with the rotation


def _frame(position: Array) -> Array:
    """Axes of the frame that turns with the eccentricity: along it, and a quarter turn on."""
    x, y = position.tolist()
    ratio = math.hypot(x, y)
    cos, sin = (x / ratio, y / ratio) if ratio > 0 else (1.0, 0.0)
    return np.array([[cos, -sin], [sin, cos]])


@dataclass(frozen=True)
class Linear:
    """The film linearised at one state.

    Attributes
    ----------
    load : array (2,)
        ∫ p (cos θ, sin θ) dA after the Newton step of the pressure alone, N.
    stiffness, damping : array (2, 2)
        Derivatives of `load` by position (per clearance) and velocity (clearances per second).
    columns : array (m, n)
        Newton step of the unknowns, and their derivatives by what `Film.weights` lists.
    """

    load: Array
    stiffness: Array
    damping: Array
    columns: Array


class Film:
    """Film of one bearing, lubricant and law on one mesh; holds the work arrays.

    Positions are in clearances, velocities in clearances per second, pressures in Pa.

    Parameters
    ----------
    mesh : Mesh
        Cells of the half film.
    law : Cavitation
        Law of the ruptured film.
    viscosity, relative_clearance, radius : float
        η (Pa s), ψ, shaft radius (m).
    edge_pressure : float
        Pressure at the rims and on the inlet line, Pa, absolute.
    grooves : GrooveCells
        Which cells lie in a groove, and their pressure; (nx, nz) each.
    """

    def __init__(
        self,
        mesh: Mesh,
        law: Cavitation,
        viscosity: float,
        relative_clearance: float,
        radius: float,
        edge_pressure: float,
        grooves: GrooveCells,
    ) -> None:
        self.mesh = mesh
        self.kind = _KIND[type(law)]
        self.ruptures = self.kind != kernel.FULL
        self.mixing = law.mixing_constant if isinstance(law, GasMixture) else 0.0
        self.p_cav = getattr(law, "cavitation_pressure", 0.0)
        self.p_edge = edge_pressure
        self.radius = radius
        self.relative_clearance = relative_clearance
        self.viscosity = viscosity
        self.slope = 12.0 * viscosity / relative_clearance**2  # squeeze pressure per d(FH)/dt
        self.fixed, self.fixed_pressure = grooves
        self.set_scale(0.0)
        self.set_speed(0.0)

        nx, nz = mesh.shape
        n = nx * nz
        self.ab = np.empty((n, 3 * mesh.bandwidth + 1))
        self.state = np.empty((8, nx, nz))
        self.coef = np.zeros((8, nx + 1))
        self.shifted = (np.zeros((8, nx + 1)), np.zeros((8, nx + 1)))

    def set_speed(self, speed: float) -> None:
        """Set the speed of the shaft, rad/s."""
        self.speed = speed
        self.wedge = 0.5 * self.slope * speed

    def set_scale(self, rate: float) -> None:
        """Set the scale of pressure and unknowns, Pa, from the largest speed or squeeze, 1/s."""
        self.scale = max(0.5 * self.slope * rate, self.p_edge, 1.0)

    def raise_scale(self, pressure: float) -> None:
        """Raise the scale of pressure to at least `pressure`, Pa."""
        self.scale = max(self.scale, pressure)

    # --- state -----------------------------------------------------------------------------------
    def unknown_of(self, pressure: Array) -> Array:
        """Unknowns of a (not ruptured) pressure field."""
        if self.kind != kernel.GAS_MIXTURE:
            return np.array(pressure, dtype=float)
        return pressure - self.scale * self.mixing / (pressure + self.mixing)

    def start(self) -> Array:
        """Unknowns of a film at edge pressure everywhere but in the grooves."""
        pressure = np.where(self.fixed, self.fixed_pressure, self.p_edge)
        return self.unknown_of(pressure)

    def place(self, u: Array, position: Array) -> Array:
        """Evaluate law and gap at `u` and `position`; returns the axes of the mesh's frame."""
        kernel.apply_law(self.kind, self.mixing, self.p_cav, self.scale, u, self.state)
        if not self.mesh.polar:
            self._gap(self.coef, 0.0, float(position[0]), float(position[1]))
            return _SHELL
        ratio = math.hypot(*position)
        self._gap(self.coef, self.mesh.strength * ratio, ratio, 0.0)
        return _frame(position)

    def _gap(self, out: Array, stretch: float, ex: float, ey: float) -> None:
        kernel.gap_coefficients(*self.mesh.trigonometry, stretch, ex, ey, out)

    def _slope_of_gap(self, position: Array) -> list[Array]:
        """Derivative of the gap coefficients by the mesh coordinates of the position.

        Central differences of closed forms: the relative error is below 1e-7.
        """
        ex, ey = float(position[0]), float(position[1])
        ratio = float(np.hypot(ex, ey))
        step = 1e-5 * (1.0 - ratio)
        if self.mesh.polar:
            turns = [(1.0, 0.0)]
            ex, ey = ratio, 0.0
        else:
            turns = [(1.0, 0.0), (0.0, 1.0)]
        slopes = []
        plus, minus = self.shifted
        for tx, ty in turns:
            for out, h in ((plus, step), (minus, -step)):
                x, y = ex + h * tx, ey + h * ty
                self._gap(out, self.mesh.strength * x if self.mesh.polar else 0.0, x, y)
            slopes.append((plus - minus) / (2 * step))
        return slopes

    # --- balance ---------------------------------------------------------------------------------
    def _storage(self, coef: Array, velocity: Array, rate: float) -> Array:
        """Growth of the gap volume of each cell, (nx,), Pa."""
        cells = coef[:, :-1]
        moving = velocity[0] * cells[kernel.COS] + velocity[1] * cells[kernel.SIN]
        return self.slope * (rate * cells[kernel.HM] - moving)

    def _balance(self, coef: Array, mass: Array) -> Array:
        mesh = self.mesh
        field = np.zeros(mesh.shape)
        kernel.balance(
            self.state, coef, mesh.dz, mesh.gz, mesh.closed, self.wedge,
            self.p_edge, self.p_edge, 1.0, mass, field,
        )  # fmt: skip
        return field

    def residual(self, u: Array, mass: Array, old: Array | float = 0.0) -> Array:
        """Balance of every cell (nx, nz), after `place`."""
        field = self._balance(self.coef, mass) + self.state[kernel.SLACK]
        field -= old
        field[self.fixed] = 0.0
        return field

    def linearise(
        self,
        u: Array,
        position: Array,
        velocity: Array,
        rate: float = 0.0,
        old: Array | float = 0.0,
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
        """
        mesh = self.mesh
        frame = self.place(u, position)
        local = frame.T @ velocity
        mass = self._storage(self.coef, local, rate)
        slopes = self._slope_of_gap(position)
        kernel.jacobian(
            self.state, self.coef, mesh.dz, mesh.gz, mesh.closed, self.wedge, mass,
            mesh.order, self.fixed, self.ab,
        )  # fmt: skip
        lu, pivots, info = dgbtrf(self.ab.T, mesh.bandwidth, mesh.bandwidth, overwrite_ab=1)
        if info:
            raise SolverError(f"film matrix is singular in row {info} at eccentricity {position}")

        fields = [self.residual(u, mass, old)]
        fields += [self._balance(c, self._storage(c, local, rate)) for c in slopes]
        squeeze = -self.slope * self.state[kernel.FILL] * mesh.dz
        fields += [squeeze * self.coef[row, :-1, None] for row in (kernel.COS, kernel.SIN)]
        columns = np.empty((len(fields), mesh.angle.size * mesh.z.size))
        for column, field in zip(columns, fields):
            field[self.fixed] = 0.0
            kernel.gather(field, mesh.order, column)
        dgbtrs(lu, mesh.bandwidth, mesh.bandwidth, columns.T, pivots, overwrite_b=1)

        carried = np.empty((len(fields), 2))
        kernel.carried_by(self.state, self.coef, mesh.dz, mesh.order, columns, carried)
        carried *= 2.0 * self.radius**2
        load = self._load(self.coef) - carried[0]
        by_gap = [self._load(c) for c in slopes]
        damping = -carried[-2:].T
        direct = [d - c for d, c in zip(by_gap, carried[1:])]
        if mesh.polar:
            ratio = max(float(np.hypot(*position)), 1e-9)
            direct.append(_TURN @ load / ratio - damping @ (_TURN @ local) / ratio)
        return Linear(
            load=frame @ load,
            stiffness=frame @ np.array(direct).T @ frame.T,
            damping=frame @ damping @ frame.T,
            columns=columns,
        )

    def _load(self, coef: Array) -> Array:
        """∫ p (cos θ, sin θ) dA at the state last placed, full width, in the mesh's frame, N."""
        return 2.0 * self.radius**2 * np.array(kernel.load_of(self.state, coef, self.mesh.dz))

    # --- what Newton needs -----------------------------------------------------------------------
    def weights(self, position: Array, velocity: Array, target: Array, speed: Array) -> Array:
        """Weights of `Linear.columns` in a step to position `target` and velocity `speed`."""
        if not self.mesh.polar:
            return np.concatenate([[1.0], target - position, speed - velocity])
        far = math.hypot(*target) - math.hypot(*position)
        turned = _frame(target).T @ speed - _frame(position).T @ velocity
        return np.array([1.0, far, *turned])

    def size(self, column: Array) -> float:
        """Largest entry of a change of the unknowns over the pressure of the film."""
        peak = float(self.state[kernel.LOAD].max())
        return float(np.abs(column).max()) / max(self.scale, peak)

    def correct(self, u: Array, columns: Array, weights: Array) -> float:
        """Apply a Newton step to `u`; returns its largest change over the scale of pressure."""
        return kernel.correct(u, columns, weights, self.mesh.order) / self.scale

    def imbalance(
        self,
        u: Array,
        position: Array,
        velocity: Array,
        force: Array | None = None,
        rate: float = 0.0,
        old: Array | float = 0.0,
    ) -> float:
        """Largest imbalance of a cell, and of the load if `force` is given, over their scales."""
        frame = self.place(u, position)
        mass = self._storage(self.coef, frame.T @ velocity, rate)
        flux = (abs(self.wedge) + self.scale) * self.mesh.dz.max()
        worst = float(np.abs(self.residual(u, mass, old)).max()) / flux
        if force is not None:
            scale = max(float(np.hypot(*force)), self.scale * self.radius**2 * 1e-3)
            missing = force - frame @ self._load(self.coef)
            worst = max(worst, float(np.hypot(*missing)) / scale)
        return worst

    def liquid(self) -> Array:
        """Liquid in each cell (nx, nz) times the squeeze pressure, Pa s, at the last state."""
        volume = self.coef[kernel.HM, :-1, None] * self.mesh.dz
        return self.slope * self.state[kernel.FILL] * volume

    # --- results ---------------------------------------------------------------------------------
    def summary(self, u: Array, position: Array) -> dict[str, float]:
        """Integral results at `u`, in SI units, named as in `Equilibrium`."""
        self.place(u, position)
        mesh = self.mesh
        peak, dissipation, shear, outflow, liquid, volume = kernel.integrals(
            self.state, self.coef, mesh.dz, mesh.gz, mesh.closed,
            self.p_edge, self.p_edge, self.fixed,
        )  # fmt: skip
        clearance = self.relative_clearance * self.radius
        flow = 2.0 * clearance**3 / (12.0 * self.viscosity)
        drag = 2.0 * self.viscosity * self.speed**2 * self.radius**4 / clearance
        return {
            "minimum_film": clearance * (1.0 - float(np.hypot(*position))),
            "maximum_pressure": peak,
            "friction_power": flow * dissipation + drag * shear,
            "side_flow": flow * outflow,
            "supply_flow": flow * self._groove_outflow() if self.fixed.any() else 0.0,
            "total_fill": liquid / volume,
        }

    def _groove_outflow(self) -> float:
        mass = np.zeros(self.mesh.shape[0])
        return float(self._balance(self.coef, mass)[self.fixed].sum())

    def field(self, u: Array, position: Array) -> tuple[Array, Array, Array, Array]:
        """Pressure (Pa) and fill of the cells (nx, nz), their angle (nx,), and the load (N)."""
        frame = self.place(u, position)
        load = frame @ self._load(self.coef)
        angle = self.mesh.angle
        if self.mesh.polar:
            stretch = self.mesh.strength * float(np.hypot(*position))
            narrow = np.sqrt((1 - stretch) / (1 + stretch))
            angle = 2 * np.arctan(narrow * np.tan(0.5 * angle)) + np.arctan2(
                frame[1, 0], frame[0, 0]
            )
        return self.state[kernel.LOAD].copy(), self.state[kernel.FILL].copy(), angle, load
