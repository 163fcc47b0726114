"""Phases of a series: standstill, run-up, operation, run-down."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.reduction._series import Floats, finite

HALF_SPEED = 0.5
"""Share of the highest speed; a series that begins or ends slower was cut out of a run-up or
run-down."""


@dataclass(frozen=True)
class Phase:
    """A stretch of a series.

    Attributes
    ----------
    name : str
        ``"standstill"``, ``"run-up"``, ``"operation"``, ``"run-down"``, or ``"part speed"`` for a
        turn that never reaches operation.
    start, stop : int
        Places in the series, `stop` not included.

    Examples
    --------
    >>> from loadflow.reduction import Phase
    >>> Phase("run-up", 2, 5).places
    slice(2, 5, None)
    """

    name: str
    start: int
    stop: int

    @property
    def places(self) -> slice:
        """For indexing: ``force[phase.places]``."""
        return slice(self.start, self.stop)


def phases(speed: ArrayLike, still: float = 0.01, operating: float = 0.9) -> tuple[Phase, ...]:
    """Cut a series into phases, so that each can be reduced by itself.

    Parameters
    ----------
    speed : array_like, shape (n,)
        rad/s; direction does not matter.
    still : float
        Share of the highest speed below which the shaft stands.
    operating : float
        Share of the highest speed that ends a run-up when first reached, and begins a run-down
        when last reached; slower stretches in between belong to operation.

    Returns
    -------
    tuple of Phase
        In order, without gaps.

    Raises
    ------
    InputError
        The series is empty, not one-dimensional or not finite; shares out of order.

    Examples
    --------
    >>> [phase.name for phase in phases([0, 0, 3, 6, 10, 9.5, 10, 4, 0])]
    ['standstill', 'run-up', 'operation', 'run-down', 'standstill']
    """
    magnitude = np.abs(finite("speed", speed))
    if magnitude.ndim != 1 or magnitude.size == 0:
        raise InputError(f"speed has shape {magnitude.shape}; (n,) with n >= 1 is needed")
    if not 0 < still < operating < 1:
        raise InputError(
            f"still = {still}, operating = {operating}; allowed: 0 < still < operating < 1"
        )
    top = float(magnitude.max())
    if top == 0.0:
        return (Phase("standstill", 0, magnitude.size),)
    share = magnitude / top
    stands = share < still
    cuts = [0, *(np.flatnonzero(np.diff(stands)) + 1).tolist(), magnitude.size]
    found: list[Phase] = []
    for start, stop in pairwise(cuts):
        if stands[start]:
            found.append(Phase("standstill", start, stop))
        else:
            found += _turning(share[start:stop], start, operating)
    return tuple(found)


def _turning(share: Floats, offset: int, operating: float) -> list[Phase]:
    """Phases of a stretch in which the shaft turns."""
    fast = np.flatnonzero(share >= operating)
    if fast.size == 0:
        return [Phase("part speed", offset, offset + share.size)]
    begin = int(fast[0]) if share[0] < HALF_SPEED else 0
    end = int(fast[-1]) + 1 if share[-1] < HALF_SPEED else share.size
    limits = (("run-up", 0, begin), ("operation", begin, end), ("run-down", end, share.size))
    return [Phase(name, offset + a, offset + b) for name, a, b in limits if b > a]
