"""Factors of turbulent flow in a gap, compiled; see `loadflow.journal.turbulence`."""

from __future__ import annotations

import numpy as np

from loadflow.numerics.linked import njit

ALONG, ACROSS, SHEAR = range(3)
_SIZES = (0.0136 / 12.0, 0.0043 / 12.0, 0.0012)
_POWERS = (0.90, 0.96, 0.94)


@njit(cache=True, nogil=True, error_model="numpy")
def factor(h, regime, which):
    """Factor of resistance `which` at a gap h, clearances, and its derivative by h."""
    reynolds, onset, begin, end = regime
    if not (h > 0.0 and reynolds > 0.0):
        return 1.0, 0.0
    root = np.sqrt(h)
    beyond = onset * h * root - begin  # the local critical number falls with the root of the gap
    if beyond <= 0.0 and begin > 0.0:
        return 1.0, 0.0
    share, rise = 1.0, 0.0
    if beyond < end - begin:
        t = beyond / (end - begin)
        share = t * t * (3.0 - 2.0 * t)
        rise = 6.0 * t * (1.0 - t) / (end - begin) * 1.5 * onset * root
    power = _POWERS[which]
    more = _SIZES[which] * (reynolds * h) ** power
    return 1.0 + share * more, (rise + share * power / h) * more
