"""Former public names, for one version more."""

from __future__ import annotations

import warnings
from typing import Any

import xarray as xr

from loadflow.shaft.beam import BearingSupport
from loadflow.shaft.coupled import CoupledBearing, coupled_loads

BearingSeat = BearingSupport
Seated = CoupledBearing


def seated_loads(*arguments: Any, **keywords: Any) -> xr.Dataset:
    """`coupled_loads` under its former name; deprecated.

    Examples
    --------
    >>> from loadflow.shaft import BearingSeat, BearingSupport
    >>> BearingSeat is BearingSupport
    True
    """
    warnings.warn("seated_loads(…) is now coupled_loads(…)", DeprecationWarning, stacklevel=2)
    return coupled_loads(*arguments, **keywords)
