"""Equivalence within a margin, and how many seeds a wanted uncertainty takes."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.seeds._samples import as_samples, check_level
from loadflow.seeds.longrun import COSINES, LongRun, long_run_variance

MOST_SEEDS = 100_000


@dataclass(frozen=True)
class Equivalence:
    """Whether seeds are alike to within a margin.

    Attributes
    ----------
    location, spread : float
        Upper confidence bound of the largest difference between two seeds: of their means, over
        the root mean square of all values; of their mean distances from the median, over the
        mean of these.
    margin : float
        What was allowed.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import equivalence
    >>> x = 10.0 + np.random.default_rng(0).standard_normal((6, 6000))
    >>> found = equivalence(x, margin=0.05)
    >>> found.location < found.margin, found.spread < found.margin
    (True, True)
    """

    location: float
    spread: float
    margin: float

    @property
    def equivalent(self) -> bool:
        """Whether the seeds are shown to differ by less than the margin."""
        return max(self.location, self.spread) <= self.margin


def equivalence(x: Iterable[ArrayLike], margin: float = 0.05, alpha: float = 0.05) -> Equivalence:
    """Show that seeds differ by less than a margin: what merging them really needs.

    A test of equality that does not reject may only have been too weak. Here the burden of proof
    is turned round: seeds are equivalent if the confidence bound of every pairwise difference lies
    within the margin (two one-sided tests; all pairs must pass, so no correction is due).

    Parameters
    ----------
    x : array_like, shape (case, time), or iterable of array_like, shape (n_i,)
        One series per seed.
    margin : float
        Allowed relative difference.
    alpha : float
        Probability of calling seeds equivalent that differ by the margin.

    Returns
    -------
    Equivalence

    Raises
    ------
    InputError
        A series is not finite or has fewer than 8 values; `margin` or `alpha` out of range.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import equivalence
    >>> x = 10.0 + np.random.default_rng(0).standard_normal((6, 6000))
    >>> found = equivalence(x, margin=0.05)
    >>> found.location < found.margin
    True
    """
    from scipy.special import stdtrit

    check_level(alpha)
    if not margin > 0:
        raise InputError(f"margin = {margin}; allowed: margin > 0")
    samples = as_samples(x, least=2 * COSINES)
    if len(samples) == 1:
        return Equivalence(0.0, 0.0, margin)
    runs = [LongRun.of(np.stack([s, np.abs(s - np.median(s))], axis=1)) for s in samples]
    means = np.stack([run.mean for run in runs])
    shares = 1.0 / np.array([run.n for run in runs])
    error = np.sqrt(long_run_variance(runs) * (shares[:, None, None] + shares[None, :, None]))
    difference = np.abs(means[:, None] - means[None, :])
    bound = difference + stdtrit(COSINES * len(runs), 1.0 - alpha) * error
    first, second = np.triu_indices(len(runs), 1)
    largest = bound[first, second].max(axis=0)
    pooled = np.concatenate(samples)
    scale = np.array([np.sqrt(np.mean(pooled**2)), means[:, 1].mean()])
    relative = np.where(largest == 0.0, 0.0, largest / np.maximum(scale, np.finfo(float).tiny))
    return Equivalence(float(relative[0]), float(relative[1]), margin)


@dataclass(frozen=True)
class SeedsNeeded:
    """Number of seeds that a wanted uncertainty takes.

    Attributes
    ----------
    seeds : int
        Needed number, if the scatter between seeds is what the given ones show.
    low, high : int
        The same for the bounds of that scatter.
    scatter : float
        Coefficient of variation between the given seeds.
    uncertainty : float
        Relative half width of the confidence interval of the mean of the given seeds.

    Examples
    --------
    >>> from loadflow.seeds import seeds_needed
    >>> needed = seeds_needed([0.96, 1.02, 1.05, 0.94, 1.04, 0.99], uncertainty=0.05)
    >>> needed.low <= needed.seeds <= needed.high
    True
    """

    seeds: int
    low: int
    high: int
    scatter: float
    uncertainty: float


def seeds_needed(values: ArrayLike, uncertainty: float, confidence: float = 0.95) -> SeedsNeeded:
    """Return how many seeds give the mean of a statistic a wanted relative uncertainty.

    Parameters
    ----------
    values : array_like, shape (m,)
        One number per seed at hand: its mean, extreme, damage-equivalent load, …
    uncertainty : float
        Wanted half width of the confidence interval of their mean, relative to it.
    confidence : float
        Of that interval and of the bounds `low` and `high`.

    Returns
    -------
    SeedsNeeded

    Raises
    ------
    InputError
        Fewer than two values, mean zero, an option out of range, or more than 100,000 seeds.

    Examples
    --------
    >>> seeds_needed([0.96, 1.02, 1.05, 0.94, 1.04, 0.99], uncertainty=0.05).seeds
    6
    """
    from scipy.special import chdtri, stdtrit

    check_level(1.0 - confidence)
    if not uncertainty > 0:
        raise InputError(f"uncertainty = {uncertainty}; allowed: uncertainty > 0")
    (x,) = as_samples([values], least=2)
    mean, deviation = float(x.mean()), float(x.std(ddof=1))
    if mean == 0.0:
        raise InputError("the mean of values is 0; a relative uncertainty means nothing")
    scatter, two_sided, df = deviation / abs(mean), (1.0 + confidence) / 2.0, x.size - 1

    def needed(cov: float) -> int:
        def enough(n: int) -> bool:
            return bool(stdtrit(n - 1.0, two_sided) * cov <= uncertainty * math.sqrt(n))

        numbers = range(2, MOST_SEEDS + 1)  # once enough, more of them are, too
        if not enough(numbers[-1]):
            raise InputError(f"uncertainty = {uncertainty} needs more than {MOST_SEEDS} seeds")
        return numbers[bisect_left(numbers, True, key=enough)]

    return SeedsNeeded(
        seeds=needed(scatter),
        low=needed(scatter * float(np.sqrt(df / chdtri(df, 1.0 - two_sided)))),
        high=needed(scatter * float(np.sqrt(df / chdtri(df, two_sided)))),
        scatter=scatter,
        uncertainty=float(stdtrit(df, two_sided)) * scatter / float(np.sqrt(x.size)),
    )
