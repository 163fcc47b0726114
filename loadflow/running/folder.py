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
from loadflow.planning.effects import Verdict
from loadflow.planning.plan import Plan
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene


def part_file(folder: Path, stage: str, case: Case | None = None) -> Path:
    """Return the file of a stage, and of a case if the stage runs once for each."""
    return folder / f"{stage}.h5" if case is None else folder / stage / f"{case.name}.h5"


def climbs(folder: Path, scene: Scene) -> list[str]:
    """Return the stages for which this scene has had to take a better model before, in order."""
    manifest = _manifest(folder)
    return manifest["climbed"] if manifest.get("wanted") == scene.digest() else []


def known_verdict(folder: Path, scene: Scene) -> Verdict | None:
    """Return what a pilot of this scene found before; None without one."""
    manifest = _manifest(folder)
    found = manifest.get("pilot") if manifest.get("wanted") == scene.digest() else None
    return Verdict.from_json(found) if found else None


def _manifest(folder: Path) -> dict[str, Any]:
    path = folder / "manifest.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


def finished_parts(folder: Path, plan: Plan) -> dict[str, int]:
    """Return the number of parts of each stage that a run of this plan would find finished."""
    known = _manifest(folder).get("stages", {})
    return {
        step.name: len(_parts(folder, step.name)) if known.get(step.name) == step.digest else 0
        for step in plan.steps
    }


def _parts(folder: Path, stage: str) -> list[Path]:
    return [*folder.glob(f"{stage}/*.h5"), *folder.glob(f"{stage}.h5")]


def prepare(
    folder: Path,
    scene: Scene,
    plan: Plan,
    climbed: list[str],
    overwrite: bool,
    verdict: Verdict | None = None,
) -> dict[str, Any]:
    """Make the folder, or check that what is in it belongs to these settings."""
    folder.mkdir(parents=True, exist_ok=True)
    manifest = _manifest(folder)
    digests = {step.name: step.digest for step in plan.steps}
    known = manifest.get("stages", {})
    samples = {step.name for step in plan.steps if step.stage.sample}  # cheap: made anew
    for name, digest in digests.items():
        parts = _parts(folder, name)
        if not parts or known.get(name) == digest:
            continue
        if not overwrite and name not in samples:
            raise InputError(
                f"{folder}: holds {len(parts)} finished parts of the stage {name!r} that were made "
                "with other settings or inputs; give the run another name, or overwrite it"
            )
        for part in parts:
            part.unlink()
    for rest in folder.rglob(".*.tmp"):
        rest.unlink()
    replace_text(folder / "scene.toml", plan.scene.to_toml())
    manifest |= {
        "wanted": scene.digest(),
        "climbed": climbed,
        "stages": known | digests,
        "rungs": {
            step.name: {"rung": step.rung, "error": step.error or "not measured"}
            | {"reason": plan.reasons.get(step.name, "")}
            for step in plan.steps
        },
        "expected_errors": {
            result: {name: "not measured" if e is None else e for name, e in errors.items()}
            for result, errors in plan.errors.items()
        },
        "accurate": plan.accurate,
        "shortfalls": plan.shortfalls,
        "effects": [vars(effect) for effect in plan.effects],
        "pilot": verdict.to_json() if verdict else None,
        "inputs": {c.file or c.wind: c.fingerprint for c in plan.cases if c.fingerprint},
        "cases": [case.name for case in plan.cases],
        "versions": {"python": platform.python_version(), "loadflow": loadflow.__version__}
        | {name: metadata.version(name) for name in ("numpy", "scipy", "numba", "xarray")},
    }
    replace_text(folder / "manifest.json", json.dumps(manifest, indent=1))
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
