"""Reduced films with effects at rest, load by load, on the points of one level."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.cell_error import Balance, resting_errors
from loadflow.journal.film.discretise import crowds_around
from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.creep import Creep
from loadflow.journal.models.composed.error import Judged
from loadflow.journal.models.composed.film import Composed
from loadflow.journal.models.composed.kernels._loops import solve
from loadflow.journal.models.composed.model import ComposedFilm, build, contact_share, unknowns_on
from loadflow.journal.models.composed.supply import falls_dry
from loadflow.journal.models.composed.thickening import less_thickening, thickening_of
from loadflow.journal.models.composed.uneven import Thickness
from loadflow.journal.models.slow_heat import COLD, standing_states
from loadflow.journal.questions import AtRest
from loadflow.journal.rows import operating_columns
from loadflow.journal.solvers.estimate import NEAR, OFF_THE_BORE
from loadflow.journal.solvers.search import IN_VAIN
from loadflow.numerics.convergence import Limits

Array = NDArray[np.float64]

_AT_REST = np.zeros(1)  # one time
_NO_SLOPES = np.zeros((2, 0, 0))
_THICKER, _LEAST_THICKER = 0.25, 1.0 / 64  # steps of the coefficient of a liquid that thickens
_MISSED = 0.6  # of the load where the shaft touches: above 0.46 the grid had a film in no draw


class Start(NamedTuple):
    """Where Newton's method starts: a place (4,), whether it is the first, steps that led to it."""

    place: Array
    first: bool = False
    spent: int = 0


class Known(NamedTuple):
    """Films of some loads: unknowns (nx, L) and place (4,) of each, on the points of a model."""

    films: dict[int, tuple[Array, Array]]
    model: ComposedFilm

    def on(self, model: ComposedFilm, n: int) -> tuple[Array, Array] | None:
        """Film of load `n` on the points of another model."""
        if n not in self.films:
            return None
        unknowns, place = self.films[n]
        points = self.model.film.nodes.slopes.shape, model.film.nodes.slopes.shape
        if points[0] == points[1] and self.model.options is model.options:  # the same ones
            return unknowns.copy(), place
        return unknowns_on(unknowns, self.model, model), place


@dataclass(frozen=True)
class RestingFilms:
    """Films at rest under loads, and which loads have one.

    Attributes
    ----------
    answer : dict
        Fields of `Equilibrium`, (n, …).
    found : array of bool (n,)
        Loads that have an answer.
    left : array of bool (n,)
        Loads whose pressure asks for more points across.
    none : array of bool (n,)
        Loads that surely have no film.
    thin : array of bool (n,)
        Loads whose film in an elastic shell asks for more cells around.
    model : ComposedFilm
        The film that they were solved on.
    films : dict
        Of loads that are left: unknowns (nx, L) and place (4,).
    """

    answer: dict[str, Any]
    found: NDArray[np.bool_]
    left: NDArray[np.bool_]
    none: NDArray[np.bool_]
    thin: NDArray[np.bool_]
    model: ComposedFilm
    films: dict[int, tuple[Array, Array]] = field(default_factory=dict)


