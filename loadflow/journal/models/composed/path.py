"""A reduced film with effects through time, with as many points across as each stretch asks for.

Most of a path is resolved by few points. A stretch that asks for more is gone through again with
these, from the film that has come so far: its unknowns are taken between the points, so that gas
and oil stay where they are in the gap. The path goes on with them until few points would resolve
what they find.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.creep import Creep
from loadflow.journal.models.composed.kernels._loops import solve
from loadflow.journal.models.composed.kernels._pad_kernels import LAST, NEXT
from loadflow.journal.models.composed.kernels._pad_loops import solve_on_pads
from loadflow.journal.models.composed.model import (
    LEVELS,
    ComposedFilm,
    build,
    contact_share,
    rubs,
    unknowns_on,
    warn_unresolved,
)
from loadflow.journal.models.composed.pads import (
    Pads,
    PadWork,
    first_on_pads,
    make_pad_work,
    narrowest_on_pads,
    pads_of,
)
from loadflow.journal.models.composed.uneven import Thickness
from loadflow.journal.models.ring import no_start
from loadflow.journal.models.slow_heat import THIN, Warmth, cooled, slow_states
from loadflow.journal.questions import InMotion
from loadflow.journal.solvers.load_stepping import TOUCHING
from loadflow.journal.solvers.messages import at_edge, touched
from loadflow.journal.solvers.motion.transient import OrbitStopped, stopped
from loadflow.journal.solvers.statics import Statics

Array = NDArray[np.float64]

STEP_BEFORE = 4  # of the `past` of a state: the step to its last time, s; 0 at the first one
_BEGUN = (0.0, 0.0, np.inf)  # steps of the past of a first state
_NO_SLOPES = np.zeros((2, 0, 0))
STRETCH = 24  # samples that take more points together
_TRIES = 3  # of a first film, each from where the last one left the shaft
_LEAST_STEP = 1.0 / 1024  # of an eccentricity, as a share of it, below which its film is given up
LONG = 240  # samples that go on together with few; calls of fewer cost


class State(NamedTuple):
    """Film and shaft at the last time, and at the one before; shapes as in `ComposedWork`.

    `tilts` (4, p) and `on` (p,) are those of `PadWork` where pads tilt.
    """

    level: int
    last: Array
    before: Array
    place: Array
    place_before: Array
    place_earlier: Array
    past: Array
    tilts: Array | None = None
    on: NDArray[np.bool_] | None = None


@dataclass(frozen=True)
class Drive(InMotion):
    """What drives a path, and its films, one for each level that has been asked for.

    `viscosity` is that of the cells where it is uneven, `warm` the same film on the grid where pads
    tilt.
    """

    viscosity: Thickness | None = None
    warm: Statics | None = None
    models: dict[int, ComposedFilm] = field(default_factory=dict)

    @classmethod
    def of(cls, asked: InMotion, viscosity: Thickness | None, warm: Statics | None) -> Drive:
        """The drive of a path that is asked for."""
        return cls(**vars(asked), viscosity=viscosity, warm=warm)

    @property
    def specific_load(self) -> Array:
        """Loads over width and diameter (n,), Pa."""
        area = self.bearing.width * self.bearing.diameter
        return np.asarray(np.hypot(*self.force.T) / area)

    def model(self, level: int) -> ComposedFilm:
        """The film with the points across of a level."""
        if level not in self.models:
            given = self.bearing, self.film, self.speed, self.line, level
            model = build(*given, viscosity=self.viscosity)
            model.units.raise_scale(float(self.specific_load.max()))
            film = model.film._replace(ring=model.film.ring._replace(scale=model.units.scale))
            self.models[level] = replace(model, film=film)
        return self.models[level]


class March:
    """The loops over what drives a path, and the rows that they fill."""

    def __init__(self, drive: Drive) -> None:
        steps, self.drive = drive.steps, drive
        self.start, self.accuracy = steps.start, steps.accuracy
        self.levels = LEVELS
        if drive.viscosity is not None:  # as fine as the temperatures are
            self.levels = self.levels[-1:]
        self.model = model = drive.model(self.levels[0])
        contact = drive.film.contact
        rub = 0.0 if contact is None else contact.coefficient * drive.bearing.radius
        share = 0.5 if model.whole else 1.0
        self.warmth: Warmth
        self.warmth, self.states = slow_states(
            drive.film, model.units, share, rub, steps.temperature, drive.time.size
        )
        self.rows = np.zeros((drive.time.size, model.columns))
        self.lines, self.loads = model.lines(drive.time.size), model.loads(drive.force)
        self.typical = float(drive.specific_load.mean())
        self.reached: State | None = None
        self.work = 0.0  # Newton steps times cells so far

    def solve(self, level: int, place: Array, size: int, begin: int, end: int, most: int) -> bool:
        """Solve for the samples `begin` … `end`, and whether all have been; moves `place`."""
        model, drive = self.drive.model(level), self.drive
        solved = solve(
            model.film, model.work, place, size, begin, drive.time[:end], self.loads[:end],
            self.lines[:end], drive.speed[:end], drive.limits.tolerance, most, self.accuracy,
            self.rows[:end], _NO_SLOPES, self.warmth, self.states[:end],
        )  # fmt: skip
        return self._solved(begin, solved, model.work.u.size)

    def _solved(self, begin: int, solved: int, cells: int) -> bool:
        """Note what the samples from `begin` on took, and whether the last of them is found."""
        self.work += float(self.rows[begin:solved, at.ITERATIONS].sum() * cells)
        return bool(self.rows[solved - 1, at.CONVERGED])

    def resolved(self, level: int, begin: int, end: int) -> bool:
        """Whether the points of a level resolve the samples `begin` … `end`, or are the most."""
        some = slice(begin, end)
        rows, force = self.rows[some], self.drive.force[some]
        missed = self.model.unresolved_on_path(rows, force, self.typical)
        if level == self.levels[0]:
            missed |= rubs(rows, force)
        return level == self.levels[-1] or not missed.any()

    def asks_for_more(self, begin: int, end: int) -> bool:
        """Whether the first level would miss what a further one has found in these samples."""
        rows, force = self.rows[begin:end], self.drive.force[begin:end]
        missed = self.model.unresolved_on_path(rows, force, self.typical, at.BEYOND)
        return bool((missed | rubs(rows, force)).any())

    def begins(self, level: int, begin: Callable[[], Array]) -> State | None:
        """The film at the first time, and where the shaft is; None where it is not found."""
        model, most = self.drive.model(level), 2 * self.drive.limits.max_iterations
        work, size = model.work, model.size if self.start is None else 0
        work.bend[:] = self.lines[0, 2:]
        work.u[:] = model.cold()
        place = model.estimates(self.drive.force[:1], self.drive.speed[:1], self.lines[:1])[0]
        if self.start is not None:
            place[:2] = self.start
        found = self.solve(level, place, size, 0, 1, most)
        if not found and self.start is not None:
            found = self._approaches(level, place, most)
        if not found and self.start is None and model.film.give > 0.0:
            found = self._creeps(level, place, most)
        if not found and self.start is None:
            place[:] = begin()
            for _ in range(_TRIES):  # a film that has run away may leave its shaft near the answer
                work.u[:] = model.cold()
                for moving in (0, size):  # the film first
                    found = self.solve(level, place, moving, 0, 1, most)
                if found or not np.isfinite(place).all():
                    break
        bend = self.lines[0, 2:]
        return _first(level, work.u, place, bend) if found else None

    def _approaches(self, level: int, place: Array, most: int) -> bool:
        """Whether the film at the start is found by way of lesser eccentricities; moves `place`.

        In a shell that gives way the start may lie beyond the bore, where no film is near that of
        a rigid one.
        """
        work, known = self.drive.model(level).work, self.drive.model(level).cold()
        share, step, spent = 0.0, 0.5, self.rows[0, at.ITERATIONS]
        while share < 1.0 and step >= _LEAST_STEP:
            ahead = min(share + step, 1.0)
            work.u[:], place[:2] = known, ahead * np.asarray(self.start)
            found = self.solve(level, place, 0, 0, 1, most)
            spent += self.rows[0, at.ITERATIONS]
            if found:
                share, known = ahead, work.u.copy()
            else:
                step *= 0.5
        self.rows[0, at.ITERATIONS] = spent
        return share == 1.0

    def _creeps(self, level: int, place: Array, most: int) -> bool:
        """Whether the first film is found from faster or standing ones; moves `place`."""
        model, drive = self.drive.model(level), self.drive
        limits = replace(drive.limits, max_iterations=most)
        one = self.loads[:1], self.lines[:1]
        creep = Creep(model, *one, limits, self.warmth, self.states[:1])
        for found in creep.places(float(drive.speed[0])):
            place[:] = found
            if self.solve(level, place, model.size, 0, 1, most):
                self.rows[0, at.ITERATIONS] += creep.spent
                return True
        return False

    def goes_on(self, state: State, level: int, begin: int, end: int) -> State | None:
        """The film after the samples `begin` … `end`; None where it is not found."""
        model = self.drive.model(level)
        work, place = model.work, state.place.copy()
        if state is not self.reached or level != state.level:  # the factors are of another film
            work.kept[0] = 0.0
        work.last[:] = self._moved(state.last, state.level, level)
        work.before[:] = self._moved(state.before, state.level, level)
        work.u[:] = work.last
        work.places[0], work.places[3] = state.place_before, state.place_earlier
        work.past[:], work.bend[:] = state.past, state.past[2:4]
        most = self.drive.limits.max_iterations
        if not self.solve(level, place, model.size, begin, end, most):
            return None
        films, past = (work.last.copy(), work.before.copy()), work.past.copy()
        earlier = work.places[0].copy(), work.places[3].copy()
        self.reached = State(level, *films, place, *earlier, past)
        return self.reached

    def _moved(self, unknowns: Array, level: int, other: int) -> Array:
        """Unknowns (nx, L) at the points of another level."""
        if level == other:
            return unknowns
        return unknowns_on(unknowns, self.drive.model(level), self.drive.model(other))

    def least(self, state: State) -> float:
        """Narrowest gap that a state leaves in a rigid shell, clearances."""
        model = self.drive.model(state.level)
        return float(model.least(state.place[None], state.past[None, 2:4])[0])

    def not_begun(self) -> OrbitStopped:
        """Say that there is no film at the first time."""
        drive, row = self.drive, self.rows[0]
        ratio = float(np.hypot(row[at.X], row[at.Y]))
        given = drive.force[0], drive.speed[0], ratio, _found_in(row)
        return no_start(*given, self.work, self._touch(0))

    def stops(self, begin: int, end: int) -> OrbitStopped:
        """Say at which of the samples `begin` … `end` a path ends: the first without a film."""
        drive, last = self.drive, begin + int(np.argmin(self.rows[begin:end, at.CONVERGED]))
        row = self.rows[last]
        ratio = float(np.hypot(row[at.X], row[at.Y]))
        given = drive.time[last], drive.force[last], drive.speed[last], ratio
        why = self._touch(last) or at_edge(drive.bearing, row[[at.X, at.Y]])
        return stopped(*given, _found_in(row), why, self.work)

    def _touch(self, sample: int) -> str:
        """That a smooth shaft has met a rigid bore at a sample, as on the grid; else nothing.

        Of an aligned cylinder the cells alone say so: its film carries whatever comes.
        """
        place = self.rows[sample, [at.X, at.Y, at.TILT_X, at.TILT_Y]]
        bend, film = self.lines[sample, 2:], self.model.film
        round_ = not (place[2:].any() or bend.any() or film.ring.shaped)
        if round_ or film.give > 0.0 or film.rough.size > 0.0:
            return ""
        least = self._narrowest(place, bend)
        return touched(least, self.drive.bearing.clearance) if least < TOUCHING else ""

    def _narrowest(self, place: Array, bend: Array) -> float:
        """Narrowest gap, clearances, of a rigid bore at a `place` (4,) that was tried last."""
        return float(self.model.least(place[None], bend[None])[0])

    def results(self) -> dict[str, Any]:
        """Variables of the path so far."""
        speed = self.drive.speed * self.states[:, THIN]
        return self.model.results(self.rows, speed)


class _OnPads(March):
    """The same on pads that tilt, which begin as those of the grid."""

    def __init__(self, drive: Drive) -> None:
        super().__init__(drive)
        limits = replace(drive.limits, max_iterations=2 * drive.limits.max_iterations)
        first = drive.at_rest.at(np.array([0]))
        asked = replace(first, film=drive.film.isothermal(), limits=limits)
        self.first, self.gap = first_on_pads(asked, self.start, drive.warm)
        self.tilts = np.zeros((drive.time.size, self.gap.pads.size))
        self.pads: dict[int, tuple[Pads, PadWork]] = {}
        self.tried = self.pads_at(self.levels[0])[1]  # at which the last steps were

    def pads_at(self, level: int) -> tuple[Pads, PadWork]:
        """Pads of the film of a level."""
        if level not in self.pads:
            model = self.drive.model(level)
            pads = pads_of(model.film.ring, self.gap, float(model.cold()[0, 0]))
            self.pads[level] = pads, make_pad_work(model.work.u.shape, self.gap.pads.size)
        return self.pads[level]

    def solve(self, level: int, place: Array, size: int, begin: int, end: int, most: int) -> bool:
        model, drive, both = self.drive.model(level), self.drive, self.pads_at(level)
        self.tried = both[1]
        solved = solve_on_pads(
            model.film, model.work, *both, place, size, begin, drive.time[:end],
            self.loads[:end], self.lines[:end], drive.speed[:end], drive.limits.tolerance, most,
            self.accuracy, self.rows[:end], self.tilts[:end], self.warmth, self.states[:end],
        )  # fmt: skip
        return self._solved(begin, solved, model.work.u.size)

    def begins(self, level: int, begin: Callable[[], Array]) -> State | None:
        """The film at the first time, near the place of the grid; None where it is not found."""
        model, most = self.drive.model(level), 2 * self.drive.limits.max_iterations
        work, (_, pad_work), bend = model.work, self.pads_at(level), self.lines[0, 2:]
        work.bend[:], work.u[:] = bend, model.cold()
        place = self.first.place.copy()
        pad_work.tilts[:], pad_work.on[:] = self.first.tilts, self.first.on
        sizes = (0, model.size) if self.start is None else (0,)  # the film first
        if not [self.solve(level, place, size, 0, 1, most) for size in sizes][-1]:
            return None
        begun = _first(level, work.u, place, bend)
        return begun._replace(tilts=pad_work.tilts.copy(), on=pad_work.on.copy())

    def goes_on(self, state: State, level: int, begin: int, end: int) -> State | None:
        _, pad_work = self.pads_at(level)
        pad_work.tilts[:], pad_work.on[:] = state.tilts, state.on
        after = super().goes_on(state, level, begin, end)
        if after is None:
            return None
        return after._replace(tilts=pad_work.tilts.copy(), on=pad_work.on.copy())

    def least(self, state: State) -> float:
        assert state.tilts is not None
        model = self.drive.model(state.level)
        return self._on_tilted(model, state.place, state.past[2:4], state.tilts[LAST])

    def _narrowest(self, place: Array, bend: Array) -> float:
        return self._on_tilted(self.model, place, bend, self.tried.tilts[NEXT])

    def _on_tilted(self, model: ComposedFilm, place: Array, bend: Array, tilts: Array) -> float:
        """Narrowest gap, clearances, of pads of `tilts` (p,)."""
        centres, depth = model.centres(place[None], bend[None]), model.film.places.depth
        return float(narrowest_on_pads(self.drive.bearing, centres, depth, tilts[None])[0])

    def results(self) -> dict[str, Any]:
        tilts = self.tilts * self.drive.bearing.relative_clearance
        return super().results() | {"pad_tilt": tilts}


def _first(level: int, unknowns: Array, place: Array, bend: Array) -> State:
    """The state of a film at the first time, which has no past."""
    past, film = np.concatenate([bend, bend, _BEGUN]), unknowns.copy()
    return State(level, film, film, place, place, place, past)


def march_of(drive: Drive) -> March:
    """The loops over a drive that its bore asks for."""
    return _OnPads(drive) if Bore.of(drive.bearing).pads else March(drive)


def orbit(
    asked: InMotion,
    begin: Callable[[], Array],
    viscosity: Thickness | None = None,
    warm: Statics | None = None,
) -> dict[str, Any]:
    """Variables of the path over time.

    `begin` finds the first position (4,) where none is given and the film alone does not;
    `viscosity` and `warm` are those of `Drive`.

    Raises
    ------
    loadflow.errors.SolverError
        No equilibrium to start from, or a step that fails even when cut to 1/256.

    Warns
    -----
    loadflow.errors.ValidityWarning
        A pressure that changes more across the width than the polynomials do; names the time.
    """
    time, force = asked.time, asked.force
    march = march_of(Drive.of(asked, viscosity, warm))
    model, rows = march.model, march.rows
    for level in march.levels:
        state = march.begins(level, begin)
        if state is not None and march.resolved(level, 0, 1):
            break
    if state is None:
        raise march.not_begun()
    done, level, samples = 1, state.level, STRETCH
    while done < time.size:
        end = min(done + samples, time.size)
        after = march.goes_on(state, level, done, end)
        resolved = after is not None and march.resolved(level, done, end)
        if not resolved and level != march.levels[-1]:  # a stretch alone asks for more points
            level, samples = level + (samples == STRETCH), STRETCH
            continue
        if after is None:
            raise march.stops(done, end)
        if level == march.levels[0]:
            samples = min(2 * samples, LONG)
        elif not march.asks_for_more(done, end):
            level = march.levels[0]
        done, state = end, after
    # where surfaces rub, what is missed of the oil's pressure is little beside what they carry
    left = model.unresolved_on_path(rows, force) & ~rubs(rows, force)
    if left.any():
        warn_unresolved(left, f"t = {time[left.argmax()]:.6g} s")
    values = march.results() | {"x": rows[:, at.X], "y": rows[:, at.Y]}
    if asked.steps.step == "adaptive":
        values["steps"] = rows[:, at.STEPS].astype(int)
    if asked.film.contact is not None:
        values["contact_share"] = contact_share(values["contact_force"], force)
    return cooled(march.warmth, march.states, values)


def _found_in(row: Array) -> tuple[float, float, float]:
    """Residual, its rounding level, and Newton steps of a row."""
    residual, rounding, iterations = row[[at.RESIDUAL, at.ROUNDING, at.ITERATIONS]].tolist()
    return residual, rounding, iterations
