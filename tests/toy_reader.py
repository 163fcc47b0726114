"""A reader of a toy format, in one file: what adding one takes besides its row in `READERS`."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.errors import InputError
from loadflow.readers.aliases import COMPONENTS, Aliases, Channels, Frame
from loadflow.readers.registry import Reader
from loadflow.readers.series import to_series
from loadflow.readers.table import Table

UNITS = {"speed": "rad/s", "pitch": "rad", "azimuth": "rad", "wind": "m/s"}
KNOWN = Aliases(fixed={name: (name,) for name in COMPONENTS})


def read_bars(
    path: str | os.PathLike[str],
    channels: Channels | None = None,
    gauge_distance: float | None = None,
    frame: Frame = "auto",
) -> xr.Dataset:
    """Read one file: names in the first line, numbers below, bars between; forces in kN, kN m.

    Raises
    ------
    loadflow.errors.InputError
        Empty, a number missing or none, and all that `to_series` finds.
    """
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    if len(lines) < 3:
        raise InputError(f"{path}: the file has no two time steps")
    names = tuple(lines[0].split("|"))
    try:
        values = np.array([[float(field) for field in line.split("|")] for line in lines[1:]])
    except ValueError as error:
        raise InputError(f"{path}: not a table of numbers: {error}") from None
    units = tuple(UNITS.get(name, "kNm" if "moment" in name else "kN") for name in names[1:])
    table = Table(str(path), values[:, 0], names, ("s", *units), values)
    return to_series(table, KNOWN, channels, gauge_distance, frame)


BARS = Reader(("*.bars",), "toy_reader:read_bars")
