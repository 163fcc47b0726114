"""Viscosity of a reduced film with effects that rises with pressure, as its loops have it."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.lubricant import Lubricant

Array = NDArray[np.float64]

_LAST, _STEP = 60.0, 0.02  # of pressure times coefficient: end of the table, and distance
_PLACES, _WEIGHTS = (0.5 * part for part in np.polynomial.legendre.leggauss(6))


class Thickening(NamedTuple):
    """What drives the flow of a liquid that pressure thickens: ∫ η/η(p) dp in place of p.

    Attributes
    ----------
    on : bool
        Whether it does.
    rise : float
        Pressure that thickens it e-fold near none, Pa.
    first, step : float
        Pressures of the table: first one, and distance, Pa.
    table : array (2, n)
        What drives the flow, Pa, that at the bearing ends being their pressure, and its derivative.
    """

    on: bool
    rise: float
    first: float
    step: float
    table: Array


NO_THICKENING = Thickening(False, np.inf, 0.0, 1.0, np.zeros((2, 2)))


@lru_cache(maxsize=8)
def thickening_of(liquid: Lubricant, edge: float) -> Thickening:
    """That of a `liquid` between bearing ends at the pressure `edge`, Pa.

    Below no pressure and behind the last one the table goes straight on.
    """
    if liquid.pressure_coefficient == 0.0:
        return NO_THICKENING
    rise = 1.0 / liquid.pressure_coefficient
    step, pressure = _STEP * rise, rise * np.arange(0.0, _LAST, _STEP)
    within = pressure[:-1, None] + step * (0.5 + _PLACES)
    driving = np.append(0.0, np.cumsum(step * (_WEIGHTS / liquid.thickening(within)).sum(axis=1)))
    driving += edge - float(liquid.driving(np.array(edge)))
    return Thickening(True, rise, 0.0, step, np.stack([driving, 1.0 / liquid.thickening(pressure)]))


def less_thickening(liquid: Lubricant, share: float) -> Lubricant:
    """The `liquid` with a share of its pressure coefficient."""
    return replace(liquid, pressure_coefficient=share * liquid.pressure_coefficient)
