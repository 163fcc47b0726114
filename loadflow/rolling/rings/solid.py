"""A ring as a solid, meshed all round; the reference for the cheaper models of rings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from annotated_types import Ge, Le

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields
from loadflow.rolling.contacts import Array
from loadflow.rolling.rings.local_compliance import half_space, local_block, semidefinite_factor
from loadflow.rolling.rings.patches import PatchPoints
from loadflow.rolling.rings.profile import graded
from loadflow.rolling.rings.solid_section import SolidSection


@dataclass(frozen=True, kw_only=True)
class SolidRing(SolidSection):
    """A ring of quadratic hexahedra, condensed to its raceway patches (Guyan).

    The fields of `SolidSection`, and:

    Attributes
    ----------
    around : int
        Least number of elements around the ring; two narrow ones carry the patch of each ball.
    sectors : tuple of (float, float), optional
        (centre, width) of the sectors in which the face is held, rad; all round if None.

    Examples
    --------
    >>> from loadflow.rolling import RingProfile, SlewingBearing, SolidRing
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> profile = RingProfile(bearing=bearing, ring="outer", inside=0.51, outside=0.62,
    ...     bottom=-0.04, top=0.04)
    >>> SolidRing(profile=profile, held="bottom", sectors=((0.0, 0.8),)).around
    45
    """

    around: Annotated[int, Ge(8), Le(1000)] = 45
    sectors: tuple[tuple[float, float], ...] | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        check_fields(self)

    def flexibility(self, points: PatchPoints) -> Array:
        """Factor Q, (kind, ball, 3, mode), of C = Q Qᵀ; see `RingBeam.flexibility`.

        Raises
        ------
        InputError
            If a patch is not on the raceway.
        """
        from scipy.linalg import block_diag
        from scipy.sparse.linalg import splu

        stations = self._stations(points)
        basis = self._basis(stations)
        stiffness = self._stiffness(basis, stations)
        loads, blocks = self._patch_loads(basis, points, stations)
        inverse = splu(stiffness, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
        compliance = loads.T @ inverse.solve(loads)
        compliance -= block_diag(*np.repeat(blocks, len(points.azimuth), axis=0))
        factor = semidefinite_factor(compliance)
        return factor.reshape(len(points.radius), len(points.azimuth), 3, -1)

    def _stations(self, points: PatchPoints) -> Array:
        """Azimuths of the planes between elements: of each ball, its patch, and between patches."""
        side = max(length for *_, length, _ in self._patches(points))
        balls = np.sort(points.azimuth % (2 * math.pi))
        gaps = np.diff(np.append(balls, balls[0] + 2 * math.pi))
        half = min(side / 2 / float(points.radius.mean()), gaps.min() / 3)
        steps = max(1, math.ceil((self.around / len(balls) - 2) / 2))
        planes = []
        for ball, gap in zip(balls, gaps):
            ends = (gap / 2 - half) * graded(steps, 1.5 * half / (gap / 2 - half))
            planes.append([ball, *(ball + half + ends), *(ball + gap - half - ends[-2::-1])])
        return np.concatenate(planes)

    def _patches(self, points: PatchPoints) -> list[tuple[Array, float, Array]]:
        """Edges (edge, 3, 2) of each kind of patch (low, middle, high), its length and normal."""
        line = np.column_stack([part[:, 0] for part in self.profile.grid(self.across)])
        edges = np.stack([line[:-1], (line[:-1] + line[1:]) / 2, line[1:]], axis=1)
        reach = 1.05 * self.profile.patch_half
        patches = []
        for place in zip(points.radius, points.height):
            chosen = edges[np.linalg.norm(edges[:, 1] - place, axis=1) < reach]
            if not len(chosen):
                raise InputError(f"profile: no raceway at radius and height {place} m of the patch")
            across = chosen[-1, 2] - chosen[0, 0]
            length = float(np.linalg.norm(chosen[:, 2] - chosen[:, 0], axis=1).sum())
            patches.append((chosen, length, np.array([-across[1], across[0]])))
        return patches

    def _basis(self, stations: Array) -> Any:
        """Hexahedra from the section turned round the axis, closed to a ring."""
        from skfem import Basis, ElementHexS2, ElementVector, MeshHex

        radius, height = self.profile.grid(self.across)
        rows, cols = radius.shape
        around = len(stations)
        mesh = MeshHex.init_tensor(*(np.arange(n, dtype=float) for n in (rows, cols, around + 1)))
        i, j, k = mesh.p.round().astype(int)
        k %= around
        r, angle = radius[i, j], stations[k]
        places = np.stack([r * np.cos(angle), r * np.sin(angle), height[i, j]])
        _, first, same = np.unique((i * cols + j) * around + k, True, True)
        ring = MeshHex(np.ascontiguousarray(places[:, first]), same.ravel()[mesh.t])
        return Basis(ring, ElementVector(ElementHexS2()), intorder=4)

    def _stiffness(self, basis: Any, stations: Array) -> Any:
        """Stiffness with the bed of the held face."""
        from skfem import BilinearForm, FacetBasis, asm
        from skfem.models.elasticity import linear_elasticity

        halves = np.diff(np.append(stations, stations[0] + 2 * math.pi)) / 2

        def held(x: Array) -> Any:
            angle = np.arctan2(x[1], x[0])
            inside = self.sectors is None or np.any(
                [np.abs((angle - c + math.pi) % (2 * math.pi) - math.pi) < w / 2
                 for c, w in self.sectors],
                axis=0,
            )  # fmt: skip
            # a flat facet's middle lies inside of the circle, by 1 - cos of half its angle
            element = np.searchsorted(stations, stations[0] + (angle - stations[0]) % (2 * np.pi))
            r = np.hypot(x[0], x[1])
            if self.held == "back":
                r = r / np.cos(halves[element - 1])
            return inside & self.on_face(np.array([r, x[2]]))

        radial, along, axial = self.springs

        @BilinearForm
        def bedding(u: Any, v: Any, w: Any) -> Any:
            r = np.hypot(w.x[0], w.x[1])
            cos, sin = w.x[0] / r, w.x[1] / r
            a, b = u, v
            outward = (a[0] * cos + a[1] * sin) * (b[0] * cos + b[1] * sin)
            sideways = (a[1] * cos - a[0] * sin) * (b[1] * cos - b[0] * sin)
            return radial * outward + along * sideways + axial * a[2] * b[2]

        facets = basis.mesh.facets_satisfying(held, boundaries_only=True)
        if not len(facets):
            raise InputError("sectors: no element lies within them")
        face = FacetBasis(basis.mesh, basis.elem, facets=facets, intorder=4)
        return (asm(linear_elasticity(*self.lame), basis) + asm(bedding, face)).tocsc()

    def _patch_loads(self, basis: Any, points: PatchPoints, stations: Array) -> tuple[Array, Array]:
        """Unit loads (r, θ, z) on each patch, (unknown, patch and component), and local blocks.

        A patch is 10° of the groove to both sides of its point, on the elements to both sides of
        its ball; the blocks (kind, 3, 3) are what a half-space yields under it.
        """
        from scipy.spatial import cKDTree

        nodes = cKDTree(basis.doflocs[:, ::3].T)  # three unknowns for each
        half = float(stations[1] - stations[0]) / 2  # half the angle of an element beside a ball
        loads = np.zeros((basis.N, len(points.radius), len(points.azimuth), 3))
        blocks = []
        for kind, (edges, length, normal) in enumerate(self._patches(points)):
            width = 4 * math.tan(half) * points.radius[kind]
            yields = half_space(length, width, self.elastic_modulus, self.poisson_ratio)
            blocks.append(local_block(normal, yields))
            places = [
                (at, turn, weight * float(np.linalg.norm(edge[2] - edge[0])) / (2 * length))
                for edge in edges
                for at, turn, weight in _face(edge, half)
            ]
            for ball, angle in enumerate(points.azimuth):
                cos, sin = math.cos(angle), math.sin(angle)
                frame = np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])
                for (r, z), turn, weight in places:
                    _, node = nodes.query(
                        [r * math.cos(angle + turn), r * math.sin(angle + turn), z]
                    )
                    loads[3 * node : 3 * node + 3, kind, ball] += weight * frame
        return loads.reshape(basis.N, -1), np.array(blocks)


def _face(edge: Array, half: float) -> Iterator[tuple[Array, float, float]]:
    """Nodes of the quadratic faces to both sides of a ball: (r, z), azimuth, consistent weight.

    Faces are flat, `half` is half the angle of one; their middle nodes lie on its chord.
    """
    low, middle, high = edge
    for side in (2 * half, -2 * half):
        for turn in (0.0, side):
            yield low, turn, -1 / 12
            yield high, turn, -1 / 12
            yield middle, turn, 1 / 3
        for end in (low, high):
            yield end * [math.cos(half), 1], side / 2, 1 / 3
