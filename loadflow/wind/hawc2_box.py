"""Turbulence boxes of HAWC2 and of Mann generators: raw 32-bit floats, a file for each component.

Order: x (downwind) slowest, then y, z fastest. The box drifts downwind, so its last plane comes
first. The files say nothing of their own size.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.wind.box import Box
from loadflow.wind.box_file import content


def read_hawc2_box(
    u: str | Path,
    v: str | Path,
    w: str | Path,
    *,
    shape: tuple[int, int, int],
    spacing: tuple[float, float, float],
    wind_speed: float,
    hub_height: float,
    shear_exponent: float = 0.2,
) -> Box:
    """Read a box of fluctuations, centred on the hub.

    Parameters
    ----------
    u, v, w : path
        Files of the components, m/s; y rises to the left when looking downwind, z up.
    shape : tuple of int
        Points along x, y, z.
    spacing : tuple of float
        Their distances, m.
    wind_speed, hub_height, shear_exponent : float
        Mean profile that the box drifts in.

    Raises
    ------
    InputError
        Sizes that make no sense; a file of another size, or with values that are not finite.
    """
    if min(shape) < 2 or min(spacing) <= 0 or wind_speed <= 0 or hub_height <= 0:
        raise InputError(
            f"shape = {shape}, spacing = {spacing} m, wind_speed = {wind_speed} m/s, hub_height = "
            f"{hub_height} m: at least 2 points each way and positive lengths and speed"
        )
    down, side, up = (_component(Path(path), shape) for path in (u, v, w))
    (nx, ny, nz), (dx, dy, dz) = shape, spacing
    y = dy * (np.arange(ny, dtype=float) - (ny - 1) / 2)
    z = hub_height + dz * (np.arange(nz, dtype=float) - (nz - 1) / 2)
    time = dx / wind_speed * np.arange(nx, dtype=float)
    return Box(time, y, z, down, side, up, wind_speed, hub_height, shear_exponent)


def _component(path: Path, shape: tuple[int, int, int]) -> NDArray[np.float32]:
    raw = content(path)
    if len(raw) != 4 * np.prod(shape):
        raise InputError(
            f"{path}: {len(raw)} bytes, a box of {' × '.join(map(str, shape))} points has "
            f"{4 * np.prod(shape)}"
        )
    values = np.frombuffer(raw, "<f4").reshape(shape)[::-1]
    if not np.isfinite(values).all():
        raise InputError(f"{path}: {values[~np.isfinite(values)][0]} among the values")
    return np.ascontiguousarray(values, dtype=np.float32)
