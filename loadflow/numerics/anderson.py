"""Fixed points x = g(x) by Anderson's acceleration."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Anderson:
    """Next guess of a fixed point from the last few, by least squares on their residuals.

    Walker & Ni 2011, type II. One function value a step, no derivatives; near the fixed point of a
    linear map of rank r it needs r + 1 steps.

    Parameters
    ----------
    depth : int
        Earlier guesses that count.

    Examples
    --------
    >>> method, x = Anderson(depth=2), np.array([1.0, 0.0])
    >>> matrix = np.array([[0.9, 0.2], [0.0, -0.8]])
    >>> for _ in range(4):
    ...     x = method.next(x, matrix @ x + 1.0)
    >>> bool(np.allclose(x, matrix @ x + 1.0))
    True
    """

    def __init__(self, depth: int) -> None:
        self.depth = depth
        self._guesses: list[Array] = []
        self._values: list[Array] = []

    def next(self, guess: Array, value: Array) -> Array:
        """Guess that follows `guess`, whose function value is `value`."""
        self._guesses = [*self._guesses[-self.depth :], guess]
        self._values = [*self._values[-self.depth :], value]
        if len(self._values) == 1:
            return value
        values = np.array(self._values)
        residuals = values - np.array(self._guesses)
        steps = np.diff(residuals, axis=0)
        weights = np.linalg.lstsq(steps.T, residuals[-1], rcond=1e-12)[0]
        return np.asarray(value - weights @ np.diff(values, axis=0), dtype=np.float64)

    def forget(self) -> None:
        """Start afresh, keeping nothing."""
        self._guesses, self._values = [], []
