"""Rating life: capacity, equivalent load, load spectra, oscillation.

ISO 281 with the thrust ball table, the slewing-bearing rules of the NREL guideline DG03 as printed
in [Ritzer 2018] ch. 2.5 and 4.4, and the reference life of ISO/TS 16281 per raceway.
Lives are in millions of revolutions, as in the standards, unless named otherwise.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError

Array = NDArray[np.float64]

POINT_EXPONENT = 3.0
LINE_EXPONENT = 10.0 / 3.0

# Tab. 4.8: f_cm over γ for contact angles of 45°, 60°, 75° (ISO 281, thrust ball bearings).
_GAMMA = np.r_[0.01:0.105:0.01, 0.12:0.305:0.02]
_F_CM = {
    45: "42.1 51.7 58.2 63.3 67.3 70.7 73.5 75.9 78.0 79.7 82.3 84.1 85.1 85.5 85.4 84.9 84.0 82.8 "
    "81.3 79.6",
    60: "39.2 48.1 54.2 58.9 62.6 65.8 68.4 70.7 72.6 74.2 76.6 78.3 79.2 79.6 79.5",
    75: "37.3 45.9 51.7 56.1 59.7 62.7 65.2 67.3 69.2 70.7",
}
_COLUMNS = {np.radians(a): np.array(text.split(), float) for a, text in _F_CM.items()}


def capacity_factor(gamma: float, contact_angle: float) -> float:
    """Factor f_cm of Tab. 4.8, linear in γ and in the contact angle.

    Parameters
    ----------
    gamma : float
        D_w cos α₀/D_pw, (4.10).
    contact_angle : float
        Nominal contact angle, rad, 45° … 75°.

    Raises
    ------
    InputError
        If γ or the angle is outside the table.
    """
    angles = np.array(list(_COLUMNS))
    if not angles[0] - 1e-6 <= contact_angle <= angles[-1] + 1e-6:
        raise InputError(
            f"contact_angle: f_cm is tabulated for 45° … 75°, got {np.degrees(contact_angle):.4g}°"
        )
    upper = int(np.clip(np.searchsorted(angles, contact_angle), 1, 2))
    pair = [_COLUMNS[angles[upper - 1]], _COLUMNS[angles[upper]]]
    last = _GAMMA[(len(pair[1]) if contact_angle > angles[upper - 1] + 1e-6 else len(pair[0])) - 1]
    if not _GAMMA[0] <= gamma <= last:
        raise InputError(f"gamma: f_cm is tabulated for {_GAMMA[0]} … {last:.2f}, got {gamma:.5g}")
    values = [np.interp(gamma, _GAMMA[: len(c)], c) for c in pair]
    return float(np.interp(contact_angle, angles[upper - 1 : upper + 1], values))


def slewing_capacity(
    *,
    balls: int,
    rows: int,
    ball_diameter: float,
    pitch_diameter: float,
    contact_angle: float,
    groove_radius: float,
    factor: float | None = None,
) -> float:
    """Basic dynamic axial capacity C_a of a ball slewing bearing, N, (4.8)–(4.10).

    Parameters
    ----------
    balls, rows : int
        Balls per row and number of rows.
    ball_diameter, pitch_diameter, groove_radius : float
        m.
    contact_angle : float
        Nominal contact angle, rad.
    factor : float, optional
        f_cm; from `capacity_factor` if not given.

    Raises
    ------
    InputError
        If the osculation (r - R_w)/R_w exceeds 0.08, where the source leaves the correction open, or the geometry is outside the table.
    """
    osculation = 2 * groove_radius / ball_diameter - 1
    if osculation > 0.08:
        raise InputError(
            f"groove_radius: capacity holds for (r - R_w)/R_w ≤ 0.08, got {osculation:.3g}; "
            "state dynamic_capacity instead"
        )
    if factor is None:
        gamma = ball_diameter * np.cos(contact_angle) / pitch_diameter
        factor = capacity_factor(gamma, contact_angle)
    d = ball_diameter * 1e3
    size = d**1.8 if d <= 25.4 else 3.647 * d**1.4
    angle = (rows * np.cos(contact_angle)) ** 0.7 * np.tan(contact_angle)
    return float(1.3 * factor * angle * balls ** (2 / 3) * size)


def equivalent_axial_load(force_cubes: ArrayLike, balls: int, contact_angle: float) -> Array:
    """Equivalent axial load P_ea, N, from the sum of the cubed ball forces, (2.21) and (4.4).

    Parameters
    ----------
    force_cubes : array_like
        Sum of F³ over all contacts of all rows and diagonals, N³.
    balls : int
        Balls of all rows together.
    contact_angle : float
        Nominal contact angle, rad.
    """
    mean = np.cbrt(np.asarray(force_cubes, float) / balls)
    return np.asarray(mean * balls * np.sin(contact_angle))


def rating_life(capacity: ArrayLike, load: ArrayLike, exponent: float = POINT_EXPONENT) -> Array:
    """Basic rating life L10 = (C/P)^p in millions of revolutions, (2.19); infinite without load."""
    c, p = np.broadcast_arrays(np.asarray(capacity, float), np.asarray(load, float))
    return np.divide(c, p, out=np.full(p.shape, np.inf), where=p > 0) ** exponent


def spectrum_load(
    load: ArrayLike,
    weight: ArrayLike,
    exponent: float = POINT_EXPONENT,
    axis: int | tuple[int, ...] | None = None,
) -> Array:
    """Constant load with the damage of a spectrum: (Σ P^p w/Σ w)^(1/p), (4.5).

    Parameters
    ----------
    load : array_like
        Equivalent load of each step, N.
    weight : array_like
        Revolutions (or over-rolled angle) of each step; broadcasts with `load`.
    exponent : float
        Life exponent: 3 for points, 10/3 for lines.
    axis : int or tuple of int, optional
        Axes to sum over; all by default.

    Raises
    ------
    InputError
        If weights are negative or all zero.
    """
    p, w = np.broadcast_arrays(np.asarray(load, float), np.asarray(weight, float))
    total = w.sum(axis=axis)
    if np.any(w < 0) or np.any(total <= 0):
        raise InputError("weight: must be ≥ 0 with a positive sum")
    peak = np.maximum(p.max(axis=axis, keepdims=True, initial=0.0), np.finfo(float).tiny)
    mean = ((p / peak) ** exponent * w).sum(axis=axis) / total
    return np.asarray(mean ** (1 / exponent) * peak.reshape(mean.shape))


def rating_life_spectrum(
    capacity: float,
    load: ArrayLike,
    revolutions: ArrayLike,
    exponent: float = POINT_EXPONENT,
    axis: int | tuple[int, ...] | None = None,
) -> Array:
    """Rating life under a load spectrum or series, weighted by revolutions (Palmgren–Miner).

    Parameters
    ----------
    capacity : float
        Basic dynamic capacity, N.
    load : array_like
        Equivalent load of each step, N (`equivalent_load` of a result).
    revolutions : array_like
        Revolutions of each step, or any weight in their proportion.
    exponent : float
        Life exponent.
    axis : int or tuple of int, optional
        Axes to sum over; all by default.

    Returns
    -------
    ndarray
        L10 in millions of revolutions.
    """
    return rating_life(capacity, spectrum_load(load, revolutions, exponent, axis), exponent)


def raceway_capacity_thrust(
    capacity: float, balls: int, contact_angle: float, gamma: float, osculation: float = 1.0
) -> tuple[float, float]:
    """Dynamic capacities (Q_ci, Q_ce) of the raceways of one thrust ball row, N, ISO/TS 16281.

    Parameters
    ----------
    capacity : float
        Basic dynamic axial capacity of the row, N.
    balls : int
        Balls in the row.
    contact_angle : float
        Nominal contact angle, rad, below 90°.
    gamma : float
        D_w cos α/D_pw.
    osculation : float
        r_i (2 r_e - D)/(r_e (2 r_i - D)) of the groove radii; 1 for equal grooves.
    """
    ratio = _raceway_ratio(gamma, osculation)
    each = capacity / (balls * np.sin(contact_angle))
    return (
        float(each * (1 + ratio ** (10 / 3)) ** 0.3),
        float(each * (1 + ratio ** (-10 / 3)) ** 0.3),
    )


def raceway_capacity_radial(
    capacity: float,
    balls: int,
    rows: int,
    contact_angle: float,
    gamma: float,
    osculation: float = 1.0,
) -> tuple[float, float]:
    """Dynamic capacities (Q_ci, Q_ce) of the raceways of a radial ball bearing, N, ISO/TS 16281.

    Parameters
    ----------
    capacity : float
        Basic dynamic radial capacity, N.
    balls, rows : int
        Balls per row, rows.
    contact_angle, gamma, osculation : float
        As in `raceway_capacity_thrust`.
    """
    ratio = _raceway_ratio(gamma, osculation)
    each = capacity / (balls * np.cos(contact_angle) ** 0.7 * rows**0.7)
    return (
        float(each / 0.407 * (1 + ratio ** (10 / 3)) ** 0.3),
        float(each / 0.389 * (1 + ratio ** (-10 / 3)) ** 0.3),
    )


def _raceway_ratio(gamma: float, osculation: float) -> float:
    """Capacity of the inner over the outer raceway of a ball bearing."""
    return float(1.044 * ((1 - gamma) / (1 + gamma)) ** 1.72 * osculation**0.41)


def life_hours(life: ArrayLike, speed: ArrayLike) -> Array:
    """Life in hours from millions of revolutions at `speed` (rad/s), (4.12)."""
    turns_per_hour = np.abs(np.asarray(speed, float)) / (2 * np.pi) * 3600
    return np.asarray(np.asarray(life, float) * 1e6 / turns_per_hour)


Amplitude = Literal["travel", "half"]


def oscillation_speed(
    frequency: ArrayLike, amplitude: ArrayLike, definition: Amplitude = "travel"
) -> Array:
    """Equivalent steady speed of an oscillation, rad/s, (4.13).

    Parameters
    ----------
    frequency : array_like
        Oscillations per second, 1/s.
    amplitude : array_like
        Amplitude, rad.
    definition : {"travel", "half"}
        ``"travel"``: the whole path of one oscillation, as (4.13) reads it; ``"half"``: from the
        middle to one end, so that one oscillation travels four times as far.
    """
    return np.asarray(_travel(amplitude, definition) * np.asarray(frequency, float))


def _travel(amplitude: ArrayLike, definition: Amplitude) -> Array:
    """Path of one oscillation, rad."""
    factors = {"travel": 1.0, "half": 4.0}
    if definition not in factors:
        raise InputError(f"definition: must be 'travel' or 'half', got {definition!r}")
    return np.asarray(amplitude, float) * factors[definition]


def overrollings(balls: int, gamma: float) -> float:
    """Passages u_j of balls over a point of the inner ring in one revolution, (4.7)."""
    return balls / 2 * (1 + gamma)


def critical_amplitude(balls: int, gamma: float) -> float:
    """Critical amplitude O_crit, rad, (4.6) as printed (twice the usual 720°/[Z(1 ∓ γ)])."""
    return 4 * np.pi / overrollings(balls, gamma) / (1 - gamma)


def oscillation_load(
    load: ArrayLike,
    frequency: ArrayLike,
    time: ArrayLike,
    amplitude: ArrayLike,
    *,
    exponent: float = POINT_EXPONENT,
    critical: float | None = None,
    rule: Literal["as-printed", "rumbarger"] = "as-printed",
) -> float:
    """Equivalent load of an oscillation spectrum, N, (4.5).

    Weights are N t O^x. Amplitudes that differ from each other only by the definition (travel or
    half) give the same load, except beside `critical`.

    Parameters
    ----------
    load, frequency, time, amplitude : array_like, shape (case,)
        Equivalent load (N), oscillations per second, share of time, amplitude (rad).
    exponent : float
        Life exponent.
    critical : float, optional
        Critical amplitude, rad (`critical_amplitude`); without it x = 1 throughout.
    rule : {"as-printed", "rumbarger"}
        Where x = 9/10: above the critical amplitude as the source prints, or below it as in
        Rumbarger's and Harris's rule, of which the print is probably a swap.
    """
    o = np.asarray(amplitude, float)
    x = np.ones_like(o)
    if critical is not None:
        above = o > critical
        x = np.where(above if rule == "as-printed" else ~above, 0.9, 1.0)
    weight = np.asarray(frequency, float) * np.asarray(time, float) * o**x
    return float(spectrum_load(load, weight, exponent))


def mean_speed(speed: ArrayLike, time: ArrayLike) -> float:
    """Mean speed Σ n t, rad/s, (4.14); shares of time are used as they are, not normalised."""
    return float(np.sum(np.asarray(speed, float) * np.asarray(time, float)))
