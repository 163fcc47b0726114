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

from loadflow.numerics.linked import LINKED
from loadflow.rolling._kernels import rounding_level, stalled
from loadflow.rolling.contacts import FREE, GAP, NORMAL_R, NORMAL_Z, POINT, STIFFNESS
from loadflow.rolling.rings._line_kernels import line_contacts, line_rows

# Sums may be reordered (so that they use vector units); nothing else of fast mathematics.
_REORDER = {"reassoc", "contract", "nsz"}


@njit(nogil=True, error_model="numpy", cache=True)
def _root(stretch, cubic):
    """Root y of y² (1 + cubic y) = stretch > 0, of a contact δ = y² with a spring behind it."""
    root = min(math.sqrt(stretch), (stretch / cubic) ** (1.0 / 3.0))
    for _ in range(60):
        step = (root * root * (1.0 + cubic * root) - stretch) / (root * (2.0 + 3.0 * cubic * root))
        root -= step
        if stalled(abs(step), rounding_level(root)):
            break
    return root


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER, **LINKED)
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


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER, **LINKED)
def _spread(x, waves, amount, shift):
    """Fill the `shift` (3 kind, ball) of all contacts by the unknowns `x`.

    Unknowns to `amount` (wave, 3 kind) of each wave, then waves to balls, four at a time: cosines
    and sines over half of the ring, whose sum and difference are both halves.
    """
    trig, owner, wave, amplitude, cosines, balls = waves
    half = trig.shape[1]
    odd = np.empty(half)
    amount[:, :] = 0.0
    for i in range(owner.shape[0]):
        size, line, part = x[owner[i]], amount[wave[i]], amplitude[i]
        for s in range(part.shape[0]):
            line[s] += size * part[s]
    for s in range(shift.shape[0]):
        line = shift[s]
        line[:half] = 0.0
        odd[:] = 0.0
        for t in range(0, cosines, 4):
            a, b, c, d = amount[t, s], amount[t + 1, s], amount[t + 2, s], amount[t + 3, s]
            ta, tb, tc, td = trig[t], trig[t + 1], trig[t + 2], trig[t + 3]
            for j in range(half):
                line[j] += a * ta[j] + b * tb[j] + c * tc[j] + d * td[j]
        for t in range(cosines, trig.shape[0], 4):
            a, b, c, d = amount[t, s], amount[t + 1, s], amount[t + 2, s], amount[t + 3, s]
            ta, tb, tc, td = trig[t], trig[t + 1], trig[t + 2], trig[t + 3]
            for j in range(half):
                odd[j] += a * ta[j] + b * tb[j] + c * tc[j] + d * td[j]
        for j in range(1, balls - half + 1):
            line[balls - j] = line[j] - odd[j]
            line[j] += odd[j]


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER, **LINKED)
def _gather(push, waves, amount, pull):
    """Add the forces `push` (3 kind, ball) of all contacts to those on the unknowns."""
    trig, owner, wave, amplitude, cosines, balls = waves
    half = trig.shape[1]
    even, odd = np.empty(half), np.empty(half)
    for s in range(push.shape[0]):
        line = push[s]
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
            amount[t, s], amount[t + 1, s], amount[t + 2, s], amount[t + 3, s] = a, b, c, d
    for i in range(owner.shape[0]):
        pull[owner[i]] += dot(amplitude[i], amount[wave[i]])


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER, **LINKED)
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


@njit(cache=True, nogil=True, error_model="numpy")
def shift_of(x, waves, amount, shift):
    _spread(x, waves, amount, shift)


@njit(cache=True, nogil=True, error_model="numpy")
def forces(x, shift, waves, law, amount, push, slope, across, slant, pull):
    """Energy, sum of forces, and whether a loaded contact lies beyond 90°, at known shifts.

    Fills what `_contacts` or `line_contacts` fills, and the force `pull` on all unknowns.
    """
    beyond = False
    if law.power == POINT:
        energy, total, beyond = _contacts(shift, law.table, law.local, push, slope, across)
    else:
        energy, total = line_contacts(shift, law.table, push, slope, across, slant)
    for a in range(x.shape[0]):
        pull[a] = x[a] if a >= 5 else 0.0
        energy += 0.5 * pull[a] * pull[a]
    _gather(push, waves, amount, pull)
    return energy, total, beyond


