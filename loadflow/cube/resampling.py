"""Bringing cases to another step or length, on request only."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.cube.build import make_cube
from loadflow.cube.checks import regular_time
from loadflow.cube.parts import Cube, iter_cases
from loadflow.errors import InputError

TURN = 2.0 * np.pi


def resample(cube: Cube, dt: float, duration: float | None = None) -> Cube:
    """Return all cases at one step, and of one length if asked.

    To a shorter step, values are interpolated linearly. To a longer one, each value becomes the
    mean of the old series over the new step around it (less at the ends), so that what the new
    step cannot carry does not come back as a slow oscillation; peaks are lowered by that, so
    that extreme values are better taken before. The azimuth is unwrapped for it.

    Parameters
    ----------
    cube : xarray.Dataset or xarray.DataTree
        A cube.
    dt : float
        New time step, s.
    duration : float, optional
        New length from the start, s. Without it each case keeps its own, cut to whole steps.

    Returns
    -------
    xarray.Dataset or xarray.DataTree

    Raises
    ------
    loadflow.errors.InputError
        Step not positive, fewer than two steps, or a case shorter than `duration`.

    Examples
    --------
    >>> from loadflow.cube import make_case, make_cube, resample
    >>> nothing = [[0.0] * 3] * 3
    >>> data = {"speed": [1.2, 1.3, 1.2], "hub_force": nothing, "hub_moment": nothing}
    >>> case = make_case([0.0, 0.1, 0.2], data, dlc="1.1", wind_speed=8.0, seed=1)
    >>> resample(make_cube([case]), dt=0.05).sizes["time"]
    5
    """
    if not dt > 0:
        raise InputError(f"resample: dt = {dt:g} s must be > 0")
    return make_cube([_resample_case(case, name, dt, duration) for name, case in iter_cases(cube)])


def _resample_case(case: xr.Dataset, name: str, dt: float, duration: float | None) -> xr.Dataset:
    old_dt, old = regular_time(case["time"].values, f"case {name!r}")
    length = old[-1] if duration is None else duration
    if length > old[-1] * (1 + 1e-9):
        raise InputError(f"case {name!r} lasts {old[-1]:g} s, shorter than duration = {length:g} s")
    steps = int(np.floor(length / dt * (1 + 1e-9)))
    if steps < 1:
        raise InputError(f"case {name!r}: dt = {dt:g} s is longer than the series, {length:g} s")
    new: NDArray[np.float64] = dt * np.arange(steps + 1, dtype=float)

    def along_time(values: NDArray[Any], key: Hashable) -> NDArray[Any]:
        series = np.unwrap(values.astype(float), axis=-1) if key == "azimuth" else values
        out = np.apply_along_axis(lambda y: _mean_or_line(new, dt, old, old_dt, y), -1, series)
        return (np.mod(out, TURN) if key == "azimuth" else out).astype(values.dtype)

    arrays = {}
    for key, array in case.data_vars.items():
        if "time" in array.dims:
            dims = [d for d in array.dims if d != "time"] + ["time"]
            values = array.transpose(*dims).values
            arrays[key] = (dims, along_time(values, key), array.attrs)
        else:
            arrays[key] = (list(array.dims), array.values, array.attrs)
    time = ("time", new, case["time"].attrs)
    return xr.Dataset(arrays, case.drop_vars("time").coords, case.attrs).assign_coords(time=time)


def _mean_or_line(
    new: NDArray[np.float64],
    dt: float,
    old: NDArray[np.float64],
    old_dt: float,
    values: NDArray[Any],
) -> NDArray[np.float64]:
    if dt <= old_dt:
        return np.interp(new, old, values)
    areas = 0.5 * old_dt * (values[1:] + values[:-1].astype(float))
    integral = np.r_[0.0, np.cumsum(areas)]
    half = np.minimum(dt / 2, np.minimum(new - old[0], old[-1] - new))  # centred up to the ends
    inside = half > 0.1 * old_dt
    means = np.interp(new, old, values)
    at, wide = new[inside], half[inside]
    means[inside] = np.interp(at + wide, old, integral) - np.interp(at - wide, old, integral)
    means[inside] /= 2 * wide
    return means
