"""A moment of a load case as a picture: the series of a bearing for some seconds around it."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from loadflow.plots.style import readable
from loadflow.report.charts import Chart, Panel

AROUND = 15.0
"""Seconds that are shown before and behind a moment."""

_VALUES = 800  # of a line: 30 s at 0.04 s, or every extreme of what is longer or finer


@dataclass(frozen=True)
class Moment:
    """Where a number is from.

    Attributes
    ----------
    case : str
        Load case.
    time : float
        In it, s; NaN where the number is of the whole load case.
    place : str
        Bearing.

    Examples
    --------
    >>> from loadflow.report.moments import Moment
    >>> moment = Moment("dlc1.1_v18_s2", 48.575, "N")
    >>> moment.anchor, moment.told
    ('at-dlc1.1_v18_s2-N-48.575', 'dlc1.1_v18_s2, 48.6 s, bearing N')
    """

    case: str
    time: float
    place: str

    @property
    def anchor(self) -> str:
        """Name for links within a page."""
        time = "" if math.isnan(self.time) else f"-{self.time:.3f}"
        return re.sub(r"[^\w.+-]+", "_", f"at-{self.case}-{self.place}{time}")

    @property
    def within(self) -> str:
        """Load case, and time where it is known, in words."""
        return self.case if math.isnan(self.time) else f"{self.case}, {self.time:.1f} s"

    @property
    def told(self) -> str:
        """It in words, with its bearing."""
        return f"{self.within}, bearing {self.place}"


def place_of(subject: str) -> str:
    """Bearing that a verdict is on, of its subject: kind and place.

    Examples
    --------
    >>> from loadflow.report.moments import place_of
    >>> place_of("journal N2")
    'N2'
    """
    return subject.rpartition(" ")[2]


def links_to(
    moments: Iterable[Moment | None], column: int, shown: Collection[str]
) -> dict[tuple[int, int], str]:
    """Links from a column of a table to the moments of its rows that a page shows.

    Parameters
    ----------
    moments : iterable of Moment or None
        Of each row.
    column : int
        Number of the column.
    shown : collection of str
        Anchors of the page.
    """
    anchors = (None if moment is None else moment.anchor for moment in moments)
    return {(k, column): name for k, name in enumerate(anchors) if name in shown and name}


def moment_chart(
    moment: Moment,
    series: xr.Dataset,
    samples: Mapping[str, xr.Dataset],
    caption: str,
    anchor: str = "",
) -> Chart:
    """Loads, speed, film and pressure of a bearing around a moment, which is marked.

    Parameters
    ----------
    moment : Moment
        What is marked; without a time the whole load case is shown.
    series : xarray.Dataset
        `speed` (time), `force` and `moment` (axis, time) of the bearing.
    samples : mapping of str to xarray.Dataset
        By what they are of: `time`, and `minimum_film` or `maximum_pressure` where known, of
        some samples of the series, or of all of them, in any order.
    caption : str
        What it shows.
    anchor : str, optional
        Name for links to it; default that of the moment.
    """
    known = not math.isnan(moment.time)
    if known:
        time = series["time"].values
        series = series.isel(time=np.abs(time - moment.time) <= AROUND)
    panels = [_across_and_along(series["force"], "force")]
    if series["moment"].values.any():
        panels.append(_across_and_along(series["moment"], "moment"))
    speed, unit = readable(series["speed"])
    panels.append(Panel(f"speed, {unit}", {"speed": speed}))
    time = series["time"].values
    panels += _of_samples(time, samples, "minimum_film", "smallest film", "µm")
    panels += _of_samples(time, samples, "maximum_pressure", "largest pressure", None)
    return Chart(
        caption, "time, s", time, panels, True, _VALUES,
        mark=moment.time if known else None, anchor=anchor or moment.anchor,
    )  # fmt: skip


def _across_and_along(load: xr.DataArray, name: str) -> Panel:
    values, unit = readable(load.transpose("axis", "time"))
    along, *across = values
    lines = {"across the shaft": np.hypot(*across)}
    if along.any():
        lines["along it"] = along
    return Panel(f"{name}, {unit}", lines)


def _of_samples(
    time: np.ndarray, samples: Mapping[str, xr.Dataset], name: str, said: str, units: str | None
) -> Iterator[Panel]:
    """Yield the frame of what samples know, at their places of the series; none without any."""
    step = np.diff(time).max(initial=0.0)
    own: dict[str, xr.Dataset] = {}
    for what, data in samples.items():
        if name in data:
            near = (data["time"] >= time[0] - 0.5 * step) & (data["time"] <= time[-1] + 0.5 * step)
            part = data[["time", name]].isel(sample=(near & data[name].notnull()).values)
            own |= {what: part} if part.sizes["sample"] else {}
    if not own:
        return
    attributes = next(iter(own.values()))[name].attrs
    placed = xr.DataArray(np.full((len(own), time.size), np.nan), attrs=attributes)
    middles = 0.5 * (time[1:] + time[:-1])
    for row, part in zip(placed.values, own.values()):
        row[np.searchsorted(middles, part["time"].values)] = part[name].values
    values, unit = readable(placed, units)  # all in one
    lines = dict(zip(own, values))
    yield Panel(f"{said}, {unit}", lines, dots=any(map(_stand_alone, lines.values())))


def _stand_alone(values: np.ndarray) -> bool:
    """Whether some values have none beside them, so that no line shows them."""
    known = np.pad(np.isfinite(values), 1)
    return bool((known[1:-1] & ~known[:-2] & ~known[2:]).any())
