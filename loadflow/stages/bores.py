"""Bores of journal bearings that are turned against a shaft that does not bend.

Machines are assembled with bores that follow the shaft as it lies at its usual load,
``alignment = "mean"``. The usual load of a simulated machine is that of operation from cut-in to
cut-out, steady but for moments that scatter with the turbulence, each wind speed with its share of
the lifetime; of given series, it is that of samples of those that turn, each with the weight of its
load case. So it depends on machine and loads alone: every load case has the same bores, in whatever
process it is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.errors import InputError, SolverError
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.scene.shaft_place import floating
from loadflow.shaft import Concept
from loadflow.shaft import bearing_loads as reactions
from loadflow.stages.effects.situation import SWING
from loadflow.stages.films.of_bearing import equilibria
from loadflow.stages.films.turning import SLOWEST
from loadflow.stages.frames import from_film, slope_of
from loadflow.stages.labelling import label

Floats = NDArray[np.float64]

ALIGNED = ("alignment_down", "alignment_left")
"""What a run tells of the bores that follow the shaft."""

STEP = 2.0
"""Distance of the wind speeds of steady operation, m/s."""

SAMPLES = 200
"""Samples that are taken of a given series."""


class UsualLoads(NamedTuple):
    """Loads of the hub, (3, n), N and N m, speed (n,), rad/s, and weight (n,) of each."""

    force: Floats
    moment: Floats
    speed: Floats
    weight: Floats


def bores(scene: Scene) -> dict[str, Floats]:
    """Turn of the bore of each journal bearing, (3,), rad, in the frame of the cube.

    Raises
    ------
    loadflow.errors.InputError
        No given series turns, of which a mean is asked.
    loadflow.errors.SolverError
        No steady operation, of which a mean is asked; no film that carries it.
    """
    stated = {name: scene.journal.at(name).alignment for name in scene.journal.bearings}
    found = {name: from_film(turn) for name, turn in stated.items() if turn != "mean"}
    if len(found) < len(stated):
        found |= {name: turn for name, turn in _mean(scene).items() if stated[name] == "mean"}
    return {name: found.get(name, np.zeros(3)) for name in stated}


def turned_bores(scene: Scene) -> list[str]:
    """Journal bearings whose bores are turned, as stated or as they follow the shaft."""
    journal = scene.journal
    return [name for name in journal.tilting if journal.at(name).alignment != (0.0, 0.0)]


def with_bores(scene: Scene, shaft: xr.Dataset) -> xr.Dataset:
    """Loads of bearings, and `alignment` (bearing, axis) of those whose bores are turned."""
    places = turned_bores(scene)
    if not places or "tilt" not in shaft:
        return shaft
    turned, none = bores(scene), np.zeros(3)
    rows = [turned[name] if name in places else none for name in shaft["bearing"].values]
    meaning = label("rad", "turn of the bore against a shaft that does not bend")
    return shaft.assign(alignment=(("bearing", "axis"), np.array(rows), meaning))


def against_bore(bearing: xr.Dataset) -> xr.Dataset:
    """Samples of a bearing with the `tilt` of the shaft less the `alignment` of its bore."""
    if "tilt" not in bearing or "alignment" not in bearing:
        return bearing
    tilt = (bearing["tilt"] - bearing["alignment"]).assign_attrs(bearing["tilt"].attrs)
    return bearing.assign(tilt=tilt.transpose(*bearing["tilt"].dims))


def in_bore(bearing: xr.Dataset, options: Journal) -> xr.Dataset:
    """Samples of a bearing with their `weight`, and the `alignment` of the bore of `options`.

    One that follows the shaft has the mean of their own `tilt`: that of a spectrum, which tells the
    loads of all load cases.
    """
    if "tilt" not in bearing:
        return bearing
    if options.alignment == "mean":
        turn = bearing["tilt"].weighted(bearing["weight"]).mean("sample")
    else:
        turn = xr.DataArray(from_film(options.alignment), dims="axis")
    return bearing.assign(alignment=turn.assign_attrs(bearing["tilt"].attrs))


def told_bores(tables: Mapping[str, Any]) -> list[str]:
    """Say how bores are turned, by the tables of a run, by stage."""
    if "shaft" not in tables or ALIGNED[0] not in tables["shaft"]:
        return []
    shaft = tables["shaft"]
    down, left = (shaft[name].isel(case=0).values for name in ALIGNED)
    told = [
        f"{name} by {1e3 * one:.2g} mrad about down and {1e3 * other:.2g} mrad about left"
        for name, one, other in zip(shaft["bearing"].values, down, left)
        if one or other
    ]
    return [f"bores turned against a shaft that does not bend: {', '.join(told)}"] if told else []


_KNOWN: dict[str, dict[str, Floats]] = {}
"""Mean tilt by digest of what it depends on: load cases of a process share it."""


def _mean(scene: Scene) -> dict[str, Floats]:
    """Mean tilt of the shaft in each journal bearing on a beam, (3,), rad."""
    sections = ("turbine", "loads", "environment", "shaft", "journal")
    key = ":".join([scene.digest(*sections), *_contents(scene)])
    if key not in _KNOWN:
        _KNOWN[key] = _mean_tilt(scene, usual_loads(scene))
    return _KNOWN[key]


def _contents(scene: Scene) -> list[str]:
    """What the files of load series hold, of which a scene tells the names."""
    if scene.loads.source != "files":
        return []
    from loadflow.scene.cases import list_cases

    return [case.fingerprint for case in list_cases(scene)]


def _mean_tilt(scene: Scene, usual: UsualLoads) -> dict[str, Floats]:
    from loadflow.turbines import load_turbine

    gravity = load_turbine(scene.turbine.name).rotor.tilt
    found: dict[str, Floats] = {}
    lies = {kind: films for kind, _, films in floating(scene.shaft, scene.journal)}
    for kind, concept in scene.shaft.suspensions.items():
        if concept.beam is None:
            continue
        rigid = replace(concept, beam=concept.beam.free_in_films().on_rigid_bearings())
        loads = reactions(rigid, usual.force, usual.moment, tilt=gravity)
        turned = (loads["tilt"] - loads["bore_tilt"]).transpose("bearing", "time", "axis")
        slope = np.zeros((usual.speed.size, 3))
        if kind in lies and all(name in scene.shaft.coupled for name in lies[kind]):
            slope = slope_in_clearances(scene, concept, lies[kind], loads, usual.speed)
        lying = np.isfinite(slope).all(axis=1)
        if not lying.any():
            raise SolverError(
                f'journal.alignment = "mean": no film of {", ".join(lies[kind])} carries the shaft '
                "at its usual load; give the turn of the bores in rad"
            )
        for name, bent in zip(concept.bearings, turned.values):
            if name in scene.journal.bearings:
                found[name] = np.average((bent + slope)[lying], axis=0, weights=usual.weight[lying])
    return found


def slope_in_clearances(
    scene: Scene, concept: Concept, films: list[str], loads: xr.Dataset, speed: Floats
) -> Floats:
    """Slope of a shaft, (n, 3), rad, by the places of its outermost films at rest."""
    places = {}
    for name in (films[0], films[-1]):
        own = scene.journal.at(name).model_copy(update={"tilt": False})
        force = loads["force"].sel(bearing=name).transpose("time", "axis").values.astype(float)
        places[name] = from_film(equilibria(own, force, speed).eccentricity)
    return slope_between(concept, places)


def slope_between(concept: Concept, places: Mapping[str, Floats]) -> Floats:
    """Slope of a shaft, (..., 3), rad, from the first to the last of its `places` (..., 3), m."""
    where = dict(zip(concept.bearings, concept.positions))
    first, *_, last = places
    return slope_of((places[last] - places[first]) / (where[last] - where[first]))


def usual_loads(scene: Scene) -> UsualLoads:
    """Return the loads of the hub that bores are aligned at.

    Raises
    ------
    loadflow.errors.InputError, loadflow.errors.SolverError
        As `bores`.
    """
    sections = ("turbine", "loads", "environment")
    key = ":".join([scene.digest(*sections), *_contents(scene)])
    if key not in _USUAL:
        given = scene.loads.source == "files"
        _USUAL[key] = _of_series(scene) if given else _of_operation(scene)
    return _USUAL[key]


_USUAL: dict[str, UsualLoads] = {}
"""Usual loads by digest of what they depend on: plans and runs share them."""


def _of_operation(scene: Scene) -> UsualLoads:
    """Steady operation from cut-in to cut-out, and what turbulence adds to its moments.

    Films do not lie in the mean where the mean load has them. The moments about both axes are those
    of three nodes of a normal distribution with the spread of `SWING`.
    """
    from loadflow.rotor import steady_state
    from loadflow.scene.cases import Case, speed_shares, wind_class, wind_of
    from loadflow.turbines import load_turbine

    turbine, loads = load_turbine(scene.turbine.name), scene.loads
    count = max(2, round((turbine.cut_out - turbine.cut_in) / STEP) + 1)
    winds = np.linspace(turbine.cut_in, turbine.cut_out, count)
    options = replace(loads.rotor_options, air_density=scene.environment.air_density)
    found = steady_state(
        turbine, winds.tolist(), shear=loads.shear_exponent, rung=loads.rung, options=options
    )
    shares = speed_shares(winds, wind_class(scene))
    force, moment = (
        found[name].transpose("axis", "wind_speed").values for name in ("hub_force", "hub_moment")
    )
    sigma = np.array([wind_of(scene, Case("1.1", float(wind), 1)).sigma for wind in winds])
    radius = turbine.rotor.radius
    push = scene.environment.air_density * np.pi * radius**3 * winds * sigma
    across = SWING * push * np.array([np.zeros((3, 3)), *np.meshgrid(_NODES, _NODES)])[..., None]
    count = 9 * winds.size
    moment = (moment[:, None, None] + across).reshape(3, count)
    weight = np.outer(_SHARES, _SHARES)[..., None] * [shares[wind] for wind in winds]
    return UsualLoads(
        np.tile(force, 9), moment, np.tile(found["speed"].values, 9), weight.reshape(count)
    )


_NODES = np.sqrt(3.0) * np.array([-1.0, 0.0, 1.0])  # of a normal distribution, and their shares
_SHARES = np.array([1.0, 4.0, 1.0]) / 6.0


def _of_series(scene: Scene) -> UsualLoads:
    """Samples of given series that turn, of one load case of each wind speed."""
    from loadflow.scene.cases import list_cases
    from loadflow.stages.loads import hub_loads

    force, moment, speed, weight = [], [], [], []
    cases = list_cases(scene)
    first = {case.wind_speed: case for case in reversed(cases)}
    for wind, case in sorted(first.items()):
        series = hub_loads(scene, case, {})
        mean = float(series["speed"].mean())
        if abs(mean) < SLOWEST:
            continue
        some = np.unique(np.linspace(0, series.sizes["time"] - 1, SAMPLES).astype(int))
        series = series.isel(time=some)
        force.append(series["hub_force"].transpose("axis", "time").values)
        moment.append(series["hub_moment"].transpose("axis", "time").values)
        speed.append(series["speed"].values)
        share = sum(one.weight for one in cases if one.wind_speed == wind)
        weight.append(np.full(some.size, share / some.size))
    if not speed:
        raise InputError(
            'journal.alignment = "mean": none of the load series turns; give the turn of the '
            "bores in rad, or series in operation"
        )
    columns = (np.concatenate(rows, axis=-1) for rows in (force, moment, speed, weight))
    return UsualLoads(*(np.asarray(column, dtype=float) for column in columns))
