"""OpenFAST output, text (``.out``) and binary (``.outb``), through openfast_io.

openfast_io reads sound files; on unsound ones it stops with an error of `struct`, or returns an
empty array. So sizes and headers are checked here before it is asked.
"""

from __future__ import annotations

import os
import struct
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.errors import InputError
from loadflow.readers.table import Channels, Table, to_series

CHANNELS: dict[str, tuple[str, ...]] = {
    "speed": ("RotSpeed", "LSSTipVxa", "LSSTipVxs", "LSSTipV"),
    "pitch": ("BldPitch1", "PtchPMzc1", "BlPitch1", "BldPtch1"),
    "azimuth": ("Azimuth", "LSSTipPxa", "LSSTipPxs", "LSSTipP"),
    "wind": ("Wind1VelX", "WindVxi", "HorWindV", "RtVAvgxh"),
    "hub_force_x": ("RotThrust", "LSShftFxa", "LSShftFxs"),
    "hub_force_y": ("LSShftFys",),
    "hub_force_z": ("LSShftFzs",),
    "hub_moment_x": ("RotTorq", "LSShftTq", "LSShftMxa", "LSShftMxs"),
    "hub_moment_y": ("LSSTipMys",),
    "hub_moment_z": ("LSSTipMzs",),
}
"""Component of the cube → channels of ElastoDyn and InflowWind, the first one found is used.
Shaft frame s of OpenFAST is the frame of the cube: x along the shaft, downwind; z up."""

GAUGE = ("LSSGagMys", "LSSGagMzs")
HEADER_LINES = 8
KINDS = {1: "packed, with time", 2: "packed", 3: "double precision", 4: "packed, long names"}


def read_openfast(
    path: str | os.PathLike[str],
    channels: Channels | None = None,
    gauge_distance: float | None = None,
) -> xr.Dataset:
    """Read one OpenFAST output file.

    Parameters
    ----------
    path : path
        File, ``.outb`` or ``.out``.
    channels : mapping, optional
        Channels to use instead of those of `CHANNELS`, by component of the cube.
    gauge_distance : float, optional
        Distance of the shaft strain gauge downwind of the rotor apex (ElastoDyn ``ShftGagL``), m.
        Only used where the moments at the apex (``LSSTipMys``, ``LSSTipMzs``) are absent.

    Returns
    -------
    xarray.Dataset
        Variables over time from 0, in the frame of the cube and SI units, single precision;
        scalar coordinates ``file`` and ``file_start`` (first stamp in the file, s).

    Raises
    ------
    loadflow.errors.InputError
        No such file, empty, truncated, malformed, missing channel, unknown unit, value that is
        not finite, irregular time.
    """
    path = Path(path)
    table = read_table(path)
    chosen = {**CHANNELS, **(channels or {})}
    if not {"hub_moment_y", "hub_moment_z"} & set(channels or {}):
        table = _with_moments_at_apex(table, gauge_distance)
    return to_series(table, chosen)


def read_table(path: Path) -> Table:
    """Read all channels of an OpenFAST output file as they are."""
    from openfast_io.FAST_output_reader import load_ascii_output, load_binary_output

    if not path.is_file():
        raise InputError(f"{path}: no such file")
    with path.open("rb") as file:
        start = file.read(64)
    if not start:
        raise InputError(f"{path}: the file is empty")
    if b"\0" in start:
        _check_binary(path)
        with np.errstate(divide="ignore", invalid="ignore"):  # bad scales show as NaN later
            data, info, _ = load_binary_output(str(path))
    else:
        _check_text(path)
        data, info = load_ascii_output(str(path))
    names, units = tuple(info["attribute_names"]), tuple(info["attribute_units"])
    if names[0].casefold() != "time" or units[0].casefold() not in ("s", "sec"):
        raise InputError(f"{path}: first channel is {names[0]!r} in {units[0]!r}, not time in s")
    return Table(str(path), data[:, 0], names, units, data)


