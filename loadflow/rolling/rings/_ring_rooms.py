"""Arrays that the compiled loops of flexible rings use again and again.

To make one takes as long as some of the loops, and loops that make none count no references. They
are made once for a series. Words are those of `loadflow.rolling.rings._ring_kernels`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.lanes import LANES, lanes_for
from loadflow.numerics.linked import LINKED, njit
from loadflow.rolling.contacts import Array


class WaveRoom(NamedTuple):
    """For shifts and forces through waves.

    Attributes
    ----------
    lumped : ndarray, shape (track, ball)
        Forces on the tracks.
    amount, line : ndarray
        Of each wave, (track, wave), and the same in one line.
    even, odd : ndarray, shape (track, half)
        Of both halves of a ring; filled up.
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
    harmonics : ndarray, shape (2, track, harmonic · track)
        Half of these of the cosines and of the sines of the harmonics -top … 2 top; filled up.
    starts, signed : ndarray, shape (part, 3) and (part,)
        Where in `harmonics` the sums lie that cosines and sines feel of a part of an unknown, how
        far the sums of both harmonics lie behind their differences, and its amplitude, of sines
        with the other sign.
    sums, differences : ndarray, shape (half of (track, track), half)
        Of both halves of a ring; filled up.
    rows, felt : ndarray, shape (8, wave · track) and (wave · track, 8)
        What the waves feel of eight unknowns; cosines and sines are filled up.
    forced : ndarray, shape (track · ball, unknown)
        What each ball resists of each unknown; empty where waves are few.
    """

    resistance: Array
    along: Array
    weight: Array
    moments: Array
    harmonics: Array
    starts: NDArray[np.int64]
    signed: Array
    sums: Array
    differences: Array
    rows: Array
    felt: Array
    forced: Array


class NewtonRoom(NamedTuple):
    """For the iteration.

    Attributes
    ----------
    small, right_rigid : ndarray, shape (5, 5) and (5,)
        Of the rigid part.
    one, pull, rest, right, step, trial : ndarray, shape (unknown,)
        Ones, forces, what is left of them, the same put right by pairs, step, next state.
    column : ndarray, shape (wide,)
        Right-hand side and solution, modes first; filled up.
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
    column: Array
    part: Array
    shift: Array
    far: Array
    between: Array
    push: Array
    full: Array
    slope: Array
    across: Array
    slant: Array


_LINE, _TABLE = np.zeros(1), np.zeros((1, 1))

SMALL_ROOMS = (
    WaveRoom(_TABLE, _TABLE, _LINE, _TABLE, _TABLE),
    TangentRoom(
        _TABLE, _TABLE, _LINE, _TABLE, np.zeros((1, 1, 1)), np.zeros((1, 1), np.int64), _LINE,
        *[_TABLE] * 5,
    ),
    NewtonRoom(_TABLE, *[_LINE] * 9, *[_TABLE] * 8),
)  # fmt: skip
"""Rooms of no bearing, for the types of what compiled functions hand on."""

_filled = njit(nogil=True, **LINKED)(lanes_for)


@njit(nogil=True, error_model="numpy", **LINKED)
def wave_room(waves: Any) -> WaveRoom:
    """A `WaveRoom` for the waves of a bearing."""
    tracks, half = waves.mixing.shape[1], waves.trig.shape[1]
    amount = np.zeros((tracks, waves.trig.shape[0]))
    return WaveRoom(
        np.zeros((tracks, waves.balls)), amount, amount.reshape(amount.size),
        np.zeros((tracks, half)), np.zeros((tracks, half)),
    )  # fmt: skip


@njit(nogil=True, error_model="numpy", **LINKED)
def tangent_room(waves: Any) -> TangentRoom:
    """A `TangentRoom` for the waves of a bearing."""
    tracks, top = waves.mixing.shape[1], waves.top
    pairs = tracks * (tracks + 1) // 2
    few = waves.shapes.shape[0] == 0
    long = _filled((3 * top + 2) * tracks) + LANES if few else 0  # lanes reach beyond the last one
    wide = _filled((top + 1) * tracks) if few else 0
    starts, signed = np.zeros((waves.value.size, 3), np.int64), waves.value.copy()
    for e in range(waves.value.size):
        wave, track = waves.wave[e], waves.track[e]
        sine = wave >= waves.cosines
        m = wave - waves.cosines + 1 if sine else wave
        one, two = (tracks + track, track) if sine else (track, tracks + track)
        starts[e, 0] = one * long + (top - m) * tracks
        starts[e, 1] = two * long + (top - m + 1) * tracks
        starts[e, 2] = 2 * m * tracks
        if sine:
            signed[e] = -signed[e]
    return TangentRoom(
        np.zeros((pairs, waves.balls)), np.zeros((tracks, waves.balls)), np.zeros(waves.balls),
        np.zeros((pairs, waves.products.shape[1])), np.zeros((2, tracks, long)), starts, signed,
        np.zeros((pairs, waves.products.shape[0])), np.zeros((pairs, waves.products.shape[0])),
        np.zeros((LANES, 2 * wide)), np.zeros((2 * wide, LANES)), np.zeros(waves.shapes.shape),
    )  # fmt: skip


@njit(nogil=True, error_model="numpy", **LINKED)
def square_room(size: int) -> Array:
    """Room for the tangent of so many unknowns or its factor, filled up both ways."""
    wide = _filled(size)
    return np.zeros((wide, wide))


@njit(nogil=True, error_model="numpy", **LINKED)
def newton_room(waves: Any, kinds: int, size: int, pairs: int) -> NewtonRoom:
    """A `NewtonRoom` for `kinds` of contacts, unknowns and pairs of so many."""
    tracks, fields, balls = waves.mixing.shape[1], waves.mixing.shape[0], waves.balls
    return NewtonRoom(
        np.zeros((5, 5)), np.zeros(5), np.ones(size), np.zeros(size), np.zeros(size),
        np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(_filled(size)), np.zeros(pairs),
        np.zeros((tracks, balls)), np.zeros((tracks, balls)), np.zeros((tracks, balls)),
        np.zeros((fields, balls)), np.zeros((fields, balls)),
        np.zeros((kinds, balls)), np.zeros((kinds, balls)), np.zeros((kinds, balls)),
    )  # fmt: skip
