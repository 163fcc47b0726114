"""Position of the shaft by Butenschön's closed form: where Newton starts."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.tribology.film import butenschoen

Array = NDArray[np.float64]

NEAR = 0.3  # share of the narrowest gap that the estimate may move for a warm start

_RATIOS = np.concatenate([np.linspace(0.0, 0.9, 91)[1:], 1.0 - np.geomspace(0.099, 1e-4, 60)])


def closed_form_position(
    width_ratio: float, number: ArrayLike, force: Array, speed: ArrayLike, ruptures: bool
) -> Array:
    """Position (…, 2), in clearances, under `force` (…, 2) at Sommerfeld numbers `number` (…).

    Parameters
    ----------
    width_ratio : float
        B/D.
    number, speed : array_like (…)
        So, ≥ 0, and the speed, of which only the sign counts.
    ruptures : bool
        Whether the film ruptures; a full one has an attitude of a right angle.
    """
    numbers, attitudes = _closed_form(width_ratio)
    wanted = np.asarray(number)
    ratio = np.interp(wanted, numbers, _RATIOS) * np.minimum(wanted / numbers[0], 1.0)
    attitude = np.interp(ratio, _RATIOS, attitudes) if ruptures else 0.5 * np.pi
    turn = np.arctan2(force[..., 1], force[..., 0]) + np.sign(speed) * attitude
    return ratio[..., None] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)


@lru_cache(maxsize=32)
def _closed_form(width_ratio: float) -> tuple[Array, Array]:
    """So and attitude over `_RATIOS`, the width kept within the validity of the closed form."""
    return butenschoen(_RATIOS, min(max(width_ratio, 0.125), 1.0))
