"""Which seeds belong together, and why the others do not."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from loadflow.errors import InputError
from loadflow.seeds._samples import as_samples
from loadflow.seeds.spectra import BAND
from loadflow.seeds.verdict import Method, SeedEquality, evidence

if TYPE_CHECKING:
    import xarray as xr

Group = tuple[int, ...]
Compare = Callable[[Group], SeedEquality]


@dataclass(frozen=True)
class Grouping:
    """A partition of the seeds.

    Attributes
    ----------
    labels : DataArray or ndarray of int, shape (case,)
        Group of each seed, numbered in order of appearance; labelled as the input was.
    reasons : tuple of str
        Why groups are apart, one line per pair of groups; why they are together if there is one.
    representatives : ndarray of int, shape (groups,)
        Place (along case) of the member of each group that is most like its other members.
    verdict : SeedEquality
        On all the seeds together.
    """

    labels: Any
    reasons: tuple[str, ...]
    representatives: np.ndarray
    verdict: SeedEquality

    @property
    def groups(self) -> list[Group]:
        """Places of the members of each group."""
        labels = np.asarray(self.labels)
        return [tuple(np.flatnonzero(labels == g).tolist()) for g in range(labels.max() + 1)]


def group_seeds(
    x: xr.DataArray | np.ndarray | Sequence[np.ndarray],
    alpha: float = 0.05,
    method: Method = "calibrated",
    *,
    dt: float | None = None,
    band: float = BAND,
) -> Grouping:
    """Partition seeds into groups that may be merged.

    If all seeds are equal they are one group. Otherwise the most alike groups are joined, starting
    from single seeds, as long as the joined group passes the test of equality as a whole.

    Parameters
    ----------
    x : DataArray with dims (case, time), or array_like, shape (case, time)
        One variable of one wind speed.
    alpha : float
        Level of significance of `equality`.
    method : {"calibrated", "as-printed"}
        See `equality`. As printed, records as long as real ones are never grouped.
    dt : float, optional
        Time step in s; by default that of the coordinate ``time``.
    band : float
        Allowed relative difference of the printed spectral criterion.

    Returns
    -------
    Grouping

    Raises
    ------
    InputError
        Dimensions are not case and time; no time step; see `equality`.

    Examples
    --------
    >>> x = np.random.default_rng(1).standard_normal((4, 3000))
    >>> x[2] += 1.0
    >>> group_seeds(x, dt=0.05).groups
    [(0, 1, 3), (2,)]
    """
    series, labelled, step = _unpack(x, dt)
    samples = as_samples(series, least=2)
    compare: Compare = cache(evidence(samples, step, alpha, method, band).compare)
    groups = partition(len(samples), compare)
    labels = np.empty(len(samples), dtype=int)
    for g, group in enumerate(groups):
        labels[list(group)] = g
    return Grouping(
        labels=labels if labelled is None else labelled(labels),
        reasons=_reasons(groups, compare),
        representatives=np.array([_representative(group, compare) for group in groups]),
        verdict=compare(tuple(range(len(samples)))),
    )


def partition(m: int, compare: Compare) -> list[Group]:
    """Partition seeds 0 … m − 1; groups in order of their first member."""
    everything = tuple(range(m))
    if compare(everything).equal:
        return [everything]
    groups: list[Group] = [(i,) for i in everything]
    while True:
        unions = [(a, b, compare(_union(a, b))) for a, b in combinations(groups, 2)]
        alike = [(verdict.pvalue, a, b) for a, b, verdict in unions if verdict.equal]
        if not alike:
            return sorted(groups)
        _, a, b = max(alike, key=lambda entry: entry[0])
        groups = [g for g in groups if g not in (a, b)] + [_union(a, b)]


def _union(a: Group, b: Group) -> Group:
    return tuple(sorted(a + b))


def _reasons(groups: list[Group], compare: Compare) -> tuple[str, ...]:
    """One line per pair of groups, or one for the only group."""
    if len(groups) == 1:
        return (compare(groups[0]).text,)
    return tuple(
        f"groups {a} and {b}: {compare(_union(groups[a], groups[b])).text}"
        for a, b in combinations(range(len(groups)), 2)
    )


def _representative(group: Group, compare: Compare) -> int:
    """Member whose least likeness to another member is greatest."""

    def likeness(i: int) -> float:
        return min((compare(_union((i,), (j,))).pvalue for j in group if j != i), default=1.0)

    return max(group, key=likeness)


def _unpack(x: Any, dt: float | None) -> tuple[Any, Callable[[np.ndarray], Any] | None, float]:
    """Rows, a function that labels an array along case, and the time step."""
    if not hasattr(x, "dims"):
        if dt is None:
            raise InputError("dt is needed for series without a time coordinate")
        return x, None, dt
    if set(x.dims) != {"case", "time"}:
        raise InputError(f"x has dims {tuple(x.dims)}; (case, time) is needed, one variable")
    if dt is None:
        if "time" not in x.coords or x.sizes["time"] < 2:
            raise InputError("dt is needed: x has no time coordinate")
        dt = float(x["time"][1] - x["time"][0])
    x = x.transpose("case", "time")
    template = x.isel(time=0, drop=True)

    def labelled(labels: np.ndarray) -> Any:
        result = template.copy(data=labels).rename("group")
        result.attrs = {"units": "1", "long_name": "group of seeds that may be merged"}
        return result

    return x.to_numpy(), labelled, dt
