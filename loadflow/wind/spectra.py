"""Kaimal spectrum and exponential coherence of IEC 61400-1 (Annex B of edition 3, C of 4)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.wind import iec
from loadflow.wind.iec import Floats


def kaimal_spectrum(
    frequency: ArrayLike,
    wind_speed: float,
    sigma: float,
    length_scale: float,
    component: int = 0,
) -> Floats:
    """One-sided power spectral density of one component, m²/s² per Hz.

    f S/σk² = 4 f Lk/V / (1 + 6 f Lk/V)^(5/3), with σk and Lk the component's shares of σ1 and Λ1.

    Parameters
    ----------
    frequency : array_like
        Frequency, Hz.
    wind_speed, sigma, length_scale : float
        Mean speed at the hub (m/s), σ1 (m/s) and Λ1 (m).
    component : {0, 1, 2}
        u, v or w.
    """
    passage = iec.COMPONENT_LENGTH[component] * length_scale / wind_speed
    variance = (iec.COMPONENT_SIGMA[component] * sigma) ** 2
    return 4 * variance * passage / (1 + 6 * passage * np.asarray(frequency, float)) ** (5 / 3)


def coherence_decay(frequency: ArrayLike, wind_speed: float, length_scale: float) -> Floats:
    """Decay κ in 1/m of the coherence exp(−κ r) over a distance r across the wind.

    κ = 12 [(f/V)² + (0.12/Lc)²]^½ with Lc = 8.1 Λ1. All of frequency, speed and length scale
    enter through this one number.
    """
    steady = 0.12 / (iec.COMPONENT_LENGTH[0] * length_scale)
    return 12 * np.hypot(np.asarray(frequency, float) / wind_speed, steady)


def coherence(
    frequency: ArrayLike, distance: ArrayLike, wind_speed: float, length_scale: float
) -> Floats:
    """Magnitude of the cross-spectrum of u over its auto-spectrum, at `distance` in m."""
    return np.exp(-coherence_decay(frequency, wind_speed, length_scale) * np.asarray(distance))


def check_turbulence(wind_speed: float, sigma: float, length_scale: float) -> None:
    """Raise `InputError` unless the three describe a turbulent wind."""
    for name, value, unit in (
        ("wind_speed", wind_speed, "m/s"),
        ("length_scale", length_scale, "m"),
    ):
        if not 0 < value < np.inf:
            raise InputError(f"{name} = {value} {unit} must be > 0 and finite")
    if not 0 <= sigma < np.inf:
        raise InputError(f"sigma = {sigma} m/s must not be negative")
