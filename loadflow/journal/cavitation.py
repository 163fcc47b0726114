"""Laws of the ruptured film."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from annotated_types import Gt

from loadflow.numerics.fields import require


@dataclass(frozen=True)
class GasMixture:
    """Gas–liquid mixture of Wegmann, (3.41–3.51) of the source [Jonuschies 2015].

    The gap is filled to ``F = p / (p + c)``, p absolute (the source misprints (3.48)).

    Attributes
    ----------
    mixing_constant : float
        c, Pa. Towards 0 the law tends to `MassConserving`.
    """

    mixing_constant: Annotated[float, Gt(0)]

    def __post_init__(self) -> None:
        require(self.mixing_constant > 0, "mixing_constant", self.mixing_constant, "Pa, > 0")


@dataclass(frozen=True)
class Sommerfeld:
    """Full film: pressures below zero are allowed, (3.38) of the source."""


@dataclass(frozen=True)
class Guembel:
    """Full film whose pressure below the cavitation pressure carries nothing, (3.39).

    Attributes
    ----------
    cavitation_pressure : float
        Pa, absolute.
    """

    cavitation_pressure: float = 0.0


@dataclass(frozen=True)
class Reynolds:
    """Swift–Stieber film: p and ∂p/∂n continuous at the rupture, (3.40); not mass conserving.

    Attributes
    ----------
    cavitation_pressure : float
        Pa, absolute.
    """

    cavitation_pressure: float = 0.0


@dataclass(frozen=True)
class MassConserving:
    """Jakobsson–Floberg–Olsson film: either full (F = 1) or at cavitation pressure (F < 1).

    Attributes
    ----------
    cavitation_pressure : float
        Pa, absolute.
    """

    cavitation_pressure: float = 0.0


Cavitation = GasMixture | Sommerfeld | Guembel | Reynolds | MassConserving
