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

    Examples
    --------
    >>> round(float(limiting_stress(1000e6, 4e6, 502e6, 0.07)) / 1e6, 2)
    38.86
    """
    return critical_stress + slope * np.maximum(pressure - critical_pressure, 0.0)


def newtonian_stress(viscosity: Value, sliding: Value, film: Value) -> Value:
    """Newtonian stress η(p̄) Δv/h, (5.50), Pa."""
    return np.minimum(viscosity, _STIFFEST) * sliding / film


def clipped_stress(newtonian: Value, limit: Value) -> Value:
    """Stress after Table 5.1: Newtonian up to the limit, then the limit, Pa."""
    return np.minimum(np.maximum(newtonian, -limit), limit)


def smooth_stress(newtonian: Value, limit: Value) -> Value:
    """The same without a kink, τ_lim tanh(τ_N/τ_lim), Pa; at most 24 % below it (at the kink)."""
    return limit * np.tanh(newtonian / limit)


def eyring_stress(newtonian: Value, eyring: Value) -> Value:
    """Stress of Eyring's liquid, τ₀ arsinh(τ_N/τ₀), Pa."""
    return eyring * np.arcsinh(newtonian / eyring)


def boundary_coefficient(sliding: Value, coefficient: float, reference: float = 1e-3) -> Value:
    """Friction coefficient of touching asperities, μ tanh(Δv/v_ref), which stands still at rest.

    Parameters
    ----------
    sliding : float or ndarray
        Sliding speed, m/s.
    coefficient : float
        Boundary friction coefficient μ_bl.
    reference : float
        Speed over which the friction turns round, m/s.
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
    """
    return (1.0 - share) * stress * area + share * boundary * load
