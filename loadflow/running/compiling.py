"""How long this process compiles kernels, as numba tells it."""

from __future__ import annotations

import time
from collections.abc import Callable
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
