"""Cells of the film: around in the coordinate of the Sommerfeld map, across to the bearing ends."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap._gap_kernels import FLATTEST
from loadflow.journal.film.gap.grooves import edges_across, edges_around
from loadflow.journal.film_model import check_grid
from loadflow.journal.supply import Supply

Array = NDArray[np.float64]

MAP_STRENGTH = (
    0.95  # of the Sommerfeld map, times the eccentricity ratio: least error up to ε = 0.99
)
END_STRENGTH = 0.8  # share of the sine in the axial grading toward the bearing end


@dataclass(frozen=True, eq=False)
class Mesh:
    """Cells of the half or the whole film.

    Attributes
    ----------
    edges : array (nx + 1,)
        Cell edges around, in the coordinate a of the Sommerfeld map, rad.
    z_edges : array (nz + 1,)
        Cell edges across, from mid-plane 0 or from the other end to the end, in shaft radii.
    closed : bool
        Whether the film runs round; else both ends lie on an inlet line.
    polar : bool
        Whether the mesh turns with the eccentricity (θ = 0 at the narrowest gap); else it is fixed
        to the shell.
    strength : float
        Strength of the Sommerfeld map over the eccentricity ratio (polar meshes only).
    nodes : int
        Gauss points of the integrals over cells.
    """

    edges: Array
    z_edges: Array
    closed: bool
    polar: bool
    strength: float
    nodes: int

    @cached_property
    def angle(self) -> Array:
        """Cell centres around, in the coordinate of the map."""
        return 0.5 * (self.edges[1:] + self.edges[:-1])

    @cached_property
    def z(self) -> Array:
        """Cell centres across, in shaft radii."""
        return 0.5 * (self.z_edges[1:] + self.z_edges[:-1])

    @cached_property
    def dx(self) -> Array:
        """Cell widths around, in the coordinate of the map."""
        return np.diff(self.edges)

    @cached_property
    def dz(self) -> Array:
        """Cell widths across."""
        return np.diff(self.z_edges)

    @property
    def area(self) -> Array:
        """Surface of the cells over their width around: the cell widths across of a cylinder."""
        return self.dz

    @property
    def half(self) -> bool:
        """Whether only the half from mid-plane to one bearing end is solved."""
        return bool(self.z_edges[0] == 0.0)

    @property
    def end_distances(self) -> tuple[float, float]:
        """Distances of the outermost cell centres to the ends of `z_edges`."""
        return float(self.z[0] - self.z_edges[0]), float(self.z_edges[-1] - self.z[-1])

    @cached_property
    def gz(self) -> Array:
        """Inverse distances between cell centres and to the ends (nz + 1,); 0 at mid-plane."""
        first, last = self.end_distances
        inverse = 1.0 / np.concatenate([[first], np.diff(self.z), [last]])
        if self.half:
            inverse[0] = 0.0
        return inverse

    @cached_property
    def cells(self) -> tuple[Array, Array, Array]:
        """Widths and surfaces of the cells across, and their inverse distances."""
        return self.dz, self.area, self.gz

    @property
    def shape(self) -> tuple[int, int]:
        """Cells around and across."""
        return self.angle.size, self.z.size

    def stretch(self, ratio: float) -> float:
        """Stretch of the Sommerfeld map at an eccentricity ratio, which may exceed 1."""
        return min(self.strength * ratio, FLATTEST)

    def angles(self, position: Array) -> Array:
        """Angle of each column of cells (nx,), rad, as the shaft stands at `position`."""
        if not self.polar:
            return self.angle
        stretch = self.stretch(float(np.hypot(*position[:2])))
        narrow = np.sqrt((1 - stretch) / (1 + stretch))
        turned = 2 * np.arctan(narrow * np.tan(0.5 * self.angle))
        return np.asarray(turned + np.arctan2(position[1], position[0]))

    @cached_property
    def order(self) -> NDArray[np.int64]:
        """Place of each column of cells in the band; a closed film is folded (0, N−1, 1, …)."""
        return folded(self.angle.size) if self.closed else np.arange(self.angle.size)

    @property
    def bandwidth(self) -> int:
        """Half bandwidth of the Jacobian."""
        return (2 if self.closed else 1) * self.z.size

    @cached_property
    def trigonometry(self) -> tuple[Array, Array]:
        """Cosine, sine and weight at the Gauss points between centres, and inside cells.

        Of the shape (3, nx + 1, nodes) and (3, nx, nodes).
        """
        a = self.angle
        ends = (a[-1] - 2 * np.pi, a[0] + 2 * np.pi) if self.closed else self.edges[[0, -1]]
        between = np.concatenate([[ends[0]], a, [ends[1]]])
        return _gauss(between, self.nodes), _gauss(self.edges, self.nodes)


def folded(count: int) -> NDArray[np.int64]:
    """Places in the band of columns of cells that run round: 0, N − 1, 1, N − 2 and so on."""
    turn = np.arange(count)
    return np.where(2 * turn < count, 2 * turn, 2 * (count - turn) - 1)


def _gauss(edges: Array, nodes: int) -> Array:
    """Cosine, sine and weight of Gauss points between `edges`, (3, intervals, nodes)."""
    x, w = np.polynomial.legendre.leggauss(nodes)
    half = 0.5 * np.diff(edges)[:, None]
    a = 0.5 * (edges[1:] + edges[:-1])[:, None] + half * x
    return np.stack([np.cos(a), np.sin(a), half * w])


def graded_share(cells: int) -> Array:
    """Edges of `cells` from mid-plane 0 to end 1 that crowd at the bearing end."""
    share = np.linspace(0.0, 1.0, cells + 1)
    return (1 - END_STRENGTH) * share + END_STRENGTH * np.sin(0.5 * np.pi * share)


@lru_cache(maxsize=32)
def build_mesh(
    width_ratio: float,
    grid: tuple[int, int],
    graded: bool,
    inlet: bool,
    supply: Supply | None,
    radius: float,
) -> Mesh:
    """Mesh of a bearing of width over diameter `width_ratio`.

    Parameters
    ----------
    width_ratio : float
        B/D.
    grid : tuple of int
        Cells around and across the full width (even).
    graded : bool
        Graded around the narrowest gap and toward the bearing ends, else uniform.
    inlet : bool
        Inlet line at the widest gap.
    supply : Supply or None
        Grooves of the shell; the mesh is then fixed to the shell, with edges on the grooves'.
    radius : float
        Of the shaft, m.
    """
    nx, nz = check_grid(grid)
    share = graded_share(nz // 2) if graded else np.linspace(0.0, 1.0, nz // 2 + 1)
    z_edges = width_ratio * share
    polar = supply is None and (graded or inlet)
    if supply is None:
        start = -np.pi if polar else 0.0
        edges = start + np.linspace(0.0, 2 * np.pi, nx + 1)
    else:
        edges = edges_around(nx, supply.grooves, radius)
        z_edges = edges_across(z_edges, supply.grooves, radius)
    return Mesh(
        edges=edges,
        z_edges=z_edges,
        closed=not inlet,
        polar=polar,
        strength=MAP_STRENGTH if graded and polar else 0.0,
        nodes=3 if graded else 1,
    )
