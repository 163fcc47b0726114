"""Friction torque of slewing bearings, [Ritzer 2018] ch. 2.6: from loads and from ball forces.

(2.23) takes the equivalent load, (2.25) the loads, (2.37) the ball forces.
On Ritzer's blade bearing (2.25) gives 25 … 54 % less than was measured and (2.37) 40 … 61 %
less: rules of thumb. Makers allow ±25 % for (2.25), which for roller slewing rings has 4.1 and 2.05
in place of 4.4 and 2.2. Friction factors belong to their formula and must
not be exchanged; Ritzer has none for three-row bearings.
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
        Factor μ of Table 2.3 (`FRICTION_FACTORS`).
    idle : float
        Torque M_R0 without load, N m.

    Returns
    -------
    ndarray
        N m.

    Examples
    --------
    >>> from loadflow.rolling import friction_torque_loads
    >>> round(float(friction_torque_loads(1e6, 1e5, 2e5, 1.9, idle=8000.0)))  # N m
    12797
    """
    tilt = 4.4 * np.abs(np.asarray(moment, float))
    force = 2.2 * np.abs(np.asarray(radial, float)) + np.abs(np.asarray(axial, float))
    return np.asarray(idle + friction / 2 * (tilt + force * pitch_diameter))


def friction_torque_components(
    force: Array, moment: Array, pitch_diameter: float, *, friction: float, idle: float
) -> Array:
    """`friction_torque_loads` of the force (..., 3) and moment (..., 2) of a result.

    Parameters
    ----------
    force : ndarray (..., 3)
        N.
    moment : ndarray (..., 2)
        N m.
    pitch_diameter, friction, idle : float
        As `friction_torque_loads`.

    Returns
    -------
    ndarray (...)
        N m.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling.friction import friction_torque_components
    >>> force, moment = np.array([1e5, 0.0, 1e6]), np.array([2e5, 0.0])
    >>> torque = friction_torque_components(force, moment, 1.9, friction=0.003, idle=0.0)
    >>> round(float(torque))  # N m
    4797
    """
    axial, radial = force[..., 2], np.hypot(force[..., 0], force[..., 1])
    tilt = np.hypot(moment[..., 0], moment[..., 1])
    return friction_torque_loads(axial, radial, tilt, pitch_diameter, friction=friction, idle=idle)


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
        Factor μ that Ritzer calibrated.
    idle : float
        Torque M_R0 without load and without preload (which is in `force_sum`), N m.

    Returns
    -------
    ndarray
        N m.

    Examples
    --------
    >>> from loadflow.rolling import friction_torque_forces
    >>> round(float(friction_torque_forces(2_202_502, 1.9, idle=8000.0)))  # N m
    15323
    """
    return np.asarray(idle + friction * 0.7 * np.asarray(force_sum, float) * pitch_diameter / 2)


def friction_factor(
    torque: ArrayLike, force_sum: ArrayLike, pitch_diameter: float, *, idle: float = 0.0
) -> Array:
    """Friction factor μ of `friction_torque_forces` from a measured torque (N m), (2.38).

    Parameters
    ----------
    torque : array_like
        Measured friction torque, N m.
    force_sum, pitch_diameter, idle
        See `friction_torque_forces`.

    Returns
    -------
    ndarray
        μ.

    Examples
    --------
    >>> from loadflow.rolling.friction import friction_factor, friction_torque_forces
    >>> torque = friction_torque_forces(2.2e6, 1.9, friction=0.004)
    >>> round(float(friction_factor(torque, 2.2e6, 1.9)), 6)
    0.004
    """
    per_factor = friction_torque_forces(force_sum, pitch_diameter, friction=1.0)
    return np.asarray((np.asarray(torque, float) - idle) / per_factor)


def friction_torque_equivalent(
    load: ArrayLike, pitch_diameter: float, *, friction: float = 0.0024, idle: float = 0.0
) -> Array:
    """Friction torque from the equivalent axial load P_ea, N m, (2.23), (2.29).

    Parameters
    ----------
    load : array_like
        `equivalent_load` of a result, N.
    pitch_diameter : float
        m.
    friction : float
        Factor μ; 0.0024 of four-point bearings.
    idle : float
        Torque without load, N m.

    Returns
    -------
    ndarray
        N m.

    Examples
    --------
    >>> from loadflow.rolling.friction import friction_torque_equivalent
    >>> round(float(friction_torque_equivalent(1e6, 1.9)))  # N m
    2280
    """
    return np.asarray(idle + friction * np.asarray(load, float) * pitch_diameter / 2)
