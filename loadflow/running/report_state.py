"""Whether the report of a run is that of its results; asked without what reads or draws them."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import loadflow
from loadflow.report.mark import mark_of

_WRITTEN_BY = ("report", "plots", "running", "planning", "studies")
"""Rooms whose files decide what the page looks like, besides the files that stand in no room."""

_OF_CLOCK = ("seconds", "wall_seconds", "workers", "finished")
"""Keys of the manifest that another start changes, and no result."""


def report_is_current(folder: Path) -> bool:
    """Whether the report of a run is there, and was made of the results that are there now."""
    try:
        return mark_of(folder / "report.html") == fingerprint(folder)
    except (OSError, ValueError, AttributeError):  # no manifest, or a damaged one: told elsewhere
        return False


def fingerprint(folder: Path) -> str:
    """Fingerprint of results, scene and manifest of a run, and of the code that shows them."""
    found = hashlib.sha256()
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    kept = {key: value for key, value in manifest.items() if key not in _OF_CLOCK}
    found.update(json.dumps(kept, sort_keys=True).encode())
    package = Path(loadflow.__file__).parent
    files = [
        *sorted(package.glob("*")),
        *(path for room in _WRITTEN_BY for path in sorted((package / room).rglob("*"))),
    ]
    code = [path for path in files if path.suffix in {".py", ".html", ".js", ".css"}]
    for path in (folder / "result.h5", folder / "scene.toml", *code):
        if path.is_file():
            found.update(path.read_bytes())
    return found.hexdigest()
