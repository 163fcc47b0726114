"""Points of a bore that wears, and a shaft that lies on the asperities between them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.bearing import JournalBearing
from loadflow.journal.contact import Contact
from loadflow.journal.relief import Contour

Array = NDArray[np.float64]

_NEWTON, _CLOSE = 60, 1e-10  # steps of a shaft on its asperities, and what is left of their load


@dataclass(frozen=True)
class Group:
    """Neighbouring samples of a cycle, taken together.

    Attributes
    ----------
    force, place : array (2,)
        Mean load on the asperities, N, and eccentricity, m.
    distance : float
        What the shaft slides in them over the life, m.
    line : array (4,)
        Mean tilt, rad, and bend, 1/m.
    """

    force: Array
    place: Array
    distance: float
    line: Array


class Surface:
    """Points of the contour of a bore, and a shaft on its asperities.

    Parameters
    ----------
    bearing : JournalBearing
        As it is made.
    around, across : int
        Number of points.
    """

    def __init__(self, bearing: JournalBearing, around: int, across: int) -> None:
        self.bearing = bearing
        turn, count = 2.0 * np.pi / around, across
        self.angle: Array = np.asarray(turn * np.arange(around))
        self.z: Array = np.asarray(bearing.width * ((np.arange(count) + 0.5) / count - 0.5))
        self.shape = around, count
        self.area = turn * bearing.radius * bearing.width / count
        self._way = np.stack([np.cos(self.angle), np.sin(self.angle)])
        made = np.full(self.shape, bearing.clearance)
        for part in bearing.relief:
            made = made + part.added(self.angle, self.z, bearing.width)
        self._made = made

    def worn(self, depth: Array) -> JournalBearing:
        """The bearing with a bore that is worn."""
        if not depth.any():
            return self.bearing
        z = tuple(self.z) if self.z.size > 1 else None
        contour = Contour(tuple(self.angle), (depth if z else depth[:, 0]).tolist(), z)
        return replace(self.bearing, relief=(*self.bearing.relief, contour))

    def pressed(self, groups: list[Group], rough: Contact, depth: Array) -> tuple[Array, float]:
        """∫ p ds of all groups, N/m, at each point, and the worst share of a load that is missed.

        Raises
        ------
        loadflow.errors.SolverError
            A shaft that its asperities do not hold.
        """
        total, worst = np.zeros(self.shape), 0.0
        for group in groups:
            pressure, missed = self._carried(group, rough, depth)
            total += group.distance * pressure
            worst = max(worst, missed)
        return total, worst

    def _carried(self, group: Group, rough: Contact, depth: Array) -> tuple[Array, float]:
        """Pressure, Pa, at each point of a shaft whose asperities carry the load of a group."""
        tips, way = rough.asperities, self._way
        tilt_x, tilt_y, bend_x, bend_y = group.line
        z = self.z
        lies = np.outer(way[0], tilt_y * z + 0.5 * bend_x * z**2)
        lies += np.outer(way[1], -tilt_x * z + 0.5 * bend_y * z**2)
        bore, place = self._made + depth - lies, group.place.copy()
        size, limit = float(np.hypot(*group.force)), tips.roughness
        for _ in range(_NEWTON):
            gap = bore - (place @ way)[:, None]
            pressure = tips.pressure(gap)
            missing = group.force - self.area * (way @ pressure.sum(axis=1))
            missed = float(np.hypot(*missing)) / size
            if missed < _CLOSE:
                return pressure, missed
            slope = -self.area * tips.pressure_slope(gap).sum(axis=1)
            stiffness = (way * slope) @ way.T
            step = np.linalg.lstsq(stiffness, missing, rcond=1e-12)[0]
            length = float(np.hypot(*step))
            if not np.isfinite(length) or length == 0.0:
                step, length = group.force / size * limit, limit
            place += step * min(1.0, limit / length)
        raise SolverError(
            f"wear: asperities do not carry {size:.4g} N after {_NEWTON} steps, {missed:.2g} left"
        )
