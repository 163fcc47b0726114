"""The page of a search for the best design: sentence, table, front, maps."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from loadflow.plots.style import to_svg
from loadflow.quantities import three_digits
from loadflow.report.design_figures import front_figure, map_figure
from loadflow.report.page import write_filled

FRONT_ROWS = 12
"""Designs of the front that the page lists."""

CHECKED = (
    "load_factor",
    "energy",
    "friction",
    "minimum_film",
    "film_pressure",
    "eccentricity_ratio",
    "tilt",
    "whirl",
    "oil_flow",
    "static_safety",
    "contact_pressure",
    "modified_life",
    "rating_life",
)
"""Rows of the first table: numbers of the fast models and of the runs, in one unit."""


def write_design(path: Path, data: Mapping[str, Any]) -> Path:
    """Write the page of a search, whole or not at all.

    Parameters
    ----------
    path : Path
        HTML file to write.
    data : mapping
        `loadflow.studies.design.result.Designs.as_dict`.
    """
    checks = data["checks"]
    best = next((name for name in reversed(checks) if name != "start"), None)
    return write_filled(
        path,
        "design.html",
        data=data,
        best=checks[best] if best else None,
        start=checks.get("start"),
        rows=[*_rows(data, best)],
        told_by_runs=[*_told_by_runs(data)],
        front=[*_front(data)],
        figure=to_svg(front_figure(data)),
        maps=[(one["keys"], to_svg(map_figure(data, k))) for k, one in enumerate(data["maps"])],
    )


def _rows(data: Mapping[str, Any], best: str | None) -> Any:
    """Quantity, unit, and the value of given and best design by fast models and when run."""
    numbers = data["designs"][data["best"]]["numbers"] if data["best"] is not None else {}
    runs = [data["checks"].get(name) for name in ("start", best) if name]
    runs += [None] * (2 - len(runs))
    for key in CHECKED:
        about = data["quantities"][key]
        factor = data["numbers"].get(key, {"shown": [1.0]})["shown"][0]
        fast = [
            "" if one.get(key) is None else three_digits(factor * one[key])
            for one in (data["given"], numbers)
        ]
        run = [_run_value(one, key) for one in runs]
        cells = [fast[0], run[0], fast[1], run[1]]
        if any(cells):
            yield about["name"], about["unit"], cells


def _run_value(run: Mapping[str, Any] | None, key: str) -> str:
    number = run["numbers"].get(key) if run else None
    if not number or number["value"] is None:
        return ""
    bounds = ""
    if number["low"] is not None:
        bounds = f" ({three_digits(number['low'])} … {three_digits(number['high'])})"
    return f"{three_digits(number['value'])}{bounds}"


def _told_by_runs(data: Mapping[str, Any]) -> Any:
    """Name, margins, their ratio and limits of each design that was run, as they were."""
    for one in data["told_by_runs"]:
        fast, run = (("–" if one[k] is None else three_digits(one[k])) for k in ("fast", "run"))
        both = one["fast"] and one["run"] is not None
        share = three_digits(one["run"] / one["fast"]) if both else "–"
        name = "as given" if one["name"] == "start" else one["name"]
        limits = "hold" if one["holds"] else "broken: " + ("; ".join(one["broken"]) or "no answer")
        yield name, fast, run, share, limits, "good" if one["holds"] else "bad"


def _front(data: Mapping[str, Any]) -> Any:
    """Rows of some designs of the front, spread over it."""
    index = data["front"]["index"]
    if not index:
        return
    count = min(FRONT_ROWS, len(index))
    chosen = dict.fromkeys(round(k * (len(index) - 1) / max(count - 1, 1)) for k in range(count))
    for k in chosen:
        one = data["designs"][index[k]]
        values = [three_digits(one["numbers"][name]) for name in ("load_factor", "energy")]
        yield index[k] == data["best"], [*one["settings"], *values, one["governs"]]
