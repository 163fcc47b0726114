"""Time series of HAWC2 in HDF5 (gtsdf): blocks of values, beside names and units of the channels.

The format of DTU's wind energy toolbox: ``attribute_names``, ``attribute_units`` and groups
``block0000``, … with ``data`` (samples, channels); integers have ``gains`` and ``offsets`` for each
channel, and time is given by start and step, or by stamps.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.cube.trust import check_hdf5
from loadflow.errors import InputError
from loadflow.readers.aliases import Channels, Frame, aliases
from loadflow.readers.series import to_series
from loadflow.readers.table import Table

KIND = "General time series data format"


def read_gtsdf(
    path: str | os.PathLike[str],
    channels: Channels | None = None,
    gauge_distance: float | None = None,
    frame: Frame = "auto",
) -> xr.Dataset:
    """Read one HAWC2 run that was written with ``data_format gtsdf``.

    Parameters
    ----------
    path : path
        File, ``.hdf5``.
    channels, gauge_distance, frame
        As in `loadflow.readers.read_hawc2`; ``"#7"`` counts the channels of the file, time not
        among them.

    Returns
    -------
    xarray.Dataset
        Variables over time from 0, in SI units, single precision; scalar coordinates ``file``,
        ``file_start`` and ``doubts``.

    Raises
    ------
    loadflow.errors.InputError
        No such file, not HDF5, not gtsdf, truncated, or a channel that is missing or has another
        unit.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import h5py
    >>> import numpy as np
    >>> from loadflow.readers import read_gtsdf
    >>> names = ["Omega", "Fx", "Fy", "Fz", "Mx", "My", "Mz"]
    >>> kinds = [f"{what}_{axis}" for what in ("hub_force", "hub_moment") for axis in "xyz"]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "run.hdf5"
    ...     with h5py.File(path, "w") as file:
    ...         file.attrs["type"], file.attrs["no_blocks"] = "General time series data format", 1
    ...         file["attribute_names"] = np.array([name.encode() for name in names])
    ...         file["attribute_units"] = np.array([b"rad/s", *[b"kN"] * 3, *[b"kNm"] * 3])
    ...         block = file.create_group("block0000")
    ...         block.attrs["time_start"], block.attrs["time_step"] = 0.0, 0.1
    ...         block["data"] = np.tile([0.9, 600.0, 0.0, -700.0, 4000.0, 0.0, 0.0], (3, 1))
    ...     series = read_gtsdf(path, {"speed": "Omega"} | dict(zip(kinds, names[1:])))
    >>> series["hub_force"].isel(time=0).values.tolist(), series["hub_force"].units
    ([600000.0, 0.0, -700000.0], 'N')
    """
    path = Path(path)
    if not path.is_file():
        raise InputError(f"{path}: no such file")
    check_hdf5(path)
    try:
        with h5py.File(path, "r") as file:
            table = _table(file, path)
    except InputError:
        raise
    except Exception as error:  # h5py raises of nearly every kind on damaged files
        raise InputError(f"{path}: damaged gtsdf file: {error}") from None
    return to_series(table, aliases("hawc2"), channels, gauge_distance, frame)


def is_series(path: Path) -> bool:
    """Whether an HDF5 file says that it is gtsdf, or cannot be opened to say what it is."""
    try:
        check_hdf5(path)
        with h5py.File(path, "r") as file:
            return _text(file.attrs.get("type", "")).casefold() == KIND.casefold()
    except Exception:  # a damaged file is for the reader to refuse
        return True


def _table(file: h5py.File, path: Path) -> Table:
    kind = _text(file.attrs.get("type", ""))
    if kind.casefold() != KIND.casefold():
        raise InputError(f"{path}: no gtsdf file; attribute 'type' is {kind!r}, not {KIND!r}")
    blocks = [file[name] for name in sorted(file) if name.startswith("block")]
    stated = int(file.attrs.get("no_blocks", len(blocks)))
    if not blocks or stated != len(blocks):
        raise InputError(f"{path}: {len(blocks)} blocks of data where it says {stated}; truncated?")
    values, stamps = [], []
    for block in blocks:
        data = _values(block)
        values.append(data)
        stamps.append(_stamps(block, len(data)))
    if len({data.shape[1] for data in values}) > 1:
        raise InputError(f"{path}: blocks differ in their number of channels")
    count = values[0].shape[1]
    names = _texts(file, "attribute_names", count)
    units = _texts(file, "attribute_units", count)
    if not len(names) == len(units) == count:
        raise InputError(f"{path}: {count} channels, {len(names)} names, {len(units)} units")
    described = _texts(file, "attribute_descriptions", count)
    return Table(
        str(path),
        np.concatenate(stamps),
        names,
        units,
        np.concatenate(values),
        descriptions=described if len(described) == count else (),
    )


def _values(block: Any) -> NDArray[np.float64]:
    data = block["data"]
    if data.ndim != 2:
        raise ValueError(f"{block.name}: data of {data.ndim} dimensions")
    packed = data[:]
    values: NDArray[np.float64] = packed.astype(float)
    if data.dtype.kind in "iu":
        values[packed == np.iinfo(data.dtype).max] = np.nan  # what the format says of gaps
    if "gains" in block:
        values *= block["gains"][:]
    if "offsets" in block:
        values += block["offsets"][:]
    return values


def _stamps(block: Any, count: int) -> NDArray[np.float64]:
    stamps = block["time"][:].astype(float) if "time" in block else np.arange(count, dtype=float)
    if len(stamps) != count:
        raise ValueError(f"{block.name}: {len(stamps)} stamps of {count} samples")
    # each is one number, or two that are added, for absolute times
    step, start = (
        float(np.sum(block.attrs.get(key, default)))
        for key, default in (("time_step", 1.0), ("time_start", 0.0))
    )
    found: NDArray[np.float64] = stamps * step + start
    return found


def _texts(file: h5py.File, key: str, count: int) -> tuple[str, ...]:
    if key not in file:
        return tuple(f"Attribute {i}" for i in range(count)) if key.endswith("names") else ()
    return tuple(_text(entry).strip() for entry in file[key][:])


def _text(entry: Any) -> str:
    return entry.decode("utf-8", "replace") if isinstance(entry, bytes) else str(entry)
