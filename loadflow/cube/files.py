"""The load cube on disk: HDF5 in netCDF-4 layout, written whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Literal

import xarray as xr

from loadflow.cube.build import Cube, make_cube
from loadflow.cube.hdf5 import check_hdf5
from loadflow.errors import InputError

ENGINE: Literal["h5netcdf"] = "h5netcdf"
SUFFIXES = (".h5", ".nc")


def save_cube(cube: Cube, path: str | os.PathLike[str]) -> Path:
    """Write a cube, or one case, to a file.

    The file appears under its name only when it is complete: it is written under a temporary
    name beside it and renamed. Types are kept, so that what is read back is what was saved.

    Parameters
    ----------
    cube : xarray.Dataset or xarray.DataTree
        What to write.
    path : path
        File to write; an existing one is replaced. Folders are made.

    Returns
    -------
    pathlib.Path
        The file.
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        if isinstance(cube, xr.DataTree):
            encoding = {leaf.path: _encoding(leaf.to_dataset()) for leaf in cube.leaves}
            cube.to_netcdf(temporary, engine=ENGINE, encoding=encoding)
        else:
            cube.drop_encoding().to_netcdf(temporary, engine=ENGINE, encoding=_encoding(cube))
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)
    return path


def open_cube(path: str | os.PathLike[str], chunks: Any = None) -> Cube:
    """Open a cube without loading its series.

    Parameters
    ----------
    path : path
        A file written by `save_cube`, or a folder with one file for each case, as a run leaves
        them. The cases of a folder are loaded when they are joined.
    chunks : int, dict or "auto", optional
        Open as dask arrays of these chunks (needs the extra ``dask``). Without it, values are
        read from the file when they are used.

    Returns
    -------
    xarray.Dataset or xarray.DataTree
        The cube, as it was saved.

    Raises
    ------
    loadflow.errors.InputError
        No such file or folder, nothing in it, or a file that is truncated or no HDF5.
    """
    path = Path(path)
    if chunks is not None:
        _need_dask()
    if path.is_dir():
        files = sorted(p for p in path.iterdir() if p.suffix in SUFFIXES)
        if not files:
            raise InputError(f"{path}: the folder holds no case ({' or '.join(SUFFIXES)} files)")
        cases = []
        for file in files:
            case = _open(file, None)
            if isinstance(case, xr.DataTree) or "case" in case.dims:
                raise InputError(f"{file}: a whole cube among the files of single cases")
            cases.append(case)
        cube = make_cube(sorted(cases, key=_order))
        if chunks is None:
            return cube
        if isinstance(cube, xr.DataTree):
            return cube.map_over_datasets(_in_chunks, chunks)
        return _in_chunks(cube, chunks)
    if not path.is_file():
        raise InputError(f"{path}: no such load cube, neither file nor folder")
    return _open(path, chunks)


def _in_chunks(dataset: xr.Dataset, chunks: Any) -> xr.Dataset:
    """Chunk the series; the labels of the cases stay in memory."""
    return dataset.chunk(chunks).assign_coords(dataset.coords)


def _need_dask() -> None:
    try:
        import dask  # noqa: F401
    except ImportError:
        raise InputError("chunks= needs dask: pip install 'loadflow[dask]'") from None


def _open(path: Path, chunks: Any) -> Cube:
    check_hdf5(path)
    try:
        tree = xr.open_datatree(path, engine=ENGINE, chunks=chunks)
        if tree.children:
            return tree.map_over_datasets(_labels_loaded)
        return _labels_loaded(tree.to_dataset())
    except Exception as error:  # h5py and h5netcdf raise of nearly every kind on damaged files
        raise InputError(f"{path}: cannot be read as HDF5; a part is damaged ({error})") from error


def _order(case: xr.Dataset) -> tuple[str, float, int]:
    """By load case, wind speed and seed; names of files would put 10 m/s before 4 m/s."""
    return tuple(case[c].item() if c in case.coords else 0 for c in ("dlc", "wind_speed", "seed"))  # type: ignore[return-value]


def _labels_loaded(dataset: xr.Dataset) -> xr.Dataset:
    """Load what labels the cases; turn strings read as objects into fixed-width ones, as saved."""
    labels = {n: c.compute() for n, c in dataset.coords.items()}
    strings = {n: c.astype(str) for n, c in labels.items() if c.dtype.kind in "OT"}
    return dataset.assign_coords(labels | strings)


def _encoding(dataset: xr.Dataset) -> dict[str, dict[str, Any]]:
    """No fill value: a cube has none, and readers need not look for it."""
    return {
        str(n): {"_FillValue": None} for n, v in dataset.variables.items() if v.dtype.kind == "f"
    }
