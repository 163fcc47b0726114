"""Films of a thrust collar for a whole series: tabulated once over gap and speed, interpolated."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize.elementwise import find_root

from loadflow.errors import InputError, SolverError
from loadflow.journal.film_model import Film
from loadflow.journal.thrust.bearings import ThrustBearing
from loadflow.journal.thrust.double_thrust import DoubleThrustBearing
from loadflow.journal.thrust.pads import check_film
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

_GAPS = 65  # nodes between the thinnest and the thickest film, evenly in its logarithm
_FEWEST = 17  # nodes of a column that is one
_DECADE = 8  # columns in a decade of speed
_PROBES = 8  # gaps at which the interpolation over speed is checked
_ROOTS = {"xatol": 0.0, "xrtol": 1e-12, "fatol": 0.0, "frtol": 0.0}
_CLOSED = 1e-9  # of the larger film force: an equilibrium is one
FORCE, PRESSURE, TORQUE, FILM, SIDE_FLOW = range(5)
"""Rows of a table: force, largest pressure above that of the edges, friction torque, least film,
and what leaves at the ends, whose error is not told: nothing that must hold follows from it."""

_POWERS = np.array([2.0, 2.0, 1.0, -1.0, -1.0])  # of the gap, and ...
_DRAGGED = np.array([1.0, 1.0, 1.0, 0.0, 1.0])  # ... of the speed, by which a row is nearly even


@dataclass(frozen=True)
class CollarFilms:
    """Films of a thrust collar under a series of forces, by interpolation.

    Attributes
    ----------
    gap : array (n,)
        Film of the front row, m; NaN, as all else, where no film was found.
    minimum_film, maximum_pressure : array (n,)
        Of both rows, m; Pa, absolute.
    friction_torque, friction_power : array (n,)
        N m, W.
    side_flow : array (n,)
        Oil that leaves at the ends of both rows, of films at rest at their gaps, m³/s.
    touching : array of bool (n,)
        Whether only a film under the thinnest of the table, or none, carries the force.
    converged : array of bool (n,)
        Whether the collar has a place at which both films carry the force.
    residual : array (n,)
        Imbalance of the tabulated forces over the larger one.
    iterations : array of int (n,)
        Steps of the search.
    interpolation_error : float
        Largest relative error of force, pressure, torque and least film by interpolation.
    """

    gap: Array
    minimum_film: Array
    maximum_pressure: Array
    friction_torque: Array
    friction_power: Array
    side_flow: Array
    touching: NDArray[np.bool_]
    converged: NDArray[np.bool_]
    residual: Array
    iterations: NDArray[np.int64]
    interpolation_error: float


@dataclass(frozen=True)
class CollarCurves:
    """A thrust collar whose films are tabulated over gap and speed.

    Each row of pads is solved once at 65 gaps for each speed of a fixed ladder, eight to a decade,
    and interpolated by cubics in the logarithms of gap and speed. Where the law has no pressure of
    its own the film scales exactly with the speed, and one column serves them all. Answers do not
    depend on what else is asked for.

    Attributes
    ----------
    collar : DoubleThrustBearing
        Its pads are rigid, or tilt freely on rigid pivots.
    film : Film
        As for its verbs.
    thinnest : float
        Smallest gap of the table, m.

    Raises
    ------
    loadflow.errors.InputError
        Pads on supports that give way; a thinnest gap that the play does not leave.

    Examples
    --------
    >>> from loadflow.journal import DoubleThrustBearing, Film, Guembel, Lubricant, ThrustBearing
    >>> from loadflow.journal.thrust.curves import CollarCurves
    >>> lands = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
    >>> collar = DoubleThrustBearing(lands, lands, play=4e-4)
    >>> film = Film(Lubricant(0.05), Guembel(cavitation_pressure=0.0), grid=(20, 10))
    >>> curves = CollarCurves(collar, film, thinnest=5e-6)
    >>> found = curves.equilibrium([1e6, -2e6], 10.0)
    >>> exact = collar.equilibrium(1e6, 10.0, film)
    >>> bool(abs(found.minimum_film[0] / exact.minimum_film - 1) < 1e-4)
    True
    >>> found.interpolation_error < 0.01
    True
    """

    collar: DoubleThrustBearing
    film: Film
    thinnest: float

    def __post_init__(self) -> None:
        check_film(self.film)
        least, most = self.thinnest, 0.5 * self.collar.play
        require(
            0 < least < most, "thinnest", least, f"must be > 0 m and below {most:g}, half the play"
        )
        for name, row in (("front", self.collar.front), ("back", self.collar.back)):
            if gives_way(row):
                raise InputError(
                    f"{name}: pads on supports that give way have no curve of their film over the "
                    "gap; solve them on the grid"
                )

    def equilibrium(self, force: ArrayLike, speed: ArrayLike) -> CollarFilms:
        """Films at the places at which they carry `force`.

        Parameters
        ----------
        force : array_like (n,)
            Along the axis, N; > 0 presses the collar on the front row.
        speed : array_like (n,) or float
            rad/s; without rotation there is no film.

        Returns
        -------
        CollarFilms

        Raises
        ------
        loadflow.errors.InputError
            Values that are not finite.
        loadflow.errors.SolverError
            No table, as its films carry nothing, and no answer of another one; samples of one sense
            of rotation that lack theirs are neither `converged` nor `touching`.
        """
        loads, speeds = np.broadcast_arrays(
            np.atleast_1d(np.asarray(force, float)), np.asarray(speed, float)
        )
        require(bool(np.isfinite(loads).all()), "force", force, "N, finite")
        require(bool(np.isfinite(speeds).all()), "speed", speed, "rad/s, finite")
        found = {name: np.full(loads.size, np.nan) for name in ("gap", "residual")}
        steps, carried = np.zeros(loads.size, np.int64), np.zeros(loads.size, bool)
        values = np.full((_POWERS.size, loads.size), np.nan)
        turning, error = speeds != 0.0, 0.0
        touching, why = ~turning, None
        for backwards in (False, True):
            at = np.flatnonzero(turning & ((speeds < 0) == backwards))
            sure = self._surely_touching(loads[at], speeds[at])  # these need no table
            touching[at[sure]], at = True, at[~sure]
            if not at.size:
                continue
            try:
                front, back = (
                    _Series(row, self.film, self.thinnest, self.collar.play, speeds[at])
                    for row in (self.collar.front, self.collar.back)
                )
            except SolverError as found_none:
                why = found_none
                continue
            gap, missing, steps[at], inside = self._places(front, back, loads[at])
            rows = front(gap), back(self.collar.play - gap)
            largest = np.maximum(rows[0][FORCE], rows[1][FORCE])
            found["gap"][at], found["residual"][at] = gap, np.abs(missing) / largest
            carried[at] = inside & (found["residual"][at] < _CLOSED)
            whole = np.maximum(front.least, back.least) < self.thinnest * (1 + 1e-9)
            touching[at] = ~inside & whole
            values[:, at] = [
                rows[0][FORCE] - rows[1][FORCE],
                self.film.edge_pressure + np.maximum(rows[0][PRESSURE], rows[1][PRESSURE]),
                rows[0][TORQUE] + rows[1][TORQUE],
                np.minimum(rows[0][FILM], rows[1][FILM]),
                rows[0][SIDE_FLOW] + rows[1][SIDE_FLOW],
            ]
            error = max(error, front.error, back.error)
        if why is not None and not np.any(carried | touching):
            raise why
        values[:, ~carried], found["gap"][~carried] = np.nan, np.nan
        return CollarFilms(
            gap=found["gap"],
            minimum_film=values[FILM],
            maximum_pressure=values[PRESSURE],
            friction_torque=values[TORQUE] * np.sign(speeds),
            friction_power=values[TORQUE] * np.abs(speeds),
            side_flow=values[SIDE_FLOW],
            touching=touching,
            converged=carried,
            residual=np.where(carried, found["residual"], np.nan),
            iterations=steps,
            interpolation_error=error,
        )

    def _surely_touching(self, loads: Array, speeds: Array) -> NDArray[np.bool_]:
        """Whether the thinnest film carries less than each load at the next speed of the ladder.

        A rotor that nearly stands passes many decades of speed, each of which would be tabulated.
        """
        found = np.zeros(loads.size, bool)
        if _scales(self.film):
            return found
        above = np.ceil(_DECADE * np.log10(np.abs(speeds))).astype(int)
        for number, ahead in {*zip(above.tolist(), (loads >= 0).tolist())}:
            row = self.collar.front if ahead else self.collar.back
            sense = -1 if speeds[0] < 0 else 1
            here = (above == number) & ((loads >= 0) == ahead)
            found[here] = np.abs(loads[here]) > _most(row, self.film, self.thinnest, sense, number)
        return found

    def _places(
        self, front: _Series, back: _Series, loads: Array
    ) -> tuple[Array, Array, NDArray[np.int64], NDArray[np.bool_]]:
        """Gap of the front row, force missing there, steps, and whether the table holds it."""
        play = self.collar.play

        def missing(place: Array, at: Array) -> Array:
            some = at.astype(int)
            gap = _gap_at(place, play)
            return loads[some] - front(gap, some)[FORCE] + back(play - gap, some)[FORCE]

        # the place as ln(gap / gap behind): each film is as finely searched as it is thin
        index = np.arange(loads.size, dtype=float)
        ends = np.log(front.least / (play - front.least)), np.log((play - back.least) / back.least)
        inside = missing(ends[0], index) * missing(ends[1], index) <= 0.0
        found = find_root(missing, ends, args=(index,), tolerances=_ROOTS)
        place = np.where(inside, found.x, 0.0)
        return _gap_at(place, play), missing(place, index), found.nit, inside


def _gap_at(place: Array, play: float) -> Array:
    """Gap of the front row, m, of the logarithm of its ratio to the one behind."""
    return np.asarray(play / (1.0 + np.exp(-place)))


class _Series:
    """One row of pads at the speeds of a series, of one sense of rotation."""

    def __init__(
        self, row: ThrustBearing, film: Film, thinnest: float, play: float, speeds: Array
    ) -> None:
        self._speeds = np.abs(speeds)
        sense = -1 if speeds[0] < 0 else 1
        ends = thinnest, play
        if _scales(film):
            numbers, self._weights = np.zeros((1, 1), int), np.ones((1, speeds.size))
            self._first = np.zeros(speeds.size, int)
        else:
            place = _DECADE * np.log10(self._speeds)
            first = np.floor(place).astype(int) - 1
            numbers = np.unique(first)
            self._first = np.searchsorted(numbers, first)
            numbers = numbers[:, None] + np.arange(4)
            self._weights = _lagrange(place - first)
        columns = [[_column(row, film, ends, sense, int(k)) for k in group] for group in numbers]
        self._columns = columns
        least = np.array([max(one.gaps[0] for one in group) for group in columns])
        self.least = least[self._first]
        self.error = max(one.error for group in columns for one in group)
        if len(numbers[0]) == 4:
            between = (_between(row, film, ends, sense, int(k[0])) for k in numbers)
            self.error = max(self.error, *between)

    def __call__(self, gap: Array, some: NDArray[np.int64] | slice = slice(None)) -> Array:
        """Table's rows (5, n) at gaps (n,), m, of `some` of the series."""
        x, first, weights = np.log(gap), self._first[some], self._weights[:, some]
        found = np.empty((_POWERS.size, gap.size))
        for k in np.unique(first):
            here = first == k
            for number, column in enumerate(self._columns[k]):
                part = weights[number, here] * column.spline(x[here]).T
                found[:, here] = part if number == 0 else found[:, here] + part
        speed = self._speeds[some]
        return np.asarray(found * gap ** -_POWERS[:, None] * speed ** _DRAGGED[:, None])


