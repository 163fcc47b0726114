"""Friction of a ball or slewing bearing: film, Λ, rolling, differential slip, spin.

The wide contact of a ball in its groove rolls purely along two lines only; elsewhere the surfaces
slide (Heathcote). Under a contact angle the rings also turn against each other about the normal;
the contact with the smaller moment of friction takes that spin (raceway control). Both losses are
those of a constant friction coefficient over the ellipse, formed from asperities and from the film
at the contact's mean sliding speed.

References
----------
Johnson: Contact Mechanics, ch. 8 (rolling of conforming surfaces). Harris, Kotzalas: Advanced
Concepts of Bearing Technology, ch. 2, 5.
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
from loadflow.rolling.friction.contact_films import Ring, groove_film
from loadflow.rolling.friction.differential_slip import sliding_coefficient
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.kinematics import entrainment_speed
from loadflow.rolling.raceways import BallRaceways
from loadflow.rolling.results import ContactResult
from loadflow.tribology.hertz import effective_modulus

Array = NDArray[np.float64]

# Pressure of an ellipse, constant μ, no net traction: pure rolling at 0.3473 of the semi-axis,
# loss this factor times μ Q and the greatest difference of speed, u a²/(2 R_x R_groove)
_HEATHCOTE = 0.16114240
_ELLIPSE_HYSTERESIS = 3 / 16  # ∫ p x over the leading half of an ellipse, over Q b


class _Groove(NamedTuple):
    """Balls on one ring: friction, friction coefficient, semi-axis, differential speed, area."""

    contact: ContactFriction
    coefficient: Array
    across: Array
    slip: Array
    area: Array


def ball_friction(
    result: ContactResult[BallRaceways], speed: ArrayLike, options: FrictionOptions
) -> BearingFriction:
    """Film, Λ and losses of every contact of a ball bearing.

    Parameters
    ----------
    result : ContactResult
        Load distribution of a ball or slewing bearing, cases (...).
    speed : array_like
        Speed of the inner ring (less that of the outer), rad/s; broadcasts with the cases.
    options : FrictionOptions
        Lubricant, surfaces, churning, seals; ribs are not used.

    Returns
    -------
    BearingFriction
        Over the cases (...) and contacts (..., kind, ball, ring).

    Raises
    ------
    InputError
        If the speed is not finite or does not fit the cases.

    Examples
    --------
    >>> from loadflow.rolling import BallBearing, FrictionOptions
    >>> from loadflow.tribology import lubricant
    >>> bearing = BallBearing(balls=9, ball_diameter=12.7e-3, pitch_diameter=65e-3,
    ...     groove_radius=0.52 * 12.7e-3)
    >>> loaded = bearing.equilibrium(force=(2000, 0, 500))
    >>> oil = FrictionOptions(oil=lubricant("iso-vg-68"), temperature=333.15)
    >>> friction = ball_friction(loaded, 100.0, oil)
    >>> sorted(friction.losses)
    ['churning', 'differential slip', 'drag', 'hysteresis', 'rolling', 'seal', 'spin']
    """
    omega = case_speeds(speed, result.cases)
    bearing, balls = result.bearing, result.contact_forces
    shape = (*omega.shape, *balls.shape[-2:])
    force = np.broadcast_to(balls, shape)
    sine = np.broadcast_to(np.abs(result.contact_directions[..., 2]), shape)
    mean = entrainment_speed(omega, 0.0, bearing.pitch_diameter, bearing.gamma)
    u = np.asarray(mean)[..., None, None]
    turning = np.abs(omega)[..., None, None] * sine
    inner, outer = (_groove(result, ring, force, u, turning, options) for ring in RINGS)
    both = (inner, outer)
    # spin moment 3/8 μ Q a E(k), E(k) = 1 for the long ellipses of grooves
    moments = [3 / 8 * g.coefficient * force * g.across for g in both]
    curved = [_HEATHCOTE * g.coefficient * force * g.slip for g in both]
    inside = moments[0] <= moments[1]  # the ring on which the ball spins
    spinning = [np.where(here, m * turning, 0.0) for here, m in zip((inside, ~inside), moments)]
    special = {
        "differential slip": np.asarray(curved[0] + curved[1]),
        "spin": np.asarray(spinning[0] + spinning[1]),
    }
    found = sum_losses(omega, u, bearing.ball_diameter, [g.contact for g in both], special, options)
    arm = np.where(inside, inner.across, outer.across)
    sliding = _HEATHCOTE * np.maximum(inner.slip, outer.slip) + 3 / 8 * arm * turning
    loaded = (force > 0) & (u > 0)
    density = [
        np.divide(c + s, g.area, out=np.zeros(shape), where=loaded)
        for c, s, g in zip(curved, spinning, both)
    ]
    return replace(
        found,
        sliding=np.divide(sliding, u, out=np.zeros(shape), where=loaded),
        slip_power_density=np.maximum(*density),
    )


def _groove(
    result: ContactResult[BallRaceways],
    ring: Ring,
    force: Array,
    u: Array,
    turning: Array,
    options: FrictionOptions,
) -> _Groove:
    """Friction of all contacts with one ring."""
    bearing, oil, t = result.bearing, options.oil, options.temperature
    film = groove_film(bearing, ring, force, np.broadcast_to(u, force.shape), options)
    modulus = 2 * float(effective_modulus(bearing.elastic_modulus, bearing.poisson_ratio))
    across = film.length * 2 / np.pi
    viscosity, alpha = float(oil.viscosity(t)), float(oil.pressure_viscosity(t))
    span = np.where(force > 0, 2 * across, 1.0)
    rolling = resistance.hydrodynamic_force(force, span, film.radius, u, viscosity, alpha, modulus)
    moment = _ELLIPSE_HYSTERESIS * options.hysteresis * force * film.half_width
    contact = contact_friction(
        force, film, np.asarray(rolling), np.asarray(moment / (2 * film.radius)), options
    )
    groove, ball = bearing.groove(ring), bearing.ball_diameter / 2
    deformed = 2 * groove * ball / (groove + ball)
    slip = u * across**2 / (2 * film.radius * deformed)
    sliding = _HEATHCOTE * slip + 3 / 8 * across * turning
    coefficient = sliding_coefficient(film, contact.share, sliding, options)
    return _Groove(contact, coefficient, across, slip, 2 * film.half_width * film.length)
