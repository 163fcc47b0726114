"""How kernels are compiled: those that other kernels alone call, and those that never allocate."""

from __future__ import annotations

from contextlib import ExitStack
from functools import partial
from typing import Any

from numba import njit
from numba.core import event

from loadflow.numerics import kept_kernels  # noqa: F401 - before a kernel is made
from loadflow.numerics.collections import few_collections

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
    """Python looks for unreachable objects less often while numba compiles, for 9 % less time.

    One kernel is compiled within another, all under one lock; the outermost counts.
    """

    def __init__(self) -> None:
        self._depth, self._few = 0, ExitStack()

    def on_start(self, event: Any) -> None:
        if self._depth == 0:
            self._few.enter_context(few_collections())
        self._depth += 1

    def on_end(self, event: Any) -> None:
        self._depth -= 1
        if self._depth == 0:
            self._few.close()


event.register("numba:compile", _FewerCollections())
