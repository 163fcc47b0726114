"""Friction and films of the rolling bearings of a candidate, and what catalogues say of them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.rolling.friction import torques_beside
from loadflow.scene.scene import Scene
from loadflow.stages.films.turning import runs_throughout
from loadflow.stages.friction import CATALOGUES, least_film_parameter
from loadflow.stages.rolling_at_work import friction_options
from loadflow.studies.candidate.margins import looked_at, solved

_SLOW = 0.1  # share of the samples that counts as low speed
_Means = dict[tuple[str, str], float]  # by load case and bearing

OWN_TORQUE = "friction_torque"
TORQUES = {"": OWN_TORQUE} | {key: name for key, (name, _) in CATALOGUES.items()}
"""Quantity of a comparison by catalogue; the first is our own."""


@dataclass(frozen=True)
class Losses:
    """Losses and films of rolling bearings in ideal rolling, without slip of rollers.

    Attributes
    ----------
    power : xarray.DataArray
        Mean friction power (case, bearing), W.
    torques : dict of xarray.DataArray
        Mean friction torque (case, bearing), N m, 0 at rest, by quantity: ours, and
        after those catalogues that know every bearing.
    film_parameter : float
        Median of the least Λ of loaded contacts at low speed, of the bearing with the thinnest.
    place, case : str
        That bearing, and the load case of the thinnest film in it.
    time, speed : float
        Its time, s, and the speed below which a speed is low, rad/s.
    by_case : dict
        Λ at low speed of that bearing in each load case that has one.
    """

    power: xr.DataArray
    torques: dict[str, xr.DataArray]
    film_parameter: float
    place: str
    case: str
    time: float
    speed: float
    by_case: dict[str, list[float]]


def rolling_losses(scene: Scene, folder: Path, table: xr.Dataset) -> Losses | None:
    """Friction and films of the rolling bearings in some samples of all cases.

    Each is as warm as in the `table` of its run. Films are those of load cases in which the shaft
    runs throughout: one that starts or stops has none at first. None where there is no model of
    friction for one of the bearings.
    """
    judged = {*table["case"].values[runs_throughout(table)].tolist()}
    power: _Means = {}
    torques: dict[str, _Means] = {}
    films: dict[str, list[tuple[float, float, str, float]]] = {}
    for place, part in scene.rolling.bearings.items():
        stated = friction_options(scene.friction, part.geometry)
        for case, some in looked_at(folder, place, table):
            warm = float(table["bearing_temperature"].sel(case=case, bearing=place))
            options = replace(stated, temperature=warm)
            speed = some["speed"].values.astype(float)
            answer = solved(scene, place, some)
            try:
                lost = answer.friction(speed, options)
            except SolverError:
                return None
            weight = some["weight"].values.astype(float)
            power[case, place] = float(np.average(lost.power, weights=weight))
            beside = torques_beside(answer, speed, options, part.catalogue)
            for name, torque in {"": lost.torque, **beside}.items():
                while_turning = torque * (speed != 0)  # as ours, which vanishes at rest
                mean = float(np.average(while_turning, weights=weight))
                torques.setdefault(TORQUES[name], {})[case, place] = mean
            least = least_film_parameter(lost.film_parameter, answer.element_forces)
            times = some["time"].values.astype(float)
            films.setdefault(place, []).extend(
                (abs(float(v)), float(film), case, float(t))
                for v, film, t in zip(speed, least, times)
                if v != 0 and math.isfinite(film) and case in judged
            )
    cases = list(dict.fromkeys(case for case, _ in power))
    places = list(scene.rolling.geometries)
    means = _table(power, cases, places)
    of_all = {
        name: _table(found, cases, places)
        for name, found in torques.items()
        if len(found) == len(power)
    }
    speeds = np.array([row[0] for rows in films.values() for row in rows])
    if speeds.size == 0:
        return Losses(means, of_all, math.nan, "", "", math.nan, math.nan, {})
    slow = float(np.quantile(speeds, _SLOW))
    thin = {place: [row for row in rows if row[0] <= slow] for place, rows in films.items()}
    medians = {
        place: float(np.median([row[1] for row in rows])) for place, rows in thin.items() if rows
    }
    place = min(medians, key=lambda name: medians[name])
    _, _, case, time = min(thin[place], key=lambda row: row[1])
    by_case: dict[str, list[float]] = {}
    for _, film, name, _ in thin[place]:
        by_case.setdefault(name, []).append(film)
    return Losses(means, of_all, medians[place], place, case, time, slow, by_case)


def error_together(lost: Mapping[str, float], errors: Mapping[str, float]) -> float:
    """Error by models of all losses, each result's with what it loses; NaN: not measured.

    Parameters
    ----------
    lost, errors : mapping of str to float
        By result: losses, W, and their error as a share.
    """
    some = {name: loss for name, loss in lost.items() if loss > 0} or dict.fromkeys(lost, 1.0)
    return sum(loss * errors[name] for name, loss in some.items()) / sum(some.values())


def _table(means: _Means, cases: Sequence[str], places: Sequence[str]) -> xr.DataArray:
    """Means over load cases and bearings."""
    values = [[means[case, place] for place in places] for case in cases]
    return xr.DataArray(values, {"case": cases, "bearing": places}, ("case", "bearing"))
