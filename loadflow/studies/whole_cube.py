"""One histogram over all cases of a load cube: classes that all of them share, and their sums."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr

from loadflow.reduction import class_edges, number_of_classes
from loadflow.studies.bearing_series import BearingSeries

Floats = np.ndarray
Edges = tuple[Floats, Floats]


def common_edges(
    every: Iterable[BearingSeries], classes: int | tuple[int, int] | None = None
) -> dict[str, Edges]:
    """Class edges of speed (rad/s) and radial force (N) that hold all cases, by bearing.

    Parameters
    ----------
    every : iterable of BearingSeries
        One after another; none is kept.
    classes : int or (int, int), optional
        Of speed and of force; by default (4.30) for the length of all series together.

    Raises
    ------
    loadflow.errors.InputError
        Less than one class.
    """
    ends: dict[str, Floats] = {}
    lengths: dict[str, int] = {}
    for one in every:
        pair = np.stack([one.speed, np.hypot(*one.radial.T)])
        known = [ends[one.bearing]] if one.bearing in ends else []
        found = np.concatenate([pair, *known], axis=1)
        ends[one.bearing] = np.stack([found.min(axis=1), found.max(axis=1)], axis=1)
        lengths[one.bearing] = lengths.get(one.bearing, 0) + one.speed.size
    edges = {}
    for bearing, (speed, force) in ends.items():
        number = number_of_classes(lengths[bearing]) if classes is None else classes
        along, across = (number, number) if isinstance(number, int) else number
        edges[bearing] = class_edges(speed, int(along)), class_edges(force, int(across))
    return edges


def whole_histograms(parts: Iterable[tuple[str, xr.Dataset]]) -> dict[str, xr.Dataset]:
    """Histograms before and after of all cases together, by bearing.

    Parameters
    ----------
    parts : iterable of (str, xarray.Dataset)
        Bearing and reduced series, all with the edges of `common_edges`.
    """
    whole: dict[str, xr.Dataset] = {}
    names = ["counts_full", "counts_reduced", "speed_edges", "load_edges"]
    for bearing, series in parts:
        if bearing not in whole:
            source = f"all cases, bearing {bearing}"
            whole[bearing] = series[names].copy(deep=True).assign_attrs(source=source)
            continue
        for name in names[:2]:
            whole[bearing][name].values += series[name].values
    return whole
