"""Compiled loops of the equilibrium with flexible rings.

Unknowns x = (ux, uy, uz, R θx, R θy, a): motion of the inner ring's structure relative to the outer
one's, all lengths, and the ring modes of unit stiffness. `basis` (3, contact, unknown) gives the
relative shift (r, θ, z) of the two groove centres of each contact. `local` is the compliance of
the rings right at a contact, along its force. Contacts are numbered kind by kind, the table is
that of `loadflow.rolling.contacts`. The potential is convex in x.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from loadflow.rolling._kernels import cholesky_solve, is_small, rounding_level, stalled
from loadflow.rolling.contacts import FREE, GAP, NORMAL_R, NORMAL_Z, STIFFNESS

# Sums may be reordered (so that they use vector units); nothing else of fast mathematics.
_REORDER = {"reassoc", "contract", "nsz"}


@njit(cache=True, nogil=True, error_model="numpy")
def _compress(stretch, stiffness, local):
    """Force and slope of a contact δ = (F/K)^(2/3) + c F under the whole stretch δ > 0."""
    root = math.sqrt(stretch)
    if local > 0.0:
        cubic = local * stiffness
        root = min(root, (stretch / cubic) ** (1.0 / 3.0))
        for _ in range(60):
            step = (root * root * (1.0 + cubic * root) - stretch) / (
                root * (2.0 + 3.0 * cubic * root)
            )
            root -= step
            if stalled(abs(step), rounding_level(root)):
                break
    slope = 1.5 * stiffness * root
    return stiffness * root**3, slope / (1.0 + local * slope)


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER)
def _dot(a, b):
    """Sum of products; loops rather than array expressions, which take seconds to compile."""
    total = 0.0
    for i in range(a.shape[0]):
        total += a[i] * b[i]
    return total


@njit(cache=True, nogil=True, error_model="numpy")
def _largest(a, b):
    """Largest |a b|."""
    most = 0.0
    for i in range(a.shape[0]):
        most = max(most, abs(a[i] * b[i]))
    return most


@njit(cache=True, nogil=True, error_model="numpy")
def evaluate(x, basis, table, local, push, slope, across, angle, pull):
    """Energy at x; fills push (3, contact), slope along and across, and angle of the contacts.

    Fills the force `pull` on all unknowns as well. Returns energy, sum of forces, and whether a
    loaded contact lies beyond 90°.
    """
    count, size = basis.shape[1], x.shape[0]
    balls = count // table.shape[0]
    energy = total = 0.0
    beyond = False
    for a in range(size):
        pull[a] = x[a] if a >= 5 else 0.0
        energy += 0.5 * pull[a] * pull[a]
    for i in range(count):
        line = table[i // balls]
        dr, dt, dz = _dot(basis[0, i], x), _dot(basis[1, i], x), _dot(basis[2, i], x)
        stretch = (
            2.0 * (line[NORMAL_R] * dr + line[NORMAL_Z] * dz)
            + dr * dr + dt * dt + dz * dz + line[GAP]
        )  # fmt: skip
        r, z = line[NORMAL_R] + dr, line[NORMAL_Z] + dz
        angle[i] = math.atan2(z, r)
        push[0, i] = push[1, i] = push[2, i] = slope[i] = across[i] = 0.0
        if stretch <= 0.0:
            continue
        length = math.sqrt(r * r + dt * dt + z * z)
        delta = stretch / (length + line[FREE])
        force, slope[i] = _compress(delta, line[STIFFNESS], local)
        energy += 0.4 * force * (delta - local * force) + 0.5 * local * force * force
        total += force
        across[i] = force / length
        push[0, i], push[1, i], push[2, i] = across[i] * r, across[i] * dt, across[i] * z
        beyond = beyond or r <= 0.0
        for a in range(size):
            pull[a] += (
                push[0, i] * basis[0, i, a]
                + push[1, i] * basis[1, i, a]
                + push[2, i] * basis[2, i, a]
            )
    return energy, total, beyond


@njit(cache=True, nogil=True, error_model="numpy")
def tangent(basis, push, slope, across, rows):
    """Exact Hessian of the potential; `rows` (3 · contact, unknown) is room to work in."""
    count, size = basis.shape[1], basis.shape[2]
    k = 0
    for i in range(count):
        if slope[i] == 0.0:
            continue
        force = math.sqrt(push[0, i] ** 2 + push[1, i] ** 2 + push[2, i] ** 2)
        nr, nt, nz = push[0, i] / force, push[1, i] / force, push[2, i] / force
        flat = math.sqrt(nr * nr + nz * nz)
        br, bz = -nz / flat, nr / flat  # across, within the plane of the ball
        along, side = math.sqrt(slope[i]), math.sqrt(across[i])
        for a in range(size):
            gr, gt, gz = basis[0, i, a], basis[1, i, a], basis[2, i, a]
            normal = nr * gr + nz * gz
            rows[k, a] = along * (normal + nt * gt)
            rows[k + 1, a] = side * (br * gr + bz * gz)
            rows[k + 2, a] = side * (flat * gt - nt / flat * normal)
        k += 3
    used = rows[:k]
    hessian = np.dot(used.T, used)
    for a in range(5, size):
        hessian[a, a] += 1.0
    return hessian


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER)
def _factorise(matrix):
    """Replace the lower half of a positive definite matrix by its Cholesky factor."""
    for a in range(matrix.shape[0]):
        for b in range(a + 1):
            value = matrix[a, b]
            for k in range(b):
                value -= matrix[a, k] * matrix[b, k]
            matrix[a, b] = math.sqrt(value) if a == b else value / matrix[b, b]


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER)
def _solve(factor, rhs):
    """Replace `rhs` by the solution with a matrix given by its Cholesky factor."""
    for a in range(rhs.shape[0]):
        value = rhs[a]
        for k in range(a):
            value -= factor[a, k] * rhs[k]
        rhs[a] = value / factor[a, a]
    for a in range(rhs.shape[0] - 1, -1, -1):
        rhs[a] /= factor[a, a]
        for k in range(a):
            rhs[k] -= factor[a, k] * rhs[a]


@njit(cache=True, nogil=True, error_model="numpy")
def _condense(basis, push, slope, across, room, factor, solved, condensed):
    """Tangent with the modes eliminated.

    Fills the Cholesky `factor` of the modes, the modes `solved` (5, mode) that follow each rigid
    unknown, and the 5 × 5 tangent that is left.
    """
    hessian = tangent(basis, push, slope, across, room)
    modes = factor.shape[0]
    for a in range(modes):
        for b in range(modes):
            factor[a, b] = hessian[5 + a, 5 + b]
    _factorise(factor)
    for a in range(5):
        for b in range(modes):
            solved[a, b] = hessian[a, 5 + b]
        _solve(factor, solved[a])
    for a in range(5):
        for b in range(5):
            condensed[a, b] = hessian[a, b] - _dot(hessian[a, 5:], solved[b])


@njit(cache=True, nogil=True, error_model="numpy")
def _direction(rest, factor, solved, condensed, cap, small, step):
    """Fill `step` by Newton's, with a Levenberg shift where the rigid part is singular.

    Returns the largest diagonal term and the smallest pivot of the rigid part.
    """
    rhs, modes = np.empty(5), step[5:]
    largest = norm = 0.0
    for a in range(5):
        rhs[a] = rest[a] - _dot(solved[a], rest[5:])
        largest = max(largest, condensed[a, a])
        norm += rhs[a] * rhs[a]
    regular, shift = 0.0, 0.0
    pivot = -1.0
    while regular <= 1e-13 and (largest > 0.0 or pivot < 0.0):
        regular = cholesky_solve(condensed, shift, rhs, small, step)
        pivot = regular if pivot < 0.0 else pivot
        shift = max(100.0 * shift, 1e-10 * largest)
    if largest == 0.0:  # nothing touches: go along the load
        for a in range(5):
            step[a] = rhs[a] * cap / math.sqrt(max(norm, 1e-300))
    for b in range(modes.shape[0]):
        modes[b] = rest[5 + b]
    _solve(factor, modes)
    for a in range(5):
        for b in range(modes.shape[0]):
            modes[b] -= solved[a, b] * step[a]
    return largest, pivot


@njit(cache=True, nogil=True, error_model="numpy")
def _newton(
    x, load, basis, table, local, reach, cap, tolerance, limit, room,
    factor, solved, condensed, known,
):  # fmt: skip
    """Minimise energy - load·x from `x`.

    Returns converged, residual, iterations, singular, and the rounding level of the residual.

    Newton with the exact tangent, kept while the residual falls tenfold at each step (`known` says
    whether a tangent from near `x` is there to begin with), a cap on the step of the contacts, and
    halving until energy or residual falls. Leaves the exact tangent at the solution.
    """
    count, size = basis.shape[1], basis.shape[2]
    push, small = np.zeros((3, count)), np.zeros((5, 5))
    slope, across, angle = np.zeros(count), np.zeros(count), np.zeros(count)
    pull, rest, step, trial = np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(size)
    one = np.ones(size)
    for a in range(size):
        trial[a] = x[a]
    external = _largest(load, one)
    iterations, residual, moved, norm, energy = 0, 0.0, 0.0, 0.0, 0.0
    damping, exact, fresh, beyond = 1.0, False, True, False
    potential, descent, halvings = 0.0, 0.0, 0
    while True:
        energy, total, beyond = evaluate(
            trial, basis, table, local, push, slope, across, angle, pull
        )
        new_norm = 0.0
        for a in range(size):
            new_norm += ((load[a] - pull[a]) * reach[a]) ** 2
        # accept where residual or potential falls, or at the very start
        if fresh or new_norm < norm * (1.0 - 1e-4 * damping) or (
            energy - _dot(load, trial) < potential + 1e-4 * damping * descent
        ):  # fmt: skip
            for a in range(size):
                x[a] = trial[a]
                rest[a] = load[a] - pull[a]
            norm, before = new_norm, residual
            reference = max(external, 1e-4 * total)
            residual = _largest(rest, reach)
            residual = residual / reference if reference > 0.0 else 0.0
            moved = _largest(x[:5], one)
            slow = not fresh and residual > 0.1 * before
            fresh = False
            if residual <= tolerance or iterations == limit:
                break
            exact = not known or slow
        elif halvings < 30:
            halvings += 1
            damping *= 0.5
            for a in range(size):
                trial[a] = x[a] + damping * step[a]
            continue
        elif exact:
            break
        else:  # an old tangent misled: go back and take the exact one
            for a in range(size):
                trial[a] = x[a]
            known, fresh, halvings = False, True, 0
            continue
        if exact:
            _condense(basis, push, slope, across, room, factor, solved, condensed)
            known = True
        _direction(rest, factor, solved, condensed, cap, small, step)
        iterations += 1
        shift = 0.0
        for i in range(count):
            for c in range(3):
                shift = max(shift, abs(_dot(basis[c, i], step)))
        if exact and stalled(max(shift, _largest(step[:5], one)), rounding_level(moved)):
            break
        damping = min(1.0, cap / shift) if shift > 0.0 else 1.0
        potential, descent, halvings = energy - _dot(load, x), -_dot(rest, step), 0
        for a in range(size):
            trial[a] = x[a] + damping * step[a]
    _condense(basis, push, slope, across, room, factor, solved, condensed)
    stiffest, pivot = _direction(rest, factor, solved, condensed, cap, small, step)
    reference = max(external, 1e-4 * total, 1e-300)
    rounding = rounding_level(moved * stiffest) / reference
    answered = is_small(residual, tolerance, rounding) and not beyond
    return answered, residual, iterations, pivot <= 1e-12, rounding


@njit(cache=True, nogil=True, error_model="numpy")
def solve_series(loads, rigid, basis, table, local, reach, cap, tolerance, limit, chunk):
    """Equilibrium for each load (n, 5) of lengths; warm start inside chunks of `chunk` cases.

    `rigid` (n, 5) is the equilibrium with rigid rings, from which a cold start goes. A case that
    fails or is singular from a warm start is solved again from a cold one; what then still fails is
    reached from a larger load in steps.
    """
    n, size = loads.shape[0], basis.shape[2]
    states, stiffness = np.zeros((n, size)), np.zeros((n, 5, 5))
    residual, iterations = np.zeros(n), np.zeros(n, np.int64)
    converged, singular = np.zeros(n, np.bool_), np.zeros(n, np.bool_)
    rounding = np.zeros(n)
    room = np.empty((3 * basis.shape[1], size))
    x, load = np.zeros(size), np.zeros(size)
    factor, solved = np.zeros((size - 5, size - 5)), np.zeros((5, size - 5))
    for i in range(n):
        warm = i % chunk > 0 and converged[i - 1] and not singular[i - 1]
        ok, res, count, free = False, 0.0, 0, False
        for attempt in range(9):  # warm, cold, then from 1e6 times the load down
            if attempt == 0 and not warm:
                continue
            times = 1.0 if attempt < 2 else 10.0 ** (8 - attempt)
            for a in range(5):
                load[a] = times * loads[i, a]
                for b in range(5):
                    if attempt == 0:
                        stiffness[i, a, b] = stiffness[i - 1, a, b]
            if attempt == 1 or attempt == 2:
                for a in range(size):
                    x[a] = rigid[i, a] if a < 5 else 0.0
            ok, res, more, free, rounding[i] = _newton(
                x, load, basis, table, local, reach, cap, tolerance, limit, room,
                factor, solved, stiffness[i], attempt == 0,
            )  # fmt: skip
            count += more
            if ok and (attempt == 1 or (attempt == 0 and not free)):
                break
        for a in range(size):
            states[i, a] = x[a]
        converged[i], residual[i], iterations[i], singular[i] = ok, res, count, free
    return states, stiffness, converged, residual, iterations, singular, rounding


@njit(cache=True, nogil=True, error_model="numpy")
def contact_state(states, basis, table, local):
    """Force and signed angle (from the radial plane) of each contact, (n, contact)."""
    count = basis.shape[1]
    force, angle = np.zeros((len(states), count)), np.zeros((len(states), count))
    push, pull = np.zeros((3, count)), np.zeros(basis.shape[2])
    slope, across = np.zeros(count), np.zeros(count)
    for j in range(len(states)):
        evaluate(states[j], basis, table, local, push, slope, across, angle[j], pull)
        for i in range(count):
            force[j, i] = math.sqrt(push[0, i] ** 2 + push[1, i] ** 2 + push[2, i] ** 2)
    return force, angle
