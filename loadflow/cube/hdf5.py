"""HDF5 files are looked at before they are read: a damaged one may ask for any amount of memory."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import xarray as xr

from loadflow.errors import InputError
from loadflow.storage import check_content

PACKED = 1100
"""Largest ratio of values to stored bytes: deflate does not pack more densely than 1032 : 1."""
REFERENCE = np.dtype([("length", "<u4"), ("heap", "<u8"), ("index", "<u4")])
"""How HDF5 keeps a text of any length: the text itself lies in a heap."""
SMALL = 2**20
"""Bytes of a dataset that nobody minds."""


def check_hdf5(path: Path) -> None:
    """Raise unless a file is HDF5 that can hold the values it declares.

    Parameters
    ----------
    path : pathlib.Path
        File.

    Raises
    ------
    loadflow.errors.InputError
        Empty, truncated, of another kind, a damaged part, or a dataset that is larger than the file
        could hold; the message names file and dataset.
    """
    size = path.stat().st_size
    if size == 0:
        raise InputError(f"{path}: cannot be read as HDF5; the file is empty")
    check_content(path)
    try:
        with h5py.File(path, "r") as file:
            found = [*_attributes("/", file)]
            file.visititems(lambda name, part: found.extend(_parts(name, part)))
    except Exception as error:  # h5py raises of nearly every kind on damaged files
        raise InputError(
            f"{path}: cannot be read as HDF5; empty, truncated or of another kind ({error})"
        ) from None
    for name, declared, room in found:
        if declared > max(SMALL, min(room, PACKED * size)):
            raise InputError(
                f"{path}, {name}: says it holds {declared / 1e6:.4g} MB, but the file of "
                f"{size / 1e6:.4g} MB has room for {min(room, PACKED * size) / 1e6:.4g} MB of it"
            )


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
    try:
        with h5py.File(path, "r") as file:
            inside = file[group or "/"]
            found = {name: _variable(inside[name]) for name in names if name in inside}
            wanted = {dim for variable in found.values() for dim in variable.dims}
            coords = {
                dim: _variable(inside[dim])
                for dim in wanted
                if dim in inside and not _is_bare(inside[dim])
            }
            told = {key: _told(value) for key, value in inside.attrs.items() if key[0] != "_"}
    except (OSError, KeyError, RuntimeError, ValueError) as error:
        raise InputError(f"{path}: cannot be read as HDF5 ({error})") from error
    return xr.Dataset({**coords, **found}, attrs=told).set_coords([*coords])


def groups_of(path: Path) -> list[str]:
    """Names of the groups of a file, in order of creation where it is kept.

    Raises
    ------
    loadflow.errors.InputError
        No file that HDF5 can read.
    """
    try:
        with h5py.File(path, "r") as file:
            return [name for name, part in file.items() if isinstance(part, h5py.Group)]
    except (OSError, RuntimeError) as error:
        raise InputError(f"{path}: cannot be read as HDF5 ({error})") from error


_INTERNAL = {"DIMENSION_LIST", "CLASS", "NAME", "REFERENCE_LIST", "_FillValue"}


def _variable(part: h5py.Dataset) -> xr.Variable:
    dims = [part.name] if part.is_scale else [scales[0].name for scales in part.dims]
    dims = [dim.rsplit("/", 1)[-1] for dim in dims]
    values = part.asstr()[()] if h5py.check_string_dtype(part.dtype) else part[()]
    attrs = {
        key: _told(value)
        for key, value in part.attrs.items()
        if key not in _INTERNAL and not key.startswith("_Netcdf4")
    }
    return xr.Variable(dims, values, attrs)


def _is_bare(part: h5py.Dataset) -> bool:
    """Whether a dimension has no values of its own."""
    return b"not a netCDF variable" in np.bytes_(part.attrs.get("NAME", b""))


def _told(value: Any) -> Any:
    """An attribute as xarray gives it."""
    if isinstance(value, bytes):
        return value.decode()
    return value.item() if isinstance(value, np.ndarray | np.generic) and value.size == 1 else value


Part = tuple[str, int, int]
"""Name, bytes that it says it holds, and bytes that can be stored for it."""


def _parts(name: str, part: h5py.Group | h5py.Dataset) -> Iterator[Part]:
    """Yield a dataset and the attributes of whatever it is."""
    yield from _attributes(name, part)
    if isinstance(part, h5py.Dataset):
        stored = part.id.get_storage_size()
        packed = part.chunks is not None and part.id.get_create_plist().get_nfilters() > 0
        size = Path(part.file.filename).stat().st_size
        yield name, part.nbytes, PACKED * stored if packed else min(stored, size)
        text = h5py.check_string_dtype(part.dtype)
        if text is not None and text.length is None and part.id.get_offset() is not None:
            yield f"{name}, longest text", _longest_text(part), size


def _longest_text(part: h5py.Dataset) -> int:
    """Length that texts of any length claim: HDF5 takes memory for it before it looks further."""
    with Path(part.file.filename).open("rb") as file:
        file.seek(part.id.get_offset())
        raw = file.read(part.id.get_storage_size())
    references = np.frombuffer(raw, REFERENCE, count=len(raw) // REFERENCE.itemsize)
    return int(references["length"].max(initial=0))


def _attributes(name: str, part: h5py.Group | h5py.Dataset) -> Iterator[Part]:
    """Yield the attributes of a part; they are never packed."""
    size = Path(part.file.filename).stat().st_size
    for key in part.attrs:
        attribute = h5py.h5a.open(part.id, key.encode())
        declared = int(np.prod(attribute.shape, dtype=float)) * attribute.dtype.itemsize
        yield f"{name}, attribute {key}", declared, size