def films_at_rest(
    asked: AtRest,
    level: int,
    begun: Known | None = None,
    may_leave: bool = False,
    viscosity: Thickness | None = None,
) -> RestingFilms:
    """Films on the points of a `level`; those of loads that are `begun` begin there.

    Loads that surely ask for more cells around are not solved if these `may_leave`; `viscosity` is
    that of `build`.
    """
    bearing, options, line = asked.bearing, asked.film, asked.line
    force, speed = asked.force, asked.speed
    model = build(bearing, options, speed, line, level, at_rest=True, viscosity=viscosity)
    crowding = crowds_around(bearing, options, line, asked.limits.refine)
    work, count = model.work, speed.size
    rows = np.zeros((count, model.columns))
    both = 4 if model.whole else 2
    stiffness, damping = np.zeros((count, both, both)), np.zeros((count, both, both))
    none, thin, slopes = np.zeros(count, bool), np.zeros(count, bool), np.zeros((2, both, both))
    loads = _Loads(model, force, speed, model.lines(count), asked.limits)
    judged = Judged(model.film.ring, model.film.nodes, model.film.held.on, count)
    films: dict[int, tuple[Array, Array]] = {}
    last: int | None = None
    vain = 0
    together = line.searches is not None and line.searches[0].together
    for n in range(count):
        hardly = together and last is None and vain >= IN_VAIN
        spent, converged, residual, rounding = 0, False, np.inf, 0.0
        work.liquid[:] = 0.0
        if speed[n] == 0.0 and options.contact is None and loads.loads[n].any():
            rows[n, at.RESIDUAL] = np.inf
            continue  # no film without rotation and squeeze
        if may_leave and model.surely_thin(loads.places[n], force[n]):
            thin[n], rows[n, at.RESIDUAL] = True, np.inf
            continue
        for start in loads.starts(n, last, rows, begun and begun.on(model, n)):
            row = loads.solve(start.place, n, slopes=slopes)
            residual, iterations, answered, rounding = row[at.RESIDUAL : at.RESULTS]
            spent += start.spent + int(iterations)
            converged = answered > 0.0 and (not crowding or model.resolves(start.place))
            converged = converged and not falls_dry(model.units, row[at.RESULTS :])
            none[n] = start.first and _MISSED < residual < 1.0 and model.touches(start.place)
            if converged:
                rows[n], stiffness[n], damping[n] = row, *slopes
                work.last[:] = work.u
                last = n
                model.judge(judged, n, speed[n])
                thin[n] = model.film.give > 0.0 and not model.resolves_gap(row[at.LEAST])
                if model.unresolved_across(row[None])[0]:
                    films[n] = work.u.copy(), start.place.copy()
            if answered or none[n] or (hardly and start.first):
                break
        rows[n, at.RESIDUAL : at.RESULTS] = residual, spent, converged, rounding
        vain += not converged
    lengths = np.array([1.0, 1.0, bearing.radius, bearing.radius])[:both]
    scale = np.outer(lengths, lengths) / bearing.clearance
    answer = {
        **operating_columns(bearing, force, speed, options.liquid, rows[:, [at.X, at.Y]]),
        "moment": np.zeros((count, 2)),
        "tilt": np.zeros((count, 2)),
        "pad_tilt": np.zeros((count, 0)),
        **model.results(rows, speed),
        "stiffness": stiffness * scale,
        "damping": damping * scale,
    }
    answer["relative_grid_error"] = _errors(model, judged, rows, force, answer, stiffness)
    if options.contact is not None:
        answer["contact_share"] = contact_share(answer["contact_force"], force)
    found, left = rows[:, at.CONVERGED] > 0, model.unresolved_across(rows)
    return RestingFilms(answer, found, left, none, thin, model, films)


def _errors(
    model: ComposedFilm,
    judged: Judged,
    rows: Array,
    force: Array,
    answer: dict[str, Any],
    stiffness: Array,
) -> Array:
    """Relative bounds of what cells and points leave out, (n, 7); `stiffness` is per clearance."""
    contact, size, rubbing = model.options.contact, model.size, np.zeros(len(rows))
    if contact is not None:
        rubbing = answer["contact_power"] / np.maximum(answer["friction_power"], 1e-300)
        rubbing = rubbing / np.maximum(rows[:, at.NORMAL], 1e-300)
    half = model.bearing.width / model.bearing.diameter
    balance = Balance(
        position=rows[:, [at.X, at.Y]],
        facing=judged.facing[:, :size],
        stiffness=stiffness[:, :size, :size],
        arms=np.array([1.0, 1.0, 0.5 * half, 0.5 * half])[:size],
        narrow=rows[:, at.LEAST] if contact is None else judged.narrow,
        growth=rows[:, at.GROWTH],
        opens=judged.opens,
        load=force,
        touching=None if contact is None else rows[:, [at.CONTACT_X, at.CONTACT_Y]],
        rubbing=rubbing,
        fed=model.film.held.on,
    )
    return resting_errors(judged.left(), balance)


