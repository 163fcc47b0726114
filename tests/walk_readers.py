"""What the stages that read a section give for it, as fingerprints that the walks compare.

Each reader is a generator of what is found, the cheap first: a walk stops at the first difference.
"""

import hashlib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import xarray as xr
from synthetic import case

from loadflow.planning.choice import finer
from loadflow.planning.plan import make_plan
from loadflow.running.candidates import candidate_scene, candidates_for
from loadflow.running.comparison import Means
from loadflow.running.designing import chosen_candidate
from loadflow.running.search import Search
from loadflow.scene.cases import list_cases
from loadflow.stages import (
    dynamics,
    friction,
    journal,
    loads,
    reduction,
    rolling,
    seeds,
    shaft,
    thrust,
    wear,
)
from loadflow.studies.candidate.deviations import Built, tolerances_of
from loadflow.studies.design.crowning import crowns_of
from loadflow.studies.design.point import NUMBERS, DesignPoint
from loadflow.studies.design.space import space_of
from loadflow.studies.lifetime.finished_run import run_lifetime
from loadflow.studies.lifetime.load_spectrum import load_spectrum
from loadflow.studies.verdicts.verdicts import verdicts


def fingerprints(scene, section):
    """Yield a fingerprint of each thing that the readers of a section find."""
    for found in FOUND[section](scene):
        yield _fingerprint(found)


def _fingerprint(found):
    told = hashlib.sha256()
    if isinstance(found, xr.Dataset | xr.DataTree):
        for node in found.subtree if isinstance(found, xr.DataTree) else [found]:
            for name in sorted(map(str, node.data_vars)):
                told.update(name.encode() + np.ascontiguousarray(node[name].values).tobytes())
            told.update(repr(sorted(node.attrs.items())).encode())
    else:
        told.update(repr(found).encode())
    return told.hexdigest()


# --- loads that all bearings get ---------------------------------------------------------------


def _with_blade(hub):
    """A series with the loads of blade 1 at its root, which is pitched."""
    turn = np.linspace(0.0, 12.0, hub.sizes["time"])
    still = np.zeros_like(turn)
    force = np.stack([6e5 - 1.7e5 * np.cos(turn), 1.5e5 + still, -1.7e5 * np.sin(turn)])
    moment = np.stack([still, 1.2e6 + 3.5e6 * np.sin(turn), 5e6 + 4e5 * np.cos(turn)])
    vectors = {"root_force": force, "root_moment": moment}
    found = {name: (("axis", "time"), values) for name, values in vectors.items()}
    return hub.assign(found | {"pitch": ("time", 0.0009 * np.sin(2 * turn) + 0.02 * np.sin(turn))})


HUB = case(8.0, 1, steps=120)
HUB["speed"][:20] = np.linspace(0.0, 0.012, 20)  # the surfaces touch at first
HUB = _with_blade(HUB)


class _Case(SimpleNamespace):
    """A load case, as it stands in lists and mappings."""

    dlc, name = "1.1", "dlc1.1_v8_s1"
    wind_speed, seed, weight, duration = 8.0, 1, 1.0, 600.0
    __hash__ = object.__hash__


ONE, START = _Case(), _Case(dlc="3.1", name="dlc3.1_v8_s1")


def inputs(scene):
    """What the stages before bearings give, once for scenes that do not differ in it."""
    if scene.shaft.coupled or scene.reduction.method == "periodic":  # these ask the bearings
        return _made(scene)
    key = scene.model_dump_json(include=READ)
    if key not in _INPUTS:
        _INPUTS[key] = _made(scene)
    return _INPUTS[key]


_INPUTS = {}
READ = {
    "shaft": True, "reduction": True, "turbine": True,
    "rolling": {"bearing": True, "further": True},
}  # fmt: skip
"""What the stages before bearings read of a scene."""


def _made(scene):
    series = {"loads": HUB, "shaft": shaft.bearing_loads(scene, None, {"loads": HUB})}
    return series | {"reduction": reduction.reduced_loads(scene, ONE, series)}


# --- readers -----------------------------------------------------------------------------------


def _loads(scene):
    cases = list_cases(scene)
    yield [(one.name, one.weight) for one in cases]
    yield loads.hub_loads(scene, cases[0], {})


def _shaft(scene):
    yield shaft.bearing_loads(scene, None, {"loads": HUB})


def _judged(scene, stage, tree):
    table = stage.summary({ONE: tree})
    yield table
    name = stage.__name__.rpartition(".")[2]
    lifetime = run_lifetime(scene, {name: table})
    yield [one.sentence for one in verdicts(scene, {name: table}, lifetime)]


_SOLVED = {}


def solved(solve, scene, ignored):
    """Films of a scene, once for scenes that differ in what changes verdicts and wear alone."""
    key = solve, scene.model_dump_json(exclude=ignored)
    if key not in _SOLVED:
        _SOLVED[key] = solve(scene, ONE, inputs(scene))
    return _SOLVED[key]


def films(scene):
    """Films of journal bearings; their limits, wear and how often a year starts do not count."""
    solve = journal.orbit if scene.journal.in_motion else journal.film
    return solved(solve, scene, {"journal": {"limits"}, "wear": True, "lifetime": True})


