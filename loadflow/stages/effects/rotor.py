"""Effects of the simulated rotor, beyond its rungs and the grid of the wind.

How blades and tower bend stands on the rungs of the rotor, the wind's grid on those of the wind.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import UNSURE, Effect, Sizes
from loadflow.stages.effects.situation import AIR_DENSITY, FEATHERED_THRUST, Floats, Situation
from loadflow.stages.stage import with_settings
from loadflow.turbines import load_turbine
from loadflow.wind.cases import load_case

OUT = 0.75
"""Place of the section that stands for a blade, over the radius."""

SEPARATION = 0.05
"""Change of the moments' damage by dynamic stall, over the turbulence; docs/rotor.md."""

SWINGING = 10.0
"""Change of the loads of a rotor that stands, in an oblique storm, by stall; docs/rotor.md."""

COHERENCE = 0.035
"""Change of the moments' damage at 24 m/s without coherence of v and w; docs/physics.md."""

LIGHT = 0.125
"""What is left of that in light wind, over it."""

TURN = 0.015
"""Change of the moments' damage by the turn of sections bent both ways; docs/rotor.md."""

TWISTED = 3.0
"""Change of the thrust over the elastic turn of a section at three quarters of the span, rad;
IEA 15 and 22 MW, docs/rotor.md."""


def _simulated(scene: Scene) -> bool:
    return scene.loads.source == "simulate"


def _of_loads(share: float) -> Sizes:
    return dict.fromkeys(("bearing load max", "radial force max", "bearing force DEL"), share)


def _switch(
    name: str,
    key: str,
    indicator: Callable[[Situation], Sizes],
    out: str,
    cost: float,
    concerns: Callable[[Scene], bool] = _simulated,
    off: bool | None = False,
    larger: Callable[[Scene], float] = lambda scene: UNSURE,
    smaller: float = 4.0,
) -> Effect:
    """An effect that one key of the loads turns on; `cost` is the time over that without it.

    `off` is what the key says where the plan leaves the effect out.
    """
    return Effect(
        name,
        model="loads",
        keys=(f"loads.{key}",),
        is_on=lambda scene: bool(getattr(scene.loads, key)),
        switched=lambda scene, on: with_settings(scene, "loads", {key: on or off}),
        indicator=indicator,
        out=out,
        needs=f"loads.{key} = true",
        concerns=concerns,
        cost=lambda scene: cost,
        larger=larger,
        smaller=smaller,
    )


def _inflow(at: Situation) -> Sizes:
    """Share of a gust that a wake takes which follows at once, and one that lags does not.

    Blades at Ω r take the thrust per swept area ½ ρ σ 2π Ω r (V − u) of the wind V less the induced
    velocity u, with the solidity σ at `OUT` of the radius; the wake bears 2 ρ (V − u) u [Hansen
    2008]. If they balance at all times, both change by du/dV = (b − u)/(b + V − 2u), b = ½ π σ Ω r.
    Feathered blades induce nothing.
    """
    rotor, blade = at.turbine.rotor, at.turbine.blade
    radius = OUT * rotor.radius
    solidity = rotor.blades * np.interp(radius, blade.radius, blade.chord) / (2.0 * np.pi * radius)
    blades = 0.5 * np.pi * solidity * at.speed * radius
    induced = _induction(at) * at.wind_speed
    taken = (blades - induced) / (blades + at.wind_speed - 2.0 * induced)
    feathered = at.thrust_coefficient <= FEATHERED_THRUST
    return _of_loads(float(np.where(feathered, 0.0, np.abs(taken)).max()))


def _induction(at: Situation) -> Floats:
    """Induced velocity over the wind (n,): 4a(1 − a) = c_T, 4a(1 − a)² = c_P of the rated power."""
    turbine = at.turbine
    area, induction = np.pi * turbine.rotor.radius**2, np.linspace(0.0, 1.0 / 3.0, 100)
    rated = turbine.control.rated_mechanical_power / (0.5 * AIR_DENSITY * area * at.wind_speed**3)
    limited = np.interp(rated, 4.0 * induction * (1.0 - induction) ** 2, induction)
    return np.minimum(0.5 * (1.0 - np.sqrt(1.0 - at.thrust_coefficient)), limited)


INFLOW = _switch(
    "dynamic inflow",
    "dynamic_inflow",
    _inflow,
    out="no loads.dynamic_inflow: induction follows the load at once",
    cost=1.03,
    smaller=8.0,  # at 18 m/s over a pilot at 4 m/s
)


def _spectral(scene: Scene) -> bool:
    """Whether the wind is made of spectra and coherences, which fields of Mann are not."""
    turbulent = any(load_case(dlc).turbulent for dlc in scene.loads.dlcs)
    return _simulated(scene) and turbulent and scene.loads.spectrum != "mann"


