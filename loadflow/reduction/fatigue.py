"""Rainflow cycles, damage-equivalent loads, and how long which load lasts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.reduction._series import Floats, check_series, finite
from loadflow.reduction.quasistatic import Edges, Grid, bivariate_edges, weighted_sums


@dataclass(frozen=True)
class Rainflow:
    """Cycles of a series.

    Attributes
    ----------
    range, mean : ndarray, shape (k,)
        Double amplitude and mean of each cycle, in the unit of the series.
    count : ndarray, shape (k,)
        1 for a closed cycle, 0.5 for a half cycle of the residue.

    Examples
    --------
    >>> from loadflow.reduction import rainflow
    >>> cycles = rainflow([0.0, 2.0, 1.0, 3.0, 0.0])
    >>> float(cycles.count.sum())
    2.0
    """

    range: Floats
    mean: Floats
    count: Floats

    def matrix(self, range_edges: ArrayLike, mean_edges: ArrayLike) -> Floats:
        """Return the counts per class of range and mean (rainflow matrix), shape (l_r, l_m)."""
        bins = [np.asarray(range_edges, dtype=float), np.asarray(mean_edges, dtype=float)]
        return np.histogram2d(self.range, self.mean, bins=bins, weights=self.count)[0]


def rainflow(x: ArrayLike) -> Rainflow:
    """Count the rainflow cycles of a series, as ASTM E1049.

    pylife closes the cycles (four-point method); the half cycles of what it leaves are added here,
    which makes the count that of ASTM E1049-85, section 5.4.4.

    Parameters
    ----------
    x : array_like, shape (n,)
        Series.

    Returns
    -------
    Rainflow

    Raises
    ------
    InputError
        The series is empty, not one-dimensional or not finite (pylife would drop such values).

    Examples
    --------
    >>> cycles = rainflow([-2, 1, -3, 5, -1, 3, -4, 4, -2])
    >>> sorted(zip(cycles.range.tolist(), cycles.count.tolist()))
    [(3.0, 0.5), (4.0, 0.5), (4.0, 1.0), (6.0, 0.5), (8.0, 0.5), (8.0, 0.5), (9.0, 0.5)]
    """
    from pylife.stress.rainflow import FourPointDetector, LoopValueRecorder

    series = finite("x", x)
    if series.ndim != 1 or series.size == 0:
        raise InputError(f"x has shape {series.shape}; (n,) with n >= 1 is needed")
    if series.size < 2:
        return Rainflow(np.empty(0), np.empty(0), np.empty(0))
    recorder = LoopValueRecorder()
    detector = FourPointDetector(recorder=recorder)
    detector.process(series)
    residue = np.asarray(detector.residuals, dtype=float)
    start = np.concatenate([np.asarray(recorder.values_from, dtype=float), residue[:-1]])
    end = np.concatenate([np.asarray(recorder.values_to, dtype=float), residue[1:]])
    count = np.repeat([1.0, 0.5], [start.size - residue.size + 1, residue.size - 1])
    span = np.abs(end - start)
    real = span > 0.0
    return Rainflow(span[real], 0.5 * (start + end)[real], count[real])


def damage_equivalent_load(
    x: ArrayLike | Rainflow, m: float | Sequence[float], duration: float, f_eq: float = 1.0
) -> float | Floats:
    """Range of the sine that damages as much as the series: (Σ n_i S_i^m / (f_eq T))^(1/m).

    Parameters
    ----------
    x : array_like, shape (n,), or Rainflow
        Series or its cycles.
    m : float or sequence of float
        Wöhler exponents.
    duration : float
        T, length of the series in s.
    f_eq : float
        Frequency of the sine in Hz.

    Returns
    -------
    float or ndarray
        One value per exponent, in the unit of the series.

    Raises
    ------
    InputError
        An exponent, duration or frequency is not positive; see `rainflow`.

    Examples
    --------
    >>> t = np.arange(0, 100.01, 0.01)
    >>> round(damage_equivalent_load(np.cos(2 * np.pi * t), m=4, duration=100), 3)
    2.0
    """
    cycles = x if isinstance(x, Rainflow) else rainflow(x)
    exponents = finite("m", m)
    for name, value in (("m", exponents.min()), ("duration", duration), ("f_eq", f_eq)):
        if not value > 0:
            raise InputError(f"{name} = {value}; allowed: {name} > 0")
    if cycles.range.size == 0:
        loads = np.zeros_like(exponents)
    else:
        # relative to the largest range, so that high exponents do not overflow
        largest = cycles.range.max()
        powers = (cycles.range / largest) ** exponents[..., None]
        loads = largest * (powers @ cycles.count / (f_eq * duration)) ** (1.0 / exponents)
    return float(loads) if exponents.ndim == 0 else loads


@dataclass(frozen=True)
class LoadDuration:
    """How long and for how many revolutions the load lay in each class.

    Attributes
    ----------
    edges : tuple of two ndarrays
        Class edges of speed (rad/s) and resultant force (N).
    seconds, revolutions : ndarray, shape (l_n, l_F)
        Time and turns in each class.
    force : ndarray, shape (l_n, l_F)
        Mean resultant force of each class by revolutions, N; 0 where there are none.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import load_duration
    >>> time = np.arange(0.0, 60.0, 0.1)
    >>> force = np.stack([2e6 + 2e5 * np.sin(0.8 * time), 0.0 * time], axis=-1)
    >>> duration = load_duration(np.full(600, 1.2), force, time)
    >>> bool(1.8e6 < duration.equivalent_force() < 2.2e6)
    True
    """

    edges: Edges
    seconds: Floats
    revolutions: Floats
    force: Floats

    def equivalent_force(self, exponent: float = 10.0 / 3.0) -> float:
        """Force that tires a rolling bearing alike: (Σ N_i F_i^p / Σ N_i)^(1/p), in N.

        Parameters
        ----------
        exponent : float
            p: 3 for ball bearings, 10/3 for roller bearings.
        """
        turns = self.revolutions.sum()
        if turns == 0.0:
            raise InputError("the shaft does not turn; there is no equivalent force")
        return float((np.sum(self.revolutions * self.force**exponent) / turns) ** (1 / exponent))


def load_duration(
    speed: ArrayLike,
    force: ArrayLike,
    time: ArrayLike,
    *,
    classes: Grid | None = None,
) -> LoadDuration:
    """Sort a series by time and revolutions into classes of speed and resultant force.

    Each value stands for the time half-way to its neighbours.

    Parameters
    ----------
    speed : array_like, shape (n,)
        rad/s; backward turns count as turns.
    force : array_like, shape (n, 2)
        N.
    time : array_like, shape (n,)
        s, rising; steps need not be equal.
    classes
        See `histogram`.

    Returns
    -------
    LoadDuration

    Raises
    ------
    InputError
        See `histogram`; fewer than two values.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import load_duration
    >>> time = np.arange(0.0, 60.0, 0.1)
    >>> speed = 1.2 + 0.05 * np.sin(time)
    >>> force = np.stack([2e6 + 2e5 * np.sin(0.8 * time), 1e5 * np.cos(time)], axis=-1)
    >>> duration = load_duration(speed, force, time)
    >>> round(float(duration.seconds.sum()), 1)
    59.9
    """
    n, f, t = check_series(speed, force, time)
    if t is None or t.size < 2:
        raise InputError("time: at least two values are needed")
    steps = np.diff(t)
    seconds = 0.5 * (np.append(steps, 0.0) + np.append(0.0, steps))
    turns = seconds * np.abs(n) / (2.0 * np.pi)
    resultant = np.hypot(f[:, 0], f[:, 1])
    edges = bivariate_edges(n, resultant, classes)
    weights = (seconds, turns, turns * resultant)
    time_in, turns_in, moment = weighted_sums(n, resultant, edges, weights)
    mean = moment / np.where(turns_in > 0.0, turns_in, 1.0)
    return LoadDuration(edges, time_in, turns_in, mean)
