"""Linear algebra on one thread, for matrices that are too small for more."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, wraps
from typing import ParamSpec, TypeVar

from threadpoolctl import ThreadpoolController

P = ParamSpec("P")
T = TypeVar("T")


@cache
def _libraries() -> ThreadpoolController:
    """Those of NumPy and SciPy; found once, as looking for them takes milliseconds."""
    import scipy.linalg  # noqa: F401

    return ThreadpoolController().select(user_api="blas")


def on_one_thread(solve: Callable[P, T]) -> Callable[P, T]:
    """Let BLAS and LAPACK have one thread while `solve` is at work.

    The band of a film is too small for more: a machine with as much other work as it has cores
    spends up to 28 times the processor time on threads that wait for each other.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.numerics.one_thread import on_one_thread
    >>> on_one_thread(np.linalg.inv)(2.0 * np.eye(2)).tolist()
    [[0.5, 0.0], [0.0, 0.5]]
    """

    @wraps(solve)
    def alone(*args: P.args, **kwargs: P.kwargs) -> T:
        known = _libraries()
        if all(one.num_threads == 1 for one in known.lib_controllers):
            return solve(*args, **kwargs)  # to set and restore takes six times as long as to look
        with known.limit(limits=1):
            return solve(*args, **kwargs)

    return alone
