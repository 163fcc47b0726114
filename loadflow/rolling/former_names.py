"""Former public names, for one version more."""

from __future__ import annotations

import warnings
from typing import Any

from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.rolling.bearings.base import RollingBearing, RollingEquilibrium
from loadflow.rolling.rating import modified_life
from loadflow.rolling.rating.modified_life import LifeModification, Lubrication
from loadflow.rolling.rings.transient import Transient, transient_response

MainBearing = RollingBearing
RollerResult = SlewingResult = FlexibleResult = RollingEquilibrium
BallBearingResult = SpinningResult = ThreeRowResult = RollingEquilibrium


def settle(*arguments: Any, **keywords: Any) -> Transient:
    """`transient_response` under its former name; deprecated.

    Examples
    --------
    >>> from loadflow.rolling import settle
    >>> settle.__doc__.split()[0]
    '`transient_response`'
    """
    warnings.warn("settle(…) is now transient_response(…)", DeprecationWarning, stacklevel=2)
    return transient_response(*arguments, **keywords)


def static_capacity(bearing: RollingBearing) -> float:
    """`bearing.static_capacity`; deprecated.

    Raises
    ------
    InputError
        If it is no bearing.

    Examples
    --------
    >>> import warnings
    >>> from loadflow.rolling import BallBearing, static_capacity
    >>> bearing = BallBearing(balls=16, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208)
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", DeprecationWarning)
    ...     found = static_capacity(bearing)
    >>> found == bearing.static_capacity
    True
    """
    warnings.warn("static_capacity(b) is now b.static_capacity", DeprecationWarning, stacklevel=2)
    if not isinstance(bearing, RollingBearing):
        raise InputError(f"bearing: no static capacity of a {type(bearing).__name__}")
    return bearing.static_capacity


def bearing_modification(
    bearing: RollingBearing,
    load: ArrayLike,
    speed: ArrayLike,
    lubrication: Lubrication,
    limit: float = modified_life.LARGEST_FACTOR,
) -> LifeModification:
    """`bearing.life_modification(load, speed, lubrication, limit)`; deprecated.

    Examples
    --------
    >>> import warnings
    >>> from loadflow.rolling import BallBearing, Lubrication, bearing_modification
    >>> from loadflow.tribology import lubricant
    >>> bearing = BallBearing(balls=16, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208)
    >>> oil = Lubrication(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", DeprecationWarning)
    ...     found = bearing_modification(bearing, 1e4, 10.0, oil)
    >>> bool(found.factor == bearing.life_modification(1e4, 10.0, oil).factor)
    True
    """
    warnings.warn(
        "bearing_modification(b, …) is now b.life_modification(…)", DeprecationWarning, stacklevel=2
    )
    return bearing.life_modification(load, speed, lubrication, limit)
