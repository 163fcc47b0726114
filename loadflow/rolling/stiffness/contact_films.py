"""Dynamic stiffness of lubricated contacts after Richter and Dietl, and proportional damping.

Complex stiffnesses k + iωc, N/m, for vibration at the circular frequency ω. Equation numbers are
those of Kruk's review.

References
----------
Richter, Dietl, as reviewed by Kruk. Krämer, E.: Dynamics of Rotors and Foundations. Springer 1993
(damping of 0.25 … 2.5e-5 s times the stiffness).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


# 1 - tanh(z)/z in powers of z², from z²; below |z| = 0.2 the closed form cancels
_SERIES = (
    1 / 3, -2 / 15, 17 / 315, -62 / 2835, 1382 / 155_925, -21_844 / 6_081_075,
    929_569 / 638_512_875,
)  # fmt: skip
_SMALL = 0.2


def richter_plate(
    bulk_modulus: ArrayLike,
    length: ArrayLike,
    half_width: ArrayLike,
    film: ArrayLike,
    viscosity: ArrayLike,
    frequency: ArrayLike,
) -> Complex:
    """Complex stiffness of a compressible film squeezed between plates, N/m, (2.5)–(2.10).

    K* = E l/h (2b - 2/κ tanh κb) with κ² = 12 i η ω/(h² E): the printed real formulas in one, with
    the series where they cancel. Slow: damping η l (2b)³/h³; fast: the trapped film E l 2b/h.

    Parameters
    ----------
    bulk_modulus : array_like
        E of the oil in the contact, Pa.
    length : array_like
        Of the contact line, m.
    half_width : array_like
        Half the plates' width b (that of Hertz), m.
    film : array_like
        h > 0, m.
    viscosity : array_like
        In the contact, under its pressure, Pa s.
    frequency : array_like
        Circular frequency of the vibration ω ≥ 0, rad/s.

    Examples
    --------
    >>> k = richter_plate(1.5e9, 11e-3, 100e-6, 0.5e-6, 30.0, 100.0)
    >>> round(float(k.real) / 1e8, 4), round(float(k.imag) / 100 / 1e7, 4)
    (7.0453, 1.8383)
    """
    modulus, span, b, h, eta, omega = (
        np.asarray(v, float) for v in (bulk_modulus, length, half_width, film, viscosity, frequency)
    )
    if not (h > 0).all():
        raise InputError(f"film: must be > 0 m, got {h.min() if h.size else h}")
    phase = 12 * eta * omega / (h * h * modulus) * b * b  # |κb|²
    square = 1j * phase
    small = np.abs(phase) < _SMALL**2
    series = np.zeros(np.shape(square), complex)
    for factor in reversed(_SERIES):
        series = square * (factor + series)
    z = np.sqrt(np.where(small, 1.0, square))
    closed = 1 - np.tanh(z) / z
    return np.asarray(modulus * span / h * 2 * b * np.where(small, series, closed))


def dietl_contact_stiffness(load: ArrayLike, deflection: ArrayLike, exponent: float) -> Array:
    """Tangent n Q/δ of a contact Q = C δ^n, N/m, (2.11).

    Kruk prints C^n Q^((n-1)/n²), which is no stiffness; C^(1/n) Q^((n-1)/n) n is meant.
    """
    return np.asarray(exponent * np.asarray(load, float) / np.asarray(deflection, float))


def dietl_film_stiffness(load: ArrayLike, film: ArrayLike, exponent: float = 0.1) -> Array:
    """Stiffness Q/(m h) of a film h ~ Q^-m, N/m, (2.13).

    Parameters
    ----------
    load : array_like
        N.
    film : array_like
        m.
    exponent : float
        m, the film law's exponent of the load: about 0.1.
    """
    return np.asarray(np.asarray(load, float) / (exponent * np.asarray(film, float)))


def proportional_damping(stiffness: ArrayLike, time_constant: float = 1e-5) -> Array:
    """Damping C = σ K, (2.2).

    Parameters
    ----------
    stiffness : array_like
        Any stiffness.
    time_constant : float
        σ, s; Krämer gives 0.25e-5 … 2.5e-5 for rolling bearings.

    Raises
    ------
    InputError
        If σ is negative.
    """
    if not time_constant >= 0:
        raise InputError(f"time_constant: must be ≥ 0 s, got {time_constant}")
    return np.asarray(time_constant * np.asarray(stiffness, float))
