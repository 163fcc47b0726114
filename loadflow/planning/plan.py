"""From what a scene wants to the stages that it needs, and nothing else."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Literal

from loadflow import __version__
from loadflow.planning.accuracy import Errors
from loadflow.planning.choice import AS_GIVEN, Choice, choose, refine
from loadflow.planning.effects import EffectVerdict, concerned, estimates
from loadflow.planning.ladder import expected_seconds, measured
from loadflow.planning.shortfalls import shortfalls
from loadflow.planning.verification import CHECK
from loadflow.quantities import percent
from loadflow.scene.cases import Case, list_cases
from loadflow.scene.scene import Scene
from loadflow.stages.comparisons import OCCASIONS
from loadflow.stages.effects.effect import Sizes
from loadflow.stages.registry import STAGES, giving
from loadflow.stages.stage import Rungs, Stage

LITTLE = 0.02
"""Share of the time of a run that an effect may take to be kept unasked: to ask takes longer."""


def stage_named(name: str) -> Stage:
    """Return a stage of the flow, or the check of its models."""
    return CHECK if name == CHECK.name else STAGES[name]


@dataclass(frozen=True)
class Step:
    """A stage as planned.

    Attributes
    ----------
    name : str
        Of the stage.
    needs : tuple of str
        Stages whose results it reads in this plan.
    rung : str
        Models of the stage, as the ladder calls them.
    digest : str
        Changes when any setting or input changes that the result depends on.
    runs : int
        How often it runs.
    seconds : float, optional
        Expected time on one core, s; None where not measured.
    error : str, optional
        Error of its rung in words, effects that are left out aside; None where not measured.
    """

    name: str
    needs: tuple[str, ...]
    rung: str
    digest: str
    runs: int
    seconds: float | None
    error: str | None

    @property
    def stage(self) -> Stage:
        """The stage itself."""
        return stage_named(self.name)


@dataclass(frozen=True)
class EffectInPlan:
    """An effect as planned: whether it is kept, and what leaving it out changes.

    `size` is what a pilot measured, None without one; `indicator` the closed-form estimate; both by
    quantity, the largest share by which an answer changes. `why` says why it is out or in.
    """

    name: str
    kept: bool
    size: Sizes | None
    indicator: Sizes
    why: str


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
        Why a model was taken, by section of the scene.
    errors : dict
        Expected error of what users read, by result and quantity, effects that are left out
        counted; None where not measured.
    accurate : bool
        Whether the accuracy that the scene asks for is expected to hold.
    effects : tuple of EffectInPlan
        All effects that the stages could have.
    shortfalls : tuple of str
        For each result that is not expected to be accurate enough: how far off, why, what helps.
    overloaded : tuple of str
        Rolling bearings that cannot carry the estimated loads, in words.
    """

    scene: Scene
    steps: tuple[Step, ...]
    cases: tuple[Case, ...]
    left_out: dict[str, str]
    reasons: dict[str, str]
    errors: Errors
    accurate: bool
    effects: tuple[EffectInPlan, ...] = ()
    shortfalls: tuple[str, ...] = field(default=())
    overloaded: tuple[str, ...] = field(default=())

    def of_scope(self, scope: Literal["case", "run"]) -> Iterator[Step]:
        """Yield the steps of one scope, in the order of the flow."""
        return (step for step in self.steps if step.stage.scope == scope)


def make_plan(
    scene: Scene,
    refined: Iterable[str] = (),
    verdict: EffectVerdict | None = None,
) -> Plan:
    """Choose the stages that the wanted results need, and their models.

    Parameters
    ----------
    scene : Scene
        What is wanted.
    refined : iterable of str
        Models and effects that were found too coarse or missing, once for each better one to take.
    verdict : EffectVerdict, optional
        What a pilot of this scene measured; without it the indicators of the effects count.

    Returns
    -------
    Plan
        Stages in the order of the flow, load cases, and what was left out.

    Raises
    ------
    loadflow.errors.InputError
        The scene's load files do not exist or cannot be told apart.
    """
    cases = tuple(list_cases(scene))
    return plan_of(scene, chosen_models(scene, cases, refined, verdict), cases)


def plan_of(scene: Scene, choice: Choice, cases: tuple[Case, ...]) -> Plan:
    """Return the plan of models that are chosen already; else as `make_plan`."""
    needed = needed_stages(choice.scene)
    steps: dict[str, Step] = {}
    for name, stage in STAGES.items():
        if name in needed:
            steps[name] = _step(choice.scene, stage, stage.needs(choice.scene), cases, steps)
    if needed & {*OCCASIONS}:
        among = tuple(name for name in CHECK.needs(scene) if name in needed)
        steps[CHECK.name] = _step(choice.scene, CHECK, among, cases, steps)
    effects = tuple(_effects(scene, choice, needed))
    return Plan(
        choice.scene,
        tuple(steps.values()),
        cases,
        _left_out(choice.scene, scene, needed),
        choice.reasons,
        choice.errors,
        choice.met,
        effects,
        tuple(shortfalls(scene, choice)) if scene.asks else (),
        choice.estimates.overloaded,
    )


