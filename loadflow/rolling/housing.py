"""Housing around a bearing of which only the rolling elements are known: what gives heat off."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from loadflow.errors import InputError
from loadflow.rolling.rings.usual import BEYOND, RING, STRUCTURE

if TYPE_CHECKING:
    from loadflow.rolling.geometry import RollingGeometry

COVER = 0.5
"""Thickness of the cover at each end over the diameter of the rolling elements, assumed."""


def housing_area(bearing: RollingGeometry) -> float:
    """Surface of a round housing that gives heat off, m²: mantle, and both faces without the shaft.

    A = π H B_H + π/2 (H² − d²), as [ISO 7902-1] has it of cylindrical housings, with height H and
    width B_H of the housing and diameter d of the shaft. These follow from the rolling elements as
    rings and structure do in `loadflow.rolling.rings.usual`, with a cover at each end; all assumed.

    Raises
    ------
    loadflow.errors.InputError
        If the bearing has elements of several sizes.

    Examples
    --------
    >>> from loadflow.rolling import SphericalRollerBearing
    >>> bearing = SphericalRollerBearing(rollers=24, roller_diameter=0.112, roller_length=0.145,
    ...     pitch_diameter=0.995, contact_angle=0.185)  # a 231/750
    >>> round(housing_area(bearing), 1)
    5.1
    """
    own: Any = bearing
    balls = own.element == "ball"
    size = getattr(own, "ball_diameter" if balls else "roller_diameter", None)
    if size is None:
        raise InputError(
            "the bearing has elements of several sizes; give conductance, or area and transfer"
        )
    length = size if balls else own.roller_length
    rows = (getattr(own, "rows", 1) - 1) * getattr(own, "row_spacing", 0.0)
    rows = rows or 2 * abs(getattr(own, "row_offset", 0.0))  # of spherical ones by their angle
    shaft = own.pitch_diameter - (1 + 2 * RING) * size
    high = own.pitch_diameter + (1 + 2 * RING + 2 * STRUCTURE) * size
    wide = rows + length + 2 * (BEYOND + COVER) * size
    return float(math.pi * high * wide + 0.5 * math.pi * (high**2 - shaft**2))
