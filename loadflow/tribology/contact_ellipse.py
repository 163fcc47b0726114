"""Ellipse of a Hertzian point contact by the complete elliptic integrals."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def ellipticity(ratio: ArrayLike) -> Array:
    """Axis ratio k = a/b of the contact ellipse from the ratio of the summed curvatures.

    Solves ``ratio = k² B(m)/D(m)``, m = 1 - 1/k², with the complete elliptic integrals
    B = (E - (1 - m) K)/m and D = (K - E)/m, by Newton's method in ln k. D comes from Carlson's
    integral, so that nothing cancels near the circle (k = 1). Good to about 1e-14.

    Parameters
    ----------
    ratio : array_like
        Larger over smaller sum of curvatures of the two principal planes, at least 1.

    Returns
    -------
    ndarray
        Ellipticity k ≥ 1, of the shape of `ratio`.

    Examples
    --------
    >>> float(ellipticity(1.0))
    1.0
    >>> round(float(ellipticity(10.0)), 10)
    4.4994473032
    """
    target = np.log(np.asarray(ratio, float))
    x = 0.65 * target
    for _ in range(50):
        residual, slope = _log_ratio(x)
        step = (residual - target) / slope
        x = np.maximum(x - step, 0.0)
        if np.max(np.abs(step), initial=0.0) < 1e-12:
            break
    return np.exp(x)


def _log_ratio(x: Array) -> tuple[Array, Array]:
    """Logarithm of the curvature ratio at ln k = x, and its derivative."""
    k_integral, d_integral, _ = _elliptic(x)
    b_integral = k_integral - d_integral
    m1 = np.exp(-2 * x)
    m = -np.expm1(-2 * x)
    near_circle = m < 1e-4  # there the slope is 3/2 to order m, and its formula cancels
    m_safe = np.where(near_circle, 1.0, m)
    dk = b_integral / (2 * m1)
    dd = (b_integral - m1 * d_integral) / (2 * m_safe * m1)
    slope = 2 + 2 * m1 * ((dk - dd) / b_integral - dd / d_integral)
    return 2 * x + np.log(b_integral / d_integral), np.where(near_circle, 1.5, slope)


def _elliptic(x: Array) -> tuple[Array, Array, Array]:
    """Complete elliptic integrals K, D = (K - E)/m and E for k = exp(x)."""
    from scipy.special import ellipkm1, elliprd

    m1 = np.exp(-2 * x)
    k = ellipkm1(m1)
    d = elliprd(0.0, m1, 1.0) / 3
    return k, d, k + np.expm1(-2 * x) * d


def exact_ellipse(ratio: ArrayLike) -> tuple[Array, Array, Array]:
    """Ellipticity k of the contact and its complete elliptic integrals K and E.

    `ratio` as of `ellipticity`.
    """
    k = ellipticity(ratio)
    k_integral, _, e_integral = _elliptic(np.log(k))
    return k, k_integral, e_integral
