"""Turbulence boxes of HAWC2 and of Mann generators: raw 32-bit floats, a file for each component.

Order: x (downwind) slowest, then y, z fastest. The box drifts downwind, so its last plane comes
first. The files say nothing of their own size.
"""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError, ValidityWarning
from loadflow.numerics.fields import check_one_of
from loadflow.wind.box import Box
from loadflow.wind.box_file import content

OUTSTANDING = 4.0
"""Ratio of mean-square steps between neighbours that no homogeneous turbulence makes."""
FURTHEST, SMALLER = 16, 0.8
"""Steps within which differences must grow with the distance, and the share they may fall to."""


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
    first_line: Literal["right", "left"] = "right",
) -> Box:
    """Read a box of fluctuations, centred on the hub.

    Parameters
    ----------
    u, v, w : path
        Files of the components, m/s, z rising.
    shape : tuple of int
        Points along x, y, z.
    spacing : tuple of float
        Their distances, m.
    wind_speed, hub_height, shear_exponent : float
        Mean profile that the box drifts in.
    first_line : {"right", "left"}
        Where the first line of a plane lies, looking downwind. "left" is how InflowWind of OpenFAST
        takes the same files; it is the mirror image of the other.

    Returns
    -------
    Box
        The fluctuation and its mean profile.

    Raises
    ------
    InputError
        Sizes that make no sense; a file of another size, or with values that are not finite.

    Warns
    -----
    loadflow.errors.ValidityWarning
        The values jump where those of a box of this shape would not: its size fits, its shape
        does not.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> from loadflow.wind import read_hawc2_box
    >>> noise = np.random.default_rng(0).standard_normal((3, 8, 4, 4)).astype("f4")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     files = [Path(folder) / f"{name}.bin" for name in "uvw"]
    ...     for file, values in zip(files, noise):
    ...         values.tofile(file)
    ...     box = read_hawc2_box(*files, shape=(8, 4, 4), spacing=(5.0, 10.0, 10.0),
    ...     wind_speed=10.0,
    ...         hub_height=90.0)
    >>> box.u.shape, float(box.time[1])
    ((8, 4, 4), 0.5)
    """
    check_one_of("first_line", first_line, ("right", "left"))
    if min(shape) < 2 or min(spacing) <= 0 or wind_speed <= 0 or hub_height <= 0:
        raise InputError(
            f"shape = {shape}, spacing = {spacing} m, wind_speed = {wind_speed} m/s, hub_height = "
            f"{hub_height} m: at least 2 points each way and positive lengths and speed"
        )
    down, side, up = (_component(Path(path), shape) for path in (u, v, w))
    if jump := _jumps(down):
        warnings.warn(f"{u}: {jump}; is the shape {shape} right?", ValidityWarning, stacklevel=2)
    if first_line == "left":
        down, side, up = (component[:, ::-1] for component in (down, side, up))
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


def _jumps(values: NDArray[np.float32]) -> str:
    """Say where neighbours differ as if they were none; empty where none do.

    In homogeneous turbulence the mean square of the difference of two points depends on their
    distance only, and grows with it. Lines that are cut at the wrong length show as steps that
    stand out, or as neighbours that differ by more than points further apart.
    """
    for axis, name in enumerate("xyz"):
        lines = np.moveaxis(values, axis, 0)
        reach = range(1, min(FURTHEST, max(2, len(lines) // 4), len(lines) - 1) + 1)
        sizes = [_mean_square(lines, lag) for lag in reach]
        near = sizes[0]
        if name != "x" and near.max() > OUTSTANDING * np.median(near):
            at = int(near.argmax())
            return f"the step from line {at + 1} to {at + 2} along {name} stands out"
        lag = int(np.argmin([size.mean() for size in sizes]))
        if sizes[lag].mean() < SMALLER * near.mean():
            return f"neighbours along {name} differ by more than points {lag + 1} steps apart"
    return ""


def _mean_square(lines: NDArray[np.float32], lag: int) -> NDArray[np.float64]:
    """Mean square of the difference between lines `lag` apart, for each first line."""
    steps = lines[lag:] - lines[:-lag]
    return np.mean(steps * steps, axis=(1, 2), dtype=float)
