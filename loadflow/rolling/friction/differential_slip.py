"""Differential slip: contacts that are curved across the direction of rolling slide in part.

A surface that bulges by h over a contact runs faster or slower there by h times the speed of
rolling, so that rolling is pure on two lines at most; elsewhere the surfaces slide (Heathcote). The
friction coefficient is constant over a contact, and what slides forward balances what slides back:
h on the lines without slip is its median over the load, and the mean sliding speed is the mean
distance from it.

References
----------
Johnson: Contact Mechanics, ch. 8 (rolling of conforming surfaces). Harris, Kotzalas: Advanced
Concepts of Bearing Technology, ch. 2, 5.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.rolling.friction.contact_films import ContactFilm
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.roller_raceways import RollerRaceways
from loadflow.tribology import traction

Array = NDArray[np.float64]

_STATIONS = (np.arange(200) + 0.5) / 100 - 1  # over the loaded length of a roller
_APPROACHES = np.geomspace(1e-7, 0.05, 160)  # over the diameter; a roller gives way by 1e-5 … 1e-2


class CurvedLines(NamedTuple):
    """Rollers along which their raceways curve, arrays over the forces.

    `lever` is the mean sliding speed over the relative turning u/R_eff of roller and raceway, m;
    `area` that of the contact over a strip of equal load along the whole roller.

    Examples
    --------
    >>> from loadflow.rolling.friction.differential_slip import CurvedLines
    >>> CurvedLines._fields
    ('lever', 'area')
    """

    lever: Array
    area: Array


def mean_deviation(height: Array, weight: Array) -> Array:
    """Mean distance of heights from their median, both over `weight`; along the last axis.

    Times μ and the load it is the loss by a constant friction coefficient of surfaces that slide by
    `height` less what balances.

    Parameters
    ----------
    height : ndarray
        m, or m/s.
    weight : ndarray
        Load at each height; not negative.

    Examples
    --------
    Half of an even load lies within half of the length, where a parabola has risen to 1/4:

    >>> import numpy as np
    >>> from loadflow.rolling.friction.differential_slip import mean_deviation
    >>> y = (np.arange(1000) + 0.5) / 500 - 1
    >>> round(float(mean_deviation(y**2, np.ones(1000))), 4)
    0.25
    """
    order = np.argsort(height, axis=-1)
    rising, load = (np.take_along_axis(a, order, axis=-1) for a in (height, weight))
    total = load.sum(axis=-1, keepdims=True)
    middle = np.argmax(load.cumsum(axis=-1) >= total / 2, axis=-1, keepdims=True)
    away = np.abs(rising - np.take_along_axis(rising, middle, axis=-1))
    return np.asarray((away * load).sum(axis=-1) / total[..., 0])


def curved_lines(bearing: RollerRaceways, force: Array) -> CurvedLines:
    """Lever of the slip and area of the contacts of rollers in raceways curved along them.

    The height of the contact along the roller is that of the deformed surfaces, midway between
    both, and of the raceway that leans by the contact angle against the axis of the bearing: the
    ring turns about the contact's normal, the roller does not. The load lies along the roller as
    its profile leaves it, whatever the slices; no tilt.

    Parameters
    ----------
    bearing : RollerRaceways
        Rollers, profile, `contact_curvature`.
    force : ndarray
        On each roller, N; not negative.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling import SphericalRollerBearing
    >>> from loadflow.rolling.friction.differential_slip import curved_lines
    >>> bearing = SphericalRollerBearing(rollers=28, roller_diameter=0.08, roller_length=0.12,
    ...     pitch_diameter=0.95, contact_angle=0.17, profile="crowned", crown_radius=15.0)
    >>> found = curved_lines(bearing, np.array([1e4, 1e5]))
    >>> bool(0 < found.lever[0] < found.lever[1] < 1e-3), bool((found.area < 1).all())
    (True, True)
    """
    known, lever, area = _by_load(bearing)
    asked = np.log(np.maximum(force, 1e-9))
    return CurvedLines(*(np.exp(np.interp(asked, known, values)) for values in (lever, area)))


@lru_cache(maxsize=16)  # of a bearing that is asked case by case
def _by_load(bearing: RollerRaceways) -> tuple[Array, Array, Array]:
    """Logarithms of the load of a roller, and of lever and area under it."""
    approach = (_APPROACHES * bearing.roller_diameter)[:, None]
    reach = _loaded_half(bearing, approach)
    place = reach * _STATIONS
    # both contacts of a roller drop by its profile, as its slices do
    load = np.maximum(approach - 2 * bearing.drop_at(place), 0.0) ** (10 / 9)
    lean = bearing.roller_diameter * np.sin(bearing.contact_angle) / bearing.pitch_diameter
    height = bearing.contact_curvature / 2 * place**2 + lean * place
    share, mean = 2 * reach[:, 0] / bearing.roller_length, load.mean(axis=-1)
    total = np.log(bearing.slices * bearing.slice_stiffness * share * mean)
    # a Hertzian strip is as wide as the root of its load
    area = np.sqrt(share / mean) * np.sqrt(load).mean(axis=-1)
    return total, np.log(mean_deviation(height, load)), np.log(area)


def _loaded_half(bearing: RollerRaceways, approach: Array) -> Array:
    """Half the length on which rollers touch under an approach (both contacts), m, by halving."""
    low, high = np.zeros_like(approach), np.full_like(approach, bearing.roller_length / 2)
    for _ in range(40):
        middle = (low + high) / 2
        touches = 2 * bearing.drop_at(middle) < approach
        low, high = np.where(touches, middle, low), np.where(touches, high, middle)
    return high


def sliding_coefficient(
    film: ContactFilm, share: Array, sliding: Array, options: FrictionOptions
) -> Array:
    """Friction coefficient of film and asperities of contacts at a sliding speed.

    Parameters
    ----------
    film : ContactFilm
        Of the contacts.
    share : ndarray
        Share of the load that asperities carry.
    sliding : ndarray
        Mean sliding speed in the contact, m/s.
    options : FrictionOptions
        Oil, temperature, boundary friction.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling import FrictionOptions
    >>> from loadflow.rolling.friction import line_film
    >>> from loadflow.rolling.friction.differential_slip import sliding_coefficient
    >>> from loadflow.tribology import lubricant
    >>> options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> film = line_film(np.array([1e5]), 0.06, 0.018, 2.3e11, np.array([2.0]), options)
    >>> dry = sliding_coefficient(film, np.ones(1), np.array([0.01]), options)
    >>> full = sliding_coefficient(film, np.zeros(1), np.array([0.01]), options)
    >>> float(dry[0]), bool(0 < full[0] < 0.08)
    (0.12, True)
    """
    oil = options.oil
    limit = traction.limiting_stress(
        film.pressure, oil.critical_stress, oil.critical_pressure, oil.limiting_slope
    )
    viscosity = oil.viscosity(options.temperature, film.pressure)
    there = (film.film > 0) & (film.pressure > 0)
    newton = traction.newtonian_stress(viscosity, sliding, np.where(there, film.film, 1.0))
    stress = traction.smooth_stress(newton, limit)
    fluid = np.divide(stress, film.pressure, out=np.zeros_like(stress), where=there)
    return np.asarray((1 - share) * fluid + share * options.boundary_friction)
