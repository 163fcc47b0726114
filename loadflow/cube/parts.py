"""What a cube consists of: cubes of one length and step, and their cases."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr

from loadflow.cube.schema import case_name
from loadflow.errors import InputError

Cube = xr.Dataset | xr.DataTree
"""Cases of one length and step are a Dataset; several such cubes are kept in a DataTree."""


def iter_cases(cube: Cube) -> Iterator[tuple[str, xr.Dataset]]:
    """Yield name and Dataset(time) of every case, without loading the series.

    Parameters
    ----------
    cube : xarray.Dataset or xarray.DataTree
        A cube, or a single case.

    Yields
    ------
    name : str
    case : xarray.Dataset
        The case with scalar coordinates.

    Examples
    --------
    >>> from loadflow.cube import iter_cases, make_case, make_cube
    >>> data = {"speed": [1.2, 1.3], "hub_force": [[0.0, 0.0]] * 3, "hub_moment": [[0.0, 0.0]] * 3}
    >>> cube = make_cube([make_case([0.0, 0.1], data, dlc="1.1", wind_speed=8.0, seed=1)])
    >>> [name for name, case in iter_cases(cube)]
    ['dlc1.1_v8_s1']
    """
    for part in parts(cube).values():
        if "case" not in part.dims:
            one = label_case(part)
            yield str(one["case"].values), one
            continue
        for i in range(part.sizes["case"]):
            case = part.isel(case=i)
            yield str(case["case"].values), case


def case_named(cube: Cube, name: str) -> xr.Dataset:
    """Return one case of a cube, without loading its series or looking at the others.

    Parameters
    ----------
    cube : xarray.Dataset or xarray.DataTree
        The cube.
    name : str
        Of the case.

    Returns
    -------
    xarray.Dataset
        The case.

    Raises
    ------
    loadflow.errors.InputError
        The cube has no such case.

    Examples
    --------
    >>> from loadflow.cube import case_named, make_case, make_cube
    >>> data = {"speed": [1.2, 1.3], "hub_force": [[0.0, 0.0]] * 3, "hub_moment": [[0.0, 0.0]] * 3}
    >>> cube = make_cube([make_case([0.0, 0.1], data, dlc="1.1", wind_speed=8.0, seed=1)])
    >>> case_named(cube, "dlc1.1_v8_s1").sizes["time"]
    2
    """
    for part in parts(cube).values():
        if "case" not in part.dims:
            if str((one := label_case(part))["case"].values) == name:
                return one
        elif (found := np.flatnonzero(part["case"].values == name)).size:
            return part.isel(case=int(found[0]))
    raise InputError(f"the cube has no load case {name!r}")


def parts(cube: Cube) -> dict[str, xr.Dataset]:
    """Cubes of one length and step each."""
    if isinstance(cube, xr.Dataset):
        return {"": cube}
    return {leaf.path: leaf.to_dataset() for leaf in cube.leaves if leaf.has_data}


def label_case(case: xr.Dataset) -> xr.Dataset:
    """Return the case with its name as the coordinate ``case``."""
    if "case" in case.coords:
        return case
    missing = [c for c in ("dlc", "wind_speed", "seed") if c not in case.coords]
    if missing:
        raise InputError(
            f"a load case lacks the coordinate {missing[0]!r}; those of a load cube have dlc, "
            "wind_speed and seed, as loadflow.cube.make_case sets them"
        )
    dlc, wind_speed, seed = (case.coords[c].item() for c in ("dlc", "wind_speed", "seed"))
    return case.assign_coords(case=case_name(dlc, wind_speed, seed))
