"""Joining what was found case by case."""

from __future__ import annotations

from collections.abc import Mapping

import xarray as xr

from loadflow.scene.cases import Case


def over_cases(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset:
    """Join Datasets along ``case``, labelled by what each case is."""
    plain = [part.drop_vars([c for c in LABELS if c in part.coords]) for part in parts.values()]
    joined = xr.concat(
        plain, "case", combine_attrs="override", coords="minimal", compat="override"
    ).transpose(..., "case")
    cases = list(parts)
    return joined.assign_coords(
        case=("case", [case.name for case in cases]),
        dlc=("case", [case.dlc for case in cases]),
        wind_speed=("case", [case.wind_speed for case in cases], {"units": "m/s"}),
        seed=("case", [case.seed for case in cases]),
        weight=("case", [case.weight for case in cases], {"long_name": "share of lifetime"}),
    )


LABELS = (
    "case", "dlc", "wind_speed", "seed", "weight", "tripped", "file", "file_start", "doubts",
    "standing_share",
)  # fmt: skip
