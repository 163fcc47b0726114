"""What a gap of any shape is before a shaft stands in it: bore, modes, where it is narrowest."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap.shaped_mesh import ShapedMesh
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.relief import Relief
from loadflow.journal.shapes import Segment

Array = NDArray[np.float64]
_FINE = np.radians(0.5)  # largest distance of the angles at which the narrowest gap is sought


@dataclass(frozen=True)
class Bore:
    """Bore of a bearing: segments, relief, and the lengths that make its gap dimensionless (m)."""

    segments: tuple[Segment, ...]
    relief: tuple[Relief, ...]
    radius: float
    width: float
    clearance: float

    @classmethod
    def of(cls, bearing: JournalGeometry) -> Bore:
        """Bore of a bearing."""
        shape, lengths = bearing.shape, (bearing.radius, bearing.width, bearing.clearance)
        return cls(shape.segments, bearing.relief, *lengths)

    @property
    def along(self) -> bool:
        """Whether the gap changes along the axis."""
        return bool(self.relief)

    @property
    def pads(self) -> list[int]:
        """Numbers of the segments that tilt."""
        return [number for number, part in enumerate(self.segments) if part.tilting]

    def arcs(self) -> Array:
        """Circles that the bore is made of, (s, 5), in clearances and rad.

        Radius beyond that of the shaft; where a centred shaft is from the middle of the circle,
        (2,); middle of the arc, and half of it. One circle all round where there are no segments.
        """
        if not self.segments:
            return np.array([[1.0, 0.0, 0.0, 0.0, 2.0 * np.pi]])
        found = []
        for part in self.segments:
            wide = 1.0 / (1.0 - part.preload)
            away, toward = part.preload * wide, part.narrowest
            shift = away * np.cos(toward), away * np.sin(toward)
            half = 0.5 * (part.end - part.start)
            found.append([wide, *shift, part.start + half, half])
        return np.array(found)

    def gap(self, angle: Array, segment: NDArray[np.int64], z: Array) -> Array:
        """Gap of the centred shaft in clearances, (n, m).

        Parameters
        ----------
        angle, segment : array (n,)
            rad, and the segment that each lies in.
        z : array (m,)
            Shaft radii from mid-plane.
        """
        around = np.ones(angle.size)
        if self.segments:
            preload = np.array([part.preload for part in self.segments])[segment]
            narrowest = np.array([part.narrowest for part in self.segments])[segment]
            around = (1.0 - preload * np.cos(angle - narrowest)) / (1.0 - preload)
        total = np.repeat(around[:, None], z.size, axis=1)
        for part in self.relief:
            total += part.added(angle, z * self.radius, self.width) / self.clearance
        return total

    def narrowest(self, position: Array) -> Array:
        """Narrowest gap (n,) around aligned shafts at positions (n, 2), clearances; no relief."""
        if not self.segments:
            return np.asarray(1.0 - np.hypot(*position.T))
        least = np.full(len(position), np.inf)
        for wide, *shift, middle, half in self.arcs():
            x, y = (position + np.array(shift)).T
            # H = wide − |(x, y)| cos(θ − its angle): least there, or at an end of the segment
            beside = (np.arctan2(y, x) - middle + np.pi) % (2 * np.pi) - np.pi
            toward = middle + np.clip(beside, -half, half)
            least = np.minimum(least, wide - x * np.cos(toward) - y * np.sin(toward))
        return least


@dataclass(frozen=True)
class Places:
    """Places in a gap: H_0 (n, l), direction (n, 2), z (l,), modes (m, n) around, (m, l) along."""

    base: Array
    facing: Array
    z: Array
    reach: Array
    lengths: Array

    def gaps(self, position: Array, curvature: Array) -> Array:
        """Gap (n, l) of a shaft at `position` whose centre line has a `curvature` (2,)."""
        moved = (self.reach.T * position) @ self.lengths
        bent = self.facing @ (0.5 * np.outer(curvature, self.z**2))
        return np.asarray(self.base - moved - bent)


class Layout:
    """Bore and modes of a gap on a mesh, which no shaft changes.

    Parameters
    ----------
    mesh, bore, along
        As for `ShapedGap`.

    Attributes
    ----------
    tilts, along : bool
        Whether rotations of the shaft are among the m degrees of freedom, and whether there is a
        row for each cell across.
    shaft, size : int
        Number of degrees of freedom of the shaft, and with those of the pads.
    pivots, tangents : array (pads, 2)
        Directions of the pivots, and a quarter turn on.
    modes : array (m, nx, 2)
        Direction in which each degree of freedom shifts the shaft against each column of cells.
    z : array (rows,)
        Axial places of the rows, shaft radii, of which `across` (m, rows) is the factor along.
    around : array (m, nx)
        Modes, integrated over the cells around.
    face, cell : array (3, nx + 1, 2), (3, nx)
        Cosine, sine and weight of the nodes between cell centres and in cells.
    face_gap, cell_gap : array (nx + 1, 2, rows), (nx, rows)
        H_0 there.
    angle, facing, segment, spots : array (n,), (n, 2), (n,), (n, l)
        Places at which the narrowest gap is sought, and H_0 there; `spots_z` (l,) along.
    reach, lengths : array (m, n), (m, l)
        Modes there.
    beside : array of int (n, 2)
        The next such places of another angle on the same segment; at its ends itself.
    """

    def __init__(self, mesh: ShapedMesh, bore: Bore, along: bool) -> None:
        self.tilts = not mesh.half
        self.shaft = 4 if self.tilts else 2
        self.size = self.shaft + len(bore.pads)
        self._pads = bore.pads
        self.along = along or self.tilts or bore.along
        self.z = mesh.z if self.along else np.zeros(1)
        pivots = np.array([bore.segments[number].narrowest for number in bore.pads])
        self.pivots = np.stack([np.cos(pivots), np.sin(pivots)], axis=-1)
        self.tangents = np.stack([-np.sin(pivots), np.cos(pivots)], axis=-1)
        self.modes = self.shifts(mesh.segment)
        self.across = self.lengthwise(self.z)
        angles, weights = mesh.face_angles
        self.face = np.ascontiguousarray([np.cos(angles), np.sin(angles), weights])
        self.cell = np.array([np.cos(mesh.angle), np.sin(mesh.angle), np.diff(mesh.edges)])
        columns = np.arange(mesh.shape[0])
        sides = np.append(0, columns), np.append(columns, columns[-1])
        nodes = [bore.gap(a, mesh.segment[side], self.z) for a, side in zip(angles.T, sides)]
        self.face_gap = np.ascontiguousarray(np.stack(nodes, axis=1))
        self.cell_gap = bore.gap(mesh.angle, mesh.segment, self.z)
        self.around = np.einsum("jid,di->ji", self.modes, self.cell[:2] * self.cell[2])
        self.around[self.shaft :, mesh.groove] = 0.0  # grooves do not press on pads
        self._sample(mesh, bore)

    def shifts(self, segment: NDArray[np.int64]) -> Array:
        """Direction (x, y) in which each degree of freedom shifts the shaft, (m, n, 2)."""
        shifts = np.zeros((self.size, segment.size, 2))
        shifts[0, :, 0] = shifts[1, :, 1] = 1.0
        if self.tilts:
            shifts[2, :, 1], shifts[3, :, 0] = -1.0, 1.0
        for row, number in enumerate(self._pads, start=self.shaft):
            shifts[row, segment == number] = self.tangents[row - self.shaft]
        return shifts

    def lengthwise(self, z: Array) -> Array:
        """Factor of each mode along the axis, (m, rows)."""
        across = np.ones((self.size, z.size))
        if self.tilts:
            across[2:4] = z
        return across

    def _sample(self, mesh: ShapedMesh, bore: Bore) -> None:
        """Places at which the narrowest gap is sought: H_0, cosine and sine, modes there."""
        columns = np.flatnonzero(~mesh.groove)
        parts = [angles_between(mesh.edges[i], mesh.edges[i + 1]) for i in columns]
        self.angle = np.concatenate(parts)
        self.segment = np.repeat(mesh.segment[columns], [part.size for part in parts])
        self.spots_z = mesh.z_edges if self.z.size > 1 else self.z
        inner = np.clip(self.angle, self.angle[0] + 1e-9, self.angle[-1] - 1e-9)
        self.spots = bore.gap(inner, self.segment, self.spots_z)
        self.facing = np.stack([np.cos(self.angle), np.sin(self.angle)], axis=-1)
        self.reach = np.einsum("jid,id->ji", self.shifts(self.segment), self.facing)
        self.lengths = self.lengthwise(self.spots_z)
        self.beside = _beside(self.angle, self.segment, mesh.closed)

    def lowest(self, gaps: Array) -> tuple[float, float, float]:
        """Least of `gaps` (n, l) at the sampled places, its angle, rad, and axial place.

        Around it lies where a parabola through the least of the places and its two neighbours does,
        so that it does not depend on where these happen to be.
        """
        i, k = np.unravel_index(gaps.argmin(), gaps.shape)
        least, angle, z = float(gaps[i, k]), float(self.angle[i]), float(self.spots_z[k])
        sides = self.beside[i]
        ahead = (self.angle[sides] - angle + np.pi) % (2.0 * np.pi) - np.pi
        before, behind = ahead.tolist()
        if before < 0.0 < behind:
            up, down = (gaps[sides, k] - least) / ahead
            bend = float(down - up) / (behind - before)
            slope = float(up) - bend * before
            if bend > 0.0:
                way = min(max(-0.5 * slope / bend, before), behind)
                least, angle = least + (slope + bend * way) * way, angle + way
        return least, angle, z


def angles_between(start: float, end: float) -> Array:
    """Angles from `start` to `end`, rad, at which the narrowest gap is sought."""
    return np.linspace(start, end, 2 + int((end - start) / _FINE))


def _beside(angle: Array, segment: NDArray[np.int64], closed: bool) -> NDArray[np.int64]:
    """Numbers of the next places of another angle on the same segment, (n, 2)."""
    count, number = angle.size, np.arange(angle.size)
    sides = []
    for way in (-1, 1):
        side = number + way
        for _ in range(2):  # two cells share a place
            to = side % count
            same = np.abs((angle[to] - angle + np.pi) % (2 * np.pi) - np.pi) < 1e-12
            side = np.where(same, side + way, side)
        to = side % count
        inside = segment[to] == segment if closed else (segment[to] == segment) & (to == side)
        sides.append(np.where(inside, to, number))
    return np.stack(sides, axis=-1)


@lru_cache(maxsize=16)
def layout_of(mesh: ShapedMesh, bore: Bore, along: bool) -> Layout:
    """Layout of a gap, kept from one load to the next, whose arrays nobody changes."""
    return Layout(mesh, bore, along)
