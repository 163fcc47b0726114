"""A path of a film beside that of better models, on a stretch around where it is closest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from scipy.ndimage import maximum_filter1d

from loadflow.cube import time_step
from loadflow.errors import SolverError
from loadflow.quantities import percent
from loadflow.scene.cases import Case
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.stages.differences import Difference, differences, relative
from loadflow.stages.films.past import TURNS, past_of
from loadflow.stages.films.turning import SLOWEST, is_parked, turning
from loadflow.stages.films.whirl import FORGOTTEN, whirling
from loadflow.stages.journal import FILM as CELLS
from loadflow.stages.running_time import counted, in_contact
from loadflow.stages.shaft_in_films import in_motion

RESULT = "journal.film"

FILM = ("eccentricity_ratio", "minimum_film", "maximum_pressure", "friction_power")

Better = tuple[str, dict[str, Journal]]
"""What a better model of the film is called, and by bearing, the journal bearing that it is."""

STEPS = 240
"""Steps of an orbit that are followed again, up to a little behind its largest eccentricity."""


def paths_again(
    scene: Scene,
    case: Case,
    parts: Mapping[str, Any],
    stage: str,
    models: Sequence[Better],
    own: dict[str, Journal] | None = None,
) -> Iterator[Difference]:
    """A stretch of the orbit around its largest eccentricity, from the place where it begins.

    Of it count the samples around that in which the rotor runs, as in films at rest, and does not
    whirl at half its speed: how soon that ends depends on the cells, however fine they are.

    It is held against the next better of `models`. Where that says that it may be off by more than
    the accuracy of the scene, the stretch is followed with the films that the bearings have, `own`,
    as well: shafts in light films forget slowly where they began. And the others of `models` come
    in turn, until one holds.
    """
    against, options = models[0]
    for bearing, better in options.items():
        film = parts["journal"][bearing].to_dataset().load()
        runs, where = running_ratio(case, film), f"{case.name}, {bearing}"
        whirls = whirling(film) & np.isfinite(runs)
        if whirls.any() and np.array_equal(whirls, np.isfinite(runs)):
            yield _not_asked(stage, where, "the shaft whirls at half its speed throughout")
            continue
        runs = np.where(whirls, np.nan, runs)
        if scene.shaft.coupled:
            # all films are one system: where smooth ones touch, none goes on as on other cells
            films = [in_contact(parts["journal"][name].to_dataset()) for name in options]
            touches = np.any(films, axis=0) & np.asarray(counted(film))
            # ends that are too near fail, and cells say how far
            near = film["minimum_film"].values < better.least_film
            runs = np.where(maximum_filter1d(near, 2 * STEPS), np.nan, runs)
            if (touches.any() and better.contact is None) or np.isnan(runs).all():
                yield _not_solved(stage, where, touches.mean(), better)
                continue
        beside = partial(_beside, scene, parts, stage, bearing, runs)
        found = [*beside(options)]
        if own and _is_off(scene, found) and _is_found(again := beside(own)[1]):
            found[0] = again
        for _, finer in models[1:]:
            if not _is_off(scene, found) or not _is_found(theirs := beside(finer)[1]):
                break
            found.append(theirs)
        yield from differences(stage, RESULT, where, against, *found)


def _is_found(answers: Mapping[str, float]) -> bool:
    return all(np.isfinite(value) for value in answers.values())


def _is_off(scene: Scene, found: Sequence[Mapping[str, float]]) -> bool:
    """Whether the last but one may be off by more than the accuracy of the scene.

    By first order the last one is off by as much as its cells moved the answers.
    """
    change = max(relative(found[-2][name], found[-1][name]) for name in FILM)
    return 2.0 * change > scene.allowed(RESULT)


def _beside(
    scene: Scene,
    parts: Mapping[str, Any],
    stage: str,
    bearing: str,
    runs: np.ndarray,
    options: dict[str, Journal],
) -> tuple[dict[str, float], dict[str, float]]:
    """Answers of a path as it is, and as it would be with the films of `options`.

    On a stretch around the largest ε of the samples in which `runs` (n,) are finite.
    """
    journal = next(iter(options.values())).model_copy(update={"own": options})
    other = scene.model_copy(update={"journal": journal})
    film = parts["journal"][bearing].to_dataset().load()
    places, ours, theirs = _stretch(scene, other, bearing, parts, runs, np.nanargmax(runs))
    # cells count where the film is thin, warmth all along the path
    some = places if stage == CELLS.name else slice(None)
    theirs = answers_of_path(film, some, ours, theirs)
    touches = in_contact(film).values
    alone = np.where(np.isfinite(runs) & ~touches, runs, np.nan)
    if touches[places].any() and np.isfinite(alone).any():
        # where surfaces rub, oil has hardly any pressure beside that of films that carry alone
        peak = film["maximum_pressure"].where(np.isfinite(alone)).argmax("sample")
        _, here, there = _stretch(scene, other, bearing, parts, alone, peak)
        for found, also in ((ours, here), (theirs, there)):
            pressures = [one["maximum_pressure"] for one in (found, also)]
            found["maximum_pressure"] = float(np.max(pressures))
    return ours, theirs


def _stretch(
    scene: Scene,
    other: Scene,
    bearing: str,
    parts: Mapping[str, Any],
    runs: np.ndarray,
    around: np.integer | xr.DataArray,
) -> tuple[slice, dict[str, float], dict[str, float]]:
    """Where a stretch around a sample is, and its extremes as they are and by the `other` scene.

    It reaches as far as `runs` (n,) are finite.
    """
    film, worst = parts["journal"][bearing].to_dataset().load(), int(around)
    step = time_step(parts["loads"])
    taken, finer = scene.journal.every(step), other.journal.at(bearing).every(step)
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
    places = slice(begin + known, begin + steps)
    return places, extremes_of_orbit(ours, known), theirs


def answers_of_path(
    film: xr.Dataset, places: slice, ours: dict[str, float], theirs: dict[str, float]
) -> dict[str, float]:
    """What answers of the whole path are if a stretch of it, at `places`, has `theirs`.

    In place of `ours`, and over those. Film and ε stay as they are where asperities carry the shaft
    at rest beyond these. The friction of a path is its mean: that of samples in which the shaft
    lies as far out as in the stretch has its change.
    """
    stretch = film.isel(sample=places)
    runs = np.broadcast_to(np.asarray(counted(film)), (film.sizes["sample"],))
    rests = in_contact(film) & ~runs
    stays = {
        "minimum_film": (np.fmin, film["minimum_film"].where(rests).min()),
        "eccentricity_ratio": (np.fmax, film["eccentricity_ratio"].where(rests).max()),
    }
    found = dict(theirs)
    for name, (further, rest) in stays.items():
        if np.isfinite(theirs[name]):
            reached = further(ours[name], float(rest))
            found[name] = float(ours[name] * further(theirs[name], float(rest)) / reached)
    power = film["friction_power"].where(runs)
    alike = film["eccentricity_ratio"] >= stretch["eccentricity_ratio"].min()
    mean, change = ours["friction_power"], theirs["friction_power"] - ours["friction_power"]
    if power.sum() > 0.0:
        change *= float(power.where(alike).sum() / power.sum())
    return found | {"friction_power": mean + change}


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
    return _not_asked(stage, where, f"bearing ends {how} < {1e6 * least:.2g} µm")


def _not_asked(stage: str, where: str, why: str) -> Difference:
    against = f"no other film; {why}"
    return Difference(stage, RESULT, "minimum film", where, against, float("nan"))


def running_ratio(case: Case, film: xr.Dataset) -> np.ndarray:
    """Eccentricity ratio of the samples in which the rotor runs, where some have one; else NaN.

    Without any such sample that of all in which it turns.
    """
    ratio = film["eccentricity_ratio"].where(
        xr.DataArray(turning(film, is_parked(case)), dims="sample")
    )
    running = ratio.where(counted(film))
    return np.asarray((running if running.notnull().any() else ratio).values)


def extremes_of_orbit(path: xr.Dataset, begin: int = 0) -> dict[str, float]:
    """What users read of an orbit: the smallest film, the mean friction, else the largest value.

    From its sample `begin` on.
    """
    track = {name: path[name][begin:] for name in FILM}
    found = {name: float(track[name].max()) for name in ("eccentricity_ratio", "maximum_pressure")}
    smallest, friction = float(track["minimum_film"].min()), float(track["friction_power"].mean())
    return found | {"minimum_film": smallest, "friction_power": friction}
