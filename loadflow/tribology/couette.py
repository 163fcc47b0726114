"""Heat of a sheared film in closed form: what a film solver with an energy equation must meet.

A film between parallel walls, one of which moves with speed U, without pressure; the viscosity
falls as η = η₀ exp(-β ΔT). Two limits: all heat goes with the oil (adiabatic), or all of it
through the walls (conducting).

References
----------
Nahme, R.: Beiträge zur hydrodynamischen Theorie der Lagerreibung. Ing.-Archiv, 1940.
Gavis, J.; Laurence, R. L., 1968: Viscous heating in plane and circular flow between moving
surfaces. Ind. Eng. Chem. Fundamentals.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from annotated_types import Ge
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields

Array = NDArray[np.float64]


def adiabatic_rise(
    distance: ArrayLike,
    *,
    viscosity: float,
    speed: float,
    gap: float,
    heat_capacity: float,
    steepness: float = 0.0,
) -> Array:
    """Temperature rise of a sheared film whose heat all goes with the oil, K.

    ρc_p (U h/2) dT/dx = η U²/h with T constant across the film:
    ΔT = ln(1 + 2 β η₀ U x/(ρc_p h²))/β.

    Parameters
    ----------
    distance : array_like
        x along the motion from where the viscosity is `viscosity`, m.
    viscosity : float
        η₀, Pa s.
    speed : float
        U of the moving wall, m/s.
    gap : float
        h, m.
    heat_capacity : float
        ρc_p, J/(m³ K).
    steepness : float
        β = -d(ln η)/dT, 1/K; 0 for constant viscosity.

    Returns
    -------
    ndarray
        K.

    Raises
    ------
    InputError
        If an argument is negative, or gap or heat capacity are 0.

    Examples
    --------
    >>> oil = dict(viscosity=0.0277, speed=10.471976, gap=1e-4, heat_capacity=860 * 1951.8)
    >>> round(float(adiabatic_rise(0.1, steepness=0.0341, **oil)), 6)
    3.267283
    >>> round(float(adiabatic_rise(0.1, **oil)), 6)
    3.456246
    """
    x = np.asarray(distance, float)
    for name, value in (("viscosity", viscosity), ("speed", speed), ("steepness", steepness)):
        if not (math.isfinite(value) and value >= 0):
            raise InputError(f"{name}: must be finite and ≥ 0, got {value}")
    for name, value in (("gap", gap), ("heat_capacity", heat_capacity)):
        if not (math.isfinite(value) and value > 0):
            raise InputError(f"{name}: must be finite and > 0, got {value}")
    if not np.all(x >= 0):
        raise InputError(f"distance: must be ≥ 0 m, got {x}")
    constant = 2 * viscosity * speed * x / (heat_capacity * gap * gap)
    return constant if steepness == 0 else np.log1p(steepness * constant) / steepness


def nahme_number(viscosity: float, speed: float, conductivity: float, steepness: float) -> float:
    """Na = β η₀ U²/k: heating by shear against what the walls take, times the steepness.

    Parameters
    ----------
    viscosity : float
        η₀ at the temperature of the walls, Pa s.
    speed : float
        U, m/s.
    conductivity : float
        k of the oil, W/(m K).
    steepness : float
        β = -d(ln η)/dT, 1/K.

    Returns
    -------
    float
        Na.

    Raises
    ------
    InputError
        The conductivity is not positive.

    Examples
    --------
    >>> round(nahme_number(0.0277, 21.0, 0.149, 0.0341), 2)
    2.8
    """
    if not conductivity > 0:
        raise InputError(f"conductivity: must be > 0 W/(m K), got {conductivity}")
    return steepness * viscosity * speed * speed / conductivity


@dataclass(frozen=True)
class ConductingCouette:
    """Sheared film whose heat all goes through the walls [Nahme 1940, Gavis and Laurence 1968].

    The walls are at T₀; or only the far one is, and the near one is insulated. For given wall
    speeds there is one solution for each Na.

    Attributes
    ----------
    nahme : float
        Na = β η₀ U²/k (`nahme_number`).
    insulated : bool
        Whether the near wall, y = 0, is insulated.

    Raises
    ------
    InputError
        If Na is negative or not finite.

    Examples
    --------
    >>> film = ConductingCouette(1.0)
    >>> round(film.largest_rise, 6), round(film.stress_ratio, 6)
    (0.117783, 0.924196)
    >>> film = ConductingCouette(1.0, insulated=True)
    >>> round(film.largest_rise, 6), round(film.stress_ratio, 6)
    (0.405465, 0.760346)
    """

    nahme: Annotated[float, Ge(0)]
    insulated: bool = False

    def __post_init__(self) -> None:
        check_fields(self)

    @property
    def largest_rise(self) -> float:
        """β ΔT in the middle, or at the insulated wall."""
        return math.log1p(self._excess)

    @property
    def stress_ratio(self) -> float:
        """Shear stress τ h/(η₀ U) over that of the cold film."""
        a = self._excess
        if a < 1e-12:
            return 1.0
        return math.asinh(math.sqrt(a)) / math.sqrt(a * (1 + a))

    def rise(self, share: ArrayLike) -> Array:
        """β ΔT at a share y/h of the gap from the near wall."""
        return self.largest_rise - 2 * np.log(np.cosh(self._argument(share)))

    def velocity(self, share: ArrayLike) -> Array:
        """Velocity u/U at a share y/h of the gap; the near wall is at rest."""
        end = math.asinh(math.sqrt(self._excess))
        if end == 0:
            return _share(share)
        part = np.tanh(self._argument(share)) / math.tanh(end)
        return part if self.insulated else (1 + part) / 2

    @property
    def _excess(self) -> float:
        """exp(β ΔT) - 1 where the film is warmest."""
        return self.nahme / (2 if self.insulated else 8)

    def _argument(self, share: ArrayLike) -> Array:
        """Argument of the profile cosh⁻², from 0 where the film is warmest."""
        end = math.asinh(math.sqrt(self._excess))
        y = _share(share)
        return end * (y if self.insulated else 2 * y - 1)


def _share(share: ArrayLike) -> Array:
    y = np.asarray(share, float)
    if not np.all((y >= 0) & (y <= 1)):
        raise InputError(f"share: must lie in 0 … 1 of the gap, got {y}")
    return y
