"""What a path of a shaft keeps of an earlier time, and the rule of steps that reads it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Numbers = TypeVar("Numbers", float, Array)


@dataclass(frozen=True)
class Past:
    """What a step needs of an earlier time: position, unknowns, liquid in the cells.

    `volume` is the liquid outside grooves, m³, `gain` what enters it at this time, m³/s, and
    `gained` what has entered so far, m³; `ahead` is the step that its error allows next, s. Of the
    pads that tilt, `pads` have a film.
    """

    time: float
    position: Array
    u: Array
    liquid: Array
    volume: float
    gain: float
    gained: float = 0.0
    ahead: float = math.inf
    pads: NDArray[np.int64] = field(default_factory=lambda: np.arange(0))


def backward_difference(step: Numbers, before: Numbers) -> tuple[Numbers, Numbers, Numbers]:
    """Weights of the derivative at the end of a step, of second order (BDF2 of variable step).

    Parameters
    ----------
    step, before : float or ndarray
        This step and the one before it, s.

    Returns
    -------
    tuple
        The derivative is rate · f − last · f_last − earlier · f_before, these three in 1/s.

    Examples
    --------
    >>> backward_difference(1.0, 1.0)  # of t² at t = 2: 1.5 · 4 − 2 · 1 = 4
    (1.5, 2.0, -0.5)
    """
    ratio = step / before
    return (
        (1.0 + 2.0 * ratio) / (1.0 + ratio) / step,
        (1.0 + ratio) / step,
        -(ratio**2) / (1.0 + ratio) / step,
    )
