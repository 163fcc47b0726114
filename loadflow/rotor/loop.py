"""Running the compiled loop: state at the start, one run, its columns as arrays."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numba import types
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.numerics.entries import Entry
from loadflow.numerics.references import kind_of
from loadflow.turbines import load_turbine

from . import _kernels as kernels
from . import slots as k
from .aero._airfoil_kernels import SECTION_STATES
from .control._kernels import control_torque
from .control.constants import IDLE, PARK, UNEVENTFUL, Controller, Schedule, controller
from .inflow import Inflow
from .machine import Machine, machine
from .options import RotorOptions
from .room import room_for

Array = NDArray[np.float64]


@dataclass
class State:
    """What the loop carries from step to step; `run` advances it."""

    scalars: Array
    pitch: Array  # (blades,), rad
    modes: Array  # (blades, k), deflection of each mode, m
    mode_speed: Array
    mode_acceleration: Array
    frame: Array  # (h,), see `Frame`; place 0, the generator, is in the scalars
    frame_speed: Array
    frame_acceleration: Array
    inflow_angle: Array  # (blades, n), start of the section solver
    wake: Array  # (blades, n, SECTION_STATES)
    induced: Array  # (blades, n, 2, 3), see `inflow_lag`; without sections if it is off
    torsion: Array  # (blades, n), nose-down turn, rad; without sections if no blade twists

    @property
    def speed(self) -> float:
        """Rotor speed, rad/s."""
        return float(self.scalars[k.S_SPEED])

    @property
    def azimuth(self) -> float:
        """Azimuth of blade 1, rad."""
        return float(self.scalars[k.S_AZIMUTH])

    def copy(self) -> State:
        """Return an independent copy."""
        return State(*(getattr(self, f.name).copy() for f in fields(self)))


def turning_state(
    m: Machine, c: Controller, wind_speed: float, speed: float, pitch: float
) -> State:
    """Running at steady `speed` (rad/s) and `pitch` (rad), blades straight."""
    state = _state(m, wind_speed, pitch)
    scalars = state.scalars
    scalars[k.S_SPEED] = speed
    scalars[k.S_FILTERED] = m.gear_ratio * speed
    # not compiled for this one call
    torque = control_torque.py_func(c, m.gear_ratio * speed, pitch - c.minimum_pitch)
    scalars[k.S_TORQUE] = torque
    scalars[k.S_POWER] = scalars[k.S_FILTERED] * scalars[k.S_TORQUE]
    scalars[k.S_FLOOR] = c.minimum_pitch
    gain = 1 / (1 + pitch / c.gain_halving_pitch)
    scalars[k.S_INTEGRAL] = pitch / (gain * c.integral_gain)
    return state


def standing_state(
    m: Machine, c: Controller, wind_speed: float, azimuth: float, *, idle: bool, stuck: bool
) -> State:
    """Parked with the brake closed, or free to idle; `stuck`: the last blade at fine pitch."""
    pitch = c.idling_pitch if idle else c.stopped_pitch
    state = _state(m, wind_speed, pitch)
    scalars = state.scalars
    scalars[k.S_AZIMUTH] = azimuth
    scalars[k.S_STATE] = IDLE if idle else PARK
    scalars[k.S_FLOOR] = pitch
    scalars[k.S_BRAKE] = 0.0 if idle else 1.0
    if stuck:
        state.pitch[-1] = c.minimum_pitch
    return state


def _state(m: Machine, wind_speed: float, pitch: float) -> State:
    scalars = np.zeros(k.SLOTS)
    scalars[k.S_PITCH] = pitch
    scalars[k.S_AXIAL] = wind_speed * np.cos(m.tilt)
    scalars[k.S_Z] = wind_speed * np.sin(m.tilt)
    modes, frame = np.zeros((m.blades, m.shape.shape[1])), np.zeros(m.frame.carries.size)
    sections = (m.blades, m.radius.size)
    return State(
        scalars,
        np.full(m.blades, float(pitch)),
        modes,
        modes.copy(),
        modes.copy(),
        frame,
        frame.copy(),
        frame.copy(),
        np.zeros(sections),
        np.zeros((*sections, SECTION_STATES)),
        np.zeros((m.blades, m.radius.size if m.dynamic_inflow else 0, 2, 3)),
        np.zeros((m.blades, m.torsion_compliance.size)),
    )


def run(
    m: Machine,
    c: Controller,
    inflow: Inflow,
    state: State,
    dt: float,
    *,
    steps: int,
    start: float = 0.0,
    schedule: Schedule = UNEVENTFUL,
    controlled: bool = True,
) -> Array:
    """March `steps` of `dt` from time `start`.

    Returns
    -------
    ndarray, shape (steps, COLUMNS + blades)
        The columns of `slots`, then the pitch of each blade.

    Raises
    ------
    SolverError
        If a value is not finite or the rotor exceeds 10 rad/s.
    """
    out = np.full((steps, k.COLUMNS + m.blades), np.nan)
    fresh = not (state.wake.any() or state.induced.any())
    response = Entry(kernels.respond, response_kinds(m, c, dt))
    kernels.march(
        response, m, c, schedule, inflow, dt, steps, start, fresh, controlled, state.scalars,
        state.pitch, state.modes, state.mode_speed, state.mode_acceleration, state.frame,
        state.frame_speed, state.frame_acceleration, state.inflow_angle, state.wake, state.induced,
        state.torsion, room_for(m), out,
    )  # fmt: skip
    bad = ~np.isfinite(out).all(axis=1) | (np.abs(out[:, k.SPEED]) > 10)
    if bad.any():
        step = int(np.argmax(bad))
        last = max(step - 1, 0)
        raise SolverError(
            f"the rotor model broke down at t = {start + step * dt:.3f} s; the step before: speed "
            f"{out[last, k.SPEED]:.4g} rad/s, pitch {out[last, k.PITCH]:.4g} rad, hub "
            f"wind {out[last, k.WIND_X]:.4g} m/s"
        )
    return out


def compile_response() -> None:
    """Compile the half of the loop that answers the forces of the air, where it is not on the disk.

    A process that calls `run` for the first time compiles the loop without it, and needs it when
    that is done. The kernels are the same for all turbines and options.
    """
    plant = load_turbine("nrel-5mw")
    m = machine(plant, RotorOptions())
    kernels.respond.compile(response_kinds(m, controller(plant), 0.025))


def response_kinds(m: Machine, c: Controller, dt: float) -> tuple[types.Type, ...]:
    """Types of what the loop hands to its second half, see `_kernels.respond`."""
    s = _state(m, 10.0, 0.0)
    step, time, since, controlled, speed, turned = 0, 0.0, dt, True, s.speed, s.azimuth
    given = (
        m, c, UNEVENTFUL, dt, step, time, since, controlled, speed, turned, s.scalars, s.pitch,
        s.modes, s.mode_speed, s.mode_acceleration, s.frame, s.frame_speed, s.frame_acceleration,
        s.torsion, room_for(m), np.zeros((1, k.COLUMNS + m.blades)),
    )  # fmt: skip
    return tuple(kind_of(value) for value in given)
