"""Numbers of a candidate, kept beside its run: a comparison that was stopped goes on with them."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from loadflow.running.code_stamp import code_stamp
from loadflow.storage import number_of, plain, write_json
from loadflow.studies.candidate.numbers import Finished
from loadflow.studies.candidate.result import Judged, Number
from loadflow.verdict import Verdict

FILE = "numbers.json"

_OF_RUN = ("stages", "rungs", "expected_errors", "effects", "failures", "refined", "taken")
"""What numbers rest on in a manifest, beside the scene; not when a run was made, and how fast."""


def key_of(run: Finished, **beside: Any) -> str:
    """SHA-256 of all that the numbers of a candidate rest on.

    Parameters
    ----------
    run : Finished
        Its run.
    **beside
        What else they rest on, in plain values.
    """
    told = {
        "code": code_stamp(),
        "candidate": (run.name, run.title, run.source),
        "scene": run.scene.digest(),
        "run": {name: run.manifest.get(name) for name in _OF_RUN},
        "beside": beside,
    }
    text = json.dumps(plain(told, infinite=True), sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def keep(run: Finished, key: str, found: Judged) -> None:
    """Write the numbers of a candidate into the folder of its run."""
    told = {"of": key, "found": asdict(found)}
    write_json(run.folder / FILE, told)


def kept(run: Finished, key: str) -> Judged | None:
    """Numbers of a candidate that rest on just this; None without any, or of a damaged file.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from types import SimpleNamespace
    >>> kept(SimpleNamespace(folder=Path(tempfile.mkdtemp())), "") is None
    True
    """
    told = _read(run.folder / FILE)
    if told.get("of") != key:
        return None
    found = dict(told["found"])
    found["numbers"] = {
        name: Number(**_as_kept(Number, one)) for name, one in found["numbers"].items()
    }
    found["verdicts"] = tuple(Verdict(**_as_kept(Verdict, one)) for one in found["verdicts"])
    return Judged(**found)


def _as_kept(kind: type[Number | Verdict], told: Mapping[str, Any]) -> dict[str, Any]:
    """Fields of a number or a verdict, with NaN and infinite numbers in its floats again."""
    floats = {one.name for one in fields(kind) if one.type == "float"}
    return {key: number_of(value) if key in floats else value for key, value in told.items()}


def _read(path: Path) -> Mapping[str, Any]:
    try:
        told = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):  # not there, or damaged: they are found anew
        return {}
    return told if isinstance(told, dict) else {}
