"""Extremes beyond the simulated time: block maxima and their Gumbel distribution."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.reduction._series import Floats, finite

RESAMPLES = 2000


@dataclass(frozen=True)
class ExtremeValue:
    """An extrapolated maximum.

    Attributes
    ----------
    value : float
        Level that a period of the wanted length exceeds once on average.
    low, high : float
        Its confidence interval.
    location, scale : float
        Of the Gumbel distribution of the block maxima.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import extreme_value
    >>> found = extreme_value(np.random.default_rng(0).gumbel(100.0, 5.0, 60), horizon=1e4)
    >>> bool(found.low < found.value < found.high)
    True
    """

    value: float
    low: float
    high: float
    location: float
    scale: float


def block_maxima(x: ArrayLike, dt: float, block: float) -> Floats:
    """Maxima of blocks of `block` seconds along the last axis; what is left at the end is dropped.

    Parameters
    ----------
    x : array_like, shape (..., n)
        Series.
    dt : float
        Time step in s.
    block : float
        Length of a block in s, several correlation times.

    Returns
    -------
    ndarray, shape (k,)
        Maxima of all the series together.

    Raises
    ------
    InputError
        The block is shorter than a step or longer than the record; a value is not finite.

    Examples
    --------
    >>> from loadflow.reduction import block_maxima
    >>> block_maxima([1.0, 3.0, 2.0, 5.0, 4.0, 0.0], dt=1.0, block=2.0).tolist()
    [3.0, 5.0, 4.0]
    """
    series = finite("x", x)
    if not (dt > 0 and block >= dt):
        raise InputError(f"block = {block} s; allowed: at least the time step, {dt} s")
    length = round(block / dt)
    if series.ndim == 0 or series.shape[-1] < length:
        raise InputError(f"block = {block} s is longer than the record")
    count = series.shape[-1] // length
    blocks = series[..., : count * length].reshape(*series.shape[:-1], count, length)
    return blocks.max(axis=-1).ravel()


def extreme_value(
    maxima: ArrayLike, horizon: float, confidence: float = 0.95, seed: int = 0
) -> ExtremeValue:
    """Extrapolate block maxima to the level exceeded once in `horizon` blocks.

    A Gumbel distribution is fitted by L-moments; the confidence interval is a parametric
    bootstrap-t [Hesterberg 2015], which does not cover doubt about the distribution itself.

    Parameters
    ----------
    maxima : array_like, shape (k,)
        Block maxima, from blocks of equal conditions.
    horizon : float
        Number of blocks, more than 1: 50 years of 10-minute blocks are 2.6 million.
    confidence : float
        Of the interval.
    seed : int
        Of the bootstrap.

    Returns
    -------
    ExtremeValue

    Raises
    ------
    InputError
        Fewer than ten maxima, one not finite, or an option out of range.

    Examples
    --------
    >>> maxima = np.random.default_rng(0).gumbel(100.0, 5.0, 400)
    >>> got = extreme_value(maxima, horizon=1e4)
    >>> bool(got.low < 100 + 5 * np.log(1e4) < got.high)
    True
    """
    x = finite("maxima", maxima)
    if x.ndim != 1 or x.size < 10:
        raise InputError(f"maxima has shape {x.shape}; (k,) with k >= 10 is needed")
    if not horizon > 1:
        raise InputError(f"horizon = {horizon}; allowed: horizon > 1")
    if not 0 < confidence < 1:
        raise InputError(f"confidence = {confidence}; allowed: 0 < confidence < 1")
    location, scale = (float(v) for v in gumbel_parameters(x))
    draws = np.random.default_rng(seed).gumbel(size=(RESAMPLES, x.size))
    standard_location, standard_scale = gumbel_parameters(draws)
    variate = -np.log(-np.log1p(-1.0 / horizon))
    # pivot: how far a fit of k standard maxima misses the true level, in its own scale
    miss = (standard_location + standard_scale * variate - variate) / standard_scale
    value = location + scale * variate
    upper, lower = np.quantile(miss, [(1 - confidence) / 2, (1 + confidence) / 2])
    return ExtremeValue(
        value, float(value - scale * lower), float(value - scale * upper), location, scale
    )


def gumbel_parameters(x: Floats) -> tuple[Floats, Floats]:
    """Location and scale of a Gumbel distribution along the last axis.

    By L-moments [Hosking and Wallis 1997].
    """
    from scipy.stats import lmoment  # 0.7 s of processor time, which what has no extreme saves

    first, second = lmoment(x, order=[1, 2], axis=-1)
    scale = second / np.log(2.0)
    return first - np.euler_gamma * scale, scale
