"""OpenFAST output, text (``.out``) and binary (``.outb``).

Sizes are compared with the header before anything is read: a damaged file must neither stop with an
error of the interpreter nor ask for memory that its size does not justify.
"""

from __future__ import annotations

import os
import struct
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.readers.aliases import Channels, Frame, aliases
from loadflow.readers.series import to_series
from loadflow.readers.table import Table
from loadflow.readers.text import UTF_16, number_rows, read_text

SEARCHED_LINES = 40
"""Lines within which the names of the channels must stand; OpenFAST has them in line 7."""
WITH_TIME, WITHOUT_TIME, DOUBLE, LONG_NAMES = 1, 2, 3, 4
"""Kinds of binary files: packed with time stamps, packed, double precision, packed with names of
any length."""


def read_openfast(
    path: str | os.PathLike[str],
    channels: Channels | None = None,
    gauge_distance: float | None = None,
    frame: Frame = "auto",
) -> xr.Dataset:
    r"""Read one OpenFAST output file.

    Parameters
    ----------
    path : path
        File, ``.outb`` or ``.out``.
    channels : mapping, optional
        Channels to use instead of those of ``channels.toml``, by component of the cube.
    gauge_distance : float, optional
        Distance of the shaft strain gauge downwind of the rotor apex (ElastoDyn ``ShftGagL``), m.
        Only used where the moments at the apex (``LSSTipMys``, ``LSSTipMzs``) are absent.
    frame : {"auto", "fixed", "rotating"}
        Frame of the y and z channels. Their names tell it (``LSShftFys`` stands, ``LSShftFya``
        turns), so that "auto" takes those that are there, standing ones first.

    Returns
    -------
    xarray.Dataset
        Variables over time from 0, in the frame of the cube and SI units, single precision;
        scalar coordinates ``file``, ``file_start`` (first stamp in the file, s) and ``doubts``.

    Raises
    ------
    loadflow.errors.InputError
        No such file, empty, truncated, malformed, missing channels, unknown unit, value that is
        not finite, irregular time.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.readers import read_openfast
    >>> names = "Time RotSpeed RotThrust LSShftFys LSShftFzs RotTorq LSSTipMys LSSTipMzs".split()
    >>> units = "(s) (rpm) (kN) (kN) (kN) (kN-m) (kN-m) (kN-m)".split()
    >>> rows = [f"{0.1 * k:g} 12.0 600.0 1.0 -1000.0 4000.0 200.0 100.0".split() for k in range(5)]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "run.out"
    ...     _ = file.write_text("\n".join(["OpenFAST", *("\t".join(row) for row in (names,
    ...     units, *rows))]))
    ...     series = read_openfast(file)
    >>> series["hub_force"].isel(time=0).values.tolist(), series["hub_force"].units
    ([600000.0, 1000.0, -1000000.0], 'N')
    """
    table = read_table(Path(path))
    return to_series(table, aliases("openfast"), channels, gauge_distance, frame)


def is_the_best(path: Path) -> bool:
    """Whether a file has its run to itself: OpenFAST may write text beside the same in binary."""
    return path.suffix.casefold() != ".out" or not path.with_suffix(".outb").exists()


def read_table(path: Path) -> Table:
    """Read all channels of an OpenFAST file as they are."""
    if not path.is_file():
        raise InputError(f"{path}: no such file")
    with path.open("rb") as file:
        start = file.read(64)
    if not start:
        raise InputError(f"{path}: the file is empty")
    odd = b"\0" in start or (path.suffix.lower() == ".outb" and not start.isascii())
    binary = odd and not start.startswith(UTF_16)
    table = _read_binary(path) if binary else _read_text(path)
    first, unit = table.names[0], table.units[0]
    if first.casefold() != "time" or unit.casefold().strip("()") not in ("s", "sec"):
        raise InputError(f"{path}: first channel is {first!r} in {unit!r}, not time in s")
    return table


# --- binary ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Header:
    """Beginning of a binary file.

    Attributes
    ----------
    kind : int
        1 … 4.
    channels, steps : int
        Channels without time, and time steps.
    time : tuple of float
        First stamp and step, s; of kind 1 factor and offset of the stamps.
    scale, offset : ndarray, shape (channels,)
        Packed value = scale · value + offset; empty in double precision.
    names, units : tuple of str
        Of each column, time first.
    data_start : int
        Byte at which the values begin.
    """

    kind: int
    channels: int
    steps: int
    time: tuple[float, float]
    scale: NDArray[np.float32]
    offset: NDArray[np.float32]
    names: tuple[str, ...]
    units: tuple[str, ...]
    data_start: int

    @property
    def step_size(self) -> int:
        """Bytes of one time step."""
        stamps = 4 if self.kind == WITH_TIME else 0
        return self.channels * (8 if self.kind == DOUBLE else 2) + stamps


