"""Starts, stops and faults of journal bearings on a report page, as in [Jonuschies 2015]."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr

from loadflow.quantities import four_digits
from loadflow.report import Table
from loadflow.wind.cases import stands_or_starts

_TURNS = 30 / np.pi

_COLUMNS = (
    ("transition_time", "t_ü, s", 1.0),
    ("transition_speed", "n_ü, 1/min", _TURNS),
    ("lift_off_time", "lift-off, s", 1.0),
    ("lift_off_speed", "lift-off, 1/min", _TURNS),
    ("touch_down_time", "touch-down, s", 1.0),
    ("touch_down_speed", "touch-down, 1/min", _TURNS),
    ("standstill_time", "standstill, s", 1.0),
    ("standstill_eccentricity_ratio", "ε at standstill", 1.0),
    ("film_after_stop", "film after standstill, s", 1.0),
    ("contact_time", "in contact, turning, s", 1.0),
    ("mixed_friction_time", "mixed friction, s", 1.0),
    ("mixed_friction_revolutions", "revolutions in it", 1.0),
    ("mixed_friction_energy", "energy in it, kJ", 1e-3),
)
"""What is told of a start or stop: its variable, its words, and what its values are times."""


def start_tables(data: xr.Dataset) -> Iterator[Table]:
    """Yield one table of the load cases that start, stop or stand; none where there are none.

    Parameters
    ----------
    data : xarray.Dataset
        Films of a run, over ``bearing`` and ``case``.
    """
    dlcs = [str(dlc) for dlc in data["dlc"].values]
    some = [k for k, dlc in enumerate(dlcs) if stands_or_starts(dlc)]
    if not some:
        return
    part = data.isel(case=some)
    shown = [(name, words, unit) for name, words, unit in _COLUMNS if part[name].notnull().any()]
    rows = [
        [f"{case} {bearing}"]
        + [
            _said(unit * float(part[name].sel(bearing=bearing).values[k]))
            for name, _, unit in shown
        ]
        for k, case in enumerate(part["case"].values)
        for bearing in part["bearing"].values
    ]
    heads = ["case", *(words for _, words, _ in shown)]
    yield Table("Starts, stops and faults: transition at E_krit and mixed friction", heads, rows)


def _said(value: float) -> str:
    return four_digits(value) if np.isfinite(value) else "-"
