"""Charts of a run: Dataset in, what the browser draws out."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr

from loadflow.plots.style import readable
from loadflow.report.charts import SAMPLES, Chart, Panel


def load_chart(
    loads: xr.Dataset, bearings: xr.Dataset, caption: str, fold: bool, samples: int = SAMPLES
) -> Chart:
    """Speed and pitch, hub moments and the radial forces of the bearings over time.

    Parameters
    ----------
    loads : xarray.Dataset
        Case of a load cube: `speed`, `hub_moment`, and `pitch` if it is there, over time.
    bearings : xarray.Dataset
        `force` (bearing, axis, time) of the same case.
    caption : str
        What it shows.
    fold : bool
        Hide it until it is clicked.
    samples : int
        Values of a line in the page.
    """
    panels = [_one(loads[name]) for name in ("speed", "pitch") if name in loads]
    moment = loads["hub_moment"].sel(axis=["y", "z"]).transpose("axis", "time")
    values, unit = readable(moment)
    panels.append(Panel(f"hub moment, {unit}", dict(zip(("tilt (y)", "yaw (z)"), values))))
    force = bearings["force"].sel(axis=["y", "z"]).transpose("bearing", "axis", "time")
    values, unit = readable(force)
    lines = {
        f"{bearing} F{axis}": values[b, a]
        for b, bearing in enumerate(force["bearing"].values)
        for a, axis in enumerate("yz")
    }
    panels.append(Panel(f"bearing force, {unit}", lines))
    return Chart(caption, "time, s", loads["time"].values, panels, fold, samples)


def film_chart(
    samples: xr.Dataset,
    caption: str,
    fold: bool,
    count: int = SAMPLES,
    level: float | None = None,
    least: float | None = None,
) -> Chart:
    """Eccentricity ratio, smallest film and largest pressure over time.

    Parameters
    ----------
    samples : xarray.Dataset
        `time`, `eccentricity_ratio`, `minimum_film` and `maximum_pressure` of a film.
    caption : str
        What it shows.
    fold : bool
        Hide it until it is clicked.
    count : int
        Values of a line in the page.
    level : float, optional
        Eccentricity ratio at which mixed friction begins.
    least : float, optional
        Film, m, at which it begins where no such ratio tells.
    """
    order = np.argsort(samples["time"].values, kind="stable")
    panels = []
    for name, short, units, at in (  # a long name has no room beside a frame
        ("eccentricity_ratio", "eccentricity ratio", None, level),
        ("minimum_film", "smallest film", "µm", None if least is None else 1e6 * least),
        ("maximum_pressure", "largest pressure", None, None),
    ):
        values, unit = readable(samples[name], units)
        said = samples[name].attrs["long_name"]
        panels.append(Panel(_with_unit(short, unit), {said: values[order]}, at))
    reduced = samples.attrs.get("motion") == "quasi-static"
    label = "time, s (reduced series)" if reduced else "time, s"
    return Chart(caption, label, samples["time"].values[order], panels, fold, count)


def duration_chart(revolutions: xr.Dataset, caption: str) -> Chart:
    """Hours and revolutions above each force.

    Parameters
    ----------
    revolutions : xarray.Dataset
        `seconds` and `revolutions` (speed_class, load_class) and `load_edges`.
    caption : str
        What it shows.
    """
    edges, unit = readable(revolutions["load_edges"])
    lines = {}
    for words, name, scale in (
        ("hours above", "seconds", 3600.0), ("revolutions above", "revolutions", 1.0),
    ):  # fmt: skip
        own = revolutions[name].transpose("speed_class", "load_class").values.sum(axis=0) / scale
        above = np.cumsum(own[::-1])[::-1]
        lines[words] = np.where(above > 0, above, np.nan)
    panel = Panel("in the lifetime", lines, logarithmic=True)
    return Chart(caption, f"radial force, {unit}", edges[:-1], [panel])


def exceedance_chart(found: xr.Dataset, caption: str) -> Chart:
    """How often a year a level is exceeded, tail by tail and together.

    Parameters
    ----------
    found : xarray.Dataset
        `rate` (tail, level) and `total` (level) in 1/year, coordinates `tail`, which names a wind
        speed, and `level`; attribute `years` of the return period.
    caption : str
        What it shows.
    """
    level, unit = readable(found["level"])
    least = 0.1 / found.attrs["years"]
    lines = {f"{name} m/s": found["rate"].sel(tail=name).values for name in found["tail"].values}
    lines["all"] = found["total"].values
    shown = {name: np.where(rate > least, rate, np.nan) for name, rate in lines.items()}
    panel = Panel("exceedances a year", shown, 1 / found.attrs["years"], logarithmic=True)
    return Chart(caption, f"level, {unit}", level, [panel])


def reduction_chart(reduced: xr.Dataset, caption: str, fold: bool) -> Chart:
    """How the loads are distributed before and after the reduction of a series.

    Parameters
    ----------
    reduced : xarray.Dataset
        `counts_full` and `counts_reduced` (speed_class, load_class) and `load_edges`.
    caption : str
        What it shows.
    fold : bool
        Hide it until it is clicked.
    """
    edges, unit = readable(reduced["load_edges"])
    lines = {}
    for words, name in (("full series", "counts_full"), ("reduced", "counts_reduced")):
        counts = reduced[name].transpose("speed_class", "load_class").values.sum(axis=0)
        lines[words] = 100 * counts / max(int(counts.sum()), 1)
    label = f"{reduced['load_edges'].attrs['long_name']}, {unit}"
    panel = Panel("samples in the class, %", lines)
    return Chart(caption, label, 0.5 * (edges[1:] + edges[:-1]), [panel], fold)


def ring_chart(worst: xr.Dataset, caption: str, fold: bool) -> Chart:
    """Contact force of every ball around the ring, unrolled.

    Parameters
    ----------
    worst : xarray.Dataset
        `ball_forces` (row, diagonal, ball) and `ball_angle`.
    caption : str
        What it shows.
    fold : bool
        Hide it until it is clicked.
    """
    forces = worst["ball_forces"].transpose("row", "diagonal", "ball")
    values, unit = readable(forces)
    lines = {
        f"row {r + 1}, diagonal {d + 1}": values[r, d]
        for r in range(values.shape[0])
        for d in range(values.shape[1])
    }
    angle, degrees = readable(worst["ball_angle"])
    label = f"angle around the ring, {degrees}"
    return Chart(caption, label, angle, [Panel(f"force on a ball, {unit}", lines)], fold)


def over_wind_speed(
    journal: xr.Dataset | None, rolling: xr.Dataset | None, caption: str
) -> Iterator[Chart]:
    """Yield what matters of each load case over wind speed: every seed a point.

    Parameters
    ----------
    journal, rolling : xarray.Dataset or None
        Results of a run over ``case``.
    caption : str
        What it shows.
    """
    speeds = {
        str(case): float(speed)
        for data in (journal, rolling)
        if data is not None
        for case, speed in zip(data["case"].values, data["wind_speed"].values)
    }
    cases, panels = sorted(speeds, key=lambda case: speeds[case]), []
    for data, names in (
        (journal, ("largest_eccentricity_ratio", "smallest_film", "largest_pressure")),
        (rolling, ("largest_ball_force", "smallest_static_safety")),
    ):
        for name in names if data is not None else ():
            assert data is not None
            found = data[name].reindex(case=cases)  # a case may have an answer in one alone
            dims = [dim for dim in ("bearing",) if dim in found.dims]
            film = "µm" if name == "smallest_film" else None
            values, unit = readable(found.transpose(*dims, "case"), film)
            said = data[name].attrs["long_name"]
            labels = [str(b) for b in data["bearing"].values] if dims else [said]
            lines = dict(zip(labels, np.atleast_2d(values)))
            panels.append(Panel(_with_unit(said, unit), lines))
    if cases:
        x = np.array([speeds[case] for case in cases])
        yield Chart(caption, "wind speed, m/s", x, panels, points=True, names=cases)


def seed_verdicts(seeds: xr.Dataset, method: str, caption: str) -> Chart:
    """P values of the tests over wind speed; a frame for each test that has some.

    Parameters
    ----------
    seeds : xarray.Dataset
        `pvalue` (variant, group, component, test), `wind_speed` (group); attribute ``alpha``.
    method : str
        Variant of the tests.
    caption : str
        What it shows.
    """
    part = seeds.sel(variant=method)
    order = np.argsort(part["wind_speed"].values, kind="stable")
    alpha, panels = float(seeds.attrs["alpha"]), []
    for test in part["test"].values:
        p = part["pvalue"].sel(test=test).transpose("component", "group").values[:, order]
        if np.isnan(p).all():  # as of the spectrum as printed, which is compared without a p
            continue
        lines = {str(c): np.maximum(p[k], 1e-12) for k, c in enumerate(part["component"].values)}
        panels.append(Panel(f"p of {test}", lines, alpha, logarithmic=True))
    groups = part.isel(group=order)
    names = [
        f"DLC {dlc}, {speed:g} m/s"
        for dlc, speed in zip(groups["dlc"].values, groups["wind_speed"].values)
    ]
    x = groups["wind_speed"].values
    return Chart(caption, "wind speed, m/s", x, panels, points=True, names=names)


def _one(data: xr.DataArray) -> Panel:
    values, unit = readable(data)
    return Panel(_with_unit(data.attrs["long_name"], unit), {data.attrs["long_name"]: values})


def _with_unit(name: str, unit: str) -> str:
    return name if unit == "–" else f"{name}, {unit}"
