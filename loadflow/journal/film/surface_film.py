"""The film on a cone, a plane ring or a straight pad: loads and losses on its nodes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import DLOAD, LOAD
from loadflow.journal.film import _kernels as kernel
from loadflow.journal.film import _surface_kernels as surface_kernel
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap_surface import SurfaceGap

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

    def _load(self, around: Array) -> Array:
        gap = self.gap
        if around is gap.still:  # motions do not move the nodes
            return np.zeros(gap.size)
        out = np.empty(gap.size)
        above = self.state[LOAD] - self.p_edge
        kernel.load_of(above, gap.pressed, gap.across, gap.mesh.carrying, out)
        return np.asarray(self.radius**2 * out)

    def _carried(self, columns: Array) -> Array:
        gap, mesh = self.gap, self.gap.mesh
        out = np.empty((columns.shape[0], gap.size))
        words = (gap.pressed, gap.across, mesh.carrying, mesh.order, columns, out)
        if self.law.cuts_load:
            surface_kernel.carried_by_cut(self._slope, *words)
        else:
            kernel.carried_by(self.state[DLOAD], *words)
        return out
