"""Heat balance of the film: how warm the oil gets, and how thin.

One effective temperature stands for the whole film, as in ISO 7902-1: the friction power leaves
with the oil at the rims, which enters at T_in and leaves at T_out, and through the housing,

    P = ρ c_p Q (T_out − T_in) + K (T − T_ambient),    T = (T_in + T_out)/2.

A film at rest depends on viscosity η and speed ω through their product: the film of (η, ω) is that
of (η₀, ω η/η₀), with friction and flow larger by η₀/η. So loads of different viscosity are solved
in one call.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from annotated_types import Ge, Gt
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.film.discretise import operating_points
from loadflow.journal.options import Lubricant, require
from loadflow.journal.results import shaped
from loadflow.journal.supply import Capillary
from loadflow.journal.validity import warn_if_turbulent
from loadflow.numerics.fields import check_fields
from loadflow.tribology import Oil, lubricant

if TYPE_CHECKING:
    from loadflow.journal.bearing import JournalBearing
    from loadflow.journal.results import Equilibrium

Array = NDArray[np.float64]

HOTTEST = 423.15
"""Largest temperature of the film that is looked for, K; oils and white metal end before."""


@dataclass(frozen=True)
class Heat:
    """Oil and cooling of a bearing.

    Attributes
    ----------
    oil : str or Oil
        Name of an oil of `loadflow.tribology.lubricant_names`, or an oil.
    inlet_temperature : float
        Of the oil that enters the film, K.
    heat_capacity : float
        c_p of the oil, J/(kg K).
    transfer : float
        K, heat that passes from the film through the housing for each kelvin above ambient, W/K;
        0: all leaves with the oil.
    ambient_temperature : float
        K.
    """

    oil: str | Oil = "mineral-vg-320"
    inlet_temperature: Annotated[float, Gt(200)] = 313.15
    heat_capacity: Annotated[float, Gt(0)] = 2000.0
    transfer: Annotated[float, Ge(0)] = 0.0
    ambient_temperature: Annotated[float, Gt(200)] = 293.15

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("inlet_temperature", "ambient_temperature"):
            value = getattr(self, name)
            require(value < HOTTEST, name, value, f"K, < {HOTTEST}")
        self.liquid  # noqa: B018  a name that is not known is told here

    @property
    def liquid(self) -> Oil:
        """The oil."""
        return lubricant(self.oil) if isinstance(self.oil, str) else self.oil

    def lubricant(self, temperature: float) -> Lubricant:
        """The oil of a film at `temperature`, K."""
        oil = self.liquid
        return Lubricant(float(oil.viscosity(temperature)), float(oil.density(temperature)))

    def temperature(self, friction_power: ArrayLike, side_flow: ArrayLike, at: ArrayLike) -> Array:
        """Effective temperature (K) that friction (W) and flow (m³/s) of a film at `at` ask for."""
        carried = 2.0 * self.liquid.density(at) * self.heat_capacity * np.asarray(side_flow)
        lost = carried + self.transfer
        gained = carried * self.inlet_temperature + self.transfer * self.ambient_temperature
        with np.errstate(divide="ignore"):  # no flow, no transfer: it never stops to warm
            return np.asarray((np.asarray(friction_power) + gained) / lost)


@dataclass(frozen=True)
class WarmFilm:
    """Equilibrium of a film at the temperature that its own friction gives it.

    Attributes
    ----------
    film : Equilibrium
        With its effective `temperature`, K; `converged` counts both film and heat.
    outlet_temperature : array (…)
        Of the oil that leaves, K.
    viscosity : array (…)
        At the effective temperature, Pa s.
    iterations : int
        Temperatures tried.
    residual : array (…)
        What is left of the heat balance, K.
    """

    film: Equilibrium
    outlet_temperature: Array
    viscosity: Array
    iterations: int
    residual: Array

    @property
    def temperature(self) -> Array:
        """Effective temperature of the film (…), K."""
        return np.asarray(self.film.temperature)[()]


def warm_equilibrium(
    bearing: JournalBearing,
    force: ArrayLike,
    speed: ArrayLike,
    heat: Heat,
    *,
    weights: ArrayLike | None = None,
    tolerance: float = 1e-6,
    max_iterations: int = 40,
    strict: bool = True,
    **film: Any,
) -> WarmFilm:
    """Equilibrium of shaft, film and heat.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.
    force, speed
        As for `JournalBearing.equilibrium`.
    heat : Heat
        Oil and cooling.
    weights : array_like (…), optional
        Shares of time of the loads: all then have one temperature, that of their mean friction and
        flow, as in a bearing too slow to follow the load. Without, each load settles for itself.
    tolerance : float
        On the heat balance, K.
    max_iterations : int
        Temperatures tried.
    strict : bool
        Raise for the first load without an answer; else its results are NaN and not converged.
    **film
        What else `JournalBearing.equilibrium` takes, but for the lubricant. Grooves must have a
        given pressure, or a capillary.

    Returns
    -------
    WarmFilm

    Raises
    ------
    loadflow.errors.InputError
        As `JournalBearing.equilibrium`; a groove with an orifice, a pump or a given flow.
    loadflow.errors.SolverError
        A load without a film, or whose balance lies above 150 °C.
    """
    loads, speeds, shape = operating_points(force, speed, "force")
    balance = _Balance(bearing, loads, speeds, heat, _share(weights, shape), _scalable(film))
    warmth = balance.solve(tolerance, max_iterations)
    state = balance.film(warmth.temperature, slice(None))
    warn_if_turbulent(bearing, speeds, heat.lubricant(float(np.nanmax(warmth.temperature))))
    found = state.converged & (warmth.residual <= tolerance)
    if strict and not found.all():
        worst = int(np.argmin(found))
        raise SolverError(
            f"load {worst}, {np.hypot(*loads[worst]):.4g} N at {speeds[worst]:.4g} rad/s: no heat "
            f"balance below {HOTTEST} K; at {warmth.temperature[worst]:.4g} K it is off by "
            f"{warmth.residual[worst]:.2g} K"
        )
    return warmth.shaped(_where(found, state), heat, shape)


@dataclass(frozen=True)
class _Warmth:
    """Temperatures that were found, (n,), K; what is left of their balance, K; and the tries."""

    temperature: Array
    residual: Array
    iterations: int

    def shaped(self, film: Equilibrium, heat: Heat, shape: tuple[int, ...]) -> WarmFilm:
        """The answer in the shape of the input."""
        found = {
            "outlet_temperature": 2.0 * self.temperature - heat.inlet_temperature,
            "viscosity": heat.liquid.viscosity(self.temperature),
            "residual": self.residual,
        }
        whole = ("moment", "tilt", "pad_tilt")  # not by load where the film has none of them
        film = replace(film, temperature=np.where(film.converged, self.temperature, np.nan))
        rows = {k: v for k, v in vars(film).items() if k not in whole or v.ndim > 1}
        state = replace(film, **shaped(rows, shape))
        return WarmFilm(state, iterations=self.iterations, **shaped(found, shape))


@dataclass(frozen=True)
class _Balance:
    """Heat balance of loads (n, 2) at speeds (n,), each for itself or of their mean by `share`."""

    bearing: JournalBearing
    force: Array
    speed: Array
    heat: Heat
    share: Array | None
    options: dict[str, Any]

    def film(self, temperature: Array, places: Any) -> Equilibrium:
        """Films of the loads at `places` (m,) at these temperatures (m,)."""
        reference = self.heat.lubricant(self.heat.inlet_temperature)
        thinner = self.heat.liquid.viscosity(temperature) / reference.viscosity
        speed = self.speed[places]
        options = self.options | {
            name: np.broadcast_to(self.options[name], self.force.shape)[places]
            for name in ("moment", "tilt", "bend")
            if self.options.get(name) is not None
        }
        state = self.bearing.equilibrium(
            self.force[places], speed * thinner, reference, strict=False, **options
        )
        lighter = self.heat.liquid.density(temperature) / reference.density
        reynolds = state.reynolds_number * lighter / thinner**2
        more = ("friction_power", "side_flow", "supply_flow", "supply_power", "groove_flow")
        return replace(
            state,
            speed=speed,
            reynolds_number=reynolds,
            laminar=reynolds < state.critical_reynolds_number,
            damping=_times(state.damping, thinner),
            **{name: _times(getattr(state, name), 1.0 / thinner) for name in more},
        )

    def solve(self, tolerance: float, max_iterations: int) -> _Warmth:
        """Find the temperatures by secants between brackets; a film that fails is too thin."""
        heat, count = self.heat, 1 if self.share is not None else self.speed.size
        cold = heat.inlet_temperature
        if heat.transfer:
            cold = min(cold, heat.ambient_temperature)
        low, high = np.full(count, cold), np.full(count, HOTTEST)
        warm, residual = np.full(count, heat.inlet_temperature), np.full(count, np.inf)
        before: tuple[Array, Array] | None = None
        active, tries = np.arange(count), 0
        while active.size and tries < max_iterations:
            here = warm[active]
            excess = self._excess(here, active)
            lost = np.isnan(excess)
            tries += 1
            residual[active] = np.where(lost, np.inf, np.abs(excess))
            low[active] = np.where(excess > 0, here, low[active])
            high[active] = np.where((excess < 0) | lost, here, high[active])
            slope = -1.0 - heat.liquid.steepness(here) * np.maximum(excess + here - cold, 0.0)
            if before is not None:
                with np.errstate(divide="ignore", invalid="ignore"):
                    secant = (excess - before[1][active]) / (here - before[0][active])
                slope = np.where(secant < -0.5, secant, slope)
            before = warm.copy(), np.full(count, np.nan)
            before[1][active] = excess
            step = here - excess / slope
            inside = (step > low[active]) & (step < high[active])
            warm[active] = np.where(
                residual[active] <= tolerance,
                here,
                np.where(inside, step, 0.5 * (low[active] + high[active])),
            )
            apart = high[active] - low[active] > 1e-12 * HOTTEST
            active = active[(residual[active] > tolerance) & apart]
        return _Warmth(
            np.broadcast_to(warm, self.speed.shape).copy(),
            np.broadcast_to(residual, self.speed.shape).copy(),
            tries,
        )

    def _excess(self, temperature: Array, active: NDArray[np.int64]) -> Array:
        """How much warmer films at `temperature` would be after their own friction, K."""
        if self.share is None:
            state = self.film(temperature, active)
            power, flow = state.friction_power, state.side_flow
        else:
            state = self.film(np.full(self.speed.size, temperature[0]), slice(None))
            share = np.where(state.converged, self.share, 0.0)
            if not share.any():
                return np.array([np.nan])
            columns = np.nan_to_num([state.friction_power, state.side_flow])
            power, flow = np.average(columns, axis=1, weights=share)[:, None]
        return self.heat.temperature(power, flow, temperature) - temperature


def _where(found: NDArray[np.bool_], state: Equilibrium) -> Equilibrium:
    """Films of which those without a balance say nothing but that."""
    kept = ("force", "speed", "residual", "critical_reynolds_number")
    blank = {
        name: _times(values, np.where(found, 1.0, np.nan))
        for name, values in vars(state).items()
        if name not in kept and np.shape(values)[:1] == found.shape and values.dtype == float
    }
    return replace(state, converged=found, **blank)


def _times(values: Any, factor: Array) -> Any:
    """Rows of `values` times `factor` (n,)."""
    if values is None:
        return None
    return values * factor.reshape(factor.shape + (1,) * (values.ndim - 1))


def _share(weights: ArrayLike | None, shape: tuple[int, ...]) -> Array | None:
    if weights is None:
        return None
    share = np.asarray(weights, dtype=float)
    try:
        share = np.broadcast_to(share, shape).ravel()
    except ValueError as error:
        raise InputError(f"weights {share.shape} and loads {shape} do not broadcast") from error
    valid = bool(np.all(share >= 0) and np.isfinite(share).all() and share.any())
    require(valid, "weights", weights, "≥ 0, not all 0")
    return share


def _scalable(film: dict[str, Any]) -> dict[str, Any]:
    """Refuse what does not depend on viscosity times speed alone."""
    for name in ("lubricant", "strict"):
        if name in film:
            raise InputError(f"{name}: not given here; the lubricant follows from heat.oil")
    supply = film.get("supply")
    if supply is not None:
        feeds = [supply.pump, *(groove.restrictor for groove in supply.grooves)]
        if not all(feed is None or isinstance(feed, Capillary) for feed in feeds):
            raise InputError("supply: with heat, a groove has a given pressure or a capillary")
    return film
