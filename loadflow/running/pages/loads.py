"""Loads of a run on its report page: doubts, statistics, ultimate loads, series."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.plots.style import readable
from loadflow.quantities import four_digits
from loadflow.reduction import lifetime_equivalent_load
from loadflow.report import Chart, Section, Table
from loadflow.report.charts import CLOSE, SAMPLES
from loadflow.report.run_charts import load_chart
from loadflow.running.folder import answered, read_part
from loadflow.stages.loads import doubts, trips, when_tripped
from loadflow.stages.statistics import SLOPE
from loadflow.studies.lifetime.extreme_loads import safety_factor
from loadflow.studies.lifetime.finished_run import known_shares

_LOAD_ROWS = (
    ("speed", "speed", ""),
    ("hub_force", "hub", "F"),
    ("hub_moment", "hub", "M"),
    ("force", "bearing", "F"),
)
"""Loads of the first table: variable, what it is of, and symbol before its axis."""


def loads_section(folder: Path, tables: dict[str, xr.Dataset], shown: list[str]) -> Section:
    """What is doubtful about the loads, their statistics, and series of the cases to be shown."""
    return Section(
        "Loads",
        tables=[*_trip_table(tables), *_doubt_table(tables), *_load_tables(tables)],
        pictures=[*_load_charts(folder, shown)],
    )


def _trip_table(tables: dict[str, xr.Dataset]) -> Iterator[Table]:
    """Cases that are no longer what their load case says; nothing if there are none."""
    if rows := [[name, when_tripped(time)] for name, time in trips(tables).items()]:
        yield Table("Tripped on overspeed, and stopped from then on", ["load case", "when"], rows)


def _doubt_table(tables: dict[str, xr.Dataset]) -> Iterator[Table]:
    """What does not fit turbine, frame, unit or step; nothing if all does."""
    rows = [[name, doubt] for name, said in doubts(tables).items() for doubt in said]
    if rows:
        marked = frozenset(range(len(rows)))
        yield Table("Doubtful series", ["load case", "what does not fit"], rows, marked)


def _load_tables(tables: dict[str, xr.Dataset]) -> Iterator[Table]:
    """Mean, spread and extremes of all loads; the largest with the safety factor of its case."""
    if "statistics" not in tables:
        return
    data = tables["statistics"]
    share = known_shares(tables, data)
    factors = np.array([safety_factor(str(dlc)) for dlc in data["dlc"].values])
    rows, ultimate = [], []
    for name, title, symbol in _LOAD_ROWS:
        if name not in data:
            continue
        for label, part in _parts(data[name], title, symbol):
            values, unit = readable(part.assign_attrs(data[name].attrs))
            if not np.nan_to_num(values).any():
                continue  # a moment bearing's own moment elsewhere, say
            table = dict(zip(part["statistic"].values, np.moveaxis(values, _axis(part), 0)))
            rows.append(
                [
                    f"{label}, {unit}",
                    *(four_digits(table[s].mean()) for s in ("mean", "std")),
                    *(("-", "-") if name == "speed" else _damage(table["del"], share)),
                    four_digits(table["min"].min()),
                    four_digits(table["max"].max()),
                ]
            )
            if name != "speed":
                largest = np.maximum(np.abs(table["min"]), np.abs(table["max"]))
                k = int(np.argmax(factors * largest))
                ultimate.append(
                    [
                        f"{label}, {unit}",
                        four_digits(largest[k]),
                        f"{factors[k]:g}",
                        four_digits(factors[k] * largest[k]),
                        str(data["case"].values[k]),
                    ]
                )
    heads = [
        "over all cases",
        "mean",
        "mean std",
        f"mean DEL (m = {SLOPE:g})",
        f"DEL of the lifetime (m = {SLOPE:g})",
        "smallest",
        "largest",
    ]
    yield Table("Loads", heads, rows)
    heads = ["largest magnitude", "characteristic", "γ_f", "design value", "load case"]
    yield Table("Ultimate loads", heads, ultimate)


def _damage(loads: np.ndarray, share: np.ndarray | None) -> tuple[str, str]:
    """Damage-equivalent load in the mean, and that of the lifetime; of loads alone."""
    lifetime = None if share is None else float(lifetime_equivalent_load(loads, share, SLOPE))
    return four_digits(loads.mean()), "-" if lifetime is None else four_digits(lifetime)


def _axis(part: xr.DataArray) -> int:
    return part.dims.index("statistic")


def _parts(data: xr.DataArray, title: str, symbol: str) -> Iterator[tuple[str, xr.DataArray]]:
    dims = [dim for dim in ("bearing", "axis") if dim in data.dims]
    if not dims:
        yield title, data
        return
    for labels, part in data.stack(part=dims).groupby("part"):
        names = labels if isinstance(labels, tuple) else (labels,)
        *bearing, axis = map(str, names)
        yield " ".join([title, *bearing, symbol + axis]), part.squeeze("part", drop=True)


def _load_charts(folder: Path, shown: list[str]) -> Iterator[Chart]:
    for k, name in enumerate(answered(folder, "shaft", shown)):
        (loads,) = read_part(folder, "loads", name, ("speed", "pitch", "hub_moment")).values()
        (bearings,) = read_part(folder, "shaft", name, ("force",)).values()
        said = name if k else f"{name}, worst case, every sample"
        yield load_chart(loads, bearings, said, k > 0, SAMPLES if k else CLOSE)
