"""Stationary and periodic design loads → the film of the bearing under them."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from loadflow.scene.journal import Journal
from loadflow.stages.design_samples import Governed, closed_samples, stationary_samples
from loadflow.stages.films.summary import extremes, judged
from loadflow.stages.films.turning import turning
from loadflow.stages.journal import driven
from loadflow.studies.bearing_series import BearingSeries
from loadflow.studies.design_loads.tables import PeriodicPart

HEADS = ("case", "bearing", "load", "E", "h_min, µm", "p_max, MPa", "P_f, kW")
"""Of a table of films: under each stationary load, or largest in the orbit with its mean loss."""

NUMBERS = ("eccentricity_ratio", "minimum_film", "maximum_pressure", "friction_power")
"""What a film is told by."""


def stationary_films(series: BearingSeries, journal: Journal) -> list[dict[str, Any]]:
    """Film of a bearing at rest under each of its stationary loads, in SI units.

    Raises
    ------
    loadflow.errors.SolverError
        No film carries any of them.
    """
    loads = stationary_samples(_governed(series))
    film = driven(journal, series.bearing, loads)
    turns = turning(film.drop_vars("time"))  # each by itself: these follow no course
    numbers = {name: judged(film, name, turns) for name in NUMBERS}
    missed = ~(film["converged"].astype(bool) | film["in_contact"].astype(bool)).values
    return [
        {"case": series.case, "bearing": series.bearing, "load": str(name)}
        | {of: float(values[k]) for of, values in numbers.items()}
        | {"not_converged": int(missed[k])}
        for k, name in enumerate(loads["load_name"].values)
    ]


def periodic_film(part: PeriodicPart, journal: Journal) -> dict[str, Any]:
    """Film of a bearing round the orbit that closes under its periodic load, in SI units.

    Raises
    ------
    loadflow.errors.SolverError
        The orbit does not close.
    """
    loads = closed_samples(_governed(part.series), part.load, part.bounds)
    film = driven(journal, part.series.bearing, loads)
    found = extremes(film.assign(weight=xr.ones_like(film["weight"])))
    return {
        "case": part.series.case,
        "bearing": part.series.bearing,
        "load": "closed orbit",
        "eccentricity_ratio": float(found["largest_eccentricity_ratio"]),
        "minimum_film": float(found["smallest_film"]),
        "maximum_pressure": float(found["largest_pressure"]),
        "friction_power": float(found["mean_friction_power"]),
        "not_converged": int(found["not_converged"]),
        **{name: float(film.attrs[name]) for name in ("closure", "periods")},
    }


def as_row(film: dict[str, Any]) -> list[str]:
    """The film under `HEADS`; a load without a film has dashes."""
    shown = (
        (film["eccentricity_ratio"], 1.0),
        (film["minimum_film"], 1e6),
        (film["maximum_pressure"], 1e-6),
        (film["friction_power"], 1e-3),
    )
    numbers = [f"{scale * value:.4g}" if np.isfinite(value) else "-" for value, scale in shown]
    return [film["case"], film["bearing"], film["load"], *numbers]


def _governed(series: BearingSeries) -> Governed:
    vectors: dict[str, Any] = {"force": (series.force, {}), "moment": (series.moment, {})}
    return Governed(series.time, series.speed, vectors, False, series.source)