@dataclass(frozen=True, eq=False)
class _Column:
    """Films of a row of pads over the gap at one speed."""

    gaps: Array
    values: Array

    @cached_property
    def spline(self) -> CubicSpline:
        """The rows over the logarithm of the gap, times the powers that keep them even."""
        return CubicSpline(np.log(self.gaps), self.values, axis=0)

    @cached_property
    def error(self) -> float:
        """Error of the spline through every other node at those between, an upper bound."""
        values = self.values[:, :SIDE_FLOW]
        coarse = CubicSpline(np.log(self.gaps[::2]), values[::2], axis=0)
        inner = slice(1, self.gaps.size - 1, 2)
        between = coarse(np.log(self.gaps[inner]))
        return float(np.abs(between / values[inner] - 1.0).max())


@lru_cache(maxsize=512)
def _column(
    row: ThrustBearing, film: Film, ends: tuple[float, float], sense: int, number: int
) -> _Column:
    """Solve a row of pads at one speed of the ladder over all gaps, down to the first without film.

    Raises
    ------
    loadflow.errors.SolverError
        Hardly any gap has one.
    """
    speed = sense * _speed(number)
    gaps, found = np.geomspace(*ends, _GAPS), []
    for gap in gaps[::-1].tolist():
        try:
            found.append(_solved(row, film, gap, speed))
        except SolverError:
            break
    if len(found) < _FEWEST:
        raise SolverError(
            f"ω = {speed:.3g} rad/s: no film carries a load at a gap of {gap:.3g} m; where it "
            "diverges in this sense of rotation, none does"
        )
    kept = gaps[-len(found) :]
    return _Column(kept, np.array(found[::-1]))


