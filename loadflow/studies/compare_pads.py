"""Margins of thrust bearings and pairs of cones: their hardest samples under larger loads."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.scene.thrust import AnyAxial
from loadflow.stages.frames import to_rolling
from loadflow.studies.compare_factor import (
    WIDEST,
    Margin,
    film_factors,
    loads_at,
    pressure_factor,
)
from loadflow.studies.compare_result import Number
from loadflow.studies.compare_seeds import of_extreme, power_of_load


def pad_margins(bearing: AnyAxial, folder: Path, place: str, table: xr.Dataset) -> Iterator[Margin]:
    """Margins of smallest film and of largest pressure of one bearing of pads.

    The samples with the smallest film and with the largest pressure are solved again.
    """
    if (table["in_contact"] > 0).any():
        case = str(table["case"].values[int(np.argmax(table["in_contact"].values))])
        why = f"surfaces of the {bearing.kind} bearing touch in {place}"
        yield Margin(0.0, place, case, why, f"{place}: thicker oil")
        return
    pressure = bearing.limits.pressure_at(bearing.limits.material[0][0])
    asked = (
        ("smallest_film", np.nanmin, "minimum_film", bearing.least_film, "smallest film"),
        ("largest_pressure", np.nanmax, "maximum_pressure", pressure, "largest film pressure"),
    )
    for name, extreme, field, limit, what in asked:
        if not np.isfinite(table[name].values).any():
            continue
        worst = int(np.nanargmax(table[name].values == extreme(table[name].values)))
        case, time = str(table["case"].values[worst]), float(table[f"{name}_time"].values[worst])
        force, moment, speed = loads_at(folder, case, place, time)
        value = partial(value_of, bearing, to_rolling(force), to_rolling(moment), speed, field)
        told = f"{what} of the {bearing.kind} bearing in {place}"
        if field == "minimum_film":
            factor, thinner = film_factors(value, limit)
            change = f"{place}: oil of {1e3 * thinner * bearing.oil.viscosity:.3g} mPa s"
        else:
            factor, change = pressure_factor(value, limit), ""
        power = power_of_load(partial(value, oil=1.0), factor, WIDEST)
        drawn = of_extreme(table[name], extreme, factor, power)
        models = "thrust.film", field.replace("_", " ")
        yield Margin(
            factor, place, case, told, change, drawn, time=time, models=models, power=power
        )


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
    force: np.ndarray,
    moment: np.ndarray,
    speed: float,
    field: str,
    load: float,
    oil: float,
) -> float:
    """A value of the films with factors on load and viscosity; NaN without an answer."""
    try:
        thinner = bearing.with_viscosity(oil)
        return float(getattr(thinner.solve(load * force, load * moment, speed), field))
    except SolverError:
        return math.nan
