"""Load series → bins weighted by revolutions: far fewer equilibria for the same life."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.rolling.equilibrium import broadcast_loads

Array = NDArray[np.float64]


def bin_loads(
    force: ArrayLike, moment: ArrayLike, revolutions: ArrayLike, bins: int = 12
) -> tuple[Array, Array, Array]:
    """Gather a load series in bins of all five components together.

    Each component is cut into `bins` equal parts between its extremes; what falls into one cell of
    the five becomes one load, the mean of its samples weighted by their revolutions.

    Parameters
    ----------
    force : array_like, shape (n, 3)
        N.
    moment : array_like, shape (n, 2)
        N m.
    revolutions : array_like, shape (n,)
        Revolutions of each sample, or any weight in their proportion.
    bins : int
        Parts of each component.

    Returns
    -------
    force, moment, revolutions : ndarray
        Of the cells that are met, (m, 3), (m, 2), (m,).

    Raises
    ------
    InputError
        If shapes do not match, weights are negative or all zero, or `bins` is below 1.

    Examples
    --------
    >>> f, m, turns = bin_loads([[1, 0, 0], [1.1, 0, 0], [9, 0, 0]], [[0, 0]], [1, 1, 2], bins=2)
    >>> f[:, 0].tolist(), turns.tolist()
    ([1.05, 9.0], [2.0, 2.0])
    """
    if bins < 1:
        raise InputError(f"bins: must be at least 1, got {bins}")
    f, m = broadcast_loads(force, moment)
    load = np.concatenate([f, m], axis=-1)
    turns = np.asarray(revolutions, float)
    if load.ndim != 2 or turns.shape != load.shape[:1]:
        raise InputError(f"revolutions: must have shape ({len(load)},), got {turns.shape}")
    if not np.all(turns >= 0) or not turns.any():
        raise InputError("revolutions: must be ≥ 0 with a positive sum")
    low, high = load.min(axis=0), load.max(axis=0)
    width = np.where(high > low, (high - low) / bins, 1.0)
    place = np.minimum((load - low) // width, bins - 1).astype(int)
    cell = np.ravel_multi_index(tuple(place.T), (bins,) * 5)
    _, member = np.unique(cell[turns > 0], return_inverse=True)
    load, turns = load[turns > 0], turns[turns > 0]
    weight = np.asarray(np.bincount(member, turns), float)
    mean = np.stack([np.bincount(member, turns * c) / weight for c in load.T], axis=1)
    return mean[:, :3], mean[:, 3:], weight
