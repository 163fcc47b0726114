"""Compiled loops of the equilibrium with flexible rings.

Unknowns x = (ux, uy, uz, R θx, R θy, a): motion of the inner ring's structure relative to the outer
one's, all lengths, and the ring modes of unit stiffness. `basis` (3, contact, unknown) gives the
relative shift (r, θ, z) of the two groove centres of each contact; `waves` gives the same as few
waves around the ring, `loadflow.rolling.rings.condensed.RingWaves`. Contacts are numbered kind by
kind. `law` (`loadflow.rolling.rings.condensed.ContactLaw`) holds their table and `local`, the
compliance of the rings right at a contact, along its force; of line contacts the shift has two
fields in place of three (`loadflow.rolling.rings._line_kernels`). The potential is convex in x.
"""

from __future__ import annotations

import math

import numpy as np

from loadflow.numerics.lanes import LANES, put, spread, take
from loadflow.numerics.linked import LINKED, bare, contracted, njit
from loadflow.rolling._kernels import rounding_level, stalled
from loadflow.rolling.contacts import FREE, GAP, NORMAL_R, NORMAL_Z, POINT, STIFFNESS
from loadflow.rolling.rings._line_kernels import line_contacts
from loadflow.rolling.rings._ring_rooms import wave_room

# Sums may be reordered (so that they use vector units); nothing else of fast mathematics.
_REORDER = {"reassoc", "contract", "nsz"}


@bare(**LINKED)
def _root(stretch, cubic):
    """Root y of y² (1 + cubic y) = stretch > 0, of a contact δ = y² with a spring behind it."""
    root = min(math.sqrt(stretch), (stretch / cubic) ** (1.0 / 3.0))
    for _ in range(60):
        step = (root * root * (1.0 + cubic * root) - stretch) / (root * (2.0 + 3.0 * cubic * root))
        root -= step
        if stalled(abs(step), rounding_level(root)):
            break
    return root


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def dot(a, b):
    """Sum of products; loops rather than array expressions, which take seconds to compile."""
    total = 0.0
    for i in range(a.shape[0]):
        total += a[i] * b[i]
    return total


@njit(cache=True, nogil=True, error_model="numpy")
def largest_product(a, b):
    """Largest |a b|."""
    most = 0.0
    for i in range(a.shape[0]):
        most = max(most, abs(a[i] * b[i]))
    return most


@contracted(**LINKED)
def _weigh(weights, begin, end, table, first, last, sums):
    """Fill columns first … last of `sums` by lines of `table`, weighted by each line of `weights`.

    Lines and weights are those from `begin` to `end`; all four are multiples of `LANES`. Two lines
    of `weights` at a time, so that one look at the table serves both.
    """
    wide, long, to = table.shape[1], weights.shape[1], sums.shape[1]
    flat, one = weights.reshape(weights.size), np.uint64(1)  # not looked at twice
    for at in range(first, last, LANES):
        for s in range(0, weights.shape[0], 2):
            other = min(s + 1, weights.shape[0] - 1)
            a, b, c, d = spread(0.0), spread(0.0), spread(0.0), spread(0.0)
            for t in range(begin, end, 2):
                i, j, here = np.uint64(s * long + t), np.uint64(other * long + t), t * wide + at
                row, next_row = take(table, here), take(table, here + wide)
                a, b = a + flat[i] * row, b + flat[i + one] * next_row
                c, d = c + flat[j] * row, d + flat[j + one] * next_row
            put(sums, s * to + at, a + b)
            put(sums, other * to + at, c + d)


@bare(**LINKED)
def _spread(amount, waves, even, odd, shift):
    """Fill the `shift` (track, ball) by the `amount` (track, wave) of each wave.

    Cosines and sines over half of the ring, whose sum and difference are both halves; `even` and
    `odd` are room for them.
    """
    trig, cosines, balls = waves.trig, waves.cosines, waves.balls
    half = balls // 2 + 1
    _weigh(amount, 0, cosines, trig, 0, trig.shape[1], even)
    _weigh(amount, cosines, trig.shape[0], trig, 0, trig.shape[1], odd)
    for s in range(shift.shape[0]):
        line, one, two = shift[s], even[s], odd[s]
        for j in range(half):
            line[j] = one[j] + two[j]
        for j in range(1, balls - half + 1):
            line[balls - j] = one[j] - two[j]


