"""A few cases of the run itself, solved again by the next better models.

The ladder tells the error of a model on its own set of cases; this tells it on the user's.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import xarray as xr

from loadflow.accuracy import finer
from loadflow.ladder import rung_of
from loadflow.reduction import damage_equivalent_load
from loadflow.scene import Journal, Scene
from loadflow.stages.cases import Case
from loadflow.stages.frames import to_film
from loadflow.stages.journal import equilibria, shaft_line
from loadflow.stages.loads import hub_loads
from loadflow.stages.shaft import bearing_loads
from loadflow.stages.statistics import SLOPE

FILM = ("eccentricity_ratio", "minimum_film", "maximum_pressure", "friction_power")
SAMPLES = 5
"""Samples of a case's film that are solved again, from the smallest eccentricity to the largest."""

WARN = 0.05
"""Relative change above which a run warns, where its scene asks for no accuracy."""

HEAT_CAPACITY = 2000.0  # J/(kg K), mineral oil
THINNING = 0.035  # 1/K, relative loss of viscosity of a mineral oil of VG 100 … 320 near 50 °C


@dataclass(frozen=True)
class Difference:
    """How much an answer moves when a model is replaced by a better one.

    `result` is what the answer belongs to, `value` the relative change at its largest.
    """

    stage: str
    result: str
    quantity: str
    case: str
    against: str
    value: float


def differences(scene: Scene, cases: list[Case], inputs: Mapping[str, Any]) -> xr.Dataset:
    """Compare what `cases` gave with the next better model of each stage; dimension ``check``."""
    found = [row for case in cases for row in _of_case(scene, case, inputs[case.name])]
    text = ("stage", "result", "quantity", "case", "against")
    return xr.Dataset(
        {
            "difference": (
                "check",
                np.array([row.value for row in found]),
                {"units": "1", "long_name": "largest relative change against the better model"},
            ),
            "allowed": (
                "check",
                np.array([_allowed(scene, row) for row in found]),
                {"units": "1", "long_name": "accuracy asked for; NaN where none is"},
            ),
        },
        {name: ("check", np.array([getattr(row, name) for row in found], str)) for name in text},
    )


def exceeded(tree: xr.DataTree) -> list[str]:
    """Return the stages that differ from the better model by more than the accuracy asked for."""
    if "check" not in tree.children:
        return []
    check = tree["check"].to_dataset()
    stages = check["stage"].values[(check["difference"] > check["allowed"]).values]
    return list(dict.fromkeys(map(str, stages)))


def warnings(tree: xr.DataTree) -> list[str]:
    """Return a sentence on each stage and quantity that differs by more than is allowed."""
    if "check" not in tree.children:
        return []
    check = tree["check"].to_dataset()
    check = check.isel(check=np.argsort(-check["difference"].values))
    bad = check.isel(check=(check["difference"] > check["allowed"].fillna(WARN)).values)
    worst: dict[tuple[str, str], str] = {}
    for k in range(bad.sizes["check"]):
        row = bad.isel(check=k)
        stage, quantity = str(row["stage"].item()), str(row["quantity"].item())
        worst.setdefault(
            (stage, quantity),
            f"{quantity} moves by {100 * row['difference'].item():.2g} % with "
            f"{row['against'].item()} ({row['case'].item()})",
        )
    return [f"{stage}: {text}" for (stage, _), text in worst.items()]


def _allowed(scene: Scene, row: Difference) -> float:
    allowed = scene.allowed_error(row.result)
    return np.nan if allowed is None else allowed


def _of_case(scene: Scene, case: Case, parts: Mapping[str, Any]) -> Iterator[Difference]:
    if scene.journal.motion == "transient":  # what follows compares equilibria
        parts = {name: part for name, part in parts.items() if name != "journal"}
    yield from _loads(scene, case, parts)
    yield from _reduction(scene, case, parts)
    if "journal" in parts:
        yield from _film(scene, case, parts)


def _loads(scene: Scene, case: Case, parts: Mapping[str, Any]) -> Iterator[Difference]:
    better = finer(scene, "loads")
    if better is None:
        return
    series = hub_loads(better, case, {})
    sharp = bearing_loads(better, case, {"loads": series})
    for bearing in sharp["bearing"].values:
        ours, theirs = (_describe(data, bearing) for data in (parts["shaft"], sharp))
        for quantity in ours:
            yield Difference(
                "loads",
                "loads.statistics",
                quantity,
                f"{case.name}, {bearing}",
                f"the rotor {better.loads.rung}",
                _relative(ours[quantity], theirs[quantity]),
            )


def _describe(bearings: xr.Dataset, bearing: str) -> dict[str, float]:
    """Return largest load and damage of what governs a bearing: radial force or tilting moment."""
    load, time = _governing(bearings, bearing), bearings["time"].values
    duration = float(time[-1] - time[0])
    sideways, upright = (damage_equivalent_load(track, SLOPE, duration) for track in load.T)
    return {
        "bearing load max": float(np.hypot(*load.T).max()),
        "bearing force DEL": float(np.hypot(sideways, upright)),
    }


