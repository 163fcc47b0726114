"""Points where the raceways of a slewing bearing ride on its rings, (3.10)–(3.19)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from loadflow.rolling.contacts import Array, azimuths

if TYPE_CHECKING:
    from loadflow.rolling.raceways import BallRaceways


@dataclass(frozen=True)
class PatchPoints:
    """Points of one ring that its raceway patches ride on, one for each contact of the bearing.

    Attributes
    ----------
    radius, height : ndarray, shape (kind,)
        Of each kind of contact (row and diagonal), m.
    azimuth : ndarray, shape (ball,)
        Of the balls, in the frame of the ring, rad.
    """

    radius: Array
    height: Array
    azimuth: Array


def patch_points(
    bearing: BallRaceways,
    ring: Literal["inner", "outer"],
    azimuth: Array,
    shell: float = 0.5e-3,
    turning: bool = False,
) -> PatchPoints:
    """Points that carry the patches of all contacts of a bearing on one ring.

    Parameters
    ----------
    bearing : BallRaceways
        The bearing.
    ring : {"inner", "outer"}
        Which ring.
    azimuth : ndarray, shape (ball,)
        Of the balls, rad.
    shell : float
        Thickness T_S of the patches, m.
    turning : bool
        Whether a patch turns with its section (its groove centre is then the point that counts) or
        only shifts with its master point.

    Returns
    -------
    PatchPoints
        Radius and height of each kind of contact, m, and azimuth of each ball, rad.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling import SlewingBearing, patch_points
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> azimuth = 2 * np.pi * np.arange(24) / 24
    >>> points = patch_points(bearing, "outer", azimuth)
    >>> type(points).__name__
    'PatchPoints'
    """
    side = -1.0 if ring == "inner" else 1.0  # the inner ring is touched below by diagonal 0
    if turning:
        # the groove centre lies beyond the ball, by its radius less the ball's
        reach = side * (bearing.ball_diameter / 2 - bearing.groove(ring))
    else:
        reach = side * (bearing.ball_diameter / 2 + shell)
    cos, sin = math.cos(bearing.contact_angle), math.sin(bearing.contact_angle)
    heights = [h + sign * reach * sin for h in bearing.row_heights() for sign in (1.0, -1.0)]
    radius = np.full(len(heights), bearing.pitch_diameter / 2 + reach * cos)
    return PatchPoints(radius, np.array(heights), azimuth)


def raceway_points(
    bearing: BallRaceways, ring: Literal["inner", "outer"], shell: float = 0.5e-3
) -> Array:
    """Master points of the raceway patches on one ring, m, (row, side, ball, 3).

    Parameters
    ----------
    bearing : BallRaceways
        The bearing.
    ring : {"inner", "outer"}
        Which ring.
    shell : float
        Thickness T_S of the rigid patch between raceway and ring, m.

    Returns
    -------
    ndarray, shape (rows, 2, balls, 3)
        x, y, z; side 0 lies above the row (+z), side 1 below; the first ball at azimuth 0.

    Examples
    --------
    >>> from loadflow.rolling import SlewingBearing, raceway_points
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> raceway_points(bearing, "outer").shape
    (1, 2, 24, 3)
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
