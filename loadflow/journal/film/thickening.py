"""Viscosity that rises with pressure, in the state of the cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import DP, P
from loadflow.journal.lubricant import Lubricant

Array = NDArray[np.float64]

_RISE = 2.0  # of the logarithm of the viscosity in a Newton step
_LEAST = 0.01  # share of a step that is always gone


class Thickening:
    """A liquid whose viscosity rises with pressure, in the discrete film.

    The flow between two cells goes with the difference of ∫ η/η(p) dp, so that this, in place of
    the pressure, drives it: balance, Newton matrix and all that follows from it stay what they are.

    Parameters
    ----------
    liquid : Lubricant
        With its viscosity without pressure.
    edges : tuple of float
        Pressures at the bearing ends and the line, Pa, and the fill there.

    Attributes
    ----------
    edges : tuple of float
        The same, what drives the flow in place of the pressures.
    pressure, slope : array (nx, nz)
        Pressure and its derivative by the unknowns, as the law gave them last.
    """

    def __init__(self, liquid: Lubricant, edges: tuple[float, float, float]) -> None:
        self.liquid = liquid
        end, line = (float(liquid.driving(np.array(pressure))) for pressure in edges[:2])
        self.edges = end, line, edges[2]
        self.pressure = self.slope = np.zeros(0)

    def apply(self, state: Array) -> None:
        """Let what drives the flow know the viscosity, in the `state` that the law filled."""
        self.pressure, self.slope = state[P].copy(), state[DP].copy()
        state[P] = self.liquid.driving(self.pressure)
        state[DP] /= self.liquid.thickening(self.pressure)

    def share(self, u: Array, fall: Array) -> float:
        """Share of a Newton step, in which unknowns `u` fall by `fall`, that may be gone.

        Pressure may rise by what makes the liquid e² times as thick: beyond where it is to end it
        has next to no flow, and no step would lead back.
        """
        rising = fall < 0.0
        most = _RISE / self.liquid.pressure_coefficient + self.pressure - u
        share = float((most[rising] / -fall[rising]).min(initial=1.0))
        return max(_LEAST, share)
