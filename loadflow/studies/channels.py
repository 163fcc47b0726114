"""The single series of a load cube, by name: ``speed``, ``hub_moment.y``, ``force.N.z``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import xarray as xr

from loadflow.errors import InputError
from loadflow.numerics.fields import none_such


def channel_names(case: xr.Dataset) -> dict[str, list[str]]:
    """Names of all channels of each variable over ``time``."""
    return {
        str(name): [*_labelled(data.isel(time=0, drop=True), str(name))]
        for name, data in case.data_vars.items()
        if "time" in data.dims
    }


def choose_channels(
    case: xr.Dataset, wanted: Sequence[str] = (), source: str = "load cube"
) -> list[str]:
    """Names of the wanted channels.

    Parameters
    ----------
    case : xarray.Dataset
        Case of a cube.
    wanted : sequence of str
        Channels, or variables for all their channels; default: rotor speed and all loads that are
        not zero, those of the bearings where the cube has them, else those of the hub.
    source : str
        Name of the cube, for messages.

    Raises
    ------
    loadflow.errors.InputError
        The cube has no such channel.
    """
    known = channel_names(case)
    every = [channel for parts in known.values() for channel in parts]
    if not wanted:
        loads = ("force", "moment") if "force" in known else ("hub_force", "hub_moment")
        chosen = [c for name in ("speed", *loads) for c in known.get(name, [])]
        return [c for c in chosen if c == "speed" or np.any(channel(case, c))]
    unknown = [name for name in wanted if name not in known and name not in every]
    if unknown:
        raise InputError(f"{source}: {none_such('variable', unknown, every)}")
    chosen = [c for name in wanted for c in known.get(name, [name])]
    return list(dict.fromkeys(chosen))


def channel(case: xr.Dataset, name: str) -> xr.DataArray:
    """Series of a channel."""
    variable, *labels = name.split(".")
    data = case[variable]
    dims = [dim for dim in data.dims if dim != "time"]
    return data.sel(dict(zip(dims, labels)), drop=True)


def _labelled(data: xr.DataArray, name: str) -> Iterator[str]:
    """Name every component of a variable: its labels along all dimensions, joined by dots."""
    if not data.dims:
        yield name
        return
    first = data.dims[0]
    for label in data[first].values:
        yield from _labelled(data.sel({first: label}, drop=True), f"{name}.{label}")
