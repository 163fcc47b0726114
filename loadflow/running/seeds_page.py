"""Seeds of a run on its report page: may they be merged, by which test, and how they spread."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.plots.style import readable
from loadflow.report import Picture, Section, Table, figures
from loadflow.running.folder import answered, open_part


def seed_section(folder: Path, seeds: xr.Dataset, manifest: dict[str, Any]) -> Section:
    """Tabulate the tests of the seeds, and draw their spread."""
    tables: list[Table] = [_merge_table(seeds)]
    pictures: list[Picture] = []
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
        tables.append(Table(f"Equality of seeds, {method}", heads, rows))
        pictures.append(Picture(figures.seed_verdicts(seeds, method), f"Tests, {method}."))
    pictures += _seed_boxes(folder, manifest)
    text = (
        "Series of one wind speed may be merged only if location, spread and spectrum agree. The "
        "printed tests take every sample as independent, which samples of a record are not: they "
        "reject nearly always. The calibrated ones hold their level."
    )
    return Section("Seeds", text, tables, pictures)


def _merge_table(seeds: xr.Dataset) -> Table:
    """Return one row for each wind speed: whether its seeds may be merged."""
    rows = [
        [
            str(seeds["dlc"].values[g]),
            f"{seeds['wind_speed'].values[g]:g}",
            str(seeds["seeds"].values[g]),
            *("yes" if merge else "no" for merge in seeds["may_merge"].isel(group=g).values),
            str(seeds["together"].values[g]),
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


def _seed_boxes(folder: Path, manifest: dict[str, Any]) -> list[Picture]:
    """Draw the spread of the seeds of every wind speed that has more than one."""
    groups: dict[str, list[str]] = {}
    for name in answered(folder, "shaft", manifest["cases"]):
        groups.setdefault(name.rsplit("_s", 1)[0], []).append(name)
    pictures: list[Picture] = []
    for group, names in groups.items():
        if len(names) < 2:
            continue
        samples: dict[str, dict[str, np.ndarray]] = {}
        units: dict[str, str] = {}
        for name in names:
            seed = name.rsplit("_s", 1)[1]
            force = open_part(folder, "shaft", name)["force"]
            for bearing in force["bearing"].values[:2]:
                for axis in ("y", "z"):
                    label = f"{bearing} F{axis}"
                    values, units[label] = readable(force.sel(bearing=bearing, axis=axis))
                    samples.setdefault(label, {})[seed] = values
        pictures.append(Picture(figures.seed_boxes(samples, units), f"{group}", bool(pictures)))
    return pictures
