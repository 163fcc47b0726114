"""Reduced loads of one case → forces on the rolling elements, static safety and rating life."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.rolling import (
    Lubrication,
    bolt_loads,
    modified_spectrum_life,
    system_life,
)
from loadflow.rolling.contacts import Raceway
from loadflow.rolling.rating import life, safety
from loadflow.rolling.rings.bolts import bolts_of
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.stages.labelling import label, labelled, of_samples
from loadflow.stages.rolling_at_work import at_work, rest
from loadflow.stages.stage import (
    Link,
    Links,
    Measured,
    Rungs,
    Stage,
    always,
    kept_share,
    load_links,
    steps_of,
)
from loadflow.stages.summary import over_cases
from loadflow.stages.swinging import follows_pitch, swing_of
from loadflow.tribology import lubricant
from loadflow.wind.cases import factor_of_maximum

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
    "bearing_life": ("megarevolution", "rating life L10"),
    "bearing_modified_life": ("megarevolution", "modified life L10m, ISO 281"),
    "bearing_viscosity_ratio": ("1", "smallest viscosity ratio κ of what turns"),
    "bearing_temperature": ("K", "temperature of the bearing in its modified life"),
    "bearing_clearance": ("m", "clearance at work, as the kind of bearing states it"),
    "bearing_thin_share": ("1", "share of the revolutions with κ below 0.1, a_ISO taken as 0.1"),
    "bearing_static_safety": ("1", "smallest static safety, by force, characteristic loads"),
    "bearing_design_safety": ("1", "smallest static safety, by force, design loads"),
    "bearing_design_time": ("s", "time of the smallest static safety"),
    "bearing_load_factor": ("1", "partial safety factor for loads"),
    "bearing_truncated": ("1", "share of time with a contact cut off at a shoulder"),
    "bearing_clamping": ("1", "least share of its preload that clamps a bolted joint of a ring"),
    "bearing_axial_force": ("N", "largest force along the shaft"),
    "bearing_torque": ("N m", "largest friction torque of a slewing bearing, by its loads"),
    "bearing_pressure": ("Pa", "largest pressure"),
    "bearing_pressure_time": ("s", "time of the largest pressure"),
    "bearing_force": ("N", "largest force on a rolling element"),
}

_HARDEST = 16
"""Samples of a case that are solved again with the partial safety factor on their loads."""


def load_distribution(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.Dataset:
    """Solve the load distribution for every sample of every rolling bearing of the scene.

    Of the first bearing all samples are kept, and every ball force of the worst one; of all
    bearings what `EACH` names. The hardest samples are solved again under design loads: with the
    partial safety factor of their load case on force and moment. The modified life takes oil,
    temperature and cleanliness of ``[friction]``; with a conductance the temperature is that at
    which it carries off the mean friction of the case.

    Raises
    ------
    loadflow.errors.SolverError
        A sample has no equilibrium, or a bearing does not shed its heat.
    """
    names = list(scene.rolling.geometries)
    loads = {name: inputs["reduction"][name].to_dataset() for name in names}
    warm, answers = {}, {}
    for name in names:
        part, answer = scene.rolling.bearings[name], None
        if part.mounting is None:  # else its clearance follows its temperature
            answer = _solved(name, part, loads[name])
        warm[name] = warm_bearing(scene, name, loads[name], answer)
        answers[name] = answer or _solved(name, warm[name][0], loads[name])
    answer, reduced = answers[names[0]], loads[names[0]]
    samples = of_samples({name: getattr(answer, name) for name in KEPT}, KEPT)
    each = [
        _of_bearing(scene, case, *warm[name], answers[name], loads[name], inputs) for name in names
    ]
    whole = {
        name: ("bearing", np.array([found[name] for found in each]), label(*EACH[name]))
        for name in EACH
    } | {
        "life": ((), each[0]["bearing_life"], label("megarevolution", "rating life L10")),
        "mean_speed": ((), _mean_speed(reduced), label("rad/s", "mean speed")),
    }
    worst = int(np.argmax(answer.maximum_force))
    slope = min(bearing.weibull_slope for bearing in scene.rolling.geometries.values())
    attrs = {
        "worst_sample": worst,
        "rated_capacity": answer.bearing.rated_capacity,
        "weibull_slope": slope,
    }
    return (
        reduced[["time", "speed", "weight"]]
        .assign(samples | whole)
        .assign_coords(bearing=names)
        .assign_attrs(attrs)
        .merge(_worst(warm[names[0]][0], reduced, worst), combine_attrs="override")
    )


def solve_bearing(scene: Scene, name: str, loads: xr.Dataset) -> Any:
    """Equilibrium of one bearing, with its clearance at work, under all samples of `loads`."""
    return _solved(name, bearing_at_work(scene, name, loads), loads)


def bearing_at_work(scene: Scene, name: str, loads: xr.Dataset) -> FurtherBearing:
    """A bearing with the clearance that it has at work under all samples of `loads`."""
    part = scene.rolling.bearings[name]
    return part if part.mounting is None else warm_bearing(scene, name, loads)[0]


def warm_bearing(
    scene: Scene, name: str, loads: xr.Dataset, answer: Any = None
) -> tuple[FurtherBearing, float]:
    """A bearing with its clearance at work under all samples of `loads`; its temperature, K.

    `answer`: see `loadflow.stages.rolling_at_work.at_work`.
    """
    part, options = scene.rolling.bearings[name], scene.friction
    force, moment, speed, weight = (
        loads[what].transpose("sample", ...).values
        for what in ("force", "moment", "speed", "weight")
    )
    try:
        return at_work(part, options, force, moment, speed, weight, answer)
    except SolverError as error:
        raise SolverError(f"bearing {name}: {error}") from error


def _solved(name: str, part: FurtherBearing, loads: xr.Dataset) -> Any:
    """Equilibrium of a bearing under all samples of `loads`, or the one that they are."""
    try:
        return rest(part, *(loads[name].values for name in ("force", "moment", "speed")))
    except SolverError as error:
        raise SolverError(f"bearing {name}: {error}") from error


def _of_bearing(
    scene: Scene,
    case: Case,
    part: FurtherBearing,
    temperature: float,
    answer: Any,
    reduced: xr.Dataset,
    inputs: dict[str, Any],
) -> dict[str, float]:
    """Values of `EACH`."""
    options, weight = scene.friction, reduced["weight"].values
    lubrication = Lubrication(
        oil=lubricant(options.lubricant), temperature=temperature, cleanliness=options.cleanliness
    )
    modified = modified_spectrum_life(
        answer.bearing, answer.equivalent_load, reduced["speed"].values, lubrication, weight
    )
    swings = part.oscillation
    life = life_of(answer, reduced)
    if swings is not None:
        # in revolutions of the rotor, as all lives here: so many as it makes meanwhile
        swing = swing_of(part, inputs)
        hours = np.inf
        if swing is not None:
            hours = swing.hours(swing.life(answer.bearing, answer.equivalent_load, weight))
        turns = 3600 * _mean_speed(reduced) / (2 * np.pi)
        life = hours * turns / 1e6 if turns else np.inf
    factor = factor_of_maximum(case.dlc)
    safety, time = _design_safety(part, answer, reduced, factor)
    return {
        "bearing_life": life,
        "bearing_modified_life": modified.life if swings is None else np.nan,
        "bearing_viscosity_ratio": modified.least_viscosity_ratio,
        "bearing_temperature": temperature,
        "bearing_clearance": getattr(part.geometry, "clearance", np.nan),
        "bearing_thin_share": modified.thin_share,
        "bearing_static_safety": float(np.min(answer.static_safety)),
        "bearing_design_safety": safety,
        "bearing_design_time": time,
        "bearing_load_factor": factor,
        "bearing_truncated": _truncated_share(answer, weight),
        "bearing_clamping": _clamping(part, answer),
        "bearing_axial_force": float(np.abs(reduced["force"].values[:, 0]).max()),
        "bearing_torque": _torque(answer, part.idle_torque),
        "bearing_pressure": float(np.max(answer.maximum_pressure)),
        "bearing_pressure_time": float(reduced["time"].values[np.argmax(answer.maximum_pressure)]),
        "bearing_force": float(np.max(answer.maximum_force)),
    }


def _torque(answer: Any, idle: float) -> float:
    """Largest friction torque by the rule of the bearing's kind, N m; NaN if it has none."""
    if not answer.bearing.torque_models:
        return np.nan
    return float(np.max(answer.friction_torque(idle=idle)))


