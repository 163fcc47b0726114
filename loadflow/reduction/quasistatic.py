"""Quasi-static reduction: a tenth of the series with the same load character.

Section 4.3.3 of [Jonuschies 2015], (4.28–4.36): pairs of speed and resultant force are
counted in a bivariate histogram, and from each class a share of its members is kept.
"""

from __future__ import annotations

import bisect
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.reduction._series import Floats, check_series, finite

Ints = NDArray[np.int64]
Pick = Literal["random", "extremes", "envelope"]
Rounding = Literal["up", "nearest", "total"]
Edges = tuple[Floats, Floats]
Grid = int | tuple[int, int] | Sequence[ArrayLike]


@dataclass(frozen=True)
class Reduced:
    """A reduced load series.

    Attributes
    ----------
    index : ndarray of int, shape (k,)
        Places in the full series, ascending.
    time : ndarray, shape (k,)
        s; the index as a number if the series came without time.
    speed : ndarray, shape (k,)
        rad/s.
    force : ndarray, shape (k, 2)
        N.
    weight : ndarray, shape (k,)
        How many pairs of the full series each one stands for; sums to their number.
    edges : tuple of two ndarrays
        Class edges of speed (rad/s) and resultant force (N).
    counts_full, counts_reduced : ndarray of int, shape (l_n, l_F)
        Bivariate histograms before and after.
    pick, seed, source : str, int, str
        How and from what the pairs were picked.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import histogram
    >>> load = np.stack([2e6 + 1e5 * np.sin(np.arange(300.0)), np.zeros(300)], axis=-1)
    >>> reduced = histogram(np.linspace(1.1, 1.3, 300), load)
    >>> reduced.total, bool(reduced.index.size < 300)
    (300, True)
    """

    index: Ints
    time: Floats
    speed: Floats
    force: Floats
    weight: Floats
    edges: Edges
    counts_full: Ints = field(repr=False)
    counts_reduced: Ints = field(repr=False)
    pick: str = "random"
    seed: int = 0
    source: str = ""

    @property
    def total(self) -> int:
        """Number of pairs of the full series."""
        return int(self.counts_full.sum())

    def mean(self, values: ArrayLike) -> Floats:
        """Mean over the full series, estimated from `values` (k, ...) at the kept pairs."""
        return np.asarray(np.average(np.asarray(values), axis=0, weights=self.weight))


def number_of_classes(n: int) -> int:
    """Classes per axis for `n` values: √n up to 1000, 10 log10 n above (4.30), rounded.

    Parameters
    ----------
    n : int
        Number of values.

    Returns
    -------
    int
        At least 1.

    Raises
    ------
    InputError
        There are no values.

    Examples
    --------
    >>> number_of_classes(400), number_of_classes(24000)
    (20, 44)
    """
    if n < 1:
        raise InputError(f"n = {n}; allowed: n >= 1")
    return max(1, round(math.sqrt(n) if n <= 1000 else 10.0 * math.log10(n)))


def class_edges(x: Floats, grid: int | ArrayLike) -> Floats:
    """Edges of half-open classes [a, b) that hold all of `x`.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Values to be classed.
    grid : int or array_like
        Number of equal classes, or ascending edges. The last of the edges made here lies one
        rounding step above the largest value, so that the half-open last class holds it.

    Returns
    -------
    ndarray
        Edges, one more than classes.

    Raises
    ------
    InputError
        Edges that do not ascend, values outside of them, or no class.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import class_edges
    >>> edges = class_edges(np.array([1.0, 2.0, 4.0]), 3)
    >>> edges.size, bool(edges[-1] > 4.0)
    (4, True)
    """
    if not isinstance(grid, int | np.integer):
        edges = finite("classes", grid)
        if edges.ndim != 1 or edges.size < 2 or np.any(np.diff(edges) <= 0):
            raise InputError(f"classes: edges must ascend, at least two; got {edges.tolist()}")
        outside = np.flatnonzero((x < edges[0]) | (x >= edges[-1]))
        if outside.size:
            raise InputError(
                f"classes: {outside.size} values lie outside [{edges[0]:g}, {edges[-1]:g}), "
                f"the first is {x[outside[0]]:g} at index {int(outside[0])}"
            )
        return edges
    if grid < 1:
        raise InputError(f"classes = {grid}; allowed: at least 1 per axis")
    low, high = float(x.min()), float(x.max())
    step = (high - low) / grid
    if low + step == low:  # nothing to class
        return np.array([low, math.nextafter(high, math.inf)])
    edges = low + step * np.arange(grid + 1.0)
    edges[-1] = math.nextafter(high, math.inf)
    return edges


