"""Figures of a journal bearing: pressure, gap, shaft centre, K and C, friction over speed."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.plots.style import Margins, envelope, figure, readable


def film_series(samples: xr.Dataset) -> Figure:
    """Draw eccentricity ratio, smallest film and largest pressure over time.

    Parameters
    ----------
    samples : xarray.Dataset
        `minimum_film`, `maximum_pressure` and, of a journal bearing, `eccentricity_ratio` over
        `time`: an orbit, or the samples of a run.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> from loadflow.journal import Film, JournalBearing, Lubricant
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> film = Film(Lubricant(0.03), rung="reduced", inlet=None)
    >>> path = bearing.orbit([0, 0.01, 0.02], [[5e3, 0]] * 3, 100.0, film)
    >>> len(film_series(path).axes)
    3
    """
    wanted = (("eccentricity_ratio", None), ("minimum_film", "µm"), ("maximum_pressure", None))
    panels = [(name, unit) for name, unit in wanted if name in samples]
    drawing, axes = figure(len(panels), sharex=True, height=1.8)
    for axis, (name, unit) in zip(axes, panels):
        values, shown = readable(samples[name], unit)
        envelope(axis, samples["time"].values, values, name)
        said = samples[name].attrs["long_name"]
        axis.set_title(said if shown == "–" else f"{said}, {shown}")
    reduced = samples.attrs.get("motion") == "quasi-static"
    axes[-1].set_xlabel("time, s (reduced series)" if reduced else "time, s")
    return drawing


def orbit(samples: xr.Dataset) -> Figure:
    """Draw where the shaft centre is in the clearance circle.

    Parameters
    ----------
    samples : xarray.Dataset
        `eccentricity` (…, 2), m, along the load (down) and across it, and `minimum_film`; the
        clearance is its attribute ``radial_clearance``, or follows from `eccentricity_ratio`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> from loadflow.journal import Film, JournalBearing, Lubricant
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> film = Film(Lubricant(0.03), rung="reduced", inlet=None)
    >>> path = bearing.orbit([0, 0.01, 0.02], [[5e3, 0]] * 3, 100.0, film)
    >>> orbit(path).axes[0].get_xlabel()
    'to the left (y) / clearance'
    """
    across = next(dim for dim in samples["eccentricity"].dims if samples.sizes[dim] == 2)
    place = samples["eccentricity"].transpose(..., across).values.reshape(-1, 2)
    clearance = samples.attrs.get("radial_clearance")
    if clearance is None:
        ratio = samples["eccentricity_ratio"].values.ravel()
        k = int(np.nanargmax(ratio))
        clearance = float(np.hypot(*place[k]) / ratio[k])
    film = readable(samples["minimum_film"], "µm")[0].ravel()
    return clearance_circle(place / clearance, film)


def clearance_circle(place: ArrayLike, film: ArrayLike | None = None) -> Figure:
    """Draw places of the shaft centre over the clearance, looking downwind.

    Parameters
    ----------
    place : array_like (n, 2)
        Eccentricity over clearance: down, and to the left.
    film : array_like (n,), optional
        Smallest film, µm, as a colour.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> len(clearance_circle([[0.5, 0.2], [0.6, 0.1]], [20.0, 15.0]).axes)
    2
    """
    down, left = np.asarray(place, dtype=float).reshape(-1, 2).T
    drawing, axis = figure(height=4.2, margins=Margins(right=0.5))
    circle = np.linspace(0, 2 * np.pi, 181)
    axis.plot(np.cos(circle), np.sin(circle), color="black", lw=1.0, label="contact")
    many = down.size > 500  # then dots, as one picture within the drawing
    size = 3 if down.size > 50 else 18
    if film is None:
        axis.scatter(left, -down, s=size, rasterized=many)
    else:
        points = axis.scatter(left, -down, s=size, c=film, cmap="plasma_r", rasterized=many)
        drawing.colorbar(points, ax=axis, label="smallest film, µm")
    axis.set(aspect="equal", xlabel="to the left (y) / clearance", ylabel="up (z) / clearance")
    axis.set_title("shaft centre, looking downwind")
    axis.invert_xaxis()  # the left of one who looks downwind is the left of the page
    return drawing


def pressure(
    angle: ArrayLike, z: ArrayLike, pressure: ArrayLike, gap: ArrayLike | None = None
) -> Figure:
    """Draw the film unwrapped and around the shaft: pressure, and the gap if it is given.

    Parameters
    ----------
    angle : array_like (n,)
        Of the cells from the first axis, rad.
    z : array_like (m,)
        Axial place of the cells, m.
    pressure : array_like (n, m)
        Pa.
    gap : array_like (n, m), optional
        m.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> import numpy as np
    >>> angle, z = np.linspace(0, 6, 12), np.linspace(-0.1, 0.1, 4)
    >>> len(pressure(angle, z, np.outer(1 + np.cos(angle), [1e6, 2e6, 2e6, 1e6])).axes)
    3
    """
    theta, values = _in_order(angle, pressure)
    drawing, _ = figure(1, 1, height=3.2)
    drawing.clear()
    columns = 2 if gap is None else 3
    unwrapped = drawing.add_subplot(1, columns, 1)
    shown = unwrapped.pcolormesh(
        np.degrees(theta), 1e3 * np.asarray(z), values.T / 1e6, cmap="viridis", shading="nearest"
    )
    drawing.colorbar(shown, ax=unwrapped, label="pressure, MPa")
    unwrapped.set(xlabel="angle from the first axis, °", ylabel="axial place, mm")
    unwrapped.grid(False)
    around = drawing.add_subplot(1, columns, 2, projection="polar")
    _around(around, theta, values[:, _middle(z)] / 1e6)
    around.set_title("pressure in the middle, MPa")
    if gap is not None:
        _, heights = _in_order(angle, gap)
        last = drawing.add_subplot(1, columns, 3, projection="polar")
        _around(last, theta, heights[:, _middle(z)] * 1e6)
        last.set_title("gap in the middle, µm")
    return drawing


def pads(films: Mapping[str, tuple[ArrayLike, ArrayLike, ArrayLike]]) -> Figure:
    """Draw the pressure over the pads of thrust and conical bearings, seen along the axis.

    Parameters
    ----------
    films : mapping
        By title: angle of the nodes (pads, n), rad; their distance (m,) from the axis or the apex,
        m; pressure (pads, n, m), Pa.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> import numpy as np
    >>> angle = [[0.0, 0.2, 0.4], [1.0, 1.2, 1.4]]
    >>> len(pads({"front": (angle, [0.5, 0.6], np.full((2, 3, 2), 1e6))}).axes)
    2
    """
    drawing, axes = figure(
        1, len(films), height=3.6, squeeze=False, subplot_kw={"projection": "polar"}
    )
    largest = max(float(np.max(np.asarray(values))) for _, _, values in films.values()) / 1e6
    for axis, (title, (angle, place, values)) in zip(axes[0], films.items()):
        for theta, own in zip(np.asarray(angle, dtype=float), np.asarray(values, dtype=float)):
            shown = axis.pcolormesh(
                theta, np.asarray(place, dtype=float), own.T / 1e6, cmap="viridis",
                shading="gouraud", vmin=0.0, vmax=largest,
            )  # fmt: skip
        axis.set(title=title, rlim=(0.0, float(np.max(np.asarray(place)))))
        axis.set_theta_zero_location("S")
        axis.grid(False)
        axis.set_yticks([])
    drawing.colorbar(shown, ax=list(axes[0]), label="pressure, MPa")
    return drawing


def pressure_around(angle: ArrayLike, pressure: ArrayLike) -> Figure:
    """Draw the pressure of one ring of cells around the shaft, Pa over rad.

    Parameters
    ----------
    angle : array_like (n,)
        Of the cells, rad.
    pressure : array_like (n,)
        Pa.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> len(pressure_around([0.0, 2.0, 4.0], [1e6, 2e6, 0.0]).axes)
    1
    """
    drawing, axis = figure(height=3.6, subplot_kw={"projection": "polar"})
    _around(axis, *_in_order(angle, np.asarray(pressure, dtype=float) / 1e6))
    axis.set_title("pressure, MPa")
    return drawing


def gap_around(angle: ArrayLike, gap: ArrayLike) -> Figure:
    """Draw the gap of one ring of cells around the shaft, m over rad.

    Parameters
    ----------
    angle : array_like (n,)
        Of the cells, rad.
    gap : array_like (n,)
        m.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> len(gap_around([0.0, 2.0, 4.0], [1e-4, 2e-4, 1e-4]).axes)
    1
    """
    drawing, axis = figure(height=3.6, subplot_kw={"projection": "polar"})
    _around(axis, *_in_order(angle, np.asarray(gap, dtype=float) * 1e6))
    axis.set_title("gap, µm")
    return drawing


def coefficients(speed: ArrayLike, stiffness: ArrayLike, damping: ArrayLike) -> Figure:
    """Draw stiffness and damping of a film over speed.

    Parameters
    ----------
    speed : array_like (n,)
        rad/s.
    stiffness, damping : array_like (n, 2, 2) or (n, 4, 4)
        N/m and N s/m; those of tilts are not drawn.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Raises
    ------
    loadflow.errors.InputError
        Fewer than two speeds.

    Examples
    --------
    >>> import numpy as np
    >>> len(coefficients([1.0, 2.0], np.ones((2, 2, 2)), np.ones((2, 2, 2))).axes)
    2
    """
    speeds = np.ravel(np.asarray(speed, dtype=float))
    if speeds.size < 2:
        raise InputError("speed: K and C over speed need two speeds at least")
    order = np.argsort(speeds)
    drawing, axes = figure(1, 2, height=3.0)
    both = (("K", stiffness, 1e-9, "GN/m"), ("C", damping, 1e-9, "GN s/m"))
    for axis, (symbol, values, factor, unit) in zip(axes, both):
        matrix = np.asarray(values, dtype=float)
        matrix = matrix.reshape(speeds.size, *matrix.shape[-2:])[order] * factor
        for i in range(2):
            for j in range(2):
                axis.plot(
                    speeds[order], matrix[:, i, j], "o-", ms=3, label=f"{symbol}{'xy'[i]}{'xy'[j]}"
                )
        axis.set(xlabel="speed, rad/s", ylabel=f"{symbol}, {unit}")
        axis.legend()
    return drawing


def stribeck(curve: xr.Dataset) -> Figure:
    """Draw friction over speed, and the share of the load that asperities carry.

    Parameters
    ----------
    curve : xarray.Dataset
        Of `loadflow.journal.stribeck`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Examples
    --------
    >>> import xarray as xr
    >>> curve = xr.Dataset({"friction_coefficient": ("speed", [0.1, 0.01, 0.02])},
    ...                    {"speed": [0.1, 1.0, 10.0]})
    >>> stribeck(curve).axes[0].get_xscale()
    'log'
    """
    drawing, axis = figure(height=3.2)
    axis.plot(curve["speed"], curve["friction_coefficient"], "o-", ms=3, label="friction")
    axis.set(xscale="log", yscale="log", xlabel="speed, rad/s", ylabel="coefficient of friction")
    if "contact_share" in curve:
        twin = axis.twinx()
        twin.plot(curve["speed"], curve["contact_share"], "--", color="#d1612b", lw=1)
        twin.set(ylabel="share of the load on asperities", ylim=(0, 1))
        twin.grid(False)
    for name, style in (("minimum_speed", ":"), ("transition_speed", "-.")):
        if name in curve and np.isfinite(float(curve[name])):
            axis.axvline(
                float(curve[name]), color="black", lw=0.8, ls=style, label=name.replace("_", " ")
            )
    axis.legend()
    return drawing


def _in_order(angle: ArrayLike, values: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Angles within one turn, ascending, and the values there."""
    theta = np.mod(np.asarray(angle, dtype=float), 2 * np.pi)
    order = np.argsort(theta)
    return theta[order], np.asarray(values, dtype=float)[order]


def _middle(z: ArrayLike) -> int:
    return int(np.argmin(np.abs(np.asarray(z, dtype=float))))


def _around(axis: object, theta: np.ndarray, values: np.ndarray) -> None:
    """Draw a closed line on a polar axis; the first axis points down, as the weight does."""
    closed = np.append(theta, theta[:1] + 2 * np.pi)
    axis.plot(closed, np.append(values, values[:1]), lw=1.2)  # type: ignore[attr-defined]
    axis.set_theta_zero_location("S")  # type: ignore[attr-defined]
