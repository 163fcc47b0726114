"""Compiled tangent of the equilibrium with flexible rings.

Words and arrays are those of `loadflow.rolling.rings._ring_kernels`; the matrix is that of
`loadflow.rolling.rings._ring_factor`, modes before rigid unknowns. Contacts that ride on one ball
resist the shift of its tracks together; how much varies around the ring. Where unknowns are few
waves each, sums over the balls of what they resist times two waves are those of the sum and the
difference of both harmonics, and serve all pairs of unknowns.
"""

from __future__ import annotations

import numpy as np

from loadflow.numerics.lanes import LANES, put, spread, take
from loadflow.numerics.linked import LINKED, bare, contracted, njit
from loadflow.rolling.contacts import POINT
from loadflow.rolling.rings._ring_factor import factorise
from loadflow.rolling.rings._ring_kernels import add_multiple, gather
from loadflow.rolling.rings._ring_rooms import square_room, tangent_room

# Sums may be reordered (so that they use vector units); nothing else of fast mathematics.
_REORDER = {"reassoc", "contract", "nsz"}


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def _add_squares(along, weight, resistance):
    """Add weight · along alongᵀ of each ball, `along` (track, ball), to its lower half."""
    c = 0
    for f in range(along.shape[0]):
        for g in range(f + 1):
            line, first, second = resistance[c], along[f], along[g]
            for j in range(weight.shape[0]):
                line[j] += weight[j] * first[j] * second[j]
            c += 1


@bare(**LINKED)
def _resistances(waves, power, push, slope, across, slant, room):
    """Fill what the contacts of each ball resist, lower half of (track, track), (half, ball)."""
    mixing, balls = waves.mixing, push.shape[1]
    tracks = mixing.shape[1]
    found, along, weight = room.resistance, room.along, room.weight
    found[:, :] = 0.0
    fields = mixing.shape[0] // slope.shape[0]
    for k in range(slope.shape[0]):
        along[:, :] = 0.0
        if power == POINT:  # along the force, and alike in all directions
            weight[:] = 0.0
            for j in range(balls):
                pr, pt, pz = push[3 * k, j], push[3 * k + 1, j], push[3 * k + 2, j]
                square = pr * pr + pt * pt + pz * pz
                if square > 0.0:
                    weight[j] = (slope[k, j] - across[k, j]) / square
            for f in range(tracks):
                for s in range(3 * k, 3 * k + 3):
                    if mixing[s, f] != 0.0:
                        add_multiple(mixing[s, f], push[s], along[f])
            _add_squares(along, weight, found)
        else:  # approach at the lever of a roller's stiffness
            for f in range(tracks):
                along[f, :] = mixing[2 * k, f]
                add_multiple(mixing[2 * k + 1, f], slant[k], along[f])
            _add_squares(along, slope[k], found)
        c = 0
        for f in range(tracks):
            for g in range(f + 1):
                alike = 0.0
                for s in range(fields * k + (power != POINT), fields * (k + 1)):
                    alike += mixing[s, f] * mixing[s, g]
                if alike != 0.0:
                    add_multiple(alike, across[k], found[c])
                c += 1


@bare(**LINKED)
def _harmonics(resistance, waves, room):
    """Fill half the sums over all balls of what they resist times each harmonic -top … 2 top."""
    balls, tracks, top = waves.balls, waves.mixing.shape[1], waves.top
    moments, even, odd = room.moments, room.harmonics[0], room.harmonics[1]
    gather(resistance, waves.products, waves.product_cosines, room.sums, room.differences, moments)
    for n in range(-top, 2 * top + 1):
        fold, sign = abs(n), 0.5 if n > 0 else -0.5
        if fold > balls - fold:  # a harmonic is seen at the balls as its mirror
            fold, sign = balls - fold, -sign
        at, c = (top + n) * tracks, 0
        for f in range(tracks):
            for g in range(f + 1):
                one, two = 0.5 * moments[c, fold], 0.0
                if fold > 0:
                    two = sign * moments[c, waves.product_cosines + fold - 1]
                even[f, at + g], even[g, at + f] = one, one
                odd[f, at + g], odd[g, at + f] = two, two
                c += 1


@contracted(**LINKED)
def _feel(unknown, most, waves, room, line):
    """Fill the `line` with what all tracks feel of an unknown: cosines (wave · track), then sines.

    Up to the harmonic `most`. A product of two waves is half the sum or difference of those of both
    harmonics.
    """
    value, starts, signed, harmonics = waves.value, room.starts, room.signed, room.harmonics
    tracks, first, last = waves.mixing.shape[1], waves.first[unknown], waves.first[unknown + 1]
    sines = line.shape[0] // 2
    for n in range(0, (most + 1) * tracks, LANES):
        one, two = spread(0.0), spread(0.0)
        for e in range(first, last):
            begin, other, apart = starts[e, 0] + n, starts[e, 1] + n, starts[e, 2]
            one = one + signed[e] * take(harmonics, begin)
            two = two + value[e] * take(harmonics, other)
            one = one + value[e] * take(harmonics, begin + apart)
            two = two + signed[e] * take(harmonics, other + apart)
        put(line, n, one)
        put(line, sines + n, two)


