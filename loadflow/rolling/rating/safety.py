"""Static safety from contact forces and pressures, [Ritzer 2018] ch. 2.3 and 4.4."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError

Array = NDArray[np.float64]

BALL_PRESSURE = 4.2e9  # ISO 76: permanent deformation of 1e-4 of the ball diameter, 58 HRC and more
ROLLER_PRESSURE = 4.0e9


def hardness_factor(vickers: float) -> float:
    """Factor f_s = 1.5 (HV/800)² ≤ 1 on the allowable pressure, (2.8)."""
    if not 0 < vickers <= 1500:
        raise InputError(f"hardness: must lie in 0 … 1500 HV, got {vickers}")
    return min(1.5 * (vickers / 800) ** 2, 1.0)


def ratio(allowed: ArrayLike, actual: ArrayLike) -> Array:
    """Allowed over actual, infinite where nothing acts; (4.1), (4.2) are printed inverted."""
    top, bottom = np.broadcast_arrays(np.asarray(allowed, float), np.asarray(actual, float))
    return np.divide(top, bottom, out=np.full(bottom.shape, np.inf), where=bottom > 0)
