"""Cubes and parts of a run as HDF5 in netCDF-4 layout, put together by the shortest way.

A campaign writes several small files for each load case, and xarray's engine takes longer for each
than the case takes to compute. What is written here, every reader of netCDF-4 files reads.
"""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from typing import Any

import h5py
import xarray as xr
from xarray.conventions import encode_cf_variable, encode_dataset_coordinates

from loadflow.cube.parts import Cube
from loadflow.cube.schema import FILE_ATTRIBUTES

_BARE = "This is a netCDF dimension but not a netCDF variable."
"""What netCDF calls a dimension that has no values of its own, before its size."""


def image(cube: Cube) -> bytes:
    """Return a cube, or what a stage found, as the bytes of a file.

    Parameters
    ----------
    cube : xarray.Dataset or xarray.DataTree
        What is kept, with the version of its form.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.cube import make_case, make_cube, open_cube
    >>> case = make_case([0.0, 0.1], {"speed": [1.2, 1.3]}, dlc="1.1", wind_speed=8.0, seed=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "loads.h5"
    ...     _ = path.write_bytes(image(make_cube([case])))
    ...     open_cube(path)["speed"].values.tolist()
    [[1.2, 1.3]]
    """
    stream = BytesIO()
    with h5py.File(stream, "w", track_order=True) as file:
        if isinstance(cube, xr.DataTree):
            _write_node(file, cube, {})
        else:
            _write(file, cube, {})
        file.attrs.update(FILE_ATTRIBUTES)
    return stream.getvalue()


def _write_node(group: h5py.Group, node: xr.DataTree, above: Mapping[str, h5py.Dataset]) -> None:
    scales = _write(group, node.to_dataset(inherit=False), above)
    for name, child in node.children.items():
        _write_node(group.create_group(name, track_order=True), child, scales)


def _write(
    group: h5py.Group, data: xr.Dataset, above: Mapping[str, h5py.Dataset]
) -> dict[str, h5py.Dataset]:
    """Write variables and attributes; return the scales of the dimensions known here."""
    encoded, attrs = encode_dataset_coordinates(data.drop_encoding())
    kept = {str(name): _kept(group, str(name), one) for name, one in encoded.items()}
    scales = dict(above)
    for dim, size in data.sizes.items():
        name = str(dim)
        if name in kept:
            scales[name] = kept[name]
            scales[name].make_scale(name)
        elif name not in above or above[name].size != size:
            scales[name] = group.create_dataset(name, shape=(size,), dtype=">f4")
            scales[name].make_scale(f"{_BARE} {size:10d}")
    for name, one in encoded.items():
        if str(name) not in data.sizes:
            for k, dim in enumerate(one.dims):
                kept[str(name)].dims[k].attach_scale(scales[str(dim)])
    group.attrs.update(attrs)
    return scales


def _kept(group: h5py.Group, name: str, variable: Any) -> h5py.Dataset:
    found = encode_cf_variable(variable, name=name)
    values, attrs = found.to_numpy(), {k: v for k, v in found.attrs.items() if k != "_FillValue"}
    if values.dtype.kind in "OUT":
        values = values.astype(object)
        kept = group.create_dataset(name, data=values, dtype=h5py.string_dtype())
    else:
        kept = group.create_dataset(name, data=values)
    for key, value in attrs.items():
        kept.attrs[key] = value
    return kept
