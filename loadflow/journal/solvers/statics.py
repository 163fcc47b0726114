"""Films of the plain bearing around an aligned shaft: at rest under loads, and at given places."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.film.discretise import build_film
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.results import field_row, static_row
from loadflow.journal.solvers.estimate import NEAR, closed_form_position, closer_of
from loadflow.journal.solvers.newton import (
    Solution,
    no_film,
    not_found,
    refusal,
    solve_equilibrium,
    solve_film,
    solve_patiently,
)
from loadflow.journal.solvers.statics_shaped import equilibrium_rows
from loadflow.numerics.convergence import Limits, unresolved

Array = NDArray[np.float64]

_HIGH = 0.99  # eccentricity ratio at which the lift of a supply is stated
_AFLOAT = 0.5  # eccentricity ratio at which a shaft is sought that its supply carries
_STARVED = (
    "the supply is starved, a groove would fall below the cavitation pressure: MassConserving and "
    "GasMixture follow a groove that is not full"
)


def plain_film(bearing: JournalGeometry, options: Film, rates: Array) -> DiscreteFilm:
    """Film of a plain bearing, scaled to the largest of `rates`, 1/s."""
    film = build_film(bearing.diameter, bearing.width, bearing.relative_clearance, options)
    film.set_scale(float(np.abs(rates).max()))
    return film


def plain_rows(
    bearing: JournalGeometry, options: Film, loads: Array, speeds: Array, control: Limits
) -> list[dict[str, Any]]:
    """Rows of `Equilibrium`."""
    film = plain_film(bearing, options, speeds)
    if film.pockets.free.size:  # the supply must raise the pressure that carries the load
        film.raise_scale(_mean_pressure(bearing, loads))
    finer = plain_film(bearing, options.graded(), speeds) if options.may_grade else None
    rows = []
    last: Solution | None = None
    for index, (load, omega) in enumerate(zip(loads, speeds.tolist())):
        used, solution = _settle(bearing, film, finer, load, omega, last, control)
        crowds = options.supply is not None and omega != 0.0 and not used.dry(solution.u)
        if not solution.converged and crowds:
            row = _on_crowded_cells(bearing, options, load, omega, control)
            if row["converged"]:
                rows.append(row)
                continue
        if not solution.converged and control.strict:
            raise SolverError(f"load {index}: {_refusal(used, load, solution)}")
        if solution.converged and used is film:
            last = solution
        rows.append(static_row(bearing, used, load, options.liquid, solution))
    return rows


def _on_crowded_cells(
    bearing: JournalGeometry, options: Film, load: Array, speed: float, control: Limits
) -> dict[str, Any]:
    """Row of a load at which the gap closes between cells that the grooves hold in their places."""
    loads, speeds = load[None], np.array([speed])
    calm = replace(control, strict=False)
    return equilibrium_rows(bearing, options, loads, speeds, Line(), calm, whirl=0.0)[0]


def plain_fields(
    bearing: JournalGeometry,
    options: Film,
    places: Array,
    velocities: Array,
    speeds: Array,
    control: Limits,
) -> tuple[list[dict[str, Any]], Array]:
    """Rows of `FilmField` and axial places of the cells of one half, m."""
    rates = np.abs(speeds) + np.hypot(velocities[:, 0], velocities[:, 1])
    film = plain_film(bearing, options, rates)
    ratio = np.hypot(places[:, 0], places[:, 1])
    worst = int(ratio.argmax()) if ratio.size else 0
    if ratio.size and not film.gap.narrowest(places[worst]) > 0.0:
        limit = "< 1" if film.contact is None else "an overlap that the law of contact covers"
        raise InputError(
            f"eccentricity {worst}: ratio ε = {ratio[worst]:.6g} is not allowed: {limit} "
            f"(radial clearance {bearing.clearance:.6g} m)"
        )
    rows = []
    for index, (place, moving, omega) in enumerate(zip(places, velocities, speeds.tolist())):
        film.set_speed(omega)
        steps = _steps(film, control.max_iterations)
        solution = solve_film(film, film.start(), place, moving, control.tolerance, steps)
        if control.strict and film.dry(solution.u):
            raise SolverError(f"film {index} at ε = {np.hypot(*place):.6g}: {_STARVED}")
        if control.strict and not solution.converged:
            raise SolverError(
                f"film {index} at ε = {np.hypot(*place):.6g}, ω = {omega:.6g} rad/s: "
                + unresolved(solution.residual, solution.rounding, solution.iterations)
            )
        rows.append(field_row(film, solution))
    return rows, film.mesh.z * bearing.radius


def plain_start(
    bearing: JournalGeometry,
    film: DiscreteFilm,
    loads: Array,
    speeds: Array,
    place: Array | None,
    control: Limits,
) -> Solution:
    """First state of an orbit, at `place` (clearances) or at the equilibrium of the first load."""
    film.raise_scale(_mean_pressure(bearing, loads))
    omega = float(speeds[0])
    film.set_speed(omega)
    if place is None:
        _, first = _settle(bearing, film, None, loads[0], omega, None, control)
    else:
        first = solve_film(film, film.start(), place, np.zeros(2), control.tolerance, 100)
    if not first.converged:
        raise SolverError(f"orbit cannot start: {_refusal(film, loads[0], first)}")
    return first


def _mean_pressure(bearing: JournalGeometry, loads: Array) -> float:
    """Largest load over the projected area, Pa."""
    return float(np.hypot(*loads.T).max()) / (bearing.width * bearing.diameter)


def _settle(
    bearing: JournalGeometry,
    film: DiscreteFilm,
    finer: DiscreteFilm | None,
    load: Array,
    speed: float,
    last: Solution | None,
    control: Limits,
) -> tuple[DiscreteFilm, Solution]:
    """Equilibrium from the closed form, robustly; the film it was found on comes with it."""
    tolerance, max_iterations = control.tolerance, control.max_iterations
    film.set_speed(speed)
    lifts = film.pockets.lifts(film.p_edge)
    if speed == 0.0 and not lifts and (film.contact is None or not load.any()):
        if load.any():
            return film, no_film(film)
        return film, solve_film(film, film.start(), load, load, tolerance, max_iterations)
    position = closer_of(film, load, _estimate(bearing, load, film))
    attempts = [(film, *start) for start in _starts(film, position, last)]
    if lifts:
        floating = _floating(film, load, position)
        attempts.insert(0 if film.pockets.free.size else len(attempts), floating)
    if finer is not None:
        finer.set_speed(speed)
        attempts.append((finer, finer.start(), position))
    for used, u, start in attempts:
        steps = _steps(used, max_iterations)
        solution = solve_equilibrium(used, load, u, start, tolerance, steps)
        if solution.converged and (finer in (None, used) or used.resolves(solution.position)):
            dry = used.dry(solution.u)
            return used, replace(solution, estimate=position, converged=not dry)
    used = finer or film
    solution = solve_patiently(used, load, position, tolerance, max_iterations)
    return used, replace(solution, estimate=position)


def _starts(
    film: DiscreteFilm, position: Array, last: Solution | None
) -> Iterator[tuple[Array, Array]]:
    """Where Newton may start: from the last solution if the closed form has moved little."""
    if last is not None and last.estimate is not None:
        moved = position - last.estimate
        if np.hypot(*moved) < NEAR * (1 - np.hypot(*last.position)):
            yield last.u, last.position
    yield film.start(), position


def _estimate(bearing: JournalGeometry, load: Array, film: DiscreteFilm) -> Array:
    """Position by Butenschön's closed form, in clearances."""
    if film.speed == 0.0:
        return np.zeros(2)
    wanted = bearing.sommerfeld_number(float(np.hypot(*load)), film.speed, film.viscosity)
    ratio = bearing.width / bearing.diameter
    return closed_form_position(ratio, wanted, load, film.speed, film.ruptures)


