"""From what a scene wants to the stages that it needs, and nothing else."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any, Literal

from loadflow import __version__
from loadflow.scene import Scene
from loadflow.stages.cases import Case, list_cases


@dataclass(frozen=True)
class Stage:
    """One step of the flow.

    Attributes
    ----------
    name : str
        Name, also of its folder or file in a run.
    needs : tuple of str
        Stages whose results it reads.
    scope : {"case", "run"}
        Whether it runs once for each load case, or once over all of them.
    sections : tuple of str
        Sections of the scene that it depends on.
    function : str
        ``"module:function"``, imported when used.
    unit : str
        What the cost in the ladder counts.
    """

    name: str
    needs: tuple[str, ...]
    scope: Literal["case", "run"]
    sections: tuple[str, ...]
    function: str
    unit: str = "case"


_S = "loadflow.stages"
STAGES = {
    stage.name: stage
    for stage in (
        Stage("loads", (), "case", ("turbine", "loads"), f"{_S}.loads:hub_loads"),
        Stage("shaft", ("loads",), "case", ("shaft", "turbine"), f"{_S}.shaft:bearing_loads"),
        Stage("statistics", ("loads", "shaft"), "case", (), f"{_S}.statistics:statistics"),
        Stage("seeds", ("loads", "shaft"), "run", ("seeds",), f"{_S}.seeds:equality_of_seeds"),
        Stage(
            "reduction", ("loads", "shaft"), "case", ("reduction",), f"{_S}.reduction:reduced_loads"
        ),
        Stage("journal", ("reduction",), "case", ("journal",), f"{_S}.journal:film", "sample"),
        Stage("rolling", ("reduction",), "case", ("rolling",), f"{_S}.rolling:balls", "sample"),
    )
}

GIVEN_BY = {
    "loads.statistics": "statistics",
    "seeds.equality": "seeds",
    "reduction.histogram": "reduction",
    "journal.film": "journal",
    "rolling.loads": "rolling",
    "rolling.life": "rolling",
}
"""Which stage gives a result."""

STEPS_PER_CASE = 24_000
"""Length of a load case in the ladder: 600 s in steps of 0.025 s."""


@dataclass(frozen=True)
class Step:
    """A stage as planned: rung, fingerprint, number of runs, expected cost.

    `seconds` and `error` are None where the ladder holds no measurement. `digest` changes when any
    setting or input that the result depends on changes.
    """

    stage: Stage
    rung: str
    digest: str
    runs: int
    seconds: float | None
    error: str | None


@dataclass(frozen=True)
class Plan:
    """What will run, over which cases, and what was left out and why."""

    steps: tuple[Step, ...]
    cases: tuple[Case, ...]
    left_out: dict[str, str]

    def of_scope(self, scope: str) -> Iterator[Step]:
        """Yield the steps of one scope, in the order of the flow."""
        return (step for step in self.steps if step.stage.scope == scope)


@cache
def ladder() -> dict[str, Any]:
    """Return measured cost and error of every rung, as written by ``benchmarks/ladder.py``."""
    text = files("loadflow").joinpath("data", "ladder.json").read_text(encoding="utf-8")
    return json.loads(text)


def make_plan(scene: Scene) -> Plan:
    """Choose the stages that the wanted results need.

    Parameters
    ----------
    scene : Scene
        What is wanted.

    Returns
    -------
    Plan
        Stages in the order of the flow, load cases, and what was left out.

    Raises
    ------
    loadflow.errors.InputError
        The scene's load files do not exist or cannot be told apart.
    """
    wanted = {GIVEN_BY[result] for result in scene.results}
    needed = set().union(*(_with_needs(name) for name in wanted))
    cases = tuple(list_cases(scene))
    steps: dict[str, Step] = {}
    for name, stage in STAGES.items():
        if name in needed:
            steps[name] = _step(scene, stage, cases, steps)
    left_out = {name: "no wanted result needs it" for name in STAGES if name not in needed}
    if scene.loads.source == "files":
        left_out["wind, rotor"] = "load series are given, nothing is simulated"
    return Plan(tuple(steps.values()), cases, left_out)


def _with_needs(name: str) -> set[str]:
    return {name}.union(*(_with_needs(need) for need in STAGES[name].needs))


def _step(scene: Scene, stage: Stage, cases: tuple[Case, ...], done: dict[str, Step]) -> Step:
    rung = _rung(scene, stage.name)
    parts = [__version__, stage.name]
    parts += [scene.digest(*stage.sections)] if stage.sections else []
    parts += [done[need].digest for need in stage.needs]
    if stage.name == "loads":
        parts += [f"{case.name}:{case.fingerprint}" for case in cases]
    digest = hashlib.sha256("\n".join(parts).encode()).hexdigest()
    runs = 1 if stage.scope == "run" else len(cases)
    known = ladder().get(stage.name, {}).get(rung, {})
    cost = known.get(f"seconds_per_{stage.unit}")
    seconds = None if cost is None else cost * sum(_units(scene, stage, case) for case in cases)
    return Step(stage, rung, digest, runs, seconds, known.get("error"))


def _rung(scene: Scene, stage: str) -> str:
    """Return the model that the scene chooses, by its name in the ladder."""
    if stage == "loads":
        return scene.loads.rung if scene.loads.source == "simulate" else "files"
    return {
        "shaft": "+".join(name for name, _ in scene.shaft if getattr(scene.shaft, name)),
        "seeds": "+".join(sorted(set(scene.seeds.methods))),
        "reduction": f"histogram, {scene.reduction.pick}, {scene.reduction.size:g}",
        "journal": _film_rung(scene),
        "rolling": scene.rolling.rings,
    }.get(stage, "-")


def _film_rung(scene: Scene) -> str:
    around, across = scene.journal.grid
    rung = scene.journal.rung
    return f"grid, {around}x{across}" if rung == "grid" else rung


def _units(scene: Scene, stage: Stage, case: Case) -> float:
    """Return how many units of work one load case holds."""
    if stage.unit == "case":
        return case.steps / STEPS_PER_CASE
    known = ladder().get("reduction", {}).get(_rung(scene, "reduction"), {})
    share = min(1.0, scene.reduction.size * known.get("samples_over_wanted", 1.0))
    bearings = len(scene.journal.bearings) if stage.name == "journal" else 1
    return share * case.steps * bearings