@lru_cache(maxsize=512)
def _most(row: ThrustBearing, film: Film, gap: float, sense: int, number: int) -> float:
    """Force of the thinnest film at one speed of the ladder, N; infinite where it is not known."""
    try:
        return float(row.pressure(gap, sense * _speed(number), film).force)
    except SolverError:
        return math.inf


def _solved(row: ThrustBearing, film: Film, gap: float, speed: float) -> Array:
    """A node of the table: its rows, times the powers that keep them even."""
    state = row.pressure(gap, speed, film)
    if state.force <= 0.0:
        raise SolverError(f"ω = {speed:.3g} rad/s, gap {gap:.3g} m: the film carries no load")
    pressure, torque = state.maximum_pressure - film.edge_pressure, abs(state.friction_torque)
    side = float(np.sum(state.side_flow))
    values = np.array([state.force, pressure, torque, state.minimum_film, side])
    return np.asarray(values * gap**_POWERS * abs(speed) ** -_DRAGGED)


def _speed(number: float) -> float:
    """Speed of a column, rad/s."""
    return float(10.0 ** (number / _DECADE))


@lru_cache(maxsize=512)
def _between(
    row: ThrustBearing, film: Film, ends: tuple[float, float], sense: int, number: int
) -> float:
    """Error of the cubic through four columns from `number` on, amid them: solved at some gaps."""
    columns = [_column(row, film, ends, sense, number + k) for k in range(4)]
    count = min(one.gaps.size for one in columns)
    speed = sense * _speed(number + 1.5)
    errors = []
    for k in range(-count, 0, max(count // _PROBES, 1)):
        exact = _solved(row, film, float(columns[0].gaps[k]), speed)
        values = _lagrange(np.array([1.5]))[:, 0] @ [one.values[k] for one in columns]
        errors.append(np.abs(values[:SIDE_FLOW] / exact[:SIDE_FLOW] - 1.0).max())
    return float(max(errors))


def _lagrange(place: Array) -> Array:
    """Weights (4, n) of columns 0 … 3 at places (n,) between 1 and 2."""
    nodes = np.arange(4.0)
    return np.array(
        [
            np.prod([(place - b) / (a - b) for b in nodes if b != a], axis=0)
            for a in nodes
        ]
    )  # fmt: skip


def _scales(film: Film) -> bool:
    """Whether the law has no pressure of its own, so that the film scales with viscosity x speed.

    Its pressure above that of the edges then does.
    """
    return film.law.pressure_unit(film.edge_pressure) == 0.0


def gives_way(row: ThrustBearing) -> bool:
    """Whether supports of the pads move under their load, so that films do not scale.

    Examples
    --------
    >>> from loadflow.journal import Pivot, ThrustBearing
    >>> from loadflow.journal.thrust.curves import gives_way
    >>> gives_way(ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, pivot=Pivot(stiffness=1e9)))
    True
    """
    pivot = row.pivot
    return pivot is not None and (
        math.isfinite(pivot.stiffness) or 0.0 < pivot.tilt_stiffness < math.inf
    )