def histogram(
    speed: ArrayLike,
    force: ArrayLike,
    time: ArrayLike | None = None,
    *,
    size: int | float = 0.1,
    classes: Grid | None = None,
    pick: Pick = "random",
    rounding: Rounding = "up",
    seed: int = 0,
    source: str = "",
) -> Reduced:
    """Reduce a series to fewer pairs of speed and force with the same bivariate histogram.

    Each class x of the histogram over speed and resultant force keeps q_x = ⌈H_x q⌉ of its members
    (4.32–4.36), H_x its relative frequency (4.31) and q the wanted size. Rounding up
    keeps rare classes, so that somewhat more than q pairs remain.

    Parameters
    ----------
    speed : array_like, shape (n,)
        rad/s.
    force : array_like, shape (n, 2)
        N; the classes take its magnitude, both components are carried along.
    time : array_like, shape (n,), optional
        s, rising.
    size : int or float
        Wanted size q: a number of pairs (int) or a share of the series (float, 0 < size <= 1).
    classes : int, (int, int) or (edges, edges), optional
        Classes of speed and of force; by default (4.30), the same number for both.
    pick : {"random", "extremes", "envelope"}
        ``"random"`` is the pick of [Jonuschies 2015]; it loses the extremes of a class.
        ``"extremes"`` keeps the pair with the largest force over speed of each class and spreads
        the others evenly over the rest of the class in the order of force over speed.
        ``"envelope"`` does so, too, but a class that keeps one pair only keeps the severest if no
        other class has as much force at as little speed, else any: the extremes of the series
        stay, and means are not biased towards severe pairs. Both keep the largest force of the
        series, too, unless its class keeps one pair only and that is its severest: then the
        largest that is kept lies in the same class.
    rounding : {"up", "nearest", "total"}
        Of q_x; ``"nearest"`` keeps at least one, too. ``"total"`` rounds up, but from a smaller q,
        so that no more than the wanted size remain in all (or one of each class, if these are
        more).
    seed : int
        Of the random generator; the same seed gives the same pick.
    source : str
        What the series is; goes to the parameter file.

    Returns
    -------
    Reduced

    Raises
    ------
    InputError
        Shapes do not match, a value is not finite, time does not rise, `size` or `classes` out of
        range.

    Examples
    --------
    >>> rng = np.random.default_rng(1)
    >>> omega = 1.2 + 0.05 * rng.standard_normal(2000)
    >>> load = np.array([2e6, 0.0]) + 1e5 * rng.standard_normal((2000, 2))
    >>> reduced = histogram(omega, load, classes=10, seed=1)
    >>> reduced.weight.sum() == 2000
    np.True_
    """
    n, f, t = check_series(speed, force, time)
    q = _wanted(size, n.size)
    resultant = np.hypot(f[:, 0], f[:, 1])
    edges = bivariate_edges(n, resultant, classes)
    cell, shape = _cells(n, resultant, edges)
    counts = np.bincount(cell, minlength=shape[0] * shape[1])
    kept = _shares(counts, q, rounding)
    rng = np.random.default_rng(seed)
    if pick == "random":
        index, weight = _pick_random(cell, counts, kept, rng)
    elif pick in ("extremes", "envelope"):
        severest = (kept > 1) | (pick == "extremes") | _envelope(counts.reshape(shape))
        strongest = int(resultant.argmax())
        index, weight = _pick_extremes(
            cell, counts, kept, severest, _severity(resultant, n), strongest, rng
        )
    else:
        raise InputError(f'pick = {pick!r}; allowed: "random", "extremes", "envelope"')
    order = np.argsort(index)
    index, weight = index[order], weight[order]
    return Reduced(
        index=index,
        time=index.astype(float) if t is None else t[index],
        speed=n[index],
        force=f[index],
        weight=weight,
        edges=edges,
        counts_full=counts.reshape(shape),
        counts_reduced=np.bincount(cell[index], minlength=counts.size).reshape(shape),
        pick=pick,
        seed=seed,
        source=source,
    )


def _wanted(size: int | float, n: int) -> int:
    """Return the wanted number of pairs q."""
    if isinstance(size, int | np.integer) and not isinstance(size, bool):
        if not 1 <= size <= n:
            raise InputError(f"size = {size}; allowed: 1 <= size <= {n}, the length of the series")
        return int(size)
    if not 0.0 < size <= 1.0:
        raise InputError(f"size = {size}; as a share allowed: 0 < size <= 1")
    return math.ceil(round(size * n, 6))


