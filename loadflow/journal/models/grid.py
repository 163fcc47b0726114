"""The rung "grid": finite volumes around and across, for every bore, shell and supply."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import LoadflowError, SolverError
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.models.finer_orbit import on_enough_cells
from loadflow.journal.questions import AtPosition, AtRest, InMotion
from loadflow.journal.rows import columns_of
from loadflow.journal.solvers.motion.periodic import (
    Method,
    check_half_speed_whirl,
    check_period,
    close_orbit,
)
from loadflow.journal.solvers.motion.start import orbit_film, orbit_start
from loadflow.journal.solvers.motion.transient import (
    Marcher,
    march,
    mass_balance,
    orbit_dataset,
    orbit_row,
)
from loadflow.journal.solvers.static_rows import equilibrium_rows, field_rows
from loadflow.journal.solvers.warm.mean import mean_heat, with_temperatures
from loadflow.journal.solvers.warm.rows import warm_fields, warm_rows
from loadflow.numerics.convergence import Limits
from loadflow.numerics.lines import on_lines
from loadflow.numerics.one_thread import on_one_thread

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Question = TypeVar("Question", AtRest, AtPosition)

_MOST_AROUND = 240  # cells, of an orbit that stops on fewer
_TOLERANCE, _STEPS = 1e-10, 60  # of a load that a coarser model leaves to the grid


@on_one_thread
def equilibrium(asked: AtRest) -> dict[str, Any]:
    """Static equilibria: fields of `Equilibrium`, (n, …)."""
    rows = equilibrium_rows if asked.film.heat is None else warm_rows
    return columns_of(rows(asked))


@on_one_thread
def pressure(asked: AtPosition) -> tuple[dict[str, Any], Array]:
    """Films at given positions: fields of `FilmField`, (n, …), and axial places of the cells, m."""
    fields = field_rows if asked.film.heat is None else warm_fields
    rows, z = fields(asked)
    return columns_of(rows), z if z[0] < 0 else np.concatenate([-z[::-1], z])


@on_one_thread
def orbit(asked: InMotion) -> xr.Dataset:
    """Path of the shaft by implicit steps, or its closed path."""
    if not asked.film.law.keeps_fill:
        return _path(asked)

    def path(films: Sequence[Film]) -> xr.Dataset:
        (on,) = films
        return _path(replace(asked, film=on)).assign_attrs(cells_around=on.cells[0])

    return on_enough_cells([asked.film], path, [_MOST_AROUND])


def _path(asked: InMotion) -> xr.Dataset:
    """The orbit on the cells of its film."""
    bearing, film, line = asked.bearing, asked.film, asked.line
    time, force, speed = asked.time, asked.force, asked.speed
    limits, steps = asked.limits, asked.steps
    if steps.periodic:
        check_period(time, force, speed, line)
    first_limits = replace(limits, max_iterations=2 * limits.max_iterations)
    statics, forces = orbit_film(bearing, film, force, speed, line)
    # temperatures over the area, which the motion does not change
    warmth = None if film.heat is None else mean_heat(statics, force, speed, first_limits)
    first = orbit_start(statics, force[0], float(speed[0]), steps.start, first_limits)
    discrete = statics.film
    if steps.periodic and statics.gap.axisymmetric and not discrete.lifts:
        check_half_speed_whirl(time, force, speed)
    march_limits = limits.tolerance, limits.max_iterations
    marcher = Marcher(discrete, *march_limits, steps.accuracy, statics.shaft)
    lines = _lines(bearing, line, time.size)
    if steps.periodic:
        way: Method = "marching" if steps.periodic == "marching" else "direct"
        rows, ends, about = close_orbit(
            marcher, first, time, forces, speed, way, steps.closure, steps.max_periods, lines
        )
    else:
        past = marcher.begin(float(time[0]), first)
        begun = orbit_row(discrete, first, 0)  # at the speed and bend of the first time
        rows, end, extremes = march(marcher, past, time, forces, speed, lines)
        discrete.set_speed(float(speed[0]))
        extremes.see(begun, first)
        rows, ends, about = [begun, *rows], (past[-1], end[-1]), extremes.bounds()
    values = columns_of(rows)
    if steps.step == "given":
        del values["steps"]
    about["mass_balance"] = mass_balance(*ends, rows, time)
    path = orbit_dataset(values, time, force, speed, bearing.clearance).assign_attrs(about)
    return path if warmth is None else with_temperatures(path, warmth, bearing.clearance)


def _lines(bearing: JournalGeometry, line: Line, count: int) -> Array | None:
    """Tilt and bend of a shaft over time, (n, 4), in the coordinates of the gap."""
    if line.tilt is None and line.bend is None:
        return None
    rows, unit = np.zeros((count, 4)), bearing.radius / bearing.clearance
    if line.tilt is not None:
        rows[:, :2] = line.tilt * unit
    if line.bend is not None:
        rows[:, 2:] = line.bend * (unit * bearing.radius)
    return rows


@contextmanager
def numbered(index: int) -> Iterator[None]:
    """Have errors of the one load or position of a call say the number `index`."""
    try:
        yield
    except LoadflowError as error:
        said = re.sub(r"^(load|film|eccentricity) 0:", rf"\1 {index}:", str(error))
        raise type(error)(said) from error


def why_none(on_grid: Callable[[], object]) -> str:
    """Why one load or position that a coarser model does not solve has no film `on_grid` either.

    Or that it has one.
    """
    try:
        on_grid()
    except SolverError as error:
        return re.sub("^(load|film) 0: ", "", str(error))
    return 'no film on rung = "reduced"; "grid" has one'


def solve_on_grid(asked: AtRest, index: int, answer: dict[str, Any]) -> None:
    """Replace the row `index` of the `answer` of a coarser model by that of the grid.

    Raises
    ------
    SolverError
        If ``limits.strict`` and the grid has no answer either.
    """
    with numbered(index):
        [state] = equilibrium_rows(_alone(asked, index))
    _take(answer, index, state)


def hold_on_grid(asked: AtPosition, index: int, answer: dict[str, Any], z: Array) -> None:
    """The same of the field at a position, shown at the angles of the answer and at `z`, m.

    Raises
    ------
    InputError
        The shaft touches the bore.
    SolverError
        If ``limits.strict`` and the grid has no answer either.
    """
    with numbered(index):
        found, places = pressure(_alone(asked, index))
    state = {name: values[0] for name, values in found.items()}
    for name in ("pressure", "fill", "deformation", "gap"):
        across = on_lines(z, places, state[name].T).T
        state[name] = on_lines(answer["angle"][index], state["angle"], across, period=2.0 * np.pi)
    _take(answer, index, state | {"angle": answer["angle"][index]})


def _alone(asked: Question, index: int) -> Question:
    """The question of one load or position, within the limits of the grid."""
    own = Limits(_TOLERANCE, _STEPS, asked.limits.strict)
    return replace(asked.at(np.array([index])), limits=own)


def _take(answer: dict[str, Any], index: int, state: dict[str, Any]) -> None:
    """Replace a row of an answer; Newton steps that it took before count, too."""
    spent = answer["iterations"][index]
    for name, values in answer.items():
        values[index] = state[name]
    answer["iterations"][index] += spent
