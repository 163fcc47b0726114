"""Ladder of the stage that gives the friction of rolling bearings."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from benchmarks.common import seconds_of
from benchmarks.ladder.measuring import (
    SCENE,
    Bench,
    Entry,
    Errors,
    Rungs,
    label,
    on_cases,
    rounded,
    rung_key,
    sentence,
    with_ratios,
)
from loadflow.planning.asked import ABSOLUTE
from loadflow.scene.cases import Case
from loadflow.scene.scene import Rolling, Scene, read_scene
from loadflow.stages import friction
from loadflow.stages.probes import FRICTION

KINDS = ("balls", "rollers")
INCLUDES = {
    "balls": "ideal rolling: films, rolling resistance, differential slip, spin",
    "rollers": "films, rolling resistance, differential slip; spin of rollers followed",
}
SETTINGS: dict[str, list[dict[str, Any]]] = {
    "balls": [{"step": step} for step in (0.1, 0.2, 0.4, 0.8)],
    "rollers": [
        {"step": step, "follow_every": every}
        for step, every in ((0.1, 1), (0.2, 1), (0.4, 1), (0.8, 1), (0.2, 4), (0.4, 4), (0.4, 12))
    ],
}
"""From the finest on."""

FINEST = {"step": 0.05, "follow_every": 1}

Inputs = dict[str, xr.Dataset]


def measure_friction(bench: Bench) -> Rungs:
    """Errors of mean losses, films, slip by the step of the loads and the rollers followed."""
    rungs: Rungs = {}
    for kind, rows in SETTINGS.items():
        found = [Errors() for _ in rows]
        for scene in _scenes(bench, kind):
            for case, parts in bench.series.items():
                part = window(parts, bench.setting.duration)
                best = solve(scene, FINEST, case, part)
                for errors, row in zip(found, rows):
                    compare(errors, label(case), solve(scene, row, case, part), best)
        of_kind = {
            rung_key(scene, "friction", **row): _entry(bench, kind, row, errors)
            for errors, row in zip(found, rows)
        }
        rungs |= with_ratios(of_kind, next(iter(of_kind)))  # other bearings are no other model
    return rungs


def _scenes(bench: Bench, kind: str) -> Iterator[Scene]:
    """The scene with each bearing of a kind; the tapered rollers are those of the main job."""
    sections = {
        "balls": [Rolling()],
        "rollers": [
            Rolling.model_validate({"arrangement": "two-spherical"}),
            read_scene(SCENE).rolling,
        ],
    }
    for section in sections[kind]:
        yield bench.scene.model_copy(update={"rolling": section})


def _entry(bench: Bench, kind: str, settings: dict[str, Any], errors: Errors) -> Entry:
    case = bench.middle
    part = window(bench.series[case], bench.setting.duration)
    seconds = max(
        seconds_of(lambda s=scene: solve(s, settings, case, part), 1)  # type: ignore[misc]
        for scene in _scenes(bench, kind)
    )
    found = errors.summary()
    every = settings.get("follow_every", 1)
    followed = f", 1 in {every}" if every > 1 else ""
    return {
        "settings": settings,
        "includes": [INCLUDES[kind] + followed, f"loads every {settings['step']:g} s"],
        "seconds_per_case": rounded(seconds * 600.0 / bench.setting.duration),
        "reference": f"loads every {FINEST['step']:g} s, every roller",
        "cases": (
            f"{on_cases(bench)}; 1 seed, {bench.setting.duration:g} s; balls: the bearing of the "
            "default scene, rollers: two spherical ones, the tapered ones of the main job"
        ),
        "errors": found,
        "error": sentence(found, "friction power", "film parameter", "slip", "slip power density"),
    }


def window(parts: Inputs, duration: float) -> Inputs:
    """The first part of a series."""
    step = float(parts["loads"]["time"][1] - parts["loads"]["time"][0])
    return {name: part.isel(time=slice(round(duration / step))) for name, part in parts.items()}


def solve(scene: Scene, settings: dict[str, Any], case: Case, inputs: Inputs) -> xr.Dataset:
    """What the stage says of a case, with these settings of the friction."""
    chosen = scene.friction.model_copy(update=settings)
    stepped = scene.model_copy(update={"friction": chosen})
    return friction.summary({case: friction.losses(stepped, case, inputs)})


READ = FRICTION | {"slip power density": "largest_slip_power_density"}
"""What the errors of friction are told of, and what its summary calls that."""


def compare(errors: Errors, where: str, answer: xr.Dataset, reference: xr.Dataset) -> None:
    """Add the deviations of one case; of shares such as slip they are absolute."""
    for name in reference["bearing"].values:
        ours, best = (data.sel(bearing=name).squeeze() for data in (answer, reference))
        place = f"{where}, {name}"
        for quantity, key in READ.items():
            scale = 1.0 if quantity in ABSOLUTE else None
            errors.add(quantity, place, float(ours[key]), float(best[key]), scale)


def friction_gains(bench: Bench, step: float) -> dict[str, float]:
    """Largest d ln(answer)/d ln(load) of all kinds of bearings; of the slip, d slip/d ln(load)."""
    found: dict[str, list[float]] = {"friction power": [], "film parameter": [], "slip": []}
    for scene in (one for kind in KINDS for one in _scenes(bench, kind)):
        for case, parts in bench.series.items():
            part = window(parts, bench.setting.duration / 4)
            more, less = (
                solve(scene, {}, case, part | {"shaft": part["shaft"] * ratio})
                for ratio in (step**0.5, step**-0.5)
            )
            for quantity, key in (
                ("friction power", "mean_friction_power"),
                ("film parameter", "median_film_parameter"),
            ):
                found[quantity].append(float(abs(np.log(more[key] / less[key])).max()))
            found["slip"].append(float(abs(more["mean_slip"] - less["mean_slip"]).max()))
    return {name: rounded(max(values) / float(np.log(step))) for name, values in found.items()}