@njit(cache=True, nogil=True, error_model="numpy")
def evaluate(x, waves, law):
    """Contacts in the state x.

    Returns the shift and push (3 kind, ball) of the contacts, their slopes along and across and
    their slant (kind, ball), and the force on all unknowns.
    """
    balls, fields = waves[5], waves[3].shape[1]
    kinds = fields // 3 if law.power == POINT else fields // 2
    amount = np.zeros((waves[0].shape[0], fields))
    shift, push = np.zeros((fields, balls)), np.zeros((fields, balls))
    slope, across = np.zeros((kinds, balls)), np.zeros((kinds, balls))
    slant, pull = np.zeros((kinds, balls)), np.zeros(x.shape[0])
    shift_of(x, waves, amount, shift)
    forces(x, shift, waves, law, amount, push, slope, across, slant, pull)
    return shift, push, slope, across, slant, pull


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER, **LINKED)
def _rows(basis, push, slope, across, rows):
    """Fill the rows of points whose squares are the tangent; returns how many."""
    balls, size = push.shape[1], basis.shape[2]
    k = 0
    for i in range(basis.shape[1]):
        kind, j = i // balls, i % balls
        if slope[kind, j] == 0.0:
            continue
        pr, pt, pz = push[3 * kind, j], push[3 * kind + 1, j], push[3 * kind + 2, j]
        force = math.sqrt(pr * pr + pt * pt + pz * pz)
        nr, nt, nz = pr / force, pt / force, pz / force
        flat = math.sqrt(nr * nr + nz * nz)
        br, bz = -nz / flat, nr / flat  # across, within the plane of the ball
        along, side = math.sqrt(slope[kind, j]), math.sqrt(across[kind, j])
        gr, gt, gz = basis[0, i], basis[1, i], basis[2, i]
        first, second, third = rows[k], rows[k + 1], rows[k + 2]
        ratio = nt / flat
        for a in range(size):
            normal = nr * gr[a] + nz * gz[a]
            first[a] = along * (normal + nt * gt[a])
            second[a] = side * (br * gr[a] + bz * gz[a])
            third[a] = side * (flat * gt[a] - ratio * normal)
        k += 3
    return k


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER, **LINKED)
def _squares(rows, count, hessian):
    """Lower half of rowsᵀ rows, eight rows at a time.

    By loops, as a library of linear algebra starts threads of its own and waits for them.
    """
    size = hessian.shape[0]
    hessian[:, :] = 0.0
    for k in range(0, count, 8):
        r0, r1, r2, r3 = rows[k], rows[k + 1], rows[k + 2], rows[k + 3]
        r4, r5, r6, r7 = rows[k + 4], rows[k + 5], rows[k + 6], rows[k + 7]
        for a in range(size):
            line = hessian[a]
            c0, c1, c2, c3, c4, c5, c6, c7 = (
                r0[a], r1[a], r2[a], r3[a], r4[a], r5[a], r6[a], r7[a],
            )  # fmt: skip
            for b in range(a + 1):
                line[b] += (
                    c0 * r0[b] + c1 * r1[b] + c2 * r2[b] + c3 * r3[b]
                    + c4 * r4[b] + c5 * r5[b] + c6 * r6[b] + c7 * r7[b]
                )  # fmt: skip


@njit(cache=True, nogil=True, error_model="numpy")
def tangent(basis, push, slope, across, slant):
    """Exact Hessian of the potential; of points with three fields in the basis, of lines two."""
    fields, contacts, size = basis.shape
    rows, hessian = np.empty((fields * contacts + 8, size)), np.zeros((size, size))
    if fields == 3:
        count = _rows(basis, push, slope, across, rows)
    else:
        count = line_rows(basis, slope, across, slant, rows)
    while count % 8:
        rows[count, :] = 0.0
        count += 1
    _squares(rows, count, hessian)
    for a in range(size):
        hessian[a, a] += 1.0 if a >= 5 else 0.0
        for b in range(a):
            hessian[b, a] = hessian[a, b]
    return hessian


@njit(cache=True, nogil=True, error_model="numpy")
def contact_state(states, waves, law):
    """Force and signed angle (from the radial plane) of each point contact, (n, kind, ball)."""
    table = law.table
    balls, kinds = waves[5], table.shape[0]
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
