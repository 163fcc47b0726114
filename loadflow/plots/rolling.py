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

    Examples
    --------
    >>> import numpy as np
    >>> len(contact_pressure(np.arange(6.0), np.ones((2, 6))).axes)
    1
    """
    return _polar(angle, np.asarray(pressure) / 1e6, names, 1, "contact pressure, MPa")


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
