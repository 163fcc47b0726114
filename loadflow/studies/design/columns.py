"""Designs → columns of numbers and words, as parts on disk hold them, and back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np

from loadflow.studies.design.point import NUMBERS, DesignPoint


def to_columns(points: list[DesignPoint]) -> dict[str, np.ndarray]:
    """Numbers and words of designs by name."""
    numbers = {
        name: np.array([one.numbers.get(name, math.nan) for one in points], float)
        for name in NUMBERS
    }
    words = {
        one.name: np.array([getattr(point, one.name) for point in points], str)
        for one in fields(DesignPoint)
        if one.name != "numbers"
    }
    return numbers | words


def from_columns(columns: Mapping[str, Any]) -> list[DesignPoint]:
    """The inverse of `to_columns`."""
    words = [one.name for one in fields(DesignPoint) if one.name != "numbers"]
    count = len(columns["why"])
    return [
        DesignPoint(
            {} if columns["why"][k] else {name: float(columns[name][k]) for name in NUMBERS},
            **{word: str(columns[word][k]) for word in words},
        )
        for k in range(count)
    ]
