"""Power to supply the oil of journal bearings, of those without a stated supply, too."""

from __future__ import annotations

import numpy as np
import xarray as xr

FEED = 0.1e6
"""Pressure of the oil over that at the bearing ends where no supply is stated, Pa; assumed."""


def supply_power(table: xr.Dataset) -> tuple[np.ndarray, str]:
    """Mean power of the pump in each load case, W, and what it rests on.

    Where no bearing is supplied under pressure, all that leaves the films is brought back at
    `FEED`. The films do not know of it, and the energy of a year leaves it out.

    Parameters
    ----------
    table : xarray.Dataset
        Films over ``case`` and ``bearing``.
    """
    stated = table["mean_supply_power"].fillna(0.0).sum("bearing").values
    if stated.any():
        return stated, ""
    flow = table["mean_side_flow"].fillna(0.0).sum("bearing").values
    note = f"what leaves the films, at {1e-6 * FEED:g} MPa, assumed; not in the energy"
    return FEED * flow, note
