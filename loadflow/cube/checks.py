"""Is this a sound load cube? Every complaint names file, case, variable and index."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from loadflow.cube.parts import Cube, iter_cases, parts
from loadflow.cube.schema import VARIABLES
from loadflow.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator

    import xarray as xr
    from numpy.typing import ArrayLike, NDArray

JITTER = 0.01  # share of the step within which all stamps must lie about the regular grid
BLOCK = 64 * 2**20  # bytes of a cube that are in memory at once
NOISE = 1e-9  # s, of arithmetic


def check_cube(cube: Cube, source: str = "") -> None:
    """Raise unless every case of the cube is complete, finite, regular and in SI units.

    Parameters
    ----------
    cube : xarray.Dataset or xarray.DataTree
        The cube, or one case of it (no dimension ``case``). Series are loaded some cases at a time.
    source : str
        Name of the file, for the messages.

    Raises
    ------
    loadflow.errors.InputError
        Empty cube, missing or wrong units, wrong dimensions, NaN or infinite value, time that
        does not rise in equal steps.

    Examples
    --------
    >>> from loadflow.cube import check_cube, make_case, make_cube
    >>> data = {"speed": [1.2, 1.3], "hub_force": [[0.0, 0.0]] * 3, "hub_moment": [[0.0, 0.0]] * 3}
    >>> check_cube(make_cube([make_case([0.0, 0.1], data, dlc="1.1", wind_speed=8.0, seed=1)]))
    """
    names = set()
    for block in _blocks(cube, source):
        for name, case in iter_cases(block):
            if name in names:
                raise InputError(f"{_where(source, name)}: the cube holds this case twice")
            names.add(name)
            check_case(case, source=source, name=name)
    if not names:
        raise InputError(f"{_where(source)}: the cube is empty, it holds no case")


def _blocks(cube: Cube, source: str) -> Iterator[xr.Dataset]:
    """Yield a cube in pieces of so many cases as are read at once; each reading costs some ms."""
    for part in parts(cube).values():
        count = part.sizes.get("case", 0)
        if count and "case" not in part.coords:
            raise InputError(f"{_where(source)}: coordinate 'case', the names of cases, is missing")
        if not count:
            yield part
            continue
        some = max(1, int(BLOCK * count / max(1, part.nbytes)))
        for start in range(0, count, some):
            block = part.isel(case=slice(start, start + some))
            with suppress(Exception):  # what cannot be read is told with the case that it is of
                block = block.load()
            yield block


def check_case(case: xr.Dataset, source: str = "", name: str = "") -> None:
    """Raise unless one case is sound; see `check_cube`.

    Parameters
    ----------
    case : xarray.Dataset
        Variables over ``time``, scalar coordinates `dlc`, `wind_speed`, `seed`, `weight`.
    source, name : str
        Names of file and case, for the messages.

    Raises
    ------
    loadflow.errors.InputError
        As `check_cube`.

    Examples
    --------
    >>> from loadflow.cube import check_case, make_case
    >>> check_case(make_case([0.0, 0.1], {"speed": [1.2, 1.3]}, dlc="1.1", wind_speed=8.0, seed=1))
    """
    where = _where(source, name)
    missing = [c for c in ("dlc", "wind_speed", "seed") if c not in case.coords]
    if missing:
        raise InputError(f"{where}: coordinate {missing[0]!r} is missing")
    for coord in ("wind_speed", "weight"):
        if coord in case.coords:
            value = float(case.coords[coord])
            if not (np.isfinite(value) and value >= 0):
                raise InputError(f"{where}: {coord} = {value:g} must be finite and ≥ 0")
    if not case.data_vars:
        raise InputError(f"{where}: the case is empty, it holds no variable")
    if "time" not in case.coords:
        raise InputError(f"{where}: coordinate 'time' is missing")
    time = regular_time(case["time"].values, where)[1]
    if time[0] != 0.0:
        raise InputError(f"{where}: time starts at {time[0]:g} s instead of 0")
    for key, array in case.data_vars.items():
        _check_variable(array, str(key), where)


def regular_time(stamps: ArrayLike, where: str = "time") -> tuple[float, NDArray[np.float64]]:
    """Return step and regular stamps of a time axis, with the noise of its stamps removed.

    Stamps may spread about the regular grid by 1 % of the step, or by what their digits cost.

    Parameters
    ----------
    stamps : array_like, shape (n,)
        Time stamps, s.
    where : str
        Start of the messages.

    Returns
    -------
    step : float
        Time step, s.
    time : ndarray, shape (n,)
        Regular stamps from the first one on, s.

    Raises
    ------
    loadflow.errors.InputError
        Fewer than two stamps, a stamp that is not finite or does not rise, unequal steps.

    Examples
    --------
    >>> from loadflow.cube import regular_time
    >>> step, time = regular_time([0.0, 0.0063, 0.0125, 0.0188, 0.025])  # of four decimals
    >>> round(step, 5)
    0.00625
    """
    t = np.asarray(stamps, dtype=float)
    if t.ndim != 1 or t.size < 2:
        raise InputError(f"{where}: a series needs two time steps or more, this one has {t.size}")
    _fail_at(~np.isfinite(t), t, f"{where}, variable 'time'", "is not finite")
    rising = np.diff(t) > 0
    _fail_at(np.r_[False, ~rising], t, f"{where}, variable 'time'", "does not rise")
    step = _regular_step(t)
    if step is None:
        # the first of the oddest steps is where the series was cut, not where a fit first misses
        usual = float(np.median(np.diff(t)))
        odd = np.abs(np.diff(t) - usual)
        i = int(np.argmax(odd > 0.5 * odd.max())) + 1
        raise InputError(
            f"{where}, variable 'time', index {i}: steps are not equal, {t[i - 1]:g} s is followed "
            f"by {t[i]:g} s where the usual step is {usual:g} s; cut it at gaps, and interpolate "
            "steps that vary to equal ones"
        )
    return step, t[0] + step * np.arange(t.size)


def time_step(series: xr.Dataset | xr.DataArray) -> float:
    """Step, s, of a series with an equidistant coordinate ``time``, s, of two samples or more.

    Rounded to a nanosecond, so that series of one nominal step agree.

    Parameters
    ----------
    series : xarray.Dataset or xarray.DataArray
        Over ``time``.

    Returns
    -------
    float
        s.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> from loadflow.cube import time_step
    >>> time_step(xr.DataArray(np.zeros(3), coords={"time": [0.1, 0.2, 0.3]}, dims="time"))
    0.1
    """
    time = series["time"].values
    return round(float(time[1] - time[0]), 9)


def _regular_step(t: NDArray[np.float64]) -> float | None:
    """Shortest decimal number that is the step of all stamps, so that equal nominal steps agree.

    A step that the digits of the stamps can express was not rounded, and gets no allowance.
    """
    digit = _resolution(t)
    count = np.arange(t.size)
    mean = (t[-1] - t[0]) / (t.size - 1)
    for digits in range(1, 16):
        step = float(f"{mean:.{digits}g}")
        rounded = digit > 0 and abs(step / digit - round(step / digit)) > 1e-6
        lost = 1.001 * digit if rounded else 0.0
        drift = abs(step - mean) * (t.size - 1)
        if drift <= lost + NOISE and np.ptp(t - step * count) <= max(lost, JITTER * step):
            return step
    return None


def _resolution(t: NDArray[np.float64]) -> float:
    """Spacing of the numbers the stamps were rounded to: decimal digits or single precision."""
    for digits in range(9):
        if np.allclose(t, np.round(t, digits), rtol=0.0, atol=1e-10):
            return float(10.0**-digits)
    single = t.astype(np.float32)
    if np.array_equal(single, t):
        return float(np.spacing(np.abs(single).max()))
    return 0.0


def _check_variable(array: xr.DataArray, name: str, where: str) -> None:
    where = f"{where}, variable {name!r}"
    units = array.attrs.get("units")
    if units is None:
        raise InputError(f"{where}: attribute 'units' is missing")
    if known := VARIABLES.get(name):
        if units != known.units:
            raise InputError(f"{where}: units are {units!r}, must be {known.units!r}")
        dims = set(known.dims) - {"case"}
        if set(array.dims) != dims:
            raise InputError(
                f"{where}: dimensions are {tuple(array.dims)}, must be {tuple(sorted(dims))}"
            )
    if array.size == 0:
        raise InputError(f"{where}: the variable is empty, shape {array.shape}")
    if array.dtype.kind == "f":
        try:
            values = array.values
        except Exception as error:  # values are read now; h5py raises of nearly every kind
            raise InputError(f"{where}: cannot be read, the file is damaged ({error})") from None
        bad = ~np.isfinite(values)
        if bad.any():
            index = tuple(int(i) for i in np.argwhere(bad)[0])
            at = ", ".join(f"{d} {_label(array, d, i)}" for d, i in zip(array.dims, index))
            raise InputError(
                f"{where}, index ({at}): value {values[index]} is not finite "
                f"({int(bad.sum())} of {bad.size} values)"
            )


def _label(array: xr.DataArray, dim: object, index: int) -> str:
    if dim in ("axis", "bearing") and dim in array.coords:
        return str(array.coords[str(dim)].values[index])
    return str(index)


def _fail_at(bad: NDArray[np.bool_], values: NDArray[np.float64], where: str, what: str) -> None:
    if bad.any():
        i = int(np.argmax(bad))
        raise InputError(f"{where}, index {i}: value {values[i]:g} {what}")


def _where(source: str = "", name: str = "") -> str:
    parts = ([source] if source else []) + ([f"case {name!r}"] if name else [])
    return ", ".join(parts) or "load cube"
