"""What the compiled loops of the rung "reduced" work on: constants of a film, and work arrays."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.models.ring import Ring
from loadflow.journal.models.width_modes import Axial

Array = NDArray[np.float64]

# columns of a row of results
RESULTS = 13
X, Y, PEAK, DISSIPATION, SHEAR, OUTFLOW, FED, FILLED, STEPS = range(9)
RESIDUAL, ITERATIONS, CONVERGED, ROUNDING = range(9, RESULTS)


class Reduced(NamedTuple):
    """Constants of an aligned film with smooth, rigid surfaces, in a cylinder or around lobes.

    Attributes
    ----------
    ring : Ring
        Cells around, and what fills them.
    lanes : tuple of int
        As long as there are points across: a length that the compiler knows.
    axial : Axial
        Points across the half width.
    free : bool
        Whether the shaft moves to where its load is carried.
    """

    ring: Ring
    lanes: tuple[int, ...]
    axial: Axial
    free: bool


class Work(NamedTuple):
    """Work arrays of one film of (nx, m) points, n = nx m.

    Attributes
    ----------
    u, before, last : array (nx, m)
        Unknowns: current, and at the last two times.
    liquid : array (3, nx, m)
        F H of the cells: storage of earlier times, then the last two times.
    state : array (8, nx, m)
        As in `_kernels.apply_law`.
    gap, gap_face : array (nx,)
        H at cell centres and faces.
    band : array (n + 2 m, 4 m + 1)
        Band matrix, row by row; the last 2 m rows are those behind it.
    columns : array (n, 3)
        Residual and its derivatives by the position; then what the matrix makes of them.
    """

    u: Array
    before: Array
    last: Array
    liquid: Array
    state: Array
    gap: Array
    gap_face: Array
    band: Array
    columns: Array


def make_work(around: int, points: int) -> Work:
    """Allocate the work arrays."""
    shape = (around, points)
    n = around * points
    return Work(
        u=np.zeros(shape),
        before=np.zeros(shape),
        last=np.zeros(shape),
        liquid=np.zeros((3, *shape)),
        state=np.zeros((8, *shape)),
        gap=np.zeros(around),
        gap_face=np.zeros(around),
        band=np.zeros((n + 2 * points, 4 * points + 1)),
        columns=np.zeros((n, 3)),
    )
