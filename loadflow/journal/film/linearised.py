"""A film linearised at one state, and the state that has no such answer."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError

Array = NDArray[np.float64]


class SingularFilm(SolverError):
    """A Newton matrix that cannot be solved, as states far from any film have."""


class Linear(NamedTuple):
    """The film linearised at one state.

    Attributes
    ----------
    load : array (m,)
        ∫ p N_j dA for each degree of freedom, after the Newton step of the pressure alone, N.
    stiffness, damping : array (m, m)
        Derivatives of `load` by position (per clearance) and velocity (clearances per second).
    columns : array (l, n)
        Newton step of the unknowns, and their derivatives by what `DiscreteFilm.weights` lists.
    lacks : float
        Largest imbalance of a cell before the step, Pa.
    """

    load: Array
    stiffness: Array
    damping: Array
    columns: Array
    lacks: float = 0.0
