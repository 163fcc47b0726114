"""The power of line contacts, F = K δ^(10/9), without a branch or a call in it.

Loops over slices spend their time in δ^(1/9). A logarithm and an exponential keep a loop from
vector units; this root is a guess from the bits of δ and three steps of a series.
"""

from __future__ import annotations

import numpy as np

from loadflow.numerics.linked import njit
from loadflow.rolling.contacts import HEIGHT, NORMAL_R, NORMAL_Z, RADIUS

_GUESS = 5118843878464958409  # bits of δ^(-1/9) where those of δ are 0, put to the middle of ±3 %
_NINTH = 477218588  # 2³²/9


@njit(forceinline=True, nogil=True, error_model="numpy")
def ninth_root(delta):
    """δ^(1/9) to 3e-15 of itself for any δ from 1e-290 to the largest double.

    Below 1e-290 it falls on to 0 in a line with δ (no contact has so small an approach); a negative
    δ counts as 0, inf and NaN stay what they are.

    z = δ^(-1/9): the upper half of the bits of a double is a line in log δ but for 3 %; each step
    z ← z (1 - e)^(-1/9), e = 1 - δ z⁹, in a series to e³, leaves 3e-2, 2e-4, 5e-14 and rounding.
    """
    held = np.float64(max(delta, 1e-290))
    root = np.int64(_GUESS - (held.view(np.int64) >> 32) * _NINTH).view(np.float64)
    for _ in range(3):
        cube = root * root * root
        miss = 1.0 - held * (cube * cube * cube)
        series = 1.0 / 9.0 + miss * (5.0 / 81.0 + miss * (95.0 / 2187.0))
        root = root * (1.0 + miss * series)
    square = root * root
    fourth = square * square
    return max(delta, 0.0) * (fourth * fourth)


@njit(forceinline=True, nogil=True, error_model="numpy")
def lever_of(line):
    """Lever of a contact's normal about the centre of the bearing, m.

    Nothing where both of its parts are equal but for rounding, as on a spherical raceway, which
    tilts freely: their rounding would make a moment.
    """
    one, other = line[HEIGHT] * line[NORMAL_R], line[RADIUS] * line[NORMAL_Z]
    return one - other if abs(one - other) > 1e-14 * abs(one) else 0.0
