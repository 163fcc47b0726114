"""How long this process compiles kernels, as numba tells it."""

from __future__ import annotations

import time
from typing import Self

from numba.core import event


class Compiling(event.Listener):
    """Seconds that this process spends on compiling kernels while the block runs."""

    def __init__(self) -> None:
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
        self._depth += 1

    def on_end(self, event: event.Event) -> None:
        """Count when the outermost kernel is done."""
        self._depth -= 1
        if self._depth == 0:
            self.seconds += time.perf_counter() - self._since
