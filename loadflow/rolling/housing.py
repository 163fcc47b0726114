"""Housing around a bearing of which only the rolling elements are known: what gives heat off."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from loadflow.errors import InputError
from loadflow.rolling.raceways import BallRaceways
from loadflow.rolling.rings.usual import BEYOND, RING, STRUCTURE
from loadflow.rolling.roller_raceways import RollerRaceways

if TYPE_CHECKING:
    from loadflow.rolling.geometry import RollingGeometry

COVER = 0.5
"""Thickness of the cover at each end over the diameter of the rolling elements, assumed."""


def housing_area(bearing: RollingGeometry) -> float:
    """Surface of a round housing that gives heat off, m²: mantle, and both faces without the shaft.

    A = π H B_H + π/2 (H² − d²), as [ISO 7902-1:2020] has it of cylindrical housings, with height H
    and width B_H of the housing and diameter d of the shaft. These follow from the rolling elements
    by the proportions that `loadflow.rolling.rings.usual` has of rollers, here of balls, too, and
    without their contact angle, with a cover at each end; all assumed.

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
    if not isinstance(bearing, BallRaceways | RollerRaceways):
        raise InputError(
            "the bearing has elements of several sizes; give conductance, or area and transfer"
        )
    size = bearing.element_diameter
    length = bearing.roller_length if isinstance(bearing, RollerRaceways) else size
    # spherical ones have no spacing; their angle sets it
    rows = (bearing.rows - 1) * bearing.row_spacing or 2 * abs(bearing.row_offset)
    shaft = bearing.pitch_diameter - (1 + 2 * RING) * size
    high = bearing.pitch_diameter + (1 + 2 * RING + 2 * STRUCTURE) * size
    wide = rows + length + 2 * (BEYOND + COVER) * size
    return float(math.pi * high * wide + 0.5 * math.pi * (high**2 - shaft**2))
