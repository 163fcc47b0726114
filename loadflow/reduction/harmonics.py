"""Harmonics of a load series: amplitude, frequency and phase."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from loadflow.errors import InputError
from loadflow.reduction._series import Floats

Window = Literal["hann", "rectangular"]

# distance of two peaks in bins 1/T below which the window cannot part them
LOBE = {"hann": 2.0, "rectangular": 1.0}


@dataclass(frozen=True)
class Harmonic:
    """amplitude · sin(2π frequency · t + phase), t from the start of the series.

    Attributes
    ----------
    amplitude : float
        In the unit of the series.
    frequency : float
        Hz.
    phase : float
        rad, −π to π.
    label : str
        ``"1p"``, ``"3p"``, … or the name of a known frequency; empty if there is none near.
    kind : str
        ``"base"`` or ``"additional"`` load (4.25, 4.27 of [Jonuschies 2015]); empty if not sorted.

    Examples
    --------
    >>> from loadflow.reduction import Harmonic
    >>> Harmonic(amplitude=2e5, frequency=0.2, phase=0.0, label="1p").label
    '1p'
    """

    amplitude: float
    frequency: float
    phase: float
    label: str = ""
    kind: str = ""

    def __call__(self, time: Floats) -> Floats:
        """Values at `time` in s."""
        angle = 2.0 * np.pi * self.frequency * np.asarray(time, dtype=float) + self.phase
        return self.amplitude * np.sin(angle)


def window_weights(window: Window, n: int) -> Floats:
    """Weights of `n` values; the Hann window in its periodic form."""
    if window == "rectangular":
        return np.ones(n)
    if window == "hann":
        return 0.5 - 0.5 * np.cos(2.0 * np.pi / n * np.arange(n))
    raise InputError(f'window = {window!r}; allowed: "hann", "rectangular"')


def amplitude_spectrum(
    x: Floats, dt: float, window: Window = "hann", points: int | None = None
) -> tuple[Floats, Floats]:
    """Amplitudes of the sines in `x` about its mean.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Series.
    dt : float
        Time step in s.
    window : {"hann", "rectangular"}
        Taper; amplitudes are corrected for its mean.
    points : int, optional
        Length of the transform, at least n: the series is padded with zeros to it. By default
        the power of two above 4 n.

    Returns
    -------
    frequency : ndarray, shape (points // 2 + 1,)
        Hz.
    amplitude : ndarray, complex, same shape
        A exp(iφ) of A cos(2πft + φ).

    Raises
    ------
    InputError
        `points` is less than n.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import amplitude_spectrum
    >>> time = np.arange(2000) * 0.05
    >>> frequency, amplitude = amplitude_spectrum(3.0 * np.cos(2 * np.pi * 0.5 * time), dt=0.05)
    >>> peak = np.abs(amplitude).argmax()
    >>> round(float(frequency[peak]), 3), round(float(np.abs(amplitude[peak])), 2)
    (0.5, 3.0)
    """
    from scipy.fft import rfft, rfftfreq

    if points is None:
        points = 1 << (4 * x.size - 1).bit_length()
    if points < x.size:
        raise InputError(f"points = {points}; allowed: at least {x.size}, the length of the series")
    weights = window_weights(window, x.size)
    transform = rfft(weights * (x - x.mean()), points)
    return rfftfreq(points, dt), 2.0 * transform / weights.sum()


def find_harmonics(
    x: Floats,
    dt: float,
    count: int,
    low: float = 0.0,
    high: float = np.inf,
    *,
    window: Window = "hann",
    points: int | None = None,
    refine: bool = True,
) -> list[Harmonic]:
    """Return the largest harmonics of a series with low <= frequency < high, largest first.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Series.
    dt : float
        Time step in s.
    count : int
        How many, at most.
    low, high : float
        Range in Hz; periods longer than the record are never given.
    window, points
        See `amplitude_spectrum`.
    refine : bool
        Fit sines to the series (least squares, weighted with the window), which puts frequencies
        between the lines of the transform, and look for the next one in what is left. Without it
        the peaks of the transform are taken as they stand.

    Returns
    -------
    list of Harmonic

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import find_harmonics
    >>> time = np.arange(4000) * 0.05
    >>> load = 5.0 + 2.0 * np.sin(2 * np.pi * 0.2 * time) + np.sin(2 * np.pi * 0.6 * time)
    >>> [round(h.frequency, 2) for h in find_harmonics(load, dt=0.05, count=2)]
    [0.2, 0.6]
    """
    n = x.size
    apart = LOBE.get(window, 1.0) / (n * dt)
    low = max(low, (1.0 - 1e-9) / (n * dt))
    found: list[Harmonic] = []
    rest = x - x.mean()
    while len(found) < count:
        frequency, amplitude = amplitude_spectrum(rest, dt, window, points)
        peak = _largest_peak(frequency, np.abs(amplitude), low, high, found, apart)
        if peak is None:
            break
        a = amplitude[peak]
        found.append(Harmonic(float(abs(a)), float(frequency[peak]), _sine_phase(a)))
        if refine:
            found, rest = fit_harmonics(x, dt, found, window)
    return sorted(found, key=lambda h: -h.amplitude)


def fit_harmonics(
    x: Floats, dt: float, start: list[Harmonic], window: Window = "hann", iterations: int = 8
) -> tuple[list[Harmonic], Floats]:
    """Fit mean and sines to a series by weighted least squares (Gauss–Newton).

    A frequency may leave its start by one line 1/T of the record at most.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Series.
    dt : float
        Time step in s.
    start : list of Harmonic
        First estimates; the frequencies are what counts.
    window : {"hann", "rectangular"}
        Weights of the fit; a taper keeps unknown components elsewhere from disturbing it.
    iterations : int
        Most steps.

    Returns
    -------
    harmonics : list of Harmonic
        In the order of `start`.
    rest : ndarray, shape (n,)
        What the fit leaves.
    """
    n, k = x.size, len(start)
    weights = window_weights(window, n)
    t = dt * (np.arange(n) - 0.5 * (n - 1))  # centred: frequency and phase hardly correlate
    centre = 0.5 * dt * (n - 1)
    home = 2.0 * np.pi * np.array([h.frequency for h in start])
    omega, reach = home.copy(), 2.0 * np.pi / (n * dt)
    for _ in range(iterations):
        sine, cosine = np.sin(np.outer(omega, t)), np.cos(np.outer(omega, t))
        a, b, rest = _amplitudes(x, weights, sine, cosine)
        # change of the frequencies: column t (a cos − b sin), together with the others
        slope = t * (a[:, None] * cosine - b[:, None] * sine)
        columns = np.vstack([np.ones(n), sine, cosine, slope])
        weighted = columns * weights
        step = np.linalg.lstsq(weighted @ columns.T, weighted @ rest, rcond=1e-14)[0][1 + 2 * k :]
        moved = np.clip(omega + step, home - reach, home + reach)
        converged = np.all(np.abs(moved - omega) <= 1e-12 * home)
        omega = moved
        if converged:
            break
    sine, cosine = np.sin(np.outer(omega, t)), np.cos(np.outer(omega, t))
    a, b, rest = _amplitudes(x, weights, sine, cosine)
    fitted = [
        replace(
            h,
            amplitude=float(np.hypot(ai, bi)),
            frequency=float(w / (2.0 * np.pi)),
            phase=_wrap(float(np.arctan2(bi, ai) - w * centre)),
        )
        for h, ai, bi, w in zip(start, a, b, omega)
    ]
    return fitted, rest


def order_label(
    frequency: float,
    speed: float,
    resolution: float,
    named: dict[str, float] | None = None,
    orders: tuple[int, ...] = (1, 2, 3, 6, 9),
    tolerance: float = 0.03,
) -> str:
    """Name of a frequency: a multiple of the rotor speed, or one of the `named` frequencies.

    Parameters
    ----------
    frequency : float
        Hz.
    speed : float
        Mean rotor speed in rad/s.
    resolution : float
        Hz; a frequency this near to another one cannot be told from it.
    named : dict of str to float, optional
        Hz; of tower, drivetrain, …
    orders : tuple of int
        Multiples of the rotor speed that have a name.
    tolerance : float
        Relative distance that is still near.
    """
    known = {f"{p}p": p * abs(speed) / (2.0 * np.pi) for p in orders} | (named or {})
    name = min(known, key=lambda key: abs(known[key] - frequency))
    near = abs(known[name] - frequency) <= max(tolerance * known[name], resolution)
    return name if near and known[name] > 2.0 * resolution else ""


def _largest_peak(
    frequency: Floats,
    amplitude: Floats,
    low: float,
    high: float,
    found: list[Harmonic],
    apart: float,
) -> int | None:
    """Place of the largest local maximum within the range and apart from what was found."""
    inner = amplitude[1:-1]
    peaks = 1 + np.flatnonzero((inner > amplitude[:-2]) & (inner >= amplitude[2:]))
    free = (frequency[peaks] >= low) & (frequency[peaks] < high)
    for h in found:
        free &= np.abs(frequency[peaks] - h.frequency) >= apart
    peaks = peaks[free]
    return int(peaks[np.argmax(amplitude[peaks])]) if peaks.size else None


def _amplitudes(
    x: Floats, weights: Floats, sine: Floats, cosine: Floats
) -> tuple[Floats, Floats, Floats]:
    """Weighted least squares amplitudes of sines and cosines, and what is left of `x`."""
    columns = np.vstack([np.ones(x.size), sine, cosine])
    weighted = columns * weights
    solution = np.linalg.lstsq(weighted @ columns.T, weighted @ x, rcond=1e-14)[0].astype(float)
    k = sine.shape[0]
    return solution[1 : k + 1], solution[k + 1 :], x - solution @ columns


def _sine_phase(a: complex) -> float:
    """Phase of a sine from the complex amplitude of a cosine."""
    return _wrap(float(np.angle(a)) + 0.5 * np.pi)


def _wrap(angle: float) -> float:
    """Return the angle within −π … π."""
    return float(np.arctan2(np.sin(angle), np.cos(angle)))
