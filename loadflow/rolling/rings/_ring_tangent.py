"""Compiled tangent of the equilibrium with flexible rings, and its Cholesky factor.

Words and arrays are those of `loadflow.rolling.rings._ring_kernels`. Contacts that ride on one ball
resist the shift of its tracks together; how much varies around the ring. Where unknowns are few
waves each, sums over the balls of what they resist times two waves are those of the sum and the
difference of both harmonics, and serve all pairs of unknowns.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from loadflow.numerics.linked import LINKED, bare
from loadflow.rolling.contacts import POINT
from loadflow.rolling.rings._ring_kernels import add_multiple, dot, gather
from loadflow.rolling.rings._ring_rooms import tangent_room

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


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def _combine(first, at, second, by, sign, target, to, count):
    """Fill a part of the line `target` with one of `first` and `sign` times one of `second`.

    Places are unsigned: kernels look twice at an index that may be negative.
    """
    for n in range(count):
        target[to + n] = first[at + n] + sign * second[by + n]


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def _copy(line, at, to, count):
    """Copy a part of a line to another place."""
    for n in range(count):
        line[to + n] = line[at + n]


@bare(**LINKED)
def _products(resistance, waves, room):
    """Fill the sums over all balls of what they resist times two waves, (track · wave) twice."""
    top, cosines, balls = waves.top, waves.cosines, waves.balls
    count, tracks = waves.trig.shape[0], waves.mixing.shape[1]
    moments, even, odd = room.moments, room.even, room.odd
    gather(
        resistance, waves.products, waves.product_cosines, room.folded[0], room.folded[1], moments
    )
    flat, wide = room.products.reshape(room.products.size), room.products.shape[1]
    some, more = np.uint64(top + 1), np.uint64(top)
    c = 0
    for f in range(tracks):
        for g in range(f + 1):
            for n in range(-top, 2 * top + 1):
                fold, sign = abs(n), 1.0 if n > 0 else -1.0
                if fold > balls - fold:  # a harmonic is seen at the balls as its mirror
                    fold, sign = balls - fold, -sign
                even[top + n] = 0.5 * moments[c, fold]
                odd[top + n] = 0.0
                if fold > 0:
                    odd[top + n] = 0.5 * sign * moments[c, waves.product_cosines + fold - 1]
            c += 1
            for m in range(top + 1):
                less, beyond = np.uint64(top - m), np.uint64(top + m)
                one = np.uint64(1)
                place = np.uint64((f * count + m) * wide + g * count)
                other = np.uint64((g * count + m) * wide + f * count)
                sines = np.uint64(cosines)
                _combine(even, less, even, beyond, 1.0, flat, place, some)
                _combine(odd, beyond + one, odd, less + one, 1.0, flat, place + sines, more)
                if f != g:
                    _copy(flat, place, other, some)
                    _copy(flat, place + sines, other + sines, more)
                if m > 0:
                    place = np.uint64((f * count + cosines + m - 1) * wide + g * count)
                    other = np.uint64((g * count + cosines + m - 1) * wide + f * count)
                    _combine(odd, beyond, odd, less, -1.0, flat, place, some)
                    _combine(even, less + one, even, beyond + one, -1.0, flat, place + sines, more)
                    if f != g:
                        _copy(flat, place, other, some)
                        _copy(flat, place + sines, other + sines, more)


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def _add_four(a, first, b, second, c, third, d, fourth, target):
    """Add multiples of four lines to another."""
    for p in range(target.shape[0]):
        target[p] += a * first[p] + b * second[p] + c * third[p] + d * fourth[p]


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def _interleave(rows, felt):
    """Fill `felt` (place, 4) by four rows."""
    one, two, three, four = rows[0], rows[1], rows[2], rows[3]
    for p in range(felt.shape[0]):
        felt[p, 0], felt[p, 1], felt[p, 2], felt[p, 3] = one[p], two[p], three[p], four[p]


@bare(**LINKED)
def _by_waves(waves, room, hessian):
    """Fill the lower half of the tangent of the contacts from products of waves, four rows at once.

    What the waves of all tracks feel of the four unknowns lies side by side, so that one look at
    a wave serves all of them.
    """
    first, value, place = waves.first, waves.value, waves.place
    products, rows, felt = room.products, room.rows, room.felt
    size = hessian.shape[0]
    for a in range(0, size, 4):
        for row in range(4):
            line = rows[row]
            line[:] = 0.0
            e, last = first[min(a + row, size)], first[min(a + row + 1, size)]
            while e + 4 <= last:
                _add_four(
                    value[e], products[place[e]], value[e + 1], products[place[e + 1]],
                    value[e + 2], products[place[e + 2]], value[e + 3], products[place[e + 3]],
                    line,
                )  # fmt: skip
                e += 4
            while e < last:
                add_multiple(value[e], products[place[e]], line)
                e += 1
        _interleave(rows, felt)
        for b in range(min(a + 4, size)):
            t = u = v = w = 0.0
            for e in range(first[b], first[b + 1]):
                amount, at = value[e], felt[place[e]]
                t += amount * at[0]
                u += amount * at[1]
                v += amount * at[2]
                w += amount * at[3]
            hessian[a, b] = t
            if a + 1 < size:
                hessian[a + 1, b] = u
            if a + 2 < size:
                hessian[a + 2, b] = v
            if a + 3 < size:
                hessian[a + 3, b] = w


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER, **LINKED)
def _by_balls(resistance, waves, hessian):
    """Fill the lower half of the tangent of the contacts from all balls, eight rows at a time.

    By loops, as a library of linear algebra starts threads of its own and waits for them.
    """
    shapes, tracks = waves.shapes, waves.mixing.shape[1]
    forced = np.zeros(shapes.shape)
    for j in range(waves.balls):
        for f in range(tracks):
            for g in range(tracks):
                high, low = max(f, g), min(f, g)
                resists = resistance[high * (high + 1) // 2 + low, j]
                line, source = forced[j * tracks + f], shapes[j * tracks + g]
                for a in range(line.shape[0]):
                    line[a] += resists * source[a]
    hessian[:, :] = 0.0
    for k in range(0, shapes.shape[0], 8):
        r0, r1, r2, r3 = forced[k], forced[k + 1], forced[k + 2], forced[k + 3]
        r4, r5, r6, r7 = forced[k + 4], forced[k + 5], forced[k + 6], forced[k + 7]
        for a in range(hessian.shape[0]):
            line = hessian[a]
            c0, c1, c2, c3 = shapes[k, a], shapes[k + 1, a], shapes[k + 2, a], shapes[k + 3, a]
            c4, c5, c6, c7 = shapes[k + 4, a], shapes[k + 5, a], shapes[k + 6, a], shapes[k + 7, a]
            for b in range(a + 1):
                line[b] += (
                    c0 * r0[b] + c1 * r1[b] + c2 * r2[b] + c3 * r3[b]
                    + c4 * r4[b] + c5 * r5[b] + c6 * r6[b] + c7 * r7[b]
                )  # fmt: skip


@njit(nogil=True, error_model="numpy", **LINKED)
def _lower(waves, power, push, slope, across, slant, room):
    """Fill the lower half of the Hessian of the potential."""
    hessian = room.hessian
    _resistances(waves, power, push, slope, across, slant, room)
    if waves.shapes.shape[0] == 0:
        _products(room.resistance, waves, room)
        _by_waves(waves, room, hessian)
    else:
        _by_balls(room.resistance, waves, hessian)
    for a in range(5, hessian.shape[0]):
        hessian[a, a] += 1.0


@njit(cache=True, nogil=True, error_model="numpy")
def tangent(waves, power, push, slope, across, slant):
    """Exact Hessian of the potential."""
    room = tangent_room(waves)
    hessian = room.hessian
    _lower(waves, power, push, slope, across, slant, room)
    for a in range(hessian.shape[0]):
        for b in range(a):
            hessian[b, a] = hessian[a, b]
    return hessian


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def factorise(matrix, columns):
    """Replace the first `columns` of the lower half of a matrix by those of its Cholesky factor.

    Four columns at a time, whose sums go along the rows together; what stands in the other columns
    of the first rows may be anything.
    """
    rows = matrix.shape[0]
    for b in range(0, columns, 4):
        if b + 4 <= columns:
            one, two, three, four = matrix[b], matrix[b + 1], matrix[b + 2], matrix[b + 3]
            for a in range(b, rows):
                line = matrix[a]
                t = u = v = w = 0.0
                for k in range(b):
                    value = line[k]
                    t += value * one[k]
                    u += value * two[k]
                    v += value * three[k]
                    w += value * four[k]
                line[b] -= t
                line[b + 1] -= u
                line[b + 2] -= v
                line[b + 3] -= w
        else:
            for a in range(b, rows):
                for c in range(b, columns):
                    total = 0.0
                    for k in range(b):
                        total += matrix[a, k] * matrix[c, k]
                    matrix[a, c] -= total
        for c in range(b, min(b + 4, columns)):
            pivot = math.sqrt(matrix[c, c])
            for a in range(c, rows):
                matrix[a, c] /= pivot
            for d in range(c + 1, min(b + 4, columns)):
                for a in range(d, rows):
                    matrix[a, d] -= matrix[a, c] * matrix[d, c]


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def forward(factor, rhs):
    """Replace `rhs` by the solution with a Cholesky factor, whose columns may have more rows.

    Four rows at a time, whose sums go along together.
    """
    size = rhs.shape[0]
    blocks = size - size % 4
    for a in range(0, blocks, 4):
        one, two, three, four = factor[a], factor[a + 1], factor[a + 2], factor[a + 3]
        t, u, v, w = rhs[a], rhs[a + 1], rhs[a + 2], rhs[a + 3]
        for k in range(a):
            value = rhs[k]
            t -= value * one[k]
            u -= value * two[k]
            v -= value * three[k]
            w -= value * four[k]
        t /= one[a]
        u = (u - two[a] * t) / two[a + 1]
        v = (v - three[a] * t - three[a + 1] * u) / three[a + 2]
        w = (w - four[a] * t - four[a + 1] * u - four[a + 2] * v) / four[a + 3]
        rhs[a], rhs[a + 1], rhs[a + 2], rhs[a + 3] = t, u, v, w
    for a in range(blocks, size):
        value = rhs[a]
        for k in range(a):
            value -= factor[a, k] * rhs[k]
        rhs[a] = value / factor[a, a]


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def backward(factor, rhs):
    """Replace `rhs` by the solution with a Cholesky factor transposed, four rows at a time."""
    size = rhs.shape[0]
    blocks = size - size % 4
    for a in range(size - 1, blocks - 1, -1):
        rhs[a] /= factor[a, a]
        for k in range(a):
            rhs[k] -= factor[a, k] * rhs[a]
    for a in range(blocks - 4, -1, -4):
        one, two, three, four = factor[a], factor[a + 1], factor[a + 2], factor[a + 3]
        w = rhs[a + 3] / four[a + 3]
        v = (rhs[a + 2] - four[a + 2] * w) / three[a + 2]
        u = (rhs[a + 1] - four[a + 1] * w - three[a + 1] * v) / two[a + 1]
        t = (rhs[a] - four[a] * w - three[a] * v - two[a] * u) / one[a]
        rhs[a], rhs[a + 1], rhs[a + 2], rhs[a + 3] = t, u, v, w
        for k in range(a):
            rhs[k] -= t * one[k] + u * two[k] + v * three[k] + w * four[k]


@njit(nogil=True, error_model="numpy", **LINKED)
def condense(waves, power, push, slope, across, slant, room, factor, condensed):
    """Tangent with the modes eliminated.

    Fills the Cholesky `factor` (mode + 5, mode) of the modes, below it the rows of the rigid
    unknowns, and the 5 × 5 tangent that is left.
    """
    hessian, modes = room.hessian, factor.shape[1]
    _lower(waves, power, push, slope, across, slant, room)
    for a in range(modes):
        source, line = hessian[a + 5], factor[a]
        for b in range(a + 1):
            line[b] = source[5 + b]
        for b in range(5):
            factor[modes + b, a] = source[b]
    factorise(factor, modes)
    for a in range(5):
        for b in range(5):
            held = hessian[max(a, b), min(a, b)]
            condensed[a, b] = held - dot(factor[modes + a], factor[modes + b])
