"""Statics of a film in any bore: shafts at rest under loads, films at given positions.

One path for every bore: a first position, Newton's method for film and shaft together, and, where
that leads nowhere, a finer mesh or steps of the load. A bore, what surrounds it and the
line of the shaft only say which degrees of freedom there are: eccentricity alone where a cylinder
surrounds an aligned shaft, else also tilts of the shaft and of pads.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.journal.film.shell.contact import TouchedFilm
from loadflow.journal.solvers.crowding import may_double, other_cells
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.estimate import NEAR
from loadflow.journal.solvers.film_on_cells import FilmOnCells
from loadflow.journal.solvers.floating import carries_there, floating_film
from loadflow.journal.solvers.load_stepping import (
    ended,
    has_touched,
    in_rigid_bore,
    solve_by_approach,
    solve_by_speed,
    solve_from_held,
    stands,
)
from loadflow.journal.solvers.messages import touch_at
from loadflow.journal.solvers.newton import Solution, no_film, solve_equilibrium, solve_film
from loadflow.journal.solvers.other_loads import solve_from_other_loads
from loadflow.journal.solvers.pads.search import search_on_pads
from loadflow.journal.solvers.pads.statics import film_on_pads, with_further_pads
from loadflow.journal.solvers.path import solve_beyond_fold, solve_elastic_in_steps
from loadflow.journal.solvers.sinking import solve_by_sinking
from loadflow.numerics.convergence import Limits

Array = NDArray[np.float64]
Rows = NDArray[np.int64]

_PAD_ROUNDS = 8  # solutions in which pads may come under load, or lose theirs
_FIRST = 2  # Newton steps of a film on pads before the shaft moves
_CROWDED = 2  # meshes that are tried beside the one asked for
_KEPT = 0.6  # of the effort in an elastic shell, for other cells: on some there is no film at all
_STANDING = 0.4  # of the effort, that is kept for the way from a shaft that stands on asperities
_ROUGH = 0.5  # of it, that is kept for asperities where their film is first sought without them
_LONG = 0.03  # step of the load below which its path is followed instead


class Statics(FilmOnCells):
    """One film and what is given of the shaft's line, solved load by load."""

    def resolve(
        self,
        index: int,
        load: Array,
        omega: float,
        last: Solution | None,
        control: Limits,
        effort: Effort | None = None,
    ) -> tuple[Statics, Solution]:
        """Equilibrium under load number `index`, and the film it was found on.

        Where no cells lead to one the shaft is let go in its film, on those that come first.
        """
        effort = effort or Effort.of(self.film, control.max_iterations)
        used, solution = self._on_any_cells(index, load, omega, last, control, _CROWDED, effort)
        if solution.converged or used._told(solution):
            return used, solution
        first = self.finer if self.can_refine else self
        return first._sunk(index, load, omega, control, effort, (used, solution))

    def _on_any_cells(
        self,
        index: int,
        load: Array,
        omega: float,
        last: Solution | None,
        control: Limits,
        meshes: int,
        effort: Effort,
    ) -> tuple[Statics, Solution]:
        """As `resolve`, by Newton's method and steps.

        Cells that do not resolve the gap are graded. Where the gap closes between the cells of a
        mesh fixed to the shell there may be no equilibrium on it, so that cells crowd there, on up
        to `meshes` others, as long as the `effort` lasts.
        """
        refine = self.can_refine
        others = self.film.elastic and meshes > 0 and may_double(self.options, omega)
        effort.kept = _KEPT * effort.left if others else 0.0
        solution = self.solve(index, load, omega, last, control, not refine, effort)
        effort.kept = 0.0
        resolved = self.suited(solution.position) is self
        if (solution.converged and resolved) or not self._carries(self._force(index, load)):
            return self, solution
        if refine:
            return self.finer._on_any_cells(index, load, omega, None, control, meshes, effort)
        film = self.film
        given = film, self.gap, self.options, self.crowd, solution
        cells = other_cells(*given) if meshes and not effort.over else None
        if cells is None:
            return self, solution
        left = meshes if self.gap.axisymmetric else meshes - 1
        found = self._on(*cells)._on_any_cells(index, load, omega, None, control, left, effort)
        # a search that was given up says nothing: where the shaft has touched on these cells stands
        return (self, solution) if found[1].given_up and has_touched(film, solution) else found

    def solve(
        self,
        index: int,
        load: Array,
        omega: float,
        last: Solution | None,
        control: Limits,
        in_steps: bool = True,
        effort: Effort | None = None,
    ) -> Solution:
        """Equilibrium under load number `index` on this mesh.

        From the `last` solution, if that is near, and from a first position; if `in_steps` also by
        steps of the load, as long as the `effort` lasts.
        """
        film, gap = self.film, self.gap
        effort = effort or Effort.of(film, control.max_iterations)
        film.relax()
        film.set_speed(omega)
        force = self._force(index, load)
        carries = self._carries(force)
        if not carries and force.any():
            return no_film(film)
        estimate, cut = self._first_position(index, load), False
        limits = control.tolerance, film.newton_steps(control.max_iterations)
        if not carries:
            return solve_film(film, film.start(), estimate, np.zeros(gap.size), *limits)
        last = last or self._smooth(index, load, omega, control, effort)
        solution, estimate, pads = self._by_newton(force, estimate, last, limits, effort)
        if in_steps and not (solution.converged or effort.over):
            given = index, load, omega, control, effort
            soft, free = film.elastic, self._free(pads)
            kept, turns, found, rigid = effort.kept, stands(film), None, None
            if turns and soft:  # it is found in a rigid bore, or stands
                rigid = in_rigid_bore(film, force, estimate, *limits, effort, free)
                found = None if rigid.converged else self._from_standing(*given)
            effort.kept += _STANDING * (effort.left - kept) * (turns and not soft)
            solution = found or self._in_steps(force, estimate, pads, limits, effort, rigid)
            fixed = not (soft or gap.pads.size)
            if fixed and self._has_path and not ended(film, solution, effort):
                solution = solve_beyond_fold(film, force, estimate, *limits, effort, solution, free)
            if fixed and not ended(film, solution, effort):
                solution = self._by_other_loads(force, estimate, limits, effort) or solution
            cut, effort.kept = effort.over, kept
            if turns and not (soft or ended(film, solution, effort)):
                solution = self._from_standing(*given) or solution
        found = self._checked(replace(solution, estimate=estimate, iterations=effort.taken))
        return replace(found, given_up=(cut or effort.over) and not found.converged)

    def hold(
        self,
        index: int,
        place: Array,
        velocity: Array,
        omega: float,
        control: Limits,
        name: str = "eccentricity",
    ) -> Solution:
        """Film at a given `place`; pads take the tilt without moment and follow the `velocity`.

        Errors as of `apart`.
        """
        film, gap = self.film, self.gap
        film.relax()
        film.set_speed(omega)
        position, moving = self.apart(index, place, omega, name), np.zeros(gap.size)
        moving[:2] = velocity
        limits = control.tolerance, film.newton_steps(control.max_iterations)
        if film.elastic:
            return self._checked(solve_by_approach(film, position, moving, *limits))
        if not gap.pads.size:
            return self._checked(solve_film(film, film.start(), position, moving, *limits))
        pads = self._on_pads(gap.converging(position, omega))
        return self._checked(film_on_pads(film, self._shaped, position, moving, pads, *limits))

    def apart(self, index: int, place: Array, omega: float, name: str = "eccentricity") -> Array:
        """Position (m,) at a given `place` of a shaft that does not touch the bore.

        Raises
        ------
        loadflow.errors.InputError
            It touches the bore, in a shell that does not give way.
        """
        position = self._held(index)
        position[:2] = place
        position = self.gap.lifted(position, omega)
        if not (self.film.elastic or self.gap.narrowest(position) > 0.0):
            where = touch_at(self.bearing, self.film, self.gap, position)
            raise InputError(
                f"{name} {index}: ε = {math.hypot(*place):.6g} is not allowed: {where}"
            )
        return position

    def settled(self, index: int, load: Array, omega: float, control: Limits) -> Solution:
        """Equilibrium on this mesh, by way of that on one that follows the gap."""
        force = self._force(index, load)
        free = replace(self.options, grading="auto", inlet="auto")
        _, solution = Statics(self.bearing, free, self.line, self.rate).resolve(
            index, load, omega, None, control
        )
        if not solution.converged:
            return solution
        film = self.film
        film.set_speed(omega)
        limits = control.tolerance, film.newton_steps(control.max_iterations)
        effort = Effort.of(film, control.max_iterations)
        return self._checked(solve_from_held(film, force, solution.position, *limits, effort))

    # --- inside ----------------------------------------------------------------------------------
    def _by_newton(
        self,
        force: Array,
        estimate: Array,
        last: Solution | None,
        limits: tuple[float, int],
        effort: Effort,
    ) -> tuple[Solution, Array, Rows]:
        """Newton from all starts that the `effort` allows; the position and pads it ended at."""
        film, gap, begun = self.film, self.gap, effort.spent
        pads = gap.converging(estimate, film.speed)
        for round_ in range(_PAD_ROUNDS):
            free = self._free(self._on_pads(pads))
            for start in self._starts(force, estimate, last, free, pads, limits, effort):
                solution = solve_equilibrium(film, force, *start, *limits, free=free)
                effort.take(film, solution.iterations)
                if solution.converged or effort.over:
                    break
            tilting = gap.converging(solution.position, film.speed)
            if round_:  # a pad that has come off stays off: at the limit it would go on and off
                tilting = np.intersect1d(pads, tilting)
            if not solution.converged or np.array_equal(tilting, pads):
                break
            estimate = np.append(solution.position[:2], estimate[2:])
            estimate, last, pads = gap.lifted(estimate, film.speed), None, tilting
        solution = with_further_pads(film, self._shaped, force, solution, pads, *limits, effort)
        return replace(solution, iterations=effort.spent - begun), estimate, pads

    def _starts(
        self,
        force: Array,
        estimate: Array,
        last: Solution | None,
        free: slice | Rows,
        pads: Rows,
        limits: tuple[float, int],
        effort: Effort,
    ) -> Iterator[tuple[Array, Array]]:
        """Where Newton may start: from the last solution if the estimate has moved little."""
        film, gap = self.film, self.gap
        lifts, fed, every = film.lifts, film.pockets.free.size > 0, np.arange(gap.size)
        same = last is not None and np.array_equal(every[last.free], every[free])
        if last is not None and last.estimate is not None and same:
            position = estimate.copy()
            position[free] = last.position[free]
            # a shell opens wherever it is pressed: any film in it is nearer than none
            reach = math.inf if film.elastic else NEAR * film.narrowest(last.u, position)
            if math.hypot(*(estimate - last.estimate)[:2]) < reach:
                yield last.u, position
        afloat = partial(floating_film, film, gap, force, estimate, effort)
        floating = afloat() if lifts and fed else None
        carried = floating is not None and carries_there(floating, self.film, force)
        if floating is not None and carried:
            yield floating.u, floating.position
        first = film.start()
        if pads.size:  # a film first: from none the tilts would go far
            first = solve_film(film, first, estimate, 0.0 * estimate, limits[0], _FIRST).u
        yield first, estimate
        if lifts and not fed:
            floating = afloat()
        if floating is not None and not carried:
            yield floating.u, floating.position

    def _smooth(
        self, index: int, load: Array, omega: float, control: Limits, effort: Effort
    ) -> Solution | None:
        """Equilibrium without asperities, in a shell that spreads what presses it; None: not found.

        It takes a third of the time there, and mostly asperities carry little or nothing.
        """
        film, kept = self.film, effort.kept
        if not (isinstance(film, TouchedFilm) and film.contact and omega != 0.0):
            return None
        effort.kept += _ROUGH * (effort.left - kept)
        asperities, film.contact = film.contact, None
        try:
            found = self.solve(index, load, omega, None, control, effort=effort)
        finally:
            film.contact, effort.kept = asperities, kept
        if found.converged:
            return found
        film.relax()  # of what was tried, and of a shell that was still too stiff
        return None

    def _from_standing(
        self, index: int, load: Array, omega: float, control: Limits, effort: Effort
    ) -> Solution | None:
        """Equilibrium from the shaft that stands on asperities; None: not found this way."""
        standing = self.solve(index, load, 0.0, None, control, effort=effort)
        limits = control.tolerance, self.film.newton_steps(control.max_iterations)
        turning = self.film, self._force(index, load), standing, omega
        return solve_by_speed(*turning, *limits, effort, self.shaft)

    def _by_other_loads(
        self, force: Array, estimate: Array, limits: tuple[float, int], effort: Effort
    ) -> Solution | None:
        """Equilibrium by way of other sizes of the load."""

        def newton(share: float, last: Solution | None) -> Solution:
            place = estimate if last is None else last.position
            before = None if last is None else replace(last, estimate=place)
            return self._by_newton(share * force, place, before, limits, effort)[0]

        return solve_from_other_loads(newton, limits[1], effort)

    def _sunk(
        self,
        index: int,
        load: Array,
        omega: float,
        control: Limits,
        effort: Effort,
        reached: tuple[Statics, Solution],
    ) -> tuple[Statics, Solution]:
        """Where the shaft comes to rest that is let go, or meets its bore; or what is `reached`."""
        film, own, (used, solution) = self.film, Effort(effort.sinking), reached
        film.set_speed(omega)
        if not stands(film):
            return reached
        limits = control.tolerance, film.newton_steps(control.max_iterations)
        force, estimate = self._force(index, load), self._first_position(index, load)
        found = solve_by_sinking(film, force, estimate, *limits, own, self.shaft)
        effort.sinking, effort.spent = own.left, effort.spent + own.spent
        if found is not None:
            return self, self._checked(replace(found, estimate=estimate, iterations=effort.taken))
        if used is self and np.isfinite(solution.position).all():
            film.place(solution.u, solution.position)  # the gap by which it is judged
        return used, replace(solution, given_up=solution.given_up or own.over)

    def _in_steps(
        self,
        force: Array,
        estimate: Array,
        pads: Rows,
        limits: tuple[float, int],
        effort: Effort,
        rigid: Solution | None,
    ) -> Solution:
        """Equilibrium where Newton finds none at once; `rigid` as of `solve_elastic_in_steps`."""
        film, free = self.film, self._free(pads)
        given = film, force, estimate, *limits, effort, free
        if film.elastic:
            return solve_elastic_in_steps(film, force, estimate, *limits, effort, free, rigid)
        if pads.size:
            shaft = np.arange(self.gap.size)[self.shaft]
            return search_on_pads(film, self._shaped, force, estimate, shaft, pads, *limits, effort)
        if self.gap.pads.size or not self._has_path:
            return solve_from_held(*given)
        return solve_from_held(*given, _LONG)  # a path goes on
