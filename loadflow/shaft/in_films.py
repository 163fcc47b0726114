"""A shaft that lies in the films of two bearings: its tilt by where it is in them.

Two positions say how a rigid shaft lies. It bends under its loads and under the moments of the
films, and housings and frame turn under these. All of that is linear.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.convergence import Convergence
from loadflow.shaft.elastic import EquationsOf, ShaftMotion

Floats = NDArray[np.float64]

_FORCES, _MOMENTS = np.array([0, 1, 4, 5]), np.array([2, 3, 6, 7])


@dataclass(frozen=True)
class ShaftInFilms:
    """The shaft in two bearings whose films let it move.

    Vectors are (y, z) of the cube, of both bearings: (4, n), the first bearing first.

    Attributes
    ----------
    line : EquationsOf
        Its equations, with four components for each support.
    along : ndarray, shape (n,)
        Force along the shaft, N.
    """

    line: EquationsOf
    along: Floats

    @property
    def felt(self) -> NDArray[np.bool_]:
        """Whether the shaft feels the moment of each bearing, (2,)."""
        return np.array([support.takes_moment for support in self.line.supports])

    def force(self, moment: Floats) -> Floats:
        """Forces of the shaft on both bearings by its moments (4, n) on them."""
        return self._reactions(moment)[_FORCES]

    def tilt(self, position: Floats, moment: Floats) -> Floats:
        """Tilt in both bores (4, n), rad, by positions (4, n), m, in films that are felt so."""
        rows, reaction, base = self.line.equations, *self._lying(position, moment)
        slope = rows.arms @ base + rows.free - rows.bent @ reaction
        slope -= rows.housing @ reaction + rows.pushed
        return _rotated(slope[_MOMENTS])

    def motion(
        self, position: Floats, moment: Floats, converged: NDArray[np.bool_], told: Convergence
    ) -> ShaftMotion:
        """Loads and motion of the shaft by positions (4, n), m, and moments (4, n), N m.

        `converged` (n,) says in which samples these are known, and `told` how they were found.
        """
        return self.line.motion(*self._lying(position, moment), told, converged)

    def _reactions(self, moment: Floats) -> Floats:
        """All reactions, (8, n), in the components of the supports."""
        rows = self.line.equations
        reaction = np.zeros_like(rows.free)
        felt = np.repeat(self.felt, 2)[:, None]
        reaction[_MOMENTS] = np.where(felt, _of_supports(moment), 0.0)
        due = rows.due - rows.arms[_MOMENTS].T @ reaction[_MOMENTS]
        reaction[_FORCES] = np.linalg.solve(rows.arms[_FORCES].T, due)
        return reaction

    def _lying(self, position: Floats, moment: Floats) -> tuple[Floats, Floats]:
        """Reactions (8, n), and motion of the shaft's end (4, n)."""
        rows, reaction = self.line.equations, self._reactions(moment)
        moved = rows.housing @ reaction + rows.pushed - rows.free + rows.bent @ reaction
        base = np.linalg.solve(rows.arms[_FORCES], position + moved[_FORCES])
        return reaction, base


def _of_supports(vectors: Floats) -> Floats:
    """(y, z) of rotations or moments as (z, −y), the components of supports, in pairs."""
    return np.stack([vectors[1], -vectors[0], vectors[3], -vectors[2]])


def _rotated(components: Floats) -> Floats:
    """The other way."""
    return np.stack([-components[1], components[0], -components[3], components[2]])
