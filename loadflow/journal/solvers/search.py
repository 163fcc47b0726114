"""Films of the same loads, asked again and again: one effort, and each begins at the one before.

A bearing that warms is asked for its film at one temperature after another. Each time afresh, one
of a load that none carries would be sought in vain at all of them, and one that is found by small
steps alone by as many every time.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.newton import Solution
from loadflow.journal.solvers.statics import Statics

IN_VAIN = 4
"""Loads of one effort sought in vain, of which none has been found, after which others are hardly:
the mildest is the first."""

_CELLS = ("grid", "grading", "inlet")  # what of a film says which cells it has


@dataclass
class Search:
    """The films of one load that is asked again and again, as at other temperatures.

    All of them have one effort; each begins at the one before.

    Attributes
    ----------
    efforts : list of Effort
        The one, once a film has been asked for. Loads of one question share a list.
    together : bool
        Whether other loads share the effort: only what is sought in vain is then of it, so that
        many loads that are found leave as much as few.
    asked : tuple of float
        What was left as the last film was asked for, to its search and to a shaft that sinks.
    last : Statics and Solution, optional
        Film found last, on its cells.
    why : tuple of float and str, optional
        Speed, rad/s, of the last film that was not found, and why.
    """

    efforts: list[Effort] = field(default_factory=list)
    together: bool = False
    asked: tuple[float, float] = (0.0, 0.0)
    last: tuple[Statics, Solution] | None = None
    why: tuple[float, str] | None = None

    @property
    def over(self) -> bool:
        """Whether nothing is left of it: a search would be none, and its end would say nothing."""
        return any(effort.over for effort in self.efforts)

    @property
    def hopeless(self) -> bool:
        """Whether of loads that share the effort some have been sought in vain, and none found."""
        left = self.efforts[0]
        return self.together and left.vain >= IN_VAIN and not left.found

    def note(self, converged: bool) -> None:
        """Count a film that has been found, or sought in vain."""
        self.efforts[0].found += converged
        self.efforts[0].vain += not converged

    def effort(self, film: DiscreteFilm, max_iterations: int) -> Effort:
        """What is left to all films of the load, as one more is asked for."""
        if not self.efforts:
            self.efforts.append(Effort.of(film, max_iterations))
        left = self.efforts[0]
        left.before, self.asked = left.spent, (left.left, left.sinking)
        return left

    def give_back(self) -> None:
        """Leave to other loads that share the effort what the last film took, as it was found."""
        if self.together:
            self.efforts[0].left, self.efforts[0].sinking = self.asked


def searches(count: int, together: bool = False) -> NDArray[np.object_]:
    """Searches (count,) of some loads, with one effort for all of them `together` or for each."""
    every, shared = np.empty(count, dtype=object), list[Effort]()
    for index in range(count):
        every[index] = Search(shared, together=True) if together else Search()
    return every


def goes_on(last: Statics, found: Solution, film: Statics) -> tuple[Statics, Solution]:
    """A `film` on the cells on which the `last` one of its load was `found`, and that on its scale.

    What unknowns mean depends on the scale of pressure, and those of grooves are kept.
    """
    own = _on_cells_of(last, film)
    pressure = last.film.field(found.u, found.position)[0]
    other = own.film.unknown_of(pressure) - last.film.unknown_of(pressure)
    return own, replace(found, u=found.u + other)


def _on_cells_of(last: Statics, film: Statics) -> Statics:
    """A `film` on the cells of the `last` one."""
    was, is_ = ((one.crowd, *(getattr(one.options, n) for n in _CELLS)) for one in (last, film))
    if was == is_:
        return film
    options = replace(film.options, **dict(zip(_CELLS, was[1:])))
    other = Statics(film.bearing, options, film.line, film.rate, last.crowd)
    other.film.raise_scale(film.film.scale)
    return other
