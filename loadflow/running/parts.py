"""The parts of a run: one file for each finished case and stage, sealed with a checksum.

A part ends with a line that says which settings it belongs to and the SHA-256 of what is before
it; HDF5 does not mind bytes after its own end. So a part answers for itself: none is used that was
damaged since, or made with other settings, whatever became of the manifest.
"""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from loadflow.cube import Cube
from loadflow.cube.files import write_cube
from loadflow.storage import written_whole

_SEAL = re.compile(rb"\nloadflow-part ([0-9a-f]{64}) sha256 ([0-9a-f]{64})\n")
_SIZE = len(b"\nloadflow-part ") + 64 + len(b" sha256 ") + 64 + 1
_BLOCK = 1 << 20


def save_part(data: Cube, path: Path, digest: str) -> None:
    """Write a part, sealed, whole or not at all.

    Parameters
    ----------
    data : xarray.Dataset or xarray.DataTree
        What a stage found.
    path : Path
        File of the part.
    digest : str
        Fingerprint of the settings and inputs that it was made with, 64 hexadecimal digits.

    Raises
    ------
    OSError
        The disk is full, or refuses.
    """
    with written_whole(path) as temporary:
        write_cube(data, temporary)
        seal = f"\nloadflow-part {digest} sha256 {_sum(temporary)}\n"
        with temporary.open("ab") as stream:
            stream.write(seal.encode())


def digest_of(path: Path) -> str | None:
    """Return the fingerprint that a part was sealed with; None of a file without a whole seal."""
    seal = _seal(path)
    return seal[0] if seal else None


def is_sound(path: Path) -> bool:
    """Whether a part is what was once written, to the bit."""
    seal = _seal(path)
    return seal is not None and seal[1] == _sum(path, os.path.getsize(path) - _SIZE)


def unsound(paths: Iterable[Path]) -> Iterator[Path]:
    """Yield the parts that are no longer what was written."""
    paths = list(paths)
    with ThreadPoolExecutor(4) as pool:  # hashing releases the interpreter
        for path, sound in zip(paths, pool.map(is_sound, paths)):
            if not sound:
                yield path


def set_aside(path: Path) -> Path:
    """Rename what cannot be used, so that nothing reads it and its owner may look at it."""
    return path.replace(path.with_name(f"{path.name}.damaged"))


def _seal(path: Path) -> tuple[str, str] | None:
    with path.open("rb") as stream:
        if stream.seek(0, os.SEEK_END) < _SIZE:
            return None
        stream.seek(-_SIZE, os.SEEK_END)
        match = _SEAL.fullmatch(stream.read())
    return (match[1].decode(), match[2].decode()) if match else None


def _sum(path: Path, size: int | None = None) -> str:
    """SHA-256 of the first `size` bytes of a file; all of them if not given."""
    left = os.path.getsize(path) if size is None else size
    found = hashlib.sha256()
    with path.open("rb") as stream:
        while left and (block := stream.read(min(left, _BLOCK))):
            found.update(block)
            left -= len(block)
    return found.hexdigest()