@bare(**LINKED)
def gather(values, turned, cosines, even, odd, amount):
    """Fill the `amount` (line, wave) with sums of `values` (line, ball) times each wave.

    `turned` holds the waves by balls, `even` and `odd` (line, half) are room.
    """
    balls = values.shape[1]
    half = balls // 2 + 1
    for s in range(values.shape[0]):
        line, one, two = values[s], even[s], odd[s]
        for j in range(half):
            one[j], two[j] = line[j], 0.0
        for j in range(1, balls - half + 1):
            one[j] = line[j] + line[balls - j]
            two[j] = line[j] - line[balls - j]
    _weigh(even, 0, turned.shape[0], turned, 0, cosines, amount)
    _weigh(odd, 0, turned.shape[0], turned, cosines, turned.shape[1], amount)


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def add_multiple(factor, source, target):
    """Add `factor` times a line to another."""
    for j in range(target.shape[0]):
        target[j] += factor * source[j]


@bare(**LINKED)
def mix(mixing, shift, full):
    """Fill the `full` shift of all fields by that of the tracks."""
    full[:, :] = 0.0
    for s in range(full.shape[0]):
        for f in range(shift.shape[0]):
            if mixing[s, f] != 0.0:
                add_multiple(mixing[s, f], shift[f], full[s])


@bare(**LINKED)
def _gather_push(push, waves, room, pull):
    """Add the forces `push` (field · kind, ball) of all contacts to those on the unknowns."""
    mixing, first, value = waves.mixing, waves.first, waves.value
    lumped, amount = room.lumped, room.amount
    lumped[:, :] = 0.0
    for s in range(push.shape[0]):
        for f in range(lumped.shape[0]):
            if mixing[s, f] != 0.0:
                add_multiple(mixing[s, f], push[s], lumped[f])
    gather(lumped, waves.turned, waves.cosines, room.even, room.odd, amount)
    line, place = room.line, waves.place
    for a in range(pull.shape[0]):
        total = 0.0
        for e in range(first[a], first[a + 1]):
            total += value[e] * line[place[e]]
        pull[a] += total


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def _contacts(shift, table, local, push, slope, across):
    """Fill push (3 kind, ball), slope along and across (kind, ball) of contacts by their shift.

    Free of branches but for the spring `local`. Returns energy, sum of forces, and whether a loaded
    contact lies beyond 90°.
    """
    energy = total = 0.0
    upright = 1.0
    for k in range(table.shape[0]):
        dr, dt, dz = shift[3 * k], shift[3 * k + 1], shift[3 * k + 2]
        pr, pt, pz = push[3 * k], push[3 * k + 1], push[3 * k + 2]
        normal_r, normal_z = table[k, NORMAL_R], table[k, NORMAL_Z]
        free, gap, stiffness = table[k, FREE], table[k, GAP], table[k, STIFFNESS]
        roots, inverse = slope[k], across[k]
        for j in range(dr.shape[0]):
            stretch = (
                2.0 * (normal_r * dr[j] + normal_z * dz[j])
                + dr[j] * dr[j] + dt[j] * dt[j] + dz[j] * dz[j] + gap
            )  # fmt: skip
            r, z = normal_r + dr[j], normal_z + dz[j]
            length = math.sqrt(r * r + dt[j] * dt[j] + z * z)
            roots[j] = math.sqrt(max(stretch, 0.0) / (length + free))
            inverse[j] = 1.0 / length
        if local > 0.0:
            for j in range(dr.shape[0]):
                if roots[j] > 0.0:
                    roots[j] = _root(roots[j] * roots[j], local * stiffness)
        for j in range(dr.shape[0]):
            root, r = roots[j], normal_r + dr[j]
            force = stiffness * root * root * root
            energy += force * (0.4 * root * root + 0.5 * local * force)
            total += force
            upright = min(upright, r * force)
            side = force * inverse[j]
            along = 1.5 * stiffness * root
            pr[j], pt[j], pz[j] = side * r, side * dt[j], side * (normal_z + dz[j])
            inverse[j] = side
            roots[j] = along / (1.0 + local * along)
    return energy, total, upright < 0.0


