"""Load series of one case → mean, spread, extremes and damage-equivalent loads, on every step."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.reduction import damage_equivalent_load
from loadflow.scene import Scene
from loadflow.stages.cases import Case
from loadflow.stages.summary import over_cases

SLOPE = 4.0
"""Wöhler exponent of the damage-equivalent loads: steel parts, as in spec tables of shafts."""

STATISTICS = ("mean", "std", "min", "max", "del")


def statistics(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.Dataset:
    """Return `STATISTICS` of every load variable of the case, dimension ``statistic``."""
    series = xr.merge([inputs["loads"].load(), inputs["shaft"].load()], compat="override")
    wanted = [name for name in series.data_vars if "time" in series[name].dims]
    wanted = [name for name in wanted if name != "azimuth"]
    time = series["time"].values
    duration = float(time[-1] - time[0])
    found = {name: _describe(series[name], duration) for name in wanted}
    return xr.Dataset(found).assign_coords(statistic=list(STATISTICS))


def _describe(data: xr.DataArray, duration: float) -> xr.DataArray:
    values = np.moveaxis(data.values.astype(float), data.dims.index("time"), -1)
    flat = values.reshape(-1, values.shape[-1])
    rows = np.stack(
        [
            flat.mean(axis=-1),
            flat.std(axis=-1),
            flat.min(axis=-1),
            flat.max(axis=-1),
            [damage_equivalent_load(row, SLOPE, duration) for row in flat],
        ],
        axis=-1,
    )
    dims = [dim for dim in data.dims if dim != "time"]
    coords = {dim: data[dim] for dim in dims if dim in data.coords}
    shape = (*values.shape[:-1], len(STATISTICS))
    return xr.DataArray(rows.reshape(shape), coords, [*dims, "statistic"], attrs=data.attrs)


def summary(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset:
    """Join the statistics of all cases; dimension ``case``."""
    return over_cases({case: part.load() for case, part in parts.items()})
