"""Path of the shaft under a load that changes with time: implicit steps of film and shaft."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.film import EVERY, DiscreteFilm
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.film.integrals import summary
from loadflow.journal.rows import attitude_angle
from loadflow.journal.solvers.messages import touches
from loadflow.journal.solvers.motion import step_size
from loadflow.journal.solvers.motion.history import Past, backward_difference
from loadflow.journal.solvers.motion.moving_pads import LATER, other_pads, with_pads
from loadflow.journal.solvers.motion.orbit_error import Extremes
from loadflow.journal.solvers.motion.step_size import FINEST, SAFETY, SMALLEST, foreseen
from loadflow.journal.solvers.newton import Motion, Solution, solve_equilibrium
from loadflow.journal.solvers.pads.statics import unload_other_pads
from loadflow.numerics.convergence import unresolved
from loadflow.quantities import FILM

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]


class OrbitStopped(SolverError):
    """A step of an orbit, or its first film, that is not found however short the step is.

    Attributes
    ----------
    time : float
        Where it stops, s; NaN for the first film.
    work : float or None
        Newton steps times cells that it took up to there, of a first film as `Effort` counts; None
        where nobody counts them: smooth, aligned films on the rung "reduced", and shafts in several
        films, of which a step is cheap.
    """

    def __init__(self, message: str, time: float = math.nan, work: float | None = None) -> None:
        super().__init__(message)
        self.time, self.work = time, work


def stopped(
    time: float,
    force: Array,
    speed: float,
    ratio: float,
    found: tuple[float, float, float],
    why: str = "",
    work: float | None = None,
) -> OrbitStopped:
    """Say at which load an orbit stops.

    Parameters
    ----------
    time, force, speed, ratio
        Of the step, s, its load (2,), N, speed, rad/s, and eccentricity ratio at which Newton
        ended.
    found : tuple of float
        Residual, its rounding level, and Newton steps.
    why : str
        What else is known.
    work : float or None
        As of `OrbitStopped`.
    """
    return OrbitStopped(
        f"orbit stops at t = {time:.6g} s: F = ({force[0]:.6g}, {force[1]:.6g}) N, "
        f"ω = {speed:.6g} rad/s, ε = {ratio:.6g}; {unresolved(*found)}{why}",
        float(time),
        work,
    )


@dataclass(frozen=True)
class Marcher:
    """Second-order implicit steps (BDF2 of variable step) of one film.

    A mesh fixed to the shell keeps the liquid of each cell as history; a mesh that turns with the
    shaft serves the laws without fill, whose only history is the path of the shaft. With an
    `accuracy`, steps are cut until their error is below that share of the narrowest gap. Only the
    degrees of freedom `free` move.
    """

    film: DiscreteFilm
    tolerance: float
    max_iterations: int
    accuracy: float = math.inf
    free: slice | NDArray[np.int64] = field(default_factory=lambda: EVERY)

    def begin(self, time: float, solution: Solution) -> list[Past]:
        """History that starts at `solution`."""
        free = np.arange(self.film.gap.size)[solution.free]
        pads = np.intersect1d(free, self.film.gap.pads)
        return [self.past(time, solution.u, solution.position, pads)]

    def step(
        self,
        past: list[Past],
        time: float,
        force: Array,
        speed: float,
        before: tuple[Array, float],
        lines: tuple[Array, Array] | None = None,
    ) -> tuple[Solution, list[Past], int]:
        """Advance to `time` under `force` (N) and `speed` (rad/s), in the number of steps returned.

        `before` are force and speed at the last time, `lines` tilt and bend (4,) of the shaft at
        both times where they are given; where Newton fails, or the error is too large, the step is
        cut and all that is given interpolated.
        """
        start = past[-1].time
        smallest = SMALLEST if math.isinf(self.accuracy) else FINEST
        share, done, spent, steps = 1.0, 0.0, 0, 0
        if self.accuracy < math.inf:
            share = min(past[-1].ahead / (time - start), 1.0)
        while True:
            at = 1.0 if done + 1.01 * share > 1.0 else done + share
            now = start + at * (time - start)
            load = before[0] + at * (force - before[0])
            self.film.set_speed(before[1] + at * (speed - before[1]))
            line = None if lines is None else lines[0] + at * (lines[1] - lines[0])
            before_step = past = self._on_pads(past)
            solution = self.attempt(past, now, load, line)
            spent += solution.iterations
            if not solution.converged and self.film.gap.pads.size and share <= LATER:
                before_step = self._on_other_pads(past, solution)
                if before_step is not past:
                    solution = self.attempt(before_step, now, load, line)
                    spent += solution.iterations
            growth = self._growth(past, now, solution.position) if solution.converged else 0.5
            if growth >= SAFETY:
                share = (
                    min(growth * (at - done), 1.0) if at < 1.0 else max(growth * (at - done), share)
                )
                following = self.next(before_step[-1], now, solution, share * (time - start))
                past = [*before_step[-2:], following]
                done, steps = at, steps + 1
                if done >= 1.0:
                    return replace(solution, iterations=spent), past, steps
            elif share > smallest:
                share *= growth
            else:
                return replace(solution, iterations=spent, converged=False), past, steps

    def _growth(self, past: list[Past], time: float, position: Array) -> float:
        """How much longer the next step may be; below `SAFETY` this one was too long."""
        if math.isinf(self.accuracy):
            return 2.0
        lasting = np.diff([*(p.time for p in past), time])[::-1].tolist()
        step, before, earlier = [*lasting, 0.0, 0.0][:3]
        ahead = [w * p.position for w, p in zip(foreseen(step, before, earlier), reversed(past))]
        left = math.hypot(*(position - np.sum(ahead, axis=0)).tolist())
        narrow = self.film.gap.narrowest(position)
        return step_size.growth(left, narrow, step, before, earlier, self.accuracy)

    def attempt(
        self, past: list[Past], time: float, force: Array, line: Array | None = None
    ) -> Solution:
        """One step to `time`, whatever comes of it: backward Euler from a `past` of one time."""
        last = past[-1]
        step = time - last.time
        u, position = last.u, last.position
        if len(past) == 1:
            rate = 1.0 / step
            kept = [(rate, last)]
        else:
            before = past[-2]
            ratio = step / (last.time - before.time)
            rate, *weights = backward_difference(step, last.time - before.time)
            kept = [*zip(weights, (last, before))]
            ahead = last.position + ratio * (last.position - before.position)
            gap = self.film.gap
            if gap.narrowest(ahead) > 0.5 * gap.narrowest(last.position):
                u, position = last.u + ratio * (last.u - before.u), ahead
        if line is not None:
            position = self._laid(position, line)
        if self.film.mesh.polar:
            offset = sum((w * p.position for w, p in kept), np.zeros(2))
            motion = Motion(rate=rate, offset=offset)
        else:
            volume = sum((w * p.liquid for w, p in kept), np.zeros(self.film.mesh.shape))
            motion = Motion(volume_rate=rate, volume=volume)
        return solve_equilibrium(
            self.film, force, u, position, self.tolerance, self.max_iterations, motion,
            self._moving(last.pads),
        )  # fmt: skip

    def _moving(self, pads: NDArray[np.int64]) -> slice | NDArray[np.int64]:
        """Degrees of freedom that move in a step: those of the shaft, and of `pads`."""
        if not self.film.gap.pads.size:
            return self.free
        gap = cast("ShapedGap", self.film.gap)
        unload_other_pads(self.film, gap, pads)
        return np.append(np.arange(gap.size)[self.free], pads)

    def _on_other_pads(self, past: list[Past], failed: Solution) -> list[Past]:
        """The history with other pads under a film than those on which a step has failed."""
        gap, speed = cast("ShapedGap", self.film.gap), self.film.speed
        pads = other_pads(gap, past[-1], failed.position, speed)
        if np.array_equal(pads, past[-1].pads):
            return past
        return with_pads(self.film, gap, past, pads, self.past)

    def _on_pads(self, past: list[Past]) -> list[Past]:
        """The history as it is when pads have come under a film, or have lost theirs."""
        if not self.film.gap.pads.size:
            return past
        gap, last = cast("ShapedGap", self.film.gap), past[-1]
        pads = gap.converging(last.position, self.film.speed)
        if pads.size < 2:  # on one alone a shaft is free to go sideways
            pads = np.union1d(pads, last.pads)
        if np.array_equal(pads, last.pads):
            return past
        return with_pads(self.film, gap, past, pads, self.past)

    def _laid(self, position: Array, line: Array) -> Array:
        """The position with the given tilt, where that is not free; sets the given bend."""
        bent, gap = cast("ShapedGap", self.film.gap), position.copy()
        bent.bend(line[2:])
        held = np.setdiff1d(np.arange(2, 4), np.arange(position.size)[self.free])
        gap[held] = line[held - 2]
        return gap

    def next(self, last: Past, time: float, solution: Solution, ahead: float = math.inf) -> Past:
        """History at a `solution` that follows the `last` one."""
        new = self.past(time, solution.u, solution.position, last.pads)
        before = new.gain if math.isnan(last.gain) else last.gain
        gained = last.gained + 0.5 * (before + new.gain) * (time - last.time)
        return replace(new, gained=gained, ahead=ahead)

    def past(self, time: float, u: Array, position: Array, pads: NDArray[np.int64]) -> Past:
        """History of a film with unknowns `u` at `position`, on `pads` if it is on any."""
        self.film.place(u, position)
        volume, gain = self.film.stock()
        return Past(time, position, u, self.film.liquid(), volume, gain, pads=pads)


def march(
    marcher: Marcher,
    past: list[Past],
    time: Array,
    force: Array,
    speed: Array,
    lines: Array | None = None,
) -> tuple[list[dict[str, Any]], list[Past], Extremes]:
    """Rows of the orbit at every time after the first, the history at the last, and extremes.

    `lines` (n, 4) are tilt and bend of the shaft where they are given.

    Raises
    ------
    OrbitStopped
        A step fails even when cut.
    """
    rows: list[dict[str, Any]] = []
    extremes = Extremes(marcher.film)
    for i in range(1, time.size):
        before = (force[i - 1], float(speed[i - 1]))
        now = float(time[i])
        both = None if lines is None else (lines[i - 1], lines[i])
        solution, past, steps = marcher.step(past, now, force[i], float(speed[i]), before, both)
        if not solution.converged:
            found = solution.residual, solution.rounding, solution.iterations
            ratio, why = math.hypot(*solution.position[:2]), touches(marcher.film, solution)
            taken = solution.iterations + sum(row["iterations"] for row in rows)
            work = float(taken * marcher.film.mesh.order.size)
            raise stopped(now, force[i], speed[i], ratio, found, why, work)
        rows.append(orbit_row(marcher.film, solution, steps))
        extremes.see(rows[-1], solution)
    return rows, past, extremes


def orbit_row(film: DiscreteFilm, solution: Solution, steps: int) -> dict[str, Any]:
    """What an orbit says of one time, after `steps` implicit steps."""
    row = summary(film, solution.u, solution.position)
    if film.elastic:
        row["shell_deformation"] = float(film.deformation.max())
    x, y = solution.position[:2].tolist()
    if film.gap.pads.size:
        row["pad_tilt"] = solution.position[film.gap.pads] * film.relative_clearance
    if film.gap.shaft > 2:
        row["tilt"] = solution.position[2:4] * film.relative_clearance
        frame = film.gap.place(solution.position)
        row["moment"] = film.radius * film.load_of(frame, solution.position)[2:4]
    return row | {
        "x": x,
        "y": y,
        "residual": solution.residual,
        "iterations": solution.iterations,
        "steps": steps,
    }


def mass_balance(first: Past, last: Past, rows: list[dict[str, Any]], time: Array) -> float:
    """What entered the film less what left and what stayed, over what left or was there."""
    left = float(np.trapezoid([row["side_flow"] for row in rows], time))
    stored = last.volume - first.volume
    return float((last.gained - first.gained - stored) / max(left, last.volume))


_VARIABLES = (
    "eccentricity_ratio",
    "minimum_film",
    "maximum_pressure",
    "friction_power",
    "side_flow",
    "supply_flow",
    "supply_power",
    "total_fill",
    "contact_pressure",
    "contact_area",
    "contact_power",
    "contact_share",
    "shell_deformation",
    "residual",
    "iterations",
    "steps",
    "temperature",
)
_GROOVES = ("groove_flow", "groove_pressure")
_VECTORS = ("tilt", "moment", "contact_force")


def orbit_dataset(
    values: dict[str, Array], time: Array, force: Array, speed: Array, clearance: float
) -> xr.Dataset:
    """The orbit as a Dataset over time; `values` hold its variables and the position x, y."""
    import xarray as xr

    path = np.stack([values["x"], values["y"]], axis=-1)
    values = values | {"eccentricity_ratio": np.hypot(path[:, 0], path[:, 1])}
    data = {
        name: (dims, values[name], FILM[name].attributes)
        for dims, names in (
            ("time", _VARIABLES),
            (("time", "groove"), _GROOVES),
            (("time", "axis"), _VECTORS),
            (("time", "pad"), ("pad_tilt",)),
        )
        for name in names
        if name in values
    }
    return xr.Dataset(
        {
            "eccentricity": (
                ("time", "axis"),
                path * clearance,
                FILM["eccentricity"].attributes,
            ),
            "attitude_angle": (
                "time",
                attitude_angle(force, path, speed),
                FILM["attitude_angle"].attributes,
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
