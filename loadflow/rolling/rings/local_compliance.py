"""What a ring yields right under a ball: Hertz's law counts it, so the ring must not.

The displacement under a force on a solid grows without bound as the force is spread over less of
its surface, and with the fineness of a finite-element mesh. Near the force it is that of a
half-space, and Hertz's approach of ball and raceway already holds it, for the pressure as it is.
What belongs to the ring is the rest: its displacement under a force spread over a patch, less that
of a half-space under the same patch. The rest has a limit, which neither the mesh nor the size of
the patch moves.
"""

from __future__ import annotations

import math

import numpy as np

from loadflow.rolling.contacts import Array


def half_space(
    length: float, width: float, modulus: float, poisson: float
) -> tuple[float, float, float]:
    """Mean displacement of a rectangle on a half-space under a unit force spread evenly over it.

    From the solutions of Boussinesq and Cerruti, integrated twice over the rectangle.

    Parameters
    ----------
    length, width : float
        Sides of the rectangle, m.
    modulus, poisson : float
        Of the half-space, Pa and 1.

    Returns
    -------
    tuple of float
        Across the surface, along the side `length` and along the side `width`, m/N.

    Examples
    --------
    >>> square = half_space(1.0, 1.0, 1.0, 0.0)
    >>> round(square[0] * math.pi, 4)  # mean of 1/distance over a unit square
    2.9732
    """
    a, b, d = length, width, math.hypot(length, width)
    along_a, along_b = a * a * b * math.asinh(b / a), a * b * b * math.asinh(a / b)
    inverse = along_a + along_b + (a**3 + b**3 - d**3) / 3  # mean of 1/ρ
    lengthwise = along_b + (2 * b**3 - a**3 - 2 * d**3) / 3 + a * a * d  # mean of x²/ρ³
    unit = 2 * (1 + poisson) / (math.pi * modulus * (a * b) ** 2)
    widthwise = inverse - lengthwise
    return (
        unit * (1 - poisson) * inverse,
        unit * ((1 - poisson) * inverse + poisson * lengthwise),
        unit * ((1 - poisson) * inverse + poisson * widthwise),
    )


def local_block(normal: Array, compliance: tuple[float, float, float]) -> Array:
    """Compliance (3, 3) in (r, θ, z) of a half-space under a patch with `normal` (r, z)."""
    nr, nz = normal / np.linalg.norm(normal)
    frame = np.array([[nr, 0, nz], [-nz, 0, nr], [0, 1, 0]])  # across, along the groove's arc, θ
    return frame.T @ (np.array(compliance)[:, None] * frame)


def semidefinite_factor(matrix: Array) -> Array:
    """Q with Q Qᵀ nearest to a symmetric matrix; what is stiffer than a half-space counts rigid."""
    values, vectors = np.linalg.eigh((matrix + matrix.T) / 2)
    kept = values > 1e-12 * np.abs(values).max()
    return vectors[:, kept] * np.sqrt(values[kept])
