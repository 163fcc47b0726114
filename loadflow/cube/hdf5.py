"""HDF5 files of our own, read by the shortest way: some variables, or all at once.

These files are sealed, or were examined when they were opened; here nothing is checked again.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import xarray as xr

from loadflow.cube.parts import Cube
from loadflow.cube.schema import CUBE, version_taken
from loadflow.errors import InputError


def read_variables(path: Path, names: Collection[str], group: str = "") -> xr.Dataset:
    """Read some variables of a file and nothing else: a tenth of the time that opening it takes.

    Parameters
    ----------
    path : pathlib.Path
        File as `loadflow.cube.save_cube` or a run writes it.
    names : collection of str
        Of the variables; those that the file lacks are passed over.
    group : str, optional
        Group that holds them.

    Returns
    -------
    xarray.Dataset
        In memory, with the coordinates of their dimensions and the attributes of the group.

    Raises
    ------
    loadflow.errors.InputError
        No such group, or no file that HDF5 can read.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.cube import make_case, make_cube, save_cube
    >>> case = make_case([0.0, 0.1], {"speed": [1.2, 1.3]}, dlc="1.1", wind_speed=8.0, seed=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = save_cube(make_cube([case]), Path(folder) / "loads.h5")
    ...     read_variables(path, ["speed"])["speed"].dims
    ('case', 'time')
    """
    with _opened(path) as file:
        return _some(file[group or "/"], names)


def read_values(path: Path, wanted: Mapping[str, Sequence[str]]) -> dict[str, np.ndarray]:
    """Read bare values of a file, without labels and attributes: a third of `read_variables`.

    Parameters
    ----------
    path : pathlib.Path
        File as `loadflow.cube.save_cube` or a run writes it.
    wanted : mapping of str to sequence of str
        Dimensions of each variable, in the order in which they are asked for.

    Returns
    -------
    dict of ndarray
        By variable.

    Raises
    ------
    loadflow.errors.InputError
        A variable is missing, or has other dimensions; no file that HDF5 can read.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.cube import make_case, make_cube, save_cube
    >>> case = make_case([0.0, 0.1], {"speed": [1.2, 1.3]}, dlc="1.1", wind_speed=8.0, seed=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = save_cube(make_cube([case]), Path(folder) / "loads.h5")
    ...     read_values(path, {"speed": ("time", "case")})["speed"].tolist()
    [[1.2], [1.3]]
    """
    with _opened(path) as file:
        known = _by_address(file)
        return {name: _ordered(file[name], dims, known) for name, dims in wanted.items()}


def _ordered(part: h5py.Dataset, dims: Sequence[str], known: Mapping[int, str]) -> np.ndarray:
    """Values of a variable by dimensions in a given order."""
    order = [_dims(part, known).index(dim) for dim in dims]
    return _values(part).transpose(order)


def read_groups(path: Path, names: Collection[str]) -> dict[str, xr.Dataset]:
    """Read some variables of every group of a file, or of the file itself where it has none.

    Parameters
    ----------
    path, names
        As of `read_variables`.

    Returns
    -------
    dict of xarray.Dataset
        By group, in order of creation where it is kept; by ``""`` what stands in none.

    Raises
    ------
    loadflow.errors.InputError
        No file that HDF5 can read.
    """
    with _opened(path) as file:
        inside = {name: part for name, part in file.items() if isinstance(part, h5py.Group)}
        return {name: _some(part, names) for name, part in (inside or {"": file}).items()}


def _some(inside: h5py.Group, names: Collection[str]) -> xr.Dataset:
    known = _by_address(inside)
    found = {name: _variable(inside[name], known) for name in names if name in inside}
    wanted = {dim for variable in found.values() for dim in variable.dims}
    scales = {dim: inside[dim] for dim in wanted if dim in inside}
    coords = {dim: _variable(scale, known) for dim, scale in scales.items() if not _is_bare(scale)}
    return xr.Dataset({**coords, **found}, attrs=_attributes(inside)).set_coords([*coords])


def read_whole(path: Path) -> Cube:
    """Read all of a file into memory: a quarter of the time that xarray's engine takes.

    Parameters
    ----------
    path : pathlib.Path
        File as `loadflow.cube.save_cube` or a run writes it.

    Returns
    -------
    xarray.Dataset or xarray.DataTree
        What `loadflow.cube.open_cube` gives, loaded.

    Raises
    ------
    loadflow.errors.InputError
        No file that HDF5 can read, or one of a newer loadflow.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.cube import make_case, make_cube, save_cube
    >>> case = make_case([0.0, 0.1], {"speed": [1.2, 1.3]}, dlc="1.1", wind_speed=8.0, seed=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = save_cube(make_cube([case]), Path(folder) / "loads.h5")
    ...     read_whole(path)["speed"].values.tolist()
    [[1.2, 1.3]]
    """
    with _opened(path) as file:
        groups = dict(_groups("/", file))
    version = version_taken(groups["/"].attrs)
    groups = {name: CUBE.upgrade(part, version, str(path)) for name, part in groups.items()}
    return groups["/"] if len(groups) == 1 else xr.DataTree.from_dict(groups)


@contextmanager
def _opened(path: Path) -> Iterator[h5py.File]:
    """A file to read; what HDF5 says of it becomes an `InputError` with its name."""
    try:
        with h5py.File(path, "r") as file:
            yield file
    except (OSError, KeyError, RuntimeError, ValueError) as error:
        raise InputError(f"{path}: cannot be read as HDF5 ({error})") from error


def _attributes(group: h5py.Group) -> dict[str, Any]:
    """Attributes of a group that are not the file's own."""
    return {key: _told(group.attrs[key]) for key in group.attrs if key[0] != "_"}


def _groups(name: str, group: h5py.Group) -> Iterator[tuple[str, xr.Dataset]]:
    """Yield a group and those within it, by path."""
    found, inside, known = {}, [], _by_address(group)
    for key, part in group.items():
        if isinstance(part, h5py.Group):
            inside.append((f"{name}{key}/", part))
        elif not _is_bare(part):
            found[key] = _variable(part, known)
    attrs = _attributes(group)
    labels = set(found).intersection(dim for one in found.values() for dim in one.dims)
    for one in (attrs, *(variable.attrs for variable in found.values())):
        labels.update(str(one.pop("coordinates", "")).split())
    found = {key: one.astype(str) if one.dtype.kind in "OT" else one for key, one in found.items()}
    yield name, xr.Dataset(found, attrs=attrs).set_coords([key for key in found if key in labels])
    for path, part in inside:
        yield from _groups(path, part)


_INTERNAL = {"DIMENSION_LIST", "CLASS", "NAME", "REFERENCE_LIST", "_FillValue"}


def _by_address(group: h5py.Group) -> dict[int, str]:
    """Names of what stands in a group by where it lies in the file.

    A dimension is found through a reference, and to ask HDF5 for the name of what it leads to takes
    longer than to read the values.
    """
    return {h5py.h5o.get_info(group.id, name.encode()).addr: name for name in group}


def _dims(part: h5py.Dataset, known: Mapping[int, str]) -> list[str]:
    scales = [part] if part.is_scale else [attached[0] for attached in part.dims]
    return [
        known.get(h5py.h5o.get_info(scale.id).addr) or scale.name.rsplit("/", 1)[-1]
        for scale in scales
    ]


def _values(part: h5py.Dataset) -> Any:
    return part.asstr()[()] if h5py.check_string_dtype(part.dtype) else part[()]


def _variable(part: h5py.Dataset, known: Mapping[int, str]) -> xr.Variable:
    values, told = _values(part), part.attrs
    attrs = {
        key: _told(told[key])
        for key in told
        if key not in _INTERNAL and not key.startswith("_Netcdf4")
    }
    if attrs.get("dtype") == "bool":  # HDF5 has no such kind
        values = values.astype(attrs.pop("dtype"))
    return xr.Variable(_dims(part, known), values, attrs)


def _is_bare(part: h5py.Dataset) -> bool:
    """Whether a dimension has no values of its own."""
    return part.is_scale and b"not a netCDF variable" in np.bytes_(part.attrs.get("NAME", b""))


def _told(value: Any) -> Any:
    """An attribute as xarray gives it."""
    if isinstance(value, bytes):
        return value.decode()
    if isinstance(value, np.ndarray) and value.dtype.kind == "O" and value.size != 1:
        return value.tolist()
    return value.item() if isinstance(value, np.ndarray | np.generic) and value.size == 1 else value
