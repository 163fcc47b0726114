"""Bladed output: for each group of channels a header (``.%23``) and values (``.$23``).

Hub loads in the stationary frame have x along the shaft, downwind, and z up, as the cube; their
origin, the hub centre, is the rotor apex.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from glob import escape
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.readers.aliases import (
    COMPONENTS,
    GAUGE,
    POWER,
    Aliases,
    Channels,
    Frame,
    aliases,
    read_channels,
)
from loadflow.readers.series import to_series
from loadflow.readers.table import Table
from loadflow.readers.text import read_text
from loadflow.storage import check_content

UNITS = {"F": "N", "FL": "N m", "A": "rad", "A/T": "rad/s", "L/T": "m/s", "T": "s", "P": "W"}
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
    frame: Frame = "auto",
) -> xr.Dataset:
    r"""Read one Bladed run.

    Of the groups of the run only those are read that hold a wanted channel over time.

    Parameters
    ----------
    path : path
        Any file of the run; the groups of series beside it belong to it.
    channels : mapping, optional
        Channels to use instead of those of ``channels.toml``, by component of the cube. ``"#7"``
        counts the channels of the groups that are read.
    gauge_distance : float, optional
        Distance from the rotor apex to where ``gauge_moment_y`` and ``_z`` were taken, m.
    frame : {"auto", "fixed", "rotating"}
        Frame of the y and z channels; "auto" takes those of the stationary hub, else those of the
        rotating one.

    Returns
    -------
    xarray.Dataset
        Variables over time from 0, in SI units, single precision; scalar coordinates ``file``,
        ``file_start`` and ``doubts``.

    Raises
    ------
    loadflow.errors.InputError
        No header, a group that is truncated or malformed, groups of different time, or a missing
        channel.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> from loadflow.readers import read_bladed
    >>> kinds = [f"Stationary hub {kind}{axis}" for kind in ("F", "M") for axis in "xyz"]
    >>> names, units = ["Rotor speed", *kinds], "A/T F F F FL FL FL"
    >>> head = {"FILE": "run.$23", "ACCESS": "S", "FORMAT": "R*4", "NDIMENS": 2, "DIMENS": "7 3"}
    >>> head |= {"VARIAB": " ".join(f"'{name}'" for name in names), "VARUNIT": units}
    >>> head |= {"AXISLAB": "'Time'", "AXIUNIT": "T", "AXIMETH": 2, "MIN": 0.0, "STEP": 0.1}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "run.%23"
    ...     _ = file.write_text("\n".join(f"{key}\t{value}" for key,
    ...     value in head.items()) + "\n")
    ...     np.savetxt(Path(folder) / "run.$23", np.tile([0.9, 6e5, 0, -7e5, 4e6, 0, 0], (3, 1)))
    ...     series = read_bladed(file)
    >>> series["hub_force"].isel(time=0).values.tolist(), series["hub_force"].units
    ([600000.0, 0.0, -700000.0], 'N')
    """
    run = Path(path).with_suffix("")
    known = aliases("bladed")
    headers = sorted(p for p in run.parent.glob(f"{escape(run.name)}.%*") if p.stem == run.name)
    if not headers:
        raise InputError(f"{run}: no header (.%01, …) of a group of series")
    wanted = _wanted(known, channels or {})
    groups: list[Group] = []
    faults: list[str] = []  # of headers that cannot be read: they matter if a channel is missing
    seen: list[str] = []
    for header in headers:
        try:
            entries = _entries(header)
        except InputError as error:
            faults.append(str(error))
            continue
        names = _names(entries)
        seen += names
        if _over_time(entries) and (wanted is None or wanted & set(names)):
            groups.append(_read_group(header, entries))
    told = "".join(f"; {fault}" for fault in faults)
    if not groups:
        have = f"the groups have {', '.join(seen[:60])}"
        raise InputError(f"{run}: no group over time holds a wanted channel; {have}{told}")
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
    try:
        return to_series(table, known, channels, gauge_distance, frame)
    except InputError as error:
        raise InputError(f"{error}{told}") from None


def _wanted(known: Aliases, channels: Channels) -> set[str] | None:
    """Names of channels that may be used; None where a number may mean any."""
    own = read_channels(channels)
    keys = (*COMPONENTS, *GAUGE.values(), POWER)
    tables = (own, known.fixed, known.rotating)
    names = {name.removeprefix("-") for key in keys for t in tables for name in t.get(key, ())}
    return None if any(name.startswith("#") for name in names) else names


def _over_time(entries: dict[str, str]) -> bool:
    """Whether a group is of series: channels over time, and nothing else."""
    axis = entries["AXISLAB"].strip("' \"").casefold()
    unit = entries.get("AXIUNIT", "T").strip("' \"").upper()
    return entries["NDIMENS"] == "2" and axis.startswith("time") and unit == "T"


def _names(entries: dict[str, str]) -> tuple[str, ...]:
    """Return the names of the channels: in quotes, or separated by tabs or several blanks."""
    text = entries["VARIAB"]
    if "'" in text:
        return tuple(re.findall(r"'([^']*)'", text))
    splits = (re.split(r"\t+|\s{2,}", text), text.split())
    count = _count(entries)
    return next((tuple(parts) for parts in splits if len(parts) == count), (text,))


def _count(entries: dict[str, str]) -> int:
    first = entries.get("DIMENS", "").split()[:1]
    return int(first[0]) if first and first[0].isdigit() else 0


def _read_group(header: Path, entries: dict[str, str]) -> Group:
    """Read a group of series."""
    try:
        count, steps = (int(n) for n in entries["DIMENS"].split())
        names = _names(entries)
        units = tuple(UNITS.get(code, code) for code in entries["VARUNIT"].split())
        start, step = float(entries["MIN"]), float(entries["STEP"])
    except (KeyError, ValueError) as error:
        raise InputError(f"{header}: no Bladed header, or truncated: {error}") from None
    if not len(names) == len(units) == count:
        raise InputError(f"{header}: {count} channels, {len(names)} names, {len(units)} units")
    data = header.with_suffix(header.suffix.replace("%", "$"))
    access, form = entries.get("ACCESS", "D"), entries.get("FORMAT", "R*4")
    values = _read_values(data, access, form)
    if values.size != count * steps:
        raise InputError(
            f"{data}: {values.size} values where its header says {count} × {steps}; truncated?"
        )
    return Group(str(header), start, step, names, units, values.reshape(steps, count))


def _entries(header: Path) -> dict[str, str]:
    """Return the entries of a header, one keyword in a line; the first of several counts."""
    entries: dict[str, str] = {}
    for line in read_text(header).splitlines():
        pair = line.split(None, 1)
        if len(pair) == 2:
            entries.setdefault(pair[0], pair[1].strip())
    absent = [key for key in ("NDIMENS", "VARIAB", "AXISLAB") if key not in entries]
    if absent:
        raise InputError(f"{header}: no Bladed header, or truncated: no {', '.join(absent)}")
    return entries


def _read_values(path: Path, access: str, form: str) -> NDArray[np.float64]:
    if not path.is_file():
        raise InputError(f"{path}: no such file; a Bladed group needs .% and .$")
    if access == "S":
        try:
            return np.array(read_text(path).split(), dtype=float)
        except ValueError as error:
            raise InputError(f"{path}: {error}") from None
    if form not in TYPES:
        raise InputError(f"{path}: format {form!r} is not known; known are {list(TYPES)}")
    check_content(path)
    return np.fromfile(path, dtype=TYPES[form]).astype(float)
