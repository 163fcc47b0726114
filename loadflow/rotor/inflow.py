"""Wind over time as the compiled loop reads it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.turbines import Turbine
from loadflow.wind import Condition, transient
from loadflow.wind import Machine as WindMachine
from loadflow.wind.field import Field

Array = NDArray[np.float64]
_NO_BOX = np.zeros((0, 1, 1), dtype=np.float32)


class Inflow(NamedTuple):
    """Wind at the rotor: its course at each step, shear, and a box of turbulence.

    The wind at height Z and lateral place y is ``mean (Z/Z_hub)^shear + rise + vertical z +
    horizontal y`` in the given direction, plus the fluctuation of the box; y and the box turn with
    the wind.
    """

    mean: float  # m/s
    rise: Array  # (steps,), m/s
    heading: Array  # (steps, 2), cosine and sine of the direction, positive to the left
    vertical: Array  # (steps,), linear shear, 1/s
    horizontal: Array  # (steps,), 1/s
    shear: float
    box_step: float
    box_radius: Array
    u: NDArray[np.float32]
    v: NDArray[np.float32]
    w: NDArray[np.float32]


def steady_inflow(
    wind_speed: float, steps: int, shear: float, direction: float = 0.0, box: Field | None = None
) -> Inflow:
    """Constant hub wind with a power-law profile, and turbulence if a box is given."""
    zero = np.zeros(steps)
    return Inflow(
        mean=float(wind_speed),
        rise=zero,
        heading=_heading(np.full(steps, float(direction))),
        vertical=zero,
        horizontal=zero,
        shear=float(shear),
        box_step=1.0 if box is None else float(box.time[1] - box.time[0]),
        box_radius=np.array([0.0, 1.0]) if box is None else box.radius,
        u=_NO_BOX if box is None else box.u,
        v=_NO_BOX if box is None or box.v is None else box.v,
        w=_NO_BOX if box is None or box.w is None else box.w,
    )


def _heading(direction: Array) -> Array:
    return np.stack([np.cos(direction), np.sin(direction)], axis=-1)


def case_inflow(
    condition: Condition, machine: WindMachine, time: Array, box: Field | None
) -> Inflow:
    """Wind of a load case at each step; `time` counts from the start of the series, s."""
    steady = steady_inflow(
        condition.wind_speed, time.size, condition.shear_exponent, condition.yaw_error, box
    )
    change: dict[str, Any] = dict(transient(condition, machine, time))
    if "direction" in change:
        change["heading"] = _heading(condition.yaw_error + change.pop("direction"))
    return steady._replace(**change)


def wind_machine(turbine: Turbine) -> WindMachine:
    """What the wind conditions need to know of a turbine."""
    return WindMachine(
        cut_in=turbine.cut_in,
        rated=turbine.rated_wind_speed,
        cut_out=turbine.cut_out,
        rotor_diameter=2 * turbine.rotor.radius,
        hub_height=turbine.rotor.hub_height,
    )
