"""Films of a row of pads as warm as their own friction makes them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import ClassVar, cast

import numpy as np

from loadflow.errors import SolverError
from loadflow.journal.film_model import Film
from loadflow.journal.heat import HOTTEST
from loadflow.journal.pad_heat import PadHeat
from loadflow.journal.pad_results import Table, ThrustResult
from loadflow.numerics.convergence import Control

LEFT, TRIES = 1e-9, 60
"""What may be left of a balance, K, and the temperatures that are tried."""

_WARM: Table = {
    "temperature": ((), "K", "effective temperature of the films"),
    "inlet_temperature": ((), "K", "temperature of the oil that enters a pad"),
    "outlet_temperature": ((), "K", "temperature of the oil that leaves a pad"),
    "viscosity": ((), "Pa s", "viscosity at the effective temperature"),
    "heat_residual": ((), "K", "what is left of the heat balance"),
    "heat_iterations": ((), "1", "temperatures tried"),
}


@dataclass(frozen=True, repr=False)
class WarmThrustResult(ThrustResult):
    """Film of a thrust bearing with its heat balance, one temperature for all pads.

    Attributes
    ----------
    temperature : float
        Of the films, K: the mean of the oil that enters a pad and that leaves it.
    inlet_temperature, outlet_temperature : float
        Of the oil that enters a pad, hot oil of the pad before mixed in, and that leaves it, K.
    viscosity : float
        At that temperature, Pa s.
    heat_residual : float
        What is left of the balance, K.
    heat_iterations : int
        Temperatures tried.

    Examples
    --------
    >>> from loadflow.journal import Film, Guembel, PadHeat, ThrustBearing
    >>> bearing = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
    >>> film = Film(None, Guembel(), grid=(20, 10), heat=PadHeat("iso-vg-68"))
    >>> found = bearing.pressure(1e-4, 10.0, film)
    >>> found.heat_residual < 1e-8 < found.outlet_temperature - found.temperature
    True
    """

    temperature: float
    inlet_temperature: float
    outlet_temperature: float
    viscosity: float
    heat_residual: float
    heat_iterations: int

    _table: ClassVar[Table] = ThrustResult.told() | _WARM


def balanced(
    solve: Callable[[Film], ThrustResult], film: Film, control: Control
) -> WarmThrustResult:
    """Film of pads at the temperature that its own friction keeps.

    Parameters
    ----------
    solve : callable
        Of an isothermal film.
    film : Film
        With the heat of pads.
    control : Control
        `strict`: raise where no balance is found.

    Raises
    ------
    loadflow.errors.SolverError
        As `solve`, with the temperature; no balance below 150 °C.
    """
    heat = cast("PadHeat", film.heat)
    warm, steps = heat.inlet_temperature, 0
    for tries in range(1, TRIES + 1):
        oil = heat.lubricant(warm)
        try:
            found = solve(replace(film, lubricant=oil, heat=None))
        except SolverError as error:
            if tries == 1:
                raise
            raise SolverError(
                f"{error}; at {warm:.4g} K, to which its friction warms it"
            ) from error
        steps += found.iterations
        flow, side = found.flow, float(np.sum(found.side_flow))
        warming, carried = heat.warming(found.friction_power, flow), heat.carried(flow, side)
        entering = heat.inlet_temperature + float(carried * warming)
        left = entering + 0.5 * float(warming) - warm
        if abs(left) <= LEFT or found.speed == 0.0:
            break
        if warm == HOTTEST and left > 0.0:
            break
        warm = float(heat.nearer(warm, warm + left))
    balance = abs(left) <= LEFT
    if control.strict and not balance:
        raise SolverError(f"no heat balance below {HOTTEST} K; it is off by {left:.2g} K")
    known = {part.name: getattr(found, part.name) for part in fields(found)} | {
        "converged": found.converged and balance,
        "iterations": steps,
    }
    return WarmThrustResult(
        **known,
        temperature=warm,
        inlet_temperature=entering,
        outlet_temperature=entering + float(warming),
        viscosity=oil.viscosity,
        heat_residual=abs(left),
        heat_iterations=tries,
    )
