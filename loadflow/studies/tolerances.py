"""Band of an answer by the tolerances of a bearing's values, and which of them governs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr


@dataclass(frozen=True)
class Band:
    """How far an answer may move by the tolerances of the bearing's values.

    They are taken as independent: the changes of one sign add up by the root of the sum of their
    squares.

    Attributes
    ----------
    low, high : float
        Relative change down (≤ 0) and up (≥ 0); NaN where an end of a band has no answer.
    shares : dict
        By key of the value, the largest relative change by it alone, either way.

    Examples
    --------
    >>> band = Band(-0.13, 0.2, {"geometry.relative_clearance": 0.19, "heat.oil": 0.05})
    >>> band.governed_by, band.of(2.0)
    ('geometry.relative_clearance', (1.74, 2.4))
    """

    low: float
    high: float
    shares: Mapping[str, float]

    @property
    def largest(self) -> float:
        """Largest relative change, either way."""
        return max(-self.low, self.high)

    @property
    def governed_by(self) -> str:
        """Key of the value whose tolerance moves the answer most."""
        return max(self.shares, key=lambda key: self.shares[key])

    def of(self, value: float) -> tuple[float, float]:
        """Both ends of the band around a value of the answer."""
        return value * (1.0 + self.low), value * (1.0 + self.high)


def band_of(
    tables: Mapping[str, xr.Dataset], room: str, bearing: str, quantity: str
) -> Band | None:
    """Band of an answer of a finished run.

    Parameters
    ----------
    tables : mapping
        Results of the run by stage; those of its tolerances are ``tables["tolerances"]``.
    room : str
        Stage of the answer: ``"journal"``, ``"thrust"`` or ``"rolling"``.
    bearing : str
        Place of the bearing.
    quantity : str
        As the error budget calls it: ``"minimum film"``, ``"life"`` …

    Returns
    -------
    Band or None
        The largest of the load cases that were looked at; None where no value has a tolerance.

    Examples
    --------
    >>> data = {"low": ("change", [0.12, -0.05]), "high": ("change", [-0.16, 0.05])}
    >>> about = {"room": ["journal"] * 2, "bearing": ["N"] * 2, "quantity": ["minimum film"] * 2,
    ...     "key": ["geometry.relative_clearance", "lubricant.viscosity"], "case": ["a", "a"]}
    >>> table = xr.Dataset(data, {name: ("change", text) for name, text in about.items()})
    >>> band = band_of({"tolerances": table}, "journal", "N", "minimum film")
    >>> round(band.low, 3), round(band.high, 3), band.governed_by
    (-0.168, 0.13, 'geometry.relative_clearance')
    """
    table = tables.get("tolerances")
    if table is None or "change" not in table.dims:
        return None
    asked = {"room": room, "bearing": bearing, "quantity": quantity}
    rows = np.all([table[name].values == value for name, value in asked.items()], axis=0)
    if not rows.any():
        return None
    keys, cases = (table[name].values[rows] for name in ("key", "case"))
    ends = np.stack([table["low"].values[rows], table["high"].values[rows]])
    down = np.maximum(-ends, 0.0).max(axis=0)
    up = np.maximum(ends, 0.0).max(axis=0)
    shares = {
        str(key): float(np.abs(ends[:, keys == key]).max()) for key in dict.fromkeys(keys.tolist())
    }
    of_cases = [cases == case for case in dict.fromkeys(cases.tolist())]
    lower, upper = (max(math.hypot(*side[own]) for own in of_cases) for side in (down, up))
    if np.isnan(ends).any():
        lower = upper = math.nan
    return Band(-lower, upper, shares)
