"""Speed and error of every model rung: writes two pages of docs and ladder.json, gains.json.

python -m benchmarks.ladder [--quick] [--only STAGE …] [--pages]

One run on one core, over wind speeds from cut-in to cut-out. Seconds depend on the machine; their
ratios and the errors do not. ``--quick`` takes fewer and shorter cases and writes nothing,
``--pages`` measures nothing and writes the pages from the numbers that are there.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from benchmarks.common import ROOT, arguments, taken_from
from benchmarks.ladder.bearings import (
    measure_gains,
    measure_journal,
    measure_reduction,
    measure_rolling,
)
from benchmarks.ladder.comparison import measure_comparison
from benchmarks.ladder.figures import draw
from benchmarks.ladder.friction import measure_friction
from benchmarks.ladder.life import measure_life
from benchmarks.ladder.loads import measure_loads, measure_seeds, measure_shaft, measure_statistics
from benchmarks.ladder.measuring import QUICK, Bench, Entry, Rungs, Setting, percent
from benchmarks.ladder.orbit import measure_orbit
from benchmarks.ladder.thrust import measure_thrust
from benchmarks.ladder.wind import measure_wind

LADDER = ROOT / "loadflow" / "data" / "ladder.json"
GAINS = LADDER.with_name("gains.json")
DOC = ROOT / "docs" / "speed-vs-error.md"
BY_QUANTITY = DOC.with_name("errors-by-quantity.md")
WHOLE_RUNS = "<!-- whole runs -->", "<!-- end of whole runs -->"

STAGES: dict[str, Callable[[Bench], Rungs]] = {
    "wind": measure_wind,
    "loads": measure_loads,
    "shaft": measure_shaft,
    "statistics": measure_statistics,
    "seeds": measure_seeds,
    "reduction": measure_reduction,
    "journal": measure_journal,
    "journal, transient": measure_orbit,
    "thrust": measure_thrust,
    "rolling": measure_rolling,
    "life": measure_life,
    "friction": measure_friction,
    "comparison": measure_comparison,
}

KINDS = {"comparison"}
"""Tables whose rows are kinds of bearing, no alternatives: they have no picture."""

GAINING = {
    "journal": {"journal"}, "thrust": {"thrust", "cones"}, "rolling": {"rolling"},
    "friction": {"rolling"},
}  # fmt: skip
"""Stages whose answers have gains, and the bearings whose gains are measured with them."""

HEAD = """# Speed against error

