"""A shaft that its films hold back while it tilts: followed together with them, or not."""

from __future__ import annotations

from loadflow.scene.scene import Scene
from loadflow.scene.shaft_place import floating, move_together
from loadflow.shaft import Concept
from loadflow.stages.effects.clearances import CLEARANCES
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.film import MOTION
from loadflow.stages.effects.situation import Situation


def _fed_back(scene: Scene) -> list[Concept]:
    """Suspensions whose shaft floats in films that are all fed back to it."""
    return [
        concept
        for _, concept, films in floating(scene.shaft, scene.journal)
        if {*films} <= {*scene.shaft.coupled}
    ]


def _held_back(scene: Scene) -> bool:
    """Whether films that move hold back the shaft; at rest nothing does, nor is it lacking."""
    together = (move_together(scene.shaft, scene.journal, one) for one in _fed_back(scene))
    return not scene.journal.in_motion or all(together)


def _indicator(at: Situation) -> Sizes:
    """Squeeze holds back a tilt as it does a place, of which no more than the tilt can be lost.

    Measured on reference bearings at 5 MW, 12 m/s, bores aligned with the usual load: 27 and 30 %
    of h_min, 8 and 6 % of p_max, where motion is indicated with 33 and 19 %.
    """
    most = CLEARANCES.indicator(at)
    return {name: min(size, most.get(name, 0.0)) for name, size in MOTION.indicator(at).items()}


TOGETHER = Effect(
    "motion of the shaft in its films",
    model="journal",
    keys=(),
    is_on=_held_back,
    switched=lambda scene, on: None,
    indicator=_indicator,
    out="films move around a shaft that is tilted as it would be at rest in them",
    needs='journal.rung = "reduced" and a balance of heat or none, with both bearings of the shaft '
    "in films, so that shaft and films are followed together",
    concerns=lambda scene: scene.wants("journal") and bool(_fed_back(scene)),
)
