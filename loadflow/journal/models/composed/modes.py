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
    rubbed : array (k, nx, L)
        Amplitude by a force at the points, that of asperities on both halves of the width, 1/N.
    """

    on: bool
    shapes: Array
    pressed: Array
    rubbed: Array


_NONE = aligned(np.zeros((0, 1, LANES)))
NO_MODES = Modes(False, _NONE, _NONE, _NONE)


class RubWork(NamedTuple):
    """Work arrays of asperities on a shell that gives way by k `Modes`.

    Attributes
    ----------
    on : array (1,)
        Whether what follows is of asperities that touch.
    touched : array of bool (nx,)
        Columns of cells beside which they do.
    force : array (nx, L)
        Forces of the asperities at the points, N.
    own, next : array (nx, l, l)
        Its derivative by the growth of the gap at points of the column and of the next one, N; also
        that of the next one by the growth at its own points.
    pushed : array (4, nx, L)
        Derivative of the load of the asperities by the growth of the gap at the points, N.
    by_place : array (4, k)
        Amplitudes by the position of the shaft.
    alone, share : array (k,)
        Amplitudes by the film alone, and what asperities add to them.
    matrix, order : array (k, k), (k,)
        Factors of what amplitudes miss by themselves.
    step, trial, way, other : array (k,)
        Of steps of Newton's method for the amplitudes.
    local, change : array (nx, L)
        Growth of the gap by the pressure of a place, clearances; forces by a growth, N.
    """

    on: Array
    touched: NDArray[np.bool_]
    force: Array
    own: Array
    next: Array
    pushed: Array
    by_place: Array
    alone: Array
    share: Array
    matrix: Array
    order: NDArray[np.int64]
    step: Array
    trial: Array
    way: Array
    other: Array
    local: Array
    change: Array


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
    rub : RubWork
        Of asperities on the shell.
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
    rub: RubWork


def make_modes_work(modes: Modes, shape: tuple[int, int], points: int) -> ModesWork:
    """Allocate the work arrays of modes on cells and lanes of a `shape`, with `points` in them."""
    count = len(modes.shapes)
    return ModesWork(
        amplitude=np.zeros(count), other=np.zeros(count), growth=aligned(np.zeros(shape)),
        change=aligned(np.zeros(shape)), column=aligned(np.zeros((1, *shape))),
        row=aligned(np.zeros((1, LANES)))[0], basis=np.zeros((count + 1, count)),
        system=np.zeros((count + 1, count)), turns=np.zeros((2, count)),
        right=np.zeros(count + 1), rub=_make_rub_work(len(modes.rubbed), shape, points),
    )  # fmt: skip


def _make_rub_work(count: int, shape: tuple[int, int], points: int) -> RubWork:
    """Work arrays of asperities; none to speak of where no mode knows any."""
    around, wide = shape if count else (1, LANES)
    square = (around, points, points) if count else (1, 1, 1)
    return RubWork(
        on=np.zeros(1), touched=np.zeros(around, dtype=bool),
        force=aligned(np.zeros((around, wide))), own=np.zeros(square), next=np.zeros(square),
        pushed=aligned(np.zeros((4, around, wide))), by_place=np.zeros((4, count)),
        alone=np.zeros(count), share=np.zeros(count), matrix=np.zeros((count, count)),
        order=np.zeros(count, dtype=np.int64), step=np.zeros(count), trial=np.zeros(count),
        way=np.zeros(count), other=np.zeros(count), local=aligned(np.zeros((around, wide))),
        change=aligned(np.zeros((around, wide))),
    )  # fmt: skip
