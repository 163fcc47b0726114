"""What an earlier start left in the folder of a run, asked before anything is worked out."""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import xarray as xr

from loadflow.cube.hdf5 import read_whole
from loadflow.errors import InputError
from loadflow.planning.plan import Plan, stage_named
from loadflow.running.code_stamp import code_stamp
from loadflow.running.folder import (
    known_manifest,
    other_parts,
    part_files,
    parts_of,
    seal_of_result,
)
from loadflow.running.parts import digest_of, unsound
from loadflow.running.report_state import report_is_current
from loadflow.running.result import Run, run_of
from loadflow.scene.cases import Case, list_cases
from loadflow.scene.messages import written
from loadflow.scene.scene import Scene, make_scene
from loadflow.scene.written import origins
from loadflow.stages.registry import STAGES, giving
from loadflow.storage import write_json


def check_settings(folder: Path, scene: Scene) -> None:
    """Refuse a folder with finished parts of other settings, before a pilot works for minutes.

    Compared are load cases and keys that the scene states, which no plan changes. Parts that differ
    by models or defaults are found by `loadflow.running.folder.prepare`, which has the plan.

    Raises
    ------
    loadflow.errors.InputError
        Naming stage and keys.
    """
    manifest = known_manifest(folder)
    if not manifest or manifest.get("wanted") == scene.digest():
        return
    try:
        told = tomllib.loads((folder / "scene.toml").read_text(encoding="utf-8"))
        before = make_scene(told).model_dump(mode="json")
    except (OSError, ValueError, InputError):  # lost: then `prepare` finds what does not fit
        return
    stated = scene.model_dump(mode="json", exclude_unset=True)
    surely = {"loads", *(giving(result).name for result in scene.results)}
    for name in (one for one in STAGES if one in surely & manifest.get("rungs", {}).keys()):
        stage = STAGES[name]
        keys = [
            key
            for section in stage.sections(scene)
            for key in _changed(stated.get(section), before.get(section), section)
        ]
        if name == "loads" and not keys:
            keys = [*_changed_inputs(list_cases(scene), manifest)]
        if not keys:
            continue
        made_with = manifest["stages"].get(name)
        there = sum(digest_of(path) == made_with for path in parts_of(folder, name))
        if there:
            raise InputError(other_parts(folder, name, there, _as_written(scene, keys)))


def _as_written(scene: Scene, keys: Iterable[str]) -> list[str]:
    """Keys of sections as a scene has them, at the place of the first bearing that has them."""
    places = origins(tomllib.loads(scene.to_toml()))
    return [".".join(map(str, written(key.split("."), places))) for key in keys]


def _changed(stated: Any, before: Any, place: str) -> Iterator[str]:
    """Keys that are stated, and were others; a value that either lacks is none of them.

    Neither is a lubricant of films: a plan that leaves their heat out writes its own viscosity.
    """
    if isinstance(stated, dict) and isinstance(before, dict):
        for key, value in stated.items():
            if key != "lubricant" or place == "friction":
                yield from _changed(value, before.get(key), f"{place}.{key}")
    elif isinstance(stated, list) and isinstance(before, list) and len(stated) == len(before):
        for k, (value, other) in enumerate(zip(stated, before)):
            yield from _changed(value, other, f"{place}[{k}]")
    elif None not in (stated, before) and stated != before:
        yield place


def _changed_inputs(cases: Iterable[Case], manifest: Mapping[str, Any]) -> Iterator[str]:
    """Load files that have another content, or load cases that are not the same."""
    inputs = _inputs(cases)
    known = manifest.get("inputs", {})
    changed = [file for file in inputs if known.get(file, inputs[file]) != inputs[file]]
    if changed:
        yield f"the content of {changed[0]}"
    elif [case.name for case in cases] != manifest.get("cases"):
        yield "the load cases"


def _inputs(cases: Iterable[Case]) -> dict[str, str]:
    return {case.file or case.wind: case.fingerprint for case in cases if case.fingerprint}


def mark_finished(folder: Path, scene: Scene, plan: Plan, manifest: dict[str, Any]) -> None:
    """Record that nothing is left to do, with what a run tells and keeps nowhere else."""
    key = _key(scene, plan.cases, manifest)
    manifest["finished"] = {"of": key, "overloaded": list(plan.overloaded)}
    write_json(folder / "manifest.json", manifest)


def _key(scene: Scene, cases: Iterable[Case], manifest: Mapping[str, Any]) -> str:
    """SHA-256 of all that decides what a run has to do: scene, inputs, code, parts."""
    told = [scene.digest(), code_stamp(), *(f"{case.name}:{case.fingerprint}" for case in cases)]
    told += [f"{name}:{manifest['stages'][name]}" for name in manifest["rungs"]]
    return hashlib.sha256("\n".join(told).encode()).hexdigest()


def finished_run(folder: Path, scene: Scene, report: bool) -> Run | None:
    """The run of a scene, if all of it is there and sound; None where something is left to do."""
    manifest = known_manifest(folder)
    known, result = manifest.get("finished"), folder / "result.h5"
    if not known or manifest.get("failures") or not result.is_file():
        return None
    cases = tuple(list_cases(scene))
    if known["of"] != _key(scene, cases, manifest):
        return None
    digests = {name: manifest["stages"][name] for name in manifest["rungs"]}
    sealed = {
        path: digest
        for name, digest in digests.items()
        for path in part_files(folder, stage_named(name), cases)
    } | {result: seal_of_result(digests.values())}
    if not all(path.is_file() and digest_of(path) == digest for path, digest in sealed.items()):
        return None
    if any(unsound(sealed)) or (report and not report_is_current(folder)):
        return None
    tree = read_whole(result)
    if not isinstance(tree, xr.DataTree):
        return None
    return run_of(folder, scene, tree, {}, manifest.get("shortfalls", ()), known["overloaded"])
