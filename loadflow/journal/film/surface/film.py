"""The film on a cone, a plane ring or a straight pad: loads and losses on its nodes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import DLOAD, FILL, LOAD, P
from loadflow.journal.film import _kernels as kernel
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.surface import _surface_kernels as surface_kernel
from loadflow.journal.film.surface.gap import SurfaceGap

Array = NDArray[np.float64]


class SurfaceFilm(DiscreteFilm):
    """Film whose unknowns lie on the nodes of a `SurfaceMesh`.

    Loads are those of the pressure above that at the edges.
    """

    gap: SurfaceGap

    def _apply_law(self, u: Array) -> None:
        super()._apply_law(u)
        if not self.law.cuts_load:
            return
        self._slope = np.empty((5, *u.shape))
        mesh = self.gap.mesh
        surface_kernel.cut(
            mesh.closed, self.law.floor, self.p_line, mesh.between, self.state, self._slope
        )

    def _loads(self, around: Array) -> Array:
        gap, out = self.gap, np.empty((1, self.gap.size))  # motions do not move the nodes
        above = self.state[LOAD] - self.p_edge
        kernel.load_of(above, gap.pressed[None], gap.across, gap.mesh.carrying, out)
        return out

    def _carried(self, columns: Array) -> Array:
        gap, mesh = self.gap, self.gap.mesh
        out = np.empty((columns.shape[0], gap.size))
        words = (gap.pressed, gap.across, mesh.carrying, mesh.order, columns, out)
        if self.law.cuts_load:
            surface_kernel.carried_by_cut(self._slope, *words)
        else:
            kernel.carried_by(self.state[DLOAD], *words)
        return out

    # --- results ---------------------------------------------------------------------------------
    @property
    def flow_unit(self) -> float:
        """Unit of flow, m³/s."""
        return float(self.pockets.flow_unit)

    def shown(self) -> Array:
        """Pressure of the nodes, those on the edges included, at the state last placed, Pa."""
        pressure = np.maximum(self.state[P], self.law.floor)
        pads = [(0, 0) if self.gap.mesh.closed else (1, 1), (1, 1)]
        if not self.gap.mesh.surface.open_ends:
            pads[1] = (0, 0)
        return np.pad(pressure, pads, constant_values=self.p_edge)

    def summary(self, u: Array, position: Array) -> dict[str, Any]:
        """Integral results of one pad at `u`, in SI units.

        Friction is that of pure liquid in the whole gap; its power is what the shear of the motion
        and the pressure flow dissipate.
        """
        self.place(u, position)
        gap, mesh = self.gap, self.gap.mesh
        surface, clearance = mesh.surface, self.relative_clearance * self.radius
        weights = np.outer(mesh.weights[0], mesh.carrying) * self.radius**2
        above = (self.state[LOAD] - self.p_edge) * weights
        normal = float(above.sum())
        centre = (math.nan, math.nan)
        if normal != 0.0:
            angle = float(mesh.angle @ above.sum(axis=1)) / normal
            centre = (float(surface.place(mesh.z) @ above.sum(axis=0)) / normal, angle)
        along, across = self._flows()
        drag = self.viscosity * self.speed**2 * self.radius**4 / clearance
        power = drag * gap.shear(position) + self._dissipation()
        pressure = self.shown()
        return {
            "normal_force": normal,
            "centre": centre,
            "pressure": pressure,
            "maximum_pressure": float(pressure.max()),
            "minimum_film": clearance * gap.narrowest(position),
            "friction_power": power,
            "friction_torque": power / self.speed if self.speed else 0.0,
            "flow": along[0] if self.speed >= 0 else -along[1],
            "side_flow": across,
            "mass_balance": self._mass_balance(),
        }

    def _fluxes(self) -> tuple[Array, Array]:
        """Flow through the faces along (nx + 1, nz) and across (nx, nz + 1), in units of flow."""
        mesh, coef = self.gap.mesh, self.gap.coef
        pressure, fill = self.state[P], self.state[FILL]
        nx, nz = mesh.shape
        if mesh.closed:
            pressure = np.concatenate([pressure[-1:], pressure, pressure[:1]])
            fill = np.concatenate([fill[-1:], fill, fill[:1]])
        else:
            pressure = np.pad(pressure, ((1, 1), (0, 0)), constant_values=self.p_line)
            fill = np.pad(fill, ((1, 1), (0, 0)), constant_values=self.line_fill)
        upstream = fill[:-1] if self.wedge > 0 else fill[1:]
        along = self.wedge * coef[kernel.E, :, :nz] * upstream * mesh.area
        along -= coef[kernel.G, :, :nz] * np.diff(pressure, axis=0) * mesh.dz
        ends = np.pad(self.state[P], ((0, 0), (1, 1)), constant_values=self.p_edge)
        across = -coef[kernel.H3, :nx, : nz + 1] * np.diff(ends, axis=1) * mesh.gz
        return along, across

    def _flows(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Flow in at the first and out at the last edge; out at the inner and outer end, m³/s.

        On straight lines from the faces next to the edges.
        """
        mesh, coef = self.gap.mesh, self.gap.coef
        along, across = self._fluxes()
        inner = -1.5 * across[:, 0] + 0.5 * across[:, 1]
        outer = 1.5 * across[:, -1] - 0.5 * across[:, -2]
        ends = (self.flow_unit * float(inner.sum()), self.flow_unit * float(outer.sum()))
        if mesh.closed:
            return (0.0, 0.0), ends
        edges = []
        for face, beside in ((0, 1), (-1, -2)):
            flow = float((1.5 * along[face] - 0.5 * along[beside]).sum())
            if mesh.surface.open_ends:  # half a cell at both ends, where oil is only dragged
                share = mesh.surface.area(mesh.nodes_across)
                lost = 0.5 * np.array([share[0], share[-1]])
                drag = coef[kernel.E, face, [0, mesh.z.size - 1]] * self.line_fill
                flow += self.wedge * float(lost @ drag)
            edges.append(self.flow_unit * flow)
        return (edges[0], edges[1]), ends

    def _dissipation(self) -> float:
        """Power of the pressure flow, W."""
        mesh, coef = self.gap.mesh, self.gap.coef
        nx, nz = mesh.shape
        pressure = np.maximum(self.state[P], self.law.floor)
        if mesh.closed:
            steps = np.diff(np.concatenate([pressure[-1:], pressure, pressure[:1]]), axis=0)[:-1]
        else:
            steps = np.diff(np.pad(pressure, ((1, 1), (0, 0)), constant_values=self.p_line), axis=0)
        total = np.sum(coef[kernel.G, : len(steps), :nz] * steps**2 * mesh.dz)
        ends = np.diff(np.pad(pressure, ((0, 0), (1, 1)), constant_values=self.p_edge), axis=1)
        total += np.sum(coef[kernel.H3, :nx, : nz + 1] * ends**2 * mesh.gz)
        return self.flow_unit * float(total)

    def _mass_balance(self) -> float:
        """What enters the cells less what leaves them, over what is dragged through."""
        mesh = self.gap.mesh
        along, across = self._fluxes()
        left = float(across[:, -1].sum() - across[:, 0].sum())
        if not mesh.closed:
            left += float(along[-1].sum() - along[0].sum())
        return left / max(float(np.abs(along).sum(axis=1).max()), 1e-300)
