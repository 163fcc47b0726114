"""Load series of any origin, as CSV with names and units in the first row."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import replace
from io import StringIO
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.readers.aliases import TIME, Channels, Frame, aliases, read_channels
from loadflow.readers.series import to_series
from loadflow.readers.table import Table
from loadflow.readers.text import decoded, read_text

HEADING = re.compile(r"^\s*(?P<name>[^\[\(]+?)\s*(?:[\[\(](?P<unit>[^\]\)]*)[\]\)])?\s*$")


def read_csv(
    path: str | os.PathLike[str],
    channels: Channels | None = None,
    gauge_distance: float | None = None,
    frame: Frame = "auto",
) -> xr.Dataset:
    r"""Read one CSV file.

    The first row names the columns with their units: ``time [s], speed [rpm], hub_force_x [kN],
    …``. Columns may be separated by comma, semicolon or tab, where a decimal comma is read, too;
    lines beginning with ``#`` are comments.

    Parameters
    ----------
    path : path
        File.
    channels : mapping, optional
        Component of the cube, or ``time`` → name of the column, where it is named otherwise. A
        leading minus turns the sign.
    gauge_distance : float, optional
        Distance from the rotor apex to where ``gauge_moment_y`` and ``_z`` were taken, m.
    frame : {"auto", "fixed", "rotating"}
        "rotating" where the y and z columns turn with blade 1; they are turned back with the
        azimuth. "auto" takes them as they are.

    Returns
    -------
    xarray.Dataset
        Variables over time from 0, in SI units, single precision; scalar coordinates ``file``,
        ``file_start`` and ``doubts``.

    Raises
    ------
    loadflow.errors.InputError
        No such file, empty, column or unit missing, a field that is no number, irregular time.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.readers import read_csv
    >>> head = "time [s]; speed [rpm]; hub_force_x [kN]; hub_force_y [kN]; hub_force_z [kN]; "
    >>> head += "hub_moment_x [kN m]; hub_moment_y [kN m]; hub_moment_z [kN m]"
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "run.csv"
    ...     _ = file.write_text(f"{head}\n0;12;600;0;-700;4000;0;0\n0.1;12;600;0;-690;4000;0;0\n")
    ...     series = read_csv(file)
    >>> series["hub_force"].sel(axis="z").values.tolist(), series["hub_force"].units
    ([-700000.0, -690000.0], 'N')
    """
    table = read_table(Path(path), channels)
    return to_series(table, aliases("csv"), channels, gauge_distance, frame)


def is_series(path: Path) -> bool:
    """Whether the heading of a CSV file has a column of the time, as a load series has."""
    with path.open("rb") as file:
        start = decoded(b"".join(file.readlines(2**16)))  # whole lines, as half a character is none
    heading = next(_rows(start), "").casefold()
    return re.search(r"(?:^|[,;\t])[ \"]*time\b", heading) is not None


def read_table(path: Path, channels: Channels | None = None) -> Table:
    """Read all columns of a CSV file as they are; `channels` may name the one of the time."""
    if not path.is_file():
        raise InputError(f"{path}: no such file")
    text = read_text(path)
    columns, separator, decimal = _columns(text, path)
    try:
        frame = pd.read_csv(
            StringIO(text),
            sep=separator,
            decimal=decimal,
            comment="#",
            header=0,
            names=range(len(columns)),
            index_col=False,
        )
    except (pd.errors.ParserError, ValueError) as error:
        raise InputError(f"{path}: cannot be read as CSV: {error}") from None
    if frame.empty:
        raise InputError(f"{path}: the file has a heading but no time step")
    headings = [_heading(column, path) for column in columns]
    names = tuple(name for name, _ in headings)
    units = tuple(unit for _, unit in headings)
    series = [_numbers(frame[i], name, path) for i, name in enumerate(names)]
    table = Table(str(path), np.arange(len(frame)), names, units, np.column_stack(series))
    wanted = read_channels(channels or {}).get(TIME, aliases("csv").fixed[TIME])
    stamps = next((name for name in wanted if table.find(name) is not None), None)
    if stamps is None:
        raise InputError(
            f"{path}: column {' or '.join(map(repr, wanted))} is missing; {table.listing()}. "
            'channels say which one has the time where it is named otherwise: time = "NAME"'
        )
    return replace(table, stamps=table.series(stamps, "s"))


def _columns(text: str, path: Path) -> tuple[list[str], str, str]:
    """Return the fields of the heading, the separator, which it has most of, and the decimal sign.

    A comma among the numbers is a decimal one unless it separates.
    """
    rows = _rows(text)
    heading = next(rows, "")
    if not heading:
        raise InputError(f"{path}: the file is empty")
    separator = max(",;\t", key=heading.count)
    decimal = "," if separator != "," and any("," in row for row in rows) else "."
    return heading.strip().split(separator), separator, decimal


def _rows(text: str) -> Iterator[str]:
    """Heading and rows of numbers, without blank lines and comments."""
    return (line for line in text.splitlines() if line.strip() and line[0] != "#")


def _heading(column: str, path: Path) -> tuple[str, str]:
    match = HEADING.match(column)
    if match is None or match["unit"] is None:
        raise InputError(f"{path}: column {column!r} has no unit; write it like 'speed [rad/s]'")
    return match["name"], match["unit"]


def _numbers(column: pd.Series, name: str, path: Path) -> NDArray[np.float64]:
    numbers = pd.to_numeric(column, errors="coerce")
    wrong = numbers.isna() & column.notna()
    if wrong.any():
        i = int(wrong.to_numpy().argmax())
        raise InputError(f"{path}, column {name!r}, index {i}: {column.iloc[i]!r} is not a number")
    return numbers.to_numpy(dtype=float)