def _lateral(at: Situation) -> Sizes:
    """Loads that v and w make where they swing together all over the rotor; by the cube of V.

    A share is left in light wind, where all loads fall with it. Measured without that coherence:
    damage-equivalent moments of 0.3 to 0.6 % less at 6 and 12 m/s, 0.7 to 1.2 % at 18 m/s, 3.0 to
    3.9 % at 24 m/s; extremes up to 1.8 times as much, 1 to 2 % at 6 m/s; docs/physics.md.
    """
    cube = float(np.max(at.wind_speed) / 24.0) ** 3
    share = COHERENCE * (LIGHT + (1.0 - LIGHT) * cube)
    return {**_of_loads(1.5 * share), "bearing force DEL": share}


LATERAL = Effect(
    "coherence of lateral turbulence",
    model="wind",
    keys=("loads.lateral",),
    is_on=lambda scene: scene.loads.lateral == "coherent",
    # no plan leaves it out: loads of points that know nothing of each other depend on the grid
    switched=lambda scene, on: (
        with_settings(scene, "loads", {"lateral": "coherent"}) if on else None
    ),
    indicator=_lateral,
    out='loads.lateral = "independent": v and w of any two points know nothing of each other',
    needs='loads.lateral = "coherent"',
    concerns=_spectral,
)


def _runs(scene: Scene) -> bool:
    """Whether the rotor turns with the wind in some load case."""
    return any(load_case(dlc).operating for dlc in scene.loads.dlcs)


def _stall(at: Situation) -> Sizes:
    """Swing of the angle of attack: turbulence, and the yaw error; of a rotor that stands, all."""
    if not _runs(at.scene):
        return _of_loads(SWINGING)
    yaw = max(map(abs, at.scene.loads.yaw_errors or [0.0]))
    return _of_loads(SEPARATION * (float(np.max(at.turbulence)) + yaw))


STALL = _switch(
    "dynamic stall",
    "dynamic_stall",
    _stall,
    out="no loads.dynamic_stall: separation follows lift at once",
    cost=1.03,
    # a rotor that stands has it, unless it is switched off by name
    concerns=lambda scene: (
        _simulated(scene) and (_runs(scene) or scene.loads.dynamic_stall is False)
    ),
    off=None,  # not False, by which load cases in which the rotor stands would lose it
)

BEND_TWIST = Effect(
    "turn of blades bent both ways",
    model="loads",
    keys=("loads.bend_twist",),
    is_on=lambda scene: scene.loads.bend_twist != 0,
    switched=lambda scene, on: (
        scene
        if on == (scene.loads.bend_twist != 0)
        else with_settings(scene, "loads", {"bend_twist": 0.5 if on else 0.0})
    ),
    indicator=lambda at: _of_loads(TURN),
    smaller=20.0,
    out="loads.bend_twist = 0",
    needs="loads.bend_twist = 0.5",
    concerns=_simulated,
)


def _twists(scene: Scene) -> bool:
    return _simulated(scene) and load_turbine(scene.turbine.name).blade.twists


def _torsion(at: Situation) -> Sizes:
    """Turn under the moment of the airfoils and a lift coefficient of 1, at rated speed.

    Of a rotor that does not run, in the wind and at the speed that it has.
    """
    turbine, blade = at.turbine, at.turbine.blade
    foils = [turbine.airfoils[name] for name in blade.airfoil]
    still = np.array([np.interp(0.1, f.angle, f.moment) if f.moment.size else 0 for f in foils])
    span = blade.radius - turbine.rotor.hub_radius
    ahead = np.interp(span, blade.torsion_span, blade.centre_ahead)
    speed = turbine.rated_speed * blade.radius
    if at.scene.loads.source == "simulate" and not _runs(at.scene):
        speed = np.hypot(np.max(at.speed) * blade.radius, np.max(at.wind_speed))
    couple = 0.5 * AIR_DENSITY * speed**2 * blade.chord * (still * blade.chord + ahead)
    torque = np.cumsum((couple * np.gradient(span))[::-1])[::-1]
    rigidity = np.interp(span, blade.torsion_span, blade.torsion_stiffness)
    turned = np.cumsum(torque / rigidity * np.gradient(span))
    return _of_loads(TWISTED * abs(float(np.interp(0.75 * span[-1], span, turned))))


TORSION = _switch(
    "torsion of the blades",
    "blade_torsion",
    _torsion,
    out="loads.blade_torsion = false",
    cost=1.1,
    concerns=_twists,
    larger=lambda scene: UNSURE if _runs(scene) else 15.0,  # parked in an oblique storm
)
