"""A film and how it sits around a shaft, and the state of all films of an assembly."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.linearised import Linear
from loadflow.journal.film.surface.film import SurfaceFilm

Array = NDArray[np.float64]

BODY = 5
"""Degrees of freedom of the shaft."""


@dataclass(frozen=True)
class Member:
    """A film and how it sits.

    Attributes
    ----------
    film : SurfaceFilm
        The film; it keeps the work arrays, so that one film is in one member only.
    attached : array (m, 5)
        Position of the film (clearances) by that of the shaft (m, rad) in the axes of the pad.
    by_pad : array (m, k)
        Position of the film by the k motions of the pad (m, rad).
    support : array (k, k)
        Stiffness of the pad's support, N/m and N m/rad; 0 where the pad tilts freely.
    normal : array (m,)
        Position of the film by a shift of the shaft along the normal at the pivot.
    turns : tuple of array (5, 5)
        Axes of the shaft as seen by each pad that shares this film because it sees the same gap;
        one pad, not turned, by default.
    sense : float
        −1 where the shaft turns the other way in the axes of the film.
    """

    film: SurfaceFilm
    attached: Array
    by_pad: Array
    support: Array
    normal: Array
    turns: tuple[Array, ...] = (np.eye(BODY),)
    sense: float = 1.0

    def seen(self, turns: tuple[Array, ...], sense: float) -> Member:
        """The same, seen by a shaft in other axes."""
        return replace(self, turns=turns, sense=sense)

    @property
    def sees(self) -> Array:
        """Position of the film by that of the shaft in the axes of the bearing, (m, 5)."""
        return np.asarray(self.attached @ self.turns[0])

    def place(self, own: MemberState, position: Array) -> Array:
        """Position of the film, in its clearances, by that of the shaft."""
        return np.asarray(self.sees @ position - self.by_pad @ own.pad)

    @property
    def unit(self) -> float:
        """Unit of the gap, m: work of a load over that of its degree of freedom."""
        return self.film.relative_clearance * self.film.radius


@dataclass(frozen=True)
class MemberState:
    """Unknowns of a film, position of its pad, the last linearisation, storage of earlier times."""

    u: Array
    pad: Array
    linear: Linear | None = None
    old: Array | float = 0.0


@dataclass(frozen=True)
class AssemblyState:
    """Shaft and films: position (m, rad), velocity, states of the films, convergence.

    With a `rate`, 1/s, the films store ``rate · F h`` less `MemberState.old`: an implicit step. Of
    the shaft, `free` is in balance.
    """

    position: Array
    velocity: Array
    members: tuple[MemberState, ...]
    converged: bool = False
    iterations: int = 0
    residual: float = math.inf
    rate: float = 0.0
    free: NDArray[np.int64] = field(default_factory=lambda: np.arange(0))
