"""Hub loads → what the shaft applies to each bearing."""

from __future__ import annotations

import warnings as told
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError, ValidityWarning
from loadflow.quantities import percent
from loadflow.scene.cases import Case
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.scene.shaft import SWINGING
from loadflow.scene.shaft_place import any_moves_in_films, seats_felt
from loadflow.shaft import Concept, CoupledBearing, coupled_loads, pitch_loads, yaw_loads
from loadflow.shaft import bearing_loads as reactions
from loadflow.stages.bores import ALIGNED, bores, turned_bores, with_bores
from loadflow.stages.frames import to_film
from loadflow.stages.labelling import labelled
from loadflow.stages.shaft_in_films import STILL, followed_together, shaft_on_films
from loadflow.stages.stage import STEPS_PER_CASE, Measured, Rungs, Stage, always, steps_of
from loadflow.stages.summary import over_cases
from loadflow.stages.swinging import root_loads

Floats = np.ndarray

_GLIDING = 0.1  # share of the largest speed, above which a film changes with its logarithm


def bearing_loads(
    scene: Scene, case: Case, inputs: dict[str, Any], follows: bool = True
) -> xr.Dataset:
    """Return `force` and `moment` (bearing, axis, time) of all suspensions of the scene.

    Where a shaft is a beam, also its `displacement`, `tilt` and `curvature` in each bearing; they
    are NaN in bearings of a rigid shaft beside it. `tilt` is that against the bore. Where the
    stiffness of supports comes from the scene's bearings, `converged` tells in which samples it
    does; in the others, such as of a film at standstill, these bearings are rigid. Unless it
    `follows` shafts that move in their films, these lie on rigid bearings that they turn freely in.
    """
    from loadflow.turbines import load_turbine

    series = inputs["loads"].load()
    tilt = load_turbine(scene.turbine.name).rotor.tilt
    force, moment = (
        series[name].transpose("axis", "time").values.astype(float)
        for name in ("hub_force", "hub_moment")
    )
    speed = series["speed"].values.astype(float)

    def lies(concept: Concept) -> xr.Dataset:
        if followed_together(scene, concept, speed):
            lying = partial(_with_films, scene) if follows else _freely
            return lying(concept, series, tilt)
        if seats_felt(scene.shaft, scene.journal, concept):
            return _freely(concept, series, tilt)
        return _suspended(scene, concept, force, moment, speed, tilt)

    parts = [lies(concept) for concept in scene.shaft.concepts]
    if scene.shaft.yaw is not None:
        parts.append(yaw_loads(scene.shaft.yaw, force, moment, tilt=tilt))
    if scene.shaft.pitch is not None:
        parts.append(pitch_loads(scene.shaft.pitch, *root_loads(series)))
    joined = xr.concat(parts, "bearing", combine_attrs="drop_conflicts").assign_attrs(_worst(parts))
    joined = with_bores(scene, joined)
    return joined.assign_coords(time=series["time"]).astype("float32")


def _suspended(
    scene: Scene, concept: Concept, force: Floats, moment: Floats, speed: Floats, tilt: float
) -> xr.Dataset:
    supports = {name: s for name, s in scene.shaft.coupled.items() if name in concept.bearings}
    if not supports:
        return _against_bores(reactions(concept, force, moment, tilt=tilt))
    rigid = reactions(replace(concept, beam=None), force, moment, tilt=tilt)
    thrust = dict(zip(concept.bearings, rigid["force"].values[:, 0]))
    films = any(support.stiffness == "journal" for support in supports.values())
    turned = bores(scene) if films else {}
    bearings = {
        name: _film(scene.journal.at(name), speed, support.takes_moment, turned[name])
        if support.stiffness == "journal"
        else _rolling(scene, name, thrust[name], support.takes_moment)
        for name, support in supports.items()
    }
    return _against_bores(coupled_loads(concept, force, moment, bearings, tilt=tilt))


def _with_films(scene: Scene, concept: Concept, series: xr.Dataset, tilt: float) -> xr.Dataset:
    """A shaft in motion with its films; where that path stops on rigid bearings, with a warning.

    It turns freely in these: clamped it would tell moments that no film takes.
    """
    try:
        return _against_bores(shaft_on_films(scene, concept, series, tilt))
    except SolverError as error:
        assert concept.beam is not None
        told.warn(
            f"shaft and films in motion together: {error}; the shaft lies on rigid bearings",
            ValidityWarning,
            stacklevel=2,
        )
    return _freely(concept, series, tilt)