def _clamping(part: FurtherBearing, answer: Any) -> float:
    """Least clamping of bolted rings over all samples; NaN without such rings."""
    sides: tuple[tuple[Raceway, object], ...] = (
        ("inner", part.inner_ring),
        ("outer", part.outer_ring),
    )
    bolted = [side for side, ring in sides if part.rings == "flexible" and bolts_of(ring)]
    found = [one for side in bolted for one in bolt_loads(answer, side)]
    return min((float(one.clamping.min()) for one in found), default=np.nan)


def _truncated_share(answer: Any, weight: np.ndarray) -> float:
    """Share of time in which a contact ellipse reaches over a shoulder; NaN if none is given."""
    if getattr(answer.bearing, "shoulder_angle", None) is None:
        return np.nan
    return float(np.average(answer.truncated, weights=weight))


def _design_safety(
    part: FurtherBearing, answer: Any, reduced: xr.Dataset, factor: float
) -> tuple[float, float]:
    """Smallest static safety under the loads times `factor`, and its time, s; NaN without one."""
    hardest = np.argsort(answer.static_safety)[:_HARDEST]
    some = reduced.isel(sample=hardest)
    force, moment = (factor * some[name].values for name in ("force", "moment"))
    designed = rest(part, force, moment, some["speed"].values, strict=False)
    safety = np.where(designed.converged, designed.static_safety, np.nan)
    if np.isnan(safety).any():
        return np.nan, float(some["time"].values[np.argmax(np.isnan(safety))])
    return float(safety.min()), float(some["time"].values[np.argmin(safety)])


