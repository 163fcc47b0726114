"""Many load cases together: each counts by its share of the lifetime."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.reduction._series import Floats, finite
from loadflow.reduction.fatigue import LoadDuration


def lifetime_equivalent_load(loads: ArrayLike, weights: ArrayLike, m: float) -> Floats:
    """Damage-equivalent load of a lifetime, (Σ w_i S_i^m)^(1/m).

    Parameters
    ----------
    loads : array_like, shape (k, ...)
        Damage-equivalent loads of the cases, for one exponent and one frequency.
    weights : array_like, shape (k,)
        Share of the lifetime of each case, e.g. from the Rayleigh or Weibull distribution of wind
        speeds (2.2); what is missing to 1 does no damage.
    m : float
        Wöhler exponent.

    Returns
    -------
    ndarray, shape (...)

    Raises
    ------
    InputError
        Lengths differ, a share or load is negative, or `m` is not positive.

    Examples
    --------
    >>> float(lifetime_equivalent_load([1.0, 2.0], [0.9, 0.1], m=1.0))
    1.1
    """
    s, w = finite("loads", loads), _shares(weights)
    if s.ndim == 0 or s.shape[0] != w.size:
        raise InputError(f"loads has shape {s.shape}; ({w.size}, ...) is needed, as weights")
    if s.min() < 0:
        raise InputError(f"loads: {s.min():g} is negative")
    if not m > 0:
        raise InputError(f"m = {m}; allowed: m > 0")
    largest = max(float(s.max()), np.finfo(float).tiny)
    return largest * np.tensordot(w, (s / largest) ** m, 1) ** (1.0 / m)


def lifetime_duration(
    parts: Sequence[LoadDuration], weights: ArrayLike, duration: float
) -> LoadDuration:
    """Add up the time and revolutions of load cases over a lifetime.

    Parameters
    ----------
    parts : sequence of LoadDuration
        One for each case, all with the same class edges.
    weights : array_like, shape (k,)
        Share of the lifetime of each case.
    duration : float
        Lifetime in s.

    Returns
    -------
    LoadDuration

    Raises
    ------
    InputError
        Class edges or lengths differ, a share is negative, or `duration` is not positive.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import lifetime_duration, load_duration
    >>> time, classes = np.arange(0.0, 10.0, 0.1), (np.array([0.0, 2.0]), np.array([0.0, 3.0]))
    >>> parts = [
    ...     load_duration(np.full(100, 1.0), np.full((100, 2), size), time, classes=classes)
    ...     for size in (1.0, 2.0)
    ... ]
    >>> year = lifetime_duration(parts, [0.75, 0.25], duration=3.156e7)
    >>> round(float(year.seconds.sum()))
    31560000
    """
    w = _shares(weights)
    if w.size != len(parts):
        raise InputError(f"weights has shape {w.shape}; ({len(parts)},) is needed, as parts")
    if not duration > 0:
        raise InputError(f"duration = {duration}; allowed: duration > 0")
    edges = parts[0].edges
    for i, part in enumerate(parts):
        if not all(np.array_equal(a, b) for a, b in zip(part.edges, edges)):
            raise InputError(f"parts: the class edges of part {i} are not those of part 0")
    factors = [duration * share / part.seconds.sum() for share, part in zip(w.tolist(), parts)]

    def total(values: Sequence[Floats]) -> Floats:
        return np.sum([f * x for f, x in zip(factors, values)], axis=0)

    revolutions = total([part.revolutions for part in parts])
    moment = total([part.revolutions * part.force for part in parts])
    return LoadDuration(
        edges,
        total([part.seconds for part in parts]),
        revolutions,
        moment / np.where(revolutions > 0, revolutions, 1.0),
    )


def _shares(weights: ArrayLike) -> Floats:
    w = finite("weights", weights)
    if w.ndim != 1 or w.size == 0 or w.min() < 0:
        raise InputError(f"weights = {w.tolist()}; at least one, all >= 0")
    return w
