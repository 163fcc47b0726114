"""What a bearing costs: friction, supply, and what is left of the power of the shaft."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.journal.results import Equilibrium
from loadflow.numerics.fields import require

Array = NDArray[np.float64]


@dataclass(frozen=True)
class EnergyBalance:
    """Energy balance of a bearing, as Table 5-23 of [Jonuschies 2015] draws it up.

    Attributes
    ----------
    friction_power : array (…)
        (3.34): shear and pressure flow of the film, W.
    supply_power : array (…)
        Q p of the pump, W.
    loss : array (…)
        Their sum, W. What the pump presses through the film is in both: the table counts it twice,
        which makes it an upper bound.
    shaft_power : array (…)
        Power that the shaft passes on behind the bearing, W.
    efficiency : array (…)
        shaft_power/(shaft_power + loss).

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lubricant, energy_balance
    >>> bearing = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
    >>> state = bearing.equilibrium((2e6, 0.4e6), 1.2451, Lubricant(0.05), grid=(36, 8))
    >>> balance = energy_balance(state, shaft_power=5e6)
    >>> bool(balance.loss < 0.01 * balance.shaft_power)
    True
    """

    friction_power: Array
    supply_power: Array
    loss: Array
    shaft_power: Array
    efficiency: Array


def energy_balance(state: Equilibrium, shaft_power: ArrayLike) -> EnergyBalance:
    """Set the losses of a bearing against the power of its shaft.

    Parameters
    ----------
    state : Equilibrium
        Any number of loads.
    shaft_power : array_like (…)
        Power behind the bearing, W, ≥ 0; broadcasts with the loads.

    Returns
    -------
    EnergyBalance

    Raises
    ------
    loadflow.errors.InputError
        A power below zero or not finite.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lubricant, energy_balance
    >>> bearing = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
    >>> state = bearing.equilibrium(
    ...     (2e6, 0.4e6), 1.2451, Lubricant(0.05), edge_pressure=5e5, grid=(36, 8)
    ... )
    >>> balance = energy_balance(state, shaft_power=5e6)
    >>> float(balance.loss) == float(balance.friction_power + balance.supply_power)
    True
    >>> bool(0.99 < balance.efficiency < 1.0)
    True
    """
    power = np.asarray(shaft_power, dtype=float)
    require(
        bool(np.all(power >= 0) and np.all(np.isfinite(power))),
        "shaft_power",
        power,
        "must be ≥ 0 W",
    )
    loss = state.friction_power + state.supply_power
    power, loss = np.broadcast_arrays(power, loss)
    total = power + loss
    efficiency = np.divide(power, total, out=np.zeros(total.shape), where=total > 0)
    return EnergyBalance(
        state.friction_power, state.supply_power, loss[()], power[()], efficiency[()]
    )
