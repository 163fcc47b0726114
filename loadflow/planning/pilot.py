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

import numpy as np
from threadpoolctl import threadpool_limits

from loadflow.errors import LoadflowError, SolverError
from loadflow.planning.effects import EffectVerdict, concerned, estimates, switched
from loadflow.planning.plan import chosen_models, needed_stages
from loadflow.scene.cases import Case, list_cases
from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.registry import EFFECTS
from loadflow.stages.effects.situation import situation
from loadflow.stages.probes import PROBES, Answers
from loadflow.stages.registry import STAGES
from loadflow.stages.stage import with_settings

CASES = 2
"""Load cases that a pilot looks at, at most."""

DURATION = 100.0
"""Length of a simulated case of a pilot, s, where the case itself is longer."""

WORTH = 0.1
"""Share of the smallest error allowed, below which an indicator needs no measurement."""

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


def pilot(
    scene: Scene,
    say: Report = lambda stage, done, total: None,
    outcomes: Outcomes = in_turn,
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

    Returns
    -------
    EffectVerdict or None
        None where the scene asks for no accuracy, no effect is worth a measurement, or no case
        could be measured.

    Raises
    ------
    loadflow.errors.InputError
        Bad load files.
    """
    if not scene.asks:
        return None
    cases = tuple(list_cases(scene))
    chosen = chosen_models(scene, cases).scene
    effects = [effect.name for effect in _worth_measuring(scene, chosen, cases)]
    if not effects:
        return None
    looked_at = hardest(scene, cases)
    say("pilot", 0, len(looked_at))
    measured: dict[Case, _Found] = {}
    work = partial(_measure, chosen, tuple(effects))
    for done, (case, outcome) in enumerate(outcomes(work, looked_at), 1):
        if isinstance(outcome, _Found):
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


def hardest(scene: Scene, cases: tuple[Case, ...]) -> list[Case]:
    """Return the cases of the largest steady load per speed and of the largest load, estimated.

    Of given series only the wind speed is known: the lowest and the highest are taken.
    """
    first = {case.wind_speed: case for case in reversed(cases)}
    speeds = sorted(first)
    if scene.loads.source == "files":
        places = [0, len(speeds) - 1]
    else:
        at = situation(scene, cases)
        bearings = at.bearings.values()
        steady = np.max([one.radial for one in bearings], axis=0) / at.speed
        largest = np.max([one.radial + one.swing + one.turn for one in bearings], axis=0)
        places = [int(np.argmax(steady)), int(np.argmax(largest))]
    return [first[speeds[place]] for place in dict.fromkeys(places)][:CASES]


def _worth_measuring(scene: Scene, chosen: Scene, cases: tuple[Case, ...]) -> Iterator[Effect]:
    """Effects that can be switched, and whose indicator is not far below what is allowed."""
    stages = [name for name in STAGES if name in needed_stages(chosen)]
    least = min(scene.allowed(result) for result in scene.results)
    known = estimates(chosen, stages, cases)
    for effect in concerned(chosen, stages):
        sizes = known.sizes(effect).values()
        matters = not sizes or max(sizes) > WORTH * least or effect.is_on(scene)
        both = switched(chosen, effect, not effect.is_on(chosen)) is not None
        if matters and both and effect.model in PROBES:
            yield effect


@dataclass(frozen=True)
class _Found:
    """Of one case: sizes by effect, the effects that cannot be on, and the processor time, s."""

    sizes: Mapping[str, Sizes]
    refused: Mapping[str, str]
    seconds: float


@threadpool_limits.wrap(limits=1)
def _measure(chosen: Scene, names: tuple[str, ...], case: Case) -> _Found:
    """Switch the effects of these names on one case; a process of its own knows them by name."""
    started = time.process_time()
    by_name = {effect.name: effect for effect in EFFECTS}
    effects = [by_name[name] for name in names]
    scene, case = _short(chosen, case)
    sizes: dict[str, Sizes] = {}
    refused: dict[str, str] = {}
    inputs: dict[str, Any] = {}
    for model, probe in PROBES.items():
        ours = [effect for effect in effects if effect.model == model]
        if not ours:
            continue
        try:
            for name in probe.reads:
                if name not in inputs:
                    inputs[name] = STAGES[name].run(scene, case, inputs)
        except SolverError:
            break  # the run itself says so of this case

        def answers(one: Scene) -> Answers:
            return probe.answers(one, case, inputs)  # noqa: B023  used within this turn

        scene, best = _all_on(scene, ours, answers, refused)
        if isinstance(best, str):
            continue
        for effect in ours:
            if effect.name in refused:
                continue
            on = effect.is_on(scene)
            partner = scene if on else _alone(scene, effect, ours)
            if partner is None:
                continue
            with_it = best if partner is scene else _try(answers, partner)
            without = switched(partner, effect, False)
            left = _try(answers, without) if without is not None else "no such scene"
            if isinstance(with_it, str):
                refused[effect.name] = with_it
            elif not isinstance(left, str):
                sizes[effect.name] = _changes(with_it, left)
    return _Found(sizes, refused, time.process_time() - started)


def _short(scene: Scene, case: Case) -> tuple[Scene, Case]:
    """The case, no longer than `DURATION` where it is simulated."""
    if case.file or case.wind or case.steps * scene.loads.step <= DURATION:
        return scene, case
    shorter = with_settings(scene, "loads", {"duration": DURATION})
    if shorter is None:
        return scene, case
    return shorter, replace(case, steps=round(DURATION / scene.loads.step))


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
    best = _try(answers, together)
    if not isinstance(best, str):
        return together, best
    together = scene
    for effect in effects:  # one by one: which of them cannot be?
        together = switched(together, effect, False) or together
    best = _try(answers, together)
    for effect in effects:
        more = switched(together, effect, True)
        outcome = _try(answers, more) if more is not None else ""
        if more is not None and not isinstance(outcome, str):
            together, best = more, outcome
        elif outcome:
            refused[effect.name] = str(outcome)
    return together, best


def _alone(scene: Scene, effect: Effect, others: list[Effect]) -> Scene | None:
    """The scene with an effect on, and one of the others out that it does not go with."""
    for other in others:
        room = switched(scene, other, False) if other is not effect and other.is_on(scene) else None
        found = switched(room, effect, True) if room is not None else None
        if found is not None:
            return found
    return None


def _try(answers: Callable[[Scene], Answers], scene: Scene) -> Answers | str:
    """What a probe answers, or why it does not."""
    try:
        found = answers(scene)
    except LoadflowError as error:
        return str(error)
    bad = [f"{bearing}: {what}" for (bearing, what), value in found.items() if np.isnan(value)]
    return f"no answer for {bad[0]}" if bad else found


def _changes(with_it: Answers, without: Answers) -> dict[str, float]:
    """Largest relative change by quantity, over the bearings."""
    found: dict[str, float] = {}
    for (bearing, quantity), value in with_it.items():
        other = without[bearing, quantity]
        change = 0.0 if other == value else abs(other - value) / max(abs(value), 1e-300)
        found[quantity] = max(found.get(quantity, 0.0), float(change))
    return found
