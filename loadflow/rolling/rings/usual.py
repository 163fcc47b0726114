"""Rings of a bearing of which only the rolling elements are known, with what stands behind them.

Proportions, all assumed. A ring is half a roller thick between raceway and seat (0.56 rollers in a
231/750: 750 × 1220 mm, rollers of 112 mm); the shaft or housing behind it is 1.4 rollers thick, as
that of the bearing of `pipelines/dlc_1_1.toml`, which is an eighth of the seat of a 231/750 and a
twentieth of that of a moment bearing; both together are one section, a fifth of a roller longer at
both ends than its rows, and stand with one face on a wall as thick as the structure, as long as the
section is high. Ball rings are those of the blade bearing of [Ritzer 2018] App. B in sizes of its
balls, with the walls that the default bearing of scenes has.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from loadflow.rolling.contacts import HEIGHT
from loadflow.rolling.roller_raceways import RollerRaceways

if TYPE_CHECKING:
    from loadflow.rolling.geometry import RollingGeometry

RING, STRUCTURE = 0.5, 1.4
"""Thickness of a roller bearing's ring, and of shaft or housing behind it, over the rollers'."""

BEYOND = 0.2
"""Length of a section beyond its rows, at each end, over the diameter of the rollers."""

BALL_WIDTH, BALL_BEYOND, BALL_WALL = 2.4, 0.75, 1.5
"""Width of a ball bearing's ring, length beyond the outer rows, thickness of its wall, in balls."""

BALL_WALL_LENGTH = 0.53
"""Length of its wall over the pitch diameter."""


@dataclass(frozen=True)
class UsualRing:
    """Measures of a ring, m, as scenes write them.

    Attributes
    ----------
    width, height : float
        Of the section, radially and axially.
    radius : float
        Of its centroid.
    foot : float
        Height of the face that stands on a wall of the same radius.
    thickness, length : float
        Of the wall.
    """

    width: float
    height: float
    radius: float
    foot: float
    thickness: float
    length: float

    @property
    def written(self) -> dict[str, Any]:
        """The table of a scene."""
        wall = {
            "radius": self.radius,
            "height": self.foot,
            "thickness": self.thickness,
            "length": self.length,
        }
        return {
            "section": {"width": self.width, "height": self.height},
            "radius": self.radius,
            "supports": [wall],
        }


def usual_rings(bearing: RollingGeometry) -> tuple[UsualRing, UsualRing]:
    """Inner and outer ring as they usually are, rounded to millimetres.

    The inner ring is held at the side of +z, the outer one at the other, as between hub and frame.

    Parameters
    ----------
    bearing : RollingGeometry
        Of a kind whose rings may be flexible.

    Examples
    --------
    >>> from loadflow.rolling import main_bearings
    >>> from loadflow.rolling.rings.usual import usual_rings
    >>> inner, outer = usual_rings(main_bearings("tapered-pair")["M"])
    >>> outer.width, outer.height, outer.radius
    (0.152, 1.091, 1.207)
    """
    size, angle = bearing.element_diameter, bearing.nominal_angle
    height = bearing.contacts().table[:, HEIGHT]
    if isinstance(bearing, RollerRaceways):
        width, thickness = (RING + STRUCTURE) * size, STRUCTURE * size
        roller = (bearing.roller_length * math.cos(angle) + size * math.sin(angle)) / 2
        rows = height.reshape(bearing.tracks, -1).mean(axis=1)
        far = float(np.abs(rows).max()) + roller + BEYOND * size
        length = 2 * far
    else:
        width, thickness = BALL_WIDTH * size, BALL_WALL * size
        far = float(np.abs(height).max()) + BALL_BEYOND * size
        length = BALL_WALL_LENGTH * bearing.pitch_diameter
    middle, raceway = bearing.pitch_diameter / 2, size / 2 * math.cos(angle) + width / 2

    def ring(side: float) -> UsualRing:
        sizes = (width, 2 * far, middle + side * raceway, -side * far, thickness, length)
        return UsualRing(*(round(one, 3) for one in sizes))

    return ring(-1.0), ring(1.0)