def _refusal(film: DiscreteFilm, load: Array, solution: Solution) -> str:
    """Why no film carries `load`, in words."""
    head = f"F = ({load[0]:.6g}, {load[1]:.6g}) N at ω = {film.speed:.6g} rad/s"
    if film.dry(solution.u):
        return f"{head}: {_STARVED}"
    if film.speed == 0.0 and film.contact is None:
        if not film.pockets.lifts(film.p_edge):
            return f"{head}: without rotation and squeeze the film carries no load"
        return f"{head}: the supply carries no more than {_lift(film, load):.6g} N, at ε = {_HIGH}"
    ratio = float(np.hypot(*solution.position))
    reached = (solution.residual, solution.rounding, solution.iterations)
    if film.contact is not None:
        overlap = (ratio - 1.0) / film.gap.roughness
        return f"{head}: {not_found(*reached, ratio)}, mean planes {overlap:.3g} σ beyond touching"
    return refusal(load, film.speed, not_found(*reached, ratio))


def _steps(film: DiscreteFilm, max_iterations: int) -> int:
    """Newton steps that a load may take; the rupture of Reynolds moves by one cell in each."""
    return max(max_iterations, film.mesh.shape[0] if film.creeps else 0)


def _floating(
    film: DiscreteFilm, load: Array, position: Array
) -> tuple[DiscreteFilm, Array, Array]:
    """Start for a shaft that its supply carries: well off the shell, the film settled."""
    ratio = float(np.hypot(*position))
    if film.speed == 0.0 or ratio > _AFLOAT:
        position = _AFLOAT * load / (float(np.hypot(*load)) or 1.0)
    state = solve_film(film, film.start(), position, np.zeros(2), 1e-6, 30)
    return film, state.u, position


def _lift(film: DiscreteFilm, load: Array) -> float:
    """Load that the supply carries against `load` with the shaft nearly on the shell, N."""
    way = load / (float(np.hypot(*load)) or 1.0)
    state = solve_film(film, film.start(), _HIGH * way, np.zeros(2), 1e-6, 100)
    return float(state.linear.load @ way)
