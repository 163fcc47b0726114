"""Wind over time as the compiled loop reads it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.wind.field import Field

Array = NDArray[np.float64]
_NO_BOX = np.zeros((0, 1, 1), dtype=np.float32)


class Inflow(NamedTuple):
    """Wind at the rotor: hub values at each step, shear, and a box of turbulence.

    The wind at height Z and lateral place y is ``speed (Z/Z_hub)^shear + vertical z +
    horizontal y`` in the given direction, plus the fluctuation of the box.
    """

    speed: Array  # (steps,), m/s
    direction: Array  # (steps,), rad, positive to the left
    vertical: Array  # (steps,), linear shear, 1/s
    horizontal: Array  # (steps,), 1/s
    shear: float
    box_step: float
    box_radius: Array
    u: NDArray[np.float32]
    v: NDArray[np.float32]
    w: NDArray[np.float32]


def steady_inflow(
    wind_speed: float, steps: int, shear: float, direction: float = 0.0, box: Field | None = None
) -> Inflow:
    """Constant hub wind with a power-law profile, and turbulence if a box is given."""
    zero = np.zeros(steps)
    return Inflow(
        speed=np.full(steps, float(wind_speed)),
        direction=np.full(steps, float(direction)),
        vertical=zero,
        horizontal=zero,
        shear=float(shear),
        box_step=1.0 if box is None else float(box.time[1] - box.time[0]),
        box_radius=np.array([0.0, 1.0]) if box is None else box.radius,
        u=_NO_BOX if box is None else box.u,
        v=_NO_BOX if box is None or box.v is None else box.v,
        w=_NO_BOX if box is None or box.w is None else box.w,
    )
