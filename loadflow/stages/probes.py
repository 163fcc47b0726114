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
from loadflow.stages.comparisons import describe_loads
from loadflow.stages.effects.situation import points, situation
from loadflow.stages.films.of_bearing import (
    equilibria,
    shaft_line,
    surely_carried,
    surely_touching,
)
from loadflow.stages.films.turning import SLOWEST, is_parked, turning
from loadflow.stages.frames import to_film, to_rolling
from loadflow.stages.friction import extremes, losses
from loadflow.stages.loads import hub_loads
from loadflow.stages.paths_again import FILM, extremes_of_orbit
from loadflow.stages.reduction import moment_governs
from loadflow.stages.rolling import life_of, solve_bearing
from loadflow.stages.shaft import bearing_loads
from loadflow.stages.shaft_in_films import in_motion
from loadflow.stages.thrust import follows, samples_of, solved

Floats = NDArray[np.float64]

Answers = dict[tuple[str, str], float]
"""By bearing and quantity."""

STEPS = 360
"""Steps of the stretch around the largest load of a bearing."""

SETTLED = 60
"""Of these, the first ones that still show where an orbit began; they are dropped."""

AT_REST = 8
"""Of the others, how many are solved at rest."""

STIFF = 0.01
"""Opening of the gap over the clearance below which a shell lends a film no load to carry: about
what it takes to move ε by a hundredth."""

FOLLOWED = {"step": 0.4, "follow_every": 12}
"""What the friction of rolling bearings is asked with: loads every so many s, and one roller in so
many followed."""

CONTACTS = 12
"""Samples of a rolling bearing, from the mildest to the hardest."""


@dataclass(frozen=True)
class Probe:
    """How a model is probed: the stages whose series it reads, and what it answers.

    It is not asked in a case in which it cannot answer, and the effects stand by their indicators.
    What has another way where the first finds no answer `surely_answers`, with all effects on.
    `around_shaft` is what reads where a shaft lies in films that it moves in, all along the case;
    these films themselves are followed with it on the stretch that is asked.
    """

    reads: tuple[str, ...]
    answers: Callable[[Scene, Case, Mapping[str, Any]], Answers]
    can_answer: Callable[[Case, Mapping[str, Any]], bool] = lambda case, inputs: True
    surely_answers: bool = False
    around_shaft: bool = False


def hardest(scene: Scene, cases: tuple[Case, ...]) -> list[Case]:
    """Return the cases of the largest steady load per speed and of the largest load, estimated.

    A parked one has no speed: it counts with its load, or if all are parked. Of given series only
    the wind speed is known: the lowest and the highest are taken.
    """
    found = points(cases)
    if scene.loads.source == "files":
        places = [0, len(found) - 1]
    else:
        at = situation(scene, cases)
        bearings = at.bearings.values()
        load, turns = np.max([one.radial for one in bearings], axis=0), at.turns | ~at.turns.any()
        steady = np.where(turns, load / np.where(at.turns, at.speed, 1.0), 0.0)
        largest = np.max([one.radial + one.swing + one.turn for one in bearings], axis=0)
        places = [int(np.argmax(steady)), int(np.argmax(largest))]
    return [found[place] for place in dict.fromkeys(places)]


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


def _film_forms(case: Case, inputs: Mapping[str, Any]) -> bool:
    """Whether the shaft turns at all: one that stands rests on what no pilot needs to ask."""
    return bool(turning(inputs["loads"], is_parked(case)).any())


def _of_film(scene: Scene, case: Case, inputs: Mapping[str, Any]) -> Answers:
    """Extremes and mean friction of each film around its largest load per speed that has one."""
    found: Answers = {}
    fine = scene.journal.model_copy(update={"step": None})
    every = scene.model_copy(update={"journal": fine})
    for bearing in scene.journal.bearings:
        journal = scene.journal.at(bearing)
        loads, shaft = inputs["loads"], inputs["shaft"].sel(bearing=bearing)
        force = to_film(shaft["force"].transpose("time", "axis").values.astype(float))
        speed = np.abs(loads["speed"].values.astype(float))
        formed = _has_film(journal, shaft, speed)
        load = np.where(formed, np.hypot(*force.T) / np.maximum(speed, 1e-12), 0.0)
        stretch = _around(int(np.argmax(load)), formed)
        loads, shaft = loads.isel(time=stretch), shaft.isel(time=stretch)
        if journal.in_motion:
            film = in_motion(every, bearing, loads, shaft).isel(time=slice(_settled(loads), None))
        else:
            film = _at_rest(journal, loads, shaft)
        for name, value in extremes_of_orbit(film).items():
            found[bearing, name.replace("_", " ")] = value
    return found


