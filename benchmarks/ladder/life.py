"""Ladder of the rating life: the full series of loads against bins of them."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from benchmarks.ladder.measuring import (
    Bench,
    Errors,
    Rungs,
    label,
    on_cases,
    rounded,
    sentence,
    with_ratios,
)
from loadflow.rolling import (
    ARRANGEMENTS,
    BearingLife,
    RollingBearing,
    arrangement_lives,
    bin_loads,
    main_bearings,
)
from loadflow.stages.frames import to_rolling

EVERY = 8  # steps of 0.025 s
BINS = (4, 8, 12, 16, 24)


@dataclass(frozen=True)
class Loads:
    """Force (n, 3), moment (n, 2), revolutions (n,) and the place of each sample's wind speed."""

    force: np.ndarray
    moment: np.ndarray
    turns: np.ndarray
    wind: np.ndarray

    def at(self, some: np.ndarray) -> Loads:
        """Some of the samples."""
        return Loads(self.force[some], self.moment[some], self.turns[some], self.wind[some])


Binned = Callable[[Loads], Loads]


def of_all(bins: int) -> Binned:
    """Gather all wind speeds in the same bins."""

    def gather(loads: Loads) -> Loads:
        found = bin_loads(loads.force, loads.moment, loads.turns, bins)
        return Loads(*found, np.zeros(found[2].size, int))

    return gather


def of_each(bins: int) -> Binned:
    """Gather each wind speed in bins of its own."""

    def gather(loads: Loads) -> Loads:
        parts = [of_all(bins)(loads.at(loads.wind == k)) for k in np.unique(loads.wind)]
        names = ("force", "moment", "turns", "wind")
        return Loads(*(np.concatenate([getattr(part, n) for part in parts]) for n in names))

    return gather


MODELS: dict[str, tuple[Binned, str]] = {
    "mean of each wind speed": (of_each(1), "one load for each wind speed"),
    **{f"bins, {n}": (of_all(n), f"{n} bins of each component, by revolutions") for n in BINS},
    "bins of each wind speed, 8": (of_each(8), "8 bins of each component, each speed by itself"),
    "full series": (lambda loads: loads, f"every {0.025 * EVERY:g} s"),
}


def measure_life(bench: Bench) -> Rungs:
    """Errors of the lives under each wind speed alone and under all of them."""
    series = _series(bench)
    names = [label(case) for case in bench.series]
    answers: dict[str, dict[str, BearingLife]] = {}
    spent: dict[str, float] = defaultdict(float)
    for arrangement in ARRANGEMENTS:
        for place, bearing in main_bearings(arrangement).items():
            loads = series[place]
            life_of(bearing, loads.at(np.arange(2)))  # compiles
            for rung, (gather, _) in MODELS.items():
                found = answers.setdefault(rung, {})
                begin = time.process_time()
                together = life_of(bearing, gather(loads))
                spent[rung] += time.process_time() - begin
                found[f"{arrangement}, {place}, all speeds"] = together
                for k, name in enumerate(names):
                    one = gather(loads.at(loads.wind == k))
                    found[f"{arrangement}, {place}, {name}"] = life_of(bearing, one)
    rungs: Rungs = {}
    bearings = sum(len(main_bearings(a)) for a in ARRANGEMENTS)
    for rung, (_, about) in MODELS.items():
        errors = compare(answers[rung], answers["full series"]).summary()
        top = rung == "full series"
        rungs[rung] = {
            "includes": [about],
            "seconds_per_case": rounded(spent[rung] / len(names) / bearings),
            "reference": "the full series",
            "cases": (
                f"{on_cases(bench)}; 1 seed, {bench.setting.full_duration:g} s, each by itself and "
                f"all weighted by Rayleigh; the bearings of {', '.join(ARRANGEMENTS)}"
            ),
            "errors": {} if top else errors,
            "error": "top rung" if top else sentence(errors, "life", "static safety"),
        }
    return with_ratios(rungs, "full series")


def _series(bench: Bench) -> dict[str, Loads]:
    """Loads of each place on the shaft, all wind speeds after each other."""
    rows: dict[str, list[tuple[np.ndarray, ...]]] = defaultdict(list)
    for k, (case, parts) in enumerate(bench.series.items()):
        speed = np.abs(parts["loads"]["speed"].values[::EVERY].astype(float))
        for place in parts["shaft"]["bearing"].values:
            one = parts["shaft"].sel(bearing=place).isel(time=slice(None, None, EVERY))
            force, moment = (
                to_rolling(one[what].transpose("time", "axis").values.astype(float))
                for what in ("force", "moment")
            )
            turns = speed * case.weight
            rows[str(place)].append((force, moment[:, :2], turns, np.full(turns.size, k)))
    return {place: Loads(*map(np.concatenate, zip(*parts))) for place, parts in rows.items()}


def life_of(bearing: RollingBearing, loads: Loads) -> BearingLife:
    """Rating life of one bearing, each load weighted by its revolutions."""
    one = np.ones_like(loads.turns)
    found = arrangement_lives(
        {"it": bearing}, {"it": loads.force}, {"it": loads.moment}, one, loads.turns
    )
    return found["it"]


def compare(rung: dict[str, BearingLife], top: dict[str, BearingLife]) -> Errors:
    """Deviations of what a rung gives of each bearing and set of loads."""
    errors = Errors()
    for where, found in rung.items():
        errors.add("life", where, found.life, top[where].life)
        errors.add("static safety", where, found.static_safety, top[where].static_safety)
        errors.add("maximum pressure", where, found.maximum_pressure, top[where].maximum_pressure)
    return errors
