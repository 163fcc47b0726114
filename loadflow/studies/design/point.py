"""One design under a load spectrum, by fast models: what it loses, and how far its limits are."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import InputError, SolverError
from loadflow.rolling import modified_spectrum_life, system_life
from loadflow.rolling.rating.life import rating_life_spectrum
from loadflow.scene.bearings import FurtherBearing, Rolling
from loadflow.scene.friction import Friction
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Candidate
from loadflow.stages.films.of_bearing import surely_touching
from loadflow.stages.rolling_at_work import at_work, friction_options, rest
from loadflow.studies.candidate.factor import largest_factor
from loadflow.studies.candidate.grown_films import FACTORS, GrownFilms, fast_journal, pressed
from loadflow.studies.candidate.margins import lubrication
from loadflow.studies.candidate.quantities import QUANTITIES
from loadflow.studies.candidate.rolling_warmth import Warmth, power_of_rise
from loadflow.studies.shaft_through import BentShaft

_CONDITION = "smallest ratio of what else is allowed to what is found, 1 at the limit"
_UNITS = {
    "energy": "MWh",
    "friction": "kW",
    "load_factor": "1",
    "condition": "1",
    "minimum_film": "m",
    "film_pressure": "Pa",
    "eccentricity_ratio": "1",
    "oil_flow": "m^3/s",
    "static_safety": "1",
    "contact_pressure": "Pa",
    "rating_life": "h",
    "modified_life": "h",
}
NUMBERS = {
    name: (units, QUANTITIES[name].name if name in QUANTITIES else _CONDITION)
    for name, units in _UNITS.items()
}
"""Numbers of a design: units and meaning; NaN of those that its bearings do not have."""


@dataclass(frozen=True)
class DesignPoint:
    """What is known of a design.

    Attributes
    ----------
    numbers : dict
        Of `NUMBERS`, by name.
    governs : str
        The limit that is reached first.
    lacks : str
        Which other condition is the nearest, or broken.
    why : str
        Why there is no such design; empty if there is.
    """

    numbers: dict[str, float] = field(default_factory=dict)
    governs: str = ""
    lacks: str = ""
    why: str = ""

    @property
    def energy(self) -> float:
        """Energy lost a year, MWh; infinite without an answer."""
        return self.numbers.get("energy", math.inf)

    @property
    def load_factor(self) -> float:
        """Capacity margin; 0 without an answer."""
        return self.numbers.get("load_factor", 0.0)

    @property
    def condition(self) -> float:
        """Ratio of the nearest other condition; 0 without an answer."""
        return self.numbers.get("condition", 0.0)


@dataclass
class _Sums:
    """What the bearings of a design add up to."""

    power: float = 0.0
    flow: float = 0.0
    turning: float = 0.0
    margins: dict[str, float] = field(default_factory=dict)
    conditions: dict[str, float] = field(default_factory=dict)
    least: dict[str, float] = field(default_factory=dict)
    most: dict[str, float] = field(default_factory=dict)

    def extreme(self, name: str, value: float) -> None:
        """Keep the smallest and the largest of a number over the bearings."""
        self.least[name] = min(self.least.get(name, math.inf), value)
        self.most[name] = max(self.most.get(name, -math.inf), value)


def judge_design(
    candidate: Candidate,
    friction: Friction,
    spectrum: xr.DataTree,
    shaft: BentShaft | None = None,
    rises: Mapping[str, float] | None = None,
) -> DesignPoint:
    """Friction, margin and conditions of a candidate under a load spectrum.

    Parameters
    ----------
    candidate : Candidate
        Its bearings.
    friction : Friction
        Oil of rolling bearings.
    spectrum : xarray.DataTree
        Of `loadflow.studies.lifetime.load_spectrum.load_spectrum`, with its places.
    shaft : BentShaft, optional
        The shaft that bends in them, as wide as they are: films follow it, or its tilt is a
        condition.
    rises : mapping, optional
        Power of the load that the rise of a rolling bearing over the air follows, by place. Left
        out, that of its heat balance, and 0 where `friction` states its temperature.

    Returns
    -------
    DesignPoint
        One with `why` where a solver has no answer at all.
    """
    sums = _Sums()
    try:
        if candidate.journal is not None:
            for place in candidate.journal.bearings:
                samples, around = spectrum[place].to_dataset(), None
                if shaft is not None and place in shaft.concept.bearings:
                    samples, around = shaft.lying(candidate, place, samples), shaft
                _add_film(sums, candidate.journal.at(place), place, samples, around)
        if candidate.rolling is not None:
            _add_rolling(sums, candidate.rolling, friction, spectrum, rises or {})
            if shaft is not None:
                _add_tilts(sums, candidate, shaft, spectrum)
    except (SolverError, InputError) as error:
        return DesignPoint(why=str(error))
    seconds = spectrum.attrs["seconds"]
    numbers = dict.fromkeys(NUMBERS, math.nan) | {
        "energy": sums.power * seconds / 3.6e9,
        "friction": sums.power / 1e3 / max(sums.turning, 1e-300),
        "load_factor": min(sums.margins.values(), default=math.nan),
        "condition": min(sums.conditions.values(), default=math.inf),
    }
    numbers |= {n: v for n, v in sums.least.items() if n in ("minimum_film", "static_safety")}
    peaks = ("film_pressure", "eccentricity_ratio", "contact_pressure")
    numbers |= {n: v for n, v in sums.most.items() if n in peaks}
    numbers |= {n: v for n, v in sums.least.items() if n in ("rating_life", "modified_life")}
    if candidate.journal is not None:
        numbers["oil_flow"] = sums.flow
    return DesignPoint(
        numbers,
        min(sums.margins, key=lambda name: sums.margins[name], default=""),
        min(sums.conditions, key=lambda name: sums.conditions[name], default=""),
    )


# --- films ----------------------------------------------------------------------------------------


def _add_film(
    sums: _Sums, options: Journal, place: str, samples: xr.Dataset, shaft: BentShaft | None
) -> None:
    """Add what a journal bearing loses, and how far its limits are; around a `shaft` that bends.

    Films follow such a shaft only where it does not close the aligned ones at an end: the others
    do not hold in any case, and what is left of them takes long to find.
    """
    fast = fast_journal(options)
    force = samples["force"].transpose("sample", "axis").values
    speed, weight = samples["speed"].values, samples["weight"].values
    running = samples["running"].values.astype(bool)
    touching = surely_touching(fast, force, speed)
    if touching.all():
        sums.margins[f"smallest film in {place}"] = float(FACTORS[0])
        sums.extreme("minimum_film", 0.0)
        return
    film = GrownFilms(fast, samples)
    asked = np.flatnonzero(~touching)
    answer = film.at(asked)
    film_of = _thickness(answer, asked, speed.size)
    judged = np.flatnonzero(running)
    if shaft is not None and judged.size and not (options.tilt or options.self_aligning):
        closing = 2 * film_of[judged] / options.geometry.width
        share = float((closing / np.maximum(_tilt(samples)[judged], 1e-300)).min())
        sums.conditions[f"tilt of the shaft in {place}"] = share
        if shaft.in_films and share >= 1:
            film = GrownFilms(fast_journal(options.model_copy(update={"tilt": True})), samples)
            answer = film.at(asked)
            film_of = _thickness(answer, asked, speed.size)
    own = weight[asked] * answer.converged
    total = weight.sum() / max(own.sum(), 1e-300)  # those without a film lose as the others do
    sums.power += total * _mean(answer.friction_power + answer.supply_power, own)
    sums.flow += total * _mean(answer.side_flow, own)
    sums.turning = max(sums.turning, float(weight.sum()))

    limits = options.limits
    if judged.size:
        thin = int(judged[np.argmin(film_of[judged])])
        sums.margins[f"smallest film in {place}"] = film.crossing(
            thin, "minimum_film", options.least_film, falls=True
        )
        sums.extreme("minimum_film", float(film_of[thin]))
    pressure = pressed(options, samples.isel(sample=asked), answer)
    hardest = int(asked[np.argmax(pressure)])
    allowed = allowed_pressure(options, answer, int(np.argmax(pressure)))
    sums.margins[f"largest film pressure in {place}"] = film.crossing(
        hardest, "maximum_pressure", allowed, falls=False
    )
    sums.extreme("film_pressure", float(pressure.max()))
    _film_conditions(sums, options, place, samples, answer, asked)
    if options.heat is not None:
        warm = float(np.nanmax(answer.temperature))
        sums.conditions[f"temperature of the film in {place}"] = limits.oil_temperature / warm


def _mean(values: np.ndarray, weight: np.ndarray) -> float:
    return float((np.where(weight > 0, values, 0.0) * weight).sum())


def _thickness(answer: Any, asked: np.ndarray, count: int) -> np.ndarray:
    """Smallest film of each sample, 0 where there is none, m."""
    film = np.zeros(count)
    film[asked] = np.where(answer.converged, answer.minimum_film, 0.0)
    return film


def _tilt(samples: xr.Dataset) -> np.ndarray:
    """Size of the tilt of the shaft in a bearing, rad."""
    return np.hypot(*samples["tilt"].sel(axis=["y", "z"]).transpose("axis", "sample").values)


def allowed_pressure(options: Journal, answer: Any, worst: int) -> float:
    """Largest film pressure, Pa, that the material carries where a sample's film is as warm."""
    kelvin = float(answer.temperature[worst]) if options.heat is not None else math.nan
    return options.limits.pressure_at(kelvin)


