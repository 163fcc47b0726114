"""Writers of small, sound OpenFAST files, to be damaged by the tests."""

import struct
from pathlib import Path

import numpy as np

UNITS = {
    "Time": "(s)",
    "Wind1VelX": "(m/s)",
    "RotSpeed": "(rpm)",
    "BldPitch1": "(deg)",
    "Azimuth": "(deg)",
    "RotThrust": "(kN)",
    "LSShftFys": "(kN)",
    "LSShftFzs": "(kN)",
    "RotTorq": "(kN-m)",
    "LSSTipMys": "(kN-m)",
    "LSSTipMzs": "(kN-m)",
}


def channels(n=400, dt=0.025, start=0.0, seed=0):
    """Made-up series in the units of `UNITS`, by channel."""
    rng = np.random.default_rng(seed)
    t = start + dt * np.arange(n)
    data = {"Time": t, "Wind1VelX": 12 + rng.normal(size=n), "RotSpeed": 12 + 0.1 * np.sin(t)}
    data |= {"BldPitch1": 3 + np.cos(t), "Azimuth": np.mod(72.0 * t, 360.0)}
    for i, name in enumerate(list(UNITS)[5:]):
        data[name] = 100.0 * (i + 1) + 10 * rng.normal(size=n)
    return data


def write_outb(path: Path, data, units=UNITS, kind=4, width=12):
    """Write an OpenFAST binary file: kind 1 (packed, with time), 2, 3 (double) or 4."""
    names = list(data)
    time, values = data["Time"], np.column_stack([data[k] for k in names[1:]])
    n, count = values.shape
    low, high = values.min(axis=0), values.max(axis=0)
    scale = (65000.0 / np.where(high > low, high - low, 1.0)).astype("<f4")
    offset = (-32500.0 - scale * low).astype("<f4")
    head = struct.pack("<h", kind) + (struct.pack("<h", width) if kind == 4 else b"")
    width = width if kind == 4 else 10
    head += struct.pack("<ii", count, n)
    step = time[1] - time[0] if n > 1 else 0.025
    first = time[0] if n else 0.0
    head += struct.pack("<dd", 1 / step, 0.0) if kind == 1 else struct.pack("<dd", first, step)
    if kind != 3:
        head += scale.tobytes() + offset.tobytes()
    head += struct.pack("<i", 4) + b"test"
    for row in (names, [units[k] for k in names]):
        head += b"".join(text.encode().ljust(width)[:width] for text in row)
    body = np.round(time / step).astype("<i4").tobytes() if kind == 1 else b""
    packed = values.astype("<f8") if kind == 3 else np.round(values * scale + offset).astype("<i2")
    path.write_bytes(head + body + packed.tobytes())
    return path


def write_out(path: Path, data, units=UNITS):
    """Write an OpenFAST text file."""
    names = list(data)
    lines = ["", "Predictions were generated with a test", "", "", "Description", ""]
    lines += ["\t".join(k.rjust(11) for k in names), "\t".join(units[k].rjust(11) for k in names)]
    for row in np.column_stack([data[k] for k in names]):
        lines.append(f"{row[0]:11.4f}\t" + "\t".join(f"{x:11.4E}" for x in row[1:]))
    path.write_text("\n".join(lines) + "\n")
    return path
