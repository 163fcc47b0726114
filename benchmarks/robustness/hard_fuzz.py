"""Draw 10,000 cases of every solver: writes tests/hard/draws.json.

python -m benchmarks.robustness.hard_fuzz [--seed N] [TEST …]

TEST is part of the name of a test of tests/hard/test_fuzz*.py; what is not asked for keeps its old
row. The draws follow from a seed. With a seed of its own, which was not drawn yet, the counts are
added to those that are kept. A quarter of an hour on one core.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import time
from typing import Any

from benchmarks.common import ROOT, arguments

HARD = ROOT / "tests" / "hard"
DRAWS = HARD / "draws.json"
SEED = 8

DRAWN = re.compile(r"(\d+) passing, (\d+) failing, and (\d+) invalid")
UNANSWERED = re.compile(r"([\d.]+)%, no answer")


def draw(file: str, test: str, seed: int = SEED) -> dict[str, Any]:
    """Run one test at length: draws, failures, share without an answer, seconds."""
    begin = time.perf_counter()
    command = [sys.executable, "-m", "pytest", "-n0", "-q", "-W", "ignore::UserWarning"]
    options = [f"--hypothesis-seed={seed}", "--hypothesis-show-statistics"]
    done = subprocess.run(
        [*command, *options, f"{HARD / file}::{test}"],
        capture_output=True,
        text=True,
        env=os.environ | {"HYPOTHESIS_PROFILE": "long"},
    )
    found = DRAWN.search(done.stdout)
    if found is None:
        raise SystemExit(done.stdout + done.stderr)
    passing, failing, _ = map(int, found.groups())
    share = UNANSWERED.search(done.stdout)
    if failing:
        print(done.stdout)
    return {
        "seeds": [seed],
        "draws": passing,
        "failing": failing,
        "refused": float(share.group(1)) / 100 if share else 0.0,
        "seconds": round(time.perf_counter() - begin),
    }


def joined(kept: dict[str, Any], more: dict[str, Any]) -> dict[str, Any]:
    """Return the counts of two runs with seeds of their own as those of one.

    Raises
    ------
    ValueError
        A seed is in both: the same draws would count twice.
    """
    if twice := set(kept["seeds"]) & set(more["seeds"]):
        raise ValueError(f"seeds {sorted(twice)} were drawn before")
    sums = {name: kept[name] + more[name] for name in ("seeds", "draws", "failing", "seconds")}
    parts = [row["refused"] * row["draws"] for row in (kept, more)]
    return sums | {"refused": sum(parts) / sums["draws"]}


def main(asked: list[str], seed: int | None) -> None:
    """Draw, and keep the counts."""
    rows = json.loads(DRAWS.read_text(encoding="utf-8")) if DRAWS.exists() else {}
    for path in sorted(HARD.glob("test_fuzz*.py")):
        for test in re.findall(r"^def (test_\w+)", path.read_text(encoding="utf-8"), re.MULTILINE):
            if asked and not any(part in test for part in asked):
                continue
            if seed is not None and seed in rows[test]["seeds"]:
                sys.exit(f"{test}: seed {seed} was drawn before")
            found = draw(path.name, test, SEED if seed is None else seed)
            rows[test] = found if seed is None else joined(rows[test], found)
            print(test, rows[test], flush=True)
            DRAWS.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("tests", nargs="*", metavar="TEST")
    parser.add_argument("--seed", type=int, help="another seed, whose draws are added")
    options = parser.parse_args()
    main(options.tests, options.seed)
