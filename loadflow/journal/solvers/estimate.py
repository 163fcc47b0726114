"""Position of the shaft by Butenschön's closed form: where Newton starts."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import SolverError
from loadflow.journal.solvers.messages import narrowest_place
from loadflow.journal.solvers.pads.estimate import on_pads
from loadflow.tribology.film import butenschoen

if TYPE_CHECKING:
    from loadflow.journal.film.film import DiscreteFilm
    from loadflow.journal.film.gap.gap import BoreGap
    from loadflow.journal.film.gap.shaped import ShapedGap
    from loadflow.journal.geometry import JournalGeometry

Array = NDArray[np.float64]

NEAR = 0.3  # share of the narrowest gap that the estimate may move for a warm start

SHARES = (1.0, 0.7, 0.4, 0.1)  # of the closed form, at which the bore is tried
OFF_THE_BORE = (0.8, 0.6, 0.4, 0.2)  # of the first position, where that one led nowhere
_RATIOS = np.concatenate([np.linspace(0.0, 0.9, 91)[1:], 1.0 - np.geomspace(0.099, 1e-4, 60)])


def closed_form_position(
    width_ratio: float, number: ArrayLike, force: Array, speed: ArrayLike, ruptures: bool
) -> Array:
    """Position (…, 2), in clearances, under `force` (…, 2) at Sommerfeld numbers `number` (…).

    Parameters
    ----------
    width_ratio : float
        B/D.
    number, speed : array_like (…)
        So, ≥ 0, and the speed, of which only the sign counts.
    ruptures : bool
        Whether the film ruptures; a full one has an attitude of a right angle.
    """
    numbers, attitudes = _closed_form(width_ratio)
    wanted = np.asarray(number)
    ratio = np.interp(wanted, numbers, _RATIOS) * np.minimum(wanted / numbers[0], 1.0)
    attitude = np.interp(ratio, _RATIOS, attitudes) if ruptures else 0.5 * np.pi
    turn = np.arctan2(force[..., 1], force[..., 0]) + np.sign(speed) * attitude
    return ratio[..., None] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)


def first_position(
    bearing: JournalGeometry,
    film: DiscreteFilm,
    gap: BoreGap,
    load: Array,
    held: Array,
    free: slice | NDArray[np.int64],
    near: Array | None = None,
) -> Array:
    """Where Newton starts: the closed form of the cylinder, shrunk to what the bore leaves.

    Parameters
    ----------
    bearing, film, gap
        The bearing, its film at the speed that is set, and the gap of that.
    load : array (2,)
        N.
    held : array (m,)
        Centred position with what is given of the shaft.
    free : slice or array of int
        Degrees of freedom of the shaft that move.
    near : array (2 + pads,), optional
        Shaft and pads of a similar film, from which it starts if they have room.

    Raises
    ------
    loadflow.errors.SolverError
        The shaft touches the bore wherever it is.
    """
    if near is not None:
        start = np.concatenate([near[:2], held[2 : gap.shaft], near[2:]])
        if gap.narrowest(start) > 0.0:
            return start
    if gap.pads.size:
        afloat = on_pads(film, cast("ShapedGap", gap), load)
        if afloat is not None:
            start = gap.lifted(np.append(afloat, held[2:]), film.speed)
            if gap.narrowest(start) > 0.0:
                return start
    position, size = held.copy(), float(np.hypot(*load))
    if film.speed != 0.0:
        number = bearing.sommerfeld_number(size, film.speed, film.viscosity)
        form = bearing.width_ratio, number, load, film.speed, film.ruptures
        position[:2] = closed_form_position(*form)
    if gap.pads.size:  # pads leave the shaft no side to go to
        position[:2] = math.hypot(*position[:2]) / max(size, 1e-300) * load
    if film.contact is not None and load.any():
        return closer_of(film, load, position)
    for share in SHARES:
        start = gap.lifted(np.append(share * position[:2], position[2:]), film.speed)
        if gap.narrowest(start) > gap.first_gap:
            return start
    start = gap.widest(held, free)
    if gap.narrowest(start) <= 0.0:
        place = narrowest_place(bearing, gap, start)
        raise SolverError(f"the shaft touches the bore in any position: {place}")
    return start


_FAR = 64.0  # eccentricity ratio at which nothing is touched in this direction
_FINE = 0.05  # of the roughness, to which asperities are asked where they carry a load


def closer_of(film: DiscreteFilm, load: Array, position: Array) -> Array:
    """Start of rough surfaces: the closed form, or where asperities alone carry, if that is nearer.

    Together they carry more than either, so that the shaft lies less far out than in both. A shaft
    that is tilted or bent meets the shell on other sides, too: also towards the closed form it goes
    no farther than to where asperities carry as much as the load.

    Parameters
    ----------
    film : DiscreteFilm
        With `contact`; without, or without load, the closed form remains.
    load : array (2,)
        N.
    position : array (m,)
        By the closed form, clearances; what is not eccentricity is held.
    """
    size, asperities = math.hypot(*load), film.contact
    if asperities is None or size == 0.0:
        return position
    far, toward = math.hypot(*position[:2]), load / size
    turns = film.speed != 0.0 and far > 0.0
    way = position[:2] / far if turns else toward

    def carries(ratio: float, way: Array) -> bool:
        """Whether asperities carry as much as the load at an eccentricity ratio."""
        place = _at(position, ratio * way)
        if not film.gap.narrowest(place) > 0.0:
            return True
        return math.hypot(*asperities.at(place).load[:2]) >= size

    if turns and not (carries(far, way) or carries(far, toward)):  # most films: two are cheap
        return position
    straight = _until_pressed(lambda ratio: carries(ratio, toward), film.gap.roughness)
    if math.isinf(straight):
        return position
    if turns and far < straight:
        pressed = _until_pressed(lambda ratio: carries(ratio, way), film.gap.roughness)
        return _at(position, min(far, pressed) * way)
    return _at(position, straight * toward)


def _until_pressed(carries: Callable[[float], bool], roughness: float) -> float:
    """Eccentricity ratio up to which asperities carry less than the load."""
    low, high = 0.0, 1.0
    while not carries(high) and high < _FAR:
        low, high = high, 2.0 * high
    if high >= _FAR:
        return math.inf
    while high - low > _FINE * roughness:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if carries(middle) else (middle, high)
    return low


def _at(held: Array, place: Array) -> Array:
    """The position `held`, at another eccentricity."""
    return np.append(place, held[2:])


@lru_cache(maxsize=32)
def _closed_form(width_ratio: float) -> tuple[Array, Array]:
    """So and attitude over `_RATIOS`, the width kept within the validity of the closed form."""
    return butenschoen(_RATIOS, min(max(width_ratio, 0.125), 1.0))
