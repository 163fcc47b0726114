"""Friction around the rollers: cage sides and rim, thrust washers, lip seals.

Plain expressions for floats or arrays; equation numbers are those of von Hollen 2013.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Value = float | NDArray[np.float64]


def cage_side_torque(
    viscosity: Value,
    gaps: tuple[float, float],
    speed: Value,
    outer_radius: float,
    inner_radius: float,
) -> Value:
    """Viscous torque between the sides of a cage and its guides, N m, (5.44).

    Von Hollen takes radii about the pitch circle; the cage's own are right.

    Parameters
    ----------
    viscosity : float or ndarray
        Pa s.
    gaps : tuple of float
        s₄ left and right, m.
    speed : float or ndarray
        Of the cage against the guide, rad/s.
    outer_radius, inner_radius : float
        Of the cage, m.

    Returns
    -------
    float or ndarray
        N m.

    Examples
    --------
    >>> from loadflow.rolling.friction import cage_side_torque
    >>> f"{cage_side_torque(0.01, (1e-4, 1e-4), 40.0, 0.035, 0.030):.2e}"  # N m
    '8.68e-03'
    """
    ring = np.pi / 2 * (outer_radius**4 - inner_radius**4)
    return viscosity * (1 / gaps[0] + 1 / gaps[1]) * ring * speed


def cage_inertia_force(
    cage_mass: float, rollers: int, roller_mass: float, crank_radius: float, speed: Value
) -> Value:
    """Inertia force of the cage of a crank-pin bearing with half its rollers, N, (4.72).

    Parameters
    ----------
    cage_mass : float
        kg.
    rollers : int
        Number of rollers.
    roller_mass : float
        Of one, kg.
    crank_radius : float
        m.
    speed : float or ndarray
        Of the crank, rad/s.

    Returns
    -------
    float or ndarray
        N.

    Examples
    --------
    >>> from loadflow.rolling.friction import cage_inertia_force
    >>> round(cage_inertia_force(0.03, 18, 6.67e-3, 0.0425, 104.7), 1)  # N
    41.9
    """
    return (cage_mass + rollers / 2 * roller_mass) * crank_radius * speed * speed


def thrust_washer_torque(
    axial: Value, friction: float, outer_radius: float, inner_radius: float
) -> Value:
    """Torque of a thrust washer, μ F_a (r_o + r_i)/2, N m, (8.4); von Hollen takes F_a = 0.04 F_r.

    Parameters
    ----------
    axial : float or ndarray
        Axial force, N.
    friction : float
        Friction coefficient (steel on bronze 0.07).
    outer_radius, inner_radius : float
        m.

    Returns
    -------
    float or ndarray
        N m.

    Examples
    --------
    >>> from loadflow.rolling.friction import thrust_washer_torque
    >>> thrust_washer_torque(100.0, 0.1, 0.04, 0.02)
    0.3
    """
    return friction * axial * (outer_radius + inner_radius) / 2


def seal_torque(
    speed: Value,
    shaft_radius: float,
    radial_force: float,
    friction: float,
    viscosity: Value = 0.0,
    width_ratio: float = 0.0,
) -> Value:
    """Torque of a radial lip seal, dry and viscous, N m, (8.1).

    Parameters
    ----------
    speed : float or ndarray
        rad/s.
    shaft_radius : float
        m.
    radial_force : float
        Sum of the lip's radial line load around the shaft, N.
    friction : float
        Coefficient of the dry part.
    viscosity : float or ndarray
        At the lip's temperature, Pa s.
    width_ratio : float
        Width of the lip over the sum of the roughnesses R_p.

    Returns
    -------
    float or ndarray
        N m.

    Examples
    --------
    >>> round(seal_torque(0.0, 17.5e-3, 11.5, 0.3), 6)
    0.060375
    """
    dry = friction * radial_force * shaft_radius
    return dry + 2 * np.pi * viscosity * width_ratio * shaft_radius**3 * speed
