"""Rating life: equivalent load, load spectra, oscillation.

The slewing-bearing rules of the NREL guideline DG03 as printed in [Ritzer 2018] ch. 2.5 and 4.4,
and the reference life of ISO/TS 16281 per raceway; capacities are in
`loadflow.rolling.rating.capacity`.
Lives are in millions of revolutions, as in the standards, unless named otherwise.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_one_of

Array = NDArray[np.float64]

POINT_EXPONENT = 3.0
LINE_EXPONENT = 10.0 / 3.0


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

    Returns
    -------
    ndarray
        N.

    Raises
    ------
    InputError
        If weights are negative or all zero.

    Examples
    --------
    >>> from loadflow.rolling import spectrum_load
    >>> round(float(spectrum_load([1e5, 2e5], weight=[0.9, 0.1], exponent=3.0)))  # N
    119348
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

    Examples
    --------
    >>> from loadflow.rolling import rating_life_spectrum
    >>> round(float(rating_life_spectrum(1e6, [1e5, 2e5], revolutions=[0.9, 0.1])), 1)  # 1e6 turns
    588.2
    """
    return rating_life(capacity, spectrum_load(load, revolutions, exponent, axis), exponent)


def ball_reference_life(
    cubes: ArrayLike, powers: ArrayLike, balls: int, capacity: tuple[float, float]
) -> Array:
    """Reference life L10r of ISO/TS 16281 over the raceways of all kinds, millions of revolutions.

    Parameters
    ----------
    cubes, powers : array_like, shape (..., kind)
        Sums of F³ and of F^(10/3) over the balls of each row and diagonal.
    balls : int
        Balls per row.
    capacity : tuple of float
        Dynamic capacities of the rotating (inner) and the stationary (outer) raceway, N.

    Returns
    -------
    ndarray, shape (...)
        Infinite without load.
    """
    rotating = np.cbrt(np.asarray(cubes, float) / balls) / capacity[0]
    stationary = (np.asarray(powers, float) / balls) ** 0.3 / capacity[1]
    damage = (rotating ** (10 / 3) + stationary ** (10 / 3)).sum(axis=-1)
    return np.divide(1.0, damage, out=np.full(np.shape(damage), np.inf), where=damage > 0) ** 0.9


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
    check_one_of("definition", definition, factors)
    return np.asarray(amplitude, float) * factors[definition]


def overrollings(balls: int, gamma: float) -> float:
    """Passages u_j of balls over a point of the inner ring in one revolution, (4.7)."""
    return balls / 2 * (1 + gamma)


def critical_amplitude(balls: int, gamma: float) -> float:
    """Critical amplitude O_crit, rad, (4.6): the path there and back.

    Twice the usual 720°/[Z(1 ∓ γ)], which counts from end to end.
    """
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
    definition: Amplitude = "travel",
) -> float:
    """Equivalent load of an oscillation spectrum, N, (4.5).

    Weights are N t O^x with O as the whole path of one oscillation.

    Parameters
    ----------
    load, frequency, time, amplitude : array_like, shape (case,)
        Equivalent load (N), oscillations per second, share of time, amplitude (rad).
    exponent : float
        Life exponent.
    critical : float, optional
        Critical amplitude, rad, as a whole path (`critical_amplitude`); without it x = 1
        throughout.
    rule : {"as-printed", "rumbarger"}
        Where x = 9/10: above the critical amplitude as Ritzer prints, or below it as in
        Rumbarger's and Harris's rule, of which the print is probably a swap.
    definition : {"travel", "half"}
        Of `amplitude`, see `oscillation_speed`.

    Raises
    ------
    InputError
        If `rule` or `definition` is unknown, or weights make no sense.
    """
    check_one_of("rule", rule, ("as-printed", "rumbarger"))
    o = _travel(amplitude, definition)
    x = np.ones_like(o)
    if critical is not None:
        above = o > critical
        x = np.where(above if rule == "as-printed" else ~above, 0.9, 1.0)
    weight = np.asarray(frequency, float) * np.asarray(time, float) * o**x
    return float(spectrum_load(load, weight, exponent))


def guideline_load(
    radial: ArrayLike, axial: ArrayLike, moment: ArrayLike, pitch_diameter: float
) -> Array:
    """Equivalent axial load 0.75 F_r + F_a + 2 M/D_pw of DG03, N, without ball forces.

    It takes no heed of how loads share out between the balls; `equivalent_axial_load` does.
    """
    tilt = 2 * np.abs(moment) / pitch_diameter
    return np.asarray(0.75 * np.abs(radial) + np.abs(axial) + tilt)


def oscillating_capacity(
    capacity: float,
    amplitude: ArrayLike,
    definition: Amplitude = "travel",
    *,
    elements: int,
    gamma: float,
    kind: Literal["ball", "roller"] = "ball",
) -> Array:
    """Dynamic capacity under oscillation, N: (C_osc/P)^p is the life in 10⁶ oscillations, DG03.

    Above the angle 720°/[Z(1 + γ)] between the ends, C (180°/θ)^(1/p); below it rolling elements
    never meet and C (180°/θ)^0.3 Z^0.033 holds for balls, C (180°/θ)^(2/9) Z^0.028 for rollers.
    The two differ by 5 % where they meet.

    Parameters
    ----------
    capacity : float
        Dynamic capacity C for full turns, N.
    amplitude : array_like
        Amplitude, rad, above 0.
    definition : {"travel", "half"}
        See `oscillation_speed`; θ of the guideline, from end to end, is half the travel.
    elements : int
        Rolling elements per row.
    gamma : float
        D_w cos α/D_pw.
    kind : {"ball", "roller"}
        Kind of rolling element.

    Raises
    ------
    InputError
        If an amplitude is not positive, or `kind` or `definition` is unknown.
    """
    laws = {"ball": (1 / POINT_EXPONENT, 0.3, 0.033), "roller": (1 / LINE_EXPONENT, 2 / 9, 0.028)}
    check_one_of("kind", kind, laws)
    angle = _travel(amplitude, definition) / 2
    if not np.all(angle > 0):
        raise InputError("amplitude: must be > 0 rad")
    wide, narrow, count = laws[kind]
    share = np.pi / angle
    critical = 4 * np.pi / (elements * (1 + gamma))
    factor = np.where(angle >= critical, share**wide, share**narrow * elements**count)
    return np.asarray(capacity * factor)


def mean_speed(speed: ArrayLike, time: ArrayLike) -> float:
    """Mean speed Σ n t, rad/s, (4.14); shares of time are used as they are, not normalised."""
    return float(np.sum(np.asarray(speed, float) * np.asarray(time, float)))
