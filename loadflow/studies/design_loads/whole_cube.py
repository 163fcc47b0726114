"""One histogram over all cases of a load cube: classes that all of them share, and their sums."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr

from loadflow.stages.kept_samples import Edges, edges_of_all
from loadflow.studies.bearing_series import BearingSeries


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
    series = ((one.bearing, one.speed, np.hypot(*one.radial.T)) for one in every)
    return edges_of_all(series, classes)


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
