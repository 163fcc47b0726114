"""The rung "reduced": fine cells around, few unknowns across the width, one compiled loop.

Across the width the pressure is an even polynomial through `POINTS` Gauss–Lobatto points; around,
the cells are those of the rung "grid", and so are law, time steps and scales. Cells are fixed to
the shell: there is no inlet line. A film with a shaft that tilts or bends, asperities, a shell that
gives way or grooves of a supply is one of `loadflow.journal.models.composed.at_rest`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.cavitation import FILL, LOAD
from loadflow.journal.film.cell_error import Balance, resting_errors
from loadflow.journal.film.discretise import crowds_around
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.film.integrals import Integrals, in_units
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.models import grid
from loadflow.journal.models import reduced_film as at
from loadflow.journal.models._reduced_loops import finish, march, newton
from loadflow.journal.models.composed import at_rest as composed_at_rest
from loadflow.journal.models.composed import closed_path as composed_closed
from loadflow.journal.models.composed import heat as composed_heat
from loadflow.journal.models.composed import heat_position as composed_heat_position
from loadflow.journal.models.composed import path as composed_path
from loadflow.journal.models.composed import position as composed_position
from loadflow.journal.models.composed.error import Judged
from loadflow.journal.models.finer_orbit import on_enough_cells
from loadflow.journal.models.grid import solve_on_grid
from loadflow.journal.models.reduced_film import Reduced, Work, make_work
from loadflow.journal.models.ring import (
    estimates,
    lobed,
    no_start,
    ring_of,
    units_of,
)
from loadflow.journal.models.slow_heat import THIN, cooled, slow_states
from loadflow.journal.models.width_modes import half_width_nodes, lobatto
from loadflow.journal.questions import AtPosition, AtRest, InMotion
from loadflow.journal.rows import answered_rows, operating_columns, without_supply
from loadflow.journal.solvers.estimate import NEAR, OFF_THE_BORE, SHARES
from loadflow.journal.solvers.messages import at_edge
from loadflow.journal.solvers.motion.periodic import check_half_speed_whirl, check_period
from loadflow.journal.solvers.motion.transient import OrbitStopped, orbit_dataset, stopped
from loadflow.journal.solvers.warm.mean import with_temperatures
from loadflow.numerics.convergence import Limits

if TYPE_CHECKING:
    import xarray as xr


Array = NDArray[np.float64]

stores_heat = True  # of `loadflow.journal.warm_orbit`: the temperature follows in the same loop

_MOST_AROUND = 480  # cells, of an orbit that stops on fewer
POINTS = 3  # across the half width; the largest pressure moves by 0.4 % at most with more of them


def equilibrium(asked: AtRest) -> dict[str, Any]:
    """Static equilibria; a load that fails or is not resolved here is solved on the grid.

    So are all on pads that tilt: at rest these are of the grid alone. With heat over the area a
    load that fails here has no film, and says whether the grid has one.
    """
    bearing, options, control = asked.bearing, asked.film, asked.limits
    if Bore.of(bearing).pads:
        return grid.equilibrium(asked)
    force, speed = np.array(asked.force), np.array(asked.speed)  # of the layout that kernels know
    asked = replace(asked, force=force, speed=speed)
    if options.heat is not None:
        return composed_heat.equilibrium(asked)
    if composed_at_rest.composes(bearing, options, asked.line):
        answer, found, none = composed_at_rest.equilibrium(asked)
        answer["converged"] = found
        if not control.strict:  # else the grid says why
            answer, found = answered_rows(found | ~none, answer), found | none
        return _with_the_grid(asked, answer, found)
    film = units_of(bearing, options, speed)
    reduced, work = _discrete(bearing, options, film)
    half = float(film.mesh.z_edges[-1])
    count, bore, smooth = speed.size, Bore.of(bearing), options.law.smooth
    crowding = crowds_around(bearing, options, asked.line, control.refine)
    rows = np.zeros((count, at.RESULTS))
    stiffness, damping = np.zeros((count, 2, 2)), np.zeros((count, 2, 2))
    judged = Judged(reduced.ring, half_width_nodes(half, POINTS), False, count)
    starts = _Starts(bearing, film, reduced, work, estimates(bearing, film, force, speed))
    for n in range(count):
        spent, converged = 0, False
        for x, y in starts.of(n, speed[n], control):
            x, y, residual, iterations, converged, rounding = newton(
                reduced, work, x, y, force[n, 0], force[n, 1], speed[n], 0.0,
                control.tolerance, control.max_iterations,
            )  # fmt: skip
            spent += iterations
            answered = converged
            if converged and crowding:
                narrow = float(bore.narrowest(np.array([[x, y]]))[0])
                converged = film.resolves(np.array([1.0 - narrow, 0.0]))
            if converged:
                finish(reduced, work, x, y, speed[n], rows[n], stiffness[n], damping[n])
                fill = work.state[FILL] if smooth else None
                judged.add(n, work.state[LOAD], work.gap[:, None], 1.0, fill, speed[n])
                starts.keep(n, (x, y))
            if answered:
                break
        rows[n, at.RESIDUAL :] = residual, spent, converged, rounding
    position = rows[:, [at.X, at.Y]]
    balance = Balance(
        position=position,
        facing=judged.facing[:, :2],
        stiffness=stiffness,
        arms=np.ones(2),
        narrow=judged.narrow,
        growth=0.0,
        opens=1.0,
        load=force,
        touching=None,
        rubbing=0.0,
        fed=False,
    )
    answer = {
        **operating_columns(bearing, force, speed, options.liquid, position),
        **_results(bearing, film, rows, speed),
        "eccentricity_ratio": np.hypot(*position.T),
        "stiffness": stiffness / bearing.clearance,
        "damping": damping / bearing.clearance,
        "converged": rows[:, at.CONVERGED] > 0,
        "relative_grid_error": resting_errors(judged.left(), balance),
    }
    return _with_the_grid(asked, answer, answer["converged"])


def _with_the_grid(
    asked: AtRest, answer: dict[str, Any], known: NDArray[np.bool_]
) -> dict[str, Any]:
    """The answer, its loads that are not `known` solved on the grid, if they may be."""
    if not asked.limits.refine:
        return answer
    for index in np.flatnonzero(~known):
        solve_on_grid(asked, int(index), answer)
    return answer


def pressure(asked: AtPosition) -> tuple[dict[str, Any], Array]:
    """Films at given positions; one that fails or is not resolved here is solved on the grid.

    So are all on pads that tilt, as at rest.
    """
    if Bore.of(asked.bearing).pads:
        return grid.pressure(asked)
    if asked.film.heat is not None:
        return composed_heat_position.pressure(asked)
    across = None if composed_at_rest.composes(asked.bearing, asked.film, asked.line) else POINTS
    answer, z = composed_position.pressure(asked, across)
    for n in np.flatnonzero(~answer["converged"]):
        grid.hold_on_grid(asked, int(n), answer, z)
    return answer, z


def orbit(asked: InMotion) -> xr.Dataset:
    """Path of the shaft; all steps in one compiled loop.

    Raises
    ------
    SolverError
        No equilibrium to start from, or a step that fails even when cut to 1/256, also on twice the
        cells around.
    """
    time, force, speed = (np.array(values) for values in (asked.time, asked.force, asked.speed))
    asked = replace(asked, time=time, force=force, speed=speed)  # of the layout that kernels know

    def path(films: Sequence[Film]) -> xr.Dataset:
        (on,) = films
        return _path(replace(asked, film=on)).assign_attrs(cells_around=on.cells[0])

    return on_enough_cells([asked.film], path, [_MOST_AROUND])


def _first_position(asked: InMotion) -> Array:
    """First position (4,) of a path by the grid."""
    bearing, first = asked.bearing, asked.at_rest.at(np.array([0]))
    cold, limits = asked.film.isothermal(), replace(asked.limits, strict=True)
    try:
        found = grid.equilibrium(replace(first, film=cold, limits=limits))
    except SolverError as error:
        why = f"orbit cannot start: {str(error).removeprefix('load 0: ')}"
        if asked.film.shell is not None:
            raise SolverError(why) from error  # the grid has tried more cells
        raise OrbitStopped(why) from error
    place = np.append(found["eccentricity"][0] / bearing.clearance, np.zeros(2))
    if not asked.line.straight:
        place[2:] = found["tilt"][0] * (bearing.radius / bearing.clearance)
    return place


def _path(asked: InMotion) -> xr.Dataset:
    """The orbit on the cells of its film."""
    bearing, line, limits, steps = asked.bearing, asked.line, asked.limits, asked.steps
    time, force, speed = asked.time, asked.force, asked.speed
    over_area, viscosity, warm, bare = None, None, None, asked.film
    if bare.heat is not None and bare.heat.over_area:
        many_steps = replace(limits, max_iterations=2 * limits.max_iterations)
        warmed = composed_heat.mean_around(replace(asked.at_rest, limits=many_steps))
        over_area, viscosity, warm = warmed
        bare = bare.isothermal()
    driven, begin = replace(asked, film=bare), partial(_first_position, asked)

    def told(values: dict[str, Any]) -> xr.Dataset:
        """The path of some values over time."""
        path = orbit_dataset(values, time, force, speed, bearing.clearance)
        return path if over_area is None else with_temperatures(path, over_area, bearing.clearance)

    if steps.periodic:
        check_period(time, force, speed, line)
        if not (bearing.shape.segments or bearing.relief or bare.supply or not line.straight):
            check_half_speed_whirl(time, force, speed)
        values, about = composed_closed.orbit(driven, begin, viscosity, warm)
        return told(values).assign_attrs(about)
    effects = over_area is not None or composed_at_rest.composes(bearing, bare, line)
    if effects or Bore.of(bearing).pads:
        return told(composed_path.orbit(driven, begin, viscosity, warm))
    return told(_aligned_path(asked))


def _aligned_path(asked: InMotion) -> dict[str, Any]:
    """Variables over time of the path of an aligned shaft in a film without effects."""
    bearing, options, limits, steps = asked.bearing, asked.film, asked.limits, asked.steps
    time, force, speed = asked.time, asked.force, asked.speed
    film = units_of(bearing, options, speed)
    film.raise_scale(float(np.hypot(*force.T).max()) / (bearing.width * bearing.diameter))
    reduced, work = _discrete(bearing, options, film)
    work.u[:] = _cold(film, reduced)
    start = steps.start
    first = estimates(bearing, film, force[:1], speed[:1])[0] if start is None else start
    if reduced.ring.shaped and start is None:
        first = _first_position(asked)[:2]
    rows = np.zeros((time.size, at.RESULTS))
    warmth, states = slow_states(options, film, 1.0, 0.0, steps.temperature, time.size)
    begun = speed[0] * states[0, THIN]
    many = limits.tolerance, 2 * limits.max_iterations
    freed, held = reduced._replace(free=start is None), reduced._replace(free=False)
    fx, fy = force[0]
    x, y, residual, iterations, converged, rounding = newton(
        freed, work, first[0], first[1], fx, fy, begun, 0.0, *many
    )
    if not converged and start is None:  # near where the grid has its own, with their film solved
        first = _first_position(asked)[:2]
        for share in (1.0, *OFF_THE_BORE):
            work.u[:] = _cold(film, reduced)
            x, y = share * first
            newton(held, work, x, y, 0.0, 0.0, begun, 0.0, *many)
            x, y, residual, iterations, converged, rounding = newton(
                freed, work, x, y, fx, fy, begun, 0.0, *many
            )
            if converged:
                break
    if not converged:
        missed = residual, rounding, iterations
        raise no_start(force[0], speed[0], float(np.hypot(x, y)), missed)
    rows[0, at.RESIDUAL :] = residual, iterations, converged, rounding
    solved = march(
        reduced, work, x, y, time, force, speed, limits.tolerance, limits.max_iterations,
        steps.accuracy, rows, warmth, states,
    )  # fmt: skip
    last = solved - 1
    if not rows[last, at.CONVERGED]:
        missed = tuple(rows[last, [at.RESIDUAL, at.ROUNDING, at.ITERATIONS]])
        place = rows[last, [at.X, at.Y]]
        why = at_edge(bearing, place)
        raise stopped(time[last], force[last], speed[last], float(np.hypot(*place)), missed, why)
    values = _results(bearing, film, rows, speed * states[:, THIN])
    values = cooled(warmth, states, values) | {"x": rows[:, at.X], "y": rows[:, at.Y]}
    if steps.step == "adaptive":
        values["steps"] = rows[:, at.STEPS].astype(int)
    return values


class _Starts:
    """Where Newton may start: from the last film if the closed form has moved little."""

    def __init__(
        self,
        bearing: JournalGeometry,
        film: DiscreteFilm,
        reduced: Reduced,
        work: Work,
        estimate: Array,
    ) -> None:
        self.bore = Bore.of(bearing)
        self.held = reduced._replace(free=False)
        self.work = work
        self.estimate = estimate
        self.cold = _cold(film, reduced)
        self.last: tuple[int, tuple[float, float]] | None = None

    def of(self, n: int, speed: float, control: Limits) -> Iterator[tuple[float, float]]:
        """Positions to start load `n` from; sets the unknowns that belong to each.

        The last ones are off the bore with their film solved: near the bore, and without a film,
        the first steps of a shaft lead far away.
        """
        if self.last is not None:
            before, position = self.last
            moved = np.hypot(*(self.estimate[n] - self.estimate[before]))
            if moved < NEAR * self.bore.narrowest(np.array([position]))[0]:
                self.work.u[:] = self.work.last
                yield position
        self.work.u[:] = self.cold
        x, y = self.estimate[n]
        if self.bore.segments:
            tries = np.outer(SHARES, self.estimate[n])
            free = self.bore.narrowest(tries) > ShapedGap.first_gap
            x, y = tries[np.argmax(free)] if free.any() else (0.0, 0.0)
        yield x, y
        for share in OFF_THE_BORE:
            self.work.u[:] = self.cold
            newton(
                self.held, self.work, share * x, share * y, 0.0, 0.0, speed, 0.0,
                control.tolerance, control.max_iterations,
            )  # fmt: skip
            yield share * x, share * y

    def keep(self, n: int, position: tuple[float, float]) -> None:
        """Remember the solved film of load `n`."""
        self.work.last[:] = self.work.u
        self.last = n, position


def _discrete(bearing: JournalGeometry, options: Film, film: DiscreteFilm) -> tuple[Reduced, Work]:
    """Constants and work arrays of the compiled loops."""
    axial, ring = lobatto(float(film.mesh.z_edges[-1]), POINTS), ring_of(film, 2.0)
    if bearing.shape.segments:
        ring = lobed(ring, bearing, options)
    reduced = Reduced(ring, (0,) * POINTS, axial, True)
    return reduced, make_work(ring.width.size, POINTS)


def _cold(film: DiscreteFilm, reduced: Reduced) -> Array:
    """Unknowns (nx, m) of a film at the pressure of its ends."""
    return film.unknown_of(np.full((reduced.ring.width.size, POINTS), film.p_edge))


def _results(
    bearing: JournalGeometry, film: DiscreteFilm, rows: Array, speed: Array
) -> dict[str, Any]:
    found = Integrals(
        peak=rows[:, at.PEAK],
        dissipation=rows[:, at.DISSIPATION],
        shear=rows[:, at.SHEAR],
        outflow=rows[:, at.OUTFLOW],
        fill=rows[:, at.FILLED],
    )
    values = in_units(film, found, speed, Bore.of(bearing).narrowest(rows[:, [at.X, at.Y]]))
    return values | {
        "residual": rows[:, at.RESIDUAL],
        "iterations": rows[:, at.ITERATIONS].astype(int),
        **without_supply(len(rows)),
        "supply_flow": film.pockets.flow_unit * rows[:, at.FED],
    }