def bivariate_edges(speed: Floats, resultant: Floats, classes: Grid | None) -> Edges:
    """Class edges of speed and force."""
    if classes is None:
        classes = number_of_classes(speed.size)
    if isinstance(classes, int | np.integer):
        classes = (int(classes), int(classes))
    if len(classes) != 2:
        raise InputError(f"classes: {len(classes)} entries; two are needed, speed and force")
    return class_edges(speed, classes[0]), class_edges(resultant, classes[1])


def _cells(speed: Floats, resultant: Floats, edges: Edges) -> tuple[Ints, tuple[int, int]]:
    """Class of each pair, as one flat number, and the shape of the histogram."""
    shape = edges[0].size - 1, edges[1].size - 1
    row = np.searchsorted(edges[0], speed, side="right") - 1
    column = np.searchsorted(edges[1], resultant, side="right") - 1
    return row * shape[1] + column, shape


def bin_sums(
    speed: Floats, resultant: Floats, edges: Edges, weight: Floats | None = None
) -> NDArray[Any]:
    """Bivariate histogram of pairs that lie within the edges, optionally weighted."""
    return next(weighted_sums(speed, resultant, edges, (weight,)))


def weighted_sums(
    speed: Floats, resultant: Floats, edges: Edges, weights: Iterable[Floats | None]
) -> Iterator[NDArray[Any]]:
    """Yield the bivariate histogram of `bin_sums` for each of some weights."""
    cell, shape = _cells(speed, resultant, edges)
    for weight in weights:
        yield np.bincount(cell, weight, minlength=shape[0] * shape[1]).reshape(shape)


def _shares(counts: Ints, q: int, rounding: Rounding) -> Ints:
    """q_x of every class; whole numbers throughout, so that no rounding error adds a pair."""
    n = int(counts.sum())

    def up(size: int) -> Ints:
        return -(-counts * size // n)

    if rounding == "up":
        return up(q)
    if rounding == "nearest":
        return np.maximum((2 * counts * q + n) // (2 * n), counts > 0)
    if rounding == "total":
        fits = bisect.bisect_right(range(1, q + 1), q, key=lambda size: int(up(size).sum()))
        return up(max(fits, 1))
    raise InputError(f'rounding = {rounding!r}; allowed: "up", "nearest", "total"')


def _severity(resultant: Floats, speed: Floats) -> Floats:
    """Force over speed, to which the Sommerfeld number is proportional; infinite at standstill."""
    still = speed == 0.0
    return np.where(still, np.inf, resultant / np.where(still, 1.0, np.abs(speed)))


def _places(cell: Ints, counts: Ints) -> Ints:
    """Place of each entry within its class, for `cell` in ascending order."""
    starts = np.cumsum(counts) - counts
    return np.arange(cell.size) - starts[cell]


def _pick_random(
    cell: Ints, counts: Ints, kept: Ints, rng: np.random.Generator
) -> tuple[Ints, Floats]:
    """Pick q_x members of each class at random; each stands for its share of the class."""
    order = np.lexsort((rng.random(cell.size), cell))
    ordered = cell[order]
    taken = _places(ordered, counts) < kept[ordered]
    home = ordered[taken]
    return order[taken], counts[home] / kept[home]


def _envelope(counts: Ints) -> NDArray[np.bool_]:
    """Classes that no other class with a pair in it surpasses in force at no more speed; flat."""
    there = (counts > 0).astype(int)
    as_severe = np.cumsum(np.cumsum(there, axis=0)[:, ::-1], axis=1)[:, ::-1]
    return (as_severe == 1).ravel()


def _pick_extremes(
    cell: Ints,
    counts: Ints,
    kept: Ints,
    severest: NDArray[np.bool_],
    severity: Floats,
    strongest: int,
    rng: np.random.Generator,
) -> tuple[Ints, Floats]:
    """Pick the severest of each class that wants it, and one of each equal layer of the others.

    The layer of the pair `strongest` gives that one.
    """
    order = np.lexsort((-severity, cell))
    ordered = cell[order]
    place, size, q = _places(ordered, counts), counts[ordered], kept[ordered]
    layer = np.where(place == 0, 0, 1 + (place - 1) * (q - 1) // np.maximum(size - 1, 1))
    layer[q == 1] = 0
    group = np.cumsum(np.concatenate(([0], (np.diff(ordered) != 0) | (np.diff(layer) != 0))))
    lengths = np.bincount(group)
    first = np.cumsum(lengths) - lengths
    lucky = first + (rng.random(lengths.size) * lengths).astype(int)
    top = (layer[first] == 0) & severest[ordered[first]]
    there = int(np.flatnonzero(order == strongest)[0])
    lucky[group[there]] = there
    lucky[top] = first[top]
    return order[lucky], lengths.astype(float)
