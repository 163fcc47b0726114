"""Joining what was found case by case."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import CASE_COORDS
from loadflow.scene.cases import Case
from loadflow.stages.labelling import label


def over_cases(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset:
    """Join Datasets along ``case``, labelled by what each case is."""
    plain = [part.drop_vars([c for c in LABELS if c in part.coords]) for part in parts.values()]
    joined = xr.concat(
        plain, "case", combine_attrs="override", coords="minimal", compat="override"
    ).transpose(..., "case")
    said: dict[str, Any] = {name: [getattr(case, name) for case in parts] for name in SAID}
    coords: dict[str, Any] = {name: ("case", said[name], CASE_COORDS[name].attrs) for name in SAID}
    lengths = np.array([case.duration for case in parts])
    coords["length"] = ("case", lengths, label("s", "length of the load case"))
    return joined.assign_coords(coords | {"case": ("case", [case.name for case in parts])})


SAID = ("dlc", "wind_speed", "seed", "weight")
"""What the cases of a scene say of themselves, with the labels that cubes give it."""


LABELS = (
    "case", "dlc", "wind_speed", "seed", "weight", "tripped", "file", "file_start", "doubts",
    "standing_share",
)  # fmt: skip
