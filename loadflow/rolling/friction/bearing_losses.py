"""Friction of a whole roller bearing in ideal rolling: film, Λ, and each component's loss.

Rollers turn at ideal speed; what each contact must pull for that is compared with what it can
(`traction_use`; above 1 the roller skids and its speed is a matter of dynamics). Losses are powers;
the torque is their sum over the speed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.rolling.friction import rolling_resistance as resistance
from loadflow.rolling.friction.contact_films import (
    Ring,
    line_film,
    raceway_radius,
    sphere_film,
)
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.kinematics import entrainment_speed
from loadflow.rolling.roller_result import RollerResult
from loadflow.tribology import asperities, traction
from loadflow.tribology.hertz import effective_modulus

Array = NDArray[np.float64]
RINGS: tuple[Ring, ...] = ("inner", "outer")


@dataclass(frozen=True)
class BearingFriction:
    """Friction of a roller bearing; contacts over (..., row, roller, ring), ring = inner, outer.

    Attributes
    ----------
    speed : ndarray, shape (...)
        Speed of the inner less that of the outer ring, rad/s.
    losses : dict of str to ndarray, shape (...)
        Power of each component, W: hysteresis, rolling, rib, drag, churning, seal.
    film : ndarray
        Central film, m; very large where a turning contact has no load, 0 at standstill.
    film_parameter : ndarray
        Λ.
    asperity_share : ndarray
        Share of the load that asperities carry; 0 without load.
    traction_use : ndarray, shape (..., row, roller)
        Friction that ideal rolling needs over what both contacts can give.
    """

    speed: Array
    losses: dict[str, Array]
    film: Array
    film_parameter: Array
    asperity_share: Array
    traction_use: Array

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


@dataclass(frozen=True)
class _Contact:
    """One raceway: geometry, and line-contact quantities over (..., row, roller)."""

    film: Array
    parameter: Array
    share: Array
    rolling: Array
    hysteresis: Array
    grip: Array


def roller_friction(
    result: RollerResult, speed: ArrayLike, options: FrictionOptions
) -> BearingFriction:
    """Film, Λ and losses of every contact of a roller bearing.

    Rollers count with their mean line load (the film depends on it as W^-0.1, the rolling force as
    W^0.25).

    Parameters
    ----------
    result : RollerResult
        Load distribution, cases (...).
    speed : array_like
        Speed of the inner ring (less that of the outer), rad/s; broadcasts with the cases.
    options : FrictionOptions
        Lubricant, surfaces, ribs, churning, seals.

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
    omega = np.asarray(speed, float)
    if not np.isfinite(omega).all():
        raise InputError("speed: must be finite")
    try:
        omega = np.broadcast_to(omega, np.broadcast_shapes(omega.shape, result.cases))
    except ValueError:
        raise InputError(f"speed {omega.shape} does not fit the cases {result.cases}") from None
    bearing, oil, t = result.bearing, options.oil, options.temperature
    force = np.broadcast_to(result.roller_forces, (*omega.shape, *result.roller_forces.shape[-2:]))
    mean = entrainment_speed(omega, 0.0, bearing.pitch_diameter, bearing.gamma)
    u = np.asarray(mean)[..., None, None]
    viscosity = float(oil.viscosity(t))
    contacts = [_contact(result, ring, force, u, viscosity, options) for ring in RINGS]
    inner = contacts[0]
    radius = bearing.roller_diameter / 2
    spin = 2 * u / bearing.roller_diameter
    drag = options.roller_drag * spin

    def total(power: Array) -> Array:
        return np.asarray(np.broadcast_to(power, force.shape).sum(axis=(-2, -1)))

    churning = options.churning.torque(np.abs(omega), viscosity, oil.density(t))
    losses = {
        "hysteresis": total(2 * u * sum(c.hysteresis for c in contacts)),
        "rolling": total(2 * u * sum(c.rolling for c in contacts)),
        "rib": total(_rib_loss(result, force, u, options)),
        "drag": total(drag * spin),
        "churning": churning * np.abs(omega),
        "seal": options.seal_torque * np.abs(omega),
    }
    needed = sum(c.rolling + c.hysteresis for c in contacts) + drag / radius
    grip = inner.grip + contacts[1].grip
    return BearingFriction(
        speed=omega,
        losses=losses,
        film=np.stack([c.film for c in contacts], axis=-1),
        film_parameter=np.stack([c.parameter for c in contacts], axis=-1),
        asperity_share=np.stack([c.share for c in contacts], axis=-1),
        traction_use=np.divide(needed, grip, out=np.full(force.shape, np.inf), where=grip > 0),
    )


def _rib_loss(result: RollerResult, force: Array, u: Array, options: FrictionOptions) -> Array:
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
    result: RollerResult,
    ring: Ring,
    force: Array,
    u: Array,
    viscosity: float,
    options: FrictionOptions,
) -> _Contact:
    """Film, rolling forces and grip of all contacts with one ring."""
    bearing, oil = result.bearing, options.oil
    modulus = 2 * float(effective_modulus(bearing.elastic_modulus, bearing.poisson_ratio))
    length = bearing.roller_length
    radius = raceway_radius(bearing.roller_diameter, bearing.gamma, ring)
    found = line_film(force, length, radius, modulus, u, options)
    parameter = asperities.film_parameter(found.film, options.roughness)
    share = np.where(force > 0, asperities.asperity_share(parameter), 0.0)
    alpha = float(oil.pressure_viscosity(options.temperature))
    rolling = resistance.hydrodynamic_force(force, length, radius, u, viscosity, alpha, modulus)
    moment = resistance.hysteresis_moment(force, found.half_width, options.hysteresis)
    limit = traction.limiting_stress(
        found.pressure, oil.critical_stress, oil.critical_pressure, oil.limiting_slope
    )
    area = 2 * found.half_width * length
    grip = traction.mixed_force(limit, area, force, share, options.boundary_friction)
    return _Contact(
        film=found.film,
        parameter=np.asarray(parameter),
        share=share,
        rolling=np.asarray(found.share * rolling),
        hysteresis=np.asarray(moment / (2 * radius)),
        grip=np.asarray(grip),
    )
