"""How far films, pads and shaft of an assembly are from balance, and what of it is rounding."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import LOAD
from loadflow.journal.film import imbalance as of_film
from loadflow.journal.film.surface.film import SurfaceFilm
from loadflow.journal.solvers.assembly.member import AssemblyState, Member
from loadflow.numerics.convergence import rounding_level

Array = NDArray[np.float64]

_LEAST = 1e-3  # share of the scale of pressure, over R², that is the least scale of a load


def imbalance(
    members: Sequence[Member],
    length: float,
    state: AssemblyState,
    force: Array,
    free: NDArray[np.int64],
) -> tuple[float, float]:
    """Largest imbalance of cells, pads and shaft, over their scales, and its rounding level.

    A film near standstill carries little beside the pressure at its edges, of which every cell
    holds the last digits: there rounding allows less than a tolerance may ask for.
    """
    worst, level, least = 0.0, 0.0, 0.0
    total, terms = np.zeros_like(force), np.zeros_like(force)
    arms = np.append(np.ones(3), np.full(2, 1.0 / length))
    for member, own in zip(members, state.members):
        film = member.film
        place = member.place(own, state.position)
        moving = member.sees @ state.velocity
        found = of_film.imbalance(film, own.u, place, moving, None, state.rate, own.old)
        level = max(level, of_film.rounding(film, place, moving))
        load = member.unit * film.field(own.u, place)[3]
        pressed = member.unit * _terms(film)
        smallest = _LEAST * film.scale * film.radius**2
        for turn in member.turns:
            total += turn.T @ member.attached.T @ load
            terms += np.abs(turn.T) @ np.abs(member.attached.T) @ pressed
        least += smallest
        if own.pad.size:
            size = np.abs(member.by_pad).max(axis=0)
            missing = (member.by_pad.T @ load - member.support @ own.pad) / size
            scale = max(float(np.abs(load).max()), member.unit * smallest)
            found = max(found, float(np.abs(missing).max()) / scale)
            level = max(level, rounding_level(float(pressed.max()) / scale))
        worst = max(worst, found)
    if free.size:
        scale = max(math.hypot(*(arms * force)), least)
        worst = max(worst, float(np.abs((arms * (force - total))[free]).max()) / scale)
        level = max(level, rounding_level(float((arms * terms)[free].max()) / scale))
    return worst, level


def _terms(film: SurfaceFilm) -> Array:
    """Sums (m,) of the magnitudes of what pressures add to the load, its edges' included, N."""
    gap = film.gap
    around, across = np.abs(gap.pressed).sum(axis=1), np.abs(gap.across) @ gap.mesh.carrying
    return np.asarray(film.radius**2 * np.abs(film.state[LOAD]).max() * around * across)
