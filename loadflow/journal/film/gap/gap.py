"""The discrete gap: its coefficients on a mesh, their slopes, and how far the shaft may go.

A position is a vector of degrees of freedom. The shaft's eccentricity comes first (in clearances),
then, where it may tilt, two rotations, then one tilt for each pad. Every degree of freedom j moves
the gap by its mode, ``H = H_0 − Σ q_j N_j``, and the pressure acts on it with ``∫ p N_j dA``.
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film._kernels import COS, SIN
from loadflow.journal.film.gap import _gap_kernels as kernel
from loadflow.journal.film.gap.mesh import Mesh
from loadflow.journal.turbulence import RegimeNumbers

Array = NDArray[np.float64]

RoughNumbers = tuple[float, Array, Array, float, tuple[float, float, float]]
"""Roughness as the kernels take it: its size, flow factors along and across, slip, and what a shell
yields to asperities."""

Surfaces = tuple[RoughNumbers | None, RegimeNumbers | None]
"""What the kernels take beside the gap: roughness, and the Reynolds numbers of turbulent flow."""

_SHELL = np.eye(2)
KEPT = 0.3  # share of the narrowest gap that a step of the shaft leaves


class Gap(Protocol):
    """What the film asks of its gap.

    Attributes
    ----------
    size, shaft : int
        Number of degrees of freedom m, and of those of the shaft.
    pads : array of int
        Degrees of freedom of the pads that tilt.
    coefs : array (1 + s, 8, nx + 1, rows)
        Coefficients of the gap where the shaft was last placed, rows as in `_kernels`, and room for
        their derivatives by the position; `coef` is the first of them.
    dof_scale : array (m,)
        How readily each degree of freedom moves where nothing holds it.
    across : array (m, rows)
        Modes along the axis, of which `around` (m, nx) is the factor around.
    roughness : float
        Of both surfaces, clearances; 0 where they are smooth.
    open_share : array (nx, rows) or None
        Derivative of the mean gap of the cells by that of the mean planes; None: smooth, 1.
    regime : tuple, optional
        Reynolds numbers where the flow may be turbulent, at the speed of the shaft.
    """

    size: int
    shaft: int
    pads: NDArray[np.int64]
    dof_scale: Array
    coefs: Array
    coef: Array
    across: Array
    roughness: float
    open_share: Array | None
    regime: RegimeNumbers | None

    @property
    def mesh(self) -> Mesh:
        """Cells."""

    @property
    def around(self) -> Array:
        """Modes where the shaft was last placed, integrated over each cell around (m, nx)."""

    def place(self, position: Array) -> Array:
        """Evaluate `coef` at `position`; returns the axes of the frame of the mesh (m, m)."""

    def slopes(self, position: Array) -> Array:
        """Fill the derivatives in `coefs`, by the s coordinates of the position that move the mesh.

        Returns the modes `around` and their derivatives, (1 + s, m, nx), or the modes alone,
        (1, m, nx), where they stay.
        """

    def advance(self, position: Array, step: Array) -> Array:
        """Position after `step`, of which the narrowest gap keeps at least a third."""

    def narrowest(self, position: Array) -> float:
        """Narrowest gap over the clearance; ≤ 0 where the shaft would touch the bore."""


class BoreGap(Gap, Protocol):
    """What statics asks of the gap in a bore, beside what the film does.

    Attributes
    ----------
    axisymmetric : bool
        Whether a cylinder surrounds an aligned shaft.
    tilts : bool
        Whether rotations of the shaft are among its degrees of freedom.
    first_gap : float
        Narrowest gap, in clearances, that a first position must leave.
    """

    axisymmetric: bool
    tilts: bool
    first_gap: float

    def arcs(self, position: Array) -> Array:
        """Angles that the cells span around (nx,), rad, with the shaft at `position`."""

    def held(self, tilt: Array | None, bend: Array | None) -> Array:
        """Centred position (m,) of a shaft whose line has the given tilt and curvature."""

    def converging(self, position: Array, speed: float) -> NDArray[np.int64]:
        """Pads whose film can hold them at `position`: those toward which it narrows."""

    def lifted(self, position: Array, speed: float) -> Array:
        """Position with pads tilted so that their gap converges in the sense of rotation."""

    def closest(self, position: Array) -> tuple[float, float, float]:
        """Narrowest gap (clearances), its angle (rad) and axial place (shaft radii)."""

    def closing(self, position: Array, limit: float) -> tuple[float, ...]:
        """Angles, rad, at which the gap has a minimum below `limit`, clearances."""

    def reach(self, direction: Array, least: float) -> float:
        """How far the centred shaft may go along a unit vector (2,); it leaves a gap `least`."""

    def widest(self, position: Array, free: slice | NDArray[np.int64]) -> Array:
        """Position of the widest narrowest gap, when only the degrees of freedom `free` move."""


def turning_frame(position: Array) -> Array:
    """Axes of the frame that turns with the eccentricity: along it, and a quarter turn on."""
    x, y = position.tolist()
    ratio = math.hypot(x, y)
    cos, sin = (x / ratio, y / ratio) if ratio > 0 else (1.0, 0.0)
    return np.array([[cos, -sin], [sin, cos]])


class FlowBetween:
    """What a gap holds beside its shape: how rough its surfaces are, and how the oil flows.

    Attributes
    ----------
    rough_numbers : tuple, optional
        Where the surfaces are rough.
    regime : tuple, optional
        Where the flow may be turbulent, at the speed of the shaft.
    """

    rough_numbers: RoughNumbers | None = None
    regime: RegimeNumbers | None = None

    @property
    def surfaces(self) -> Surfaces | None:
        """What the kernels take; None of smooth surfaces in laminar flow."""
        pair = self.rough_numbers, self.regime
        return None if pair[0] is None and pair[1] is None else pair


class CylindricalGap(FlowBetween):
    """Gap of a cylinder around an aligned shaft; its mesh may turn with the eccentricity."""

    size = shaft = 2
    axisymmetric, tilts = True, False
    pads: NDArray[np.int64] = np.arange(0)
    first_gap = 0.0  # that of the closed form, which is its own
    roughness: float = 0.0
    open_share: Array | None = None

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        shape, moves = (8, mesh.angle.size + 1, 1), 1 if mesh.polar else 2
        self.coefs = np.zeros((1 + moves, *shape))
        self.coef = self.coefs[0]
        # places beside that of the shaft, and the gap there
        self.beside = np.zeros((2 * moves, 2)), np.zeros((2 * moves, *shape))
        self.across = np.ones((2, 1))
        self.dof_scale = np.ones(2)

    @property
    def around(self) -> Array:
        """Cosine and sine, integrated over the cells around (2, nx)."""
        return self.coef[COS : SIN + 1, :-1, 0].copy()

    def place(self, position: Array) -> Array:
        """Evaluate `coef` at `position`; returns the axes of the frame of the mesh (2, 2)."""
        (face, cell), mesh = self.mesh.trigonometry, self.mesh
        place = np.array([[math.hypot(*position.tolist()), 0.0]]) if mesh.polar else position[None]
        words = mesh.strength, place, self.surfaces, self.coefs, self.open_share
        kernel.gap_coefficients(face, cell, *words)
        return turning_frame(position) if mesh.polar else _SHELL

    def slopes(self, position: Array) -> Array:
        """Fill the derivatives in `coefs`; returns the modes and theirs (1 + s, 2, nx)."""
        (face, cell), mesh = self.mesh.trigonometry, self.mesh
        x, y = position.tolist()
        modes = np.empty((len(self.coefs), 2, mesh.angle.size))
        kernel.cylinder_slopes(
            face, cell, mesh.strength, mesh.polar, self.roughness, x, y, self.surfaces,
            *self.beside, self.coefs, self.open_share, modes,
        )  # fmt: skip
        return modes

    def advance(self, position: Array, step: Array) -> Array:
        """Position after `step`, of which the narrowest gap keeps at least a third of its height.

        An eccentric shaft goes along the gap, not along the chord.
        """
        (x, y), (dx, dy) = position.tolist(), step.tolist()
        return np.array(kernel.along_the_gap(x, y, dx, dy, self.farthest(math.hypot(x, y))))

    def farthest(self, ratio: float) -> float:
        """Eccentricity ratio up to which a step may lead from `ratio`."""
        return 1.0 - KEPT * (1.0 - ratio)

    def narrowest(self, position: Array) -> float:
        """Narrowest gap over the clearance."""
        return 1.0 - math.hypot(*position)

    # --- what statics asks -----------------------------------------------------------------------
    def arcs(self, position: Array) -> Array:
        """Angles that the cells span around (nx,), rad, with the shaft at `position`."""
        stretch = self.mesh.stretch(math.hypot(*position)) if self.mesh.polar else 0.0
        cos, _, weights = self.mesh.trigonometry[1]
        mapped = weights * math.sqrt(1.0 - stretch * stretch) / (1.0 + stretch * cos)
        return np.asarray(mapped.sum(axis=1))

    def held(self, tilt: Array | None, bend: Array | None) -> Array:
        """Centred position; the shaft is aligned and straight."""
        return np.zeros(2)

    def converging(self, position: Array, speed: float) -> NDArray[np.int64]:
        """There are no pads."""
        return self.pads

    def lifted(self, position: Array, speed: float) -> Array:
        """The position itself: there are no pads."""
        return position

    def closest(self, position: Array) -> tuple[float, float, float]:
        """Narrowest gap (clearances), its angle (rad), and mid-plane."""
        return 1.0 - math.hypot(*position), math.atan2(position[1], position[0]), 0.0

    def closing(self, position: Array, limit: float) -> tuple[float, ...]:
        """Angle, rad, of the narrowest gap where it is below `limit`, clearances."""
        gap, angle, _ = self.closest(position)
        return (angle,) if gap < limit else ()

    def reach(self, direction: Array, least: float) -> float:
        """How far the centred shaft may go along a unit vector (2,); it leaves a gap `least`."""
        return 1.0 - least

    def widest(self, position: Array, free: slice | NDArray[np.int64]) -> Array:
        """The centre."""
        return np.zeros(2)
