"""Gaps between rough surfaces, which only asperities close: cylindrical, shaped, elastic.

The shaft may pass the place where smooth surfaces would touch; the oil flows through the mean gap
that is left, `narrowest` is its smallest value.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.contact import Contact
from loadflow.journal.film.gap import _rough_kernels as kernel
from loadflow.journal.film.gap.elastic import ElasticGap
from loadflow.journal.film.gap.gap import KEPT, CylindricalGap, RoughNumbers
from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film.gap.mesh import Mesh
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.film.gap.shaped_mesh import ShapedMesh
from loadflow.tribology import kernels as laws

Array = NDArray[np.float64]

_DEEPEST = 8.0  # overlap of the mean planes of summits over their σ at which the law ends
_FARTHEST = 0.03  # the same in clearances, where the mesh that turns with the shaft ends


class Roughness:
    """What the gaps need of the roughness, in clearances; of a shell its compliance, m/Pa."""

    def __init__(self, contact: Contact, clearance: float, compliance: float = 0.0) -> None:
        contact.check_clearance(clearance)
        self.roughness = contact.roughness / clearance
        tips = contact.asperities
        overlap = (_DEEPEST * tips.roughness - tips.summit_height) / clearance
        self.deepest = min(max(overlap, 0.0), _FARTHEST)
        give = compliance * tips.scale / clearance
        self.yields = give, tips.roughness / clearance, tips.summit_height / clearance
        pattern, none = contact.pattern, np.empty((0, 16))
        self._along = none if pattern is None else laws.flow_rows(pattern)
        self._across = none if pattern is None else laws.flow_rows(1.0 / pattern)
        self._slip = 2.0 * contact.shaft_share - 1.0  # Φ_s of the shaft less that of the shell

    @property
    def numbers(self) -> RoughNumbers:
        """What the kernels take."""
        return self.roughness, self._along, self._across, self._slip, self.yields

    def planes(self, gap: float) -> float:
        """Gap of the mean planes where it is `gap` without what asperities press a shell open."""
        return float(kernel.opened(gap, self.yields)[0])

    def mean(self, gap: float) -> float:
        """Mean gap at one of the mean planes, clearances; 0 where the law of contact ends."""
        planes = self.planes(gap)
        if not planes >= -self.deepest * (1.0 + 1e-9):
            return 0.0
        return float(kernel.mean_film(planes, self.roughness)[0])


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
        self.rough = Roughness(contact, clearance)
        self.roughness, self.rough_numbers = self.rough.roughness, self.rough.numbers
        self.open_share = np.ones((mesh.angle.size, 1))

    def slopes(self, position: Array) -> Array:
        """Fill the derivatives in `coefs`; returns the modes and theirs (1 + s, 2, nx)."""
        kept = np.array(self.open_share)
        modes = super().slopes(position)
        self.open_share = kept
        return modes

    def farthest(self, ratio: float) -> float:
        """Eccentricity ratio up to which a step may lead from `ratio`."""
        gap = 1.0 - ratio
        return min(ratio + (1.0 - KEPT) * max(gap, self.roughness), 1.0 + self.rough.deepest)

    def narrowest(self, position: Array) -> float:
        """Narrowest mean gap over the clearance; 0 beyond where the law of contact ends."""
        return self.rough.mean(1.0 - math.hypot(*position))

    def until_end(self, position: Array) -> float:
        """How far the mean planes still may come, clearances, where the law of contact ends."""
        return 1.0 - math.hypot(*position) + self.rough.deepest


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
        self.rough = Roughness(contact, bore.clearance)
        self.roughness, self.rough_numbers = self.rough.roughness, self.rough.numbers
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
        return self.rough.mean(self.closest(position)[0])

    def until_end(self, position: Array) -> float:
        """How far the mean planes still may come, clearances, where the law of contact ends."""
        return self.closest(position)[0] + self.rough.deepest


class RoughElasticGap(ElasticGap):
    """Gap between rough surfaces, of which the shell yields to asperities where they press.

    The growth that the film gives to a cell is that of `ElasticGap`; what asperities add to it
    follows from the gap at hand, so that the kernels find it place by place.

    Parameters
    ----------
    mesh, bore, ends_deform
        As for `ElasticGap`.
    contact : Contact
        Roughness and its pattern.
    compliance : float
        Growth of the gap over the pressure of asperities that the growth of the cells is without,
        m/Pa; 0 where it is that by all that presses the shell.
    """

    def __init__(
        self,
        mesh: ShapedMesh,
        bore: Bore,
        contact: Contact,
        compliance: float,
        ends_deform: bool = False,
    ) -> None:
        super().__init__(mesh, bore, ends_deform)
        self.rough = Roughness(contact, bore.clearance, compliance)
        self.roughness, self.rough_numbers = self.rough.roughness, self.rough.numbers
        self.open_share = np.ones_like(self._cell_gap)

    def narrowest(self, position: Array) -> float:
        """Narrowest mean gap over the clearance; 0 beyond where the law of contact ends."""
        return self.rough.mean(self.closest(position)[0])

    def least(self, position: Array) -> float:
        """Narrowest gap of the mean planes, clearances, that the balance of the film takes up."""
        return self.rough.planes(super().least(position))

    def least_after(self, position: Array) -> float:
        """Gap that a step from `position` must leave: a third of the gap or of the roughness."""
        gap = self.least(position)
        kept = gap - (1.0 - KEPT) * max(gap, self.roughness)
        return max(kept, -self.rough.deepest)

    def left(self, position: Array) -> float:
        """Narrowest gap, clearances, over that at which the law of contact ends."""
        return min(self.least(position) + self.rough.deepest, self.narrowest(position))

    def pressed_open(self) -> Array:
        """Growth of the cells (nx, nz) by asperities where last placed, clearances."""
        _, _, _, gaps = self.nodes
        rough = self.rough
        return np.vectorize(rough.planes)(gaps) - gaps
