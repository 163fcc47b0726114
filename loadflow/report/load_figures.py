"""Figures of what the load processing finds: probability paper, harmonics, duration, tails."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatter

from loadflow.plots.style import figure, readable
from loadflow.report.heat import Cells, heat_maps

POINTS = 300  # of a sample that a probability paper shows


@dataclass(frozen=True)
class Paper:
    """A sample on probability paper.

    Attributes
    ----------
    title : str
        Distribution and how well the line fits.
    value, probability, variate : ndarray, shape (n,)
        Sorted sample, plotting positions and their reduced variate.
    line : ndarray, shape (n,)
        Value on the fitted line at each variate.
    logarithmic : bool
        Scale of the values.
    """

    title: str
    value: np.ndarray
    probability: np.ndarray
    variate: np.ndarray
    line: np.ndarray
    logarithmic: bool


def probability_papers(papers: Sequence[Paper], label: str) -> Figure:
    """Draw a sample on several papers; it lies on the line of the right one.

    Parameters
    ----------
    papers : sequence of Paper
        The same sample on each.
    label : str
        Name and display unit of the value.
    """
    drawing, axes = figure(1, len(papers), height=2.6, squeeze=False)
    for axis, paper in zip(axes[0], papers):
        last = paper.value.size - 1
        # tails are what the paper is for: positions equally spaced in the variate, not in rank
        wanted = np.linspace(paper.variate[0], paper.variate[-1], POINTS)
        shown = np.unique(np.clip(np.searchsorted(paper.variate, wanted), 0, last))
        axis.plot(paper.value[shown], paper.variate[shown], ".", ms=2.5)
        axis.plot(paper.line[[0, last]], paper.variate[[0, last]], lw=1.0)
        ticks = np.array([1e-4, 0.01, 0.1, 0.5, 0.9, 0.99, 0.9999])
        places = np.interp(ticks, paper.probability, paper.variate)
        inside = (ticks >= paper.probability[0]) & (ticks <= paper.probability[-1])
        axis.set_yticks(places[inside], [f"{100 * p:g}" for p in ticks[inside]])
        if paper.logarithmic:
            axis.set_xscale("log")
            for formatter in (axis.xaxis.set_major_formatter, axis.xaxis.set_minor_formatter):
                formatter(LogFormatter(minor_thresholds=(1.5, 0.6)))
        axis.set_title(paper.title, fontsize="small")
        axis.set_xlabel(label)
        axis.tick_params(labelsize="x-small", which="both")
    axes[0, 0].set_ylabel("not exceeded, %")
    return drawing


def harmonics(spectrum: xr.Dataset) -> Figure:
    """Draw the amplitudes of both force components, the bounds, and the harmonics that were kept.

    Parameters
    ----------
    spectrum : xarray.Dataset
        `amplitude` (axis, frequency) in N, `kept` (harmonic) in N with coordinates `at` (Hz), `of`
        (axis) and `label`; attributes `low` and `high` in Hz.
    """
    drawing, axes = figure(spectrum.sizes["axis"], height=2.0, sharex=True, squeeze=False)
    frequency = spectrum["frequency"].values
    for axis, name in zip(axes[:, 0], spectrum["axis"].values):
        values, unit = readable(spectrum["amplitude"].sel(axis=name))
        axis.plot(frequency, values, lw=0.6, color="#666666")
        own = spectrum["kept"][spectrum["of"].values == name]
        heights = readable(own)[0]
        axis.plot(own["at"], heights, "o", ms=4, color="#d1612b")
        for x, y, label in zip(own["at"].values, heights, own["label"].values):
            axis.annotate(f" {label or f'{x:.3g} Hz'}", (x, y), fontsize="x-small")
        axis.axvspan(spectrum.attrs["low"], spectrum.attrs["high"], alpha=0.08, lw=0)
        axis.set(xscale="log", ylabel=f"{name}, {unit}", xlim=(frequency[1], 5.0))
    axes[-1, 0].set_xlabel("frequency, Hz (shaded: between the bounds)")
    return drawing


def periodic_series(series: xr.Dataset) -> Figure:
    """Draw a periodic load over its closing period beside the first stretch of its series."""
    drawing, axes = figure(2, height=1.8, sharex=True)
    for axis, name in zip(axes, series["axis"].values):
        for variable in ("series", "force"):
            values, unit = readable(series[variable].sel(axis=name))
            axis.plot(series["time"], values, lw=0.7, label=series[variable].attrs["long_name"])
        axis.set_ylabel(f"{name}, {unit}")
    axes[0].legend(ncols=2)
    axes[-1].set_xlabel("time, s")
    return drawing


def bounds(found: xr.Dataset) -> Figure:
    """Draw the largest eccentricity ratio over the trial frequencies (4.23), one line a bearing."""
    drawing, axis = figure(height=2.6)
    for name in found["bearing"].values:
        axis.plot(found["frequency"], found["eccentricity_ratio"].sel(bearing=name), "o-", ms=3,
                  label=str(name))  # fmt: skip
    axis.set(xscale="log", xlabel="frequency, Hz", ylabel="largest ε in a period")
    axis.legend(ncols=3, fontsize="x-small", loc="upper right")
    return drawing


def duration(revolutions: xr.Dataset) -> Figure:
    """Draw hours and revolutions over classes of force, and revolutions over speed and force.

    Parameters
    ----------
    revolutions : xarray.Dataset
        `seconds` and `revolutions` (speed_class, load_class), `speed_edges` (rad/s) and
        `load_edges` (N).
    """
    drawing, axes = figure(1, 2, height=2.6)
    speed, speed_unit = readable(revolutions["speed_edges"])
    load, load_unit = readable(revolutions["load_edges"])
    turns = revolutions["revolutions"].values
    middle = 0.5 * (load[1:] + load[:-1])
    above = np.cumsum(turns.sum(axis=0)[::-1])[::-1]
    axes[0].step(middle, np.where(above > 0, above, np.nan), where="mid", label="revolutions above")
    hours = np.cumsum(revolutions["seconds"].values.sum(axis=0)[::-1])[::-1] / 3600
    axes[0].step(middle, np.where(hours > 0, hours, np.nan), where="mid", label="hours above")
    axes[0].set(yscale="log", xlabel=f"radial force, {load_unit}")
    axes[0].legend()
    mesh = axes[1].pcolormesh(speed, load, np.where(turns > 0, turns, np.nan).T, cmap="viridis")
    axes[1].set(xlabel=f"speed, {speed_unit}", ylabel=f"radial force, {load_unit}")
    drawing.colorbar(mesh, ax=axes[1], label="revolutions")
    return drawing


def markov(matrix: xr.Dataset) -> str:
    """Draw a Markov matrix, `counts` (from, to) between classes of `edges`, in colour, as SVG."""
    edges, unit = readable(matrix["edges"])
    counts = matrix["counts"].transpose("to", "from")
    values = np.log10(counts.where(counts > 0).values)
    labels = (f"to, {unit}", f"from, {unit}", "log10 of turning points")
    return heat_maps([Cells(edges, edges, values, labels, square=True)])


def tails(found: xr.Dataset) -> Figure:
    """Draw how often each tail exceeds a level, and their sum over the lifetime.

    Parameters
    ----------
    found : xarray.Dataset
        `rate` (tail, level) and `total` (level) in 1/year, coordinates `tail`, which names a wind
        speed, and `level`; attributes `value`, `low`, `high` in the unit of the level, `years`.
    """
    drawing, axis = figure(height=2.8)
    level, unit = readable(found["level"])
    factor = level[-1] / found["level"].values[-1]
    for name in found["tail"].values:
        axis.plot(level, found["rate"].sel(tail=name), lw=0.7, label=f"{name} m/s")
    axis.plot(level, found["total"], color="black", lw=1.4, label="all")
    axis.axhline(1 / found.attrs["years"], color="black", lw=0.7, ls="--")
    bounds_of = [found.attrs[key] * factor for key in ("low", "high")]
    axis.axvspan(*bounds_of, alpha=0.15, lw=0)
    axis.axvline(found.attrs["value"] * factor, color="black", lw=0.7, ls="--")
    low = 0.1 / found.attrs["years"]
    axis.set(yscale="log", ylim=(low, None), xlabel=f"level, {unit}", ylabel="exceedances a year")
    axis.legend(ncols=3, fontsize="x-small")
    return drawing
