"""One look for all figures, and axis labels from the attributes of the data."""

from __future__ import annotations

import base64
import io
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from cycler import cycler
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.layout_engine import LayoutEngine

from loadflow.quantities import factor_to, fitting_unit, scale_of

STYLE: Any = {
    "figure.constrained_layout.use": True,
    "axes.grid": True,
    "grid.alpha": 0.3,
    "grid.linewidth": 0.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": "medium",
    "axes.titlelocation": "left",
    "font.size": 9.0,
    "legend.frameon": False,
    "legend.fontsize": "small",
    "axes.prop_cycle": cycler(
        color=["#1f5a94", "#d1612b", "#3d8b5f", "#8a4f9e", "#b08d1e", "#4b9fb5", "#666666"]
    ),
}


def readable(data: xr.DataArray, units: str | None = None) -> tuple[np.ndarray, str]:
    """Return values in the unit that is usual in drawings, and that unit.

    Parameters
    ----------
    data : xarray.DataArray
        Values with the attribute `units`.
    units : str, optional
        Unit to return them in; default that in which they have no leading zeros.

    Returns
    -------
    tuple of (ndarray, str)
        Values and unit.

    Raises
    ------
    loadflow.errors.InputError
        The values are not shown in `units`.

    Examples
    --------
    >>> import xarray as xr
    >>> from loadflow.plots import readable
    >>> values, unit = readable(xr.DataArray([1e5, 2e5], attrs={"units": "N"}))
    >>> values.tolist(), unit
    ([100.0, 200.0], 'kN')
    """
    values = np.asarray(data.values, dtype=float)
    if data.attrs.get("units") == "K" and str(data.name).endswith("temperature"):  # no difference
        zero, unit = scale_of("K")
        return values - zero, unit
    own = data.attrs.get("units", "–")
    if units is not None:
        return values * factor_to(units, own), units
    known = np.abs(values[np.isfinite(values)])
    factor, unit = fitting_unit(own, float(known.max(initial=0.0)))
    return values * factor, unit


class Drawing(Figure):
    """A figure that a notebook shows, whether or not its reader has imported pyplot before."""

    def _repr_png_(self) -> bytes:
        return _png(self, dpi=72)


class Margins(LayoutEngine):
    """Room of fixed width around axes, for a line of text on each side and numbers of few digits.

    What a figure of any content needs is found by laying out all of its text twice beforehand,
    which takes longer than to draw it.

    Parameters
    ----------
    right, bottom : float
        Inches right of the last column, and below the last row.
    """

    _adjust_compatible = True
    _colorbar_gridspec = True

    def __init__(self, right: float = 0.15, bottom: float = 0.5) -> None:
        super().__init__()
        self.right, self.bottom = right, bottom

    def execute(self, fig: Figure) -> None:
        """Place the axes of a figure."""
        width, height = fig.get_size_inches()
        place = fig.axes[0].get_subplotspec()
        assert place is not None
        grid = place.get_topmost_subplotspec().get_gridspec()
        left, top, beside, below = 0.75, 0.35, 0.75, 0.45
        wide = (width - left - self.right - (grid.ncols - 1) * beside) / grid.ncols
        high = (height - top - self.bottom - (grid.nrows - 1) * below) / grid.nrows
        fig.subplots_adjust(
            left=left / width, right=1 - self.right / width, wspace=beside / wide,
            bottom=self.bottom / height, top=1 - top / height, hspace=below / high,
        )  # fmt: skip


def figure(
    rows: int = 1,
    columns: int = 1,
    height: float = 2.1,
    margins: Margins | None = None,
    **keys: Any,
) -> tuple[Figure, Any]:
    """Return a figure of page width in the common style, and its axes.

    Parameters
    ----------
    rows, columns : int
        Of axes.
    height : float
        Of a row, inches.
    margins : Margins, optional
        In less than half of the time of those that fit any text, the default.
    **keys
        Of ``Figure.subplots``.

    Returns
    -------
    tuple
        The figure, and its axes as ``Figure.subplots`` gives them.

    Examples
    --------
    >>> from loadflow.plots import figure
    >>> drawing, axes = figure(rows=2)
    >>> axes.shape
    (2,)
    """
    with mpl.rc_context(STYLE):
        drawing = Drawing(figsize=(9.0, height * rows + 0.4), layout=margins)
        axes = drawing.subplots(rows, columns, **keys)
    return drawing, axes


def envelope(axis: Axes, x: np.ndarray, y: np.ndarray, label: str, bins: int = 1500) -> None:
    """Draw a long series: every sample if short, else its extremes in each of `bins` intervals.

    A picture has fewer pixels than a series has samples; the extremes are what must stay visible.
    """
    if y.size <= 2 * bins:
        axis.plot(x, y, lw=0.8, label=label)
        return
    edges = np.linspace(0, y.size, bins, endpoint=False).astype(int)
    low, high = np.fmin.reduceat(y, edges), np.fmax.reduceat(y, edges)  # NaN: no sample at all
    axis.plot(np.repeat(x[edges], 2), np.column_stack([low, high]).ravel(), lw=0.7, label=label)


def _laid_out(drawing: Figure) -> None:
    """Place axes once: a figure that still has an engine for that is drawn twice when saved."""
    engine = drawing.get_layout_engine()
    if engine is not None:
        engine.execute(drawing)
        drawing.set_layout_engine("none")


def to_png(drawing: Figure) -> str:
    """Return a figure as a ``data:`` address, so that the page needs no other file.

    Parameters
    ----------
    drawing : matplotlib.figure.Figure
        The figure.

    Returns
    -------
    str
        ``data:image/png;base64,…``

    Examples
    --------
    >>> from loadflow.plots import figure, to_png
    >>> to_png(figure()[0])[:22]
    'data:image/png;base64,'
    """
    return "data:image/png;base64," + base64.b64encode(_png(drawing)).decode()


def _png(drawing: Figure, dpi: int = 110) -> bytes:
    buffer = io.BytesIO()
    with mpl.rc_context(STYLE):
        _laid_out(drawing)
        drawing.savefig(buffer, format="png", dpi=dpi)
    return buffer.getvalue()


NOTHING: dict[str, Any] = dict.fromkeys(("Creator", "Date", "Format", "Type"))
"""What a picture says of itself: nothing, so that equal ones are of equal bytes."""


def to_svg(drawing: Figure) -> str:
    """Return a figure as an ``<svg>`` element that scales with the page, its text as text.

    Parameters
    ----------
    drawing : matplotlib.figure.Figure
        The figure.

    Returns
    -------
    str
        The element.

    Examples
    --------
    >>> from loadflow.plots import figure, to_svg
    >>> to_svg(figure()[0])[:4]
    '<svg'
    """
    buffer = io.StringIO()
    with mpl.rc_context({**STYLE, "svg.fonttype": "none", "svg.hashsalt": "loadflow"}):
        _laid_out(drawing)
        drawing.set_dpi(110)
        FigureCanvasSVG(drawing).print_svg(buffer, metadata=NOTHING)  # savefig draws it twice
    text = buffer.getvalue()
    return text[text.index("<svg") :]
