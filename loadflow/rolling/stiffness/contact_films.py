"""Dynamic stiffness of lubricated contacts after Richter and Dietl, and proportional damping.

Complex stiffnesses k + iωc, N/m, for vibration at the circular frequency ω. Equation numbers are
those of Kruk's review.

References
----------
Richter, Dietl, as reviewed by Kruk. Krämer, E.: Dynamics of Rotors and Foundations. Springer 1993
(damping of 0.25 … 2.5e-5 s times the stiffness).
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_one_of

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


def richter_printed(
    bulk_modulus: float,
    length: float,
    half_width: float,
    film: float,
    viscosity: float,
    frequency: float,
) -> tuple[float, float]:
    """Stiffness (N/m) and damping (N s/m) of the plate in the printed real form, (2.5)–(2.10).

    Exact, but undefined at γ₆ = π/2 + kπ and overflowing for stiff films; arguments as
    `richter_plate`.
    """
    g3 = 12 * viscosity * frequency / (film**2 * bulk_modulus)
    g6 = half_width * np.sqrt(g3 / 2)
    tan, tanh = np.tan(g6), np.tanh(g6)
    over = 1 + tanh**2 * tan**2
    g4 = (tanh / np.cos(g6) ** 2 + tan / np.cosh(g6) ** 2) / over
    g5 = (tanh / np.cos(g6) ** 2 - tan / np.cosh(g6) ** 2) / over
    scale, reach = bulk_modulus * length / film, np.sqrt(2 / g3)
    return (
        float(scale * (2 * half_width - reach * g4)),
        float(scale / frequency * reach * g5),
    )


def in_series(*stiffnesses: ArrayLike) -> Complex:
    """Complex stiffness of springs (and dampers) in series, N/m; 0 if one of them is 0."""
    parts = np.broadcast_arrays(*(np.asarray(k, complex) for k in stiffnesses))
    soft = np.any([p == 0 for p in parts], axis=0)
    compliance = sum(1 / np.where(p == 0, 1.0, p) for p in parts)
    return np.asarray(np.where(soft, 0.0, 1 / np.where(soft, 1.0, compliance)))


def richter_roller(
    inner: ArrayLike,
    outer: ArrayLike,
    force: ArrayLike,
    deflection: ArrayLike,
    frequency: ArrayLike,
    variant: Literal["physics", "printed"] = "physics",
) -> Complex:
    """Complex stiffness of a roller between two films and two Hertzian contacts, N/m, (2.3), (2.4).

    Parameters
    ----------
    inner, outer : array_like of complex
        Films at both rings (`richter_plate`).
    force, deflection : array_like
        Static load, N, and elastic approach of the rings, m, whose secant is the structure.
    frequency : array_like
        rad/s.
    variant : {"physics", "printed"}
        Films and structure carry the same load and are in series; Kruk adds the structure in
        parallel, and puts the films' stiffnesses and dampings in series each by itself.
    """
    secant = np.asarray(force, float) / np.asarray(deflection, float)
    if variant == "physics":
        return in_series(inner, outer, secant)
    check_one_of("variant", variant, ("physics", "printed"))
    first, second = np.asarray(inner, complex), np.asarray(outer, complex)
    stiffness = in_series(first.real, second.real).real + secant
    damping = in_series(first.imag / frequency, second.imag / frequency).real
    return np.asarray(stiffness + 1j * np.asarray(frequency, float) * damping)


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


def dietl_roller(
    inner: ArrayLike, outer: ArrayLike, variant: Literal["physics", "printed"] = "physics"
) -> Complex:
    """Complex stiffness k + iωc of a roller between its two contacts, N/m, (2.16).

    Parameters
    ----------
    inner, outer : array_like of complex
        Contacts with both rings. A law of both contacts together, as (5.14) of von Hollen, is
        already the series.
    variant : {"physics", "printed"}
        Springs in series, or a quarter of their sum: too stiff by ((k₁ - k₂)/(k₁ + k₂))².
    """
    if variant == "physics":
        return in_series(inner, outer)
    check_one_of("variant", variant, ("physics", "printed"))
    return (np.asarray(inner, complex) + np.asarray(outer, complex)) / 4


def dietl_material_damping(stiffness: ArrayLike, loss: float, frequency: ArrayLike) -> Array:
    """Damping ψ k/ω of the steel, N s/m, (2.12).

    Parameters
    ----------
    stiffness : array_like
        N/m.
    loss : float
        ψ, energy lost in a cycle over 2π times the largest strain energy.
    frequency : array_like
        Circular frequency, rad/s.
    """
    return np.asarray(loss * np.asarray(stiffness, float) / np.asarray(frequency, float))


def dietl_film_damping(
    mass: float, frequency: ArrayLike, decrement: float, contacts: Literal[1, 2] = 1
) -> Array:
    """Damping of the film from a measured logarithmic decrement, N s/m, (2.14).

    Parameters
    ----------
    mass : float
        Mass that swings, kg.
    frequency : array_like
        Its circular frequency, rad/s.
    decrement : float
        Logarithmic decrement.
    contacts : {1, 2}
        Contacts that share the decrement: the printed factor 4 m f stands for two.
    """
    if contacts not in (1, 2):
        raise InputError(f"contacts: must be 1 or 2, got {contacts!r}")
    return np.asarray(contacts * mass * np.asarray(frequency, float) / np.pi * decrement)


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
