"""Uneven viscosity of a reduced film with effects, and growth of its gap: both by heat."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.lanes import LANES, aligned, lanes_for

Array = NDArray[np.float64]


class Uneven(NamedTuple):
    """Viscosity that changes around and across, over that of the film, and what widens the gap so.

    That is growth by heat, and contours of the bore. Where viscosity changes, friction counts where
    there is liquid, as heat is made there.

    Attributes
    ----------
    on : bool
        Whether viscosity does.
    cells, faces : array (nx, l)
        That against flow at the points, and on the way between those of each column and the next.
    shear, drags : array (nx, l)
        That under shear at the points; what is dragged on the ways, over that at one viscosity.
    grows : bool
        Whether the gap is wider in places.
    wider, wider_faces : array (nx, L)
        By how much at points and ways, beyond the depth of `Places`, clearances.
    beside : array (nx, g)
        The same at the places of `Yielding`.
    """

    on: bool
    cells: Array
    faces: Array
    shear: Array
    drags: Array
    grows: bool
    wider: Array
    wider_faces: Array
    beside: Array


class Thickness(NamedTuple):
    """Viscosity of cells around and across, over that of the film, to be had at any points.

    Attributes
    ----------
    z : array (s,)
        Increasing, from mid-plane, shaft radii.
    values : array (nx, s)
        Against flow, on the cells around.
    shear, drag : array (nx, s), optional
        Under shear; flow that is dragged, over that at one viscosity. As `values`, and 1.
    growth : array (nx, s), optional
        Growth of the gap, clearances.
    """

    z: Array
    values: Array
    shear: Array | None = None
    drag: Array | None = None
    growth: Array | None = None

    def at(self, points: Array, beside: Array, back: Array, width: Array) -> Uneven:
        """The same at `points` across (l,), straight between its own; growth `beside` (g,), too.

        The ways between cells of a `width` (nx,) reach from the faces `back` (nx,) into both.
        """
        cells = self._across(self.values, points)
        shear = cells if self.shear is None else self._across(self.shear, points)
        drags = np.ones_like(cells) if self.drag is None else self._across(self.drag, points)
        told = cells, _on_the_way(cells, back), shear, _on_the_way(drags, back)
        if self.growth is None:
            return Uneven(True, *told, False, _NONE_LANES, _NONE_LANES, _NONE_AROUND)
        apart = self.growth - self.growth.mean(axis=0)
        own = self.grown(apart, points)
        wider = aligned(np.zeros((2, len(own), lanes_for(points.size))))
        wider[0, :, : points.size], wider[1, :, : points.size] = own, _at_faces(own, width)
        # by rows as all others: of another order kernels would be compiled anew, for 40 s
        there = np.ascontiguousarray(self.grown(apart, beside))
        return Uneven(True, *told, True, wider[0], wider[1], there)

    def mean_growth(self, points: Array) -> Array:
        """Growth of the gap around on average at `points` across (l,), clearances."""
        if self.growth is None:
            return np.zeros(points.size)
        return self.grown(self.growth.mean(axis=0)[None], points)[0]

    def _across(self, values: Array, points: Array) -> Array:
        """Values (nx, l) at points across."""
        return np.stack([np.interp(points, self.z, row) for row in values])

    def grown(self, values: Array, points: Array) -> Array:
        """Values (nx, s) at points across as of growth: straight to the ends, as on the grid."""
        before = np.clip(np.searchsorted(self.z, points) - 1, 0, self.z.size - 2)
        way = (points - self.z[before]) / (self.z[before + 1] - self.z[before])
        if self.z[0] >= 0.0:  # mirrored at mid-plane
            way = np.maximum(way, 0.0)
        return np.asarray((1.0 - way) * values[:, before] + way * values[:, before + 1])


def _at_faces(cells: Array, width: Array) -> Array:
    """Values where each column of cells ends, straight between its middle and the next one's."""
    after = np.roll(width, -1)
    faces = after[:, None] * cells + width[:, None] * np.roll(cells, -1, axis=0)
    return np.asarray(faces / (width + after)[:, None])


def _on_the_way(cells: Array, back: Array) -> Array:
    """Mean values between the middles of each column of cells and of the next one."""
    after = np.roll(back, -1)
    ways = back[:, None] * cells + after[:, None] * np.roll(cells, -1, axis=0)
    return np.asarray(ways / (back + after)[:, None])


_NONE_AROUND = np.zeros((1, 1))
_NONE_LANES = aligned(np.zeros((1, LANES)))
EVEN = Uneven(
    False, _NONE_AROUND, _NONE_AROUND, _NONE_AROUND, _NONE_AROUND, False, _NONE_LANES, _NONE_LANES,
    _NONE_AROUND,
)  # fmt: skip
