"""Events that wear a bore, which come back many times, and the shaft followed through one."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from typing import Annotated, Any

import numpy as np
from annotated_types import Ge
from numpy.typing import NDArray

from loadflow.errors import InputError, SolverError, ValidityWarning
from loadflow.journal.bearing import JournalBearing
from loadflow.journal.film_model import Film
from loadflow.numerics.convergence import Control
from loadflow.numerics.fields import require
from loadflow.numerics.lines import on_lines

Array = NDArray[np.float64]

_PARTS = (1, 2, 4, 8, 16)  # steps in motion from each sample of a cycle to the next
_SETTLED = 0.01  # error of what a cycle rubs by its steps
_SLIGHT = 1e-6  # of the load all along: what asperities rub under less of it hardly wears
_BARELY = 4.0  # roughnesses between surfaces whose asperities hardly carry
_WIDE = 1.0  # m, wider than any film, of a shaft that never turns


@dataclass(frozen=True)
class Cycle:
    """One start, stop or other event that comes back many times.

    Attributes
    ----------
    time : array (n,)
        s, increasing.
    force : array (n, 2)
        What the shaft applies to the bearing, N.
    speed : array (n,)
        rad/s.
    count : float
        How often it happens in the whole time that is looked at.
    in_motion : bool
        Follow the shaft through time, squeeze included, in up to 16 steps a sample, until
        load on its asperities times way is known to 1 % (a warning tells where it is not); loads
        and speed are straight lines between the samples. Else each sample is an equilibrium.
    tilt, bend : array (n, 2), optional
        How the shaft lies, rad and 1/m, as in `JournalBearing.orbit`.
    name : str
        For messages and tables.
    start : array (2,), optional
        First eccentricity in motion, m, in the bore as new; in a worn bore as far from where the
        shaft would lie at rest. Left out, the shaft begins there.

    Raises
    ------
    loadflow.errors.InputError
        Misshapen, not finite or not increasing input.

    Examples
    --------
    >>> from loadflow.journal import Cycle
    >>> start = Cycle(time=[0.0, 5.0], force=[(8e4, 0.0)] * 2, speed=[0.0, 10.0], count=20_000)
    >>> start.distance(radius=0.1).sum()  # m, of one start
    np.float64(2.5)
    """

    time: Array
    force: Array
    speed: Array
    count: Annotated[float, Ge(0)] = 1.0
    in_motion: bool = True
    tilt: Array | None = None
    bend: Array | None = None
    name: str = "cycle"
    start: Array | None = None

    def __post_init__(self) -> None:
        n = np.asarray(self.time, dtype=float).shape
        shapes = {"time": n, "speed": n, **dict.fromkeys(("force", "tilt", "bend"), (*n, 2))}
        shapes |= {"start": (2,)}
        for key, shape in shapes.items():
            if (values := getattr(self, key)) is None:
                continue
            values = np.asarray(values, dtype=float)
            if len(n) != 1 or values.shape != shape or not np.isfinite(values).all():
                raise InputError(f"{self.name}, {key} {values.shape}: must be finite, {shape}")
            object.__setattr__(self, key, values)
        increases = bool(np.all(np.diff(self.time) > 0)) and n[0] > 1
        require(increases, "time", f"{n[0]} times", "two or more, increasing")
        require(bool(0 <= self.count < np.inf), "count", self.count, "≥ 0, finite")
        begins = self.start is None or self.in_motion
        require(begins, "start", self.start, "None of samples at rest (in_motion = False)")

    @property
    def seconds(self) -> Array:
        """Time that each sample stands for, (n,), s; that of the whole cycle in all."""
        steps = np.diff(self.time)
        return 0.5 * (np.append(steps, 0.0) + np.append(0.0, steps))

    def divided(self, parts: int) -> Cycle:
        """The same event with `parts` samples in place of each, on straight lines between them."""
        known = np.arange(self.time.size, dtype=float)
        place = np.arange((known.size - 1) * parts + 1) / parts
        given = {"time": self.time, "force": self.force, "speed": self.speed} | self.line()
        finer: dict[str, Any] = {key: on_lines(place, known, one) for key, one in given.items()}
        return replace(self, **finer)

    def line(self, some: slice = slice(None)) -> dict[str, Any]:
        """How the shaft lies at `some` of the times, by the keywords of `JournalBearing.orbit`."""
        lines = {"tilt": self.tilt, "bend": self.bend}
        return {key: values[some] for key, values in lines.items() if values is not None}

    def distance(self, radius: float) -> Array:
        """Sliding distance of each sample on a shaft of `radius`, m, (n,), m."""
        return self.seconds * np.abs(self.speed) * radius


def followed(
    bearing: JournalBearing,
    cycle: Cycle,
    film: Film,
    control: Control | None = None,
    offset: Array | None = None,
) -> tuple[Cycle, dict[str, Array]]:
    """Follow a cycle, first by `offset` (2,), m, from rest, or solve each of its samples.

    The cycle at the times that were solved, between its samples, too, and arrays (n, …) of these
    by names of `JournalBearing.orbit`; `loadflow.errors.SolverError` names the cycle.
    """
    start = None
    if offset is not None:
        start = _first_place(bearing, cycle, film, control) + offset
    try:
        if cycle.in_motion:
            return _path(bearing, cycle, film, control, start)
        given, line = (cycle.force, cycle.speed), cycle.line()
        rest = bearing.equilibrium(*given, film, control=control, **line)
        return cycle, {name: np.asarray(getattr(rest, name)) for name in _FOLLOWED}
    except SolverError as error:
        raise SolverError(f"{cycle.name}: {error}") from error


def _path(
    bearing: JournalBearing,
    cycle: Cycle,
    film: Film,
    control: Control | None,
    start: Array | None,
) -> tuple[Cycle, dict[str, Array]]:
    """A cycle in motion, in steps so short that load on its asperities times way settles.

    A shaft leaves its asperities faster than the samples of a start tell, or meets them between
    two of these. Steps of one length need no rest to go on from.
    """
    tips = None if film.contact is None else film.contact.asperities
    barely = 0.0 if tips is None else tips.summit_height + _BARELY * tips.roughness
    slight = _SLIGHT * float(cycle.distance(bearing.radius) @ np.hypot(*cycle.force.T))
    rubbed = narrow = np.nan
    for parts in _PARTS:
        finer = cycle.divided(parts)
        given: dict[str, Any] = {"force": finer.force, "speed": finer.speed} | finer.line()
        given |= {} if start is None else {"start": start}
        path = bearing.orbit(finer.time, film=film, control=control, **given)
        found = {name: path[name].values for name in _FOLLOWED}
        load = np.hypot(*found["contact_force"].T)
        before, rubbed = rubbed, float(finer.distance(bearing.radius) @ load)
        turns = np.abs(finer.speed) > 0.0
        wider, narrow = narrow, float(found["minimum_film"][turns].min(initial=_WIDE))
        settled = abs(rubbed - before) <= 3.0 * _SETTLED * max(rubbed, slight)  # of second order
        if rubbed <= slight:  # nor may the film come nearer between its steps than they tell
            far = max(narrow - barely, 3.0 * _SETTLED * narrow)
            settled = settled and abs(narrow - wider) <= far
        if settled:
            break
    else:
        warnings.warn(
            f"{cycle.name}: in {_PARTS[-1]} steps a sample load on asperities times way "
            f"is not known to {_SETTLED:.0%}; samples that are closer together tell it",
            ValidityWarning,
            stacklevel=2,
        )
    return finer, found


_FOLLOWED = ("eccentricity", "contact_force", "contact_share", "contact_power",
             "friction_power", "minimum_film", "contact_pressure")  # fmt: skip


def offset_of(
    bearing: JournalBearing, cycle: Cycle, film: Film, control: Control | None = None
) -> Array | None:
    """How far a cycle begins from rest, (2,), m, for other bores: its `start` may be outside."""
    return (
        None if cycle.start is None else cycle.start - _first_place(bearing, cycle, film, control)
    )


def _first_place(
    bearing: JournalBearing, cycle: Cycle, film: Film, control: Control | None
) -> Array:
    """Eccentricity (2,), m, at rest under the first load of a cycle."""
    first = slice(0, 1)
    given, line = (cycle.force[first], cycle.speed[first]), cycle.line(first)
    try:
        rest = bearing.equilibrium(*given, film, control=control, **line)
    except SolverError as error:
        raise SolverError(f"{cycle.name}: {error}") from error
    return np.asarray(rest.eccentricity)[0]
