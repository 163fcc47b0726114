"""Joining what was found case by case."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr

from loadflow.cube import CASE_COORDS
from loadflow.scene.cases import Case


def over_cases(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset:
    """Join Datasets along ``case``, labelled by what each case is."""
    plain = [part.drop_vars([c for c in LABELS if c in part.coords]) for part in parts.values()]
    joined = xr.concat(
        plain, "case", combine_attrs="override", coords="minimal", compat="override"
    ).transpose(..., "case")
    said = {name: [getattr(case, name) for case in parts] for name in SAID}
    coords = {name: ("case", said[name], CASE_COORDS[name].attrs) for name in SAID}
    return joined.assign_coords(coords | {"case": ("case", [case.name for case in parts])})


SAID = ("dlc", "wind_speed", "seed", "weight")
"""What the cases of a scene say of themselves, with the labels that cubes give it."""


LABELS = (
    "case", "dlc", "wind_speed", "seed", "weight", "tripped", "file", "file_start", "doubts",
    "standing_share",
)  # fmt: skip
