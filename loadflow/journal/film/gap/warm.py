"""Gap of a film whose viscosity differs from cell to cell, weighed by it; it may grow with heat."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film import _kernels as row
from loadflow.journal.film.gap._gap_kernels import faces_across
from loadflow.journal.film.gap.elastic import ElasticGap, GrowingGap, Thinned
from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film.gap.rough import RoughElasticGap, RoughShapedGap
from loadflow.journal.film.gap.shaped_mesh import ShapedMesh

Array = NDArray[np.float64]


class AcrossFilm(NamedTuple):
    """Viscosity across the film, which may change from surface to surface; arrays (nx, nz).

    Attributes
    ----------
    shear, flow : array
        That under shear, and against flow by pressure, over that of the film.
    drag : array
        Flow that the surfaces drag, over that at one viscosity.
    """

    shear: Array
    flow: Array
    drag: Array


class WarmGap(GrowingGap):
    """Gap whose coefficients hold the viscosity of each cell over that of the film.

    Around, the flow between two cell centres passes the mean viscosity of its way; across, two
    conductances in series. Everything that follows from the coefficients (balance, Newton matrix,
    stiffness, damping, friction) is then that of the film with this viscosity.

    Parameters
    ----------
    mesh, bore, *more, **ends
        As for `GrowingGap`, or what the other gap of a class made of two asks for.
    """

    def __init__(self, mesh: ShapedMesh, bore: Bore, *more: Any, **ends: Any) -> None:
        super().__init__(mesh, bore, *more, **ends)
        self.thicken(AcrossFilm(*(np.ones(mesh.shape) for _ in range(3))))

    def thicken(self, across: AcrossFilm) -> None:
        """Set the viscosity of the cells (nx, nz)."""
        self.across_film = across
        faces = self._over_faces(across.flow), self._over_faces(across.drag)
        self.thinned = Thinned(1.0 / faces[0], faces[1], 1.0 / across.flow)

    def _over_faces(self, values: Array) -> Array:
        """Mean of `values` of the cells on the ways between their centres."""
        weights = self.mesh.face_angles[1]
        parts = [weights[:, side, None] * values[self._sides[side]] for side in (0, 1)]
        return np.asarray((parts[0] + parts[1]) / weights.sum(axis=1)[:, None])

    def place(self, position: Array) -> Array:
        """Evaluate `coef` at `position`; the frame of the mesh is that of the shell."""
        frame = super().place(position)
        rows = self.mesh.shape[1]
        for coef in (self.coef, self._by_x, self._by_y):
            coef[row.G, :, :rows] *= self.thinned.around
            coef[row.E, :, :rows] *= self.thinned.dragged
            coef[row.CELL3, :-1, :rows] *= self.thinned.across
        self.coef[row.HINV, :-1, :rows] *= self.across_film.shear
        faces_across(self.coef, self.mesh.dz, False, self.coef)
        return frame

    @property
    def means(self) -> Array:
        """Mean gap of the cells (nx, nz), in clearances, where the shaft was last placed."""
        rows = self.mesh.shape[1]
        return np.asarray(self.coef[row.HM, :-1, :rows] / self.mesh.dx[:, None])

    @property
    def shear(self) -> Array:
        """∫ 1/H of the cells (nx, nz) around, where the shaft was last placed."""
        rows = self.mesh.shape[1]
        return np.asarray(self.coef[row.HINV, :-1, :rows] / self.across_film.shear)


class ElasticWarmGap(WarmGap, ElasticGap):
    """The same in a shell that pressure deforms."""


class RoughElasticWarmGap(WarmGap, RoughElasticGap):
    """The same in a shell that pressure deforms, between rough surfaces."""


class RoughWarmGap(RoughShapedGap, WarmGap):
    """The same between rough surfaces; `RoughShapedGap` says how far the shaft goes."""
