"""How much an answer moves when a model is replaced by a better one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Difference:
    """How much an answer moves when a model is replaced by a better one.

    `stage` names the model or the effect, `result` is what the answer belongs to, `value` the
    relative change at its largest. `finer` are the changes by each rung beyond, where these were
    solved, too.
    """

    stage: str
    result: str
    quantity: str
    case: str
    against: str
    value: float
    finer: tuple[float, ...] = ()


def differences(
    stage: str,
    result: str,
    where: str,
    against: str,
    ours: Mapping[str, Any],
    *theirs: Mapping[str, Any],
) -> Iterator[Difference]:
    """A difference for each quantity of `ours`, beside the next better model, and on from there."""
    for name in ours:
        values = [one[name] for one in (ours, *theirs)]
        change, *finer = (relative(*pair) for pair in pairwise(values))
        quantity = name.replace("_", " ")
        yield Difference(stage, result, quantity, where, against, change, tuple(finer))


def relative(ours: Any, theirs: Any) -> float:
    """Largest relative change; infinite where only one of the two has an answer."""
    ours, theirs = np.atleast_1d(ours).astype(float), np.atleast_1d(theirs).astype(float)
    known = np.isfinite(ours) & np.isfinite(theirs)
    if not np.array_equal(np.isfinite(ours), known) or not np.array_equal(
        np.isfinite(theirs), known
    ):
        return float("inf")
    scale = np.where(theirs[known] != 0, np.abs(theirs[known]), 1.0)
    return float(np.max(np.abs(ours[known] - theirs[known]) / scale, initial=0.0))
