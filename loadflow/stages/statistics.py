"""Load series of one case → mean, spread, shape, extremes and damage-equivalent loads."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.reduction import damage_equivalent_load
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.stages.stage import Rungs, Stage, always, load_links
from loadflow.stages.summary import over_cases

SLOPE = 4.0
"""Wöhler exponent of the damage-equivalent loads: that of welded and forged steel parts."""

_LOADS = ("N", "N m")
"""Units of what damages; a speed or an angle has no damage-equivalent load."""

STATISTICS = ("mean", "std", "min", "max", "skewness", "kurtosis", "del")


def statistics(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.Dataset:
    """Return `STATISTICS` of every load variable of the case, dimension ``statistic``."""
    series = xr.merge([inputs["loads"].load(), inputs["shaft"].load()], compat="override")
    return describe(series)


def describe(series: xr.Dataset) -> xr.Dataset:
    """Return `STATISTICS` of every variable over ``time``, dimension ``statistic``.

    Skewness and kurtosis are those of the distribution of the values (0 and 3 if it is normal; both
    0 for a constant). The damage-equivalent load is a range at 1 Hz with the exponent `SLOPE`, and
    NaN of what is no force or moment. Left out are the azimuth, an angle that only runs round, the
    supervisory state and flags.
    """
    over_time = (name for name in series.data_vars if "time" in series[name].dims)
    wanted = [name for name in over_time if name not in ("azimuth", "state", "converged")]
    time = series["time"].values
    duration = float(time[-1] - time[0])
    found = {name: _describe(series[name], duration) for name in wanted}
    return xr.Dataset(found).assign_coords(statistic=list(STATISTICS))


def _describe(data: xr.DataArray, duration: float) -> xr.DataArray:
    values = np.moveaxis(data.values.astype(float), data.dims.index("time"), -1)
    damages = data.attrs.get("units") in _LOADS
    rows = [_row(x, duration, damages) for x in values.reshape(-1, values.shape[-1])]
    dims = [dim for dim in data.dims if dim != "time"]
    coords = {dim: data[dim] for dim in dims if dim in data.coords}
    shape = (*values.shape[:-1], len(STATISTICS))
    return xr.DataArray(np.reshape(rows, shape), coords, [*dims, "statistic"], attrs=data.attrs)


def _row(x: np.ndarray, duration: float, damages: bool) -> list[float]:
    if np.isnan(x).all():  # nothing that this bearing has: the tilt in one on a rigid shaft
        return [np.nan] * len(STATISTICS)
    mean, deviation = float(x.mean()), float(x.std())
    varies = deviation > 1e-12 * max(abs(mean), np.finfo(float).tiny)
    z = (x - mean) / deviation if varies else np.zeros(1)
    square = z * z
    shape = float(np.mean(square * z)), float(np.mean(square * square))
    fatigue = float(damage_equivalent_load(x, SLOPE, duration)) if damages else np.nan
    return [mean, deviation, float(x.min()), float(x.max()), *shape, fatigue]


def summary(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset:
    """Join the statistics of all cases; dimension ``case``."""
    return over_cases({case: part.load() for case, part in parts.items()})


STAGE = Stage(
    "statistics",
    run=statistics,
    results={
        "loads.statistics": lambda scene: {
            quantity: load_links(quantity, of_load=False)
            for quantity in ("bearing load max", "bearing force DEL")
        }
    },
    needs=always("loads", "shaft"),
    models=(Rungs("statistics", section="loads", key=lambda scene: "-", exact=lambda scene: True),),
    summarise=summary,
)
