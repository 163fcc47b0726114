"""One shaft in two reduced films with effects, followed through time.

Both films and the shaft are one system: each film has the loads, and the shaft the tilt, that the
other one leaves, with what the moments of the films bend it, and turn housings. Smooth films
do not keep shaft and shell apart for sure where it is pressed on a bearing end, as cells are
wider than the film is long there; what surfaces that touch do is done by a stop at each end.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.film import Composed, ShelledFilm
from loadflow.journal.models.composed.kernels._loops import solve
from loadflow.journal.models.composed.kernels._pad_loops import solve_on_pads
from loadflow.journal.models.composed.kernels._shared_loops import follow
from loadflow.journal.models.composed.model import (
    LEVELS,
    ComposedFilm,
    build,
    contact_share,
    rubs,
    unknowns_on,
)
from loadflow.journal.models.composed.pads import first_on_pads
from loadflow.journal.models.composed.path import STRETCH
from loadflow.journal.models.composed.shared_sides import (
    COORDINATES,
    SHAFT,
    Lying,
    Shared,
    gap_of_pads,
    pads_beside,
    side_of,
)
from loadflow.journal.models.finer_orbit import on_enough_cells
from loadflow.journal.models.ring import no_start
from loadflow.journal.models.slow_heat import (
    COLD,
    THIN,
    cooled,
    standing_states,
)
from loadflow.journal.questions import AtRest
from loadflow.journal.solvers.motion.transient import OrbitStopped, orbit_dataset, stopped
from loadflow.numerics.convergence import Limits

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

_LONG = 48  # samples that go on together with few points: more are gone through in vain
_SHARES = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.0)  # of the way out of the middle
_ROOM = 0.1  # gap, clearances, that the first place leaves at bearing ends
_RESTED = 40  # steps that double, from that of a series to a thousand years
_NOW = np.zeros(1)
_MOST_AROUND = 240  # cells, of pads on which a path stops on fewer


@dataclass(frozen=True)
class SharedPath:
    """Path of a shaft in two films; first dimension time, second the film.

    Attributes
    ----------
    position, tilt : array (n, 2, 2)
        m; rad.
    moment : array (n, 2, 2)
        Of the shaft on the film and what it touches, N m.
    paths : list of xarray.Dataset
        Of each film, as `JournalBearing.orbit` gives it.
    """

    position: Array
    tilt: Array
    moment: Array
    paths: list[xr.Dataset]


def follow_shared(
    bearings: Sequence[JournalGeometry],
    options: Sequence[Film],
    time: Array,
    speed: Array,
    lying: Lying,
    control: Limits,
    temperature: Sequence[float] = (0.0, 0.0),
    rests: bool = False,
) -> SharedPath:
    """Follow a shaft in two films.

    Parameters
    ----------
    bearings, options : sequence
        The two bearings and their films, with no heat over the area.
    time, speed : array (n,)
        s; rad/s.
    lying : Lying
        How the shaft lies in them.
    control : Limits
        How hard each step is solved.
    temperature : sequence of float
        Of both films at the first time, K, where they store heat.
    rests : bool
        Whether both have come to rest under the first loads, at the first speed; else the shaft
        lies there as near its loads as it can. One that stands rests on asperities.

    Raises
    ------
    OrbitStopped
        No film to begin with, or a step that fails even when cut to 1/256; on tilting pads on more
        cells around, too, which each path tells as `cells_around`.
    """

    def path(films: Sequence[Film]) -> SharedPath:
        return _followed(_March(bearings, films, time, speed, lying, control, temperature), rests)

    # only ends of pads may meet the shaft between cells
    most = [_MOST_AROUND if Bore.of(bearing).pads else 0 for bearing in bearings]
    return on_enough_cells(options, path, most)


def _followed(march: _March, rests: bool) -> SharedPath:
    """The path of a march."""
    time = march.time
    march.begins()
    if rests:
        march.rests()
    done, samples, levels = 1, STRETCH, [LEVELS[0]] * 2
    while done < time.size:
        end = min(done + samples, time.size)
        reached = march.goes_on(levels, done, end)
        more = [
            k
            for k, level in enumerate(levels)
            if level != LEVELS[-1] and (reached < end or march.unresolved(k, done, end, at.HIGHEST))
        ]
        if more:  # a stretch alone asks for more points
            march.goes_back()
            if samples == STRETCH:
                levels = [level + (k in more) for k, level in enumerate(levels)]
            samples = STRETCH
            continue
        if reached < end:
            raise march.stops(reached)
        if levels == [LEVELS[0]] * 2:
            samples = min(2 * samples, _LONG)
        levels = [
            level if march.unresolved(k, done, end, at.BEYOND) else LEVELS[0]
            for k, level in enumerate(levels)
        ]
        done = end
    return march.told()


class _March:
    """The loop over films and shaft, on the points across that stretches ask for."""

    def __init__(
        self,
        bearings: Sequence[JournalGeometry],
        options: Sequence[Film],
        time: Array,
        speed: Array,
        lying: Lying,
        control: Limits,
        temperature: Sequence[float],
    ) -> None:
        self.time, self.speed, self.lying, self.control = time, speed, lying, control
        size = np.hypot(*np.moveaxis(lying.force, -1, 0))
        area = np.array([bearing.width * bearing.diameter for bearing in bearings])
        self.typical, self.levels = size.mean(axis=0) / area, [LEVELS[0]] * 2
        most = size.max(axis=0) / area
        self.films = {n: self._films(bearings, options, most, n) for n in LEVELS}
        first = self.films[LEVELS[0]]
        self.gaps = [gap_of_pads(m, lying.force[:1, k], speed[:1]) for k, m in enumerate(first)]
        self.pads = {n: list(map(pads_beside, both, self.gaps)) for n, both in self.films.items()}
        flat = self.pads[LEVELS[0]]
        self.sides = [side_of(k, first, lying, temperature[k], flat) for k in range(2)]
        felt = [side.felt[:2, :COORDINATES] for side in self.sides]
        load = sum(lying.force[:, k] @ felt[k] for k in range(2))
        many = self.sides[0].lies.shape[1]
        slip = np.zeros((0, 2)) if lying.seats is None else lying.seats.slip
        slip = slip / [bearing.radius for bearing in bearings]
        now, before, new, step, missing = np.zeros((5, many))
        self.shared = Shared(
            np.array(load), now, before, new, step, missing, system=np.zeros((many, many + 1)),
            slip=slip, held=np.ones((many - SHAFT) // 2), steps=np.zeros(1), told=np.zeros(2),
        )  # fmt: skip
        self.before: list[tuple[NDArray[Any], NDArray[Any]]] = []

    def _films(
        self, bearings: Sequence[JournalGeometry], options: Sequence[Film], most: Array, level: int
    ) -> list[ComposedFilm]:
        """Both films with the points across of a level, up to `most` load over area, Pa."""
        models = []
        for k, (bearing, film) in enumerate(zip(bearings, options)):
            line = Line(tilt=self.lying.tilt[:, k], bend=self.lying.bend[:, k])
            model = build(bearing, film, self.speed, line, level)
            model.units.raise_scale(float(most[k]))
            ring = model.film.ring._replace(scale=model.units.scale)
            models.append(replace(model, film=model.film._replace(ring=ring)))
        kinds = {type(model.film) for model in models}
        if len(kinds) > 1:  # the loop knows two of one kind, that of all their effects
            kind = ShelledFilm if ShelledFilm in kinds else Composed
            models = [replace(model, film=kind(*model.film)) for model in models]
        return models

    def begins(self) -> None:
        """Films at the first time, around a shaft that lies as near its loads as it can.

        Under these alone, aligned, it may lie so far apart in both films that it has no place.
        """
        models = self.films[LEVELS[0]]
        far = []
        for k, (side, model) in enumerate(zip(self.sides, models)):
            along = np.concatenate([np.zeros((1, 2)), side.bend[:1]], axis=1)
            far.append(model.estimates(self.lying.force[:1, k], self.speed[:1], along)[0, :2])
        for share in _SHARES:
            self.shared.at[:COORDINATES] = share * np.concatenate(far)
            for side in self.sides:
                side.place[:] = side.lies @ self.shared.at + side.given[0]
            for k in range(self.shared.held.size):
                self._follows(k)
            both = zip(self.sides, models)
            room = min(m.least(s.place[None], s.bend[:1])[0] for s, m in both)
            last = share == _SHARES[-1]
            if (room > _ROOM or last) and self._pads_hold(last):
                break
        for k, side in enumerate(self.sides):
            self._held(k)
            side.past[:4], side.past[4:6], side.past[6:] = side.place, side.bend[0], side.bend[0]
        self.shared.before[:] = self.shared.at

    def _pads_hold(self, last: bool) -> bool:
        """Whether pads that tilt have a film at the first time, on which they are put.

        Raises
        ------
        loadflow.errors.InputError, loadflow.errors.SolverError
            They have none at the `last` place that is tried.
        """
        for k, (side, model, gap) in enumerate(zip(self.sides, self.films[LEVELS[0]], self.gaps)):
            if gap is None:
                continue
            unit = model.bearing.clearance / model.bearing.radius
            line = Line(tilt=unit * side.place[None, 2:], bend=self.lying.bend[:1, k])
            given = self.lying.force[:1, k], self.speed[:1], line, self.control
            asked = AtRest(model.bearing, model.options.isothermal(), *given)
            try:
                first, _ = first_on_pads(asked, side.place[:2])
            except (InputError, SolverError):  # the former where they meet the shaft
                if last:
                    raise
                return False
            side.pad_work.tilts[:], side.pad_work.on[:] = first.tilts, first.on
        return True

    def _held(self, k: int) -> None:
        """The film at the first time, around a shaft that is held at its place."""
        side, model, force = self.sides[k], self.films[LEVELS[0]][k], self.lying.force[:1, k]
        work, limits = side.work, (self.control.tolerance, 4 * self.control.max_iterations)
        line = np.concatenate([side.place[None, 2:], side.bend[:1]], axis=1)
        work.bend[:], work.u[:], work.kept[0] = side.bend[0], model.cold(), 0.0
        given = side.place, 0, 0, _NOW, model.loads(force), line, self.speed[:1] * side.thin[0]
        rows, still = side.rows[:1], (COLD, standing_states(1))
        if self.gaps[k] is None:
            solve(side.film, work, *given, *limits, np.inf, rows, np.zeros((2, 0, 0)), *still)
        else:
            pads = side.pads, side.pad_work
            solve_on_pads(
                side.film, work, *pads, *given, *limits, np.inf, rows, side.tilts[:1], *still
            )
        if not side.rows[0, at.CONVERGED] > 0.0:
            missed = tuple(side.rows[0, [at.RESIDUAL, at.ROUNDING, at.ITERATIONS]])
            ratio = float(np.hypot(*side.place[:2]))
            raise no_start(force[0], float(self.speed[0]), ratio, missed)
        work.kept[0] = 0.0

    def rests(self) -> None:
        """Let both films come to rest under the first loads.

        They are followed under these in steps that double, until nothing is squeezed out any more,
        at the temperature of the first time.
        """

        def first(rows: Array) -> Array:
            return rows[:1].repeat(_RESTED, axis=0)

        sides = [
            side._replace(
                given=first(side.given), bend=first(side.bend), states=first(side.states),
                rows=first(side.rows), tilts=first(side.tilts),
                warmth=side.warmth._replace(on=False),
            )
            for side in self.sides
        ]  # fmt: skip
        shared = self.shared
        still = shared._replace(load=first(shared.load), slip=first(shared.slip))
        step = self.time[1] - self.time[0] if self.time.size > 1 else 1.0
        time, speed = step * (2.0 ** np.arange(_RESTED) - 1.0), first(self.speed)
        limits = self.control.tolerance, self.control.max_iterations
        done = follow(sides[0], sides[1], still, 1, time, speed, *limits)
        if done < _RESTED:
            k = int(np.argmin([side.rows[done - 1, at.LEAST] for side in sides]))
            given = self.lying.force[0, k], self.speed[0], float(np.hypot(*sides[k].place[:2]))
            raise no_start(*given, (float(shared.told[0]), 0.0, int(shared.told[1])))
        for side, rested in zip(self.sides, sides):
            side.rows[0], side.tilts[0] = rested.rows[-1], rested.tilts[-1]

    def _follows(self, k: int) -> None:
        """Turn the shell of a film with the shaft, at the first time: elastic, or slid so far."""
        side, own = self.sides[k], SHAFT + 2 * k
        give, turned = -side.lies[2, own], side.place[2:].copy()
        if np.isinf(self.shared.slip[0, k]) and give > 0.0:
            self.shared.at[own : own + 2] += turned / give
            side.place[2:] = 0.0
        elif give > 0.0:
            side.slipped[2:] = turned
            side.place[2:] = 0.0

    def goes_on(self, levels: list[int], begin: int, end: int) -> int:
        """Go through the samples `begin` … `end` with points of `levels`; how many are done."""
        for k, level in enumerate(levels):
            if level != self.levels[k]:
                self._take(k, level)
        kept: list[NDArray[Any]] = [*self.shared[1:3], self.shared.steps]
        for side in self.sides:
            kept += [
                side.place,
                side.past,
                side.thin,
                side.work.last,
                side.work.before,
                side.slipped,
                side.pad_work.tilts,
                side.pad_work.on,
            ]
        self.before = [(values, values.copy()) for values in kept]
        first, second = self.sides
        return follow(
            first, second, self.shared, begin, self.time[:end], self.speed[:end],
            self.control.tolerance, self.control.max_iterations,
        )  # fmt: skip

    def goes_back(self) -> None:
        """Take back what was before the last samples."""
        for values, before in self.before:
            values[:] = before
        for side in self.sides:
            side.work.u[:] = side.work.last
            side.work.kept[0] = 0.0

    def _take(self, k: int, level: int) -> None:
        """A film on the points across of another level."""
        here, there = self.films[self.levels[k]][k], self.films[level][k]
        for name in ("last", "before", "u"):
            moved = unknowns_on(getattr(here.work, name), here, there)
            getattr(there.work, name)[:] = moved
        there.work.kept[0] = 0.0
        pads, pad_work = self.pads[level][k]
        before = self.sides[k].pad_work
        pad_work.tilts[:], pad_work.on[:] = before.tilts, before.on
        self.sides[k] = self.sides[k]._replace(
            film=there.film, work=there.work, pads=pads, pad_work=pad_work
        )
        self.levels[k] = level

    def unresolved(self, k: int, begin: int, end: int, by: int) -> bool:
        """Whether few points miss, or would miss, the pressure of a film in these samples."""
        rows, force = self.sides[k].rows[begin:end], self.lying.force[begin:end, k]
        model = self.films[self.levels[k]][k]
        missed = model.unresolved_on_path(rows, force, float(self.typical[k]), by)
        return bool((missed | rubs(rows, force)).any())

    def stops(self, done: int) -> OrbitStopped:
        """Say at which time the path ends."""
        k = int(np.argmin([side.rows[done - 1, at.LEAST] for side in self.sides]))
        ratio = float(np.hypot(*self.sides[k].place[:2]))
        residual, iterations = self.shared.told
        missed = float(residual), 0.0, int(iterations)
        return stopped(self.time[done], self.lying.force[done, k], self.speed[done], ratio, missed)

    def told(self) -> SharedPath:
        """What the loop has found."""
        models, rows = self.films[LEVELS[0]], [side.rows for side in self.sides]
        lengths = np.array([[m.bearing.clearance, m.bearing.radius] for m in models])

        def both(*columns: int) -> Array:
            return np.stack([each[:, columns] for each in rows], axis=1)

        paths = []
        for k, (model, side) in enumerate(zip(models, self.sides)):
            values = model.results(rows[k], self.speed * side.states[:, THIN])
            values |= {"x": rows[k][:, at.X], "y": rows[k][:, at.Y]}
            force = self.lying.force[:, k]
            if model.options.contact is not None:
                values["contact_share"] = contact_share(values["contact_force"], force)
            if side.pad_work.on.size:
                values["pad_tilt"] = side.tilts * model.bearing.relative_clearance
            values = cooled(side.warmth, side.states, values)
            given = self.time, force, self.speed, model.bearing.clearance
            around = model.options.cells[0]
            paths.append(orbit_dataset(values, *given).assign_attrs(cells_around=around))
        return SharedPath(
            position=both(at.X, at.Y) * lengths[:, :1],
            tilt=both(at.TILT_X, at.TILT_Y) * (lengths[:, :1] / lengths[:, 1:]),
            moment=both(at.MOMENT_X, at.MOMENT_Y) * lengths[:, 1:],
            paths=paths,
        )
