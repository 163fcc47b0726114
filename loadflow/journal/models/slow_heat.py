"""Temperature of a film in motion as a slow state beside its path.

One temperature T stands for the whole film, as in `loadflow.journal.thermal`. Bearing and oil store
heat, C dT/dt = P − 2 ρ c_p Q (T − T_in) − K (T − T_ambient). A film depends on viscosity, speed and
time through η ω and η/dt: one of viscosity η is that of η₀ at the speed ω η/η₀ in steps longer by
η₀/η, its friction and flow larger by η₀/η. So nothing is assembled anew as the oil warms.
"""

from __future__ import annotations

from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film_model import Film
from loadflow.journal.heat import HOTTEST, Heat
from loadflow.numerics.linked import LINKED, njit

Array = NDArray[np.float64]

_TABLE = 0.25  # distance of the temperatures of the table, K

# columns of a row of states
TEMPERATURE, THIN, POWER, CARRIED, STEP = range(5)
STATES = 5


class Warmth(NamedTuple):
    """Heat of a film in the units of the compiled loops.

    Attributes
    ----------
    on : bool
        Whether there is any.
    coldest : float
        First temperature of the table, K.
    table : array (2, n)
        Viscosity over that of the film, and 2 ρ c_p, J/(m³ K), each `_TABLE` kelvins.
    inlet, ambient : float
        K.
    transfer, capacity : float
        W/K; J/K.
    flow, drag, rub : float
        Of a film without warmth: power and flow over the sums of `summarise`, the second over ω²,
        too; power over ∫ p_a and |ω|, m.
    light : float
        1/(2 ρ c_p) of the film as it is computed, m³ K/J.
    """

    on: bool
    coldest: float
    table: Array
    inlet: float
    ambient: float
    transfer: float
    capacity: float
    flow: float
    drag: float
    rub: float
    light: float


COLD = Warmth(False, 0.0, np.ones((2, 2)), 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
"""Of a film whose temperature is not followed."""


def standing_states(count: int) -> Array:
    """States (count, STATES) of a film whose viscosity stays as it is."""
    states = np.zeros((count, STATES))
    states[:, THIN] = 1.0
    return states


def slow_states(
    options: Film, film: DiscreteFilm, share: float, rub: float, start: float, count: int
) -> tuple[Warmth, Array]:
    """Heat of a film for the compiled loops, and its states (count, STATES) over time.

    Parameters
    ----------
    options : Film
        With heat that is stored, or without.
    film : DiscreteFilm
        What is computed: its units are those of `share` of the sums, its viscosity the reference.
    share : float
        Of the sums of the compiled loops that are in these units.
    rub : float
        Boundary friction times the radius of the shaft, m.
    start : float
        Temperature at the first time, K.
    count : int
        Number of times.
    """
    states = standing_states(count)
    heat = cast("Heat | None", options.heat)  # the other kind is refused in motion
    if heat is None or heat.capacity is None:
        return COLD, states
    states[0, TEMPERATURE] = start
    states[0, THIN] = float(heat.liquid.viscosity(start)) / film.viscosity
    clearance = film.relative_clearance * film.radius
    drag = share * film.mirrors * film.viscosity * film.radius**4 / clearance
    return _warmth_of(heat, film.viscosity, share * film.pockets.flow_unit, drag, rub), states


def cooled(warmth: Warmth, states: Array, values: dict[str, Any]) -> dict[str, Any]:
    """Results of a film of the reference viscosity as those at its temperature.

    Raises
    ------
    loadflow.errors.SolverError
        A film that gets too hot.
    """
    if not warmth.on:
        return values
    warm = states[:, TEMPERATURE]
    if not warm.max() < HOTTEST:
        raise SolverError(
            f"the film warms beyond {HOTTEST} K: it reaches {warm.max():.5g} K at sample "
            f"{int(np.argmax(warm))}"
        )
    thin = states[:, THIN]
    thinner = {name: (values[name].T / thin).T for name in _SCALED if name in values}
    return values | thinner | {"temperature": warm}


_SCALED = (
    "friction_power", "contact_power", "side_flow", "supply_flow", "supply_power", "groove_flow",
)  # fmt: skip


def _warmth_of(heat: Heat, viscosity: float, flow: float, drag: float, rub: float) -> Warmth:
    """Heat of a film that is computed with a `viscosity`, Pa s."""
    assert heat.capacity is not None
    low = heat.coldest - 10.0 * _TABLE
    temperature = np.arange(low, HOTTEST + 20.0 * _TABLE, _TABLE)
    oil = heat.liquid
    light = 0.5 / (float(oil.density(heat.inlet_temperature)) * heat.heat_capacity)
    table = np.stack(
        [
            np.asarray(oil.viscosity(temperature)) / viscosity,
            2.0 * np.asarray(oil.density(temperature)) * heat.heat_capacity,
        ]
    )
    return Warmth(
        True, low, table, heat.inlet_temperature, heat.ambient_temperature, heat.transfer,
        heat.capacity, flow, drag, rub, light,
    )  # fmt: skip


@njit(nogil=True, **LINKED)
def slow_heat(warmth, states, n, step, speed, rows, first, normal):
    """Temperature at time `n`, a `step` (s) after the last; returns viscosity over the film's.

    Second order: exact for the friction and flow of the middle of the step, which go on as straight
    lines from the last two times. `first` and the two columns after it of `rows` are dissipation,
    shear and outflow, `normal` (if ≥ 0) ∫ p_a.
    """
    row, state = rows[n - 1], states[n - 1]
    thin = state[THIN]
    omega = speed[n - 1] * thin
    power = (warmth.flow * row[first] + warmth.drag * omega * omega * row[first + 1]) / thin
    if normal >= 0:
        power += warmth.rub * abs(speed[n - 1]) * row[normal]
    carried = _at(warmth, 1, state[TEMPERATURE]) * warmth.flow * row[first + 2] / thin
    state[POWER], state[CARRIED] = power, carried
    if n > 1:
        half = 0.5 * step / state[STEP]
        power = max(power + half * (power - states[n - 2, POWER]), 0.0)
        carried = max(carried + half * (carried - states[n - 2, CARRIED]), 0.0)
    states[n, STEP] = step
    lost = carried + warmth.transfer
    gained = power + carried * warmth.inlet + warmth.transfer * warmth.ambient
    warm = state[TEMPERATURE]
    decay = lost * step / warmth.capacity
    if decay > 1e-12:
        warm = gained / lost + (warm - gained / lost) * np.exp(-decay)
    else:
        warm += gained * step / warmth.capacity
    states[n, TEMPERATURE] = warm
    states[n, THIN] = _at(warmth, 0, warm)
    return states[n, THIN]


@njit(nogil=True, **LINKED)
def lighter(warmth, states, n):
    """Density of the oil at time `n` over that of the film."""
    return warmth.light * _at(warmth, 1, states[n, TEMPERATURE])


@njit(nogil=True, **LINKED)
def _at(warmth, row, temperature):
    """Value of the table at a temperature, held at its ends; exponentials between its points."""
    place = (temperature - warmth.coldest) / _TABLE
    i = min(max(int(place), 0), warmth.table.shape[1] - 2)
    t = min(max(place - i, 0.0), 1.0)
    low, high = warmth.table[row, i], warmth.table[row, i + 1]
    return low * (high / low) ** t
