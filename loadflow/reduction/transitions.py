"""Markov matrix: from which class of load to which the turning points go."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.reduction._series import Floats, finite
from loadflow.reduction.quasistatic import class_edges


@dataclass(frozen=True)
class MarkovMatrix:
    """Transitions between classes of load.

    Attributes
    ----------
    edges : ndarray, shape (l + 1,)
        Class edges, in the unit of the series.
    counts : ndarray of int, shape (l, l)
        Turning points that go from class i (row) to class j (column): rises above the diagonal,
        falls below it, nothing on it.

    Examples
    --------
    >>> from loadflow.reduction import markov_matrix
    >>> markov_matrix([0.5, 2.5, 1.5, 2.5, 0.5], classes=[0, 1, 2, 3]).edges.tolist()
    [0.0, 1.0, 2.0, 3.0]
    """

    edges: Floats
    counts: NDArray[np.int64]


def markov_matrix(x: ArrayLike, classes: int | ArrayLike = 64) -> MarkovMatrix:
    """Count how the turning points of a series pass from class to class.

    The series is first brought to its classes, so that what moves within one class counts for
    nothing (the width of a class is the hysteresis).

    Parameters
    ----------
    x : array_like, shape (n,)
        Series.
    classes : int or array_like
        Number of equal classes over the range of the series, or ascending edges.

    Returns
    -------
    MarkovMatrix

    Raises
    ------
    InputError
        The series is empty, not one-dimensional or not finite; a value lies outside the edges.

    Examples
    --------
    >>> markov_matrix([0.5, 2.5, 1.5, 2.5, 0.5], classes=[0, 1, 2, 3]).counts.tolist()
    [[0, 0, 1], [0, 0, 1], [1, 1, 0]]
    """
    series = finite("x", x)
    if series.ndim != 1 or series.size == 0:
        raise InputError(f"x has shape {series.shape}; (n,) with n >= 1 is needed")
    edges = class_edges(series, classes)
    place = np.searchsorted(edges, series, side="right") - 1
    place = place[np.concatenate(([True], np.diff(place) != 0))]
    direction = np.sign(np.diff(place))
    turns = np.concatenate(([True], np.diff(direction) != 0, [True]))[: place.size]
    point = place[turns]
    size = edges.size - 1
    counts = np.bincount(point[:-1] * size + point[1:], minlength=size * size)
    return MarkovMatrix(edges, counts.reshape(size, size))
