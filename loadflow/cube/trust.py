"""HDF5 files are examined in a process of its own before this one reads them."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import lru_cache
from multiprocessing.util import Finalize
from pathlib import Path
from threading import Lock, Timer
from typing import Any

from loadflow.cube import examine as program
from loadflow.errors import InputError
from loadflow.storage import check_content

PATIENCE = 300.0
"""Seconds after which a file that is still examined is taken as damaged; on most systems, the
process ends itself long before."""

OUT_OF_TIME = -getattr(signal, "SIGPROF", 0) or None
"""How the process returns that a file has kept it for too long."""

RACY = 2.0
"""Seconds since its last change within which a file may change again and keep its time stamp."""


def check_hdf5(path: Path) -> None:
    """Raise unless a file is HDF5 that can be read whole, and can hold the values it declares.

    Parameters
    ----------
    path : pathlib.Path
        File. One that has not changed since it was found sound is not examined again.

    Raises
    ------
    loadflow.errors.InputError
        Empty, truncated, of another kind, a damaged part, one that ends the process that reads it,
        or a dataset that is larger than the file could hold; the message names file and dataset.
    """
    found = path.stat()
    if found.st_size == 0:
        raise InputError(f"{path}: cannot be read as HDF5; the file is empty")
    check_content(path)
    if time.time() - found.st_mtime < RACY:
        _check(path)
    else:
        _check_once(path.absolute(), found.st_ino, found.st_size, found.st_mtime_ns)


@lru_cache(maxsize=10_000)
def _check_once(path: Path, *stamp: int) -> None:
    """Remember files that are sound; what is raised is not kept."""
    _check(path)


def _check(path: Path) -> None:
    with _AT_A_TIME:
        wrong = _EXAMINER.examined(path)
    if wrong:
        raise InputError(f"{path}{wrong}")


class _Examiner:
    """A process that is asked about one file after another; another one where a file ended it."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[str] | None = None
        self._owner = 0
        self._asked = 0

    def examined(self, path: Path) -> str:
        """What is wrong with a file, or nothing."""
        for _ in range(2):
            process = self._started()
            if process is None:  # no interpreter to start, as inside of other programs
                return program.examine(path)
            answer, place = self._answer(process, path)
            if answer is not None:
                return answer
            self.close()
            if process.returncode == OUT_OF_TIME:
                return f", {place}: damaged so that HDF5 finds no end of it"
            if self._asked == 1:  # else a file before may have harmed it: a fresh one is asked
                break
        return f", {place}: damaged so that HDF5 ends the process that reads it"

    def _answer(self, process: subprocess.Popen[str], path: Path) -> tuple[str | None, str]:
        """The answer of the process, None if the question ended it, and where it was then."""
        assert process.stdin is not None
        self._asked += 1
        place: list[str] = ["/"]
        said: Any = None
        with suppress(OSError), _patience(process):
            process.stdin.write(json.dumps(str(path.absolute())) + "\n")
            process.stdin.flush()
            while isinstance(said := _said(process), list):
                place = said
        return said, place[0]

    def _started(self) -> subprocess.Popen[str] | None:
        """The process, started if there is none of this process's own; None if it cannot be."""
        if self._process is not None and self._owner == os.getpid():
            return self._process
        try:
            process = subprocess.Popen(
                [sys.executable, "-P", program.__file__],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
                text=True,
            )
        except OSError:
            return None
        self._process, self._owner, self._asked = process, os.getpid(), 0
        with _patience(process):
            ready = _said(process)
        if ready is None:
            self.close()
        return self._process

    def close(self) -> None:
        """End the process; it would end by itself when nobody is left to ask."""
        process, self._process = self._process, None
        if process is None or self._owner != os.getpid():
            return
        process.kill()
        process.wait()
        for stream in (process.stdin, process.stdout):
            with suppress(OSError):  # what the pipe still holds has nobody to go to
                if stream is not None:
                    stream.close()


def _said(process: subprocess.Popen[str]) -> Any:
    """What the process says next; None if it has ended."""
    assert process.stdout is not None
    line = process.stdout.readline()
    return json.loads(line) if line.endswith("\n") else None


@contextmanager
def _patience(process: subprocess.Popen[str]) -> Iterator[None]:
    """End a process that keeps silence for too long."""
    clock = Timer(PATIENCE, process.kill)
    clock.daemon = True
    clock.start()
    try:
        yield
    finally:
        clock.cancel()


_EXAMINER = _Examiner()
_AT_A_TIME = Lock()
# also where a worker or a signal ends this process without atexit
Finalize(None, _EXAMINER.close, exitpriority=0)
