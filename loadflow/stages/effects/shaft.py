"""Effects of the shaft."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from loadflow.scene.scene import Scene
from loadflow.scene.shaft_place import move_together
from loadflow.shaft import Concept
from loadflow.stages.effects.clearances import closed_ends
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.situation import Situation

_SUSPENSIONS = ("two_point", "three_point", "integrated", "direct_drive", "moment")
_KEYS = tuple(f"shaft.{name}" for name in _SUSPENSIONS)


_ALIGNED = 1e-6
"""Share of its film that the ends of a bearing take at least: coth x - 1/x is told from nothing."""

_LOADS = "bearing load max", "radial force max", "bearing force DEL"


def _moments(at: Situation) -> Sizes:
    """What moments in the bearings change of the largest radial force, if these are rigid.

    Nothing where bearings turn freely with the shaft: their loads follow from equilibrium. How a
    bent shaft tilts in its films is counted there, as tilt.
    """
    most = max(float(np.max(load.held)) for load in at.bearings.values())
    return dict.fromkeys(_LOADS, most)


def _giving_way(at: Situation) -> Sizes:
    """What rigid bearings change of the largest radial force of a shaft on its own ones.

    Newton's method finds how far films of the charts and rigid rings give way under what the bent
    shaft presses on them. Films in motion lie elsewhere, and elastic rings give way further.
    Moments of films are added, where their supports take any.
    """
    most = max(float(np.max(load.fed_back)) for load in at.bearings.values())
    return dict.fromkeys(_LOADS, max(most, _moments_of_films(at)))


def _moments_of_films(at: Situation) -> float:
    """What moments of two films change of their largest radial force.

    Slices of a film carry the more the thinner they are, as exp(2 x s), s from -1/2 to 1/2 over the
    width, with x as in `closed_ends`: their force acts (coth x - 1/x)/2 of it off mid-plane.
    """
    ends = {name: max(share, _ALIGNED) for name, share in closed_ends(at).items()}
    found = 0.0
    for concept in at.scene.shaft.concepts:
        taken = [name for name in concept.bearings if name in ends and _takes(at.scene, name)]
        if not taken or len(concept.bearings) != 2:
            continue
        loads = {name: at.bearings[name] for name in concept.bearings}
        radial = {name: float(np.max(one.radial + one.swing)) for name, one in loads.items()}
        width = {name: at.scene.journal.at(name).geometry.width for name in taken}
        moment = sum(
            0.5 * width[name] * (1.0 / np.tanh(ends[name]) - 1.0 / ends[name]) * radial[name]
            for name in taken
        )
        span = float(np.ptp(concept.positions))
        found = max(found, moment / span / max(radial.values()))
    return found


def _takes(scene: Scene, bearing: str) -> bool:
    """Whether the support of a bearing, fed back to the shaft, takes a moment."""
    support = scene.shaft.coupled.get(bearing)
    return support is not None and support.takes_moment


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


def _at_rest(scene: Scene, concept: Concept) -> bool:
    """Whether a shaft is iterated with its bearings, not followed together with films in motion.

    What these are worth is an effect of its own, tilt in the clearances.
    """
    fed_back = {*concept.bearings} & {*scene.shaft.coupled}
    return bool(fed_back) and not move_together(scene.shaft, scene.journal, concept)


def _given(scene: Scene, on: bool) -> Scene | None:
    if on:
        return scene if STIFFNESS.is_on(scene) else None
    held = {
        name: replace(concept, beam=concept.beam.free_in_films().on_rigid_bearings())
        for name, concept in scene.shaft.suspensions.items()
        if concept is not None and concept.beam is not None and _at_rest(scene, concept)
    }
    return scene.model_copy(update={"shaft": scene.shaft.model_copy(update=held)})


STIFFNESS = Effect(
    "stiffness of the bearings",
    model="shaft",
    keys=_KEYS,
    is_on=lambda scene: any(_at_rest(scene, concept) for concept in scene.shaft.concepts),
    switched=_given,
    indicator=_giving_way,
    out="no shaft is iterated with the stiffness of its bearings",
    needs='`supports` of the beam with stiffness = "journal" or "rolling"',
    concerns=lambda scene: any(
        concept.beam is not None and not move_together(scene.shaft, scene.journal, concept)
        for concept in scene.shaft.concepts
    ),
)
