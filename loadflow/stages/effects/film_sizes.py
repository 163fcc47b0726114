"""Sizes that the effects of a film share: what follows in each answer from one change."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import UNKNOWN, UNSURE, Sizes
from loadflow.stages.effects.situation import Film, Floats
from loadflow.stages.films.turning import always_turns

ANSWERS = ("eccentricity ratio", "minimum film", "maximum pressure", "friction power")


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


def no_bound_at_standstill(scene: Scene) -> float:
    """What a film's effect is over its indicator: no one knows where the shaft also stands.

    There asperities carry it, and what tilt, shell and heat do to their friction and to the
    pressure at their edges follows from no film: up to 1,700 times what is indicated.
    """
    return UNSURE if always_turns(scene) else UNKNOWN
