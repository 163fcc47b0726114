"""Periodic design loads: mean, base load and additional loads (4.3.2 of [Jonuschies 2015])."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.reduction._series import Floats, check_series, finite
from loadflow.reduction.bounds import FrequencyBounds, Response, frequency_bounds
from loadflow.reduction.harmonics import Harmonic, Window, find_harmonics, order_label

ORDER_BAND = 0.05  # relative half width of the search for an order of the rotor speed


@dataclass(frozen=True)
class PeriodicLoad:
    """A mean force, harmonics on each axis and a constant speed.

    Attributes
    ----------
    speed : float
        Mean speed in rad/s.
    mean : ndarray, shape (2,)
        Mean force in N.
    harmonics : tuple of two tuples of Harmonic
        Per axis; the base load first, if there is one, then the additional loads.
    bounds : FrequencyBounds or None
        How base and additional loads were told apart, if a bearing was asked.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import Harmonic, PeriodicLoad
    >>> swing = Harmonic(amplitude=3e5, frequency=0.2, phase=0.0)
    >>> load = PeriodicLoad(speed=1.25, mean=np.array([2e6, 0.0]), harmonics=((swing,), ()))
    >>> load.frequencies
    (0.2,)
    """

    speed: float
    mean: Floats
    harmonics: tuple[tuple[Harmonic, ...], tuple[Harmonic, ...]]
    bounds: FrequencyBounds | None = None

    def __call__(self, time: ArrayLike) -> Floats:
        """Force in N at `time` in s; shape (..., 2)."""
        t = np.asarray(time, dtype=float)
        axes = (sum((h(t) for h in axis), np.zeros_like(t)) for axis in self.harmonics)
        return self.mean + np.stack(list(axes), axis=-1)

    @property
    def frequencies(self) -> tuple[float, ...]:
        """All frequencies in Hz."""
        return tuple(h.frequency for axis in self.harmonics for h in axis)

    def series(self, dt: float, duration: float | None = None) -> tuple[Floats, Floats]:
        """Time (n,) and force (n, 2) in steps of at most `dt`, over a `duration` in s.

        Without `duration`, over one period of `closed` loads, both ends included.
        """
        if not dt > 0:
            raise InputError(f"dt = {dt}; allowed: dt > 0")
        if duration is None:
            duration = closing_period(self.frequencies, tolerance=1e-9).period
        time = np.linspace(0.0, duration, int(np.ceil(duration / dt - 1e-9)) + 1)
        return time, self(time)

    def closed(self, tolerance: float = 0.01) -> PeriodicLoad:
        """Return the same load with frequencies rounded so that it repeats itself soon.

        Parameters
        ----------
        tolerance : float
            Allowed relative change of a frequency.
        """
        if not self.frequencies:
            return self
        rounded = iter(closing_period(self.frequencies, tolerance).frequencies)
        first, second = (
            tuple(replace(h, frequency=next(rounded)) for h in axis) for axis in self.harmonics
        )
        return replace(self, harmonics=(first, second))


@dataclass(frozen=True)
class ClosingPeriod:
    """A common period of several frequencies.

    Attributes
    ----------
    period : float
        s.
    frequencies : tuple of float
        Hz, rounded to whole numbers of periods in it.
    error : float
        Largest relative change of a frequency.

    Examples
    --------
    >>> from loadflow.reduction import closing_period
    >>> closing_period([0.2, 0.6], tolerance=0.01).period
    5.0
    """

    period: float
    frequencies: tuple[float, ...]
    error: float


def closing_period(frequencies: Sequence[float], tolerance: float = 0.01) -> ClosingPeriod:
    """Return the shortest multiple of the longest period that all frequencies fit into.

    Parameters
    ----------
    frequencies : sequence of float
        Hz.
    tolerance : float
        Allowed relative change of a frequency.

    Returns
    -------
    ClosingPeriod

    Raises
    ------
    InputError
        No frequencies, one that is not positive, or none of the first million multiples fits.

    Examples
    --------
    >>> closing_period([0.2, 0.601], tolerance=0.01).period
    5.0
    """
    f = finite("frequencies", frequencies)
    if f.ndim != 1 or f.size == 0 or f.min() <= 0:
        raise InputError(f"frequencies = {f.tolist()}; at least one, all > 0")
    if not tolerance > 0:
        raise InputError(f"tolerance = {tolerance}; allowed: tolerance > 0")
    ratios = f / f.min()
    for first in range(1, 1_000_001, 10_000):
        turns = np.arange(first, first + 10_000)[:, None] * ratios
        error = np.abs(np.rint(turns) / turns - 1.0).max(axis=1)
        fits = np.flatnonzero(error <= tolerance)
        if fits.size:
            k = int(fits[0])
            period = float((first + k) / f.min())
            return ClosingPeriod(period, tuple(np.rint(turns[k]) / period), float(error[k]))
    raise InputError(f"frequencies = {f.tolist()} have no common period within {tolerance:g}")


def periodic(
    speed: ArrayLike,
    force: ArrayLike,
    time: ArrayLike,
    *,
    response: Response | None = None,
    bounds: tuple[float, float] | FrequencyBounds | None = None,
    additional: int = 2,
    orders: Sequence[float] | None = None,
    named: dict[str, float] | None = None,
    window: Window = "hann",
    points: int | None = None,
    refine: bool = True,
) -> PeriodicLoad:
    """Reduce a series to its mean, the base load and additional loads on each axis.

    The base load is the largest harmonic slower than the lower frequency bound (4.25), the
    additional loads are the largest ones between the bounds (4.27).

    Parameters
    ----------
    speed : array_like, shape (n,)
        rad/s; its mean is used.
    force : array_like, shape (n, 2)
        N.
    time : array_like, shape (n,)
        s, in equal steps.
    response : callable, optional
        ``response(mean, amplitude, frequency)`` → largest eccentricity ratio per period; the
        bearing that sets the bounds (`frequency_bounds`). The typical amplitude is √2 times the
        standard deviation of each component.
    bounds : (float, float) or FrequencyBounds, optional
        Lower and upper bound in Hz instead; without both, half the rotor's frequency and half the
        sampling frequency.
    additional : int
        Number of additional loads per axis.
    orders : sequence of float, optional
        Take as additional loads the largest harmonic within 5 % of each of these multiples of the
        rotor's frequency, e.g. (1, 3), whatever else there is between the bounds.
    named : dict of str to float, optional
        Known frequencies in Hz (tower, drivetrain), for the labels.
    window, points, refine
        See `loadflow.reduction.find_harmonics`. Jonuschies's tables come from
        ``window="rectangular", points=2**15, refine=False``.

    Returns
    -------
    PeriodicLoad

    Raises
    ------
    InputError
        See `histogram`; the steps of time are not equal; bounds out of order; both bounds and
        response given.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import periodic
    >>> time = np.arange(6000) * 0.1
    >>> swing = 3e5 * np.sin(2 * np.pi * 0.02 * time) + 1e5 * np.sin(2 * np.pi * 0.2 * time)
    >>> force = np.stack([2e6 + swing, 0.2 * swing], axis=-1)
    >>> load = periodic(np.full(6000, 1.25), force, time, bounds=(0.05, 1.0), additional=1)
    >>> [round(harmonic.frequency, 2) for harmonic in load.harmonics[0]]
    [0.02, 0.2]
    """
    n, f, t = check_series(speed, force, time)
    dt = _equal_step(t)
    mean, rotor = f.mean(axis=0), abs(float(n.mean())) / (2.0 * np.pi)
    if response is not None:
        if bounds is not None:
            raise InputError("give either bounds or response")
        bounds = frequency_bounds(response, mean, np.sqrt(2.0) * f.std(axis=0))
    low, high = _limits(bounds, rotor, dt)
    resolution = 1.0 / (n.size * dt)

    def largest(x: Floats, count: int, kind: str, start: float, end: float) -> list[Harmonic]:
        found = find_harmonics(
            x, dt, count, start, end, window=window, points=points, refine=refine
        )
        return [
            replace(
                h, kind=kind, label=order_label(h.frequency, 2 * np.pi * rotor, resolution, named)
            )
            for h in found
        ]

    def axis(x: Floats) -> tuple[Harmonic, ...]:
        loads = largest(x, 1, "base", 0.0, low)
        if orders is None:
            return (*loads, *largest(x, additional, "additional", low, high))
        for p in orders:
            reach = max(ORDER_BAND * p * rotor, 2.0 * resolution)
            loads += largest(x, 1, "additional", p * rotor - reach, p * rotor + reach)
        return tuple(loads)

    return PeriodicLoad(
        speed=float(n.mean()),
        mean=mean,
        harmonics=(axis(f[:, 0]), axis(f[:, 1])),
        bounds=bounds if isinstance(bounds, FrequencyBounds) else None,
    )


def _equal_step(time: Floats | None) -> float:
    """Time step in s of equidistant times."""
    if time is None or time.size < 4:
        raise InputError("time: at least four equal steps are needed")
    steps = np.diff(time)
    dt = float(time[-1] - time[0]) / steps.size
    worst = int(np.argmax(np.abs(steps - dt)))
    if abs(steps[worst] - dt) > 1e-3 * dt:
        raise InputError(f"time: step {steps[worst]:g} s at index {worst}, mean step {dt:g} s")
    return dt


def _limits(
    bounds: tuple[float, float] | FrequencyBounds | None, rotor: float, dt: float
) -> tuple[float, float]:
    """Lower and upper frequency bound in Hz."""
    if bounds is None:
        return 0.5 * rotor, 0.5 / dt
    low, high = (
        (bounds.low, bounds.high) if isinstance(bounds, FrequencyBounds) else map(float, bounds)
    )
    if not 0 < low <= high:
        raise InputError(f"bounds = ({low:g}, {high:g}) Hz; allowed: 0 < low <= high")
    return low, high
