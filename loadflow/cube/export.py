"""A load cube as a table for other programs: CSV, Parquet, MATLAB."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from loadflow.cube.parts import Cube, iter_cases
from loadflow.cube.schema import CASE_COORDS
from loadflow.errors import InputError

if TYPE_CHECKING:
    import pandas as pd

EXPORTS = (".csv", ".parquet", ".mat")


def export_cube(cube: Cube, path: str | os.PathLike[str]) -> Path:
    """Write a cube as CSV, Parquet or MATLAB file, as the ending of its name says.

    CSV and Parquet hold one row for each case and time, with what the case is (``case``, ``dlc``,
    ``wind_speed``, ``seed``, ``weight``) and a column for each component, such as ``hub_force.x``;
    units are SI, a line of comments (CSV) or the metadata ``units`` (Parquet) states them. A MATLAB
    file has one structure for each case, with its variables in the dimensions of the cube, and a
    structure ``units``.

    Parameters
    ----------
    cube : xarray.Dataset or xarray.DataTree
        A cube.
    path : path
        File to write: ``.csv``, ``.parquet`` (needs the extra ``parquet``) or ``.mat``. It appears
        under its name when it is complete.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    loadflow.errors.InputError
        Another ending, no case, or pyarrow is missing.

    Examples
    --------
    >>> import tempfile
    >>> from loadflow.cube import export_cube, make_case, make_cube
    >>> data = {"speed": [1.2, 1.3], "hub_force": [[0.0, 0.0]] * 3, "hub_moment": [[0.0, 0.0]] * 3}
    >>> cube = make_cube([make_case([0.0, 0.1], data, dlc="1.1", wind_speed=8.0, seed=1)])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     lines = export_cube(cube, f"{folder}/loads.csv").read_text().splitlines()
    >>> lines[-1].split(",")[:5]
    ['dlc1.1_v8_s1', '1.1', '8.0', '1', '1.0']
    """
    path = Path(path)
    writers = {".csv": _write_csv, ".parquet": _write_parquet, ".mat": _write_matlab}
    if path.suffix not in writers:
        raise InputError(f"{path}: ending {path.suffix!r}; allowed: {', '.join(EXPORTS)}")
    cases = list(iter_cases(cube))
    if not cases:
        raise InputError(f"{path}: the load cube is empty, it holds no case")
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.stem}.{os.getpid()}.tmp{path.suffix}")
    try:
        writers[path.suffix](cases, temporary)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)
    return path


Cases = list[tuple[str, xr.Dataset]]


def _write_csv(cases: Cases, path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as stream:
        for k, (name, case) in enumerate(cases):
            table = _table(name, case)
            if k == 0:
                units = ", ".join(f"{n} {u}" for n, u in _units(case).items())
                stream.write(f"# units: {units}\n")
            table.to_csv(stream, index=False, header=k == 0)


def _write_parquet(cases: Cases, path: Path) -> None:
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError:
        raise InputError("writing Parquet needs pyarrow: pip install 'loadflow[parquet]'") from None
    units = ", ".join(f"{n} {u}" for n, u in _units(cases[0][1]).items())
    writer: Any = None
    try:
        for name, case in cases:
            table = pa.Table.from_pandas(_table(name, case), preserve_index=False)
            table = table.replace_schema_metadata({**(table.schema.metadata or {}), "units": units})
            writer = writer or pq.ParquetWriter(path, table.schema)
            writer.write_table(table)
    finally:
        if writer is not None:
            writer.close()


def _write_matlab(cases: Cases, path: Path) -> None:
    from scipy.io import savemat

    content: dict[str, Any] = {"units": _matlab_names(_variable_units(cases[0][1]))}
    for name, case in cases:
        values = {str(n): v.values for n, v in case.data_vars.items()}
        values["time"] = case["time"].values
        values |= {c: case[c].item() for c in CASE_COORDS if c in case.coords}
        content |= _matlab_names({name: _matlab_names(values)})
    savemat(path, content, do_compression=True, long_field_names=True, oned_as="row")


def _table(name: str, case: xr.Dataset) -> pd.DataFrame:
    """One row for each time."""
    import pandas as pd

    case = case.load()
    head = {c: case[c].item() for c in CASE_COORDS if c in case.coords}
    columns: dict[str, Any] = {"case": name, **head, "time": case["time"].values}
    columns |= dict(_columns(case))
    return pd.DataFrame(columns)


def _columns(case: xr.Dataset) -> Iterator[tuple[str, np.ndarray]]:
    """Yield name and values (time,) of every component."""
    for name, data in case.data_vars.items():
        if "time" not in data.dims:
            continue
        rest = [d for d in data.dims if d != "time"]
        values = data.transpose(*rest, "time").values
        for place in np.ndindex(values.shape[:-1]):
            labels = [str(data[d].values[i]) for d, i in zip(rest, place)]
            yield ".".join([str(name), *labels]), values[place]


def _variable_units(case: xr.Dataset) -> dict[str, str]:
    found = {str(n): str(v.attrs.get("units", "")) for n, v in case.data_vars.items()}
    return {"time": "s"} | found


def _units(case: xr.Dataset) -> dict[str, str]:
    by_variable = _variable_units(case)
    return {"time": "s"} | {n: by_variable[n.split(".")[0]] for n, _ in _columns(case)}


def _matlab_names(values: dict[str, Any]) -> dict[str, Any]:
    """Names that MATLAB takes: letters, digits and underscores, a letter first."""
    return {re.sub(r"^(?=[^A-Za-z])", "x", re.sub(r"\W", "_", k)): v for k, v in values.items()}
