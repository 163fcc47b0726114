"""Films of all load cases → worn bore of each journal bearing over the lifetime."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.errors import ValidityWarning
from loadflow.journal.grid_bounds import unresolved_counted
from loadflow.journal.wear.cycle import Cycle
from loadflow.journal.wear.lifetime import TOUCHING, wear_bearing
from loadflow.journal.wear.worn_bearing import WornBearing
from loadflow.numerics.lines import on_lines
from loadflow.scene.cases import Case
from loadflow.scene.journal import Journal
from loadflow.scene.lifetime_shares import seconds_per_year, shares_in
from loadflow.scene.scene import Scene
from loadflow.stages.films.of_bearing import shaft_line
from loadflow.stages.frames import to_film
from loadflow.stages.labelling import label
from loadflow.stages.stage import Stage, always
from loadflow.wind.cases import by_load_case, stands_or_starts

_AFTER = 0.25  # of the time in contact, for which a cycle is followed beyond it


def wear(scene: Scene, cases: list[Case], inputs: Mapping[str, dict[str, Any]]) -> xr.DataTree:
    """Wear each bore by all that touches in a load case; one group per bearing.

    Starts, stops and faults count as often as the scene says, other load cases with their share
    of the lifetime.

    Returns
    -------
    xarray.DataTree
        Of each bearing `depth` (angle, z) after the life, and over ``renewal`` (and ``cycle``) the
        history of `loadflow.journal.WornBearing`; `case` and `production` tell of which load case a
        cycle is, and whether the shaft runs in it throughout. Without values where none touches.

    Raises
    ------
    loadflow.errors.SolverError
        A film in a worn bore without an answer.
    """
    found, times = {}, _times(scene, cases)
    for name in scene.journal.bearings:
        options = scene.journal.at(name)
        cycles, temperatures = list[tuple[Case, Cycle]](), []
        for case, count in zip(cases, times):
            if count == 0.0:
                continue
            parts = inputs[case.name]  # read once
            film = parts["journal"][name].to_dataset().load()
            loads, shaft = (parts[key].load() for key in ("loads", "shaft"))
            asked = scene, options, film, loads, shaft.sel(bearing=name)
            some = cycles_of(case.dlc, *asked)
            for number, one in enumerate(some, start=1):
                told = case.name if len(some) == 1 else f"{case.name}, {number}"
                cycles.append((case, replace(one, count=count * one.count, name=told)))
            if some and "temperature" in film:
                temperatures.append(float(film["temperature"].median()))
        worn = _worn(scene, options, [cycle for _, cycle in cycles], temperatures)
        found[name] = _told(worn, cycles)
    return xr.DataTree.from_dict(found)


def _times(scene: Scene, cases: list[Case]) -> list[float]:
    """How often the series of each case comes in the life."""
    dlcs = [case.dlc for case in cases]
    counts = counts_of(scene, dlcs)
    given = [(case.dlc, case.wind_speed, case.duration, case.weight) for case in cases]
    share, seconds = shares_in(scene, *zip(*given)), seconds_per_year(scene, dlcs)
    running = np.zeros(len(cases)) if share is None else share * seconds * scene.lifetime.years
    return [
        counts[case.dlc] * case.weight if case.dlc in counts else float(taken) / case.duration
        for case, taken in zip(cases, running)
    ]


def _worn(
    scene: Scene, options: Journal, cycles: list[Cycle], temperatures: list[float]
) -> WornBearing | None:
    """The bore after all cycles; None where there are none."""
    if not cycles:
        return None
    held = options
    if temperatures:
        held = options.at_temperature(float(np.mean(temperatures)))
    with unresolved_counted():  # the run has told of these in the films that wear begins with
        warnings.filterwarnings("ignore", 'rung "reduced": the pressure at', ValidityWarning)
        return wear_bearing(options.geometry, cycles, held.film_model, scene.wear.model)


def cycles_of(
    dlc: str, scene: Scene, options: Journal, film: xr.Dataset, loads: xr.Dataset, shaft: xr.Dataset
) -> list[Cycle]:
    """What of a load case is in contact while it turns, the hardest first; as `touching_cycle`.

    Of one that starts, stops or stands from the first contact to the last; of others each spell of
    contact, of which those that rub most stand for all: `count` is the friction energy of all over
    that of these. Films at rest have no such spells.
    """
    if stands_or_starts(dlc):
        cycle = touching_cycle(scene, options, film, loads, shaft)
        return [] if cycle is None else [cycle]
    if not options.in_motion:
        return []
    time, rubs = film["time"].values, _rubs(film)
    energy = np.where(rubs, film["contact_power"].values, 0.0)
    spells = sorted(_spells(rubs, scene.wear.samples), key=lambda one: -energy[one].sum())
    kept, left = list[slice](), scene.wear.samples
    for one in spells:
        if not kept or one.stop - one.start <= left:
            kept.append(one)
            left -= one.stop - one.start
    if not kept or energy.sum() == 0.0:
        return []
    whole = float(energy.sum() / sum(energy[one].sum() for one in kept))
    given = options, film, loads, shaft
    return [replace(_lying(time[one], one.start, *given), count=whole) for one in kept]


def _place(options: Journal, film: xr.Dataset, sample: int) -> NDArray[np.float64] | None:
    """Eccentricity (2,), m, of a sample in the bore as stated; None at rest and without an answer.

    At rest under the first load the shaft would touch long before squeeze lets it.
    """
    if not options.in_motion:
        return None
    found = film.isel(sample=sample)
    place = found["eccentricity"].values.astype(float)
    if "clearance" in found:  # that of the warm bore
        place *= options.geometry.clearance / float(found["clearance"])
    return place if np.isfinite(place).all() else None


def _spells(rubs: NDArray[np.bool_], most: int) -> Iterator[slice]:
    """Each stretch in contact, of `most` samples, with the one before it and the one after."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], rubs.astype(int), [0]])))
    for first, end in edges.reshape(-1, 2).tolist():
        for begin in range(first, end, most):
            yield slice(max(begin - 1, 0), min(begin + most, end) + 1)


