"""Rings as curved beams: stretch, both bendings, shear and twist of the section, in harmonics.

Each section stays plane and keeps its shape: it moves by (u, v, w) radially, tangentially, axially
and turns by (ψ_r, ψ_θ, ψ_z). At (ρ, ζ) from the centroid, r = R + ρ, this strains the ring by

    ε_θ  = [(u + v') + ρ ψ_z' + ζ (ψ_θ - ψ_r')]/r
    γ_rθ = [(u' - v + R ψ_z) + ζ (ψ_θ' + ψ_r)]/r
    γ_zθ = [(w' - R ψ_r) - ρ (ψ_θ' + ψ_r)]/r

with ' = d/dθ. The integrals over the section take 1/r to second order in ρ/R; twist works against
J and shear against the reduced area. Uniform radial load q gives u = q R²/(E A) and uniform twist m
gives ψ_θ = m R²/(E ∫ζ² dA), as the simplest ring formulas do; the product of inertia and springs
beside the centroid couple both, which makes tension differ from compression.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from annotated_types import Ge, Gt, Le

from loadflow.errors import InputError, SolverError
from loadflow.numerics.fields import check_fields
from loadflow.rolling.contacts import Array
from loadflow.rolling.rings.bolts import BoltCircle, bolts_of
from loadflow.rolling.rings.patches import PatchPoints
from loadflow.rolling.rings.section import LARGEST, RingSection, Support
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON

FIELDS = 6  # u, v, w, ψ_r, ψ_θ, ψ_z


@dataclass(frozen=True, kw_only=True)
class RingBeam:
    """A bearing ring as a curved beam.

    Attributes
    ----------
    section : RingSection
        Constants of the cross section.
    radius, height : float
        Centroid of the section: distance from the axis, and axial position above the centre of the
        bearing, m.
    supports : tuple of Support or BoltCircle
        What holds the ring to its structure. Without any, the ring keeps its shape free and only
        its mean rigid motion is held (the reaction is spread all round).
    elastic_modulus, poisson_ratio : float
        Pa and 1.
    harmonics : int
        Highest Fourier harmonic around the ring.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> from loadflow.rolling import RingBeam, RingSection, Support
    >>> ring = RingBeam(
    ...     section=RingSection.rectangle(0.1, 0.12), radius=0.3,
    ...     supports=(Support.wall(radius=0.3, height=0.06, thickness=0.03, length=0.3),),
    ... )
    >>> ring.harmonics
    32
    """

    section: RingSection
    radius: Annotated[float, Gt(0), Le(LARGEST)]
    height: float = 0.0
    supports: tuple[Support | BoltCircle, ...] = ()
    elastic_modulus: Annotated[float, Gt(0)] = STEEL_MODULUS
    poisson_ratio: Annotated[float, Ge(0), Le(0.5)] = STEEL_POISSON
    harmonics: Annotated[int, Ge(1), Le(400)] = 32

    kind: ClassVar[str] = "beam"

    def __post_init__(self) -> None:
        check_fields(self)
        if any(bolts.height == self.height for bolts in bolts_of(self)):
            raise InputError("supports: bolts must clamp a face of the ring, not its centroid")

    def of(self, bearing: object, ring: str) -> RingBeam:
        """The ring of a bearing: its section says all."""
        return self

    def flexibility(self, points: PatchPoints) -> Array:
        """Factor Q of the compliance C = Q Qᵀ of the ring at its raceway patches.

        Parameters
        ----------
        points : PatchPoints
            Where the patches ride on the ring.

        Returns
        -------
        ndarray, shape (kind, ball, 3, mode)
            Radial, tangential, axial displacement of each patch, m, in each mode of unit stiffness.

        Raises
        ------
        SolverError
            If the supports leave the ring a motion without resistance.
        """
        try:
            return self._factor(points)
        except np.linalg.LinAlgError:
            message = "supports: they leave the ring free to move as a rigid body"
            raise SolverError(message) from None

    def _factor(self, points: PatchPoints) -> Array:
        """Flexibility; a singular stiffness raises LinAlgError."""
        from scipy.linalg import solve_triangular

        stiffness, reach = self.stiffness(), self._patch_motion(points)
        if not self.supports:
            shapes = _deformations(self.harmonics, self.radius)
            stiffness, reach = shapes.T @ stiffness @ shapes, reach @ shapes
        # rotations and displacements, and low and high harmonics, differ by orders of magnitude
        size = np.sqrt(np.diag(stiffness))
        if not size.all():
            raise np.linalg.LinAlgError
        factor = np.linalg.cholesky(stiffness / np.outer(size, size))
        if np.diag(factor).min() < 1e-7:
            raise np.linalg.LinAlgError
        patches = (reach / size).reshape(-1, len(size))
        return solve_triangular(factor, patches.T, lower=True).T.reshape(reach.shape)

    def stiffness(self) -> Array:
        """Stiffness of the ring with its supports over the harmonics of the six fields.

        Ordered (harmonic, field); harmonics 1, cos θ, sin θ, cos 2θ, …. SI units.
        """
        theta = 2 * np.pi * np.arange(2 * self.harmonics + 2) / (2 * self.harmonics + 2)
        weight = np.full(theta.shape, 2 * np.pi / len(theta))
        stiffness = _integrate(self._strains(theta), self._elasticity(), weight)
        for support in (held.springs for held in self.supports):
            theta, weight = _quadrature(support, self.harmonics)
            springs = np.array([support.radial, support.tangential, support.axial, support.tilt])
            moved = self._motion(theta, support.radius, support.height)
            turned = _fields(theta, self.harmonics)[:, 4:5]
            stiffness += _integrate(
                np.concatenate([moved, turned], axis=1),
                np.diag(springs),
                weight * support.radius,
            )
        return stiffness

    def _elasticity(self) -> Array:
        """Stiffness of the six strains (e, ψ_z', ψ_θ - ψ_r', twist, two shears) per radian."""
        section, big = self.section, self.radius
        i_z, i_r, i_rz = section.inertia_axial, section.inertia_radial, section.inertia_product
        shear = self.elastic_modulus / (2 * (1 + self.poisson_ratio))
        matrix = np.zeros((FIELDS, FIELDS))
        matrix[:3, :3] = self.elastic_modulus * np.array(
            [
                [section.area / big + i_z / big**3, -i_z / big**2, -i_rz / big**2],
                [-i_z / big**2, i_z / big, i_rz / big],
                [-i_rz / big**2, i_rz / big, i_r / big],
            ]
        )
        carried = section.shear_factor * section.area
        matrix[3:, 3:] = shear / big * np.diag([section.torsion, carried, carried])
        return matrix

    def _strains(self, theta: Array) -> Array:
        """Strains of all harmonics at `theta`, (angle, strain, harmonic and field)."""
        u, v, _, pr, pt, pz = np.moveaxis(_fields(theta, self.harmonics), 1, 0)
        du, dv, dw, dpr, dpt, dpz = np.moveaxis(_fields(theta, self.harmonics, slope=True), 1, 0)
        big = self.radius
        strains = [u + dv, dpz, pt - dpr, dpt + pr, du - v + big * pz, dw - big * pr]
        return np.stack(strains, axis=1)

    def _motion(self, theta: Array, radius: float, height: float) -> Array:
        """Displacement (r, θ, z) of a point of the section, (angle, 3, harmonic and field)."""
        rho, zeta = radius - self.radius, height - self.height
        u, v, w, pr, pt, pz = np.moveaxis(_fields(theta, self.harmonics), 1, 0)
        return np.stack([u + zeta * pt, v + rho * pz - zeta * pr, w - rho * pt], axis=1)

    def _patch_motion(self, points: PatchPoints) -> Array:
        """Displacement of all patches in all harmonics, (kind, ball, 3, harmonic and field)."""
        places = zip(points.radius, points.height)
        return np.stack([self._motion(points.azimuth, r, z) for r, z in places])


def _fields(theta: Array, harmonics: int, slope: bool = False) -> Array:
    """Values or slopes of the six fields at `theta`, (angle, field, harmonic and field)."""
    n = np.arange(1, harmonics + 1)
    cos, sin = np.cos(theta[:, None] * n), np.sin(theta[:, None] * n)
    waves = np.empty((len(theta), 2 * harmonics + 1))
    waves[:, 0] = 0.0 if slope else 1.0
    waves[:, 1::2] = -n * sin if slope else cos
    waves[:, 2::2] = n * cos if slope else sin
    values = waves[:, None, :, None] * np.eye(FIELDS)[:, None, :]
    return values.reshape(len(theta), FIELDS, -1)


def _integrate(strains: Array, elasticity: Array, weight: Array) -> Array:
    """Sum of weight · strainsᵀ elasticity strains over all angles."""
    stress = np.einsum("ab,qbn,q->qan", elasticity, strains, weight, optimize=True)
    size = strains.shape[-1]
    return strains.reshape(-1, size).T @ stress.reshape(-1, size)


def _quadrature(support: Support, harmonics: int) -> tuple[Array, Array]:
    """Angles and weights that integrate products of harmonics exactly over a support."""
    if support.sectors is None:
        count = 2 * harmonics + 2
        return 2 * np.pi * np.arange(count) / count, np.full(count, 2 * np.pi / count)
    parts = []
    for centre, width in support.sectors:
        # Gauss resolves a wave with about half a point per radian of its phase
        nodes, weights = np.polynomial.legendre.leggauss(8 + math.ceil(harmonics * width))
        parts.append((centre + width / 2 * nodes, width / 2 * weights))
    angles, weights = (np.concatenate(column) for column in zip(*parts))
    return angles, weights


def _deformations(harmonics: int, radius: float) -> Array:
    """Orthonormal basis of all motions that are not those of a rigid body."""
    from scipy.linalg import null_space

    rigid = np.zeros((6, 2 * harmonics + 1, FIELDS))
    u, v, w, pr, pt, pz = range(FIELDS)
    constant, cos, sin = range(3)
    rigid[0, cos, u], rigid[0, sin, v] = 1, -1  # along x
    rigid[1, sin, u], rigid[1, cos, v] = 1, 1  # along y
    rigid[2, constant, w] = 1  # along z
    rigid[3, sin, w], rigid[3, cos, pr], rigid[3, sin, pt] = radius, 1, -1  # about x
    rigid[4, cos, w], rigid[4, sin, pr], rigid[4, cos, pt] = -radius, 1, 1  # about y
    rigid[5, constant, v], rigid[5, constant, pz] = radius, 1  # about z
    return null_space(rigid.reshape(6, -1))
