"""Ladder of the film in motion: windows of the turbine's series around their largest load."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from benchmarks.common import seconds_of
from benchmarks.ladder.bearings import ALIGNED, BY_NAME
from benchmarks.ladder.measuring import (
    Bench,
    Errors,
    Rungs,
    label,
    on_cases,
    radial_loads,
    rounded,
    rung_key,
    sentence,
    with_ratios,
)
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene

CHOSEN: list[dict[str, Any]] = [
    {"rung": "reduced", "grid": (60, 20), "step": 0.05},
    {"rung": "reduced", "grid": (60, 20)},
    {"rung": "reduced", "grid": (120, 20)},
    {"rung": "reduced", "grid": (240, 20)},
    {"rung": "reduced", "grid": (480, 20)},
    {"rung": "grid", "grid": (60, 20)},
    {"rung": "grid", "grid": (120, 40)},
    {"rung": "map", "grid": (60, 20)},
]
MODELS = {
    rung_key(Scene(name="film"), "journal", motion="transient", **keys): keys for keys in CHOSEN
}
INCLUDES = {"map": "squeeze; fill steady in the frame that turns with the eccentricity"}
REFERENCE: dict[str, Any] = {"rung": "reduced"}
FINEST = 480  # cells around of the reference; of rungs with half as many and more, twice that
STEPS = {"map": 4000, "reduced": 4000, "grid": 40}  # to take times on


def measure_orbit(bench: Bench) -> Rungs:
    options = bench.scene.journal
    windows = dict(_windows(bench, bench.setting.window))
    finest = {
        cells: {
            where: solve(options, *series, **REFERENCE | {"grid": (cells, 20)})
            for where, series in windows.items()
        }
        for cells in (FINEST // 2, FINEST, 2 * FINEST)
    }
    about = {cells: _about(finest, cells) for cells in (FINEST, 2 * FINEST)}
    length = next(iter(windows.values()))[0].size
    rungs: Rungs = {}
    for name, keys in MODELS.items():
        errors, cells = Errors(), FINEST
        if keys["rung"] == "reduced" and keys["grid"][0] >= FINEST // 2:
            cells = 2 * FINEST
        for where, series in windows.items():
            compare(errors, where, solve(options, *series, **keys), finest[cells][where])
        found = errors.summary()
        rungs[name] = {
            **({} if name in BY_NAME else {"settings": keys}),
            "includes": [INCLUDES.get(name, "squeeze and history of the fill"), ALIGNED],
            "seconds_per_sample": rounded(_seconds(bench, keys)),
            "reference": about[cells],
            "cases": (
                f"{on_cases(bench)}; 1 seed, bearings N and N2, {length} steps of 0.025 s around "
                "the largest load of each"
            ),
            "errors": found,
            "error": sentence(
                found, "eccentricity ratio", "minimum film", "maximum pressure", "friction power"
            ),
        }
    return with_ratios(rungs, "grid, 120x40")


def _about(finest: dict[int, dict[str, xr.Dataset]], cells: int) -> str:
    """What a reference of so many cells around is, and how far it moves from half of them."""
    doubt = Errors()
    for where, reference in finest[cells].items():
        compare(doubt, where, finest[cells // 2][where], reference)
    return (
        f"the rung reduced on {cells} cells around, every sample; against {cells // 2} it moves by "
        + sentence(doubt.summary(), "eccentricity ratio", "maximum pressure", "friction power")
        + "; how far finer cells across agree with it shows at grid, 120x40"
    )


def _windows(bench: Bench, steps: int) -> Iterator[tuple[str, tuple[np.ndarray, ...]]]:
    for case, parts in bench.series.items():
        time = parts["loads"]["time"].values.astype(float)
        speed = parts["loads"]["speed"].values.astype(float)
        for bearing in ("N", "N2"):
            force = radial_loads(parts["shaft"])[bearing]
            peak = int(np.hypot(*force.T).argmax())
            begin = min(max(0, peak - 3 * steps // 4), time.size - steps)
            part = slice(begin, begin + steps)
            yield f"{label(case)}, {bearing}", (time[part], force[part], speed[part])


def solve(
    options: Journal, time: np.ndarray, force: np.ndarray, speed: np.ndarray, **keys: Any
) -> xr.Dataset:
    """Orbit with the options of a scene, but for `keys`."""
    film = {name: value for name, value in keys.items() if name != "step"}
    taken = options.model_copy(update={"step": keys.get("step")})
    every = slice(None, None, taken.every(float(time[1] - time[0])))
    return options.geometry.orbit(
        time[every], force[every], speed[every], replace(options.film_model, **film)
    )


def compare(errors: Errors, where: str, answer: xr.Dataset, reference: xr.Dataset) -> None:
    """Add the deviations of one window."""
    for name, quantity in (
        ("eccentricity ratio", lambda o: o["eccentricity_ratio"].max()),
        ("minimum film", lambda o: o["minimum_film"].min()),
        ("maximum pressure", lambda o: o["maximum_pressure"].max()),
        ("friction power", lambda o: o["friction_power"].mean()),
        ("side flow", lambda o: o["side_flow"].mean()),
    ):
        errors.add(name, where, float(quantity(answer)), float(quantity(reference)))


def _seconds(bench: Bench, keys: dict[str, Any]) -> float:
    """Seconds of one step, in the middle of a series."""
    parts = bench.series[bench.middle]
    steps = slice(0, STEPS[keys["rung"]])
    time = parts["loads"]["time"].values.astype(float)[steps]
    speed = parts["loads"]["speed"].values.astype(float)[steps]
    force = radial_loads(parts["shaft"])["N"][steps]
    options = bench.scene.journal
    taken = solve(options, time, force, speed, **keys).sizes["time"]
    return (
        seconds_of(lambda: solve(options, time, force, speed, **keys), bench.setting.repeat) / taken
    )
