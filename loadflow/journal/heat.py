"""What a user states about the heat of a film: its oil, and how it is cooled. No solver."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from annotated_types import Ge, Gt
from numpy.typing import ArrayLike, NDArray

from loadflow.journal.lubricant import Lubricant
from loadflow.numerics.fields import check_fields, require
from loadflow.tribology import Oil, lubricant

Array = NDArray[np.float64]

HOTTEST = 423.15
"""Largest temperature of the film that is looked for, K; oils and white metal end before."""


@dataclass(frozen=True)
class Heat:
    """Oil and cooling of a bearing.

    Attributes
    ----------
    oil : str or Oil
        Name of an oil of `loadflow.tribology.lubricant_names`, or an oil.
    inlet_temperature : float
        Of the oil that enters the film, K.
    heat_capacity : float
        c_p of the oil, J/(kg K).
    transfer : float
        K, heat that passes from the film through the housing for each kelvin above ambient, W/K;
        0: all leaves with the oil.
    ambient_temperature : float
        K.

    Examples
    --------
    >>> from loadflow.journal import Heat
    >>> heat = Heat(oil="iso-vg-220", inlet_temperature=313.15)
    >>> bool(heat.lubricant(333.15).viscosity < heat.lubricant(313.15).viscosity)
    True
    """

    oil: str | Oil = "mineral-vg-320"
    inlet_temperature: Annotated[float, Gt(200)] = 313.15
    heat_capacity: Annotated[float, Gt(0)] = 2000.0
    transfer: Annotated[float, Ge(0)] = 0.0
    ambient_temperature: Annotated[float, Gt(200)] = 293.15

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("inlet_temperature", "ambient_temperature"):
            value = getattr(self, name)
            require(value < HOTTEST, name, value, f"K, < {HOTTEST}")
        self.liquid  # noqa: B018  a name that is not known is told here

    @property
    def liquid(self) -> Oil:
        """The oil."""
        return lubricant(self.oil) if isinstance(self.oil, str) else self.oil

    def lubricant(self, temperature: float) -> Lubricant:
        """The oil of a film at `temperature`, K."""
        oil = self.liquid
        return Lubricant(float(oil.viscosity(temperature)), float(oil.density(temperature)))

    def temperature(self, friction_power: ArrayLike, side_flow: ArrayLike, at: ArrayLike) -> Array:
        """Effective temperature (K) that friction (W) and flow (m³/s) of a film at `at` ask for."""
        carried = 2.0 * self.liquid.density(at) * self.heat_capacity * np.asarray(side_flow)
        # a film that stands still neither warms its oil nor moves it
        standing = (carried == 0.0) & (self.transfer == 0.0) & (np.asarray(friction_power) == 0.0)
        carried = np.where(standing, 1.0, carried)
        lost = carried + self.transfer
        gained = carried * self.inlet_temperature + self.transfer * self.ambient_temperature
        with np.errstate(divide="ignore"):  # no flow, no transfer: it never stops to warm
            return np.asarray((np.asarray(friction_power) + gained) / lost)
