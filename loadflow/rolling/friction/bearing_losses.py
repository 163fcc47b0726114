"""Friction of a whole roller bearing in ideal rolling: film, Λ, and each component's loss.

Rollers turn at ideal speed; what each contact must pull for that is compared with what it can
(`traction_use`; above 1 the roller skids and its speed is a matter of dynamics). Losses are powers;
the torque is their sum over the speed.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Literal

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields
from loadflow.rolling.friction import rolling_resistance as resistance
from loadflow.rolling.friction.churning import Churning
from loadflow.rolling.kinematics import entrainment_speed
from loadflow.rolling.roller_result import RollerResult
from loadflow.tribology import asperities, contact_film, traction
from loadflow.tribology.hertz import effective_modulus
from loadflow.tribology.lubricants import Oil

Array = NDArray[np.float64]
RINGS: tuple[Literal["inner", "outer"], ...] = ("inner", "outer")


@dataclass(frozen=True, kw_only=True)
class FrictionOptions:
    """What the friction of a roller bearing depends on besides load and speed.

    Attributes
    ----------
    oil : Oil
        Oil, or base oil of the grease.
    temperature : float
        Of the oil at the inlets of the contacts, K.
    roughness : float
        Combined roughness σ of roller and raceway, m.
    hysteresis : float
        Loss factor α of the steel.
    film : str
        Film law, see `loadflow.tribology.film_ratio`; ``"moes"`` holds in all regimes.
    starvation : float
        Share of the flooded film and rolling force that is left; grease 0.5 … 0.7, oil 1.
    boundary_friction : float
        Friction coefficient where asperities touch.
    rib_angle : float
        Angle between the contact normals of both raceways, rad; a rib carries its sine of the load
        (tapered rollers 0.02 … 0.06, cylindrical 0).
    rib_height : float
        Height of the rib contact over the raceway, m.
    rib_friction : float
        Friction coefficient of the rib's film.
    roller_drag : float
        C₁ of the viscous drag on each roller (`drag_constants`), N m s.
    churning : Churning
        Torque of churning.
    seal_torque : float
        Torque of the seals, N m.
    """

    oil: Oil
    temperature: Annotated[float, Gt(200), Le(500)]
    roughness: Annotated[float, Gt(0)] = 0.5e-6
    hysteresis: Annotated[float, Ge(0), Le(0.1)] = 0.01
    film: str = "moes"
    starvation: Annotated[float, Gt(0), Le(1)] = 1.0
    boundary_friction: Annotated[float, Ge(0), Le(1)] = 0.12
    rib_angle: Annotated[float, Ge(0), Le(0.5)] = 0.0
    rib_height: Annotated[float, Ge(0)] = 0.0
    rib_friction: Annotated[float, Ge(0), Le(1)] = 0.05
    roller_drag: Annotated[float, Ge(0)] = 0.0
    churning: Churning = field(default_factory=Churning)
    seal_torque: Annotated[float, Ge(0)] = 0.0

    def __post_init__(self) -> None:
        check_fields(self)


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
    >>> from loadflow.rolling import RollerBearing
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
    rib_speed = options.rib_height * u / _radius(bearing.roller_diameter, bearing.gamma, "inner")
    rib = options.rib_friction * np.sin(options.rib_angle) * force * rib_speed

    def total(power: Array) -> Array:
        return np.asarray(np.broadcast_to(power, force.shape).sum(axis=(-2, -1)))

    churning = options.churning.torque(np.abs(omega), viscosity, oil.density(t))
    losses = {
        "hysteresis": total(2 * u * sum(c.hysteresis for c in contacts)),
        "rolling": total(2 * u * sum(c.rolling for c in contacts)),
        "rib": total(rib),
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


def _radius(roller_diameter: float, gamma: float, ring: str) -> float:
    """Reduced radius ρ (1 ∓ γ) of roller and raceway, m, (5.66), (5.67)."""
    return roller_diameter / 2 * (1 - gamma if ring == "inner" else 1 + gamma)


def _contact(
    result: RollerResult,
    ring: Literal["inner", "outer"],
    force: Array,
    u: Array,
    viscosity: float,
    options: FrictionOptions,
) -> _Contact:
    """Film, rolling forces and grip of all contacts with one ring."""
    bearing, oil, t = result.bearing, options.oil, options.temperature
    modulus = 2 * float(effective_modulus(bearing.elastic_modulus, bearing.poisson_ratio))
    length = bearing.roller_length
    radius = _radius(bearing.roller_diameter, bearing.gamma, ring)
    alpha = float(oil.pressure_viscosity(t))
    half_width = np.sqrt(8 * force * radius / (np.pi * length * modulus))
    pressure = force / np.maximum(2 * half_width * length, 1e-30)

    entraining = viscosity * np.maximum(u, 1e-12) / (modulus * radius)
    ratio = contact_film.film_ratio(
        options.film, alpha * modulus, entraining, force / (modulus * radius * length)
    )
    loading = contact_film.thermal_loading(
        viscosity, float(oil.steepness(t)), u, float(oil.conductivity(t))
    )
    heated = contact_film.thermal_factor(loading)
    film = np.where(u > 0, options.starvation * heated * ratio * radius, 0.0)
    parameter = asperities.film_parameter(film, options.roughness)
    share = np.where(force > 0, asperities.asperity_share(parameter), 0.0)
    rolling = resistance.hydrodynamic_force(force, length, radius, u, viscosity, alpha, modulus)
    moment = resistance.hysteresis_moment(force, half_width, options.hysteresis)
    limit = traction.limiting_stress(
        pressure, oil.critical_stress, oil.critical_pressure, oil.limiting_slope
    )
    return _Contact(
        film=film,
        parameter=np.asarray(parameter),
        share=share,
        rolling=np.asarray(options.starvation * heated * rolling),
        hysteresis=np.asarray(moment / (2 * radius)),
        grip=np.asarray(
            traction.mixed_force(
                limit, 2 * half_width * length, force, share, options.boundary_friction
            )
        ),
    )
