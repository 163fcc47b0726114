"""Film against roughness: Λ, and the share of the load that asperities carry.

References
----------
Zhou, Hoeprich: Torque of Tapered Roller Bearings. J. Tribology 113 (1991) 590.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Value = float | NDArray[np.float64]


def combined_roughness(first: Value, second: Value) -> Value:
    """Combined roughness σ = √(R_q1² + R_q2²), m."""
    return np.sqrt(first * first + second * second)


def film_parameter(film: Value, roughness: Value) -> Value:
    """Λ = h/σ, (8.2) of von Hollen 2013; at least 5 keeps ground surfaces apart.

    Examples
    --------
    >>> round(float(film_parameter(3.8, combined_roughness(0.31, 0.533))), 2)
    6.16
    """
    return film / roughness


def asperity_share(parameter: Value, rate: float = 1.8, power: float = 1.2) -> Value:
    """Share exp(-B Λ^C) of the load that asperities carry, of Zhou and Hoeprich.

    Parameters
    ----------
    parameter : float or ndarray
        Λ.
    rate, power : float
        B and C.
    """
    return np.exp(-rate * np.minimum(parameter, 1e3) ** power)
