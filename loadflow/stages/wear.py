"""Films of all starts and stops → worn bore of each journal bearing over a lifetime of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr

from loadflow.journal.wear import TOUCHING, Cycle, wear_bearing
from loadflow.journal.worn_bearing import WornBearing
from loadflow.scene.cases import Case
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.stages.film_of_bearing import shaft_line
from loadflow.stages.frames import to_film
from loadflow.stages.labelling import label
from loadflow.stages.stage import Stage, always
from loadflow.wind.cases import by_load_case, stands_or_starts

_AFTER = 0.25  # of the time in contact, for which a cycle is followed beyond it


def wear(scene: Scene, cases: list[Case], inputs: Mapping[str, dict[str, Any]]) -> xr.DataTree:
    """Wear each bore by all starts, stops and faults that touch; one group per bearing.

    Returns
    -------
    xarray.DataTree
        Of each bearing `depth` (angle, z) after the life, and over ``renewal`` (and ``cycle``) the
        history of `loadflow.journal.WornBearing`; without values where no case touches.

    Raises
    ------
    loadflow.errors.SolverError
        A film in a worn bore without an answer.
    """
    found, counts = {}, counts_of(scene, (case.dlc for case in cases))
    for name in scene.journal.bearings:
        options = scene.journal.at(name)
        cycles, temperatures = [], []
        for case in cases:
            if not stands_or_starts(case.dlc):
                continue
            film = inputs[case.name]["journal"][name].to_dataset().load()
            loads, shaft = (inputs[case.name][key].load() for key in ("loads", "shaft"))
            cycle = touching_cycle(scene, options, film, loads, shaft.sel(bearing=name))
            if cycle is not None:
                count = counts[case.dlc] * case.weight
                cycles.append(replace(cycle, count=count, name=case.name))
                if "temperature" in film:
                    temperatures.append(float(film["temperature"].median()))
        found[name] = _told(_worn(scene, options, cycles, temperatures), cycles)
    return xr.DataTree.from_dict(found)


def _worn(
    scene: Scene, options: Journal, cycles: list[Cycle], temperatures: list[float]
) -> WornBearing | None:
    """The bore after all cycles; None where there are none."""
    if not cycles:
        return None
    held = options
    if temperatures:
        held = options.at_temperature(float(np.mean(temperatures)))
    film = replace(held.film_model, rung="grid")
    return wear_bearing(options.geometry, cycles, film, scene.wear.model)


def touching_cycle(
    scene: Scene, options: Journal, film: xr.Dataset, loads: xr.Dataset, shaft: xr.Dataset
) -> Cycle | None:
    """What of a load case is in contact while it turns, and the sample before; None: nothing.

    From its film and its loads, and from its shaft in the one bearing that `options` describe.
    """
    time, speed = (loads[key].values.astype(float) for key in ("time", "speed"))
    share = film["contact_share"].values
    rubs = (np.nan_to_num(share) > TOUCHING) & (np.abs(film["speed"].values) > 0)
    if not rubs.any():
        return None
    seconds = film["time"].values[rubs]
    first, last = float(seconds.min()), float(seconds.max())
    step = float(time[1] - time[0])
    first, last = first - step, last + _AFTER * (last - first) + step
    count = max(2, min(scene.wear.samples, int((last - first) / step) + 1))
    when = np.linspace(max(first, float(time[0])), min(last, float(time[-1])), count)
    line = {key: to_film(values) for key, values in shaft_line(options, shaft).items()}
    force = to_film(shaft["force"].transpose("time", "axis").values.astype(float))
    lying = {key: _between(when, time, values) for key, values in line.items()}
    if not options.tilt and "tilt" in film:  # a shell on a seat, which leaves that of the shaft
        lying["tilt"] = _between(when, film["time"].values, film["tilt"].values.astype(float))
        bent = to_film(shaft["curvature"].transpose("time", "axis").values.astype(float))
        lying["bend"] = _between(when, time, bent)
    return Cycle(
        when,
        _between(when, time, force),
        np.interp(when, time, speed),
        in_motion=options.in_motion,
        tilt=lying.get("tilt"),
        bend=lying.get("bend"),
    )


def counts_of(scene: Scene, dlcs: Iterable[str]) -> dict[str, float]:
    """How often each load case of a scene that starts, stops or stands happens in the life."""
    there = set(dlcs)
    yearly = by_load_case(scene.lifetime.per_year, there)
    told = {dlc: scene.lifetime.years * number for dlc, number in yearly.items()}
    told |= by_load_case(scene.wear.counts, there)
    return {dlc: told.get(dlc, scene.wear.events) for dlc in filter(stands_or_starts, there)}


def _between(when: np.ndarray, time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Straight lines through `values` (n, 2)."""
    return np.stack([np.interp(when, time, column) for column in values.T], axis=-1)


def _told(found: WornBearing | None, cycles: list[Cycle]) -> xr.Dataset:
    """Worn contour and history of one bearing."""
    if found is None:
        return xr.Dataset(attrs={"cycles": 0})
    counts = label("1", "how often in the life")
    return (
        found.to_dataset()
        .assign(count=("cycle", np.array([cycle.count for cycle in cycles]), counts))
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
    left_out=lambda scene: {
        "wear in power production": "only load cases that start, stop or stand wear the bore"
    },
)
