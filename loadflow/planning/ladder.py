"""What each model costs and how far it is off: the measured ladder, and a scene's place on it.

``python -m benchmarks.ladder`` writes ``loadflow/data/ladder.json``: for each table and rung the
processor time per unit of work, and the error of what users read against a stated reference. What
a rung is called, the stages say themselves.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from loadflow.data import gains, ladder
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.stages.effects.registry import EFFECTS, effects_of
from loadflow.stages.registry import STAGES, models
from loadflow.stages.stage import STEPS_PER_CASE, Measured, Rungs, Stage

__all__ = ["STEPS_PER_CASE", "expected_seconds", "gains", "ladder", "measured"]


def measured(scene: Scene, model: str, key: str | None = None) -> dict[str, Any] | None:
    """Return what the ladder holds of a rung, None if it was not measured.

    Parameters
    ----------
    scene : Scene
        The rung is that of this scene.
    model : str
        Name of the model.
    key : str, optional
        The rung itself, in the scene's table.
    """
    rungs = models().get(model)
    if rungs is None:
        return None
    return rungs_of(scene, rungs).get(rungs.key(scene) if key is None else key)


def rungs_of(scene: Scene, rungs: Rungs) -> dict[str, Any]:
    """All measured rungs of a model, by name."""
    found: dict[str, Any] = ladder().get(rungs.table_of(scene), {})
    return found


def expected_seconds(scene: Scene, stage: str, cases: Iterable[Case]) -> float | None:
    """Processor time that a stage takes over `cases`, s; None if its rung was not measured."""
    one = STAGES.get(stage)
    known = measured(scene, stage)
    if one is None or known is None:
        return None
    cases = tuple(cases)
    work, more = one.work(scene, cases, measured), one.more_seconds(scene, _with_effects(one))
    if work is None or more is None:
        return None
    each = known["seconds_per_case"] + more if "seconds_per_case" in known else _per_sample(known)
    return each * work * cost_of_effects(scene, one) + one.once(scene, measured)


def _per_sample(known: dict[str, Any]) -> float:
    return float(known["seconds_per_sample"])


def cost_of_effects(scene: Scene, stage: Stage) -> float:
    """Time of a stage over that without the effects whose cost its rungs do not tell.

    Those of a model that is another stage's own are in its `Stage.more_seconds`.
    """
    return _cost(scene, stage, {rungs.name for rungs in stage.models} - _others(stage))


def _others(stage: Stage) -> set[str]:
    """Models that are another stage's own: the last of each."""
    return {one.models[-1].name for one in STAGES.values() if one.models and one is not stage}


def _cost(scene: Scene, stage: Stage, models: set[str]) -> float:
    on = [one for one in effects_of(stage, scene) if one.model in models and one.is_on(scene)]
    return math.prod(one.cost(scene) for one in on)


def _with_effects(stage: Stage) -> Measured:
    """`measured`, which of a model that is another stage's own tells the time with its effects.

    That is so of the rung that a scene has; one that is named is told without effects.
    """

    def found(scene: Scene, model: str, key: str | None = None) -> dict[str, Any] | None:
        known = measured(scene, model, key)
        if known is None or key is not None or model not in _others(stage):
            return known
        factor = _cost(scene, stage, {model})
        return known | {"seconds_per_sample": factor * _per_sample(known)}

    return found


def choices(scene: Scene, rungs: Rungs) -> list[Scene]:
    """Return the scene with each rung that it leaves open for a model; itself alone if none is.

    A rung is open where the scene names none of its settings. Rungs that another one makes
    needless, or that a scene cannot ask for, are passed over.
    """
    if rungs.exact(scene):
        return [scene]
    section = getattr(scene, rungs.section)
    decided = {key for effect in EFFECTS for key in effect.keys}
    entries = rungs_of(scene, rungs).values()
    useful = [e["settings"] for e in entries if "settings" in e and "dominated_by" not in e]
    opened = [
        settings
        for settings in useful
        if not section.model_fields_set & set(settings)
        and not any(f"{rungs.section}.{key}" in decided for key in settings)
    ]
    found = [rungs.with_settings(scene, settings) for settings in opened]
    return [one for one in found if one is not None] or [scene]