@bare(forceinline=True, **LINKED)
def _interleave(rows, begin, count, felt):
    """Fill a part of `felt` (place, 8) by eight rows."""
    for p in range(begin, begin + count):
        for row in range(LANES):
            felt[p, row] = rows[row, p]


@contracted(**LINKED)
def _by_waves(waves, room, matrix):
    """Fill the upper half of the tangent of the contacts from products of waves, eight at once.

    What the waves of all tracks feel of the eight unknowns lies side by side, so that one look at
    a wave serves all of them.
    """
    first, value, spot = waves.first, waves.value, waves.spot
    order, rows, felt = waves.order, room.rows, room.felt
    size, wide, tracks = order.shape[0], matrix.shape[1], waves.mixing.shape[1]
    sines = felt.shape[0] // 2
    for a in range(0, size, LANES):
        last = min(a + LANES, size)
        most = waves.upto[last - 1]
        for row in range(last - a):
            _feel(order[a + row], most, waves, room, rows[row])
        for row in range(last - a, LANES):
            rows[row, :] = 0.0
        _interleave(rows, 0, (most + 1) * tracks, felt)
        _interleave(rows, sines, most * tracks, felt)
        for b in range(last):
            owner = order[b]
            resists = spread(0.0)
            for e in range(first[owner], first[owner + 1]):
                resists = resists + value[e] * take(felt, LANES * spot[e])
            put(matrix, b * wide + a, resists)


@contracted(**LINKED)
def _by_balls(resistance, waves, room, matrix):
    """Fill the upper half of the tangent of the contacts from all balls, eight at a time.

    By loops, as a library of linear algebra starts threads of its own and waits for them.
    """
    shapes, forced, tracks = waves.shapes, room.forced, waves.mixing.shape[1]
    size, wide = waves.order.shape[0], matrix.shape[1]
    for j in range(waves.balls):
        for f in range(tracks):
            line = forced[j * tracks + f]
            line[:] = 0.0
            for g in range(tracks):
                high, low = max(f, g), min(f, g)
                add_multiple(
                    resistance[high * (high + 1) // 2 + low, j], shapes[j * tracks + g], line
                )
    matrix[:, :] = 0.0
    for k in range(0, shapes.shape[0], LANES):
        for a in range(size):
            c0, c1, c2, c3 = shapes[k, a], shapes[k + 1, a], shapes[k + 2, a], shapes[k + 3, a]
            c4, c5, c6, c7 = shapes[k + 4, a], shapes[k + 5, a], shapes[k + 6, a], shapes[k + 7, a]
            for at in range(a // LANES * LANES, wide, LANES):
                here = k * wide + at
                one = c0 * take(forced, here) + c1 * take(forced, here + wide)
                two = c2 * take(forced, here + 2 * wide) + c3 * take(forced, here + 3 * wide)
                three = c4 * take(forced, here + 4 * wide) + c5 * take(forced, here + 5 * wide)
                four = c6 * take(forced, here + 6 * wide) + c7 * take(forced, here + 7 * wide)
                place = a * wide + at
                put(matrix, place, take(matrix, place) + ((one + two) + (three + four)))


@bare(**LINKED)
def _upper(waves, power, push, slope, across, slant, room, matrix):
    """Fill the upper half of the Hessian of the potential, modes before rigid unknowns."""
    _resistances(waves, power, push, slope, across, slant, room)
    if waves.shapes.shape[0] == 0:
        _harmonics(room.resistance, waves, room)
        _by_waves(waves, room, matrix)
    else:
        _by_balls(room.resistance, waves, room, matrix)
    for a in range(waves.order.shape[0] - 5):
        matrix[a, a] += 1.0


@njit(cache=True, nogil=True, error_model="numpy")
def tangent(waves, power, push, slope, across, slant):
    """Exact Hessian of the potential, (unknown, unknown)."""
    order, size = waves.order, waves.order.shape[0]
    matrix = square_room(size)
    _upper(waves, power, push, slope, across, slant, tangent_room(waves), matrix)
    hessian = np.zeros((size, size))
    for a in range(size):
        for b in range(a, size):
            hessian[order[a], order[b]] = hessian[order[b], order[a]] = matrix[a, b]
    return hessian


@bare(**LINKED)
def condense(waves, power, push, slope, across, slant, room, factor, condensed):
    """Tangent with the modes eliminated.

    Fills the `factor` of `loadflow.rolling.rings._ring_factor.factorise`, and the 5 × 5 tangent
    that is left.
    """
    _upper(waves, power, push, slope, across, slant, room, factor)
    modes = waves.order.shape[0] - 5
    factorise(factor, modes)
    for a in range(5):
        for b in range(a, 5):
            condensed[a, b] = condensed[b, a] = factor[modes + a, modes + b]
