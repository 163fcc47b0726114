"""Stopping on a signal: one sentence, within two seconds, and no process left."""

from __future__ import annotations

import os
import signal
import socket
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from multiprocessing import active_children, util
from typing import NoReturn

from loadflow.cli.base import err

PATIENCE = 1.0
"""Time to end in order, s; after it the process is ended where it stands, as kill does."""

_SIGNALS = [
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
]


class Stopped(BaseException):
    """A signal asks to stop; no KeyboardInterrupt, which others answer in their own way."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number

    @property
    def code(self) -> int:
        """Exit code, as shells have it: 130 for SIGINT, 143 for SIGTERM."""
        return 128 + self.number


def tell_stopped(number: int) -> None:
    """Say it, in one sentence."""
    name = signal.Signals(number).name
    err.print(f"stopped by {name}; started again, a run goes on where it was", soft_wrap=True)


def leave(code: int) -> NoReturn:
    """End at once; Python would wait for threads that look after processes already killed."""
    with suppress(Exception):
        # gives back the semaphores of a pool, which no public function does
        util._exit_function()  # type: ignore[attr-defined]
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
    os._exit(code)


@contextmanager
def stoppable() -> Iterator[None]:
    """Raise `Stopped` in the block when a signal comes.

    Python runs its handlers between two of its own instructions only; a kernel may take seconds.
    So another thread waits, too, and ends a process that has not ended in time. What is written is
    whole or not there, whenever that is.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(number: int, _: object) -> None:
        raise Stopped(number)

    before = {number: signal.signal(number, stop) for number in _SIGNALS}
    reader, writer = socket.socketpair()
    writer.setblocking(False)
    earlier = signal.set_wakeup_fd(writer.fileno(), warn_on_full_buffer=False)
    ended = threading.Event()
    threading.Thread(target=_watch, args=(reader, ended), daemon=True).start()
    try:
        yield
    finally:
        ended.set()
        signal.set_wakeup_fd(earlier)
        for number, handler in before.items():
            signal.signal(number, handler)
        writer.close()


def _watch(reader: socket.socket, ended: threading.Event) -> None:
    with reader:
        told = b"\0"
        while told and told[0] not in _SIGNALS:  # other signals wake it as well
            told = reader.recv(1)
    if not told or ended.wait(PATIENCE):
        return
    for child in active_children():
        child.kill()
    err.show_cursor()
    tell_stopped(told[0])
    leave(128 + told[0])
