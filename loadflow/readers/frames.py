"""From the rotating to the non-rotating frame, and from gauge to apex."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from loadflow.readers.aliases import GAUGE

Series = Mapping[str, NDArray[np.float64]]
"""By component of the cube, over time."""

PAIRS = ("hub_force", "hub_moment", "gauge_moment")
REVOLUTIONS = 3.0
"""Turns of the rotor below which nothing is said of the frame of a series."""


def turned(series: Series, azimuth: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """Turn y and z components with the azimuth, from the rotating into the fixed frame.

    Parameters
    ----------
    series : mapping of str to ndarray
        Components; those that are not there are left out.
    azimuth : ndarray, shape (n,)
        Angle of the rotating frame about +x, 0 where both frames agree, rad.

    Returns
    -------
    dict of str to ndarray
        The y and z components in the fixed frame.

    Examples
    --------
    >>> import numpy as np
    >>> weight = {"hub_force_y": np.array([0.0, -1.0]), "hub_force_z": np.array([-1.0, 0.0])}
    >>> fixed = turned(weight, np.array([0.0, np.pi / 2]))
    >>> fixed["hub_force_z"].round(9).tolist()
    [-1.0, -1.0]
    """
    found: dict[str, NDArray[np.float64]] = {}
    cos, sin = np.cos(azimuth), np.sin(azimuth)
    for name in PAIRS:
        keys = f"{name}_y", f"{name}_z"
        if set(keys) <= set(series):
            y, z = (series[key] for key in keys)
            found |= dict(zip(keys, (cos * y - sin * z, sin * y + cos * z)))
    return found


def at_apex(series: Series, distance: float) -> dict[str, NDArray[np.float64]]:
    """Return the bending moments at the rotor apex that follow from those at the gauge.

    Equilibrium of the (massless) shaft between the two: M_y,apex = M_y,gauge − l F_z and
    M_z,apex = M_z,gauge + l F_y. Moments that are there already are left alone.

    Parameters
    ----------
    series : mapping of str to ndarray
        Components in one frame.
    distance : float
        l, from the apex to the gauge, downwind, m.
    """
    if set(GAUGE) & set(series) or not set(GAUGE.values()) <= set(series):
        return {}
    return {
        "hub_moment_y": series["gauge_moment_y"] - distance * series["hub_force_z"],
        "hub_moment_z": series["gauge_moment_z"] + distance * series["hub_force_y"],
    }


def turning_order(
    lateral: NDArray[np.complex128], speed: NDArray[np.float64], step: float
) -> tuple[int, float, float] | None:
    """How often a lateral force turns with the rotor: 0 in the non-rotating frame.

    The mean of F_y + i F_z, mainly weight, is largest in the non-rotating frame; in the
    rotating one it appears at −1 per revolution, turned the wrong way at −2 or +1.

    Parameters
    ----------
    lateral : ndarray, shape (n,)
        F_y + i F_z, N.
    speed : ndarray, shape (n,)
        Rotor speed, rad/s.
    step : float
        Time step, s.

    Returns
    -------
    order : int
        Turns per revolution of the rotor of the largest part.
    size, mean : float
        That part and the mean, N. None if the rotor turns less than `REVOLUTIONS`.
    """
    angle = np.cumsum(speed) * step
    if np.ptp(angle) < 2 * np.pi * REVOLUTIONS:
        return None
    # samples at equal steps of the angle: a rotor at rest must not outweigh one that runs
    weights = np.abs(speed) / np.abs(speed).sum()
    sizes = {k: abs(np.sum(weights * lateral * np.exp(-1j * k * angle))) for k in range(-2, 3)}
    order = max(sizes, key=lambda k: sizes[k])
    return order, float(sizes[order]), float(sizes[0])
