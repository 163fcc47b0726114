"""Numbers of a finished candidate with what is known of their error: by seeds, and by models."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import xarray as xr

from loadflow.quantities import load_cases
from loadflow.scene.scene import Scene
from loadflow.stages.films.turning import of_running, runs_throughout
from loadflow.studies.candidate.quantities import QUANTITIES
from loadflow.studies.candidate.result import STARTS_ALONE, Number
from loadflow.studies.lifetime.finished_run import NO_SHARE, known_shares
from loadflow.studies.seeds.intervals import Groups, interval
from loadflow.verdict import Verdict

Sense = Literal["most", "least"]


@dataclass(frozen=True)
class Finished:
    """A candidate that was run.

    Attributes
    ----------
    name, title, source : str
        Of the candidate.
    scene : Scene
        What was run, with the effects that were decided on.
    tables : mapping
        Its results by stage.
    manifest : mapping
        How its numbers came about.
    folder : Path
        Of its run.
    """

    name: str
    title: str
    source: str
    scene: Scene
    tables: Mapping[str, xr.Dataset]
    manifest: Mapping[str, Any]
    folder: Path

    @property
    def rooms(self) -> list[str]:
        """What kinds of bearing it has results of."""
        return [room for room in ("journal", "thrust", "rolling") if room in self.tables]


def extreme(
    run: Finished,
    table: xr.Dataset,
    groups: Groups,
    name: str,
    sense: Sense,
    scale: float,
    unit: str,
    model: str,
    *,
    running: bool = False,
) -> Number:
    """Extreme over cases and bearings, with case, time, interval and error.

    With `running` it is that of load cases in which the shaft runs throughout, as the verdicts on
    films have it; the note tells how many others there are.
    """
    found = (of_running(table) if running else table)[name]
    values = found.transpose("case", "bearing").values.astype(float)
    pick = np.nanmax if sense == "most" else np.nanmin
    others = int((~runs_throughout(table)).sum()) if running else 0
    if np.isnan(values).all():
        alone = f"n/a: {STARTS_ALONE}" if others == table.sizes["case"] else "no case has a value"
        return Number(math.nan, unit, note=alone)
    do = "starts, stops or stands" if others == 1 else "start, stop or stand"
    note = f"{load_cases(others)} that {do} not counted" if others else ""
    k, b = np.unravel_index(
        int(np.nanargmax(values) if sense == "most" else np.nanargmin(values)), values.shape
    )
    low, high = interval(groups, lambda some: float(pick(values[some])))
    times = {"bearing_design_safety": "bearing_design_time"}.get(name, f"{name}_time")
    when = math.nan
    if times in table:
        when = float(table[times].transpose("case", "bearing").values[k, b])
    result = {"thrust": "thrust.film", "rolling": "rolling.loads"}.get(
        next(room for room, found in run.tables.items() if found is table), "journal.film"
    )
    return Number(
        float(values[k, b]) * scale, unit, low * scale, high * scale, error_of(run, result, model),
        case=str(table["case"].values[k]), time=when, place=str(table["bearing"].values[b]),
        note=note,
    )  # fmt: skip


def seeds_of(
    run: Finished, by_case: Mapping[str, Any], statistic: Callable[[list[Any]], float]
) -> tuple[float, float]:
    """Interval of a statistic of what cases have, of those that have something."""
    table = next(
        run.tables[room] for room in ("journal", "thrust", "rolling") if room in run.tables
    )
    seen = [by_case.get(str(case)) for case in table["case"].values]

    def known(some: np.ndarray) -> float:
        own = [seen[k] for k in some if seen[k] is not None]
        return statistic(own) if own else math.nan

    return interval(Groups.of(table), known)


def of_one_seed(run: Finished, number: Number) -> Number:
    """A number without its interval where it is of a load case with one seed alone.

    Drawn anew, that seed is itself: an interval without width would look like a certain number.
    """
    if not number.case or number.low != number.high:
        return number
    table = next(one for one in run.tables.values() if "case" in one.coords and "dlc" in one)
    cases = table["case"].values.tolist()
    alone = {cases[int(group[0])] for group in Groups.of(table).members if group.size == 1}
    return replace(number, low=math.nan, high=math.nan) if number.case in alone else number


def lifetime_mean(
    run: Finished,
    values: np.ndarray,
    share: np.ndarray,
    groups: Groups,
    unit: str,
    note: str = "",
) -> Number:
    """Mean over the lifetime."""

    def mean(some: np.ndarray) -> float:
        return float((values[some] * share[some]).sum() / share[some].sum())

    low, high = interval(groups, mean)
    return Number(mean(np.arange(values.size)), unit, low, high, note=note)


def against(number: Number, verdicts: Sequence[Verdict], quantity: str, scale: float) -> Number:
    """The number with the limit of the verdict on it, of the bearing nearest to its limit."""
    own = [v for v in verdicts if v.quantity == quantity]
    if not own:
        return number
    of_place = [v for v in own if v.subject.endswith(f" {number.place}")] or own
    limit = of_place[0].limit * scale
    holds = all(v.holds for v in own) if math.isfinite(limit) else None
    return replace(number, limit=limit, holds=holds)


def error_of(run: Finished, result: str, quantity: str) -> float:
    """Error by models that the plan expects, as a share; NaN where it was not measured."""
    found = run.manifest.get("expected_errors", {}).get(result, {}).get(quantity)
    return float(found) if isinstance(found, int | float) else math.nan


def without_shares(run: Finished, numbers: Mapping[str, Number]) -> dict[str, Number]:
    """The numbers of a run, without those of a life or a year where no load case has a share of it.

    Means and quantiles are then those over all load cases, each as long as another, and say so.
    """
    rooms = ("journal", "thrust", "rolling")
    table = next(run.tables[room] for room in rooms if room in run.tables)
    if known_shares(run.tables, table) is not None:
        return dict(numbers)
    found = dict(numbers)
    for key, number in numbers.items():
        if number.note.startswith("n/a"):
            continue
        if QUANTITIES[key].shares == "life":
            found[key] = Number(math.nan, number.unit, note=f"n/a: {NO_SHARE}")
        elif QUANTITIES[key].shares == "mean":
            note = f"all load cases count alike, as {NO_SHARE}"
            found[key] = replace(number, note="; ".join(filter(None, (number.note, note))))
    return found


def shares_of(run: Finished, table: xr.Dataset) -> np.ndarray:
    """Share of the lifetime of each case; equal ones where the run could not tell."""
    share = known_shares(run.tables, table)
    return np.full(table.sizes["case"], 1 / table.sizes["case"]) if share is None else share
