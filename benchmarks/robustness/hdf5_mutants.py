"""Sound HDF5 files of the kinds that loadflow reads, to be damaged: gtsdf of HAWC2, load cubes."""

from __future__ import annotations

import random
import warnings
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from loadflow.cube import check_cube, make_case, make_cube, open_cube, save_cube
from loadflow.readers import read_loads

NAMES = ["Omega", *(f"{what}{axis} coo: shaft" for what in "FM" for axis in "xyz")]
UNITS = ["rad/s", *["kN"] * 3, *["kNm"] * 3]
CHANNELS = {"speed": NAMES[0]} | {
    f"{kind}_{axis}": f"{what}{axis} coo: shaft"
    for kind, what in (("hub_force", "F"), ("hub_moment", "M"))
    for axis in "xyz"
}
SEVERAL = 3
"""Sound files of each kind, which keep their values in different ways."""


def write_gtsdf(path: Path, how: int) -> None:
    """Two blocks: as numbers, as integers with gains, or packed; texts of fixed and any length."""
    rng = np.random.default_rng(how)
    values = 100 * rng.normal(size=(120, len(NAMES)))
    values[:, 0] = 1.2 + 1e-3 * values[:, 0]
    texts: Any = h5py.string_dtype() if how else "S30"
    with h5py.File(path, "w", libver="latest" if how == 2 else None) as file:
        file.attrs["type"], file.attrs["no_blocks"] = "General time series data format", 2
        file.attrs["description"] = "a run of HAWC2"
        for key, found in (("attribute_names", NAMES), ("attribute_units", UNITS)):
            file.create_dataset(key, data=np.array(found, dtype=texts if how else "S30"))
        for k, rows in enumerate((values[:80], values[80:])):
            block = file.create_group(f"block{k:04d}")
            block.attrs["time_start"], block.attrs["time_step"] = 100.0 + 4 * k, 0.05
            if how == 1:
                low, gain = rows.min(axis=0), np.ptp(rows, axis=0) / 65000
                block["data"] = np.round((rows - low) / gain).astype("<u2")
                block["gains"], block["offsets"] = gain, low
            else:
                packing = {"chunks": (20, 7), "compression": "gzip"} if how else {}
                block.create_dataset("data", data=rows.astype("f4"), **packing)


def write_cube(path: Path, how: int) -> None:
    """A cube, cases of different length, or a single case."""
    rng = np.random.default_rng(how)
    cases = [
        make_case(
            0.1 * np.arange(steps),
            {
                "speed": 1.2 + 0.01 * rng.normal(size=steps),
                "hub_force": rng.normal(size=(3, steps)),
                "hub_moment": rng.normal(size=(3, steps)),
            },
            dlc="1.1",
            wind_speed=8.0,
            seed=seed,
        )
        for seed, steps in enumerate((60, 60, 60 if how == 0 else 40), 1)
    ]
    save_cube(cases[0] if how == 2 else make_cube(cases), path)


def damaged(data: bytes, draw: random.Random) -> bytes:
    """Bytes replaced, the end cut off, a run of noise, or a flipped bit where structure stands."""
    copy = bytearray(data)
    match draw.randrange(5):
        case 0:
            for _ in range(draw.randint(1, 8)):
                copy[draw.randrange(len(copy))] = draw.randrange(256)
        case 1:
            del copy[draw.randrange(len(copy)) :]
        case 2:
            start = draw.randrange(len(copy))
            count = min(len(copy) - start, draw.randint(1, 200))
            copy[start : start + count] = draw.randbytes(count)
        case 3:
            copy[draw.randrange(min(len(copy), 3000))] ^= 1 << draw.randrange(8)
        case _:  # lengths, addresses and counts among what is mostly zeros
            at = draw.randrange(len(copy) - 8)
            copy[at : at + 8] = draw.choice([0, 1, 2**31, 2**32 - 1, 2**63, len(copy)]).to_bytes(
                8, "little"
            )
    return bytes(copy)


@cache
def _sound(kind: str, how: int, folder: Path) -> bytes:
    path = folder / f"dlc11_v8_s{1 + how}.sound.{kind}"
    (write_cube if kind == "h5" else write_gtsdf)(path, how)
    READ[kind](path)
    return path.read_bytes()


def read_gtsdf(path: Path) -> None:
    """Read a load file to its last value."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        read_loads(path, channels=CHANNELS, quiet=True)


def read_cube(path: Path) -> None:
    """Read a cube to its last value."""
    check_cube(open_cube(path), source=str(path))


READ: dict[str, Callable[[Path], None]] = {"hdf5": read_gtsdf, "h5": read_cube}


def mutant(kind: str, number: int, folder: Path) -> Callable[[], Any]:
    """Return what reads a mutant; refusals must name the file."""
    draw = random.Random(f"{kind} {number}")
    path = folder / f"dlc11_v8_s1.{kind}"
    path.unlink(missing_ok=True)  # HDF5 knows files by their place on the disk: a new one each time
    path.write_bytes(damaged(_sound(kind, draw.randrange(SEVERAL), folder), draw))
    return lambda: READ[kind](path)
