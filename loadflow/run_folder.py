"""The folder of a run: its parts, and the manifest that says how each number came about."""

from __future__ import annotations

import json
import os
import platform
from importlib import metadata
from pathlib import Path
from typing import Any

import loadflow
from loadflow.errors import InputError
from loadflow.plan import Plan, Stage
from loadflow.scene import Scene
from loadflow.stages.cases import Case


def part_file(folder: Path, stage: Stage, case: Case | None = None) -> Path:
    """Return the file of a stage, and of a case if the stage runs once for each."""
    return folder / f"{stage.name}.h5" if case is None else folder / stage.name / f"{case.name}.h5"


def prepare(folder: Path, scene: Scene, plan: Plan, overwrite: bool) -> dict[str, Any]:
    """Make the folder, or check that what is in it belongs to these settings."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "manifest.json"
    manifest = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    digests = {step.stage.name: step.digest for step in plan.steps}
    known = manifest.get("stages", {})
    for name, digest in digests.items():
        parts = [*folder.glob(f"{name}/*.h5"), *folder.glob(f"{name}.h5")]
        if not parts or known.get(name) == digest:
            continue
        if not overwrite:
            raise InputError(
                f"{folder}: holds {len(parts)} finished parts of the stage {name!r} that were made "
                "with other settings or inputs; give the run another name, or overwrite it"
            )
        for part in parts:
            part.unlink()
    for rest in folder.rglob(".*.tmp"):
        rest.unlink()
    (folder / "scene.toml").write_text(scene.to_toml(), encoding="utf-8")
    manifest |= {
        "stages": known | digests,
        "rungs": {
            step.stage.name: {"rung": step.rung, "error": step.error or "not measured"}
            for step in plan.steps
        },
        "inputs": {case.file: case.fingerprint for case in plan.cases if case.file},
        "cases": [case.name for case in plan.cases],
        "versions": {"python": platform.python_version(), "loadflow": loadflow.__version__}
        | {name: metadata.version(name) for name in ("numpy", "scipy", "numba", "xarray")},
    }
    replace_text(path, json.dumps(manifest, indent=1))
    return manifest


def record(
    folder: Path,
    manifest: dict[str, Any],
    timing: dict[str, float],
    failures: dict[str, str],
    workers: int,
    wall: float,
) -> None:
    """Record what it took; a run that is taken up again adds to what it took before."""
    before = manifest.get("seconds", {})
    spent = {k: round(before.get(k, 0.0) + timing.get(k, 0.0), 3) for k in before | timing}
    manifest |= {
        "seconds": spent,
        "wall_seconds": round(manifest.get("wall_seconds", 0.0) + wall, 3),
        "workers": workers,
        "failures": failures,
    }
    replace_text(folder / "manifest.json", json.dumps(manifest, indent=1))


def replace_text(path: Path, text: str) -> None:
    """Write a text file whole or not at all."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    temporary.write_text(text, encoding="utf-8")
    os.replace(temporary, path)
