"""A ring as a solid, meshed all round; the reference for the cheaper models of rings."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from annotated_types import Ge, Le

from loadflow.errors import InputError
from loadflow.rolling.contact import Array
from loadflow.rolling.options import check_fields
from loadflow.rolling.patches import PatchPoints
from loadflow.rolling.ring_fem import SolidSection


@dataclass(frozen=True, kw_only=True)
class SolidRing(SolidSection):
    """A ring of quadratic hexahedra, condensed to its raceway patches.

    The fields of `SolidSection`, and:

    Attributes
    ----------
    around : int
        Elements around the ring; each ball must sit on one of their `around` planes.
    sectors : tuple of (float, float), optional
        (centre, width) of the sectors in which the face is held, rad; all round if None.
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
            If a patch is not on a line of nodes of the raceway.
        ImportError
            Without scikit-fem.
        """
        from scipy.sparse.linalg import splu

        basis = self._basis()
        stiffness = self._stiffness(basis)
        loads = self._patch_loads(basis, points)
        inverse = splu(stiffness, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
        compliance = loads.T @ inverse.solve(loads)
        values, vectors = np.linalg.eigh((compliance + compliance.T) / 2)
        kept = values > 1e-12 * values[-1]
        factor = vectors[:, kept] * np.sqrt(values[kept])
        return factor.reshape(len(points.radius), len(points.azimuth), 3, -1)

    def _basis(self) -> Any:
        """Hexahedra from the section turned round the axis, closed to a ring."""
        from skfem import Basis, ElementHexS2, ElementVector, MeshHex

        radius, height = self.profile.grid(self.across)
        rows, cols = radius.shape
        lines = (np.arange(n, dtype=float) for n in (rows, cols, self.around + 1))
        mesh = MeshHex.init_tensor(*lines)
        i, j, k = mesh.p.round().astype(int)
        k %= self.around
        angle = 2 * math.pi * k / self.around
        r = radius[i, j]
        places = np.stack([r * np.cos(angle), r * np.sin(angle), height[i, j]])
        _, first, same = np.unique((i * cols + j) * self.around + k, True, True)
        ring = MeshHex(places[:, first], same.ravel()[mesh.t])
        return Basis(ring, ElementVector(ElementHexS2()), intorder=4)

    def _stiffness(self, basis: Any) -> Any:
        """Stiffness with the bed of the held face."""
        from skfem import BilinearForm, FacetBasis, asm
        from skfem.models.elasticity import linear_elasticity

        def held(x: Array) -> Any:
            angle = np.arctan2(x[1], x[0])
            inside = self.sectors is None or np.any(
                [np.abs((angle - c + math.pi) % (2 * math.pi) - math.pi) < w / 2
                 for c, w in self.sectors],
                axis=0,
            )  # fmt: skip
            # a flat facet's middle lies inside of the circle, by 1 - cos of half its angle
            r = np.hypot(x[0], x[1]) / (
                math.cos(math.pi / self.around) if self.held == "back" else 1
            )
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

    def _patch_loads(self, basis: Any, points: PatchPoints) -> Array:
        """Unit loads (r, θ, z) on each patch, (unknown, patch and component)."""
        from scipy.spatial import cKDTree

        nodes = cKDTree(basis.doflocs[:, ::3].T)  # three unknowns for each
        line = np.column_stack([part[:, 0] for part in self.profile.grid(self.across)])
        size = np.linalg.norm(np.diff(line, axis=0), axis=1)
        reach = 1.05 * self.profile.bearing.groove(self.profile.ring) * math.radians(10)
        loads = np.zeros((basis.N, len(points.radius), len(points.azimuth), 3))
        for kind, place in enumerate(zip(points.radius, points.height)):
            middle = (line[:-1] + line[1:]) / 2
            edges = np.flatnonzero(np.linalg.norm(middle - place, axis=1) < reach)
            if not len(edges):
                raise InputError(f"profile: no raceway at radius and height {place} m of the patch")
            for ball, angle in enumerate(points.azimuth):
                frame = np.array([[math.cos(angle), math.sin(angle)],
                                  [-math.sin(angle), math.cos(angle)]])  # fmt: skip
                for e in edges:
                    # Simpson's weights of a quadratic edge
                    for r, z, share in zip(
                        (line[e, 0], middle[e, 0], line[e + 1, 0]),
                        (line[e, 1], middle[e, 1], line[e + 1, 1]),
                        (1 / 6, 4 / 6, 1 / 6),
                    ):
                        gap, node = nodes.query([*(r * frame[0]), z])
                        if gap > 1e-6 * r:
                            raise InputError(
                                f"around: the ball at {angle:g} rad is not on one of "
                                f"{self.around} lines of nodes"
                            )
                        weight = share * size[e] / size[edges].sum()
                        loads[3 * node : 3 * node + 2, kind, ball, 0] += weight * frame[0]
                        loads[3 * node : 3 * node + 2, kind, ball, 1] += weight * frame[1]
                        loads[3 * node + 2, kind, ball, 2] += weight
        return loads.reshape(basis.N, -1)
