"""Effects of the shaft."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.situation import Situation

_SUSPENSIONS = ("two_point", "three_point", "integrated", "direct_drive", "moment")
_KEYS = tuple(f"shaft.{name}" for name in _SUSPENSIONS)


def _moments(at: Situation) -> Sizes:
    """What moments in the bearings change of the largest radial force, if these are rigid.

    Nothing where bearings turn freely with the shaft: their loads follow from equilibrium. A film
    that takes a moment hardly resists it, a rolling bearing nearly as a rigid one. How a bent
    shaft tilts in its films is counted there, as tilt.
    """
    most = max(float(np.max(load.held)) for load in at.bearings.values())
    return dict.fromkeys(("bearing load max", "radial force max", "bearing force DEL"), most)


def _rigid(scene: Scene, on: bool) -> Scene | None:
    if on:
        return scene if all(c.beam is not None for c in scene.shaft.concepts) else None
    stiff = {
        name: replace(concept, beam=None)
        for name, concept in scene.shaft.suspensions.items()
        if concept is not None
        and not any(support in scene.shaft.coupled for support in concept.bearings)
    }
    return scene.model_copy(update={"shaft": scene.shaft.model_copy(update=stiff)})


ELASTIC = Effect(
    "elastic shaft",
    model="shaft",
    keys=_KEYS,
    is_on=lambda scene: any(concept.beam is not None for concept in scene.shaft.concepts),
    switched=_rigid,
    indicator=_moments,
    out="no beam in the suspension: its bearings are free to tilt, and loads follow from balance",
    needs="a table beam in the suspension",
    concerns=lambda scene: bool(scene.shaft.concepts),
)


def _given(scene: Scene, on: bool) -> Scene | None:
    if on:
        return scene if scene.shaft.coupled else None
    held = {
        name: replace(concept, beam=concept.beam.free_in_films().on_rigid_bearings())
        for name, concept in scene.shaft.suspensions.items()
        if concept is not None and concept.beam is not None
    }
    return scene.model_copy(update={"shaft": scene.shaft.model_copy(update=held)})


STIFFNESS = Effect(
    "stiffness of the bearings",
    model="shaft",
    keys=_KEYS,
    is_on=lambda scene: bool(scene.shaft.coupled),
    switched=_given,
    indicator=_moments,
    larger=lambda scene: 25.0,  # a film beside a bearing that takes the moment gives way
    out="no support of the shaft takes its stiffness from a bearing",
    needs='`supports` of the beam with stiffness = "journal" or "rolling"',
    concerns=lambda scene: any(concept.beam is not None for concept in scene.shaft.concepts),
)
