"""A film without dimensions that is carried along: the velocity at which it carries a load."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.discretise import build_film
from loadflow.journal.film.integrals import summary
from loadflow.journal.film.linearised import Linear
from loadflow.journal.film_model import Film
from loadflow.journal.models import _mobility_kernels as kernel

Array = NDArray[np.float64]
Node = tuple[float, float]  # ε, s

_SLOW = 0.1  # ε below which the fill no longer turns with the eccentricity
_NEWTON = 40  # steps
_STEP = 1e-4  # of velocity and load in the last of them: the error is near its square

POWERS = np.array([kernel.RADIAL_POWER, kernel.TANGENTIAL_POWER])  # of the gap, of velocities

# rows of the results of a moving film: peak over ambient pressure, dissipation, flow over the ends,
# fill, stiffness and damping in the frame of the eccentricity
PEAK, DISSIPATION, OUTFLOW, FILL, STIFFNESS, DAMPING = 0, 1, 2, 3, slice(4, 8), slice(8, 12)
LOADS = np.array([1, 2, 1, 0, 1, 1, 1, 1, 0, 0, 0, 0])  # powers of s of these values
GAPS = np.array([-0.5, 1, 0, 0, -1, -1, -1, -1, -1.5, -1, -1, -0.5])  # and of 1 − ε
ODD = np.array([0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0], dtype=bool)  # under a mirror of the load


class Found(NamedTuple):
    """A film that carries its load: unknowns, velocity u, linearisation."""

    u: Array
    velocity: Array
    linear: Linear | None = None


class MovingFilm:
    """Film of unit radius, clearance and squeeze pressure, to be carried along at velocity u."""

    def __init__(self, width_ratio: float, options: Film) -> None:
        self.film = build_film(2.0, 2.0 * width_ratio, 1.0, options)
        self.film.raise_scale(1.0)
        self.fills = options.law.keeps_fill
        self.area = 4.0 * width_ratio
        self.solved = 0

    def carry(
        self, ratio: float, size: float, chi: float, u: Array, velocity: Array
    ) -> Found | None:
        """Unknowns and velocity at which the film carries the load; None where Newton fails.

        The slope by the tangential velocity, which also moves the fill, is that of pure squeeze at
        first, then a secant; a step after which more load is missing than before is halved.
        """
        film, position = self.film, np.array([ratio, 0.0])
        load = self.area * size * _towards(ratio, chi)
        turn = _turn(ratio)
        squeeze = np.array([1.0, 1.0 - ratio * turn])
        u, velocity = u.copy(), velocity.copy()
        last, step, missing = np.zeros(2), np.zeros(2), math.inf
        for _ in range(_NEWTON):
            self.solved += 1
            film.set_speed(-2.0 * turn * float(velocity[1]))
            linear = film.linearise(u, position, squeeze * velocity)
            before, missing = missing, math.hypot(*(load - linear.load))
            if missing > 2.0 * before:
                step = -0.5 * step
            else:
                (a, b), (c, d) = self._slope(linear, last, step, velocity).tolist()
                x, y = (load - linear.load).tolist()
                if not a * d > b * c:
                    return None
                last = linear.load
                step = np.array([d * x - b * y, a * y - c * x]) / (a * d - b * c)
                far, reach = math.hypot(*step), 2.0 * math.hypot(*velocity)
                if far > reach > 0.0:
                    step *= reach / far
            target = velocity + step
            weights = film.weights(position, squeeze * velocity, position, squeeze * target)
            change = film.correct(u, linear.columns, weights) * film.scale
            velocity = target
            if math.hypot(*step) < _STEP * math.hypot(*velocity) and change < _STEP * size:
                return Found(u, velocity, linear)
        return None

    def _slope(self, linear: Linear, last: Array, step: Array, velocity: Array) -> Array:
        """∂load/∂u: exact by the radial velocity, a secant by the tangential one."""
        slope = linear.damping
        if self.fills and abs(step[1]) > 1e-6 * math.hypot(*velocity):
            secant = slope.copy()
            secant[:, 1] = (linear.load - last - slope[:, 0] * step[0]) / step[1]
            credible = secant[1, 1] > 0.2 * slope[1, 1]
            if credible and np.linalg.det(secant) > 0.2 * np.linalg.det(slope):
                return secant
        return slope

    def values(self, ratio: float, size: float, found: Found) -> tuple[Array, Array] | None:
        """What a map holds at a solution, for its splines; None if a pressure is below vacuum.

        Stiffness is that of a shaft at rest in the oil that flows past it at −u.
        """
        film, (u, velocity, linear) = self.film, found
        assert linear is not None
        film.set_speed(0.0)  # without the drag of the shaft, which needs no map
        state = summary(film, u, np.array([ratio, 0.0]))
        rest = -float(velocity[1]) * (1.0 / ratio - _turn(ratio)) if ratio > 0.0 else 0.0
        damping = linear.damping
        stiffness = linear.stiffness + rest * np.stack([-damping[:, 1], damping[:, 0]], axis=1)
        raw = [
            state["maximum_pressure"] - film.p_edge,
            state["friction_power"],
            state["side_flow"],
            state["total_fill"],
            *stiffness.ravel(),
            *damping.ravel(),
        ]
        gap = 1.0 - ratio
        results = np.array(raw) / (size**LOADS * gap**GAPS)
        if not np.all(results[: FILL + 1] > 0.0):
            return None
        results[:FILL] = np.log(results[:FILL])
        results[FILL + 1 :] = np.arcsinh(results[FILL + 1 :])
        return np.arcsinh(velocity / (size * gap**POWERS)), results


def _turn(ratio: float) -> float:
    """How fast the film turns with the eccentricity, over the tangential velocity."""
    return ratio / (ratio**2 + _SLOW**2)


def _towards(ratio: float, chi: float) -> Array:
    """Direction of the load of `chi`, in the frame of the eccentricity."""
    k = ((1.0 - ratio) / (1.0 + ratio)) ** kernel.STRETCH
    c, s = math.cos(0.5 * chi), k * math.sin(0.5 * chi)
    return np.array([c * c - s * s, 2.0 * c * s]) / (c * c + s * s)


def approach(
    film: MovingFilm, start: Node, end: Node, chi: float, found: Found, halvings: int = 3
) -> Found | None:
    """Go from a solution at ε, s `start` to one at `end`; the way is halved where Newton fails."""
    reached = film.carry(*end, chi, found.u, found.velocity * (end[1] / start[1]))
    if reached is not None or halvings == 0:
        return reached
    gap = math.sqrt((1.0 - start[0]) * (1.0 - end[0]))
    middle = (1.0 - gap, math.sqrt(start[1] * end[1]))
    reached = approach(film, start, middle, chi, found, halvings - 1)
    if reached is None:
        return None
    return approach(film, middle, end, chi, reached, halvings - 1)
