"""A rolling bearing of a scene at work: its friction, its temperature, its clearance."""

from __future__ import annotations

from typing import Any

import numpy as np

from loadflow.errors import SolverError
from loadflow.rolling import FrictionOptions, RollingBearing
from loadflow.rolling.friction import balanced_temperature
from loadflow.rolling.rating.static import static_overload
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.friction import Friction
from loadflow.stages.frames import to_rolling
from loadflow.tribology import lubricant

Floats = np.ndarray

MOST = 250
"""Samples of a load case whose mean friction decides on the temperature of a bearing."""


def rest(
    part: FurtherBearing,
    force: Floats,
    moment: Floats,
    speed: Floats | None = None,
    *,
    strict: bool = True,
) -> Any:
    """Equilibrium of a bearing, with its rings, under loads (..., 3) in the frame of the cube.

    `speed` (...), rad/s, is that of the inertia of its balls, if the scene has it counted; without
    a speed they rest.
    """
    load = to_rolling(force), to_rolling(moment)[..., :2]
    turning = speed if part.inertia else None
    try:
        return part.modelled.equilibrium(*load, rings=part.ring_model, speed=turning, strict=strict)
    except SolverError as error:
        over = float(np.max(overload(part, force, moment), initial=0.0))
        why = f" {overloaded_words('it', over)}" if over > 1 else ""
        raise SolverError(f"{error}{why}") from error


def overload(part: FurtherBearing, force: Floats, moment: Floats) -> Floats:
    """Static load over the capacity of a bearing under loads (..., 3) in the frame of the cube."""
    push, turn = to_rolling(force), to_rolling(moment)
    radial, tilting = (np.hypot(*np.moveaxis(each[..., :2], -1, 0)) for each in (push, turn))
    return static_overload(part.geometry, radial, push[..., 2], tilting)


def overloaded_words(subject: str, over: float) -> str:
    """Say that a bearing is overloaded, and by which factor."""
    return (
        f"{subject} is overloaded: the load is {over:.3g} times its static capacity (ISO 76); a "
        "larger bearing would help"
    )


def as_stated(part: FurtherBearing, options: Friction) -> FurtherBearing:
    """Return a bearing with the clearance that it has at the temperature of the section."""
    return part.at_work(options.temperature_of(part), options.ambient_temperature)


def at_work(
    part: FurtherBearing,
    options: Friction,
    force: Floats,
    moment: Floats,
    speed: Floats,
    weight: Floats | None = None,
    answer: Any = None,
) -> tuple[FurtherBearing, float]:
    """Return a bearing with its clearance at work, and its temperature, K.

    With a conductance, the temperature is that at which it carries off the mean friction of the
    samples; where the clearance follows the temperature, friction follows the clearance. Else, and
    of bearings that swing or have no model of friction, it is that of the section. A bearing
    without a mounting keeps its clearance.

    Parameters
    ----------
    part : FurtherBearing
        As the scene has it.
    options : Friction
        Oil and cooling.
    force, moment : ndarray, shape (n, 3)
        In the frame of the cube, N and N m.
    speed, weight : ndarray, shape (n,)
        rad/s, and share of time.
    answer : RollingEquilibrium, optional
        Of a bearing without a mounting, under all samples; else `MOST` of them are looked at.

    Raises
    ------
    loadflow.errors.SolverError
        No such temperature, or no clearance at it.
    """
    ambient = options.ambient_temperature
    conductance = options.conductance_of(part)
    if conductance is None or not part.balances_heat:
        return as_stated(part, options), options.temperature_of(part)
    every = part.mounting is None and answer is not None
    count = speed.size if every else min(MOST, speed.size)
    some = np.unique(np.linspace(0, speed.size - 1, count).round().astype(int))

    def warm(temperature: float) -> Any:
        return rest(part.at_work(temperature, ambient), force[some], moment[some], speed[some])

    balance = balanced_temperature(
        warm if part.mounting is not None else answer if every else warm(ambient),
        np.abs(speed[some]),
        friction_options(options, part.geometry, part.idle_torque),
        conductance,
        ambient,
        weights=None if weight is None else weight[some],
        model=part.modelled.losses,
    )
    return part.at_work(balance.temperature, ambient), balance.temperature


TAPERED_RIB = 0.04
"""Angle between both contact normals of tapered rollers, rad, where a scene gives none: the middle
of 0.02 … 0.06."""

_RIB_HEIGHT, _RIB_RADIUS = 0.075, 50.0  # of a roller's diameter, where a scene gives none


def friction_options(
    options: Friction, bearing: RollingBearing, idle_torque: float = 0.0
) -> FrictionOptions:
    """Options of the room for a bearing, of a scene's section as it is for that one.

    `idle_torque` (N m) is that of a bearing that swings: its seals, grease and preload without
    load, beside the torque of the section's seals.

    Where the scene says nothing of ribs, tapered rollers press on theirs with `TAPERED_RIB`, at a
    height of 0.075 and with a reduced radius of 50 of a roller's diameter; others on none.
    """
    tapered = bearing.rib_guided
    diameter = getattr(bearing, "roller_diameter", 0.0)
    radius = options.rib_radius or (_RIB_RADIUS * diameter if tapered else None)
    return FrictionOptions(
        oil=lubricant(options.lubricant),
        temperature=options.temperature,
        roughness=options.roughness,
        hysteresis=options.hysteresis,
        starvation=options.starvation,
        boundary_friction=options.boundary_friction,
        rib_angle=_given(options.rib_angle, TAPERED_RIB if tapered else 0.0),
        rib_height=_given(options.rib_height, _RIB_HEIGHT * diameter),
        rib_friction=options.rib_friction,
        rib_radius=radius,
        roller_drag=options.roller_drag,
        churning=options.churning,
        seal_torque=options.seal_torque + idle_torque,
    )


def _given(value: float | None, default: float) -> float:
    return default if value is None else value
