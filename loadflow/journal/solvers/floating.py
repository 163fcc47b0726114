"""Where Newton starts for a shaft that its supply carries: afloat, well off the bore."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.elastic import GrowingGap
from loadflow.journal.film.gap.gap import BoreGap
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.newton import Solution, solve_film

Array = NDArray[np.float64]

_FAR = 0.5  # share of the way to the bore at which the shaft is sought


def floating_film(
    film: DiscreteFilm, gap: BoreGap, force: Array, estimate: Array, effort: Effort
) -> Solution | None:
    """The film around a shaft well off the bore; None where an end of it touches there.

    Its steps are of the `effort`.
    """
    load = force[:2]
    way, position = load / (float(np.hypot(*load)) or 1.0), estimate.copy()
    if isinstance(gap, GrowingGap) and not np.isfinite(gap.pressed).all():
        gap.grow(np.zeros(gap.mesh.shape))  # a film that ran away before bends no shell
    far = _FAR * min(gap.reach(way, 0.0), 1.0)
    if film.speed == 0.0 or float(np.hypot(*position[:2])) > far:
        position[:2] = far * way
        position = gap.lifted(position, film.speed)
    if not gap.narrowest(position) > 0.0:
        return None
    found = solve_film(film, film.start(), position, np.zeros(gap.size), 1e-6, 30)
    effort.take(film, found.iterations)
    return found


def carries_there(floating: Solution, film: DiscreteFilm, force: Array) -> bool:
    """Whether a film off the bore carries the load, which then lies no farther out."""
    load = force[:2]
    return film.speed == 0.0 or bool(floating.linear.load[:2] @ load >= load @ load)
