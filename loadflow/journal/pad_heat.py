"""What a user states about the heat of a row of pads: its oil, and how much is carried on."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, Literal

import numpy as np
from annotated_types import Ge, Gt, Lt
from numpy.typing import ArrayLike, NDArray

from loadflow.journal.heat import HOTTEST, Entering

Array = NDArray[np.float64]

_STEEP = 0.7  # d ln(friction)/d ln(viscosity) under a load, about: only speeds the search up


@dataclass(frozen=True)
class PadHeat(Entering):
    """Oil of a row of pads: one temperature of its films by their heat balance.

    All friction leaves with the oil. A pad warms what enters it by D = P/(ρ c_p Q), P and Q those
    of all pads. Of the hot oil that leaves at its end, the share `carry_over` enters the next pad
    and fresh oil makes up the rest; what leaves at the sides is gone. With s, the share of the oil
    that leaves at the end, it enters a pad λ s D/(1 − λ s) warmer than it is fed, and the film is
    half of D warmer still. Each side of a collar has a temperature of its own.

    Attributes
    ----------
    oil : str, Oil or ExponentialOil
        Name of an oil of `loadflow.tribology.lubricant_names`, or an oil.
    inlet_temperature : float
        Of the oil that the pads are fed with, K.
    heat_capacity : float
        c_p of the oil, J/(kg K).
    carry_over : float
        λ; measured 0.4 … 0.8 [Mitsui, Hori and Tanaka 1983].

    Examples
    --------
    >>> from loadflow.journal import Film, Guembel, PadHeat, ThrustBearing
    >>> bearing = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
    >>> film = Film(None, Guembel(), grid=(20, 10), heat=PadHeat("iso-vg-68"))
    >>> found = bearing.equilibrium(1e6, 10.0, film)
    >>> bool(found.temperature > found.inlet_temperature > 313.15)
    True
    """

    heat_capacity: Annotated[float, Gt(0)] = 2000.0
    carry_over: Annotated[float, Ge(0), Lt(1)] = 0.8
    kind: Literal["pads"] = "pads"

    over_area: ClassVar[bool] = False
    of_pads: ClassVar[bool] = True

    @property
    def volume_heat(self) -> float:
        """ρ c_p of the oil as it enters, J/(m³ K)."""
        return float(self.liquid.density(self.inlet_temperature)) * self.heat_capacity

    def scaled(self, factor: float) -> PadHeat:
        """The same with an oil so many times as thick."""
        return replace(self, oil=self.liquid.scaled(factor))

    def warming(self, friction_power: ArrayLike, flow: ArrayLike) -> Array:
        """D, K: by how much friction (W) warms what flows through a pad, m³/s of all pads."""
        return np.asarray(friction_power) / (self.volume_heat * np.asarray(flow))

    def carried(self, flow: ArrayLike, side_flow: ArrayLike) -> Array:
        """λ s/(1 − λ s): by how much of D the oil enters a pad warmer than it is fed."""
        kept = self.carry_over * (1.0 - np.asarray(side_flow) / np.asarray(flow))
        return np.asarray(kept / (1.0 - kept))

    def nearer(self, temperature: ArrayLike, asked: ArrayLike) -> Array:
        """Temperature between one that was tried and that which its films ask for, K.

        Warmer oil is thinner and warms less: Newton with the slope of that.
        """
        warm, asked = np.asarray(temperature), np.asarray(asked)
        rise = np.maximum(asked - self.inlet_temperature, 0.0)
        slope = 1.0 + _STEEP * self.liquid.steepness(warm) * rise
        return np.asarray(np.minimum(warm + (asked - warm) / slope, HOTTEST))
