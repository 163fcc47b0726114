"""Traction of a film under pressure: Newtonian up to a limiting shear stress, and mixed friction.

Equation numbers are those of von Hollen 2013. Plain expressions for floats or arrays, as in
`loadflow.tribology.contact_film`; the sign of a stress is that of the sliding speed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Value = float | NDArray[np.float64]

_STIFFEST = 1e20  # Pa s; a film so thick is a solid, and products with it stay finite


def limiting_stress(
    pressure: Value, critical_stress: float, critical_pressure: float, slope: float
) -> Value:
    """Limiting shear stress: τ_c, above the critical pressure τ_c + (p̄ - p_c) slope, (5.53), Pa.

    Parameters
    ----------
    pressure : float or ndarray
        Mean pressure p̄ of the contact, Pa.
    critical_stress, critical_pressure : float
        τ_c and p_c, Pa.
    slope : float
        dτ/dp̄ above p_c.

    Returns
    -------
    float or ndarray
        Pa.

    Examples
    --------
    >>> round(float(limiting_stress(1000e6, 4e6, 502e6, 0.07)) / 1e6, 2)
    38.86
    """
    return critical_stress + slope * np.maximum(pressure - critical_pressure, 0.0)


def newtonian_stress(viscosity: Value, sliding: Value, film: Value) -> Value:
    """Newtonian stress η(p̄) Δv/h, (5.50), Pa.

    Examples
    --------
    >>> round(float(newtonian_stress(0.1, 0.5, 1e-6)))
    50000
    """
    return np.minimum(viscosity, _STIFFEST) * sliding / film


def smooth_stress(newtonian: Value, limit: Value) -> Value:
    """Stress τ_lim tanh(τ_N/τ_lim), Pa; at most 24 % below Table 5.1, at its kink.

    Table 5.1: Newtonian up to the limit, then the limit.

    Examples
    --------
    >>> round(float(smooth_stress(4e6, 4e6)) / 4e6, 4)
    0.7616
    """
    return limit * np.tanh(newtonian / limit)


def inlet_force(
    sliding: Value, viscosity: Value, length: float, radius: float, film: Value
) -> Value:
    """Traction of the wedge around a contact, 3.154 η Δv l √(R/h), N; exact for rigid cylinders.

    The only traction where a roller is barely loaded and its Hertzian strip vanishes; negligible
    beside the strip's traction under load. To be added to `mixed_force`.

    Parameters
    ----------
    sliding : float or ndarray
        Δv, m/s.
    viscosity : float or ndarray
        At ambient pressure, Pa s.
    length : float
        m.
    radius : float
        Reduced radius, m.
    film : float or ndarray
        Central film of the regime (`loadflow.tribology.moes_line`), m.

    Examples
    --------
    >>> round(float(inlet_force(0.5, 0.1, 0.02, 5e-3, 1e-6)), 4)
    0.223
    """
    return 3.1540 * viscosity * sliding * length * np.sqrt(radius / film)


def boundary_coefficient(sliding: Value, coefficient: float, reference: float = 1e-3) -> Value:
    """Friction coefficient of touching asperities, μ tanh(Δv/v_ref), which vanishes at rest.

    Parameters
    ----------
    sliding : float or ndarray
        Sliding speed, m/s.
    coefficient : float
        Boundary friction coefficient μ_bl.
    reference : float
        Speed over which the friction reverses, m/s.

    Examples
    --------
    >>> round(float(boundary_coefficient(-1.0, 0.1)), 4)
    -0.1
    """
    return coefficient * np.tanh(sliding / reference)


def mixed_force(stress: Value, area: Value, load: Value, share: Value, boundary: Value) -> Value:
    """Friction force of film and asperities side by side, N.

    Parameters
    ----------
    stress : float or ndarray
        Shear stress of the film, Pa.
    area : float or ndarray
        Area of the contact, m².
    load : float or ndarray
        N.
    share : float or ndarray
        Share of the load that asperities carry.
    boundary : float or ndarray
        `boundary_coefficient`.

    Examples
    --------
    >>> round(mixed_force(1e6, 1e-5, 1000.0, 0.2, 0.1), 3)
    28.0
    """
    return (1.0 - share) * stress * area + share * boundary * load
