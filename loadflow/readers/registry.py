"""Which reader reads which file. A new format is one file with a reader, and one line here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fnmatch import fnmatchcase
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from loadflow.errors import InputError

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Reader:
    """How to find the reader of a format.

    Attributes
    ----------
    patterns : tuple of str
        Names of files it reads, lower case, as shell patterns.
    function : str
        ``"module:function"``, imported when used. Called as ``function(path, channels=…,
        gauge_distance=…, frame=…)``, it returns a Dataset over ``time`` in the frame of the cube.
    several_files : bool
        One run makes several files that differ in the suffix only.
    """

    patterns: tuple[str, ...]
    function: str
    several_files: bool = False

    def matches(self, path: Path) -> bool:
        """Return whether this reader reads the file."""
        return any(fnmatchcase(path.name.lower(), pattern) for pattern in self.patterns)

    def load(self) -> Callable[..., xr.Dataset]:
        """Import the function."""
        module, name = self.function.split(":")
        function: Callable[..., xr.Dataset] = getattr(import_module(module), name)
        return function


READERS: tuple[Reader, ...] = (
    Reader(("*.outb", "*.out"), "loadflow.readers.openfast:read_openfast"),
    Reader(("*.csv",), "loadflow.readers.csv_text:read_csv"),
    Reader(("*.sel", "*.dat"), "loadflow.readers.hawc2:read_hawc2", several_files=True),
    Reader(("*.hdf5",), "loadflow.readers.gtsdf:read_gtsdf"),
    Reader(("*.%[0-9]*", "*.$[0-9]*", "*.$pj"), "loadflow.readers.bladed:read_bladed", True),
)
"""All readers; the first whose pattern fits is used."""


def find_reader(path: Path) -> Reader:
    """Return the reader of a file.

    Raises
    ------
    loadflow.errors.InputError
        No reader for this kind of file.
    """
    for reader in READERS:
        if reader.matches(path):
            return reader
    known = ", ".join(pattern for reader in READERS for pattern in reader.patterns)
    raise InputError(f"{path}: no reader for this kind of file; there are readers for {known}")
