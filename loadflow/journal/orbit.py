"""Path of the shaft under a load that changes with time: implicit steps of film and shaft."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.equilibrium import Motion, Solution, solve_equilibrium
from loadflow.journal.film import Film
from loadflow.journal.result import attitude_angle

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

_SMALLEST = 1.0 / 256  # of a given step, to which a step that fails may be cut


@dataclass(frozen=True)
class _Past:
    """What a step needs of an earlier time: position, unknowns, liquid in the cells."""

    time: float
    position: Array
    u: Array
    liquid: Array


@dataclass(frozen=True)
class Marcher:
    """Second-order implicit steps (BDF2 of variable step) of one film.

    A mesh fixed to the shell keeps the liquid of each cell as history; a mesh that turns with the
    shaft serves the laws without fill, whose only history is the path of the shaft.
    """

    film: Film
    tolerance: float
    max_iterations: int

    def begin(self, time: float, solution: Solution) -> list[_Past]:
        """History that starts at `solution`."""
        return [self._past(time, solution)]

    def step(
        self,
        past: list[_Past],
        time: float,
        force: Array,
        speed: float,
        before: tuple[Array, float],
    ) -> tuple[Solution, list[_Past]]:
        """Advance to `time` under `force` (N) and `speed` (rad/s).

        `before` are force and speed at the last time; where Newton fails the step is cut and the
        load interpolated.
        """
        start = past[-1].time
        share, done, spent = 1.0, 0.0, 0
        while True:
            at = min(1.0, done + share)
            now = start + at * (time - start)
            load = before[0] + at * (force - before[0])
            self.film.set_speed(before[1] + at * (speed - before[1]))
            solution = self._try(past, now, load)
            spent += solution.iterations
            if solution.converged:
                past = [past[-1], self._past(now, solution)]
                done = at
                if done >= 1.0:
                    return _counted(solution, spent), past
                share = min(2 * share, 1.0)
            elif share > _SMALLEST:
                share *= 0.5
            else:
                return _counted(solution, spent), past

    def _try(self, past: list[_Past], time: float, force: Array) -> Solution:
        last = past[-1]
        step = time - last.time
        u, position = last.u, last.position
        if len(past) == 1:
            rate = 1.0 / step
            kept = [(rate, last)]
        else:
            ratio = step / (last.time - past[0].time)
            rate = (1 + 2 * ratio) / (1 + ratio) / step
            kept = [((1 + ratio) / step, last), (-(ratio**2) / (1 + ratio) / step, past[0])]
            ahead = last.position + ratio * (last.position - past[0].position)
            if math.hypot(*ahead) < 0.5 + 0.5 * math.hypot(*last.position):
                u, position = last.u + ratio * (last.u - past[0].u), ahead
        if self.film.mesh.polar:
            offset = sum((w * p.position for w, p in kept), np.zeros(2))
            motion = Motion(rate=rate, offset=offset)
        else:
            volume = sum((w * p.liquid for w, p in kept), np.zeros(self.film.mesh.shape))
            motion = Motion(volume_rate=rate, volume=volume)
        return solve_equilibrium(
            self.film, force, u, position, self.tolerance, self.max_iterations, motion
        )

    def _past(self, time: float, solution: Solution) -> _Past:
        self.film.place(solution.u, solution.position)
        return _Past(time, solution.position, solution.u, self.film.liquid())


def _counted(solution: Solution, iterations: int) -> Solution:
    return replace(solution, iterations=iterations)


def march(
    film: Film,
    start: Solution,
    time: Array,
    force: Array,
    speed: Array,
    tolerance: float,
    max_iterations: int,
) -> dict[str, Array]:
    """What `orbit_dataset` needs at every time, the first being `start`.

    Raises
    ------
    SolverError
        A step fails even when cut to 1/256.
    """
    marcher = Marcher(film, tolerance, max_iterations)
    past = marcher.begin(float(time[0]), start)
    rows = [_row(film, start)]
    for i in range(1, time.size):
        before = (force[i - 1], float(speed[i - 1]))
        now = float(time[i])
        solution, past = marcher.step(past, now, force[i], float(speed[i]), before)
        if not solution.converged:
            raise SolverError(
                f"orbit stops at t = {now:.6g} s: F = ({force[i, 0]:.6g}, {force[i, 1]:.6g}) N, "
                f"ω = {speed[i]:.6g} rad/s, ε = {math.hypot(*solution.position):.6g}; residual "
                f"{solution.residual:.3g} after {solution.iterations} Newton steps"
            )
        rows.append(_row(film, solution))
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def _row(film: Film, solution: Solution) -> dict[str, float]:
    row = film.summary(solution.u, solution.position)
    x, y = solution.position.tolist()
    row |= {"x": x, "y": y, "residual": solution.residual, "iterations": solution.iterations}
    return row


_VARIABLES = {
    "eccentricity_ratio": ("1", "eccentricity ratio |e|/c"),
    "minimum_film": ("m", "minimum film thickness"),
    "maximum_pressure": ("Pa", "largest film pressure, absolute"),
    "friction_power": ("W", "friction power of the film"),
    "side_flow": ("m3/s", "oil that leaves through the rims"),
    "supply_flow": ("m3/s", "oil that the grooves give, net"),
    "total_fill": ("1", "share of liquid in the gap"),
    "residual": ("1", "largest imbalance of cell and load, scaled"),
    "iterations": ("1", "Newton steps"),
}


def orbit_dataset(
    values: dict[str, Array], time: Array, force: Array, speed: Array, clearance: float
) -> xr.Dataset:
    """The orbit as a Dataset over time; `values` hold its variables and the position x, y."""
    import xarray as xr

    path = np.stack([values["x"], values["y"]], axis=-1)
    values = values | {"eccentricity_ratio": np.hypot(path[:, 0], path[:, 1])}
    data = {
        name: ("time", values[name], {"units": units, "long_name": text})
        for name, (units, text) in _VARIABLES.items()
    }
    return xr.Dataset(
        {
            "eccentricity": (
                ("time", "axis"),
                path * clearance,
                {"units": "m", "long_name": "shaft centre relative to the shell"},
            ),
            "attitude_angle": (
                "time",
                attitude_angle(force, path, speed),
                {"units": "rad", "long_name": "angle from load to eccentricity, > 0 with rotation"},
            ),
            **data,
        },
        coords={
            "time": ("time", time, {"units": "s", "long_name": "time"}),
            "axis": (
                "axis",
                [0, 1],
                {"units": "1", "long_name": "component in the bearing's plane"},
            ),
        },
    )
