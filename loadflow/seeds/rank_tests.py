"""Kruskal–Wallis and Meyer-Bahlburg, as printed: every value counts as independent.

On autocorrelated records both reject far too often; `loadflow.seeds.equality` with
``method="calibrated"`` is the test to trust there.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.seeds._samples import Floats, as_samples

ONE_SEED = "one seed, nothing to test"
ALL_EQUAL = "all ranks are equal, nothing differs"


@dataclass(frozen=True)
class RankTest:
    """Outcome of a rank test of several samples.

    Attributes
    ----------
    statistic : float
        H, asymptotically chi-square distributed with `df` degrees of freedom.
    pvalue : float
        Probability of an H at least as large if nothing differs.
    df : int
        Number of samples less one.
    rank_sums : ndarray, shape (m,)
        Sum of the ranks of each sample.
    note : str
        What a reader must know (ties, one sample, N not divisible by 4); empty if nothing.

    Examples
    --------
    >>> from loadflow.seeds import kruskal_wallis
    >>> test = kruskal_wallis([[1.0, 2.0, 3.0], [1.5, 2.5, 3.5]])
    >>> test.df, bool(test.pvalue > 0.05)
    (1, True)
    """

    statistic: float
    pvalue: float
    df: int
    rank_sums: Floats
    note: str = ""


@dataclass(frozen=True)
class Pool:
    """Samples pooled and sorted; both rank tests use the same one.

    Attributes
    ----------
    sizes : ndarray, shape (m,)
        Length of each sample.
    owner : ndarray, shape (N,)
        Which sample each value comes from, in ascending order of the values.
    tie_starts : ndarray or None
        Where a new value starts in that order; None if there are no ties.
    """

    sizes: NDArray[np.int64]
    owner: NDArray[np.int64]
    tie_starts: NDArray[np.int64] | None

    @classmethod
    def of(cls, samples: list[Floats]) -> Pool:
        """Pool and sort `samples`."""
        sizes = np.array([x.size for x in samples])
        values = np.concatenate(samples)
        order = np.argsort(values)
        ordered = values[order]
        new = np.concatenate(([True], ordered[1:] != ordered[:-1]))
        owner = np.repeat(np.arange(sizes.size), sizes)[order]
        return cls(sizes, owner, None if new.all() else np.flatnonzero(new))


def siegel_tukey_ranks(n: int) -> Floats:
    """Return the ranks of `n` ascending values, counted from the outside inwards.

    1 to the smallest, 2 to the largest, 3 to the second largest, 4 to the second smallest, 5 to
    the third smallest, and so on; the middle value of an odd number has rank n.

    Parameters
    ----------
    n : int
        Number of values.

    Returns
    -------
    ndarray (n,)
        The ranks.

    Examples
    --------
    >>> siegel_tukey_ranks(8).astype(int).tolist()
    [1, 4, 5, 8, 7, 6, 3, 2]
    """
    ranks = np.arange(1.0, n + 1.0)
    low = np.arange(1, n + 1) % 4 < 2
    return np.concatenate((ranks[low], ranks[~low][::-1]))


def rank_test(pool: Pool, ranks: Floats, note: str = "") -> RankTest:
    """Kruskal–Wallis' H of given ranks, with the permutation variance of the ranks used.

    H = (N − 1) Σ n_i (R̄_i − (N+1)/2)² / Σ (r_j − (N+1)/2)²: without ties it is (4.9) of
    [Jonuschies 2015], with tied values sharing their mean rank it is exact for any set of ranks.

    Parameters
    ----------
    pool : Pool
        The samples.
    ranks : ndarray, shape (N,)
        Rank of each position in ascending order; a permutation of 1 … N.
    note : str
        Goes to the result.
    """
    from scipy.special import chdtrc

    n, df = pool.owner.size, pool.sizes.size - 1
    if pool.tie_starts is not None:
        lengths = np.diff(pool.tie_starts, append=n)
        ranks = np.repeat(np.add.reduceat(ranks, pool.tie_starts) / lengths, lengths)
        note = "; ".join(filter(None, [note, f"{n - lengths.size} of {n} values repeat another"]))
    rank_sums = np.bincount(pool.owner, weights=ranks, minlength=df + 1).astype(float)
    if df == 0:
        return RankTest(0.0, 1.0, 0, rank_sums, ONE_SEED)
    middle = (n + 1) / 2
    total = float(np.sum((ranks - middle) ** 2))
    if total == 0.0:
        return RankTest(0.0, 1.0, df, rank_sums, ALL_EQUAL)
    between = float(np.sum((rank_sums - pool.sizes * middle) ** 2 / pool.sizes))
    h = (n - 1) * between / total
    return RankTest(h, float(chdtrc(df, h)), df, rank_sums, note)


def kruskal_wallis_of(pool: Pool) -> RankTest:
    """Kruskal–Wallis test of pooled samples."""
    return rank_test(pool, np.arange(1.0, pool.owner.size + 1.0))


def meyer_bahlburg_of(pool: Pool) -> RankTest:
    """Meyer-Bahlburg test of pooled samples."""
    n = pool.owner.size
    note = (
        "" if n % 4 == 0 else f"N = {n} is not divisible by 4 (4.13): the last ranks are one-sided"
    )
    return rank_test(pool, siegel_tukey_ranks(n), note)


def kruskal_wallis(samples: Iterable[ArrayLike]) -> RankTest:
    """Test whether samples have the same location (4.6–4.12 of [Jonuschies 2015]).

    Parameters
    ----------
    samples : iterable of array_like, shape (n_i,)
        One series per seed; lengths may differ. Tied values share their mean rank.

    Returns
    -------
    RankTest
        H, its p value from chi-square with m − 1 degrees of freedom, and the rank sums.

    Raises
    ------
    InputError
        A sample is empty, not one-dimensional or not finite.

    Examples
    --------
    >>> test = kruskal_wallis([[1.90, 2.25, 3.12, 4.25], [0.55, 2.91, 2.93, 3.23, 3.95],
    ...                        [1.66, 2.56, 3.31, 3.69], [0.79, 1.11, 2.09]])
    >>> test.rank_sums.tolist(), round(test.statistic, 2)
    ([39.0, 47.0, 39.0, 11.0], 3.82)
    """
    return kruskal_wallis_of(Pool.of(as_samples(samples)))


def meyer_bahlburg(
    samples: Iterable[ArrayLike], centre: Literal["none", "median"] = "none"
) -> RankTest:
    """Test whether samples have the same spread: Siegel–Tukey ranks, then Kruskal–Wallis' H.

    Meyer-Bahlburg (Metrika 15, 1970), (4.13) of [Jonuschies 2015], for any number of
    values and with ties: tied values share the mean of their Siegel–Tukey ranks, and H uses the
    variance of the ranks so averaged (the tie factor of Kruskal–Wallis would be wrong here). If N
    is not divisible by 4 the two sides differ by a rank or two at the middle; `note` says so.

    Parameters
    ----------
    samples : iterable of array_like, shape (n_i,)
        One series per seed; lengths may differ.
    centre : {"none", "median"}
        The test supposes equal location. ``"median"`` subtracts each sample's median first; the
        test is then only approximately distribution-free.

    Returns
    -------
    RankTest
        H, its p value from chi-square with m − 1 degrees of freedom, and the rank sums. A large
        rank sum means values near the centre, so a small spread.

    Raises
    ------
    InputError
        A sample is empty, not one-dimensional or not finite; `centre` unknown.

    Examples
    --------
    >>> test = meyer_bahlburg([[33, 62, 84, 85, 88, 93, 97], [4, 16, 48, 51, 66, 98]])
    >>> test.rank_sums.tolist(), round(test.statistic, 5), round(test.pvalue, 5)
    ([54.0, 37.0], 0.5102, 0.47505)
    """
    arrays = as_samples(samples)
    if centre == "median":
        arrays = [x - np.median(x) for x in arrays]
    elif centre != "none":
        raise InputError(f'centre = {centre!r}; allowed: "none", "median"')
    return meyer_bahlburg_of(Pool.of(arrays))
