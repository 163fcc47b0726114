"""Run every hard case and write docs/hard-cases.md: python benchmarks/hard_cases.py."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests" / "hard"))

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
`python benchmarks/hard_cases.py`.
"""


def main() -> None:
    """Write the page."""
    (ROOT / "docs" / "hard-cases.md").write_text("\n".join(_page()) + "\n", encoding="utf-8")


def _page() -> Iterator[str]:
    yield HEAD
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
    cells = (case.name, case.why, case.what, outcome.result, residual, iterations, case.peer)
    return "| " + " | ".join(cells) + " |"


if __name__ == "__main__":
    main()
