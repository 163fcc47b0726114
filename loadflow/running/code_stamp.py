"""What tells whether the code of the package has changed."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path

import loadflow

_CODE = {".py", ".html", ".js", ".css"}


@cache
def code_stamp() -> str:
    """SHA-256 of names and text of all files of the package that are code, those of pages too."""
    root = Path(loadflow.__file__).parent
    told = hashlib.sha256()
    for file in sorted(path for path in root.rglob("*") if path.suffix in _CODE):
        told.update(f"\n{file.relative_to(root).as_posix()}\n".encode())
        told.update(file.read_bytes())
    return told.hexdigest()
