"""The page of a comparison: one sentence, one table, then inputs, then depth."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from loadflow.quantities import HOURS_PER_YEAR, percent, scale_of, three_digits
from loadflow.report.charts import Chart
from loadflow.report.moments import Moment, place_of
from loadflow.report.page import write_filled
from loadflow.report.sketch import sketch


@dataclass(frozen=True)
class Cell:
    """A cell of the table: the value, what is known of its error, and where it is from.

    `around` has what seeds, models and tolerances make of it, `missing` which of them are not
    known, and why; `link` leads to the extreme in the depth of the page, `hint` says why a kind of
    bearing has no such number.
    """

    value: str
    around: tuple[tuple[str, str], ...] = ()
    limit: str = ""
    where: str = ""
    note: str = ""
    state: str = ""
    link: str = ""
    hint: str = ""
    missing: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class Row:
    """A quantity of all candidates; `limit` is that of all that have it, where it is the same."""

    name: str
    unit: str
    limit: str
    cells: tuple[Cell, ...]


def write_comparison(
    path: Path, data: Mapping[str, Any], pictures: Mapping[str, Sequence[Chart]] | None = None
) -> Path:
    """Write the page of a comparison, whole or not at all.

    Parameters
    ----------
    path : Path
        HTML file to write.
    data : mapping
        `loadflow.studies.candidate.result.Comparison.as_dict`.
    pictures : mapping of str to sequence of Chart, optional
        By candidate, the moments that its numbers are from; its name and a full stop stand before
        their anchors.

    Returns
    -------
    Path
        The file.
    """
    candidates, pictures = data["candidates"], pictures or {}
    shown = {chart.anchor for charts in pictures.values() for chart in charts}
    groups: dict[str, list[Row]] = {}
    silent = []
    behind: dict[str, list[str]] = {}
    above: Row | None = None
    for one in candidates:
        behind.setdefault(one["references"], []).append(one["title"])
    for key, about in data["quantities"].items():
        rows = groups.setdefault(about["group"], [])
        if (row := _row(key, data, shown)) is None:
            continue
        if (why := _tells_nothing(key, data)) is None:
            rows.append(row if above is None else _without_notes_of(above, row))
            above = row
        else:
            silent.append(f"{about['name']} ({why})")
    nowhere = _nowhere(groups)
    groups = {title: [_without(nowhere, row) for row in rows] for title, rows in groups.items()}
    return write_filled(
        path,
        "compare.html",
        data=data,
        groups=groups.items(),
        silent=silent,
        nowhere=nowhere,
        reasons=_reasons(groups),
        behind=behind.items(),
        sketch=sketch(data["shaft"]),
        verdicts={one["name"]: [*_verdicts(one, shown)] for one in candidates},
        extremes={one["name"]: [*_extremes(one, data, shown)] for one in candidates},
        pictures=pictures,
        checks={one["name"]: [_check(c) for c in one["checks"]] for one in candidates},
    )


def _nowhere(groups: Mapping[str, list[Row]]) -> dict[str, str]:
    """What no number of the table has, for one reason that all share: told once, in no cell."""
    cells = [cell for rows in groups.values() for row in rows for cell in row.cells]
    numbers = [dict(cell.missing) for cell in cells if cell.around or cell.missing]
    shared = set.intersection(*(set(lacks.items()) for lacks in numbers)) if numbers else set()
    return dict(sorted(shared))


def _without(told: Mapping[str, str], row: Row) -> Row:
    """A row whose cells leave out what is told once for all of them."""
    cells = (
        replace(cell, missing=tuple(one for one in cell.missing if one[0] not in told))
        for cell in row.cells
    )
    return replace(row, cells=tuple(cells))


def _reasons(groups: Mapping[str, list[Row]]) -> dict[str, int]:
    """Why there is no number, interval, error or band: each reason once, with its number."""
    cells = (cell for rows in groups.values() for row in rows for cell in row.cells)
    found = (why for cell in cells for why in (cell.hint, *dict(cell.missing).values()) if why)
    return {why: k for k, why in enumerate(dict.fromkeys(found), 1)}


def moments_of(one: Mapping[str, Any], data: Mapping[str, Any]) -> dict[Moment, list[str]]:
    """Where the numbers of a candidate are from, with the names of the numbers.

    Parameters
    ----------
    one : mapping
        `loadflow.studies.candidate.result.Judged.as_dict`.
    data : mapping
        That of the comparison.
    """
    found: dict[Moment, list[str]] = {}
    for key, number in one["numbers"].items():
        if _is_extreme(number):
            found.setdefault(_moment(number), []).append(data["quantities"][key]["name"])
    for verdict in one["verdicts"]:
        if verdict["case"]:
            found.setdefault(_moment(verdict), []).append(verdict["quantity"])
    return found


def _moment(told: Mapping[str, Any]) -> Moment:
    """Where a number, or a verdict, is from."""
    time = math.nan if told["time"] is None else told["time"]
    return Moment(told["case"], time, told.get("place") or place_of(told.get("subject", "")))


def _verdicts(one: Mapping[str, Any], shown: Collection[str]) -> Iterator[dict[str, str]]:
    """Verdicts on a candidate as rows of a table, each with its link."""
    for verdict in one["verdicts"]:
        yield verdict_row(verdict) | {"link": _picture(one, verdict, shown)}


def _picture(one: Mapping[str, Any], told: Mapping[str, Any], shown: Collection[str]) -> str:
    """Link to where a number of a candidate, or a verdict, is from; empty without a picture."""
    name = f"{one['name']}.{_moment(told).anchor}"
    return f"#{name}" if name in shown else ""


def _row(key: str, data: Mapping[str, Any], shown: Collection[str]) -> Row | None:
    """A quantity of all candidates; None where none has it, or could have it."""
    about = data["quantities"][key]
    numbers = [one["numbers"].get(key) for one in data["candidates"]]
    links = [_link(one, key, shown) for one in data["candidates"]]
    cells = [_cell(number, link, about["at_most"]) for number, link in zip(numbers, links)]
    if all(cell.value == "" or _makes_no_sense(number) for cell, number in zip(cells, numbers)):
        return None
    told = (cell for cell, number in zip(cells, numbers) if number and number["value"] is not None)
    limits = {cell.limit for cell in told}
    shared = limits.pop() if len(limits) == 1 else ""
    own = [replace(cell, limit="") for cell in cells] if shared else cells
    return Row(about["name"], about["unit"], shared, tuple(own))


def _without_notes_of(above: Row, row: Row) -> Row:
    """A row whose cells do not repeat the remark of the cell above them."""
    cells = (
        replace(cell, note="") if cell.note == over.note else cell
        for cell, over in zip(row.cells, above.cells)
    )
    return replace(row, cells=tuple(cells))


def _tells_nothing(key: str, data: Mapping[str, Any]) -> str | None:
    """Why a row would be 0, or without a number, throughout; None where it tells something."""
    numbers = [one["numbers"][key] for one in data["candidates"] if key in one["numbers"]]
    if any(number["value"] or number["holds"] is False for number in numbers):
        return None
    own = [number for number in numbers if not _makes_no_sense(number)]
    notes = dict.fromkeys(number["note"].removeprefix("n/a: ") for number in own if number["note"])
    zero = any(number["value"] is not None for number in own)
    return "; ".join(["0 throughout", *notes] if zero else notes)


def _makes_no_sense(number: Mapping[str, Any] | None) -> bool:
    """Whether a kind of bearing has no such quantity."""
    return number is not None and number["value"] is None and number["note"].startswith("n/a: no ")


def _link(one: Mapping[str, Any], key: str, shown: Collection[str]) -> str:
    """Where a number leads to: the picture of its moment, or its row among the extremes."""
    number = one["numbers"].get(key)
    if number is None or not _is_extreme(number):
        return ""
    return _picture(one, number, shown) or f"#{one['name']}.{key}"


def _cell(number: dict[str, Any] | None, link: str, at_most: bool) -> Cell:
    """A number of a candidate as it stands in the table, with the `link` to where it is from."""
    if number is None or (number["value"] is None and not number["note"]):
        return Cell("")
    if _makes_no_sense(number):
        return Cell("n/a", hint=number["note"].removeprefix("n/a: "))
    if number["value"] is None:
        return Cell("–", where=number["note"])
    around = [] if number["low"] is None else [("seeds", _ends(number, "low", "high"))]
    if number["error"] is not None:
        around.append(("models", _by_models(number["error"])))
    if number["tolerance_low"] is not None:
        band = _ends(number, "tolerance_low", "tolerance_high")
        around.append((_BESIDE["tolerances"], f"{band}, {number['tolerance']}"))
    sign = "≤" if at_most else "≥"
    limit = "" if number["limit"] is None else f"limit {sign} {short(number['limit'])}"
    state = {True: "good", False: "bad", None: ""}[number["holds"]]
    where, note = _where(number | {"note": ""}), number["note"]
    missing = tuple((_BESIDE.get(what, what), why) for what, why in number["missing"].items())
    value = three_digits(number["value"])
    return Cell(value, tuple(around), limit, where, note, state, link, "", missing)


_BESIDE = {"tolerances": "tol."}  # what is written short beside the numbers


def _by_models(error: float) -> str:
    """An error as a share; one that leaves no digit of the value as the factor that it is."""
    return f"± {percent(error)}" if error < _FACTOR else f"within a factor of {short(1 + error)}"


_FACTOR = 2.0  # share from which an error is told as a factor


def _ends(number: Mapping[str, Any], low: str, high: str) -> str:
    """An interval; in words where it does not move the digits that are shown."""
    value, down, up = (three_digits(number[end]) for end in ("value", low, high))
    return "the same" if value == down == up else f"{down}\u2009…\u2009{up}"


def _where(number: Mapping[str, Any]) -> str:
    """Bearing, load case, time and note of a number."""
    time = "" if number["time"] is None else f"{number['time']:.1f} s"
    parts = (number["place"], number["case"], time, number["note"])
    return ", ".join(part for part in parts if part)


def short(value: float) -> str:
    """A number with three digits, without those behind its point that are 0 at the end."""
    text = three_digits(value)
    return text.rstrip("0").rstrip(".") if "." in text and "e" not in text else text


UNITS = {
    "Pa": (1e-6, "MPa"),
    "m": (1e6, "µm"),
    "N": (1e-3, "kN"),
    "h": (1 / HOURS_PER_YEAR, "years"),
}
"""Factor and unit in which a verdict in SI units is shown."""


def verdict_row(verdict: Mapping[str, Any]) -> dict[str, str]:
    """A verdict (`loadflow.verdict.Verdict.as_dict`) as it stands in a table: value and limit in
    units that fit, and where they are from.
    """
    factor, unit = UNITS.get(verdict["unit"], (1.0, verdict["unit"]))
    zero, unit = scale_of(unit)
    value, limit = (
        "–" if verdict[key] is None else f"{short(factor * (verdict[key] - zero))} {unit}".strip()
        for key in ("value", "limit")
    )
    sign = "≤" if verdict["sense"] == "at most" else "≥"
    return {
        "subject": verdict["subject"],
        "quantity": verdict["quantity"],
        "value": value,
        "limit": f"{sign} {limit}" if limit != "–" else limit,
        "answer": verdict["answer"],
        "where": _where({**verdict, "place": ""} | {"note": ""}),
        "source": verdict["source"],
        "note": verdict["note"],
        "key": verdict["key"],
        "state": "" if verdict["answer"] in ("holds", "no limit") else "bad",
    }


def _is_extreme(number: Mapping[str, Any]) -> bool:
    """Whether a number is that of one load case."""
    return bool(number["case"]) and number["value"] is not None


def _extremes(
    one: Mapping[str, Any], data: Mapping[str, Any], shown: Collection[str]
) -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """Name, link to its picture and cells of each extreme: with bearing, load case and time."""
    for key, number in one["numbers"].items():
        if _is_extreme(number):
            unit = "" if number["unit"] == "–" else number["unit"]
            yield (
                f"{one['name']}.{key}",
                _picture(one, number, shown),
                (
                    data["quantities"][key]["name"],
                    f"{three_digits(number['value'])} {unit}".rstrip(),
                    number["place"],
                    number["case"],
                    "" if number["time"] is None else f"{number['time']:.2f} s",
                ),
            )


def _check(check: Mapping[str, Any]) -> dict[str, str]:
    change = "not solved" if check["change"] is None else percent(check["change"])
    return {**{key: str(check[key]) for key in ("stage", "quantity", "against")}, "change": change}
