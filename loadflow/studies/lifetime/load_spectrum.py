"""Series of all load cases → few loads of each bearing, with weights, that stand for a lifetime.

A design is judged on hundreds of variants; the series of a run has too many samples for that. Each
class of speed and load is one sample of the series, that nearest to the middle of the class, with
the share of the lifetime of all; the hardest samples are kept besides, with no weight.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.reduction.quasistatic import class_edges
from loadflow.scene.scene import Scene
from loadflow.stages.frames import to_film
from loadflow.stages.reduction import moment_governs
from loadflow.studies.lifetime.finished_run import case_shares, energy_per_year
from loadflow.wind.cases import factor_of_maximum, row_of, stands_or_starts

Floats = NDArray[np.float64]

HARDEST = 6
"""Samples that are kept for each way in which a load can be hard."""

STANDING_SHARE = 0.05
"""Speed, over the fastest, below which a shaft counts as standing."""

VARIABLES = {
    "speed": ("rad/s", "rotor speed"),
    "weight": ("1", "share of the lifetime"),
    "load_factor": ("1", "partial safety factor for loads of the load case"),
    "running": ("1", "whether of a load case in which the shaft neither stands nor starts"),
    "ultimate": ("1", "whether of a load case of ultimate loads"),
    "time": ("s", "time in the load case"),
    "force": ("N", "force on the bearing"),
    "moment": ("N m", "moment on the bearing"),
    "tilt": ("rad", "tilt of the shaft in the bearing"),
    "curvature": ("1/m", "bend of the shaft in the bearing"),
    "hub_force": ("N", "force of the rotor on the shaft at the hub centre"),
    "hub_moment": ("N m", "moment of the rotor on the shaft about the hub centre"),
}
"""What is known of each sample: units and meaning."""
_OF_BEARING = ("force", "moment", "tilt", "curvature")
_OF_HUB = ("hub_force", "hub_moment")
_VECTORS = _OF_BEARING + _OF_HUB


def load_spectrum(
    scene: Scene,
    cases: Iterable[tuple[str, xr.Dataset, xr.Dataset]],
    places: Sequence[str],
    classes: int = 5,
) -> xr.DataTree:
    """Representative loads of bearings over all load cases.

    Parameters
    ----------
    scene : Scene
        For the shares of the lifetime.
    cases : iterable of tuple
        Name, loads and shaft of each load case, as stages give them.
    places : sequence of str
        Bearings.
    classes : int
        Classes of speed, and half of those of the load.

    Returns
    -------
    xarray.DataTree
        A group for each place: `force`, `moment` (sample, axis), N, N m, and `tilt`, `curvature` of
        an elastic shaft, and `hub_force`, `hub_moment` meanwhile, in the frame of the cube;
        `speed`, rad/s, `weight`, whose sum is 1 or the
        share of the time in which the shaft turns, `time`, `load_factor`, `running`, `ultimate`
        and, by load case, `load_per_speed` (case), the mean radial load over speed, N s/rad. The
        attribute `seconds` of the tree is the time in a year that all weights stand for.
    """
    rows = list(cases)
    table = _table(rows)
    share = case_shares(scene, table)
    share = np.full(len(rows), 1 / len(rows)) if share is None else share
    ones = xr.DataArray(np.ones((len(rows), 1)), dims=("case", "bearing"))
    seconds = float(energy_per_year(scene, table, ones, share)[0])
    groups = {
        place: _of_place(scene, place, rows, share / max(share.sum(), 1e-300), classes)
        for place in places
    }
    tree = xr.DataTree.from_dict(groups)
    tree.attrs["seconds"] = seconds
    return tree


def _table(rows: Sequence[tuple[str, xr.Dataset, xr.Dataset]]) -> xr.Dataset:
    columns = {
        name: ("case", [loads[name].item() for _, loads, _ in rows])
        for name in ("dlc", "wind_speed", "weight")
    }
    lengths = [float(loads["time"][-1] - loads["time"][0]) for _, loads, _ in rows]
    columns["length"] = ("case", lengths)
    return xr.Dataset(coords={"case": [name for name, *_ in rows], **columns})


def _of_place(
    scene: Scene,
    place: str,
    rows: Sequence[tuple[str, xr.Dataset, xr.Dataset]],
    share: Floats,
    classes: int,
) -> xr.Dataset:
    """Samples of one bearing."""
    parts = [
        _series(loads, shaft.sel(bearing=place), w) for (_, loads, shaft), w in zip(rows, share)
    ]
    whole = {
        name: np.concatenate([part[name] for part in parts])
        for name in set.intersection(*map(set, parts))
    }
    number = np.concatenate([np.full(part["speed"].size, k) for k, part in enumerate(parts)])
    turning = np.abs(whole["speed"]) > STANDING_SHARE * np.abs(whole["speed"]).max(initial=0.0)
    by_moment = moment_governs(scene, place, whole["moment"])
    load = np.hypot(*to_film(whole["moment" if by_moment else "force"]).T)
    index, weight = _classed(np.abs(whole["speed"]), load, whole["weight"], turning, classes)
    hard = np.setdiff1d(_hardest(whole, turning), index)
    picked = np.concatenate([index, hard])
    samples: dict[str, Any] = {
        name: (
            ("sample", "axis") if name in _VECTORS else ("sample",),
            values[picked],
            _about(name),
        )
        for name, values in whole.items()
        if name != "weight"
    }
    samples["weight"] = "sample", np.concatenate([weight, np.zeros(hard.size)]), _about("weight")
    samples["load_per_speed"] = (
        "case",
        _load_per_speed(whole, turning & whole["running"], number, len(rows)),
        {"units": "N s/rad", "long_name": "mean radial load over speed; NaN where none turns"},
    )
    names = np.array([name for name, *_ in rows])
    return xr.Dataset(
        samples,
        {"axis": ["x", "y", "z"], "case": names, "of_case": ("sample", names[number[picked]])},
    )


def _about(name: str) -> dict[str, str]:
    units, meaning = VARIABLES[name]
    return {"units": units, "long_name": meaning}


def _series(loads: xr.Dataset, shaft: xr.Dataset, share: float) -> dict[str, Any]:
    """All samples of one load case."""
    speed = loads["speed"].values.astype(float)
    dlc = str(loads["dlc"].item())
    row = row_of(dlc)
    alike: Mapping[str, Any] = {
        "weight": share / speed.size,
        "load_factor": factor_of_maximum(dlc),
        "running": not stands_or_starts(dlc),
        "ultimate": row is None or row.kind == "U",
    }
    found = {name: np.full(speed.size, value) for name, value in alike.items()}
    found |= {"speed": speed, "time": loads["time"].values.astype(float)}
    for names, given in ((_OF_BEARING, shaft), (_OF_HUB, loads)):
        for name in names:
            if name in given and bool(given[name].notnull().all()):
                found[name] = given[name].transpose("time", "axis").values.astype(float)
    return found


def _classed(
    speed: Floats, load: Floats, weight: Floats, turning: NDArray[np.bool_], classes: int
) -> tuple[NDArray[np.int64], Floats]:
    """One sample for each class of speed and load, and the weight of the class."""
    some = np.flatnonzero(turning & (weight > 0))
    if some.size == 0:
        return np.array([], dtype=np.int64), np.array([])
    edges = class_edges(speed[some], classes), class_edges(load[some], 2 * classes)
    places = [np.digitize(x[some], e[1:-1]) for x, e in zip((speed, load), edges)]
    label = places[0] * (2 * classes) + places[1]
    index, weights = [], []
    for one in np.unique(label):
        members = some[label == one]
        own = weight[members]
        distance = sum(
            ((x[members] - np.average(x[members], weights=own)) / max(np.ptp(x[some]), 1e-300)) ** 2
            for x in (speed, load)
        )
        index.append(int(members[np.argmin(distance)]))
        weights.append(float(own.sum()))
    return np.array(index, dtype=np.int64), np.array(weights)


def _hardest(whole: Mapping[str, Any], turning: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Samples of the largest loads, with and without their factor, and of the thinnest films."""
    radial = np.hypot(*to_film(whole["force"]).T)
    moment = np.hypot(*to_film(whole["moment"]).T)
    factor = whole["load_factor"]
    running = turning & whole["running"]
    per_speed = np.where(running, radial / np.maximum(np.abs(whole["speed"]), 1e-300), -1.0)
    ways = (
        per_speed,
        np.where(turning, radial, -1.0),
        factor * radial,
        factor * moment,
        factor * np.abs(whole["force"][:, 0]),
    )
    found = [np.argsort(way)[::-1][:HARDEST] for way in ways if way.max() > 0]
    return np.unique(np.concatenate(found)) if found else np.array([], dtype=np.int64)


def _load_per_speed(
    whole: Mapping[str, Any], used: NDArray[np.bool_], number: NDArray[np.int64], count: int
) -> Floats:
    radial = np.hypot(*to_film(whole["force"]).T)
    found = np.full(count, np.nan)
    for k in range(count):
        own = used & (number == k)
        if own.any():
            found[k] = np.mean(radial[own] / np.abs(whole["speed"][own]))
    return found
