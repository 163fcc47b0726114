"""The schedule of the lowest pitch over the power, from that over the wind.

Sources give the lowest pitch over the wind, which their controllers estimate. Ours knows its power:
a wind is recognised by the steady power of the rotor in it, at the pitch that belongs to it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from loadflow.turbines import Turbine

from . import slots as k
from .control.constants import controller
from .inflow import steady_inflow
from .loop import run, turning_state
from .machine import machine
from .options import RotorOptions
from .tables import with_table

Array = NDArray[np.float64]
_STEP, _SETTLE = 0.1, 40.0  # s; each wind starts from the speed of the one before
_RIGID = RotorOptions(modes=(), tower_motion=False, drivetrain_torsion=False, tower_dam=False)
_BELOW_RATED = 0.98  # from there on the power tells nothing of the wind


def schedule_over_power(turbine: Turbine) -> tuple[Array, Array]:
    """Power (W, increasing) and lowest pitch (rad) of the schedule of a turbine.

    Rigid blades in a uniform, steady wind; points where the power no longer rises are left out.
    """
    m, c = with_table(machine(turbine, _RIGID)), controller(turbine)
    speed = c.region_2_start / m.gear_ratio
    powers: list[float] = []
    for wind, pitch in zip(turbine.control.scheduled_wind, turbine.control.scheduled_pitch):
        pitch = float(pitch)  # whole numbers would have the loop compiled once more
        held = c._replace(minimum_pitch=pitch, scheduled_pitch=np.array([pitch]))
        state = turning_state(m, held, wind, speed, pitch)
        steps = round(_SETTLE / _STEP)
        run(m, held, steady_inflow(wind, steps, 0.0), state, _STEP, steps=steps)
        speed = state.speed
        power = float(state.scalars[k.S_FILTERED] * state.scalars[k.S_TORQUE])
        lowest = powers[-1] if powers else 0.0
        if not lowest < power < _BELOW_RATED * c.rated_power:
            break
        powers.append(power)
    return np.array(powers), np.array(turbine.control.scheduled_pitch[: len(powers)])
