"""HDF5 files are looked at before they are read: a damaged one may ask for any amount of memory."""

from __future__ import annotations

from pathlib import Path

import h5py

from loadflow.errors import InputError

PACKED = 1100
"""Largest ratio of values to stored bytes: deflate does not pack more densely than 1032 : 1."""
SMALL = 2**20
"""Bytes of a dataset that nobody minds."""


def check_hdf5(path: Path) -> None:
    """Raise unless a file is HDF5 that can hold the values it declares.

    Parameters
    ----------
    path : pathlib.Path
        File.

    Raises
    ------
    loadflow.errors.InputError
        Empty, truncated, of another kind, a damaged part, or a dataset that is larger than the file
        could hold; the message names file and dataset.
    """
    size = path.stat().st_size
    if size == 0:
        raise InputError(f"{path}: cannot be read as HDF5; the file is empty")
    try:
        with h5py.File(path, "r") as file:
            found: list[tuple[str, int, int]] = []

            def look(name: str, part: object) -> None:
                if isinstance(part, h5py.Dataset):
                    found.append((name, part.nbytes, part.id.get_storage_size()))

            file.visititems(look)
    except Exception as error:  # h5py raises of nearly every kind on damaged files
        raise InputError(
            f"{path}: cannot be read as HDF5; empty, truncated or of another kind ({error})"
        ) from None
    for name, declared, stored in found:
        if declared > SMALL and declared > PACKED * min(stored, size):
            raise InputError(
                f"{path}, {name}: says it holds {declared / 1e6:.4g} MB, but "
                f"{min(stored, size) / 1e6:.4g} MB of it are in the file of {size / 1e6:.4g} MB"
            )
