"""What lives and film verdicts leave out of a comparison: reserves and shares of rows."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.rolling import Lubrication, RollingBearing, modified_spectrum_life, system_life
from loadflow.scene.friction import Friction
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.stages.films.of_bearing import equilibria, shaft_line
from loadflow.stages.films.turning import of_running
from loadflow.stages.rolling import bearing_at_work
from loadflow.stages.rolling_at_work import rest
from loadflow.studies.candidate.deviations import oil_of
from loadflow.studies.candidate.factor import (
    SAMPLES,
    WIDEST,
    Margin,
    at_time,
    film_extremes,
    film_margin,
    grown,
    life_factor,
    reduced_samples,
    series_of,
)
from loadflow.studies.candidate.grown_films import fast_journal
from loadflow.studies.candidate.pads import pad_margins
from loadflow.studies.candidate.rolling_warmth import warmth_of
from loadflow.studies.candidate.seeds import of_extreme, of_life, power_of_load
from loadflow.studies.lifetime.finished_run import known_shares
from loadflow.studies.seeds.intervals import Groups, interval
from loadflow.studies.verdicts.verdicts import warm_in
from loadflow.tribology import lubricant
from loadflow.verdict import Verdict

Tables = Mapping[str, xr.Dataset]


_TOLD = 2  # changes that are told
# results and quantities whose error margins of lives have
_LIFE, _MODIFIED = ("rolling.life", "life"), ("rolling.life", "modified life")
_WARMER = 60.0  # K: how much warmer the oil is asked to be at most


@dataclass(frozen=True)
class RowShare:
    """Load on the row that takes the thrust: share at the largest thrust and in the mean.

    `by_case` has the largest thrust of each case, N, and the share of that row then.
    """

    share: float
    mean: float
    rows: int
    thrust: float
    place: str
    case: str
    time: float
    by_case: dict[str, tuple[float, float]]


def margin_of(scene: Scene, folder: Path, tables: Tables, verdicts: Sequence[Verdict]) -> Margin:
    """Factor on the loads with which a candidate reaches its first limit.

    The force on rolling elements is taken to grow with the load, and so does their equivalent load,
    with a_ISO of each sample anew. Of a journal bearing, the sample with the smallest film and that
    with the largest pressure are solved again at rest under larger or smaller loads, warm and
    around the shaft as it bends under these, where the run did so; of bearings of pads, see
    `pad_margins`. A limit whose factor has no answer does not count, and is named. As in the
    verdicts, films are those of load cases in which the shaft runs throughout: one that starts,
    stops or stands must touch its shell, and mixed friction and wear tell what that does to it.
    """
    found: list[Margin] = []
    rooms = [room for room in ("journal", "thrust", "rolling") if room in tables]
    first = tables[rooms[0]]
    same = {room: tables[room].reindex(case=first["case"].values) for room in rooms}
    tables = {**tables, **same}  # all of the same cases, for the seeds
    if "journal" in tables:
        table = of_running(tables["journal"])
        for place in table["bearing"].values.tolist():
            found += _film_margins(scene, folder, place, table.sel(bearing=place))
    if "thrust" in tables:
        table = of_running(tables["thrust"])
        for place in scene.thrust.bearings:
            found += pad_margins(scene, folder, place, table.sel(bearing=place))
    if "rolling" in tables:
        found += _rolling_margins(scene, folder, tables, verdicts)
    known = sorted((one for one in found if math.isfinite(one.factor)), key=lambda one: one.factor)
    uncounted = "; ".join(one.uncounted for one in found if one.uncounted)
    if not known:
        return Margin(math.nan, uncounted=uncounted)
    changes = dict.fromkeys(one.change for one in known if one.change)
    low, high = math.nan, math.nan
    if all(one.drawn is not None for one in known):
        draws = [one.drawn for one in known if one.drawn is not None]
        low, high = interval(
            Groups.of(first), lambda some: float(np.nanmin([drawn(some) for drawn in draws]))
        )
    told = "; ".join([*changes][:_TOLD])
    return replace(known[0], change=told, low=low, high=high, uncounted=uncounted)


# --- films ----------------------------------------------------------------------------------------


def _film_margins(scene: Scene, folder: Path, place: str, table: xr.Dataset) -> Iterator[Margin]:
    """Margins of one journal bearing: of its film, its pressure, and its load as it stands."""
    stated = scene.journal.at(place)
    if (table["in_contact"] > 0).any():
        case = str(table["case"].values[int(np.argmax(table["in_contact"].values))])
        yield Margin(0.0, place, case, f"shaft and shell touch in {place}", f"{place}: thicker oil")
        return
    yield from _standing_margin(stated, place, table)
    for one in film_extremes(stated, place, table):
        sample = at_time(series_of(scene, folder, one.case, place), one.time)
        value = cache(partial(_film_value, fast_journal(stated), sample, one.quantity))
        told = f"{one.what} in {place}"
        if not value(1.0, 1.0) > 0:
            why = f"{told} ({one.case}): no film at rest under its load"
            yield Margin(math.nan, place, one.case, uncounted=why)
            continue
        yield film_margin(one, value, stated, "journal", place, told)


def _standing_margin(stated: Journal, place: str, table: xr.Dataset) -> Iterator[Margin]:
    """Margin of the specific load F/(B D) of a shaft that stands, in proportion to its loads."""
    if "standing_load" not in table or not table["standing_load"].notnull().any():
        return
    load = table["standing_load"]
    worst = int(np.nanargmax(load.values))
    case, area = str(table["case"].values[worst]), stated.geometry.width * stated.geometry.diameter
    limit = stated.limits.pressure_at(warm_in(table, case))
    factor = limit * area / float(load.values[worst])
    yield Margin(
        factor, place, case, f"specific load at standstill in {place}",
        drawn=of_extreme(load, np.nanmax, factor, 1.0),
        time=float(table["standing_load_time"].values[worst]), power=1.0,
        models=("shaft.tilt", "tilt"),  # that of the load, which both follow
    )  # fmt: skip


def _film_value(options: Journal, sample: xr.Dataset, field: str, load: float, oil: float) -> float:
    """A value of the film at rest with factors on load and viscosity; NaN without an answer.

    The shaft lies as its beam says under so much load.
    """
    if oil != 1.0:
        options = options.model_copy(update=oil_of(options, oil))
    under = grown(sample, load)
    force = under["force"].transpose("sample", "axis").values.astype(float)
    lying = shaft_line(options, under)
    try:
        answer = equilibria(options, force, under["speed"].values.astype(float), **lying)
    except SolverError:  # a shaft that is tilted by more than the bore lets it
        return math.nan
    return float(getattr(answer, field)[0]) if answer.converged[0] else math.nan


# --- rolling bearings -----------------------------------------------------------------------------


@dataclass(frozen=True)
class _Life:
    """How a life of one bearing follows the load, and what takes it in the run.

    `hours` has a factor on the loads; `damage` is that of each case in an hour.
    """

    place: str
    hours: Callable[[float], float]
    damage: xr.DataArray
    factor: float
    power: float
    change: str = ""


def _rolling_margins(
    scene: Scene, folder: Path, tables: Tables, verdicts: Sequence[Verdict]
) -> Iterator[Margin]:
    """Margins of the static ratings, rating and modified lives of all rolling bearings.

    Lives are those of each bearing and, as the verdicts hold it, that of all as a system.
    """
    table = tables["rolling"]
    share = known_shares(tables, table)
    share = np.ones(table.sizes["case"]) if share is None else np.nan_to_num(share)
    of_all = {v.quantity: v.limit for v in verdicts if v.subject == "rolling, all as a system"}
    own = {(v.subject.removeprefix("rolling "), v.quantity): v for v in verdicts}
    places = [*scene.rolling.geometries]
    for place in places:
        static = own.get((place, "static rating over the design load"))
        if static is None or not math.isfinite(static.value):
            continue
        factor = static.value / scene.rolling.bearings[place].limits.static_safety
        safety = table["bearing_design_safety"].sel(bearing=place)
        yield Margin(
            factor, place, static.case, f"static rating of {place}",
            drawn=of_extreme(safety, np.nanmin, factor, -1.0), time=static.time,
            models=("rolling.loads", "maximum force"), power=-1.0,
        )  # fmt: skip
    for what, quantity, models, life_of in (
        ("rating life", "rating life L10h", _LIFE, _rating),
        ("modified life", "modified rating life L10mh", _MODIFIED, _modified),
    ):
        stated = {place: own.get((place, quantity)) for place in places}
        known = {place: v.value for place, v in stated.items() if v and math.isfinite(v.value)}
        lives = [life_of(scene, folder, place, tables, hours) for place, hours in known.items()]
        for one in lives:
            yield _life_margin(one, f"{what} of {one.place}", one.damage, share, models)
        if len(lives) > 1 and quantity in of_all:
            slope = float(table.attrs["weibull_slope"])
            together = _together(lives, of_all[quantity], share, slope)
            whose = f"{what} of all bearings, most of {together.place}"
            damage = xr.concat([one.damage.drop_vars("bearing") for one in lives], "bearing")
            yield _life_margin(together, whose, damage, share, models, slope)


def _life_margin(
    one: _Life,
    governs: str,
    damage: xr.DataArray,
    share: np.ndarray,
    models: tuple[str, str],
    slope: float = 1.0,
) -> Margin:
    """Margin of a life of one bearing, or by the `damage` of several that of all together."""
    case, most = _most_damage(one.damage, share)
    return Margin(
        one.factor, one.place, case, f"{governs}{most}", one.change,
        of_life(damage, share, one.factor, one.power, slope), models=models, power=-one.power,
    )  # fmt: skip


def _together(lives: Sequence[_Life], limit: float, share: np.ndarray, slope: float) -> _Life:
    """The life of all bearings as a system, at the place that takes most of it."""

    def hours(factor: float) -> float:
        return float(system_life(np.array([one.hours(factor) for one in lives]), slope))

    worst = max(lives, key=lambda one: float((np.nan_to_num(one.damage.values) * share).sum()))
    factor = life_factor(hours, limit)
    power = -power_of_load(hours, factor, WIDEST)
    return _Life(worst.place, hours, worst.damage, factor, power)


def _rating(scene: Scene, folder: Path, place: str, tables: Tables, found: float) -> _Life:
    """Rating life, which is `found` in the run, h: a power of the load."""
    power = scene.rolling.geometries[place].life_exponent
    limit = scene.rolling.bearings[place].limits.life
    damage = damage_per_hour(tables["rolling"].sel(bearing=place), "")
    factor = (found / limit) ** (1 / power)
    return _Life(place, lambda f: float(found * f**-power), damage, factor, power)


def _modified(scene: Scene, folder: Path, place: str, tables: Tables, found: float) -> _Life:
    """Modified life, which is `found` in the run, h, with a_ISO of each sample anew.

    The oil is as warm as in each load case of the run; by a heat balance it is warmer the larger
    the loads are.
    """
    bearing, limit = scene.rolling.geometries[place], scene.rolling.bearings[place].limits.life
    spectrum = _spectrum(scene, folder, place, tables)
    grease = lubrication(scene.friction)
    every = tables["rolling"]
    warmth = warmth_of(scene, place, every, looked_at(folder, place, every))

    @cache
    def life(factor: float, warmer: float = 0.0) -> float:
        turns = damage = 0.0
        for case, load, speed, weight in spectrum:
            oil = replace(grease, temperature=warmth.under(case, factor) + warmer)
            own = float((np.abs(speed) * weight).sum())
            turns += own
            damage += own / modified_spectrum_life(bearing, factor * load, speed, oil, weight).life
        return turns / damage if damage else math.inf

    whole = life(1.0)
    allowed = limit / found * whole
    factor = life_factor(life, allowed)
    warmer = np.linspace(0.0, _WARMER, 13)
    short = np.flatnonzero(np.array([life(1.0, float(more)) for more in warmer]) < allowed)
    change = f"{place}: oil {warmer[short[0]]:.0f} K warmer" if short.size and short[0] > 0 else ""
    power = -power_of_load(life, factor, WIDEST)
    damage = damage_per_hour(every.sel(bearing=place), "modified_")
    return _Life(place, lambda f: found * life(f) / whole, damage, factor, power, change)


def _most_damage(damage: xr.DataArray, share: np.ndarray) -> tuple[str, str]:
    """The load case that takes most of a life, and how much of it, in words."""
    parts = np.nan_to_num(damage.values * share)
    if not parts.sum() > 0:
        return "", ""
    most = int(np.argmax(parts))
    told = f" ({100 * parts[most] / parts.sum():.0f} % of its damage in one load case)"
    return str(damage["case"].values[most]), told


def damage_per_hour(table: xr.Dataset, kind: str) -> xr.DataArray:
    """Damage of each case in an hour by the rating life, or the ``modified_`` one."""
    revolutions = table["mean_speed"] / (2 * np.pi) * 3600
    return revolutions / (table[f"bearing_{kind}life"] * 1e6)


def lubrication(options: Friction) -> Lubrication:
    """Oil, temperature and cleanliness of the rolling bearings of a scene."""
    return Lubrication(
        oil=lubricant(options.lubricant),
        temperature=options.temperature,
        cleanliness=options.cleanliness,
    )


def _spectrum(
    scene: Scene, folder: Path, place: str, tables: Tables
) -> list[tuple[str, np.ndarray, np.ndarray, np.ndarray]]:
    """Each case with equivalent loads, N, speeds, rad/s, and shares of time of some samples."""
    lifetime = tables.get("lifetime")
    parts = []
    for case, some in looked_at(folder, place, tables["rolling"]):
        share = 1.0
        if lifetime is not None and "share" in lifetime:
            share = float(lifetime["share"].sel(case=case))
        answer = solved(scene, place, some)
        speed = some["speed"].values.astype(float)
        weight = np.full(speed.size, share / speed.size)
        parts.append((case, answer.equivalent_load, speed, weight))
    return parts


def solved(scene: Scene, place: str, some: xr.Dataset) -> Any:
    """Equilibrium of a rolling bearing, as it is at work, under some samples of a case."""
    force, moment = (
        some[name].transpose("sample", "axis").values.astype(float) for name in ("force", "moment")
    )
    return rest(bearing_at_work(scene, place, some), force, moment, strict=False)


def looked_at(folder: Path, place: str, table: xr.Dataset) -> Iterator[tuple[str, xr.Dataset]]:
    """Yield each case and some of its samples, that with the largest thrust among them.

    Those of the `table` of rolling bearings that have an answer: a run goes on without the others.
    """
    answered = table["bearing_temperature"].sel(bearing=place).dropna("case")
    for case in answered["case"].values.tolist():
        samples = reduced_samples(folder / "reduction" / f"{case}.h5", place)
        count = samples.sizes["sample"]
        spread = np.linspace(0, count - 1, min(SAMPLES, count)).round().astype(int)
        thrust = int(np.argmax(np.abs(samples["force"].sel(axis="x").values)))
        yield case, samples.isel(sample=np.unique([*spread, thrust]))


def row_shares(scene: Scene, folder: Path, tables: Tables) -> RowShare | None:
    """Load share of the row that takes the thrust, of the bearing where it is largest.

    None where no bearing has several rows and thrust.
    """
    found: list[RowShare] = []
    for place, bearing in scene.rolling.geometries.items():
        if bearing.group_dims[0] != "row" or bearing.groups[0] < 2 or not bearing.takes_thrust:
            continue
        parts = [
            (case, float(some["time"].values[k]), float(force), row)
            for case, some in looked_at(folder, place, tables["rolling"])
            for k, (force, row) in enumerate(
                zip(
                    some["force"].sel(axis="x").values,
                    load_by_row(bearing, solved(scene, place, some)),
                )
            )
        ]
        thrust = np.abs([part[2] for part in parts])
        rows = np.array([part[3] for part in parts])
        hardest = int(np.argmax(thrust))
        if thrust[hardest] == 0 or not np.isfinite(rows[hardest]).all():
            continue
        row = int(np.argmax(rows[hardest]))
        case, time, *_ = parts[hardest]
        by_case: dict[str, tuple[float, float]] = {}
        for (name, *_), force, own in zip(parts, thrust, rows):
            by_case[name] = max(by_case.get(name, (0.0, math.nan)), (float(force), float(own[row])))
        found.append(
            RowShare(
                float(rows[hardest, row]), float(np.nanmean(rows[:, row])), bearing.groups[0],
                float(thrust[hardest]), place, case, time, by_case,
            )
        )  # fmt: skip
    return max(found, key=lambda one: one.share * one.rows, default=None)


def load_by_row(bearing: RollingBearing, answer: Any) -> np.ndarray:
    """Share of each row in the forces on all elements, (sample, row)."""
    forces = answer.element_forces
    own = forces.reshape(len(forces), bearing.groups[0], -1).sum(axis=-1)
    with np.errstate(invalid="ignore"):
        return np.asarray(own / own.sum(axis=1, keepdims=True))
