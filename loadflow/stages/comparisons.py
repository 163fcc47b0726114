"""Answers of a case beside those of the next better models, on a few of its samples."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.reduction import damage_equivalent_load
from loadflow.scene.cases import Case
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.stages.differences import Difference, differences, relative
from loadflow.stages.effects.film import MOTION
from loadflow.stages.effects.film_heat import HEAT
from loadflow.stages.effects.rolling import RINGS
from loadflow.stages.films.of_bearing import equilibria, follow, shaft_line
from loadflow.stages.films.past import past_of
from loadflow.stages.journal import FILM as FILM_MODEL
from loadflow.stages.journal import fast_film
from loadflow.stages.kept_samples import stretch
from loadflow.stages.loads import ROTOR, hub_loads
from loadflow.stages.paths_again import (
    FILM,
    Better,
    extremes_of_orbit,
    paths_again,
    running_ratio,
)
from loadflow.stages.reduction import governing_load
from loadflow.stages.rolling import life_of, solve_bearing
from loadflow.stages.running_time import counted, running
from loadflow.stages.shaft import bearing_loads
from loadflow.stages.stage import with_settings
from loadflow.stages.statistics import SLOPE
from loadflow.stages.thrust import finer_grid, follows, samples_of, solved, tabulated

Parts = Mapping[str, Any]
"""What each stage gave for a case, by the name of the stage."""

EXTREMES = ("eccentricity_ratio", "minimum_film", "maximum_pressure")
CONTACT = ("maximum_force", "maximum_pressure")

SAMPLES = 5
"""Samples of a case that are solved again, from the mildest to the hardest."""

HEAT_CAPACITY = 2000.0  # J/(kg K), mineral oil
THINNING = 0.035  # 1/K, relative loss of viscosity of a mineral oil of VG 100 … 320 near 50 °C

_OF_SAMPLES = ("reduction", "journal", "rolling")
"""Stages whose comparisons take samples of the full series."""


def compare(
    scene: Scene, case: Case, parts: Parts, sure: Collection[str] = ()
) -> Iterator[Difference]:
    """Compare what the stages gave for a case with what the next better models give.

    But for effects of which it is `sure` that leaving them out does not matter.
    """
    # design loads that are chosen by hand are all that their readers see
    designed = scene.reduction.method != "histogram"
    for stage, against_better in COMPARISONS.items():
        settled = stage in COMPARED and COMPARED[stage].name in sure
        if stage in parts and not settled and not (designed and stage in _OF_SAMPLES):
            yield from against_better(scene, case, parts)


def _film(scene: Scene, case: Case, parts: Parts) -> Iterator[Difference]:
    for stage, models, own in _better_films(scene, case, parts):
        if scene.journal.in_motion:
            yield from paths_again(scene, case, parts, stage, models, own)
        else:
            yield from _films(scene, case, parts, stage, models[0])
    if not scene.journal.in_motion:
        yield from _motion(scene, case, parts)


def _loads(scene: Scene, case: Case, parts: Parts) -> Iterator[Difference]:
    better = ROTOR.finer(scene)
    if better is None:
        return
    series = hub_loads(better, case, {})
    sharp = bearing_loads(better, case, {"loads": series})
    for bearing in sharp["bearing"].values:
        ours, theirs = (describe_loads(scene, data, bearing) for data in (parts["shaft"], sharp))
        where, against = f"{case.name}, {bearing}", f"the rotor {better.loads.rung}"
        yield from differences("loads", "loads.statistics", where, against, ours, theirs)


def describe_loads(scene: Scene, bearings: xr.Dataset, bearing: str) -> dict[str, float]:
    """Return largest load and damage of what governs a bearing: radial force or tilting moment.

    And the largest radial force by itself, where that governs.
    """
    load, by_moment = governing_load(scene, bearings, bearing)
    time = bearings["time"].values
    duration = float(time[-1] - time[0])
    sideways, upright = (damage_equivalent_load(track, SLOPE, duration) for track in load.T)
    largest = float(np.hypot(*load.T).max())
    damage = {"bearing force DEL": float(np.hypot(sideways, upright))}
    radial = {} if by_moment else {"radial force max": largest}
    return {"bearing load max": largest} | radial | damage


def _reduction(scene: Scene, case: Case, parts: Parts) -> Iterator[Difference]:
    for bearing, node in parts["reduction"].children.items():
        load = np.hypot(*governing_load(scene, parts["shaft"], bearing)[0].T)
        where, index = f"{case.name}, {bearing}", node["index"].values
        # the times that the scene wants are the whole series that it speaks of
        wanted = np.zeros(load.size, dtype=bool)
        wanted[stretch(parts["loads"]["time"].values, scene.reduction.between, where)] = True
        yield Difference(
            "reduction",
            "reduction.histogram",
            "largest load",
            where,
            "the full series",
            relative(load[index].max(), load[wanted].max()),
        )
        if "journal" in parts and not scene.journal.in_motion and bearing in _answered(parts):
            film = parts["journal"][bearing].to_dataset()
            yield Difference(
                "reduction",
                "journal.film",
                "eccentricity ratio",
                where,
                "the full series",
                _severest(scene.journal.at(bearing), bearing, load * wanted, parts, film),
            )


def _severest(
    options: Journal, bearing: str, load: np.ndarray, parts: Parts, film: xr.Dataset
) -> float:
    """Compare the largest ε with that at the largest load per speed of the full series."""
    speed = parts["loads"]["speed"].values.astype(float)
    turning = np.abs(speed) >= np.abs(film["speed"].values[film["converged"].values > 0]).min()
    worst = int(np.argmax(np.where(turning, load / np.maximum(np.abs(speed), 1e-12), 0.0)))
    at = parts["shaft"].sel(bearing=bearing).isel(time=[worst])
    force = at["force"].transpose("time", "axis").values.astype(float)
    line = shaft_line(options, at)
    answer = equilibria(options, force, speed[worst : worst + 1], **line)
    return relative(
        float(film["eccentricity_ratio"].max()), float(np.max(answer.eccentricity_ratio))
    )


def _answered(parts: Parts) -> list[str]:
    """Journal bearings that have a film in some sample; in the others the surfaces touch in all."""
    return [name for name, node in parts["journal"].children.items() if node["converged"].any()]


def _better_films(
    scene: Scene, case: Case, parts: Parts
) -> Iterator[tuple[str, list[Better], dict[str, Journal] | None]]:
    """Stage, better models of the film from the next one on, and of other cells the film as it is.

    None of a shaft that stands throughout: what it rests on as it creeps in its brake depends on
    the cells, however fine they are.
    """
    films = {b: parts["journal"][b].to_dataset() for b in _answered(parts)}
    films = {b: film for b, film in films.items() if np.isfinite(running_ratio(case, film)).any()}
    if not films:
        return
    if scene.journal.heat is None:
        warmer = {b: _warmer(scene.journal.at(b), film) for b, film in films.items()}
        yield HEAT.name, [("oil warmed by its friction", warmer)], None
    other, against = other_cells(scene)
    if other is None:
        return
    models = [(against, _held_warm(other, films))]
    if scene.journal.in_motion and scene.journal.rung == "reduced" and FILM_MODEL.finer(scene):
        while (other := FILM_MODEL.finer(other)) is not None:
            models.append((f"the film {FILM_MODEL.key(other)}", _held_warm(other, films)))
    yield FILM_MODEL.name, models, _held_warm(scene, films)


def _held_warm(scene: Scene, films: Mapping[str, xr.Dataset]) -> dict[str, Journal]:
    """The journal bearings of `films`, at the temperature that each has in motion."""
    options = {bearing: scene.journal.at(bearing) for bearing in films}
    if not scene.journal.in_motion or scene.journal.heat is None:
        return options
    return {
        bearing: options[bearing].at_temperature(float(film["temperature"].median()))
        for bearing, film in films.items()
    }


def other_cells(scene: Scene) -> tuple[Scene | None, str]:
    """The scene with the next finer film, and what that is called.

    Nothing is finer than the finest: half as many cells each way that they are refined stand in for
    it; None without cells.
    """
    finer = FILM_MODEL.finer(scene)
    if finer is not None:
        return finer, f"the film {FILM_MODEL.key(finer)}"
    around, across = scene.journal.grid
    half = {"reduced": (around // 2, across), "grid": (around // 2, across // 2)}
    grid = half.get(scene.journal.rung)
    coarser = with_settings(scene, "journal", {"grid": grid}) if grid else None
    if coarser is None:
        return None, ""
    moves = "half as fine; by first order, the film is off by as much as it moves"
    return coarser, f"the film {FILM_MODEL.key(coarser)} ({moves})"


def _warmer(options: Journal, film: xr.Dataset) -> Journal:
    """The bearing with the oil as warm as the mean friction makes it, if the side flow takes all.

    ΔT = P/(ρ c Q) of the energy balance, and the viscosity that is left after it.
    """
    oil = options.lubricant
    carried = oil.density * HEAT_CAPACITY * float(film["side_flow"].mean())
    warming = float(film["friction_power"].mean()) / carried if carried > 0 else 0.0
    thinner = replace(oil, viscosity=oil.viscosity * float(np.exp(-THINNING * warming)))
    return options.model_copy(update={"lubricant": thinner})


def _films(
    scene: Scene, case: Case, parts: Parts, stage: str, model: Better
) -> Iterator[Difference]:
    """Equilibria of a few samples, by the next better model.

    Of those in which the rotor runs: as it comes to a stand, films get as thin as any cells fail to
    resolve, until the surfaces touch, and what is asked of them there is when they do.
    """
    against, options = model
    for bearing, better in options.items():
        film = parts["journal"][bearing].to_dataset().load()
        places = _spread(running_ratio(case, film))
        some = film.isel(sample=places)
        loads = parts["reduction"][bearing].to_dataset().isel(sample=places)
        line = shaft_line(scene.journal.at(bearing), loads)
        answer = equilibria(better, loads["force"].values, some["speed"].values, **line)
        ours = {quantity: some[quantity].values for quantity in FILM}
        where = f"{case.name}, {bearing}"
        yield from differences(stage, "journal.film", where, against, ours, vars(answer))


def _motion(scene: Scene, case: Case, parts: Parts) -> Iterator[Difference]:
    """The series with the film in motion, where that is cheap, as far as the rotor runs."""
    for bearing in _answered(parts):
        journal = fast_film(scene.journal.at(bearing))
        if journal is None:
            return
        film = parts["journal"][bearing].to_dataset().load()
        loads, shaft = parts["loads"].load(), parts["shaft"].sel(bearing=bearing).load()
        try:
            path = follow(journal, loads, shaft, past=past_of(scene, loads))
        except SolverError:
            continue
        runs = running(scene, loads)
        ours, theirs = (
            extremes_of_orbit(track)
            for track in (film.where(counted(film)), path.where(runs | ~runs.any()))
        )
        kept, where = {quantity: ours[quantity] for quantity in EXTREMES}, f"{case.name}, {bearing}"
        yield from differences(
            MOTION.name, "journal.film", where, "the film in motion", kept, theirs
        )


def _contacts(scene: Scene, case: Case, parts: Parts) -> Iterator[Difference]:
    """Equilibria of a few samples of the first bearing, and the life under these alone."""
    better = None if RINGS.is_on(scene) else RINGS.switched(scene, True)
    if better is None:
        return
    bearing = scene.rolling.bearing
    reduced = parts["reduction"][bearing].to_dataset()
    places = _spread(parts["rolling"]["maximum_force"].values)
    some = reduced.isel(sample=places).load()
    ours, theirs = (solve_bearing(one, bearing, some) for one in (scene, better))
    where, against = f"{case.name}, {bearing}", f"rings {better.rolling.rings}"
    forces, lives = (
        [{q: getattr(answer, q) for q in CONTACT} for answer in (ours, theirs)],
        [{"life": life_of(answer, some)} for answer in (ours, theirs)],
    )
    yield from differences(RINGS.name, "rolling.loads", where, against, *forces)
    yield from differences(RINGS.name, "rolling.life", where, against, *lives)


def _collars(scene: Scene, case: Case, parts: Parts) -> Iterator[Difference]:
    """Films of a few samples of each collar, on the grid, where they are those of a curve.

    Those of a table of tilts, of temperatures or of a path are held against a finer one.
    """
    cells = finer_grid(scene)
    if scene.thrust.rung != "curve" or (tabulated(scene) and cells is None):
        return
    for place, bearing in scene.thrust.collars.items():
        film = parts["thrust"][place].to_dataset().load()
        if not film["converged"].any():
            continue
        some = _spread(film["minimum_film"].values)
        ours = {name: film[name].values[some] for name in ("minimum_film", "maximum_pressure")}
        samples = samples_of(scene, case, bearing, place, parts)
        if tabulated(scene) and cells is not None:
            finer, moving = bearing.on_cells(cells), follows(scene, bearing)
            found = solved(finer, place, samples, "curve", moving).isel(sample=some)
            against = f"the collar on {cells[0]} x {cells[1]} cells"
        else:
            found = solved(bearing, place, samples.isel(sample=some))
            against = "the collar on the grid"
        theirs = {name: found[name].values for name in ours}
        where = f"{case.name}, {place}"
        yield from differences("thrust", "thrust.film", where, against, ours, theirs)


def _spread(values: np.ndarray) -> np.ndarray:
    """Places of `SAMPLES` finite values, from the smallest to the largest in even steps of rank."""
    order = np.argsort(values)[: np.isfinite(values).sum()]
    return np.unique(order[np.linspace(0, order.size - 1, SAMPLES).round().astype(int)])


COMPARISONS: dict[str, Callable[[Scene, Case, Parts], Iterator[Difference]]] = {
    "loads": _loads,
    "reduction": _reduction,
    "journal": _film,
    "thrust": _collars,
    "rolling": _contacts,
}
"""For each stage that has better models, how it is compared with them."""

COMPARED = {"rolling": RINGS}
"""Of these the effect, where it is the one thing that is compared."""

READ = ("loads", "shaft", "reduction", "journal", "thrust", "rolling")
"""Stages that comparisons read."""

OCCASIONS = ("reduction", "journal", "thrust", "rolling")
"""Stages without which nothing is compared: a better load matters where a bearing reads it."""