class _Loads:
    """Loads on one film at rest, and where the film of each may start."""

    def __init__(
        self, model: ComposedFilm, force: Array, speed: Array, lines: Array, control: Limits
    ) -> None:
        self.model, self.force, self.speed, self.lines = model, force, speed, lines
        self.control, self.loads = control, model.loads(force)
        self.places = model.estimates(force, speed, lines)

    def solve(
        self,
        place: Array,
        n: int,
        size: int | None = None,
        slopes: Array = _NO_SLOPES,
        film: Composed | None = None,
    ) -> Array:
        """Row of load `n`; `place` moves in `size` coordinates to where it is carried.

        A `film` that is given takes the place of that of the model.
        """
        model, this, row = self.model, slice(n, n + 1), np.zeros((1, self.model.columns))
        solve(
            model.film if film is None else film, model.work, place,
            model.size if size is None else size, 0, _AT_REST, self.loads[this], self.lines[this],
            self.speed[this], self.control.tolerance, self.control.max_iterations, np.inf, row,
            slopes, COLD, standing_states(1),
        )  # fmt: skip
        return row[0]

    def starts(
        self, n: int, last: int | None, rows: Array, begun: tuple[Array, Array] | None
    ) -> Iterator[Start]:
        """Where load `n` may start, after load `last`; sets the unknowns of each.

        The last ones are off the bore with their film solved: near the bore, and without a film,
        the first steps of a shaft lead far away.
        """
        model, work, places = self.model, self.model.work, self.places
        if begun is not None:
            work.u[:] = begun[0]
            yield Start(begun[1].copy())
        near = last is not None and self._near(n, last, rows[last])
        if last is not None and near:
            yield self._after(n, last, rows)
        work.u[:] = model.cold()
        place = places[n].copy()
        yield Start(place, first=True)
        if model.film.held.on and np.isfinite(place).all():
            work.u[:] = model.cold()  # a film that has run away may leave its shaft near the answer
            row = self.solve(place, n, size=0)
            yield Start(place, spent=int(row[at.ITERATIONS]))
        spent = (yield from self._thickening(n)) if model.film.thickening.on else 0
        if last is not None and model.film.give > 0.0 and not near:
            yield self._after(n, last, rows)
        spent += (yield from self._creeping(n)) if model.film.give > 0.0 else 0
        for share in OFF_THE_BORE:
            work.u[:] = model.cold()
            place = places[n].copy()
            place[:2] *= share
            row = self.solve(place, n, size=0)
            yield Start(place, spent=spent + int(row[at.ITERATIONS]))
            spent = 0

    def _after(self, n: int, last: int, rows: Array) -> Start:
        """Start of load `n` where the `last` one ended; sets the unknowns."""
        self.model.work.u[:] = self.model.work.last
        tilt = (rows[last, :4] if self.model.size == 4 else self.places[n])[2:]
        return Start(np.append(rows[last, :2], tilt))

    def _thickening(self, n: int) -> Generator[Start, None, int]:
        """Where load `n` may start by way of liquids that thicken less; sets the unknowns.

        Returns the steps of a way that led nowhere.
        """
        model, work, place, spent = self.model, self.model.work, self.places[n].copy(), 0
        work.u[:] = model.cold()
        share, step, held = 0.0, _THICKER, (work.u.copy(), place.copy())
        while step >= _LEAST_THICKER:
            liquid = less_thickening(model.options.liquid, share)
            film = model.film._replace(thickening=thickening_of(liquid, model.units.p_edge))
            row = self.solve(place, n, film=film)
            spent += int(row[at.ITERATIONS])
            if row[at.CONVERGED] > 0.0 and share == 1.0:
                yield Start(place, spent=spent)
                return 0
            if row[at.CONVERGED] > 0.0:
                reached, held = share, (work.u.copy(), place.copy())
            elif share == 0.0:
                break
            else:
                step *= 0.5
                work.u[:], place[:] = held[0], held[1]
            share = min(reached + step, 1.0)
        return spent

    def _near(self, n: int, last: int, row: Array) -> bool:
        """Whether the place of load `n` is near that of the `last` one, which has a `row`."""
        model, places = self.model, self.places
        moved, turned = np.hypot(*(places[n] - places[last]).reshape(2, 2).T)
        gap = max(1.0 - np.hypot(*row[:2]), model.film.rough.size)
        given = 0.0 if model.size == 4 else turned * model.film.nodes.z.max()
        return bool(moved + given < NEAR * gap)

    def _creeping(self, n: int) -> Generator[Start, None, int]:
        """Where a standing or creeping shaft in a shell may start; sets the unknowns of each.

        Returns the steps of ways that led nowhere.
        """
        one, told = (self.loads[n : n + 1], self.lines[n : n + 1]), 0
        creep = Creep(self.model, *one, self.control, COLD, standing_states(1))
        for place in creep.places(float(self.speed[n])):
            yield Start(place, spent=creep.spent - told)
            told = creep.spent
        return creep.spent - told
