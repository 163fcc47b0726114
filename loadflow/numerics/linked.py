"""How kernels are compiled that other kernels alone call."""

from __future__ import annotations

from typing import Any

LINKED: dict[str, Any] = {"cache": True, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
"""Options of numba for it: ``njit(nogil=True, **LINKED)``.

Such a kernel has no way in from Python, whose making takes a part of the time of compiling.
"""
