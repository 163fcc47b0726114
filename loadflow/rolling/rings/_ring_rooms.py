"""Arrays that the compiled loops of flexible rings use again and again.

To make one takes as long as some of the loops, and loops that make none count no references. They
are made once for a series. Words are those of `loadflow.rolling.rings._ring_kernels`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba import njit

from loadflow.numerics.linked import LINKED
from loadflow.rolling.contacts import Array

_TOGETHER = 32  # numbers that loops with vector units take at once


class WaveRoom(NamedTuple):
    """For shifts and forces through waves.

    Attributes
    ----------
    lumped : ndarray, shape (track, ball)
        Forces on the tracks.
    amount, line : ndarray
        Of each wave, (track, wave), and the same in one line.
    even, odd : ndarray, shape (half,)
        Of both halves of a ring.
    """

    lumped: Array
    amount: Array
    line: Array
    even: Array
    odd: Array


class TangentRoom(NamedTuple):
    """For the tangent.

    Attributes
    ----------
    resistance : ndarray, shape (half of (track, track), ball)
        What the contacts of each ball resist.
    along, weight : ndarray, shape (track, ball) and (ball,)
        Of one kind of contacts.
    moments : ndarray, shape (half of (track, track), wave)
        Sums of the resistance times waves that products of two have.
    even, odd : ndarray
        Of the harmonics -top … 2 top.
    folded : ndarray, shape (2, half)
        Of both halves of a ring.
    products : ndarray, shape (track · wave, track · wave)
        Sums of the resistance times two waves; rows filled up. Empty where balls are summed over.
    rows, felt : ndarray, shape (4, track · wave) and (track · wave, 4)
        What the waves feel of four unknowns, the first filled up.
    hessian : ndarray, shape (unknown, unknown)
        Of the potential, its lower half.
    """

    resistance: Array
    along: Array
    weight: Array
    moments: Array
    even: Array
    odd: Array
    folded: Array
    products: Array
    rows: Array
    felt: Array
    hessian: Array


class NewtonRoom(NamedTuple):
    """For the iteration.

    Attributes
    ----------
    small, right_rigid : ndarray, shape (5, 5) and (5,)
        Of the rigid part.
    one, pull, rest, right, step, trial : ndarray, shape (unknown,)
        Ones, forces, what is left of them, the same put right by pairs, step, next state.
    part : ndarray, shape (pair,)
        Shares of the pairs.
    shift, far, between : ndarray, shape (track, ball)
        Of the state, of the step, of the next state.
    push, full : ndarray, shape (field · kind, ball)
        Forces and shifts of the contacts.
    slope, across, slant : ndarray, shape (kind, ball)
        As `loadflow.rolling.rings._ring_kernels.forces` fills them.
    """

    small: Array
    right_rigid: Array
    one: Array
    pull: Array
    rest: Array
    right: Array
    step: Array
    trial: Array
    part: Array
    shift: Array
    far: Array
    between: Array
    push: Array
    full: Array
    slope: Array
    across: Array
    slant: Array


@njit(nogil=True, error_model="numpy", **LINKED)
def wave_room(waves: Any) -> WaveRoom:
    """A `WaveRoom` for the waves of a bearing."""
    tracks, half = waves.mixing.shape[1], waves.trig.shape[1]
    amount = np.zeros((tracks, waves.trig.shape[0]))
    return WaveRoom(
        np.zeros((tracks, waves.balls)), amount, amount.reshape(amount.size),
        np.zeros(half), np.zeros(half),
    )  # fmt: skip


@njit(nogil=True, error_model="numpy", **LINKED)
def tangent_room(waves: Any) -> TangentRoom:
    """A `TangentRoom` for the waves of a bearing."""
    tracks, count, size = waves.mixing.shape[1], waves.trig.shape[0], waves.first.shape[0] - 1
    pairs, harmonics = tracks * (tracks + 1) // 2, 3 * waves.top + 1
    few = 0 if waves.shapes.shape[0] else tracks * count
    wide = -(-few // _TOGETHER) * _TOGETHER
    return TangentRoom(
        np.zeros((pairs, waves.balls)), np.zeros((tracks, waves.balls)), np.zeros(waves.balls),
        np.zeros((pairs, waves.products.shape[0])), np.zeros(harmonics), np.zeros(harmonics),
        np.zeros((2, waves.products.shape[1])), np.zeros((few, wide)), np.zeros((4, wide)),
        np.zeros((few, 4)), np.zeros((size, size)),
    )  # fmt: skip


@njit(nogil=True, error_model="numpy", **LINKED)
def newton_room(waves: Any, kinds: int, size: int, pairs: int) -> NewtonRoom:
    """A `NewtonRoom` for `kinds` of contacts, unknowns and pairs of so many."""
    tracks, fields, balls = waves.mixing.shape[1], waves.mixing.shape[0], waves.balls
    return NewtonRoom(
        np.zeros((5, 5)), np.zeros(5), np.ones(size), np.zeros(size), np.zeros(size),
        np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(pairs),
        np.zeros((tracks, balls)), np.zeros((tracks, balls)), np.zeros((tracks, balls)),
        np.zeros((fields, balls)), np.zeros((fields, balls)),
        np.zeros((kinds, balls)), np.zeros((kinds, balls)), np.zeros((kinds, balls)),
    )  # fmt: skip
