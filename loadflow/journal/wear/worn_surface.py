"""Points of a bore that wears, and a shaft that lies on the asperities between them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.bearing import JournalBearing
from loadflow.journal.contact import Contact
from loadflow.journal.relief import Contour

Array = NDArray[np.float64]

_NEWTON, _CLOSE = 100, 1e-10  # steps of a shaft on its asperities, and what is left of their load
_TRIES = 60  # lengths of one step
_FAR = 0.5  # of a load, beyond which the shaft is first pushed along it
_ROUNDING = 4 * float(np.finfo(float).eps)  # of a place, which is no finer known


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

    def pressed(
        self, groups: list[Group], rough: Contact, depth: Array
    ) -> tuple[Array, float, list[Group]]:
        """∫ p ds of all groups, N/m, at each point, and the worst share of a load that is missed.

        And the groups where their shafts lie now: a bore that has worn a little further moves these
        by little.

        Raises
        ------
        loadflow.errors.SolverError
            A shaft that its asperities do not hold.
        """
        total, worst, moved = np.zeros(self.shape), 0.0, list[Group]()
        for group in groups:
            pressure, missed, place = self._carried(group, rough, depth)
            total += group.distance * pressure
            worst = max(worst, missed)
            moved.append(replace(group, place=place))
        return total, worst, moved

    def _carried(self, group: Group, rough: Contact, depth: Array) -> tuple[Array, float, Array]:
        """Pressure, Pa, at each point of a shaft whose asperities carry the load of a group.

        And what of the load is missed, as a share, and where the shaft lies, (2,), m.
        """
        way, tips = self._way, rough.asperities
        tilt_x, tilt_y, bend_x, bend_y = group.line
        z = self.z
        lies = np.outer(way[0], tilt_y * z + 0.5 * bend_x * z**2)
        lies += np.outer(way[1], -tilt_x * z + 0.5 * bend_y * z**2)
        bore, size = self._made + depth - lies, float(np.hypot(*group.force))

        def missing(place: Array) -> Array:
            pressure = tips.pressure(bore - (place @ way)[:, None])
            return np.asarray(group.force - self.area * (way @ pressure.sum(axis=1)))

        place, left = group.place, missing(group.place)
        if np.hypot(*left) > _FAR * size:
            # the mean of neighbouring places may lie many roughnesses beside what carries
            place = _pushed(missing, place, group.force / size, tips.roughness)
            left = missing(place)
        for _ in range(_NEWTON):
            gap = bore - (place @ way)[:, None]
            missed = float(np.hypot(*left)) / size
            slope = -self.area * tips.pressure_slope(gap).sum(axis=1)
            stiffness = (way * slope) @ way.T
            known = _ROUNDING * float(np.abs(bore).max()) * float(np.trace(stiffness)) / size
            if missed < max(_CLOSE, known):
                return tips.pressure(gap), missed, place
            step = np.linalg.lstsq(stiffness, left, rcond=1e-12)[0]
            if not left @ step > 0:  # nothing touches: no stiffness
                step = left / size * tips.roughness
            place, left = _stepped(missing, place, left, step)
        raise SolverError(
            f"wear: asperities do not carry {size:.4g} N after {_NEWTON} steps, {missed:.2g} left"
        )


def _pushed(missing: Callable[[Array], Array], place: Array, way: Array, roughness: float) -> Array:
    """The place along the load, to a roughness, where asperities carry about all of it."""
    low, high = -roughness, roughness
    while missing(place + low * way) @ way < 0:
        low *= 2.0
    while missing(place + high * way) @ way > 0:
        high *= 2.0
    while high - low > roughness:
        middle = 0.5 * (low + high)
        if missing(place + middle * way) @ way > 0:
            low = middle
        else:
            high = middle
    return place + high * way


def _stepped(
    missing: Callable[[Array], Array], place: Array, left: Array, step: Array
) -> tuple[Array, Array]:
    """The place along a step, longer or shorter, that halves what is `left` along it, and its own.

    What asperities store is convex: what is missing along a line falls from its start on.
    """
    start, low, high, length = float(left @ step), 0.0, np.inf, 1.0
    for _ in range(_TRIES):
        there = place + length * step
        left = missing(there)
        along = float(left @ step)
        if abs(along) <= 0.5 * start:
            break
        low, high = (length, high) if along > 0 else (low, length)
        length = 2.0 * length if high == np.inf else 0.5 * (low + high)
    return there, left
