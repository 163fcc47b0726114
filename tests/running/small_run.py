"""A run of a second, and how two runs are compared to the bit."""

import numpy as np
import xarray as xr
from synthetic import cube_file

from loadflow.scene.scene import make_scene


def small_scene(folder, results=("reduction.histogram",), **keys):
    """Two short load cases, given as a cube in `folder`, and no film or rolling solver."""
    cube = folder / "loads.h5"
    if not cube.exists():
        cube_file(cube, wind_speeds=(8.0, 12.0), seeds=(1,), steps=120)
    data = {"name": "small", "accuracy": "given", "results": [*results]}
    data["loads"] = {"files": [str(cube)]}
    return make_scene(data | keys)


def contents(path):
    """All arrays of a file by name, as bytes."""
    with xr.open_datatree(path, engine="h5netcdf") as tree:
        return {
            f"{node.path}/{name}": (values.shape, str(values.dtype), values.tobytes())
            for node in tree.subtree
            for name, variable in node.to_dataset(inherit=False).variables.items()
            for values in [_fixed(variable.values)]
        }


def _fixed(values):
    values = np.asarray(values)
    return values.astype(str) if values.dtype.kind == "O" else values
