"""Run every hard case and write docs/hard-cases.md: python -m benchmarks.robustness.hard_cases."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from functools import cache
from typing import Any

from benchmarks.common import ROOT, arguments

HARD = ROOT / "tests" / "hard"
sys.path.insert(0, str(HARD))  # the cases are those of the tests

import friction_cases  # noqa: E402, F401
import journal_cases  # noqa: E402, F401
import motion_cases  # noqa: E402, F401
import record_cases  # noqa: E402, F401
import rolling_cases  # noqa: E402, F401
from hard_case import CASES, HardCase  # noqa: E402

HEAD = """# Hard cases

Where solvers of this kind usually fail, and what this one does. Each row is a test
(`tests/hard/`): it converges with the stated residual, or is refused by an error that names what is
wrong with numbers; none hangs, none gives a silent NaN. The residual is the worst of the row's
loads, scaled as each solver states; iterations likewise. Written by
`python -m benchmarks.robustness.hard_cases`.

The last column is what other packages do with the same case, where they can express it, with their
versions: their answer, their error or their warning, as `python -m benchmarks.peers.hard_peers` got
it (`tests/hard/peers.json`). ROSS is asked for the plain bearing under load (`PlainJournal`, 20 x 8
elements, a pad of 359°) or for the pressure at a given position (`FluidFlow`).
"""


def main() -> None:
    """Write the page."""
    (ROOT / "docs" / "hard-cases.md").write_text("\n".join(_page()) + "\n", encoding="utf-8")


RULE = """## When an iteration has an answer

One rule for every solver (`loadflow.numerics.convergence`): films at rest and in time, pads,
shells, `reduced`, rigid and flexible rings, shaft on bearings. A residual is a sum of terms that
nearly cancel: below some roundings of its largest terms nothing can bring it. A residual is
small that is within its tolerance or at that level; an answer is a state of small residual whose
last step was short enough, or as short as rounding lets a step be. What fails it is refused with
both numbers, "residual … after … steps, where rounding allows …". Of 285 loads between 1e-12 and
1e12 N, all laws, 48 were refused before the rule, most of them light; 19 are now, all with So >
7e4, whose films are thinner than the last digit of the position.

`.ci/other_processor` runs the numerical tests with kernels compiled for a plain processor
(`NUMBA_CPU_NAME=generic`) beside an old instruction set of the BLAS
(`OPENBLAS_CORETYPE=Prescott`). Results have the same bits on one processor. On another they move
by (largest difference over the largest magnitude of a variable, `python -m
benchmarks.robustness.reproducibility`):

| results | moved by |
|---|---:|
| journal bearing at rest: laws, lobes, pads, supply, tilt, shell; with K and C | 1.5e-11 |
| journal bearing in time, 200 steps: `grid`, `reduced`, `map` | 7.5e-13 |
| four-point bearing, 1 N to 1 MN | 6.5e-16 |
| rotor: steady state, and 30 s with control | 5.7e-8 |

## Journal bearings drawn at random

`python -m benchmarks.robustness.families` draws every family over So 1e-3 … 300, B/D 0.1 … 4 and
all laws (ranges and seeds stand in it). "No answer there" is an error that says why there is none:
the shaft meets the bore with the load not yet carried, a groove runs dry. For 13 of them, tilts
that are held and fixed bores, this was checked by the winding number of the force around all
positions next to contact. Not solved yet: soft shells on cells longer than the bearing is wide,
some pads, orbits at So > 80.

| family | draws | answered | no answer there | not found | other errors |
|---|---:|---:|---:|---:|---:|
| cylinder | 300 | 300 | 0 | 0 | 0 |
| arcs, lobes, tilting pads, relief | 300 | 285 | 5 | 10 | 0 |
| tilt, moment, bend | 300 | 211 | 79 | 10 | 0 |
| supply | 150 | 146 | 3 | 1 | 0 |
| elastic shells | 60 | 43 | 8 | 9 | 0 |
"""

DRAWN = """## Random draws

Every solver over its whole documented range of inputs, drawn at random; each draw gives an answer
that holds the laws of its test (converged, finite, within its bounds, in balance) or an error that
names what is wrong. Counts of the last long run (`python -m benchmarks.robustness.hard_fuzz`,
`tests/hard/draws.json`); the test suite draws a sample.

| what is drawn | draws | refused by name | failures | found on the way, and now |
|---|---:|---:|---:|---|"""

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


def _page() -> Iterator[str]:
    yield HEAD
    for room in dict.fromkeys(case.room for case in CASES):
        yield f"## {room}\n"
        yield "| case | why hard | what we do | result | residual | iterations | others |"
        yield "|---|---|---|---|---:|---:|---|"
        yield from (_row(case) for case in CASES if case.room == room)
        yield ""
    yield RULE
    yield DRAWN
    yield from _draws()


def _row(case: HardCase) -> str:
    outcome = case.solve()
    residual = "-" if outcome.residual is None else f"{outcome.residual:.0e}"
    iterations = "-" if outcome.iterations is None else str(outcome.iterations)
    peer = _stored("peers.json").get(str(case), "")
    cells = (case.name, case.why, case.what, outcome.result, residual, iterations, peer)
    return "| " + " | ".join(cells) + " |"


def _draws() -> Iterator[str]:
    for test, row in _stored("draws.json").items():
        name = test.removeprefix("test_").replace("_", " ")
        refused = f"{100 * row['refused']:.2g} %" if row["refused"] else "none"
        found = FOUND.get(test, "nothing")
        yield f"| {name} | {row['draws']:,} | {refused} | {row['failing']} | {found} |"


@cache
def _stored(name: str) -> dict[str, Any]:
    return json.loads((HARD / name).read_text(encoding="utf-8"))


if __name__ == "__main__":
    arguments(__doc__).parse_args()
    main()
