"""Matrices that a user has in a file: read, and told from files that have changed."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError


def read_matrix(path: str | Path, name: str = "matrix") -> NDArray[np.float64]:
    r"""Read a matrix from a file; `name` is that of its key.

    The file is one of numpy (``.npy``), of values between commas (``.csv``), or rows of text.

    Raises
    ------
    InputError
        A file that is missing, or no table of numbers.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.numerics.matrix_file import read_matrix
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = (Path(folder) / "a.txt").write_text("1.0 2.0\n2.0 5.0\n")
    ...     read_matrix(Path(folder) / "a.txt").tolist()
    [[1.0, 2.0], [2.0, 5.0]]
    """
    try:
        if Path(path).suffix == ".npy":
            return np.asarray(np.load(path, allow_pickle=False), dtype=float)
        return np.loadtxt(path, ndmin=2, delimiter="," if Path(path).suffix == ".csv" else None)
    except OSError as error:
        raise InputError(f"{name} = {str(path)!r}: cannot be read: {error}") from error
    except ValueError as error:
        raise InputError(f"{name} = {str(path)!r}: no table of numbers: {error}") from error


def digest_of(path: str | Path, name: str = "matrix", stated: str = "") -> str:
    """SHA-256 of a file, by which a change of it is seen; it must be the `stated` one, if any.

    Raises
    ------
    InputError
        A file that is missing, or another one than was stated.
    """
    try:
        found = hashlib.sha256(Path(path).read_bytes()).hexdigest()
    except OSError as error:
        raise InputError(f"{name} = {str(path)!r}: cannot be read: {error}") from error
    if stated not in ("", found):
        raise InputError(f"{name} = {str(path)!r}: has changed since; sha256 is {found}")
    return found
