"""Means of autocorrelated series and how sure they are.

The variance of the mean of a correlated record is its spectral density at zero frequency over its
length. The density is taken from the squared cosine coefficients of the lowest frequencies
j/(2T), j = 1 … B (equal-weighted cosine estimator; Lazarus, Lewis, Stock & Watson, J. Business &
Economic Statistics 36, 2018): it needs no model of the correlation, and a ratio of mean squares
formed with it is F-distributed. It holds as long as the density is flat up to B/(2T): with B = 4
for correlation times below about T/40: 15 s in a record of 600 s.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from loadflow.seeds._samples import Floats, as_samples

COSINES = 4
ROUNDING = 1e-12  # of the level: smaller differences are rounding errors, not signal


@dataclass(frozen=True)
class LongRun:
    """Means of the features of one record and what they scatter by.

    Attributes
    ----------
    n : int
        Number of values.
    mean : ndarray, shape (k,)
        Mean of each feature.
    cosines : ndarray, shape (B, k)
        Lowest cosine coefficients; the mean of their squares is n times the variance of the mean.
    """

    n: int
    mean: Floats
    cosines: Floats

    @classmethod
    def of(cls, z: Floats, cosines: int = COSINES) -> LongRun:
        """Summarise a record `z` of shape (n, k)."""
        mean = z.mean(axis=0)
        return cls(z.shape[0], mean, _cosines(z.shape[0], cosines) @ (z - mean))


@dataclass(frozen=True)
class EqualMeans:
    """F test of equal means, per feature.

    Attributes
    ----------
    statistic, pvalue : ndarray, shape (k,)
        F with (m − 1, B m) degrees of freedom, and its p value.
    """

    statistic: Floats
    pvalue: Floats


@lru_cache(maxsize=4)
def _cosines(n: int, count: int) -> Floats:
    """First cosine functions on `n` places, of squared norm one; shape (count, n)."""
    j = np.arange(1, count + 1)[:, None]
    basis = np.sqrt(2.0 / n) * np.cos(np.pi / n * j * (np.arange(n) + 0.5))
    basis.setflags(write=False)
    return basis


def long_run_variance(runs: Sequence[LongRun]) -> Floats:
    """Variance of a mean times the number of values, pooled over records; shape (k,)."""
    return np.mean([run.cosines**2 for run in runs], axis=(0, 1))


def equal_means(runs: Sequence[LongRun]) -> EqualMeans:
    """Test whether records have equal means, feature by feature.

    Parameters
    ----------
    runs : sequence of LongRun
        At least two records with the same features; lengths may differ.

    Returns
    -------
    EqualMeans
    """
    from scipy.special import fdtrc

    n = np.array([run.n for run in runs])[:, None]
    means = np.stack([run.mean for run in runs])
    grand = np.sum(n * means, axis=0) / n.sum()
    m = len(runs)
    between = np.sum(n * (means - grand) ** 2, axis=0) / (m - 1)
    within = long_run_variance(runs)
    floor = n.sum() * (ROUNDING * np.abs(means).max(axis=0)) ** 2
    f = np.where(between <= floor, 0.0, between / np.maximum(within, np.finfo(float).tiny))
    return EqualMeans(f, fdtrc(m - 1, m * runs[0].cosines.shape[0], f))


def effective_size(x: Iterable[ArrayLike]) -> float:
    """Number of independent values that would make a record's mean as sure as it is.

    Parameters
    ----------
    x : array_like, shape (case, time), or iterable of array_like, shape (n_i,)
        Records of one process; the more, the surer the number: six have 24 degrees of freedom.

    Returns
    -------
    float
        Mean over the records; between 1 and the number of values. Right on average before that cap;
        of one record alone half of the answers are below 0.6 of it.

    Raises
    ------
    InputError
        A record is not finite or has fewer than 8 values.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import effective_size
    >>> noise = np.random.default_rng(0).standard_normal((6, 4000))
    >>> slow = np.cumsum(noise, axis=1) - np.cumsum(noise, axis=1).mean(axis=1, keepdims=True)
    >>> bool(effective_size(slow) < 0.02 * effective_size(noise))
    True
    """
    samples = as_samples(x, least=2 * COSINES)
    runs = [LongRun.of(sample[:, None]) for sample in samples]
    n = float(np.mean([run.n for run in runs]))
    variance = float(np.mean([sample.var() for sample in samples]))
    if variance <= (ROUNDING * max(abs(float(run.mean[0])) for run in runs)) ** 2:
        return n
    slow = float(long_run_variance(runs)[0])
    freedom = COSINES * len(runs)  # of `slow`, whose reciprocal is on average d / (d − 2) too large
    tiny = np.finfo(float).tiny
    return float(np.clip(n * variance / max(slow, tiny) * (1 - 2 / freedom), 1.0, n))


def holm(pvalues: Floats | Sequence[float]) -> Floats:
    """Holm's adjusted p values: reject where they are below the level of the whole family.

    Parameters
    ----------
    pvalues : array_like, shape (k,)
        p values of k tests, in any dependence.

    Returns
    -------
    ndarray (k,)
        Adjusted p values, at most 1.

    Examples
    --------
    >>> holm([0.01, 0.04, 0.03]).tolist()
    [0.03, 0.06, 0.06]
    """
    p = np.asarray(pvalues, dtype=float)
    order = np.argsort(p)
    stepped = np.maximum.accumulate(p[order] * np.arange(p.size, 0, -1))
    adjusted = np.empty_like(p)
    adjusted[order] = np.minimum(stepped, 1.0)
    return adjusted