def _freely(concept: Concept, series: xr.Dataset, tilt: float) -> xr.Dataset:
    """A shaft on rigid bearings that it turns freely in, in no sample on its own ones."""
    assert concept.beam is not None
    loads = (
        series[name].transpose("axis", "time").values.astype(float)
        for name in ("hub_force", "hub_moment")
    )
    freely = concept.beam.free_in_films().on_rigid_bearings()
    rigid = reactions(replace(concept, beam=freely), *loads, tilt=tilt)
    flags = np.zeros((rigid.sizes["bearing"], rigid.sizes["time"]), dtype=bool)
    meaning = {"units": "1", "long_name": "whether shaft and bearings agree"}
    none = {"solved": 0, "interpolation_error": 0.0}
    found = rigid.assign(converged=(("bearing", "time"), flags, meaning))
    return _against_bores(found.assign_attrs(none))


def _worst(parts: list[xr.Dataset]) -> dict[str, float]:
    """How shaft and bearings were iterated, of the suspension that it was hardest for."""
    told = {
        name: [part.attrs[name] for part in parts if name in part.attrs]
        for name in ("converged", *_TOLD)
    }
    pick = {"converged": min}
    return {name: pick.get(name, max)(values) for name, values in told.items() if values}


def _film(options: Journal, speed: Floats, tilting: bool, bore: Floats) -> CoupledBearing:
    from loadflow.stages.films.support import film_model

    fastest = float(np.abs(speed).max())
    return CoupledBearing(
        lambda rows: film_model(options, speed[rows], tilting=tilting, strict=False, bore=bore),
        state=np.arcsinh(speed / (_GLIDING * fastest or 1.0)),
        idle=np.abs(speed) <= STILL * fastest,
    )


def _rolling(scene: Scene, name: str, thrust: Floats, tilting: bool) -> CoupledBearing:
    from loadflow.stages.rolling_at_work import as_stated
    from loadflow.stages.rolling_support import rolling_model

    part = as_stated(scene.rolling.bearings[name], scene.friction)
    return CoupledBearing(
        lambda rows: rolling_model(part, thrust[rows], tilting=tilting, strict=False),
        state=thrust,
        idle=np.zeros(thrust.size, dtype=bool),
        cheap=part.rings == "rigid",
    )


def _against_bores(found: xr.Dataset) -> xr.Dataset:
    """`found`, with the tilt of the shaft in each bearing less that of the bearing's bore."""
    if "bore_tilt" not in found:
        return found
    tilt = (found["tilt"] - found["bore_tilt"]).assign_attrs(found["tilt"].attrs)
    return found.assign(tilt=tilt).drop_vars("bore_tilt")


