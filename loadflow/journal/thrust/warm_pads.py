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
from loadflow.journal.thrust.pad_results import Table, ThrustResult
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
        try:
            cool = solve(at_temperature(film, warm))
        except SolverError as error:
            if tries == 1:
                raise
            raise SolverError(
                f"{error}; at {warm:.4g} K, to which its friction warms it"
            ) from error
        steps += cool.iterations
        found = warmed(cool, heat, warm)
        if is_settled(found):
            break
        warm = next_temperature(found, heat)
    if control.strict:
        check_balance(found)
    return replace(found, heat_iterations=tries, iterations=steps)


def at_temperature(film: Film, temperature: float) -> Film:
    """The film with its oil at a temperature, K."""
    oil = cast("PadHeat", film.heat).lubricant(temperature)
    return replace(film, lubricant=oil, heat=None)


def warmed(cool: ThrustResult, heat: PadHeat, temperature: float) -> WarmThrustResult:
    """Films at a temperature, K, with what is left of their balance there."""
    flow, side = cool.flow, float(np.sum(cool.side_flow))
    warming = float(heat.warming(cool.friction_power, flow))
    entering = heat.inlet_temperature + float(heat.carried(flow, side)) * warming
    left = entering + 0.5 * warming - temperature
    known = {part.name: getattr(cool, part.name) for part in fields(cool)}
    return WarmThrustResult(
        **known | {"converged": cool.converged and abs(left) <= LEFT},
        temperature=temperature,
        inlet_temperature=entering,
        outlet_temperature=entering + warming,
        viscosity=heat.lubricant(temperature).viscosity,
        heat_residual=abs(left),
        heat_iterations=1,
    )


def next_temperature(found: WarmThrustResult, heat: PadHeat) -> float:
    """Temperature that is tried after one whose balance is not met, K."""
    asked = 0.5 * (found.inlet_temperature + found.outlet_temperature)
    return float(heat.nearer(found.temperature, asked))


def is_settled(found: WarmThrustResult) -> bool:
    """Whether the balance is met, or lies above the hottest temperature."""
    asked = 0.5 * (found.inlet_temperature + found.outlet_temperature)
    beyond = found.temperature == HOTTEST and asked > HOTTEST
    return found.heat_residual <= LEFT or beyond


def check_balance(found: WarmThrustResult) -> None:
    """Refuse films without a balance.

    Raises
    ------
    loadflow.errors.SolverError
        With what is left of it.
    """
    if found.heat_residual > LEFT:
        left = f"it is off by {found.heat_residual:.2g} K"
        raise SolverError(f"no heat balance below {HOTTEST} K; {left}")
