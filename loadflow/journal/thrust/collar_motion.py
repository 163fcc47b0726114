"""A thrust collar that follows its load along the axis by implicit steps of second order."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.thrust._collar_kernels import follow
from loadflow.journal.thrust.collar_sides import Side
from loadflow.journal.thrust.row_table import DAMPING, FORCE

Array = NDArray[np.float64]

FOLLOWED = 1e-8
"""Largest share of the force that may be missing in a step."""


def followed(
    sides: tuple[Side, Side], loads: Array, play: float, ends: tuple[Array, Array], weights: Array
) -> tuple[Array, Array, NDArray[np.int64]]:
    """Places (n,) of a collar under loads, shares of the force missing, and Newton steps.

    Its mass is neglected.

    Parameters
    ----------
    sides : pair of Side
        Front and back row through the series, each at one temperature.
    loads : array (n,)
        Along the axis, N.
    play : float
        Of both films together, m.
    ends : pair of array (n,)
        Smallest and largest ln(front film/back film), as which places are told: there the surfaces
        touch.
    weights : array (3, n)
        Velocity by the gap now, one step and two steps before, 1/s; 0 of collars at rest.
    """
    front, back = sides
    turning = np.maximum(front.speed, 0.0)  # a wedge that runs backward carries nothing
    given = np.column_stack([loads, turning, front.slope, *ends, *front.wave, *back.wave])
    place, residual = np.empty(loads.size), np.empty(loads.size)
    steps = np.empty(loads.size, np.int64)
    one, other = (side.table.parts[[FORCE, DAMPING]] for side in sides)
    frames = np.array([side.table.frame for side in sides])
    viscosity = np.array([float(side.held_viscosity) for side in sides])
    powers = np.empty((2, one.shape[3]))
    follow(
        one, other, frames, play, viscosity, given, weights, FOLLOWED, powers, place, residual,
        steps,
    )  # fmt: skip
    return place, residual, steps


def backward(times: Array) -> Array:
    """Weights (3, n) of differences of second order backward in time; the first is at rest."""
    weights, steps = np.zeros((3, times.size)), np.diff(times)
    if steps.size:
        weights[:2, 1] = 1.0 / steps[0], -1.0 / steps[0]
    if steps.size > 1:
        ratio, step = steps[1:] / steps[:-1], steps[1:]
        weights[0, 2:] = (1.0 + 2.0 * ratio) / (1.0 + ratio) / step
        weights[1, 2:] = -(1.0 + ratio) / step
        weights[2, 2:] = ratio**2 / (1.0 + ratio) / step
    return weights


def rates(gap: Array, weights: Array) -> Array:
    """Velocities (n,) of gaps, m/s."""
    padded = np.concatenate([[0.0, 0.0], gap])
    return np.asarray(weights[0] * gap + weights[1] * padded[1:-1] + weights[2] * padded[:-2])