def summary(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset:
    """Largest loads of each place in each case; also how shaft and bearings agree, if iterated."""
    largest: dict[Case, xr.Dataset] = {}
    agreement: dict[Case, xr.Dataset] = {}
    for case, part in parts.items():  # each is read once
        largest[case] = _largest(part)
        if "converged" in part:
            agreement[case] = _agreement(part)
    if len(agreement) == len(largest):
        largest = {case: found.merge(agreement[case]) for case, found in largest.items()}
    return over_cases(largest)


def _largest(part: xr.Dataset) -> xr.Dataset:
    """Largest radial load of each place, and largest force along the shaft with its time."""
    force = np.abs(part["force"].transpose("axis", "bearing", "time").values)
    along, radial = force[0], np.hypot(force[1], force[2]).max(axis=1)
    at = part["time"].values[along.argmax(axis=1)]
    places = {"bearing": part["bearing"].values}

    def of_places(values: Floats, units: str, meaning: str) -> tuple[xr.DataArray, str, str]:
        return xr.DataArray(values, places, ["bearing"]), units, meaning

    along_the_shaft = "largest force along the shaft"
    found = {
        "largest_load": of_places(radial, "N", "largest radial load"),
        "largest_axial_load": of_places(along.max(axis=1), "N", along_the_shaft),
        "largest_axial_load_time": of_places(at, "s", f"time of the {along_the_shaft}"),
    }
    if "alignment" in part:
        turned = to_film(part["alignment"].transpose("bearing", "axis").values)
        for name, values in zip(ALIGNED, turned.T):
            about = f"turn of the bore about {name.split('_')[1]}"
            found[name] = of_places(values, "rad", about)
    return labelled(found)


def _agreement(part: xr.Dataset) -> xr.Dataset:
    rigid = (part["converged"] == 0).any("bearing").sum("time")  # NaN where nothing is iterated
    found = {"not_converged": (rigid, "1", "samples with rigid bearings: these have no answer")}
    for name, meaning in _TOLD.items():
        found[name] = xr.DataArray(float(part.attrs[name])), "1", meaning
    return labelled(found)


def warnings(tree: xr.DataTree) -> list[str]:
    """Say where shaft and bearings were iterated, but not well, or not at all."""
    if "shaft" not in tree.children:
        return []
    found = tree["shaft"].to_dataset()
    if "interpolation_error" not in found:  # a shaft that is not iterated with its bearings
        return []
    worst = found.isel(case=int(np.argmax(found["interpolation_error"].values)))
    error, said = worst["interpolation_error"].item(), []
    if error > WARN:
        said.append(
            f"shaft: between the samples solved, loads or tilt are off by {percent(error)} of "
            f"their largest ({worst['case'].item()})"
        )
    if rigid := int(found["not_converged"].sum()):
        said.append(
            f"shaft: {rigid} samples have rigid bearings in place of films or rollers that have "
            "no answer there, such as a film at standstill"
        )
    return said


WARN = 0.05
"""Error between the samples solved, over the largest values, above which a run warns."""

_TOLD = {
    "iterations": "iterations of shaft and bearings",
    "residual": "largest change of a reaction in the last iteration, relative",
    "solved": "samples solved with the bearings' own models",
    "interpolation_error": "error between these, of loads, motion and tilt in the bore",
}


def _described(scene: Scene) -> str:
    concepts = scene.shaft.suspensions.items()
    words = [f"{name}, beam" if concept.beam else name for name, concept in concepts]
    names = "+".join([*words, *(name for name in SWINGING if getattr(scene.shaft, name))])
    supports = [f"{name} {support.stiffness}" for name, support in scene.shaft.coupled.items()]
    return f"{names}, iterated with {', '.join(supports)}" if supports else names


def shaft_key(scene: Scene) -> str:
    """Name of the shaft in the ladder: its suspensions, or the bearings it is iterated with."""
    if not scene.shaft.coupled:
        return _described(scene)
    if any_moves_in_films(scene.shaft, scene.journal):
        return "on journal, in motion"
    kinds = {
        f"{support.stiffness}, tilting"
        if support.stiffness == "journal" and support.takes_moment
        else f"{support.stiffness}, flexible"
        if support.stiffness == "rolling" and scene.rolling.bearings[name].rings == "flexible"
        else support.stiffness
        for name, support in scene.shaft.coupled.items()
    }
    return f"on {'+'.join(sorted(kinds))}"


def _work(scene: Scene, cases: tuple[Case, ...], measured: Measured) -> float | None:
    """Load cases; those whose films take another time than the measured one count accordingly."""
    count = steps_of(cases) / STEPS_PER_CASE
    known = measured(scene, "shaft") or {}
    if "film" not in known:
        return count
    from loadflow.stages.journal import warm_films

    still = scene.model_copy(
        update={"journal": scene.journal.model_copy(update={"motion": "quasi-static"})}
    )
    ours, theirs = (measured(still, "journal", key) for key in (None, known["film"]))
    if ours is None or theirs is None:
        return None
    films = float(ours["seconds_per_sample"] / theirs["seconds_per_sample"])
    return count * warm_films(still.journal) * films


def _clearance_follows_heat(scene: Scene) -> bool:
    """Whether a rolling bearing that is fed back has the clearance of its stated temperature."""
    parts = scene.rolling.bearings
    return any(
        support.stiffness == "rolling" and parts[name].mounting is not None
        for name, support in scene.shaft.coupled.items()
    )


STAGE = Stage(
    "shaft",
    run=bearing_loads,
    needs=always("loads"),
    sections=lambda scene: (
        *("shaft", "turbine"),
        *(("journal", "rolling") if scene.shaft.coupled else ()),
        *(("journal",) if turned_bores(scene) and not scene.shaft.coupled else ()),
        *(("friction",) if _clearance_follows_heat(scene) else ()),
    ),
    models=(
        Rungs("shaft", section="shaft", key=shaft_key, text=_described, exact=lambda scene: True),
    ),
    summarise=summary,
    warnings=warnings,
    work=_work,
)
