"""Ladder of the stage that gives the friction of rolling bearings."""

from __future__ import annotations

import numpy as np
import xarray as xr

from benchmarks.common import seconds_of
from benchmarks.ladder.measuring import (
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
from loadflow.scene.cases import Case
from loadflow.scene.scene import Rolling, Scene
from loadflow.stages import friction

ROLLING = {
    "balls": Rolling(),
    "rollers": Rolling.model_validate({"arrangement": "two-spherical"}),
}
INCLUDES = {
    "balls": "ideal rolling: films, rolling resistance, differential slip, spin",
    "rollers": "films, rolling resistance, differential slip; spin of every roller followed",
}
STEPS = (0.1, 0.2, 0.4)
FINEST = 0.05

Inputs = dict[str, xr.Dataset]


def measure_friction(bench: Bench) -> Rungs:
    """Errors of mean losses, films and slip by the step of the loads."""
    rungs: Rungs = {}
    for kind, section in ROLLING.items():
        scene = bench.scene.model_copy(update={"rolling": section})
        windows = {
            case: window(parts, bench.setting.duration) for case, parts in bench.series.items()
        }
        answers = {
            step: {case: solve(scene, step, case, parts) for case, parts in windows.items()}
            for step in (*STEPS, FINEST)
        }
        of_kind = {}
        for step in STEPS:
            errors = Errors()
            for case in windows:
                compare(errors, label(case), answers[step][case], answers[FINEST][case])
            key = rung_key(scene, "friction", step=step)
            of_kind[key] = _entry(bench, kind, scene, step, errors)
        rungs |= with_ratios(of_kind, next(iter(of_kind)))  # other bearings are no other model
    return rungs


def _entry(bench: Bench, kind: str, scene: Scene, step: float, errors: Errors) -> Entry:
    case = bench.middle
    part = window(bench.series[case], bench.setting.duration)
    seconds = seconds_of(lambda: solve(scene, step, case, part), 1)
    found = errors.summary()
    return {
        "includes": [INCLUDES[kind], f"loads every {step:g} s"],
        "seconds_per_case": rounded(seconds * 600.0 / bench.setting.duration),
        "reference": f"loads every {FINEST:g} s",
        "cases": (
            f"{on_cases(bench)}; 1 seed, {bench.setting.duration:g} s; balls: the bearing of the "
            "default scene, rollers: two spherical ones"
        ),
        "errors": found,
        "error": sentence(found, "friction power", "film parameter", "slip"),
    }


def window(parts: Inputs, duration: float) -> Inputs:
    """The first part of a series."""
    step = float(parts["loads"]["time"][1] - parts["loads"]["time"][0])
    return {name: part.isel(time=slice(round(duration / step))) for name, part in parts.items()}


def solve(scene: Scene, step: float, case: Case, inputs: Inputs) -> xr.Dataset:
    """What the stage says of a case, with the loads taken every `step`, s."""
    chosen = scene.friction.model_copy(update={"step": step})
    stepped = scene.model_copy(update={"friction": chosen})
    return friction.summary({case: friction.losses(stepped, case, inputs)})


def compare(errors: Errors, where: str, answer: xr.Dataset, reference: xr.Dataset) -> None:
    """Add the deviations of one case; the slip's, a share itself, are absolute."""
    for name in reference["bearing"].values:
        ours, best = (data.sel(bearing=name).squeeze() for data in (answer, reference))
        place = f"{where}, {name}"
        for quantity, key, scale in (
            ("friction power", "mean_friction_power", None),
            ("film parameter", "median_film_parameter", None),
            ("slip", "mean_slip", 1.0),
        ):
            errors.add(quantity, place, float(ours[key]), float(best[key]), scale)


def friction_gains(bench: Bench, step: float) -> dict[str, float]:
    """Largest d ln(answer)/d ln(load) of all kinds of bearings; of the slip, d slip/d ln(load)."""
    found: dict[str, list[float]] = {"friction power": [], "film parameter": [], "slip": []}
    for section in ROLLING.values():
        scene = bench.scene.model_copy(update={"rolling": section})
        for case, parts in bench.series.items():
            part = window(parts, bench.setting.duration / 4)
            more, less = (
                solve(scene, STEPS[0], case, part | {"shaft": part["shaft"] * ratio})
                for ratio in (step**0.5, step**-0.5)
            )
            for quantity, key in (
                ("friction power", "mean_friction_power"),
                ("film parameter", "median_film_parameter"),
            ):
                found[quantity].append(float(abs(np.log(more[key] / less[key])).max()))
            found["slip"].append(float(abs(more["mean_slip"] - less["mean_slip"]).max()))
    return {name: rounded(max(values) / float(np.log(step))) for name, values in found.items()}
