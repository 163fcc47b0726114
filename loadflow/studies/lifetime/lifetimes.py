"""Load cube → what each bearing goes through in a lifetime: fatigue, revolutions, extremes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from loadflow.errors import InputError
from loadflow.reduction import (
    LoadDuration,
    LongTermExtreme,
    MarkovMatrix,
    Tail,
    damage_equivalent_load,
    lifetime_duration,
    lifetime_equivalent_load,
    load_duration,
    long_term_extreme,
    markov_matrix,
    rainflow,
    tail_of_maxima,
    tail_of_peaks,
)
from loadflow.reduction.quasistatic import class_edges
from loadflow.scene.lifetime_shares import YEAR, lifetime_shares, without_share
from loadflow.studies.bearing_series import BearingSeries

COMPONENTS = ("Fz", "Fy", "Fx")
"""Forces of the shaft's frame of which ranges are counted, which have no sign."""

TailKind = Literal["maxima", "peaks"]


@dataclass(frozen=True)
class LifetimeOptions:
    """What a lifetime is.

    Attributes
    ----------
    years : float
        Its length.
    return_period : float
        Years in which the extreme is exceeded once.
    exponents : tuple of float
        Wöhler exponents.
    weights : {"rayleigh", "given"}
        Shares from the distribution of wind speeds (2.2, 2.3), see
        `loadflow.scene.lifetime_shares.lifetime_shares`, or those that the cube states.
    wind_class : str
        I, II or III.
    weibull_shape : float
        2 is the Rayleigh distribution.
    operating : tuple of float
        Cut-in and cut-out, m/s; production and idling part there.
    per_year : mapping of str to float
        How often a year a design load case happens, such as ``{"3.1": 1000}``.
    classes : int
        Of speed, of force, and of the Markov matrix.
    tail : {"peaks", "maxima"}
        Peaks over a threshold, or block maxima.
    block : float
        Length of a block, or distance between peaks, s.
    """

    years: float = 20.0
    return_period: float = 50.0
    exponents: tuple[float, ...] = (4.0, 10.0)
    weights: Literal["rayleigh", "given"] = "rayleigh"
    wind_class: str = "I"
    weibull_shape: float = 2.0
    operating: tuple[float, float] = (3.0, 25.0)
    per_year: Mapping[str, float] = field(default_factory=dict)
    classes: int = 44
    tail: TailKind = "maxima"
    block: float = 60.0

    def __post_init__(self) -> None:
        for name in ("years", "return_period", "block"):
            if not getattr(self, name) > 0:
                raise InputError(f"{name} = {getattr(self, name)}; allowed: {name} > 0")
        if self.classes < 1:
            raise InputError(f"classes = {self.classes}; allowed: at least 1")
        if self.weights == "given" and self.per_year:
            raise InputError('per_year: weights = "given" takes the shares of the cube')


@dataclass(frozen=True)
class BearingLifetime:
    """One bearing over a lifetime.

    Attributes
    ----------
    bearing : str
        Which.
    cases : tuple of str
        Load cases.
    shares : ndarray, shape (k,)
        Share of the lifetime of each case.
    left_out : tuple of str
        Design load cases without a share: they add nothing but to the load classes' range.
    equivalent : ndarray, shape (exponent, component, k)
        Damage-equivalent load of each case, N, a range at 1 Hz; components as in `COMPONENTS`.
    lifetime_equivalent : ndarray, shape (exponent, component)
        That of the lifetime, N.
    duration : LoadDuration
        Time and revolutions of the lifetime by speed and radial force.
    markov : MarkovMatrix
        Transitions of −Fz, the force downwards, between classes, of the lifetime.
    tails : dict of Tail by load case and wind speed (m/s)
        Of the radial force, where there are enough data.
    tail_shares : ndarray, shape (tails,)
        Share of the lifetime of each tail.
    extreme : LongTermExtreme or None
        Radial force of the return period, N.
    """

    bearing: str
    cases: tuple[str, ...]
    shares: np.ndarray
    left_out: tuple[str, ...]
    equivalent: np.ndarray
    lifetime_equivalent: np.ndarray
    duration: LoadDuration
    markov: MarkovMatrix
    tails: dict[tuple[str, float], Tail]
    tail_shares: np.ndarray
    extreme: LongTermExtreme | None

    @property
    def tail_names(self) -> list[str]:
        """Wind speed of each tail, behind its load case where there are tails of several."""
        several = len({dlc for dlc, _ in self.tails}) > 1
        return [f"{dlc}, {speed:g}" if several else f"{speed:g}" for dlc, speed in self.tails]


def lifetimes(
    series: Iterable[BearingSeries], options: LifetimeOptions | None = None
) -> Iterator[BearingLifetime]:
    """Yield the lifetime of each bearing.

    Parameters
    ----------
    series : iterable of BearingSeries
        All bearings in all load cases.
    options : LifetimeOptions
        What a lifetime is.

    Raises
    ------
    loadflow.errors.InputError
        Unknown class, no weights, or a series that is too short.
    """
    options = options or LifetimeOptions()
    by_bearing: dict[str, list[BearingSeries]] = {}
    for part in series:
        by_bearing.setdefault(part.bearing, []).append(part)
    for bearing, parts in by_bearing.items():
        yield _lifetime(bearing, parts, options)


