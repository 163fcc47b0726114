"""Load series of any origin, as CSV with names and units in the first row."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pandas as pd
import xarray as xr

from loadflow.errors import InputError
from loadflow.readers.table import COMPONENTS, Channels, Table, to_series

CHANNELS = {name: name for name in COMPONENTS}
HEADING = re.compile(r"^\s*(?P<name>[^\[\(]+?)\s*(?:[\[\(](?P<unit>[^\]\)]*)[\]\)])?\s*$")


def read_csv(
    path: str | os.PathLike[str],
    channels: Channels | None = None,
    gauge_distance: float | None = None,
) -> xr.Dataset:
    """Read one CSV file.

    The first row names the columns with their units: ``time [s], speed [rpm], hub_force_x [kN],
    …``. Columns may be separated by comma, semicolon or tab; lines beginning with ``#`` are
    comments.

    Parameters
    ----------
    path : path
        File.
    channels : mapping, optional
        Component of the cube → name of the column, where it is named otherwise. A leading minus
        turns the sign.
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
        No such file, empty, column or unit missing, a field that is no number, irregular time.
    """
    table = read_table(Path(path))
    return to_series(table, {**CHANNELS, **(channels or {})})


def read_table(path: Path) -> Table:
    """Read all columns of a CSV file as they are."""
    if not path.is_file():
        raise InputError(f"{path}: no such file")
    try:
        frame = pd.read_csv(path, sep=_separator(path), comment="#", encoding="utf-8-sig")
    except pd.errors.EmptyDataError:
        raise InputError(f"{path}: the file is empty") from None
    except (pd.errors.ParserError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read as CSV: {error}") from None
    if frame.empty:
        raise InputError(f"{path}: the file has a heading but no time step")
    headings = [_heading(str(column), path) for column in frame.columns]
    names = tuple(name for name, _ in headings)
    units = tuple(unit for _, unit in headings)
    if "time" not in names:
        raise InputError(f"{path}: column 'time' is missing; the file has {', '.join(names)}")
    values = pd.DataFrame(
        {i: _numbers(frame.iloc[:, i], names[i], path) for i in range(len(names))}
    )
    stamps = Table(str(path), values.index.to_numpy(), names, units, values.to_numpy())
    return Table(str(path), stamps.series("time", "s"), names, units, stamps.values)


def _separator(path: Path) -> str:
    """Return the separator that the heading has most of."""
    try:
        with path.open(encoding="utf-8-sig") as file:
            heading = next((line for line in file if line.strip() and line[0] != "#"), "")
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: is no text ({error})") from None
    return max(",;\t", key=heading.count)


def _heading(column: str, path: Path) -> tuple[str, str]:
    match = HEADING.match(column)
    if match is None or match["unit"] is None:
        raise InputError(f"{path}: column {column!r} has no unit; write it like 'speed [rad/s]'")
    return match["name"], match["unit"]


def _numbers(column: pd.Series, name: str, path: Path) -> pd.Series:
    numbers = pd.to_numeric(column, errors="coerce")
    wrong = numbers.isna() & column.notna()
    if wrong.any():
        i = int(wrong.to_numpy().argmax())
        raise InputError(f"{path}, column {name!r}, index {i}: {column.iloc[i]!r} is not a number")
    return numbers.astype(float)
