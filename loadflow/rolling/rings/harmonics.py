"""Finite elements over the section of a ring, harmonics around it, by scikit-fem.

In harmonic n the ring moves by (u cos nθ, v sin nθ, w cos nθ) and by the same turned by a quarter
wave, u, v, w over the section from quadratic elements. Matrices are per unit of ∫cos² nθ dθ.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from loadflow.errors import InputError
from loadflow.rolling.contacts import Array

if TYPE_CHECKING:
    from loadflow.rolling.rings.patches import PatchPoints
    from loadflow.rolling.rings.solid_section import SolidSection

_EXACT, _GROWTH = 12, 1.2  # harmonics solved one by one, and spacing of the others


@dataclass(frozen=True, eq=False)
class SectionSystem:
    """Matrices of a ring, its section in finite elements.

    Attributes
    ----------
    ring : SolidSection
        The ring.
    """

    ring: SolidSection

    @cached_property
    def basis(self) -> Any:
        """Quadratic elements with three components over the section."""
        from skfem import Basis, ElementQuad2, ElementVector, MeshQuad

        radius, height = self.ring.profile.grid(self.ring.across)
        rows, cols = radius.shape
        mesh = MeshQuad.init_tensor(np.arange(rows, dtype=float), np.arange(cols, dtype=float))
        i, j = mesh.p.round().astype(int)
        mesh = MeshQuad(np.stack([radius[i, j], height[i, j]]), mesh.t)
        return Basis(mesh, ElementVector(ElementQuad2(), 3), intorder=5)

    @cached_property
    def _powers(self) -> tuple[Any, Any, Any]:
        """Stiffness as a polynomial in n: its constant, linear and square part."""
        stiffness = [self._assemble(n) for n in (0, 1, -1)]
        constant = stiffness[0]
        linear = (stiffness[1] - stiffness[2]) / 2
        return constant, linear, (stiffness[1] + stiffness[2]) / 2 - constant

    def stiffness(self, n: int) -> Any:
        """Stiffness of harmonic n, sparse, with the bed of the held face."""
        constant, linear, square = self._powers
        return (constant + n * linear + n**2 * square).tocsc()

    def _assemble(self, n: int) -> Any:
        from skfem import BilinearForm, FacetBasis, asm

        basis, ring = self.basis, self.ring
        lam, mu = ring.lame

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
            springs = enumerate(ring.springs)
            return w.x[0] * sum(k * u[c] * v[c] for c, k in springs)

        face = FacetBasis(basis.mesh, basis.elem, facets=basis.mesh.facets_satisfying(ring.on_face))
        return asm(elastic, basis) + asm(bedding, face)

    @cached_property
    def mass(self) -> Any:
        """Mass, sparse, the same in all harmonics."""
        from skfem import BilinearForm, asm

        density = self.ring.density

        @BilinearForm
        def inertia(u: Any, v: Any, w: Any) -> Any:
            return density * w.x[0] * (u[0] * v[0] + u[1] * v[1] + u[2] * v[2])

        return asm(inertia, self.basis).tocsc()


@dataclass(frozen=True, eq=False)
class Patches:
    """Unit loads on the raceway patches of a ring, spread evenly over their width in the section.

    Attributes
    ----------
    loads : ndarray, shape (unknown, 3 kind)
        In r, θ, z for each kind of patch.
    normals : ndarray, shape (kind, 2)
        Of the raceway at each kind, (r, z).
    length : float
        Width of a patch in the section, m.
    """

    loads: Array
    normals: Array
    length: float

    @classmethod
    def on(cls, system: SectionSystem, points: PatchPoints) -> Patches:
        """Find the patches, 10° of the groove to both sides of each point.

        Raises
        ------
        InputError
            If a point is not on the raceway side of the section.
        """
        from skfem import FacetBasis, Functional, LinearForm, asm

        basis, profile = system.basis, system.ring.profile
        reach = profile.patch_half
        loads, normals, lengths = [], [], []
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
            normals.append([Functional(lambda w, c=c: w.n[c]).assemble(patch) for c in range(2)])
            lengths.append(length)
        return cls(np.stack(loads, axis=1), np.array(normals), float(np.mean(lengths)))


@dataclass(frozen=True, eq=False)
class RingWave:
    """A wave around the ring as equally spaced balls see it.

    Attributes
    ----------
    order, family : int
        Harmonic, and which of its two families: 0 is (cos, sin, cos), 1 is (sin, -cos, sin).
    loads : ndarray, shape (unknown, 3 kind)
        Unit loads on the patches.
    factor : ndarray, shape (3 kind, mode)
        Amplitudes of the patches in modes of unit stiffness.
    """

    order: int
    family: int
    loads: Array
    factor: Array

    def values(self, balls: int) -> Array:
        """Of r, θ and z at the balls, (ball, 3), the first ball at azimuth 0."""
        angle = self.order * 2 * np.pi * np.arange(balls) / balls
        cos, sin = np.cos(angle), np.sin(angle)
        return np.stack([cos, sin, cos] if self.family == 0 else [sin, -cos, sin], axis=-1)

    def components(self, balls: int) -> Any:
        """Which of the 3 kind components the balls see at all."""
        alone = 2 * self.order % balls == 0
        tangential = np.arange(self.loads.shape[1]) % 3 == 1
        return (tangential == (self.family == 1)) | (not alone)

    @property
    def weight(self) -> float:
        """∫cos² around the ring, π or 2π."""
        return 2 * math.pi if self.order == 0 else math.pi


def harmonic_compliances(system: SectionSystem, patches: Patches, highest: int) -> Array:
    """Compliance of the patches in harmonics 0 … `highest`, (harmonic, 3 kind, 3 kind).

    The first ones are solved one by one; the others, smooth in log n, at some and in between by
    splines.
    """
    from scipy.interpolate import CubicSpline
    from scipy.sparse.linalg import splu

    solved = _solved_harmonics(highest)
    loads = patches.loads
    values = np.stack([loads.T @ splu(system.stiffness(n)).solve(loads) for n in solved])
    values = (values + values.transpose(0, 2, 1)) / 2
    if len(solved) == highest + 1:
        return values
    n = np.arange(highest + 1)
    smooth = CubicSpline(np.log1p(solved), values * (1.0 + np.array(solved))[:, None, None])
    return smooth(np.log1p(n)) / (1.0 + n)[:, None, None]


def _solved_harmonics(highest: int) -> list[int]:
    """Harmonics to solve: the first, then ever fewer, and the last."""
    solved = list(range(min(_EXACT, highest) + 1))
    while solved[-1] < highest:
        solved.append(min(max(round(solved[-1] * _GROWTH), solved[-1] + 1), highest))
    return solved


def fold(compliance: Array, balls: int) -> list[tuple[int, float, Array]]:
    """Gather harmonics that look alike at equally spaced balls.

    Returns (m, share of a unit matrix over all balls, compliance) for m = 0 … balls/2. Harmonics
    k balls ± m take the values of harmonic m there, the tangential wave reversed for the minus.
    """
    size = compliance.shape[1]
    reversed_ = np.where(np.arange(size) % 3 == 1, -1.0, 1.0)
    mirrored = compliance * reversed_ * reversed_[:, None]
    classes = []
    for m in range(balls // 2 + 1):
        folded = compliance[m::balls].sum(axis=0)
        alone = 2 * m % balls == 0
        if not alone:
            folded = folded + mirrored[balls - m :: balls].sum(axis=0)
        classes.append((m, (1 if alone else 2) / balls, folded))
    return classes
