"""Loads of one case → film of each journal bearing, at static equilibrium or in motion."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import time_step
from loadflow.errors import SolverError
from loadflow.journal.grid_bounds import unresolved_counted
from loadflow.journal.heat import Heat
from loadflow.journal.line import Line
from loadflow.journal.models.model import why_not
from loadflow.journal.validity import critical_reynolds_number, reynolds_number
from loadflow.quantities import GRID_ERROR
from loadflow.scene.cases import Case
from loadflow.scene.journal import Journal
from loadflow.scene.loads import Loads
from loadflow.scene.scene import Scene
from loadflow.scene.seats import without_seat
from loadflow.stages.films.kept import RESOLVED, kept_of
from loadflow.stages.films.of_bearing import equilibria, follow, shaft_line, surely_touching
from loadflow.stages.films.past import AT_REST, past_of
from loadflow.stages.films.summary import summary, warnings
from loadflow.stages.films.temperature import mean_temperature
from loadflow.stages.films.turning import is_parked
from loadflow.stages.frames import to_film
from loadflow.stages.labelling import label, of_samples
from loadflow.stages.running_time import with_running
from loadflow.stages.shaft_in_films import films_together, followed_together
from loadflow.stages.stage import (
    Link,
    Links,
    Measured,
    Rungs,
    Stage,
    kept_share,
    load_links,
    steps_of,
)

_TRIES = 200  # samples of a start that are asked for the first film


def film(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.DataTree:
    """Solve the film for every sample of the reduced series; one group per bearing.

    Periodic design loads drive it round the orbit that closes.

    Where the film is thinner than both surfaces are rough, such as at standstill, shaft and shell
    are ``in_contact``; the sample has values only if the asperities are described. A sample whose
    film was not found has none either, and ``converged`` 0.

    Raises
    ------
    loadflow.errors.SolverError
        No sample at all has an equilibrium or is in contact.
    """
    found = {}
    for name in scene.journal.bearings:
        reduced = inputs["reduction"][name].to_dataset()
        found[name] = with_running(scene, driven(scene.journal.at(name), name, reduced))
    return xr.DataTree.from_dict(found)


def driven(options: Journal, bearing: str, reduced: xr.Dataset) -> xr.Dataset:
    """Film of one bearing under reduced loads: at rest, or round one period if they close.

    Raises
    ------
    loadflow.errors.SolverError
        No sample has an equilibrium or is in contact; the orbit does not close.
    """
    solve = _closing if reduced.attrs.get("closed") else _resting
    return solve(options, bearing, reduced)


def orbit(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.DataTree:
    """Follow the shaft through every step of the series; one group per bearing.

    Raises
    ------
    loadflow.errors.SolverError
        No equilibrium to start from, or a step without an answer.
    """
    loads, shaft = inputs["loads"].load(), inputs["shaft"].load()
    together = _together(scene, loads)
    return xr.DataTree.from_dict(
        {
            bearing: with_running(
                scene,
                _moving(
                    scene,
                    bearing,
                    loads,
                    shaft.sel(bearing=bearing),
                    is_parked(case),
                    together.get(bearing),
                ),
            )
            for bearing in scene.journal.bearings
        }
    )


def _together(scene: Scene, loads: xr.Dataset) -> dict[str, tuple[xr.Dataset, float | None]]:
    """Path and temperature of the films that are followed with the shaft, by bearing."""
    from loadflow.turbines import load_turbine

    tilt = load_turbine(scene.turbine.name).rotor.tilt
    found: dict[str, tuple[xr.Dataset, float | None]] = {}
    for concept in scene.shaft.concepts:
        if followed_together(scene, concept, loads["speed"].values.astype(float)):
            try:
                both = films_together(scene, concept, loads, tilt)
            except SolverError:
                continue  # the shaft has told
            found |= dict(zip(concept.bearings, zip(both.path.paths, both.temperature)))
    return found


def _resting(options: Journal, bearing: str, reduced: xr.Dataset) -> xr.Dataset:
    speed, force = reduced["speed"].values, reduced["force"].values
    line, kept = shaft_line(options, reduced), kept_of(options, at_rest=True)
    touching = surely_touching(options, force, speed)
    found = _nothing(options, speed.size, at_rest=True)
    if np.any(asked := ~touching):
        some = {name: vectors[asked] for name, vectors in line.items()}
        answer = equilibria(options, force[asked], speed[asked], **some)
        for name, values in found.items():
            bounds = answer.grid_error if name.endswith(GRID_ERROR) else answer
            values[asked] = getattr(bounds, name.removesuffix(GRID_ERROR))
    _drop_contact(options, found, touching)
    if not np.any(found["converged"] | touching):
        raise SolverError(
            f"bearing {bearing}: no film carries any of the {speed.size} samples; speed "
            f"{np.abs(speed).min():.4g} … {np.abs(speed).max():.4g} rad/s"
        )
    samples = of_samples(found, kept) | _loaded(force, touching)
    samples |= _lying(options, found)
    given = reduced[["time", "speed", "weight"]]
    return _placed(options, given.assign(samples), found["eccentricity"])


def _closing(options: Journal, bearing: str, reduced: xr.Dataset) -> xr.Dataset:
    """Film on the closed orbit under one period of a load, around the shaft as it lies then.

    Raises
    ------
    loadflow.errors.SolverError
        The orbit does not close.
    """
    vectors = reduced["force"].values
    force, speed = to_film(vectors), reduced["speed"].values
    line: dict[str, Any] = {
        name: to_film(rows) for name, rows in shaft_line(options, reduced).items()
    }
    warm = mean_temperature(options, force, speed, **line)
    held = options if warm is None else options.at_temperature(warm)
    film = held.film_model.closing()
    try:
        with unresolved_counted():  # `films.summary` tells of them
            path = held.geometry.orbit(
                reduced["time"].values,
                force,
                speed,
                film,
                periodic=True,
                **line,
            )
    except SolverError as error:
        raise SolverError(f"bearing {bearing}: {error}") from error
    found, kept = _nothing(options, speed.size), kept_of(options)
    _take_path(found, path, slice(None))
    if warm is not None:
        found["temperature"][:] = warm
    if "clearance" in found:
        found["clearance"][:] = held.geometry.clearance
    found["sommerfeld_number"][:] = options.geometry.sommerfeld_number(
        np.hypot(*force.T), speed, held.lubricant.viscosity
    )
    touching = np.zeros(speed.size, dtype=bool)
    _drop_contact(options, found, touching)
    samples = of_samples(found, kept) | _loaded(vectors, touching) | _lying(options, found)
    about = {name: path.attrs[name] for name in ("closure", "periods")} | {"motion": "periodic"}
    about |= _bounds(path)
    given = reduced[["time", "speed", "weight"]].assign(samples)
    return _placed(held, given, found["eccentricity"]).assign_attrs(about)


def _lying(options: Journal, found: dict[str, np.ndarray]) -> dict[str, Any]:
    """How the shaft lies in samples, where it tilts."""
    if not options.tilt:
        return {}
    meaning = label("rad", "rotation of the shaft: about down, about left")
    return {"tilt": (("sample", "component"), found["tilt"], meaning)}


def _take_path(found: dict[str, np.ndarray], path: xr.Dataset, places: slice) -> None:
    """Put an orbit where it belongs in what is kept."""
    for name in found:
        if name in path:
            found[name][places] = path[name].values
    found["converged"][places] = True


def _bounds(path: xr.Dataset) -> dict[str, float]:
    """What a path says that its cells do to its extremes, where it does."""
    return {name: path.attrs[name] for name in RESOLVED if name in path.attrs}


def _moving(
    scene: Scene,
    bearing: str,
    loads: xr.Dataset,
    reactions: xr.Dataset,
    parked: bool,
    together: tuple[xr.Dataset, float | None] | None = None,
) -> xr.Dataset:
    """Film along the series, from the first sample on in which the surfaces need not touch."""
    options = scene.journal.at(bearing).model_copy(update={"tilt": True} if together else {})
    held, warm = options, None
    if parked and isinstance(options.heat, Heat) and options.heat.stands_as_it_enters:
        # what it loses as it slips in its brake warms no oil; a balance is sought in vain for long
        warm = options.heat.inlet_temperature
        held = options.at_temperature(warm)
    every = slice(None, None, options.every(time_step(loads)))
    loads, reactions = loads.isel(time=every), reactions.isel(time=every)
    vectors = reactions["force"].transpose("time", "axis").values.astype(float)
    time, speed = (loads[name].values.astype(float) for name in ("time", "speed"))
    begin, start = (0, None) if together else _lift_off(options, vectors, speed)
    touching = np.arange(time.size) < begin  # later on, squeeze carries more than a film at rest
    found, kept = _nothing(options, time.size), kept_of(options)
    force, left = to_film(vectors), slice(begin, None)
    about: dict[str, float] = {}
    if begin < time.size:
        try:
            if together is None:
                past = AT_REST if begin else past_of(scene, loads)
                path = follow(held, loads.isel(time=left), reactions.isel(time=left), start, past)
            else:
                path, warm = together
        except SolverError as error:
            raise SolverError(f"bearing {bearing}: {error}") from error
        _take_path(found, path, left)
        about = _bounds(path)
        viscosity = np.asarray(options.lubricant.viscosity)
        if options.heat is not None:
            if warm is not None:
                found["temperature"][left] = warm
            viscosity = np.asarray(options.heat.liquid.viscosity(found["temperature"][left]))
        if "clearance" in found:
            grown = options.at_temperature(float(found["temperature"][left][0]))
            found["clearance"][left] = grown.geometry.clearance
        found["sommerfeld_number"][left] = options.geometry.sommerfeld_number(
            np.hypot(*force[left].T), speed[left], viscosity
        )
    _drop_contact(options, found, touching)
    samples = xr.Dataset(
        {
            "time": ("sample", time, label("s", "time")),
            "speed": ("sample", speed, label("rad/s", "rotor speed")),
            "weight": ("sample", np.ones(time.size), label("1", "samples")),
        }
    )
    labels = of_samples(found, kept) | _loaded(vectors, touching) | _lying(options, found)
    return _placed(options, samples.assign(labels), found["eccentricity"]).assign_attrs(about)


def _lift_off(
    options: Journal, force: np.ndarray, speed: np.ndarray
) -> tuple[int, np.ndarray | None]:
    """First sample from which the film can be followed, and the place (2,), m, if it is given.

    That is the first sample of all, or of a start the first in which the surfaces do not touch.
    """
    if not surely_touching(options, force[:1], speed[:1])[0]:
        return 0, None  # what carries the others at most is not asked, which takes long
    touching = surely_touching(options, force, speed)
    touching[0] = True
    for k in np.flatnonzero(~touching)[:_TRIES]:
        there = equilibria(options, force[k : k + 1], speed[k : k + 1])
        if there.converged[0] and there.minimum_film[0] >= options.contact_film:
            return int(k), there.eccentricity[0]
    return speed.size, None


def _nothing(options: Journal, count: int, at_rest: bool = False) -> dict[str, np.ndarray]:
    """What is kept of `count` samples, and where the shaft lies, before anything is known."""
    none = {name: np.full(count, np.nan) for name in kept_of(options, at_rest)}
    if "resolved" in none:
        none["resolved"] = np.zeros(count, dtype=bool)
    none |= {"converged": np.zeros(count, dtype=bool), "iterations": np.zeros(count, dtype=int)}
    none["eccentricity"] = np.full((count, 2), np.nan)
    return none | ({"tilt": np.full((count, 2), np.nan)} if options.tilt else {})


def _drop_contact(options: Journal, found: dict[str, np.ndarray], touching: np.ndarray) -> None:
    """Mark samples whose film is thinner than the roughness; a smooth one keeps no values of it."""
    with np.errstate(invalid="ignore"):
        touching |= found["converged"] & (found["minimum_film"] < options.contact_film)
    if options.contact is not None:
        return
    for name, values in found.items():
        if name in ("converged", "iterations", "resolved"):
            values[touching] = 0
        else:
            values[touching] = np.nan


def _loaded(force: np.ndarray, touching: np.ndarray) -> dict[str, Any]:
    """Loads of samples, and whether the surfaces touch."""
    about = label("1", "whether shaft and shell touch: a smooth film would be below the roughness")
    radial, axial = np.hypot(*to_film(force).T), np.abs(force[:, 0])
    return {
        "load": ("sample", radial, label("N", "radial load")),
        "axial_load": ("sample", axial, label("N", "force along the shaft, its size")),
        "in_contact": ("sample", touching, about),
    }


def _placed(options: Journal, samples: xr.Dataset, eccentricity: np.ndarray) -> xr.Dataset:
    meaning = label("m", "shaft centre: down, then left")
    bearing = options.geometry
    fastest, oil = float(np.abs(samples["speed"]).max()), options.lubricant
    if options.heat is not None:
        warmest = float(
            np.fmax.reduce(samples["temperature"].values, initial=options.heat.inlet_temperature)
        )
        oil = options.heat.lubricant(warmest)
    reynolds = float(reynolds_number(bearing, fastest, oil))
    return samples.assign(
        eccentricity=(("sample", "component"), eccentricity, meaning)
    ).assign_attrs(
        motion=options.motion,
        radius=bearing.radius,
        boundary_friction=options.boundary_friction,
        **options.critical.attributes,
        radial_clearance=bearing.clearance,
        laminar=int(reynolds < critical_reynolds_number(bearing.relative_clearance)),
        largest_reynolds_number=reynolds,
    )


FINEST_GRID = 480
"""Cells around that a run goes up to by itself."""


def film_key(scene: Scene) -> str:
    """Name of the film in the ladder."""
    journal = scene.journal
    around, across = journal.grid
    graded = ", graded" if journal.grading == "graded" else ""
    elastic = ", elastic" if journal.shell is not None else ""
    names = {"grid": f"grid, {around}x{across}{graded}{elastic}", "reduced": f"reduced, {around}"}
    step = f", {journal.step:g} s" if journal.in_motion and journal.step is not None else ""
    return names.get(journal.rung, journal.rung) + step


def warm_films(options: Journal) -> float:
    """Time of a film with its heat balance over that of an isothermal one; docs/journal-heat.md."""
    return 7.0 if options.heat is not None and not options.in_motion else 1.0


def fast_film(journal: Journal) -> Journal | None:
    """The bearing with the film that is fast over a long series; None where it does not fit."""
    film = replace(journal.film_model, rung="reduced")
    line = Line(moment=np.zeros((1, 2))) if journal.tilt else Line()
    if why_not("in_motion", film, journal.geometry, line) is None:
        return journal.model_copy(update={"rung": "reduced"})
    return None


def _finer_grid(scene: Scene) -> dict[str, Any]:
    """A film has no top: its grid is doubled, up to what a scene may ask for.

    One in motion stays on the rung "reduced", which is nearest to the truth for its time, and takes
    every sample, so that both errors show.
    """
    journal = scene.journal
    around, across = journal.grid
    every = {"step": None} if journal.step is not None else {}
    if 2 * around > FINEST_GRID:
        return every
    if journal.in_motion and journal.rung == "reduced":
        return {"grid": (2 * around, across)} | every
    return {"rung": "grid", "grid": (2 * around, 2 * across)} | every


def _links(scene: Scene) -> Links:
    """A film in motion reads the whole series, the others the reduced one."""
    ends = {
        "eccentricity ratio": "E_max",
        "minimum film": "h_min",
        "maximum pressure": "p_max",
        "friction power": "friction power",
    }
    return {
        quantity: (
            *load_links("radial force max"),
            Link("shaft", quantity),  # how the shaft lies in the bearing
            *(() if scene.journal.in_motion else (Link("reduction", end),)),
            Link("journal", quantity),
        )
        for quantity, end in ends.items()
    }


def _work(scene: Scene, cases: tuple[Case, ...], measured: Measured) -> float:
    if scene.journal.in_motion:
        share = 1.0 / scene.journal.every(_step_of(scene))
    else:
        share = kept_share(scene, measured)
    films = share * len(scene.journal.bearings) * steps_of(cases)
    return films * warm_films(scene.journal)


def _step_of(scene: Scene) -> float:
    """Step of the scene's series, s; of given ones the usual one is taken."""
    return scene.loads.step if scene.loads.source == "simulate" else Loads().step


FILM = Rungs(
    "journal",
    section="journal",
    key=film_key,
    table=lambda scene: "journal, transient" if scene.journal.in_motion else "journal",
    better=_finer_grid,
)

STAGE = Stage(
    "journal",
    run=lambda scene, case, inputs: (orbit if scene.journal.in_motion else film)(
        scene, case, inputs
    ),
    results={"journal.film": _links},
    needs=lambda scene: ("loads", "shaft") if scene.journal.in_motion else ("reduction",),
    sections=lambda scene: ("journal",),
    models=(FILM,),
    summarise=summary,
    warnings=warnings,
    work=_work,
    left_out=lambda scene: without_seat(
        "journal", {name: scene.journal.at(name) for name in scene.journal.bearings}
    ),
)
