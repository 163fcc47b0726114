"""Which samples of a series are kept for a bearing: classes of the case, or of all load cases."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np
import xarray as xr

from loadflow.errors import InputError
from loadflow.reduction import Reduced, class_edges, histogram, number_of_classes
from loadflow.scene.cases import Case, list_cases
from loadflow.scene.scene import Scene
from loadflow.stages.loads import hub_loads
from loadflow.stages.shaft import bearing_loads

Floats = np.ndarray
Edges = tuple[Floats, Floats]

LoadsOf = Callable[[xr.Dataset], Mapping[str, Floats]]
"""Bearing loads of a case → by bearing, the load that is reduced, (n, 2)."""


def kept_samples(
    scene: Scene,
    speed: Floats,
    load: Floats,
    time: Floats,
    edges: Edges | None,
    source: str,
) -> Reduced:
    """Reduce a series by its histogram as the scene says; `index` counts in the whole series.

    Parameters
    ----------
    speed : ndarray, shape (n,)
        rad/s.
    load : ndarray, shape (n, 2)
        Force, N, or moment, N m.
    time : ndarray, shape (n,)
        s.
    edges : (ndarray, ndarray), optional
        Of `edges_of_cube`; by default the classes are those of the series.
    source : str
        What the series is.

    Raises
    ------
    loadflow.errors.InputError
        The times that the scene wants hold fewer than two samples.
    """
    options = scene.reduction
    places = stretch(time, options.between, source)
    found = histogram(
        speed[places],
        load[places],
        time[places],
        size=options.size,
        classes=options.classes if edges is None else edges,
        pick=options.pick,
        seed=options.seed,
        source=source,
    )
    return replace(found, index=found.index + places.start)


def stretch(time: Floats, between: tuple[float, float] | None, source: str) -> slice:
    """Places of the samples from the first of two times on and before the second, s.

    Raises
    ------
    loadflow.errors.InputError
        Fewer than two samples.
    """
    if between is None:
        return slice(0, time.size)
    first, last = np.searchsorted(time, between, side="left")
    if not between[0] < between[1] or last - first < 2:
        raise InputError(
            f"{source}: between = {between[0]:g}, {between[1]:g} s: fewer than two samples; the "
            f"series runs from {time[0]:g} to {time[-1]:g} s"
        )
    return slice(int(first), int(last))


def edges_of_all(
    every: Iterable[tuple[str, Floats, Floats]], classes: int | tuple[int, int] | None = None
) -> dict[str, Edges]:
    """Class edges of speed (rad/s) and load that hold all series, by bearing.

    Parameters
    ----------
    every : iterable of (str, ndarray, ndarray)
        Bearing, speed (n,) and load (n,) of one series after another; none is kept.
    classes : int or (int, int), optional
        Of speed and of load; by default (4.30) for the length of all series together.

    Raises
    ------
    loadflow.errors.InputError
        Less than one class.
    """
    ends: dict[str, Floats] = {}
    lengths: dict[str, int] = {}
    for bearing, speed, load in every:
        known = [ends[bearing]] if bearing in ends else []
        found = np.concatenate([np.stack([speed, load]), *known], axis=1)
        ends[bearing] = np.stack([found.min(axis=1), found.max(axis=1)], axis=1)
        lengths[bearing] = lengths.get(bearing, 0) + speed.size
    edges = {}
    for bearing, (speed, load) in ends.items():
        number = number_of_classes(lengths[bearing]) if classes is None else classes
        along, across = (number, number) if isinstance(number, int) else number
        edges[bearing] = class_edges(speed, int(along)), class_edges(load, int(across))
    return edges


_KNOWN: dict[str, dict[str, Edges]] = {}


def edges_of_cube(scene: Scene, stage: str, loads_of: LoadsOf) -> dict[str, Edges]:
    """Edges of classes that all load cases of a scene share, by bearing; empty if it has none.

    The load cases are read, and taken through the shaft, once in each process: a stage is given the
    loads of its own case only. `stage` names who asks: each reduces loads of its own.
    """
    if scene.reduction.grid != "cube":
        return {}
    cases = list_cases(scene)
    marks = [f"{case.name}:{case.fingerprint}" for case in cases]
    key = "\n".join([stage, scene.model_dump_json(), *marks])
    if key not in _KNOWN:
        if len(_KNOWN) > 1:  # of a run, there are the classes of two stages
            _KNOWN.clear()
        _KNOWN[key] = edges_of_all(_all_cases(scene, cases, loads_of), scene.reduction.classes)
    return _KNOWN[key]


def _all_cases(
    scene: Scene, cases: Iterable[Case], loads_of: LoadsOf
) -> Iterator[tuple[str, Floats, Floats]]:
    for case in cases:
        loads = hub_loads(scene, case, {})
        shaft = bearing_loads(scene, case, {"loads": loads})
        speed = loads["speed"].values.astype(float)
        for bearing, load in loads_of(shaft).items():
            yield bearing, speed, np.hypot(*load.T)