def _film_conditions(
    sums: _Sums, options: Journal, place: str, samples: xr.Dataset, answer: Any, asked: np.ndarray
) -> None:
    """ε and So in power production, as the verdicts of a run hold them against their limits."""
    limits = options.limits
    running = samples["running"].values.astype(bool)[asked] & answer.converged
    if not running.any():
        return
    ratio = float(answer.eccentricity_ratio[running].max())
    sums.extreme("eccentricity_ratio", ratio)
    if math.isfinite(options.critical.ratio):  # else its film is in the least one
        sums.conditions[f"eccentricity ratio in {place}"] = options.critical.ratio / ratio
    number = answer.sommerfeld_number[running]
    some = samples.isel(sample=asked[running])
    radial = np.hypot(*some["force"].sel(axis=["y", "z"]).transpose("axis", "sample").values)
    per_load = float(np.median(number * np.abs(some["speed"].values) / np.maximum(radial, 1e-300)))
    means = samples["load_per_speed"].values
    means = per_load * means[np.isfinite(means)]
    low, high = options.sommerfeld_range
    peak = max(float(number.max()), 1e-300)
    sums.conditions[f"largest Sommerfeld number in {place}"] = limits.sommerfeld_peak / peak
    if means.size:
        sums.conditions[f"largest mean Sommerfeld number in {place}"] = high / means.max()
        if low > 0:
            sums.conditions[f"smallest mean Sommerfeld number in {place}"] = means.min() / low


