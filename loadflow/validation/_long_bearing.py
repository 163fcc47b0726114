"""Closed forms of the infinitely long bearing, which the film's wide limit is held against."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def long_bearing(eccentricity_ratio: ArrayLike) -> Array:
    """So of the infinitely long bearing without rupture (β = π/2), Sommerfeld.

    Examples
    --------
    >>> from loadflow.validation._long_bearing import long_bearing
    >>> round(float(long_bearing(0.6)), 6)
    5.990325
    """
    e = np.asarray(eccentricity_ratio, dtype=float)
    return 6 * np.pi * e / ((2 + e**2) * np.sqrt(1 - e**2))


def long_bearing_ruptured(eccentricity_ratio: float) -> tuple[float, float, float]:
    """So, β (rad) and rupture angle (rad, from the widest gap) of the infinitely long bearing.

    Swift–Stieber rupture, film starting at the widest gap; quadrature to about 1e-10.

    Examples
    --------
    >>> from loadflow.validation._long_bearing import long_bearing_ruptured
    >>> so, beta, rupture = long_bearing_ruptured(0.6)
    >>> round(so, 6), round(float(np.degrees(rupture)), 4)
    (4.086203, 213.0783)
    """
    from scipy.optimize import brentq

    e = float(eccentricity_ratio)
    nodes, weights = np.polynomial.legendre.leggauss(200)

    def flux(theta: Array, at: float) -> Array:
        h = 1 + e * np.cos(theta)
        return 1 / h**2 - (1 + e * np.cos(at)) / h**3

    def end_pressure(at: float) -> float:
        return float(0.5 * at * weights @ flux(0.5 * at * (nodes + 1), at))

    rupture = brentq(end_pressure, np.pi * (1 + 1e-9), 2 * np.pi * (1 - 1e-9), xtol=1e-14)
    theta = 0.5 * rupture * (nodes + 1)
    slope = 6 * flux(theta, rupture) * 0.5 * rupture * weights
    # by parts: ∫ p cos θ = −∫ p' sin θ, ∫ p sin θ = ∫ p' cos θ (p vanishes at both ends)
    along, across = 0.5 * -(slope @ np.sin(theta)), 0.5 * (slope @ np.cos(theta))
    return float(np.hypot(along, across)), float(np.arctan2(across, -along)), float(rupture)
