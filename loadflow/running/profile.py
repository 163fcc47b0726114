"""Where the time of a run went: by stage, and how much of it compiled kernels or wrote files."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from loadflow.running.cases import Outcome
from loadflow.storage import write_json

FILE = "profile.json"
"""What a run with a profile leaves in its folder."""

COMPILING = "compiling kernels"
LOAD_CASES = "load cases"
_GROUPS = {
    "loads": "rotor",
    "journal": "films",
    "thrust": "films",
    "rolling": "rolling bearings, rings",
    "friction": "friction",
}
_OF_STAGE = ("seconds", "compiling", "writing", "processor")


@dataclass
class Profile:
    """Adds up what the parts of a run took.

    Attributes
    ----------
    wall : dict
        Seconds by phase of the run, as a clock on the wall shows them.
    stages : dict
        Seconds of all processes by stage of a load case: in all, of it compiling, of it writing;
        and their processor time.
    parts : dict
        Seconds of all processes of what their rooms name, over all stages.
    """

    started: float = field(default_factory=time.perf_counter)
    wall: dict[str, float] = field(default_factory=dict)
    stages: dict[str, dict[str, float]] = field(default_factory=dict)
    parts: dict[str, dict[str, float]] = field(default_factory=dict)

    def add_wall(self, phase: str, seconds: float) -> None:
        """Add to a phase."""
        self.wall[phase] = self.wall.get(phase, 0.0) + seconds

    def add(self, outcome: Outcome) -> None:
        """Add a load case."""
        for stage, seconds in outcome.seconds.items():
            row = self.stages.setdefault(stage, dict.fromkeys(_OF_STAGE, 0.0))
            row["seconds"] += seconds
            row["compiling"] += outcome.compiling[stage]
            row["writing"] += outcome.writing[stage]
            row["processor"] += outcome.processor[stage]
            for part, spent in outcome.parts.get(stage, {}).items():
                known = self.parts.setdefault(stage, {})
                known[part] = known.get(part, 0.0) + spent

    def where(self, workers: int, whole: float) -> dict[str, float]:
        """Seconds of all processes by what they did; together those of the run times `workers`.

        What one process does while the others wait counts for all of them.
        """
        rest = whole - sum(self.wall.values())
        found = {"start-up, plan": workers * rest}
        found |= {phase: workers * s for phase, s in self.wall.items() if phase != LOAD_CASES}
        for stage, row in self.stages.items():
            own = row["seconds"] - row["compiling"] - row["writing"]
            parts = self.parts.get(stage, {})
            group = _GROUPS.get(stage, "other stages of a load case")
            shares = parts | {group: own - sum(parts.values())}
            shares |= {COMPILING: row["compiling"], "files of load cases": row["writing"]}
            for name, seconds in shares.items():
                found[name] = found.get(name, 0.0) + seconds
        if LOAD_CASES in self.wall:
            busy = sum(row["seconds"] for row in self.stages.values())
            found["processes start and wait"] = workers * self.wall[LOAD_CASES] - busy
        return found

    def table(self, workers: int) -> dict[str, Any]:
        """What a reader wants of it, rounded to milliseconds."""
        whole = time.perf_counter() - self.started
        of_cases = sum(row["seconds"] for row in self.stages.values())
        rest = {"start, plan and other": max(0.0, whole - sum(self.wall.values()))}
        return {
            "wall_seconds": round(whole, 3),
            "processes": workers,
            "where": {
                name: {"process_seconds": round(s, 3), "share": round(s / (whole * workers), 4)}
                for name, s in self.where(workers, whole).items()
            },
            "phases": {
                phase: {"wall_seconds": round(s, 3), "share": round(s / whole, 4)}
                for phase, s in (self.wall | rest).items()
            },
            "stages_of_load_cases": {
                stage: {
                    "process_seconds": round(row["seconds"], 3),
                    "processor_seconds": round(row["processor"], 3),
                    "share": round(row["seconds"] / of_cases, 4),
                    "compiling": round(row["compiling"], 3),
                    "writing": round(row["writing"], 3),
                }
                for stage, row in self.stages.items()
            },
        }

    def write(self, path: Path, workers: int) -> None:
        """Write the table as JSON."""
        write_json(path, self.table(workers))
