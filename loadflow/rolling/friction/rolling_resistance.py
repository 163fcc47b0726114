"""Resistance to rolling: hysteresis of the steel and the pressure of the film at the inlet.

Both shift the resultant of the pressure upstream by a lever e. The moment N e is the same for both
bodies and does the power N e u/R_eff, as if each surface were held by the force F = N e/(2 R_eff)
over its speed u: P = 2 u F. Plain expressions for floats or arrays; equation numbers are those of
von Hollen 2013.

References
----------
Zhou, Hoeprich: Torque of Tapered Roller Bearings. J. Tribology 113 (1991) 590, eqs. (6)–(17).
Martin: Lubrication of gear teeth. Engineering 102 (1916) (rigid cylinders).
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.fields import check_one_of

Value = float | NDArray[np.float64]

ELASTIC_POWER = 0.648
"""Of G U in the rolling force of elastic films."""

# Rigid cylinders and an isoviscous film that ruptures where it leaves with p' = 0 (Martin): the
# shear of the pressure flow on each surface is this factor times √(η u Q/l).
_MARTIN = 2.0796226


def hysteresis_moment(load: Value, half_width: Value, loss: float) -> Value:
    """Rolling moment α 2/(3π) Q a of one contact, N m, (4.39).

    Its power is the moment times the rolling speed u/R_eff; von Hollen takes the roller's spin,
    which is right on a plane.

    Parameters
    ----------
    load : float or ndarray
        Contact load Q, N.
    half_width : float or ndarray
        Half the Hertzian width a, m.
    loss : float
        Hysteresis loss factor α of the steel; of the order of 0.01.

    Returns
    -------
    float or ndarray
        N m.

    Examples
    --------
    >>> from loadflow.rolling.friction import hysteresis_moment
    >>> f"{hysteresis_moment(1000.0, 57e-6, loss=0.01):.2e}"  # N m
    '1.21e-04'
    """
    return loss * 2.0 / (3.0 * np.pi) * load * half_width


def elastic_force(
    load: Value,
    length: Value,
    radius: float,
    speed: Value,
    viscosity: Value,
    pressure_viscosity: Value,
    modulus: float,
) -> Value:
    """Hydrodynamic rolling force of an elastic contact, N, (4.46).

    F = 29.2 R/α_p l (G U)^0.648 W^0.246, per surface; good to about ±50 %.

    Parameters
    ----------
    load, length : float or ndarray
        Contact load, N, on the effective length, m.
    radius : float
        Reduced radius R_eff, m.
    speed : float or ndarray
        Mean surface speed u ≥ 0, m/s.
    viscosity, pressure_viscosity : float or ndarray
        At ambient pressure, Pa s and 1/Pa.
    modulus : float
        Reduced modulus E₀ = 2 E*, Pa.

    Returns
    -------
    float or ndarray
        N.

    Examples
    --------
    >>> from loadflow.rolling.friction import elastic_force
    >>> round(float(elastic_force(1e4, 0.06, 0.018, 2.0, 0.2, 2e-8, 2.3e11)), 2)
    10.01
    """
    carry = (pressure_viscosity * viscosity * speed / radius) ** ELASTIC_POWER
    weight = (load / (modulus * length * radius)) ** 0.246
    return 29.2 * radius / pressure_viscosity * length * carry * weight


def rigid_force(load: Value, length: Value, speed: Value, viscosity: Value) -> Value:
    """Hydrodynamic rolling force between rigid cylinders, 2.080 l √(η u Q/l), N.

    Exact for an isoviscous film; the lighter the load, the nearer.

    Parameters
    ----------
    load : float or ndarray
        Contact load Q, N.
    length : float or ndarray
        Effective length l, m.
    speed : float or ndarray
        Mean surface speed u ≥ 0, m/s.
    viscosity : float or ndarray
        η at ambient pressure, Pa s.

    Returns
    -------
    float or ndarray
        N.

    Examples
    --------
    >>> from loadflow.rolling.friction import rigid_force
    >>> round(rigid_force(100.0, 11e-3, 1.5, 0.01), 2)  # N
    np.float64(0.27)
    """
    return _MARTIN * length * np.sqrt(viscosity * speed * load / length)


def hydrodynamic_force(
    load: Value,
    length: Value,
    radius: float,
    speed: Value,
    viscosity: Value,
    pressure_viscosity: Value,
    modulus: float,
) -> Value:
    """Hydrodynamic rolling force per surface in all regimes, N.

    The smaller of `elastic_force` and `rigid_force`, rounded where they meet: the regression of
    the elastic film is far too large for rollers that hardly touch. Arguments as `elastic_force`.

    Parameters
    ----------
    load, length, radius, speed, viscosity, pressure_viscosity, modulus
        As `elastic_force`.

    Returns
    -------
    float or ndarray
        N.

    Examples
    --------
    >>> from loadflow.rolling.friction import elastic_force, hydrodynamic_force
    >>> given = 0.06, 0.018, 2.0, 0.2, 2e-8, 2.3e11
    >>> light, heavy = (hydrodynamic_force(load, *given) / elastic_force(load,
    ...     *given) for load in (1.0, 1e5))
    >>> bool(light < 0.5), bool(heavy > 0.9)
    (True, True)
    """
    # both written out: a compiled caller needs one function without calls
    carry = (pressure_viscosity * viscosity * speed / radius) ** ELASTIC_POWER
    weight = (load / (modulus * length * radius)) ** 0.246
    elastic = 29.2 * radius / pressure_viscosity * length * carry * weight
    rigid = _MARTIN * length * np.sqrt(viscosity * speed * load / length)
    return elastic * rigid / np.sqrt(np.sqrt(elastic**4 + rigid**4 + 1e-200))


def hydrodynamic_torque(
    inner_force: Value,
    outer_force: Value,
    inner_diameter: float,
    outer_diameter: float,
    variant: Literal["physics", "printed"] = "physics",
    contact_angle: float = 0.0,
) -> Value:
    """Torque on the driving ring of a roller bearing from rolling forces, N m, (4.48), (4.49).

    Parameters
    ----------
    inner_force, outer_force : float or ndarray
        Sums over the rollers of the rolling forces at both rings, N.
    inner_diameter, outer_diameter : float
        Raceway diameters, m.
    variant : {"physics", "printed"}
        Von Hollen prints R - R_eff for the lever at the inner ring; R + R_eff makes both levers
        D d/(D + d), so that torque times speed is the power 2 u F.
    contact_angle : float
        Of both rings, rad.

    Returns
    -------
    float or ndarray
        N m.

    Examples
    --------
    >>> from loadflow.rolling.friction import hydrodynamic_torque
    >>> round(hydrodynamic_torque(0.2, 0.2, 49.5e-3, 71.5e-3), 5)  # N m: arms D d/(D + d) for both
    np.float64(0.0117)
    """
    inner, outer, cos = inner_diameter / 2, outer_diameter / 2, np.cos(contact_angle)
    roller = (outer - inner) / (2 * cos)
    # R_eff cos α with R/cos α, the raceways' radii of curvature
    shift = inner * roller * cos / (inner + roller * cos)
    check_one_of("variant", variant, ("physics", "printed"))
    lever = inner + shift if variant == "physics" else inner - shift
    return inner_force * lever + outer_force * (
        outer - outer * roller * cos / (outer - roller * cos)
    )
