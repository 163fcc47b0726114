"""From what a scene wants to the stages that it needs, and nothing else."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal

from loadflow import __version__
from loadflow.planning.accuracy import choose, climb
from loadflow.planning.ladder import expected_seconds, measured, rung_of
from loadflow.scene.cases import Case, list_cases
from loadflow.scene.scene import Scene


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
    sample : int, optional
        Number of cases that it looks at, spread over all of them; default all.
    """

    name: str
    needs: tuple[str, ...]
    scope: Literal["case", "run"]
    sections: tuple[str, ...]
    function: str
    sample: int | None = None


_S = "loadflow.stages"
CHECKED = ("loads", "shaft", "reduction", "journal", "rolling")
"""Stages whose models are checked against the next better ones, where they run."""

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
        Stage("journal", ("reduction",), "case", ("journal",), f"{_S}.journal:film"),
        Stage("rolling", ("reduction",), "case", ("rolling", "friction"), f"{_S}.rolling:balls"),
        Stage(
            "friction", ("loads", "shaft"), "case", ("rolling", "friction"), f"{_S}.friction:losses"
        ),
        Stage(
            "check",
            CHECKED,
            "run",
            ("accuracy",),
            "loadflow.planning.verification:differences",
            sample=3,
        ),
    )
}

_FILM_IN_MOTION = replace(
    STAGES["journal"], needs=("loads", "shaft"), function=f"{_S}.journal:orbit"
)
"""It reads the whole series, not the reduced one."""

_ON_BEARINGS = replace(STAGES["shaft"], sections=(*STAGES["shaft"].sections, "journal", "rolling"))
"""The shaft rests on these bearings."""

GIVEN_BY = {
    "loads.statistics": "statistics",
    "seeds.equality": "seeds",
    "reduction.histogram": "reduction",
    "journal.film": "journal",
    "rolling.loads": "rolling",
    "rolling.life": "rolling",
    "rolling.friction": "friction",
}
"""Which stage gives a result."""


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
    """What will run, over which cases, and what was left out and why.

    Attributes
    ----------
    scene : Scene
        As wanted, with the chosen models in it.
    steps : tuple of Step
        In the order of the flow.
    cases : tuple of Case
        Load cases.
    left_out : dict
        Why a stage does not run, by stage, and why an effect is not modelled, by effect.
    reasons : dict
        Why a model was taken, by stage.
    errors : dict
        Expected error of what users read, by result and quantity; None where not measured.
    accurate : bool
        Whether the accuracy that the scene asks for is expected to hold.
    """

    scene: Scene
    steps: tuple[Step, ...]
    cases: tuple[Case, ...]
    left_out: dict[str, str]
    reasons: dict[str, str]
    errors: dict[str, dict[str, float | None]]
    accurate: bool

    def of_scope(self, scope: str) -> Iterator[Step]:
        """Yield the steps of one scope, in the order of the flow."""
        return (step for step in self.steps if step.stage.scope == scope)


def make_plan(scene: Scene, climbed: Iterable[str] = ()) -> Plan:
    """Choose the stages that the wanted results need, and their models.

    Parameters
    ----------
    scene : Scene
        What is wanted.
    climbed : iterable of str
        Stages whose chosen model was found too coarse, once for each better model to take.

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
    stages = STAGES | {"journal": _FILM_IN_MOTION} if scene.journal.in_motion else STAGES
    if scene.shaft.seated:
        stages = stages | {"shaft": _ON_BEARINGS}
    needed = set().union(*(_with_needs(name, stages) for name in wanted))
    cases = tuple(list_cases(scene))
    choice = climb(choose(scene, needed, cases), climbed)
    steps: dict[str, Step] = {}
    for name, stage in stages.items():
        if name in needed:
            steps[name] = _step(choice.scene, stage, cases, steps)
    among = tuple(name for name in CHECKED if name in needed)
    if {"reduction", "journal"} & needed:
        steps["check"] = _step(choice.scene, replace(STAGES["check"], needs=among), cases, steps)
    return Plan(
        choice.scene,
        tuple(steps.values()),
        cases,
        _left_out(choice.scene, needed),
        choice.reasons,
        choice.errors,
        choice.met,
    )


def _left_out(scene: Scene, needed: set[str]) -> dict[str, str]:
    """Why stages, and effects of those that run, are left out."""
    why = {name: "no wanted result needs it" for name in STAGES if name not in {*needed, "check"}}
    if scene.loads.source == "files":
        why["wind, rotor"] = "load series are given, nothing is simulated"
    else:
        why |= _left_out_of_rotor(scene)
    if "journal" in needed:
        if scene.journal.heat is None:
            why["heat of the film"] = "no journal.heat; the run warns where it would matter"
        if not scene.journal.in_motion:
            why["motion of the film"] = (
                'journal.motion = "quasi-static"; the run warns where the orbit differs'
            )
        if not scene.journal.tilt:
            why["tilt of the shaft"] = "no journal.tilt: half the width of the film is solved"
        if scene.journal.shell is None:
            why["elastic shell"] = "no journal.shell"
    if "rolling" in needed and scene.rolling.rings == "rigid":
        why["elastic rings"] = 'rolling.rings = "rigid"'
    return why


def _left_out_of_rotor(scene: Scene) -> dict[str, str]:
    """Why effects of the simulated rotor are left out."""
    loads, why = scene.loads, {}
    if not loads.dynamic_inflow:
        why["dynamic inflow"] = "no loads.dynamic_inflow: induction follows the load at once"
    if not loads.dynamic_stall:
        why["dynamic stall"] = "no loads.dynamic_stall: separation follows lift at once"
    if loads.bend_twist == 0:
        why["turn of blades bent both ways"] = "loads.bend_twist = 0"
    return why


def _with_needs(name: str, stages: dict[str, Stage]) -> set[str]:
    return {name}.union(*(_with_needs(need, stages) for need in stages[name].needs))


def _step(scene: Scene, stage: Stage, cases: tuple[Case, ...], done: dict[str, Step]) -> Step:
    parts = [__version__, stage.name]
    parts += [scene.digest(*stage.sections)] if stage.sections else []
    parts += [done[need].digest for need in stage.needs]
    if stage.name == "loads":
        parts += [f"{case.name}:{case.fingerprint}" for case in cases]
    digest = hashlib.sha256("\n".join(parts).encode()).hexdigest()
    rung, error = _model(scene, stage.name)
    return Step(
        stage,
        rung,
        digest,
        1 if stage.scope == "run" else len(cases),
        expected_seconds(scene, stage.name, cases),
        error,
    )


def _model(scene: Scene, stage: str) -> tuple[str, str | None]:
    """Model of a stage and its error in words; loads may be those in a wind that is made."""
    rung, error = rung_of(scene, stage), (measured(scene, stage) or {}).get("error")
    if stage != "loads" or not scene.loads.makes_wind:
        return rung, error
    wind = (measured(scene, "wind") or {}).get("error")
    both = f"{error}; wind: {wind}" if error and wind else None
    return f"{rung} in {rung_of(scene, 'wind')}", both
