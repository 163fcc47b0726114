"""Reduced loads of one case → forces on the rolling elements, static safety and rating life."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.rolling import SlewingBearing, system_life
from loadflow.rolling.bearings.arrangements import life_exponent, weibull_slope
from loadflow.rolling.rating import life, safety
from loadflow.rolling.rating.static import HOURS_20_YEARS, STATIC_RATING
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.stages.frames import to_rolling
from loadflow.stages.labelling import label, labelled, of_samples
from loadflow.stages.reduction import kept_share
from loadflow.stages.stage import Link, Links, Measured, Rungs, Stage, always, load_links, steps_of
from loadflow.stages.summary import over_cases

# what is kept of every sample: units and meaning
KEPT = {
    "maximum_force": ("N", "largest contact force"),
    "maximum_pressure": ("Pa", "largest contact pressure"),
    "equivalent_load": ("N", "dynamic equivalent load"),
    "pressure_safety": ("1", "static safety, by pressure"),
    "static_safety": ("1", "static safety, by force"),
    "converged": ("1", "whether the equilibrium was found"),
    "residual": ("1", "scaled residual of the equilibrium"),
    "iterations": ("1", "iterations"),
}


# what is kept of each bearing of the shaft: units and meaning
EACH = {
    "bearing_life": ("1e6 rev", "rating life L10"),
    "bearing_static_safety": ("1", "smallest static safety, by force"),
    "bearing_pressure": ("Pa", "largest pressure"),
    "bearing_force": ("N", "largest force on a rolling element"),
}


def balls(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.Dataset:
    """Solve the load distribution for every sample of every rolling bearing of the scene.

    Of the first bearing all samples are kept, and every ball force of the worst one; of all
    bearings what `EACH` names.

    Raises
    ------
    loadflow.errors.SolverError
        A sample has no equilibrium.
    """
    first, *others = scene.rolling.geometries
    reduced = inputs["reduction"][first].to_dataset()
    answer = solve_bearing(scene, first, reduced)
    samples = of_samples({name: getattr(answer, name) for name in KEPT}, KEPT)
    each = [_of_bearing(answer, reduced)]
    for name in others:
        other = inputs["reduction"][name].to_dataset()
        each.append(_of_bearing(solve_bearing(scene, name, other), other))
    whole = {
        name: ("bearing", np.array(values), label(*EACH[name]))
        for name, values in zip(EACH, zip(*each))
    } | {
        "life": ((), life_of(answer, reduced), label("1e6 rev", "rating life L10")),
        "mean_speed": ((), _mean_speed(reduced), label("rad/s", "mean speed")),
    }
    worst = int(np.argmax(answer.maximum_force))
    slope = min(weibull_slope(bearing) for bearing in scene.rolling.geometries.values())
    attrs = {
        "worst_sample": worst,
        "rated_capacity": answer.bearing.rated_capacity,
        "weibull_slope": slope,
    }
    return (
        reduced[["time", "speed", "weight"]]
        .assign(samples | whole)
        .assign_coords(bearing=[first, *others])
        .assign_attrs(attrs)
        .merge(_worst(scene, reduced, worst), combine_attrs="override")
    )


def solve_bearing(scene: Scene, name: str, loads: xr.Dataset) -> Any:
    """Equilibrium of one bearing under all samples of `loads`, or the one that they are."""
    try:
        return rest(scene.rolling.bearings[name], loads["force"].values, loads["moment"].values)
    except SolverError as error:
        raise SolverError(f"bearing {name}: {error}") from error


def rest(part: FurtherBearing, force: np.ndarray, moment: np.ndarray, strict: bool = True) -> Any:
    """Equilibrium of a bearing, with its rings, under loads (..., 3) in the frame of the cube."""
    bearing = part.geometry
    load = to_rolling(force), to_rolling(moment)[..., :2]
    if isinstance(bearing, SlewingBearing):
        return bearing.equilibrium(*load, rings=part.ring_model, strict=strict)
    return bearing.equilibrium(*load, strict=strict)


def _of_bearing(answer: Any, reduced: xr.Dataset) -> tuple[float, float, float, float]:
    """Values of `EACH`."""
    return (
        life_of(answer, reduced),
        float(np.min(answer.static_safety)),
        float(np.max(answer.maximum_pressure)),
        float(np.max(answer.maximum_force)),
    )


def _worst(scene: Scene, reduced: xr.Dataset, worst: int) -> xr.Dataset:
    """Every ball force of the worst sample of a slewing bearing."""
    bearing = scene.rolling.geometry
    if not isinstance(bearing, SlewingBearing):
        return xr.Dataset()
    hardest = solve_bearing(scene, scene.rolling.bearing, reduced.isel(sample=worst))
    around = ("row", "diagonal", "ball")
    angle = 2 * np.pi / bearing.balls * np.arange(bearing.balls)
    angles = label("rad", "operating contact angle, worst sample")
    return xr.Dataset(
        {
            "ball_forces": (
                around,
                hardest.ball_forces,
                label("N", "contact force, worst sample"),
            ),
            "contact_angles": (around, hardest.contact_angles, angles),
        },
        {"ball_angle": ("ball", angle, label("rad", "angle from y toward z"))},
    )


def life_of(answer: Any, reduced: xr.Dataset) -> float:
    """Rating life under the case alone, each sample weighted by its revolutions (4.5)."""
    revolutions = np.abs(reduced["speed"].values) * reduced["weight"].values
    if not revolutions.any():
        return np.inf
    bearing = answer.bearing
    return float(
        life.rating_life_spectrum(
            bearing.rated_capacity, answer.equivalent_load, revolutions, life_exponent(bearing)
        )
    )


def _mean_speed(reduced: xr.Dataset) -> float:
    return float(np.average(np.abs(reduced["speed"].values), weights=reduced["weight"].values))


def summary(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset:
    """Reduce each case to extremes and life; add the lives under all cases of each DLC together.

    ``life_hours`` is that of the first bearing, ``bearing_life_hours`` of each, and
    ``system_life_hours`` of all of them, with the smallest Weibull slope among them. What ends in
    ``_holds`` is the verdict of IEC 61400-1: lives of 20 years, static ratings over the load.
    """
    joined = over_cases({case: _extremes(part) for case, part in parts.items()})
    dlcs = np.unique(joined["dlc"])
    cases = [joined.isel(case=np.flatnonzero(joined["dlc"] == dlc)) for dlc in dlcs]
    each = np.stack([_together(part) for part in cases])
    slope = next(iter(parts.values())).attrs["weibull_slope"]
    under = "under all cases of the DLC, weighted by their share"
    first = label("h", f"rating life {under}")
    together = label("h", f"rating life of all bearings as a system {under}")
    of_all = label("h", f"rating life of each bearing {under}")
    system = system_life(each, slope)
    static = joined["bearing_static_safety"].min("case").values[:, None] >= STATIC_RATING
    years = label("1", "whether it reaches 20 years")
    rating = label("1", "whether the static safety reaches the limit in all cases")
    return joined.assign(
        life_hours=("load_case", each[:, 0], first),
        bearing_life_hours=(("load_case", "bearing"), each, of_all),
        system_life_hours=("load_case", system, together),
        bearing_life_holds=(("load_case", "bearing"), each >= HOURS_20_YEARS, years),
        system_life_holds=("load_case", system >= HOURS_20_YEARS, years),
        static_rating_holds=(("bearing", "static_limit"), static, rating),
    ).assign_coords(load_case=dlcs, static_limit=("static_limit", list(STATIC_RATING)))


def _together(cases: xr.Dataset) -> np.ndarray:
    """Life of each bearing, h: damages per hour of the cases, weighted by share of the lifetime."""
    per_hour = cases["mean_speed"] / (2 * np.pi) * 3600 / (cases["bearing_life"] * 1e6)
    total = (per_hour * cases["weight"]).sum("case") / cases["weight"].sum()
    return safety.ratio(1.0, total.values)


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
        **{name: (samples[name], *labels) for name, labels in EACH.items()},
        "mean_speed": (samples["mean_speed"], "rad/s", "mean speed"),
        "largest_residual": (samples["residual"].max(), "1", "largest residual"),
        "not_converged": (
            (~samples["converged"].astype(bool)).sum(),
            "1",
            "samples not converged",
        ),
    }
    return labelled(found)


def rings_key(scene: Scene) -> str:
    """Name of the rings in the ladder."""
    return scene.rolling.rung


def _contact_links(scene: Scene) -> Links:
    return {
        quantity: (
            *load_links("bearing load max"),
            Link("reduction", "largest load", of_load=True),
            Link("rolling", quantity),
        )
        for quantity in ("maximum force", "maximum pressure")
    }


def _life_links(scene: Scene) -> Links:
    ends = (Link("reduction", "life"), Link("rolling", "life"))
    return {"life": (*load_links("bearing force DEL"), *ends)}


def _work(scene: Scene, cases: tuple[Case, ...], measured: Measured) -> float:
    return kept_share(scene, measured) * steps_of(cases)


STAGE = Stage(
    "rolling",
    run=balls,
    results={"rolling.loads": _contact_links, "rolling.life": _life_links},
    needs=always("reduction"),
    sections=always("rolling"),
    models=(
        Rungs(
            "rolling",
            section="rolling",
            key=rings_key,
            error_key=lambda scene: "flexible",  # rigid rings leave out an effect
        ),
    ),
    summarise=summary,
    work=_work,
)