# --- rolling bearings -----------------------------------------------------------------------------


def _lives(turned: _Turned, wanted: float, factor: float) -> bool:
    """Whether a bearing reaches a modified life, h, under its loads times a factor."""
    return bool(turned.modified(factor) >= wanted)


def _add_rolling(
    sums: _Sums,
    rolling: Rolling,
    friction: Friction,
    spectrum: xr.DataTree,
    rises: Mapping[str, float],
) -> None:
    """Add what the rolling bearings lose, and how far their limits are."""
    parts, limit = rolling.bearings, rolling.system_life
    lives: list[_Turned] = []
    for place, stated in parts.items():
        samples, own = spectrum[place].to_dataset(), friction.of(stated)
        own = own if stated.balances_heat else own.without_balance()
        turned = _Turned.of(stated, samples, own, rises.get(place, 0.0))
        part = turned.part
        lives.append(turned)
        sums.power += turned.power
        sums.turning = max(sums.turning, float(turned.weight.sum()))
        sums.extreme("contact_pressure", max(turned.pressure, _rarest_pressure(part, samples)))
        safety = _static(part, samples)
        sums.extreme("static_safety", safety)
        sums.margins[f"static rating of {place}"] = safety / part.limits.static_safety
        sums.margins[f"rating life of {place}"] = (turned.hours() / part.limits.life) ** (
            1 / part.geometry.life_exponent
        )
        sums.margins[f"modified life of {place}"] = largest_factor(
            partial(_lives, turned, part.limits.life)
        )
    slope = min(part.geometry.weibull_slope for part in parts.values())

    def together(hours: Iterator[float]) -> float:
        return float(system_life(np.array([*hours]), slope))

    rating = together(one.hours() for one in lives)
    modified = together(one.modified(1.0) for one in lives)
    sums.extreme("rating_life", rating)
    sums.extreme("modified_life", modified)
    if len(lives) > 1:
        sums.margins["rating life of all bearings"] = largest_factor(
            lambda f: together(one.hours(f) for one in lives) >= limit
        )
        sums.margins["modified life of all bearings"] = largest_factor(
            lambda f: together(one.modified(f) for one in lives) >= limit
        )


