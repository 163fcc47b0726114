"""Whether bounds of the grid error hold: draws of every family against twice the cells each way.

python -m benchmarks.robustness.grid_bounds [--draws N] [--first I] [--json FILE] [FAMILY …]
python -m benchmarks.robustness.grid_bounds --rung reduced …

The draws are those of `benchmarks.robustness.families`. The error is 4/3 of the difference from
twice as many cells each way, as of the second order, 16/15 from four times as many where twice as
many have a wider bound: a draw may grade its cells and not those. "touching" takes those draws in
which asperities carry. For each family: draws with both answers, the share of them in which
`grid_error`, or the attributes of a path, hold the error of each quantity, the median of bound over
error, and of h_min how many are more than 25 % off with and without `resolved`.
On "reduced", without an inlet line, the finer films have twice the points across, too; paths have
no bounds there.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from typing import Any
from unittest.mock import patch

import numpy as np

from benchmarks.common import arguments
from benchmarks.robustness.families import FAMILIES, SEEDS, draw_point
from benchmarks.robustness.invariances import Asked, asked, on_reduced
from loadflow.errors import LoadflowError
from loadflow.journal.grid_bounds import BOUNDED, UNRESOLVED
from loadflow.journal.models import reduced
from loadflow.journal.models.composed import model as composed_model
from loadflow.journal.models.composed import supply as composed_supply

QUANTITIES = BOUNDED[1:]
_RICHARDSON = 4.0 / 3.0
_TOUCHES = 0.01  # share of the load on asperities from which surfaces touch


def apart(name: str, one: float, other: float) -> float:
    """Difference of two values; of angles, rad, the lesser way round."""
    way = abs(one - other)
    return min(way, 2.0 * np.pi - way) if name == "attitude_angle" else way


@contextmanager
def many_points() -> Iterator[None]:
    """Reduced films on at least twice the points across that they take by themselves."""
    with (
        patch.object(reduced, "POINTS", 7),
        patch.object(composed_model, "HALF_POINTS", (12, 16, 20, 24, 28)),
        patch.object(composed_model, "POINTS", (24, 28, 32, 36, 40)),
        patch.object(composed_supply, "_POINTS", (9, 12, 16, 20)),
    ):
        yield


def compare(family: str, number: int, rung: str = "grid") -> dict[str, Any] | None:
    """Bounds and errors of one draw; None where either grid has no answer, or it is a path."""
    case = asked(family, number)
    case = on_reduced(case) if rung == "reduced" else case
    if case.verb != "equilibrium":
        return None
    try:
        state, times = _on(case, 1), 2
        with many_points():
            finer = _on(case, times)
            if finer.grid_error.minimum_film > state.grid_error.minimum_film:
                finer, times = _on(case, 4), 4  # its cells know less: the first are graded
    except LoadflowError:
        return None
    if family == "touching" and not state.contact_share > _TOUCHES:
        return None
    more = times**2 / (times**2 - 1.0)
    row = {
        name: (
            float(getattr(state.grid_error, name)),
            more * apart(name, float(getattr(state, name)), float(getattr(finer, name))),
        )
        for name in QUANTITIES
        if hasattr(state.grid_error, name)
    }
    off = apart("", float(state.minimum_film), float(finer.minimum_film))
    return row | {"resolved": bool(state.resolved), "off": off / float(finer.minimum_film)}


def _on(case: Asked, times: int) -> Any:
    """The answer on so many times the cells each way."""
    around, across = case.film.cells
    film = replace(case.film, grid=(times * around, times * across))
    return replace(case, film=film).answer()


def compare_path(number: int) -> dict[str, Any] | None:
    """Bounds and errors of one path on the grid, of narrowest film and largest pressure."""
    paths = []
    for finer in (1, 2):
        point = draw_point(np.random.default_rng([SEEDS["orbit"], number]))
        around, across = min(point.film["grid"], (60, 12))
        point.film["grid"] = (finer * around, finer * across)
        try:
            paths.append(FAMILIES["orbit"](point)())
        except LoadflowError:
            return None
    if "resolved" not in paths[0].attrs:  # another rung
        return None
    film = [float(path.minimum_film.min()) for path in paths]
    peak = [float(path.maximum_pressure.max()) for path in paths]
    row = {
        f"{name}": (paths[0].attrs[f"{name}_grid_error"], _RICHARDSON * abs(one - other))
        for name, (one, other) in (("minimum_film", film), ("maximum_pressure", peak))
    }
    off = abs(film[0] - film[1]) / film[1]
    return row | {"resolved": bool(paths[0].attrs["resolved"]), "off": off}


def run(family: str, numbers: range, rung: str = "grid") -> dict[str, Any]:
    """Shares of one family."""
    one = compare_path if family == "orbit" else partial(compare, family, rung=rung)
    rows = [row for number in numbers if (row := one(number)) is not None]
    row: dict[str, Any] = {"draws": len(rows)}
    for name in [name for name in QUANTITIES if name in rows[0]]:
        bound, error = np.array([row[name] for row in rows]).T
        known = error > 1e-12 * np.abs(bound)
        row[name] = {
            "held": round(float(np.mean(bound >= error)), 4),
            "median": round(float(np.median((bound / np.where(known, error, 1.0))[known])), 1),
        }
    far = np.array([row["off"] for row in rows]) > UNRESOLVED
    told = ~np.array([row["resolved"] for row in rows])
    return row | {
        "unresolved": int(told.sum()),
        "far_off": int(far.sum()),
        "far_off_untold": int((far & ~told).sum()),
    }


def main() -> None:
    """Draw and print the shares."""
    parser = arguments(__doc__)
    every = ["cylinder", "shaped", "pads", "supply", "line", "shell", "contact", "touching"]
    every += ["heat", "composed", "thrust", "cone", "pair", "orbit"]
    parser.add_argument("families", nargs="*", default=every, metavar="FAMILY")
    parser.add_argument("--draws", type=int, default=200)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--rung", choices=["grid", "reduced"], default="grid")
    parser.add_argument("--json", metavar="FILE", help="write the shares there")
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    rows = {}
    for family in given.families:
        rows[family] = run(family, range(given.first, given.first + given.draws), given.rung)
        print(f"{family}: {rows[family]}", flush=True)
        if given.json:
            with open(given.json, "w", encoding="utf-8") as file:
                json.dump(rows, file, indent=1)


if __name__ == "__main__":
    main()
