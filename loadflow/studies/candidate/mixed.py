"""Time in mixed friction, and what the error of the films means for it."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.cube.hdf5 import read_groups
from loadflow.journal.critical import Critical
from loadflow.quantities import HOURS_PER_YEAR, percent
from loadflow.stages.films.turning import runs_throughout, turning
from loadflow.studies.candidate.numbers import Finished, error_of, lifetime_mean
from loadflow.studies.candidate.result import Number
from loadflow.studies.seeds.intervals import Groups

_READ = (
    "time", "speed", "weight", "in_contact", "eccentricity_ratio", "minimum_film", "converged",
)  # fmt: skip


def mixed_time(run: Finished, table: xr.Dataset, share: np.ndarray, groups: Groups) -> Number:
    """Hours a year above E_krit or in contact while turning, of the bearing with most of them.

    Its error by models is that of the smallest film, carried on: the same series are counted with
    all films so much thinner, and so much thicker. A time of 0 that stays 0 with thinner films has
    no error; one that does not has no share of itself, and the note says what it becomes.

    Parameters
    ----------
    run : Finished
        The candidate; its films in motion, or in samples, lie in its folder.
    table : xarray.Dataset
        Films of the run over ``case``.
    share : ndarray
        Of the lifetime, of each case.
    groups : Groups
        Cases that differ by their seed alone.
    """
    part = (table["mixed_friction_time"] / table["duration"]).max("bearing").values
    touching = float(table["contact_time"].sum())
    note = "" if part.any() else "no film is in contact or above E_krit while turning"
    note = f"in contact for {touching:.3g} s of all cases together" if touching else note
    note = "; ".join(filter(None, (note, _starts(table, share))))
    number = lifetime_mean(run, part * HOURS_PER_YEAR, share, groups, "h", note)
    error = error_of(run, "journal.film", "minimum film") if "journal" in run.tables else math.nan
    if not error < 1:
        return number
    hours = [_hours(run, table, share, scale) for scale in (1 - error, 1 + error)]
    apart = max(abs(each - number.value) for each in hours)
    if number.value or not apart:
        return replace(number, error=apart / number.value if number.value else 0.0)
    said = f"{hours[0]:.3g} h with films thinner by {percent(error)}, their error by models"
    return replace(number, note=f"{note}; {said}")


def _starts(table: xr.Dataset, share: np.ndarray) -> str:
    """What a start, stop or fault takes that has no share of the year, or all of it, in words."""
    starts = ~runs_throughout(table)
    left = starts & (share == 0)
    mixed = table["mixed_friction_time"].max("bearing").values
    if (mixed * left).any():
        dlcs = ", ".join(sorted({*table["dlc"].values[left & (mixed > 0)].tolist()}))
        return (
            f"without DLC {dlcs}, up to {np.max(mixed * left):.3g} s each time: "
            "lifetime.per_year says how often"
        )
    if starts.all():
        return "of a year of nothing but starts, stops and standing: add production to the loads"
    return ""


def _hours(run: Finished, table: xr.Dataset, share: np.ndarray, scale: float) -> float:
    """Hours a year with all films `scale` times as thick."""
    found = [
        max(
            _part(samples, run.scene.journal.at(place).contact_film, scale)
            for place, samples in read_groups(_films(run.folder, case), _READ).items()
        )
        for case in table["case"].values.tolist()
    ]
    return HOURS_PER_YEAR * float((np.array(found) * share).sum() / share.sum())


def _films(folder: Path, case: str) -> Path:
    return folder / "journal" / f"{case}.h5"


def _part(samples: xr.Dataset, rough: float, scale: float) -> float:
    """Share of the series of a bearing in mixed friction, with films `scale` times as thick."""
    touches = samples["in_contact"].values.astype(bool)
    film = scale * samples["minimum_film"].values
    apart = film >= rough
    touches = touches & ~apart if scale > 1 else touches | (film < rough)
    above = np.zeros(touches.shape, bool)
    if "eccentricity_ratio" in samples:
        left = Critical.told(samples.attrs).left(samples["eccentricity_ratio"].values, film / scale)
        above = scale * left < 1
    weight = samples["weight"].values
    return float(weight[turning(samples) & (touches | above)].sum() / weight.sum())
