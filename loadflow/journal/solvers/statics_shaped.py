"""Statics of a bearing of any shape, of a shaft that may tilt and bend, and of pads that tilt."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.film.discretise import build_shaped_film
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap_shaped import Bore
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.results import field_row, following, static_row
from loadflow.journal.shapes import Cylindrical
from loadflow.journal.solvers.estimate import closed_form_position, closer_of
from loadflow.journal.solvers.load_stepping import (
    APART,
    TOUCHING,
    solve_by_approach,
    solve_from_held,
    solve_in_load_steps,
)
from loadflow.journal.solvers.newton import (
    Motion,
    Solution,
    no_film,
    solve_equilibrium,
    solve_film,
)
from loadflow.journal.solvers.pads import solve_with_pads
from loadflow.numerics.convergence import Limits, unresolved
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

_LIFT = 0.3  # share of the gap over the pivot by which a pad is tilted at first
_ROOM = 0.02  # gap, in clearances, that the first position must leave
_PAD_ROUNDS = 8  # solutions in which pads may come under load, or lose theirs
_FLAT = 0.02  # curvature of a pad's gap, in clearances, that still holds it
_CROWDED = 2  # meshes that are tried beside the one asked for
_SAME = 0.02  # angle, rad, by which the place of the narrowest gap must have moved for another
_NARROW = 0.2  # narrowest gap, in clearances, above which no mesh but that is tried
_NEAR = 0.3  # share of the narrowest gap that the estimate may move for a warm start


def plain(bearing: JournalGeometry, line: Line) -> bool:
    """Whether the gap is that of a cylinder around an aligned, straight shaft."""
    return isinstance(bearing.shape, Cylindrical) and not bearing.relief and line.straight


def equilibrium_rows(
    bearing: JournalGeometry,
    options: Film,
    loads: Array,
    speeds: Array,
    line: Line,
    control: Limits,
    whirl: float,
) -> list[dict[str, Any]]:
    """Rows of `Equilibrium`."""
    statics = _Statics(bearing, options, line, float(np.abs(speeds).max()))
    rows = []
    last: Solution | None = None
    for index, (load, omega) in enumerate(zip(loads, speeds.tolist())):
        used, solution = statics.resolve(index, load, omega, last, control)
        if not solution.converged and control.strict:
            raise SolverError(f"load {index}: {used.refusal(load, solution)}")
        last = solution if solution.converged and used is statics else last
        rows.append(static_row(bearing, used.film, load, options.liquid, solution, whirl))
    return rows


def field_rows(
    bearing: JournalGeometry,
    options: Film,
    places: Array,
    velocities: Array,
    speeds: Array,
    line: Line,
    control: Limits,
) -> tuple[list[dict[str, Any]], Array]:
    """Rows of `FilmField` and axial places of the cells, m."""
    require(line.moment is None, "moment", "given", "tilt is given where the position is")
    fastest = np.abs(speeds) + np.hypot(velocities[:, 0], velocities[:, 1])
    statics = _Statics(bearing, options, line, float(fastest.max()))
    rows = []
    for index, (place, moving, omega) in enumerate(zip(places, velocities, speeds.tolist())):
        solution = statics.hold(index, place, moving, omega, control)
        if not solution.converged and control.strict:
            raise SolverError(f"film {index}: {statics.refusal(np.zeros(2), solution)}")
        rows.append(field_row(statics.film, solution))
    return rows, statics.film.mesh.z * bearing.radius


def orbit_start(
    bearing: JournalGeometry,
    options: Film,
    loads: Array,
    speeds: Array,
    line: Line,
    start: Array | None,
    control: Limits,
) -> tuple[DiscreteFilm, Solution, Array, NDArray[np.int64]]:
    """Film, first state, generalised loads (n, m) and moving degrees of freedom of an orbit.

    It begins at `start`, in clearances, or at the equilibrium of the first load.
    """
    require(not bore_of(bearing).pads, "shape", bearing.shape.kind, "a fixed bore for an orbit")
    statics = _Statics(bearing, options, line, float(np.abs(speeds).max()))
    gap, omega = statics.gap, float(speeds[0])
    forces = np.zeros((len(loads), gap.size))
    forces[:, :2] = loads
    if line.moment is not None:
        forces[:, 2:] = line.moment / bearing.radius
    size = float(np.linalg.norm(forces, axis=1).max())
    statics.film.raise_scale(size / (bearing.width * bearing.diameter))
    if start is None:
        first = statics.solve(0, loads[0], omega, None, control)
    else:
        first = statics.hold(0, start, np.zeros(2), omega, control)
    if not first.converged:
        raise SolverError(f"orbit cannot start: {statics.refusal(loads[0], first)}")
    free = np.arange(gap.size if line.moment is not None else 2)
    return statics.film, first, forces, free


class _Statics:
    """One film and what is given of the shaft's line, solved load by load."""

    def __init__(
        self,
        bearing: JournalGeometry,
        options: Film,
        line: Line,
        rate: float,
        crowd: tuple[float, ...] = (),
    ) -> None:
        self.bearing, self.line, self.options, self.rate = bearing, line, options, rate
        self.crowd = crowd
        self.gap, self.film = build_shaped_film(
            bore_of(bearing), bearing.shape, options, line.straight, crowd
        )
        self.film.set_scale(rate)
        self.pads = np.arange(self.gap.shaft, self.gap.size)

    def resolve(
        self, index: int, load: Array, omega: float, last: Solution | None, control: Limits
    ) -> tuple[_Statics, Solution]:
        """Equilibrium under load number `index`, and the film it was found on.

        Where the gap closes between the cells of the mesh there may be none on it, so that cells
        crowd where the gap was narrowest.
        """
        used, solution = self, self.solve(index, load, omega, last, control)
        for _ in range(_CROWDED):
            known = np.isfinite(solution.position).all()
            if solution.converged or self.film.elastic or not known:
                break
            crowd = used.gap.closing(solution.position, _NARROW)
            if not crowd or _same(crowd, used.crowd):
                break
            used = _Statics(self.bearing, self.options, self.line, self.rate, crowd)
            solution = used.solve(index, load, omega, None, control)
        return used, solution

    def solve(
        self, index: int, load: Array, omega: float, last: Solution | None, control: Limits
    ) -> Solution:
        """Equilibrium under load number `index`."""
        film, gap = self.film, self.gap
        film.relax()
        film.set_speed(omega)
        lifts = film.pockets.lifts(film.p_edge)
        if omega == 0.0 and load.any() and not lifts and film.contact is None:
            return no_film(film)
        force, held = np.zeros(gap.size), np.zeros(gap.size)
        force[:2] = load
        free = np.arange(2)
        if gap.tilts:
            self._straighten(index, held)
            if self.line.moment is not None:
                free = np.arange(4)
                force[2:4] = self.line.moment[index] / self.bearing.radius
        estimate = self._estimate(load, held, free)
        free = np.append(free, self._tilting(estimate))
        if omega == 0.0 and not lifts and not (film.contact is not None and load.any()):
            return solve_film(film, film.start(), estimate, 0.0 * estimate, control.tolerance, 1)
        for _ in range(_PAD_ROUNDS):
            self._idle(free)
            solution = self._newton(force, estimate, last, free, control)
            tilting = self._tilting(solution.position)
            if not solution.converged or np.array_equal(tilting, free[free >= gap.shaft]):
                break
            estimate[:2], last = solution.position[:2], None
            estimate = self._lifted(estimate)
            free = np.append(free[free < gap.shaft], tilting)
        if not solution.converged and film.elastic:
            solution = solve_in_load_steps(film, force, estimate, control.tolerance, free)
        elif not solution.converged:
            limits = self._limits(control)
            if free[-1] >= gap.shaft:
                shaft = free[free < gap.shaft]
                pads = (self._tilting, lambda pads: self._idle(np.append(shaft, pads)))
                solution = solve_with_pads(film, gap, force, estimate, shaft, *pads, *limits)
            if not solution.converged:
                self._idle(free)
                solution = solve_from_held(film, force, estimate, *limits, free)
        return self._apart(replace(solution, estimate=estimate))

    def _newton(
        self,
        force: Array,
        estimate: Array,
        last: Solution | None,
        free: NDArray[np.int64],
        control: Limits,
    ) -> Solution:
        """Newton from the last solution, if that is near, and from the estimate."""
        limits = self._limits(control)
        for start in self._starts(estimate, last, free, control):
            solution = solve_equilibrium(self.film, force, *start, *limits, free=free)
            if solution.converged:
                break
        return solution

    def _balanced(self, position: Array, pads: NDArray[np.int64], control: Limits) -> Solution:
        """Film at a given position of the shaft at rest, `pads` without moment."""
        limits = self._limits(control)
        film = self.film
        first = solve_film(film, film.start(), position, 0.0 * position, *limits)
        if not pads.size:
            return first
        nothing = np.zeros(position.size)
        return solve_equilibrium(film, nothing, first.u, position, *limits, free=pads)

    def _idle(self, free: NDArray[np.int64]) -> None:
        """Take the film off the pads that are not `free`."""
        if self.pads.size:
            idle = np.array(self.gap.bore.pads)[~np.isin(self.pads, free)]
            self.film.rest(np.isin(self.gap.mesh.segment, idle))

    def _tilting(self, position: Array) -> NDArray[np.int64]:
        """Pads whose film can hold them: those toward which it narrows, so that it converges."""
        tilting = []
        for row, number in zip(self.pads, self.gap.bore.pads):
            part = self.gap.bore.segments[number]
            toward, _ = _turned(position, part.narrowest)
            if part.preload / (1.0 - part.preload) + toward > _FLAT:
                tilting.append(row)
        return np.array(tilting, dtype=np.int64)

    def hold(
        self, index: int, place: Array, velocity: Array, omega: float, control: Limits
    ) -> Solution:
        """Film at a given position; pads take the tilt without moment and follow the shaft."""
        film, gap = self.film, self.gap
        film.relax()
        film.set_speed(omega)
        position, moving = np.zeros(gap.size), np.zeros(gap.size)
        if gap.tilts:
            self._straighten(index, position)
        position[:2], moving[:2] = place, velocity
        position = self._lifted(position)
        limits = self._limits(control)
        if film.elastic:
            return self._apart(solve_by_approach(film, position, moving, *limits))
        self._check_room(index, position)
        pads = self._tilting(position)
        self._idle(pads)
        if not pads.size:
            return solve_film(film, film.start(), position, moving, *limits)
        first = self._balanced(position, pads, control)
        if not moving.any() or not first.converged:
            return first
        every = np.append(np.arange(gap.shaft), pads)
        stiffness = first.linear.stiffness[np.ix_(every, every)]
        moving[pads] = -following(stiffness, gap.shaft) @ moving[: gap.shaft]
        start, nothing = (first.u, first.position), np.zeros(gap.size)
        return solve_equilibrium(film, nothing, *start, *limits, Motion(offset=-moving), pads)

    def _apart(self, solution: Solution) -> Solution:
        """The solution, not converged where an elastic shell would meet the shaft."""
        apart = self.film.room_left(solution.position) > APART
        return replace(solution, converged=solution.converged and apart)

    def refusal(self, load: Array, solution: Solution) -> str:
        """Why there is no answer, with numbers."""
        head = f"F = ({load[0]:.6g}, {load[1]:.6g}) N at ω = {self.film.speed:.6g} rad/s"
        still = self.film.speed == 0.0 and self.film.contact is None
        if still and not self.film.pockets.lifts(self.film.p_edge):
            return f"{head}: without rotation and squeeze the film carries no load"
        rigid = self.film.contact is None and not self.film.elastic
        if rigid and self.gap.narrowest(solution.position) < TOUCHING:
            return (
                f"{head}: the shaft touches the bore, {self._where(solution.position)}, before the "
                f"film carries the last {100 * min(solution.residual, 1.0):.3g} % of the load"
            )
        if self.film.room_left(solution.position) <= APART:
            return f"{head}: the shaft touches the elastic shell, {self._where(solution.position)}"
        return (
            f"{head}: no equilibrium found; "
            f"{unresolved(solution.residual, solution.rounding, solution.iterations)}, "
            f"{self._where(solution.position)}"
        )

    def _limits(self, control: Limits) -> tuple[float, int]:
        """Tolerance and Newton steps; the rupture of Reynolds moves by one cell in each."""
        cells = self.film.mesh.shape[0] if self.film.creeps else 0
        return control.tolerance, max(control.max_iterations, cells)

    # --- inside ----------------------------------------------------------------------------------
    def _straighten(self, index: int, held: Array) -> None:
        """Set the given bend, and the given tilt in `held`."""
        unit = self.bearing.radius / self.bearing.clearance
        if self.line.bend is not None:
            self.gap.bend(self.line.bend[index] * self.bearing.radius * unit)
        if self.line.tilt is not None:
            held[2:4] = self.line.tilt[index] * unit

    def _estimate(self, load: Array, held: Array, free: NDArray[np.int64]) -> Array:
        """First position: the closed form of the cylinder, shrunk to what the bore leaves."""
        position = held.copy()
        if self.film.speed != 0.0:
            position[:2] = self._plain_position(load)
        if self.pads.size:  # pads leave the shaft no side to go to
            along = math.hypot(*position[:2]) / max(math.hypot(*load), 1e-300)
            position[:2] = along * load
        if self.film.contact is not None and load.any():
            return closer_of(self.film, load, position)
        for share in (1.0, 0.7, 0.4, 0.1):
            start = self._lifted(np.append(share * position[:2], position[2:]))
            if self.gap.narrowest(start) > _ROOM:
                return start
        start = self.gap.roomiest(held, free)
        if self.gap.narrowest(start) <= 0.0:
            raise SolverError(f"the shaft touches the bore in any position: {self._where(start)}")
        return start

    def _plain_position(self, load: Array) -> Array:
        """Position in the plain bearing by the closed form."""
        bearing, film = self.bearing, self.film
        number = bearing.sommerfeld_number(math.hypot(*load), film.speed, film.viscosity)
        ratio = bearing.width / bearing.diameter
        return closed_form_position(ratio, number, load, film.speed, film.ruptures)

    def _lifted(self, position: Array) -> Array:
        """The same with pads tilted so that their gap converges."""
        position = position.copy()
        position[self.pads] = 0.0
        for row in self._tilting(position):
            part = self.gap.bore.segments[self.gap.bore.pads[row - self.gap.shaft]]
            pivot = part.narrowest
            toward, aside = _turned(position, pivot)
            lift = _LIFT * (1.0 - toward) / math.sin(max(pivot - part.start, part.end - pivot))
            position[row] = math.copysign(lift, self.film.speed) - aside
        return position

    def _check_room(self, index: int, position: Array) -> None:
        if self.gap.narrowest(position) <= 0.0:
            raise InputError(f"film {index}: the shaft touches the bore, {self._where(position)}")

    def _where(self, position: Array) -> str:
        gap, angle, z = self.gap.closest(position)
        return (
            f"narrowest gap {gap * self.bearing.clearance:.6g} m at {math.degrees(angle):.4g}°, "
            f"z = {z * self.bearing.radius:.6g} m (radial clearance "
            f"{self.bearing.clearance:.6g} m)"
        )

    def _starts(
        self,
        estimate: Array,
        last: Solution | None,
        free: NDArray[np.int64],
        control: Limits,
    ) -> Iterator[tuple[Array, Array]]:
        """Where Newton may start: from the last solution if the estimate has moved little."""
        if (
            last is not None
            and last.estimate is not None
            and np.array_equal(np.asarray(last.free), free)
        ):
            position = estimate.copy()
            position[free] = last.position[free]
            self.film.place(last.u, position)
            room = self.gap.narrowest(position)
            if room > 0 and math.hypot(*(estimate - last.estimate)[:2]) < _NEAR * room:
                yield last.u, position
        pads = free[free >= self.gap.shaft]
        if not pads.size:
            yield self.film.start(), estimate
            return
        first = self._balanced(estimate, pads, control)
        if first.converged:
            yield first.u, first.position
        yield self.film.start(), estimate


def _same(crowd: tuple[float, ...], other: tuple[float, ...]) -> bool:
    """Whether cells that crowd at either angles are about the same."""
    return len(crowd) == len(other) and np.allclose(crowd, other, atol=_SAME)


def _turned(position: Array, angle: float) -> tuple[float, float]:
    """Eccentricity toward `angle`, and a quarter turn on."""
    cos, sin = math.cos(angle), math.sin(angle)
    x, y = position[:2].tolist()
    return x * cos + y * sin, y * cos - x * sin


def bore_of(bearing: JournalGeometry) -> Bore:
    """Bore of a bearing."""
    return Bore(
        bearing.shape.segments, bearing.relief, bearing.radius, bearing.width, bearing.clearance
    )
