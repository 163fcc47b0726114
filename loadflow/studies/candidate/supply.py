"""Oil that leaves films, and power to supply it, of those without a stated supply, too."""

from __future__ import annotations

import numpy as np
import xarray as xr

FEED = 0.1e6
"""Pressure of the oil over that at the bearing ends where no supply is stated, Pa; assumed."""


def leaving(table: xr.Dataset | None, cases: np.ndarray) -> np.ndarray:
    """Oil that leaves the films of all bearings of a table in the mean of each load case, m³/s.

    Parameters
    ----------
    table : xarray.Dataset or None
        Films over ``case`` and ``bearing``; none have no oil.
    cases : ndarray of str
        Load cases.
    """
    if table is None:
        return np.zeros(cases.size)
    flow = table["mean_side_flow"].fillna(0.0).sum("bearing")
    return np.asarray(flow.reindex(case=cases, fill_value=0.0).values)


def supply_power(table: xr.Dataset, beside: np.ndarray | float = 0.0) -> tuple[np.ndarray, str]:
    """Mean power of the pump in each load case, W, and what it rests on.

    Where no bearing is supplied under pressure, all that leaves the films is brought back at
    `FEED`. The films do not know of it, and the energy of a year leaves it out. So it is with what
    leaves pads, of which none has a supply.

    Parameters
    ----------
    table : xarray.Dataset
        Films of journal bearings, or of pads in their place, over ``case`` and ``bearing``.
    beside : ndarray or float
        What leaves a collar beside them, m³/s.
    """
    none = xr.zeros_like(table["mean_side_flow"])
    stated = table.get("mean_supply_power", none).fillna(0.0).sum("bearing").values
    assumed = f"at {1e-6 * FEED:g} MPa, assumed; not in the energy"
    if stated.any():
        note = f"what leaves the collar {assumed}" if np.any(beside) else ""
        return stated + FEED * beside, note
    flow = table["mean_side_flow"].fillna(0.0).sum("bearing").values
    return FEED * (flow + beside), f"what leaves the films, {assumed}"
