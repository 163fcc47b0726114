"""One function for each figure of the report: Dataset in, matplotlib Figure out."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from loadflow.plots.rolling import element_forces
from loadflow.plots.style import envelope, figure, readable


def load_series(loads: xr.Dataset, bearings: xr.Dataset) -> Figure:
    """Draw speed and pitch, hub moments and the radial force of each bearing over time.

    Parameters
    ----------
    loads : xarray.Dataset
        Case of a load cube: `speed`, `hub_moment`, and `pitch` if it is there, over time.
    bearings : xarray.Dataset
        `force` (bearing, axis, time) of the same case.

    Returns
    -------
    matplotlib.figure.Figure
    """
    drawing, axes = figure(3, sharex=True)
    time = loads["time"].values
    for name in (key for key in ("speed", "pitch") if key in loads):
        values, unit = readable(loads[name])
        envelope(axes[0], time, values, f"{loads[name].attrs['long_name']}, {unit}")
    for name, axis in (("tilt", "y"), ("yaw", "z")):
        values, unit = readable(loads["hub_moment"].sel(axis=axis))
        envelope(axes[1], time, values, f"{name} moment")
        axes[1].set_ylabel(f"hub moment, {unit}")
    for bearing in bearings["bearing"].values:
        for axis in ("y", "z"):
            values, unit = readable(bearings["force"].sel(bearing=bearing, axis=axis))
            envelope(axes[2], time, values, f"{bearing}, {axis}")
        axes[2].set_ylabel(f"bearing force, {unit}")
    axes[2].set_xlabel("time, s")
    for axis in axes:
        axis.legend(ncols=6, loc="upper right")
    return drawing


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


def seed_verdicts(seeds: xr.Dataset, method: str) -> Figure:
    """Draw p values of location and spread and the spectral difference over wind speed."""
    part = seeds.sel(variant=method)
    drawing, axes = figure(1, 3, height=2.4)
    for axis, test in zip(axes, ("location", "spread", "spectrum")):
        for component in part["component"].values:
            p = part["pvalue"].sel(test=test, component=component)
            axis.plot(part["wind_speed"], np.maximum(p, 1e-12), "o-", ms=3, label=str(component))
        axis.axhline(seeds.attrs["alpha"], color="black", lw=0.8, ls="--")
        axis.set(yscale="log", ylim=(1e-12, 2), title=test, xlabel="wind speed, m/s")
    axes[0].set_ylabel("p value (below the line: not equal)")
    axes[0].legend()
    return drawing


def histograms(reduced: xr.Dataset) -> Figure:
    """Draw the bivariate histogram of speed and load before and after the reduction."""
    drawing, axes = figure(1, 2, height=2.8, sharey=True)
    speed, speed_unit = readable(reduced["speed_edges"])
    load, load_unit = readable(reduced["load_edges"])
    for axis, name in zip(axes, ("counts_full", "counts_reduced")):
        counts = reduced[name].values.astype(float)
        mesh = axis.pcolormesh(speed, load, np.where(counts > 0, counts, np.nan).T, cmap="viridis")
        axis.set_title(f"{reduced[name].attrs['long_name']}: {counts.sum():.0f} samples")
        axis.set_xlabel(f"speed, {speed_unit}")
        drawing.colorbar(mesh, ax=axis, label="samples in the class")
    axes[0].set_ylabel(f"{reduced['load_edges'].attrs['long_name']}, {load_unit}")
    return drawing


def ball_ring(worst: xr.Dataset) -> Figure:
    """Draw the contact force of every ball around the ring, at the most loaded sample."""
    rows, diagonals = worst.sizes["row"], worst.sizes["diagonal"]
    forces = worst["ball_forces"].transpose("row", "diagonal", "ball").values
    names = [f"diagonal {k % diagonals + 1}" for k in range(rows * diagonals)]
    groups = forces.reshape(rows * diagonals, -1)
    return element_forces(worst["ball_angle"].values, groups, names, rows)


def over_wind_speed(journal: xr.Dataset | None, rolling: xr.Dataset | None) -> Figure | None:
    """Draw what matters of each load case over wind speed: every seed a point."""
    panels = [
        (data, name)
        for data, names in (
            (journal, ("largest_eccentricity_ratio", "smallest_film", "largest_pressure")),
            (rolling, ("largest_ball_force", "smallest_static_safety")),
        )
        if data is not None
        for name in names
    ]
    if not panels:
        return None
    drawing, axes = figure(1, len(panels), height=2.4, squeeze=False)
    for axis, (data, name) in zip(axes[0], panels):
        values, unit = readable(data[name], "µm" if name == "smallest_film" else None)
        lines = values if values.ndim == 2 else values[None]
        labels = data["bearing"].values if "bearing" in data[name].dims else [None]
        for line, label in zip(lines, labels):
            axis.plot(data["wind_speed"], line, "o", ms=3, alpha=0.7, label=label)
        axis.set_title(f"{data[name].attrs['long_name']}, {unit}", fontsize="small")
        axis.set_xlabel("wind speed, m/s")
        if labels[0] is not None:
            axis.legend()
    return drawing
