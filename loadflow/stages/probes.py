"""What users read of a model on a short stretch of a load case: what the pilot compares.

A probe solves a few samples around the largest load, so that an effect can be switched and its size
be seen in a second.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.scene.cases import Case
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.stages.comparisons import FILM, describe_loads, extremes_of_orbit
from loadflow.stages.effects.situation import situation
from loadflow.stages.film_of_bearing import (
    equilibria,
    follow,
    shaft_line,
    surely_carried,
    surely_touching,
)
from loadflow.stages.frames import to_film, to_rolling
from loadflow.stages.loads import hub_loads
from loadflow.stages.reduction import moment_governs
from loadflow.stages.rolling import life_of, solve_bearing
from loadflow.stages.shaft import bearing_loads
from loadflow.stages.thrust import follows, samples_of, solved

Floats = NDArray[np.float64]

Answers = dict[tuple[str, str], float]
"""By bearing and quantity."""

STEPS = 360
"""Steps of the stretch around the largest load of a bearing."""

SETTLED = 60
"""Of these, the first ones that still show where an orbit began; they are dropped."""

AT_REST = 16
"""Of the others, how many are solved at rest."""

CONTACTS = 12
"""Samples of a rolling bearing, from the mildest to the hardest."""


@dataclass(frozen=True)
class Probe:
    """How a model is probed: the stages whose series it reads, and what it answers."""

    reads: tuple[str, ...]
    answers: Callable[[Scene, Case, Mapping[str, Any]], Answers]


def hardest(scene: Scene, cases: tuple[Case, ...]) -> list[Case]:
    """Return the cases of the largest steady load per speed and of the largest load, estimated.

    Of given series only the wind speed is known: the lowest and the highest are taken.
    """
    first = {case.wind_speed: case for case in reversed(cases)}
    speeds = sorted(first)
    if scene.loads.source == "files":
        places = [0, len(speeds) - 1]
    else:
        at = situation(scene, cases)
        bearings = at.bearings.values()
        steady = np.max([one.radial for one in bearings], axis=0) / at.speed
        largest = np.max([one.radial + one.swing + one.turn for one in bearings], axis=0)
        places = [int(np.argmax(steady)), int(np.argmax(largest))]
    return [first[speeds[place]] for place in dict.fromkeys(places)]


def _of_rotor(scene: Scene, case: Case, inputs: Mapping[str, Any]) -> Answers:
    return _of_shaft(scene, case, {"loads": hub_loads(scene, case, {})})


def _of_shaft(scene: Scene, case: Case, inputs: Mapping[str, Any]) -> Answers:
    """Largest load and damage of what governs each bearing."""
    loads = bearing_loads(scene, case, dict(inputs))
    return {
        (str(bearing), quantity): value
        for bearing in loads["bearing"].values
        for quantity, value in describe_loads(scene, loads, str(bearing)).items()
    }


def _of_film(scene: Scene, case: Case, inputs: Mapping[str, Any]) -> Answers:
    """Extremes and mean friction of each film around its largest load per speed that has one."""
    found: Answers = {}
    for bearing in scene.journal.bearings:
        journal = scene.journal.at(bearing)
        loads, shaft = inputs["loads"], inputs["shaft"].sel(bearing=bearing)
        force = to_film(shaft["force"].transpose("time", "axis").values.astype(float))
        speed = np.abs(loads["speed"].values.astype(float))
        load = np.where(
            _has_film(journal, shaft, speed), np.hypot(*force.T) / np.maximum(speed, 1e-12), 0.0
        )
        begin = max(0, min(int(np.argmax(load)) - 3 * STEPS // 4, load.size - STEPS))
        stretch = slice(begin, begin + STEPS)
        loads, shaft = loads.isel(time=stretch), shaft.isel(time=stretch)
        if journal.in_motion:
            film = follow(journal, loads, shaft).isel(time=slice(_settled(loads), None))
        else:
            film = _at_rest(journal, loads, shaft)
        for name, value in extremes_of_orbit(film).items():
            found[bearing, name.replace("_", " ")] = value
    return found


def _settled(loads: xr.Dataset) -> int:
    """First sample of a stretch that counts: `SETTLED`, or the middle of a series that is short."""
    return min(SETTLED, loads.sizes["time"] // 2)


def _has_film(journal: Journal, shaft: xr.Dataset, speed: Floats) -> NDArray[np.bool_]:
    """Whether a sample turns, and a film carries it for certain, else perhaps.

    A shaft that lies has no film, and where it nearly does a search for one takes seconds.
    """
    smooth = journal.model_copy(update={"contact": None})  # the same samples with and without
    vectors = shaft["force"].transpose("time", "axis").values.astype(float)
    turning = (speed > 0.01 * speed.max()) & ~surely_touching(smooth, vectors, speed)
    light = turning & surely_carried(smooth, vectors, speed)
    return light if light.any() else turning


def _at_rest(journal: Journal, loads: xr.Dataset, shaft: xr.Dataset) -> xr.Dataset:
    """Films of some samples of a stretch, from the mildest to the hardest."""
    some = slice(_settled(loads), None)
    loads, shaft = loads.isel(time=some), shaft.isel(time=some)
    force = shaft["force"].transpose("time", "axis").values.astype(float)
    speed = loads["speed"].values.astype(float)
    carried = np.flatnonzero(_has_film(journal, shaft, np.abs(speed)))
    if carried.size == 0:
        raise SolverError("shaft and shell touch in all samples")
    hard = np.hypot(*to_film(force[carried]).T) / np.abs(speed[carried])
    order = carried[np.argsort(hard, kind="stable")]
    places = np.unique(order[np.linspace(0, order.size - 1, AT_REST).round().astype(int)])
    line = shaft_line(journal, shaft.isel(time=places))
    film = equilibria(journal, force[places], speed[places], **line)
    return xr.Dataset({name: ("time", np.asarray(getattr(film, name))) for name in FILM})


def _of_contacts(scene: Scene, case: Case, inputs: Mapping[str, Any]) -> Answers:
    """Largest contact of a few samples of each bearing, and the life under these alone."""
    found: Answers = {}
    for bearing in scene.rolling.bearings:
        shaft = inputs["shaft"].sel(bearing=bearing)
        moment = shaft["moment"].transpose("time", "axis").values.astype(float)
        force = shaft["force"].transpose("time", "axis").values.astype(float)
        load = moment if moment_governs(scene, bearing, moment) else force
        order = np.argsort(np.hypot(*to_film(load).T), kind="stable")
        places = np.unique(order[np.linspace(0, order.size - 1, CONTACTS).round().astype(int)])
        some = xr.Dataset(
            {
                "force": (("sample", "axis"), force[places]),
                "moment": (("sample", "axis"), moment[places]),
                "speed": ("sample", inputs["loads"]["speed"].values.astype(float)[places]),
                "weight": ("sample", np.ones(places.size)),
            }
        )
        answer = solve_bearing(scene, bearing, some)
        found |= {
            (bearing, "maximum force"): float(np.max(answer.maximum_force)),
            (bearing, "maximum pressure"): float(np.max(answer.maximum_pressure)),
            (bearing, "life"): life_of(answer, some),
        }
    return found


def _of_collars(scene: Scene, case: Case, inputs: Mapping[str, Any]) -> Answers:
    """Extremes and mean friction of each bearing of pads: of all that a curve gives at once.

    Of others a few are solved, the hardest included.
    """
    found: Answers = {}
    for place, bearing in scene.thrust.bearings.items():
        samples = samples_of(scene, case, bearing, place, inputs)
        force, moment = (
            to_rolling(samples[name].transpose("sample", "axis").values.astype(float))
            for name in ("force", "moment")
        )
        order = np.argsort(bearing.normal_load(force, moment), kind="stable")
        places = np.unique(order[np.linspace(0, order.size - 1, CONTACTS).round().astype(int)])
        if scene.thrust.rung != "curve" or bearing.kind != "thrust":
            samples = samples.isel(sample=places)
        film = solved(bearing, place, samples, scene.thrust.rung, follows(scene, bearing))
        weight = film["weight"]
        found |= {
            (place, "minimum film"): float(np.nanmin(film["minimum_film"])),
            (place, "maximum pressure"): float(np.nanmax(film["maximum_pressure"])),
            (place, "friction power"): float(film["friction_power"].weighted(weight).mean()),
        }
    return found


PROBES: dict[str, Probe] = {
    "loads": Probe((), _of_rotor),
    "shaft": Probe(("loads",), _of_shaft),
    "journal": Probe(("loads", "shaft"), _of_film),
    "thrust": Probe(("loads", "shaft"), _of_collars),
    "rolling": Probe(("loads", "shaft"), _of_contacts),
}
"""By model; effects of models that have none are told by their indicators alone."""
