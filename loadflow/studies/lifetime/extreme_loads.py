"""Load cube → table of extreme loads with what acts at the same moment, as IEC 61400-1 wants it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import Cube, iter_cases
from loadflow.errors import InputError
from loadflow.studies.channels import channel, channel_names

Floats = np.ndarray


def contemporaneous_extremes(
    cube: Cube, variables: Sequence[str] = (), source: str = "load cube"
) -> xr.Dataset:
    """Find the largest and smallest value of every load over all cases, and the others with it.

    Beside the components of a force or moment stands its resultant across the shaft, named ``yz``.
    Extremes are ranked with the partial safety factor for loads of their design load case; a case
    that IEC 61400-1 does not know counts with 1.

    Parameters
    ----------
    cube : Cube
        A cube.
    variables : sequence of str
        Forces and moments to take; default: all that the cube has.
    source : str
        Name of the cube, for messages.

    Returns
    -------
    xarray.Dataset
        `load` (extreme, channel) without safety factor; on ``extreme``: `which` ("max" or "min"),
        `of` (channel), `case`, `time` (s), `wind_speed` (m/s) and `safety_factor`; `units` on
        ``channel``.

    Raises
    ------
    loadflow.errors.InputError
        No loads in the cube, or an unknown variable.
    """
    best: dict[tuple[str, str], tuple[float, dict[str, Any], Floats]] = {}
    units: dict[str, str] = {}
    for name, case in iter_cases(cube):
        series = dict(_loads(case.load(), variables, f"{source}: {name}", units))
        values = np.stack(list(series.values()))
        factor = safety_factor(str(case["dlc"].item()))
        where = {"case": name, "safety_factor": factor, "wind_speed": float(case["wind_speed"])}
        for row, of in enumerate(series):
            for which, sign in (("max", 1.0), ("min", -1.0)):
                at = int(np.argmax(sign * values[row]))
                rank = sign * factor * values[row, at]
                if (which, of) not in best or rank > best[which, of][0]:
                    moment = where | {"time": float(case["time"][at])}
                    best[which, of] = rank, moment, values[:, at]
    if not best:
        raise InputError(f"{source}: the load cube is empty, it holds no case")
    ordered = [
        ((which, of), best[which, of])
        for of in units
        for which in (("max",) if of.endswith(".yz") else ("max", "min"))
    ]
    return _dataset(ordered, units)


def _loads(
    case: xr.Dataset, variables: Sequence[str], source: str, units: dict[str, str]
) -> Iterator[tuple[str, Floats]]:
    """Yield components and resultants of the wanted forces and moments; note their units."""
    known = channel_names(case)
    wanted = list(variables) or [n for n in LOADS if n in known]
    if not wanted or any(name not in known for name in wanted):
        raise InputError(f"{source}: loads {wanted or list(LOADS)}: the cube has {list(known)}")
    for variable in wanted:
        groups: dict[str, dict[str, Floats]] = {}
        for name in known[variable]:
            stem, _, axis = name.rpartition(".")
            groups.setdefault(stem, {})[axis] = channel(case, name).values.astype(float)
        for stem, parts in groups.items():
            if {"y", "z"} <= parts.keys():
                parts["yz"] = np.hypot(parts["y"], parts["z"])
            for axis, values in parts.items():
                units[f"{stem}.{axis}"] = case[variable].attrs.get("units", "")
                yield f"{stem}.{axis}", values


LOADS = ("hub_force", "hub_moment", "force", "moment")


def safety_factor(dlc: str) -> float:
    """Partial safety factor for the largest load of a series; 1 for a case not of the standard.

    That of 1.1 is the normal 1.35: the 1.25 of IEC 61400-1 is for loads that are extrapolated.
    Variants have that of their load case: ``DLC6.2a``, ``62`` and ``6.2 EWM`` that of 6.2.
    """
    from loadflow.readers.names import plain_dlc
    from loadflow.wind.cases import factor_of_maximum

    return factor_of_maximum(plain_dlc(dlc))


def _dataset(
    ordered: Sequence[tuple[tuple[str, str], tuple[float, Mapping[str, Any], Floats]]],
    units: dict[str, str],
) -> xr.Dataset:
    moments = [moment for _, (_, moment, _) in ordered]
    attrs: dict[str, dict[str, str]] = {
        "time": {"units": "s", "long_name": "time of the extreme"},
        "wind_speed": {"units": "m/s", "long_name": "mean wind speed"},
        "safety_factor": {"units": "1", "long_name": "partial safety factor for loads"},
    }
    coords: dict[str, Any] = {
        key: ("extreme", [moment[key] for moment in moments], attrs.get(key, {}))
        for key in ("case", "time", "wind_speed", "safety_factor")
    }
    return xr.Dataset(
        {
            "load": (
                ("extreme", "channel"),
                np.stack([values for _, (_, _, values) in ordered]),
                {"long_name": "loads at the same moment, without safety factor", "units": "mixed"},
            )
        },
        {
            "channel": list(units),
            "units": ("channel", list(units.values())),
            "which": ("extreme", [which for (which, _), _ in ordered]),
            "of": ("extreme", [of for (_, of), _ in ordered]),
            **coords,
        },
    )
