"""HAWC2 output: a list of channels (``.sel``) and their values (``.dat``), text or binary.

The files say which body a load was taken from, but not how its axes lie. So `channels` must name
the loads, with signs: for the usual shaft body, whose z axis runs upwind along the shaft,
``{"hub_force_x": "-Fz …", …}``.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.readers.aliases import Channels, Frame, aliases
from loadflow.readers.series import to_series
from loadflow.readers.table import Table
from loadflow.readers.text import number_rows, read_text
from loadflow.storage import check_content


@dataclass(frozen=True)
class Header:
    """Content of a ``.sel`` file.

    Attributes
    ----------
    scans, duration : int, float
        Number of time steps, and their length together, s.
    binary : bool
        Whether the ``.dat`` file holds 16-bit integers.
    names, units, descriptions : tuple of str
        Of each channel.
    scales : ndarray, shape (channels,)
        Factors of binary channels; empty for text.
    """

    scans: int
    duration: float
    binary: bool
    names: tuple[str, ...]
    units: tuple[str, ...]
    descriptions: tuple[str, ...]
    scales: NDArray[np.float64]


def read_hawc2(
    path: str | os.PathLike[str],
    channels: Channels | None = None,
    gauge_distance: float | None = None,
    frame: Frame = "auto",
) -> xr.Dataset:
    r"""Read one HAWC2 run.

    Parameters
    ----------
    path : path
        The ``.sel`` or the ``.dat`` file; the other one lies beside it.
    channels : mapping
        Component of the cube → name of the channel, words of its description, or ``"#7"`` for
        channel 7 of the list; a leading minus turns the sign.
    gauge_distance : float, optional
        Distance from the rotor apex to where ``gauge_moment_y`` and ``_z`` were taken, m.
    frame : {"auto", "fixed", "rotating"}
        "rotating" where the body turns with the rotor, as the shaft of the DTU 10 MW and IEA
        turbines does; y and z channels are turned back with the azimuth (``shaft_rot angle``).

    Returns
    -------
    xarray.Dataset
        Variables over time from 0, in SI units, single precision; scalar coordinates ``file``,
        ``file_start`` and ``doubts``.

    Raises
    ------
    loadflow.errors.InputError
        A file is absent, empty, truncated or malformed; a channel is missing or has another unit.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.readers import read_hawc2
    >>> units = ["s", "rad/s", "kN", "kN", "kN", "kNm", "kNm", "kNm"]
    >>> names = ["Time", "Omega", "Fx", "Fy", "Fz", "Mx", "My", "Mz"]
    >>> rows = [f"{k:6d}      {names[k - 1]:30s} {units[k - 1]:10s} shaft" for k in range(1, 9)]
    >>> head = ["   Scans    Channels    Time [sec]      Format",
    ...     "     3     8     0.300     ASCII"]
    >>> kinds = [f"{what}_{axis}" for what in ("hub_force", "hub_moment") for axis in "xyz"]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "run.sel"
    ...     _ = file.write_text("\n".join([*head, *rows]))
    ...     values = [f"0.{k} 0.9 600 0 -700 4000 0 0" for k in (1, 2, 3)]
    ...     _ = file.with_suffix(".dat").write_text("\n".join(values))
    ...     series = read_hawc2(file, {"speed": "Omega"} | dict(zip(kinds, names[2:])))
    >>> series["hub_force"].isel(time=0).values.tolist(), series["hub_force"].units
    ([600000.0, 0.0, -700000.0], 'N')
    """
    path = Path(path)
    listing, data = path.with_suffix(".sel"), path.with_suffix(".dat")
    for file in (listing, data):
        if not file.is_file():
            raise InputError(f"{file}: no such file; a HAWC2 run needs .sel and .dat")
    header = _read_header(listing)
    values = _read_binary(data, header) if header.binary else _read_text(data, header)
    stamps = _stamps(data, values, header)
    table = Table(
        str(data), stamps, header.names, header.units, values, descriptions=header.descriptions
    )
    return to_series(table, aliases("hawc2"), channels, gauge_distance, frame)


def is_series(path: Path) -> bool:
    """Whether a file has its list: what ends in ``.dat`` may be anything, as decks of OpenFAST."""
    return path.with_suffix(".sel").exists()


def _read_header(path: Path) -> Header:
    lines = read_text(path).splitlines()
    at = next(
        (i for i, line in enumerate(lines) if line.split()[:2] == ["Scans", "Channels"]), None
    )
    try:
        if at is None:
            raise ValueError("no line 'Scans Channels Time Format'")
        scans, count, duration, form = lines[at + 1].split()[:4]
        rows = [line for line in lines[at + 2 :] if line[:12].strip().isdigit()][: int(count)]
        binary = form.upper() == "BINARY"
        numbers = _scales(lines) if binary else []
        wanted = int(count) if binary else 0
        if len(rows) != int(count) or len(numbers) != wanted:
            raise ValueError(f"{count} channels, but {len(rows)} names, {len(numbers)} scales")
        if int(scans) < 1 or float(duration) <= 0:
            raise ValueError(f"{scans} scans in {duration} s")
    except (ValueError, IndexError) as error:
        raise InputError(f"{path}: no list of HAWC2 channels, or truncated: {error}") from None
    names = tuple(row[12:43].strip() for row in rows)
    units = tuple(row[43:54].strip() for row in rows)
    described = tuple(row[54:].strip() for row in rows)
    return Header(int(scans), float(duration), binary, names, units, described, np.array(numbers))


def _scales(lines: list[str]) -> list[float]:
    start = next((i for i, line in enumerate(lines) if "scale factors" in line.lower()), len(lines))
    return [float(line) for line in lines[start + 1 :] if line.strip()]


def _read_binary(path: Path, header: Header) -> NDArray[np.float64]:
    """Read 16-bit integers, one channel after the other."""
    check_content(path)
    count = len(header.names)
    expected = 2 * count * header.scans
    if (size := path.stat().st_size) != expected:
        raise InputError(f"{path}: {size} bytes where its list says {expected}; truncated?")
    packed = np.fromfile(path, dtype="<i2").reshape(count, header.scans)
    values: NDArray[np.float64] = (packed * header.scales[:, None]).T
    return values


def _read_text(path: Path, header: Header) -> NDArray[np.float64]:
    values = number_rows(read_text(path).splitlines(), 0, len(header.names), path, "its list has")
    if len(values) != header.scans:
        raise InputError(
            f"{path}: {len(values)} × {len(header.names)} values where its list says "
            f"{header.scans} × {len(header.names)}; truncated?"
        )
    return values


def _stamps(path: Path, values: NDArray[np.float64], header: Header) -> NDArray[np.float64]:
    """Return regular stamps; 16 bits are too few for those in a binary file."""
    if header.names[0].casefold() == "time" and not header.binary:
        return values[:, 0]
    step = header.duration / header.scans
    count = np.arange(header.scans, dtype=float)
    if header.names[0].casefold() != "time":
        return step * (count + 1)
    written = values[:, 0]
    stamps: NDArray[np.float64] = step * (round(written[0] / step) + count)
    off = float(np.abs(written - stamps).max())
    if off > max(1.5 * header.scales[0], 1.01 * step):
        raise InputError(f"{path}, channel 'Time': off steps of {step:g} s by up to {off:g} s")
    return stamps
