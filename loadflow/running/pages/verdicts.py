"""Verdicts of a run, and its lives, on the report page."""

from __future__ import annotations

from collections.abc import Collection, Iterator

import numpy as np
import xarray as xr

from loadflow.quantities import HOURS_PER_YEAR, four_digits
from loadflow.report import Table
from loadflow.report.moments import Moment, links_to, place_of
from loadflow.verdict import Verdict, from_dataset


def verdict_sentence(tables: dict[str, xr.Dataset]) -> str:
    """How many limits hold, and which do not; empty where nothing is judged."""
    if "verdicts" not in tables:
        return ""
    judged = [one for one in from_dataset(tables["verdicts"]) if one.answer != "no limit"]
    if not judged:
        return ""
    told = f"{sum(one.holds for one in judged)} of {len(judged)} limits hold"
    for answer in ("broken", "not answered"):
        if failed := [one for one in judged if one.answer == answer]:
            told += f"; {answer}: {', '.join(map(_failed, failed))}"
    return f"{told}."


def _failed(verdict: Verdict) -> str:
    _, what, value, limit, *_ = _verdict_row(verdict)
    numbers = "" if np.isnan(verdict.value) else f", {value}, limit {limit}"
    return f"{what} ({verdict.subject}{numbers})"


def verdict_table(tables: dict[str, xr.Dataset], shown: Collection[str] = ()) -> Iterator[Table]:
    """All verdicts of the run, the broken ones marked; nothing if there are none.

    Parameters
    ----------
    tables : dict
        Results of the run by stage.
    shown : collection of str, optional
        Anchors of the moments that the page shows, to lead to.
    """
    if "verdicts" not in tables:
        return
    found = [*from_dataset(tables["verdicts"])]
    rows = [_verdict_row(verdict) for verdict in found]
    bad = frozenset(k for k, verdict in enumerate(found) if not verdict.holds)
    heads = ["bearing", "what", "value", "limit", "margin", "verdict", "governed by", "limit from"]
    links = links_to(map(moment_of, found), heads.index("governed by"), shown)
    yield Table("Verdicts", [*heads, "remarks"], rows, bad, links=links)


def moment_of(verdict: Verdict) -> Moment | None:
    """Where a verdict is from; None where it is of all load cases."""
    place = place_of(verdict.subject)
    return Moment(verdict.case, verdict.time, place) if verdict.case else None


def _verdict_row(verdict: Verdict) -> list[str]:
    moment = moment_of(verdict)
    value, limit, margin = verdict.numbers
    sign = "≤" if verdict.sense == "at most" else "≥"
    at = "" if moment is None else moment.within
    said = (f"{sign} {limit}" if limit else "", margin or "-", verdict.answer, at)
    about = (verdict.source, verdict.note)
    return [verdict.subject, verdict.quantity, value or "-", *said, *about]


def lifetime_table(tables: dict[str, xr.Dataset]) -> Iterator[Table]:
    """Life and energy a year of each bearing over all load cases."""
    if "lifetime" not in tables:
        return
    data, rows = tables["lifetime"], []
    for kind in ("journal", "thrust", "rolling"):
        for name in data[kind].values.tolist() if kind in data.dims else ():
            own = {n: data[n].sel({kind: name}) for n in data.data_vars if kind in data[n].dims}
            life, modified = (
                four_digits(float(own[n]) / HOURS_PER_YEAR) if n in own else "-"
                for n in ("life_hours", "modified_life_hours")
            )
            energy = own.get(f"{kind}_energy")
            spent = "-" if energy is None else four_digits(float(energy) / 3.6e9)
            rows.append([f"{kind} {name}", life, modified, spent])
    heads = ["over all load cases", "life L10h, years", "modified life L10mh, years"]
    yield Table("Lifetime", [*heads, "energy, MWh a year"], rows)
