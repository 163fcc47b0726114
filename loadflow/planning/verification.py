"""A few cases of the run itself, solved again by the next better models.

The ladder tells the error of a model on its own set of cases, the pilot that of an effect on a few
of the run's; this tells both on others.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.planning.accuracy import error_by_change, surely_small
from loadflow.planning.effects import estimates, switched
from loadflow.quantities import percent
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.stages.comparisons import COMPARED, READ, Difference, compare
from loadflow.stages.journal import FILM as FILM_MODEL
from loadflow.stages.registry import STAGES, models
from loadflow.stages.stage import Stage, always
from loadflow.stages.thrust import RUNGS as PADS_MODEL

WARN = 0.05
"""Relative change above which a run warns, where its scene asks for no accuracy."""


def differences(scene: Scene, cases: list[Case], inputs: Mapping[str, Any]) -> xr.Dataset:
    """Compare what `cases` gave with the next better model of each stage; dimension ``check``.

    Cells have an order, so that a film is off by more than the next finer one moves it, see
    `loadflow.planning.accuracy.error_by_change`.
    """
    found: list[Difference] = []
    for case in cases:
        parts = inputs[case.name]  # read once
        found += compare(scene, case, parts, _sure(scene, case, parts))
    text = ("stage", "result", "quantity", "case", "against")
    return xr.Dataset(
        {
            "difference": (
                "check",
                np.array([_off_by(scene, row) for row in found]),
                {"units": "1", "long_name": "largest relative error, NaN where not solved again"},
            ),
            "allowed": (
                "check",
                np.array([_allowed(scene, row) for row in found]),
                {"units": "1", "long_name": "accuracy asked for; NaN where none is"},
            ),
            "rungs": (
                "check",
                np.array([_rungs(scene, row) for row in found], int),
                {"units": "1", "long_name": "rungs finer that hold it; 0 where not solved on them"},
            ),
        },
        {name: ("check", np.array([getattr(row, name) for row in found], str)) for name in text},
    )


def to_refine(
    tree: xr.DataTree,
    can: Callable[[str], bool],
    rungs: Callable[[str, str, float, float], int],
) -> list[str]:
    """Return the models and effects whose refinement brings an answer nearer to what is asked for.

    They differ by more than that, `can` be refined, and are not outweighed in every such answer by
    what cannot be: a finer grid is no help where the effect of motion, left out, is larger. Each is
    named as often as it takes: by the finer rungs that the check solved, else by what `rungs` says
    of stage, quantity, difference and allowance.
    """
    if "check" not in tree.children:
        return []
    check = tree["check"].to_dataset()
    rows = [
        (str(row.stage.item()), (str(row.result.item()), str(row.quantity.item())), row)
        for row in (check.isel(check=k) for k in range(check.sizes["check"]))
        if row["difference"] > row["allowed"]
    ]
    able = {stage: can(stage) for stage, _, _ in rows}
    fixed: dict[tuple[str, str], float] = {}
    for stage, answer, row in rows:
        if not able[stage]:
            fixed[answer] = max(fixed.get(answer, 0.0), row["difference"].item())
    helps: dict[str, int] = {}
    for stage, answer, row in rows:
        difference, allowed = row["difference"].item(), row["allowed"].item()
        if able[stage] and difference > fixed.get(answer, 0.0):
            up = int(row.get("rungs", 0)) or rungs(stage, answer[1], difference, allowed)
            helps[stage] = max(helps.get(stage, 0), up)
    return [stage for stage, up in helps.items() for _ in range(up)]


def warnings(tree: xr.DataTree) -> list[str]:
    """Return a sentence on each stage and quantity that differs by more than `WARN`.

    Where an accuracy is asked for, `loadflow.planning.shortfalls` says so, before all else.
    """
    if "check" not in tree.children:
        return []
    check = tree["check"].to_dataset()
    check = check.isel(check=np.argsort(-check["difference"].values))
    unasked = check["allowed"].isnull()
    bad = check.isel(check=(unasked & (check["difference"] > WARN)).values)
    worst: dict[tuple[str, str], str] = {}
    for k in range(bad.sizes["check"]):
        row = bad.isel(check=k)
        stage, quantity = str(row["stage"].item()), str(row["quantity"].item())
        worst.setdefault(
            (stage, quantity),
            f"{quantity} is off by {percent(row['difference'].item())} beside "
            f"{row['against'].item()} ({row['case'].item()})",
        )
    found = [f"{stage}: {text}" for (stage, _), text in worst.items()]
    missed = check.isel(check=np.isnan(check["difference"].values))
    if missed.sizes["check"]:
        row = missed.isel(check=0)
        found.append(
            f"{row['stage'].item()}: {row['quantity'].item()} is not checked "
            f"({row['case'].item()}): {row['against'].item()}"
        )
    return found


def _sure(scene: Scene, case: Case, parts: Mapping[str, Any]) -> list[str]:
    """Effects that are out for certain, and are not solved again for what they may change."""
    if not scene.asks:
        return []
    stages = [name for name in STAGES if name in parts]
    known = estimates(scene, stages, (case,))
    able = (one for one in COMPARED.values() if switched(scene, one, True) is not None)
    return [one.name for one in able if surely_small(scene, one, known, alone=True)]


def _off_by(scene: Scene, row: Difference) -> float:
    """Error of an answer by what a better model changes; that of cells falls by their order."""
    if row.stage not in (FILM_MODEL.name, PADS_MODEL.name):
        return row.value
    return error_by_change(scene, row.stage, row.quantity, row.value)


def _rungs(scene: Scene, row: Difference) -> int:
    """How many rungs finer an answer holds the accuracy, by those on which it was solved again.

    One beyond these where none does, as far as they go; 0 where the next one alone was solved.
    """
    if not row.finer:
        return 0
    one, allowed = scene, _allowed(scene, row)
    for up, change in enumerate((row.value, *row.finer)):
        if error_by_change(one, row.stage, row.quantity, change) <= allowed:
            return up
        one = models()[row.stage].finer(one) or one
    return 1 + len(row.finer)


def _allowed(scene: Scene, row: Difference) -> float:
    allowed = scene.allowed(row.result)
    return allowed if np.isfinite(allowed) else np.nan


CHECK = Stage(
    "check",
    run=differences,
    needs=always(*READ),
    scope="run",
    sections=always("accuracy"),
    warnings=warnings,
    sample=3,
    pieces=lambda scene, cases: [[case] for case in cases],
    joined=lambda scene, found: xr.concat(found, "check"),
)
"""The last step of a plan that has a bearing; it reads of `READ` what there is."""
