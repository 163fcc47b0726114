"""Bearing loads of one case → friction of its rolling bearings, and slip of their rollers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.rolling import (
    BallBearing,
    FrictionOptions,
    RollerBearing,
    SlewingBearing,
    SphericalRollerBearing,
    ball_friction,
    roller_slip,
)
from loadflow.scene.cases import Case
from loadflow.scene.scene import Friction, Scene
from loadflow.stages.frames import to_rolling
from loadflow.stages.labelling import label, labelled
from loadflow.stages.summary import over_cases
from loadflow.tribology import lubricant

CHUNK = 250  # samples of a ball bearing at once: all contacts of all samples would fill the memory

# what is kept of every sample: units and meaning
KEPT = {
    "friction_power": ("W", "friction power"),
    "friction_torque": ("N m", "friction torque"),
    "film_parameter": ("1", "least Λ of the loaded contacts"),
    "slip_power": ("W", "power lost in slip of rollers"),
    "slip": ("1", "mean slip of the rollers of the slower row; balls roll ideally"),
    "slip_power_density": ("W/m2", "largest slip power over contact area"),
}


def losses(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.Dataset:
    """Losses, film and slip of each rolling bearing of the scene over (bearing, sample).

    Every roller is followed through the whole series; balls and rings take ideal rolling and rigid
    rings.

    Raises
    ------
    loadflow.errors.SolverError
        A sample has no equilibrium, the motion of rollers does not settle, or there is no friction
        model for the bearing.
    """
    options = friction_options(scene.friction)
    time = inputs["loads"]["time"].values.astype(float)
    stride = max(1, round(scene.friction.step / (time[1] - time[0])))
    time = time[::stride]
    speed = inputs["loads"]["speed"].values.astype(float)[::stride]
    found = []
    for name, bearing in scene.rolling.geometries.items():
        load, moment = (
            to_rolling(
                inputs["shaft"][what]
                .sel(bearing=name)
                .transpose("time", "axis")
                .values[::stride]
                .astype(float)
            )
            for what in ("force", "moment")
        )
        try:
            if isinstance(bearing, RollerBearing | SphericalRollerBearing):
                found.append(_rollers(bearing, load, moment[:, :2], time, speed, options))
            elif isinstance(bearing, BallBearing | SlewingBearing):
                found.append(_balls(bearing, load, moment[:, :2], speed, options))
            else:
                raise SolverError(
                    f"no model of friction for the contacts of a {type(bearing).__name__}; "
                    "rolling.friction_torque_loads estimates its torque from the loads"
                )
        except SolverError as error:
            raise SolverError(f"bearing {name}: {error}") from error
    kept = {
        name: (("bearing", "sample"), np.stack([part[name] for part in found]), label(*about))
        for name, about in KEPT.items()
    }
    return xr.Dataset(
        kept | {"speed": ("sample", speed, label("rad/s", "speed"))},
        {"sample": time, "bearing": list(scene.rolling.geometries)},
    )


def friction_options(options: Friction) -> FrictionOptions:
    """Options of the room, of a scene's section."""
    return FrictionOptions(
        oil=lubricant(options.lubricant),
        temperature=options.temperature,
        roughness=options.roughness,
        starvation=options.starvation,
        roller_drag=options.roller_drag,
        seal_torque=options.seal_torque,
    )


def _rollers(
    bearing: RollerBearing | SphericalRollerBearing,
    force: np.ndarray,
    moment: np.ndarray,
    time: np.ndarray,
    speed: np.ndarray,
    options: FrictionOptions,
) -> dict[str, np.ndarray]:
    """What is kept of a roller bearing, its rollers followed one by one."""
    result = bearing.equilibrium(force, moment)
    found = roller_slip(result, time, speed, options)
    return {
        "friction_power": found.friction.power,
        "friction_torque": found.friction.torque,
        "film_parameter": least_film_parameter(found.friction.film_parameter, result.roller_forces),
        "slip_power": found.friction.losses["slip"],
        "slip": found.slip.mean(axis=-1).max(axis=-1),
        "slip_power_density": found.slip_power_density.max(axis=(-2, -1)),
    }


def _balls(
    bearing: BallBearing | SlewingBearing,
    force: np.ndarray,
    moment: np.ndarray,
    speed: np.ndarray,
    options: FrictionOptions,
) -> dict[str, np.ndarray]:
    """What is kept of a ball bearing in ideal rolling."""
    parts = []
    for start in range(0, speed.size, CHUNK):
        some = slice(start, start + CHUNK)
        result = bearing.equilibrium(force[some], moment[some])
        found = ball_friction(result, speed[some], options)
        least = least_film_parameter(found.film_parameter, result.ball_forces)
        parts.append((found.power, found.torque, least))
    power, torque, least = (np.concatenate(values) for values in zip(*parts))
    none = np.zeros_like(power)
    return dict(zip(KEPT, (power, torque, least, none, none, none)))


def least_film_parameter(parameter: np.ndarray, forces: np.ndarray) -> np.ndarray:
    """Least Λ of the loaded contacts of each sample, infinite where there are none."""
    loaded = forces.reshape(parameter.shape[:-1])[..., None] > 0
    kept = np.where(loaded, parameter, np.inf)
    return np.asarray(kept.reshape(len(kept), -1).min(axis=-1))


def summary(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset:
    """Reduce each case to means and extremes; dimensions ``bearing`` and ``case``."""
    return over_cases({case: _extremes(part) for case, part in parts.items()})


def _extremes(samples: xr.Dataset) -> xr.Dataset:
    mean, largest = samples.mean("sample"), samples.max("sample")
    least = samples["film_parameter"].median("sample")
    return labelled(
        {
            "mean_friction_power": (mean["friction_power"], "W", "mean friction power"),
            "mean_friction_torque": (mean["friction_torque"], "N m", "mean friction torque"),
            "mean_slip_power": (mean["slip_power"], "W", "mean power lost in slip"),
            "median_film_parameter": (least, "1", "median of the least Λ"),
            "mean_slip": (mean["slip"], "1", "mean slip of the slower row"),
            "largest_slip_power_density": (
                largest["slip_power_density"],
                "W/m2",
                "largest slip power over contact area",
            ),
        }
    )
