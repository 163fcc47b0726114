"""Processor time of work without what is compiled in it, and an end to work that is late.

Kernels are compiled when a combination of effects is met for the first time, for seconds, and read
from disk ever after: counted, that would make a draw late once and never again.
"""

from __future__ import annotations

import signal
import time
from typing import Any

from numba.core import event


class Late(BaseException):
    """A piece of work has taken longer than it may."""


class Clock(event.Listener):  # type: ignore[misc]
    """Stopped while kernels are compiled; ends the work after `cap` seconds (0: never).

    Examples
    --------
    >>> with Clock(cap=60.0) as clock:
    ...     total = sum(range(1000))
    >>> clock.seconds < 60.0
    True
    """

    def __init__(self, cap: float = 0.0) -> None:
        self.cap, self.seconds = cap, 0.0
        self._depth, self._begun = 0, 0.0

    def __enter__(self) -> Clock:
        signal.signal(signal.SIGPROF, _end)
        event.register("numba:compile", self)
        self.seconds, self._depth = 0.0, 0
        self._go()
        return self

    def __exit__(self, *error: object) -> None:
        if not self._depth:
            self._stop()
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        event.unregister("numba:compile", self)

    def on_start(self, event: Any) -> None:
        """Stop before the outermost of kernels that are compiled."""
        if not self._depth:
            self._stop()
        self._depth += 1

    def on_end(self, event: Any) -> None:
        """Go on after it."""
        self._depth -= 1
        if not self._depth:
            self._go()

    def _stop(self) -> None:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        self.seconds += time.process_time() - self._begun

    def _go(self) -> None:
        self._begun = time.process_time()
        if self.cap:
            signal.setitimer(signal.ITIMER_PROF, max(self.cap - self.seconds, 1e-3))


def _end(number: int, frame: Any) -> None:
    raise Late
