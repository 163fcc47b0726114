"""Full-field wind files of Bladed (``.wnd``), also those that TurbSim writes in this form.

Header: identifier −99 and the number of the spectral model, then sizes, spacings and mean speed;
then 16-bit integers, component fastest, then y, z, time. An integer is a thousandth of the
turbulence intensity of its component.
"""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from loadflow.errors import InputError
from loadflow.wind.box import LARGEST, Box, fitted_profile
from loadflow.wind.box_file import content

_IMPROVED, _LONG = 4, (7, 8)  # TurbSim and improved von Karman; general Kaimal and Mann
_INTENSITIES = struct.Struct("<i6f")  # components, latitude, roughness, height, three intensities
_LENGTHS = struct.Struct("<2i")  # of the header, components
_GRID = struct.Struct("<3fif3f4i")  # dz dy dx, half the steps, speed, 3 scales, 2 unused, nz ny


def read_bladed_box(
    path: str | Path,
    *,
    hub_height: float | None = None,
    intensity: tuple[float, float, float] | None = None,
    clockwise: bool = True,
    shear_exponent: float | None = None,
) -> Box:
    """Read a box.

    Parameters
    ----------
    path : path
        The ``.wnd`` file.
    hub_height : float, optional
        m; by default the height in the middle of the grid, which only some files state.
    intensity : tuple of float, optional
        Turbulence intensity of u, v, w (1) that the integers count; only some files state it.
    clockwise : bool
        Whether the lines of a grid begin at the left, looking downwind (TurbSim states it beside
        the file); else at the right.
    shear_exponent : float, optional
        Of the mean profile that the file leaves out, as Bladed's own files do. By default the file
        holds the profile, as TurbSim's do, and its exponent is fitted.

    Returns
    -------
    Box
        The fluctuation and its mean profile.

    Raises
    ------
    InputError
        Not a file of this format, shorter than its header says, or it lacks what is not given.

    Examples
    --------
    >>> import struct, tempfile
    >>> from pathlib import Path
    >>> from loadflow.wind import read_bladed_box
    >>> kind = struct.pack("<2hi6f", -99, 4, 3, 0.0, 0.03, 80.0, 16.0, 12.0, 8.0)
    >>> grid = struct.pack("<3fif3f4i", 10.0, 10.0, 2.5, 3, 10.0, 0, 0, 0, 0, 7, 3, 4)  # steps
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "wind.wnd"
    ...     _ = file.write_bytes(kind + grid + bytes(24) + bytes(2 * 3 * 6 * 4 * 3))  # steady
    ...     box = read_bladed_box(file, shear_exponent=0.2)
    >>> box.u.shape, box.wind_speed, box.hub_height
    ((6, 4, 3), 10.0, 80.0)
    """
    raw = content(path)
    if len(raw) < 4 + _LENGTHS.size + _GRID.size:
        raise InputError(f"{path}: {len(raw)} bytes, shorter than the header of a .wnd file")
    identifier, model = struct.unpack_from("<2h", raw)
    if identifier != -99 or model not in (_IMPROVED, *_LONG):
        raise InputError(f"{path}: not a .wnd file with three components ({identifier}, {model})")
    start = 4
    if model == _IMPROVED:
        components, _, _, middle, *percent = _INTENSITIES.unpack_from(raw, start)
        hub_height = middle if hub_height is None else hub_height
        intensity = intensity or tuple(value / 100 for value in percent)
        start += _INTENSITIES.size
    else:
        _, components = _LENGTHS.unpack_from(raw, start)
        start += _LENGTHS.size
    dz, dy, dx, half, speed, *_, nz, ny = _GRID.unpack_from(raw, start)
    sizes = all(0 < size < np.inf for size in (dz, dy, dx, speed))
    if components != 3 or min(nz, ny) < 2 or half < 1 or not sizes:
        raise InputError(
            f"{path}: {components} components on a grid {ny} × {nz} of {dy} × {dz} m, {2 * half} "
            f"steps of {dx} m at {speed} m/s"
        )
    if hub_height is None or intensity is None:
        raise InputError(
            f"{path}: the file states no hub_height and intensity; give both to read_bladed_box; a "
            "scene takes the .bts that write_bts makes of its box"
        )
    most = LARGEST / (33 * speed)  # an integer counts up to 32.8 of it
    if not (0 < hub_height < np.inf and all(0 <= share < most for share in intensity)):
        raise InputError(
            f"{path}: hub_height = {hub_height} m must be positive and finite, "
            f"intensity = {intensity} at least 0 and below {most:.0e}"
        )
    count, row = 2 * half, 3 * ny * nz
    # headers differ in length, but the integers run to the end
    start = start + _GRID.size + 24 if model == _IMPROVED else len(raw) - 2 * count * row
    if start < 4 + _GRID.size or len(raw) < start + 2 * count * row:
        raise InputError(
            f"{path}: {len(raw)} bytes, {count} steps of the grid {ny} × {nz} need "
            f"{2 * count * row} beside the header"
        )
    counts = np.frombuffer(raw, "<i2", count * row, start).reshape(count, nz, ny, 3)
    if clockwise:
        counts = counts[:, :, ::-1]
    unit = 1e-3 * speed * np.asarray(intensity)
    u, v, w = ((counts[..., k].transpose(0, 2, 1) * unit[k]).astype(np.float32) for k in range(3))
    z = hub_height + dz * (np.arange(nz) - (nz - 1) / 2)
    if shear_exponent is None:
        mean = speed + u.mean(axis=(0, 1), dtype=float)
        shear_exponent, profile = fitted_profile(z, dz, hub_height, mean / speed, path)
        u -= (speed * (profile - 1)).astype(np.float32)
    y = dy * (np.arange(ny) - (ny - 1) / 2)
    return Box(dx / speed * np.arange(count), y, z, u, v, w, speed, hub_height, shear_exponent)
