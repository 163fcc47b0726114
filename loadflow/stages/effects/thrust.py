"""Effects of thrust collars: motion, heat, tilt, and contact, which no model of them knows.

Calibrated on the collar of ``pipelines/dlc_1_1.toml`` from 4 to 24 m/s, films of 70 to 125 µm.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
from scipy.special import lambertw

from loadflow.data import gains
from loadflow.errors import InputError
from loadflow.journal import DoubleThrustResult, PadHeat
from loadflow.scene.scene import Scene
from loadflow.scene.thrust import AnyAxial, ThrustCollar
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.film import ROUGHNESS, THREE_P
from loadflow.stages.effects.film_heat import oil_of
from loadflow.stages.effects.film_sizes import asperity_share
from loadflow.stages.effects.situation import BearingLoad, Situation
from loadflow.stages.films.turning import always_turns
from loadflow.stages.stage import with_settings

COSTS = {
    "motion": {"curve": 0.075},
    "tilt": {"curve": 1.1, "grid": 4.5, "transient": 2.9},
    "heat": {"curve": 1.6, "grid": 6.0, "transient": 1.1},
}
"""Time of a sample with an effect over that without, by rung, in motion by itself: of samples and
steps on a table, which the ladder counts once, and of one sample on the grid. Measured by ``python
-m benchmarks.references.collar_costs``; docs/thrust.md."""

SMALLER = 15.0
"""Indicators of collars over their effects, at most: they are those of the hardest wind speed."""

_QUANTITIES = ("minimum film", "maximum pressure", "friction power")

Of = Callable[[Situation, ThrustCollar, BearingLoad, int, DoubleThrustResult], Sizes]
"""Sizes of one collar at one point, from its load and its film there."""


def _worst(of: Of) -> Callable[[Situation], Sizes]:
    """The largest sizes over all collars and points; 1 where no film carries a load.

    0 where the collar stands, by standstill: it has no film, and no answer of one to move.
    """

    def indicator(at: Situation) -> Sizes:
        found = [
            of(at, at.scene.thrust.collars[place], at.bearings[place], k, film)
            if film is not None
            else dict.fromkeys(_QUANTITIES, float(at.turns[k]))
            for place, films in at.collars.items()
            for k, film in enumerate(films)
        ]
        largest = {name: max((one[name] for one in found), default=1.0) for name in _QUANTITIES}
        return {name: min(size, 1.0) for name, size in largest.items()}

    indicator.__doc__ = of.__doc__
    return indicator


def cost_of(name: str) -> Callable[[Scene], float]:
    """Cost of one of `COSTS` on the rung of a scene, of the others in motion that of a step."""

    def cost(scene: Scene) -> float:
        own = "transient" if scene.thrust.in_motion else scene.thrust.rung
        return COSTS[name].get(own, COSTS[name][scene.thrust.rung])

    return cost


def _has_collars(scene: Scene) -> bool:
    return bool(scene.thrust.collars) and scene.wants("thrust")


def _may_tilt(scene: Scene) -> bool:
    """Whether the shaft tilts in a collar: pads that align themselves follow it."""
    fixed = (one for one in scene.thrust.collars.values() if not one.self_aligning)
    return _has_collars(scene) and any(fixed)


def _motion(
    at: Situation, collar: ThrustCollar, load: BearingLoad, k: int, film: DoubleThrustResult
) -> Sizes:
    """What squeeze takes out of the swing of the thrust as blades pass: 1 − 1/√(1 + (Ω C/K)²).

    `THREE_P` of the swing comes at Ω, the passing of the blades; the rest is slow. Nothing of a
    collar that stands.
    """
    passing = at.turbine.rotor.blades * at.speed[k]
    left = 1.0 / np.hypot(1.0, passing * film.damping / film.stiffness)
    mean = abs(load.force[k, 0])
    change = THREE_P * (1.0 - float(left)) * load.surge[k] / max(mean + load.surge[k], 1.0)
    gain = gains()["thrust"]
    return {name: gain[name] * change for name in _QUANTITIES}


MOTION = Effect(
    "motion of the collar",
    model="thrust",
    keys=("thrust.motion",),
    is_on=lambda scene: scene.thrust.in_motion,
    switched=lambda scene, on: (
        with_settings(scene, "thrust", {"motion": "transient" if on else "quasi-static"})
        if always_turns(scene) or not on
        else None
    ),
    indicator=_worst(_motion),
    out='thrust.motion = "quasi-static": films of pads are solved at rest',
    needs='thrust.motion = "transient", of a shaft that never stands',
    concerns=_has_collars,
    solves=True,
    rungs=("curve",),
    cost=cost_of("motion"),
)


def _heat(
    at: Situation, collar: ThrustCollar, load: BearingLoad, k: int, film: DoubleThrustResult
) -> Sizes:
    """What the warming of the oil takes off its viscosity, at the balance of the harder film.

    Adiabatic: a pad warms its oil by D = P/(ρ c_p Q). Of what leaves at its end λ enters the
    next pad, so that with s of the oil leaving there it enters λ s D/(1 − λ s) warmer than it
    is fed, and the film is half of D warmer still. Nothing warms where the collar stands.
    """
    hard = max((film.front, film.back), key=lambda row: row.force)
    heat = collar.heat or PadHeat(oil=oil_of(collar.lubricant))
    oil, fed = heat.liquid, collar.oil
    rise = hard.friction_power / (fed.density * heat.heat_capacity * hard.flow)
    kept = heat.carry_over * (1.0 - float(np.sum(hard.side_flow)) / hard.flow)
    steepness = float(oil.steepness(heat.inlet_temperature))
    # the power falls with the viscosity: warmer = cold · exp(−FRICTION · steepness · warmer)
    falls = FRICTION * steepness
    warmer = float(lambertw(falls * rise * (kept / (1.0 - kept) + 0.5)).real) / falls
    thinner = math.exp(-steepness * warmer)
    gain = gains()["thrust"]
    return {
        "minimum film": 1.0 - thinner ** gain["minimum film"],
        "maximum pressure": PRESSED * (1.0 - thinner),
        "friction power": 1.0 - thinner**FRICTION,
    }


FRICTION = 0.68
"""d ln(friction)/d ln(viscosity) of a collar under a given load."""

PRESSED = 0.105
"""Growth of the largest pressure over the loss of viscosity: a thinner film has a steeper wedge."""


def _warmed(scene: Scene, on: bool) -> Scene | None:
    """The scene with a heat balance of each collar, or without any.

    A stated viscosity is that of the oil that enters, with and without.
    """
    changed: dict[str, AnyAxial] = {}
    for place, collar in scene.thrust.collars.items():
        stated = collar.model_dump(exclude_unset=True) | {"grid": collar.grid}
        if not on:
            stated |= {"heat": None, "lubricant": collar.oil}
        elif collar.heat is None:
            stated.pop("lubricant", None)
            try:
                stated["heat"] = PadHeat(oil=oil_of(collar.lubricant))
            except InputError:
                return None
        changed[place] = type(collar).model_validate(stated).on_cells(collar.grid)
    return with_collars(scene, changed)


def with_collars(scene: Scene, changed: Mapping[str, AnyAxial]) -> Scene:
    """The scene with other collars at their places."""
    bearings = {**scene.thrust.bearings, **changed}
    return scene.model_copy(
        update={"thrust": scene.thrust.model_copy(update={"bearings": bearings})}
    )


HEAT = Effect(
    "heat of the collar",
    model="thrust",
    keys=(),
    is_on=lambda scene: all(one.heat is not None for one in scene.thrust.collars.values()),
    switched=_warmed,
    indicator=_worst(_heat),
    out="no heat of a thrust bearing: its films have one viscosity, that of the oil as stated",
    needs="a table heat of the thrust bearing with the oil and the temperature at which it enters",
    concerns=_has_collars,
    solves=True,
    cost=cost_of("heat"),
    smaller=SMALLER,
)


def _tilt(
    at: Situation, collar: ThrustCollar, load: BearingLoad, k: int, film: DoubleThrustResult
) -> Sizes:
    """Slope of the shaft × outer radius / film, x: the film is x/(1 + 0.85 x) thinner at one side.

    Under the same load: h_min within 6 % of the change for x up to 0.8; the largest pressure grows
    by 1.4 to 2.8 x, the friction falls by 0.11 x². Pads that follow the shaft lose less.
    """
    slope = 0.0 if collar.self_aligning else float(load.slope[k])
    share = slope * collar.geometry.outer_radius / film.minimum_film
    return {
        "minimum film": share / (1.0 + 0.85 * share),
        "maximum pressure": 2.5 * share,
        "friction power": 0.11 * share**2,
    }


TILT = Effect(
    "tilt of the collar",
    model="thrust",
    keys=("thrust.tilt",),
    is_on=lambda scene: scene.thrust.tilt,
    switched=lambda scene, on: (
        with_settings(scene, "thrust", {"tilt": on})
        if not on or any(map(scene.shaft.bends_at, scene.thrust.collars))
        else None
    ),
    indicator=_worst(_tilt),
    out="no thrust.tilt: pads are aligned with the collar, however the shaft bends",
    needs="thrust.tilt = true, with a beam as the shaft; pads that follow it lose less",
    concerns=_may_tilt,
    solves=True,
    cost=cost_of("tilt"),
    smaller=SMALLER,
)


def _contact(
    at: Situation, collar: ThrustCollar, load: BearingLoad, k: int, film: DoubleThrustResult
) -> Sizes:
    """Share of the load that asperities take, as of journal films."""
    share = float(asperity_share(film.minimum_film, ROUGHNESS * collar.contact_film))
    return dict.fromkeys(_QUANTITIES, share)


CONTACT = Effect(
    "contact of the collar",
    model="thrust",
    keys=(),
    is_on=lambda scene: False,
    switched=lambda scene, on: None if on else scene,
    indicator=_worst(_contact),
    out="films of pads alone carry; asperities would take load below a film parameter of 4",
    needs="films of pads with asperities, which scenes do not have",
    concerns=_has_collars,
    solves=True,
)
