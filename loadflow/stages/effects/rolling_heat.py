"""Effect of the heat of rolling bearings: how far the oil is from the temperature assumed."""

from __future__ import annotations

from typing import Any

import numpy as np

from loadflow.rolling import Lubrication, modified_spectrum_life
from loadflow.rolling.friction.catalogue import (
    FRICTION_COEFFICIENTS,
    PALMGREN_F0,
    PALMGREN_F1,
    palmgren_idle_torque,
    palmgren_load_torque,
)
from loadflow.rolling.housing import housing_area
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.friction import Friction
from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import UNKNOWN, Effect, Sizes
from loadflow.stages.effects.roller_profile import SLICED
from loadflow.stages.effects.situation import BearingLoad, Floats, Situation
from loadflow.tribology import lubricant

TRANSFER = 15.0
"""Of a housing in still air, W/(m² K), where no cooling is stated; assumed (docs/compare.md)."""

HOTTEST = 150.0  # K above the air, to which the balance is sought
_HALVINGS = 30
FILM_POWER = 0.7
"""Of the viscosity, that films of lines follow [Dowson and Higginson 1966]."""


def _heat(at: Situation) -> Sizes:
    """What the temperature that is assumed is off of κ, modified life, Λ and friction.

    Against that at which Palmgren's friction under the mean load leaves by the cooling stated, or
    else by the surface of a housing that is assumed. Nothing where the shaft stands, or where
    somebody has measured it.
    """
    found: list[Sizes] = []
    for name, part in _unknown(at.scene).items() if at.turns.any() else ():
        found.append(_of_bearing(at.scene.friction, part, at.bearings[name], at.speed))
    names = {name for one in found for name in one}
    # NaN of one bearing is that of all
    return {name: float(np.max([one.get(name, 0.0) for one in found])) for name in sorted(names)}


def _of_bearing(options: Friction, part: FurtherBearing, load: BearingLoad, speed: Floats) -> Sizes:
    """Sizes of one bearing; those of the point where each is largest.

    NaN where its friction leaves at no temperature up to `HOTTEST`.
    """
    bearing: Any = part.geometry
    oil, turns = lubricant(options.lubricant), np.abs(speed) > 0
    own = _Friction(bearing, load, speed, turns)
    conductance = options.conductance_of(part) or TRANSFER * housing_area(bearing)
    air, stated = options.ambient_temperature, options.temperature_of(part)
    low, high = np.full(own.speed.shape, air), np.full(own.speed.shape, air + HOTTEST)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        lost = own.torque(oil.kinematic_viscosity(middle)) * own.speed
        warms = lost > conductance * (middle - air)
        low, high = np.where(warms, middle, low), np.where(warms, high, middle)
    hot, cool = 0.5 * (low + high), np.full(low.shape, stated)
    if (high == air + HOTTEST).any():  # no middle has shed what is lost
        return dict.fromkeys(MOVED, float("nan"))
    warm, assumed = (np.asarray(oil.kinematic_viscosity(each), float) for each in (hot, cool))
    ratio = assumed / warm
    changes = (
        ratio,
        ratio**FILM_POWER,
        own.torque(assumed) / own.torque(warm),
        own.lives(options, cool) / own.lives(options, hot),
    )
    return {name: float(np.abs(change - 1.0).max()) for name, change in zip(MOVED, changes)}


MOVED = ("viscosity ratio", "film parameter", "friction power", "modified life")
"""What another temperature of the oil moves."""


class _Friction:
    """Friction torque of a bearing after Palmgren at the points that turn."""

    def __init__(self, bearing: Any, load: BearingLoad, speed: Floats, turns: Floats) -> None:
        turn = np.hypot(load.moment[:, 1], load.moment[:, 2])
        pushed = np.hypot(load.radial, load.force[:, 0]) + 2.0 * turn / bearing.pitch_diameter
        self.load, self.speed = np.maximum(pushed[turns], 1.0), np.abs(speed[turns])
        self._bearing, self._diameter = bearing, bearing.pitch_diameter

    def torque(self, viscosity: Any) -> Floats:
        """N m, with the kinematic viscosity (n,), m²/s."""
        kind = self._bearing.catalogue_kind
        factor = 0.5 * FRICTION_COEFFICIENTS.get(kind, FRICTION_COEFFICIENTS["deep groove"])
        factor = PALMGREN_F1.get(kind, factor)
        idle = PALMGREN_F0.get(kind, PALMGREN_F0["ball"])
        held = palmgren_load_torque(self.load, self._diameter, factor)
        return np.asarray(palmgren_idle_torque(self.speed, viscosity, self._diameter, idle) + held)

    def lives(self, options: Friction, temperatures: Floats) -> Floats:
        """Modified life at each point alone, with its oil at a temperature (n,), K."""
        oil, one = lubricant(options.lubricant), np.ones(1)
        found = []
        for kelvin, load, speed in zip(temperatures.tolist(), self.load, self.speed):
            grease = Lubrication(oil=oil, temperature=kelvin, cleanliness=options.cleanliness)
            life = modified_spectrum_life(self._bearing, load * one, speed * one, grease, one)
            found.append(float(life.life))
        return np.array(found)


def _unknown(scene: Scene) -> dict[str, FurtherBearing]:
    """Bearings, by place, that have no temperature of their own: a balance tells it, or nobody."""
    return {
        place: part
        for place, part in scene.rolling.bearings.items()
        if part.balances_heat and not scene.friction.states(part)
    }


def _all_balanced(scene: Scene) -> bool:
    parts = _unknown(scene).values()
    return len(scene.friction.balances(parts)) == len(parts)


def _switched(scene: Scene, on: bool) -> Scene | None:
    """The scene with the heat balances that it states, or without any."""
    if on:
        return scene if _all_balanced(scene) else None
    rolling = _uncooled(scene.rolling)
    rolling = rolling.model_copy(update={"further": [_uncooled(one) for one in rolling.further]})
    friction = scene.friction.without_balance()
    return scene.model_copy(update={"friction": friction, "rolling": rolling})


def _uncooled(part: Any) -> Any:
    """A bearing without what it states of its cooling, unless that is a temperature."""
    if part.cooling is None or part.cooling.temperature is not None:
        return part
    return part.model_copy(update={"cooling": None})


HEAT_COSTS = {"rigid": {False: 30.0, True: 2.9}, "flexible": {False: 3.1, True: 1.9}}
"""Time of equilibria with heat balance over that without, by rings and whether rollers are sliced:
0.5 ms a sample, whatever the rung, beside what the ladder has of it."""


def _cost(scene: Scene) -> float:
    return HEAT_COSTS[scene.rolling.rung][SLICED.is_on(scene)]


ROLLING_HEAT = Effect(
    "heat of rolling bearings",
    model="rolling",
    keys=("friction.conductance", "friction.cooling", "rolling.cooling"),
    is_on=_all_balanced,
    switched=_switched,
    indicator=_heat,
    larger=lambda scene: UNKNOWN,  # nobody knows a housing that is not stated
    smaller=15.0,
    out="no cooling is stated: the oil is as warm as friction.temperature",
    needs="friction.conductance, or the cooling of each bearing",
    concerns=lambda scene: (
        (scene.wants("rolling") or "rolling.friction" in scene.results)
        and bool(_unknown(scene))
        and "temperature" not in scene.friction.changed
    ),
    probe="friction",
    untold="its friction leaves at no temperature up to "
    f"{HOTTEST:g} K above the air by the cooling stated or assumed",
    cost=_cost,
)
