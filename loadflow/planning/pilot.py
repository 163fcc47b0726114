"""The pilot of a run: how large is each effect, on a few samples of a few of its own cases.

The cases are those of the largest estimated loads. Each is solved on a short stretch with all
effects that can be on, then with one of them out at a time. A case is measured as a whole wherever
that is, so that the verdict does not depend on how many processes there are.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, TypeVar

from threadpoolctl import threadpool_limits

from loadflow.errors import SolverError
from loadflow.planning.accuracy import contributions, surely_small
from loadflow.planning.asked import Asked, changes, lying_shaft, resting, tried, without
from loadflow.planning.choice import Choice
from loadflow.planning.effects import EffectVerdict, Estimates, concerned, estimates, switched
from loadflow.planning.ladder import expected_seconds
from loadflow.planning.plan import LITTLE, chosen_models, needed_stages
from loadflow.scene.cases import Case, list_cases
from loadflow.scene.scene import Scene
from loadflow.scene.shaft_place import any_moves_in_films
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.film import MOTION
from loadflow.stages.effects.registry import EFFECTS
from loadflow.stages.films.turning import comes_from_or_to_standstill
from loadflow.stages.probes import PROBES, Answers, hardest
from loadflow.stages.registry import STAGES, giving
from loadflow.stages.stage import with_settings
from loadflow.wind.cases import load_case

SHARE = 0.05
"""Processor time of a pilot over that of its run, at most, where the ladder knows both; a pilot of
one case is then within a tenth of the time of two processes."""

MOST = 0.1
"""The same of a pilot that follows a shaft in its films near standstill."""

SOLVED = 1.0
"""Processor time of the films and contacts of a case of a pilot, s; the main job's."""


@dataclass(frozen=True)
class Effort:
    """How much a pilot measures.

    Attributes
    ----------
    cases : int
        Load cases that it looks at, at most.
    duration : float
        Length of a simulated case, s, where the case itself is longer.
    thorough : bool
        Whether the case is simulated with each effect of the rotor in and out, and effects are
        measured of which nothing is to decide: those that the scene has by name, and those that are
        out for certain (`surely_small`). Else all these stand by their indicators.
    """

    cases: int
    duration: float
    thorough: bool = True


EFFORTS = (Effort(2, 100.0), Effort(1, 60.0), Effort(1, 60.0, thorough=False))
"""From the most on. The least is taken where even that is more than its `SHARE`."""

Report = Callable[[str, int, int], None]
Item = TypeVar("Item")
Outcome = TypeVar("Outcome")

Outcomes = Callable[[Callable[[Case], Any], Iterable[Case]], Iterable[tuple[Case, Any]]]


def in_turn(
    work: Callable[[Item], Outcome], items: Iterable[Item]
) -> Iterator[tuple[Item, Outcome]]:
    """Work on one item after another in this process."""
    for item in items:
        yield item, work(item)


@dataclass(frozen=True)
class Questions:
    """What a pilot is to measure.

    Attributes
    ----------
    scene : Scene
        With the models of the run.
    effects : tuple of str
        Their names.
    duration : float
        Length of a simulated case, s, where the case itself is longer.
    cases : tuple of Case
        Those that are looked at.
    settled : tuple of str
        Effects of these that are kept whatever their size: whether they can be on is asked alone,
        and not even that of a model that surely answers, whose others are measured without them.
    """

    scene: Scene
    effects: tuple[str, ...]
    duration: float
    cases: tuple[Case, ...]
    settled: tuple[str, ...] = ()

    @property
    def models(self) -> tuple[str, ...]:
        """Models that have an effect to measure, in the order in which they are probed."""
        found = {effect.probed for effect in EFFECTS if effect.name in self.effects}
        return tuple(model for model in PROBES if model in found)

    @property
    def around_shaft(self) -> bool:
        """Whether one of them, as of films at rest, reads where a shaft lies in films that move."""
        found = [one for one in EFFECTS if one.name in {*self.effects} - {*self.settled}]
        return any(one is MOTION or PROBES[one.probed].around_shaft for one in found)

    def of_model(self, model: str, duration: float) -> Questions:
        """Those of one model alone, on a simulated case of `duration`, s."""
        names = tuple(one.name for one in EFFECTS if one.probed == model)
        ours = tuple(name for name in self.effects if name in names)
        return replace(self, effects=ours, duration=duration)


