"""Finite-element rings, condensed to their raceway patches; needs scikit-fem (``loadflow[fem]``).

`FiniteElementRing` meshes the section and takes the ring in Fourier harmonics; a force on a patch
is spread evenly over the width of the patch across the groove, and its displacement is the mean
over the same width, so that the compliance is symmetric.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
from annotated_types import Ge, Gt, Le

from loadflow.errors import InputError
from loadflow.rolling.contact import Array
from loadflow.rolling.options import check_choice, check_fields
from loadflow.rolling.patches import PatchPoints
from loadflow.rolling.ring_profile import RingProfile
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON

FACES = ("bottom", "top", "back")


@dataclass(frozen=True, kw_only=True)
class SolidSection:
    """What finite-element rings share: section, material, and the face that holds the ring.

    Attributes
    ----------
    profile : RingProfile
        Section with its grooves.
    held : {"bottom", "top", "back"}
        Face on an elastic bed: below, above, or opposite the raceways.
    bed, grip : float
        Stiffness of the bed across and along the face, N/m³; 1e15 is as good as clamped for steel,
        a small `grip` lets the ring slide on its face.
    across : int
        Elements across the ring (quadratic); 3 to 5 suffice.
    elastic_modulus, poisson_ratio : float
        Pa and 1.

    Raises
    ------
    InputError
        If a field is out of its range.
    """

    profile: RingProfile
    held: Literal["bottom", "top", "back"]
    bed: Annotated[float, Gt(0)] = 1e15
    grip: Annotated[float, Gt(0)] = 1e15
    across: Annotated[int, Ge(1), Le(40)] = 4
    elastic_modulus: Annotated[float, Gt(0)] = STEEL_MODULUS
    poisson_ratio: Annotated[float, Ge(0), Le(0.49)] = STEEL_POISSON

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "held", FACES)

    @property
    def lame(self) -> tuple[float, float]:
        """Lamé's constants λ, μ, Pa."""
        e, nu = self.elastic_modulus, self.poisson_ratio
        return e * nu / ((1 + nu) * (1 - 2 * nu)), e / (2 * (1 + nu))

    @property
    def springs(self) -> tuple[float, float, float]:
        """Stiffness of the bed in r, θ, z, N/m³."""
        if self.held == "back":
            return self.bed, self.grip, self.grip
        return self.grip, self.grip, self.bed

    def on_face(self, x: Array) -> Any:
        """Whether places (r, z, …) lie on the held face."""
        profile = self.profile
        size = profile.top - profile.bottom
        place, face = {
            "bottom": (x[1], profile.bottom),
            "top": (x[1], profile.top),
            "back": (x[0], profile._back),
        }[self.held]
        return np.abs(place - face) < 1e-9 * size


