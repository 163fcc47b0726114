"""Polynomials of the integral F_5/2 of Greenwood and Tripp.

Compiled into `loadflow.tribology.kernels`: clear its numba cache after a change.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LOWEST, HIGHEST = -10.0, 38.5  # H; F_5/2 is 4e-325 at the upper end
PER_UNIT = 16  # pieces in a unit of H


def polynomials() -> Array:
    """Coefficients of ln F_5/2 + H²/2 in each piece, shape (pieces, 6), lowest power first.

    Quintic Hermite polynomials through value, slope and curvature at the ends of each piece.
    """
    step = 1.0 / PER_UNIT
    pieces = round((HIGHEST - LOWEST) * PER_UNIT)
    u = LOWEST + step * np.arange(pieces + 1, dtype=np.float64)
    half, three_halves, five_halves = _scaled_integrals(u)
    log = np.log(five_halves / np.sqrt(2 * np.pi))
    ratio = three_halves / five_halves
    slope = (u - 2.5 * ratio) * step
    curvature = (1 + 3.75 * half / five_halves - 6.25 * ratio**2) * step**2
    left = np.stack([log, slope, curvature / 2], axis=-1)[:-1]
    # what the cubic to quintic terms must add at the end of the piece
    value = log[1:] - left.sum(axis=-1)
    rise = slope[1:] - left[:, 1] - 2 * left[:, 2]
    bend = curvature[1:] - 2 * left[:, 2]
    right = np.stack(
        [
            10 * value - 4 * rise + bend / 2,
            -15 * value + 7 * rise - bend,
            6 * value - 3 * rise + bend / 2,
        ],
        axis=-1,
    )
    return np.ascontiguousarray(np.concatenate([left, right], axis=-1))


def _scaled_integrals(u: Array) -> tuple[Array, Array, Array]:
    """∫ t^n exp(-t²/2 - u t) dt over t > 0 for n = 1/2, 3/2, 5/2, shape as `u`.

    With t = s² the integrands are smooth, and Gauss–Legendre quadrature is exact to 1e-14. (The
    parabolic cylinder functions of scipy are good to 3e-9.)
    """
    nodes, weights = np.polynomial.legendre.leggauss(96)
    end = np.sqrt(np.sqrt(u * u + 90.0) - u)[:, None]  # where the integrand has fallen by e^-45
    s = end * (nodes + 1) / 2
    density = end * weights * s**2 * np.exp(-(s**2) * (s**2 / 2 + u[:, None]))
    half, three_halves, five_halves = ((density * s ** (2 * k)).sum(axis=1) for k in range(3))
    return half, three_halves, five_halves