def pilot(
    scene: Scene,
    say: Report = lambda stage, done, total: None,
    outcomes: Outcomes = in_turn,
    effort: Effort | None = None,
    before: Callable[[Questions, Choice], None] = lambda questions, choice: None,
    brief: bool = False,
) -> EffectVerdict | None:
    """Measure the effects of a scene.

    Parameters
    ----------
    scene : Scene
        What is wanted.
    say : callable
        Told of progress: ("pilot", done, total).
    outcomes : callable
        Maps the measurement over cases, in other processes if it likes, and yields each case with
        what came of it, in any order. A case that came to nothing is left out of the verdict.
    effort : Effort, optional
        How much is measured; None: what goes with the expected time of the run.
    before : callable
        Called with the questions before they are asked, and with the models expected without them:
        a runner compiles what they call.
    brief : bool
        Whether the least effort asks that alone on which the choice of models hangs.

    Returns
    -------
    EffectVerdict or None
        None where the scene asks for no accuracy, no effect is worth a measurement or, if `brief`,
        what it takes, or no case could be measured.

    Raises
    ------
    loadflow.errors.InputError
        Bad load files.
    """
    if not scene.asks:
        return None
    cases = tuple(list_cases(scene))
    choice, known = _expected(scene, cases, solving=False)
    chosen = choice.scene
    worth = list(_worth_measuring(scene, chosen, known))
    effort = effort or effort_for(chosen, worth, cases)
    brief = brief and not effort.thorough
    there = [*concerned(scene, _stages(scene)), *concerned(chosen, _stages(chosen))]
    if brief and any(one.solves for one in there):  # that costs less than what it may settle
        choice, known = _expected(scene, cases, solving=True)
        chosen = choice.scene
        worth = list(_worth_measuring(scene, chosen, known))
    if not effort.thorough:
        worth = [
            one
            for one in worth
            if one.model != "loads"
            and (one.is_open(scene) or not one.is_on(chosen))
            and not surely_small(chosen, one, known)
        ]
    effects, settled = tuple(one.name for one in worth), tuple[str, ...]()
    if brief:
        effects, settled = _to_decide(scene, chosen, known, worth, cases)
    if not effects or (brief and _takes_long(chosen, effort, cases)):
        return None
    looked_at = hardest(scene, cases)[: effort.cases]
    questions = Questions(chosen, effects, effort.duration, tuple(looked_at), settled)
    before(questions, choice)
    say("pilot", 0, len(looked_at))
    measured: dict[Case, Found] = {}
    work = partial(measure, questions)
    for done, (case, outcome) in enumerate(outcomes(work, looked_at), 1):
        if isinstance(outcome, Found):
            measured[case] = outcome
        say("pilot", done, len(looked_at))
    found = [measured[case] for case in looked_at if case in measured]
    if not found:
        return None
    sizes = {}
    for effect in effects:
        seen = [one.sizes[effect] for one in found if effect in one.sizes]
        if seen:
            sizes[effect] = {
                quantity: max(one.get(quantity, 0.0) for one in seen)
                for quantity in sorted({name for one in seen for name in one})
            }
    refused = {name: why for one in found for name, why in one.refused.items()}
    seconds = round(sum(one.seconds for one in found), 2)
    return EffectVerdict(
        sizes, refused, tuple(case.name for case in looked_at if case in measured), seconds
    )


def effort_for(scene: Scene, effects: Iterable[Effect], cases: tuple[Case, ...]) -> Effort:
    """Return the largest effort within `SHARE` of the time of the run, both by the ladder.

    Parameters
    ----------
    scene : Scene
        With the models of the run.
    effects : iterable of Effect
        What shall be measured.
    cases : tuple of Case
        All of the run.
    """
    run = _seconds(scene, needed_stages(scene), cases)
    simulated = 1 + sum(effect.model == "loads" for effect in effects)
    for effort in EFFORTS[:-1]:
        shorter, case = _short(scene, cases[0], effort.duration)
        each = _seconds(shorter, ("loads",), (case,))
        if effort.cases * ((1 + simulated) * each + SOLVED) <= SHARE * run:
            return effort
    return EFFORTS[-1]


