"""Bearing loads of one case → friction of its rolling bearings, and slip of their rollers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.rolling import FrictionOptions, roller_slip
from loadflow.rolling.friction import torques_beside
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.stages.effects.roller_profile import SLICED_COSTS
from loadflow.stages.labelling import label, labelled
from loadflow.stages.rolling import EQUILIBRIUM
from loadflow.stages.rolling_at_work import at_work, friction_options, rest
from loadflow.stages.running_time import counted, time_shares, with_running
from loadflow.stages.stage import (
    STEPS_PER_CASE,
    Link,
    Links,
    Measured,
    Rungs,
    Stage,
    always,
    load_links,
)
from loadflow.stages.summary import over_cases
from loadflow.stages.swinging import swing_speed

CHUNK = 250  # samples of a ball bearing at once: all contacts of all samples would fill the memory

# what is kept of every sample: units and meaning
KEPT = {
    "friction_power": ("W", "friction power"),
    "friction_torque": ("N m", "friction torque"),
    "film_parameter": ("1", "least Λ of the loaded contacts"),
    "slip_power": ("W", "power lost in slip, differential slip with it"),
    "differential_slip_power": ("W", "power lost in differential slip of curved contacts"),
    "slip": ("1", "slip of the slower row: missing spin of rollers, mean sliding of balls"),
    "slip_power_density": ("W/m^2", "largest slip power over contact area"),
}

CATALOGUES = {
    "palmgren": ("palmgren_torque", "Palmgren"),
    "constant coefficient": ("constant_coefficient_torque", "a constant coefficient of catalogues"),
    "skf": ("skf_torque", "SKF"),
}
"""Variable and words of the torque after each catalogue, of those bearings that have it."""


def losses(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.Dataset:
    """Losses, film and slip of each rolling bearing of the scene over (bearing, sample).

    Every roller, or one in `follow_every`, is followed through the whole series; balls and barrels
    slide where their contacts are curved, balls where they spin; bearings that swing have their
    mean speed, or that of the pitch, and their torque without load. Rings are those of the scene.
    With a conductance each bearing that turns finds its own temperature.

    Raises
    ------
    loadflow.errors.SolverError
        A sample has no equilibrium, the motion of rollers does not converge, or there is no
        friction model for the bearing.
    """
    time = inputs["loads"]["time"].values.astype(float)
    stride = max(1, round(scene.friction.step / (time[1] - time[0])))
    time = time[::stride]
    speed = inputs["loads"]["speed"].values.astype(float)[::stride]
    found, temperatures, every = [], [], scene.friction.follow_every
    for name, part in scene.rolling.bearings.items():
        turning = speed
        if part.oscillation is not None:
            turning = swing_speed(part, inputs["loads"], slice(None, None, stride))
        load, moment = (
            inputs["shaft"][what]
            .sel(bearing=name)
            .transpose("time", "axis")
            .values[::stride]
            .astype(float)
            for what in ("force", "moment")
        )
        try:
            warm, temperature = at_work(part, scene.friction, load, moment, turning)
            options = friction_options(scene.friction, warm.modelled, part.idle_torque)
            options = replace(options, temperature=temperature)
            follow = _FOLLOW[part.geometry.friction_model]
            found.append(follow(warm, load, moment, time, turning, options, every))
            temperatures.append(temperature)
        except SolverError as error:
            raise SolverError(f"bearing {name}: {error}") from error
    kept = {
        name: (("bearing", "sample"), np.stack([part[name] for part in found]), label(*about))
        for name, about in KEPT.items()
    } | _beside(found, speed.size)
    samples = xr.Dataset(
        kept
        | {
            "speed": ("sample", speed, label("rad/s", "speed")),
            "temperature": ("bearing", temperatures, label("K", "temperature of the bearing")),
        },
        {"sample": time, "bearing": list(scene.rolling.geometries)},
    )
    samples, parts = with_running(scene, samples), scene.rolling.bearings.values()
    if any(swinging := [part.oscillation is not None for part in parts]):  # whatever the rotor does
        samples["running"] = samples["running"] | xr.DataArray(swinging, dims="bearing")
    return samples


def _beside(found: list[dict[str, Any]], size: int) -> dict[str, Any]:
    """Torques after the catalogues that know any of the bearings; NaN of those they do not know."""
    unknown = np.full(size, np.nan)
    return {
        name: (
            ("bearing", "sample"),
            np.stack([part["catalogues"].get(key, unknown) for part in found]),
            label("N m", f"friction torque after {words}, for comparison"),
        )
        for key, (name, words) in CATALOGUES.items()
        if any(key in part["catalogues"] for part in found)
    }


def _rollers(
    part: FurtherBearing,
    force: np.ndarray,
    moment: np.ndarray,
    time: np.ndarray,
    speed: np.ndarray,
    options: FrictionOptions,
    every: int,
) -> dict[str, Any]:
    """What is kept of a roller bearing, `every` so many of its rollers followed one by one."""
    result: Any = rest(part, force, moment, speed)
    rollers = result.bearing.rollers
    every = min(every, rollers)
    found = roller_slip(result, time, speed, options, every=every)
    density = np.repeat(found.slip_power_density, every, axis=-1)[..., :rollers]
    if found.friction.slip_power_density is not None:  # of barrels, which slide all the time
        density = density + found.friction.slip_power_density
    curved = found.friction.losses.get("differential slip", np.zeros_like(speed))
    return {
        "friction_power": found.friction.power,
        "friction_torque": found.friction.torque,
        "film_parameter": least_film_parameter(found.friction.film_parameter, result.roller_forces),
        "slip_power": found.friction.losses["slip"] + curved,
        "differential_slip_power": curved,
        "slip": found.slip.mean(axis=-1).max(axis=-1),
        "slip_power_density": density.max(axis=(-2, -1)),
        "catalogues": torques_beside(result, speed, options, part.catalogue),
    }


def _balls(
    part: FurtherBearing,
    force: np.ndarray,
    moment: np.ndarray,
    time: np.ndarray,
    speed: np.ndarray,
    options: FrictionOptions,
    every: int,
) -> dict[str, Any]:
    """What is kept of a ball bearing, whose balls keep up with the cage."""
    parts = []
    for start in range(0, speed.size, CHUNK):
        some = slice(start, start + CHUNK)
        result = rest(part, force[some], moment[some], speed[some])
        found = result.friction(speed[some], options)
        least = least_film_parameter(found.film_parameter, result.ball_forces)
        curved = found.losses["differential slip"]
        slip = curved + found.losses["spin"]
        assert found.sliding is not None
        assert found.slip_power_density is not None
        mean = mean_of_loaded(found.sliding, result.ball_forces)
        density = found.slip_power_density.max(axis=(-2, -1))
        kept = dict(
            zip(KEPT, (found.power, found.torque, least, slip, curved, mean, density), strict=True)
        )
        parts.append((kept, torques_beside(result, speed[some], options, part.catalogue)))
    whole, beside = (
        {name: np.concatenate([part[name] for part in some]) for name in some[0]}
        for some in zip(*parts)
    )
    return whole | {"catalogues": beside}


def _unknown(part: FurtherBearing, *_: Any) -> dict[str, Any]:
    raise SolverError(
        f"no model of friction for the contacts of a {type(part.geometry).__name__}; "
        "rolling.friction_torque_loads estimates its torque from the loads"
    )


_FOLLOW = {"rollers": _rollers, "balls": _balls, None: _unknown}


def mean_of_loaded(sliding: np.ndarray, forces: np.ndarray) -> np.ndarray:
    """Mean over the loaded contacts of the row that slides most; 0 without load."""
    loaded = forces.reshape(sliding.shape) > 0
    count = np.maximum(loaded.sum(axis=-1), 1)
    return np.asarray(((sliding * loaded).sum(axis=-1) / count).max(axis=-1))


def least_film_parameter(parameter: np.ndarray, forces: np.ndarray) -> np.ndarray:
    """Least Λ of the loaded contacts of each sample, infinite where there are none."""
    loaded = forces.reshape(parameter.shape[:-1])[..., None] > 0
    kept = np.where(loaded, parameter, np.inf)
    return np.asarray(kept.reshape(len(kept), -1).min(axis=-1))


def summary(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset:
    """Reduce each case to means and extremes; dimensions ``bearing`` and ``case``."""
    return over_cases({case: extremes(part) for case, part in parts.items()})


def extremes(samples: xr.Dataset) -> xr.Dataset:
    """Means and extremes of a case."""
    largest, runs = samples.max("sample"), samples.where(counted(samples))
    mean, least = runs.mean("sample"), runs["film_parameter"].median("sample")
    return labelled(
        {
            "mean_friction_power": (mean["friction_power"], "W", "mean friction power"),
            "mean_friction_torque": (mean["friction_torque"], "N m", "mean friction torque"),
            **_mean_beside(mean),
            "mean_slip_power": (mean["slip_power"], "W", "mean power lost in slip"),
            "mean_differential_slip_power": (
                mean["differential_slip_power"],
                "W",
                "mean power lost in differential slip of curved contacts",
            ),
            "median_film_parameter": (least, "1", "median of the least Λ"),
            **time_shares(samples, samples["friction_power"]),
            "mean_slip": (mean["slip"], "1", "mean slip of the slower row"),
            "temperature": (samples["temperature"], "K", "temperature of the bearing"),
            "largest_slip_power_density": (
                largest["slip_power_density"],
                "W/m^2",
                "largest slip power over contact area",
            ),
        }
    )


def _mean_beside(mean: xr.Dataset) -> dict[str, Any]:
    """Mean torques after catalogues, beside our own."""
    return {
        f"mean_{name}": (mean[name], "N m", f"mean friction torque after {words}, for comparison")
        for name, words in CATALOGUES.values()
        if name in mean
    }


def _has_rollers(scene: Scene) -> bool:
    return any(one.friction_model == "rollers" for one in scene.rolling.geometries.values())


def friction_key(scene: Scene) -> str:
    """Name of the friction in the ladder: rollers are followed one by one, balls roll ideally."""
    if not _has_rollers(scene):
        return f"balls, every {scene.friction.step:g} s"
    every = scene.friction.follow_every
    some = f", 1 in {every} followed" if every > 1 else ""
    return f"rollers, every {scene.friction.step:g} s{some}"


def _links(scene: Scene) -> Links:
    """Losses, film and slip are means over a series: a coarser wind reaches them by its mean load.

    What the rotor leaves out counts by what it does to the largest one, of which more is known.
    """
    wind, rotor, suspension = load_links("bearing load max")
    wind = replace(wind, quantity="bearing load mean")
    return {
        quantity: (
            wind,
            rotor,
            suspension,
            Link(EQUILIBRIUM.name, quantity),
            Link("friction", quantity),
        )
        for quantity in ("friction power", "film parameter", "slip")
    }


def _more_seconds(scene: Scene, measured: Measured) -> float | None:
    """Seconds of the load distribution of a load case beyond that which friction was timed with.

    That was with rigid rings, and with rollers in slices.
    """
    own, rigid = measured(scene, EQUILIBRIUM.name), measured(scene, EQUILIBRIUM.name, "rigid")
    if own is None or rigid is None:
        return None
    steps = STEPS_PER_CASE * min(1.0, scene.loads.step / scene.friction.step)
    timed = SLICED_COSTS["rigid"] if _has_rollers(scene) else 1.0
    more = own["seconds_per_sample"] - timed * rigid["seconds_per_sample"]
    return float(steps * len(scene.rolling.bearings) * more)


STAGE = Stage(
    "friction",
    run=losses,
    results={"rolling.friction": _links},
    needs=always("loads", "shaft"),
    sections=always("rolling", "friction"),
    models=(EQUILIBRIUM, Rungs("friction", section="friction", key=friction_key)),
    more_seconds=_more_seconds,
    summarise=summary,
)
