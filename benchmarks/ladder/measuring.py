"""What the measurements of the ladder share: cases, series, errors, times."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
import xarray as xr

from benchmarks.common import ROOT
from loadflow.quantities import percent as written_out
from loadflow.scene.bearings import Rolling
from loadflow.scene.cases import Case, list_cases
from loadflow.scene.loads import Loads
from loadflow.scene.scene import Scene, read_scene
from loadflow.stages import loads, shaft
from loadflow.stages.frames import to_film
from loadflow.stages.registry import models
from loadflow.stages.stage import with_settings

SCENE = ROOT / "pipelines" / "dlc_1_1.toml"

Entry = dict[str, Any]
Rungs = dict[str, Entry]


@dataclass(frozen=True)
class Setting:
    """What is measured on: the cases, and how fine the reference is."""

    wind_speeds: tuple[float, ...] = (4.0, 8.0, 12.0, 18.0, 24.0)
    seeds: int = 2
    duration: float = 200.0
    full_duration: float = 600.0
    sommerfeld: tuple[float, ...] = (0.5, 1.0, 2.0, 5.0, 10.0)
    speeds: tuple[float, ...] = (0.6, 1.267)
    finest: tuple[int, int] = (480, 160)
    sizes: tuple[float, ...] = (0.05, 0.1, 0.2)
    picks: int = 10
    repeat: int = 2
    window: int = 400


QUICK = Setting(
    (4.0, 12.0, 24.0), 1, 60.0, 120.0, (1.0, 10.0), (1.267,), (240, 80), (0.1,), 2, 1, 100
)


@dataclass
class Errors:
    """Deviations of quantities, each under the name of its case."""

    found: dict[str, dict[str, float]] = field(default_factory=lambda: defaultdict(dict))

    def add(
        self, quantity: str, case: str, value: Any, reference: Any, scale: float | None = None
    ) -> None:
        """Add |value − reference| over |reference|, or over `scale`; of a matrix, its norm."""
        size = float(np.linalg.norm(reference)) if scale is None else scale
        off = float(np.linalg.norm(np.subtract(value, reference)))
        self.found[quantity][case] = off / size

    def summary(self) -> dict[str, dict[str, Any]]:
        """Largest and 95 % quantile of each quantity, and the case that is worst."""
        return {
            quantity: {
                "max": rounded(max(values.values())),
                "p95": rounded(float(np.quantile(list(values.values()), 0.95))),
                "worst": max(values, key=values.__getitem__),
            }
            for quantity, values in self.found.items()
        }


def rung_key(scene: Scene, model: str, **settings: Any) -> str:
    """Name of a rung in the ladder, as the plan looks it up."""
    rungs = models()[model]
    chosen = with_settings(scene, rungs.section, settings) if settings else scene
    if chosen is None:
        raise ValueError(f"{model}: no scene can ask for {settings}")
    return rungs.key(chosen)


def rounded(value: float) -> float:
    return float(f"{value:.2e}")


def percent(share: float) -> str:
    """A share in two figures, as plain as they go."""
    if share < 1e-5:
        return f"{share:.0e}" if share else "0"
    return written_out(share)


def sentence(errors: dict[str, dict[str, Any]], *quantities: str) -> str:
    """The largest errors in a few words, for `plan`."""
    return ", ".join(f"{name} ≤ {percent(errors[name]['max'])}" for name in quantities)


def with_ratios(rungs: Rungs, top: str) -> Rungs:
    """Add the time relative to the rung `top`, and which rungs another one makes needless."""
    for entry in rungs.values():
        entry["relative_time"] = rounded(_cost(entry) / _cost(rungs[top]))
    return with_dominated(rungs)


def with_dominated(rungs: Rungs) -> Rungs:
    """Mark a rung that is dearer than another one and nowhere more accurate.

    One that a plan may choose is measured against its like only.
    """
    measured = {name: entry for name, entry in rungs.items() if entry["errors"]}
    for entry in measured.values():
        better = [
            name
            for name, other in measured.items()
            if other["relative_time"] < entry["relative_time"]
            and ("settings" in other or "settings" not in entry)
            and all(
                q in other["errors"] and other["errors"][q]["max"] <= e["max"]
                for q, e in entry["errors"].items()
            )
        ]
        if better:
            entry["dominated_by"] = better[0]
    return rungs


TEN_CASES = 20_000
"""Samples over which the curve of a collar, made once, counts in the relative time of a rung."""


def _cost(entry: Entry) -> float:
    once = float(entry.get("seconds_once", {}).get("curve", 0.0)) / TEN_CASES
    return float(entry.get("seconds_per_case") or entry["seconds_per_sample"]) + once


@dataclass(frozen=True)
class Bench:
    """Scene, cases and series of one run of the benchmark."""

    setting: Setting

    @cached_property
    def scene(self) -> Scene:
        """The pipeline of DLC 1.1 on the cheapest rotor, one seed, full length."""
        return self.with_loads(
            wind_speeds=list(self.setting.wind_speeds),
            seeds=1,
            duration=self.setting.full_duration,
            rung="tables",
        )

    def with_loads(self, **keys: Any) -> Scene:
        # the ladder's rolling bearing is the ball ring, whose rings have rungs
        scene = read_scene(SCENE).model_copy(update={"rolling": Rolling()})
        chosen = Loads.model_validate(scene.loads.model_dump() | keys)
        return scene.model_copy(update={"loads": chosen})

    @cached_property
    def series(self) -> dict[Case, dict[str, xr.Dataset]]:
        """What the stages loads and shaft give."""
        return {case: inputs(self.scene, case) for case in list_cases(self.scene)}

    @property
    def middle(self) -> Case:
        """A case amid the range, to take times on."""
        return list(self.series)[len(self.series) // 2]


def inputs(scene: Scene, case: Case) -> dict[str, xr.Dataset]:
    found = {"loads": loads.hub_loads(scene, case, {})}
    return found | {"shaft": shaft.bearing_loads(scene, case, found)}


def label(case: Case) -> str:
    return f"{case.wind_speed:g} m/s, seed {case.seed}"


def on_cases(bench: Bench) -> str:
    speeds = ", ".join(f"{v:g}" for v in bench.setting.wind_speeds)
    return f"DLC 1.1 of the NREL 5 MW turbine, {speeds} m/s"


def radial_loads(bearings: xr.Dataset) -> dict[str, np.ndarray]:
    """Radial force of N and N2, tilting moment of M; in the plane of the film."""
    variables = {"N": "force", "N2": "force", "M": "moment"}
    return {
        name: to_film(
            bearings[variable].sel(bearing=name).transpose("time", "axis").values.astype(float)
        )
        for name, variable in variables.items()
    }
