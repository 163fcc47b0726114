"""Film of every contact of a bearing: roller on raceway, ball in groove."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.raceways import BallRaceways
from loadflow.tribology import contact_film
from loadflow.tribology.hertz import effective_modulus

Array = NDArray[np.float64]
Ring = Literal["inner", "outer"]


class ContactFilm(NamedTuple):
    """Film and Hertzian strip of contacts, arrays of one shape.

    `film` is central, m, 0 at standstill; `half_width` along rolling and `length` across, m, of a
    strip of the contact's area; `pressure` the mean one, Pa; `radius` R_eff along rolling, m;
    `share` what thermal and starved inlets leave of the flooded isothermal film.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling import FrictionOptions
    >>> from loadflow.rolling.friction import line_film
    >>> from loadflow.tribology import lubricant
    >>> options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> found = line_film(np.array([1e4]), 0.06, 0.018, 2.3e11, np.array([2.0]), options)
    >>> found._fields
    ('film', 'half_width', 'length', 'pressure', 'radius', 'share')
    """

    film: Array
    half_width: Array
    length: Array
    pressure: Array
    radius: float
    share: Array


def raceway_radius(roller_diameter: float, gamma: float, ring: Ring) -> float:
    """Reduced radius ρ (1 ∓ γ) of rolling element and raceway, m, (5.66), (5.67).

    Parameters
    ----------
    roller_diameter : float
        m.
    gamma : float
        γ = D_w cos α/D_pw.
    ring : {"inner", "outer"}
        Which raceway: 1 - γ at the inner, 1 + γ at the outer one.

    Returns
    -------
    float
        m.

    Examples
    --------
    >>> from loadflow.rolling.friction import raceway_radius
    >>> round(raceway_radius(11e-3, 11 / 60.5, "inner") * 1e3, 3)  # mm
    4.5
    """
    return roller_diameter / 2 * (1 - gamma if ring == "inner" else 1 + gamma)


def line_film(
    force: Array,
    length: float,
    radius: float,
    modulus: float,
    mean_speed: Array,
    options: FrictionOptions,
) -> ContactFilm:
    """Film between a roller, or a slice of it, and a raceway.

    Parameters
    ----------
    force : ndarray
        N, not negative.
    length : float
        Effective length, m.
    radius : float
        `raceway_radius`, m.
    modulus : float
        Reduced modulus E₀ = 2 E*, Pa.
    mean_speed : ndarray
        Mean surface speed u ≥ 0, m/s; broadcasts with `force`.
    options : FrictionOptions
        Oil, temperature, film law, starvation.

    Returns
    -------
    ContactFilm
        Film, pressure and size of the contacts.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling import FrictionOptions
    >>> from loadflow.rolling.friction import line_film
    >>> from loadflow.tribology import lubricant
    >>> options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> still, turning = line_film(np.array([1e4]), 0.06, 0.018, 2.3e11, np.array([0.0, 2.0]),
    ...     options).film
    >>> float(still), bool(5e-7 < turning < 5e-6)
    (0.0, True)
    """
    half_width = np.sqrt(8 * force * radius / (np.pi * length * modulus))
    pressure = force / np.maximum(2 * half_width * length, 1e-30)
    material, speed, share = _inlet(mean_speed, radius, modulus, options)
    load = force / (modulus * radius * length)
    ratio = contact_film.film_ratio(options.film, material, speed, load)
    film = _thickness(mean_speed, share * ratio * radius)
    return ContactFilm(film, half_width, np.full_like(force, length), pressure, radius, share)


def groove_film(
    bearing: BallRaceways,
    ring: Ring,
    force: Array,
    mean_speed: Array,
    options: FrictionOptions,
) -> ContactFilm:
    """Film between balls and a groove (Hamrock and Dowson, central).

    Parameters
    ----------
    bearing : BallRaceways
        Ball bearing.
    ring : {"inner", "outer"}
        Which groove.
    force, mean_speed, options
        As `line_film`.

    Returns
    -------
    ContactFilm
        Film, pressure and size of the contacts.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling import BallBearing, FrictionOptions
    >>> from loadflow.rolling.friction import groove_film
    >>> from loadflow.tribology import lubricant
    >>> bearing = BallBearing(balls=16, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208)
    >>> options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> slow, fast = groove_film(bearing, "inner", np.array([5e3]), np.array([1.0, 2.0]),
    ...     options).film
    >>> bool(fast > slow > 0.0)
    True
    """
    radius = raceway_radius(bearing.ball_diameter, bearing.gamma, ring)
    modulus = 2 * float(effective_modulus(bearing.elastic_modulus, bearing.poisson_ratio))
    contact = bearing.raceway_contact(ring, force)
    across, along = contact.semi_axes
    material, speed, share = _inlet(mean_speed, radius, modulus, options)
    load = np.maximum(force, 1e-9) / (modulus * radius**2)
    ratio = contact_film.hamrock_dowson_central(material, speed, load, contact.ellipticity)
    film = _thickness(mean_speed, share * ratio * radius)
    return ContactFilm(film, along, np.pi / 2 * across, 2 / 3 * contact.pressure, radius, share)


def sphere_film(
    force: Array, radius: float, modulus: float, mean_speed: Array, options: FrictionOptions
) -> Array:
    """Central film of a circular contact, m, as a roller end on a rib; 0 at standstill.

    Parameters
    ----------
    force, modulus, mean_speed, options
        As `line_film`.
    radius : float
        Reduced radius, m.

    Returns
    -------
    ndarray
        m.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling import FrictionOptions
    >>> from loadflow.rolling.friction import sphere_film
    >>> from loadflow.tribology import lubricant
    >>> options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> film = sphere_film(np.array([100.0]), 0.5, 2.3e11, np.array([0.0, 1.0]), options)
    >>> bool(film[0] == 0.0 < film[1])
    True
    """
    material, speed, share = _inlet(mean_speed, radius, modulus, options)
    load = force / (modulus * radius**2)
    ratio = contact_film.nijenbanning_point(material, speed, load, 1.0)
    return _thickness(mean_speed, share * ratio * radius)


def _inlet(
    mean_speed: Array, radius: float, modulus: float, options: FrictionOptions
) -> tuple[float, Array, Array]:
    """Material and speed parameter of a film, and what heat and starvation leave of it."""
    oil, t = options.oil, options.temperature
    viscosity = float(oil.viscosity(t))
    loading = contact_film.thermal_loading(
        viscosity, float(oil.steepness(t)), mean_speed, float(oil.conductivity(t))
    )
    share = options.starvation * contact_film.thermal_factor(loading)
    speed = viscosity * np.maximum(mean_speed, 1e-12) / (modulus * radius)
    return float(oil.pressure_viscosity(t)) * modulus, speed, np.asarray(share)


def _thickness(mean_speed: Array, film: Array) -> Array:
    """The film where surfaces move, 0 at standstill."""
    return np.asarray(np.where(mean_speed > 0, film, 0.0))
