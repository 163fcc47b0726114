"""How long this process compiles kernels, as numba tells it, and how it spends less on it."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Self

from numba.core import event


class Compiling(event.Listener):
    """Seconds that this process spends on compiling kernels while the block runs.

    Parameters
    ----------
    began : callable
        Called when the first kernel is compiled, none where all are on the disk.
    """

    def __init__(self, began: Callable[[], None] = lambda: None) -> None:
        self._began, self._has_begun = began, False
        self.seconds = 0.0
        self._depth = 0
        self._since = 0.0

    def __enter__(self) -> Self:
        event.register("numba:compile", self)
        return self

    def __exit__(self, *_: object) -> None:
        event.unregister("numba:compile", self)

    def on_start(self, event: event.Event) -> None:
        """Begin to count with the outermost kernel: it compiles those that it calls."""
        if self._depth == 0:
            self._since = time.perf_counter()
            if not self._has_begun:
                self._has_begun = True
                self._began()
        self._depth += 1

    def on_end(self, event: event.Event) -> None:
        """Count when the outermost kernel is done."""
        self._depth -= 1
        if self._depth == 0:
            self.seconds += time.perf_counter() - self._since


@contextmanager
def few_collections() -> Iterator[None]:
    """Look for unreachable objects a hundredth as often.

    numba makes millions of small objects that live as long as a kernel is compiled; to go through
    them again and again takes an eighth of the time. What is there already is not gone through.
    """
    thresholds = gc.get_threshold()
    gc.freeze()
    gc.set_threshold(100 * thresholds[0], *thresholds[1:])
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)
        gc.unfreeze()