def _around(worst: int, formed: NDArray[np.bool_]) -> slice:
    """`STEPS` samples, three quarters of them before the worst, that begin and end with a film.

    While the shaft stands before a start and after a stop, what it rests on is the same with and
    without most effects, and nothing without asperities.
    """
    begin = max(0, min(worst - 3 * STEPS // 4, formed.size - STEPS))
    begin += int(np.argmax(formed[begin:]))
    places = np.flatnonzero(formed[begin : begin + STEPS])
    return slice(begin, begin + int(places[-1]) + 1)


def _settled(loads: xr.Dataset) -> int:
    """First sample of a stretch that counts: `SETTLED`, or the middle of a series that is short."""
    return min(SETTLED, loads.sizes["time"] // 2)


def _has_film(journal: Journal, shaft: xr.Dataset, speed: Floats) -> NDArray[np.bool_]:
    """Whether a sample turns, and a smooth film carries it for certain.

    If it carries none for certain, those that it may carry; if it carries none at all, those that
    turn. A shaft that lies has no film, and where it nearly does a search for one takes seconds, in
    a shell most. Asperities do not count, so that the samples stay as they are switched.

    Raises
    ------
    loadflow.errors.SolverError
        The film is smooth, and carries none.
    """
    vectors = shaft["force"].transpose("time", "axis").values.astype(float)
    smooth = journal.model_copy(update={"contact": None})
    if _hardly_gives(journal, float(np.hypot(*to_film(vectors).T).max())):
        smooth = smooth.model_copy(update={"shell": None})
    turns = speed > max(0.01 * speed.max(), SLOWEST)
    light = turns & surely_carried(smooth, vectors, speed)
    if light.any():
        return np.asarray(light)
    carried = turns & ~surely_touching(smooth, vectors, speed)
    if carried.any():
        return np.asarray(carried)
    if journal.contact is None:
        raise SolverError("shaft and shell touch in all samples")
    return np.asarray(turns)


def _hardly_gives(journal: Journal, load: float) -> bool:
    """Whether a load, N, spread over the bore, opens the gap by less than a share of `STIFF`."""
    size, shell = journal.geometry, journal.shell
    if shell is None:
        return True
    pressure = load / (size.diameter * size.width)
    return bool(pressure * getattr(shell, "compliance", np.inf) < STIFF * size.clearance)


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
    """Largest contact of a few samples of each bearing, and the life under these alone.

    Their friction, if that is wanted, over the whole series, as rollers slip by what was before.
    """
    found = _of_friction(scene, case, inputs) if "rolling.friction" in scene.results else {}
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


def _of_friction(scene: Scene, case: Case, inputs: Mapping[str, Any]) -> Answers:
    """Mean losses, film and slip of each rolling bearing."""
    coarse = {
        "step": max(FOLLOWED["step"], scene.friction.step),
        "follow_every": max(FOLLOWED["follow_every"], scene.friction.follow_every),
    }
    friction = scene.friction.model_copy(update=coarse)
    told = extremes(losses(scene.model_copy(update={"friction": friction}), case, dict(inputs)))
    return {
        (str(place), quantity): float(told[key].sel(bearing=place))
        for place in told["bearing"].values
        for quantity, key in FRICTION.items()
    }


FRICTION = {
    "friction power": "mean_friction_power",
    "film parameter": "median_film_parameter",
    "slip": "mean_slip",
}
"""What users read of the friction of rolling bearings, and what its summary calls that."""


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
    "journal": Probe(("loads", "shaft"), _of_film, _film_forms),
    "thrust": Probe(("loads", "shaft"), _of_collars, surely_answers=True, around_shaft=True),
    "rolling": Probe(("loads", "shaft"), _of_contacts),
}
"""By model; effects of models that have none are told by their indicators alone."""
