"""Charts that the browser draws from the numbers: long series stay zoomable without a network.

A chart holds its lines as they are where that is little, and their extremes in equal intervals
where it is much: what is drawn shows every peak, as a figure of all samples would. Values go into
the page as 16-bit integers between the extremes of their line, which are exact.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

SAMPLES = 2000
"""Values of a line in the page; a screen has fewer columns than half of that."""

CLOSE = 24_000
"""Values of a line that is worth a close look: ten minutes at 0.025 s."""

_LISTED = 200  # values up to which numbers are written out
_MISSING = 65535


@dataclass(frozen=True)
class Panel:
    """A frame of a chart.

    Attributes
    ----------
    label : str
        Name and unit along its ordinate.
    lines : mapping
        Values (n,) of each line by its name.
    level : float, optional
        A dashed line across.
    logarithmic : bool
        Scale of the ordinate.
    dots : bool
        Values stand alone: samples of a series that no line joins.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.report.charts import Panel
    >>> Panel("film, µm", {"h_min": np.array([30.0, 28.0])}, level=10.0).logarithmic
    False
    """

    label: str
    lines: dict[str, np.ndarray]
    level: float | None = None
    logarithmic: bool = False
    dots: bool = False


@dataclass(frozen=True)
class Chart:
    """Frames over one abscissa.

    Attributes
    ----------
    caption : str
        What it shows.
    label : str
        Name and unit along the abscissa.
    x : ndarray, shape (n,)
        Its values, ascending.
    panels : sequence of Panel
        From top to bottom, or beside each other if points.
    fold : bool
        Hide it until it is clicked.
    samples : int
        Values of a line in the page.
    points : bool
        Points, not lines, and all of them; `names` says what each is.
    names : sequence of str
        Of the points.
    mark : float, optional
        A place of the abscissa that is marked in every frame.
    anchor : str
        Name for links to it; empty without one.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.report import Chart, Panel
    >>> time = np.arange(0.0, 600.0, 0.025)
    >>> chart = Chart("a wave", "time, s", time, [Panel("force, kN", {"N": np.sin(time)})])
    >>> len(chart.markup) < 12_000 < time.size
    True
    """

    caption: str
    label: str
    x: np.ndarray
    panels: Sequence[Panel]
    fold: bool = False
    samples: int = SAMPLES
    points: bool = False
    names: Sequence[str] = ()
    mark: float | None = None
    anchor: str = ""

    @property
    def markup(self) -> str:
        """Element of the page that the script of the page draws."""
        panels = []
        samples = self.x.size if self.points else self.samples
        for panel in self.panels:
            drawn = {name: thinned(self.x, y, samples) for name, y in panel.lines.items()}
            panels.append(
                {
                    "label": panel.label,
                    "lines": [{"name": name, "y": _packed(y)} for name, (_, y) in drawn.items()],
                    "level": panel.level,
                    "log": panel.logarithmic,
                    "dots": panel.dots,
                }
            )
        first = next(iter(self.panels[0].lines.values()))
        data: dict[str, Any] = {
            "label": self.label,
            "x": _packed(thinned(self.x, first, samples)[0]),
            "panels": panels,
            "mark": self.mark,
        }
        if self.points:
            data |= {"points": True, "names": [*self.names]}
        text = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
        text = text.replace("</", "<\\/")  # a name must not end the element
        name = f' id="{escape(self.anchor)}"' if self.anchor else ""
        return (
            f'<div class="chart"{name} tabindex="0" role="group" '
            f'aria-label="{escape(self.caption)}">'
            f'<script type="application/json">{text}</script></div>'
        )


def thinned(x: ArrayLike, y: ArrayLike, samples: int) -> tuple[np.ndarray, np.ndarray]:
    """Return a series, or where it is longer than `samples` its extremes in equal intervals.

    Both extremes of each of `samples` / 2 intervals stay, in the order in which they come, at the
    first and at the middle place of the interval. Missing values are passed over.

    Parameters
    ----------
    x, y : array_like (n,)
        Places and values.
    samples : int
        Largest number of values.

    Examples
    --------
    >>> x, y = thinned(range(8), [0, 5, 1, 0, 0, 0, -3, 0], 4)
    >>> x.tolist(), y.tolist()
    ([0.0, 2.0, 4.0, 6.0], [0.0, 5.0, 0.0, -3.0])
    """
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if y.size <= samples:
        return x, y
    width = -(-y.size // (samples // 2))
    count = -(-y.size // width)
    short = count * width - y.size
    rows = np.append(y, np.full(short, np.nan)).reshape(count, width)
    low = np.where(np.isnan(rows), np.inf, rows)
    high = np.where(np.isnan(rows), -np.inf, rows)
    at, top = low.argmin(axis=1), high.argmax(axis=1)
    pick = np.sort(np.column_stack([at, top]), axis=1)
    values = np.take_along_axis(rows, pick, axis=1).ravel()
    begin = width * np.arange(count)
    places = np.column_stack([begin, np.minimum(begin + width // 2, y.size - 1)]).ravel()
    return x[places], values


def _packed(values: np.ndarray) -> Any:
    """Numbers as the script reads them: listed, equidistant, or 16-bit between the extremes."""
    known = values[np.isfinite(values)]
    if values.size <= _LISTED:
        return [float(f"{v:.6g}") if np.isfinite(v) else None for v in values]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 0.0)
    step = (values[-1] - values[0]) / (values.size - 1)
    if known.size == values.size and np.allclose(np.diff(values), step, rtol=1e-6, atol=0):
        return {"start": float(values[0]), "step": float(step), "count": values.size}
    scale = (high - low) / (_MISSING - 1)
    with np.errstate(invalid="ignore"):
        steps = np.rint((values - low) / scale) if scale > 0 else 0.0 * values
    codes = np.where(np.isfinite(values), steps, _MISSING).astype("<u2")
    return {"low": low, "high": high, "data": base64.b64encode(codes.tobytes()).decode()}
