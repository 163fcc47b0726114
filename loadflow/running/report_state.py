"""Whether the report of a run is that of its results; asked without what reads or draws them."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from loadflow.report.mark import mark_of
from loadflow.running.code_stamp import code_stamp

_OF_CLOCK = ("seconds", "wall_seconds", "workers", "finished")
"""Keys of the manifest that another start changes, and no result."""


def report_is_current(folder: Path) -> bool:
    """Whether the report of a run is there, and was made of the results that are there now."""
    try:
        return mark_of(folder / "report.html") == fingerprint(folder)
    except (OSError, ValueError, AttributeError):  # no manifest, or a damaged one: told elsewhere
        return False


def fingerprint(folder: Path) -> str:
    """Fingerprint of results, scene and manifest of a run, and of the code."""
    found = hashlib.sha256(code_stamp().encode())
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    kept = {key: value for key, value in manifest.items() if key not in _OF_CLOCK}
    found.update(json.dumps(kept, sort_keys=True).encode())
    for path in (folder / "result.h5", folder / "scene.toml"):
        if path.is_file():
            found.update(path.read_bytes())
    return found.hexdigest()
