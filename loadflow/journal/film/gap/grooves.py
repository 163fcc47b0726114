"""Where grooves and pockets lie on the mesh: cell edges on their outlines, and their cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.journal.shapes import Segment
from loadflow.journal.supply import Groove, Supply

Array = NDArray[np.float64]

_THIN = 1e-4  # share of a groove in its outermost cells
_ROUND = 10  # cells across the diameter of a circle, at least


def edges_around(count: int, grooves: tuple[Groove, ...], radius: float) -> Array:
    """Cell edges around, about `count` cells, with edges on those of the grooves.

    The outermost cells of a groove are thin, so that its pressure acts at its very edge.
    """
    if not grooves:
        return np.linspace(0.0, 2 * np.pi, count + 1)
    marks, _ = groove_marks(grooves, count, radius)
    start = marks[0]
    return start + _divided((marks - start) % (2 * np.pi), 2 * np.pi, 2 * np.pi / count)


def edges_across(edges: Array, grooves: tuple[Groove, ...], radius: float) -> Array:
    """The cell `edges` across the half width (in radii), with edges on the ends of the grooves."""
    _, marks = groove_marks(grooves, 1, radius)
    marks = marks[(marks > 0) & (marks < edges[-1])]
    return _divided(marks, float(edges[-1]), edges[-1] / (edges.size - 1)) if marks.size else edges


def groove_marks(grooves: tuple[Groove, ...], count: int, radius: float) -> tuple[Array, Array]:
    """Angles and axial places (shaft radii) at which `grooves` ask for cell edges.

    The first angle is that of the first groove's start; `count` is the number of cells around.
    """
    turns = [g.angle + _arc(g, count, radius) * _sides(g) for g in grooves]
    ends = [(g.axial + g.length * _sides(g)) / radius for g in grooves if g.length is not None]
    return np.concatenate([[], *turns]), np.concatenate([[], *ends])


def on_one_segment(
    groove: Groove, segments: tuple[Segment, ...], count: int, radius: float
) -> bool:
    """Whether all of a groove lies on one segment of a shaped bore, or the bore has none."""
    first, *_, last = groove_marks((groove,), count, radius)[0].tolist()
    return not segments or any(
        (first - part.start) % (2 * np.pi) + last - first <= part.end - part.start
        for part in segments
    )


def groove_numbers(
    angle: Array,
    z: Array,
    half_width: float,
    supply: Supply | None,
    count: int,
    radius: float,
    shell: NDArray[np.bool_] | None = None,
) -> NDArray[np.int64]:
    """Number of the groove in which each cell (nx, nz) lies, −1 for none.

    Parameters
    ----------
    angle, z : array (nx,), (nz,)
        Cell centres, rad and shaft radii.
    half_width : float
        Shaft radii.
    supply : Supply or None
        Its grooves.
    count : int
        Cells around that were asked for.
    radius : float
        Of the shaft, m.
    shell : array of bool (nx,), optional
        Which columns face the shell, and no groove between its segments; all by default.

    Raises
    ------
    InputError
        A groove beyond the bearing end or beside the shell, or two that overlap.
    """
    numbers = np.full((angle.size, z.size), -1)
    for number, groove in enumerate(supply.grooves if supply else ()):
        half_length = half_width if groove.length is None else 0.5 * groove.length / radius
        middle = groove.axial / radius
        if middle + half_length > half_width * (1 + 1e-9):
            length = 2 * half_length * radius
            raise InputError(
                f"grooves[{number}] of length {length:.6g} m at {groove.axial:.6g} m from mid-plane"
                f" is not allowed: the bearing is {2 * half_width * radius:.6g} m wide"
            )
        away = np.abs((angle - groove.angle + np.pi) % (2 * np.pi) - np.pi)[:, None]
        along = np.abs(np.abs(z) - middle)[None, :]
        if groove.shape == "circle":
            inside = np.hypot(away, along) < half_length
        else:
            inside = (away < 0.5 * _arc(groove, count, radius)) & (along < half_length)
        if not (inside if shell is None else inside[shell]).any():
            raise InputError(
                f"grooves[{number}].angle = {groove.angle!r} is not allowed: an angle, rad, at "
                "which there is shell; what lies between its segments has shape.groove_pressure"
            )
        other = numbers[inside].max(initial=-1)
        if other >= 0:
            raise InputError(f"grooves[{number}] overlaps grooves[{other}]: give them apart")
        numbers[inside] = number
    return numbers


def _arc(groove: Groove, count: int, radius: float) -> float:
    """Arc of a groove, rad; a line takes that of a cell."""
    if groove.shape == "circle" and groove.length is not None:
        return groove.length / radius
    return groove.arc if groove.arc > 0 else 2 * np.pi / count


def _sides(groove: Groove) -> Array:
    """Edges that a groove asks for, from its middle and over its size."""
    if groove.shape == "circle":
        return np.linspace(-0.5, 0.5, _ROUND + 1)
    return np.array([-0.5, -0.5 + _THIN, 0.5 - _THIN, 0.5])


def _divided(marks: Array, length: float, spacing: float) -> Array:
    """Edges from 0 to `length` at all `marks`, evenly spaced between them by about `spacing`."""
    breaks = np.unique(np.round([0.0, *marks, length], 12))
    cells = np.maximum(np.rint(np.diff(breaks) / spacing).astype(int), 1)
    parts = [
        np.linspace(a, b, n, endpoint=False) for a, b, n in zip(breaks[:-1], breaks[1:], cells)
    ]
    return np.append(np.concatenate(parts), length)