def _lifetime(
    bearing: str, parts: list[BearingSeries], options: LifetimeOptions
) -> BearingLifetime:
    shares = _shares(parts, options)
    equivalent = np.stack([_equivalent(part, options.exponents) for part in parts], axis=-1)
    lifetime = [
        [float(lifetime_equivalent_load(case_loads, shares, m)) for case_loads in component]
        for m, component in zip(options.exponents, equivalent)
    ]
    resultants = [np.hypot(*part.radial.T) for part in parts]
    speed_edges = class_edges(_extremes([part.speed for part in parts]), options.classes)
    force_edges = class_edges(_extremes(resultants), options.classes)
    seconds = options.years * YEAR
    durations = [
        load_duration(part.speed, part.radial, part.time, classes=(speed_edges, force_edges))
        for part in parts
    ]
    living = [k for k, share in enumerate(shares.tolist()) if share > 0]
    tails = _tails([parts[k] for k in living], [resultants[k] for k in living], options)
    populations = [_population(part) for part in parts]
    tail_shares = np.array(
        [sum(w for w, own in zip(shares.tolist(), populations) if own == one) for one in tails]
    )
    return BearingLifetime(
        bearing,
        tuple(part.case for part in parts),
        shares,
        tuple(without_share([part.labels["dlc"] for part in parts], shares)),
        equivalent,
        np.array(lifetime),
        lifetime_duration(durations, shares, seconds),
        _markov(parts, shares * seconds, options.classes),
        tails,
        tail_shares,
        long_term_extreme(list(tails.values()), tail_shares, options.return_period)
        if tails
        else None,
    )


def _extremes(series: Sequence[np.ndarray]) -> np.ndarray:
    """Smallest and largest value of some series: all that edges of equal classes depend on."""
    return np.array([min(x.min() for x in series), max(x.max() for x in series)])


def _shares(parts: Sequence[BearingSeries], options: LifetimeOptions) -> np.ndarray:
    """Share of each case."""
    if options.weights == "given":
        given = np.array([part.labels["weight"] for part in parts])
        if not given.any():
            raise InputError("weights: the cube gives every case a share of 0")
        return given
    return lifetime_shares(
        [part.labels["dlc"] for part in parts],
        [part.labels["wind_speed"] for part in parts],
        [float(part.time[-1] + part.time[1] - 2 * part.time[0]) for part in parts],
        wind_class=options.wind_class,
        shape=options.weibull_shape,
        operating=options.operating,
        per_year=options.per_year,
    )


def _equivalent(part: BearingSeries, exponents: Sequence[float]) -> np.ndarray:
    """Damage-equivalent loads (exponent, component) of one case."""
    length = float(part.time[-1] - part.time[0])
    components = [*part.radial.T, part.force[:, 0]]
    found = [damage_equivalent_load(rainflow(x), list(exponents), length) for x in components]
    return np.stack(found, axis=1)


def _markov(parts: Sequence[BearingSeries], seconds: np.ndarray, classes: int) -> MarkovMatrix:
    """Transitions of all cases, each repeated for its share of the lifetime."""
    edges = class_edges(_extremes([part.radial[:, 0] for part in parts]), classes)
    counts = np.zeros((edges.size - 1, edges.size - 1))
    for part, length in zip(parts, seconds.tolist()):
        own = markov_matrix(part.radial[:, 0], edges).counts
        counts += own * length / float(part.time[-1] - part.time[0])
    return MarkovMatrix(edges, np.rint(counts).astype(np.int64))


def _population(part: BearingSeries) -> tuple[str, float]:
    """What cases of one tail have in common: a start is no production in the same wind."""
    return str(part.labels["dlc"]), float(part.labels["wind_speed"])


def _tails(
    parts: Sequence[BearingSeries], resultants: list[np.ndarray], options: LifetimeOptions
) -> dict[tuple[str, float], Tail]:
    """Tails of load cases and wind speeds with enough blocks or peaks, all seeds together."""
    groups: dict[tuple[str, float], list[int]] = {}
    for k, part in enumerate(parts):
        groups.setdefault(_population(part), []).append(k)
    found = {}
    for one, members in sorted(groups.items()):
        dt = float(parts[members[0]].time[1] - parts[members[0]].time[0])
        x = [resultants[k] for k in members if resultants[k].size >= round(options.block / dt)]
        try:
            if options.tail == "maxima":
                found[one] = tail_of_maxima(x, dt, options.block)
            else:
                found[one] = tail_of_peaks(x, dt, separation=options.block)
        except InputError:  # too short a record has no tail; the table says which have one
            continue
    return found
