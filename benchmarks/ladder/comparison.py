"""Ladder of what a comparison says of rolling bearings from few samples, and as if rollers rolled.

`loadflow compare` takes friction, films and loads of rolling bearings in some forty samples of a
load case, in ideal rolling. Here it runs on the candidates of a turbine, and what it says is held
against every bearing followed through the whole series.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import xarray as xr

from benchmarks.common import timed
from benchmarks.ladder.measuring import (
    Bench,
    Entry,
    Errors,
    Rungs,
    inputs,
    label,
    on_cases,
    rounded,
    sentence,
)
from loadflow.cube.hdf5 import read_whole
from loadflow.rolling.rating.modified_life import viscosity_ratio
from loadflow.running.candidates import SHAPED_CLASSES, candidates_for
from loadflow.running.comparison import Means, run_candidates, shared_loads
from loadflow.running.folder import part_file
from loadflow.scene.bearings import Rolling
from loadflow.scene.cases import Case, list_cases
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.scene.thrust import AnyAxial, Thrust
from loadflow.stages import friction, thrust
from loadflow.stages.frames import to_rolling
from loadflow.studies.candidate.friction import OWN_TORQUE, Losses, rolling_losses
from loadflow.studies.candidate.margins import load_by_row, lubrication, row_shares, solved
from loadflow.studies.candidate.numbers import Finished
from loadflow.studies.candidate.risks import LIGHT, mostly_exceeded, rolling_risks

CANDIDATES = {
    "rollers": ("two-spherical", "cylindrical-tapered", "tapered-pair", "double-row-tapered"),
    "balls": ("four-point",),
}
PADS = {"collar": "journal-thrust", "cones": "conical-pair"}
HARD, SPREAD = 15, 40  # samples of cones of a case: the hardest, and others
EVERY = 4  # samples of 0.025 s: what the friction of rollers is followed by
SLOW = 0.1  # share of the samples that counts as low speed
MEASURED = ("friction power", "film parameter", "smallest load")

Parts = dict[Case, dict[str, xr.Dataset]]


def measure_comparison(bench: Bench) -> Rungs:
    """Errors of what a comparison says of rolling bearings, by kind of their elements."""
    base = _scene(bench)
    with TemporaryDirectory() as below:
        how = Means()
        loads = shared_loads(base, below, how)
        chosen = {name: None for names in CANDIDATES.values() for name in names}
        known = candidates_for(base)[0]
        finished, failures = run_candidates(
            loads, {name: known[name] for name in chosen}, Path(below) / "candidates", how
        )
        if failures:
            raise RuntimeError(f"candidates without an answer: {failures}")
        runs = {run.name: run for run in finished}
        rolling = {
            kind: _entry(bench, [runs[name] for name in names])
            for kind, names in CANDIDATES.items()
        }
    return rolling | measure_pads(bench)


def measure_pads(bench: Bench) -> Rungs:
    """Errors of films of pads by the few samples that a comparison solves them in."""
    return {kind: _of_pads(bench, name) for kind, name in PADS.items()}


def _of_pads(bench: Bench, name: str) -> Entry:
    base, errors = _scene(bench), Errors()
    section = candidates_for(base)[0][name].thrust
    steps = round(bench.setting.duration / base.loads.step)
    fewer = {"size": min(1.0, SHAPED_CLASSES**2 / steps), "classes": SHAPED_CLASSES}
    reduction = base.reduction.model_copy(update=fewer)
    scene = base.model_copy(update={"thrust": section, "reduction": reduction})
    [(place, bearing)] = scene.thrust.bearings.items()
    rung = "curve" if bearing.kind == "thrust" else "grid"
    ours = theirs = seconds = 0.0
    cases = [*list_cases(scene)]
    for case in cases:
        parts = inputs(scene, case)
        few = thrust.samples_of(scene, case, bearing, place, parts)
        many = _hardest_and_spread(bearing, _samples(parts, place))
        if rung == "curve":
            many = _samples(parts, place)
        best = thrust.solved(bearing, place, many, rung)
        found, spent = timed(partial(thrust.solved, bearing, place, few, rung), warm=True)
        seconds += spent
        ours, theirs = ours + few.sizes["sample"], theirs + parts["loads"].sizes["time"]
        for quantity, value in _told(found).items():
            errors.add(quantity, label(case), value, _told(best)[quantity])
    summed = errors.summary()
    reference = f"every sample, every {0.025 * EVERY:g} s"
    if rung == "grid":
        most = f"the {HARD} most pressed, and the {HARD} most pressed for their speed"
        reference = f"{most}; losses of {SPREAD} spread over the series"
    return {
        "includes": ["films at rest", f"some {SHAPED_CLASSES**2} samples of a case"],
        "relative_time": rounded(ours / theirs),
        "seconds_per_case": rounded(seconds / len(cases) * 600.0 / bench.setting.duration),
        "reference": reference,
        "cases": f"{on_cases(bench)}; 1 seed, {bench.setting.duration:g} s; the sized {name}",
        "errors": summed,
        "error": sentence(summed, *summed),
    }


def _told(films: xr.Dataset) -> dict[str, float]:
    """Smallest film, largest pressure and mean losses."""
    lost, weight = films["friction_power"].values, films["weight"].values
    known = np.isfinite(lost)
    return {
        "minimum film": float(films["minimum_film"].min()),
        "maximum pressure": float(films["maximum_pressure"].max()),
        "friction power": float(np.average(lost[known], weights=weight[known])),
    }


def _hardest_and_spread(bearing: AnyAxial, series: xr.Dataset) -> xr.Dataset:
    """Samples with the thinnest films and largest pressures among them; losses of the spread."""
    force, moment = (to_rolling(series[name].values) for name in ("force", "moment"))
    pressed = bearing.normal_load(force, moment)
    slow = pressed / np.maximum(np.abs(series["speed"].values), 1e-9)
    spread = np.linspace(0, pressed.size - 1, SPREAD).round().astype(int)
    hard = {*np.argsort(pressed)[-HARD:].tolist(), *np.argsort(slow)[-HARD:].tolist()}
    kept = sorted(hard | {*spread.tolist()})
    weight = np.isin(kept, spread).astype(float)
    return series.isel(sample=kept).assign(weight=("sample", weight))


def _scene(bench: Bench) -> Scene:
    scene = bench.with_loads(
        wind_speeds=list(bench.setting.wind_speeds),
        seeds=1,
        duration=bench.setting.duration,
        rung="tables",
    )
    update = {"journal": Journal(), "rolling": Rolling(), "thrust": Thrust()}
    found = scene.model_copy(update=update | {"results": ["loads.statistics"]})
    found.model_fields_set.difference_update(update)
    return found


def _entry(bench: Bench, runs: list[Finished]) -> Entry:
    errors, ours, theirs = Errors(), 0.0, 0.0
    for run in runs:
        series, table = _series(run), _table(run)
        few, seconds = timed(partial(rolling_losses, run.scene, run.folder, table), warm=True)
        assert few is not None
        ours += seconds / len(series)
        followed, seconds = timed(partial(_followed, run, series), warm=True)
        theirs += seconds / len(series)
        _compare(errors, run, series, table, few, followed)
    found = errors.summary()
    count, scale = len(runs), 600.0 / bench.setting.duration
    return {
        "includes": ["ideal rolling, without slip of rollers", "some 40 samples of a case"],
        "seconds_per_case": rounded(scale * ours / count),
        "relative_time": rounded(ours / theirs),
        "reference": f"rolling bearings followed through the series, loads every {0.025 * EVERY} s",
        "cases": (
            f"{on_cases(bench)}; 1 seed, {bench.setting.duration:g} s; the sized candidates "
            f"{', '.join(run.name for run in runs)}; losses by case, the others of all cases"
        ),
        "errors": found,
        "error": sentence(found, *(name for name in MEASURED if name in found)),
    }


def _series(run: Finished) -> Parts:
    """Loads and shaft of each case."""
    return {
        case: {name: read_whole(part_file(run.folder, name, case)) for name in ("loads", "shaft")}
        for case in list_cases(run.scene)
    }


def _table(run: Finished) -> xr.Dataset:
    """What the run says of its rolling bearings."""
    return read_whole(run.folder / "result.h5")["rolling"].to_dataset()


def _followed(run: Finished, series: Parts) -> dict[Case, xr.Dataset]:
    """Every bearing through the whole series."""
    options = run.scene.friction.model_copy(update={"step": 0.025 * EVERY})
    scene = run.scene.model_copy(update={"friction": options})
    return {case: friction.losses(scene, case, parts) for case, parts in series.items()}


def _compare(
    errors: Errors,
    run: Finished,
    series: Parts,
    table: xr.Dataset,
    few: Losses,
    followed: Mapping[Case, xr.Dataset],
) -> None:
    whole = friction.summary(followed).sum("bearing", skipna=False)
    for case in series:
        place, at = f"{run.name}, {label(case)}", {"case": case.name}
        ours, best = few.power.sel(at).sum(), whole["mean_friction_power"].sel(at)
        errors.add("friction power", place, float(ours), float(best))
        for name, torque in few.torques.items():
            best, own = whole[f"mean_{name}"].sel(at), name == OWN_TORQUE
            told = "friction torque" if own else "catalogue torque"
            of = place if own else f"{place}, {name}"
            errors.add(told, of, float(torque.sel(at).sum()), float(best))
    thin = min(_thin_at_low_speed(followed).values())
    errors.add("film parameter", run.name, few.film_parameter, thin)
    share = np.full(table.sizes["case"], 1 / table.sizes["case"])
    said = dict(rolling_risks(run.scene, run.folder, table, share))
    best = _whole(run, series, table)
    for key, name in (("viscosity_ratio", "viscosity ratio"), ("minimum_load", "smallest load")):
        limit = said[key].limit if key == "minimum_load" else 1.0
        errors.add(name, run.name, said[key].value / limit, best[name])
    rows = row_shares(run.scene, run.folder, {"rolling": table})
    if rows is not None:
        errors.add("row share", run.name, rows.share, best["row share"])


def _thin_at_low_speed(followed: Mapping[Case, xr.Dataset]) -> dict[str, float]:
    """Median of the least Λ of each bearing in its slowest tenth of samples."""
    speed = np.abs(np.concatenate([one["speed"].values for one in followed.values()]))
    films = np.concatenate([one["film_parameter"].values for one in followed.values()], axis=1)
    slow = (speed > 0) & (speed <= np.quantile(speed[speed > 0], SLOW))
    places = next(iter(followed.values()))["bearing"].values.tolist()
    return {
        place: float(np.median(own[slow & np.isfinite(own)])) for place, own in zip(places, films)
    }


def _whole(run: Finished, series: Parts, table: xr.Dataset) -> dict[str, float]:
    """Smallest κ, load over its limit that is mostly exceeded, share of the row with the thrust."""
    ratio, light, rows = math.inf, math.inf, (0.0, math.nan)
    for place, bearing in run.scene.rolling.geometries.items():
        loads: list[np.ndarray] = []
        for case, parts in series.items():
            some = _samples(parts, place)
            speed = some["speed"].values
            turning = speed != 0
            warm = table["bearing_temperature"].sel(case=case.name, bearing=place).item()
            oil = replace(lubrication(run.scene.friction), temperature=warm)
            kappa = viscosity_ratio(oil, speed[turning], bearing.pitch_diameter)
            ratio = min(ratio, float(kappa.min()))
            answer: Any = solved(run.scene, place, some)
            loads.append(answer.equivalent_load[turning] / bearing.rated_capacity)
            if bearing.group_dims[0] == "row" and bearing.groups[0] > 1 and bearing.takes_thrust:
                thrust = np.abs(some["force"].sel(axis="x").values)
                k = int(np.argmax(thrust))
                rows = max(rows, (float(thrust[k]), float(load_by_row(bearing, answer)[k].max())))
        every = np.concatenate(loads)
        least = mostly_exceeded(every, np.ones_like(every)) / LIGHT[bearing.element]
        light = min(light, least)
    return {"viscosity ratio": ratio, "smallest load": light, "row share": rows[1]}


def _samples(parts: Mapping[str, xr.Dataset], place: str) -> xr.Dataset:
    """The series at a bearing as samples, every `EVERY` of them."""
    shaft = parts["shaft"].sel(bearing=place).isel(time=slice(None, None, EVERY))
    speed = parts["loads"]["speed"].values[::EVERY].astype(float)
    vectors = {
        name: (("sample", "axis"), shaft[name].transpose("time", "axis").values.astype(float))
        for name in ("force", "moment")
    }
    lines = {"time": shaft["time"].values, "speed": speed, "weight": np.ones_like(speed)}
    of_samples = {name: ("sample", values) for name, values in lines.items()}
    return xr.Dataset(vectors | of_samples, {"axis": shaft["axis"].values})
