"""Ellipse of Hertz's point contact: exact elliptic integrals, and approximations of them.

Each rung takes the ratio of the summed curvatures of the two principal planes, at least 1, and
returns the ellipticity k and the complete elliptic integrals K and E. Largest errors of stiffness
and pressure are measured by ``benchmarks/references/rolling_life.py`` (``docs/rolling.md``).

References
----------
Brewe, D. E.; Hamrock, B. J.: Simplified solution for elliptical-contact deformation. ASME J.
Lubr. Technol. 99 (1977). Hamrock, B. J.; Brewe, D. E.: Simplified solution for stresses and
deformations. ASME J. Lubr. Technol. 105 (1983).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.numerics.fields import check_one_of

Array = NDArray[np.float64]

SPLINE_LIMIT = 1e4
_KNOTS = 257


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

    Examples
    --------
    >>> [round(float(x), 6) for x in exact_ellipse(10.0)]
    [4.499447, 2.914203, 1.059884]
    """
    k = ellipticity(ratio)
    k_integral, _, e_integral = _elliptic(np.log(k))
    return k, k_integral, e_integral


def regression(ratio: Array) -> tuple[Array, Array, Array]:
    """Regression of Brewe and Hamrock (1977).

    Examples
    --------
    >>> [round(float(x), 4) for x in regression(np.array(10.0))]
    [4.4718, 2.9145, 1.06]
    """
    return (
        1.0339 * ratio**0.636,
        1.5277 + 0.6023 * np.log(ratio),
        1.0003 + 0.5968 / ratio,
    )


def power(ratio: Array) -> tuple[Array, Array, Array]:
    """Power law of Hamrock and Brewe (1983), exact for circles.

    Examples
    --------
    >>> [round(float(x), 4) for x in power(np.array(10.0))]
    [4.3313, 2.8851, 1.0571]
    """
    q = math.pi / 2 - 1
    return ratio ** (2 / math.pi), math.pi / 2 + q * np.log(ratio), 1 + q / ratio


def spline(ratio: Array) -> tuple[Array, Array, Array]:
    """Cubic splines over the logarithm of the ratio; exact above `SPLINE_LIMIT`.

    Examples
    --------
    >>> [round(float(x), 6) for x in spline(np.array(10.0))]
    [4.499447, 2.914203, 1.059884]
    """
    if np.max(ratio, initial=1.0) > SPLINE_LIMIT:
        return exact_ellipse(ratio)
    values = _splines()(np.log(ratio))
    return np.exp(values[..., 0]), values[..., 1], values[..., 2]


@cache
def _splines() -> Any:
    from scipy.interpolate import CubicSpline

    knots = np.linspace(0.0, math.log(SPLINE_LIMIT), _KNOTS)
    k, first, second = exact_ellipse(np.exp(knots))
    return CubicSpline(knots, np.stack([np.log(k), first, second], axis=-1))


RUNGS: dict[str, Callable[[Array], tuple[Array, Array, Array]]] = {
    "exact": exact_ellipse,
    "spline": spline,
    "power": power,
    "regression": regression,
}


def ellipse(ratio: Array, rung: str = "exact") -> tuple[Array, Array, Array]:
    """Ellipticity k and the complete elliptic integrals K and E by one of the `RUNGS`.

    Parameters
    ----------
    ratio : ndarray
        As of `ellipticity`.
    rung : str
        Name of the rung.

    Raises
    ------
    InputError
        If there is no such rung.

    Examples
    --------
    >>> [round(float(x), 6) for x in ellipse(np.array(5.0))]
    [2.890181, 2.493744, 1.12052]
    """
    check_one_of("rung", rung, RUNGS)
    return RUNGS[rung](ratio)
