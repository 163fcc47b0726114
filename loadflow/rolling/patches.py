"""Points where the raceways of a slewing bearing ride on its rings, (3.10)–(3.19)."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from loadflow.rolling.contact import Array, azimuths
from loadflow.rolling.slewing import SlewingBearing


def raceway_points(
    bearing: SlewingBearing, ring: Literal["inner", "outer"], shell: float = 0.5e-3
) -> Array:
    """Master points of the raceway patches on one ring, m, (row, side, ball, 3).

    Parameters
    ----------
    bearing : SlewingBearing
        The bearing.
    ring : {"inner", "outer"}
        Which ring.
    shell : float
        Thickness T_S of the rigid patch between raceway and ring, m.

    Returns
    -------
    ndarray, shape (rows, 2, balls, 3)
        x, y, z; side 0 lies above the row (+z), side 1 below; the first ball at azimuth 0.
    """
    reach = bearing.ball_diameter / 2 + shell
    sign = 1.0 if ring == "outer" else -1.0
    radius = bearing.pitch_diameter / 2 + sign * math.cos(bearing.contact_angle) * reach
    phi = azimuths(bearing.balls)
    points = np.empty((bearing.rows, 2, bearing.balls, 3))
    points[..., 0] = radius * np.cos(phi)
    points[..., 1] = radius * np.sin(phi)
    height = math.sin(bearing.contact_angle) * reach * np.array([1.0, -1.0])
    points[..., 2] = (np.array(bearing.row_heights())[:, None] + height)[..., None]
    return points
