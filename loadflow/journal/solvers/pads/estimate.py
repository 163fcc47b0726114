"""Where a shaft floats on tilting pads: where Newton starts.

The forces of pads without moment have a potential, which is convex as each falls with its gap: the
shaft lies where it balances the load.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from loadflow.journal.film.film import DiscreteFilm
    from loadflow.journal.film.gap.shaped import ShapedGap

Array = NDArray[np.float64]

_STEPS, _ENOUGH = 60, 1e-4  # of Newton's method for the shaft; load that may be missing
_KEPT = 0.4  # share of each gap that a step leaves
_SOFT = 1e-6  # stiffness across a single pad, over that along it
_LEAST = 1e-9  # the same where no pad carries, loads over clearance


def on_pads(film: DiscreteFilm, gap: ShapedGap, load: Array) -> Array | None:
    """Where the pads carry `load` (2,), N, by their curve: (2,), clearances; None: nowhere found.

    The shaft is taken as aligned.
    """
    unit = abs(film.wedge) / 6.0 * gap.bore.width * gap.bore.radius
    if unit == 0.0:
        return None
    curve, toward = gap.pad_curve(film.speed), gap.pivots
    wanted, place = load / unit, np.zeros(2)
    size = math.hypot(*wanted)
    for _ in range(_STEPS):
        gaps = 1.0 - toward @ place
        if gaps.min() <= 0.0:  # to rounding: a load that no film carries
            return None
        forces, slopes = curve.force(gaps)
        missing = wanted - forces @ toward
        if math.hypot(*missing) <= _ENOUGH * max(size, float(forces.max())):
            return place
        stiffness = (toward.T * slopes) @ toward
        soft = _SOFT * float(np.trace(stiffness)) + _LEAST * size
        step = np.linalg.solve(stiffness + soft * np.eye(2), missing)
        closing = float(((toward @ step) / gaps).max())
        place = place + step * min(1.0, (1.0 - _KEPT) / closing if closing > 0 else 1.0)
    return None
