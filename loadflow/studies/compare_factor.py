"""How far a candidate is from a limit: factors on its loads, sought where the limit is nearest."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.cube.hdf5 import read_variables
from loadflow.studies.compare_seeds import Draw

SAMPLES = 40
"""Samples of each case that are looked at again, the extremes among them."""

WIDEST = 16.0
"""Factor on load or viscosity beyond which nothing is asked."""

_HALVINGS = 9


@dataclass(frozen=True)
class Margin:
    """How far a candidate is from its first limit.

    Attributes
    ----------
    factor : float
        On all loads, with which the first limit is reached; below 1 if it is broken.
    place, case : str
        Where.
    governs, change : str
        Which limit that is; what else would reach it.
    drawn : callable, optional
        The factor that some of the cases would give, for the seeds.
    low, high : float
        Interval by the seeds, of all limits together.
    time : float
        Time of an extreme in its case, s; NaN for what is no extreme.
    models : tuple of str
        Result and quantity whose error by models the factor has.
    power : float
        Of the load that this quantity follows.
    """

    factor: float
    place: str = ""
    case: str = ""
    governs: str = ""
    change: str = ""
    drawn: Draw | None = field(default=None, compare=False, repr=False)
    low: float = math.nan
    high: float = math.nan
    time: float = math.nan
    models: tuple[str, str] = ("", "")
    power: float = math.nan


def largest_factor(holds: Callable[[float], bool]) -> float:
    """Largest factor with which something holds that holds for all smaller ones."""
    low, high = 1 / WIDEST, WIDEST
    for _ in range(_HALVINGS):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return math.sqrt(low * high)


def film_factors(value: Callable[[float, float], float], limit: float) -> tuple[float, float]:
    """Largest factor on the load, and smallest on the viscosity, with which a film is allowed."""
    load = largest_factor(lambda f: value(f, 1.0) >= limit)
    return load, 1.0 / largest_factor(lambda f: value(1.0, 1.0 / f) >= limit)


def pressure_factor(value: Callable[[float, float], float], limit: float) -> float:
    """Largest factor on the load with which a pressure is allowed."""
    return largest_factor(lambda f: value(f, 1.0) <= limit)


def reduced_samples(path: Path, place: str) -> xr.Dataset:
    """Loads, speed, time and weight of the samples that a bearing was solved for in a case."""
    return read_variables(path, ("force", "moment", "speed", "weight", "time"), place)


def loads_at(
    folder: Path, case: str, place: str, time: float
) -> tuple[np.ndarray, np.ndarray, float]:
    """Force and moment (3,) on a bearing, N and N m, and speed, rad/s, at a time of a case."""
    loads = read_variables(folder / "loads" / f"{case}.h5", ("speed",))
    shaft = read_variables(folder / "shaft" / f"{case}.h5", ("force", "moment")).sel(bearing=place)
    k = int(np.argmin(np.abs(loads["time"].values - time))) if math.isfinite(time) else 0
    force, moment = (
        shaft[name].isel(time=k).transpose("axis").values.astype(float)
        for name in ("force", "moment")
    )
    return force, moment, float(loads["speed"].values[k])
