"""Reduced loads of one case → forces on the rolling elements, static safety and rating life."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.rolling import life
from loadflow.scene import Scene
from loadflow.stages.cases import Case
from loadflow.stages.frames import to_rolling
from loadflow.stages.summary import over_cases

# what is kept of every sample: units and meaning
KEPT = {
    "maximum_force": ("N", "largest contact force"),
    "maximum_pressure": ("Pa", "largest contact pressure"),
    "equivalent_load": ("N", "equivalent axial load"),
    "pressure_safety": ("1", "static safety, by pressure"),
    "static_safety": ("1", "static safety, by force"),
    "converged": ("1", "whether the equilibrium was found"),
    "residual": ("1", "scaled residual of the equilibrium"),
    "iterations": ("1", "iterations"),
}


def balls(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.Dataset:
    """Solve the load distribution for every sample; keep every ball force of the worst one.

    Raises
    ------
    loadflow.errors.SolverError
        A sample has no equilibrium.
    """
    bearing, rings = scene.rolling.geometry, scene.rolling.ring_model
    reduced = inputs["reduction"][scene.rolling.bearing].to_dataset()
    force = to_rolling(reduced["force"].values)
    moment = to_rolling(reduced["moment"].values)[:, :2]
    try:
        answer = bearing.equilibrium(force=force, moment=moment, rings=rings)
    except SolverError as error:
        raise SolverError(f"bearing {scene.rolling.bearing}: {error}") from error
    worst = int(np.argmax(answer.maximum_force))
    hardest = bearing.equilibrium(force=force[worst], moment=moment[worst], rings=rings)
    samples = {
        name: ("sample", np.asarray(getattr(answer, name)), {"units": units, "long_name": meaning})
        for name, (units, meaning) in KEPT.items()
    }
    around = ("row", "diagonal", "ball")
    worst_sample = {
        "ball_forces": (around, hardest.ball_forces, _label("N", "contact force, worst sample")),
        "contact_angles": (
            around,
            hardest.contact_angles,
            _label("rad", "operating contact angle, worst sample"),
        ),
        "life": ((), _life(answer, reduced), _label("1e6 rev", "rating life L10")),
        "mean_speed": ((), _mean_speed(reduced), _label("rad/s", "mean speed")),
    }
    angle = 2 * np.pi / bearing.balls * np.arange(bearing.balls)
    return (
        reduced[["time", "speed", "weight"]]
        .assign(samples | worst_sample)
        .assign_coords(ball_angle=("ball", angle, _label("rad", "angle from y toward z")))
        .assign_attrs(worst_sample=worst, rated_capacity=bearing.rated_capacity)
    )


def _label(units: str, long_name: str) -> dict[str, str]:
    return {"units": units, "long_name": long_name}


def _life(answer: Any, reduced: xr.Dataset) -> float:
    """Rating life under the case alone, each sample weighted by its revolutions (4.5)."""
    revolutions = np.abs(reduced["speed"].values) * reduced["weight"].values
    if not revolutions.any():
        return np.inf
    return float(
        life.rating_life_spectrum(
            answer.bearing.rated_capacity, answer.equivalent_load, revolutions
        )
    )


def _mean_speed(reduced: xr.Dataset) -> float:
    return float(np.average(np.abs(reduced["speed"].values), weights=reduced["weight"].values))


def summary(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset:
    """Reduce each case to extremes and life; add the life under all cases of each DLC together."""
    joined = over_cases({case: _extremes(part) for case, part in parts.items()})
    dlcs = np.unique(joined["dlc"])
    hours = [_together(joined.isel(case=np.flatnonzero(joined["dlc"] == dlc))) for dlc in dlcs]
    label = _label("h", "rating life under all cases of the DLC, weighted by their share")
    return joined.assign(life_hours=("load_case", hours, label)).assign_coords(load_case=dlcs)


def _together(cases: xr.Dataset) -> float:
    """Life in hours: damages per hour of the cases, weighted by their share of the lifetime."""
    damage_per_hour = cases["mean_speed"] / (2 * np.pi) * 3600 / (cases["life"] * 1e6)
    total = float((damage_per_hour * cases["weight"]).sum() / cases["weight"].sum())
    return 1 / total if total > 0 else np.inf


def _extremes(samples: xr.Dataset) -> xr.Dataset:
    found = {
        "largest_ball_force": (samples["maximum_force"].max(), "N", "largest ball force"),
        "largest_pressure": (samples["maximum_pressure"].max(), "Pa", "largest pressure"),
        "smallest_static_safety": (samples["static_safety"].min(), "1", "smallest static safety"),
        "smallest_pressure_safety": (
            samples["pressure_safety"].min(),
            "1",
            "smallest pressure safety",
        ),
        "life": (samples["life"], "1e6 rev", "rating life"),
        "mean_speed": (samples["mean_speed"], "rad/s", "mean speed"),
        "largest_residual": (samples["residual"].max(), "1", "largest residual"),
        "not_converged": (
            (~samples["converged"].astype(bool)).sum(),
            "1",
            "samples not converged",
        ),
    }
    return xr.Dataset(
        {name: value.assign_attrs(_label(u, text)) for name, (value, u, text) in found.items()}
    )
