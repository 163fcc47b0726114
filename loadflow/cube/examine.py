"""What is looked at in an HDF5 file before it is trusted, in a process that may die of it.

HDF5 follows lengths and addresses of a damaged file wherever they lead: to any amount of memory, or
to memory that is not there, which ends the process. `loadflow.cube.trust` therefore runs this file
as a program of its own, and asks it about one file after another; it imports nothing of loadflow,
so that it starts fast.
"""

from __future__ import annotations

import json
import signal
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import h5py
import numpy as np

PACKED = 1100
"""Largest ratio of values to stored bytes: deflate does not pack more densely than 1032 : 1."""
REFERENCE = np.dtype([("length", "<u4"), ("heap", "<u8"), ("index", "<u4")])
"""How HDF5 keeps a text of any length: the text itself lies in a heap."""
SMALL = 2**20
"""Bytes of a dataset that nobody minds."""
WHOLE = 64 * 2**20
"""Bytes of a dataset up to which all of it is read; of larger ones, the ends and the index."""
PATIENCE = 2.0
"""Seconds of processor time within which a file is examined, and a second more for each `SPEED`."""
SPEED = 20e6
"""Bytes that are examined in a second, at the least."""
MEMORY = 2**30
"""Bytes that the process may take beyond what it has when it starts."""


def examine(path: Path, tell: Callable[[str], None] = lambda name: None) -> str:
    """Read whatever a file holds; return what is wrong with it, or nothing.

    Each part is told of before it is looked at, as no answer may follow.
    """
    size = path.stat().st_size
    try:
        with h5py.File(path, "r") as file:
            found: list[Part] = []
            for name, part in _each(file, tell):
                found += _parts(name, part)
            for name, declared, room in found:
                if declared > max(SMALL, min(room, PACKED * size)):
                    return (
                        f", {name}: says it holds {declared / 1e6:.4g} MB, but the file of "
                        f"{size / 1e6:.4g} MB has room for {min(room, PACKED * size) / 1e6:.4g} MB "
                        "of it"
                    )
            for _, part in _each(file, tell):
                _read(part)
    except Exception as error:  # h5py raises of nearly every kind on damaged files
        return f": cannot be read as HDF5; empty, truncated or of another kind ({error})"
    return ""


def _each(
    file: h5py.File, tell: Callable[[str], None]
) -> Iterator[tuple[str, h5py.Group | h5py.Dataset]]:
    """Yield all parts of a file, itself first."""
    tell("/")
    yield "/", file
    names: list[str] = []
    file.visit(names.append)
    for name in names:
        tell(name)
        yield name, file[name]


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


UNKNOWN = (TypeError, UnicodeError)
"""What h5py raises of sound values that it has no kind for; a reader that wants them tells so."""


def _read_attributes(part: h5py.Group | h5py.Dataset) -> None:
    for key in part.attrs:
        try:
            part.attrs[key]
        except UNKNOWN:
            continue


def _read(part: h5py.Group | h5py.Dataset) -> None:
    """Read attributes and values of a part, and what else its readers ask HDF5 for."""
    _read_attributes(part)
    if not isinstance(part, h5py.Dataset):
        return
    try:
        _ = part.is_scale, [[*dim.values()] for dim in part.dims], part.fillvalue
        if part.chunks is not None:
            for k in range(part.id.get_num_chunks()):
                part.id.get_chunk_info(k)
        if part.ndim == 0 or part.nbytes <= WHOLE:
            part[()]
        elif part.size:
            _ = part[:1], part[-1:]
    except UNKNOWN:
        return


def limit_memory() -> None:
    """Let a length that is damaged meet a limit, where the system has one."""
    try:
        import resource

        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    except (ImportError, OSError):
        return
    most = pages * resource.getpagesize() + MEMORY
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def main() -> None:
    """Answer each path, a line of JSON, with a line of JSON, until nobody asks any more.

    Before the answer, lists with one name tell where it is.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the keyboard is the parent's
    limit_memory()
    _say("ready")
    for line in sys.stdin:
        path = Path(json.loads(line))
        _limit_time(path.stat().st_size)
        _say(examine(path, tell=lambda name: _say([name])))
        _limit_time()


def _say(what: str | list[str]) -> None:
    """An answer, or the name of the part that is looked at."""
    print(json.dumps(what), flush=True)


def _limit_time(size: int | None = None) -> None:
    """End this process if a file takes it longer than its size justifies; HDF5 may find no end."""
    if hasattr(signal, "setitimer"):
        seconds = 0.0 if size is None else PATIENCE + size / SPEED
        signal.setitimer(signal.ITIMER_PROF, seconds)


if __name__ == "__main__":
    main()