def _journal(scene):
    if any(scene.journal.at(name).seat is not None for name in scene.journal.bearings):
        yield make_plan(scene).errors["journal.film"]
    tree = films(scene)
    yield tree
    yield from _judged(scene, journal, tree)


def _rolling(scene):
    if scene.results == ["rolling.dynamics"]:
        yield from _dynamics(scene)
        return
    if any(part.catalogue is not None for part in scene.rolling.bearings.values()):
        yield friction.losses(scene, ONE, inputs(scene))
    # with the effect of the rings on, too, as the run's own check has it
    for one in filter(None, (scene, finer(scene, "elastic rings"))):
        found = rolling.load_distribution(one, ONE, inputs(one))
        yield found
        yield from _judged(one, rolling, found)


def _thrust(scene):
    if any(one.seat is not None for one in scene.thrust.collars.values()):
        yield make_plan(scene).errors["thrust.film"]
    tree = solved(thrust.films, scene, {"thrust": {"bearings": {"__all__": {"limits"}}}})
    yield tree
    yield from _judged(scene, thrust, tree)


def _friction(scene):
    if scene.results == ["rolling.dynamics"]:
        yield from _dynamics(scene)
        return
    yield friction.losses(scene, ONE, inputs(scene))
    yield rolling.load_distribution(scene, ONE, inputs(scene))


def _dynamics(scene):
    tree = dynamics.dynamics(scene, ONE, inputs(scene))
    yield tree
    yield dynamics.summary({ONE: tree})


def _wear(scene):
    yield wear.wear(scene, [START], {START.name: inputs(scene) | {"journal": films(scene)}})


def _environment(scene):
    yield from _loads(scene)
    if scene.wants("journal"):
        yield from _journal(scene)
    if "rolling.life" in scene.results:
        yield from _rolling(scene)


def _reduction(scene):
    if scene.journal.in_motion:
        yield from _journal(scene)
    elif scene.loads.source == "files":  # classes of a cube hold its own cases
        first = list_cases(scene)[0]
        hub = loads.hub_loads(scene, first, {})
        series = {"loads": hub, "shaft": shaft.bearing_loads(scene, first, {"loads": hub})}
        yield reduction.reduced_loads(scene, first, series)
    else:
        yield inputs(scene)["reduction"]


def _seeds(scene):
    cases = list_cases(scene)
    series = {}
    for one in cases:
        hub = loads.hub_loads(scene, one, {})
        series[one.name] = {
            "loads": hub, "shaft": shaft.bearing_loads(scene, one, {"loads": hub}),
        }  # fmt: skip
    found = [seeds.groups_in(scene, piece, series) for piece in seeds.pieces(scene, cases)]
    yield seeds.joined(scene, found)


class _Formula:
    """A design whose numbers are plain functions of its keys, in place of films."""

    def __init__(self, space):
        self.space = space

    def outcomes(self, work, batches):
        for number, points in batches:
            yield (number, points), [self.judged(point) for point in points]

    def judged(self, point):
        width, oil = point
        numbers = {"energy": width * (1 + oil), "load_factor": width + oil, "condition": 2.0}
        return DesignPoint(dict.fromkeys(NUMBERS, 1.0) | numbers, "", "", "")


def _spectrum(scene, candidate, classes):
    hub, found = HUB.assign_coords(weight=1.0), shaft.bearing_loads(scene, None, {"loads": HUB})
    return load_spectrum(scene, [("case", hub, found)], candidate.places, classes)


def _design(scene):
    asked = scene.design
    name, candidate = chosen_candidate(scene)
    yield name
    spectrum = _spectrum(scene, candidate, asked.classes)
    yield spectrum
    if asked.crown is not None:
        groups = {place: spectrum[place].to_dataset() for place in candidate.places}
        yield [one.as_dict() for one in crowns_of(candidate.journal, groups, asked.crown)]
        return
    space = space_of(scene, candidate, asked)
    formula = _Formula(space)
    search = Search(formula, asked, Path(), formula, Means(formula, False, None))
    search.sweep()
    yield np.array(search.points)
    yield search.levels(), np.array(search.points)
    yield search.best(asked.margin)
    found = search.maps(search.points[0])
    yield [(one.keys, one.across, one.up) for one in found]


def _candidates(scene):
    for name, one in candidates_for(scene)[0].items():
        plan = make_plan(candidate_scene(scene, name, one, HUB.sizes["time"]))
        yield [step.digest for step in plan.steps]
        yield one.model_dump_json(include={"tolerances"})


def _as_built(scene):
    candidate = candidates_for(scene)[0]["own-journal"]
    built = Built(candidate, scene.friction, _spectrum(scene, candidate, 2))
    for one in tolerances_of(built, scene.as_built):
        yield one.name, [end.candidate.model_dump_json() for end in one.ends]
        for end in one.ends:
            yield end.spectrum


FOUND = {
    "design": _design, "candidates": _candidates, "as_built": _as_built, "tolerances": _as_built,
    "loads": _loads, "turbine": _loads, "shaft": _shaft, "seeds": _seeds, "reduction": _reduction,
    "journal": _journal, "rolling": _rolling, "friction": _friction, "dynamics": _dynamics,
    "wear": _wear, "lifetime": _wear, "thrust": _thrust, "environment": _environment,
}  # fmt: skip
