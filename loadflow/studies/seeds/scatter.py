"""How far what a run says of the lifetime depends on how many seeds each wind speed has.

Every number here is the half width of the 95 % interval that *one* seed of each wind speed would
leave, over the answer; that of n seeds is smaller by √n. Extremes are means over the seeds of each
wind speed, the largest of them, as IEC 61400-1 takes characteristic loads: the largest of all seeds
has no such interval.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.reduction import LongTermExtreme, Tail, long_term_extreme
from loadflow.reduction.extremes import gumbel_parameters
from loadflow.stages.statistics import SLOPE
from loadflow.studies.seeds.intervals import Groups

Floats = NDArray[np.float64]

NORMAL = 1.96
"""Half width of a 95 % interval over the standard deviation."""

YEARS = 50.0

ANSWERS: dict[str, tuple[str, str]] = {
    "largest eccentricity ratio": ("journal.film", "eccentricity ratio"),
    "smallest film": ("journal.film", "minimum film"),
    "damage-equivalent load": ("loads.statistics", "bearing force DEL"),
    "50-year load": ("loads.statistics", "bearing load max"),
    "life": ("rolling.life", "life"),
}
"""By answer, the result and the quantity whose error by models stands beside it."""


def scatter_of_one_seed(
    tables: Mapping[str, xr.Dataset], shares: Floats | None
) -> dict[str, float]:
    """Half widths of the intervals that one seed of each wind speed leaves.

    Parameters
    ----------
    tables : mapping
        Results of a finished run by stage.
    shares : ndarray, shape (case,), or None
        Share of the lifetime of each case; alike where it is not known.

    Returns
    -------
    dict
        By answer of `ANSWERS`, as far as the run has it; empty if no wind speed has two seeds.

    Examples
    --------
    >>> film = [0.80, 0.84, 0.90, 0.92]
    >>> table = xr.Dataset(
    ...     {"largest_eccentricity_ratio": (("bearing", "case"), [film])},
    ...     {"bearing": ["N"], "case": list("abcd"), "dlc": ("case", ["1.1"] * 4),
    ...      "wind_speed": ("case", [8.0, 8.0, 12.0, 12.0])})
    >>> found = scatter_of_one_seed({"journal": table}, None)
    >>> round(found["largest eccentricity ratio"], 3)
    0.048
    """
    table = table_of_cases(tables)
    if table is None:
        return {}
    every = table["case"].values
    kept = {name: tables[name] for name in ("journal", "statistics", "rolling") if name in tables}
    known = np.all([np.isin(every, one["case"].values) for one in kept.values()], axis=0)
    if not known.all():  # a case that failed is left out of all
        shares = None if shares is None else shares[known]
        tables = {name: one.sel(case=every[known]) for name, one in kept.items()}
        table = table.sel(case=every[known])
    groups = Groups.of(table)
    if max(groups.sizes, default=0) < 2:
        return {}
    count = table.sizes["case"]
    weight = np.full(count, 1.0 / count) if shares is None else shares / shares.sum()
    found: dict[str, float] = {}
    if (journal := tables.get("journal")) is not None:
        for name, variable, sign in (
            ("largest eccentricity ratio", "largest_eccentricity_ratio", 1.0),
            ("smallest film", "smallest_film", -1.0),
        ):
            if variable in journal:
                values = journal[variable].transpose("bearing", "case").values.astype(float)
                found[name] = max(_of_extreme(groups, sign * row) for row in values)
    if (statistics := tables.get("statistics")) is not None and "force" in statistics:
        force = statistics["force"].sel(axis=["y", "z"]).transpose("bearing", "axis", ..., "case")
        rows = {
            name: force.sel(statistic=name).values.reshape(-1, count).astype(float)
            for name in ("del", "min", "max")
        }
        damage = rows["del"] ** SLOPE
        found["damage-equivalent load"] = _of_sum(groups, weight, _heaviest(damage, weight)) / SLOPE
        peaks = np.maximum(np.abs(rows["min"]), np.abs(rows["max"]))
        length = table["length"].values if "length" in table.coords else np.full(count, 600)
        largest = peaks[int(np.argmax(peaks.max(axis=1)))]
        found["50-year load"] = _of_return(groups, weight, largest, float(np.median(length)))
    rolling = tables.get("rolling")
    if rolling is not None and "bearing_life" in rolling:
        lives = rolling["bearing_life"].transpose("bearing", "case").values.astype(float)
        damage = np.abs(rolling["mean_speed"].values) / lives
        found["life"] = _of_sum(groups, weight, _heaviest(damage, weight))
    return {name: value for name, value in found.items() if math.isfinite(value)}


def table_of_cases(tables: Mapping[str, xr.Dataset]) -> xr.Dataset | None:
    """A table of a run over all of its load cases; None if it has none."""
    found = [table for table in tables.values() if "case" in table.dims and "dlc" in table.coords]
    return next((table for table in found if "length" in table.coords), found[0] if found else None)


def _heaviest(rows: Floats, weight: Floats) -> Floats:
    """The row that sums up to most."""
    return rows[int(np.argmax(np.nan_to_num(rows) @ weight))]


def _of_extreme(groups: Groups, values: Floats) -> float:
    """Of the largest mean over the seeds of a wind speed; the scatter of all wind speeds counts."""
    means = np.array([values[some].mean() for some in groups.members])
    several = [values[some] for some in groups.members if some.size > 1]
    scatter = math.sqrt(np.mean([one.var(ddof=1) for one in several]))
    return NORMAL * scatter / abs(float(means.max()))


def _of_sum(groups: Groups, weight: Floats, values: Floats) -> float:
    """Of the sum over wind speeds of their shares times the means over their seeds."""
    total = variance = 0.0
    for some in groups.members:
        share = float(weight[some].sum())
        total += share * float(values[some].mean())
        if some.size > 1:
            variance += share**2 * float(values[some].var(ddof=1))
    return NORMAL * math.sqrt(variance) / total if total > 0 else math.nan


def _of_return(groups: Groups, weight: Floats, peaks: Floats, length: float) -> float:
    """Of the level exceeded once in `YEARS`."""
    level = return_level(groups, weight, peaks, length)
    if level is None:
        return math.nan
    least = min(some.size for some in groups.members if some.size > 2)
    return 0.5 * (level.high - level.low) / level.value * math.sqrt(least)


def return_level(
    groups: Groups, weight: Floats, peaks: Floats, length: float
) -> LongTermExtreme | None:
    """Level exceeded once in `YEARS`, by Gumbel's law of the largest of each seed.

    Parameters
    ----------
    groups : Groups
        Cases that differ by their seed alone; those of three seeds or more count.
    weight, peaks : ndarray, shape (case,)
        Share of the lifetime of each case, and its largest value.
    length : float
        Of a case, s.

    Returns
    -------
    LongTermExtreme or None
        With its 95 % interval; None where no wind speed has three seeds.

    Examples
    --------
    >>> groups, peaks = Groups((np.arange(4),)), np.array([1.0, 1.1, 1.05, 1.2])
    >>> level = return_level(groups, np.ones(4), peaks, 600.0)
    >>> level.low < level.value < level.high
    True
    """
    several = [some for some in groups.members if some.size > 2]
    if not several:
        return None
    least = min(some.size for some in several)
    tails, shares = [], []
    for some in several:
        location, scale = gumbel_parameters(peaks[some])
        if scale > 0:
            tail = Tail(float(location), float(scale), 0.0, 1.0 / length, int(least))
            tails.append(tail)
            shares.append(float(weight[some].sum()))
    if not tails or not sum(shares) > 0:
        return None
    return long_term_extreme(tails, shares, YEARS)
