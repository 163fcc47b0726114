"""When the rotor runs, and when it stands or idles."""

from __future__ import annotations

import xarray as xr

STANDING = 0.1
"""Share of the rated speed below which a rotor stands or idles: no turbine produces power there."""

STANDING_SPEED = 0.05
"""The same limit where the rated speed is not known, rad/s (half a revolution a minute)."""


def standing(case: xr.Dataset, rated_speed: float | None = None) -> xr.DataArray:
    """Whether the rotor stands or idles, sample by sample.

    Films and friction of a bearing that hardly turns are other ones than those of a running
    machine: means over a case leave these samples out, ``x.where(~standing(case)).mean("time")``.

    Parameters
    ----------
    case : xarray.Dataset
        Case or cube with the variable ``speed``, rad/s.
    rated_speed : float, optional
        Of the rotor, rad/s. The limit is `STANDING` of it, else `STANDING_SPEED`.

    Returns
    -------
    xarray.DataArray
        bool, with the dimensions of ``speed``.

    Examples
    --------
    >>> from loadflow.cube import make_series
    >>> stop = make_series([0, 1, 2], {"speed": [1.2, 0.4, -0.01]})
    >>> standing(stop, rated_speed=1.27).values.tolist()
    [False, False, True]
    """
    limit = STANDING_SPEED if rated_speed is None else STANDING * rated_speed
    return (abs(case["speed"]) < limit).assign_attrs(
        units="1", long_name="whether the rotor stands or idles"
    )


def standing_share(case: xr.Dataset, rated_speed: float | None = None) -> xr.DataArray:
    """Share of the time during which the rotor stands or idles; see `standing`.

    Parameters
    ----------
    case : xarray.Dataset
        One case, with `speed` over ``time``.
    rated_speed : float, optional
        Of the rotor, rad/s; see `standing`.

    Returns
    -------
    xarray.DataArray
        Share, 0 … 1.

    Examples
    --------
    >>> from loadflow.cube import make_series, standing_share
    >>> float(standing_share(make_series([0.0, 0.1, 0.2, 0.3], {"speed": [1.2, 1.2, 0.0, 0.0]})))
    0.5
    """
    share = standing(case, rated_speed).mean("time")
    return share.assign_attrs(units="1", long_name="share of the time standing or idling")
