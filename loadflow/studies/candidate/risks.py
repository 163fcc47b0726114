"""What wears bearings out beside fatigue: contact of films, light loads, thin films, standing."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube.hdf5 import read_variables
from loadflow.quantities import percent
from loadflow.scene.scene import Scene
from loadflow.scene.wear import check_wear
from loadflow.stages.films.turning import SLOWEST, runs_throughout
from loadflow.stages.frames import to_rolling
from loadflow.stages.rolling import bearing_at_work
from loadflow.stages.rolling_at_work import rest
from loadflow.stages.wear import counts_of
from loadflow.studies.candidate.factor import reduced_samples
from loadflow.studies.candidate.result import STARTS_ALONE, Number
from loadflow.studies.seeds.intervals import Groups, interval

WORN_SHARE = 0.1
"""Of the radial clearance that may wear off; assumed."""

LIGHT = {"ball": 0.01, "roller": 0.02}
"""Smallest load over the dynamic capacity at which elements roll without skidding: the rule of
thumb of bearing catalogues."""

BRIEF = 0.05
"""Share of the time that may pass below it, as the rule is one of steady running; assumed. A load
that turns about the shaft passes through the middle of a bearing now and then."""

THINNEST = 0.1
"""Smallest viscosity ratio κ that ISO 281 covers."""


def wear(
    scene: Scene, bores: Mapping[str, xr.Dataset], table: xr.Dataset, groups: Groups
) -> Number:
    """Deepest wear of the shells over the life, of the result ``journal.wear``, µm.

    Its interval takes the depth as proportional to what asperities rub off in all load cases
    together, their friction energy, of which other seeds have more or less.

    Parameters
    ----------
    scene : Scene
        What was run; ``[wear]`` says by which law, and how often a start happens.
    bores : mapping
        Of the stage ``wear``, by bearing; empty where the run has none.
    table : xarray.Dataset
        Films of the run over ``case``.
    groups : Groups
        Cases that differ by their seed alone.
    """
    if not bores:
        return Number(math.nan, "µm", note=f"n/a: {_unworn(scene)}")
    place = max(bores, key=lambda name: _depth(bores[name]) / _worn_limit(scene, name))
    data, limit = bores[place], _worn_limit(scene, place)
    depth = _depth(data)
    law = scene.wear.law
    note = f"{law}; {events(scene, table)}; limit: a tenth of the radial clearance, assumed"
    if depth == 0:
        note += "; no load case of this run touches while it turns"
        return Number(0.0, "µm", limit=1e6 * limit, holds=True, place=place, note=note)
    energy = (data["contact_energy"] * data["count"]).mean("renewal").values
    produces, count = data["production"].values.astype(bool), data["count"].values
    running = float(energy[produces].sum() / energy.sum())
    if running < 1:
        each = 1e9 * depth * (1 - running) / float(count[~produces].sum())
        note += f"; {each:.3g} nm each on average"
    note += f"; {percent(running)} of the friction energy that wears is of power production"
    rubbed = np.zeros(table.sizes["case"])
    cases = table["case"].values.tolist()
    np.add.at(rubbed, [cases.index(name) for name in data["case"].values.tolist()], energy)
    low, high = interval(groups, lambda some: 1e6 * depth * rubbed[some].sum() / rubbed.sum())
    return Number(
        1e6 * depth, "µm", low, high, limit=1e6 * limit, holds=bool(depth <= limit),
        case=cases[int(np.argmax(rubbed))], place=place, note=note,
    )  # fmt: skip


def events(scene: Scene, table: xr.Dataset) -> str:
    """How often the starts, stops and faults of a run happen in the life, in words.

    Parameters
    ----------
    scene : Scene
        What was run.
    table : xarray.Dataset
        Any result over ``case``, with `dlc`.
    """
    counts = sorted(counts_of(scene, table["dlc"].values.tolist()).items())
    told = (f"{number:,.0f} of DLC {dlc}" for dlc, number in counts)
    return f"{', '.join(told)} in the life" if counts else "no start, stop or fault in this run"


def _depth(bore: xr.Dataset) -> float:
    return float(bore["depth_of_bore"].max()) if bore.attrs["cycles"] else 0.0


def _worn_limit(scene: Scene, place: str) -> float:
    return WORN_SHARE * scene.journal.at(place).geometry.clearance


def _unworn(scene: Scene) -> str:
    """Why a run has no worn bores."""
    try:
        check_wear(scene.wear, scene.journal, scene.shaft)
    except ValueError as error:
        return str(error)
    return "the run was not asked for journal.wear"


def rolling_risks(
    scene: Scene, folder: Path, table: xr.Dataset, share: np.ndarray
) -> Iterator[tuple[str, Number]]:
    """Yield load, smallest viscosity ratio, and standstill of rolling bearings.

    Load and κ are those of load cases in which the shaft runs throughout: any bearing that starts
    or stops has a κ of 0 at first, which rules of running do not mean.
    """
    groups, runs = Groups.of(table), runs_throughout(table)
    if not runs.any():
        for name, unit in (("minimum_load", "%"), ("viscosity_ratio", "–")):
            yield name, Number(math.nan, unit, note=f"n/a: {STARTS_ALONE}")
        yield "standstill", _standing(scene, folder, table, share)
        return
    yield "minimum_load", _lightest(scene, folder, table, share, groups)
    ratio = table["bearing_viscosity_ratio"].transpose("case", "bearing").values.astype(float)
    ratio[~runs] = math.nan
    if np.isfinite(ratio).any():
        k, b = np.unravel_index(int(np.nanargmin(ratio)), ratio.shape)
        low, high = interval(groups, lambda some: float(np.nanmin(ratio[some])))
        case, place = str(table["case"].values[k]), str(table["bearing"].values[b])
        yield "viscosity_ratio", Number(
            float(ratio[k, b]), "–", low, high, limit=THINNEST, holds=bool(ratio[k, b] >= THINNEST),
            case=case, time=_slowest(reduced_samples(folder / "reduction" / f"{case}.h5", place)),
            place=place,
            note=f"oil as warm as {_oil(scene, place)}; full films begin at 1",
        )  # fmt: skip
    yield "standstill", _standing(scene, folder, table, share)


def _oil(scene: Scene, place: str) -> str:
    cooled = scene.friction.conductance_of(scene.rolling.bearings[place]) is not None
    return "its heat balance has it" if cooled else "stated"


def _slowest(samples: xr.Dataset) -> float:
    """Time of the slowest sample that turns, s: at one temperature κ is smallest there."""
    speed = np.abs(samples["speed"].values)
    turns = speed * samples["weight"].values > 0
    return float(samples["time"].values[np.argmin(np.where(turns, speed, np.inf))])


def _lightest(
    scene: Scene, folder: Path, table: xr.Dataset, share: np.ndarray, groups: Groups
) -> Number:
    """Equivalent load over the capacity that is exceeded for nearly all of the time that turns."""
    cases = table["case"].values.tolist()
    runs = runs_throughout(table)
    share = np.where(runs, share, 0.0)
    share = share if share.any() else runs / runs.sum()  # of extremes alone
    found: dict[str, dict[int, tuple[np.ndarray, np.ndarray, np.ndarray]]] = {}
    for place, case, some in _samples(scene, folder, [cases[k] for k in np.flatnonzero(share)]):
        k, weight = cases.index(case), some["weight"].values
        turning = np.abs(some["speed"].values) >= SLOWEST
        if weight[turning].any():
            load = _equilibrium(scene, place, some).equivalent_load[turning]
            load = load / scene.rolling.geometries[place].rated_capacity
            told = share[k] * weight[turning] / weight.sum(), some["time"].values[turning]
            found.setdefault(place, {})[k] = load, *told
    if not found:
        return Number(math.nan, "%", note="the shaft does not turn")

    def over_limit(place: str, asked: Iterable[int]) -> float:
        there = [found[place][k] for k in asked if k in found[place]]
        if not there:  # of seeds drawn anew, those whose shaft stands alone
            return math.nan
        loads, weights = (np.concatenate([one[k] for one in there]) for k in (0, 1))
        return mostly_exceeded(loads, weights) / _limit(scene, place)

    place = min(found, key=lambda name: over_limit(name, found[name]))
    limit, ratio = _limit(scene, place), over_limit(place, found[place])
    those = found[place]
    light = sum(float(weight[load < limit].sum()) for load, weight, _ in those.values())
    total = sum(float(weight.sum()) for _, weight, _ in those.values())
    k = min(those, key=lambda one: float(those[one][0].min()))
    load, _, time = those[k]
    least = int(np.argmin(load))
    low, high = interval(groups, lambda some: 100 * limit * over_limit(place, some.tolist()))
    return Number(
        100 * limit * ratio, "%", low, high,
        limit=100 * limit, holds=ratio >= 1, case=cases[k], time=float(time[least]),
        place=place, note=f"of C; below the limit in {percent(light / total)} of that time, "
        f"{percent(float(load[least]))} at least",
    )  # fmt: skip


def _limit(scene: Scene, place: str) -> float:
    return LIGHT[scene.rolling.geometries[place].element]


def mostly_exceeded(values: np.ndarray, weights: np.ndarray) -> float:
    """The value below which there is `BRIEF` of all weight, which counts as passing.

    Parameters
    ----------
    values, weights : array (n,)
        Any order; weights of the same unit, not all 0.
    """
    order = np.argsort(values)
    reached = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(reached, BRIEF * reached[-1])])


def spread_over(values: np.ndarray, weights: np.ndarray, count: int) -> np.ndarray:
    """Places of the values in the middle of `count` parts of equal weight, in rising order.

    They tell the quantiles of all values; as many spread over time miss those by chance.

    Parameters
    ----------
    values, weights : array (n,)
        Any order; weights of the same unit, not all 0. A value that weighs more than a part is
        there several times.
    count : int
        Of parts.

    Returns
    -------
    ndarray of int, shape (count,)
        Places in `values`.

    Examples
    --------
    >>> spread_over(np.array([3.0, 1.0, 2.0]), np.array([2.0, 1.0, 1.0]), 4).tolist()
    [1, 2, 0, 0]
    """
    order = np.argsort(values, kind="stable")
    reached = np.cumsum(weights[order])
    middles = (np.arange(count) + 0.5) / count * reached[-1]
    return np.asarray(order[np.searchsorted(reached, middles)])


def _standing(scene: Scene, folder: Path, table: xr.Dataset, share: np.ndarray) -> Number:
    """Share of the lifetime in which the shaft stands, and the largest pressure meanwhile.

    Its error is that of what counts as standing: a tenth, and ten times, of that speed.
    """
    counted, worst = np.zeros((3, table.sizes["case"])), (0.0, "", "", math.nan)
    cases = table["case"].values.tolist()
    for k, case in enumerate(cases):
        speed = np.abs(read_variables(folder / "loads" / f"{case}.h5", ("speed",))["speed"].values)
        counted[:, k] = [(speed < factor * SLOWEST).mean() for factor in (1.0, *_THRESHOLDS)]
    stands = counted[0]
    for place, case, some in _samples(scene, folder, cases):
        still = np.abs(some["speed"].values) < SLOWEST
        if still.any():
            pressure = _equilibrium(scene, place, some).maximum_pressure
            k = int(np.argmax(np.where(still, pressure, -np.inf)))
            if pressure[k] > worst[0]:
                worst = float(pressure[k]), place, case, float(some["time"].values[k])
    pressure, place, case, time = worst
    told = f"largest contact pressure meanwhile {1e-6 * pressure:.0f} MPa" if case else ""
    if not stands.any():
        told = (
            "no load case of this run stands: marks of standing are not judged; starts and stops "
            "are DLC 3.1 and 4.1 of loads.dlc"
        )
    else:
        counts = "± with a tenth, and ten times, of the 0.01 1/min below which it stands"
        told = "; ".join(filter(None, (told, events(scene, table), counts)))
    value, *others = 100 * (counted * share).sum(axis=1)
    low, high = interval(
        Groups.of(table),
        lambda some: 100 * float((stands[some] * share[some]).sum() / share[some].sum()),
    )
    apart = max(abs(other - value) for other in others)
    return Number(
        float(value),
        "%",
        low,
        high,
        float(apart / value) if value else math.nan,
        case=case,
        time=time,
        place=place,
        note=told,
    )


def _samples(
    scene: Scene, folder: Path, cases: Sequence[str]
) -> Iterator[tuple[str, str, xr.Dataset]]:
    """Yield place, case and reduced samples of all rolling bearings that turn with the rotor.

    They are spread over the loads of the case, each for an equal share of its time; the least and
    the most loaded, and the slowest, are there besides, with no weight.
    """
    for place, part in scene.rolling.bearings.items():
        if part.oscillation is not None:
            continue
        for path in sorted((folder / "reduction").glob("*.h5")):
            if path.stem not in cases:
                continue
            samples = reduced_samples(path, place)
            force, moment = (
                to_rolling(samples[name].transpose("sample", "axis").values)
                for name in ("force", "moment")
            )
            size, speed = np.linalg.norm(force, axis=1), np.abs(samples["speed"].values)
            ends = [int(np.argmin(size)), int(np.argmin(speed)), int(np.argmax(size))]
            lever = scene.rolling.geometries[place].pitch_diameter / 2
            load = size + np.linalg.norm(moment[:, :2], axis=1) / lever
            time = samples["weight"].values.astype(float)
            parts = np.bincount(spread_over(load, time, _SPREAD), minlength=load.size)
            picked = np.union1d(np.flatnonzero(parts), ends)
            shared = samples["weight"].copy(data=time.sum() / _SPREAD * parts)
            yield place, path.stem, samples.assign(weight=shared).isel(sample=picked)


_SPREAD = 48
_THRESHOLDS = 0.1, 10.0  # of `SLOWEST`


def _equilibrium(scene: Scene, place: str, some: xr.Dataset) -> Any:
    force, moment = (
        some[name].transpose("sample", "axis").values.astype(float) for name in ("force", "moment")
    )
    speed = some["speed"].values
    return rest(bearing_at_work(scene, place, some), force, moment, speed, strict=False)
