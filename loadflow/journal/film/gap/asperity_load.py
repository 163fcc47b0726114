"""Load that touching asperities carry at a position of the shaft, with its derivative.

The gap of a rigid bore follows from the position alone, so that the load of its asperities does,
too. It is integrated on nodes of its own: the zone of contact may be narrower than a cell.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.contact import Contact
from loadflow.journal.film.gap import _rough_kernels as kernel
from loadflow.journal.film.gap.elastic import GrowingGap
from loadflow.journal.film.gap.gap import turning_frame
from loadflow.journal.film.gap.rough import RoughElasticGap
from loadflow.journal.film.gap.shaped import ShapedGap

Array = NDArray[np.float64]

_NODES = 96  # Gauss nodes over the zone of contact of a cylinder
_ACROSS = 4  # Gauss nodes in a cell across
_STEP = np.radians(0.5)  # largest distance of nodes around; less where the surfaces are smooth
_FINEST = np.radians(0.05)
_PER_ZONE = 0.3  # of the half width √(2s) of the zone of contact
_FAR = 10.0  # film parameter beyond which a cylinder does not touch
_NOT_ASKED = np.zeros((0, 0))


@dataclass(frozen=True)
class Touch:
    """What the asperities carry at one position.

    Attributes
    ----------
    load : array (m,)
        ∫ p_a N_j dA, N.
    stiffness : array (m, m)
        Its derivative by the position, N per clearance.
    normal : float
        ∬ p_a dA, N.
    pressure, area : float
        Largest p_a, Pa, and real over nominal area of contact there.
    """

    load: Array
    stiffness: Array
    normal: float
    pressure: float
    area: float


class AsperityLoad(Protocol):
    """Asperities of a bearing."""

    contact: Contact

    def at(self, position: Array) -> Touch:
        """What they carry with the shaft at `position` (m,), clearances."""


class CylinderLoad:
    """Asperities of a cylindrical bore around an aligned shaft.

    Parameters
    ----------
    contact : Contact
        The surfaces.
    radius, width, clearance : float
        m.
    """

    def __init__(self, contact: Contact, radius: float, width: float, clearance: float) -> None:
        self.contact = contact
        self._area = radius * width
        self._roughness = contact.asperities.roughness / clearance
        self._summits = contact.asperities.summit_height / clearance
        self._x, self._w = np.polynomial.legendre.leggauss(_NODES)

    def at(self, position: Array) -> Touch:
        """What they carry with the shaft at `position` (2,), clearances."""
        ratio = math.hypot(*position)
        s, frame = self._roughness, turning_frame(position)
        least = (1.0 - self._summits - _FAR * s) / max(ratio, 1e-12)
        load, stiffness = np.zeros(2), np.zeros((2, 2))
        if least >= 1.0:
            return Touch(load, stiffness, 0.0, 0.0, 0.0)
        half = math.acos(max(least, -1.0))
        angle = half * self._x
        reach = np.stack([np.cos(angle), np.sin(angle)])
        gap = (1.0 - self._summits - ratio * reach[0])[:, None]
        weights, one = self._area * half * self._w, np.ones(1)
        none = np.zeros(gap.shape, dtype=bool)
        normal, _ = kernel.pressed(
            gap, s, 0.0, weights, one, none, reach, np.ones((2, 1)), load, stiffness, _NOT_ASKED
        )
        scale = self.contact.asperities.scale
        return Touch(
            scale * (frame @ load),
            scale * (frame @ stiffness @ frame.T),
            scale * normal,
            *_worst(self.contact, (1.0 - self._summits - ratio) / s),
        )


class NodeLoad:
    """Asperities of a bore of any shape, on nodes fixed to the shell.

    Parameters
    ----------
    contact : Contact
        The surfaces.
    gap : ShapedGap
        Gap of the mean planes: its cells, modes and the bend of the shaft.
    radius, mirrors : float
        Shaft radius, m; 2 where only half of the width is meshed.
    grooves : array of bool (nx, nz)
        Cells without asperities.
    """

    def __init__(
        self,
        contact: Contact,
        gap: ShapedGap,
        radius: float,
        mirrors: float,
        grooves: NDArray[np.bool_],
    ) -> None:
        self.contact, self._gap = contact, gap
        self._area = mirrors * radius**2
        mesh = gap.mesh
        self._roughness = contact.asperities.roughness / gap.bore.clearance
        self._summits = contact.asperities.summit_height / gap.bore.clearance
        step = min(_STEP, max(_FINEST, _PER_ZONE * math.sqrt(2.0 * self._roughness)))
        counts = np.maximum(1, np.ceil(mesh.dx / step)).astype(int)
        angle, self._around, columns = _nodes(mesh.edges, counts, 1)
        z, self._across, rows = _nodes(mesh.z_edges, np.ones(mesh.z.size, dtype=int), _ACROSS)
        self._angle, self._z = angle, z
        self._modes = gap.modes_at(angle, mesh.segment[columns], z)
        self._held = np.ascontiguousarray(grooves[np.ix_(columns, rows)])
        self._cells = (columns[:, None] * mesh.z.size + rows).ravel()

    def at(self, position: Array) -> Touch:
        """What they carry with the shaft at `position` (m,), clearances."""
        return self._touch(self._gaps(position), self._give, _NOT_ASKED)

    def forces(self, position: Array) -> Array:
        """Force normal to the shell that they carry in each cell (nx, nz), N."""
        gaps = (self._gaps(position) - self._summits).ravel()
        value, slope = np.zeros(gaps.size), np.zeros(gaps.size)
        free = ~self._held.ravel()
        kernel.asperity_field(gaps, self._roughness, self._give, free, value, slope)
        weights = self._unit * np.outer(self._around, self._across).ravel()
        shape = self._gap.mesh.shape
        sums = np.bincount(self._cells, weights * value, shape[0] * shape[1])
        return np.asarray(sums.reshape(shape))

    def _gaps(self, position: Array) -> Array:
        """Gap of the nodes."""
        return self._modes.gaps(position, self._gap.curvature)

    @property
    def _give(self) -> float:
        """Growth of the gap under the unit of asperity pressure, clearances."""
        return 0.0

    @property
    def _unit(self) -> float:
        """Load, N, over the sums of the kernel."""
        return self._area * self.contact.asperities.scale

    def _touch(self, gaps: Array, give: float, relief: Array) -> Touch:
        """What they carry at the `gaps` of the nodes; fills `relief` as `pressed` does."""
        modes, size = self._modes, self._modes.reach.shape[0]
        load, stiffness = np.zeros(size), np.zeros((size, size))
        normal, least = kernel.pressed(
            gaps - self._summits, self._roughness, give, self._around, self._across, self._held,
            modes.reach, modes.lengths, load, stiffness, relief,
        )  # fmt: skip
        worst, unit = _worst(self.contact, least / self._roughness), self._unit
        return Touch(unit * load, unit * stiffness, unit * normal, *worst)


class GrowingNodeLoad(NodeLoad):
    """Asperities in a gap that grows cell by cell, by heat or by the pressure of the film.

    Parameters
    ----------
    contact, radius, mirrors, grooves
        As for `NodeLoad`.
    gap : GrowingGap
        Gap of the mean planes, but for what asperities press open.
    """

    def __init__(
        self,
        contact: Contact,
        gap: GrowingGap,
        radius: float,
        mirrors: float,
        grooves: NDArray[np.bool_],
    ) -> None:
        super().__init__(contact, gap, radius, mirrors, grooves)
        self._growing = gap
        self._places = gap.places(self._angle, self._z)
        self._between = self._places[0]

    def _gaps(self, position: Array) -> Array:
        """Gap of the nodes but for what asperities press open."""
        return super()._gaps(position) + self._growing.grown_at(self._places)


class YieldingNodeLoad(GrowingNodeLoad):
    """Asperities on a shell that yields where it is pressed, by film and asperities alike.

    Parameters
    ----------
    contact, radius, mirrors, grooves
        As for `NodeLoad`.
    gap : RoughElasticGap
        Gap of the mean planes; the growth of its cells is that by the pressure of the film.
    """

    def __init__(
        self,
        contact: Contact,
        gap: RoughElasticGap,
        radius: float,
        mirrors: float,
        grooves: NDArray[np.bool_],
    ) -> None:
        super().__init__(contact, gap, radius, mirrors, grooves)
        self._shell = gap
        nx, nz = gap.mesh.shape
        # what the nodes give to the cells: around, and across, where the last row stays
        self._to_columns = self._between.around.matrix(nx).T.tocsr()
        self._to_rows = self._between.across.matrix(nz + 1)[:, :nz].toarray()

    @property
    def _give(self) -> float:
        return self._shell.rough.yields[0]

    def with_growth(self, position: Array) -> tuple[Touch, Array]:
        """What they carry, and what its load owes to the growth of the cells.

        The second is its derivative, (m, nx, nz), N per clearance.
        """
        gaps, modes = self._gaps(position), self._modes
        relief = np.zeros(gaps.shape)
        touch = self._touch(gaps, self._give, relief)
        parts = [
            self._to_columns @ (reach[:, None] * (relief @ (lengths[:, None] * self._to_rows)))
            for reach, lengths in zip(modes.reach, modes.lengths)
        ]
        return touch, self._unit * np.array(parts)


def _worst(contact: Contact, parameter: float) -> tuple[float, float]:
    """Pressure, Pa, and share of the real area at a film parameter of the summits."""
    if parameter >= kernel.NO_CONTACT:
        return 0.0, 0.0
    asperities = contact.asperities
    gap = parameter * asperities.roughness + asperities.summit_height
    return float(asperities.pressure(gap)), float(asperities.area(gap))


def _nodes(
    edges: Array, counts: NDArray[np.int64], order: int
) -> tuple[Array, Array, NDArray[np.int64]]:
    """Gauss nodes of `counts` parts of each cell, their weights, and the cells they lie in."""
    x, w = np.polynomial.legendre.leggauss(order)
    widths = np.repeat(np.diff(edges) / counts, counts)
    cells = np.repeat(np.arange(counts.size), counts)
    within = np.concatenate([np.arange(n) for n in counts])
    starts = edges[:-1][cells] + within * widths
    places = starts[:, None] + 0.5 * widths[:, None] * (1.0 + x)
    weights = 0.5 * widths[:, None] * w
    return places.ravel(), weights.ravel(), np.repeat(cells, order)
