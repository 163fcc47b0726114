"""How often Python looks for unreachable objects while many are made that stay."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def few_collections() -> Iterator[None]:
    """Look for unreachable objects a hundredth as often.

    What compiles a kernel or reads modules makes many small objects that stay; to go through them
    again and again takes an eighth of the time. What is there already is not gone through.
    """
    thresholds = gc.get_threshold()
    gc.freeze()
    gc.set_threshold(100 * thresholds[0], *thresholds[1:])
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)
        gc.unfreeze()
