"""Putting cases together into a cube, and taking them out again."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from loadflow.cube.checks import check_case, regular_time
from loadflow.cube.parts import Cube, label_case, parts
from loadflow.cube.schema import AXES, CASE_COORDS, TIME, VARIABLES
from loadflow.errors import InputError


def make_case(
    time: ArrayLike,
    data: Mapping[str, ArrayLike],
    *,
    dlc: str,
    wind_speed: float,
    seed: int,
    weight: float | None = None,
    **varied: Any,
) -> xr.Dataset:
    """Label the plain arrays of one load case with names, units and meaning.

    Parameters
    ----------
    time : array_like, shape (n,)
        Time from 0, equidistant, s.
    data : mapping of str to array_like
        Variables of `VARIABLES`: (n,), or (3, n) with x, y, z first. Their dtype is kept.
    dlc : str
        Design load case.
    wind_speed : float
        Mean wind speed, m/s.
    seed : int
        Seed of the turbulence.
    weight : float, optional
        Share of the lifetime; `make_cube` gives equal shares where no case states one.
    **varied
        Other scalars that tell the cases apart, kept as coordinates.

    Returns
    -------
    xarray.Dataset
        Variables over ``time``, with the rest as scalar coordinates.

    Examples
    --------
    >>> make_case([0, 1], {"speed": [1.2, 1.2]}, dlc="1.1", wind_speed=12, seed=1).speed.units
    'rad/s'
    """
    scalars: dict[str, Any] = {"dlc": str(dlc), "wind_speed": float(wind_speed), "seed": int(seed)}
    scalars |= varied if weight is None else {"weight": float(weight), **varied}
    coords = {name: ((), value, _attrs(name)) for name, value in scalars.items()}
    return make_series(time, data).assign_coords(coords)


def make_series(time: ArrayLike, data: Mapping[str, ArrayLike]) -> xr.Dataset:
    """Label plain arrays over time, without saying which case they are; see `make_case`.

    Parameters
    ----------
    time : array_like, shape (n,)
        Time from 0, equidistant, s.
    data : mapping of str to array_like
        Variables of `VARIABLES`: (n,), or (3, n) with x, y, z first. Their dtype is kept.

    Returns
    -------
    xarray.Dataset
        Variables over ``time``.

    Raises
    ------
    loadflow.errors.InputError
        A variable that is not known, or does not have its shape.

    Examples
    --------
    >>> from loadflow.cube import make_series
    >>> series = make_series([0.0, 0.1, 0.2], {"speed": [1.2, 1.2, 1.3]})
    >>> series["speed"].attrs["units"]
    'rad/s'
    """
    arrays, count = {}, np.size(time)
    for name, values in data.items():
        if name not in VARIABLES or "bearing" in VARIABLES[name].dims:
            known = [k for k, v in VARIABLES.items() if "bearing" not in v.dims]
            raise InputError(f"unknown variable {name!r} of a load case; known are {known}")
        dims = [d for d in VARIABLES[name].dims if d != "case"]
        given = np.asarray(values)
        asked = tuple(len(AXES) if d == "axis" else count for d in dims)
        if all(d in ("axis", "time") for d in dims) and given.shape != asked:
            raise InputError(f"{name}: must have the shape {asked}, got {given.shape}")
        arrays[name] = (dims, given, VARIABLES[name].attrs)
    coords: dict[str, Any] = {"time": ("time", np.asarray(time, dtype=float), TIME.attrs)}
    if any("axis" in dims for dims, _, _ in arrays.values()):
        coords["axis"] = list(AXES)
    return xr.Dataset(arrays, coords)


def make_cube(cases: Sequence[xr.Dataset]) -> Cube:
    """Join cases into a cube.

    Parameters
    ----------
    cases : sequence of xarray.Dataset
        Each with dimension ``time`` and scalar coordinates `dlc`, `wind_speed`, `seed` and
        `weight`; see `make_case`. A scalar coordinate ``case`` overrides the name.

    Returns
    -------
    xarray.Dataset or xarray.DataTree
        One Dataset over ``case`` and ``time`` where all cases have the same number of steps and
        the same step, else a DataTree with one such cube for each, named like ``t600_dt0.025``.

    Raises
    ------
    loadflow.errors.InputError
        No case, a case that is not sound, two cases of one name, or different variables.

    Examples
    --------
    >>> from loadflow.cube import make_case, make_cube
    >>> data = {"speed": [1.2, 1.3], "hub_force": [[0.0, 0.0]] * 3, "hub_moment": [[0.0, 0.0]] * 3}
    >>> seeds = [make_case([0.0, 0.1], data, dlc="1.1", wind_speed=8.0, seed=k) for k in (1, 2)]
    >>> dict(make_cube(seeds).sizes)["case"]
    2
    """
    if not cases:
        raise InputError("a load cube needs one case or more, none was given")
    groups: dict[tuple[int, float], list[xr.Dataset]] = {}
    names: set[str] = set()
    for named in _weighted([label_case(case) for case in cases]):
        name = str(named["case"].values)
        source = str(named.coords["file"].values) if "file" in named.coords else ""
        if name in names:
            raise InputError(f"case {name!r} is given twice; dlc, wind speed and seed must differ")
        names.add(name)
        check_case(named, source=source, name=name)
        step, time = regular_time(named["time"].values)
        groups.setdefault((time.size, step), []).append(named)
    cubes = {
        f"t{(n - 1) * step:.10g}_dt{step:.10g}": _stack(group)
        for (n, step), group in groups.items()
    }
    return _join(cubes)


def select(
    cube: Cube,
    dlc: str | Iterable[str] | None = None,
    wind_speed: float | Iterable[float] | None = None,
    seed: int | Iterable[int] | None = None,
) -> Cube:
    """Return the cases that match all of the given values.

    Parameters
    ----------
    cube : xarray.Dataset or xarray.DataTree
        A cube.
    dlc, wind_speed, seed : scalar or iterable, optional
        Wanted value or values; wind speed in m/s.

    Returns
    -------
    xarray.Dataset or xarray.DataTree
        A Dataset where all that is left has one length and step.

    Raises
    ------
    loadflow.errors.InputError
        Nothing matches; the message lists what the cube holds.

    Examples
    --------
    >>> from loadflow.cube import make_case, make_cube, select
    >>> data = {"speed": [1.2, 1.3], "hub_force": [[0.0, 0.0]] * 3, "hub_moment": [[0.0, 0.0]] * 3}
    >>> seeds = [make_case([0.0, 0.1], data, dlc="1.1", wind_speed=8.0, seed=k) for k in (1, 2)]
    >>> select(make_cube(seeds), seed=2)["seed"].values.tolist()
    [2]
    """
    wanted = {"dlc": dlc, "wind_speed": wind_speed, "seed": seed}
    left = {}
    for name, part in parts(cube).items():
        keep = np.ones(part.sizes["case"], dtype=bool)
        for coord, value in wanted.items():
            if value is not None:
                single = isinstance(value, str) or not isinstance(value, Iterable)
                keep &= np.isin(part[coord].values, [value] if single else list(value))  # type: ignore[arg-type]
        if keep.any():
            left[name] = part.isel(case=np.flatnonzero(keep))
    if not left:
        held = {
            coord: sorted({v for p in parts(cube).values() for v in p[coord].values.tolist()})
            for coord in wanted
        }
        asked = {k: v for k, v in wanted.items() if v is not None}
        raise InputError(f"no case matches {asked}; the cube holds {held}")
    return _join(left)


def _join(cubes: dict[str, xr.Dataset]) -> Cube:
    if len(cubes) == 1:
        return next(iter(cubes.values()))
    return xr.DataTree.from_dict(cubes)


def _weighted(cases: list[xr.Dataset]) -> list[xr.Dataset]:
    """Give every case the same share of the lifetime where none states one."""
    missing = [case["case"].item() for case in cases if "weight" not in case.coords]
    if len(missing) == len(cases):
        weight = xr.DataArray(1.0 / len(cases), attrs=_attrs("weight"))
        return [case.assign_coords(weight=weight) for case in cases]
    if missing:
        raise InputError(f"case {missing[0]!r} has no weight, but others have; give all or none")
    return cases


def _stack(cases: list[xr.Dataset]) -> xr.Dataset:
    """Join cases of one length and step; the first one gives the time axis."""
    first = cases[0]
    for case in cases[1:]:
        pair = f"cases {first['case'].item()!r} and {case['case'].item()!r}"
        if differing := set(first.variables) ^ set(case.variables):
            names = ", ".join(sorted(map(str, differing)))
            raise InputError(f"{pair} hold different variables: {names} in one of them only")
    cube = xr.concat(
        [case.assign_coords(time=first["time"].variable) for case in cases],
        dim="case",
        data_vars="all",
        coords=[name for name, coord in first.coords.items() if coord.ndim == 0 and name != "case"],
        compat="equals",
        join="exact",
        combine_attrs="drop_conflicts",
    )
    for name in cube.data_vars:
        cube[name] = cube[name].transpose(*_order(name, cube[name].dims))
    return cube


def _order(name: Hashable, dims: Sequence[Hashable]) -> Sequence[Hashable]:
    """Order of storage: a series of one case lies in one piece."""
    if name in VARIABLES:
        return VARIABLES[str(name)].dims
    last = [d for d in ("case", "time") if d in dims]
    return [d for d in dims if d not in last] + last


def _attrs(name: str) -> dict[str, str]:
    return CASE_COORDS[name].attrs if name in CASE_COORDS else {}
