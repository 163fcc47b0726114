"""Control and supervision of a turbine. Frozen, checked once when made; SI units and radians."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import pi
from typing import Annotated

from annotated_types import Ge, Gt, Le

from loadflow.errors import InputError

from .checks import NotNegative, Positive, require, require_ranges

_DEGREE = pi / 180


@dataclass(frozen=True)
class Control:
    """Variable-speed, collective-pitch control of the NREL 5 MW kind (generator side).

    Attributes
    ----------
    region_2_gain : float
        Torque over speed² at optimal tip-speed ratio, N m/(rad/s)².
    region_15_start, region_2_start, rated_speed : float
        Speeds at which regions 1½, 2 and 3 begin, rad/s.
    slip : float
        Of the generator in region 2½, share of its synchronous speed.
    rated_mechanical_power : float
        W.
    constant_power : float
        Above rated wind: 1 holds the power, 0 the torque, anything between is a blend of both.
    maximum_torque, maximum_torque_rate : float
        N m; N m/s.
    speed_filter : float
        Corner of the low-pass on the measured speed, Hz.
    proportional_gain, integral_gain : float
        Of the pitch controller at zero pitch, s and −.
    gain_halving_pitch : float
        Pitch at which the gains are halved, rad.
    reference_speed : float
        rad/s.
    pitch_rate, minimum_pitch, maximum_pitch : float
        rad/s; rad.
    scheduled_wind, scheduled_pitch : tuple of float
        Lowest pitch over the wind: m/s, increasing, and rad; linear in the power between the
        points, constant outside. Empty: `minimum_pitch` throughout.
    schedule_filter : float
        Corner of the low-pass on the power, by which the wind is recognised, Hz.
    optimal_tip_speed_ratio : float, optional
        In place of `region_2_gain`, which then follows from the power of the rotor.
    pitch_frequency, pitch_damping : float, optional
        In place of the three gains: frequency (rad/s) and damping ratio of the speed under the
        pitch control; the gains then follow from the power over the pitch.
    thrust_limit : float, optional
        Peak shaving: largest steady thrust, share of that without a limit; the lowest pitch around
        rated wind follows from it.
    individual_gain, individual_limit : float
        Of the individual pitch control: integral gain on the tilt and yaw moment, rad/(N m s), and
        largest deviation from the collective pitch, rad.

    Examples
    --------
    >>> from loadflow.turbines import load_turbine
    >>> round(load_turbine("nrel-5mw").control.pitch_rate, 4)  # rad/s
    0.1396
    """

    region_15_start: Positive
    region_2_start: Positive
    rated_speed: Positive
    slip: Positive
    rated_mechanical_power: Positive
    maximum_torque: Positive
    maximum_torque_rate: Positive
    speed_filter: Positive
    reference_speed: Positive
    pitch_rate: Positive
    minimum_pitch: float
    maximum_pitch: float
    region_2_gain: Positive | None = None
    proportional_gain: NotNegative | None = None
    integral_gain: Positive | None = None
    gain_halving_pitch: Positive | None = None
    optimal_tip_speed_ratio: Positive | None = None
    pitch_frequency: Positive | None = None
    pitch_damping: Positive | None = None
    thrust_limit: Annotated[float, Gt(0), Le(1)] | None = None
    scheduled_wind: tuple[float, ...] = ()
    scheduled_pitch: tuple[float, ...] = ()
    schedule_filter: Positive = 0.033
    constant_power: Annotated[float, Ge(0), Le(1)] = 1.0
    individual_gain: NotNegative = 0.0
    individual_limit: NotNegative = 5.0 * _DEGREE

    def __post_init__(self) -> None:
        speeds = (self.region_15_start, self.region_2_start, self.rated_speed)
        ordered = 0 < speeds[0] < speeds[1] < speeds[2] <= self.reference_speed
        require(
            ordered,
            "Control",
            "speeds",
            (*speeds, self.reference_speed),
            "increasing: region_15_start < region_2_start < rated_speed <= reference_speed",
        )
        require_ranges(self)
        self._check_gains()
        require(
            self.minimum_pitch < self.maximum_pitch,
            "Control",
            "minimum_pitch",
            self.minimum_pitch,
            f"below maximum_pitch = {self.maximum_pitch}",
        )
        wind, pitch = self.scheduled_wind, self.scheduled_pitch
        require(
            all(a < b for a, b in pairwise((0.0, *wind))),
            "Control",
            "scheduled_wind",
            wind,
            "positive and increasing",
        )
        within = all(self.minimum_pitch <= p <= self.maximum_pitch for p in pitch)
        require(
            len(pitch) == len(wind) and within,
            "Control",
            "scheduled_pitch",
            pitch,
            "one value for each scheduled_wind, from minimum_pitch to maximum_pitch",
        )

    def _check_gains(self) -> None:
        """Each gain is stated, or what it follows from."""
        if (self.region_2_gain is None) == (self.optimal_tip_speed_ratio is None):
            raise InputError("Control: region_2_gain or optimal_tip_speed_ratio: give one of both")
        stated = (self.proportional_gain, self.integral_gain, self.gain_halving_pitch)
        wanted = (self.pitch_frequency, self.pitch_damping)
        complete = [None not in group for group in (stated, wanted)]
        if complete.count(True) != 1 or any(x is not None for x in (stated, wanted)[complete[0]]):
            raise InputError(
                "Control: give proportional_gain, integral_gain and gain_halving_pitch, or else "
                "pitch_frequency and pitch_damping"
            )

    @property
    def is_tuned(self) -> bool:
        """Whether all gains are stated, so that none follows from the rotor."""
        return None not in (self.region_2_gain, self.integral_gain) and self.thrust_limit is None


@dataclass(frozen=True)
class Supervision:
    """What the control does around power production; the file of a turbine may leave it out.

    The pitch by state is that of the source (Table 2-1: 70° idling, 90° stopped); rates, delay and
    overspeed are common practice and no property of a published turbine.

    Attributes
    ----------
    idling_pitch, stopped_pitch : float
        rad.
    start_rate, stop_rate : float
        Pitch rate of start and normal stop, rad/s; fault and emergency take `Control.pitch_rate`.
    overspeed : float
        Generator speed that trips the protection, share of `Control.reference_speed`.
    fault_delay : float
        From a fault to the reaction of the control, s.
    brake_speed : float
        Rotor speed below which the brake closes in a stop, rad/s.

    Examples
    --------
    >>> from loadflow.turbines import Supervision
    >>> Supervision(overspeed=1.15).brake_speed
    0.1
    """

    idling_pitch: Positive = 70.0 * _DEGREE
    stopped_pitch: Positive = 90.0 * _DEGREE
    start_rate: Positive = 2.0 * _DEGREE
    stop_rate: Positive = 4.0 * _DEGREE
    overspeed: Annotated[float, Gt(1)] = 1.2
    fault_delay: NotNegative = 0.2
    brake_speed: Positive = 0.1

    def __post_init__(self) -> None:
        require_ranges(self)


COMMON_PRACTICE = Supervision()
"""Of a turbine whose file says nothing of its supervision."""
