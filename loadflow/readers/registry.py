"""Which reader reads which file. A new format is one file with a reader, and one line here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fnmatch import fnmatchcase
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

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
    recognise : str
        ``"module:function"`` of a test whether a file that was not named, but lies in a folder, is
        a load series; without it every file that fits a pattern is one.

    Examples
    --------
    >>> from pathlib import Path
    >>> from loadflow.readers import READERS
    >>> [reader.function for reader in READERS if reader.matches(Path("RUN_01.OUTB"))]
    ['loadflow.readers.openfast:read_openfast']
    """

    patterns: tuple[str, ...]
    function: str
    several_files: bool = False
    recognise: str = ""

    def matches(self, path: Path) -> bool:
        """Return whether this reader reads the file."""
        return any(fnmatchcase(path.name.lower(), pattern) for pattern in self.patterns)

    def recognises(self, path: Path) -> bool:
        """Return whether a file in a folder is a load series that this reader reads."""
        return self.matches(path) and (not self.recognise or bool(_imported(self.recognise)(path)))

    def load(self) -> Callable[..., xr.Dataset]:
        """Import the function."""
        return _imported(self.function)


def _imported(name: str) -> Callable[..., Any]:
    module, function = name.split(":")
    found: Callable[..., Any] = getattr(import_module(module), function)
    return found


_ROOM = "loadflow.readers"
READERS: tuple[Reader, ...] = (
    Reader(
        ("*.outb", "*.out"),
        f"{_ROOM}.openfast:read_openfast",
        recognise=f"{_ROOM}.openfast:is_the_best",
    ),
    Reader(("*.csv",), f"{_ROOM}.csv_text:read_csv", recognise=f"{_ROOM}.csv_text:is_series"),
    Reader(
        ("*.sel", "*.dat"),
        f"{_ROOM}.hawc2:read_hawc2",
        several_files=True,
        recognise=f"{_ROOM}.hawc2:is_series",
    ),
    Reader(("*.hdf5",), f"{_ROOM}.gtsdf:read_gtsdf", recognise=f"{_ROOM}.gtsdf:is_series"),
    Reader(("*.%[0-9]*", "*.$[0-9]*", "*.$pj"), f"{_ROOM}.bladed:read_bladed", several_files=True),
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
