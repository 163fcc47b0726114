"""Bearings that swing instead of turning: pitch and yaw bearings ([Ritzer 2018] ch. 2.5, DG03)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields, check_one_of, shown
from loadflow.reduction import rainflow
from loadflow.rolling.rating.life import oscillating_capacity, rating_life, spectrum_load

if TYPE_CHECKING:
    from loadflow.rolling.geometry import RollingGeometry

Array = NDArray[np.float64]
MountedOn = Literal["rigid", "pitch", "yaw, tubular tower", "yaw, four-leg tower"]

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

IdlePart = Literal["first row", "second row", "first seal", "second seal", "grease"]
IdleTorque = Annotated[float, Ge(0)] | IdlePart | tuple[IdlePart, ...]


def idle_torque_of(stated: float | str | Sequence[str]) -> float:
    """Torque without load, N m: a number, or the sum of `IDLE_TORQUES` by name.

    Raises
    ------
    InputError
        An unknown name, or less than 0, as grease alone has.

    Examples
    --------
    >>> from loadflow.rolling.rating.oscillation import idle_torque_of
    >>> idle_torque_of(["first row", "first seal"])
    4970.0
    """
    if isinstance(stated, int | float):
        torque = stated
    else:
        parts = [stated] if isinstance(stated, str) else stated
        for part in parts:
            check_one_of("idle_torque", part, IDLE_TORQUES)
        torque = sum((IDLE_TORQUES[part] for part in parts), 0.0)
    if not torque >= 0:
        raise InputError(f"idle_torque: must be ≥ 0, got {shown(torque)}")
    return torque


class _Swinging:
    """What every kind of oscillation has: what the bearing is mounted on, and its idle torque."""

    mounting: MountedOn
    idle_torque: IdleTorque

    def __post_init__(self) -> None:
        # names stand for their sum from here on
        object.__setattr__(self, "idle_torque", idle_torque_of(self.idle_torque))
        check_fields(self)
        check_one_of("mounting", self.mounting, MOUNTING_FACTORS)


@dataclass(frozen=True)
class Oscillation(_Swinging):
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
        Friction without load, N m. Given as the name of one of `IDLE_TORQUES`, those of one
        bearing, or as several of them, it is their sum.

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
    mounting: MountedOn = "rigid"
    idle_torque: IdleTorque = 0.0
    kind: Literal["stated"] = "stated"

    of_pitch: ClassVar[bool] = False

    def during(self, time: ArrayLike, angle: ArrayLike) -> Oscillation | None:
        """How it swings in a series: as is stated."""
        return self

    def speed(self, time: ArrayLike, angle: ArrayLike) -> Array:
        """Size of its speed at the samples of a series, rad/s: the mean one."""
        return np.full(np.shape(time), self.mean_speed)

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
        exponent = float(bearing.life_exponent)
        mean = spectrum_load(load, weight, exponent)
        return self.mounting_factor * float(rating_life(self.capacity(bearing), mean, exponent))

    def hours(self, life: float) -> float:
        """Hours of a life in millions of oscillations."""
        return float(np.multiply(life, 1e6) / (3600.0 * self.frequency))


@dataclass(frozen=True)
class PitchMotion(_Swinging):
    """How a pitch bearing swings: as the pitch of each series does.

    Attributes
    ----------
    threshold : float
        Smallest range of a cycle of the pitch, there and back, that counts, rad.
    mounting, idle_torque
        As in `Oscillation`.

    Raises
    ------
    InputError
        A value out of its range, or an unknown mounting.

    Examples
    --------
    Five cycles of ±2° in 50 s:

    >>> import numpy as np
    >>> from loadflow.rolling import PitchMotion
    >>> time = np.linspace(0.0, 50.0, 2001)
    >>> swing = PitchMotion().during(time, np.radians(2.0) * np.cos(0.2 * np.pi * time))
    >>> round(float(np.degrees(swing.amplitude)), 1), round(swing.frequency, 2)
    (2.0, 0.1)
    """

    threshold: Annotated[float, Gt(0), Le(0.1)] = math.radians(0.1)
    mounting: MountedOn = "pitch"
    idle_torque: IdleTorque = 0.0
    kind: Literal["pitch"] = "pitch"

    of_pitch: ClassVar[bool] = True

    def during(self, time: ArrayLike, angle: ArrayLike) -> Oscillation | None:
        """How it swings in a series, by its rainflow cycles; None where the pitch stands.

        Their number and mean range count, as the damage of small oscillations goes with their
        number times their range ([Ritzer 2018] (4.5) with x = 1).

        Parameters
        ----------
        time, angle : array_like, shape (n,)
            s; pitch, rad.
        """
        cycles = rainflow(angle)
        count = np.where(cycles.range >= self.threshold, cycles.count, 0.0)
        number = float(count.sum())
        if number == 0:
            return None
        amplitude = float(count @ cycles.range) / number / 2
        # half cycles at the ends have been passed once
        length = float(np.ptp(np.asarray(time, dtype=float)))
        return Oscillation(amplitude, number / length, self.mounting, self.idle_torque)

    def speed(self, time: ArrayLike, angle: ArrayLike) -> Array:
        """Size of the pitch rate at the samples of a series, rad/s."""
        rate = np.gradient(np.asarray(angle, dtype=float), np.asarray(time, dtype=float))
        return np.asarray(np.abs(rate))
