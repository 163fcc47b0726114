"""Loads of one case → films of thrust bearings and of pairs of cones, at rest or in motion."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.journal.grid_bounds import unresolved_counted
from loadflow.journal.thrust.collar_series import CollarPath
from loadflow.journal.thrust.curves import CollarFilms
from loadflow.quantities import table
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.scene.seats import without_seat
from loadflow.scene.thrust import AnyAxial
from loadflow.stages.bores import against_bore
from loadflow.stages.films.summary import beyond_pressure, summary
from loadflow.stages.frames import to_rolling
from loadflow.stages.kept_samples import edges_of_cube, kept_samples
from loadflow.stages.labelling import label, of_samples
from loadflow.stages.running_time import with_running
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

KEPT = table(
    "minimum_film", "maximum_pressure", "friction_power", "side_flow", "converged", "residual",
    "iterations",
)  # fmt: skip
"""What is kept of every sample: units and meaning."""

WARM = table("temperature")
"""What is kept too of collars with heat: that of the warmer row."""

TILTED = table("restoring_moment")
"""What is kept too of collars that are tilted: no shaft feels it, but a support may state it."""

_LOADS = {
    "load": ("N", "load that presses on the films"),
    "axial_load": ("N", "force along the shaft, its size"),
    "moment_load": ("N m", "moment across the shaft, its size"),
    "friction_torque": ("N m", "friction torque"),
    "in_contact": ("1", "whether surfaces touch"),
}


def films(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.DataTree:
    """Solve the films of every bearing for some samples of the series; one group per bearing.

    Collars in motion follow the whole series. Of the others samples are chosen by the histogram of
    speed and of the load that presses on the films, where the scene's reduction is by histogram,
    else they are those of the reduction.

    Raises
    ------
    loadflow.errors.SolverError
        No sample at all has an equilibrium or is in contact.
    """
    found = {}
    for place, bearing in scene.thrust.bearings.items():
        samples = samples_of(scene, case, bearing, place, inputs)
        moving = follows(scene, bearing)
        answer = solved(bearing, place, samples, scene.thrust.rung, moving)
        found[place] = with_running(scene, answer)
    return xr.DataTree.from_dict(found)


def follows(scene: Scene, bearing: AnyAxial) -> bool:
    """Whether a bearing is followed through the whole series."""
    return scene.thrust.in_motion and bearing.kind == "thrust"


def samples_of(
    scene: Scene, case: Case, bearing: AnyAxial, place: str, inputs: Mapping[str, Any]
) -> xr.Dataset:
    """Samples of one case: `time`, `speed`, `weight` (sample), `force` and `moment` (sample, axis).

    Vectors are in the frame of the cube; `tilt` (sample, axis) is there where it acts on the films.
    """
    moving = follows(scene, bearing)
    if scene.reduction.method != "histogram" and not moving:
        reduced = against_bore(inputs["reduction"][place].to_dataset())
        names = ("tilt",) if _tilts(scene, bearing) and "tilt" in reduced else ()
        return reduced[["time", "speed", "weight", "force", "moment", *names]]
    loads, shaft = inputs["loads"].load(), inputs["shaft"].load().sel(bearing=place)
    shaft = against_bore(shaft)  # pads stand in the housing of the bore
    tilted = lies(scene, bearing, shaft)
    if moving:
        return _whole(loads, shaft, tilted)
    force, moment = _vectors(shaft)
    kept = kept_samples(
        scene,
        loads["speed"].values.astype(float),
        _pressed(bearing, force, moment),
        loads["time"].values,
        edges_of_cube(scene, "thrust", lambda one: _all_pressed(scene, one)).get(place),
        f"{case.name}, bearing {place}",
    )
    axes = ("sample", "axis")
    found = xr.Dataset(
        {
            "time": ("sample", kept.time, label("s", "time")),
            "speed": ("sample", kept.speed, label("rad/s", "rotor speed")),
            "weight": ("sample", kept.weight, label("1", "samples of the full series")),
            "force": (axes, force[kept.index], label("N", "force on the bearing")),
            "moment": (axes, moment[kept.index], label("N m", "moment on the bearing")),
        },
        {"axis": ["x", "y", "z"]},
    )
    if not tilted:
        return found
    return found.assign(tilt=(axes, _tilt(shaft)[kept.index], label("rad", "tilt of the shaft")))


def _tilts(scene: Scene, bearing: AnyAxial) -> bool:
    return scene.thrust.tilt and bearing.kind == "thrust" and not bearing.self_aligning


def lies(scene: Scene, bearing: AnyAxial, shaft: xr.Dataset) -> bool:
    """Whether the tilt that a shaft has in a bearing acts on its films."""
    known = "tilt" in shaft and bool(shaft["tilt"].notnull().all())
    return _tilts(scene, bearing) and known


def _whole(loads: xr.Dataset, shaft: xr.Dataset, tilted: bool) -> xr.Dataset:
    """The whole series of one bearing as samples, one for each step; with its tilt or without."""
    names = ("force", "moment", *(("tilt",) if tilted else ()))
    series = xr.merge([loads[["speed"]], shaft[[*names]]], compat="override", join="override")
    weight = np.ones(series.sizes["time"])
    found = series.assign(weight=("time", weight, label("1", "samples"))).rename(time="sample")
    time = loads["time"].values.astype(float)
    return found.drop_vars("sample").assign(time=("sample", time, label("s", "time")))


def _tilt(shaft: xr.Dataset) -> np.ndarray:
    return shaft["tilt"].transpose("time", "axis").values.astype(float)


def _vectors(shaft: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    """Force, N, and moment, N m, on one bearing, (n, 3) each."""
    force, moment = (
        shaft[name].transpose("time", "axis").values.astype(float) for name in ("force", "moment")
    )
    return force, moment


def _pressed(bearing: AnyAxial, force: np.ndarray, moment: np.ndarray) -> np.ndarray:
    """Load that presses on the films of one bearing, N, as the first of two components (n, 2)."""
    pressed = bearing.normal_load(to_rolling(force), to_rolling(moment))
    return np.column_stack([pressed, np.zeros_like(pressed)])


def _all_pressed(scene: Scene, shaft: xr.Dataset) -> dict[str, np.ndarray]:
    """The same of all bearings, by place."""
    bearings = scene.thrust.bearings.items()
    return {
        place: _pressed(bearing, *_vectors(shaft.sel(bearing=place))) for place, bearing in bearings
    }


def solved(
    bearing: AnyAxial, place: str, samples: xr.Dataset, rung: str = "grid", moving: bool = False
) -> xr.Dataset:
    """Films of one bearing under samples of loads; `moving`, along all of them in their order.

    By its curve, where it has one and the rung says so; what that does not answer at rest, on the
    grid.
    Where the film is thinner than both surfaces are rough they are ``in_contact``, and the sample
    has no film. A sample that the solver did not answer has none either, and ``converged`` 0.

    Raises
    ------
    loadflow.errors.SolverError
        No sample has an equilibrium or is in contact.
    """
    force, moment = (
        to_rolling(samples[name].transpose("sample", "axis").values.astype(float))
        for name in ("force", "moment")
    )
    speed = samples["speed"].values.astype(float)
    tilt = tilt_in_frame(samples)
    kept = KEPT | (WARM if bearing.kind == "thrust" and bearing.heat is not None else {})
    kept |= {} if tilt is None else TILTED
    found = {name: np.full(speed.size, np.nan) for name in (*kept, "friction_torque")}
    found |= {"converged": np.zeros(speed.size, bool), "iterations": np.zeros(speed.size, int)}
    touching, why, open_ = np.zeros(speed.size, bool), "", [*range(speed.size)]
    about: dict[str, Any] = {}
    time = samples["time"].values.astype(float) if moving else None
    curve = _by_curve(bearing, force, speed, tilt, time) if rung == "curve" else None
    if curve is not None:
        touching = curve.touching | (curve.minimum_film < bearing.contact_film)
        there = curve.converged & ~touching
        for name, values in found.items():
            values[there] = getattr(curve, name)[there]
        open_ = [] if moving else np.flatnonzero(~there & ~touching).tolist()
        about["interpolation_error"] = curve.interpolation_error
        if tilt is not None and isinstance(curve, CollarPath):
            about["moment_error"] = curve.moment_error
    for k in open_:
        try:
            turned = None if tilt is None else tilt[k]
            with unresolved_counted():  # `films.summary` keeps the largest pressure
                answer = bearing.solve(force[k], moment[k], float(speed[k]), turned)
        except SolverError as error:
            touching[k], why = bearing.touches(force[k], float(speed[k])), str(error)
            continue
        if answer.minimum_film < bearing.contact_film:
            touching[k] = True
            continue
        for name, values in found.items():
            values[k] = getattr(answer, name)
    if not np.any(found["converged"] | touching):
        raise SolverError(f"bearing {place}: no film carries any of the samples; {why}")
    loads = {
        "load": bearing.normal_load(force, moment),
        "axial_load": np.abs(force[:, 2]),
        "moment_load": np.hypot(moment[:, 0], moment[:, 1]),
        "in_contact": touching,
    }
    given = samples[["time", "speed", "weight"]]
    thickest = float(np.nanmax(found["minimum_film"], initial=0.0))
    oil = bearing.oil
    fastest = float(np.abs(speed).max()) * bearing.radius
    about |= {
        "motion": "transient" if moving else "quasi-static",
        "largest_reynolds_number": oil.density * fastest * thickest / oil.viscosity,
        "radius": bearing.radius,
        "boundary_friction": bearing.boundary_friction,
    }
    if tilt is not None:
        about["tilting_stiffness"] = _tilting_stiffness(found["restoring_moment"], tilt)
    return given.assign(of_samples(found, kept)).assign(
        of_samples(loads | {"friction_torque": found["friction_torque"]}, _LOADS)
    ).assign_attrs(about)  # fmt: skip


def _tilting_stiffness(moment: np.ndarray, tilt: np.ndarray) -> float:
    """Moment over tilt of all samples, by least squares, N m/rad; 0 of films that never tilt."""
    slope = np.where(np.isnan(moment), 0.0, np.hypot(*tilt.T))
    square = float((slope**2).sum())
    return float(np.nansum(moment * slope)) / square if square > 0.0 else 0.0


def tilt_in_frame(samples: xr.Dataset) -> np.ndarray | None:
    """Tilt of the shaft (n, 2), rad, in the frame of the bearing; None where it does not act."""
    if "tilt" not in samples:
        return None
    tilt: np.ndarray = samples["tilt"].transpose("sample", "axis").values.astype(float)
    return to_rolling(tilt)[:, :2]


def _by_curve(
    bearing: AnyAxial,
    force: np.ndarray,
    speed: np.ndarray,
    tilt: np.ndarray | None,
    time: np.ndarray | None,
) -> CollarFilms | None:
    """Films by the bearing's curve; None where it has none, as pads that find no tilt.

    Raises
    ------
    loadflow.errors.SolverError
        The films of a series that is followed have no curve.
    """
    try:
        return bearing.by_curve(force, speed, tilt, time)
    except SolverError:
        if time is not None:
            raise
        return None


def _links(scene: Scene) -> Links:
    """The loads, and the films themselves; those in motion read the whole series."""
    whose = "" if len(scene.thrust.collars) == len(scene.thrust.bearings) else "cones"
    largest = Link("reduction", "largest load", of_load=True, gains=whose)
    reduced = () if scene.thrust.in_motion else (largest,)
    through = (*load_links("bearing load max", gains=whose), *reduced)
    names = ("minimum film", "maximum pressure", "friction power")
    return {name: (*through, Link("thrust", name)) for name in names}


GRIDS = ((20, 10), (40, 20), (80, 40))
"""Grids of a pad whose error is in the ladder."""


def tabulated(scene: Scene) -> bool:
    """Whether films of collars are those of a table of tilts, of temperatures or of a path."""
    warm = any(one.heat is not None for one in scene.thrust.collars.values())
    return scene.thrust.rung == "curve" and (warm or scene.thrust.tilt or scene.thrust.in_motion)


def rung_key(scene: Scene) -> str:
    """Rung of the films and their grid: the finest of `GRIDS` that theirs is not coarser than.

    Of collars beside a pair of cones, that of the pair.
    """
    pairs = [one for one in scene.thrust.bearings.values() if one.kind != "thrust"]
    around, across = min((one.grid for one in pairs), default=scene.thrust.grid)
    held = [grid for grid in GRIDS if grid[0] <= around and grid[1] <= across]
    around, across = held[-1] if held else (around, across)
    return f"{'pair of cones' if pairs else scene.thrust.rung}, {around}x{across}"


def _better(scene: Scene) -> dict[str, Any]:
    """A curve is held against its grid, a grid against the next finer one.

    So is a table of films that are tilted, warm or in motion: the grid takes seconds for each.
    """
    if scene.thrust.rung == "curve" and not tabulated(scene):
        return {"rung": "grid"}
    finer = finer_grid(scene)
    return {"grid": finer} if finer and scene.thrust.collars else {}


def finer_grid(scene: Scene) -> tuple[int, int] | None:
    """The next of `GRIDS`; None at the top."""
    finer = [grid for grid in GRIDS if min(np.subtract(grid, scene.thrust.grid)) > 0]
    return finer[0] if finer else None


RUNGS = Rungs(
    "thrust",
    section="thrust",
    key=rung_key,
    better=_better,
)


def _left_out(scene: Scene) -> dict[str, str]:
    """What films of cones do not know, and seats that are not stated; else the effects say so."""
    seats = without_seat("thrust", scene.thrust.collars)
    if not scene.wants("thrust") or len(scene.thrust.collars) == len(scene.thrust.bearings):
        return seats
    return seats | {
        "thrust: motion, heat, contact of cones": "their films are solved at rest, at one "
        "temperature, without asperities",
    }


def _work(scene: Scene, cases: tuple[Case, ...], measured: Measured) -> float:
    followed = len(scene.thrust.collars) if scene.thrust.in_motion else 0
    others = len(scene.thrust.bearings) - followed
    return (followed + kept_share(scene, measured) * others) * steps_of(cases)


def _tables(scene: Scene, measured: Measured) -> float:
    """Seconds of the tables of all collars, where they have one; both rows share it if alike."""
    known = (measured(scene, "thrust") or {}).get("seconds_once", {})
    kind = "tilted" if scene.thrust.tilt else "aligned" if tabulated(scene) else "curve"
    return float(known.get(kind, 0.0)) * len(scene.thrust.collars)


def _needs(scene: Scene) -> tuple[str, ...]:
    """The series where collars follow it, or choose of it by their own load; else what is kept."""
    by_histogram = scene.reduction.method == "histogram"
    others = len(scene.thrust.collars) < len(scene.thrust.bearings)
    series = ("loads", "shaft") if by_histogram or scene.thrust.in_motion else ()
    reduced = not by_histogram and (others or not scene.thrust.in_motion)
    return (*series, *(("reduction",) if reduced else ()))


def warnings(tree: xr.DataTree) -> list[str]:
    """Say in which load cases the pressure of a film is beyond what oil and pads bear."""
    return [*beyond_pressure(tree, "thrust")]


STAGE = Stage(
    "thrust",
    run=films,
    results={"thrust.film": _links},
    needs=_needs,
    sections=always("thrust", "reduction"),
    models=(RUNGS,),
    summarise=summary,
    warnings=warnings,
    work=_work,
    once=_tables,
    left_out=_left_out,
)
