"""What a probe answers of one case as a scene is switched."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from loadflow.errors import LoadflowError
from loadflow.planning.effects import switched
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.scene.shaft_place import any_moves_in_films
from loadflow.stages.effects.effect import Effect
from loadflow.stages.probes import Answers, Probe
from loadflow.stages.registry import STAGES
from loadflow.stages.shaft import bearing_loads

ABSOLUTE = ("slip",)
"""Quantities that are shares themselves: what moves them is told as it is."""


@dataclass(frozen=True)
class Asked:
    """A probe of a case: series by stage, and the shaft's by what it rests on (`resting`).

    Unless it `follows` them, shafts that move in their films lie on rigid bearings.
    """

    probe: Probe
    case: Case
    inputs: Mapping[str, Any]
    shafts: dict[str, Any]
    follows: bool = True

    def answers(self, one: Scene) -> Answers:
        """What the probe answers of a scene."""
        return self.probe.answers(one, self.case, self.reads(one))

    def reads(self, one: Scene) -> Mapping[str, Any]:
        """What it reads: a shaft that rests on something else lies elsewhere."""
        if "shaft" not in self.probe.reads:
            return self.inputs
        key = resting(one)
        if key not in self.shafts:
            self.shafts[key] = lying_shaft(one, self.case, self.inputs, self.follows)
        return {**self.inputs, "shaft": self.shafts[key]}


def lying_shaft(scene: Scene, case: Case, inputs: Mapping[str, Any], follows: bool) -> Any:
    """Series of the shaft's stage; shafts that move in their films without these, or `follows`."""
    if follows or not any_moves_in_films(scene.shaft, scene.journal):
        return STAGES["shaft"].run(scene, case, dict(inputs))
    return bearing_loads(scene, case, dict(inputs), follows=False)


def resting(scene: Scene) -> str:
    """Digest of what the shaft depends on: the films and rollers that are fed back to it, too.

    Not whether these films move: films at rest are asked around the shaft that is followed in
    motion. Iterated with warm films at rest it takes 16 s, thrice a whole pilot.
    """
    films = scene.journal.model_copy(update={"motion": "quasi-static"})
    still = scene.model_copy(update={"journal": films})
    return still.digest(*STAGES["shaft"].sections(scene))


def without(asked: Asked, effect: Effect, scene: Scene) -> Answers | str:
    """What a probe answers without an effect that is on in the scene."""
    if (mute := effect.muted(scene)) is not None:

        def still(one: Scene) -> Answers:
            return asked.probe.answers(one, asked.case, mute(asked.reads(one)))

        return tried(still, scene)
    left = switched(scene, effect, False)
    return "no such scene" if left is None else tried(asked.answers, left)


def tried(answers: Callable[[Scene], Answers], scene: Scene) -> Answers | str:
    """What a probe answers, or why it does not."""
    try:
        found = answers(scene)
    except LoadflowError as error:
        return str(error)
    bad = [f"{bearing}: {what}" for (bearing, what), value in found.items() if np.isnan(value)]
    return f"no answer for {bad[0]}" if bad else found


def changes(with_it: Answers, without: Answers) -> dict[str, float]:
    """Largest relative change by quantity, over the bearings; absolute of `ABSOLUTE`."""
    found: dict[str, float] = {}
    for (bearing, quantity), value in with_it.items():
        other = without[bearing, quantity]
        scale = 1.0 if quantity in ABSOLUTE else max(abs(value), 1e-300)
        change = 0.0 if other == value else abs(other - value) / scale
        found[quantity] = max(found.get(quantity, 0.0), float(change))
    return found
