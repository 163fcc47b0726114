"""The bytes of a file of wind."""

from __future__ import annotations

from pathlib import Path

from loadflow.errors import InputError


def content(path: str | Path) -> bytes:
    """Whole content of a file.

    Raises
    ------
    InputError
        The file is missing or cannot be read.
    """
    try:
        return Path(path).read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot read the wind: {error.strerror}") from error
