"""Run every hard case and write the tables of docs/hard-cases.md, of cases and of kept draws.

python -m benchmarks.robustness.hard_cases [--tables]
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from typing import Any

from benchmarks.common import ROOT, arguments
from benchmarks.robustness import kept
from loadflow.quantities import percent

HARD = ROOT / "tests" / "hard"
sys.path[:0] = [str(HARD), str(HARD.parent)]  # the cases are those of the tests

import composed_cases  # noqa: E402, F401
import friction_cases  # noqa: E402, F401
import journal_cases  # noqa: E402, F401
import motion_cases  # noqa: E402, F401
import record_cases  # noqa: E402, F401
import rolling_cases  # noqa: E402, F401
from hard_case import CASES, HardCase  # noqa: E402

PAGE = ROOT / "docs" / "hard-cases.md"

FAMILIES = {
    "cylinder": "cylinder",
    "shaped": "arcs, lobes, tilting pads, relief",
    "pads": 'tilting pads, a third each crowned, tilted, on "reduced"',
    "supply": "supply",
    "line": "tilt, moment, bend",
    "shell": "elastic shells",
    "contact": "asperities, half of them tilted",
    "thrust": "thrust: lands and tilting pads",
    "cone": "cones, rings and segments",
    "pair": "pairs of cones, half of them free to tilt",
    "heat": "heat: one temperature of the film, or one of each place",
    "orbit": 'orbits, a third on "reduced"',
    "touching": "asperities that carry a good part of the load",
    "composed": "any parts together, at rest and in motion",
}
"""What the page calls the families of draws."""


def main(cases: bool) -> None:
    """Write the tables of the page; those of the cases only where they are to be solved."""
    page = PAGE.read_text(encoding="utf-8")
    if cases:
        page = put(page, "cases", _cases())
    page = put(page, "families", kept.table(kept.read(), FAMILIES))
    PAGE.write_text(put(page, "draws", _draws()), encoding="utf-8")


def put(page: str, name: str, lines: Iterable[str]) -> str:
    """Return the page with other lines between the marks of a table."""
    begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->"
    before, _, rest = page.partition(begin)
    _, _, after = rest.partition(end)
    return before + begin + "\n".join(lines) + "\n" + end + after


FOUND = {
    "test_reduction_keeps_the_weight_of_the_whole_series": (
        "the largest force of the series was lost where a smaller one at less speed shared its "
        "class; it is kept, but for a class of which one pair is kept"
    ),
    "test_rollers_carry_any_load_or_say_why_not": (
        "an axial load that cylindrical rollers cannot carry passed as balanced where it was below "
        "a millionth of the others, the shaft metres away; it is refused"
    ),
}
"""What the draws of a test brought to light."""


def _cases() -> Iterator[str]:
    for room in dict.fromkeys(case.room for case in CASES):
        yield f"## {room}\n"
        yield "| case | why hard | what we do | result | residual | iterations | others |"
        yield "|---|---|---|---|---:|---:|---|"
        yield from (_row(case) for case in CASES if case.room == room)
        yield ""


def _row(case: HardCase) -> str:
    outcome = case.solve()
    residual = "-" if outcome.residual is None else f"{outcome.residual:.0e}"
    iterations = "-" if outcome.iterations is None else str(outcome.iterations)
    peer = _stored("peers.json").get(str(case), "")
    cells = (case.name, case.why, case.what, outcome.result, residual, iterations, peer)
    return "| " + " | ".join(cells) + " |"


def _draws() -> Iterator[str]:
    yield "| what is drawn | draws | refused by name | failures | found on the way, and now |"
    yield "|---|---:|---:|---:|---|"
    for test, row in _stored("draws.json").items():
        name = test.removeprefix("test_").replace("_", " ")
        refused = percent(row["refused"]) if row["refused"] else "none"
        found = FOUND.get(test, "nothing")
        yield f"| {name} | {row['draws']:,} | {refused} | {row['failing']} | {found} |"


@cache
def _stored(name: str) -> dict[str, Any]:
    return json.loads((HARD / name).read_text(encoding="utf-8"))


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("--tables", action="store_true", help="only those of kept counts")
    main(cases=not parser.parse_args().tables)
