"""Films of a thrust collar through a series: tilted, warm and in motion, on tables of its rows."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import cast

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize.elementwise import find_root

from loadflow.errors import SolverError
from loadflow.journal.film_model import Film
from loadflow.journal.heat import HOTTEST
from loadflow.journal.pad_heat import PadHeat
from loadflow.journal.thrust.bearings import ThrustBearing
from loadflow.journal.thrust.collar_motion import FOLLOWED, backward, followed, rates
from loadflow.journal.thrust.collar_sides import TRIES, Side
from loadflow.journal.thrust.curves import CollarFilms
from loadflow.journal.thrust.double_thrust import DoubleThrustBearing
from loadflow.journal.thrust.pads import check_film
from loadflow.journal.thrust.row_table import MOST, RowTable
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

_ROOTS = {"xatol": 0.0, "xrtol": 1e-12, "fatol": 0.0, "frtol": 0.0}
_CLOSED = 1e-9  # of the larger force
_WARM = 1e-6  # K left of a balance
_MEANS = 64  # samples whose mean friction and flow give the temperatures of a path


@dataclass(frozen=True)
class CollarPath(CollarFilms):
    """Films of a thrust collar under a series of forces.

    What it has beside `CollarFilms`:

    Attributes
    ----------
    front_temperature, back_temperature : array (n,)
        Of the films of each row, K; NaN without heat.
    moment : array (n, 2)
        What the tilted collar applies to both rows about both axes, N m, of films at rest at their
        gaps; the shaft gets it back.
    moment_error : float
        Largest relative error of the moment of a row by interpolation; 0 of a collar that never
        tilts.
    """

    front_temperature: Array
    back_temperature: Array
    moment: Array
    moment_error: float

    @property
    def restoring_moment(self) -> Array:
        """Its size (n,), N m."""
        return np.hypot(*self.moment.T)

    @property
    def temperature(self) -> Array:
        """Of the warmer row, K."""
        return np.fmax(self.front_temperature, self.back_temperature)


@dataclass(frozen=True)
class CollarSeries:
    """A thrust collar under series of loads, at rest or in motion along its axis.

    Its rows are tabulated by `RowTable`: films that rupture at the pressure of their edges. What a
    law of its own changes is measured, and part of `interpolation_error`.

    Attributes
    ----------
    collar : DoubleThrustBearing
        Its pads are fixed, or tilt freely on rigid pivots.
    film : Film
        As for its verbs; with `PadHeat` each row is as warm as its friction makes it.
    contact : float
        Film below which the surfaces touch, m.
    tilts : bool
        Whether the shaft may be tilted.
    span : (float, float), optional
        Gaps between which its rows are tabulated, m; left out, half of the contact and the play.
        Collars that differ little share the tables of one of them.

    Raises
    ------
    loadflow.errors.InputError
        Pads on supports that give way; more contact than the play leaves.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.journal import DoubleThrustBearing, Film, Guembel, PadHeat, ThrustBearing
    >>> from loadflow.journal.thrust.collar_series import CollarSeries
    >>> lands = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
    >>> collar = DoubleThrustBearing(lands, lands, play=4e-4)
    >>> film = Film(None, Guembel(), grid=(8, 4), heat=PadHeat("iso-vg-68"))
    >>> series = CollarSeries(collar, film, contact=4e-6)
    >>> found = series.equilibrium([1e6, -5e5], 10.0)
    >>> exact = collar.equilibrium(1e6, 10.0, film)
    >>> bool(abs(found.front_temperature[0] - exact.front.temperature) < 0.01)
    True
    """

    collar: DoubleThrustBearing
    film: Film
    contact: float
    tilts: bool = False
    span: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        check_film(self.film, knows_heat=True)
        least, most = self.contact, self.collar.play
        require(0 < least < most, "contact", least, f"must be > 0 m and below {most:g}, the play")
        self._table(self.collar.front), self._table(self.collar.back)

    def equilibrium(
        self, force: ArrayLike, speed: ArrayLike, tilt: ArrayLike = (0.0, 0.0)
    ) -> CollarPath:
        """Films at rest under each load, each with a heat balance of its own.

        Parameters
        ----------
        force : array_like (n,)
            Along the axis, N; > 0 presses the collar on the front row.
        speed : array_like (n,) or float
            rad/s; without rotation, and against the order of the pads, there is no film.
        tilt : array_like (n, 2) or (2,)
            Rotation of the collar about both axes, rad.

        Returns
        -------
        CollarPath

        Raises
        ------
        loadflow.errors.InputError
            Values that are not finite; a tilt of a collar that was said to have none.
        loadflow.errors.SolverError
            No table, as its films carry nothing.
        """
        loads, front, back = self._sides(force, speed, tilt)
        gap, missing, steps, inside = self._places(front, back, loads)
        return self._told(loads, front, back, gap, missing, steps, inside, 0.0 * gap, _CLOSED)

    def path(
        self, time: ArrayLike, force: ArrayLike, speed: ArrayLike, tilt: ArrayLike = (0.0, 0.0)
    ) -> CollarPath:
        """Path of the collar along its axis under loads that change, its mass neglected.

        Film forces less damping × velocity are the load; implicit steps of second order from the
        equilibrium of the first load, each by Newton from where the last ones lead. A film carries
        no tension. Where the surfaces touch, the film stays as thin as the table is. Each row has
        the one temperature of the mean friction and flow of 64 equilibria of the series. The tilt
        is followed without what its own rate squeezes; its moment is told, and does not act on it.

        Parameters
        ----------
        time : array_like (n,)
            s, increasing.
        force, speed, tilt
            As of `equilibrium`.

        Returns
        -------
        CollarPath
            `residual` and `iterations` are those of the path.

        Raises
        ------
        loadflow.errors.InputError
            As `equilibrium`; times that do not increase.
        loadflow.errors.SolverError
            As `equilibrium`; no heat balance.
        """
        loads, front, back = self._sides(force, speed, tilt)
        times = np.asarray(time, float)
        rising = times.shape == loads.shape and bool(np.all(np.diff(times) > 0))
        require(rising, "time", time, "s, increasing, one for each load")
        front, back = self._at_mean_temperature(loads, front, back)
        weights, play = backward(times), self.collar.play
        ends = self._ends(front, back)
        place, residual, steps = followed((front, back), loads, play, ends, weights)
        gap, inside = self._gap(place), np.ones(loads.size, bool)
        rate = rates(gap, weights)
        return self._told(loads, front, back, gap, residual, steps, inside, rate, FOLLOWED)

    @property
    def ends(self) -> tuple[float, float]:
        """Half of the contact, and the play: the gaps of its own tables, m."""
        return 0.5 * self.contact, self.collar.play

    # --- inside ----------------------------------------------------------------------------------
    def _table(self, row: ThrustBearing) -> RowTable:
        cells = self.film.grid or (40, 20)
        return RowTable(row, cells, *(self.span or self.ends), self.tilts)

    def _sides(
        self, force: ArrayLike, speed: ArrayLike, tilt: ArrayLike
    ) -> tuple[Array, Side, Side]:
        loads = np.atleast_1d(np.asarray(force, float))
        speeds = np.broadcast_to(np.asarray(speed, float), loads.shape)
        turned = np.broadcast_to(np.asarray(tilt, float), (loads.size, 2))
        for name, values, units in (
            ("force", loads, "N"), ("speed", speeds, "rad/s"), ("tilt", turned, "rad"),
        ):  # fmt: skip
            require(bool(np.isfinite(values).all()), name, values, f"{units}, finite")
        slope = np.hypot(*turned.T)
        require(self.tilts or not slope.any(), "tilt", tilt, "0 of a collar that does not tilt")
        direction = np.arctan2(turned[:, 0], -turned[:, 1])
        heat = cast("PadHeat | None", self.film.heat)
        oil = self.film.liquid.viscosity
        rows = (self.collar.front, direction), (self.collar.back, direction + math.pi)
        front, back = (Side(self._table(row), speeds, slope, at, oil, heat) for row, at in rows)
        return loads, front, back

    def _ends(self, front: Side, back: Side) -> tuple[Array, Array]:
        """Smallest and largest ln(front film/back film)."""
        play = self.collar.play
        first = np.minimum(front.least, 0.5 * play)
        last = np.minimum(back.least, 0.5 * play)
        return np.log(first / (play - first)), np.log((play - last) / last)

    def _places(
        self, front: Side, back: Side, loads: Array
    ) -> tuple[Array, Array, NDArray[np.int64], NDArray[np.bool_]]:
        """Gap of the front row, share of the force missing, steps, and whether there is one."""
        play = self.collar.play

        def forces(place: Array, at: Array) -> tuple[Array, Array]:
            some, gap = at.astype(int), self._gap(place)
            return front.at(gap, some).force, back.at(play - gap, some).force

        def missing(place: Array, at: Array) -> Array:
            one, other = forces(place, at)
            return loads[at.astype(int)] - one + other

        index, ends = np.arange(loads.size, dtype=float), self._ends(front, back)
        over = missing(ends[0], index), missing(ends[1], index)
        inside = (over[0] * over[1] <= 0.0) & (ends[0] < ends[1]) & (front.speed > 0.0)
        found = find_root(missing, ends, args=(index,), tolerances=_ROOTS)
        nearer = np.where(np.abs(over[0]) < np.abs(over[1]), *ends)
        place = np.where(inside, found.x, nearer)
        one, other = forces(place, index)
        scale = np.maximum(np.maximum(one, other), np.abs(loads))
        share = np.abs(loads - one + other) / np.where(scale > 0.0, scale, 1.0)
        return self._gap(place), share, found.nit, inside

    def _gap(self, place: Array) -> Array:
        return np.asarray(self.collar.play / (1.0 + np.exp(-place)))

    def _at_mean_temperature(self, loads: Array, front: Side, back: Side) -> tuple[Side, Side]:
        """Both rows at the temperatures of the mean friction and flow of some equilibria."""
        heat = front.heat
        if heat is None:
            return front, back
        some = np.unique(np.linspace(0, loads.size - 1, _MEANS).round().astype(int))
        few = [side.some(some) for side in (front, back)]
        warm = np.full(2, heat.inlet_temperature)
        ends, still = self._ends(few[0], few[1]), np.zeros((3, some.size))
        for _ in range(TRIES):
            held = [replace(side, held=float(one)) for side, one in zip(few, warm)]
            place, *_ = followed((held[0], held[1]), loads[some], self.collar.play, ends, still)
            inside = (ends[0] < place) & (place < ends[1]) & (few[0].speed > 0.0)
            if not inside.any():
                raise SolverError("no film carries any of the loads whose mean friction warms it")
            gap = self._gap(place)
            asked = []
            for side, at in zip(held, (gap, self.collar.play - gap)):
                row = side.at(at[inside], np.flatnonzero(inside))
                power, flow = (row.torque * side.speed[inside]).mean(), row.flow.mean()
                rise = heat.warming(power, flow) * (heat.carried(flow, row.side_flow.mean()) + 0.5)
                asked.append(heat.inlet_temperature + float(rise))
            left = np.array(asked) - warm
            if np.abs(left).max() < _WARM:
                return replace(front, held=float(warm[0])), replace(back, held=float(warm[1]))
            warm = heat.nearer(warm, np.array(asked))
        raise SolverError(f"no heat balance below {HOTTEST} K; it is off by {left.max():.2g} K")

    def _told(
        self,
        loads: Array,
        front: Side,
        back: Side,
        gap: Array,
        residual: Array,
        steps: NDArray[np.int64],
        inside: NDArray[np.bool_],
        rate: Array,
        within: float,
    ) -> CollarPath:
        behind, every = self.collar.play - gap, np.arange(loads.size)
        rows = front.at(gap, every), back.at(behind, every)
        moving = rate, -rate
        carried = [np.maximum(row.force - row.damping * v, 0.0) for row, v in zip(rows, moving)]
        pressure = np.maximum(
            front.pressure(gap, rows[0], carried[0]), back.pressure(behind, rows[1], carried[1])
        )
        thin = np.minimum(front.minimum_film(gap), back.minimum_film(behind))
        torque, speed = rows[0].torque + rows[1].torque, front.speed
        warm = [np.where(row.temperature < HOTTEST, row.temperature, np.nan) for row in rows]
        balanced = (
            np.ones(loads.size, bool) if front.heat is None else np.isfinite(warm[0] + warm[1])
        )
        touching = (thin < self.contact) | (~inside & ((speed == 0.0) | (thin <= 0.0)))
        found = inside & balanced & (residual < within) & ~touching
        shown = np.where(found, 1.0, np.nan)
        share = front.slope * front.table.row.outer_radius / np.minimum(gap, behind)
        most = float(np.max(share, where=found, initial=0.0))
        typical = float(np.median(np.abs(speed[found]))) if found.any() else 0.0
        film = self.film.isothermal()
        errors = np.zeros(2)
        for side in (front, back) if typical > 0.0 else ():
            errors = np.maximum(errors, _errors(side.table, film, most, typical))
        return CollarPath(
            gap=gap * shown,
            minimum_film=thin * shown,
            maximum_pressure=(self.film.edge_pressure + pressure) * shown,
            friction_torque=torque * np.sign(speed) * shown,
            friction_power=torque * np.abs(speed) * shown,
            side_flow=(rows[0].side_flow + rows[1].side_flow) * shown,
            touching=touching,
            converged=found,
            residual=residual * shown,
            iterations=np.asarray(steps),
            interpolation_error=float(errors[0]),
            front_temperature=warm[0] * shown,
            back_temperature=warm[1] * shown,
            moment=(rows[0].moment - rows[1].moment) * shown[:, None],
            moment_error=float(errors[1]),
        )


_errors_of: Callable[[RowTable, Film, float, float], Array] = lru_cache(maxsize=256)(
    lambda table, film, most, speed: table.errors(film, speed, most)
)


def _errors(table: RowTable, film: Film, most: float, speed: float) -> Array:
    """Errors of a table up to the next tenth of tilts, at a speed and a viscosity of one digit."""
    tilt = min(math.ceil(10.0 * most) / 10.0, MOST)
    thick = replace(film.liquid, viscosity=_one_digit(film.liquid.viscosity))
    return _errors_of(table, replace(film, lubricant=thick), tilt, _one_digit(speed))


def _one_digit(value: float) -> float:
    digit = 10.0 ** math.floor(math.log10(value))
    return round(value / digit) * digit
