"""Files that are whole or not there, under names that every system takes."""

from __future__ import annotations

import errno
import json
import math
import os
import re
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from loadflow.errors import InputError

LONGEST_NAME = 120

_UNSAFE = re.compile(r'[\x00-\x1f\x7f/\\:*?"<>|]')
_RESERVED = re.compile(r"(con|prn|aux|nul|com[0-9]|lpt[0-9]) *(\..*)?", re.IGNORECASE)
_TEMPORARY = re.compile(r"\.(?P<name>.+)\.\d+\.loadflow-tmp")


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """Yield a temporary name beside `path`; what was written there takes its place, or nothing.

    The folder must be there. The content is on the disk before the name is: a machine that loses
    power leaves the old file or the new one. (The rename itself may be lost, which is no harm.)

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "answer.txt"
    >>> with written_whole(path) as temporary:
    ...     _ = temporary.write_text("42")
    >>> path.read_text()
    '42'
    """
    temporary = path.with_name(f".{path.name}.{os.getpid()}.loadflow-tmp")
    try:
        yield temporary
        with temporary.open("rb+") as stream:
            os.fsync(stream.fileno())
        os.replace(temporary, path)
    except OSError as error:
        if error.errno is None or error.filename not in (None, str(temporary)):
            raise
        said = error.strerror or os.strerror(error.errno)  # of a full disk no name is told
        raise OSError(error.errno, said, str(path)) from error
    finally:
        with suppress(OSError):  # the disk may be gone, and the first error is the one to tell
            temporary.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> Path:
    """Write a text file whole or not at all."""
    with written_whole(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return path


def write_json(path: Path, data: Any) -> Path:
    """Write data as JSON, whole or not at all: NaN as null, what is infinite as "Infinity"."""
    text = json.dumps(plain(data, infinite=True), indent=1, allow_nan=False)
    return write_text(path, text)


def plain(data: Any, *, infinite: bool = False) -> Any:
    """Mappings, sequences and arrays as what JSON knows; NaN is None.

    Parameters
    ----------
    data
        Of any depth.
    infinite : bool
        Whether infinite numbers are told, as "Infinity" and "-Infinity"; else they are None, too.

    Examples
    --------
    >>> plain({"life": (1.0, float("nan"), float("inf"))})
    {'life': [1.0, None, None]}
    >>> plain(float("-inf"), infinite=True)
    '-Infinity'
    """
    if hasattr(data, "tolist"):  # an array or one of its numbers
        data = data.tolist()
    if isinstance(data, Mapping):
        return {str(key): plain(value, infinite=infinite) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [plain(value, infinite=infinite) for value in data]
    if not isinstance(data, float) or math.isfinite(data):
        return data
    if infinite and math.isinf(data):
        return "Infinity" if data > 0 else "-Infinity"
    return None


def number_of(value: Any) -> Any:
    """A number as it was before `write_json`; what else stands in its place stays as it is.

    Examples
    --------
    >>> number_of(None), number_of("-Infinity"), number_of("not measured")
    (nan, -inf, 'not measured')
    """
    if value is None:
        return math.nan
    return float(value) if value in ("Infinity", "-Infinity") else value


def target_of(name: str) -> str | None:
    """Name of the file that a temporary one was to become; None if `written_whole` made it not.

    Examples
    --------
    >>> target_of(".loads.h5.4711.loadflow-tmp")
    'loads.h5'
    >>> target_of(".session.tmp") is None
    True
    """
    match = _TEMPORARY.fullmatch(name)
    return match["name"] if match else None


_POINTER = b"version https://git-lfs.github.com/spec/"


def check_content(path: Path) -> None:
    r"""Refuse what Git LFS leaves in place of a large file that was not fetched.

    Raises
    ------
    loadflow.errors.InputError
        The file is such a pointer.

    Examples
    --------
    >>> import tempfile
    >>> path = Path(tempfile.mkdtemp()) / "run.outb"
    >>> _ = path.write_text("version https://git-lfs.github.com/spec/v1\noid sha256:12\nsize 9\n")
    >>> try:
    ...     check_content(path)
    ... except InputError as error:
    ...     print(str(error).removeprefix(str(path)))
    : a pointer of Git LFS, not the file itself; `git lfs pull` fetches it
    """
    with path.open("rb") as stream:
        if stream.read(len(_POINTER)) == _POINTER:
            raise InputError(
                f"{path}: a pointer of Git LFS, not the file itself; `git lfs pull` fetches it"
            )


def check_name(name: str, what: str = "name") -> str:
    """Return a name that may become a file or a folder, on every system and nowhere else.

    Raises
    ------
    loadflow.errors.InputError
        Empty or too long; separators of folders or other characters that a system forbids; a dot
        at either end or a space at the last; a name that Windows keeps for devices.

    Examples
    --------
    >>> check_name("dlc1.1_v12_s1")
    'dlc1.1_v12_s1'
    """
    shown = f"{what} = {name[: 2 * LONGEST_NAME]!r} is not allowed; it must"
    if not 0 < len(name.encode()) <= LONGEST_NAME:
        raise InputError(f"{shown} have 1 to {LONGEST_NAME} characters")
    if _UNSAFE.search(name):
        raise InputError(f'{shown} not hold / \\ : * ? " < > | or control characters')
    if name.startswith(".") or name.endswith((".", " ")):
        raise InputError(f"{shown} not begin with a dot, nor end with a dot or a space")
    if _RESERVED.fullmatch(name):
        raise InputError(f"{shown} not be one that Windows keeps for devices")
    return name


def check_room(folder: Path, size: int) -> None:
    """Raise the error of a full disk if `folder` has no room for `size` bytes.

    Raises
    ------
    OSError
        With the bytes wanted and free.
    """
    free = shutil.disk_usage(folder).free
    if free < size:
        said = f"{os.strerror(errno.ENOSPC)}: {size / 1e6:.0f} MB wanted, {free / 1e6:.0f} MB free"
        raise OSError(errno.ENOSPC, said, str(folder))
