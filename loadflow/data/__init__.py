"""Package data: polars, reference tables, speed and error of the rungs.

``ladder.json`` and ``gains.json`` are written by ``python -m benchmarks.ladder``.
"""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files
from typing import Any


@cache
def ladder() -> dict[str, Any]:
    """Return measured cost and error of every rung, by table and rung."""
    return _read("ladder.json")


@cache
def gains() -> dict[str, dict[str, float]]:
    """Return d ln(answer)/d ln(load) of what users read of each bearing, at its largest."""
    return _read("gains.json")


def _read(name: str) -> Any:
    return json.loads(files(__name__).joinpath(name).read_text(encoding="utf-8"))
