"""Ladder of the stage that gives the friction of rolling bearings."""

from __future__ import annotations

from measuring import Bench, Entry, Rungs, label, percent, rounded, timed, with_ratios

from loadflow.scene import Rolling, Scene
from loadflow.stages import friction

ROLLING = {
    "balls": Rolling(),
    "rollers": Rolling.model_validate({"arrangement": "two-spherical"}),
}
INCLUDES = {
    "balls": "ideal rolling: films, rolling resistance, differential slip, spin",
    "rollers": "films, rolling resistance; spin of every roller followed",
}


def measure_friction(bench: Bench) -> Rungs:
    rungs = {name: _entry(bench, name, section) for name, section in ROLLING.items()}
    return with_ratios(rungs, "rollers")


def _entry(bench: Bench, name: str, section: Rolling) -> Entry:
    scene = bench.scene.model_copy(update={"rolling": section})
    case = bench.middle
    inputs = bench.series[case]
    seconds = timed(lambda: friction.losses(scene, case, inputs), 1)
    coarse, fine = (
        friction.summary({case: friction.losses(_stepped(scene, step), case, inputs)})
        for step in (scene.friction.step, scene.friction.step / 2)
    )
    power = abs(coarse["mean_friction_power"] / fine["mean_friction_power"] - 1).max()
    slip = abs(coarse["mean_slip"] - fine["mean_slip"]).max()
    return {
        "settings": {},
        "includes": [INCLUDES[name], f"loads every {scene.friction.step:g} s"],
        "seconds_per_case": rounded(seconds * 600.0 / bench.setting.full_duration),
        "reference": f"loads every {scene.friction.step / 2:g} s",
        "cases": f"DLC 1.1, {label(case)}",
        "errors": {},
        "error": f"mean friction power ≤ {percent(float(power))}, mean slip ± {float(slip):.1g}",
    }


def _stepped(scene: Scene, step: float) -> Scene:
    chosen = scene.friction.model_copy(update={"step": step})
    return scene.model_copy(update={"friction": chosen})