def _read_binary(path: Path) -> Table:
    data = path.read_bytes()
    header = _header(data, path)
    expected = header.data_start + header.steps * header.step_size
    if len(data) < expected:
        whole = max(len(data) - header.data_start, 0) // header.step_size
        raise InputError(
            f"{path}: truncated, holds {whole} of {header.steps} time steps: {len(data)} bytes "
            f"where its header says {expected}"
        )
    doubts = []
    if len(data) > expected:
        doubts.append(
            f"{len(data) - expected} bytes follow the {expected} of the header: probably written "
            "over a longer file"
        )
    at, stamps = header.data_start, np.arange(header.steps, dtype=float)
    if header.kind == WITH_TIME:
        scale, offset = header.time
        packed_time = np.frombuffer(data, "<i4", header.steps, at)
        at += 4 * header.steps
        with np.errstate(divide="ignore", invalid="ignore"):  # bad scales show as NaN later
            stamps = (packed_time - offset) / np.float64(scale)
    else:
        stamps = header.time[0] + header.time[1] * stamps
    count = header.steps * header.channels
    if header.kind == DOUBLE:
        values = np.frombuffer(data, "<f8", count, at).reshape(header.steps, header.channels)
    else:
        packed = np.frombuffer(data, "<i2", count, at).reshape(header.steps, header.channels)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            values = (packed - header.offset.astype(float)) / header.scale.astype(float)
    columns = np.column_stack([stamps, values])
    return Table(str(path), stamps, header.names, header.units, columns, doubts=tuple(doubts))


def _header(data: bytes, path: Path) -> Header:
    """Read the header; raise unless it is one, and lies within the file."""
    nonsense = f"{path}: no OpenFAST binary file"
    try:
        (kind,) = struct.unpack_from("<h", data)
        if not WITH_TIME <= kind <= LONG_NAMES:
            raise InputError(f"{nonsense}; it says kind {kind}, known are 1 to 4")
        at, width = 2, 10
        if kind == LONG_NAMES:
            (width,) = struct.unpack_from("<h", data, at)
            at += 2
        channels, steps = struct.unpack_from("<ii", data, at)
        time = struct.unpack_from("<dd", data, at + 8)
        if min(width, channels) < 1 or steps < 0:
            raise InputError(
                f"{nonsense}; the header says {channels} channels, {steps} time steps, names of "
                f"{width} characters"
            )
        at += 24
        packed = 0 if kind == DOUBLE else channels
        if at + 8 * packed > len(data):
            raise struct.error
        scale = np.frombuffer(data, "<f4", packed, at)
        offset = np.frombuffer(data, "<f4", packed, at + 4 * packed)
        (description,) = struct.unpack_from("<i", data, at + 8 * packed)
        at += 8 * packed + 4
        if description < 0:
            raise InputError(f"{nonsense}; a description of {description} characters")
        at += description
        end = at + 2 * (channels + 1) * width
        if end > len(data):
            raise struct.error
    except struct.error:
        raise InputError(f"{path}: truncated within the header, {len(data)} bytes long") from None
    texts = [data[i : i + width].decode("latin-1").strip(" \0") for i in range(at, end, width)]
    names, units = texts[: channels + 1], [_unit(text) for text in texts[channels + 1 :]]
    return Header(kind, channels, steps, time, scale, offset, tuple(names), tuple(units), end)


def _unit(text: str) -> str:
    return text.removeprefix("(").removesuffix(")")


# --- text ------------------------------------------------------------------------------------


def _read_text(path: Path) -> Table:
    """Read a table whose heading, two lines, begins with ``Time`` and its unit."""
    lines = read_text(path).splitlines()
    at = next(
        (i for i, line in enumerate(lines[:SEARCHED_LINES]) if line.split()[:1] in _TIME), None
    )
    if at is None:
        raise InputError(
            f"{path}: no OpenFAST text output; a line must name the channels, beginning with Time"
        )
    names = tuple(lines[at].split())
    units = tuple(lines[at + 1].split()) if len(lines) > at + 1 else ()
    if len(units) != len(names) or units[0].casefold() not in ("(s)", "(sec)"):
        raise InputError(
            f"{path}: line {at + 2} must give {len(names)} units, (s) of the time first, has "
            f"{list(units[:60])}"
        )
    values = number_rows(lines, at + 2, len(names), path)
    return Table(str(path), values[:, 0], names, tuple(map(_unit, units)), values)


_TIME = (["Time"], ["time"], ["TIME"])