def _takes_long(chosen: Scene, effort: Effort, cases: tuple[Case, ...]) -> bool:
    """Whether a shaft is to be followed in its films through too large a part of a run.

    Of starts and stops alone, of about a load case: near standstill the past of a stretch is long.
    """
    floats = any_moves_in_films(chosen.shaft, chosen.journal)
    if not floats or not comes_from_or_to_standstill(chosen):
        return False
    one = _seconds(chosen, ("loads", "shaft", "journal"), cases[:1])
    return effort.cases * one > MOST * _seconds(chosen, needed_stages(chosen), cases)


def _seconds(scene: Scene, stages: Iterable[str], cases: tuple[Case, ...]) -> float:
    """Processor time of stages over cases as far as the ladder knows it, s."""
    return sum(expected_seconds(scene, name, cases) or 0.0 for name in stages)


def _expected(scene: Scene, cases: tuple[Case, ...], solving: bool) -> tuple[Choice, Estimates]:
    """Models that a run has without a pilot, and what indicators say of their effects."""
    choice = chosen_models(scene, cases, solving=solving)
    return choice, estimates(choice.scene, _stages(choice.scene), cases, solving=solving)


def _stages(scene: Scene) -> list[str]:
    needed = needed_stages(scene)
    return [name for name in STAGES if name in needed]


def _worth_measuring(scene: Scene, chosen: Scene, known: Estimates) -> Iterator[Effect]:
    """Effects that can be switched, and whose indicator is not far below what is allowed."""
    for effect in concerned(chosen, _stages(chosen)):
        matters = not known.is_little(scene, effect) or effect.is_on(scene)
        both = switched(chosen, effect, not effect.is_on(chosen)) is not None
        if matters and both and effect.probed in PROBES:
            yield effect


