"""Compiled control: supervisory states, generator torque, pitch, shaft brake.

The supervision moves one number, the floor below which the speed control may not pitch: down to
fine pitch in a start, up to feather in a stop. So speed control, start and stop are one law without
a jump between them.
"""

import numpy as np

from loadflow.numerics.linked import LINKED, njit

from .. import slots as k
from .._compile import part
from .constants import EMERGENCY, EVENTS, FAULT, IDLE, PARK, RUN, START, STOP

_E_STUCK = EVENTS.index("blade stuck")
_E_RUNAWAY = EVENTS.index("pitch runaway")
_E_GRID = EVENTS.index("grid loss")
_E_START = EVENTS.index("start")
_E_STOP = EVENTS.index("stop")
_E_EMERGENCY = EVENTS.index("emergency stop")
_E_STUCK_PARKED = EVENTS.index("parked, blade stuck")
_REGION_3_PITCH = np.radians(1.0)


@njit(cache=True, nogil=True)
def control_torque(c, speed, surplus):
    """Generator torque of the speed, N m (regions 1 to 3; 3 is held while the `surplus` of the
    pitch above the lowest one exceeds 1°).
    """
    held = (1 - c.constant_power) * c.rated_power / c.reference_speed
    if speed >= c.rated_speed or surplus >= _REGION_3_PITCH:
        torque = held + c.constant_power * c.rated_power / max(speed, 0.01 * c.rated_speed)
    elif speed <= c.region_15_start:
        torque = 0.0
    elif speed < c.region_2_start:
        top = c.region_2_gain * c.region_2_start**2
        share = (speed - c.region_15_start) / (c.region_2_start - c.region_15_start)
        torque = top * share
    else:
        top = held + c.constant_power * c.rated_power / c.rated_speed
        slope = top / (c.rated_speed - c.synchronous_speed)
        # region 2 follows the parabola until the line of region 2 1/2 crosses it
        torque = max(c.region_2_gain * speed**2, slope * (speed - c.synchronous_speed))
        torque = min(torque, top)
    return min(torque, c.maximum_torque)


@part
def supervise(c, schedule, state, generator_speed, time, dt):
    """Move the state machine and the floor of the pitch on by one step."""
    mode = state[k.S_STATE]
    running = mode in (RUN, START)
    if state[k.S_HAPPENED] == 0.0 and time >= schedule.time:
        state[k.S_HAPPENED] = 1.0
        if schedule.event == _E_START:
            mode = START
        elif schedule.event == _E_STOP:
            mode = STOP
        elif schedule.event == _E_EMERGENCY:
            mode = EMERGENCY
    noticed = state[k.S_HAPPENED] == 1.0 and time >= schedule.time + c.fault_delay
    faulty = schedule.event == _E_STUCK or schedule.event == _E_GRID
    if running and noticed and faulty:
        mode = FAULT
    if (running or mode == STOP) and generator_speed > c.overspeed:
        mode = FAULT
    if mode != state[k.S_STATE]:
        state[k.S_STATE] = mode
        state[k.S_FLOOR] = state[k.S_PITCH]

    if mode == RUN:
        return
    if mode == START:
        state[k.S_FLOOR] = max(state[k.S_FLOOR] - c.start_rate * dt, c.minimum_pitch)
        # the ramp is done, or the speed control has taken over from it
        if state[k.S_FLOOR] == c.minimum_pitch or state[k.S_PITCH] > state[k.S_FLOOR] + 0.02:
            state[k.S_STATE] = RUN
            state[k.S_FLOOR] = c.minimum_pitch
    elif mode == IDLE:
        state[k.S_FLOOR] = c.idling_pitch
    else:
        rate = c.stop_rate if mode == STOP else c.pitch_rate
        state[k.S_FLOOR] = min(state[k.S_FLOOR] + rate * dt, c.stopped_pitch)
        if state[k.S_SPEED] == 0.0 and state[k.S_FLOOR] == c.stopped_pitch:
            state[k.S_STATE] = PARK


@part
def between(x, places, values):
    """Linear interpolation, held beyond the ends; `numpy.interp` takes far longer to compile."""
    last = places.size - 1
    if last == 0 or x <= places[0]:
        return values[0]
    if x >= places[last]:
        return values[last]
    j = 0
    while j < last - 1 and x >= places[j + 1]:
        j += 1
    slope = (values[j + 1] - values[j]) / (places[j + 1] - places[j])
    return slope * (x - places[j]) + values[j]


@part
def schedule_pitch(c, state, dt):
    """Move the lowest pitch of power production on: by the schedule over the power."""
    share = 1 - np.exp(-dt * c.schedule_rate)
    power = state[k.S_FILTERED] * state[k.S_TORQUE]
    state[k.S_POWER] += share * (power - state[k.S_POWER])
    state[k.S_LOWEST] = c.minimum_pitch
    if state[k.S_STATE] == RUN:
        state[k.S_LOWEST] = between(state[k.S_POWER], c.scheduled_power, c.scheduled_pitch)


