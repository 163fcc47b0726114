"""Seeds of a run on its report page: may they be merged, by which test, and how they spread."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.report import Chart, Picture, Section, Table, figures
from loadflow.report.run_charts import seed_verdicts
from loadflow.running.folder import ForceOf, answered

QUANTILES = (1, 25, 50, 75, 99)
"""Shares of the samples, %, at which the spread of a seed is drawn."""


def seed_section(
    folder: Path, seeds: xr.Dataset, manifest: dict[str, Any], force_of: ForceOf
) -> Section:
    """Tabulate the tests of the seeds, and draw their spread."""
    tables: list[Table] = [_merge_table(seeds)]
    pictures: list[Picture | Chart] = []
    for method in seeds["variant"].values:
        part = seeds.sel(variant=method)
        rows = [
            [
                str(group["dlc"].item()),
                f"{group['wind_speed'].item():g}",
                f"{group['seeds'].item()}",
                str(group["component"].item()),
                *(_p(group["pvalue"].sel(test=test).item()) for test in group["test"].values),
                str(group["verdict"].item()),
            ]
            for _, group in _cells(part)
        ]
        heads = ["DLC", "wind, m/s", "seeds", "component"]
        heads += [f"p {test}" for test in part["test"].values] + ["verdict"]
        tables.append(Table(f"Equality of seeds, {method}", heads, rows, fold=True))
        below = "a point below the dashed line is not equal; p below 1e-12 is drawn there"
        caption = f"Tests, {method}: {below}."
        pictures.append(seed_verdicts(seeds, str(method), caption))
    pictures += _spread(folder, manifest, force_of)
    text = (
        f"{answer(seeds)} "
        "Series of one wind speed may be merged only if location, spread and spectrum agree. The "
        "printed tests take every sample as independent, which samples of a record are not: they "
        "reject nearly always. The calibrated ones hold their level."
    )
    return Section("Seeds", text, tables, pictures)


_VALID = "calibrated"
"""Tests that hold their level; with them, which seeds belong together is asked."""


def answer(seeds: xr.Dataset) -> str:
    """At how many wind speeds seeds may be merged, by the valid tests, and why where they differ.

    Parameters
    ----------
    seeds : xarray.Dataset
        Tests of a run.
    """
    count = seeds.sizes["group"]
    merged = {
        str(method): f"{int((seeds['may_merge'].sel(variant=method) > 0).sum())} of {count}"
        for method in seeds["variant"].values
    }
    valid = merged.pop(_VALID, None)
    others = "; ".join(f"{method}: {said}" for method, said in merged.items())
    if valid is None:
        return f"Seeds may be merged by tests {others}, which are not valid."
    beside = f" ({others}, not valid)" if others else ""
    text = f"By the calibrated tests, seeds may be merged at {valid} wind speeds{beside}."
    alone = [
        f"{seeds['wind_speed'].values[g]:g}" for g in range(count) if _apart_by_chance(seeds, g)
    ]
    if alone:
        tests = count * seeds.sizes["component"]
        text += (
            f" Those of {', '.join(alone)} m/s differ only if that wind speed is tested alone: "
            f"among the {tests} tests of this run such a difference may be chance (Holm's "
            "correction), so that they may be merged."
        )
    return text


def _apart_by_chance(seeds: xr.Dataset, group: int) -> bool:
    """Whether seeds fall into several groups at one wind speed alone, but may be merged."""
    several = str(seeds["together"].values[group]).count("{") > 1
    return several and bool(seeds["may_merge"].sel(variant=_VALID).values[group] > 0)


def _belong(seeds: xr.Dataset, group: int) -> str:
    together = str(seeds["together"].values[group])
    if _VALID in seeds["variant"].values and _apart_by_chance(seeds, group):
        return f"all; this wind speed alone: {together}"
    return together


def _merge_table(seeds: xr.Dataset) -> Table:
    """Return one row for each wind speed: whether its seeds may be merged."""
    rows = [
        [
            str(seeds["dlc"].values[g]),
            f"{seeds['wind_speed'].values[g]:g}",
            str(seeds["seeds"].values[g]),
            *("yes" if merge else "no" for merge in seeds["may_merge"].isel(group=g).values),
            _belong(seeds, g),
        ]
        for g in range(seeds.sizes["group"])
    ]
    variants = [str(variant) for variant in seeds["variant"].values]
    heads = ["DLC", "wind, m/s", "seeds", *variants, "which belong together (calibrated)"]
    return Table("May the seeds be merged?", heads, rows)


def _cells(part: xr.Dataset) -> Iterator[tuple[Any, xr.Dataset]]:
    for g in range(part.sizes["group"]):
        for c in range(part.sizes["component"]):
            yield (g, c), part.isel(group=g, component=c)


def _p(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.2g}"


def _spread(folder: Path, manifest: dict[str, Any], force_of: ForceOf) -> Iterator[Picture]:
    """Draw the spread of the seeds of every wind speed that has more than one."""
    groups: dict[str, list[str]] = {}
    for name in answered(folder, "shaft", manifest["cases"]):
        groups.setdefault(name.rsplit("_s", 1)[0], []).append(name)
    several = {group: names for group, names in groups.items() if len(names) > 1}
    found: dict[str, list[np.ndarray]] = {}
    for name in itertools.chain(*several.values()):
        for bearing, force in itertools.islice(force_of(name).items(), 2):
            for axis, series in zip("yz", force[1:]):
                percentile = np.nanpercentile if np.isnan(series).any() else np.percentile
                found.setdefault(f"{bearing} F{axis}", []).append(percentile(series, QUANTILES))
    of = [group for group, names in several.items() for _ in names]
    quantiles = {
        component: xr.DataArray(
            rows, {"group": ("case", of)}, ("case", "quantile"), attrs={"units": "N"}
        )
        for component, rows in found.items()
    }
    if quantiles:
        yield Picture(figures.seed_spread(quantiles), "Forces of every seed, wind speed by speed.")
