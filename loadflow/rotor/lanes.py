"""Sections of all blades side by side, for loops that work on several at once.

A compiler turns a loop into vector instructions if it can prove that what is written is not what is
read in the next turn. It can where everything lies in one array, row after row of a length that it
knows: `LANES` sections, of whichever blade. Row X of a pack of sections is ``pack[X + lane]``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .machine import Machine

Array = NDArray[np.float64]

LANES = 16
"""Sections in a pack, whole vectors of any processor; the last pack is filled up with its last
section, of no weight. (Short rows of `loadflow.numerics.lanes` are told to the compiler as vectors;
in loops as long as these it finds them by itself.)"""

# what a section is: place and form, sine and cosine of its twist, share in the mean wind
RADIUS, CHORD, TWIST, TWIST_S, TWIST_C, WIDTH, WEIGHT = range(0, 7 * LANES, LANES)
# what its blade does: sine and cosine of the azimuth and of the pitch, pitch
AZIMUTH_S, AZIMUTH_C, PITCH_S, PITCH_C, PITCH = range(7 * LANES, 12 * LANES, LANES)
# its motion, the columns of `deflection`
BENT, SWEPT, BENT_RATE, SWEPT_RATE, SLOPE, PULL, TURNED, TWISTED = range(
    12 * LANES, 20 * LANES, LANES
)
# where it is: along the shaft, outward, in the sense of rotation; left and up; in the ground frame
ALONG, OUT, AROUND, Y, Z, GROUND_X, GROUND_Z = range(20 * LANES, 27 * LANES, LANES)
# place in the box of turbulence: time, distance from its centre, angle in steps of the box
WHEN, RING, SPOKE = range(27 * LANES, 30 * LANES, LANES)
# wind: that of the profile, and the fluctuation
PROFILE, GUST_U, GUST_V, GUST_W = range(30 * LANES, 34 * LANES, LANES)
# flow without induction: across and along the plane, its size and angle; slope of the blade
ACROSS, ALONG_PLANE, SIZE, ANGLE, BEND_S, BEND_C = range(34 * LANES, 40 * LANES, LANES)
INDUCTION, SWIRL = range(40 * LANES, 42 * LANES, LANES)
# flow at the section: speed, direction, angle of attack, that at three quarters of the chord, turn
SPEED, SINE, COSINE, ATTACK, REAR, SPIN = range(42 * LANES, 48 * LANES, LANES)
LIFT, DRAG, MOMENT = range(48 * LANES, 51 * LANES, LANES)
FORCE = 51 * LANES  # downwind, outward, in the sense of rotation; couple
SIZE_OF_PACK = 55 * LANES


def packs(m: Machine) -> tuple[Array, NDArray[np.int64], NDArray[np.int64]]:
    """Packs (count, SIZE_OF_PACK) of the sections of a machine; blade and section of each lane."""
    n = m.radius.size
    total = m.blades * n
    count = -(-total // LANES)
    lane = np.minimum(np.arange(count * LANES), total - 1)
    blade, section = np.divmod(lane, n)
    pack = np.zeros((count, SIZE_OF_PACK))
    for row, values in (
        (RADIUS, m.radius),
        (CHORD, m.chord),
        (TWIST, m.twist),
        (TWIST_S, np.sin(m.twist)),
        (TWIST_C, np.cos(m.twist)),
        (WIDTH, m.width),
    ):
        pack[:, row : row + LANES] = values[section].reshape(count, LANES)
    weight = np.where(np.arange(count * LANES) < total, 1 / total, 0.0)
    pack[:, WEIGHT : WEIGHT + LANES] = weight.reshape(count, LANES)
    return pack, blade, section
