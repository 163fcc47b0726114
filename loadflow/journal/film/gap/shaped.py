"""Gap of any shape around a shaft that may tilt and bend; pads that tilt."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap import _gap_kernels as kernel
from loadflow.journal.film.gap.gap import KEPT, FlowBetween
from loadflow.journal.film.gap.layout import Bore, Places, layout_of
from loadflow.journal.film.gap.pad_curve import PadCurve, pad_curve
from loadflow.journal.film.gap.shaped_mesh import ShapedMesh

Array = NDArray[np.float64]
_STAYS = 1e-3  # readiness of a shaft that nothing holds to move, against that of its pad
_EXACT = 0.95  # share of a gap from which a film may hold a pad after all
_SMALL_LIFT = 0.03  # tilt of a pad, in clearances, from which it may grow threefold in a step


class ShapedGap(FlowBetween):
    """Gap ``H = H_0(θ, z) − Σ q_j N_j(θ, z)`` on a mesh fixed to the shell.

    The degrees of freedom q are the eccentricity (x, y); on a mesh of the full width also the
    rotations of the shaft about x and y, in clearances per shaft radius; and one tilt for each
    pad, in clearances: how far it lifts the film a quarter turn before the pivot.

    Parameters
    ----------
    mesh : ShapedMesh
        Cells.
    bore : Bore
        What tells H_0.
    along : bool
        Whether to keep a row for each cell across even where the gap does not change there.
    """

    roughness: float = 0.0
    open_share: Array | None = None
    axisymmetric = False
    first_gap = 0.02

    def __init__(self, mesh: ShapedMesh, bore: Bore, along: bool = False) -> None:
        self.mesh, self.bore = mesh, bore
        self.layout = plan = layout_of(mesh, bore, along)
        self.tilts, self.shaft, self.size = plan.tilts, plan.shaft, plan.size
        self.dof_scale = np.repeat([_STAYS, 1.0], [self.shaft, len(bore.pads)])
        self.pads = np.arange(self.shaft, self.size)
        self.pivots, self._tangents, self.across = plan.pivots, plan.tangents, plan.across
        self._face, self._face_gap = plan.face, plan.face_gap
        self._cell, self._cell_gap = plan.cell, plan.cell_gap
        self._reach, self._lengths = plan.reach, plan.lengths
        nx, rows = plan.cell_gap.shape
        shape = (8, nx + 1, rows + (1 if plan.along else 0))
        self.coefs = np.zeros((1 + self.size, *shape))
        self.coef, self._slopes = self.coefs[0], self.coefs[1:]
        self._by_x, self._by_y = np.zeros((2, *shape))
        self.bend(np.zeros(2))

    def arcs(self, position: Array) -> Array:
        """Angles that the cells span around (nx,), rad."""
        return self._cell[2]

    # --- the shaft's centre line -----------------------------------------------------------------
    def held(self, tilt: Array | None, bend: Array | None) -> Array:
        """Centred position of a shaft tilted by `tilt` (2,), rad, and bent by `bend` (2,), 1/m."""
        position, unit = np.zeros(self.size), self.bore.radius / self.bore.clearance
        if bend is not None:
            self.bend(bend * self.bore.radius * unit)
        if tilt is not None:
            position[2:4] = tilt * unit
        return position

    def bend(self, curvature: Array) -> None:
        """Bend the shaft: curvature (2,) of its centre line over that of one clearance per R²."""
        self.curvature, plan = curvature, self.layout
        self.line = 0.5 * np.outer(curvature, plan.z**2)
        self._spots = plan.spots - plan.facing @ (0.5 * np.outer(curvature, plan.spots_z**2))

    def modes_at(self, angle: Array, segment: NDArray[np.int64], z: Array) -> Places:
        """Gap and modes at angles (n,), rad, in segments (n,), and at z (l,), shaft radii."""
        facing = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        return Places(
            base=self.bore.gap(angle, segment, z),
            facing=facing,
            z=z,
            reach=np.einsum("jid,id->ji", self.layout.shifts(segment), facing),
            lengths=self.layout.lengthwise(z),
        )

    def gaps(self, position: Array) -> Array:
        """Gap at the sampled places, in clearances."""
        moved = (self._reach.T * position) @ self._lengths
        return np.asarray(self._spots - moved)

    def uniform(self) -> Array:
        """∫ N_j over the film (m,), in units of R²."""
        return np.asarray(self.around.sum(axis=1) * (self.across * self.mesh.dz).sum(axis=1))

    def facing_groove(self) -> Array:
        """∫ N_j over the groove in which the film begins and ends (m,), in units of R²."""
        first, last = self.bore.segments[0].start + 2 * np.pi, self.bore.segments[-1].end
        out = np.zeros(self.size)
        out[:2] = np.sin(first) - np.sin(last), np.cos(last) - np.cos(first)
        return out * float(self.mesh.dz.sum())

    # --- what the film asks ----------------------------------------------------------------------
    @property
    def around(self) -> Array:
        """Modes, integrated over the cells around (m, nx)."""
        return self.layout.around

    def place(self, position: Array) -> Array:
        """Evaluate `coef` at `position`; the frame of the mesh is that of the shell."""
        self.moved = self.centre(position)
        self._evaluate()
        kernel.faces_across(self.coef, self.mesh.dz, False, self.coef)
        return np.eye(self.size)

    def _evaluate(self) -> None:
        """Fill `coef` and its derivatives where the shaft was `moved` to."""
        kernel.shaped_coefficients(
            self._face, self._face_gap, self._cell, self._cell_gap, *self.moved,
            self.surfaces, self.coef, self._by_x, self._by_y, self.open_share,
        )  # fmt: skip

    def centre(self, position: Array) -> tuple[Array, Array]:
        """Where the shaft is seen to be from each cell, x and y (nx, rows)."""
        modes, (along_x, along_y) = self.layout.modes, self.line
        ex = (modes[:, :, 0].T * position) @ self.across + along_x
        return ex, (modes[:, :, 1].T * position) @ self.across + along_y

    def slopes(self, position: Array) -> Array:
        """Fill the derivatives in `coefs` where the shaft was last placed; returns the modes."""
        modes, dz = self.layout.modes, self.mesh.dz
        kernel.mode_slopes(self._by_x, self._by_y, modes, self.across, self.coef, dz, self._slopes)
        return self.around[None]

    def advance(self, position: Array, step: Array) -> Array:
        """Position after `step`, of which every place keeps at least a third of its gap."""
        gaps = self.gaps(position)
        closing = (self._reach.T * step) @ self._lengths
        worst = float((closing / gaps).max())
        target = position + step * min(1.0, (1.0 - KEPT) / worst if worst > 0 else 1.0)
        for row in (self.shaft + np.flatnonzero(step[self.shaft :])).tolist():
            before, after = self.lift(row, position), self.lift(row, target)
            # a pad that tilts the other way has no film, and would stay so
            low, high = KEPT * abs(before), max(abs(before), _SMALL_LIFT) / KEPT
            kept = math.copysign(min(max(math.copysign(after, after * before), low), high), before)
            target[row] += kept - after
        return target

    def lift(self, row: int, position: Array) -> float:
        """Tilt of a pad against the shaft: its own less the way of the shaft past it."""
        return float(position[row] + position[:2] @ self._tangents[row - self.shaft])

    def pad_curve(self, speed: float) -> PadCurve:
        """What each pad carries, and how it tilts, in the sense of rotation of `speed`."""
        part = self.bore.segments[self.bore.pads[0]]
        before, after = part.narrowest - part.start, part.end - part.narrowest
        ends = (before, after) if speed >= 0.0 else (after, before)
        width_ratio = 0.5 * self.bore.width / self.bore.radius
        return pad_curve(part.preload, *(round(end, 12) for end in ends), width_ratio)

    def converging(self, position: Array, speed: float) -> NDArray[np.int64]:
        """Pads that a film can hold at `position`: those toward which it narrows."""
        if not self.pads.size:
            return self.pads
        return self.pads[self.pad_curve(speed).holds(1.0 - self.pivots @ position[:2])]

    def may_hold(self, position: Array, speed: float) -> NDArray[np.int64]:
        """Pads that a film may hold at `position`, for what the curve of one pad can tell.

        It knows no relief, and the width of its film by a parabola alone.
        """
        if self.bore.relief:
            return self.pads
        return self.pads[self.pad_curve(speed).holds(_EXACT * (1.0 - self.pivots @ position[:2]))]

    def lifted(self, position: Array, speed: float) -> Array:
        """Position with pads tilted so that their gap converges in the sense of rotation."""
        position = position.copy()
        if not self.pads.size:
            return position
        position[self.pads] = 0.0
        lifts = self.pad_curve(speed).lift(1.0 - self.pivots @ position[:2])
        for row, lift in zip(self.pads[lifts > 0.0].tolist(), lifts[lifts > 0.0].tolist()):
            position[row] = math.copysign(lift, speed) - self.lift(row, position)
        return position

    def columns_of(self, pads: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Columns of cells (nx,) that belong to `pads`."""
        return np.isin(self.mesh.segment, np.array(self.bore.pads)[pads - self.shaft])

    def widest_lift(self, row: int, position: Array, sign: float) -> float:
        """Lift of a pad, times `sign`, at which its one end meets the shaft."""
        flat = position.copy()
        flat[row] -= self.lift(row, position)
        closing = sign * self._reach[row][:, None] * self._lengths[row]
        closes = closing > 0.0
        return float((self.gaps(flat)[closes] / closing[closes]).min())

    def narrowest(self, position: Array) -> float:
        """Narrowest gap over the clearance; ≤ 0 where the shaft would touch the bore."""
        return self.closest(position)[0]

    def closest(self, position: Array) -> tuple[float, float, float]:
        """Narrowest gap (clearances), its angle (rad) and axial place (shaft radii)."""
        least, angle, z = self.layout.lowest(self.gaps(position))
        return least, math.atan2(math.sin(angle), math.cos(angle)), z

    def closing(self, position: Array, limit: float) -> tuple[float, ...]:
        """Angles, rad, of the narrowest gap of each segment where it is below `limit`."""
        gaps = self.gaps(position).min(axis=1)
        angles = []
        for number in np.unique(self.layout.segment):
            part = np.flatnonzero(self.layout.segment == number)
            nearest = part[gaps[part].argmin()]
            if gaps[nearest] < limit:
                angles.append(float(self.layout.angle[nearest]))
        return tuple(angles)

    def reach(self, direction: Array, least: float) -> float:
        """How far the centred shaft may go along a unit vector (2,); it leaves a gap `least`."""
        step = np.zeros(self.size)
        step[:2] = direction
        closing = (self._reach.T * step) @ self._lengths
        gaps = self.gaps(np.zeros(self.size)) - least
        closes = closing > 0.0
        return float((gaps[closes] / closing[closes]).min(initial=np.inf))

    def widest(self, position: Array, free: slice | NDArray[np.int64]) -> Array:
        """Position of the widest narrowest gap, when only the degrees of freedom `free` move."""
        from scipy.optimize import linprog

        free = np.arange(self.size)[free]
        held = position.copy()
        held[free] = 0.0
        gaps = self.gaps(held).ravel()
        taken = (self._reach[free, :, None] * self._lengths[free, None, :]).reshape(free.size, -1)
        # widest t with taken·q + t ≤ gaps
        answer = linprog(
            np.append(np.zeros(free.size), -1.0),
            A_ub=np.column_stack([taken.T, np.ones(gaps.size)]),
            b_ub=gaps,
            bounds=[(None, None)] * free.size + [(None, 1.0)],
        )
        held[free] = answer.x[:-1]
        return held
