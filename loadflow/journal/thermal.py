"""Heat balance of the film: how warm the oil gets, and how thin.

One effective temperature stands for the whole film, as in ISO 7902-1: the friction power leaves
with the oil at the bearing ends, which enters at T_in and leaves at T_out, and through the housing,

    P = ρ c_p Q (T_out − T_in) + K (T − T_ambient),    T = (T_in + T_out)/2.

A film at rest depends on viscosity η and speed ω through their product: the film of (η, ω) is that
of (η₀, ω η/η₀), with friction and flow larger by η₀/η. So loads of different viscosity are solved
in one call.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.film.cell_error import warm_errors
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.grid_bounds import BOUNDED
from loadflow.journal.heat import HOTTEST, Heat
from loadflow.journal.rows import answered_rows, times_rows
from loadflow.numerics.fields import require

Array = NDArray[np.float64]
Columns = dict[str, Any]
"""Fields of `Equilibrium`, (n, …)."""
AtRest = Callable[[Array, Array, NDArray[np.int64], Array], Columns]
"""Equilibria of an isothermal film under loads (m, 2) at speeds (m,); their places among all, and
the temperatures (m,), K, by which their bearing has grown."""

TOLERANCE, TRIES = 1e-6, 40
"""What is left of a heat balance, K, and the temperatures that are tried."""

_WITHIN, _BEYOND = 4, 2
"""Temperatures that are tried before the largest one is, or the coldest of a film that grows; and
before the largest one is where the balance seems to lie beyond it."""

_FLATTEST = -0.05
"""Slope of a balance, K/K, up to which a secant is followed; where asperities rub more the warmer
the film is, it falls by far less than one.
"""

_STEEPEST = 1e-3
"""Share of what may be left of a balance, K, in which no balance is that does not jump."""

_AHEAD = 10.0
"""Where a film warms so much that its balance lies this many times farther than the temperature at
which it carries the load no more, none is looked for between them.
"""

_JUMP = 1e-3
"""By how much, K, friction may warm a film more on one mesh than on another: a balance that jumps
over zero where the mesh changes has its temperature there, and keeps what is left as its residual.
"""


def warm_film(
    at_rest: AtRest,
    force: Array,
    speed: Array,
    film: Film,
    weights: Array | None,
    tolerance: float = TOLERANCE,
    max_iterations: int = TRIES,
    strict: bool = True,
    start: Array | None = None,
    why: AtRest | None = None,
) -> Columns:
    """Equilibrium of shaft, film and heat.

    Parameters
    ----------
    at_rest : callable
        Equilibria of the film as it enters, without heat, at other speeds.
    force, speed : array (n, 2), (n,)
        Loads, N, and speeds, rad/s.
    film : Film
        With heat.
    weights : array (n,), optional
        Shares of time: one temperature for all.
    tolerance, max_iterations
        On the heat balance, K; temperatures tried.
    strict : bool
        Raise for the first load without an answer.
    start : array (n,), optional
        Temperatures, K, that are tried first; that of the inlet by default.
    why : callable, optional
        As `at_rest`, raising why a load has no film: of one that has none at any temperature.

    Raises
    ------
    loadflow.errors.InputError
        A groove with an orifice, a pump or a given flow.
    loadflow.errors.SolverError
        A load without a film, or whose balance lies above 150 °C.
    """
    check_scalable(film)
    heat = cast("Heat", film.heat)
    balance = _Balance(at_rest, force, speed, heat, weights)
    warmth = balance.solve(tolerance, max_iterations, start)
    state = balance.film(warmth.temperature, np.arange(speed.size))
    found = state["converged"] & ((warmth.residual <= tolerance) | warmth.jumps)
    if strict and not found.all():
        worst = int(np.argmin(found))
        head = (
            f"load {worst}, {np.hypot(*force[worst]):.4g} N at {speed[worst]:.4g} rad/s: no heat "
        )
        at, left = warmth.temperature[worst], warmth.residual[worst]
        if np.isfinite(warmth.fails[worst]):
            raise SolverError(
                f"{head}balance: at {at:.6g} K the film still warms by {left:.3g} K, and at "
                f"{warmth.fails[worst]:.6g} K it carries the load no more"
            )
        if why is not None and np.isinf(left):
            balance.explain(why, worst, float(at))
        raise SolverError(
            f"{head}balance below {HOTTEST} K; at {at:.4g} K it is off by {left:.2g} K"
        )
    return warmth.said_of(answered_rows(found, state), heat, weights)


@dataclass(frozen=True)
class _Warmth:
    """Temperatures that were found, (n,), K; what is left of their balance, K; and the tries.

    `jumps` says where the balance steps over zero, by less than `_JUMP`; `fails` is the temperature
    at which a film that warms up to there carries its load no more, K, else infinite.
    """

    temperature: Array
    residual: Array
    iterations: int
    jumps: NDArray[np.bool_]
    fails: Array

    def said_of(self, film: Columns, heat: Heat, share: Array | None) -> Columns:
        """The film with its temperatures, each its own or that of the mean by `share`."""
        entering = heat.entering(film["side_flow"], self.temperature)
        return _with_bounds(film, heat, self.temperature, share) | {
            "temperature": np.where(film["converged"], self.temperature, np.nan),
            "outlet_temperature": 2.0 * self.temperature - entering,
            "inlet_temperature": entering,
            "viscosity": np.asarray(heat.liquid.viscosity(self.temperature)),
            "heat_residual": self.residual,
            "heat_iterations": np.full(self.residual.shape, self.iterations),
        }


def _with_bounds(film: Columns, heat: Heat, temperature: Array, share: Array | None) -> Columns:
    """A film whose bounds of what cells do count its temperature, K: what less oil carries less.

    One temperature of all is that of their mean by `share`, and moves by the mean alone. The
    friction's own error needs no more: a film that rubs less warms less.
    """
    if "relative_grid_error" not in film or not film["converged"].any():
        return film
    bounds, flow = film["relative_grid_error"], film["side_flow"]
    less = flow / (1.0 + bounds[:, BOUNDED.index("side_flow")])
    columns = np.array([film["friction_power"], flow, less])
    if share is not None:
        there = np.where(film["converged"], share, 0.0)
        if not there.any():
            return film
        columns = np.average(np.nan_to_num(columns), axis=1, weights=there)[:, None]
    power, *flows = columns
    cooler, warmer = (heat.temperature(power, each, temperature) for each in flows)
    rise = warmer - cooler
    steep = heat.liquid.steepness(temperature)
    rise = rise / (1.0 + steep * np.maximum(temperature - heat.coldest, 0.0))
    narrow = film["minimum_film"] * film["eccentricity_ratio"]
    narrow = narrow / np.maximum(np.hypot(*film["eccentricity"].T), 1e-300)
    known = np.abs(steep * rise), film["eccentricity_ratio"], narrow
    return film | {"relative_grid_error": warm_errors(bounds, *known)}


@dataclass
class _Balance:
    """Heat balance of loads (n, 2) at speeds (n,), each for itself or of their mean by `share`."""

    at_rest: AtRest
    force: Array
    speed: Array
    heat: Heat
    share: Array | None
    refused: Array = field(init=False)
    """Temperatures from which on a load has no film, K, (n,): warmer oil is thinner."""
    known: Array = field(init=False)
    """Temperatures of the films that are `kept`, K, (n,); NaN before."""
    kept: Columns = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        self.refused = np.full(self.speed.size, np.inf)
        self.known = np.full(self.speed.size, np.nan)

    def film(self, temperature: Array, places: NDArray[np.int64]) -> Columns:
        """Films of the loads at `places` (m,) at these temperatures (m,); the last are kept."""
        asked = self.known[places] != temperature
        if asked.any():
            found = self._film(temperature[asked], places[asked])
            for name, values in found.items():
                _put(self.kept, name, values, places[asked], self.known.size)
            self.known[places[asked]] = temperature[asked]
        return {name: rows if rows is None else rows[places] for name, rows in self.kept.items()}

    def explain(self, why: AtRest, place: int, temperature: float) -> None:
        """Raise why the load at `place` has no film at a temperature, K, if `why` says so."""
        one, warm = np.array([place]), np.array([temperature])
        cold = self.heat.inlet_temperature
        thinner = self.heat.liquid.viscosity(warm) / self.heat.liquid.viscosity(cold)
        try:
            why(self.force[one], self.speed[one] * thinner, one, warm)
        except SolverError as error:
            said = str(error).removeprefix("load 0: ")
            raise SolverError(
                f"load {place}: no film at any temperature; warm or cold, it is that of oil at "
                f"{cold:.4g} K at another speed: {said}"
            ) from error

    def _film(self, temperature: Array, places: NDArray[np.int64]) -> Columns:
        reference = self.heat.lubricant(self.heat.inlet_temperature)
        thinner = self.heat.liquid.viscosity(temperature) / reference.viscosity
        speed = self.speed[places]
        state = self.at_rest(self.force[places], speed * thinner, places, temperature)
        lighter = self.heat.liquid.density(temperature) / reference.density
        reynolds = state["reynolds_number"] * lighter / thinner**2
        power, flow = ("friction_power", "contact_power"), ("side_flow", "supply_flow")
        scaled = (*power, *flow, "supply_power", "groove_flow")
        more = [name for name in scaled if name in state]
        return state | {
            "speed": speed,
            "reynolds_number": reynolds,
            "laminar": reynolds < state["critical_reynolds_number"],
            "damping": times_rows(state["damping"], thinner),
            **{name: times_rows(state[name], 1.0 / thinner) for name in more},
        }

    def solve(self, tolerance: float, max_iterations: int, start: Array | None = None) -> _Warmth:
        """Find the temperatures by secants between brackets; a film that fails is too thin."""
        heat, count = self.heat, 1 if self.share is not None else self.speed.size
        shortest = max(1e-12 * HOTTEST, _STEEPEST * tolerance)
        cold = heat.coldest
        low, high = np.full(count, cold), np.full(count, HOTTEST)
        warm, residual = np.full(count, heat.inlet_temperature), np.full(count, np.inf)
        if start is not None:
            known = np.isfinite(start) & (start > cold) & (start < HOTTEST)
            warm = np.where(known, start, warm)
        before: tuple[Array, Array] | None = None
        reach, excess_low = np.full(count, -np.inf), np.zeros(count)  # of the balance, at `low`
        fails, tested = np.full(count, np.inf), np.zeros(count, dtype=bool)  # at the hottest
        thins = heat.growth is None
        active, tries = np.arange(count), 0
        while active.size and tries < max_iterations:
            here = warm[active]
            excess = self._excess(here, active)
            lost = np.isnan(excess)
            tries += 1
            residual[active] = np.where(lost, np.inf, np.abs(excess))
            low[active] = np.where(excess > 0, here, low[active])
            high[active] = np.where((excess < 0) | lost, here, high[active])
            fails[active] = np.where(excess < 0, np.inf, np.where(lost, here, fails[active]))
            slope = -1.0 - heat.liquid.steepness(here) * np.maximum(excess + here - cold, 0.0)
            warms = excess > 0
            reach[active] = np.where(warms, -excess / slope, reach[active])
            excess_low[active] = np.where(warms, excess, excess_low[active])
            if before is not None:
                with np.errstate(divide="ignore", invalid="ignore"):
                    secant = (excess - before[1][active]) / (here - before[0][active])
                slope = np.where(secant < _FLATTEST, secant, slope)
            before = warm.copy(), np.full(count, np.nan)
            before[1][active] = excess
            step = here - excess / slope
            inside = (step > low[active]) & (step < high[active])
            enough = (tries >= _WITHIN) | ((tries >= _BEYOND) & (step >= HOTTEST))
            at_end = enough & (high[active] == HOTTEST) & ~tested[active]
            aside = np.where(at_end, HOTTEST, 0.5 * (low[active] + high[active]))
            # warmer oil is thinner: a load without a film at the coldest has none at all, mostly
            # even in a bearing that grows
            unknown = lost & (excess_low[active] == 0.0)
            aside = np.where(unknown & (thins or tries >= _WITHIN), cold, aside)
            tested[active] |= at_end & ~inside
            balanced = residual[active] <= tolerance
            warm[active] = np.where(balanced, here, np.where(inside, step, aside))
            width = high[active] - low[active]
            hopeless = np.isfinite(fails[active]) & (reach[active] > _AHEAD * width)
            active = active[(residual[active] > tolerance) & (width > shortest) & ~hopeless]
        shape = self.speed.shape
        fails = np.where((reach > _AHEAD * (high - low)) & (residual > tolerance), fails, np.inf)
        warm, residual = (
            np.where(np.isfinite(fails), *both) for both in ((low, warm), (excess_low, residual))
        )
        jumps = (high - low <= shortest) & (residual <= _JUMP)
        return _Warmth(
            np.broadcast_to(warm, shape).copy(),
            np.broadcast_to(residual, shape).copy(),
            tries,
            np.broadcast_to(jumps, shape).copy(),
            np.broadcast_to(fails, shape).copy(),
        )

    def _excess(self, temperature: Array, active: NDArray[np.int64]) -> Array:
        """How much warmer films at `temperature` would be after their own friction, K."""
        if self.share is None:
            state = self.film(temperature, active)
            power, flow = state["friction_power"], state["side_flow"]
        else:
            asked = np.flatnonzero(self.refused > temperature[0])
            if asked.size == 0:
                return np.array([np.nan])
            state = self.film(np.full(asked.size, temperature[0]), asked)
            share = np.where(state["converged"], self.share[asked], 0.0)
            if self.heat.growth is None:  # a bearing that grows may carry more when it is warm
                self.refused[asked[~state["converged"]]] = temperature[0]
            if not share.any():
                return np.array([np.nan])
            columns = np.nan_to_num([state["friction_power"], state["side_flow"]])
            power, flow = np.average(columns, axis=1, weights=share)[:, None]
        return self.heat.temperature(power, flow, temperature) - temperature


def shares(weights: ArrayLike | None, shape: tuple[int, ...]) -> Array | None:
    """Shares of time (n,) of loads of `shape`.

    Raises
    ------
    loadflow.errors.InputError
        Misshapen or negative shares, or none above 0.
    """
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


LEFT = 0.01
"""Of the clearance, what is left where the shaft has grown into the shell; no film carries."""


def clearance_at(bearing: JournalGeometry, heat: Heat, temperature: ArrayLike) -> Array:
    """Clearance with a film at some temperatures, K; m, at least `LEFT` of that as it is made."""
    assert heat.growth is not None
    wider = heat.growth.radial(temperature, heat.ambient_temperature, bearing.radius)
    return np.maximum(bearing.clearance + wider, LEFT * bearing.clearance)


def grown_by(bearing: JournalGeometry, heat: Heat, temperature: float) -> JournalGeometry:
    """The bearing with the clearance that it has with a film at `temperature`, K."""
    if heat.growth is None:
        return bearing
    clearance = float(clearance_at(bearing, heat, temperature))
    return replace(bearing, relative_clearance=clearance / bearing.radius)


def at_temperatures(
    solve: Callable[[JournalGeometry, Film, Array, Array, NDArray[np.int64]], Columns],
    bearing: JournalGeometry,
    film: Film,
) -> AtRest:
    """Equilibria of the oil as it enters, in what of bearing and flow goes with each temperature.

    That is the clearance of a bearing that grows, and the Reynolds number of turbulent flow: at a
    speed times η/η₀ the film of η₀ has it with a density times ρ/ρ₀ (η₀/η)².

    Parameters
    ----------
    solve : callable
        Equilibria in a bearing and of an isothermal film, as `AtRest` without temperatures.
    bearing : JournalGeometry
        As it is made.
    film : Film
        With heat.
    """
    heat, cold = cast("Heat", film.heat), film.isothermal()
    enters = cold.liquid

    def at_rest(
        force: Array, speed: Array, places: NDArray[np.int64], temperature: Array
    ) -> Columns:
        if heat.growth is None and film.turbulence is None:
            return solve(bearing, cold, force, speed, places)
        joined: Columns = {}
        for one in np.unique(temperature):
            some = temperature == one
            oil, now = heat.lubricant(float(one)), grown_by(bearing, heat, float(one))
            heavier = oil.density * (enters.viscosity / oil.viscosity) ** 2
            own = replace(cold, lubricant=replace(enters, density=heavier))
            found = solve(now, own, force[some], speed[some], places[some])
            reynolds = found["reynolds_number"] * enters.density / heavier
            found = found | {"reynolds_number": reynolds}
            if heat.growth is not None:
                found = found | {"clearance": np.full(int(some.sum()), now.clearance)}
            for name, values in found.items():
                _put(joined, name, values, some, speed.size)
        return joined

    return at_rest


def _put(columns: Columns, name: str, values: Any, places: NDArray[Any], count: int) -> None:
    """Write `values` (m, …) of a column of `count` rows at some of their places, None as it is."""
    if values is None:
        columns[name] = None
        return
    shape = (count, *values.shape[1:])
    columns.setdefault(name, np.zeros(shape, dtype=values.dtype))[places] = values


def check_scalable(film: Film) -> None:
    """Refuse what does not depend on viscosity times speed alone.

    Raises
    ------
    loadflow.errors.InputError
        A groove with an orifice, a pump or a given flow.
    """
    supply = film.supply
    if supply is not None:
        restrictors = [g.restrictor for g in supply.grooves if g.restrictor is not None]
        if supply.pump is not None or not all(part.laminar for part in restrictors):
            raise InputError("supply: with heat, a groove has a given pressure or a capillary")
