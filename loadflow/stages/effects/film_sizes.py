"""Sizes that the effects of a film share: what follows in each answer from one change."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

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


def largest(found: Sequence[Sizes]) -> Sizes:
    """Of all bearings, by quantity."""
    return {name: max(sizes[name] for sizes in found) for name in found[0]}