def chosen_models(
    scene: Scene,
    cases: tuple[Case, ...],
    refined: Iterable[str] = (),
    verdict: EffectVerdict | None = None,
    solving: bool = True,
) -> Choice:
    """Return the models of a plan, the rest of it aside.

    Not `solving`: indicators that solve films say nothing, and their effects count for nothing, as
    is expected before a pilot measures them.
    """
    stages = needed_stages(scene)
    known = estimates(scene, _in_order(stages), cases, verdict, solving)
    return refine(choose(scene, _in_order(stages), cases, known), refined)


def needed_stages(scene: Scene) -> set[str]:
    """Names of all stages that the wanted results need."""
    found: set[str] = set()
    todo = [giving(result).name for result in scene.results]
    todo += [name for name, stage in STAGES.items() if stage.asked(scene)]
    while todo:
        name = todo.pop()
        if name not in found:
            found.add(name)
            todo += STAGES[name].needs(scene)
    return found


def _in_order(names: set[str]) -> list[str]:
    return [name for name in STAGES if name in names]


def _effects(wanted: Scene, choice: Choice, needed: set[str]) -> Iterator[EffectInPlan]:
    verdict = choice.estimates.verdict
    for effect in concerned(wanted, _in_order(needed)):
        kept = effect.is_on(choice.scene)
        if not wanted.asks or not effect.is_open(wanted):
            why = AS_GIVEN
        elif refused := choice.estimates.refused(effect):
            why = refused
        elif not kept and effect.switched(wanted, True) is None:
            why = f"it would need {effect.needs}"
        elif kept and choice.estimates.is_doubtful(choice.scene, effect):
            why = "its indicator is no bound, and no pilot measured it"
        else:
            little = f"it takes {percent(LITTLE)} of the time or less"
            why = f"the accuracy asks for it, or {little}" if kept else "small enough"
        yield EffectInPlan(
            effect.name,
            kept,
            verdict.sizes.get(effect.name) if verdict else None,
            choice.estimates.indicators.get(effect.name, {}),
            why,
        )


def _left_out(scene: Scene, wanted: Scene, needed: set[str]) -> dict[str, str]:
    """Why stages, and effects of those that run, are left out of what was `wanted`."""
    why = {name: "no wanted result needs it" for name in STAGES if name not in needed}
    for name in _in_order(needed):
        why |= STAGES[name].left_out(scene)
    off = (one for one in concerned(wanted, _in_order(needed)) if not one.is_on(scene))
    return why | {effect.name: effect.out for effect in off}


def _step(
    scene: Scene,
    stage: Stage,
    needs: tuple[str, ...],
    cases: tuple[Case, ...],
    done: dict[str, Step],
) -> Step:
    sections = stage.sections(scene)
    parts = [__version__, stage.name]
    parts += [scene.digest(*sections)] if sections else []
    parts += [done[need].digest for need in needs]
    if not needs:
        parts += [f"{case.name}:{case.fingerprint}" for case in cases]
    return Step(
        stage.name,
        needs,
        " in ".join(rungs.text_of(scene) for rungs in reversed(_worth_naming(stage, scene))) or "-",
        hashlib.sha256("\n".join(parts).encode()).hexdigest(),
        1 if stage.scope == "run" else len(cases),
        expected_seconds(scene, stage.name, cases),
        _error(scene, stage),
    )


def _told(scene: Scene, rungs: Rungs) -> str | None:
    """Error of a rung in words; of one that differs by an effect, that with the effect."""
    key = rungs.error_key(scene) if rungs.error_key else rungs.key(scene)
    error = (measured(scene, rungs.name, key) or {}).get("error")
    if error is None or key == rungs.key(scene):
        return error
    return f"{error}, as {key}; what it leaves out is among the effects"


def _worth_naming(stage: Stage, scene: Scene) -> list[Rungs]:
    """Models of a stage: its own, and the others where there is something to choose."""
    return [one for one in stage.models if one is stage.models[-1] or not one.exact(scene)]


def _error(scene: Scene, stage: Stage) -> str | None:
    """Errors of the stage's rungs in words, as answers count them; None if one is not known."""
    found = [(rungs, _told(scene, rungs)) for rungs in _worth_naming(stage, scene)]
    if not found or not all(error for _, error in found):
        return None
    own, *others = reversed(found)
    return "; ".join([str(own[1]), *(f"{rungs.name}: {error}" for rungs, error in others)])
