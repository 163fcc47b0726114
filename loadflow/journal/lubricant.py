"""The liquid of a film."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import ArrayLike, NDArray

from loadflow.numerics.fields import require
from loadflow.tribology.lubricant_states import ROELANDS_LOG
from loadflow.tribology.lubricants import PRESSURE_LAWS

Array = NDArray[np.float64]

_PLACES, _WEIGHTS = (0.5 * part for part in np.polynomial.legendre.leggauss(10))


@dataclass(frozen=True)
class Lubricant:
    """Liquid of one temperature; its viscosity may rise with pressure.

    Attributes
    ----------
    viscosity : float
        Dynamic viscosity without pressure, Pa s.
    density : float
        Density, kg/m³; only used for the Reynolds number.
    pressure_coefficient : float
        α = d(ln η)/dp without pressure, 1/Pa; 0: one viscosity everywhere.
    pressure_law : {"barus", "roelands"}
        How the viscosity goes on with pressure; has no effect where α is 0.

    Examples
    --------
    >>> from loadflow.journal import Lubricant
    >>> oil = Lubricant(viscosity=0.05, pressure_coefficient=20e-9)
    >>> oil.thickening([0.0, 50e6]).round(3).tolist()  # η(p)/η
    [1.0, 2.718]
    """

    viscosity: Annotated[float, Gt(0)]
    density: Annotated[float, Gt(0)] = 870.0
    pressure_coefficient: Annotated[float, Ge(0), Le(1e-6)] = 0.0
    pressure_law: Literal["barus", "roelands"] = "barus"

    def __post_init__(self) -> None:
        require(self.viscosity > 0, "viscosity", self.viscosity, "must be > 0 Pa s")
        require(self.density > 0, "density", self.density, "must be > 0 kg/m³")
        rise, law = self.pressure_coefficient, self.pressure_law
        require(0 <= rise <= 1e-6, "pressure_coefficient", rise, "1/Pa, 0 … 1e-6")
        require(law in PRESSURE_LAWS, "pressure_law", law, '"barus" or "roelands"')
        thin = self.pressure_law == "roelands" and math.log(self.viscosity) <= ROELANDS_LOG
        allowed = f'Pa s, > {math.exp(ROELANDS_LOG):.2g} with pressure_law = "roelands"'
        require(not thin, "viscosity", self.viscosity, allowed)

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        if self.pressure_coefficient == 0 and self.pressure_law != "barus":
            yield "pressure_law", "pressure_coefficient is 0"

    def thickening(self, pressure: ArrayLike) -> Array:
        """Viscosity at a pressure, Pa, over that without; 1 below 0.

        Examples
        --------
        >>> from loadflow.journal import Lubricant
        >>> Lubricant(0.05, 870.0, 20e-9, "roelands").thickening(50e6).round(3).tolist()
        2.593
        """
        above = np.maximum(np.asarray(pressure, dtype=float), 0.0)
        law = PRESSURE_LAWS[self.pressure_law]
        thick = law(self.viscosity, 0.0, self.pressure_coefficient, 0.0, above)[0]
        return np.asarray(thick / self.viscosity)

    def driving(self, pressure: Array) -> Array:
        """Pressure that drives as much flow at one viscosity, ∫ η/η(p) dp from 0, Pa.

        The flow between two places goes with its difference, whatever the pressure between them
        [Grubin 1949].

        Examples
        --------
        >>> import numpy as np
        >>> from loadflow.journal import Lubricant
        >>> oil = Lubricant(0.05, pressure_coefficient=20e-9)
        >>> oil.driving(np.array([-1e5, 50e6])).round(-3).tolist()  # (1 − exp(−αp))/α
        [-100000.0, 31606000.0]
        """
        found = np.zeros(np.shape(pressure))
        for place, weight in zip(0.5 + _PLACES, _WEIGHTS):
            found += weight / self.thickening(place * pressure)
        return found * pressure