def _to_decide(
    scene: Scene, chosen: Scene, known: Estimates, effects: list[Effect], cases: tuple[Case, ...]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Names of the effects that are asked about, and of those among them that are kept anyway.

    Kept are effects that cost `LITTLE`, and such as their indicators leave no doubt of: they are
    not taken out. Whether all can be on together is asked all the same, but of a model that surely
    answers.
    """
    settled = {
        one.name
        for one in effects
        if _is_needed(scene, chosen, known, one) or _costs_little(chosen, one, cases)
    }
    open_ = {
        one.probed
        for one in effects
        if one.name not in settled or not PROBES[one.probed].surely_answers
    }
    asked = tuple(one.name for one in effects if one.probed in open_)
    return asked, tuple(name for name in asked if name in settled)


def _is_needed(scene: Scene, chosen: Scene, known: Estimates, effect: Effect) -> bool:
    """Whether an answer without the effect is off by more than is allowed, beyond any doubt."""
    without = switched(chosen, effect, False)
    if not effect.is_on(chosen) or without is None:
        return False
    return any(
        part.effect is effect and (part.share or 0.0) > effect.smaller * scene.allowed(result)
        for result in scene.results
        for name, links in giving(result).results[result](without).items()
        for part in contributions(without, result, name, links, known)
        if name not in effect.either_way
    )


def _costs_little(chosen: Scene, effect: Effect, cases: tuple[Case, ...]) -> bool:
    """Whether the plan has the effect, and expects to take hardly less time without."""
    without = switched(chosen, effect, False)
    if not effect.is_on(chosen) or without is None:
        return False
    with_it, left = (
        [expected_seconds(one, name, cases) for name in needed_stages(one)]
        for one in (chosen, without)
    )
    if None in with_it or None in left:
        return False
    return sum(filter(None, with_it)) <= (1.0 + LITTLE) * sum(filter(None, left))


@dataclass(frozen=True)
class Found:
    """Of one case: sizes by effect, the effects that cannot be on, and the processor time, s."""

    sizes: Mapping[str, Sizes]
    refused: Mapping[str, str]
    seconds: float


@threadpool_limits.wrap(limits=1)
def measure(questions: Questions, case: Case, given: Mapping[str, Any] | None = None) -> Found:
    """Switch the effects on one case; a process of its own knows them by name.

    Parameters
    ----------
    questions : Questions
        What is measured; its cases are not looked at.
    case : Case
        On which.
    given : mapping, optional
        Series by stage that are there already, and are not computed.
    """
    started = time.process_time()
    by_name = {effect.name: effect for effect in EFFECTS}
    effects = [by_name[name] for name in questions.effects]
    scene, case = _short(questions.scene, case, questions.duration)
    sizes: dict[str, Sizes] = {}
    refused: dict[str, str] = {}
    inputs: dict[str, Any] = dict(given or {})
    shafts = {resting(scene): inputs["shaft"]} if "shaft" in inputs else {}
    for model, probe in PROBES.items():
        ours = [effect for effect in effects if effect.probed == model]
        if not ours:
            continue
        if probe.surely_answers:  # then nobody asks whether those that are kept go with others
            for effect in (one for one in ours if one.name in questions.settled):
                scene = switched(scene, effect, False) or scene
            ours = [one for one in ours if one.name not in questions.settled or one.is_on(scene)]
        try:
            for name in probe.reads:
                if name == "shaft" and name not in inputs:
                    inputs[name] = lying_shaft(scene, case, inputs, questions.around_shaft)
                    shafts[resting(scene)] = inputs[name]
                elif name not in inputs:
                    inputs[name] = STAGES[name].run(scene, case, inputs)
        except SolverError:
            break  # the run itself says so of this case
        if not probe.can_answer(case, inputs):
            continue
        asked = Asked(probe, case, inputs, shafts, questions.around_shaft)
        answers = asked.answers

        scene, best = _all_on(scene, ours, answers, refused)
        if isinstance(best, str):
            continue
        for effect in ours:
            if effect.name in refused or effect.name in questions.settled:
                continue
            on = effect.is_on(scene)
            partner = scene if on else _alone(scene, effect, ours)
            if partner is None:
                continue
            with_it = best if partner is scene else tried(answers, partner)
            left = without(asked, effect, partner)
            if isinstance(with_it, str):
                refused[effect.name] = with_it
            elif not isinstance(left, str):
                sizes[effect.name] = changes(with_it, left)
    return Found(sizes, refused, time.process_time() - started)


def _short(scene: Scene, case: Case, duration: float) -> tuple[Scene, Case]:
    """The case, no longer than `duration`, s, where it is simulated; a start is seen to its end."""
    whole = case.file or case.wind or "start" in load_case(case.dlc).events
    if whole or case.steps * scene.loads.step <= duration:
        return scene, case
    shorter = with_settings(scene, "loads", {"duration": duration})
    if shorter is None:
        return scene, case
    return shorter, replace(case, steps=round(duration / scene.loads.step))


def _all_on(
    scene: Scene,
    effects: list[Effect],
    answers: Callable[[Scene], Answers],
    refused: dict[str, str],
) -> tuple[Scene, Answers | str]:
    """The scene with all effects that can be on together, and its answers."""
    together = scene
    for effect in sorted(effects, key=lambda one: not one.is_on(scene)):  # those that it has first
        together = switched(together, effect, True) or together
    best = tried(answers, together)
    if not isinstance(best, str):
        return together, best
    together = scene
    for effect in effects:  # one by one: which of them cannot be?
        left = switched(together, effect, False)
        if left is not None and switched(left, effect, True) is not None:  # not a stated table
            together = left
    best = tried(answers, together)
    for effect in effects:
        more = switched(together, effect, True)
        outcome = tried(answers, more) if more is not None else ""
        if more is not None and not isinstance(outcome, str):
            together, best = more, outcome
        elif outcome:
            refused[effect.name] = str(outcome)
    return together, best


def _alone(scene: Scene, effect: Effect, others: list[Effect]) -> Scene | None:
    """The scene with an effect on, and one of the others out that it does not go with."""
    some = (other for other in others if other is not effect and other.is_on(scene))
    rooms = (switched(scene, other, False) for other in some)
    found = (switched(room, effect, True) for room in rooms if room is not None)
    return next((one for one in found if one is not None), None)
