"""Channels of a file with their names and units, and the way from there to the cube."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from loadflow.cube import VARIABLES, make_series, regular_time
from loadflow.errors import InputError

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

DEGREE = math.pi / 180.0
UNITS: dict[str, dict[str, float]] = {
    "rad/s": {"rad/s": 1.0, "rpm": math.pi / 30, "1/min": math.pi / 30, "deg/s": DEGREE},
    "rad": {"rad": 1.0, "deg": DEGREE, "°": DEGREE},
    "m/s": {"m/s": 1.0},
    "N": {"n": 1.0, "kn": 1e3, "mn": 1e6},
    "N m": {"nm": 1.0, "knm": 1e3, "mnm": 1e6},
    "s": {"s": 1.0, "sec": 1.0},
}
"""SI unit → what files may say instead → factor."""

COMPONENTS = tuple(
    f"{name}_{axis}" if "axis" in variable.dims else name
    for name, variable in VARIABLES.items()
    if "bearing" not in variable.dims
    for axis in ("xyz" if "axis" in variable.dims else "x")
)
"""What a reader may deliver: ``speed``, …, ``hub_force_x``, …, ``hub_moment_z``."""

OPTIONAL = ("pitch", "azimuth", "wind")

Channels = Mapping[str, str | Sequence[str]]
"""Component of the cube → channel of the file, or several of which the first one found is used;
a leading minus turns the sign."""


@dataclass(frozen=True)
class Table:
    """Content of one file, as it stands there.

    Attributes
    ----------
    source : str
        Name of the file, for messages.
    stamps : ndarray, shape (n,)
        Time stamps, s.
    names, units : tuple of str
        Of each column, in the order of the file.
    values : ndarray, shape (n, columns)
        The series.
    """

    source: str
    stamps: NDArray[Any]
    names: tuple[str, ...]
    units: tuple[str, ...]
    values: NDArray[Any]

    def find(self, channel: str) -> int | None:
        """Return the column of a channel, or None.

        Parameters
        ----------
        channel : str
            Name, or ``"#7"`` for the seventh column of the file; a leading minus is ignored.

        Raises
        ------
        loadflow.errors.InputError
            Several columns bear the name.
        """
        name = channel.removeprefix("-")
        if name.startswith("#") and name[1:].isdigit():
            column = int(name[1:]) - 1
            return column if 0 <= column < len(self.names) else None
        columns = [i for i, have in enumerate(self.names) if have == name]
        if len(columns) > 1:
            numbers = ", ".join(f"#{i + 1}" for i in columns)
            raise InputError(
                f"{self.source}: {len(columns)} channels {name!r}; name one: {numbers}"
            )
        return columns[0] if columns else None

    def series(self, channel: str, si: str) -> NDArray[np.float64]:
        """Return one channel in SI units.

        Parameters
        ----------
        channel : str
            As in `find`; with a leading minus the sign is turned.
        si : str
            Unit to return, a key of `UNITS`.

        Raises
        ------
        loadflow.errors.InputError
            No such channel, its unit cannot be turned into `si`, or a value is not finite.
        """
        column = self.find(channel)
        if column is None:
            raise InputError(f"{self.source}: channel {channel!r} is missing; {self.listing()}")
        values = np.asarray(self.values[:, column], dtype=float)
        bad = ~np.isfinite(values)
        if bad.any():
            i = int(np.argmax(bad))
            raise InputError(
                f"{self.source}, channel {self.names[column]!r}, index {i} "
                f"(time {self.stamps[i]:g} s): value {values[i]} is not finite"
            )
        sign = -1.0 if channel.startswith("-") else 1.0
        return sign * self._factor(column, si) * values

    def listing(self) -> str:
        """Return what channels there are, for messages."""
        more = f" and {len(self.names) - 60} more" if len(self.names) > 60 else ""
        return f"the file has {', '.join(self.names[:60])}{more}"

    def _factor(self, column: int, si: str) -> float:
        unit = self.units[column]
        factor = UNITS[si].get(_plain_unit(unit))
        if factor is None:
            raise InputError(
                f"{self.source}, channel {self.names[column]!r}: unit {unit!r} cannot be read as "
                f"{si!r}; expected one of {', '.join(UNITS[si])}"
            )
        return factor


def to_series(table: Table, channels: Channels) -> xr.Dataset:
    """Turn the channels of a file into the variables of the cube.

    Parameters
    ----------
    table : Table
        The file.
    channels : Channels
        Which channels to take; `OPTIONAL` ones may be absent.

    Returns
    -------
    xarray.Dataset
        Variables over time from 0 in single precision, with scalar coordinates ``file`` and
        ``file_start``.

    Raises
    ------
    loadflow.errors.InputError
        Missing channel, wrong unit, value that is not finite, irregular time.
    """
    if unknown := set(channels) - set(COMPONENTS):
        raise InputError(
            f"channels: {sorted(unknown)[0]!r} is nothing the cube holds; it takes "
            f"{', '.join(COMPONENTS)}"
        )
    step, stamps = regular_time(table.stamps, table.source)
    data = {}
    for name, variable in VARIABLES.items():
        keys = [c for c in COMPONENTS if c == name or c[:-2] == name]
        found = [_find(table, key, channels) for key in keys]
        series = [table.series(channel, variable.units) for channel in found if channel]
        if series:
            stacked = np.stack(series) if "axis" in variable.dims else series[0]
            data[name] = stacked.astype(np.float32)
    start = float(stamps[0])
    coords = {"file": table.source, "file_start": ((), start, {"units": "s"})}
    return make_series(step * np.arange(stamps.size), data).assign_coords(coords)


def _find(table: Table, key: str, channels: Channels) -> str | None:
    """Return the first channel for a component that the file has."""
    wanted = channels.get(key, ())
    names = [wanted] if isinstance(wanted, str) else list(wanted)
    for name in names:
        if table.find(name) is not None:
            return name
    if key in OPTIONAL:
        return None
    if not names:
        raise InputError(f"{table.source}: no channel is named for {key!r}; {table.listing()}")
    asked = " or ".join(map(repr, names))
    raise InputError(f"{table.source}: channel {asked} for {key!r} is missing; {table.listing()}")


def _plain_unit(unit: str) -> str:
    plain = unit.strip().strip("()[]").casefold()
    for sign in "·*-. ":
        plain = plain.replace(sign, "")
    return plain