@part
def generator(c, schedule, state, dt):
    """Generator torque of the next step."""
    mode = state[k.S_STATE]
    lost = schedule.event == _E_GRID and state[k.S_HAPPENED] == 1.0
    if lost or mode >= EMERGENCY:
        state[k.S_TORQUE] = 0.0
        return
    # only a turbine that runs holds its power: the others pitch for other reasons than power
    surplus = state[k.S_PITCH] - state[k.S_LOWEST] if mode == RUN else 0.0
    change = control_torque(c, state[k.S_FILTERED], surplus) - state[k.S_TORQUE]
    state[k.S_TORQUE] += min(max(change, -c.torque_rate * dt), c.torque_rate * dt)


@part
def collective_pitch(c, schedule, state, dt):
    """Collective pitch of the next step: proportional and integral on speed, above the floor."""
    pitch, floor = state[k.S_PITCH], max(state[k.S_FLOOR], state[k.S_LOWEST])
    gain = 1 / (1 + pitch / c.gain_halving_pitch)
    error = state[k.S_FILTERED] - c.reference_speed
    span = gain * c.integral_gain
    integral = state[k.S_INTEGRAL] + error * dt
    if state[k.S_STATE] == START and error < 0:
        integral = 0.0  # nothing to hold yet: the ramp leads, however slow the integrator
    state[k.S_INTEGRAL] = min(max(integral, floor / span), c.maximum_pitch / span)
    wanted = gain * c.proportional_gain * error + span * state[k.S_INTEGRAL]
    wanted = min(max(wanted, floor), c.maximum_pitch)
    runs_away = schedule.event == _E_RUNAWAY and state[k.S_HAPPENED] == 1.0
    if runs_away and state[k.S_STATE] == RUN:
        wanted = c.minimum_pitch
    change = wanted - pitch
    state[k.S_PITCH] += min(max(change, -c.pitch_rate * dt), c.pitch_rate * dt)


@part
def individual_pitch(c, state, moment_y, moment_z, dt):
    """Integrate the tilt and yaw moments of the rotor into two pitch angles that counter them."""
    state[k.S_TILT] += c.individual_gain * moment_y * dt
    state[k.S_YAW] += c.individual_gain * moment_z * dt
    # no deviation at fine pitch, where it would cost power
    room = max(state[k.S_PITCH] - state[k.S_LOWEST], 0.0)
    limit = min(c.individual_limit, room) if state[k.S_STATE] == RUN else 0.0
    size = np.sqrt(state[k.S_TILT] ** 2 + state[k.S_YAW] ** 2)
    if size > limit:
        state[k.S_TILT] *= limit / size
        state[k.S_YAW] *= limit / size


@part
def move_blades(c, schedule, state, pitch, dt):
    """Let the actuator of each blade follow; that of the last blade may be stuck."""
    stuck = (
        schedule.event == _E_STUCK and state[k.S_HAPPENED] == 1.0
    ) or schedule.event == _E_STUCK_PARKED
    blades = pitch.size - 1 if stuck else pitch.size
    for b in range(blades):
        wanted = state[k.S_PITCH]
        if c.individual_gain > 0:
            azimuth = state[k.S_AZIMUTH] + 2 * np.pi * b / pitch.size
            wanted += state[k.S_TILT] * np.cos(azimuth) + state[k.S_YAW] * np.sin(azimuth)
        change = wanted - pitch[b]
        if abs(change) <= c.pitch_rate * dt:
            pitch[b] = wanted
        else:
            pitch[b] += np.sign(change) * c.pitch_rate * dt


@njit(nogil=True, **LINKED)
def brake(c, state, dt):
    """Torque that the shaft brake can hold in the next step, N m at the rotor."""
    mode = state[k.S_STATE]
    slow = abs(state[k.S_SPEED]) < c.brake_speed or state[k.S_BRAKE] > 0.0
    if mode in (EMERGENCY, PARK) or (mode in (STOP, FAULT) and slow):
        state[k.S_BRAKE] = min(state[k.S_BRAKE] + dt / c.brake_time, 1.0)
    else:
        state[k.S_BRAKE] = 0.0
    return state[k.S_BRAKE] * c.brake_torque


@njit(cache=True, nogil=True)
def control(c, schedule, state, pitch, generator_speed, moment_y, moment_z, time, dt):
    """One step of the control, from what the sensors show now to torque and pitch of the next."""
    share = 1 - np.exp(-dt * c.filter_rate)
    state[k.S_FILTERED] += share * (generator_speed - state[k.S_FILTERED])
    supervise(c, schedule, state, generator_speed, time, dt)
    schedule_pitch(c, state, dt)
    generator(c, schedule, state, dt)
    collective_pitch(c, schedule, state, dt)
    if c.individual_gain > 0:
        individual_pitch(c, state, moment_y, moment_z, dt)
    move_blades(c, schedule, state, pitch, dt)
