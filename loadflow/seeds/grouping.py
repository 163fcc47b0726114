"""Which seeds belong together, and why the others do not."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from loadflow.cube import time_step
from loadflow.errors import InputError
from loadflow.seeds._samples import as_samples
from loadflow.seeds.joint import JointEquality
from loadflow.seeds.spectra import BAND
from loadflow.seeds.sufficiency import Equivalence, equivalence
from loadflow.seeds.verdict import Method, evidence

if TYPE_CHECKING:
    import xarray as xr

Group = tuple[int, ...]


class Likeness(Protocol):
    """What grouping needs of a verdict on a subset of the seeds."""

    @property
    def equal(self) -> bool:
        """Whether they may be merged."""

    @property
    def pvalue(self) -> float:
        """How alike they are."""

    @property
    def text(self) -> str:
        """The verdict in words."""


Compare = Callable[[Group], Likeness]


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
    verdict : SeedEquality or JointEquality
        On all the seeds together.
    equivalence : tuple of Equivalence
        For each group whether its members are shown to differ by less than a margin; empty if none
        was given.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import group_seeds
    >>> x = np.random.default_rng(1).standard_normal((4, 3000))
    >>> x[2] += 1.0
    >>> found = group_seeds(x, dt=0.05)
    >>> found.labels.tolist(), len(found.representatives)
    ([0, 0, 1, 0], 2)
    """

    labels: Any
    reasons: tuple[str, ...]
    representatives: np.ndarray
    verdict: Any
    equivalence: tuple[Equivalence, ...] = ()

    @property
    def groups(self) -> list[Group]:
        """Places of the members of each group."""
        labels = np.asarray(self.labels)
        return [tuple(np.flatnonzero(labels == g).tolist()) for g in range(labels.max() + 1)]

    def in_words(self, names: Sequence[str]) -> str:
        """Groups by the `names` of their seeds, who stands for each of several, and reasons."""
        told = [
            "{" + ", ".join(names[i] for i in members) + "}"
            + (f" ({names[chief]} stands for them)" if len(members) > 1 else "")
            for members, chief in zip(self.groups, self.representatives)
        ]  # fmt: skip
        return f"{' '.join(told)}. {'. '.join(self.reasons)}"


def group_seeds(
    x: xr.DataArray | np.ndarray | Sequence[np.ndarray],
    alpha: float = 0.05,
    method: Method = "calibrated",
    *,
    dt: float | None = None,
    band: float = BAND,
    margin: float | None = None,
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
    margin : float, optional
        Also say of each group whether its members are equivalent to within this relative
        difference (`equivalence`), which is what merging them needs.

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
    grouping = _group(len(samples), compare)
    if labelled is not None:
        grouping = replace(grouping, labels=labelled(grouping.labels))
    if margin is not None:
        shown = [equivalence([samples[i] for i in g], margin, alpha) for g in grouping.groups]
        grouping = replace(grouping, equivalence=tuple(shown))
    return grouping


def group_seeds_jointly(
    series: Mapping[str, Sequence[np.ndarray] | np.ndarray],
    dt: float,
    alpha: float = 0.05,
    method: Method = "calibrated",
    *,
    band: float = BAND,
) -> Grouping:
    """Partition the seeds of a wind speed by all their components together.

    Seeds are joined only if speed and every load component say equal; the calibrated tests are
    corrected for the number of components (Holm).

    Parameters
    ----------
    series : mapping of str to array_like, shape (case, time)
        The seeds of each component, in the same order.
    dt : float
        Time step in s.
    alpha, method, band
        See `group_seeds`.

    Returns
    -------
    Grouping
        Its reasons name the components that differ.

    Raises
    ------
    InputError
        No component, different numbers of seeds; see `group_seeds`.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import group_seeds_jointly
    >>> rng = np.random.default_rng(1)
    >>> speed, force = rng.standard_normal((2, 4, 3000))
    >>> force[2] += 1.0  # one seed differs in one component: it stands alone in all
    >>> group_seeds_jointly({"speed": speed, "force": force}, dt=0.05).groups
    [(0, 1, 3), (2,)]
    """
    proofs = {
        name: evidence(as_samples(x, least=2), dt, alpha, method, band)
        for name, x in series.items()
    }
    counts = {name: len(x) for name, x in series.items()}
    if len(set(counts.values())) != 1:
        raise InputError(f"series: number of seeds {counts}; the same for every component, >= 1")

    @cache
    def compare(group: Group) -> JointEquality:
        found = {name: proof.compare(group) for name, proof in proofs.items()}
        return JointEquality(found, alpha, method)

    return _group(next(iter(counts.values())), compare)


def _group(m: int, compare: Compare) -> Grouping:
    """Partition seeds 0 … m − 1 with reasons and representatives."""
    groups = partition(m, compare)
    labels = np.empty(m, dtype=int)
    for g, group in enumerate(groups):
        labels[list(group)] = g
    return Grouping(
        labels=labels,
        reasons=_reasons(groups, compare),
        representatives=np.array([_representative(group, compare) for group in groups]),
        verdict=compare(tuple(range(m))),
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
        f"groups {a + 1} and {b + 1}: {compare(_union(groups[a], groups[b])).text}"
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
        dt = time_step(x)
    x = x.transpose("case", "time")
    template = x.isel(time=0, drop=True)

    def labelled(labels: np.ndarray) -> Any:
        result = template.copy(data=labels).rename("group")
        result.attrs = {"units": "1", "long_name": "group of seeds that may be merged"}
        return result

    return x.to_numpy(), labelled, dt
