"""The cheapest models that are accurate enough, and better ones where cases of a run ask for it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np

from loadflow.errors import InputError
from loadflow.planning.accuracy import Errors, effects_left_out, expected_errors, of_link
from loadflow.planning.effects import Estimates, concerned, switched
from loadflow.planning.ladder import choices, expected_seconds
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.scene.section import is_valid
from loadflow.stages.effects.effect import Effect
from loadflow.stages.effects.registry import EFFECTS, effect_named
from loadflow.stages.registry import STAGES, giving, models
from loadflow.stages.stage import Link, Rungs

Floats = np.ndarray


@dataclass(frozen=True)
class Choice:
    """Models for a scene: the scene with all of them named, and what to expect of it.

    Attributes
    ----------
    scene : Scene
        With the rung of every model set, and every effect in or out.
    reasons : dict
        Why each model was taken, by section of the scene.
    errors : dict
        Expected error of what users read, by result and quantity, what is left out counted; None
        where not measured.
    estimates : Estimates
        Sizes of the effects that this rests on.
    met : bool
        Whether every expected error is known and within the accuracy that is asked for.
    """

    scene: Scene
    reasons: dict[str, str]
    errors: Errors
    estimates: Estimates = field(default_factory=Estimates)
    met: bool = True


def choose(
    scene: Scene, stages: Iterable[str], cases: tuple[Case, ...], known: Estimates | None = None
) -> Choice:
    """Choose the cheapest models that hold the accuracy that the scene asks for.

    Parameters
    ----------
    scene : Scene
        What is wanted. With ``accuracy = "given"`` its models stay as they are.
    stages : iterable of str
        Stages that will run.
    cases : tuple of Case
        Load cases, for the expected time.
    known : Estimates, optional
        Sizes of effects.

    Returns
    -------
    Choice
        Where an accuracy is out of reach, what is in reach is held: the rest of the error is kept
        within it. Where some errors were not measured, as few of these as can be; `met` is False in
        both. As few effects as can be are left out that nobody measured and whose indicator is no
        bound.

    Raises
    ------
    loadflow.errors.InputError
        No models that the scene leaves open go together.
    """
    known = known or Estimates()
    stages = tuple(stages)
    needed = [rungs for name in stages if name in STAGES for rungs in STAGES[name].models]
    alternatives = sections(scene, needed, stages, known)
    reasons = dict.fromkeys(alternatives, AS_GIVEN)
    if not scene.asks:
        return Choice(scene, reasons, expected_errors(scene, known), known)
    choosing = _Choosing(scene, stages, cases, known)
    few = {name: choosing.worthwhile(name, found) for name, found in alternatives.items()}
    best, why = choosing.best(few)
    reasons |= {name: why for name, found in alternatives.items() if len(found) > 1}
    errors = expected_errors(best, known)
    return Choice(best, reasons, errors, known, _holds(scene, errors))


AS_GIVEN = "as the scene says"


def sections(
    scene: Scene, needed: Iterable[Rungs], stages: Iterable[str], known: Estimates
) -> dict[str, list[Any]]:
    """Alternatives of each section: every open rung of its models, every open effect in or out."""
    found: dict[str, list[Scene]] = {}
    effects = [
        effect
        for effect in concerned(scene, stages)
        if effect.is_open(scene) and not known.refused(effect)
    ]
    for section in dict.fromkeys(rungs.section for rungs in needed):
        variants = [scene]
        for effect in (one for one in effects if one.section == section):
            variants = [
                changed
                for one in variants
                for on in (False, True)  # of equals the first is taken
                if (changed := switched(one, effect, on)) is not None
            ]
        for rungs in (one for one in needed if one.section == section):
            variants = [other for one in variants for other in choices(one, rungs)]
        found[section] = variants
    return {
        name: [getattr(one, name) for one in variants if _effects_known(one, name)]
        or [getattr(scene, name)]
        for name, variants in found.items()
    }


def _effects_known(scene: Scene, section: str) -> bool:
    """Whether the rung of a section knows all effects of it that are on."""
    return all(
        effect.known_by(scene)
        for effect in EFFECTS
        if effect.section == section and effect.rungs and effect.is_on(scene)
    )


@dataclass(frozen=True)
class _Choosing:
    """A choice in progress: what a candidate costs, and by how much it is off."""

    scene: Scene
    stages: tuple[str, ...]
    cases: tuple[Case, ...]
    known: Estimates
    times: dict[Any, float | None] = field(default_factory=dict)
    parts: dict[Any, tuple[float, int]] = field(default_factory=dict)
    left_out: dict[Any, list[Effect]] = field(default_factory=dict)

    def with_sections(self, changed: Mapping[str, Any]) -> Scene:
        return self.scene.model_copy(update=dict(changed))

    def links(self, scene: Scene) -> dict[tuple[str, str], tuple[Link, ...]]:
        """What reaches each answer, by result and quantity."""
        return {
            (result, quantity): of
            for result in scene.results
            for quantity, of in giving(result).results[result](scene).items()
        }

    def seconds(self, scene: Scene) -> tuple[int, float]:
        """How many times are not known, and the sum of those that are."""
        costs = [self._seconds_of(scene, name) for name in self.stages]
        return costs.count(None), sum(cost for cost in costs if cost is not None)

    def _seconds_of(self, scene: Scene, name: str) -> float | None:
        """Time of a stage; candidates share their sections, and so most of their times."""
        stage = STAGES[name]
        near = (stage, *(STAGES[need] for need in stage.needs(scene)))
        sections = dict.fromkeys(section for one in near for section in one.sections(scene))
        place = name, *((section, id(getattr(scene, section))) for section in sections)
        if place not in self.times:
            self.times[place] = expected_seconds(scene, name, self.cases)
        return self.times[place]

    @cached_property
    def effects(self) -> list[Effect]:
        """Those that can be there in the scene, on or off."""
        return concerned(self.scene, self.stages)

    def doubts(self, name: str, section: Any) -> int:
        """How many effects a section leaves out whose size nobody knows."""
        scene = self.with_sections({name: section})
        return sum(
            one.section == name and not one.is_on(scene) and self.known.is_doubtful(scene, one)
            for one in self.effects
        )

    def worthwhile(self, name: str, alternatives: list[Any]) -> list[Any]:
        """Alternatives of a section that no other one beats in time and in every error."""
        rated, seen = [], []
        for section in alternatives:
            scene = self.with_sections({name: section})
            links = self.links(scene)
            own = self._shares(scene, links, name, ())
            if links not in seen:
                seen.append(links)
            times = map(float, self.seconds(scene))
            rating = (self.doubts(name, section), *times, *own.ravel().tolist())
            rated.append((section, seen.index(links), rating))
        return [
            one
            for k, (one, links, rating) in enumerate(rated)
            if not any(
                other == links
                and all(a <= b for a, b in zip(theirs, rating))
                and (theirs != rating or j < k)
                for j, (_, other, theirs) in enumerate(rated)
                if j != k
            )
        ]

    def best(self, alternatives: dict[str, list[Any]]) -> tuple[Scene, str]:
        """The cheapest combination that is accurate enough and a valid scene, and why.

        Where none is valid that is accurate enough, the most accurate one of the others. What
        nobody knows counts alike: an error, or an effect that a section leaves out in doubt.
        """
        names, picked, errors = self._candidates(alternatives)
        allowed = np.array([self.scene.allowed(result) for result, _ in self.links(self.scene)])
        doubts = {
            id(one): self.doubts(name, one) for name in alternatives for one in alternatives[name]
        }
        known, unknown = errors[:, 0], (errors[:, 1] > 0).sum(axis=1)
        if any(doubts.values()):
            unknown += [sum(doubts[id(section)] for section in combined) for combined in picked]
        fewest = unknown == unknown.min()
        least = known[fewest].min(axis=0, initial=np.inf)
        beyond = least > allowed
        excess = ((known - np.where(beyond, least, 0.0)) / allowed).max(axis=1, initial=0.0)
        good = fewest & (excess <= 1.0 + 1e-9)

        def scene_of(k: int) -> Scene:
            return self.with_sections(dict(zip(names, picked[k])))

        def cost(k: int) -> tuple[tuple[int, float], float]:
            return self.seconds(scene_of(k)), float(known[k].sum())

        def off(k: int) -> tuple[int, float, float]:
            return int(unknown[k]), float(excess[k]), float(known[k].sum())

        # sections are chosen one by one: some do not go together, as a shaft that films hold
        # against its tilt and films without it
        groups = (good, cost), (~good, off)
        ranked = (k for some, by in groups for k in sorted(np.flatnonzero(some).tolist(), key=by))
        best = next((k for k in ranked if is_valid(scene_of(k))), None)
        if best is None:
            left = ", ".join(name for name, found in alternatives.items() if len(found) > 1)
            raise InputError(
                f"{self.scene.name}: no models of {left} that the scene leaves open go together "
                'with what it states; name their rungs, or accuracy = "given"'
            )
        why = "most accurate that was measured"
        if good[best]:
            beside = "beside what cannot be helped"
            why = f"cheapest {beside if beyond.any() else 'that is accurate enough'}"
        if (errors[best, 1] > 0).any():
            why += ", by the errors that are known"
        return scene_of(best), why

    def _candidates(
        self, alternatives: dict[str, list[Any]]
    ) -> tuple[list[str], list[tuple[Any, ...]], Floats]:
        """Names of sections, all combinations of these, and errors (n, 2, answers) as of `_shares`.

        A link's share depends on one section. (Whether shaft and films move together depends on
        two: they do, wherever a plan rests the one in the other.) Where the links themselves depend
        on a section, as on that of a film that moves, its alternatives are gone through one by one,
        and the others once for each set of links.
        """
        stated = self.links(self.scene)
        forking = {
            name: found
            for name, found in alternatives.items()
            if any(self.links(self.with_sections({name: one})) != stated for one in found)
        }
        others = {name: found for name, found in alternatives.items() if name not in forking}
        rests = [*product(*others.values())]
        combined, errors = [], []
        known: list[tuple[Any, Floats]] = []  # links, and what the others bring to them
        for fork in product(*forking.values()):
            fixed = dict(zip(forking, fork))
            scene = self.with_sections(fixed)
            links = self.links(scene)
            table = next((found for one, found in known if one == links), None)
            if table is None:
                table = self._table(fixed, links, others)
                known.append((links, table))
            held = {*forking, *({rungs.section for rungs in models().values()} - {*others})}
            for name in held:
                table = table + self._shares(scene, links, name, tuple(fixed))
            errors.append(table)
            combined += [fork + rest for rest in rests]
        return [*forking, *others], combined, np.concatenate(errors)

    def _table(
        self,
        fixed: dict[str, Any],
        links: dict[tuple[str, str], tuple[Link, ...]],
        others: dict[str, list[Any]],
    ) -> Floats:
        """What combinations of sections bring, (n, 2, answers), the others those of `fixed`."""
        table = np.zeros((1, 2, len(links)))
        for name, found in others.items():
            own = [
                self._shares(self.with_sections(fixed | {name: one}), links, name, tuple(fixed))
                for one in found
            ]
            # the number of rows is said: results without links have no columns to find it by
            table = (table[:, None] + own).reshape(len(table) * len(own), 2, len(links))
        return table

    def _shares(
        self,
        scene: Scene,
        links: dict[tuple[str, str], tuple[Link, ...]],
        section: str,
        forking: tuple[str, ...],
    ) -> Floats:
        """What the links to models of one section bring to each answer, (2, answers).

        The sum of what is known, and how many parts are not: what one model does not tell leaves
        what is asked of the others.
        """
        found = np.zeros((2, len(links)))
        for k, (place, of) in enumerate(links.items()):
            for link in of:
                if models()[link.model].section == section:
                    found[:, k] += self._part(scene, place, link, forking)
        return found

    def _part(
        self, scene: Scene, answer: tuple[str, str], link: Link, forking: tuple[str, ...]
    ) -> tuple[float, int]:
        """What a link brings to an answer; candidates share their sections, and so most of it."""
        sections = dict.fromkeys((models()[link.model].section, *forking))
        there = tuple(id(getattr(scene, section)) for section in sections)
        place = answer, link, there
        if place not in self.parts:
            if (link.model, there) not in self.left_out:
                self.left_out[link.model, there] = [*effects_left_out(scene, link.model)]
            left_out = self.left_out[link.model, there]
            parts = of_link(scene, *answer, link, self.known, left_out)
            shares = [part.share for part in parts]
            known = [share for share in shares if share is not None]
            self.parts[place] = float(sum(known)), len(shares) - len(known)
        return self.parts[place]


def _holds(scene: Scene, errors: Errors) -> bool:
    return all(
        error is not None and error <= scene.allowed(result)
        for result, found in errors.items()
        for error in found.values()
    )


# --- refining where a run's own cases ask for it -------------------------------------------------


def finer(scene: Scene, name: str) -> Scene | None:
    """Return the scene with the next more accurate model, or with an effect on; None at the top."""
    effect = effect_named(name)
    if effect is not None:
        return None if effect.is_on(scene) else switched(scene, effect, True)
    rungs = models().get(name)
    return rungs.finer(scene) if rungs else None


def refine(choice: Choice, names: Iterable[str]) -> Choice:
    """Return the choice with a model one better, or an effect on, for each mention of it."""
    scene, reasons = choice.scene, dict(choice.reasons)
    for name in names:
        scene = finer(scene, name) or scene
        reasons[_section(name)] = "refined: the coarser model differs too much on cases of this run"
    errors = expected_errors(scene, choice.estimates)
    return replace(choice, scene=scene, reasons=reasons, errors=errors)


def can_refine(wanted: Scene, chosen: Scene, name: str) -> bool:
    """Whether a model or an effect is the plan's to choose, and there is a better one."""
    if not wanted.asks:
        return False
    effect = effect_named(name)
    if effect is None and name not in models():
        return False
    is_open = effect.is_open(wanted) if effect else len(choices(wanted, models()[name])) > 1
    return is_open and finer(chosen, name) is not None


def _section(name: str) -> str:
    effect = effect_named(name)
    return effect.section if effect else models()[name].section
