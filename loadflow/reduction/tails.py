"""Extremes over a lifetime: how often each wind speed exceeds a level, weighted and extrapolated.

A tail says how often per second a level is exceeded. It is fitted to block maxima (Gumbel) or to
peaks over a threshold (exponential or generalised Pareto), by L-moments [Hosking & Wallis, Regional
Frequency Analysis, 1997]. The tails of all wind speeds add up, each weighted by its share of the
lifetime, as IEC 61400-1 extrapolates design load case 1.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.reduction._series import Floats, finite
from loadflow.reduction.extremes import block_maxima, gumbel_parameters

YEAR = 365.25 * 86_400.0
LEAST = 10  # values that a fit needs
ROUNDING = 1e-12  # spread of equal values, relative to the largest
RESAMPLES = 500
STEPS = 80  # halvings of the interval that holds the level: to double precision


@dataclass(frozen=True)
class Tail:
    """How often a level is exceeded: rate · (1 + shape (x − threshold)/scale)^(−1/shape).

    Attributes
    ----------
    threshold : float
        Level from which the tail begins; for block maxima the location of the Gumbel distribution.
    scale : float
        In the unit of the series.
    shape : float
        Generalised Pareto shape: 0 exponential (Gumbel), < 0 bounded, > 0 heavy.
    rate : float
        Exceedances of the threshold, 1/s.
    count : int
        Number of maxima or peaks that it was fitted to.
    kind : {"maxima", "peaks"}
        What it was fitted to.

    Examples
    --------
    >>> from loadflow.reduction import Tail
    >>> tail = Tail(threshold=100.0, scale=5.0, shape=0.0, rate=1 / 600, count=60)
    >>> bool(tail.rate_above(110.0) < tail.rate_above(105.0))
    True
    """

    threshold: float
    scale: float
    shape: float
    rate: float
    count: int
    kind: Literal["maxima", "peaks"] = "maxima"

    def rate_above(self, level: ArrayLike) -> Floats:
        """Expected exceedances of `level` per second."""
        return _rate(np.asarray(level, dtype=float), self._parameters)

    @property
    def _parameters(self) -> Floats:
        return np.array([self.threshold, self.scale, self.shape, self.rate])

    def _resampled(self, rng: np.random.Generator, draws: int) -> Floats:
        """Parameters (draws, 4) fitted to as many values drawn from this tail itself."""
        if self.kind == "maxima":
            location, scale = gumbel_parameters(
                rng.gumbel(self.threshold, self.scale, (draws, self.count))
            )
            return np.stack([location, scale, 0 * scale, np.full(draws, self.rate)], axis=1)
        exponent = rng.standard_exponential((draws, self.count))
        if self.shape == 0.0:
            scale, shape = self.scale * exponent.mean(axis=1), np.zeros(draws)
        else:
            scale, shape = _pareto(self.scale * np.expm1(self.shape * exponent) / self.shape)
        # without a single value there is no fit
        rate = self.rate * np.maximum(rng.poisson(self.count, draws), 1) / self.count
        return np.stack([np.full(draws, self.threshold), scale, shape, rate], axis=1)


@dataclass(frozen=True)
class LongTermExtreme:
    """A level that the lifetime exceeds once on average.

    Attributes
    ----------
    value, low, high : float
        The level and its confidence interval, in the unit of the series.
    shares : ndarray, shape (k,)
        How much each tail contributes to the exceedances; sums to 1.

    Examples
    --------
    >>> from loadflow.reduction import Tail, long_term_extreme
    >>> tail = Tail(threshold=100.0, scale=5.0, shape=0.0, rate=1 / 600, count=60)
    >>> found = long_term_extreme([tail], [1.0])
    >>> bool(found.low < found.value < found.high)
    True
    """

    value: float
    low: float
    high: float
    shares: Floats


def tail_of_maxima(x: ArrayLike, dt: float, block: float) -> Tail:
    """Fit a Gumbel distribution to block maxima.

    Parameters
    ----------
    x : array_like, shape (..., n), or list of array_like, shape (n_i,)
        Series of one wind speed, along the last axis; in a list they may be of several lengths.
    dt : float
        Time step in s.
    block : float
        Length of a block in s, several correlation times.

    Returns
    -------
    Tail

    Raises
    ------
    InputError
        Fewer than ten blocks, or see `block_maxima`.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import tail_of_maxima
    >>> x = np.random.default_rng(0).standard_normal((6, 6000))
    >>> tail = tail_of_maxima(x, dt=0.1, block=60.0)
    >>> tail.kind, tail.count
    ('maxima', 60)
    """
    maxima = np.concatenate([block_maxima(row, dt, block) for row in _rows(x)])
    _check(maxima, "blocks")
    location, scale = (float(v) for v in gumbel_parameters(maxima))
    return Tail(location, scale, 0.0, 1.0 / (round(block / dt) * dt), maxima.size)


def tail_of_peaks(
    x: ArrayLike,
    dt: float,
    quantile: float = 0.95,
    separation: float = 10.0,
    shape: Literal[0] | None = 0,
) -> Tail:
    """Fit an exponential or generalised Pareto distribution to peaks over a threshold.

    Parameters
    ----------
    x : array_like, shape (..., n), or list of array_like, shape (n_i,)
        Series of one wind speed, along the last axis; in a list they may be of several lengths.
    dt : float
        Time step in s.
    quantile : float
        Of all values: the threshold.
    separation : float
        s; exceedances nearer to each other than this are one peak.
    shape : 0 or None
        0: exponential excesses, the counterpart of Gumbel maxima. None: the shape is fitted, too;
        from an hour of data it is uncertain by ±0.2 or so, which fifty years do not bear.

    Returns
    -------
    Tail

    Raises
    ------
    InputError
        Fewer than ten peaks, a value is not finite, or an option out of range.

    Examples
    --------
    >>> x = np.random.default_rng(0).standard_exponential((6, 24_000))
    >>> tail = tail_of_peaks(x, dt=1.0, quantile=0.99, separation=1.0, shape=None)
    >>> abs(tail.shape) < 0.1, abs(tail.scale - 1) < 0.1
    (True, True)
    """
    rows = _rows(x)
    if not 0 < quantile < 1:
        raise InputError(f"quantile = {quantile}; allowed: 0 < quantile < 1")
    if not (dt > 0 and separation >= dt):
        raise InputError(f"separation = {separation} s; allowed: at least the time step, {dt} s")
    if shape not in (0, None):
        raise InputError(f"shape = {shape!r}; allowed: 0, None")
    threshold = float(np.quantile(np.concatenate(rows), quantile))
    apart = round(separation / dt)
    peaks = np.concatenate([_peaks(row, threshold, apart) for row in rows])
    _check(peaks, "peaks over the threshold")
    if shape is None:
        scale, fitted = (float(v) for v in _pareto(peaks - threshold))
    else:
        scale, fitted = float(peaks.mean()) - threshold, 0.0
    rate = peaks.size / (sum(row.size for row in rows) * dt)
    return Tail(threshold, scale, fitted, rate, peaks.size, "peaks")


def long_term_extreme(
    tails: Sequence[Tail],
    weights: ArrayLike,
    years: float = 50.0,
    confidence: float = 0.95,
    seed: int = 0,
) -> LongTermExtreme:
    """Return the level that is exceeded once in so many years on average.

    Parameters
    ----------
    tails : sequence of Tail
        One for each wind speed.
    weights : array_like, shape (k,)
        Share of the lifetime of each; they need not sum to 1 (the rest has no such loads).
    years : float
        Return period: IEC 61400-1 takes 50.
    confidence : float
        Of the interval, a parametric bootstrap of the fits (bootstrap-t [Hesterberg 2015]: misses
        of resampled fits in their own scale; percentiles where a shape was fitted, by which that
        scale varies over orders of magnitude); doubt about the distribution itself is not in it.
    seed : int
        Of the bootstrap.

    Returns
    -------
    LongTermExtreme
        Level, its interval, and the share of each wind speed.

    Raises
    ------
    InputError
        Lengths differ, a share is negative, or all are zero.

    Examples
    --------
    >>> tail = Tail(threshold=100.0, scale=5.0, shape=0.0, rate=1 / 600, count=60)
    >>> round(long_term_extreme([tail], [1.0]).value, 1)
    173.9
    """
    shares = finite("weights", weights)
    if shares.shape != (len(tails),) or shares.size == 0:
        raise InputError(f"weights has shape {shares.shape}; ({len(tails)},) is needed, as tails")
    if shares.min() < 0 or shares.sum() == 0:
        raise InputError(f"weights = {shares.tolist()}; allowed: >= 0, not all 0")
    if not years > 0:
        raise InputError(f"years = {years}; allowed: years > 0")
    if not 0 < confidence < 1:
        raise InputError(f"confidence = {confidence}; allowed: 0 < confidence < 1")
    wanted = 1.0 / (years * YEAR)
    best = np.stack([tail._parameters for tail in tails])[:, None]
    value = _level(best, shares, wanted)
    rng = np.random.default_rng(seed)
    drawn = np.stack([tail._resampled(rng, RESAMPLES) for tail in tails])
    level, ends = _level(drawn, shares, wanted), [(1 - confidence) / 2, (1 + confidence) / 2]
    if any(tail.shape for tail in tails):
        low, high = np.quantile(level, ends)
    else:  # pivot: how far a fit to as many values misses the level, in its own scale
        miss = (level - value) / _scale(level, drawn, shares)
        upper, lower = np.quantile(miss, ends)
        low, high = (value - _scale(value, best, shares) * [[lower], [upper]])[:, 0]
    rates = shares * [float(tail.rate_above(value[0])) for tail in tails]
    return LongTermExtreme(float(value[0]), float(low), float(high), rates / rates.sum())


def _rate(level: Floats, parameters: Floats) -> Floats:
    """Exceedances per second of `level` for parameters (..., 4)."""
    threshold, scale, shape, rate = np.moveaxis(parameters, -1, 0)
    y = (level - threshold) / scale
    curved = np.abs(shape) > 1e-9
    xi = np.where(curved, shape, 1.0)
    inside = np.maximum(1.0 + xi * y, 1e-300)
    exponent = np.where(curved, -np.log(inside) / xi, -y)
    return rate * np.exp(np.clip(exponent, -700.0, 700.0))


def _scale(level: Floats, parameters: Floats, shares: Floats) -> Floats:
    """By how much the level (draws,) rises as the rate of tails without shape falls by e."""
    rate = shares[:, None] * _rate(level, parameters)
    return np.asarray(rate.sum(axis=0) / (rate / parameters[..., 1]).sum(axis=0))


def _level(parameters: Floats, shares: Floats, wanted: float) -> Floats:
    """Level that all tails (k, draws, 4) together exceed at the `wanted` rate, by bisection."""
    spread = parameters[..., 1].max(axis=0)
    low = parameters[..., 0].min(axis=0) - 50.0 * spread
    high = parameters[..., 0].max(axis=0) + spread

    def rate(level: Floats) -> Floats:
        return np.einsum("k,kd->d", shares, _rate(level, parameters))

    for _ in range(STEPS):
        too_low = rate(high) > wanted
        if not too_low.any():
            break
        high = np.where(too_low, high + 2.0 * (high - low), high)
    for _ in range(STEPS):
        middle = 0.5 * (low + high)
        above = rate(middle) > wanted
        low, high = np.where(above, middle, low), np.where(above, high, middle)
    return 0.5 * (low + high)


def _pareto(excess: Floats) -> tuple[Floats, Floats]:
    """Scale and shape of a generalised Pareto distribution by L-moments along the last axis."""
    from scipy.stats import lmoment

    first, second = lmoment(excess, order=[1, 2], axis=-1)
    shape = 2.0 - first / np.maximum(second, np.finfo(float).tiny)
    return first * (1.0 - shape), shape


def _rows(x: ArrayLike) -> list[Floats]:
    """Series along the last axis, one by one."""
    if isinstance(x, list) and x and all(np.ndim(row) == 1 for row in x):
        return [finite("x", row) for row in x]
    series = np.atleast_1d(finite("x", x))
    if series.size == 0:
        raise InputError("x: there are no values")
    return list(series.reshape(-1, series.shape[-1]))


def _peaks(x: Floats, threshold: float, apart: int) -> Floats:
    """Largest value of each cluster of exceedances."""
    above = np.flatnonzero(x > threshold)
    if above.size == 0:
        return np.empty(0)
    starts = np.concatenate(([0], 1 + np.flatnonzero(np.diff(above) >= apart)))
    return np.maximum.reduceat(x[above], starts)


def _check(values: Floats, what: str) -> None:
    """Refuse values too few for a tail, or so equal that their spread is one of rounding."""
    if values.size < LEAST:
        raise InputError(f"{values.size} {what}; a tail needs at least {LEAST}")
    if np.ptp(values) <= ROUNDING * np.abs(values).max():
        raise InputError("all maxima are equal; there is no tail to extrapolate")
