"""Package data: polars, reference tables, speed and error of the rungs.

``ladder.json`` and ``gains.json`` are written by ``python -m benchmarks.ladder``,
``seed_scatter.json`` by ``python -m benchmarks.references.seed_scatter RUN``, ``evidence.json`` by
``python tests/validation/test_tables.py``.
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


@cache
def seed_scatter() -> dict[str, Any]:
    """Return how far answers of the main job scatter with one seed of each wind speed."""
    return _read("seed_scatter.json")


@cache
def evidence() -> dict[str, dict[str, int]]:
    """Return how many numbers of each table of `loadflow validate` are held against what."""
    found: dict[str, dict[str, int]] = _read("evidence.json")
    return found


def _read(name: str) -> Any:
    return json.loads(files(__name__).joinpath(name).read_text(encoding="utf-8"))
