"""How kernels are compiled: those that other kernels alone call, and those that never allocate."""

from __future__ import annotations

import gc
from functools import partial
from typing import Any

from numba import njit
from numba.core import event

from loadflow.numerics import kept_kernels  # noqa: F401 - before a kernel is made

LINKED: dict[str, Any] = {"cache": True, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
"""Options of numba for it: ``njit(nogil=True, **LINKED)``.

Such a kernel has no way in from Python, whose making takes a part of the time of compiling. The
cache knows a function by its name, not by these options: no function has both of `LINKED` and
another way that is cached.
"""

bare = partial(njit, nogil=True, error_model="numpy", _nrt=False)
"""Of a kernel that allocates nothing: ``bare(cache=True)``.

It counts no references to arrays, whose code took a quarter of the time of compiling; a division by
zero gives infinity or NaN.
"""

contracted = partial(bare, fastmath={"contract"})
"""The same, where a product and a sum may be rounded once, in one instruction."""


class _FewerCollections(event.Listener):
    """While numba compiles, Python looks less often for objects that it may forget.

    Most that numba makes of a kernel stay until it is compiled: to look through them took a tenth
    of the time, most of it saved by a sixth more memory. One kernel is compiled within another, all
    under one lock.
    """

    WHILE_COMPILING = (50_000, 20, 20)

    def __init__(self) -> None:
        self._kept: list[tuple[int, int, int]] = []

    def on_start(self, event: Any) -> None:
        self._kept.append(gc.get_threshold())
        gc.set_threshold(*self.WHILE_COMPILING)

    def on_end(self, event: Any) -> None:
        gc.set_threshold(*self._kept.pop())


event.register("numba:compile", _FewerCollections())
