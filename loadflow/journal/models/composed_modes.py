"""Modes of a shell that gives way all over, as the loops of a reduced film have them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.lanes import LANES, aligned

Array = NDArray[np.float64]


class Modes(NamedTuple):
    """Modes in which a shell gives way all over, beside what it gives locally.

    Attributes
    ----------
    on : bool
        Whether it does.
    shapes : array (k, nx, L)
        Growth of the gap at the points by the amplitude of each, clearances.
    pressed : array (k, nx, L)
        Amplitude by the pressure at the inner points, 1/Pa.
    """

    on: bool
    shapes: Array
    pressed: Array


NO_MODES = Modes(False, aligned(np.zeros((0, 1, LANES))), aligned(np.zeros((0, 1, LANES))))


class ModesWork(NamedTuple):
    """Work arrays of `Modes`.

    Attributes
    ----------
    amplitude, other : array (k,)
        Amplitudes at the unknowns, and of a change of these.
    growth, change : array (nx, L)
        Growth of the gap at the unknowns, clearances; that by a change of them, or a pressure, Pa.
    column : array (1, nx, L)
        Change of the residual by a growth.
    row : array (L,)
        Numbers that are taken one by one.
    basis, system, turns, right : array (s + 1, k), (s + 1, s), (2, s), (s + 1,)
        Of steps of GMRES: s = k, after which nothing is left.
    """

    amplitude: Array
    other: Array
    growth: Array
    change: Array
    column: Array
    row: Array
    basis: Array
    system: Array
    turns: Array
    right: Array


def make_modes_work(modes: Modes, shape: tuple[int, int]) -> ModesWork:
    """Allocate the work arrays of modes on cells and lanes of a `shape`."""
    count = len(modes.shapes)
    return ModesWork(
        amplitude=np.zeros(count), other=np.zeros(count), growth=aligned(np.zeros(shape)),
        change=aligned(np.zeros(shape)), column=aligned(np.zeros((1, *shape))),
        row=aligned(np.zeros((1, LANES)))[0], basis=np.zeros((count + 1, count)),
        system=np.zeros((count + 1, count)), turns=np.zeros((2, count)),
        right=np.zeros(count + 1),
    )  # fmt: skip
