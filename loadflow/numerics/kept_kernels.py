"""Where compiled kernels are kept on the disk, and when a kept one is out of date.

numba compiles into a kernel what it calls and the constants that it names, also those of other
files, but looks at its own file alone when it asks whether a kept one still holds: after an update
old code could answer. It also knows a field of a named tuple by its place alone. Here the state of
all these files and tuples is part of the name under which a kernel is kept, and kernels kept of
another state of its file are removed.

Where neither the folder of the package nor one of the user can be written, as for an account
without a home, numba would refuse to compile at all. Kernels are then kept in the folder for
temporary files.
"""

from __future__ import annotations

import ast
import atexit
import hashlib
import os
import re
import shutil
import stat
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from numba.core.caching import FunctionCache, _CacheLocator

_ROOT = Path(__file__).parents[1]
_IMPORT = re.compile(r"^from (\.*)([\w.]*) import (\([^)]*\)|.*)", re.MULTILINE)
_TUPLE = re.compile(r"^class (\w+)\(NamedTuple\b.*:\n((?:(?: .*)?\n)*)", re.MULTILINE)
_FIELD = re.compile(r"^    (\w+): ", re.MULTILINE)
_COMPILES = {"linked.py", "_compile.py"}  # from these come the decorators of kernels


class KernelPlace(_CacheLocator):
    """Where kernels of one file are kept; of the kind that numba calls a cache locator.

    Parameters
    ----------
    chosen : numba cache locator
        What numba itself would choose; it says the folder.
    file : path
        File of the kernel.
    """

    def __init__(self, chosen: Any, file: Path) -> None:
        self._chosen = chosen
        self._state = state_of(file)

    def get_cache_path(self) -> str:
        """Folder."""
        return str(self._chosen.get_cache_path())

    def get_source_stamp(self) -> str:
        """State of the file of the kernel and of what it rests on."""
        return self._state

    def get_disambiguator(self) -> str:
        """Part of the name of the kept files: line of the kernel and state."""
        return f"{self._chosen.get_disambiguator()}-{self._state}"

    @classmethod
    def from_function(cls, function: Callable[..., Any], file: str) -> KernelPlace | None:
        """Place of a kernel of this package; None of others."""
        path = Path(file)
        if not path.is_relative_to(_ROOT) or not path.is_file():
            return None
        found = (kind.from_function(function, file) for kind in _BY_NUMBA)
        chosen = next(filter(None, found), None) or TemporaryPlace(function, path)
        _remove_outdated(Path(chosen.get_cache_path()), path)
        return cls(chosen, path)


class TemporaryPlace:
    """A folder for temporary files as a place of kernels, of the kind that numba chooses.

    Parameters
    ----------
    function : callable
        What is compiled.
    file : path
        Its file.

    Raises
    ------
    OSError
        If there is no folder for temporary files either.
    """

    def __init__(self, function: Callable[..., Any], file: Path) -> None:
        self._folder = _temporary_folder() / file.relative_to(_ROOT).parent
        self._folder.mkdir(parents=True, exist_ok=True)
        self._line = function.__code__.co_firstlineno

    def get_cache_path(self) -> str:
        """Folder."""
        return str(self._folder)

    def get_disambiguator(self) -> str:
        """Line of the kernel."""
        return str(self._line)


@cache
def _temporary_folder() -> Path:
    """The user's own folder: who else could write there could have his code run by us."""
    user = os.getuid() if hasattr(os, "getuid") else ""
    folder = Path(tempfile.gettempdir()) / f"loadflow-kernels-{user}"
    with suppress(FileExistsError):
        folder.mkdir(mode=0o700)
    state = folder.lstat()
    foreign = not stat.S_ISDIR(state.st_mode) or state.st_mode & 0o077
    if user != "" and (foreign or state.st_uid != user):
        folder = Path(tempfile.mkdtemp(prefix="loadflow-kernels-"))  # of this process alone
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


@cache
def state_of(file: Path) -> str:
    """Digest of a file with kernels and of the files of this package that it rests on.

    Those are the files that it imports from, and again those of each of them that has kernels; of
    one without kernels, those that its constants are made of. A kernel need not import the named
    tuples that it is given, so that those of all rooms of these files count.
    """
    found, ahead = {file}, [file]
    while ahead:
        new = set(_rests_on(ahead.pop())) - found
        found |= new
        ahead += new
    told = hashlib.sha256()
    for each in sorted(found):
        told.update(f"{each.relative_to(_ROOT).as_posix()}\n{_text(each)}\n".encode())
    for room in sorted({each.relative_to(_ROOT).parts[0] for each in found}):
        told.update(_tuples_of(room).encode())
    return told.hexdigest()[:12]


@cache
def _text(file: Path) -> str:
    return file.read_text(encoding="utf-8")


@cache
def _rests_on(file: Path) -> tuple[Path, ...]:
    """Files of this package that what is compiled from one needs itself."""
    every = _imports(file)
    kernels = _COMPILES & {each.name for each in every}
    return every if kernels else _imports(file, _compiled_names(file))


@cache
def _imports(file: Path, names: frozenset[str] | None = None) -> tuple[Path, ...]:
    """Files of this package from which one imports at its top, all or only some `names`."""
    found = []
    for dots, module, told in _IMPORT.findall(_text(file)):
        start = file.parents[len(dots) - 1] if dots else _ROOT.parent
        place = start.joinpath(*module.split(".")) if module else start
        known = [
            name
            for name, called in re.findall(r"(\w+)(?: as (\w+))?", told)
            if names is None or (called or name) in names
        ]
        if known:
            found += [place.with_suffix(".py"), *(place / f"{name}.py" for name in known)]
    return tuple(path for path in found if path.is_relative_to(_ROOT) and path.is_file())


def _compiled_names(file: Path) -> frozenset[str]:
    """Names of which the constants of a file are made."""
    told = ast.parse(_text(file)).body
    made = [one.value for one in told if isinstance(one, (ast.Assign, ast.AnnAssign)) and one.value]
    parts = [part for value in made for part in ast.walk(value)]
    return frozenset(part.id for part in parts if isinstance(part, ast.Name))


@cache
def _tuples_of(room: str) -> str:
    """Fields of all named tuples of a room, in their order."""
    texts = [_text(file) for file in sorted((_ROOT / room).rglob("*.py"))]
    found = [each for text in texts for each in _TUPLE.findall(text)]
    return "\n".join(f"{name}: {' '.join(_FIELD.findall(body))}" for name, body in found)


@cache
def _remove_outdated(folder: Path, file: Path) -> None:
    """Remove kernels of other states of a file; another process may have done so."""
    for kept in folder.glob(f"{file.stem}.*.nb[ic]"):
        if f"-{state_of(file)}." not in kept.name:
            with suppress(OSError):
                kept.unlink()


_BY_NUMBA: tuple[Any, ...] = tuple(FunctionCache._impl_class._locator_classes)
FunctionCache._impl_class._locator_classes = [KernelPlace, *_BY_NUMBA]
