"""Units and meaning on what stages give."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr


def label(units: str, long_name: str) -> dict[str, str]:
    """Attributes of a variable."""
    return {"units": units, "long_name": long_name}


def of_samples(found: Mapping[str, Any], kept: Mapping[str, tuple[str, str]]) -> dict[str, Any]:
    """Variables over ``sample`` of what is `kept`: its units and meaning by name."""
    return {name: ("sample", np.asarray(found[name]), label(*kept[name])) for name in kept}


def labelled(found: Mapping[str, tuple[xr.DataArray, str, str]]) -> xr.Dataset:
    """Dataset of values, each given with its units and meaning."""
    return xr.Dataset(
        {name: value.assign_attrs(label(*about)) for name, (value, *about) in found.items()}
    )


def quantities(rows: Mapping[str, tuple[Any, str, str]], **attrs: str) -> xr.Dataset:
    """Label values of any shape: name → value, units, meaning."""
    variables = {
        name: (
            [f"{name}_{axis}" for axis in range(np.ndim(value))],
            np.asarray(value),
            label(units, meaning),
        )
        for name, (value, units, meaning) in rows.items()
    }
    return xr.Dataset(variables, attrs=attrs)
