"""Gaps between rough surfaces, which only asperities close: `CylindricalGap`, `ShapedGap`.

The shaft may pass the place where smooth surfaces would touch; the oil flows through the mean gap
that is left, `narrowest` is its smallest value.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.contact import Contact
from loadflow.journal.film import _rough_kernels as kernel
from loadflow.journal.film.gap import KEPT, CylindricalGap
from loadflow.journal.film.gap_mesh import ShapedMesh
from loadflow.journal.film.gap_shaped import Bore, ShapedGap
from loadflow.journal.film.mesh import Mesh
from loadflow.tribology import kernels as laws

Array = NDArray[np.float64]

_DEEPEST = 8.0  # overlap of the mean planes of summits over their σ at which the law ends
_FARTHEST = 0.03  # the same in clearances, where the mesh that turns with the shaft ends


class _Rough:
    """What both gaps need of the roughness, in clearances."""

    def __init__(self, contact: Contact, clearance: float) -> None:
        contact.check_clearance(clearance)
        self.roughness = contact.roughness / clearance
        tips = contact.asperities
        overlap = (_DEEPEST * tips.roughness - tips.summit_height) / clearance
        self.deepest = min(max(overlap, 0.0), _FARTHEST)
        pattern, none = contact.pattern, np.empty((0, 16))
        self._along = none if pattern is None else laws.flow_rows(pattern)
        self._across = none if pattern is None else laws.flow_rows(1.0 / pattern)
        self._slip = 2.0 * contact.shaft_share - 1.0  # Φ_s of the shaft less that of the shell

    @property
    def numbers(self) -> tuple[float, Array, Array, float]:
        """What the kernels take."""
        return self.roughness, self._along, self._across, self._slip

    def mean(self, gap: float) -> float:
        """Mean gap at that of the mean planes, clearances; 0 where the law of contact ends."""
        if not gap >= -self.deepest * (1.0 + 1e-9):
            return 0.0
        return float(kernel.mean_film(gap, self.roughness)[0])


class RoughGap(CylindricalGap):
    """Gap of a rough cylinder around an aligned, rough shaft.

    Parameters
    ----------
    mesh : Mesh
        Cells.
    contact : Contact
        Roughness and its pattern.
    clearance : float
        Radial clearance, m.
    """

    open_share: Array

    def __init__(self, mesh: Mesh, contact: Contact, clearance: float) -> None:
        super().__init__(mesh)
        self.rough = _Rough(contact, clearance)
        self.roughness, self.surfaces = self.rough.roughness, self.rough.numbers
        self.open_share = np.ones((mesh.angle.size, 1))

    def slopes(self, position: Array) -> list[tuple[Array, Array]]:
        """Derivatives of (`coef`, `around`) by the mesh coordinates of the position."""
        kept = np.array(self.open_share)
        slopes = super().slopes(position)
        self.open_share = kept
        return slopes

    def farthest(self, ratio: float) -> float:
        """Eccentricity ratio up to which a step may lead from `ratio`."""
        gap = 1.0 - ratio
        return min(ratio + (1.0 - KEPT) * max(gap, self.roughness), 1.0 + self.rough.deepest)

    def narrowest(self, position: Array) -> float:
        """Narrowest mean gap over the clearance; 0 beyond where the law of contact ends."""
        return self.rough.mean(1.0 - math.hypot(*position))


class RoughShapedGap(ShapedGap):
    """Gap of any shape between rough surfaces.

    Parameters
    ----------
    mesh, bore
        As for `ShapedGap`.
    contact : Contact
        Roughness and its pattern.
    """

    def __init__(self, mesh: ShapedMesh, bore: Bore, contact: Contact) -> None:
        super().__init__(mesh, bore)
        self.rough = _Rough(contact, bore.clearance)
        self.roughness, self.surfaces = self.rough.roughness, self.rough.numbers
        self.open_share = np.ones_like(self._cell_gap)

    def advance(self, position: Array, step: Array) -> Array:
        """Position after `step`, of which every place keeps a third of its gap or roughness."""
        gaps = self.gaps(position)
        closing = (self._reach.T * step) @ self._lengths
        allowed = np.minimum(
            (1.0 - KEPT) * np.maximum(gaps, self.roughness),
            np.maximum(gaps + self.rough.deepest, 0.0),
        )
        tight = closing > allowed
        share = float((allowed[tight] / closing[tight]).min(initial=1.0))
        return position + share * step

    def narrowest(self, position: Array) -> float:
        """Narrowest mean gap over the clearance; 0 beyond where the law of contact ends."""
        return self.rough.mean(float(self.gaps(position).min()))