def _rubs(film: xr.Dataset) -> NDArray[np.bool_]:
    """Samples of a film that touch while they turn."""
    share = np.nan_to_num(film["contact_share"].values)
    return np.asarray((share > TOUCHING) & (np.abs(film["speed"].values) > 0))


def touching_cycle(
    scene: Scene, options: Journal, film: xr.Dataset, loads: xr.Dataset, shaft: xr.Dataset
) -> Cycle | None:
    """What of a load case is in contact while it turns, and the sample before; None: nothing.

    From its film and its loads, and from its shaft in the one bearing that `options` describe.
    """
    time, rubs = loads["time"].values.astype(float), _rubs(film)
    if not rubs.any():
        return None
    begin = max(int(np.argmax(rubs)) - 1, 0)
    seconds = film["time"].values
    first, last = float(seconds[begin]), float(seconds[rubs].max())
    step = float(time[1] - time[0])
    last += _AFTER * (last - first) + step
    count = max(2, min(scene.wear.samples, int((last - first) / step) + 1))
    when = np.linspace(first, min(last, float(time[-1])), count)
    return _lying(when, begin, options, film, loads, shaft)


def _lying(
    when: np.ndarray,
    begin: int,
    options: Journal,
    film: xr.Dataset,
    loads: xr.Dataset,
    shaft: xr.Dataset,
) -> Cycle:
    """Loads and shaft at some times of a load case, from the sample `begin` of its film on."""
    time, speed = (loads[key].values.astype(float) for key in ("time", "speed"))
    line = {key: to_film(values) for key, values in shaft_line(options, shaft).items()}
    force = to_film(shaft["force"].transpose("time", "axis").values.astype(float))
    lying = {key: on_lines(when, time, values) for key, values in line.items()}
    if not options.tilt and "tilt" in film:  # a shell on a seat, which leaves that of the shaft
        lying["tilt"] = on_lines(when, film["time"].values, film["tilt"].values.astype(float))
        bent = to_film(shaft["curvature"].transpose("time", "axis").values.astype(float))
        lying["bend"] = on_lines(when, time, bent)
    return Cycle(
        when,
        on_lines(when, time, force),
        np.interp(when, time, speed),
        in_motion=options.in_motion,
        tilt=lying.get("tilt"),
        bend=lying.get("bend"),
        start=_place(options, film, begin),
    )


def counts_of(scene: Scene, dlcs: Iterable[str]) -> dict[str, float]:
    """How often each load case of a scene that starts, stops or stands happens in the life."""
    there = set(dlcs)
    yearly = by_load_case(scene.lifetime.per_year, there)
    told = {dlc: scene.lifetime.years * number for dlc, number in yearly.items()}
    told |= by_load_case(scene.wear.counts, there)
    return {dlc: told.get(dlc, scene.wear.events) for dlc in filter(stands_or_starts, there)}


def _told(found: WornBearing | None, cycles: list[tuple[Case, Cycle]]) -> xr.Dataset:
    """Worn contour and history of one bearing."""
    if found is None:
        return xr.Dataset(attrs={"cycles": 0})
    counts = np.array([cycle.count for _, cycle in cycles])
    names, runs = [case.name for case, _ in cycles], label("1", "whether the shaft runs throughout")
    production = np.array([not stands_or_starts(case.dlc) for case, _ in cycles])
    return (
        found.to_dataset()
        .assign(count=("cycle", counts, label("1", "how often in the life")))
        .assign(case=("cycle", names, label("1", "load case")))
        .assign(production=("cycle", production, runs))
        .assign_attrs(cycles=len(cycles))
    )


STAGE = Stage(
    "wear",
    run=wear,
    results={"journal.wear": lambda scene: {}},
    needs=always("loads", "shaft", "journal"),
    scope="run",
    sections=always("journal", "wear", "lifetime"),
    work=lambda scene, cases, measured: None,
    left_out=lambda scene: (
        {}
        if scene.journal.in_motion
        else {"wear in power production": "films at rest have no spells of contact to follow"}
    ),
)
