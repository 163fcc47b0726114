"""How often Python looks for unreachable objects while many are made that stay."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

FEW = 70_000
"""Objects more than before, after which Python looks again; by default after 700 or 2000."""


@contextmanager
def few_collections() -> Iterator[None]:
    """Look for unreachable objects by far less often.

    What compiles a kernel or reads modules makes many small objects that stay; to go through them
    again and again takes an eighth of the time. What is there already is not gone through. Within
    itself, and where a program looks as seldom already, it changes nothing.
    """
    thresholds = gc.get_threshold()
    if thresholds[0] >= FEW:
        yield
        return
    gc.freeze()
    gc.set_threshold(FEW, *thresholds[1:])
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)
        gc.unfreeze()
