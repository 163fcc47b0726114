"""Loads of a run over the lifetime on its report page: duration, Markov matrix, extreme, DEL."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.cube.hdf5 import read_values
from loadflow.report import Section
from loadflow.report.page import Shown
from loadflow.report.run_charts import duration_chart, exceedance_chart
from loadflow.running.folder import ForceOf, answered
from loadflow.scene.scene import Scene
from loadflow.studies.bearing_series import BearingSeries
from loadflow.studies.lifetime.finished_run import case_shares
from loadflow.studies.lifetime.lifetimes import BearingLifetime, LifetimeOptions, lifetimes
from loadflow.studies.lifetime.page import (
    case_table,
    duration_of,
    exceedances,
    markov_picture,
    summary_table,
    tail_tables,
)

CLASSES = 32
"""Of speed, of force, and of the Markov matrix."""


def lifetime_of_loads(
    folder: Path, scene: Scene, tables: Mapping[str, xr.Dataset], force_of: ForceOf
) -> tuple[list[BearingLifetime], LifetimeOptions]:
    """Duration, transitions, tails and damage of the loads on the bearings of a run.

    Each load case counts with its share of the lifetime.

    Parameters
    ----------
    folder : Path
        Of a finished run.
    scene : Scene
        What was run.
    tables : mapping
        Its results by stage.
    force_of : callable
        Forces on the bearings of a case, by its name.

    Returns
    -------
    tuple
        Those of the bearings that results are of, or of all; none where no case has a share.
    """
    options = LifetimeOptions(years=scene.lifetime.years, weights="given", classes=CLASSES)
    share = case_shares(scene, tables["statistics"]) if "statistics" in tables else None
    if share is None or not (folder / "shaft").is_dir():
        return [], options
    table = tables["statistics"]
    shares = dict(zip(table["case"].values.tolist(), share.tolist()))
    series = _series(folder, table, shares, _bearings(tables), force_of)
    return list(lifetimes(series, options)), options


def lifetime_section(lives: list[BearingLifetime], options: LifetimeOptions) -> Section:
    """What matters of each bearing first; its cases, tails and pictures behind."""
    tables, pictures = [summary_table(lives, options)], list[Shown]()
    for life in lives:
        what = f"Bearing {life.bearing}: "
        tables += [
            replace(table, title=what + table.title, fold=True)
            for table in (case_table(life, options), *tail_tables(life))
        ]
        pictures.append(duration_chart(duration_of(life), what + "hours and revolutions above"))
        if life.extreme is not None:
            said = f"{what}radial force; dashed: once in {options.return_period:g} years"
            pictures.append(exceedance_chart(exceedances(life, options), said))
        pictures.append(markov_picture(life, what))
    return Section(
        "Lifetime of the loads",
        "Every load case with its share of the lifetime. Ranges of damage-equivalent loads are "
        "counted by rainflow; the extreme follows from block maxima of each wind speed.",
        tables,
        pictures,
    )


def _bearings(tables: Mapping[str, xr.Dataset]) -> set[str]:
    """Bearings that results are of; empty: of all."""
    of = ("journal", "thrust", "rolling")
    return {str(b) for room in of if room in tables for b in tables[room]["bearing"].values}


_OVER_TIME = ("time", "speed")


def _series(
    folder: Path,
    table: xr.Dataset,
    shares: Mapping[str, float],
    wanted: set[str],
    force_of: ForceOf,
) -> Iterator[BearingSeries]:
    columns = (table[name].values.tolist() for name in ("case", "dlc", "wind_speed"))
    known = {case: {"dlc": dlc, "wind_speed": wind} for case, dlc, wind in zip(*columns)}
    for case in answered(folder, "shaft", shares):
        loads = read_values(folder / "loads" / f"{case}.h5", dict.fromkeys(_OVER_TIME, ("time",)))
        time, speed = (loads[name].astype(float) for name in _OVER_TIME)
        labels_of = known[case] | {"weight": shares[case]}
        for name, force in force_of(case).items():
            if not wanted or name in wanted:
                force = force.astype(float).T
                none = np.broadcast_to(0.0, force.shape)
                yield BearingSeries(case, name, labels_of, time, speed, force, none)
