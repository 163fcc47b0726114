"""Compiled loops of the equilibrium with flexible rings.

Unknowns x = (ux, uy, uz, R θx, R θy, a): motion of the inner ring's structure relative to the outer
one's, all lengths, and the ring modes of unit stiffness. `basis` (3, contact, unknown) gives the
relative shift (r, θ, z) of the two groove centres of each contact. `local` is the compliance of
the rings right at a contact, along its force. Contacts are numbered kind by kind, the table is
that of `loadflow.rolling.contact`. The potential is convex in x.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from loadflow.rolling._kernels import cholesky_solve
from loadflow.rolling.contact import FREE, GAP, NORMAL_R, NORMAL_Z, STIFFNESS

_EPS = 2.220446049250313e-16
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
            if abs(step) <= 4.0 * _EPS * root:
                break
    slope = 1.5 * stiffness * root
    return stiffness * root**3, slope / (1.0 + local * slope)


@njit(cache=True, nogil=True, error_model="numpy")
def evaluate(x, basis, table, local, push, slope, across):
    """Energy at x; fills the push (3, contact) of the contacts, its slope along and across.

    Returns energy, sum of forces, and whether a loaded contact lies beyond 90°.
    """
    count = basis.shape[1]
    balls = count // table.shape[0]
    shift = np.dot(basis.reshape(3 * count, basis.shape[2]), x).reshape(3, count)
    energy = total = 0.0
    beyond = False
    for i in range(count):
        line = table[i // balls]
        dr, dt, dz = shift[0, i], shift[1, i], shift[2, i]
        stretch = (
            2.0 * (line[NORMAL_R] * dr + line[NORMAL_Z] * dz)
            + dr * dr + dt * dt + dz * dz + line[GAP]
        )  # fmt: skip
        if stretch <= 0.0:
            push[0, i] = push[1, i] = push[2, i] = slope[i] = across[i] = 0.0
            continue
        r, z = line[NORMAL_R] + dr, line[NORMAL_Z] + dz
        length = math.sqrt(r * r + dt * dt + z * z)
        delta = stretch / (length + line[FREE])
        force, slope[i] = _compress(delta, line[STIFFNESS], local)
        energy += 0.4 * force * (delta - local * force) + 0.5 * local * force * force
        total += force
        across[i] = force / length
        push[0, i], push[1, i], push[2, i] = across[i] * r, across[i] * dt, across[i] * z
        beyond = beyond or r <= 0.0
    for a in range(5, x.shape[0]):
        energy += 0.5 * x[a] * x[a]
    return energy, total, beyond


@njit(cache=True, nogil=True, error_model="numpy")
def _tangent(basis, push, slope, across, rows):
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


@njit(cache=True, nogil=True, error_model="numpy", fastmath=_REORDER)
def _factorise(matrix):
    """Replace the lower half of a positive definite matrix by its Cholesky factor."""
    for a in range(matrix.shape[0]):
        for b in range(a + 1):
            value = matrix[a, b]
            for k in range(b):
                value -= matrix[a, k] * matrix[b, k]
            matrix[a, b] = math.sqrt(value) if a == b else value / matrix[b, b]


@njit(cache=True, nogil=True, error_model="numpy", fastmath=_REORDER)
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
    hessian = _tangent(basis, push, slope, across, room)
    factor[:, :] = hessian[5:, 5:]
    solved[:, :] = hessian[:5, 5:]
    _factorise(factor)
    for a in range(5):
        _solve(factor, solved[a])
    for a in range(5):
        for b in range(5):
            condensed[a, b] = hessian[a, b] - np.sum(hessian[a, 5:] * solved[b])


@njit(cache=True, nogil=True, error_model="numpy")
def _direction(rest, factor, solved, condensed, cap, small, step):
    """Fill `step` by Newton's, with a Levenberg shift where the rigid part is singular."""
    rhs, rigid = np.empty(5), np.zeros(5)
    largest = 0.0
    for a in range(5):
        rhs[a] = rest[a] - np.sum(solved[a] * rest[5:])
        largest = max(largest, condensed[a, a])
    pivot, shift = cholesky_solve(condensed, 0.0, rhs, small, rigid), 1e-10 * largest
    while pivot <= 1e-13 and largest > 0.0:
        pivot = cholesky_solve(condensed, shift, rhs, small, rigid)
        shift *= 100.0
    if largest == 0.0:  # nothing touches: go along the load
        rigid[:] = rhs * (cap / math.sqrt(max(np.sum(rhs * rhs), 1e-300)))
    step[:5] = rigid
    modes = step[5:]
    modes[:] = rest[5:]
    _solve(factor, modes)
    for a in range(5):
        modes -= solved[a] * rigid[a]


@njit(cache=True, nogil=True, error_model="numpy")
def _unbalanced(x, load, flat, push):
    """What the load leaves over contacts and ring modes."""
    rest = load - np.dot(push.reshape(flat.shape[0]), flat)
    rest[5:] -= x[5:]
    return rest


