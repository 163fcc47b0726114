"""Load cube → statistics of every case and contemporaneous extremes, as CSV and a page."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import Cube, iter_cases
from loadflow.plots.style import readable
from loadflow.quantities import four_digits
from loadflow.report import Section, Table, write_page
from loadflow.stages.statistics import SLOPE, STATISTICS, describe
from loadflow.studies.channels import channel, choose_channels

log = logging.getLogger("loadflow.run")

HEADS = (
    "case",
    "component",
    "unit",
    "mean",
    "std",
    "min",
    "max",
    "skewness",
    "kurtosis",
    f"DEL m = {SLOPE:g}",
)
UNITLESS = ("skewness", "kurtosis")


def statistic_records(
    cube: Cube, wanted: Sequence[str] = (), source: str = "load cube"
) -> list[dict[str, Any]]:
    """Statistics of every case and channel in SI units, one record each.

    Parameters
    ----------
    cube : Cube
        A cube.
    wanted : sequence of str
        See `loadflow.studies.channels.choose_channels`.
    source : str
        Name of the cube, for messages.
    """
    records = []
    for name, case in iter_cases(cube):
        series = case.load()
        log.info("%s: %d samples", name, series.sizes["time"])
        for component in choose_channels(series, wanted, f"{source}: {name}"):
            data = channel(series, component)
            found = describe(data.to_dataset(name="x"))["x"]
            numbers = dict(zip(STATISTICS, found.values.tolist()))
            head = {"case": name, "component": component, "units": data.attrs.get("units", "")}
            records.append(head | numbers)
    return records


def statistic_row(record: dict[str, Any]) -> list[str]:
    """The record under `HEADS`, in the units of engineers."""
    values = xr.DataArray([record[s] for s in STATISTICS], attrs={"units": record["units"]})
    shown, unit = readable(values)
    numbers = [
        "-" if np.isnan(value) else f"{record[name]:.3g}" if name in UNITLESS else f"{value:.5g}"
        for name, value in zip(STATISTICS, shown.tolist())
    ]
    return [record["case"], record["component"], unit, *numbers]


EXTREME_HEADS = ("extreme", "value", "unit", "case", "time, s", "γf")


def extreme_row(record: dict[str, Any], units: dict[str, str]) -> list[str]:
    """One extreme alone under `EXTREME_HEADS`; a page has what acts at the same moment."""
    factor, unit = _unit(units[record["of"]])
    what = f"{record['which']} {record['of']}"
    value = f"{record[record['of']] * factor:.5g}"
    time = f"{record['time']:.6g}"
    return [what, value, unit, record["case"], time, f"{record['safety_factor']:g}"]


def extreme_heads(extremes: xr.Dataset) -> list[str]:
    """Heads of the table of extremes; each load with its unit."""
    loads = [
        f"{name}, {_unit(units)[1]}"
        for name, units in zip(extremes["channel"].values, extremes["units"].values)
    ]
    return ["extreme", "case", "time, s", "γf", *loads]


def extreme_rows(extremes: xr.Dataset) -> list[list[str]]:
    """Table of extremes: the extreme load and, beside it, all loads at the same moment."""
    factors = np.array([_unit(units)[0] for units in extremes["units"].values])
    return [
        [
            f"{row['which'].item()} {row['of'].item()}",
            str(row["case"].item()),
            f"{row['time'].item():.6g}",
            f"{row['safety_factor'].item():g}",
            *map(four_digits, row["load"].values * factors),
        ]
        for row in (extremes.isel(extreme=k) for k in range(extremes.sizes["extreme"]))
    ]


def extreme_records(extremes: xr.Dataset) -> list[dict[str, Any]]:
    """The table of extremes in SI units, one record for each extreme."""
    keys = ("which", "of", "case", "time", "wind_speed", "safety_factor")
    return [
        {key: row[key].item() for key in keys}
        | dict(zip(extremes["channel"].values.tolist(), row["load"].values.tolist()))
        for row in (extremes.isel(extreme=k) for k in range(extremes.sizes["extreme"]))
    ]


def write_statistics(
    records: list[dict[str, Any]], extremes: xr.Dataset, folder: Path, source: str
) -> Path:
    """Write ``statistics.csv`` and ``extremes.csv`` in SI units, and a page."""
    import pandas as pd

    folder.mkdir(parents=True, exist_ok=True)
    pd.DataFrame(records).to_csv(folder / "statistics.csv", index=False)
    pd.DataFrame(extreme_records(extremes)).to_csv(folder / "extremes.csv", index=False)
    rows = [statistic_row(record) for record in records]
    sections = [
        Section("Extremes", TEXT, [Table("", extreme_heads(extremes), extreme_rows(extremes))]),
        Section("Statistics", tables=[Table("", list(HEADS), rows)]),
    ]
    cases = str(len({record["case"] for record in records}))
    return write_page(
        folder / "statistics.html", f"Statistics of {source}", {"Cases": cases}, sections
    )


TEXT = (
    "Largest and smallest value of every load over all cases, ranked with the partial safety "
    "factor of their design load case, and the loads at the same moment; no factor is in them."
)


def _unit(units: str) -> tuple[float, str]:
    values, unit = readable(xr.DataArray(1.0, attrs={"units": units}))
    return float(values), unit
