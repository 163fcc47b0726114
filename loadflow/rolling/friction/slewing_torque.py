"""Friction torque of slewing bearings, [Ritzer 2018] ch. 2.6: from loads and from ball forces.

Measured on the source's blade bearing, the first lies 45 … 49 % too low and the second 40 … 61 %;
both are rules of thumb. Friction factors belong to their formula and must not be exchanged.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

FRICTION_FACTORS = {"balls with cage": 0.003, "balls with spacers": 0.004, "crossed rollers": 0.004}


def friction_torque_loads(
    axial: ArrayLike,
    radial: ArrayLike,
    moment: ArrayLike,
    pitch_diameter: float,
    *,
    friction: float = 0.003,
    idle: float = 0.0,
) -> Array:
    """Friction torque from the external loads, N m, (2.25)–(2.27), DG03.

    Parameters
    ----------
    axial, radial, moment : array_like
        Magnitudes of axial force, radial force (N) and tilting moment (N m).
    pitch_diameter : float
        m.
    friction : float
        Factor μ of Tab. 2.3 (`FRICTION_FACTORS`).
    idle : float
        Torque M_R0 without load, N m.
    """
    tilt = 4.4 * np.abs(np.asarray(moment, float))
    force = 2.2 * np.abs(np.asarray(radial, float)) + np.abs(np.asarray(axial, float))
    return np.asarray(idle + friction / 2 * (tilt + force * pitch_diameter))


def friction_torque_forces(
    force_sum: ArrayLike, pitch_diameter: float, *, friction: float = 0.005, idle: float = 0.0
) -> Array:
    """Friction torque from the sum of the ball forces, N m, (2.37).

    Parameters
    ----------
    force_sum : array_like
        Sum of all ball forces, N.
    pitch_diameter : float
        m.
    friction : float
        Factor μ that the source calibrated.
    idle : float
        Torque M_R0 without load and without preload (which is in `force_sum`), N m.
    """
    return np.asarray(idle + friction * 0.7 * np.asarray(force_sum, float) * pitch_diameter / 2)
