"""Counts in classes of two quantities as coloured cells, as SVG without a figure of matplotlib.

A page holds many of them: each takes a hundredth of the time that a figure of matplotlib takes.
"""

from __future__ import annotations

import base64
import io
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.image import imsave
from matplotlib.ticker import MaxNLocator

WIDTH, HEIGHT = 720.0, 250.0
LEFT, TOP, BOTTOM, BAR, BESIDE = 58.0, 22.0, 38.0, 12.0, 56.0
_BARE: dict[str, Any] = {"Software": None}  # equal pictures are of equal bytes
_FINE = 4  # points of the picture along each side of a cell: edges need not be equidistant


@dataclass(frozen=True)
class Cells:
    """Cells between edges along two axes, and what they are coloured by.

    Attributes
    ----------
    x, y : ndarray, shape (n + 1,) and (m + 1,)
        Edges, rising.
    values : ndarray, shape (n, m)
        Colour; NaN: none.
    labels : tuple of str
        Of x, y and colour.
    title : str
        Above.
    square : bool
        One unit is as long along x as along y.

    Examples
    --------
    >>> import numpy as np
    >>> cells = Cells(np.arange(3.0), np.arange(4.0), np.ones((2, 3)), ("to", "from", "number"))
    >>> cells.values.size
    6
    """

    x: np.ndarray
    y: np.ndarray
    values: np.ndarray
    labels: tuple[str, str, str]
    title: str = ""
    square: bool = False


def heat_maps(frames: Sequence[Cells]) -> str:
    """Draw frames beside each other, each with its scale of colours.

    Parameters
    ----------
    frames : sequence of Cells
        From left to right.

    Returns
    -------
    str
        An ``<svg>`` element.

    Examples
    --------
    >>> import numpy as np
    >>> cells = Cells(np.arange(3.0), np.arange(4.0), np.ones((2, 3)), ("to", "from", "number"))
    >>> heat_maps([cells]).count("<image")
    2
    """
    width = WIDTH / len(frames)
    body = "".join(_frame(one, width * k, width) for k, one in enumerate(frames))
    said = escape("; ".join(" over ".join(one.labels[::-1]) for one in frames))
    return (
        f'<svg class="heat" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" width="{WIDTH:g}" role="img" '
        f'aria-label="{said}" font-family="system-ui, sans-serif" font-size="11">{body}</svg>'
    )


def _frame(cells: Cells, start: float, width: float) -> str:
    left, high = start + LEFT, HEIGHT - TOP - BOTTOM
    wide = width - LEFT - BAR - BESIDE - 8
    if cells.square:
        wide = min(wide, high * float(np.ptp(cells.x) / np.ptp(cells.y)))
    known = cells.values[np.isfinite(cells.values)]
    low, top = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    right, foot = left + wide, TOP + high
    span = top - low or 1.0
    bar = np.linspace(1.0, 0.0, 64)[:, None]
    middle = f'x="{left + wide / 2:g}" text-anchor="middle"'
    parts = [
        f'<text {middle} y="14">{escape(cells.title)}</text>',
        _image(_fine(cells, low, span), left, TOP, wide, high),
        _image(bar, right + 8, TOP, BAR, high),
        f'<path d="M {left:g} {TOP:g} V {foot:g} H {right:g}" fill="none" stroke="#222"/>',
    ]
    for at in _ticks(cells.x, wide / 45):
        x = left + wide * (at - cells.x[0]) / np.ptp(cells.x)
        parts.append(f'<path d="M {x:.1f} {foot:g} v 4" stroke="#222"/>')
        parts.append(f'<text x="{x:.1f}" y="{foot + 15:g}" text-anchor="middle">{at:g}</text>')
    for at in _ticks(cells.y, high / 30):
        y = foot - high * (at - cells.y[0]) / np.ptp(cells.y)
        parts.append(f'<path d="M {left:g} {y:.1f} h -4" stroke="#222"/>')
        parts.append(f'<text x="{left - 6:g}" y="{y + 4:.1f}" text-anchor="end">{at:g}</text>')
    for at in _ticks(np.array([low, low + span]), high / 30):
        y = foot - high * (at - low) / span
        parts.append(f'<text x="{right + 12 + BAR:g}" y="{y + 4:.1f}">{at:g}</text>')
    x_label, y_label, colour = map(escape, cells.labels)
    parts.append(
        f'<text x="{left + wide / 2:g}" y="{foot + 32:g}" text-anchor="middle">{x_label}</text>'
    )
    parts += [
        f'<text transform="translate({x:g} {TOP + high / 2:g}) rotate(-90)" text-anchor="middle">'
        f"{label}</text>"
        for x, label in ((start + 12, y_label), (right + BAR + BESIDE - 4, colour))
    ]
    return "".join(parts)


def _fine(cells: Cells, low: float, span: float) -> np.ndarray:
    """Shares of the scale of colours (row, column), the first row on top; NaN: none."""
    places = []
    for edges in (cells.x, cells.y):
        count = edges.size - 1
        middles = edges[0] + np.ptp(edges) * (np.arange(_FINE * count) + 0.5) / (_FINE * count)
        # of edges that lie together, as of a series that does not vary, the last cell is the one
        places.append(np.minimum(np.searchsorted(edges, middles, "right"), count) - 1)
    return np.asarray(((cells.values - low) / span)[np.ix_(*places)].T[::-1])


def _image(share: np.ndarray, x: float, y: float, width: float, height: float) -> str:
    colours = mpl.colormaps["viridis"](np.ma.masked_invalid(share), bytes=True)
    stream = io.BytesIO()
    imsave(stream, colours, format="png", metadata=_BARE)
    data = base64.b64encode(stream.getvalue()).decode()
    return (
        f'<image x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" '
        f'preserveAspectRatio="none" style="image-rendering:pixelated" '
        f'href="data:image/png;base64,{data}"/>'
    )


def _ticks(edges: np.ndarray, count: float) -> list[float]:
    """Round numbers within the edges, at most `count` of them."""
    low, high = float(edges[0]), float(edges[-1])
    found = MaxNLocator(max(2, int(count)), steps=[1, 2, 5, 10]).tick_values(low, high)
    return [float(at) for at in found if low <= at <= high]
