"""The folder of a run: its parts, and the manifest that says how each number came about."""

from __future__ import annotations

import hashlib
import json
import logging
import platform
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

import loadflow
from loadflow.cube import open_cube
from loadflow.cube.hdf5 import read_groups, read_values, read_whole
from loadflow.errors import InputError, NewerVersionError
from loadflow.planning.effects import EffectVerdict
from loadflow.planning.plan import Plan
from loadflow.running.parts import digest_of, is_sound, save_part, set_aside, unsound
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.schemas import Schema
from loadflow.stages.stage import Stage
from loadflow.storage import number_of, target_of, write_json, write_text

FILES = (
    "scene.toml", "manifest.json", "result.h5", "report.html", "profile.json", "run.log",
    "numbers.json",
)  # fmt: skip
"""What a run, and a comparison of it, writes beside its parts."""


def _refined(manifest: dict[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """Version 1 called the stages whose models were refined ``climbed``."""
    if "climbed" not in manifest:
        return manifest, []
    data = dict(manifest)
    data["refined"] = data.pop("climbed")
    return data, ["climbed is refined today"]


MANIFEST = Schema("manifest", "schema", (_refined,))
"""Form of manifests. 2: ``refined``; 1, or nothing: ``climbed``."""

_KINDS: dict[str, type | tuple[type, ...]] = {
    "wanted": str,
    "refined": list,
    "stages": dict,
    "rungs": dict,
    "cases": list,
    "inputs": dict,
    "versions": dict,
    "seconds": dict,
    "failures": dict,
    "pilot": (dict, type(None)),
    "effects": list,
    "expected_errors": dict,
    "wall_seconds": (int, float),
    "finished": dict,
}

log = logging.getLogger("loadflow.run")


def part_file(folder: Path, stage: str, case: Case | None = None) -> Path:
    """Return the file of a stage, and of a case if the stage runs once for each."""
    return folder / f"{stage}.h5" if case is None else folder / stage / f"{case.name}.h5"


def part_files(folder: Path, stage: Stage, cases: Iterable[Case]) -> list[Path]:
    """Return the files that a stage leaves when it is done."""
    if stage.scope == "run":
        return [part_file(folder, stage.name)]
    return [part_file(folder, stage.name, case) for case in cases]


def open_part(folder: Path, stage: str, case: str) -> Any:
    """Open what a stage found of the case of a name."""
    return open_cube(folder / stage / f"{case}.h5")


def read_part(folder: Path, stage: str, case: str, names: Collection[str]) -> dict[str, xr.Dataset]:
    """Read some variables of what a stage found of a case, by bearing where it keeps them so."""
    return read_groups(folder / stage / f"{case}.h5", names)


Forces = dict[str, np.ndarray]
"""Force on each bearing over axis x, y, z and time, N, in single precision."""

ForceOf = Callable[[str], Forces]
"""From the name of a case to the forces on the bearings in it."""


def forces_of(folder: Path) -> ForceOf:
    """Read the forces on the bearings of each case once, however often they are asked for."""

    @cache
    def force_of(case: str) -> Forces:
        wanted = {"bearing": ("bearing",), "force": ("bearing", "axis", "time")}
        found = read_values(folder / "shaft" / f"{case}.h5", wanted)
        return dict(zip(found["bearing"].tolist(), found["force"]))

    return force_of


def answered(folder: Path, stage: str, cases: Iterable[str]) -> list[str]:
    """Return the names of the cases that the stage has answered."""
    return [case for case in cases if (folder / stage / f"{case}.h5").exists()]


def refinements(folder: Path, scene: Scene) -> list[str]:
    """Return the stages for which this scene has had to take a better model before, in order."""
    manifest = known_manifest(folder)
    return manifest["refined"] if manifest.get("wanted") == scene.digest() else []


def known_verdict(folder: Path, scene: Scene) -> EffectVerdict | None:
    """Return what a pilot of this scene found before; None without one."""
    manifest = known_manifest(folder)
    found = manifest.get("pilot") if manifest.get("wanted") == scene.digest() else None
    return EffectVerdict.from_json(found) if found else None


def read_manifest(folder: Path) -> dict[str, Any]:
    """Return how the numbers of a run came about.

    Raises
    ------
    loadflow.errors.InputError
        There is none, it is damaged, or a newer loadflow wrote it.
    """
    path = folder / "manifest.json"
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise InputError(f"{path}: there is none; `loadflow run` makes it") from error
    except NotADirectoryError as error:
        raise InputError(f"{folder}: is a file; the folder of a run is needed") from error
    except ValueError as error:  # no JSON, or not even text
        raise InputError(f"{path}: damaged ({error}); `loadflow run` makes it anew") from error
    known = isinstance(found, dict)
    if known:
        version = found.pop(MANIFEST.key, 1)
        found = MANIFEST.upgrade(found, version, str(path))
    wrong = [
        key
        for key, kind in _KINDS.items()
        if not known or (key in found and not isinstance(found[key], kind))
    ]
    if wrong:
        raise InputError(
            f"{path}: damaged (bad value of {', '.join(wrong)}); `loadflow run` makes it anew"
        )
    return found | _sizes_of(found)


def _sizes_of(found: Mapping[str, Any]) -> dict[str, Any]:
    """Parts of a manifest that tell sizes by quantity, with the numbers that JSON has not."""
    told: dict[str, Any] = {}
    if "expected_errors" in found:
        told["expected_errors"] = _numbers(found["expected_errors"])
    if found.get("pilot"):
        told["pilot"] = found["pilot"] | {"sizes": _numbers(found["pilot"].get("sizes", {}))}
    if "effects" in found:  # a size of None was not measured
        told["effects"] = [
            {
                key: _numbers(value) if isinstance(value, dict) else value
                for key, value in one.items()
            }
            for one in found["effects"]
            if isinstance(one, dict)
        ]
    return told


def _numbers(part: Any) -> Any:
    known = isinstance(part, dict)
    return {key: _numbers(value) for key, value in part.items()} if known else number_of(part)


def known_manifest(folder: Path) -> dict[str, Any]:
    """What is known of earlier work; parts answer for themselves, so that it may be lost."""
    if not (folder / "manifest.json").exists():
        return {}
    try:
        return read_manifest(folder)
    except NewerVersionError:
        raise
    except InputError as error:
        log.warning("%s", error)
        return {}


def finished_parts(folder: Path, plan: Plan) -> dict[str, int]:
    """Return the number of parts of each stage that a run of this plan would find finished."""
    return {
        step.name: sum(
            path.is_file() and digest_of(path) == step.digest
            for path in part_files(folder, step.stage, plan.cases)
        )
        for step in plan.steps
    }


def save_result(folder: Path, tree: xr.DataTree, plan: Plan) -> None:
    """Write what all stages found, sealed with the fingerprint of the plan."""
    save_part(tree, folder / "result.h5", seal_of_result(step.digest for step in plan.steps))


def seal_of_result(digests: Iterable[str]) -> str:
    """Fingerprint that a result is sealed with, of those of its stages in order."""
    return hashlib.sha256("\n".join(digests).encode()).hexdigest()


def results_of(folder: Path) -> dict[str, xr.Dataset] | None:
    """Tables of a finished run by stage; None where there is none."""
    groups = _result(folder / "result.h5") if (folder / "result.h5").exists() else None
    if groups is None:
        return None
    return {name: node.to_dataset().load() for name, node in groups.items()}


def groups_of_result(folder: Path, stage: str) -> dict[str, xr.Dataset]:
    """What a stage of a finished run found of each bearing, all load cases together."""
    found = _result(folder / "result.h5").get(stage)
    return {} if found is None else {n: p.to_dataset().load() for n, p in found.children.items()}


def _result(path: Path) -> Mapping[str, xr.DataTree]:
    """Groups of a result: read at once where it is what a run wrote, examined first where not."""
    results = read_whole(path) if is_sound(path) else open_cube(path)
    return results.children if isinstance(results, xr.DataTree) else {}


def parts_of(folder: Path, stage: str) -> list[Path]:
    """Return the files of a stage that are there, of whatever load cases and settings."""
    return [*folder.glob(f"{stage}/*.h5"), *folder.glob(f"{stage}.h5")]


def prepare(
    folder: Path,
    scene: Scene,
    plan: Plan,
    refined: list[str],
    overwrite: bool,
    verdict: EffectVerdict | None = None,
) -> dict[str, Any]:
    """Clear the folder of what a run left there that is of no use; return its manifest.

    Nothing is deleted but parts of other settings, if `overwrite` says so, and temporary files of
    runs that were killed. Damaged parts are renamed, and so are done again.

    Raises
    ------
    loadflow.errors.InputError
        Finished parts of other settings, or a symbolic link where a run would write.
    """
    for step in plan.steps:
        _check_own(folder, step.stage)
        if step.stage.scope == "case":
            (folder / step.name).mkdir(exist_ok=True)
        _clear(folder, step.stage, step.digest, plan.cases, overwrite)
    for rest in _left_by_killed(folder, plan):
        rest.unlink()
    manifest = known_manifest(folder)
    manifest.pop("finished", None)  # it is not, until nothing is left to do
    write_text(folder / "scene.toml", plan.scene.to_toml())
    manifest |= {
        MANIFEST.key: MANIFEST.version,
        "wanted": scene.digest(),
        "refined": refined,
        "taken": scene.taken,
        "stages": manifest.get("stages", {}) | {step.name: step.digest for step in plan.steps},
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
    write_json(folder / "manifest.json", manifest)
    return manifest


def _check_own(folder: Path, stage: Stage) -> None:
    """Refuse a link that leads what is written, or deleted, out of the folder."""
    for path in (folder / stage.name, folder / f"{stage.name}.h5"):
        if path.is_symlink():
            raise InputError(f"{path}: a symbolic link; a run writes into its own folder only")


def _clear(
    folder: Path, stage: Stage, digest: str, cases: tuple[Case, ...], overwrite: bool
) -> None:
    """Leave only sound parts of these settings, and what is no part of a run."""
    sealed = {path: digest_of(path) for path in parts_of(folder, stage.name) if path.is_file()}
    others = [path for path, made_with in sealed.items() if made_with not in (digest, None)]
    if others and not overwrite and stage.sample is None:  # a sample is cheap: made anew
        raise InputError(other_parts(folder, stage.name, len(others)))
    for path in others:
        path.unlink()
    wanted = [path for path in part_files(folder, stage, cases) if path not in others]
    for path in unsound(path for path in wanted if path.is_file()):
        kept = set_aside(path)
        log.warning(
            "%s: damaged, or of an older version; it is made again (kept as %s)", path, kept.name
        )


def other_parts(folder: Path, stage: str, count: int, keys: Sequence[str] = ()) -> str:
    """Say that a folder holds parts of other settings, by which keys, and what helps."""
    more = f" and {len(keys) - _TOLD} others" if len(keys) > _TOLD else ""
    told = f" ({', '.join(keys[:_TOLD])}{more})" if keys else ""
    return (
        f"{folder}: holds {count} finished parts of the stage {stage!r} that were made with other "
        f"settings or inputs{told}; give the run another name (--name), or overwrite it "
        "(--overwrite)"
    )


_TOLD = 3  # keys that are named


def _left_by_killed(folder: Path, plan: Plan) -> Iterator[Path]:
    """Temporary files of this run's own, of processes that were killed while they wrote."""
    own: dict[Path, set[str]] = {folder: set(FILES)}
    for step in plan.steps:
        for path in part_files(folder, step.stage, plan.cases):
            own.setdefault(path.parent, set()).add(path.name)
    for place, names in own.items():
        for path in place.glob(".*.loadflow-tmp"):
            if target_of(path.name) in names and path.is_file() and not path.is_symlink():
                yield path


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
    write_json(folder / "manifest.json", manifest)
