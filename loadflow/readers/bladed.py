"""Bladed output: for each group of channels a header (``.%23``) and values (``.$23``).

Hub loads in the stationary frame have x along the shaft, downwind, and z up, as the cube; their
origin, the hub centre, is the rotor apex.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.readers.table import Channels, Table, to_series

CHANNELS: dict[str, tuple[str, ...]] = {
    "speed": ("Rotor speed",),
    "pitch": ("Blade 1 pitch angle", "Pitch angle"),
    "azimuth": ("Rotor azimuth angle",),
    "wind": ("Hub wind speed magnitude", "Longitudinal wind speed at hub position"),
    "hub_force_x": ("Stationary hub Fx",),
    "hub_force_y": ("Stationary hub Fy",),
    "hub_force_z": ("Stationary hub Fz",),
    "hub_moment_x": ("Stationary hub Mx",),
    "hub_moment_y": ("Stationary hub My",),
    "hub_moment_z": ("Stationary hub Mz",),
}
UNITS = {"F": "N", "FL": "N m", "A": "rad", "A/T": "rad/s", "L/T": "m/s", "T": "s"}
"""Bladed writes SI units, as dimensions: F force, L length, A angle, T time."""
TYPES = {"R*4": "<f4", "R*8": "<f8", "I*4": "<i4"}


@dataclass(frozen=True)
class Group:
    """One group of channels over time.

    Attributes
    ----------
    source : str
        Header file.
    start, step : float
        First time stamp and time step, s.
    names, units : tuple of str
        Of each channel.
    values : ndarray, shape (n, channels)
        The series.
    """

    source: str
    start: float
    step: float
    names: tuple[str, ...]
    units: tuple[str, ...]
    values: NDArray[np.float64]


def read_bladed(
    path: str | os.PathLike[str],
    channels: Channels | None = None,
    gauge_distance: float | None = None,
) -> xr.Dataset:
    """Read one Bladed run.

    Parameters
    ----------
    path : path
        Any file of the run; all groups of series beside it are read.
    channels : mapping, optional
        Channels to use instead of those of `CHANNELS`, by component of the cube.
    gauge_distance : float, optional
        Not used here; all readers are called alike.

    Returns
    -------
    xarray.Dataset
        Variables over time from 0, in SI units, single precision; scalar coordinates ``file``
        and ``file_start``.

    Raises
    ------
    loadflow.errors.InputError
        No header, a group that is truncated or malformed, groups of different time, or a missing
        channel.
    """
    run = Path(path).with_suffix("")
    headers = sorted(p for p in run.parent.glob("*.%*") if p.with_suffix("") == run)
    groups = [group for header in headers if (group := _read_group(header)) is not None]
    if not groups:
        raise InputError(f"{run}: no header (.%01, …) of a group of series")
    first = groups[0]
    for group in groups[1:]:
        if (group.start, group.step, len(group.values)) != (
            first.start,
            first.step,
            len(first.values),
        ):
            raise InputError(f"{group.source}: times differ from those in {first.source}")
    table = Table(
        str(run),
        first.start + first.step * np.arange(len(first.values)),
        tuple(name for group in groups for name in group.names),
        tuple(unit for group in groups for unit in group.units),
        np.hstack([group.values for group in groups]),
    )
    return to_series(table, {**CHANNELS, **(channels or {})})


def _read_group(header: Path) -> Group | None:
    """Read a group; None where it has more dimensions than channel and time."""
    entries = _entries(header)
    try:
        if int(entries["NDIMENS"]) != 2 or "time" not in entries["AXISLAB"].lower():
            return None
        count, steps = (int(n) for n in entries["DIMENS"].split())
        names = tuple(re.findall(r"'([^']*)'", entries["VARIAB"]))
        units = tuple(UNITS.get(code, code) for code in entries["VARUNIT"].split())
        start, step = float(entries["MIN"]), float(entries["STEP"])
    except (KeyError, ValueError) as error:
        raise InputError(f"{header}: no Bladed header, or truncated: {error}") from None
    if not len(names) == len(units) == count:
        raise InputError(f"{header}: {count} channels, {len(names)} names, {len(units)} units")
    data = header.with_suffix(header.suffix.replace("%", "$"))
    values = _read_values(data, entries.get("ACCESS", "D"), entries.get("FORMAT", "R*4"))
    if values.size != count * steps:
        raise InputError(
            f"{data}: {values.size} values where its header says {count} × {steps}; truncated?"
        )
    return Group(str(header), start, step, names, units, values.reshape(steps, count))


def _entries(header: Path) -> dict[str, str]:
    """Return the entries of a header, one keyword in a line."""
    lines = header.read_text(errors="replace").splitlines()
    pairs = (line.split(None, 1) for line in lines)
    return {pair[0]: pair[1].strip() for pair in pairs if len(pair) == 2}


def _read_values(path: Path, access: str, form: str) -> NDArray[np.float64]:
    if not path.is_file():
        raise InputError(f"{path}: no such file; a Bladed group needs .% and .$")
    if access == "S":
        try:
            return np.array(path.read_text().split(), dtype=float)
        except ValueError as error:
            raise InputError(f"{path}: {error}") from None
    if form not in TYPES:
        raise InputError(f"{path}: format {form!r} is not known; known are {list(TYPES)}")
    return np.fromfile(path, dtype=TYPES[form]).astype(float)
