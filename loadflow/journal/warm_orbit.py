"""Temperature of a film in motion: one of the whole series, or one that follows its heat balance.

A bearing warms over minutes and hours while its load changes in seconds. Without a heat capacity it
is too slow to follow: the film has one temperature, that of its mean friction and flow. With one,
C dT/dt = P − 2 ρ c_p Q (T − T_in) − K (T − T_ambient) goes along with the path. The film of
viscosity η is that of η₀ at the speed ω η/η₀ in a time that runs η₀/η times as fast, so that any
model follows a temperature over time; path and temperature are taken in turns until both agree.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError, ValidityWarning
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.growing_orbit import growing_orbit
from loadflow.journal.heat import HOTTEST, Heat
from loadflow.journal.line import Line
from loadflow.journal.models.model import Model
from loadflow.journal.questions import AtRest, InMotion, Steps
from loadflow.journal.solvers.messages import MORE_STEPS
from loadflow.journal.solvers.search import searches
from loadflow.journal.thermal import at_temperatures, check_scalable, grown_by, warm_film
from loadflow.numerics.convergence import Limits
from loadflow.quantities import FILM

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

SAMPLES = 64
"""Samples of a series whose mean friction and flow give the temperature of a film in motion."""

FEW, SURELY = 8, 30.0
"""Samples that tell about how warm the mean of all is; and by how much, K, their film must warm
beyond any temperature for that of all to have no balance either."""

MILDEST = 4
"""Loads of a series that go on to a more expensive model where the own one has a film for none."""

BALANCED = 2e-3
"""What is left of the heat balance of that mean, K: other samples move it by more."""

ABOUT = 0.2
"""The same of few of them, from whose temperature that of all is sought."""

SLOW = 0.01
"""Share of the fastest speed below which a shaft warms nothing: friction goes with its square."""

LEFT_OUT = 0.1
"""Share of the samples without a film at rest above which their mean is warned of."""

TOLERANCE, ROUNDS = 1e-3, 30
"""Change of the temperature from one path to the next, K, and paths that are tried."""

_SCALED = (
    "friction_power", "contact_power", "side_flow", "supply_flow", "supply_power", "groove_flow",
)  # fmt: skip


def warm_orbit(model: Model, asked: InMotion) -> xr.Dataset:
    """Path of the shaft in a film with a heat balance, and its `temperature`.

    Raises
    ------
    loadflow.errors.InputError
        A groove with an orifice, a pump or a given flow.
    loadflow.errors.SolverError
        No heat balance of the series, a film that gets too hot, or what the model raises.
    """
    bearing, film, time, steps = asked.bearing, asked.film, asked.time, asked.steps
    heat = cast("Heat", film.heat)  # the other kind is refused in motion
    check_scalable(film)
    start = heat.start_temperature
    if start is None or heat.capacity is None:
        start = series_temperature(model, bearing, film, asked.force, asked.speed, asked.line)
    stays = film if heat.capacity is None else replace(film, heat=replace(heat, growth=None))

    def piece(grown: JournalGeometry, some: slice, warm: float, own: Steps) -> xr.Dataset:
        """Path over some samples in a bearing that stays as it is, from a temperature, K."""
        there = replace(asked.at(np.arange(time.size)[some]), bearing=grown, steps=own)
        held = replace(stays, lubricant=heat.lubricant(warm), heat=None)

        def path(times: Array, speeds: Array) -> xr.Dataset:
            return model.orbit(replace(there, film=held, time=times, speed=speeds))

        if heat.capacity is None:
            return _told(path(there.time, there.speed), np.full(there.time.size, warm))
        if getattr(model, "stores_heat", False):
            begins = replace(own, temperature=warm)
            return model.orbit(replace(there, film=stays, steps=begins))
        return _in_turns(path, heat, there.time, there.speed, warm)

    if heat.capacity is not None and heat.growth is not None:
        return growing_orbit(piece, bearing, heat, time.size, start, steps)
    grown = grown_by(bearing, heat, start)
    if steps.start is not None:  # told in clearances as they are made
        steps = replace(steps, start=steps.start * (bearing.clearance / grown.clearance))
    return piece(grown, slice(0, time.size), start, steps)


def series_temperature(
    model: Model, bearing: JournalGeometry, film: Film, force: Array, speed: Array, line: Line
) -> float:
    """Temperature, K, of the mean friction and flow of equilibria spread over a series.

    Loads without a film at rest are left out of the mean: squeeze may carry them in motion. They
    are not passed on to a more expensive model, unless none has a film; then only the `MILDEST`.
    Neither are those asked in which the shaft hardly turns, as after a stop: nothing warms there.

    Raises
    ------
    loadflow.errors.SolverError
        No heat balance below the largest temperature.

    Warns
    -----
    loadflow.errors.ValidityWarning
        More than `LEFT_OUT` of the samples have no film at rest; names the largest load that does.
    """
    some = np.unique(np.linspace(0, speed.size - 1, SAMPLES).round().astype(int))
    turning = np.abs(speed[some])
    some = some[turning >= SLOW * turning.max()]
    severity = np.hypot(*force[some].T) / np.maximum(np.abs(speed[some]), 1e-300)
    some = np.roll(some, -int(severity.argmin()))  # each starts from the one before, so mildly
    limits = Limits(1e-10, 60, strict=False, refine=False)

    again = replace(line, searches=searches(speed.size, together=True))

    def mean(
        some: NDArray[np.int64], limits: Limits, start: float | None = None, about: bool = False
    ) -> dict[str, Any]:
        asked = AtRest(bearing, film, force[some], speed[some], again.at(some), limits)
        return _of_mean(model, asked, start, ABOUT if about else BALANCED)

    start, worth_asking = None, some.size <= 2 * FEW
    if not worth_asking:  # all of them are asked at few temperatures
        few = some[np.linspace(0, some.size - 1, FEW).round().astype(int)]  # the mildest first
        found = mean(few, limits, about=True)
        _check_warmth(found, SURELY)
        start = float(np.nanmax(found["temperature"])) if found["converged"].any() else None
        worth_asking = start is not None or _still_warms(found) > 0.0  # all may be in balance
    if worth_asking:
        found = mean(some, limits, start)
    if not found["converged"].any():
        _check_warmth(found)
        severity = np.hypot(*force[some].T) / np.maximum(np.abs(speed[some]), 1e-300)
        some = np.sort(some[np.argsort(severity, kind="stable")[:MILDEST]])
        limits = replace(limits, refine=True)
        again = replace(line, searches=searches(speed.size, together=True))
        found = mean(some, limits)
    converged = found["converged"]
    if not converged.any():
        _check_warmth(found)
        size = np.hypot(*force[some].T)
        every = AtRest(bearing, film, force, speed, again, Limits(1e-10, 60))
        raise SolverError(
            "orbit cannot start: no heat balance of its mean friction and flow; at rest no film "
            f"carries its mildest loads, from {size.min():.4g} N on"
            + _why_none(model, every.at(some[[size.argmin()]]))
        )
    if np.mean(converged) < 1.0 - LEFT_OUT:
        largest = np.hypot(*force[some][converged].T).max()
        warnings.warn(
            f"temperature of the film: at rest {converged.size - converged.sum()} of "
            f"{converged.size} loads of the series have none; it is that of the others, up to "
            f"{largest:.4g} N",
            ValidityWarning,
            stacklevel=5,
        )
    return float(np.nanmax(found["temperature"]))


def _of_mean(model: Model, asked: AtRest, start: float | None, tolerance: float) -> dict[str, Any]:
    """Films at the temperature of their mean friction and flow, first tried at `start`, K."""

    def solve(
        grown: JournalGeometry,
        cold: Film,
        forces: Array,
        speeds: Array,
        places: NDArray[np.int64],
    ) -> dict[str, Any]:
        line = asked.line.at(places)
        return model.equilibrium(AtRest(grown, cold, forces, speeds, line, asked.limits))

    film, force, speed = asked.film, asked.force, asked.speed
    at_rest, shares = (
        at_temperatures(solve, asked.bearing, film),
        np.full(speed.size, 1 / speed.size),
    )
    near = None if start is None else np.array([start])
    return warm_film(at_rest, force, speed, film, shares, tolerance, strict=False, start=near)


def _still_warms(found: dict[str, Any]) -> float:
    """What films that were found warm by, K; 0 where none was found."""
    left = float(np.max(found["heat_residual"], initial=0.0))
    return left if left < np.inf else 0.0


def _check_warmth(found: dict[str, Any], least: float = BALANCED) -> None:
    """Raise where films are found that warm by more than `least`, K, at every temperature."""
    left = _still_warms(found)
    if not found["converged"].any() and left > least:
        raise SolverError(
            f"orbit cannot start: no heat balance below {HOTTEST} K; the mean friction of loads "
            f"spread over the series still warms the film by {left:.3g} K"
        )


def _why_none(model: Model, asked: AtRest) -> str:
    """Why the one load has no film: as its search has told, or in the coldest oil."""
    told = None if asked.line.searches is None else asked.line.searches[0].why
    if told is not None and MORE_STEPS not in told[1]:
        return f": {told[1]}"
    heat, afresh = cast("Heat", asked.film.heat), replace(asked.line, searches=None)
    cold = replace(asked.film.isothermal(), lubricant=heat.lubricant(heat.coldest))
    grown = grown_by(asked.bearing, heat, heat.coldest)
    try:
        model.equilibrium(replace(asked, bearing=grown, film=cold, line=afresh))
    except SolverError as error:
        return f": {str(error).removeprefix('load 0: ')}"
    return ""


def _in_turns(
    path: Callable[[Array, Array], xr.Dataset], heat: Heat, time: Array, speed: Array, start: float
) -> xr.Dataset:
    """Path and temperature, taken in turns."""
    warm, reference = np.full(time.size, start), float(heat.liquid.viscosity(start))
    for _ in range(ROUNDS):
        thin = np.asarray(heat.liquid.viscosity(warm)) / reference
        slower = 0.5 * (1.0 / thin[1:] + 1.0 / thin[:-1])
        stretched = np.concatenate([[0.0], np.cumsum(np.diff(time) * slower)])
        found = path(stretched, speed * thin)
        power, flow = (found[name].values / thin for name in ("friction_power", "side_flow"))
        after = _temperatures(heat, time, power, flow, warm)
        change, warm = float(np.abs(after - warm).max()), after
        if change <= TOLERANCE:
            return _told(_scaled(found, thin, time), warm)
    raise SolverError(
        f"the temperature of the film still changes by {change:.3g} K after {ROUNDS} paths"
    )


def _scaled(path: xr.Dataset, thin: Array, time: Array) -> xr.Dataset:
    """The path over its own time, friction and flow those of the viscosity that it has."""
    import xarray as xr

    share = xr.DataArray(thin, dims=["time"])
    scaled = {
        name: (path[name] / share).transpose(*path[name].dims).assign_attrs(path[name].attrs)
        for name in _SCALED
        if name in path
    }
    about = path["time"].attrs
    return path.assign(scaled).assign_coords(time=("time", time, about))


def _temperatures(heat: Heat, time: Array, power: Array, flow: Array, at: Array) -> Array:
    """Temperatures over time, K; exact for the mean friction and flow of each step."""
    assert heat.capacity is not None
    carried = 2.0 * np.asarray(heat.liquid.density(at)) * heat.heat_capacity * flow
    power, carried = (0.5 * (values[1:] + values[:-1]) for values in (power, carried))
    lost = carried + heat.transfer
    gained = power + carried * heat.inlet_temperature + heat.transfer * heat.ambient_temperature
    warm = [float(at[0])]
    for step, out, into in zip(np.diff(time).tolist(), lost.tolist(), gained.tolist()):
        decay = out * step / heat.capacity
        share = -np.expm1(-decay) / decay if decay > 1e-12 else 1.0
        warm.append(warm[-1] + share * step / heat.capacity * (into - out * warm[-1]))
        if not warm[-1] < HOTTEST:
            raise SolverError(f"the film warms beyond {HOTTEST} K")
    return np.array(warm)


def _told(path: xr.Dataset, temperature: Array) -> xr.Dataset:
    return path.assign(temperature=("time", temperature, FILM["temperature"].attributes))