@bare(**LINKED)
def shift_of(x, waves, room, shift):
    """Fill the `shift` (track, ball) by the unknowns."""
    amount, line = room.amount, room.line
    owner, place, value = waves.owner, waves.place, waves.value
    line[:] = 0.0
    for e in range(value.shape[0]):
        line[place[e]] += x[owner[e]] * value[e]
    _spread(amount, waves, room.even, room.odd, shift)


@bare(**LINKED)
def forces(x, shift, waves, law, room, full, push, slope, across, slant, pull):
    """Energy, sum of forces, and whether a loaded contact lies beyond 90°, at known shifts.

    Fills the `full` shift, what `_contacts` or `line_contacts` fills, and the force `pull` on all
    unknowns.
    """
    beyond = False
    mix(waves.mixing, shift, full)
    if law.power == POINT:
        energy, total, beyond = _contacts(full, law.table, law.local, push, slope, across)
    else:
        energy, total = line_contacts(full, law.table, push, slope, across, slant)
    for a in range(x.shape[0]):
        pull[a] = x[a] if a >= 5 else 0.0
        energy += 0.5 * pull[a] * pull[a]
    _gather_push(push, waves, room, pull)
    return energy, total, beyond


@njit(cache=True, nogil=True, error_model="numpy")
def evaluate(x, waves, law):
    """Contacts in the state x.

    Returns the shift and push (3 kind, ball) of the contacts, their slopes along and across and
    their slant (kind, ball), and the force on all unknowns.
    """
    balls, fields, tracks = waves.balls, waves.mixing.shape[0], waves.mixing.shape[1]
    kinds = fields // 3 if law.power == POINT else fields // 2
    shift, full, push = (
        np.zeros((tracks, balls)), np.zeros((fields, balls)), np.zeros((fields, balls)),
    )  # fmt: skip
    slope, across = np.zeros((kinds, balls)), np.zeros((kinds, balls))
    slant, pull = np.zeros((kinds, balls)), np.zeros(x.shape[0])
    room = wave_room(waves)
    shift_of(x, waves, room, shift)
    forces(x, shift, waves, law, room, full, push, slope, across, slant, pull)
    return full, push, slope, across, slant, pull


@njit(cache=True, nogil=True, error_model="numpy")
def fields_of(states, waves):
    """What all contacts feel in each state, (n, field · kind, ball)."""
    found = np.zeros((states.shape[0], waves.mixing.shape[0], waves.balls))
    shift = np.zeros((waves.mixing.shape[1], waves.balls))
    room = wave_room(waves)
    for i in range(states.shape[0]):
        shift_of(states[i], waves, room, shift)
        mix(waves.mixing, shift, found[i])
    return found


@njit(cache=True, nogil=True, error_model="numpy")
def contact_state(states, waves, law):
    """Force and signed angle (from the radial plane) of each point contact, (n, kind, ball)."""
    table = law.table
    balls, kinds = waves.balls, table.shape[0]
    force, angle = np.zeros((2, len(states), kinds, balls))
    for i in range(len(states)):
        shift, push, _, _, _, _ = evaluate(states[i], waves, law)
        for k in range(kinds):
            for j in range(balls):
                pr, pt, pz = push[3 * k, j], push[3 * k + 1, j], push[3 * k + 2, j]
                force[i, k, j] = math.sqrt(pr * pr + pt * pt + pz * pz)
                angle[i, k, j] = math.atan2(
                    table[k, NORMAL_Z] + shift[3 * k + 2, j], table[k, NORMAL_R] + shift[3 * k, j]
                )
    return force, angle
