"""Cells of a film whose gap has a shape: they fit its lobes, grooves and recesses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap.mesh import Mesh, graded_share
from loadflow.journal.film_model import check_grid
from loadflow.journal.relief import Relief
from loadflow.journal.shapes import Segment

Array = NDArray[np.float64]
_TURN = 2 * np.pi
_SLIVER = 1e-7  # share of a groove in its outermost cells, so that its pressure acts at its edge
_FEWEST = 4  # cells around of a segment
_CLOSEST = 0.004  # width of the narrowest cells where they crowd, rad
_GROWTH = 0.25  # width of the others there over their distance


@dataclass(frozen=True, eq=False)
class ShapedMesh(Mesh):
    """Cells fixed to the shell. Open where there are segments: both ends lie in one groove.

    Attributes
    ----------
    segment : array of int (nx,)
        Segment that each column of cells belongs to; grooves are shared out between neighbours.
    groove : array of bool (nx,)
        Columns in a groove between two segments.
    marks : array of bool (nx + 1,)
        Cell edges at which the gap may step.
    graded : bool
        Whether cells crowd at the bearing ends.
    """

    segment: NDArray[np.int64]
    groove: NDArray[np.bool_]
    marks: NDArray[np.bool_]
    graded: bool

    @property
    def end_distances(self) -> tuple[float, float]:
        """Distances of the outermost cell centres to the ends, as exact as graded cells allow."""
        if not self.graded:
            return super().end_distances
        distance = _end_distance(self.z_edges[self.z_edges >= 0.0])
        return distance, distance

    @cached_property
    def face_angles(self) -> tuple[Array, Array]:
        """Nodes between cell centres, one on either side of a face: angles and weights (nx + 1, 2).

        Both lie on the face itself but where the gap may step.
        """
        width = np.diff(self.edges)
        first, last = (width[-1], width[0]) if self.closed else (0.0, 0.0)
        sides = 0.5 * np.stack([np.append(first, width), np.append(width, last)], axis=-1)
        away = np.where(self.marks[:, None], 0.5 * sides * np.array([-1.0, 1.0]), 0.0)
        return self.edges[:, None] + away, sides


@lru_cache(maxsize=32)
def shaped_mesh(
    width_ratio: float,
    grid: tuple[int, int],
    half: bool,
    graded: bool,
    segments: tuple[Segment, ...],
    marks: tuple[float, ...],
    marks_across: tuple[float, ...],
) -> ShapedMesh:
    """Mesh of a shaped gap, kept from one load to the next.

    Parameters
    ----------
    width_ratio : float
        B/D.
    grid : tuple of int
        Cells around (on the segments together, where there are some) and across the full width.
    half : bool
        Whether one half of the width stands for both.
    graded : bool
        Whether cells crowd at the bearing ends.
    segments : tuple of Segment
        Lobes or pads; none for a bore that runs round.
    marks, marks_across : tuple of float
        Angles (rad) and axial places (shaft radii) at which the gap may step.
    """
    around, across = check_grid(grid)
    turns = np.array(sorted(marks), dtype=float)
    if segments:
        edges, segment, groove = _around_segments(segments, turns, around)
    else:
        start = turns[0] if turns.size else 0.0
        edges = between_marks(start, start + _TURN, turns, around)
        segment = np.zeros(edges.size - 1, dtype=np.int64)
        groove = np.zeros(edges.size - 1, dtype=bool)
    away = (edges[:, None] - turns[None, :] + np.pi) % _TURN - np.pi
    return ShapedMesh(
        edges=edges,
        z_edges=_across(width_ratio, across, half, graded, marks_across),
        closed=not segments,
        polar=False,
        strength=0.0,
        nodes=1,
        segment=segment,
        groove=groove,
        marks=(np.abs(away) < 1e-9).any(axis=1),
        graded=graded and not marks_across,
    )


def crowded(mesh: ShapedMesh, angle: float) -> ShapedMesh:
    """The same with its cells halved toward `angle`, rad, so that they resolve a gap that closes.

    A gap that is h clearances at its narrowest is about √(2 h) rad wide.
    """
    parts = []
    for low, high, groove in zip(mesh.edges[:-1], mesh.edges[1:], mesh.groove):
        whole = np.array([low, high])
        parts.append((whole if groove else _halved(float(low), float(high), angle))[1:])
    counts = np.array([part.size for part in parts])
    marks = np.zeros(counts.sum() + 1, dtype=bool)
    marks[np.append(0, np.cumsum(counts))] = mesh.marks
    return replace(
        mesh,
        edges=np.concatenate([mesh.edges[:1], *parts]),
        segment=np.repeat(mesh.segment, counts),
        groove=np.repeat(mesh.groove, counts),
        marks=marks,
    )


def _halved(low: float, high: float, angle: float) -> Array:
    """Edges from `low` to `high`, closer together the nearer they are to `angle`."""
    away = (0.5 * (low + high) - angle + np.pi) % _TURN - np.pi
    distance = max(abs(away) - 0.5 * (high - low), 0.0)
    if high - low <= max(_CLOSEST, _GROWTH * distance):
        return np.array([low, high])
    middle = 0.5 * (low + high)
    return np.append(_halved(low, middle, angle)[:-1], _halved(middle, high, angle))


def _end_distance(edges: Array) -> float:
    """Distance from the outermost cell centre to the end that makes a parabola's load exact.

    `edges` run from mid-plane 0 to the end b. Cells of p'' = −1 have the exact flow p' = −z at
    their edges; what is free is p of the outermost cell, which Σ p dz = b³/3 asks for. Half a cell
    leaves the load too large by more than all other errors across the width.
    """
    centres, widths = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
    falls = np.append(edges[1:-1] * np.diff(centres), 0.0)
    above = np.cumsum(falls[::-1])[::-1]  # pressure over that of the outermost cell
    end = float(edges[-1])
    return float((end**3 / 3.0 - above @ widths) / end**2)


def relief_marks(
    relief: tuple[Relief, ...], radius: float, width: float
) -> tuple[list[float], list[float]]:
    """Angles and axial places (shaft radii) at which the gap steps."""
    steps = [part.steps(width) for part in relief]
    turns = [angle for around, _ in steps for angle in around]
    return turns, [z / radius for _, across in steps for z in across]


def cells_on(segments: Sequence[Segment], cells: int) -> list[int]:
    """Share `cells` out among segments by what they span; as many to each of equal ones.

    A half counts as one more: the last digits of a span would decide otherwise.
    """
    spans = [part.end - part.start for part in segments]
    shares = [round(cells * span / sum(spans), 9) for span in spans]
    return [max(_FEWEST, math.floor(share + 0.5)) for share in shares]


def _around_segments(
    segments: tuple[Segment, ...], turns: Array, cells: int
) -> tuple[Array, NDArray[np.int64], NDArray[np.bool_]]:
    """Cell edges from the first segment's start to the last one's end; a groove takes 3 cells."""
    counts = cells_on(segments, cells)
    edges, segment, groove = [np.array([segments[0].start])], [], []
    for number, part in enumerate(segments):
        if number:
            gap = part.start - segments[number - 1].end
            inner = segments[number - 1].end + gap * np.array([_SLIVER, 1 - _SLIVER, 1.0])
            edges.append(inner)
            segment += [number - 1, number - 1, number]
            groove += [True] * 3
        own = between_marks(part.start, part.end, turns, counts[number])
        edges.append(own[1:])
        segment += [number] * (own.size - 1)
        groove += [False] * (own.size - 1)
    return np.concatenate(edges), np.array(segment), np.array(groove)


def between_marks(start: float, end: float, marks: Array, cells: int) -> Array:
    """About `cells` even cells from `start` to `end`, with edges on the `marks` between them."""
    inside = start + (marks - start) % _TURN
    inside = inside[(inside > start + 1e-9) & (inside < end - 1e-9)]
    return even_cells(np.concatenate([[start], np.unique(np.round(inside, 12)), [end]]), cells)


def even_cells(breaks: Array, cells: float) -> Array:
    """Even cells between `breaks`, about `cells` in all."""
    counts = np.maximum(np.rint(np.diff(breaks) / np.ptp(breaks) * cells).astype(int), 1)
    parts = [np.linspace(a, b, n + 1)[:-1] for a, b, n in zip(breaks[:-1], breaks[1:], counts)]
    return np.append(np.concatenate(parts), breaks[-1])


def _across(
    width_ratio: float, cells: int, half: bool, graded: bool, marks: Sequence[float]
) -> Array:
    """Cell edges across, in shaft radii, from mid-plane or from end to end."""
    inside = [z for z in marks if not half or z > 0]
    if inside:
        low = 0.0 if half else -width_ratio
        breaks = np.unique(np.round([low, *inside, width_ratio], 12))
        return even_cells(breaks, cells // 2 if half else cells)
    share = graded_share(cells // 2) if graded else np.linspace(0.0, 1.0, cells // 2 + 1)
    if not half:
        share = np.concatenate([-share[:0:-1], share])
    return width_ratio * share
