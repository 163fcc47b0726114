"""HDF5 files are looked at before they are read: a damaged one may ask for any amount of memory."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np

from loadflow.errors import InputError
from loadflow.storage import check_content

PACKED = 1100
"""Largest ratio of values to stored bytes: deflate does not pack more densely than 1032 : 1."""
REFERENCE = np.dtype([("length", "<u4"), ("heap", "<u8"), ("index", "<u4")])
"""How HDF5 keeps a text of any length: the text itself lies in a heap."""
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
    check_content(path)
    try:
        with h5py.File(path, "r") as file:
            found = [*_attributes("/", file)]
            file.visititems(lambda name, part: found.extend(_parts(name, part)))
    except Exception as error:  # h5py raises of nearly every kind on damaged files
        raise InputError(
            f"{path}: cannot be read as HDF5; empty, truncated or of another kind ({error})"
        ) from None
    for name, declared, room in found:
        if declared > max(SMALL, min(room, PACKED * size)):
            raise InputError(
                f"{path}, {name}: says it holds {declared / 1e6:.4g} MB, but the file of "
                f"{size / 1e6:.4g} MB has room for {min(room, PACKED * size) / 1e6:.4g} MB of it"
            )


Part = tuple[str, int, int]
"""Name, bytes that it says it holds, and bytes that can be stored for it."""


def _parts(name: str, part: h5py.Group | h5py.Dataset) -> Iterator[Part]:
    """Yield a dataset and the attributes of whatever it is."""
    yield from _attributes(name, part)
    if isinstance(part, h5py.Dataset):
        stored = part.id.get_storage_size()
        packed = part.chunks is not None and part.id.get_create_plist().get_nfilters() > 0
        size = Path(part.file.filename).stat().st_size
        yield name, part.nbytes, PACKED * stored if packed else min(stored, size)
        text = h5py.check_string_dtype(part.dtype)
        if text is not None and text.length is None and part.id.get_offset() is not None:
            yield f"{name}, longest text", _longest_text(part), size


def _longest_text(part: h5py.Dataset) -> int:
    """Length that texts of any length claim: HDF5 takes memory for it before it looks further."""
    with Path(part.file.filename).open("rb") as file:
        file.seek(part.id.get_offset())
        raw = file.read(part.id.get_storage_size())
    references = np.frombuffer(raw, REFERENCE, count=len(raw) // REFERENCE.itemsize)
    return int(references["length"].max(initial=0))


def _attributes(name: str, part: h5py.Group | h5py.Dataset) -> Iterator[Part]:
    """Yield the attributes of a part; they are never packed."""
    size = Path(part.file.filename).stat().st_size
    for key in part.attrs:
        attribute = h5py.h5a.open(part.id, key.encode())
        declared = int(np.prod(attribute.shape, dtype=float)) * attribute.dtype.itemsize
        yield f"{name}, attribute {key}", declared, size
