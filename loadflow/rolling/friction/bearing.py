"""What the friction of all bearings shares: the result, and the sum over contacts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.rolling.friction.contact_films import ContactFilm, Ring
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.tribology import asperities, traction

Array = NDArray[np.float64]
RINGS: tuple[Ring, ...] = ("inner", "outer")


@dataclass(frozen=True)
class BearingFriction:
    """Friction of a bearing; contacts over (..., row, element, ring), ring = inner, outer.

    Of ball bearings the axis of rows is that of their kinds of contact (row and diagonal).

    Attributes
    ----------
    speed : ndarray, shape (...)
        Speed of the inner less that of the outer ring, rad/s.
    losses : dict of str to ndarray, shape (...)
        Power of each component, W: hysteresis, rolling, drag, churning, seal; rib of roller
        bearings; differential slip of balls and of barrels (of these with the turning of the
        rings about the contact's normal); spin of balls.
    film : ndarray
        Central film, m; very large where a turning contact has no load, 0 at standstill.
    film_parameter : ndarray
        Λ.
    asperity_share : ndarray
        Share of the load that asperities carry; 0 without load.
    traction_use : ndarray, shape (..., row, element)
        Friction that ideal rolling needs over what both contacts can give.
    sliding : ndarray, shape (..., row, element), optional
        Of balls and barrels: mean sliding speed in the contact over the rolling speed, from the
        curved contact and from spin; 0 without load.
    slip_power_density : ndarray, shape (..., row, element), optional
        Of these: power of that sliding over the area of the contact, W/m², the larger of both.

    Examples
    --------
    >>> from loadflow.rolling import FrictionOptions, RollerBearing
    >>> from loadflow.rolling.friction import roller_friction
    >>> from loadflow.tribology import lubricant
    >>> bearing = RollerBearing(rollers=24, roller_diameter=0.04, roller_length=0.06,
    ...     pitch_diameter=0.5)
    >>> options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> found = roller_friction(bearing.equilibrium((1e5, 0.0, 0.0)), 10.0, options)
    >>> sorted(found.losses), found.film_parameter.shape
    (['churning', 'drag', 'hysteresis', 'rib', 'rolling', 'seal'], (1, 24, 2))
    """

    speed: Array
    losses: dict[str, Array]
    film: Array
    film_parameter: Array
    asperity_share: Array
    traction_use: Array
    sliding: Array | None = None
    slip_power_density: Array | None = None

    @property
    def power(self) -> Array:
        """All losses together, W."""
        return np.asarray(sum(self.losses.values()))

    @property
    def torque(self) -> Array:
        """Friction torque, N m."""
        return np.asarray(sum(self.torques.values()))

    @property
    def torques(self) -> dict[str, Array]:
        """Torque of each component, N m; all vanish at standstill (breakaway is not modelled)."""
        turning = np.abs(self.speed)
        safe = np.where(turning > 0, turning, 1.0)
        return {name: np.asarray(p / safe) for name, p in self.losses.items()}


class ContactFriction(NamedTuple):
    """Contacts with one ring: film, rolling forces on each surface (N), what friction can give (N).

    `parameter` is Λ, `share` that of the asperities.
    """

    film: Array
    parameter: Array
    share: Array
    rolling: Array
    hysteresis: Array
    grip: Array


def contact_friction(
    force: Array, film: ContactFilm, rolling: Array, hysteresis: Array, options: FrictionOptions
) -> ContactFriction:
    """Collect the friction of the contacts with one ring.

    Parameters
    ----------
    force : ndarray
        N.
    film : ContactFilm
        Of the contacts.
    rolling, hysteresis : ndarray
        Hydrodynamic rolling force of a flooded cold inlet, and that of hysteresis, N.
    options : FrictionOptions
        Oil and surfaces.
    """
    oil = options.oil
    parameter = np.asarray(asperities.film_parameter(film.film, options.roughness))
    share = np.where(force > 0, asperities.asperity_share(parameter), 0.0)
    limit = traction.limiting_stress(
        film.pressure, oil.critical_stress, oil.critical_pressure, oil.limiting_slope
    )
    area = 2 * film.half_width * film.length
    grip = traction.mixed_force(limit, area, force, share, options.boundary_friction)
    return ContactFriction(
        film.film, parameter, share, np.asarray(film.share * rolling), hysteresis, np.asarray(grip)
    )


def case_speeds(speed: ArrayLike, cases: tuple[int, ...]) -> Array:
    """Speeds broadcast with the cases; an `InputError` where they do not fit."""
    omega = np.asarray(speed, float)
    if not np.isfinite(omega).all():
        raise InputError("speed: must be finite")
    try:
        return np.broadcast_to(omega, np.broadcast_shapes(omega.shape, cases))
    except ValueError:
        raise InputError(f"speed {omega.shape} does not fit the cases {cases}") from None


def sum_losses(
    speed: Array,
    mean_speed: Array,
    diameter: float,
    contacts: Sequence[ContactFriction],
    special: dict[str, Array],
    options: FrictionOptions,
) -> BearingFriction:
    """Friction of a bearing from its contacts.

    Parameters
    ----------
    speed : ndarray, shape (...)
        rad/s.
    mean_speed : ndarray
        Mean surface speed of the contacts, m/s, broadcasts with them.
    diameter : float
        Of the rolling elements, m.
    contacts : sequence of ContactFriction
        With the inner and the outer ring, (..., row, element).
    special : dict of str to ndarray
        Further losses of each contact, W.
    options : FrictionOptions
        Drag, churning, seals.
    """
    oil, t = options.oil, options.temperature
    shape = contacts[0].grip.shape
    spin = 2 * mean_speed / diameter
    drag = options.roller_drag * spin
    turning = np.abs(speed)

    def total(power: Array) -> Array:
        return np.asarray(np.broadcast_to(power, shape).sum(axis=(-2, -1)))

    hysteresis, rolling, grip = (
        np.sum([getattr(c, name) for c in contacts], axis=0)
        for name in ("hysteresis", "rolling", "grip")
    )
    churning = options.churning.torque(turning, oil.viscosity(t), oil.density(t))
    losses = {
        "hysteresis": total(2 * mean_speed * hysteresis),
        "rolling": total(2 * mean_speed * rolling),
        "drag": total(drag * spin),
        "churning": churning * turning,
        "seal": options.seal_torque * turning,
        **{name: total(power) for name, power in special.items()},
    }
    needed = np.broadcast_to(rolling + hysteresis + 2 * drag / diameter, shape)
    return BearingFriction(
        speed=speed,
        losses=losses,
        film=np.stack([c.film for c in contacts], axis=-1),
        film_parameter=np.stack([c.parameter for c in contacts], axis=-1),
        asperity_share=np.stack([c.share for c in contacts], axis=-1),
        traction_use=np.divide(needed, grip, out=np.full(shape, np.inf), where=grip > 0),
    )
