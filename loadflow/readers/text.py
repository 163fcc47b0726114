"""Text files of any origin: their encoding, and tables of numbers with the place of every fault."""

from __future__ import annotations

import codecs
import math
import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.storage import check_content

UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
"""First bytes of a text in UTF-16, as shells of Windows write."""

_FORTRAN = re.compile(
    r"([+-]?(?:\d+\.?\d*|\.\d+))[dD]([+-]?\d+)|([+-]?(?:\d+\.\d*|\.\d+))([+-]\d{3})"
)
"""A number of Fortran: an exponent of three digits takes the place of the E, ``1.5-102``.

That form has a point and all three digits; ``2020-01`` is a date, and no number.
"""


def read_text(path: Path) -> str:
    """Return the content of a text file; see `decoded`.

    Raises
    ------
    loadflow.errors.InputError
        The file cannot be read, is a pointer of Git LFS, or holds bytes that no text has.
    """
    try:
        check_content(path)
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    if b"\0" in data and not data.startswith(UTF_16):
        raise InputError(f"{path}: the file is no text (a zero at byte {data.index(0)})")
    return decoded(data)


def decoded(data: bytes) -> str:
    """Text in UTF-8, in UTF-16 that says so, or else in Latin-1 (a ``·`` of old programs)."""
    if data.startswith(UTF_16):
        return data.decode("utf-16", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def number_rows(
    lines: list[str], start: int, columns: int, path: Path, what: str = "the header names"
) -> NDArray[np.float64]:
    """Return the numbers of a table from line `start` (from 0) to the end; blank ends are left out.

    Raises
    ------
    loadflow.errors.InputError
        No row, a row of another length, a field that is no number; the message names the line.
    """
    end = len(lines)
    while end > start and (not lines[end - 1].strip() or _closing(lines[end - 1])):
        end -= 1
    rows = lines[start:end]
    if not rows:
        raise InputError(f"{path}: the file has a header but no time step")
    widths = {len(row.rstrip()) for row in rows[:-1]}
    if len(widths) == 1 and len(rows[-1].rstrip()) < min(widths):
        raise InputError(f"{path}, line {end}: truncated, the last line is cut")
    fields = [row.split() for row in rows]
    for number, row in enumerate(fields, start + 1):
        if len(row) != columns:
            raise InputError(
                f"{path}, line {number}: {len(row)} values where {what} {columns} channels"
            )
    try:
        return np.array(fields, dtype=float)
    except ValueError:
        return np.array(
            [
                [_number(field, f"{path}, line {number}") for field in row]
                for number, row in enumerate(fields, start + 1)
            ]
        )


def _closing(line: str) -> bool:
    """Whether a program says at the end that it closed the file."""
    return line.strip().startswith("This output file was closed")


def _number(field: str, where: str) -> float:
    """Number of a field, also as Fortran writes it; stars of one that it could not fit are NaN."""
    try:
        return float(field)
    except ValueError:
        if match := _FORTRAN.fullmatch(field):
            return float(f"{match[1] or match[3]}e{match[2] or match[4]}")
        if not field.strip("*"):
            return math.nan
        raise InputError(f"{where}: {field!r} is not a number") from None
