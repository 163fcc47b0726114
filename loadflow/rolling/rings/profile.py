"""Sections of rings with their raceway grooves, as structured grids for finite elements."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from annotated_types import Gt
from scipy.optimize import brentq

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice, check_fields
from loadflow.rolling.contacts import Array
from loadflow.rolling.raceways import BallRaceways
from loadflow.rolling.rings.section import RingSection

PATCH = math.radians(10)  # of a groove, to both sides of the nominal contact angle


@dataclass(frozen=True, kw_only=True)
class RingProfile:
    """Rectangular section with the gothic grooves of a four-point bearing cut into one side.

    Attributes
    ----------
    bearing : BallRaceways
        Whose grooves are cut.
    ring : {"inner", "outer"}
        Which ring of it.
    inside, outside : float
        Diameters of the ring, m; the grooves lie on the side of the balls.
    bottom, top : float
        Axial limits of the ring, m.

    Raises
    ------
    InputError
        If a groove does not fit into the section.

    Examples
    --------
    >>> from loadflow.rolling import RingProfile, SlewingBearing
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> profile = RingProfile(bearing=bearing, ring="outer", inside=0.51, outside=0.62,
    ...     bottom=-0.04, top=0.04)
    >>> section, radius, height = profile.section()
    >>> round(radius, 3), section.area < 0.055 * 0.08  # the groove is cut out
    (0.285, True)
    """

    bearing: BallRaceways
    ring: Literal["inner", "outer"]
    inside: Annotated[float, Gt(0)]
    outside: Annotated[float, Gt(0)]
    bottom: float
    top: float

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "ring", ("inner", "outer"))
        if self.outside <= self.inside:
            raise InputError(f"outside: must be > inside {self.inside:g} m, got {self.outside:g}")
        edges = [z for row in self._grooves() for z in row[[0, -1], 1]]
        if not (self.bottom < edges[0] and edges[-1] < self.top and edges == sorted(edges)):
            raise InputError(
                f"bottom, top: the grooves from {edges[0]:g} to {edges[-1]:g} m must lie between "
                f"{self.bottom:g} and {self.top:g} m and not overlap"
            )

    @property
    def land(self) -> float:
        """Radius of the cylinder that the grooves are cut into."""
        return (self.inside if self.ring == "outer" else self.outside) / 2

    @property
    def back(self) -> float:
        """Radius of the opposite side."""
        return (self.outside if self.ring == "outer" else self.inside) / 2

    @property
    def patch_half(self) -> float:
        """Half the width of a raceway patch in the section, along the groove, m."""
        return self.bearing.groove(self.ring) * PATCH

    def _grooves(self, patch: float = PATCH) -> list[Array]:
        """Points (r, z) on the groove of each row from below, with grid lines at each patch."""
        bearing, side = self.bearing, 1.0 if self.ring == "outer" else -1.0
        alpha, radius = bearing.contact_angle, bearing.groove(self.ring)
        arm = radius - bearing.ball_diameter / 2
        centre = bearing.pitch_diameter / 2 - side * arm * math.cos(alpha)
        depth = side * (self.land - centre) / radius
        if not math.sin(0.05) < depth < math.cos(alpha + patch):
            raise InputError(
                f"{'inside' if self.ring == 'outer' else 'outside'}: the raceway must reach from "
                f"the groove's bottom beyond its contact angle, got {2 * self.land:g} m"
            )
        bottom = math.asin(arm * math.sin(alpha) / radius)  # both arcs meet at mid groove
        angles = [
            *np.linspace(bottom, alpha - patch, 3),
            *np.linspace(alpha - patch, alpha + patch, 3)[1:],
            math.acos(depth),
        ]
        upper = np.array(
            [
                (
                    centre + side * radius * math.cos(b),
                    radius * math.sin(b) - arm * math.sin(alpha),
                )
                for b in angles
            ]
        )
        lower = upper[:0:-1] * [1, -1]
        both = np.concatenate([lower, upper])
        return [both + np.array([0, height]) for height in bearing.row_heights()]

    def grid(self, across: int = 4) -> tuple[Array, Array]:
        """Radius and height of a grid, each (along the raceway side, across the ring).

        Parameters
        ----------
        across : int
            Elements across the ring, from the raceway side to its back.

        Raises
        ------
        InputError
            The ring is so thin and high that lines of the grid cross behind its grooves.
        """
        land = self.land
        size = self.bearing.ball_diameter / 2  # about the size of the elements beside the grooves
        line = np.array([[land, self.bottom]])
        for points in [*self._grooves(), np.array([[land, self.top]])]:
            gap = points[0, 1] - line[-1, 1]
            count = max(1, round(gap / size))
            between = np.linspace(line[-1, 1], points[0, 1], count + 1)[1:-1]
            line = np.concatenate(
                [line, np.column_stack([np.full(count - 1, land), between]), points]
            )
        # behind a groove the lines spread to an even spacing
        even = np.linspace(self.bottom, self.top, len(line))
        share = graded(across, 0.7 * self.patch_half / abs(self.back - land))
        radius = line[:, :1] + share * (self.back - line[:, :1])
        height = line[:, 1:] + share * (even - line[:, 1])[:, None]
        if _folds(np.stack([radius, height], axis=-1)):
            raise InputError(
                f"inside, outside, bottom, top: a ring {1e3 * abs(self.back - land):.4g} mm thick "
                f"is too thin behind its grooves to be meshed from {1e3 * self.bottom:.4g} to "
                f"{1e3 * self.top:.4g} mm; allowed: thicker, or with the grooves nearer its middle"
            )
        return radius, height

    def section(self) -> tuple[RingSection, float, float]:
        """Constants of the section with its grooves, and radius and height of its centroid, m.

        Torsion after Saint-Venant's A⁴/(k I_p) for compact sections, k = 42.7 that of a square.
        """
        r, z = self.grid(across=1)
        x, y = (np.append(c[:, 0], c[::-1, 1]) for c in (r, z))  # once around the section
        whole, radius, height = _centroid(x, y)
        x, y = x - radius, y - height
        x_next, y_next = np.roll(x, -1), np.roll(y, -1)
        cross = (x * y_next - x_next * y) * math.copysign(1, whole)
        moments = [
            float((cross * term).sum())
            for term in (
                (x * x + x * x_next + x_next * x_next) / 12,
                (y * y + y * y_next + y_next * y_next) / 12,
                (x * y_next + 2 * x * y + 2 * x_next * y_next + x_next * y) / 24,
            )
        ]
        area = abs(whole)
        section = RingSection(
            area=area,
            inertia_axial=moments[0],
            inertia_radial=moments[1],
            inertia_product=moments[2],
            torsion=area**4 / (42.7 * (moments[0] + moments[1])),
        )
        return section, radius, height


def _folds(grid: Array) -> bool:
    """Whether a cell of a grid of points (n, m, 2) is not convex, or turned over."""
    corners = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]])
    ahead, behind = np.roll(corners, -1, axis=0) - corners, np.roll(corners, 1, axis=0) - corners
    turns = ahead[..., 0] * behind[..., 1] - ahead[..., 1] * behind[..., 0]
    return bool(turns.min() * turns.max() <= 0)


def _centroid(x: Array, y: Array) -> tuple[float, float, float]:
    """Signed area of a polygon and its centroid."""
    x_next, y_next = np.roll(x, -1), np.roll(y, -1)
    cross = x * y_next - x_next * y
    area = float(cross.sum() / 2)
    place = [float((cross * c).sum() / (6 * area)) for c in (x + x_next, y + y_next)]
    return area, place[0], place[1]


def graded(count: int, first: float) -> Array:
    """Ends of `count` intervals of [0, 1], growing by a constant factor from `first`."""
    if count == 1 or count * first >= 1:
        return np.linspace(0, 1, count + 1)
    factor = brentq(lambda g: first * (g**count - 1) / (g - 1) - 1, 1 + 1e-9, 1 / first + 1)
    return np.append(first * (factor ** np.arange(count) - 1) / (factor - 1), 1.0)
