"""Margins of thrust bearings and pairs of cones: their hardest samples under larger loads."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.scene.scene import Scene
from loadflow.scene.thrust import AnyAxial
from loadflow.stages.bores import against_bore
from loadflow.stages.thrust import follows, lies
from loadflow.studies.candidate.factor import (
    Margin,
    at_time,
    film_extremes,
    film_margin,
    grown,
    series_of,
)
from loadflow.studies.candidate.pad_films import pad_films, span_of, tabulated
from loadflow.studies.candidate.result import Number

_TOLD = 0.01  # share by which films solved again differ from those of a run before it is told


def pad_margins(scene: Scene, folder: Path, place: str, table: xr.Dataset) -> Iterator[Margin]:
    """Margins of smallest film and of largest pressure of one bearing of pads.

    The load case with the smallest film, and that with the largest pressure, are solved again as
    the run solved them: collars that it followed along the whole series, warm and tilted, with the
    tilt of the shaft growing as its loads do; others at the one sample.
    """
    bearing = scene.thrust.bearings[place]
    if (table["in_contact"] > 0).any():
        case = str(table["case"].values[int(np.argmax(table["in_contact"].values))])
        why = f"surfaces of the {bearing.kind} bearing touch in {place}"
        yield Margin(0.0, place, case, why, f"{place}: thicker oil")
        return
    moving = follows(scene, bearing) and tabulated(bearing)
    for one in film_extremes(bearing, place, table):
        samples = series_of(scene, folder, one.case, place)
        samples = samples if moving else at_time(samples, one.time)
        if not lies(scene, bearing, samples):
            samples = samples.drop_vars("tilt", errors="ignore")
        told = f"{one.what} of the {bearing.kind} bearing in {place}"
        known, why = np.zeros(1, bool), "solved again, its film carries nowhere"
        try:
            known = pad_films(bearing, against_bore(samples), moving, span_of(bearing)).carried
        except SolverError as error:
            why = str(error)
        if not known.any():
            yield Margin(math.nan, place, one.case, uncounted=f"{told} ({one.case}): {why}")
            continue
        value = cache(partial(value_of, bearing, samples, known, moving, one.quantity))
        off = value(1.0, 1.0) / one.value - 1.0
        if abs(off) > _TOLD:  # what rungs differ by does not pass for a reserve
            told += f" (solved again {100 * off:+.1f} % off that of the run)"
        whose = f"{bearing.kind} bearing in {place}"
        yield film_margin(one, value, bearing, "thrust", whose, told)


def clearance_used(film: Number, bearing: AnyAxial) -> Number:
    """Share of the clearance that the smallest film of a bearing, µm, leaves: 1 − h_min/c."""
    own = {name: 1.0 - 1e-6 * getattr(film, name) / bearing.clearance for name in _SIDES}
    left = (1.0 - own["value"]) / own["value"] if own["value"] else math.nan
    return replace(
        film, value=own["value"], low=own["high"], high=own["low"], unit="–",
        error=left * film.error,
        limit=math.nan, holds=None, note="1 − h_min/c, with the clearance c of the centred cones",
    )  # fmt: skip


_SIDES = ("value", "low", "high")


def value_of(
    bearing: AnyAxial,
    samples: xr.Dataset,
    counted: np.ndarray,
    moving: bool,
    field: str,
    load: float,
    oil: float,
) -> float:
    """Thinnest film or largest pressure with factors on load and viscosity; NaN without one."""
    thinner = bearing if oil == 1.0 else bearing.with_viscosity(oil)
    try:
        under = against_bore(grown(samples, load))
        found = pad_films(thinner, under, moving, span_of(bearing))
    except SolverError:
        return math.nan
    return found.thinnest(counted) if field == "minimum_film" else found.highest(counted)
