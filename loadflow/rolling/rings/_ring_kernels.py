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
from numba import njit

from loadflow.numerics.linked import LINKED, bare
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


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def _spread(amount, trig, cosines, odd, shift):
    """Fill the `shift` (track, ball) by the `amount` (track, wave) of each wave.

    Four waves at a time: cosines and sines over half of the ring, whose sum and difference are
    both halves. `odd` is room for one of them.
    """
    half, balls = trig.shape[1], shift.shape[1]
    for s in range(shift.shape[0]):
        line, size = shift[s], amount[s]
        line[:half] = 0.0
        odd[:] = 0.0
        for t in range(0, cosines, 4):
            a, b, c, d = size[t], size[t + 1], size[t + 2], size[t + 3]
            ta, tb, tc, td = trig[t], trig[t + 1], trig[t + 2], trig[t + 3]
            for j in range(half):
                line[j] += a * ta[j] + b * tb[j] + c * tc[j] + d * td[j]
        for t in range(cosines, trig.shape[0], 4):
            a, b, c, d = size[t], size[t + 1], size[t + 2], size[t + 3]
            ta, tb, tc, td = trig[t], trig[t + 1], trig[t + 2], trig[t + 3]
            for j in range(half):
                odd[j] += a * ta[j] + b * tb[j] + c * tc[j] + d * td[j]
        for j in range(1, balls - half + 1):
            line[balls - j] = line[j] - odd[j]
            line[j] += odd[j]


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def gather(values, trig, cosines, even, odd, amount):
    """Fill the `amount` (line, wave) with sums of `values` (line, ball) times each wave.

    `even` and `odd` are room for half a ring each.
    """
    half, balls = trig.shape[1], values.shape[1]
    for s in range(values.shape[0]):
        line, size = values[s], amount[s]
        for j in range(half):
            even[j], odd[j] = line[j], 0.0
        for j in range(1, balls - half + 1):
            even[j] = line[j] + line[balls - j]
            odd[j] = line[j] - line[balls - j]
        for t in range(0, trig.shape[0], 4):
            folded = even if t < cosines else odd
            ta, tb, tc, td = trig[t], trig[t + 1], trig[t + 2], trig[t + 3]
            a = b = c = d = 0.0
            for j in range(half):
                a += folded[j] * ta[j]
                b += folded[j] * tb[j]
                c += folded[j] * tc[j]
                d += folded[j] * td[j]
            size[t], size[t + 1], size[t + 2], size[t + 3] = a, b, c, d


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
    gather(lumped, waves.trig, waves.cosines, room.even, room.odd, amount)
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
    first, place, value = waves.first, waves.place, waves.value
    line[:] = 0.0
    for a in range(x.shape[0]):
        for e in range(first[a], first[a + 1]):
            line[place[e]] += x[a] * value[e]
    _spread(amount, waves.trig, waves.cosines, room.odd, shift)


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