def _check_binary(path: Path) -> None:
    """Raise unless the size of the file is what its header says."""
    size = path.stat().st_size
    with path.open("rb") as file:
        try:
            (kind,) = struct.unpack("<h", file.read(2))
            if kind not in KINDS:
                raise InputError(
                    f"{path}: no OpenFAST binary file; it says kind {kind}, known are 1 to 4"
                )
            width = struct.unpack("<h", file.read(2))[0] if kind == 4 else 10
            channels, steps = struct.unpack("<ii", file.read(8))
            scales = 0 if kind == 3 else 8 * channels
            file.seek(16 + scales, os.SEEK_CUR)
            (description,) = struct.unpack("<i", file.read(4))
            data_start = file.tell() + description + 2 * (channels + 1) * width
        except struct.error:
            raise InputError(f"{path}: truncated within the header, {size} bytes long") from None
        except OSError:  # seek to before the start of the file
            raise InputError(f"{path}: no OpenFAST binary file, the header is nonsense") from None
    if min(width, channels, description + 1) < 1 or steps < 0:
        raise InputError(
            f"{path}: no OpenFAST binary file; the header says {channels} channels, {steps} time "
            f"steps, names of {width} characters"
        )
    step_size = channels * (8 if kind == 3 else 2) + (4 if kind == 1 else 0)
    expected = data_start + steps * step_size
    if size != expected:
        whole = max(size - data_start, 0) // step_size
        what = f"truncated, holds {whole} of {steps} time steps" if size < expected else "too long"
        raise InputError(f"{path}: {what}: {size} bytes where its header says {expected}")


def _check_text(path: Path) -> None:
    """Raise unless the file is a table with the header that OpenFAST writes."""
    try:
        lines = path.read_text().splitlines()
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: neither text nor OpenFAST binary ({error})") from None
    names = lines[HEADER_LINES - 2].split() if len(lines) > HEADER_LINES - 2 else []
    if not names or names[0].casefold() != "time":
        raise InputError(
            f"{path}: no OpenFAST text output; line {HEADER_LINES - 1} must name the channels, "
            "beginning with Time"
        )
    units = lines[HEADER_LINES - 1].split() if len(lines) >= HEADER_LINES else []
    if len(units) != len(names) or not all(u[0] == "(" and u[-1] == ")" for u in units):
        raise InputError(
            f"{path}: line {HEADER_LINES} must give {len(names)} units in parentheses, has {units}"
        )
    rows = lines[HEADER_LINES:]
    if not rows:
        raise InputError(f"{path}: the file has a header but no time step")
    widths = {len(row.rstrip()) for row in rows[:-1]}
    if len(widths) == 1 and len(rows[-1].rstrip()) < min(widths):
        raise InputError(f"{path}, line {len(lines)}: truncated, the last line is cut")
    for number, row in enumerate(rows, HEADER_LINES + 1):
        _check_row(row, len(names), f"{path}, line {number}")


def _check_row(row: str, columns: int, where: str) -> None:
    fields = row.split()
    if len(fields) != columns:
        raise InputError(f"{where}: {len(fields)} values where the header names {columns} channels")
    for field in fields:
        try:
            float(field)
        except ValueError:
            raise InputError(f"{where}: {field!r} is not a number") from None


def _with_moments_at_apex(table: Table, gauge_distance: float | None) -> Table:
    """Where only the strain gauge has bending moments, move them to the rotor apex.

    Equilibrium of the (massless) shaft between the two: M_y,tip = M_y,gauge − l F_z and
    M_z,tip = M_z,gauge + l F_y.
    """
    if {"LSSTipMys", "LSSTipMzs"} & set(table.names) or not set(GAUGE) <= set(table.names):
        return table
    if gauge_distance is None:
        raise InputError(
            f"{table.source}: channels 'LSSTipMys' and 'LSSTipMzs' are missing; from 'LSSGagMys' "
            "and 'LSSGagMzs' they follow if gauge_distance (ShftGagL, m) is given"
        )
    my, mz = (table.series(name, "N m") for name in GAUGE)
    fy, fz = (table.series(name, "N") for name in ("LSShftFys", "LSShftFzs"))
    moved = np.column_stack([my - gauge_distance * fz, mz + gauge_distance * fy])
    return Table(
        table.source,
        table.stamps,
        (*table.names, "LSSTipMys", "LSSTipMzs"),
        (*table.units, "N-m", "N-m"),
        np.hstack([table.values, moved]),
    )
