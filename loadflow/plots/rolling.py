"""Figures of a rolling bearing: forces and pressures around the ring."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from loadflow.plots.style import figure


def element_forces(
    angle: ArrayLike, forces: ArrayLike, names: Sequence[str] = (), rows: int = 1
) -> Figure:
    """Draw the force on every rolling element around the ring.

    Parameters
    ----------
    angle : array_like (n,) or (groups, n)
        Of the elements, rad.
    forces : array_like (groups, n)
        N.
    names : sequence of str, optional
        Of the groups.
    rows : int
        Rows of the bearing: the groups share this many frames.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> import numpy as np
    >>> len(element_forces(np.arange(6.0), np.ones((4, 6)), rows=2).axes)
    2
    """
    return _polar(angle, np.asarray(forces) / 1e3, names, rows, "force on an element, kN")


def contact_pressure(angle: ArrayLike, pressure: ArrayLike, names: Sequence[str] = ()) -> Figure:
    """Draw the largest Hertzian pressure at every rolling element around the ring.

    Parameters
    ----------
    angle : array_like (n,)
        Of the elements, rad.
    pressure : array_like (groups, n)
        Pa.
    names : sequence of str, optional
        Of the groups.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> import numpy as np
    >>> len(contact_pressure(np.arange(6.0), np.ones((2, 6))).axes)
    1
    """
    return _polar(angle, np.asarray(pressure) / 1e6, names, 1, "contact pressure, MPa")


def rings(angle: ArrayLike, displacement: ArrayLike, names: Sequence[str] = ()) -> Figure:
    """Draw how far the raceways of rings are displaced outward, around the ring.

    Parameters
    ----------
    angle : array_like (n,) or (groups, n)
        Of the elements, rad.
    displacement : array_like (groups, n)
        Outward, m; inward is negative, and drawn inside of the circle of 0.
    names : sequence of str, optional
        Of the groups.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> import numpy as np
    >>> angle = np.linspace(0, 2 * np.pi, 36, endpoint=False)
    >>> axis = rings(angle, 1e-5 * np.cos([2 * angle])).axes[0]
    >>> [round(float(end)) for end in axis.get_ylim()]
    [-20, 12]
    """
    moved = 1e6 * np.atleast_2d(np.asarray(displacement, dtype=float))
    drawing = _polar(angle, moved, names, 1, "displacement of the raceway outward, µm")
    axis, size = drawing.axes[0], float(np.abs(moved).max(initial=0.0)) or 1.0
    axis.set_ylim(-2.0 * size, 1.2 * size)  # room inside: what bends inward stays a ring
    around = np.linspace(0, 2 * np.pi, 181)
    axis.plot(around, np.zeros_like(around), color="0.6", lw=0.8, ls="--")
    if len(moved) > 1:
        axis.legend(loc="upper left", bbox_to_anchor=(1.1, 1.0))  # beside: a bent ring fills all
    return drawing


def _polar(
    angle: ArrayLike, values: np.ndarray, names: Sequence[str], rows: int, title: str
) -> Figure:
    groups = np.atleast_2d(values)
    theta = np.broadcast_to(np.asarray(angle, dtype=float), groups.shape)
    each = max(1, len(groups) // rows)
    drawing, axes = figure(1, rows, height=4.0, squeeze=False, subplot_kw={"projection": "polar"})
    for k, (own, group) in enumerate(zip(theta, groups)):
        axis = axes[0][min(k // each, rows - 1)]
        label = names[k] if k < len(names) else f"group {k + 1}"
        closed = np.append(own, own[:1] + 2 * np.pi)
        axis.plot(closed, np.append(group, group[:1]), lw=1.2, label=label)
    for row, axis in enumerate(axes[0]):
        axis.set_title(f"row {row + 1}, {title}" if rows > 1 else title)
        if len(groups) > 1:
            axis.legend(loc="lower left")
    return drawing
