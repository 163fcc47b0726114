"""The liquid of a film."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from annotated_types import Gt

from loadflow.numerics.fields import require


@dataclass(frozen=True)
class Lubricant:
    """Isoviscous liquid.

    Attributes
    ----------
    viscosity : float
        Dynamic viscosity, Pa s.
    density : float
        Density, kg/m³; only used for the Reynolds number.

    Examples
    --------
    >>> from loadflow.journal import Lubricant
    >>> Lubricant(viscosity=0.05)
    Lubricant(viscosity=0.05, density=870.0)
    """

    viscosity: Annotated[float, Gt(0)]
    density: Annotated[float, Gt(0)] = 870.0

    def __post_init__(self) -> None:
        require(self.viscosity > 0, "viscosity", self.viscosity, "Pa s, > 0")
        require(self.density > 0, "density", self.density, "kg/m³, > 0")
