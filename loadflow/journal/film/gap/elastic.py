"""Gap that grows cell by cell, by heat or by the pressure on an elastic shell."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap import _elastic_kernels as kernel
from loadflow.journal.film.gap.gap import KEPT
from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.film.gap.shaped_mesh import ShapedMesh

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix

Array = NDArray[np.float64]


class Thinned(NamedTuple):
    """Conductance and drag of the faces around (nx + 1, nz), conductance of the cells (nx, nz).

    Over those of the film's one viscosity.
    """

    around: Array
    dragged: Array
    across: Array


class GrowingGap(ShapedGap):
    """Gap ``H = H_0(θ, z) + W − Σ q_j N_j(θ, z)`` with a growth W of each cell.

    It is `pressed` open, and has an `expansion` by heat; between cell centres it runs straight.

    Parameters
    ----------
    mesh, bore
        As for `ShapedGap`.
    ends_deform : bool
        Whether what is pressed open goes on to the bearing ends, or ends there with the pressure;
        expansion goes on.
    """

    def __init__(self, mesh: ShapedMesh, bore: Bore, ends_deform: bool = True) -> None:
        super().__init__(mesh, bore, along=True)
        self._rigid_face, self._rigid_cell = self._face_gap, self._cell_gap
        columns = np.arange(mesh.shape[0])
        first, last = (columns[-1], 0) if mesh.closed else (0, columns[-1])
        self._sides = np.append(first, columns), np.append(columns, last)
        self.own_share = _own_share(mesh)
        self._ends_deform = ends_deform
        self._to_spots = self.places(self.layout.angle, self.layout.spots_z)
        self.pressed, self.expansion = np.zeros(mesh.shape), np.zeros(mesh.shape)
        self.growth = np.zeros(mesh.shape)

    def grow(self, pressed: Array) -> None:
        """Let pressure open the gaps of the cells by `pressed` (nx, nz), clearances."""
        self.pressed = pressed
        self._open()

    def expand(self, expansion: Array) -> None:
        """Let heat open the gaps of the cells by `expansion` (nx, nz), clearances."""
        self.expansion = expansion
        self._open()

    def _open(self) -> None:
        """Give faces and cells their growth by both."""
        self.growth = growth = self.pressed + self.expansion
        sides = np.stack([growth[side] for side in self._sides], axis=1)
        own = self.own_share[:, :, None]
        self._face_gap = self._rigid_face + own * sides + (1.0 - own) * sides[:, ::-1]
        self._cell_gap = self._rigid_cell + growth

    def gaps(self, position: Array) -> Array:
        """Gap at the sampled places, in clearances; the growth runs straight between cells."""
        gaps = super().gaps(position)
        return gaps + self.grown_at(self._to_spots) if self.growth.any() else gaps

    def places(self, angle: Array, z: Array) -> tuple[Between, Between]:
        """Places at `angle` (n,), rad, and `z` (l,): to what is pressed open, and to expansion."""
        around = _around(angle, self.mesh)
        ends = (_across(z, self.mesh, deform) for deform in (self._ends_deform, True))
        first, second = (Between(around, across) for across in ends)
        return first, second

    def grown_at(self, places: tuple[Between, Between]) -> Array:
        """Growth at `places` (n, l), clearances."""
        grown = places[0].of(self.pressed)
        return grown + places[1].of(self.expansion) if self.expansion.any() else grown


class ElasticGap(GrowingGap):
    """Gap of a `GrowingGap` that pressure widens.

    What the surfaces drag over a face is that of its gap, and the more of the cell it comes from
    the more the pressure there widens it: on faces, the gap of a soft shell would let the pressure
    swing from cell to cell.
    """

    def __init__(self, mesh: ShapedMesh, bore: Bore, ends_deform: bool) -> None:
        super().__init__(mesh, bore, ends_deform)
        self.blend = np.zeros((4, mesh.shape[0] + 1, mesh.shape[1]))
        self.thinned = Thinned(*(np.ones((mesh.shape[0] + i, mesh.shape[1])) for i in (1, 1, 0)))
        self.advected = np.zeros(self.blend.shape[1:])

    def drag(self, advected: Array) -> None:
        """Set what the surfaces drag along for each Pa that widens the cells (nx, nz)."""
        before, behind = (advected[side] for side in self._sides)
        self.advected = 0.5 * (before + behind) * self.thinned.dragged / self.thinned.around

    def _evaluate(self) -> None:
        """Fill `coef` and its derivatives; where pressure widens the gap, of the upstream side."""
        super()._evaluate()
        kernel.upwind(
            self._cell, self._cell_gap, *self.moved, self.surfaces, self.mesh.closed,
            self.advected, self.coef, self._by_x, self._by_y, self.blend,
        )  # fmt: skip

    @property
    def widths(self) -> Array:
        """Areas of the cells (nx, nz), in units of R²."""
        return np.outer(self._cell[2], self.mesh.dz)

    @property
    def nodes(self) -> tuple[Array, Array, Array, Array]:
        """Places and gaps of faces, then of cells, where the shaft was last placed."""
        face, cell = self.films(*self.moved)
        return self._face, face, self._cell, cell

    def films(self, ex: Array, ey: Array) -> tuple[Array, Array]:
        """Gaps of faces (nx + 1, 2, nz) and cells (nx, nz) of a shaft that is at (`ex`, `ey`)."""
        last = np.minimum(np.arange(len(ex) + 1), len(ex) - 1)
        cos, sin = self._face[:2, :, :, None]
        face = self._face_gap - ex[last, None] * cos - ey[last, None] * sin
        cos, sin = self._cell[:2, :, None]
        return face, self._cell_gap - ex * cos - ey * sin

    def least(self, position: Array) -> float:
        """Narrowest gap, in clearances, that the balance of the film takes up."""
        return min(float(gaps.min()) for gaps in self.films(*self.centre(position)))

    def least_after(self, position: Array) -> float:
        """Gap, in clearances, that a step from `position` must leave."""
        return KEPT * self.least(position)

    def left(self, position: Array) -> float:
        """Narrowest gap over the clearance, that between cells included."""
        return min(self.least(position), self.narrowest(position))

    def pressed_open(self) -> Array:
        """Growth of the cells by what is not in the film: none."""
        return np.zeros(self.mesh.shape)


def _own_share(mesh: ShapedMesh) -> Array:
    """Share of their own cell in the growth of the nodes of a face, (nx + 1, 2).

    The growth runs straight from cell to cell; the rest is that of the cell across the face.
    """
    places, sides = mesh.face_angles
    away = np.abs(places - mesh.edges[:, None])
    return np.asarray((away + sides[:, ::-1]) / sides.sum(axis=1)[:, None])


class _Line(NamedTuple):
    """Straight lines through neighbouring rows: their numbers, and the share of the higher."""

    low: NDArray[np.int64]
    high: NDArray[np.int64]
    share: Array

    @classmethod
    def through(cls, nodes: Array, rows: NDArray[np.int64], places: Array) -> _Line:
        """Lines through `rows`, which lie at `nodes`, to `places`."""
        at = np.clip(np.searchsorted(nodes, places) - 1, 0, nodes.size - 2)
        share = (places - nodes[at]) / (nodes[at + 1] - nodes[at])
        return cls(rows[at], rows[at + 1], share[:, None])

    def of(self, values: Array) -> Array:
        """Values (rows, m) on the lines, (places, m)."""
        return (1.0 - self.share) * values[self.low] + self.share * values[self.high]

    def matrix(self, rows: int) -> csr_matrix:
        """What `of` does, (places, rows)."""
        from scipy.sparse import csr_matrix

        every, share = np.arange(self.low.size), self.share[:, 0]
        places = np.append(every, every), np.append(self.low, self.high)
        return csr_matrix((np.append(1.0 - share, share), places), shape=(every.size, rows))


class Between(NamedTuple):
    """Places between the cells, at which what the cells (nx, nz) have runs straight."""

    around: _Line
    across: _Line

    def of(self, values: Array) -> Array:
        """Values of the cells (nx, nz) at the places (n, l)."""
        still = np.zeros((self.around.low.size, 1))
        return self.across.of(np.hstack([self.around.of(values), still]).T).T

    def matrix(self, shape: tuple[int, int]) -> csr_matrix:
        """What `of` does with the values of all cells of `shape` at once, (n l, nx nz)."""
        from scipy.sparse import kron

        nx, nz = shape
        across = self.across.matrix(nz + 1)[:, :nz]  # the last row stays
        return kron(self.around.matrix(nx), across, format="csr")


def _around(angle: Array, mesh: ShapedMesh) -> _Line:
    """Lines between the cells around, to `angle`."""
    count = mesh.angle.size
    numbers = np.arange(-1, count + 1) if mesh.closed else np.arange(count)
    turns, cells = np.divmod(numbers, count)
    return _Line.through(mesh.angle[cells] + 2 * np.pi * turns, cells, angle)


def _across(z: Array, mesh: ShapedMesh, ends_deform: bool) -> _Line:
    """Lines between the cells across, to `z`, mirrored at mid-plane where that is an end.

    Behind the cells there is a row that stays: the bearing ends, if they do not deform.
    """
    count = mesh.z.size
    nodes, rows = mesh.z, np.arange(count)
    if not ends_deform:
        nodes, rows = np.append(nodes, mesh.z_edges[-1]), np.append(rows, count)
    if mesh.half:
        nodes, rows = np.append(-mesh.z[0], nodes), np.append(0, rows)
    elif not ends_deform:
        nodes, rows = np.append(mesh.z_edges[0], nodes), np.append(count, rows)
    return _Line.through(nodes, rows, z)
