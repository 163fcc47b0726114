"""The change of frame from the load cube to each bearing room.

The cube's frame does not rotate: x along the shaft, downwind; z up; y to the left looking
downwind. The rotor turns y toward z.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


FILM_AXES = (("z", -1.0), ("y", 1.0))
"""Axis of the cube, and sign, of the first and the second axis of a film."""


def to_film(vector: Floats) -> Floats:
    """Turn (..., x, y, z) of the cube into the plane of the film: (first, second) = (−z, +y).

    The first axis points down, the way the weight acts; the rotor turns it toward the second.
    This is the frame of [Jonuschies 2015].
    """
    return np.stack([-vector[..., 2], vector[..., 1]], axis=-1)


def from_film(vector: ArrayLike) -> Floats:
    """Turn (..., first, second) of the plane of the film into (..., x, y, z) of the cube."""
    first, second = np.moveaxis(np.asarray(vector, dtype=float), -1, 0)
    return np.stack([np.zeros_like(first), second, -first], axis=-1)


def slope_of(moved: Floats) -> Floats:
    """Slope of a shaft, (..., 3), rad, that moves by `moved` (..., 3) with each unit of its length.

    What moves along y turns about z, what moves along z about −y; both in the cube.
    """
    return np.stack([np.zeros_like(moved[..., 0]), -moved[..., 2], moved[..., 1]], axis=-1)


def moved_by(slope: Floats) -> Floats:
    """How far a shaft of a slope (..., 3), rad, moves with each unit of its length; the inverse."""
    return np.stack([np.zeros_like(slope[..., 0]), slope[..., 2], -slope[..., 1]], axis=-1)


def to_rolling(vector: Floats) -> Floats:
    """Turn (..., x, y, z) of the cube into (y, z, x): the bearing axis comes last."""
    return vector[..., [1, 2, 0]]
