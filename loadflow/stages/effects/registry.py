"""The effects of all rooms. This is the only list of them."""

from __future__ import annotations

from loadflow.scene.scene import Scene
from loadflow.stages.effects import (
    clearances,
    film,
    film_heat,
    film_tilt,
    joint_motion,
    roller_profile,
    rolling,
    rolling_heat,
    rotor,
    seats,
    shaft,
    thrust,
)
from loadflow.stages.effects.effect import Effect
from loadflow.stages.stage import Stage

EFFECTS: list[Effect] = [
    rotor.INFLOW,
    rotor.STALL,
    rotor.LATERAL,
    rotor.BEND_TWIST,
    rotor.TORSION,
    shaft.ELASTIC,
    shaft.STIFFNESS,
    clearances.CLEARANCES,
    joint_motion.TOGETHER,
    seats.SEATS,
    film.MOTION,
    film_heat.HEAT,
    film_heat.GROWTH,
    film_tilt.TILT,
    film.SHELL,
    film.CONTACT,
    film.TURBULENCE,
    film.SUPPLY,
    thrust.MOTION,
    thrust.HEAT,
    thrust.TILT,
    thrust.CONTACT,
    seats.OF_COLLARS,
    rolling.RINGS,
    roller_profile.SLICED,
    rolling.CENTRIFUGAL,
    rolling_heat.ROLLING_HEAT,
]


def effect_named(name: str) -> Effect | None:
    """The effect of that name; None without one."""
    return next((one for one in EFFECTS if one.name == name), None)


def effects_of(stage: Stage, scene: Scene) -> list[Effect]:
    """Effects of a stage that can be there in a scene, on or off."""
    models = {rungs.name for rungs in stage.models}
    return [one for one in EFFECTS if one.model in models and one.concerns(scene)]
