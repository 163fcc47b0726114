"""Arrays into which the compiled loop writes at each step, made once for all steps."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .lanes import packs
from .machine import Machine

Array = NDArray[np.float64]


class Room(NamedTuple):
    """What a step writes and reads again; ``n`` sections, ``k`` modes, ``h`` of the frame."""

    shape: Array  # (blades, n, k, 4), see `turned_shapes`
    motion: Array  # (blades, n, 8), see `deflection`
    force: Array  # (blades, n, 4)
    answer: Array  # (blades, k, 1 + h), see `blade_equations`, as the next four
    couple: Array  # (k, 1 + h)
    swing: Array  # (k, 6)
    reach: Array  # (h, 6)
    push: Array  # (h, 6)
    modal: Array  # (k, k)
    q_ahead: Array  # (k,)
    v_ahead: Array  # (k,)
    bend: Array  # (k,)
    ahead: Array  # (h,)
    rate_ahead: Array  # (h,)
    new: Array  # (h,)
    inertia: Array  # (h, h)
    load: Array  # (h,)
    system: Array  # (h, h), see `frame_acceleration`, as the next three
    fixed: Array  # (h, h)
    right: Array  # (h, 1)
    found: Array  # (h, 1)
    point: Array  # (n, 3), see `torsion`, as the next
    torque: Array  # (n,)
    drift: Array  # (6,)
    gravity: Array  # (3,)
    jerk: Array  # (6,)
    total: Array  # (6,)
    own: Array  # (6,)
    pitch: Array  # (blades,), imbalance included
    turned: Array  # (4, blades), sine and cosine of azimuth and pitch
    packs: Array  # (packs, SIZE_OF_PACK), see `lanes`
    blade: NDArray[np.int64]  # of each lane
    section: NDArray[np.int64]


def room_for(m: Machine) -> Room:
    """Room for the steps of a machine."""
    b, n, k, h = m.blades, m.radius.size, m.modal_mass.shape[0], m.frame.carries.size
    frame, modes = (h, h), (k, k)
    sizes = (
        (b, n, k, 4), (b, n, 8), (b, n, 4), (b, k, 1 + h), (k, 1 + h), (k, 6), (h, 6), (h, 6),
        modes, k, k, k, h, h, h, frame, h, frame, frame, (h, 1), (h, 1), (n, 3), n, 6, 3, 6, 6, 6,
        b, (4, b),
    )  # fmt: skip
    return Room._make((*(np.zeros(size) for size in sizes), *packs(m)))
