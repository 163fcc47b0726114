"""Lumped heat balance: the temperature at which a bearing sheds what its friction makes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.numerics.convergence import Convergence
from loadflow.numerics.shown import Shown, span_in_words
from loadflow.quantities import CELSIUS, Quantity
from loadflow.rolling.friction.bearing import BearingFriction
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.friction.roller_losses import roller_friction
from loadflow.rolling.results import ContactResult

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_SHOWN = {
    "temperature": Quantity("T", "K", "temperature of oil and bearing"),
    "power": Quantity("P", "W", "friction at that temperature"),
    "converged": Quantity("", "1", "whether loss and cooling are equal"),
    "residual": Quantity("", "1", "power not balanced over the loss of the cold bearing"),
    "iterations": Quantity("", "1", "steps"),
}

_HOTTEST = 200.0  # K above the surroundings that are searched
_MOST_STEPS = 100  # of the search for the balance between two temperatures
_STEP = 10.0  # K, of the search where the loss may overtake the cooling again


@dataclass(frozen=True, repr=False)
class HeatBalance(Shown):
    """State in which mean loss and cooling are equal.

    Attributes
    ----------
    temperature : float
        Of oil and bearing, K.
    friction : BearingFriction
        Films and losses at that temperature.
    convergence : Convergence
        Of the search; the residual is the power not balanced over the loss.

    Examples
    --------
    >>> from loadflow.rolling import FrictionOptions, RollerBearing
    >>> from loadflow.rolling.friction import balanced_temperature
    >>> from loadflow.tribology import lubricant
    >>> bearing = RollerBearing(rollers=24, roller_diameter=0.04, roller_length=0.06,
    ...     pitch_diameter=0.5)
    >>> options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> state = bearing.equilibrium((1e5, 0.0, 0.0))
    >>> found = balanced_temperature(state, 10.0, options, conductance=10.0, ambient=293.15)
    >>> found.convergence.converged, found.temperature > 293.15
    (True, True)
    """

    temperature: float
    friction: BearingFriction
    convergence: Convergence

    @property
    def power(self) -> NDArray[np.float64]:
        """Friction of each load case at that temperature, W."""
        return self.friction.power

    @property
    def converged(self) -> bool:
        """Whether loss and cooling are equal."""
        return self.convergence.converged

    @property
    def residual(self) -> float:
        """Power that is not balanced, over the loss of the bearing as cold as its surroundings."""
        return self.convergence.residual

    @property
    def iterations(self) -> int:
        """Steps of the search."""
        return self.convergence.iterations

    def shown_quantities(self) -> Mapping[str, Quantity]:
        """Quantities of a heat balance."""
        return _SHOWN

    def to_dataset(self) -> xr.Dataset:
        """Temperature and search beside the friction at that temperature, with units."""
        alone = ((name, getattr(self, name), _SHOWN[name]) for name in _SHOWN if name != "power")
        return self.friction.to_dataset().assign(
            {name: ((), value, about.attributes) for name, value, about in alone}
        )

    def plot(self) -> Figure:
        """Draw the friction at that temperature, as `BearingFriction.plot`."""
        return self.friction.plot()

    def __repr__(self) -> str:
        power, unit = span_in_words(self.power, "W")
        said = "converged" if self.converged else "not converged"
        warm = self.temperature - CELSIUS
        return f"<HeatBalance, {warm:.4g} °C with {power} {unit}, {said}>"


def balanced_temperature(
    result: ContactResult[Any] | Callable[[float], ContactResult[Any]],
    speed: ArrayLike,
    options: FrictionOptions,
    conductance: float,
    ambient: float,
    weights: ArrayLike | None = None,
    model: Callable[..., BearingFriction] = roller_friction,
) -> HeatBalance:
    """Find the temperature of a bearing over a duty of many cases.

    The bearing is one mass, slow against the cases: its temperature follows from the mean loss.

    Parameters
    ----------
    result : ContactResult or callable
        As `roller_friction`; or a function of the temperature, K, that gives it, of a bearing whose
        clearance follows its temperature.
    speed, options
        As `roller_friction`; `options.temperature` is replaced.
    conductance : float
        Heat that leaves the bearing, W/K > 0.
    ambient : float
        Temperature around it, K.
    weights : array_like, optional
        Share of time of each case; equal if not given.
    model : callable
        `roller_friction`, or `ball_friction` for balls.

    Returns
    -------
    HeatBalance
        Temperature, K, friction at it, and the residual.

    Raises
    ------
    InputError
        If the conductance is not positive or the oil is not known so cold.
    SolverError
        If the bearing would run more than 200 K hot, as one does whose preload grows faster with
        the temperature than what is carried off; or if no balance is found in 100 steps.

    Examples
    --------
    >>> from loadflow.rolling import FrictionOptions, RollerBearing
    >>> from loadflow.rolling.friction import balanced_temperature
    >>> from loadflow.tribology import lubricant
    >>> bearing = RollerBearing(rollers=24, roller_diameter=0.04, roller_length=0.06,
    ...     pitch_diameter=0.5)
    >>> options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> state = bearing.equilibrium((1e5, 0.0, 0.0))
    >>> found = balanced_temperature(state, 10.0, options, conductance=10.0, ambient=293.15)
    >>> loss = float(found.friction.power)
    >>> abs(loss / (10.0 * (found.temperature - 293.15)) - 1) < 1e-3
    True
    """
    from scipy.optimize import brentq

    if not conductance > 0:
        raise InputError(f"conductance: must be > 0 W/K, got {conductance}")

    @lru_cache(maxsize=2)  # one of the last two asked is the answer
    def friction(temperature: float) -> BearingFriction:
        state = result(temperature) if callable(result) else result
        return model(state, speed, replace(options, temperature=temperature))

    @cache  # the search begins with the ends that are asked before
    def surplus(temperature: float) -> float:
        power = friction(temperature).power
        share = (
            None if weights is None else np.broadcast_to(np.asarray(weights, float), power.shape)
        )
        return float(np.average(power, weights=share)) - conductance * (temperature - ambient)

    idle = surplus(ambient)
    if idle <= 0:  # stands still
        return HeatBalance(ambient, friction(ambient), Convergence(True, 0.0, 0))
    hottest = min(ambient + _HOTTEST, 500.0)
    low = ambient
    if callable(result):
        low, hottest = _first_span(surplus, ambient, hottest)
    elif (cold := ambient + idle / conductance) < hottest and surplus(cold) <= 0:
        hottest = cold  # warm oil seldom loses more than cold oil
    left = surplus(hottest)
    if left > 0:
        raise SolverError(
            f"heat balance: {left:.3g} W are left at {hottest:g} K; conductance {conductance:g} W/K"
        )
    found, report = brentq(
        surplus, low, hottest, xtol=1e-5, maxiter=_MOST_STEPS, full_output=True, disp=False
    )
    residual = abs(surplus(found)) / idle
    if not report.converged:
        raise SolverError(
            f"heat balance: not found in {_MOST_STEPS} steps from {low:.5g} to {hottest:.5g} K; at "
            f"{found:.5g} K loss and cooling still differ by {residual:.3g} of the loss at "
            f"{ambient:g} K. What helps: a conductance (now {conductance:g} W/K) that keeps the "
            "bearing where its loss changes little with the temperature, or a stated temperature"
        )
    return HeatBalance(
        float(found),
        friction(found),
        Convergence(True, residual, int(report.iterations)),
    )


def _first_span(
    surplus: Callable[[float], float], ambient: float, hottest: float
) -> tuple[float, float]:
    """The coolest span in which cooling overtakes the loss.

    Where preload grows with heat, the loss may overtake again beyond it.
    """
    steps = int(np.ceil((hottest - ambient) / _STEP))
    low = ambient
    for high in np.linspace(ambient, hottest, steps + 1)[1:]:
        if surplus(float(high)) <= 0:
            return low, float(high)
        low = float(high)
    return low, hottest
