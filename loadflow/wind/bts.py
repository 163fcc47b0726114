"""Full-field wind files of TurbSim (``.bts``), as OpenFAST reads them.

Layout: identifier, sizes, spacings, scale of each component, a description, then the total wind
(mean profile and turbulence) as 16-bit integers, component fastest, then y, z, time.
"""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.wind.box import LARGEST, Box, fitted_profile, spacing_of
from loadflow.wind.box_file import content

_HEAD = struct.Struct("<h4i6f6fi")
_NOT_PERIODIC, _PERIODIC = 7, 8


def write_bts(path: str | Path, box: Box, description: str = "loadflow") -> None:
    """Write a box with its mean profile; the 16-bit numbers resolve 1/65534 of each range.

    Parameters
    ----------
    path : path-like
        File to write; one that is there is overwritten.
    box : Box
        Fluctuation and mean profile; y symmetric to 0, m.
    description : str
        Text in the head of the file, of which 200 ASCII characters are kept.

    Raises
    ------
    InputError
        If the grid lines are not equidistant or the hub is not within the box.

    Examples
    --------
    >>> import tempfile
    >>> from loadflow.wind import kaimal_box, read_bts, write_bts
    >>> box = kaimal_box(12.0, 1.8, y=[-20.0, 0.0, 20.0], z=[70.0, 90.0, 110.0], hub_height=90.0,
    ...     duration=10.0, dt=0.5, seed=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_bts(f"{folder}/wind.bts", box)
    ...     again = read_bts(f"{folder}/wind.bts")
    >>> again.u.shape == box.u.shape, bool(abs(again.v - box.v).max() < 1e-3)
    (True, True)
    """
    dy, dz = spacing_of("y", box.y), spacing_of("z", box.z)
    if abs(box.y[0] + box.y[-1]) > 1e-3 * dy:
        raise InputError(f"the format wants y symmetric to 0, not {box.y[0]} … {box.y[-1]} m")
    if not box.z[0] <= box.hub_height <= box.z[-1] or box.z[0] <= 0:
        raise InputError(
            f"z = {box.z[0]} … {box.z[-1]} m must be above ground and contain the hub, "
            f"{box.hub_height} m"
        )
    shape = (len(box.time), len(box.z), len(box.y), 3)
    counts = np.empty(shape, np.int16)
    scales: list[float] = []
    for k, fluctuation in enumerate((box.u, box.v, box.w)):
        wind = np.zeros((1, 1, 1)) if fluctuation is None else fluctuation.transpose(0, 2, 1)
        if k == 0:
            wind = wind + _profile(box)[:, None]
        low, high = float(wind.min()), float(wind.max())
        # rounded as the file stores them, so that reading undoes exactly what was written
        slope = np.float32(65534 / (high - low) if high > low else 1.0)
        offset = np.float32(-32767 - slope * low)
        np.clip(np.rint(slope * wind + offset), -32768, 32767, out=counts[..., k], casting="unsafe")
        scales += [float(slope), float(offset)]
    text = description.encode("ascii", "replace")[:200]
    head = _HEAD.pack(
        _NOT_PERIODIC, len(box.z), len(box.y), 0, len(box.time),
        dz, dy, box.time[1] - box.time[0], box.wind_speed, box.hub_height, box.z[0],
        *scales, len(text),
    )  # fmt: skip
    with open(path, "wb") as file:
        file.write(head + text)
        counts.tofile(file)


def read_bts(path: str | Path) -> Box:
    """Read a box; the exponent of the mean profile is fitted, the rest of the wind fluctuates.

    Parameters
    ----------
    path : path-like
        A file of TurbSim's full-field format (``.bts``).

    Returns
    -------
    Box
        The fluctuation and its mean profile.

    Raises
    ------
    InputError
        If the file is not of this format, its header makes no sense, or it is shorter than that
        says; if no power law can be fitted, as where the wind blows backwards.

    Examples
    --------
    >>> import tempfile
    >>> from loadflow.wind import kaimal_box, read_bts, write_bts
    >>> box = kaimal_box(12.0, 1.8, y=[-20.0, 0.0, 20.0], z=[70.0, 90.0, 110.0], hub_height=90.0,
    ...     duration=10.0, dt=0.5, seed=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_bts(f"{folder}/wind.bts", box)
    ...     box = read_bts(f"{folder}/wind.bts")
    >>> box.y.tolist(), round(box.wind_speed, 3)
    ([-20.0, 0.0, 20.0], 12.0)
    """
    raw = content(path)
    if len(raw) < _HEAD.size:
        raise InputError(f"{path}: {len(raw)} bytes, shorter than the header of a .bts file")
    identifier, nz, ny, tower, nt, dz, dy, dt, speed, hub, bottom, *scales, text = (
        _HEAD.unpack_from(raw)
    )
    if (
        identifier not in (_NOT_PERIODIC, _PERIODIC)
        or min(nz, ny, nt) < 2
        or min(tower, text, bottom) < 0
        or not all(0 < size < np.inf for size in (dz, dy, dt, speed, hub))
        or not np.isfinite([bottom, *scales]).all()
        or min(scales[::2]) <= 0
        or any(2**15 + abs(b) > LARGEST * a for a, b in zip(scales[::2], scales[1::2]))
    ):
        raise InputError(
            f"{path}: not a .bts file (identifier {identifier}, grid {ny} × {nz} of {dy} × {dz} m "
            f"from {bottom} m, steps of {dt} s, {speed} m/s at {hub} m)"
        )
    start, row = _HEAD.size + text, 3 * (nz * ny + tower)
    if len(raw) < start + 2 * nt * row:
        raise InputError(f"{path}: {len(raw)} bytes, the header asks for {start + 2 * nt * row}")
    counts = np.frombuffer(raw, "<i2", nt * row, start).reshape(nt, row)[:, : 3 * nz * ny]
    counts = counts.reshape(nt, nz, ny, 3).transpose(0, 2, 1, 3)
    u, v, w = (
        ((counts[..., k] - scales[2 * k + 1]) / scales[2 * k]).astype(np.float32) for k in range(3)
    )
    z = bottom + dz * np.arange(nz)
    mean = u.mean(axis=(0, 1), dtype=float)
    exponent, profile = fitted_profile(z, dz, hub, mean / speed, path)
    u -= (speed * profile).astype(np.float32)
    y = dy * (np.arange(ny) - (ny - 1) / 2)
    return Box(dt * np.arange(nt), y, z, u, v, w, speed, hub, exponent)


def _profile(box: Box) -> NDArray[np.float64]:
    return box.wind_speed * (box.z / box.hub_height) ** box.shear_exponent
