"""The rung "reduced" with effects: a shaft that tilts and bends, asperities, a local shell.

What `loadflow.journal.models.reduced` says of cells and points holds here, but that the gap changes
across the width: a shaft that tilts or bends takes polynomials over the whole of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.contact import Contact
from loadflow.journal.film._rough_kernels import NO_CONTACT
from loadflow.journal.film.asperity_load import CylinderLoad
from loadflow.journal.film.discretise import build_film
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap_rough import RoughGap
from loadflow.journal.film.integrals import Integrals, in_units
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.models import composed_film as at
from loadflow.journal.models._composed_kernels import summarise
from loadflow.journal.models._composed_loops import finish, march, newton
from loadflow.journal.models.composed_film import Composed, ComposedWork, Rough, make_work
from loadflow.journal.models.model import Steps
from loadflow.journal.models.slow_heat import THIN, cooled, slow_states
from loadflow.journal.models.width_modes import half_width_nodes, whole_width
from loadflow.journal.rows import operating_columns, without_supply
from loadflow.journal.shells import LinedShell, LocalShell
from loadflow.journal.solvers.estimate import NEAR, closed_form_position
from loadflow.journal.solvers.messages import no_equilibrium, not_found
from loadflow.numerics.convergence import Limits, unresolved

Array = NDArray[np.float64]

HALF_POINTS = 3  # across the half width of a film that is even about its middle
POINTS = 6  # across the whole width: as many even polynomials, and three odd ones
_LINES = 32  # across, on which the asperities of a shaft that tilts are asked
_PER_SIZE = 0.05  # distance of the eccentricities of the table of contact, over the roughness
_ROOM = 0.02  # gap, in clearances, that the first position of a smooth shaft must leave


def composes(film: Film, line: Line) -> bool:
    """Whether a film has more than the aligned cylinder with smooth, rigid surfaces."""
    return film.contact is not None or film.shell is not None or not line.straight


@dataclass(frozen=True)
class ComposedFilm:
    """One film, ready to be solved load by load, or through time.

    Attributes
    ----------
    bearing, options, line
        As given.
    units : DiscreteFilm
        The grid's film without effects, of which units and cells are taken.
    film : Composed
        Constants of the compiled loops.
    work : ComposedWork
        Their work arrays.
    """

    bearing: JournalGeometry
    options: Film
    line: Line
    units: DiscreteFilm
    film: Composed
    work: ComposedWork

    @property
    def whole(self) -> bool:
        """Whether the whole width is solved."""
        return not self.line.straight

    @property
    def size(self) -> int:
        """Degrees of freedom of the shaft that move."""
        return 4 if self.line.moment is not None else 2

    def loads(self, force: Array) -> Array:
        """Forces, N, and moments over the shaft radius, (n, 4)."""
        rows = np.zeros((len(force), 4))
        rows[:, :2] = force
        if self.line.moment is not None:
            rows[:, 2:] = self.line.moment / self.bearing.radius
        return rows

    def lines(self, count: int) -> Array:
        """Tilt and bend that are given, in the units of the loops, (n, 4)."""
        rows, unit = np.zeros((count, 4)), self.bearing.radius / self.bearing.clearance
        if self.line.tilt is not None:
            rows[:, :2] = self.line.tilt * unit
        if self.line.bend is not None:
            rows[:, 2:] = self.line.bend * (unit * self.bearing.radius)
        return rows

    def cold(self) -> Array:
        """Unknowns of a film at edge pressure."""
        return self.units.unknown_of(np.full(self.work.u.shape, self.film.p_edge))

    def estimates(self, force: Array, speed: Array, lines: Array) -> Array:
        """First positions (n, 4): closed form, as near as asperities and given tilt ask."""
        size = np.hypot(*force.T)
        numbers = [
            self.bearing.sommerfeld_number(*point, self.units.viscosity)
            for point in zip(size.tolist(), speed.tolist())
        ]
        ratio = self.bearing.width / self.bearing.diameter
        ruptures = self.units.ruptures
        finite = np.where(np.isfinite(numbers), numbers, 1e9)
        places = np.zeros((speed.size, 4))
        places[:, :2] = closed_form_position(ratio, finite, force, speed, ruptures)
        if self.size == 2:
            places[:, 2:] = lines[:, :2]
        standing = speed == 0.0
        if self.film.rough.size > 0.0:
            alone = self._touching_at(size)
            nearer = standing | (np.hypot(*places[:, :2].T) > alone)
            toward = force / np.maximum(size, 1e-300)[:, None]
            places[nearer, :2] = (alone[:, None] * toward)[nearer]
        else:
            places[standing, :2] = 0.0
        z, rough = self.film.nodes.z, self.film.rough.size
        for place, (*_, bx, by) in zip(places, lines):
            ends = np.stack(
                [place[3] * z + 0.5 * bx * z * z, -place[2] * z + 0.5 * by * z * z], axis=-1
            )
            for _ in range(60):
                if np.hypot(*(place[:2] + ends).T).max() <= 1.0 - max(_ROOM, 0.0) or (
                    rough > 0.0 and np.hypot(*(place[:2] + ends).T).max() <= 1.0 + 2.0 * rough
                ):
                    break
                place[:2] *= 0.9
        return places

    def _touching_at(self, load: Array) -> Array:
        """Eccentricity ratios (n,) at which asperities alone carry loads (n,), N."""
        rough = self.film.rough
        carried = rough.table[0] * rough.weights.sum()
        ratios = rough.first + rough.step * np.arange(carried.size)
        return np.interp(load, carried, ratios)

    def resolves(self, position: Array) -> bool:
        """Whether the cells around resolve the narrowest gap of a rigid shell."""
        return self.film.give > 0.0 or self.units.resolves(np.array([self.farthest(position), 0.0]))

    def farthest(self, position: Array) -> float:
        """Largest eccentricity ratio across the width."""
        z, bend = self.film.nodes.z, self.work.bend
        ex = position[0] + position[3] * z + 0.5 * bend[0] * z**2
        ey = position[1] - position[2] * z + 0.5 * bend[1] * z**2
        return float(np.hypot(ex, ey).max())

    def results(self, rows: Array, speed: Array) -> dict[str, Any]:
        """Rows of the compiled loops, in SI units and named as in `Equilibrium`."""
        share = 0.5 if self.whole else 1.0  # the units are those of half of the width
        found = Integrals(
            peak=rows[:, at.PEAK],
            dissipation=share * rows[:, at.DISSIPATION],
            shear=share * rows[:, at.SHEAR],
            outflow=share * rows[:, at.OUTFLOW],
            fill=rows[:, at.FILLED],
        )
        clearance, contact = self.bearing.clearance, self.options.contact
        values = in_units(self.units, found, speed, rows[:, at.LEAST])
        values |= {
            "residual": rows[:, at.RESIDUAL],
            "iterations": rows[:, at.ITERATIONS].astype(int),
            "eccentricity_ratio": np.hypot(rows[:, at.X], rows[:, at.Y]),
            **without_supply(len(rows)),
        }
        if self.whole:
            values["tilt"] = rows[:, [at.TILT_X, at.TILT_Y]] * clearance / self.bearing.radius
            values["moment"] = rows[:, [at.MOMENT_X, at.MOMENT_Y]] * self.bearing.radius
        if self.options.shell is not None:
            values["shell_deformation"] = rows[:, at.GROWTH] * clearance
        if contact is not None:
            values |= self._rubbing(contact, rows, speed)
            values["friction_power"] = values["friction_power"] + values["contact_power"]
        return values

    def _rubbing(self, contact: Contact, rows: Array, speed: Array) -> dict[str, Any]:
        """What the asperities carry and lose, and the mean gap between them."""
        clearance, planes = self.bearing.clearance, rows[:, at.LEAST]
        gap = _rough_gap(contact, self.units, clearance)
        force = rows[:, [at.CONTACT_X, at.CONTACT_Y]]
        touching = planes * clearance < contact.asperities.reach
        heights = np.where(touching, planes, 1.0) * clearance
        return {
            "minimum_film": clearance * np.array([gap.rough.mean(h) for h in planes.tolist()]),
            "contact_force": force,
            "contact_pressure": np.where(touching, contact.asperities.pressure(heights), 0.0),
            "contact_area": np.where(touching, contact.asperities.area(heights), 0.0),
            "contact_power": contact.coefficient
            * rows[:, at.NORMAL]
            * np.abs(speed)
            * self.bearing.radius,
        }


def equilibrium(
    bearing: JournalGeometry, options: Film, force: Array, speed: Array, line: Line, control: Limits
) -> tuple[dict[str, Any], NDArray[np.bool_]]:
    """Fields of `Equilibrium`, and which loads have an answer."""
    model = build(bearing, options, speed, line)
    film, work, count = model.film, model.work, speed.size
    rows, lines, loads = np.zeros((count, at.RESULTS)), model.lines(speed.size), model.loads(force)
    places = model.estimates(force, speed, lines)
    both = 4 if model.whole else 2
    stiffness, damping = np.zeros((count, both, both)), np.zeros((count, both, both))
    last: int | None = None
    for n in range(count):
        spent, converged, residual, rounding = 0, False, np.inf, 0.0
        work.bend[:] = lines[n, 2:]
        work.liquid[:] = 0.0
        if speed[n] == 0.0 and options.contact is None and loads[n].any():
            rows[n, at.RESIDUAL] = np.inf
            continue  # no film without rotation and squeeze
        for place in _starts(model, places, last, n, rows):
            residual, iterations, converged, rounding = newton(
                film, work, place, loads[n], model.size, speed[n], 0.0,
                control.tolerance, control.max_iterations,
            )  # fmt: skip
            spent += iterations
            if converged and options.may_grade:
                converged = model.resolves(place)
            if converged:
                finish(film, work, place, speed[n], both, rows[n], stiffness[n], damping[n])
                work.last[:] = work.u
                last = n
                break
        rows[n, at.RESIDUAL :] = residual, spent, converged, rounding
    lengths = np.array([1.0, 1.0, bearing.radius, bearing.radius])[:both]
    scale = np.outer(lengths, lengths) / bearing.clearance
    position = rows[:, [at.X, at.Y]]
    answer = {
        **operating_columns(bearing, force, speed, options.liquid, position),
        "moment": np.zeros((count, 2)),
        "tilt": np.zeros((count, 2)),
        "pad_tilt": np.zeros((count, 0)),
        **model.results(rows, speed),
        "stiffness": stiffness * scale,
        "damping": damping * scale,
    }
    if options.contact is not None:
        answer["contact_share"] = _share(answer["contact_force"], force)
    return answer, rows[:, at.CONVERGED] > 0


def orbit(
    bearing: JournalGeometry,
    options: Film,
    time: Array,
    force: Array,
    speed: Array,
    line: Line,
    control: Limits,
    steps: Steps,
    begin: Callable[[], Array],
) -> dict[str, Any]:
    """Variables of the path over time.

    `begin` finds the first position (4,) where none is given and the film alone does not.

    Raises
    ------
    loadflow.errors.SolverError
        No equilibrium to start from, or a step that fails even when cut to 1/256.
    """
    model = build(bearing, options, speed, line)
    raised = float(np.hypot(*force.T).max()) / (bearing.width * bearing.diameter)
    model.units.raise_scale(raised)
    film = model.film._replace(scale=model.units.scale)
    model = replace(model, film=film)
    work, rows = model.work, np.zeros((time.size, at.RESULTS))
    lines, loads = model.lines(time.size), model.loads(force)
    work.bend[:] = lines[0, 2:]
    work.u[:] = model.cold()
    place = model.estimates(force[:1], speed[:1], lines[:1])[0]
    size = model.size if steps.start is None else 0
    if steps.start is not None:
        place[:2] = steps.start
    rub = 0.0 if options.contact is None else options.contact.coefficient * bearing.radius
    share = 0.5 if model.whole else 1.0
    warmth, states = slow_states(options, model.units, share, rub, steps.temperature, time.size)
    limits = control.tolerance, 2 * control.max_iterations
    turning = speed[0] * states[0, THIN]
    first = place.copy()
    residual, iterations, converged, rounding = newton(
        film, work, first, loads[0], size, turning, 0.0, *limits
    )
    if not converged and steps.start is None:
        first = begin()
        work.u[:] = model.cold()
        for moving in (0, size):  # the film first
            residual, iterations, converged, rounding = newton(
                film, work, first, loads[0], moving, turning, 0.0, *limits
            )
    if not converged:
        why = not_found(residual, rounding, iterations, float(np.hypot(*first[:2])))
        raise SolverError(f"orbit cannot start: {no_equilibrium(force[0], speed[0], why)}")
    summarise(film, work, first, rows[0])
    rows[0, at.RESIDUAL :] = residual, iterations, converged, rounding
    solved = march(
        film, work, first, model.size, time, loads, lines, speed,
        control.tolerance, control.max_iterations, rows, warmth, states,
    )  # fmt: skip
    last = solved - 1
    if not rows[last, at.CONVERGED]:
        raise SolverError(
            f"orbit stops at t = {time[last]:.6g} s: F = ({force[last, 0]:.6g}, "
            f"{force[last, 1]:.6g}) N, ω = {speed[last]:.6g} rad/s, "
            f"ε = {np.hypot(rows[last, at.X], rows[last, at.Y]):.6g}; "
            + unresolved(*rows[last, [at.RESIDUAL, at.ROUNDING, at.ITERATIONS]])
        )
    values = model.results(rows, speed * states[:, THIN])
    values |= {"x": rows[:, at.X], "y": rows[:, at.Y]}
    if options.contact is not None:
        values["contact_share"] = _share(values["contact_force"], force)
    return cooled(warmth, states, values)


def _starts(
    model: ComposedFilm, places: Array, last: int | None, n: int, rows: Array
) -> Iterator[Array]:
    """Positions to start load `n` from; sets the unknowns that belong to each."""
    work = model.work
    if last is not None:
        before = rows[last, :4]
        moved = np.hypot(*(places[n] - places[last])[:2])
        gap = max(1.0 - np.hypot(*before[:2]), model.film.rough.size)
        if moved < NEAR * gap and (model.size == 4 or np.allclose(before[2:], places[n, 2:])):
            work.u[:] = work.last
            yield before.copy()
    work.u[:] = model.cold()
    yield places[n].copy()


def _share(carried: Array, force: Array) -> Array:
    """Part of loads (n, 2) that asperities carry along them, over their size; 0 without load."""
    size = (force * force).sum(axis=-1)
    along = (carried * force).sum(axis=-1)
    return np.where(size > 0.0, along / np.where(size > 0.0, size, 1.0), 0.0)


def build(bearing: JournalGeometry, options: Film, speed: Array, line: Line) -> ComposedFilm:
    """Put a film on cells around and points across."""
    bare = replace(options, grading="uniform", inlet=None, contact=None, shell=None)
    units = build_film(bearing.diameter, bearing.width, bearing.relative_clearance, bare)
    units.set_scale(float(np.abs(speed).max()))
    half = float(units.mesh.z_edges[-1])
    whole = not line.straight
    nodes = whole_width(half, POINTS) if whole else half_width_nodes(half, HALF_POINTS)
    angle = units.mesh.angle
    face = angle + np.pi / angle.size
    film = Composed(
        np.cos(angle), np.sin(angle), np.cos(face), np.sin(face), units.mesh.order,
        (0,) * nodes.slopes.shape[1], (0,) * nodes.z.size, nodes,
        units.law.address, np.array(units.law.numbers), units.law.fill_at(units.p_edge),
        units.scale, units.p_edge, units.slope, (1.0 if whole else 2.0) * units.radius**2,
        _give(bearing, options), _rough(bearing, options.contact, whole, units),
    )  # fmt: skip
    return ComposedFilm(bearing, options, line, units, film, make_work(angle.size, nodes))


def _give(bearing: JournalGeometry, options: Film) -> float:
    """Growth of the gap over pressure, clearances per Pa."""
    shell = options.shell
    if shell is None:
        return 0.0
    shell.check_local(bearing.width)
    return cast("LocalShell | LinedShell", shell).compliance / bearing.clearance


def _rough_gap(contact: Contact, units: DiscreteFilm, clearance: float) -> RoughGap:
    return RoughGap(units.mesh, contact, clearance)


def _rough(
    bearing: JournalGeometry, contact: Contact | None, whole: bool, units: DiscreteFilm
) -> Rough:
    """Asperities of the surfaces; none where they are smooth."""
    none = np.empty((0, 16))
    if contact is None:
        return Rough(0.0, none, none, 0.0, 0.0, 9.0, 1.0, np.zeros((4, 2)), np.zeros(1), np.ones(1))
    gap = _rough_gap(contact, units, bearing.clearance)
    size, along, across, slip = gap.rough.numbers
    first, step, table = _line_of_contact(contact, bearing.radius, bearing.clearance)
    x, w = np.polynomial.legendre.leggauss(_LINES if whole else 1)
    half = bearing.width / bearing.diameter
    return Rough(
        size, along, across, slip, gap.rough.deepest, first, step, table, half * x, half * w
    )


@lru_cache(maxsize=8)
def _line_of_contact(
    contact: Contact, radius: float, clearance: float
) -> tuple[float, float, Array]:
    """Table of what asperities carry on a shaft radius of width, over the eccentricity ratio."""
    surfaces = CylinderLoad(contact, radius, radius, clearance)
    size, tips = contact.asperities.roughness / clearance, contact.asperities.summit_height
    step = _PER_SIZE * size
    ratios = np.arange(1.0 - tips / clearance - NO_CONTACT * size, 1.0 + 0.04, step)
    ratios = ratios[: int((NO_CONTACT + 9.0) / _PER_SIZE)]
    touches = [surfaces.at(np.array([ratio, 0.0])) for ratio in ratios.tolist()]
    normal = np.array([touch.normal for touch in touches])
    table = np.stack(
        [
            [touch.load[0] for touch in touches],
            [touch.stiffness[0, 0] for touch in touches],
            normal,
            np.gradient(normal, step),
        ]
    )
    return float(ratios[0]), step, table