def _add_tilts(sums: _Sums, candidate: Candidate, shaft: BentShaft, spectrum: xr.DataTree) -> None:
    """Add how far the tilt of the shaft is from that which rolling bearings allow."""
    assert candidate.rolling is not None
    for place, bearing in candidate.rolling.geometries.items():
        if place in shaft.concept.bearings and bearing.allowed_tilt:
            tilt = _tilt(shaft.lying(candidate, place, spectrum[place].to_dataset())).max()
            share = bearing.allowed_tilt / max(float(tilt), 1e-300)
            sums.conditions[f"tilt of the shaft in {place}"] = share


_YEAR = "a year"
"""What the loads of the spectrum are of: one heat balance of their mean friction."""


@dataclass(frozen=True)
class _Turned:
    """A rolling bearing at work under the loads of a lifetime; `warmth` is that of its oil."""

    part: FurtherBearing
    load: np.ndarray
    speed: np.ndarray
    weight: np.ndarray
    oil: Any
    warmth: Warmth
    power: float
    pressure: float

    @classmethod
    def of(
        cls, stated: FurtherBearing, samples: xr.Dataset, options: Friction, rise: float
    ) -> _Turned:
        used = samples.isel(sample=np.flatnonzero(samples["weight"].values > 0))
        force, moment, speed, weight = (
            used[name].transpose("sample", ...).values
            for name in ("force", "moment", "speed", "weight")
        )
        part, kelvin = at_work(stated, options, force, moment, speed, weight)
        power = rise
        if options.conductance is not None:

            def under(factor: float) -> float:
                more = factor * force, factor * moment
                return at_work(stated, options, *more, speed, weight)[1]

            power = power_of_rise(under, options.ambient_temperature)
        warmth = Warmth({_YEAR: kelvin}, {_YEAR: power}, options.ambient_temperature)
        options = options.model_copy(update={"temperature": kelvin})
        answer = rest(part, force, moment, speed, strict=False)
        if not np.all(answer.converged):
            raise SolverError("no equilibrium of a rolling bearing under a load of the spectrum")
        lost = answer.friction(speed, friction_options(options, part.geometry))
        return cls(
            part, answer.equivalent_load, speed, weight, lubrication(options), warmth,
            float((lost.power * weight).sum()), float(answer.maximum_pressure.max()),
        )  # fmt: skip

    @property
    def _per_hour(self) -> float:
        """Revolutions in an hour of the lifetime."""
        return float((np.abs(self.speed) * self.weight).sum() / (2 * np.pi) * 3600)

    def hours(self, factor: float = 1.0) -> float:
        """Rating life, h, with a factor on all loads."""
        turns, bearing = np.abs(self.speed) * self.weight, self.part.geometry
        life = rating_life_spectrum(
            bearing.rated_capacity, factor * self.load, turns, bearing.life_exponent
        )
        return float(life) * 1e6 / self._per_hour

    def modified(self, factor: float) -> float:
        """Modified life, h, with a factor on all loads."""
        oil = replace(self.oil, temperature=self.warmth.under(_YEAR, factor))
        found = modified_spectrum_life(
            self.part.geometry, factor * self.load, self.speed, oil, self.weight
        )
        return float(found.life) * 1e6 / self._per_hour


def _rarest_pressure(part: FurtherBearing, samples: xr.Dataset) -> float:
    """Largest contact pressure, Pa, of samples without a share of the life, as the hardest are."""
    rare = samples.isel(sample=np.flatnonzero(~(samples["weight"].values > 0)))
    if not rare.sizes["sample"]:
        return 0.0
    force, moment = (rare[name].transpose("sample", "axis").values for name in ("force", "moment"))
    answer = rest(part, force, moment, rare["speed"].values, strict=False)
    return float(np.where(answer.converged, answer.maximum_pressure, np.inf).max())


def _static(part: FurtherBearing, samples: xr.Dataset) -> float:
    """Static rating over the hardest design loads."""
    ultimate = samples["ultimate"].values.astype(bool)
    some = samples.isel(sample=np.flatnonzero(ultimate)) if ultimate.any() else samples
    factor = some["load_factor"].values[:, None]
    force, moment = (
        factor * some[name].transpose("sample", "axis").values for name in ("force", "moment")
    )
    answer = rest(part, force, moment, some["speed"].values, strict=False)
    return float(np.where(answer.converged, answer.static_safety, 0.0).min())
