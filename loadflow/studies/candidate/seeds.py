"""What seeds do to a margin: the factor on the loads that other cases of the same kind give."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import xarray as xr

from loadflow.studies.seeds.intervals import joint_life

Draw = Callable[[np.ndarray], float]
"""From numbers of cases, some of them several times, to a factor on the loads."""

_STEP = 1.1
_NEAR = 0.05  # logarithm of a factor below which its own step tells no power
_WIDEST = 0.9  # share of the logarithm of the widest factor beyond which a limit was not reached


def power_of_load(value: Callable[[float], float], factor: float, widest: float) -> float:
    """Power of the load that a value follows between the load and the factor with which it is at
    its limit; a tenth above the load where both are the same, or the limit is out of reach.

    Examples
    --------
    >>> round(power_of_load(lambda load: 3.0 * load**-2, 1.7, 16.0), 3)
    -2.0
    """
    size = abs(math.log(factor)) if factor > 0 else math.inf
    step = factor if _NEAR < size < _WIDEST * math.log(widest) else _STEP
    before, after = value(1.0), value(step)
    if not (before > 0 and after > 0):
        return math.nan
    return math.log(after / before) / math.log(step)


def of_extreme(
    values: xr.DataArray, pick: Callable[..., float], factor: float, power: float
) -> Draw:
    """Factors where the extreme of `values` over the cases follows the load by a power.

    Examples
    --------
    >>> films = xr.DataArray([20.0, 10.0], dims="case")
    >>> round(of_extreme(films, np.nanmin, 1.5, -1.0)(np.array([0, 0])), 3)
    3.0
    """
    found = values.values.astype(float)
    whole = float(pick(found))

    def drawn(some: np.ndarray) -> float:
        own = found[some]
        if not power or np.isnan(own).all():
            return math.nan
        return factor * (float(pick(own)) / whole) ** (-1.0 / power)

    return drawn


def of_life(
    damage: xr.DataArray, share: np.ndarray, factor: float, power: float, slope: float = 1.0
) -> Draw:
    """Factors where the `damage` of each case in an hour follows the load by a power.

    Damage of several bearings is that of all as a system, by their Weibull slope.

    Examples
    --------
    >>> damage = xr.DataArray([1e-6, 4e-6], dims="case")
    >>> drawn = of_life(damage, np.array([0.5, 0.5]), 1.0, 2.0)
    >>> round(drawn(np.array([0, 0])) / drawn(np.array([1, 1])), 3)
    2.0
    """
    found = np.nan_to_num(damage.transpose("case", ...).values.astype(float))
    found = found.reshape(damage.sizes["case"], -1)
    whole = joint_life(found, share, slope)

    def drawn(some: np.ndarray) -> float:
        own = joint_life(found[some], share[some], slope)
        return factor * (own / whole) ** (1.0 / power) if math.isfinite(own) and power else math.nan

    return drawn
