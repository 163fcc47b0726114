"""What parts of a piece of work take, for whoever watches it: rooms name parts, others add up."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_watched: ContextVar[dict[str, float] | None] = ContextVar("watched", default=None)


@contextmanager
def watched() -> Iterator[dict[str, float]]:
    """Collect the seconds of parts by name while the block runs.

    Examples
    --------
    >>> from loadflow.numerics.watch import part_of_work, watched
    >>> with watched() as seconds:
    ...     with part_of_work("wind"):
    ...         wind = sum(range(1000))
    >>> list(seconds), seconds["wind"] > 0
    (['wind'], True)
    """
    seconds: dict[str, float] = {}
    before = _watched.set(seconds)
    try:
        yield seconds
    finally:
        _watched.reset(before)


@contextmanager
def part_of_work(name: str) -> Iterator[None]:
    """Name what the block does; nothing happens where nobody watches."""
    seconds, begun = _watched.get(), time.perf_counter()
    try:
        yield
    finally:
        if seconds is not None:
            seconds[name] = seconds.get(name, 0.0) + time.perf_counter() - begun
