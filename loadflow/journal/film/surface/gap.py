"""Gap on a cone, a plane ring or a straight pad around a shaft that moves as a rigid body."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap.gap import KEPT
from loadflow.journal.film.gap.mesh import Mesh
from loadflow.journal.film.gap.shaped_mesh import even_cells
from loadflow.journal.film.surface import _surface_kernels as surface_kernel
from loadflow.journal.surfaces import Profile, Surface
from loadflow.journal.turbulence import RegimeNumbers
from loadflow.numerics.fields import require

Array = NDArray[np.float64]
_COARSEST = 10  # cells that are shared out between kinks, so that finer meshes are nested


@dataclass(frozen=True, eq=False)
class SurfaceMesh(Mesh):
    """Cells round the nodes of a ring or of a pad, in the isothermal coordinates of its surface.

    Nodes lie on the edges of the pad, where the pressure is given, and on the kinks and steps of
    its profile; unknown is the pressure of those between. So all errors go with the square of the
    cells.

    Attributes
    ----------
    surface : Surface
        Where the cells lie.
    nodes_around, nodes_across : array
        Nodes with those on the edges; around a closed ring the first comes again as the last.
    """

    surface: Surface
    nodes_around: Array
    nodes_across: Array

    @cached_property
    def angle(self) -> Array:
        """Angle of the nodes with unknown pressure."""
        return self.nodes_around[:-1] if self.closed else self.nodes_around[1:-1]

    @cached_property
    def z(self) -> Array:
        """Place ζ of the nodes with unknown pressure."""
        return self.nodes_across[1:-1]

    @cached_property
    def area(self) -> Array:
        """Surface of the cells over their width around, in R²."""
        return self.surface.area(self.z_edges)

    @property
    def half(self) -> bool:
        """Never: both halves differ."""
        return False

    @cached_property
    def gz(self) -> Array:
        """Inverse distances between nodes; 0 where no oil leaves at the ends."""
        inverse = 1.0 / np.diff(self.nodes_across)
        if not self.surface.open_ends:
            inverse[[0, -1]] = 0.0
        return inverse

    @cached_property
    def faces(self) -> Array:
        """Places ζ half-way between nodes (nz + 1,)."""
        return 0.5 * (self.nodes_across[1:] + self.nodes_across[:-1])

    @cached_property
    def between(self) -> Array:
        """Distances between nodes around (nx + 1,)."""
        widths = np.diff(self.nodes_around)
        return np.append(widths[-1], widths) if self.closed else widths

    @cached_property
    def weights(self) -> tuple[Array, Array]:
        """Weights of the nodes in integrals of p − p_edge, around and across (without metric)."""
        around = 0.5 * (self.between[1:] + self.between[:-1])
        across = np.diff(self.z_edges)
        if not self.closed:
            around = around * _ended(around.size)
        if self.surface.open_ends:
            across = across * _ended(across.size)
        return around, across

    @cached_property
    def carrying(self) -> Array:
        """Surface of the cells that loads act on, over their width around, in R²."""
        return self.weights[1] * self.surface.metric(self.z)


def _ended(count: int) -> Array:
    """Factors of the trapezoidal rule that correct it for the slope at both ends.

    h²/12 of the slope there, by three nodes beside the value 0 on the edge [Gregory's rule].
    """
    factors = np.ones(count)
    for part, change in enumerate((1.0 / 4.0, -1.0 / 8.0, 1.0 / 36.0)):
        factors[part] += change
        factors[-1 - part] += change
    return factors


@lru_cache(maxsize=32)
def surface_mesh(
    surface: Surface, angle: float, closed: bool, kinks: tuple[float, ...], grid: tuple[int, int]
) -> SurfaceMesh:
    """Mesh of a pad of the given angle (rad), or of a whole ring.

    Parameters
    ----------
    surface : Surface
        Where the film lies.
    angle : float
        Of the pad, which lies symmetric to angle 0.
    closed : bool
        Whether the film runs round.
    kinks : tuple of float
        Shares of the angle on which nodes must lie.
    grid : tuple of int
        Cells along the motion and across the full width.
    """
    nx, nz = int(grid[0]), int(grid[1])
    require(nx >= 8, "grid[0]", nx, "at least 8 cells along the motion")
    require(nz >= 4, "grid[1]", nz, "at least 4 cells across the width")
    twice, coarse = 1, nx
    while coarse % 2 == 0 and coarse // 2 >= _COARSEST:
        twice, coarse = 2 * twice, coarse // 2
    shares = even_cells(np.array([0.0, *kinks, 1.0]), coarse)
    inner = shares[:-1, None] + np.diff(shares)[:, None] * np.arange(twice) / twice
    around = angle * (np.append(inner, 1.0) - 0.5)
    across = surface.nodes(nz)
    middles = 0.5 * (around[1:] + around[:-1])
    return SurfaceMesh(
        edges=np.append(middles[-1] - angle, middles) if closed else middles,
        z_edges=0.5 * (across[1:] + across[:-1]),
        closed=closed,
        polar=False,
        strength=0.0,
        nodes=1,
        surface=surface,
        nodes_around=around,
        nodes_across=across,
    )


class SurfaceGap:
    """Gap ``H = H_0(φ) − Σ q_j N_j(φ, ζ)``; q: shifts (clearances) and rotations of the shaft.

    Rotations are in clearances per reference radius, about the first and the second axis.

    Parameters
    ----------
    mesh : SurfaceMesh
        Cells.
    profile : Profile
        What is cut into the pad.
    clearance : float
        Unit of the gap, m.
    base : float
        Gap of the centred shaft where nothing is cut, in clearances.
    """

    pads: NDArray[np.int64] = np.arange(0)  # one that tilts moves with its film
    roughness: float = 0.0
    open_share: Array | None = None
    regime: RegimeNumbers | None = None

    def __init__(
        self, mesh: SurfaceMesh, profile: Profile, clearance: float, base: float = 1.0
    ) -> None:
        self.mesh = mesh
        surface, nodes = mesh.surface, mesh.nodes_around
        span = float(np.ptp(nodes))

        def gap(angle: Array) -> Array:
            return base + profile.depth((angle - nodes[0]) / span) / clearance

        self._gap_of, self._motions = gap, surface.motions
        factors, self.across = self.motions(mesh.z)
        self._factors, self._ends = factors, self.motions(mesh.faces)[1]
        self.size = self.shaft = len(factors)
        self.dof_scale = np.ones(self.size)

        def sampled(start: Array, end: Array) -> tuple[Array, Array, Array]:
            angle = 0.5 * (start + end)
            return surface.basis(angle), end - start, gap(angle)

        middles = 0.5 * (nodes[1:] + nodes[:-1])
        whole = sampled(nodes[:-1], nodes[1:])
        before, after = sampled(middles, nodes[1:]), sampled(nodes[:-1], middles)
        self._between: tuple[Array, ...]
        self._round: tuple[Array, ...]
        if mesh.closed:
            self._between = tuple(np.concatenate([v[..., -1:], v], axis=-1) for v in whole)
            pairs = [(np.roll(a, 1, axis=-1), b) for a, b in zip(before, after)]
        else:
            self._between = whole
            pairs = [(a[..., :-1], b[..., 1:]) for a, b in zip(before, after)]
        self._round = tuple(np.stack(pair, axis=-1) for pair in pairs)
        self.around = np.ascontiguousarray(
            factors @ np.einsum("biq,iq->bi", self._round[0], self._round[1])
        )
        self.pressed = np.ascontiguousarray(factors @ (surface.basis(mesh.angle) * mesh.weights[0]))
        nx, nz = mesh.shape
        shape = (8, nx + 1, nz + 1)
        self.coefs, self._by = np.zeros((1 + self.size, *shape)), np.zeros((3, *shape))
        self.coef = self.coefs[0]
        inner = 1e-9 * np.diff(nodes)
        spots = np.concatenate([nodes[:-1] + inner, nodes[1:] - inner])
        self._spots, self._spots_basis = gap(spots), surface.basis(spots)
        self._spots_across = self.motions(mesh.nodes_across)[1]
        self.unmoved = np.eye(self.size)

    def motions(self, z: Array) -> tuple[Array, Array]:
        """Factors of the basis and of ζ of those motions of the shaft that move this gap."""
        factors, across = self._motions(z)
        rigid = self.mesh.surface.rigid
        return np.ascontiguousarray(factors[rigid]), np.ascontiguousarray(across[rigid])

    # --- what the film asks ----------------------------------------------------------------------
    def place(self, position: Array) -> Array:
        """Evaluate `coef` at `position`; the frame of the mesh is that of the shell."""
        shift = self._factors.T * position
        moved, ends = (np.ascontiguousarray(shift @ z) for z in (self.across, self._ends))
        basis, width, gap = self._between
        surface_kernel.between_nodes(basis, width, gap, moved, self.coef, self._by)
        basis, width, gap = self._round
        surface_kernel.around_nodes(basis, width, gap, moved, ends, self.coef, self._by)
        return self.unmoved

    def slopes(self, position: Array) -> Array:
        """Fill the derivatives in `coefs` where the shaft was last placed; returns the modes."""
        slopes = self.coefs[1:]
        for out, factors, across, ends in zip(slopes, self._factors, self.across, self._ends):
            surface_kernel.motion(self._by, factors, across, ends, out)
        return self.around[None]

    def share(self, position: Array, step: Array) -> float:
        """Share of a `step` after which every place keeps at least a third of its gap."""
        worst = float((self._closing(step) / self.gaps(position)).max())
        return min(1.0, (1.0 - KEPT) / worst if worst > 0 else 1.0)

    def advance(self, position: Array, step: Array) -> Array:
        """Position after `step`, of which every place keeps at least a third of its gap."""
        return position + self.share(position, step) * step

    def gaps(self, position: Array) -> Array:
        """Gap at the sampled places, in clearances."""
        return np.asarray(self._spots[:, None] - self._closing(position))

    def _closing(self, step: Array) -> Array:
        return np.asarray(self._spots_basis.T @ ((self._factors.T * step) @ self._spots_across))

    def narrowest(self, position: Array) -> float:
        """Narrowest gap over the clearance, that between nodes included."""
        least = float(self.gaps(position).min())
        moved = (self._factors.T * position) @ self._spots_across
        nodes = self.mesh.nodes_around
        angle = np.arctan2(moved[1], moved[0])
        inside = (angle > nodes[0]) & (angle < nodes[-1]) & moved[:2].any(axis=0)
        if inside.any():
            basis = self.mesh.surface.basis(angle[inside])
            closing = np.einsum("bi,bi->i", basis, moved[:, inside])
            least = min(least, float((self._gap_of(angle[inside]) - closing).min()))
        return least

    def facing(self, position: Array) -> Array:
        """By how much each degree of freedom closes the narrowest of the sampled places, (m,)."""
        gaps = self.gaps(position)
        i, k = np.unravel_index(gaps.argmin(), gaps.shape)
        return np.asarray((self._factors @ self._spots_basis[:, i]) * self._spots_across[:, k])

    def shear(self, position: Array) -> float:
        """∫ (r/R)² / H dA over the whole surface, in units of R² per clearance."""
        mesh, surface = self.mesh, self.mesh.surface
        basis, width, gap = self._between
        if mesh.closed:
            basis, width, gap = basis[:, 1:], width[1:], gap[1:]
        places = mesh.nodes_across if surface.open_ends else mesh.z
        closing = (self._factors.T * position) @ self.motions(places)[1]
        gaps = gap[:, None] - basis.T @ closing
        if surface.open_ends:
            weights = np.zeros(places.size)
            weights[:-1] = weights[1:] = 0.5 * np.diff(places)
            weights[1:-1] = 0.5 * (places[2:] - places[:-2])
        else:
            weights = mesh.dz
        return float(width @ (1.0 / gaps) @ (weights * surface.metric(places) ** 2))
