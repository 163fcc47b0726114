"""Why a load has no film, in words and numbers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.shapes import Arc
from loadflow.journal.solvers.load_stepping import APART, has_touched
from loadflow.journal.solvers.newton import Solution, solve_film
from loadflow.numerics.convergence import unresolved

if TYPE_CHECKING:
    from loadflow.journal.film.film import DiscreteFilm
    from loadflow.journal.film.gap.gap import BoreGap
    from loadflow.journal.film.gap.shaped import ShapedGap

Array = NDArray[np.float64]

STARVED = (
    "the supply is starved, a groove would fall below the cavitation pressure: MassConserving and "
    "GasMixture follow a groove that is not full"
)
MORE_STEPS = "a larger control.max_iterations allows more"
AT_REST = "without rotation and squeeze the film carries no load"
_THICK = 100.0  # viscosity under pressure over that without, from which it is told
_NEAREST = 0.01  # gap, in clearances, at which the lift of a supply is stated


def no_equilibrium(force: Array, speed: float, why: str) -> str:
    """Say that no film carries `force` (2,), and `why`; at rest there can be none."""
    why = AT_REST if speed == 0.0 else why
    return f"F = ({force[0]:.6g}, {force[1]:.6g}) N at ω = {speed:.6g} rad/s: {why}"


def not_found(residual: float, rounding: float, iterations: float, ratio: float) -> str:
    """Say that Newton's method ended at the eccentricity `ratio` without an answer."""
    reached = unresolved(residual, rounding, iterations)
    return f"no equilibrium found; {reached}, at ε = {ratio:.6g}"


def narrowest_place(bearing: JournalGeometry, gap: BoreGap, position: Array) -> str:
    """Name the narrowest gap at `position` and where it is."""
    least, angle, z = gap.closest(position)
    return (
        f"narrowest gap {least * bearing.clearance:.6g} m at {math.degrees(angle):.4g}°, "
        f"z = {z * bearing.radius:.6g} m (radial clearance {bearing.clearance:.6g} m)"
    )


def touch_at(bearing: JournalGeometry, film: DiscreteFilm, gap: BoreGap, position: Array) -> str:
    """That the shaft at a `position` touches the bore, or is beyond its law of contact, where."""
    beyond = "" if film.contact is None else " beyond the law of contact"
    return f"the shaft touches the bore{beyond}, {narrowest_place(bearing, gap, position)}"


def touches(film: DiscreteFilm, solution: Solution) -> str:
    """That the shaft has met a rigid bore where it lies aslant in it or has lobes; else nothing.

    Of an aligned cylinder the cells alone say so: its film carries whatever comes.
    """
    gap = cast("BoreGap", film.gap)
    if gap.axisymmetric or not has_touched(film, solution):
        return ""
    least, angle, _ = gap.closest(solution.position)
    at = f" at {math.degrees(angle):.4g}°"
    return touched(least, film.relative_clearance * film.radius, at)


def touched(least: float, clearance: float, at: str = "") -> str:
    """Say that the shaft touches the bore, its narrowest gap `least` clearances, m, and where."""
    narrowest = f"narrowest gap {least * clearance:.6g} m{at}"
    return f"; the shaft touches the bore, {narrowest} (radial clearance {clearance:.6g} m)"


_AT_EDGE = 0.01  # gap at the end of an arc, clearances, where a path that stops has met it


def at_edge(bearing: JournalGeometry, position: Array) -> str:
    """That a shaft at a `position` (2,), clearances, has met an end of a partial arc; else nothing.

    A load beside the arc takes it there, and the film, which ends there, does not hold it.
    """
    arc = bearing.shape
    if not isinstance(arc, Arc):
        return ""
    way = math.remainder(math.atan2(position[1], position[0]) - arc.angle, 2 * math.pi)
    beyond = abs(way) - 0.5 * arc.span
    gap = 1.0 - math.hypot(*position) * math.cos(beyond)
    met = beyond > 0.0 and gap < _AT_EDGE
    return touched(gap, bearing.clearance, " at an edge of the arc") if met else ""


def why_unsolved(
    bearing: JournalGeometry,
    film: DiscreteFilm,
    gap: BoreGap,
    solution: Solution,
    load: Array | None = None,
) -> str:
    """Why `film` has no answer, with the numbers of its last state.

    Under `load` (2,), N, or, without one, at the position of the `solution`.
    """
    at = f"ω = {film.speed:.6g} rad/s"
    if load is None:
        return f"ε = {math.hypot(*solution.position[:2]):.6g} at {at}: " + _unsolved(
            bearing, film, gap, solution, "no film found"
        )
    head = f"F = ({load[0]:.6g}, {load[1]:.6g}) N at {at}: "
    if film.speed == 0.0 and film.contact is None:
        if not film.lifts:
            return head + AT_REST
        if load.any() and not gap.pads.size and not film.dry(solution.u):
            return head + _most(film, gap, load)
    if has_touched(film, solution) and not gap.axisymmetric:
        left = 100 * min(solution.residual, 1.0)
        both = "the film carries" if film.contact is None else "film and asperities carry"
        where = touch_at(bearing, film, gap, solution.position)
        return f"{head}{where}, before {both} the last {left:.3g} % of the load"
    return head + _unsolved(bearing, film, gap, solution, "no equilibrium found")


def _unsolved(
    bearing: JournalGeometry, film: DiscreteFilm, gap: BoreGap, solution: Solution, what: str
) -> str:
    """What keeps the last state of a film from being an answer."""
    position = solution.position
    if film.dry(solution.u):
        return STARVED
    place = narrowest_place(bearing, gap, position)
    if film.clearance_left(position) <= APART:
        return f"the shaft touches the elastic shell, {place}"
    reached = unresolved(solution.residual, solution.rounding, solution.iterations)
    if solution.given_up:
        reached += f", all that a search may take ({MORE_STEPS})"
    found = f"{what}; {reached}, at ε = {math.hypot(*position[:2]):.6g}"
    if solution.unheld:
        return f"{found}: a film holds no pad that faces the load, it turns each flat, {place}"
    if solution.lost.size:
        x, y = cast("ShapedGap", gap).pivots[solution.lost[0] - gap.shaft]
        return (
            f"{found}: a film holds the pad at {math.degrees(math.atan2(y, x)):.4g}° there or just "
            f"beside it alone, so that the pads carry at once too little and too much, {place}"
        )
    if film.contact is not None:
        overlap = -gap.closest(position)[0] / gap.roughness
        return f"{found}, mean planes {overlap:.3g} σ beyond touching"
    if film.thickening is not None and math.isfinite(solution.residual):
        thick = float(film.thickening.liquid.thickening(film.pressures[0].max()))
        if thick > _THICK:
            return f"{found}: the liquid is {thick:.2g} times as thick there, {place}"
    return f"{found}, {place}"


def _most(film: DiscreteFilm, gap: BoreGap, load: Array) -> str:
    """Say what the supply carries against `load` with the shaft nearly on the shell."""
    way, place = load / math.hypot(*load), np.zeros(gap.size)
    place[:2] = gap.reach(way, _NEAREST) * way
    state = solve_film(film, film.start(), place, np.zeros(gap.size), 1e-6, 100)
    lift = float(state.linear.load[:2] @ way)
    return f"the supply carries no more than {lift:.6g} N, at ε = {math.hypot(*place):.6g}"
