"""Tables of where the time of a run went, for its page and for the command line."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from loadflow.report import Section, Table
from loadflow.running.profile import FILE


def profile_tables(folder: Path) -> Iterator[Table]:
    """Time of all processes by what they did, of the run by phase, of load cases by stage.

    Nothing where the run was made without a profile.
    """
    if not (folder / FILE).is_file():
        return
    found = json.loads((folder / FILE).read_text(encoding="utf-8"))
    where = sorted(found["where"].items(), key=lambda item: -item[1]["share"])
    yield Table("All processes", ["what", *_TIME], [_timed(*one) for one in where])
    yield Table("Phases", ["phase", *_TIME], [_timed(*one) for one in found["phases"].items()])
    more = ("processor", "compiling", "writing")
    heads = ["stage, all processes", *_TIME, *(f"{name}, s" for name in more)]
    keys = ("processor_seconds", "compiling", "writing")
    stages = found["stages_of_load_cases"].items()
    rows = [[*_timed(name, row), *(f"{row[key]:.1f}" for key in keys)] for name, row in stages]
    yield Table("Load cases", heads, rows)


def profile_section(folder: Path) -> Iterator[Section]:
    """A section of the page; none where the run was made without a profile."""
    tables = [*profile_tables(folder)]
    if tables:
        text = "Of the last start of the run. Stages that were done before count 0."
        yield Section("Where the time went", text, tables=tables)


_TIME = ("time, s", "share")


def _timed(name: str, row: Mapping[str, Any]) -> list[str]:
    seconds = row["process_seconds"] if "process_seconds" in row else row["wall_seconds"]
    return [name, f"{seconds:.1f}", f"{100 * row['share']:.0f} %"]
