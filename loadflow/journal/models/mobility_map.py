"""The rung "map": shaft and film by the mobility map of `mobility`, tabulated from the grid."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.discretise import build_film
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.models import _mobility_kernels as kernel
from loadflow.journal.models import mobility_films as row
from loadflow.journal.models.grid import solve_on_grid
from loadflow.journal.models.mobility import MobilityMap, scaled, tabulate
from loadflow.journal.questions import AtRest, InMotion
from loadflow.journal.rows import operating_columns, without_supply
from loadflow.journal.solvers.motion.transient import orbit_dataset
from loadflow.quantities import FILM

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

_MOST = 100_000  # steps between two times of a series


@dataclass(frozen=True, eq=False)
class BearingMap:
    """A map with the units of one bearing.

    Attributes
    ----------
    table : MobilityMap
        Map without dimensions.
    units : array (2,)
        Load (N) of s = 1 and velocity (clearances per second) of u = 1.
    pressure : float
        Unit of pressure, Pa.
    """

    bearing: JournalGeometry
    options: Film
    table: MobilityMap
    units: Array
    pressure: float

    def results(self, position: Array, force: Array, speed: Array) -> dict[str, Any]:
        """What follows from positions (n, 2) in clearances, loads and speeds; named as elsewhere.

        `in_range` tells where the map covers them.
        """
        bearing, viscosity = self.bearing, self.options.liquid.viscosity
        place, found = self.table.results_at(position, force / self.units[kernel.LOAD])
        gap = place[:, 0]
        flow = self.pressure * bearing.clearance**3 / (12 * viscosity)
        arc = 2 * np.pi / np.sqrt(gap * (2 - gap))
        drag = viscosity * speed**2 * bearing.radius**3 * bearing.width / bearing.clearance
        direction = np.where(np.hypot(*position.T) > 0, np.arctan2(*position.T[::-1]), 0.0)
        per_place = self.pressure * bearing.radius**2 / bearing.clearance
        return {
            "minimum_film": bearing.clearance * gap,
            "maximum_pressure": self.options.edge_pressure + self.pressure * found[:, row.PEAK],
            "friction_power": self.pressure * flow * found[:, row.DISSIPATION] + drag * arc,
            "side_flow": flow * found[:, row.OUTFLOW],
            "total_fill": found[:, row.FILL],
            "stiffness": per_place * _turned(found[:, row.STIFFNESS], direction),
            "damping": per_place
            / self.units[kernel.VELOCITY]
            * _turned(found[:, row.DAMPING], direction),
            "in_range": self.table.covers(place),
            **without_supply(speed.size),
        }


def _turned(matrices: Array, angle: Array) -> Array:
    """Matrices (n, 4) of frames at `angle` in the frame of the bearing, (n, 2, 2)."""
    c, s = np.cos(angle), np.sin(angle)
    frame = np.stack([np.stack([c, -s], axis=-1), np.stack([s, c], axis=-1)], axis=-2)
    return frame @ matrices.reshape(-1, 2, 2) @ frame.swapaxes(-1, -2)


def bearing_map(bearing: JournalGeometry, options: Film, force: Array) -> BearingMap:
    """The map of a bearing and film, tabulated up to the largest of `force` (n, 2)."""
    if options.grading == "auto":
        options = replace(options, grading="graded")
    # refuses, in the user's units, what no film can have
    build_film(bearing.diameter, bearing.width, bearing.relative_clearance, options)
    dimensionless, unit = scaled(options)
    area = bearing.width * bearing.diameter
    largest = 0.0
    if unit > 0.0:
        most = float(np.hypot(*force.T).max()) / (area * unit)
        largest = 2.0 ** math.ceil(math.log2(max(most, 0.25)))
    table = tabulate(bearing.width / bearing.diameter, dimensionless, largest)
    pressure = unit or 1.0
    velocity = pressure * bearing.relative_clearance**2 / (12 * options.liquid.viscosity)
    return BearingMap(bearing, options, table, np.array([pressure * area, velocity]), pressure)


def equilibrium(asked: AtRest) -> dict[str, Any]:
    """Static equilibria: where the velocity of the map is zero.

    A load that the map does not cover is solved on the grid that the map is made of: ambient
    pressure may feed a film at one end of a cell of the map, and leave it empty at the other.

    Raises
    ------
    SolverError
        A load at ω = 0, or one that the grid does not carry either; names the first such load.
    """
    bearing, force, speed = asked.bearing, np.array(asked.force), np.array(asked.speed)
    film = bearing_map(bearing, asked.film, force)
    position, iterations, residual = _at_rest(film, force, speed)
    found = film.results(position, force, speed)
    covered = found.pop("in_range") & (~force.any(axis=-1) | (iterations > 0))
    answer = {
        **operating_columns(bearing, force, speed, film.options.liquid, position),
        **found,
        "eccentricity_ratio": np.hypot(*position.T),
        "iterations": iterations,
        "converged": covered,
        "residual": residual,
    }
    for index in np.flatnonzero(~covered) if asked.limits.refine else ():
        solve_on_grid(replace(asked, film=film.options), int(index), answer)
    return answer


def _at_rest(
    film: BearingMap, force: Array, speed: Array
) -> tuple[Array, NDArray[np.int64], Array]:
    """Positions (n, 2) in clearances; iterations are 0 where there is no load, or no answer."""
    size = np.hypot(*force.T) / film.units[kernel.LOAD]
    turns = (size > 0) & (speed != 0)
    gap, chi = np.ones(size.size), np.zeros(size.size)
    gap[size > 0] = math.exp(-film.table.axes[kernel.XI_MAX])
    iterations = np.zeros(size.size, dtype=np.int64)
    residual = np.zeros(size.size)
    part = gap[turns], chi[turns], iterations[turns], residual[turns]
    kernel.steady(
        film.table.motion, film.table.axes, film.units, size[turns], np.abs(speed[turns]), *part
    )
    gap[turns], chi[turns], iterations[turns], residual[turns] = part
    k = (gap / (2 - gap)) ** kernel.STRETCH
    turn = np.arctan2(force[:, 1], force[:, 0])
    turn += np.sign(speed) * 2 * np.arctan(k * np.tan(0.5 * chi))
    position = (1 - gap)[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    return position, iterations, residual


def orbit(asked: InMotion) -> xr.Dataset:
    """Path of the shaft by an ordinary differential equation.

    `residual` is the largest error of a step over the narrowest gap, kept below √tolerance, and
    `iterations` counts the steps; `in_range` tells where the map covers position and load.

    Raises
    ------
    SolverError
        No equilibrium to start from, or too many steps between two times.
    """
    bearing, force, speed = asked.bearing, asked.force, asked.speed
    film = bearing_map(bearing, asked.film, force)
    start = asked.steps.start
    if start is None:
        first = equilibrium(replace(asked.at_rest, film=film.options).at(np.array([0])))
        start = first["eccentricity"][0] / bearing.clearance
    path, _, values = advance(film.table.motion, film.table.axes, film.units, asked, start)
    values |= film.results(path, force, speed)
    data = orbit_dataset(values, asked.time, force, speed, bearing.clearance)
    return data.assign(in_range=("time", values["in_range"], FILM["in_range"].attributes))


def advance(
    motion: Array, axes: Array, units: Array, asked: InMotion, start: Array
) -> tuple[Array, Array, dict[str, Any]]:
    """Path of the shaft and its velocity u against the oil, (n, 2), and values for the orbit.

    Raises
    ------
    SolverError
        Too many steps between two times.
    """
    time, force, speed = asked.time, asked.force, asked.speed
    path, slip, error = np.empty((time.size, 2)), np.empty((time.size, 2)), np.zeros(time.size)
    steps = np.zeros(time.size, dtype=np.int64)
    stop = kernel.march(
        motion, axes, units, time, np.ascontiguousarray(force),
        np.require(speed, requirements=("C", "W")),  # one that is read-only compiles anew
        start, math.sqrt(asked.limits.tolerance), _MOST, path, slip, steps, error,
    )  # fmt: skip
    if stop >= 0:
        raise SolverError(
            f"orbit stops before t = {time[stop]:.6g} s: F = ({force[stop, 0]:.6g}, "
            f"{force[stop, 1]:.6g}) N, ω = {speed[stop]:.6g} rad/s need more than {_MOST} steps"
        )
    return path, slip, {"x": path[:, 0], "y": path[:, 1], "residual": error, "iterations": steps}
