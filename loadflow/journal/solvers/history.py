"""What a path of a shaft keeps of an earlier time."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


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
