"""How far a state of the film is from balance, and what of that rounding alone may leave."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import LOAD
from loadflow.journal.film._kernels import largest_terms
from loadflow.journal.film.film import EVERY, DiscreteFilm
from loadflow.journal.film.gap.gap import turning_frame
from loadflow.numerics.convergence import EPS, rounding_level

Array = NDArray[np.float64]


def imbalance(
    film: DiscreteFilm,
    u: Array,
    position: Array,
    velocity: Array,
    force: Array | None = None,
    rate: float = 0.0,
    old: Array | float = 0.0,
    free: slice | NDArray[np.int64] = EVERY,
) -> float:
    """Largest imbalance of a cell, and of the load if `force` is given, over their scales.

    Only the degrees of freedom `free` need balance.
    """
    frame = film.place(u, position)
    gap, local = film.gap, frame.T @ velocity
    mass = film.storage(gap.coefs[:1], gap.around[None], local, rate)[0]
    outflow = film.balance(film.gap.coef, mass) - old
    worst = float(np.abs(film.residual(outflow)).max()) / flux_of(film)
    if film.pockets.free.size:
        worst = max(worst, film.pockets.missing(film.pressures[0], outflow, film.scale))
    if force is not None:
        scale = film.load_scale(force)
        missing = force - film.load_of(frame, position)
        worst = max(worst, math.hypot(*missing[free]) / scale)
    return worst


def rounding(
    film: DiscreteFilm,
    position: Array,
    velocity: Array,
    slope: Array | None = None,
    force: Array | None = None,
    free: slice | NDArray[np.int64] = EVERY,
) -> float:
    """Level of rounding of `imbalance`, just called, over the same scales.

    The gap is a difference of numbers near 1: where it is narrow its coefficients have fewer
    digits. `slope` (m, m), the derivative of the load by the position, goes with a `force`.
    """
    mesh, gap = film.mesh, film.gap
    local = turning_frame(position).T @ velocity if mesh.polar else velocity
    mass = film.storage(gap.coefs[:1], gap.around[None], local, 0.0)[0]
    terms = largest_terms(
        film.state, gap.coef, mesh.cells, mesh.closed, film.wedge, film.edges, mass, film.fixed
    )
    narrow = min(max(gap.narrowest(position), EPS), 1.0)
    worst = terms * (1.0 + 3.0 / narrow) / flux_of(film)
    if force is not None and slope is not None:
        scale = film.load_scale(force)
        pressed = float(np.abs(film.state[LOAD]).max()) * 2 * np.pi * mesh.dz.sum()
        reach = np.abs(gap.across).max(axis=1)
        carried = film.unit * pressed * reach
        digits = np.abs(slope).sum(axis=1) * max(1.0, float(np.abs(position).max()))
        worst = max(worst, float((carried + digits)[free].max()) / scale)
    return rounding_level(worst)


def flux_of(film: DiscreteFilm) -> float:
    """Scale of what flows through a cell."""
    return float((abs(film.wedge) + film.scale) * film.mesh.area.max())