@njit(cache=True, nogil=True, error_model="numpy")
def _newton(
    x, load, basis, table, local, reach, cap, tolerance, limit, room,
    factor, solved, condensed, known,
):  # fmt: skip
    """Minimise energy - load·x from `x`; returns converged, residual, iterations, singular.

    Newton with the exact tangent, kept while the residual falls tenfold at each step (`known` says
    whether a tangent from near `x` is there to begin with), a cap on the shift of the contacts, and
    halving until energy or residual falls. Leaves the exact tangent at the solution.
    """
    count, size = basis.shape[1], basis.shape[2]
    push, slope, across = np.zeros((3, count)), np.zeros(count), np.zeros(count)
    small, step = np.zeros((5, 5)), np.zeros(size)
    flat = basis.reshape(3 * count, size)
    external = np.max(np.abs(load))
    energy, total, beyond = evaluate(x, basis, table, local, push, slope, across)
    rest = _unbalanced(x, load, flat, push)
    iterations, residual, moved, exact = 0, 0.0, 0.0, False
    while True:
        reference = max(external, 1e-4 * total)
        before = residual
        residual = np.max(np.abs(rest) * reach)
        residual = residual / reference if reference > 0.0 else 0.0
        moved = np.max(np.abs(x[:5]))
        if residual <= tolerance or iterations == limit:
            break
        exact = not known or (iterations > 0 and residual > 0.1 * before)
        if exact:
            _condense(basis, push, slope, across, room, factor, solved, condensed)
            known = True
        _direction(rest, factor, solved, condensed, cap, small, step)
        iterations += 1
        shift = np.max(np.abs(np.dot(flat, step)))
        if exact and max(shift, np.max(np.abs(step[:5]))) <= 4.0 * _EPS * moved:
            break
        damping = min(1.0, cap / shift) if shift > 0.0 else 1.0
        potential = energy - np.sum(load * x)
        descent = -np.sum(rest * step)
        norm = np.sum((rest * reach) ** 2)
        accepted = False
        for _ in range(30):
            trial = x + damping * step
            new_energy, total, beyond = evaluate(trial, basis, table, local, push, slope, across)
            new_rest = _unbalanced(trial, load, flat, push)
            if np.sum((new_rest * reach) ** 2) < norm * (1.0 - 1e-4 * damping) or (
                new_energy - np.sum(load * trial) < potential + 1e-4 * damping * descent
            ):
                accepted = True
                break
            damping *= 0.5
        if accepted:
            energy, rest = new_energy, new_rest
            x[:] = trial
        elif exact:
            break
        else:  # an old tangent may mislead; take the exact one here
            energy, total, beyond = evaluate(x, basis, table, local, push, slope, across)
            known = False
    _condense(basis, push, slope, across, room, factor, solved, condensed)
    singular = cholesky_solve(condensed, 0.0, rest[:5].copy(), small, step[:5]) <= 1e-12
    stiffest = np.max(np.diag(condensed))
    settled = residual <= tolerance or (
        residual * max(external, 1e-4 * total) <= 16.0 * _EPS * moved * stiffest
    )
    return settled and not beyond, residual, iterations, singular


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
    room = np.empty((3 * basis.shape[1], size))
    x, load = np.zeros(size), np.zeros(size)
    factor, solved = np.zeros((size - 5, size - 5)), np.zeros((5, size - 5))
    for i in range(n):
        warm = i % chunk > 0 and converged[i - 1] and not singular[i - 1]
        ok, res, count, free = False, 0.0, 0, False
        for attempt in range(9):  # warm, cold, then from 1e6 times the load down
            if attempt == 0 and not warm:
                continue
            if attempt == 0:
                stiffness[i] = stiffness[i - 1]
            if attempt == 1 or attempt == 2:
                x[:] = 0.0
                x[:5] = rigid[i]
            times = 1.0 if attempt < 2 else 10.0 ** (8 - attempt)
            load[:5] = times * loads[i]
            ok, res, more, free = _newton(
                x, load, basis, table, local, reach, cap, tolerance, limit, room,
                factor, solved, stiffness[i], attempt == 0,
            )  # fmt: skip
            count += more
            if ok and (attempt == 1 or (attempt == 0 and not free)):
                break
        states[i] = x
        converged[i], residual[i], iterations[i], singular[i] = ok, res, count, free
    return states, stiffness, converged, residual, iterations, singular


@njit(cache=True, nogil=True, error_model="numpy")
def contact_state(states, basis, table, local):
    """Force and signed angle (from the radial plane) of each contact, (n, contact)."""
    count = basis.shape[1]
    flat = basis.reshape(3 * count, basis.shape[2])
    balls = count // table.shape[0]
    force, angle = np.zeros((len(states), count)), np.zeros((len(states), count))
    push, slope, across = np.zeros((3, count)), np.zeros(count), np.zeros(count)
    for j in range(len(states)):
        evaluate(states[j], basis, table, local, push, slope, across)
        shift = np.dot(flat, states[j]).reshape(3, count)
        for i in range(count):
            line = table[i // balls]
            force[j, i] = math.sqrt(push[0, i] ** 2 + push[1, i] ** 2 + push[2, i] ** 2)
            angle[j, i] = math.atan2(line[NORMAL_Z] + shift[2, i], line[NORMAL_R] + shift[0, i])
    return force, angle
