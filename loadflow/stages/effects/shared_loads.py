"""Loads that bearings share by how they give way: rigid, free to tilt, or as they are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from loadflow.scene.scene import Scene
from loadflow.shaft import BearingModel, Concept, bearing_loads
from loadflow.stages.effects.chart_films import charted
from loadflow.stages.rolling_at_work import as_stated
from loadflow.stages.rolling_support import rolling_model

Floats = np.ndarray


def held(scene: Scene, tilt: float, force: Floats, moment: Floats) -> dict[str, float]:
    """What bearings that take a moment change of the largest radial force, if they are rigid."""
    found: dict[str, float] = {}
    for concept in scene.shaft.concepts:
        if concept.beam is None or not any(one.takes_moment for one in concept.beam.supports):
            continue
        rigid = _radial(_rigid(concept), tilt, force, moment)
        free = _radial(replace(concept, beam=None), tilt, force, moment)
        found |= _changed(concept, rigid, free)
    return found


def fed_back(
    scene: Scene, tilt: float, force: Floats, moment: Floats, speed: float
) -> dict[str, float]:
    """What rigid bearings change of the largest radial force of a shaft that stands on its own.

    Films are those of charts, at rest, and hardly resist tilting; rolling bearings have rigid
    rings. Loads under which no film carries the shaft are those of bearings free to tilt.
    """
    found: dict[str, float] = {}
    for concept in scene.shaft.concepts:
        own = {*concept.bearings} & {*scene.shaft.coupled}
        if concept.beam is None or not own or len(concept.bearings) == 1:
            continue
        freely = replace(concept, beam=concept.beam.free_in_films())
        given = _radial(replace(concept, beam=None), tilt, force, moment)
        if speed != 0.0:
            thrust = bearing_loads(replace(concept, beam=None), force, moment, tilt=tilt)["force"]
            models = {
                name: _model(scene, name, speed, thrust.sel(bearing=name, axis="x").values)
                for name in own
            }
            given = _radial(freely, tilt, force, moment, models, given)
        rigid = _radial(_rigid(freely), tilt, force, moment)
        found |= _changed(concept, rigid, given)
    return found


def _model(scene: Scene, name: str, speed: float, thrust: Floats) -> BearingModel:
    support = scene.shaft.coupled[name]
    if support.stiffness == "journal":
        return charted(scene.journal.at(name)).model(speed)
    part = scene.rolling.bearings[name].model_copy(update={"rings": "rigid"})
    part = as_stated(part, scene.friction)
    return rolling_model(part, thrust, tilting=support.takes_moment, strict=False)


def _rigid(concept: Concept) -> Concept:
    assert concept.beam is not None
    return replace(concept, beam=concept.beam.on_rigid_bearings())


def _radial(
    concept: Concept,
    tilt: float,
    force: Floats,
    moment: Floats,
    models: dict[str, BearingModel] | None = None,
    otherwise: Floats | float = 0.0,
) -> Floats:
    """Radial forces (bearing, n); `otherwise` where the models have no answer."""
    loads = bearing_loads(concept, force, moment, tilt=tilt, models=models, strict=False)
    across = loads["force"].sel(axis=["y", "z"]).transpose("axis", "bearing", "time").values
    radial = np.hypot(*across)
    return np.where(loads["converged"].values, radial, otherwise) if models else radial


def _changed(concept: Concept, rigid: Floats, known: Floats) -> dict[str, float]:
    """Largest of each bearing over the largest that is known, less 1."""
    change = np.abs(rigid.max(axis=1) / known.max(axis=1) - 1.0)
    return dict(zip(concept.bearings, change.tolist()))
