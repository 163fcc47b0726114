"""The stages of a run, in the order of the flow. This is the only list of them."""

from __future__ import annotations

from functools import lru_cache

from loadflow.stages import (
    dynamics,
    friction,
    journal,
    loads,
    reduction,
    rolling,
    seeds,
    shaft,
    statistics,
    thrust,
    tolerances,
    wear,
)
from loadflow.stages.stage import Rungs, Stage

STAGES: dict[str, Stage] = {
    module.STAGE.name: module.STAGE
    for module in (
        loads,
        shaft,
        statistics,
        seeds,
        reduction,
        journal,
        thrust,
        dynamics,
        rolling,
        friction,
        wear,
        tolerances,
    )
}


def models() -> dict[str, Rungs]:
    """Models of all stages that stand on rungs, by name."""
    return _models(tuple(STAGES.values()))


@lru_cache(maxsize=8)
def _models(stages: tuple[Stage, ...]) -> dict[str, Rungs]:
    return {rungs.name: rungs for stage in stages for rungs in stage.models}


def giving(result: str) -> Stage:
    """Stage that gives a result."""
    return next(stage for stage in STAGES.values() if result in stage.results)