@dataclass(frozen=True, kw_only=True)
class FiniteElementRing(SolidSection):
    """A rotationally symmetric ring: finite elements over the section, harmonics around it.

    The fields of `SolidSection`, and:

    Attributes
    ----------
    harmonics : int
        Highest harmonic around the ring.
    """

    harmonics: Annotated[int, Ge(1), Le(400)] = 48

    def flexibility(self, points: PatchPoints) -> Array:
        """Factor Q, (kind, ball, 3, mode), of C = Q Qᵀ; see `RingBeam.flexibility`.

        Raises
        ------
        InputError
            If a patch is not on the raceway side of the section.
        ImportError
            Without scikit-fem.
        """
        from scipy.sparse.linalg import splu

        basis = self._basis()
        stiffness = [self._stiffness(basis, n) for n in (0, 1, -1)]
        constant = stiffness[0]
        linear = (stiffness[1] - stiffness[2]) / 2
        square = (stiffness[1] + stiffness[2]) / 2 - constant
        loads = self._patch_loads(basis, points)
        kinds, balls = len(points.radius), len(points.azimuth)
        columns = []
        for n in range(self.harmonics + 1):
            matrix = constant + n * linear + n**2 * square
            compliance = loads.T @ splu(matrix.tocsc()).solve(loads)
            compliance /= math.pi * (2 if n == 0 else 1)
            factor = np.linalg.cholesky(_regular(compliance)).reshape(kinds, 1, 3, -1)
            cos, sin = np.cos(n * points.azimuth), np.sin(n * points.azimuth)
            waves = np.stack([[cos, sin, cos], [sin, -cos, sin]], axis=-1)  # both families
            columns += [factor * waves[:, :, f].T[None, :, :, None] for f in range(2)]
        return np.concatenate(columns, axis=-1).reshape(kinds, balls, 3, -1)

    def _basis(self) -> Any:
        """Quadratic elements with three components over the section."""
        from skfem import Basis, ElementQuad2, ElementVector, MeshQuad

        radius, height = self.profile.grid(self.across)
        rows, cols = radius.shape
        mesh = MeshQuad.init_tensor(np.arange(rows, dtype=float), np.arange(cols, dtype=float))
        i, j = mesh.p.round().astype(int)
        mesh = MeshQuad(np.stack([radius[i, j], height[i, j]]), mesh.t)
        return Basis(mesh, ElementVector(ElementQuad2(), 3), intorder=5)

    def _stiffness(self, basis: Any, n: int) -> Any:
        """Stiffness of harmonic n per unit of ∫cos² nθ dθ, with the bed."""
        from skfem import BilinearForm, FacetBasis, asm

        lam, mu = self.lame

        def strains(u: Any, r: Array) -> tuple[Array, ...]:
            value, slope = u, u.grad
            return (
                slope[0, 0],
                (value[0] + n * value[1]) / r,
                slope[2, 1],
                slope[0, 1] + slope[2, 0],
                slope[1, 0] - (n * value[0] + value[1]) / r,
                slope[1, 1] - n * value[2] / r,
            )

        @BilinearForm
        def elastic(u: Any, v: Any, w: Any) -> Any:
            a, b = strains(u, w.x[0]), strains(v, w.x[0])
            volume = lam * (a[0] + a[1] + a[2]) * (b[0] + b[1] + b[2])
            normal = 2 * mu * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
            return (volume + normal + mu * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])) * w.x[0]

        @BilinearForm
        def bedding(u: Any, v: Any, w: Any) -> Any:
            springs = enumerate(self.springs)
            return w.x[0] * sum(k * u[c] * v[c] for c, k in springs)

        face = FacetBasis(basis.mesh, basis.elem, facets=basis.mesh.facets_satisfying(self.on_face))
        return asm(elastic, basis) + asm(bedding, face)

    def _patch_loads(self, basis: Any, points: PatchPoints) -> Array:
        """Unit loads on each kind of patch, (unknown, 3 kind), one for each component."""
        from skfem import FacetBasis, LinearForm, asm

        reach = self.profile.bearing.groove(self.profile.ring) * math.radians(10)
        loads = []
        for radius, height in zip(points.radius, points.height):

            def near(x: Array, r: float = radius, z: float = height) -> Any:
                return np.hypot(x[0] - r, x[1] - z) < 1.05 * reach

            facets = basis.mesh.facets_satisfying(near, boundaries_only=True)
            if not len(facets):
                raise InputError(
                    f"profile: no raceway at radius {radius:g}, height {height:g} m of the patch"
                )
            patch = FacetBasis(basis.mesh, basis.elem, facets=facets)
            length = asm(LinearForm(lambda v, w: v[0]), patch).sum()
            loads += [asm(LinearForm(lambda v, w, c=c: v[c]), patch) / length for c in range(3)]
        return np.stack(loads, axis=1)


def _regular(compliance: Array) -> Array:
    """Symmetric part, lifted off zero by rounding, so that it has a Cholesky factor."""
    lift = 1e-12 * np.trace(compliance) / len(compliance)
    return (compliance + compliance.T) / 2 + lift * np.eye(len(compliance))
