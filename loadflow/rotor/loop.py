"""Running the compiled loop: state at the start, one run, its columns as arrays."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError

from . import _kernels as kernels
from .inflow import Inflow
from .machine import Controller, Machine

Array = NDArray[np.float64]


@dataclass
class State:
    """What the loop carries from step to step; `run` moves it on."""

    scalars: Array
    modes: Array  # (blades, k), deflection of each mode, m
    mode_speed: Array
    mode_acceleration: Array
    inflow_angle: Array  # (blades, n), start of the section solver
    wake: Array  # (blades, n, 2)

    @property
    def speed(self) -> float:
        """Rotor speed, rad/s."""
        return float(self.scalars[kernels.S_SPEED])

    def copy(self) -> State:
        """Return a state that moves on by itself."""
        return State(*(getattr(self, f.name).copy() for f in fields(self)))


def start_state(m: Machine, c: Controller, wind_speed: float, speed: float, pitch: float) -> State:
    """State that turns steadily at `speed` (rad/s) and `pitch` (rad), blades straight."""
    scalars = np.zeros(kernels.SLOTS)
    scalars[kernels.S_SPEED] = speed
    scalars[kernels.S_PITCH] = pitch
    scalars[kernels.S_FILTERED] = m.gear_ratio * speed
    scalars[kernels.S_TORQUE] = kernels.control_torque(c, m.gear_ratio * speed, pitch)
    gain = 1 / (1 + pitch / c.gain_halving_pitch)
    scalars[kernels.S_INTEGRAL] = pitch / (gain * c.integral_gain)
    scalars[kernels.S_AXIAL] = wind_speed * np.cos(m.tilt)
    scalars[kernels.S_Z] = wind_speed * np.sin(m.tilt)
    modes = np.zeros((m.blades, m.shape.shape[1]))
    sections = (m.blades, m.radius.size)
    return State(
        scalars, modes, modes.copy(), modes.copy(), np.zeros(sections), np.zeros((*sections, 2))
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
    controlled: bool = True,
) -> Array:
    """March `steps` of `dt` from time `start`; return the columns of `_kernels`, (steps, …).

    Raises
    ------
    SolverError
        If a value is not finite or the rotor runs away.
    """
    out = np.empty((steps, kernels.COLUMNS))
    kernels.march(
        m, c, inflow, dt, steps, start, controlled, state.scalars, state.modes, state.mode_speed,
        state.mode_acceleration, state.inflow_angle, state.wake, out,
    )  # fmt: skip
    bad = ~np.isfinite(out).all(axis=1) | (np.abs(out[:, kernels.SPEED]) > 10)
    if bad.any():
        step = int(np.argmax(bad))
        raise SolverError(
            f"the rotor model broke down at t = {start + step * dt:.3f} s: speed "
            f"{out[step, kernels.SPEED]:.4g} rad/s, pitch {out[step, kernels.PITCH]:.4g} rad, hub "
            f"wind {out[step, kernels.WIND_X]:.4g} m/s"
        )
    return out
