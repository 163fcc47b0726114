"""Bearing loads of one case → fewer samples of the same load character, for each bearing."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from loadflow.reduction import Reduced
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.stages.design_samples import Governed, periodic_samples, stationary_samples
from loadflow.stages.frames import to_film
from loadflow.stages.kept_samples import edges_of_cube, kept_samples
from loadflow.stages.labelling import label
from loadflow.stages.stage import Link, Rungs, Stage, always, load_links


def reduced_loads(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.DataTree:
    """Reduce the series to design loads, one group per bearing, as `Reduction.method` says.

    By the histogram of speed and load (4.28–4.36), to stationary (4.3.1) or to periodic loads
    (4.3.2). A bearing is reduced by what governs it, see `moment_governs`.

    Raises
    ------
    loadflow.errors.SolverError
        Periodic loads without bounds, of which the film has no closed orbit.
    """
    loads, shaft = inputs["loads"].load(), inputs["shaft"].load()
    speed = loads["speed"].values.astype(float)
    time = loads["time"].values
    shared = edges_of_cube(scene, "reduction", lambda one: governing_loads(scene, one))
    groups = {}
    for bearing in shaft["bearing"].values:
        force = _vectors(shaft["force"].sel(bearing=bearing))
        moment = _vectors(shaft["moment"].sel(bearing=bearing))
        load, by_moment = governing_load(scene, shaft, str(bearing))
        if scene.reduction.method != "histogram":
            one = shaft.sel(bearing=bearing)
            whole = Governed(time, speed, _known(one), by_moment, f"{case.name}, bearing {bearing}")
            groups[str(bearing)] = _designed(scene, str(bearing), whole)
            continue
        edges = shared.get(str(bearing))
        source = f"{case.name}, bearing {bearing}"
        reduced = kept_samples(scene, speed, load, time, edges, source)
        dataset = reduced_dataset(reduced, force, moment, by_moment)
        groups[str(bearing)] = dataset.assign(_tilted(shaft.sel(bearing=bearing), reduced))
    if "alignment" in shaft:  # of the bores
        turns = shaft["alignment"].drop_vars("bearing")
        places = shaft["bearing"].values.tolist()
        groups = {
            name: group.assign(alignment=turns.isel(bearing=places.index(name)))
            for name, group in groups.items()
        }
    return xr.DataTree.from_dict(groups)


def _designed(scene: Scene, bearing: str, loads: Governed) -> xr.Dataset:
    """Stationary or periodic loads of a bearing."""
    if scene.reduction.method == "stationary":
        return stationary_samples(loads)
    asked = bearing in scene.journal.bearings and not loads.by_moment
    return periodic_samples(loads, scene.reduction, scene.journal.at(bearing) if asked else None)


def _known(bearing: xr.Dataset) -> dict[str, tuple[np.ndarray, Any]]:
    """Vectors of a bearing that are known throughout."""
    return {
        name: (_vectors(bearing[name]), bearing[name].attrs)
        for name in ("force", "moment", "tilt", "curvature")
        if name in bearing and bool(bearing[name].notnull().all())
    }


def moment_governs(scene: Scene, bearing: str, moment: np.ndarray) -> bool:
    """Whether the tilting moment (n, 3) governs a bearing, and not the radial force.

    It does where a bearing takes one, as its rolling elements feel that most. A film gives way to
    it, and is governed by the force.
    """
    support = scene.shaft.coupled.get(bearing)
    return bool(np.any(moment[:, 1:])) and (support is None or support.stiffness != "journal")


def governing_load(scene: Scene, shaft: xr.Dataset, bearing: str) -> tuple[np.ndarray, bool]:
    """Radial force, N, or tilting moment, N m, (n, 2) of a bearing; whether it is the moment."""
    force, moment = (_vectors(shaft[name].sel(bearing=bearing)) for name in ("force", "moment"))
    by_moment = moment_governs(scene, bearing, moment)
    return to_film(moment if by_moment else force), by_moment


def governing_loads(scene: Scene, shaft: xr.Dataset) -> dict[str, np.ndarray]:
    """Radial force or tilting moment (n, 2) of each bearing, whichever governs it."""
    places = map(str, shaft["bearing"].values)
    return {place: governing_load(scene, shaft, place)[0] for place in places}


def _tilted(bearing: xr.Dataset, reduced: Reduced) -> dict[str, Any]:
    """Tilt and bend of the shaft in the bearing at the samples kept, where it is a beam."""
    return {
        name: (("sample", "axis"), _vectors(bearing[name])[reduced.index], bearing[name].attrs)
        for name in ("tilt", "curvature")
        if name in bearing and bool(bearing[name].notnull().all())
    }


def _vectors(data: xr.DataArray) -> np.ndarray:
    return data.transpose("time", "axis").values.astype(float)


def reduced_dataset(
    reduced: Reduced, force: np.ndarray, moment: np.ndarray, by_moment: bool
) -> xr.Dataset:
    """Label a reduced series; `force` and `moment` (n, 3) are those of the full one."""
    of, units = ("tilting moment", "N m") if by_moment else ("radial force", "N")
    samples, classes = ("sample",), ("speed_class", "load_class")
    index = reduced.index

    def labelled(dims: tuple[str, ...], values: np.ndarray, units: str, long_name: str) -> Any:
        return dims, values, label(units, long_name)

    return xr.Dataset(
        {
            "index": labelled(samples, index, "1", "place in the full series"),
            "time": labelled(samples, reduced.time, "s", "time"),
            "speed": labelled(samples, reduced.speed, "rad/s", "rotor speed"),
            "weight": labelled(samples, reduced.weight, "1", "samples of the full series"),
            "force": labelled((*samples, "axis"), force[index], "N", "force on the bearing"),
            "moment": labelled((*samples, "axis"), moment[index], "N m", "moment on the bearing"),
            "counts_full": labelled(classes, reduced.counts_full, "1", "before"),
            "counts_reduced": labelled(classes, reduced.counts_reduced, "1", "after"),
            "speed_edges": labelled(("speed_edge",), reduced.edges[0], "rad/s", "rotor speed"),
            "load_edges": labelled(("load_edge",), reduced.edges[1], units, of),
        },
        {"axis": ["x", "y", "z"]},
        {"pick": reduced.pick, "seed": reduced.seed, "source": reduced.source},
    )


def reduction_key(scene: Scene) -> str:
    """Name of the reduction in the ladder."""
    pick, size = scene.reduction.pick, scene.reduction.size
    if scene.reduction.method != "histogram":
        return scene.reduction.method
    between = scene.reduction.between
    times = f", {between[0]:g} to {between[1]:g} s" if between else ""
    classes = f", {scene.reduction.classes} classes" if scene.reduction.classes else ""
    classes += " of the whole cube" if scene.reduction.grid == "cube" else ""
    if size == 1.0:
        return f"full series{times}"
    return f"histogram, {pick}, {size:g}{classes}{times}"


STAGE = Stage(
    "reduction",
    run=reduced_loads,
    results={
        "reduction.histogram": lambda scene: {
            "largest load": (
                *load_links("bearing load max", of_load=False),
                Link("reduction", "largest load"),
            )
        }
    },
    needs=always("loads", "shaft"),
    sections=lambda scene: (
        ("reduction", "journal") if scene.reduction.method == "periodic" else ("reduction",)
    ),
    models=(
        Rungs(
            "reduction",
            section="reduction",
            key=reduction_key,
            better=lambda scene: (
                {"size": min(1.0, 2 * scene.reduction.size)}
                if scene.reduction.size < 1.0 and scene.reduction.method == "histogram"
                else {}
            ),
        ),
    ),
)
