"""Bearings that swing instead of turning: pitch and yaw bearings ([Ritzer 2018] ch. 2.5, DG03)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields
from loadflow.rolling.rating.life import oscillating_capacity, rating_life, spectrum_load

if TYPE_CHECKING:
    from loadflow.rolling.geometry import RollingGeometry

Mounting = Literal["rigid", "pitch", "yaw, tubular tower", "yaw, four-leg tower"]

MOUNTING_FACTORS: dict[str, float] = {
    "rigid": 1.0,
    "pitch": 0.85,
    "yaw, tubular tower": 0.85,
    "yaw, four-leg tower": 0.25,
}
"""Factor a₄ on the life, of what a bearing is mounted on, Table 2.1 of [Ritzer 2018] (DG03)."""

IDLE_TORQUES = {
    "first row": 3080.0,
    "second row": 1180.0,
    "first seal": 1890.0,
    "second seal": 2190.0,
    "grease": -780.0,
}
"""Torque without load of the blade bearing of [Ritzer 2018], App. C1, by what is added, N m."""


@dataclass(frozen=True)
class Oscillation:
    """How a bearing swings, and on what it is mounted.

    Attributes
    ----------
    amplitude : float
        From the middle to one end, rad.
    frequency : float
        Whole oscillations, there and back, 1/s, in the mean over time.
    mounting : str
        One of `MOUNTING_FACTORS`: deformation of what carries the bearing shortens its life.
    idle_torque : float
        Friction without load, N m; `IDLE_TORQUES` are those of one bearing.

    Raises
    ------
    InputError
        A value out of its range, or an unknown mounting.

    Examples
    --------
    >>> import math
    >>> from loadflow.rolling import Oscillation
    >>> pitch = Oscillation(amplitude=math.radians(2.5), frequency=0.05, mounting="pitch")
    >>> pitch.mounting_factor
    0.85
    """

    amplitude: Annotated[float, Gt(0), Le(2 * math.pi)]
    frequency: Annotated[float, Gt(0)]
    mounting: Mounting = "rigid"
    idle_torque: Annotated[float, Ge(0)] = 0.0

    def __post_init__(self) -> None:
        check_fields(self)
        if self.mounting not in MOUNTING_FACTORS:
            known = ", ".join(MOUNTING_FACTORS)
            raise InputError(f"mounting: must be one of {known}, got {self.mounting!r}")

    @property
    def mounting_factor(self) -> float:
        """a₄."""
        return MOUNTING_FACTORS[self.mounting]

    @property
    def mean_speed(self) -> float:
        """Mean size of the speed, rad/s."""
        return 4.0 * self.amplitude * self.frequency

    def capacity(self, bearing: RollingGeometry) -> float:
        """Dynamic capacity under this oscillation, N, DG03."""
        sized: Any = bearing
        kind: Literal["ball", "roller"] = "ball" if sized.element == "ball" else "roller"
        elements = sized.balls if kind == "ball" else sized.rollers
        return float(
            oscillating_capacity(
                sized.rated_capacity, self.amplitude, "half", elements=elements, gamma=sized.gamma,
                kind=kind,
            )
        )  # fmt: skip

    def life(self, bearing: RollingGeometry, load: ArrayLike, weight: ArrayLike) -> float:
        """Rating life under a load spectrum, a₄ (C_osc/P)^p, millions of oscillations.

        Parameters
        ----------
        bearing : RollingGeometry
            With its capacity and life exponent.
        load : array_like, shape (n,)
            Equivalent loads, N.
        weight : array_like, shape (n,)
            Their shares of time.
        """
        exponent = float(bearing.life_exponent)  # type: ignore[attr-defined]
        mean = spectrum_load(load, weight, exponent)
        return self.mounting_factor * float(rating_life(self.capacity(bearing), mean, exponent))

    def hours(self, life: float) -> float:
        """Hours of a life in millions of oscillations."""
        return float(np.multiply(life, 1e6) / (3600.0 * self.frequency))
