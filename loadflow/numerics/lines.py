"""Straight lines between known values, for many columns at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def on_lines(where: ArrayLike, known: Array, values: Array, period: float | None = None) -> Array:
    """`np.interp` of each column.

    Parameters
    ----------
    where : array_like (...)
        Places asked for.
    known : array (n,)
        Places of the values, rising; in any order where there is a `period`.
    values : array (n, ...)
        Of as many columns as there are.
    period : float, optional
        Of the places.

    Returns
    -------
    array
        Of the shape of `where`, and of the columns. Beyond the ends the last values hold.

    Examples
    --------
    >>> on_lines([0.5, 2.0], np.array([0.0, 1.0]), np.array([[0.0, 4.0], [2.0, 4.0]])).tolist()
    [[1.0, 4.0], [2.0, 4.0]]
    """
    places, columns = np.asarray(where, float), values.reshape(len(values), -1).T
    found = np.stack([np.interp(places, known, one, period=period) for one in columns], axis=-1)
    return found.reshape(*places.shape, *values.shape[1:])