What each model costs, and how far it is from the finest one that is there. `loadflow plan SCENE`
reads the same numbers; what leaving physics out costs beside them, and how models are chosen, says
[accuracy.md](accuracy.md). Start with [whole runs](#whole-runs): what a run gains by better models.
Then comes each stage by itself, in the order of a run. Every quantity with its worst case stands
in [errors by quantity](errors-by-quantity.md). Both pages are written by
`python -m benchmarks.ladder`.

**Relative time** is against the most expensive rung of the stage, measured in the same run; the
seconds hold for one core of one busy machine and are only rough. **Errors** are relative deviations
from the stated reference, the largest of all cases. They say what a coarser model changes, not how
well the finest one fits a real turbine. A rung is **dominated** if another one is cheaper and
nowhere less accurate.

Beside another code, ROSS 3.1, whose film is compiled, a static point with stiffness and damping
takes 1/8 … 1/25 of its time at its coarser meshes and 1/116 … 1/165 at its default (in three of
four bearings), with no larger error of ε, K and C; on tilting pads 1/89 at its coarsest
([table](journal-numerics.md#beside-ross), `python -m benchmarks.peers.ross`).
"""

QUANTITIES_HEAD = """# Errors by quantity

The errors of [speed against error](speed-vs-error.md), quantity by quantity: the largest of all
cases, the 95 % quantile, and the worst case. Of a stiffness it is the norm of the difference of the
matrices over that of the reference; of a slip it is absolute. Written by `python -m
benchmarks.ladder`.
"""

RELATIVE = {"reduction": "film solutions, relative"}


GAINS_HEAD = """## From loads to answers

An error of the load reaches the bearings' answers through their gain, d ln(answer)/d ln(load), at
its largest over the cases above. `loadflow plan` adds up load, reduction and bearing with it.

| bearing | answer | gain |
|---|---|---:|"""


def page(ladder: dict[str, Rungs], gains: dict[str, dict[str, float]]) -> str:
    """The page of rungs, with whole runs and gains."""
    sections = [line for name in ladder for line in _section(name, ladder[name])]
    rows = [
        f"| {room} | {answer} | {gain:.2g} |"
        for room, found in gains.items()
        for answer, gain in found.items()
    ]
    whole = taken_from(DOC, *WHOLE_RUNS)  # another benchmark's
    return "\n".join([HEAD, whole, "", *sections, GAINS_HEAD, *rows, ""])


def _section(stage: str, rungs: Rungs) -> Iterator[str]:
    yield f"## {stage}\n"
    yield f"| rung | includes | {RELATIVE.get(stage, 'relative time')} | seconds | error |"
    yield "|---|---|---:|---:|---|"
    for name, entry in rungs.items():
        yield (
            f"| {name}{_mark(entry)} | {'; '.join(entry['includes'])} "
            f"| {entry['relative_time']:.2g} "
            f"| {_seconds(entry)} | {entry['error']} |"
        )
    measured = {name: entry for name, entry in rungs.items() if entry["errors"]}
    if measured:
        yield from _reference(measured)
    if len(measured) > 1 and stage not in KINDS:
        yield f"\n![error over time of the rungs of the stage {stage}]({_figure(stage)})"
    yield ""


def by_quantity(ladder: dict[str, Rungs]) -> str:
    """The page of every quantity of every rung."""
    sections = [line for name in ladder for line in _quantities(name, ladder[name])]
    return "\n".join([QUANTITIES_HEAD, *sections])


def _quantities(stage: str, rungs: Rungs) -> Iterator[str]:
    measured = {name: entry for name, entry in rungs.items() if entry["errors"]}
    if not measured:
        return
    yield f"## {stage}\n"
    yield "| rung | quantity | largest error | 95 % below | worst case |"
    yield "|---|---|---:|---:|---|"
    for name, entry in measured.items():
        for quantity, error in entry["errors"].items():
            largest, most = percent(error["max"]), percent(error["p95"])
            yield f"| {name} | {quantity} | {largest} | {most} | {error['worst']} |"
    yield ""


def _figure(stage: str) -> str:
    """Path of a stage's picture, from the page."""
    return f"figures/speed-vs-error-{stage.replace(', ', '-')}.svg"


def _draw(ladder: dict[str, Rungs]) -> None:
    for stage, rungs in ladder.items():
        if stage not in KINDS and sum(bool(entry["errors"]) for entry in rungs.values()) > 1:
            draw(stage, rungs, DOC.parent / _figure(stage))


def _seconds(entry: Entry) -> str:
    if "seconds_per_case" in entry:
        return f"{entry['seconds_per_case']:.2g} per 600 s"
    return f"{entry['seconds_per_sample']:.1g} per sample"


def _mark(entry: Entry) -> str:
    return f" (dominated by {entry['dominated_by']})" if "dominated_by" in entry else ""


def _reference(rungs: Rungs) -> Iterator[str]:
    first = next(iter(rungs.values()))
    yield f"\nReference: {first['reference']}.\n"
    others: dict[str, list[str]] = {}
    for name, entry in rungs.items():
        if entry["reference"] != first["reference"]:
            others.setdefault(entry["reference"], []).append(name)
    for reference, names in others.items():
        yield f"Reference of {' and '.join(names)}: {reference}.\n"
    yield f"Cases: {first['cases']}."


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--quick", action="store_true", help="a few short cases; writes nothing")
    only = "stages to measure; the others stay as they are"
    pages = "write the pages from the numbers that are there"
    parser.add_argument("--pages", action="store_true", help=pages)
    parser.add_argument("--only", nargs="+", choices=STAGES, default=list(STAGES), help=only)
    chosen = parser.parse_args()
    if chosen.pages:
        _write_pages(_read(LADDER), _read(GAINS))
        return
    bench = Bench(QUICK if chosen.quick else Setting())
    measured = {}
    for name in chosen.only:
        start = time.perf_counter()
        measured[name] = STAGES[name](bench)
        print(f"{name}: {time.perf_counter() - start:.0f} s")
        for rung, entry in measured[name].items():
            print(f"  {rung}: {entry['relative_time']:.3g} × top, {entry['error']}")
    rooms = set[str]().union(*(GAINING[name] for name in chosen.only if name in GAINING))
    gains = _read(GAINS) | measure_gains(bench, rooms)
    if chosen.quick:
        return
    found = _read(LADDER) | measured
    ordered = {name: found[name] for name in STAGES if name in found}
    _write(LADDER, ordered)
    _write(GAINS, gains)
    _draw(ordered)
    _write_pages(ordered, gains)


def _write_pages(ladder: dict[str, Rungs], gains: dict[str, dict[str, float]]) -> None:
    DOC.write_text(page(ladder, gains), encoding="utf-8")
    BY_QUANTITY.write_text(by_quantity(ladder), encoding="utf-8")


def _read(path: Path) -> dict[str, Any]:
    return json.loads(path.read_text(encoding="utf-8"))


def _write(path: Path, data: dict[str, Any]) -> None:
    path.write_text(json.dumps(data, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
