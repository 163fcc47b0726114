"""Counts of draws that add up over several runs: which numbers were drawn, and what came of them.

`tests/hard/families.json` holds them by family as ranges of numbers, each with the state of the
package it was drawn with; `python -m benchmarks.robustness.families --keep` goes on where a family
ends, and writes after every block, so that a run may be ended at any time. Of a draw that raised
what must not be, number and error are kept, too: `--first NUMBER --draws 1 --show` repeats it.
"""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from benchmarks.common import ROOT
from loadflow.storage import written_whole

FILE = ROOT / "tests" / "hard" / "families.json"
OUTCOMES = ("answered", "reason", "unfound", "late", "raw")
"""What may come of a draw; each is one of them."""

BLOCK = 25
"""Draws between two writes."""

Ranges = list[dict[str, Any]]


def read(path: Path = FILE) -> dict[str, Ranges]:
    """Ranges by family."""
    if not path.exists():
        return {}
    kept: dict[str, Ranges] = json.loads(path.read_text(encoding="utf-8"))
    return kept


def write(kept: dict[str, Ranges], path: Path = FILE) -> None:
    """Write the ranges, whole or not at all."""
    with written_whole(path) as place:
        place.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")


def state() -> str:
    """The commit that is drawn with; "-dirty" if anything but the counts has changed since."""
    git = ["git", "-C", str(ROOT)]
    name = [*git, "describe", "--always", "--exclude=*"]
    changed = [*git, "diff", "--quiet", "HEAD", "--", ".", f":!{FILE.relative_to(ROOT)}"]
    commit = subprocess.run(name, check=True, capture_output=True, text=True).stdout.strip()
    return commit + ("-dirty" if subprocess.run(changed, check=False).returncode else "")


def next_number(ranges: Ranges) -> int:
    """First number that was not drawn."""
    return max((part["first"] + part["draws"] for part in ranges), default=0)


def added(ranges: Ranges, first: int, of: str, counts: dict[str, Any]) -> Ranges:
    """Return the ranges with a block of draws from `first` on.

    A block that goes on where the last one of the same state and cap ends is one range with it.
    """
    block = {"first": first, "draws": counts["draws"], "state": of, "cap": counts["cap"]}
    block |= {name: counts[name] for name in OUTCOMES}
    missing = counts["draws"] - sum(block[name] for name in OUTCOMES)
    if missing or first < next_number(ranges):
        raise ValueError(f"draws from {first} on: {missing} without an outcome, or drawn before")
    if raised := counts.get("raised"):
        block["raised"] = raised
    if ranges and _goes_on(ranges[-1], block):
        last = ranges[-1]
        sums = {name: last[name] + block[name] for name in ("draws", *OUTCOMES)}
        known = {"raised": [*last.get("raised", []), *raised]} if raised else {}
        return [*ranges[:-1], last | sums | known]
    return [*ranges, block]


def _goes_on(last: dict[str, Any], block: dict[str, Any]) -> bool:
    same = all(last[name] == block[name] for name in ("state", "cap"))
    return bool(same and last["first"] + last["draws"] == block["first"])


def keep(
    family: str, draws: int, run: Callable[[range], dict[str, Any]], path: Path = FILE
) -> dict[str, int]:
    """Go on with a family for some draws, and add what comes of them, block by block.

    Parameters
    ----------
    family : str
    draws : int
    run : callable
        Takes the numbers of a block; returns its counts.
    path : Path
        Of the kept counts.
    """
    of, ranges = state(), read(path).get(family, [])
    first = next_number(ranges)
    end = first + draws
    while first < end:
        numbers = range(first, min(first + BLOCK, end))
        counts = run(numbers)
        everything = read(path)  # another process may have drawn another family
        ranges = added(everything.get(family, []), first, of, counts)
        write(everything | {family: ranges}, path)
        first = numbers.stop
    return totals(ranges)


def totals(ranges: Ranges) -> dict[str, int]:
    """Sums over all ranges."""
    return {name: sum(part[name] for part in ranges) for name in ("draws", *OUTCOMES)}


def table(kept: dict[str, Ranges], titles: dict[str, str]) -> Iterator[str]:
    """Lines of the table of a page: each family, and its ranges where it has several."""
    yield "| family | numbers | draws | answered | no answer there | not found | late | others |"
    yield "|---|---|---:|---:|---:|---:|---:|---:|"
    for family, ranges in kept.items():
        for title, part in _rows(titles[family], ranges):
            cells = (title, part["numbers"], *(part[name] for name in ("draws", *OUTCOMES)))
            yield "| " + " | ".join(map(str, cells)) + " |"


def _rows(title: str, ranges: Ranges) -> Iterator[tuple[str, dict[str, Any]]]:
    for part in ranges:
        last = part["first"] + part["draws"] - 1
        yield title, part | {"numbers": f"{part['first']} … {last}"}
    if len(ranges) > 1:
        yield f"{title}, all", totals(ranges) | {"numbers": f"{len(ranges)} ranges"}
