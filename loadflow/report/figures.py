"""One function for each figure of the report: Dataset in, matplotlib Figure out."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from loadflow.plots.rolling import element_forces
from loadflow.plots.style import Margins, figure, readable
from loadflow.report.heat import Cells, heat_maps


def seed_boxes(samples: dict[str, dict[str, np.ndarray]], units: dict[str, str]) -> Figure:
    """Draw the spread of each seed beside the others, one panel for each component.

    Parameters
    ----------
    samples : dict
        For each component, the samples (n,) of each seed, in display units.
    units : dict
        Display unit of each component.
    """
    drawing, axes = figure(1, len(samples), height=2.4, squeeze=False)
    for axis, (component, seeds) in zip(axes[0], samples.items()):
        axis.boxplot(
            list(seeds.values()),
            tick_labels=list(seeds),
            whis=(1, 99),
            showfliers=False,
            medianprops={"color": "#d1612b"},
        )
        axis.set_title(component)
        axis.set_ylabel(units[component])
        axis.set_xlabel("seed")
    drawing.supxlabel("box: quartiles; whiskers: 1 % and 99 %", fontsize="small")
    return drawing


def seed_spread(quantiles: dict[str, xr.DataArray]) -> Figure:
    """Draw the spread of every seed beside the others of its wind speed, one frame a component.

    Parameters
    ----------
    quantiles : dict
        For each component, its values (case, quantile) at five shares of the samples, with the
        coordinates `group` and `seed` (case).
    """
    columns = min(2, len(quantiles))
    rows = -(-len(quantiles) // columns)
    drawing, axes = figure(rows, columns, height=1.9, squeeze=False, sharex=True)
    for axis, (component, data) in zip(axes.ravel(), quantiles.items()):
        names, group = np.unique(data["group"].values, return_inverse=True)
        names, group = _in_given_order(names, group)
        place = group + _beside(group)
        values, unit = readable(data.transpose("quantile", "case"))
        axis.vlines(place, values[0], values[4], lw=0.8, color="#8794a3")
        axis.vlines(place, values[1], values[3], lw=3.0, color="#1f5a94")
        axis.plot(place, values[2], "o", ms=2.2, color="#d1612b")
        axis.set(title=component, ylabel=unit)
        shown = np.arange(0, names.size, -(-names.size // 12))
        turn = 45 if max(map(len, names)) * shown.size > 60 else 0
        axis.set_xticks(shown, names[shown], rotation=turn, ha="right" if turn else "center")
    drawing.set_layout_engine(Margins(bottom=1.1 if turn else 0.75))
    drawing.supxlabel(
        "thin: 1 … 99 % of the samples, thick: quartiles, dot: median", fontsize="small"
    )
    return drawing


def _in_given_order(names: np.ndarray, group: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Names of groups and the group of each case, in the order in which the cases come."""
    _, first = np.unique(group, return_index=True)
    order = np.argsort(first)
    return names[order], np.argsort(order)[group]


def _beside(group: np.ndarray) -> np.ndarray:
    """Shift of each case from the middle of its group."""
    shift = np.zeros(group.size)
    for one in np.unique(group):
        own = np.flatnonzero(group == one)
        shift[own] = 0.7 * (np.arange(own.size) - 0.5 * (own.size - 1)) / max(own.size, 1)
    return shift


def seed_spectra(spectra: dict[str, xr.DataArray], band: float) -> Figure:
    """Draw the spectrum of each seed, and below its ratio to the mean of the seeds.

    Parameters
    ----------
    spectra : dict
        For each component the density over (seed, frequency), with its `units` and, in the
        attribute ``confidence``, the bounds of one density over the density itself.
    band : float
        Allowed relative difference, shown about the mean.
    """
    drawing, axes = figure(2, len(spectra), height=2.2, squeeze=False, sharex="col")
    for (above, below), (component, density) in zip(axes.T, spectra.items()):
        frequency, mean = density["frequency"].values, density.mean("seed").values
        used = mean > 0
        for seed in density["seed"].values:
            line = density.sel(seed=seed).values
            above.plot(frequency[used], line[used], lw=0.7, label=str(seed))
            below.plot(frequency[used], line[used] / mean[used], lw=0.6)
        below.axhspan(*density.attrs["confidence"], color="black", alpha=0.08, lw=0)
        below.axhspan(1 - band, 1 + band, color="black", alpha=0.5, lw=0)
        above.set(xscale="log", title=component, ylabel=density.attrs["units"])
        if used.any():
            above.set_yscale("log")
        below.set(xscale="log", xlabel="frequency, Hz", ylabel="over the mean")
        below.xaxis.set_minor_formatter(NullFormatter())  # they overlap in narrow panels
    axes[0, 0].legend(title="seed", ncols=2, loc="lower left")
    return drawing


def histograms(reduced: xr.Dataset) -> str:
    """Draw the bivariate histogram of speed and load before and after the reduction, as SVG."""
    speed, speed_unit = readable(reduced["speed_edges"])
    load, load_unit = readable(reduced["load_edges"])
    across = f"{reduced['load_edges'].attrs['long_name']}, {load_unit}"
    labels = (f"speed, {speed_unit}", across, "samples in the class")
    frames = []
    for name in ("counts_full", "counts_reduced"):
        counts = reduced[name].values.astype(float)
        title = f"{reduced[name].attrs['long_name']}: {counts.sum():.0f} samples"
        frames.append(Cells(speed, load, np.where(counts > 0, counts, np.nan), labels, title))
    return heat_maps(frames)


def ball_ring(worst: xr.Dataset) -> Figure:
    """Draw the contact force of every ball around the ring, at the most loaded sample."""
    rows, diagonals = worst.sizes["row"], worst.sizes["diagonal"]
    forces = worst["ball_forces"].transpose("row", "diagonal", "ball").values
    names = [f"diagonal {k % diagonals + 1}" for k in range(rows * diagonals)]
    groups = forces.reshape(rows * diagonals, -1)
    return element_forces(worst["ball_angle"].values, groups, names, rows)
