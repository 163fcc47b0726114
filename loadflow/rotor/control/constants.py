"""Constants of the control as the compiled loop reads them, and the names of its states."""

from __future__ import annotations

from typing import NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.turbines import Turbine
from loadflow.wind.cases import Event

STATES = ("run", "start", "stop", "fault", "emergency stop", "park", "idle")
"""Supervisory states; their places are the numbers in the loop and in the results."""
RUN, START, STOP, FAULT, EMERGENCY, PARK, IDLE = range(len(STATES))

EVENTS: tuple[Event, ...] = get_args(Event)
"""Events of a load case; their places are the numbers in the loop."""


FAULTS: tuple[Event, ...] = ("blade stuck", "pitch runaway", "grid loss")
"""Events that the control answers with the state "fault"."""


class Controller(NamedTuple):
    """Constants of the control, generator side, SI."""

    region_2_gain: float
    region_15_start: float
    region_2_start: float
    rated_speed: float
    synchronous_speed: float
    rated_power: float
    constant_power: float
    maximum_torque: float
    torque_rate: float
    filter_rate: float
    proportional_gain: float
    integral_gain: float
    gain_halving_pitch: float
    reference_speed: float
    pitch_rate: float
    minimum_pitch: float
    maximum_pitch: float
    scheduled_power: NDArray[np.float64]  # one point: no schedule; see `schedule_over_power`
    scheduled_pitch: NDArray[np.float64]
    schedule_rate: float
    start_rate: float
    stop_rate: float
    stopped_pitch: float
    idling_pitch: float
    overspeed: float  # generator speed that trips the protection
    fault_delay: float
    brake_torque: float  # at the rotor
    brake_time: float
    brake_speed: float  # of the rotor
    individual_gain: float  # rad per N m of fixed-frame moment and second; 0: collective pitch only
    individual_limit: float  # largest deviation from the collective pitch


class Schedule(NamedTuple):
    """What happens in one load case."""

    event: int  # place in `EVENTS`
    time: float  # of the event, as the loop counts it, s


UNEVENTFUL = Schedule(EVENTS.index("none"), np.inf)


def controller(turbine: Turbine, individual_pitch: bool = False) -> Controller:
    """Constants of the turbine's control.

    Raises
    ------
    InputError
        Individual pitch control is wanted, but the turbine states no gain for it; gains that
        follow from the rotor are not found yet (`loadflow.rotor.tuning.tuned`).
    """
    if individual_pitch and turbine.control.individual_gain == 0:
        raise InputError(f"individual_pitch = True: {turbine.name} has no control.individual_gain")
    gains = ("region_2_gain", "proportional_gain", "integral_gain", "gain_halving_pitch")
    stated = {name: getattr(turbine.control, name) for name in gains}
    if None in stated.values():
        raise InputError(f"{turbine.name}: control gains that follow from the rotor are not found")
    c, s, drivetrain = turbine.control, turbine.supervision, turbine.drivetrain
    made = Controller(
        **stated,
        region_15_start=c.region_15_start,
        region_2_start=c.region_2_start,
        rated_speed=c.rated_speed,
        synchronous_speed=c.rated_speed / (1 + c.slip),
        rated_power=c.rated_mechanical_power,
        constant_power=c.constant_power,
        maximum_torque=c.maximum_torque,
        torque_rate=c.maximum_torque_rate,
        filter_rate=2 * np.pi * c.speed_filter,
        reference_speed=c.reference_speed,
        pitch_rate=c.pitch_rate,
        minimum_pitch=c.minimum_pitch,
        maximum_pitch=c.maximum_pitch,
        scheduled_power=np.zeros(1),
        scheduled_pitch=np.array([c.minimum_pitch]),
        schedule_rate=2 * np.pi * c.schedule_filter,
        start_rate=s.start_rate,
        stop_rate=s.stop_rate,
        stopped_pitch=s.stopped_pitch,
        idling_pitch=s.idling_pitch,
        overspeed=s.overspeed * c.reference_speed,
        fault_delay=s.fault_delay,
        brake_torque=drivetrain.brake_torque * drivetrain.gear_ratio,
        brake_time=drivetrain.brake_time,
        brake_speed=s.brake_speed,
        individual_gain=c.individual_gain if individual_pitch else 0.0,
        individual_limit=c.individual_limit,
    )
    # a turbine that states whole numbers is not to have the loop compiled once more for these
    return Controller._make(one if isinstance(one, np.ndarray) else float(one) for one in made)
