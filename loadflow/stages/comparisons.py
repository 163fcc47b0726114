"""Answers of a case beside those of the next better models, on a few of its samples."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import xarray as xr
from scipy.ndimage import maximum_filter1d

from loadflow.cube import time_step
from loadflow.errors import SolverError
from loadflow.quantities import percent
from loadflow.reduction import damage_equivalent_load
from loadflow.scene.cases import Case
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.stages.effects.film import MOTION
from loadflow.stages.effects.film_heat import HEAT
from loadflow.stages.effects.rolling import RINGS
from loadflow.stages.film_of_bearing import equilibria, follow, shaft_line
from loadflow.stages.film_past import TURNS, past_of
from loadflow.stages.journal import FILM as FILM_MODEL
from loadflow.stages.journal import fast_film
from loadflow.stages.kept_samples import stretch
from loadflow.stages.loads import ROTOR, hub_loads
from loadflow.stages.reduction import governing_load
from loadflow.stages.rolling import life_of, solve_bearing
from loadflow.stages.running_time import counted, running
from loadflow.stages.shaft import bearing_loads
from loadflow.stages.shaft_in_films import in_motion
from loadflow.stages.statistics import SLOPE
from loadflow.stages.thrust import finer_grid, follows, samples_of, solved, tabulated
from loadflow.stages.turning import SLOWEST, is_parked, turning

Parts = Mapping[str, Any]
"""What each stage gave for a case, by the name of the stage."""

FILM = ("eccentricity_ratio", "minimum_film", "maximum_pressure", "friction_power")
EXTREMES = ("eccentricity_ratio", "minimum_film", "maximum_pressure")
CONTACT = ("maximum_force", "maximum_pressure")

SAMPLES = 5
"""Samples of a case that are solved again, from the mildest to the hardest."""

STEPS = 240
"""Steps of an orbit that are followed again, up to a little behind its largest eccentricity."""

FORGOTTEN = 6
"""Turns of a shaft after which it lies in its films as they have it, wherever it began."""

HEAT_CAPACITY = 2000.0  # J/(kg K), mineral oil
THINNING = 0.035  # 1/K, relative loss of viscosity of a mineral oil of VG 100 … 320 near 50 °C


@dataclass(frozen=True)
class Difference:
    """How much an answer moves when a model is replaced by a better one.

    `stage` names the model or the effect, `result` is what the answer belongs to, `value` the
    relative change at its largest.
    """

    stage: str
    result: str
    quantity: str
    case: str
    against: str
    value: float


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
    again = _orbits if scene.journal.in_motion else _films
    for model, against, options in _better_films(scene, case, parts):
        yield from again(scene, case, parts, model, against, options)
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
        yield from _rows("loads", "loads.statistics", where, against, ours, theirs)


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
            _relative(load[index].max(), load[wanted].max()),
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
    return _relative(
        float(film["eccentricity_ratio"].max()), float(np.max(answer.eccentricity_ratio))
    )


def _answered(parts: Parts) -> list[str]:
    """Journal bearings that have a film in some sample; in the others the surfaces touch in all."""
    return [name for name, node in parts["journal"].children.items() if node["converged"].any()]


def _better_films(
    scene: Scene, case: Case, parts: Parts
) -> Iterator[tuple[str, str, dict[str, Journal]]]:
    """Stage, name and, by bearing, journal bearing of each model that the film is compared with.

    None of a shaft that stands throughout: what it rests on as it creeps in its brake depends on
    the cells, however fine they are.
    """
    films = {b: parts["journal"][b].to_dataset() for b in _answered(parts)}
    films = {b: film for b, film in films.items() if np.isfinite(_running_ratio(case, film)).any()}
    if scene.journal.heat is None:
        warmer = {b: _warmer(scene.journal.at(b), film) for b, film in films.items()}
        yield HEAT.name, "oil warmed by its friction", warmer
    better = FILM_MODEL.finer(scene)
    if better is not None:
        options = {bearing: better.journal.at(bearing) for bearing in films}
        if better.journal.in_motion and better.journal.heat is not None:
            options = {
                bearing: options[bearing].at_temperature(float(film["temperature"].median()))
                for bearing, film in films.items()
            }
        yield FILM_MODEL.name, f"the film {FILM_MODEL.key(better)}", options


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
    scene: Scene, case: Case, parts: Parts, stage: str, against: str, options: dict[str, Journal]
) -> Iterator[Difference]:
    """Equilibria of a few samples.

    Of those in which the rotor runs: as it comes to a stand, films get as thin as any cells fail to
    resolve, until the surfaces touch, and what is asked of them there is when they do.
    """
    for bearing, better in options.items():
        film = parts["journal"][bearing].to_dataset().load()
        places = _spread(_running_ratio(case, film))
        some = film.isel(sample=places)
        loads = parts["reduction"][bearing].to_dataset().isel(sample=places)
        line = shaft_line(scene.journal.at(bearing), loads)
        answer = equilibria(better, loads["force"].values, some["speed"].values, **line)
        ours = {quantity: some[quantity].values for quantity in FILM}
        where = f"{case.name}, {bearing}"
        yield from _rows(stage, "journal.film", where, against, ours, vars(answer))


def _orbits(
    scene: Scene, case: Case, parts: Parts, stage: str, against: str, options: dict[str, Journal]
) -> Iterator[Difference]:
    """A stretch of the orbit around its largest eccentricity, from the place where it begins.

    Of it count the samples around that in which the rotor runs, as in `_films`.
    """
    if not options:
        return
    journal = next(iter(options.values())).model_copy(update={"own": options})
    other = scene.model_copy(update={"journal": journal})
    for bearing, better in options.items():
        film = parts["journal"][bearing].to_dataset().load()
        step = time_step(parts["loads"])
        taken, finer = scene.journal.every(step), better.every(step)
        runs, where = _running_ratio(case, film), f"{case.name}, {bearing}"
        if scene.shaft.coupled:
            # all films are one system: where smooth ones touch, none goes on as on other cells
            films = [parts["journal"][name]["in_contact"].values > 0 for name in options]
            touches = np.any(films, axis=0) & np.asarray(counted(film))
            # ends that are too near fail, and cells say how far
            near = film["minimum_film"].values < better.least_film
            runs = np.where(maximum_filter1d(near, 2 * STEPS), np.nan, runs)
            if (touches.any() and better.contact is None) or np.isnan(runs).all():
                yield _not_solved(stage, where, touches.mean(), better)
                continue
        worst = int(np.nanargmax(runs))
        formed = int(np.argmax(np.isfinite(film["eccentricity"].values[:, 0])))
        begin = max(formed, min(worst - 3 * STEPS // 4, film.sizes["sample"] - STEPS))
        lead = 0
        if scene.shaft.coupled:  # a shaft in its films begins with a past of its own, and forgets
            turn = 2.0 * np.pi / max(float(np.abs(film["speed"][begin])), SLOWEST)
            lead = min(begin - formed, int(FORGOTTEN * turn / (step * taken)))
        elif not (recent := remembered(film, begin, step * taken)).all():
            lead = min(begin - formed, recent.size)
        begin -= lead
        place = film["eccentricity"].values[begin]
        steps = min(STEPS + lead, film.sizes["sample"] - begin)
        stands = begin + np.flatnonzero(~np.isfinite(runs[begin : begin + steps]))
        known = 1 + int(stands[stands < worst].max(initial=begin - 1)) - begin
        steps = int(stands[stands > worst].min(initial=begin + steps)) - begin
        # taken up in the middle, a film has no past: what it does before it has one is no answer
        if begin > formed or (begin == 0 and past_of(scene, parts["loads"]).steps):
            known = max(known, min(STEPS // 4, (steps - lead) // 2) + lead)
        ours = film.isel(sample=slice(begin, begin + steps))
        series = slice(begin * taken, (begin + steps - 1) * taken + 1, finer)
        loads, shaft = (parts[name].isel(time=series).load() for name in ("loads", "shaft"))
        try:
            path = in_motion(other, bearing, loads, shaft.sel(bearing=bearing), place)
            theirs = extremes_of_orbit(path, known * taken // finer)
        except SolverError:
            theirs = dict.fromkeys(FILM, np.nan)
        found = extremes_of_orbit(ours, known)
        yield from _rows(stage, "journal.film", where, against, found, theirs)


def remembered(film: xr.Dataset, begin: int, step: float) -> np.ndarray:
    """Whether the rotor runs (n,) in the samples before `begin` that a film remembers there.

    Those of its last `TURNS` turns: as fast as the shaft turns, oil flows to where it was lacking.
    Samples are every `step`, s.
    """
    angle = np.cumsum(np.abs(film["speed"].values[:begin][::-1])) * step
    remembered = int(np.searchsorted(angle, 2.0 * np.pi * TURNS))
    runs = film["running"].values if "running" in film else np.ones(film.sizes["sample"])
    return runs[begin - remembered : begin] > 0


def _not_solved(stage: str, where: str, touching: float, options: Journal) -> Difference:
    """A film that is not solved again, as ends touch in a share of the time, or nearly do always.

    Where they touch it is thinner than the roughness of both surfaces, however fine the cells are.
    """
    how = f"touch in {percent(touching)} of the time: h" if touching else "nearly touch: h"
    least = options.contact_film if touching else options.least_film
    against = f"no other film; bearing ends {how} < {1e6 * least:.2g} µm"
    return Difference(stage, "journal.film", "minimum film", where, against, float("nan"))


def _running_ratio(case: Case, film: xr.Dataset) -> np.ndarray:
    """Eccentricity ratio of the samples in which the rotor runs, where some have one; else NaN.

    Without any such sample that of all in which it turns.
    """
    ratio = film["eccentricity_ratio"].where(
        xr.DataArray(turning(film, is_parked(case)), dims="sample")
    )
    running = ratio.where(counted(film))
    return np.asarray((running if running.notnull().any() else ratio).values)


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
        yield from _rows(MOTION.name, "journal.film", where, "the film in motion", kept, theirs)


def extremes_of_orbit(path: xr.Dataset, begin: int = 0) -> dict[str, float]:
    """What users read of an orbit: the smallest film, the mean friction, else the largest value.

    From its sample `begin` on.
    """
    track = {name: path[name][begin:] for name in FILM}
    found = {name: float(track[name].max()) for name in ("eccentricity_ratio", "maximum_pressure")}
    smallest, friction = float(track["minimum_film"].min()), float(track["friction_power"].mean())
    return found | {"minimum_film": smallest, "friction_power": friction}


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
    yield from _rows(RINGS.name, "rolling.loads", where, against, *forces)
    yield from _rows(RINGS.name, "rolling.life", where, against, *lives)


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
        yield from _rows("thrust", "thrust.film", where, against, ours, theirs)


def _rows(
    stage: str,
    result: str,
    where: str,
    against: str,
    ours: Mapping[str, Any],
    theirs: Mapping[str, Any],
) -> Iterator[Difference]:
    """A difference for each quantity of `ours`."""
    for name, values in ours.items():
        change = _relative(values, theirs[name])
        yield Difference(stage, result, name.replace("_", " "), where, against, change)


def _spread(values: np.ndarray) -> np.ndarray:
    """Places of `SAMPLES` finite values, from the smallest to the largest in even steps of rank."""
    order = np.argsort(values)[: np.isfinite(values).sum()]
    return np.unique(order[np.linspace(0, order.size - 1, SAMPLES).round().astype(int)])


def _relative(ours: Any, theirs: Any) -> float:
    """Largest relative change; infinite where only one of the two has an answer."""
    ours, theirs = np.atleast_1d(ours).astype(float), np.atleast_1d(theirs).astype(float)
    known = np.isfinite(ours) & np.isfinite(theirs)
    if not np.array_equal(np.isfinite(ours), known) or not np.array_equal(
        np.isfinite(theirs), known
    ):
        return float("inf")
    scale = np.where(theirs[known] != 0, np.abs(theirs[known]), 1.0)
    return float(np.max(np.abs(ours[known] - theirs[known]) / scale, initial=0.0))


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
