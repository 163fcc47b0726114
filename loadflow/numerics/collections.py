"""How often Python looks for unreachable objects while many are made that stay."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

FEW = 70_000
"""Objects more than before, after which Python looks again; by default it does after 700."""


@contextmanager
def few_collections() -> Iterator[None]:
    """Look for unreachable objects a hundredth as often.

    What compiles a kernel or reads modules makes many small objects that stay; to go through them
    again and again takes an eighth of the time. What is there already is not gone through. Within
    itself it changes nothing.
    """
    if gc.get_freeze_count():
        yield
        return
    thresholds = gc.get_threshold()
    gc.freeze()
    gc.set_threshold(max(FEW, thresholds[0]), *thresholds[1:])
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)
        gc.unfreeze()
