"""Sizes that the effects of a film share: what follows in each answer from one change."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from loadflow.stages.effects.effect import Sizes
from loadflow.stages.effects.situation import Film, Floats


def worst(film: Film, eccentricity: Floats, pressure: Floats, power: float = 0.0) -> Sizes:
    """Largest relative changes that follow from one of the eccentricity ratio."""
    ratio = np.minimum(film.eccentricity_ratio, 0.95)
    gap = np.minimum(eccentricity * ratio / (1 - ratio), 1.0)
    return {
        "eccentricity ratio": float(np.nanmax(eccentricity)),
        "minimum film": float(np.nanmax(gap)),
        "maximum pressure": float(np.nanmax(pressure)),
        "friction power": power,
    }


def asperity_share(film: ArrayLike, roughness: float) -> Floats:
    """Share of the load that asperities take, by film / roughness: none above Λ = 4.

    [Greenwood and Tripp 1970], in the fit (4 − Λ)^6.804 of the pressure, against all of it at 0.
    """
    parameter = np.nan_to_num(np.asarray(film) / roughness, nan=0.0)
    return np.asarray((np.clip(4.0 - parameter, 0.0, 4.0) / 4.0) ** 6.804)


def largest(found: Sequence[Sizes]) -> Sizes:
    """Of all bearings, by quantity."""
    return {name: max(sizes[name] for sizes in found) for name in found[0]}