def _worst(part: FurtherBearing, reduced: xr.Dataset, worst: int) -> xr.Dataset:
    """Every ball force of the worst sample of a bearing whose balls have two diagonals."""
    bearing = part.geometry
    around = (*bearing.group_dims, bearing.element)
    if "diagonal" not in around:
        return xr.Dataset()
    hardest = _solved(part.bearing, part, reduced.isel(sample=worst))
    count = hardest.ball_forces.shape[-1]
    angle = 2 * np.pi / count * np.arange(count)
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
            bearing.rated_capacity, answer.equivalent_load, revolutions, bearing.life_exponent
        )
    )


def _mean_speed(reduced: xr.Dataset) -> float:
    return float(np.average(np.abs(reduced["speed"].values), weights=reduced["weight"].values))


def summary(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset:
    """Reduce each case to extremes and life; add the lives under all cases of each DLC together.

    ``life_hours`` is that of the first bearing, ``bearing_life_hours`` of each, and
    ``system_life_hours`` of all of them, with the smallest Weibull slope among them.
    """
    joined = over_cases({case: _extremes(part) for case, part in parts.items()})
    dlcs = np.unique(joined["dlc"])
    cases = [joined.isel(case=np.flatnonzero(joined["dlc"] == dlc)) for dlc in dlcs]
    slope = next(iter(parts.values())).attrs["weibull_slope"]
    under = "under all cases of the DLC, weighted by their share"
    found: dict[str, Any] = {}
    for kind, meaning in (("", "rating life"), ("modified_", "modified rating life")):
        each = np.stack([hours_together(part, f"bearing_{kind}life") for part in cases])
        of_all, system = f"{meaning} of each bearing", f"{meaning} of all bearings as a system"
        found |= {
            f"{kind}life_hours": ("load_case", each[:, 0], label("h", f"{meaning} {under}")),
            f"bearing_{kind}life_hours": (
                ("load_case", "bearing"), each, label("h", f"{of_all} {under}"),
            ),
            f"system_{kind}life_hours": (
                "load_case", system_hours(each, slope), label("h", f"{system} {under}"),
            ),
        }  # fmt: skip
    return joined.assign(found).assign_coords(load_case=dlcs).assign_attrs(weibull_slope=slope)


def hours_together(cases: xr.Dataset, life: str, share: np.ndarray | None = None) -> np.ndarray:
    """Life of each bearing, h: damages per hour of the cases, weighted by their share of time.

    `life` names the variable, 10⁶ revolutions; without a `share` (case,) it is that of the cases
    within their design load case.
    """
    weight = cases["weight"] if share is None else xr.DataArray(share, dims="case")
    per_hour = cases["mean_speed"] / (2 * np.pi) * 3600 / (cases[life] * 1e6)
    damage = ((per_hour * weight).sum("case", skipna=False) / weight.sum()).values
    return np.where(np.isnan(damage), np.nan, safety.ratio(1.0, damage))


def system_hours(lives: np.ndarray, slope: float) -> np.ndarray:
    """Life (..., bearing) of all bearings as a system; NaN where one of them has none."""
    known = np.isfinite(lives) | (lives == np.inf)
    together = system_life(np.where(known, lives, np.inf), slope)
    return np.where(known.all(axis=-1), together, np.nan)


def _extremes(samples: xr.Dataset) -> xr.Dataset:
    found = {
        "largest_ball_force": (
            samples["maximum_force"].max(),
            "N",
            "largest force on a rolling element",
        ),
        "largest_pressure": (samples["maximum_pressure"].max(), "Pa", "largest pressure"),
        "smallest_static_safety": (samples["static_safety"].min(), "1", "smallest static safety"),
        "smallest_pressure_safety": (
            samples["pressure_safety"].min(),
            "1",
            "smallest pressure safety",
        ),
        "life": (samples["life"], "megarevolution", "rating life"),
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


EQUILIBRIUM = Rungs(
    "rolling",
    section="rolling",
    key=rings_key,
    text=lambda scene: f"{rings_key(scene)} rings",
    error_key=lambda scene: "flexible",  # rigid rings leave out an effect
)
"""Load distribution of rolling bearings, which their friction follows, too."""

STAGE = Stage(
    "rolling",
    run=load_distribution,
    results={"rolling.loads": _contact_links, "rolling.life": _life_links},
    needs=lambda scene: ("loads", "reduction") if follows_pitch(scene) else ("reduction",),
    sections=always("rolling", "friction"),
    models=(EQUILIBRIUM,),
    summarise=summary,
    work=_work,
)
