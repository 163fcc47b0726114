"""The load cube on disk: HDF5 in netCDF-4 layout, written whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Literal

import xarray as xr

from loadflow.cube.build import make_cube
from loadflow.cube.hdf5_image import image
from loadflow.cube.parts import Cube
from loadflow.cube.schema import CUBE, FILE_ATTRIBUTES, version_taken
from loadflow.cube.trust import check_hdf5
from loadflow.errors import InputError
from loadflow.storage import check_room, written_whole

ENGINE: Literal["h5netcdf"] = "h5netcdf"
SUFFIXES = (".h5", ".nc")

IN_MEMORY = 512 * 2**20
"""Largest cube, bytes, that is put together in memory and then written in one piece."""


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

    Raises
    ------
    OSError
        The disk is full, or refuses; a file that was there is left as it was.

    Examples
    --------
    >>> import tempfile
    >>> from loadflow.cube import make_case, make_cube, open_cube, save_cube
    >>> data = {"speed": [1.2, 1.3], "hub_force": [[0.0, 0.0]] * 3, "hub_moment": [[0.0, 0.0]] * 3}
    >>> cube = make_cube([make_case([0.0, 0.1], data, dlc="1.1", wind_speed=8.0, seed=1)])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = save_cube(cube, f"{folder}/loads.h5")
    ...     again = open_cube(file).load()
    >>> bool((again["speed"] == cube["speed"]).all())
    True
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with written_whole(path) as temporary:
        write_cube(cube, temporary)
    return path


def write_cube(cube: Cube, path: Path) -> None:
    """Write a cube to a file that nobody reads yet, with the version of its form.

    HDF5 that meets a full disk ends the process, without a message. So a cube is put together in
    memory, and a large one is begun only where there is room for it.

    Raises
    ------
    OSError
        The disk is full, or refuses.
    """
    if cube.nbytes <= IN_MEMORY:
        path.write_bytes(image(cube))
        return
    check_room(path.parent, cube.nbytes)
    if isinstance(cube, xr.DataTree):
        keys: dict[str, Any] = {
            "encoding": {leaf.path: _encoding(leaf.to_dataset()) for leaf in cube.leaves}
        }
        cube = cube.copy()
    else:
        cube = cube.drop_encoding()
        keys = {"encoding": _encoding(cube)}
    cube.attrs = {**cube.attrs, **FILE_ATTRIBUTES}
    cube.to_netcdf(path, engine=ENGINE, **keys)


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
        No such file or folder, nothing in it, a file that is truncated or no HDF5, or one of a
        newer loadflow.

    Examples
    --------
    >>> import tempfile
    >>> from loadflow.cube import make_case, make_cube, open_cube, save_cube
    >>> case = make_case([0.0, 0.1], {"speed": [1.2, 1.3]}, dlc="1.1", wind_speed=8.0, seed=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     cube = open_cube(save_cube(make_cube([case]), f"{folder}/loads.h5"))
    ...     mean = float(cube["speed"].mean())  # the series is read here
    >>> mean, cube["case"].values.tolist()
    (1.25, ['dlc1.1_v8_s1'])
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
    if path.suffix.lower() == ".toml":
        raise InputError(f"{path}: a scene holds no series; they stand in the folder of its run")
    check_hdf5(path)
    try:
        tree = xr.open_datatree(path, engine=ENGINE, chunks=chunks)
        CUBE.check(tree.attrs.get(CUBE.key, 1), str(path))
        cube = (
            tree.map_over_datasets(_labels_loaded)
            if tree.children
            else _labels_loaded(tree.to_dataset())
        )
    except InputError:
        raise
    except Exception as error:  # h5py and h5netcdf raise of nearly every kind on damaged files
        raise InputError(f"{path}: cannot be read as HDF5; a part is damaged ({error})") from error
    version = version_taken(cube.attrs)
    if isinstance(cube, xr.DataTree):
        return cube.map_over_datasets(lambda part: CUBE.upgrade(part, version, str(path)))
    return CUBE.upgrade(cube, version, str(path))


def _order(case: xr.Dataset) -> tuple[str, float, int]:
    """By load case, wind speed and seed; names of files would put 10 m/s before 4 m/s."""
    return tuple(case[c].item() if c in case.coords else 0 for c in ("dlc", "wind_speed", "seed"))  # type: ignore[return-value]


def _labels_loaded(dataset: xr.Dataset) -> xr.Dataset:
    """Load what labels the cases; turn strings read as objects into fixed-width ones, as saved."""
    labels = dataset.coords.to_dataset().load().variables  # together: each would load all others
    strings = {n: c.astype(str) for n, c in labels.items() if c.dtype.kind in "OT"}
    return dataset.assign_coords({**labels, **strings})


def _encoding(dataset: xr.Dataset) -> dict[str, dict[str, Any]]:
    """No fill value: a cube has none, and readers need not look for it."""
    return {
        str(n): {"_FillValue": None} for n, v in dataset.variables.items() if v.dtype.kind == "f"
    }
