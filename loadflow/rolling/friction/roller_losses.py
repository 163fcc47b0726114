"""Friction of a roller bearing in ideal rolling: film, Λ, and each component's loss.

Rollers turn at ideal speed; what each contact must pull for that is compared with what it can
(`traction_use`; above 1 the roller skids and its speed is a matter of dynamics). Barrels slide
where their contacts are curved along them (`differential_slip`). Losses are powers; the torque is
their sum over the speed.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.rolling.friction import rolling_resistance as resistance
from loadflow.rolling.friction.bearing import (
    RINGS,
    BearingFriction,
    ContactFriction,
    case_speeds,
    contact_friction,
    sum_losses,
)
from loadflow.rolling.friction.contact_films import (
    ContactFilm,
    Ring,
    line_film,
    raceway_radius,
    sphere_film,
)
from loadflow.rolling.friction.differential_slip import (
    CurvedLines,
    curved_lines,
    sliding_coefficient,
)
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.kinematics import entrainment_speed
from loadflow.rolling.results import ContactResult
from loadflow.rolling.roller_raceways import RollerRaceways
from loadflow.tribology import asperities
from loadflow.tribology.hertz import effective_modulus

Array = NDArray[np.float64]


def roller_friction(
    result: ContactResult[RollerRaceways], speed: ArrayLike, options: FrictionOptions
) -> BearingFriction:
    """Film, Λ and losses of every contact of a roller bearing.

    Rollers count with their mean line load (the film depends on it as W^-0.1, the rolling force as
    W^0.25).

    Parameters
    ----------
    result : ContactResult
        Load distribution, cases (...).
    speed : array_like
        Speed of the inner ring (less that of the outer), rad/s; broadcasts with the cases.
    options : FrictionOptions
        Lubricant, surfaces, ribs, churning, seals.

    Returns
    -------
    BearingFriction
        Over the cases (...) and contacts (..., row, roller, ring).

    Raises
    ------
    InputError
        If the speed is not finite or does not fit the cases.

    Examples
    --------
    >>> from loadflow.rolling import FrictionOptions, RollerBearing
    >>> from loadflow.tribology import lubricant
    >>> pair = RollerBearing(rollers=48, roller_diameter=0.04, roller_length=0.06,
    ...     pitch_diameter=0.8, contact_angle=0.35, rows=2, row_spacing=0.12, clearance=-20e-6)
    >>> loaded = pair.equilibrium(force=(0, -4e5, 1e5))
    >>> grease = FrictionOptions(oil=lubricant("lgwm-2"), temperature=313.15)
    >>> friction = roller_friction(loaded, 1.5, grease)
    >>> sorted(friction.losses)
    ['churning', 'drag', 'hysteresis', 'rib', 'rolling', 'seal']
    """
    omega = case_speeds(speed, result.cases)
    bearing, rollers = result.bearing, result.roller_forces
    force = np.broadcast_to(rollers, (*omega.shape, *rollers.shape[-2:]))
    mean = entrainment_speed(omega, 0.0, bearing.pitch_diameter, bearing.gamma)
    u = np.asarray(mean)[..., None, None]
    films, contacts = zip(*(_contact(result, ring, force, u, options) for ring in RINGS))
    special = {"rib": _rib_loss(result, force, u, options)}
    if not bearing.contact_curvature:
        return sum_losses(omega, u, bearing.roller_diameter, contacts, special, options)
    lines = curved_lines(bearing, force)
    slips = [_barrel_slip(lines, *ring, force, u, options) for ring in zip(films, contacts)]
    special["differential slip"] = np.asarray(slips[0].power + slips[1].power)
    found = sum_losses(omega, u, bearing.roller_diameter, contacts, special, options)
    return replace(
        found,
        sliding=np.maximum(slips[0].ratio, slips[1].ratio),
        slip_power_density=np.maximum(slips[0].density, slips[1].density),
    )


class _Slip(NamedTuple):
    """Of barrels on one ring: power, W, over the area, W/m², mean sliding over rolling speed."""

    power: Array
    density: Array
    ratio: Array


def _barrel_slip(
    lines: CurvedLines,
    film: ContactFilm,
    contact: ContactFriction,
    force: Array,
    u: Array,
    options: FrictionOptions,
) -> _Slip:
    """Differential slip of barrels on one ring."""
    pressed = film._replace(pressure=film.pressure / lines.area)
    ratio = np.where((force > 0) & (u > 0), lines.lever / film.radius, 0.0)
    power = sliding_coefficient(pressed, contact.share, ratio * u, options) * force * ratio * u
    area = 2 * film.half_width * film.length * lines.area
    density = np.divide(power, area, out=np.zeros_like(power), where=area > 0)
    return _Slip(np.asarray(power), density, ratio)


def _rib_loss(
    result: ContactResult[RollerRaceways], force: Array, u: Array, options: FrictionOptions
) -> Array:
    """Loss of roller ends on the ribs of the inner ring, W.

    A rib contact at height e slides with e u/R_eff, the rolling speed times its distance from the
    raceway.
    """
    bearing = result.bearing
    pressed = np.sin(options.rib_angle) * force
    radius = raceway_radius(bearing.roller_diameter, bearing.gamma, "inner")
    sliding = options.rib_height * u / radius
    friction: float | Array = options.rib_friction
    if options.rib_radius is not None:
        modulus = 2 * float(effective_modulus(bearing.elastic_modulus, bearing.poisson_ratio))
        film = sphere_film(pressed, options.rib_radius, modulus, u, options)
        share = asperities.asperity_share(asperities.film_parameter(film, options.roughness))
        friction = options.rib_friction + share * (options.boundary_friction - options.rib_friction)
    return np.asarray(friction * pressed * sliding)


def _contact(
    result: ContactResult[RollerRaceways],
    ring: Ring,
    force: Array,
    u: Array,
    options: FrictionOptions,
) -> tuple[ContactFilm, ContactFriction]:
    """Film and friction of all contacts with one ring."""
    bearing, oil, t = result.bearing, options.oil, options.temperature
    modulus = 2 * float(effective_modulus(bearing.elastic_modulus, bearing.poisson_ratio))
    length = bearing.roller_length
    radius = raceway_radius(bearing.roller_diameter, bearing.gamma, ring)
    film = line_film(force, length, radius, modulus, u, options)
    viscosity, alpha = float(oil.viscosity(t)), float(oil.pressure_viscosity(t))
    rolling = resistance.hydrodynamic_force(force, length, radius, u, viscosity, alpha, modulus)
    moment = resistance.hysteresis_moment(force, film.half_width, options.hysteresis)
    hysteresis = np.asarray(moment / (2 * radius))
    return film, contact_friction(force, film, np.asarray(rolling), hysteresis, options)