def _governing(bearings: xr.Dataset, bearing: str) -> np.ndarray:
    """Radial force (time, 2), or the tilting moment of a bearing that takes one."""
    data = bearings.sel(bearing=bearing)
    moment = data["moment"].transpose("time", "axis").values.astype(float)
    force = data["force"].transpose("time", "axis").values.astype(float)
    return to_film(moment if np.any(moment[:, 1:]) else force)


def _reduction(scene: Scene, case: Case, parts: Mapping[str, Any]) -> Iterator[Difference]:
    for bearing, node in parts["reduction"].children.items():
        load = np.hypot(*_governing(parts["shaft"], bearing).T)
        where, index = f"{case.name}, {bearing}", node["index"].values
        yield Difference(
            "reduction",
            "reduction.histogram",
            "largest load",
            where,
            "the full series",
            _relative(load[index].max(), load.max()),
        )
        if "journal" in parts and bearing in scene.journal.bearings:
            film = parts["journal"][bearing].to_dataset()
            yield Difference(
                "reduction",
                "journal.film",
                "eccentricity ratio",
                where,
                "the full series",
                _severest(scene.journal, bearing, load, parts, film),
            )


def _severest(
    options: Journal, bearing: str, load: np.ndarray, parts: Mapping[str, Any], film: xr.Dataset
) -> float:
    """Compare the largest ε with that at the largest load per speed of the full series."""
    speed = parts["loads"]["speed"].values.astype(float)
    turning = np.abs(speed) >= np.abs(film["speed"].values[film["converged"].values > 0]).min()
    worst = int(np.argmax(np.where(turning, load / np.maximum(np.abs(speed), 1e-12), 0.0)))
    at = parts["shaft"].sel(bearing=bearing).isel(time=[worst])
    force = at["force"].transpose("time", "axis").values.astype(float)
    line = shaft_line(options, at)
    answer = equilibria(options, force, speed[worst : worst + 1], **line)
    return _relative(
        float(film["eccentricity_ratio"].max()), float(np.max(answer.eccentricity_ratio))
    )


def _film(scene: Scene, case: Case, parts: Mapping[str, Any]) -> Iterator[Difference]:
    better = finer(scene, "journal")
    for bearing in scene.journal.bearings:
        film = parts["journal"][bearing].to_dataset().load()
        places = _spread(film["eccentricity_ratio"].values)
        some = film.isel(sample=places)
        loads = parts["reduction"][bearing].to_dataset().isel(sample=places)
        line = shaft_line(scene.journal, loads)
        against = {"oil warmed by its friction": _warmer(scene.journal, some)}
        if better is not None:
            against[f"the film {rung_of(better, 'journal')}"] = better.journal
        for name, options in against.items():
            answer = equilibria(options, loads["force"].values, some["speed"].values, **line)
            stage = "heat" if name == "oil warmed by its friction" else "journal"
            for quantity in FILM:
                ours, theirs = some[quantity].values, getattr(answer, quantity)
                yield Difference(
                    stage,
                    "journal.film",
                    quantity.replace("_", " "),
                    f"{case.name}, {bearing}",
                    name,
                    _relative(ours, theirs),
                )


def _spread(values: np.ndarray) -> np.ndarray:
    """Places of `SAMPLES` finite values, from the smallest to the largest in even steps of rank."""
    order = np.argsort(values)[: np.isfinite(values).sum()]
    return np.unique(order[np.linspace(0, order.size - 1, SAMPLES).round().astype(int)])


def _warmer(options: Journal, film: xr.Dataset) -> Journal:
    """The bearing with the oil as warm as the mean friction makes it, if the side flow takes all.

    ΔT = P/(ρ c Q) of the energy balance, and the viscosity that is left after it.
    """
    oil = options.lubricant
    carried = oil.density * HEAT_CAPACITY * float(film["side_flow"].mean())
    warming = float(film["friction_power"].mean()) / carried if carried > 0 else 0.0
    thinner = replace(oil, viscosity=oil.viscosity * float(np.exp(-THINNING * warming)))
    return options.model_copy(update={"lubricant": thinner})


def _relative(ours: Any, theirs: Any) -> float:
    """Largest relative change; infinite where only one of the two has an answer."""
    ours, theirs = np.atleast_1d(ours).astype(float), np.atleast_1d(theirs).astype(float)
    known = np.isfinite(ours) & np.isfinite(theirs)
    if not np.array_equal(np.isfinite(ours), known) or not np.array_equal(
        np.isfinite(theirs), known
    ):
        return float("inf")
    scale = np.where(theirs[known] != 0, np.abs(theirs[known]), 1.0)
    return float(np.max(np.abs(ours[known] - theirs[known]) / scale, initial=0.0))
