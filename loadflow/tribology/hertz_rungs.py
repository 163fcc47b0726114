"""Approximations of the elliptic integrals of Hertz's point contact, with their measured errors.

Each rung takes the ratio of the summed curvatures of the two principal planes, at least 1, and
returns the ellipticity k and the complete elliptic integrals K and E. Largest errors of stiffness
and pressure are measured by ``benchmarks/rolling_life.py`` (``docs/rolling.md``).

References
----------
Brewe, D. E.; Hamrock, B. J.: Simplified solution for elliptical-contact deformation. ASME J.
Lubr. Technol. 99 (1977). Hamrock, B. J.; Brewe, D. E.: Simplified solution for stresses and
deformations. ASME J. Lubr. Technol. 105 (1983).
"""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.tribology.contact_ellipse import exact_ellipse

Array = NDArray[np.float64]

SPLINE_LIMIT = 1e4
_KNOTS = 257


def regression(ratio: Array) -> tuple[Array, Array, Array]:
    """Regression of Brewe and Hamrock (1977)."""
    return (
        1.0339 * ratio**0.636,
        1.5277 + 0.6023 * np.log(ratio),
        1.0003 + 0.5968 / ratio,
    )


def power(ratio: Array) -> tuple[Array, Array, Array]:
    """Power law of Hamrock and Brewe (1983), exact for circles."""
    q = math.pi / 2 - 1
    return ratio ** (2 / math.pi), math.pi / 2 + q * np.log(ratio), 1 + q / ratio


def spline(ratio: Array) -> tuple[Array, Array, Array]:
    """Cubic splines over the logarithm of the ratio; exact above `SPLINE_LIMIT`."""
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
