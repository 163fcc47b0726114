"""Effects of thrust collars: what films of pads solved at rest, aligned and cool do not know.

No model of them has any of it: each adds what it is worth to the error of ``thrust.film``.
Calibrated on the collar of ``pipelines/dlc_1_1.toml`` from 4 to 24 m/s, films of 70 to 125 µm.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.special import lambertw

from loadflow.data import gains
from loadflow.journal import DoubleThrustResult, Heat
from loadflow.scene.scene import Scene
from loadflow.scene.thrust import ThrustCollar
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.film import ROUGHNESS, THREE_P
from loadflow.stages.effects.film_heat import HEAT_CAPACITY, MODEL_OIL
from loadflow.stages.effects.film_sizes import asperity_share
from loadflow.stages.effects.situation import BearingLoad, Situation
from loadflow.tribology import lubricant

CARRY_OVER = 0.8
"""Share of the hot oil of a pad that enters the next one; [Mitsui, Hori and Tanaka 1983]."""

_QUANTITIES = ("minimum film", "maximum pressure", "friction power")

Of = Callable[[Situation, ThrustCollar, BearingLoad, int, DoubleThrustResult], Sizes]
"""Sizes of one collar at one point, from its load and its film there."""


def _worst(of: Of) -> Callable[[Situation], Sizes]:
    """The largest sizes over all collars and points; 1 where no film carries a load."""

    def indicator(at: Situation) -> Sizes:
        found = [
            of(at, at.scene.thrust.collars[place], at.bearings[place], k, film)
            if film is not None
            else dict.fromkeys(_QUANTITIES, 1.0)
            for place, films in at.collars.items()
            for k, film in enumerate(films)
        ]
        largest = {name: max((one[name] for one in found), default=1.0) for name in _QUANTITIES}
        return {name: min(size, 1.0) for name, size in largest.items()}

    indicator.__doc__ = of.__doc__
    return indicator


def _effect(name: str, of: Of, out: str, needs: str) -> Effect:
    """An effect that is always out: scenes have no key for it."""
    return Effect(
        name,
        model="thrust",
        keys=(),
        is_on=lambda scene: False,
        switched=lambda scene, on: None if on else scene,
        indicator=_worst(of),
        out=out,
        needs=needs,
        concerns=_has_collars,
    )


def _has_collars(scene: Scene) -> bool:
    return bool(scene.thrust.collars) and scene.wants("thrust")


def _motion(
    at: Situation, collar: ThrustCollar, load: BearingLoad, k: int, film: DoubleThrustResult
) -> Sizes:
    """What squeeze takes out of the swing of the thrust as blades pass: 1 − 1/√(1 + (Ω C/K)²).

    `THREE_P` of the swing comes at Ω, the passing of the blades; the rest is slow.
    """
    passing = at.turbine.rotor.blades * at.speed[k]
    left = 1.0 / np.hypot(1.0, passing * film.damping / film.stiffness)
    mean = abs(load.force[k, 0])
    change = THREE_P * (1.0 - float(left)) * load.surge[k] / max(mean + load.surge[k], 1.0)
    gain = gains()["thrust"]
    return {name: gain[name] * change for name in _QUANTITIES}


MOTION = _effect(
    "motion of the collar",
    _motion,
    out="films of pads are solved at rest",
    needs="films of pads in motion, which scenes do not have",
)


def _heat(
    at: Situation, collar: ThrustCollar, load: BearingLoad, k: int, film: DoubleThrustResult
) -> Sizes:
    """What the warming of the oil takes off its viscosity, at the balance of the harder film.

    Adiabatic: a pad warms its oil by D = P/(ρ c_p Q). Of what leaves at its end `CARRY_OVER` enters
    the next pad, so that with s of the oil leaving there it enters λ s D/(1 − λ s) warmer than it
    is fed, and the film is half of D warmer still.
    """
    hard = max((film.front, film.back), key=lambda row: row.force)
    oil, fed = lubricant(MODEL_OIL), collar.lubricant
    rise = hard.friction_power / (fed.density * HEAT_CAPACITY * hard.flow)
    kept = CARRY_OVER * (1.0 - float(np.sum(hard.side_flow)) / hard.flow)
    steepness = float(oil.steepness(Heat().inlet_temperature))
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


HEAT = _effect(
    "heat of the collar",
    _heat,
    out="films of pads have one viscosity, that of the oil as it is stated",
    needs="films of pads with heat, which scenes do not have",
)


def _tilt(
    at: Situation, collar: ThrustCollar, load: BearingLoad, k: int, film: DoubleThrustResult
) -> Sizes:
    """Slope of the shaft × outer radius / film, x: the film is x/(1 + 0.85 x) thinner at one side.

    Under the same load: h_min within 6 % of the change for x up to 0.8; the largest pressure grows
    by 1.4 to 2.8 x, the friction falls by 0.11 x². Pads that follow the shaft lose less.
    """
    share = float(load.slope[k]) * collar.geometry.outer_radius / film.minimum_film
    return {
        "minimum film": share / (1.0 + 0.85 * share),
        "maximum pressure": 2.5 * share,
        "friction power": 0.11 * share**2,
    }


TILT = _effect(
    "tilt of the collar",
    _tilt,
    out="pads are aligned with the collar, however the shaft bends",
    needs="a stiffer shaft, a thicker film, or pads that follow the shaft",
)


def _contact(
    at: Situation, collar: ThrustCollar, load: BearingLoad, k: int, film: DoubleThrustResult
) -> Sizes:
    """Share of the load that asperities take, as of journal films."""
    share = float(asperity_share(film.minimum_film, ROUGHNESS * collar.contact_film))
    return dict.fromkeys(_QUANTITIES, share)


CONTACT = _effect(
    "contact of the collar",
    _contact,
    out="films of pads alone carry; asperities would take load below a film parameter of 4",
    needs="films of pads with asperities, which scenes do not have",
)
