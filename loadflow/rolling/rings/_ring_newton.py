"""Compiled Newton iteration of the equilibrium with flexible rings, over series of cases.

Words and arrays are those of `loadflow.rolling.rings._ring_kernels`.
"""

from __future__ import annotations

import math

import numpy as np
from numba import typeof

from loadflow.numerics.entries import Entry, enter
from loadflow.numerics.linked import LINKED, bare, njit
from loadflow.rolling._kernels import cholesky_solve, is_small, rounding_level, stalled
from loadflow.rolling._kernels import solve_series as rigid_series
from loadflow.rolling.contacts import POINT
from loadflow.rolling.rings._ring_factor import backward, forward
from loadflow.rolling.rings._ring_kernels import (
    dot,
    evaluate,
    forces,
    largest_product,
    mix,
    shift_of,
)
from loadflow.rolling.rings._ring_rooms import (
    SMALL_ROOMS,
    newton_room,
    square_room,
    tangent_room,
    wave_room,
)
from loadflow.rolling.rings._ring_tangent import condense

# Steps with a kept tangent that cost about as much as a new one; steps of lines have many slices.
_PATIENCE_POINTS, _PATIENCE_LINES = 5.0, 4.0
_PAIRS = 8  # steps remembered


@njit(nogil=True, error_model="numpy", **LINKED)
def _free(basis, push, slope, across):
    """Whether the contacts leave a motion without resistance.

    Such a motion leaves the modes at rest, so that the tangent is singular where its rigid part
    alone is. What contacts resist along their forces nearly always decides, mostly that of each
    eighth of them; else all of it does.
    """
    balls, rigid, line = push.shape[1], np.zeros((5, 5)), np.zeros(5)
    rest, step, small = np.zeros(5), np.zeros(5), np.zeros((5, 5))
    for attempt in range(3):
        rigid[:, :] = 0.0
        whole = attempt == 2
        for i in range(0, basis.shape[1], 8 if attempt == 0 else 1):
            k, j = i // balls, i % balls
            if slope[k, j] == 0.0:
                continue
            pr, pt, pz = push[3 * k, j], push[3 * k + 1, j], push[3 * k + 2, j]
            side = across[k, j] if whole else 0.0
            weight = (slope[k, j] - side) / (pr * pr + pt * pt + pz * pz)
            gr, gt, gz = basis[0, i], basis[1, i], basis[2, i]
            for a in range(5):
                line[a] = pr * gr[a] + pt * gt[a] + pz * gz[a]
                for b in range(a + 1):
                    rigid[a, b] += weight * line[a] * line[b]
            if whole:
                for a in range(5):
                    for b in range(a + 1):
                        rigid[a, b] += side * (gr[a] * gr[b] + gt[a] * gt[b] + gz[a] * gz[b])
        if cholesky_solve(rigid, 0.0, rest, small, step) > (1e-6 if attempt == 0 else 1e-12):
            return False
    return True


@njit(nogil=True, error_model="numpy", **LINKED)
def _free_lines(basis, slope, across, slant):
    """Whether line contacts leave a motion without resistance."""
    rigid, rest, step, small = np.zeros((5, 5)), np.zeros(5), np.zeros(5), np.zeros((5, 5))
    for i in range(basis.shape[1]):
        k, j = i // slope.shape[1], i % slope.shape[1]
        middle, turn = basis[0, i], basis[1, i]
        for a in range(5):
            along = middle[a] + slant[k, j] * turn[a]
            for b in range(a + 1):
                rigid[a, b] += slope[k, j] * along * (middle[b] + slant[k, j] * turn[b])
                rigid[a, b] += across[k, j] * turn[a] * turn[b]
    return cholesky_solve(rigid, 0.0, rest, small, step) <= 1e-12


@bare(**LINKED)
def _direction(rest, order, factor, condensed, cap, small, rhs, column, step):
    """Fill `step` by Newton's, with a Levenberg shift where the rigid part is singular.

    Returns the largest diagonal term and the smallest pivot of the rigid part.
    """
    count = step.shape[0] - 5
    largest = norm = 0.0
    for b in range(order.shape[0]):
        column[b] = rest[order[b]]
    forward(factor, count, column)
    for a in range(5):
        rhs[a] = column[count + a]
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
    for a in range(5):
        column[count + a] = step[a]
    backward(factor, count, column)
    for b in range(count):
        step[order[b]] = column[b]
    return largest, pivot


@bare(**LINKED)
def _secant(
    rest, order, factor, condensed, cap, small, moves, changes, held, rhs, column, part, right, step
):
    """Fill `step` by the kept tangent, put right by the last `held` steps (limited-memory BFGS).

    `moves` and the `changes` of force along them (pair, unknown), the oldest first; `rhs`,
    `column`, `part` and `right` are room.
    """
    for a in range(rest.shape[0]):
        right[a] = rest[a]
    for p in range(held - 1, -1, -1):
        part[p] = dot(moves[p], right) / dot(moves[p], changes[p])
        for a in range(right.shape[0]):
            right[a] -= part[p] * changes[p, a]
    _direction(right, order, factor, condensed, cap, small, rhs, column, step)
    for p in range(held):
        more = part[p] - dot(changes[p], step) / dot(moves[p], changes[p])
        for a in range(right.shape[0]):
            step[a] += more * moves[p, a]


@bare(**LINKED)
def _remember(moves, changes, held):
    """Drop the oldest pair if there is no room; returns the place of the next one."""
    if held < moves.shape[0]:
        return held
    for p in range(held - 1):
        for a in range(moves.shape[1]):
            moves[p, a], changes[p, a] = moves[p + 1, a], changes[p + 1, a]
    return held - 1


@njit(nogil=True, error_model="numpy", **LINKED)
def _newton(
    x, load, waves, basis, law, reach, cap, tolerance, limit, factor, condensed,
    moves, changes, held, known, rooms, told,
):  # fmt: skip
    """Minimise energy - load·x from `x`.

    Fills `told` (6,): converged, residual, iterations, singular, the rounding level of the
    residual, which is formed only where that is not within its tolerance, and the pairs held.
    By itself, called by its place in memory: two processes can compile it and the series at once.

    Newton with the exact tangent, which is kept as long as it leads to the tolerance within few
    steps (`known` says whether a tangent from near `x` is there to begin with), a cap on the step
    of the contacts, and halving until energy or residual falls.
    """
    size = x.shape[0]
    room, space = rooms[0], rooms[1]
    small, rhs, one, pull, rest, right, step, trial, column, part = rooms[2][:10]
    shift, far, between, push, full, slope, across, slant = rooms[2][10:]
    for a in range(size):
        trial[a] = x[a]
    shift_of(x, waves, room, between)
    external = largest_product(load, one)
    iterations, residual, moved, norm, energy = 0, 0.0, 0.0, 0.0, 0.0
    damping, exact, fresh, beyond = 1.0, False, True, False
    patience = _PATIENCE_POINTS if law.power == POINT else _PATIENCE_LINES
    potential, descent, halvings = 0.0, 0.0, 0
    while True:
        energy, total, beyond = forces(
            trial, between, waves, law, room, full, push, slope, across, slant, pull
        )
        new_norm = 0.0
        for a in range(size):
            new_norm += ((load[a] - pull[a]) * reach[a]) ** 2
        # accept where residual or potential falls, or at the very start
        if fresh or new_norm < norm * (1.0 - 1e-4 * damping) or (
            energy - dot(load, trial) < potential + 1e-4 * damping * descent
        ):  # fmt: skip
            if not fresh:
                held = _remember(moves, changes, held)
            for a in range(size):
                if not fresh:
                    moves[held, a] = trial[a] - x[a]
                    changes[held, a] = rest[a] - (load[a] - pull[a])
                x[a] = trial[a]
                rest[a] = load[a] - pull[a]
            if not fresh and dot(moves[held], changes[held]) > 0.0:
                held += 1
            shift, between = between, shift
            norm, before = new_norm, residual
            reference = max(external, 1e-4 * total)
            residual = largest_product(rest, reach)
            residual = residual / reference if reference > 0.0 else 0.0
            moved = largest_product(x[:5], one)
            slow = not fresh and residual * (residual / before) ** patience > tolerance
            fresh = False
            if residual <= tolerance or iterations == limit:
                break
            exact = not known or slow
        elif halvings < 30:
            halvings += 1
            damping *= 0.5
            _between(x, step, shift, far, damping, trial, between)
            continue
        elif exact:
            break
        else:  # an old tangent misled: go back and take the exact one
            _between(x, step, shift, far, 0.0, trial, between)
            known, fresh, halvings = False, True, 0
            continue
        if exact:
            condense(waves, law.power, push, slope, across, slant, space, factor, condensed)
            known, held = True, 0
        _secant(
            rest, waves.order, factor, condensed, cap, small, moves, changes, held, rhs, column,
            part, right, step,
        )  # fmt: skip
        iterations += 1
        shift_of(step, waves, room, far)
        longest = _longest(far, waves.mixing, 0.0 if exact else cap, room.line, full)
        if exact and stalled(max(longest, largest_product(step[:5], one)), rounding_level(moved)):
            break
        damping = min(1.0, cap / longest) if longest > 0.0 else 1.0
        potential, descent, halvings = energy - dot(load, x), -dot(rest, step), 0
        _between(x, step, shift, far, damping, trial, between)
    rounding = 0.0
    if residual > tolerance:
        forces(x, shift, waves, law, room, full, push, slope, across, slant, pull)
        condense(waves, law.power, push, slope, across, slant, space, factor, condensed)
        stiffest, _ = _direction(
            rest, waves.order, factor, condensed, cap, small, rhs, column, step
        )
        rounding = rounding_level(moved * stiffest) / max(external, 1e-4 * total, 1e-300)
    answered = is_small(residual, tolerance, rounding) and not beyond
    if basis.shape[0] == 3:
        singular = _free(basis, push, slope, across)
    else:
        singular = _free_lines(basis, slope, across, slant)
    told[0], told[1], told[2] = answered, residual, iterations
    told[3], told[4], told[5] = singular, rounding, held


def newton_entry(waves, basis, law, reach):
    """`_newton` for the rings of a bearing, as `solve_series` calls it."""
    one, two, number, count = np.zeros(1), np.zeros((1, 1)), 0.0, 0
    given = (
        one, one, waves, basis, law, reach, number, number, count, two, two, two, two, count, True,
        SMALL_ROOMS, one,
    )  # fmt: skip
    return Entry(_newton, tuple(typeof(value) for value in given))


@bare(forceinline=True, fastmath={"reassoc", "nsz", "nnan"})
def _largest(line):
    most = 0.0
    for j in range(line.shape[0]):
        most = max(most, abs(line[j]))
    return most


@bare(**LINKED)
def _longest(far, mixing, cap, most, full):
    """Largest shift of a contact; a bound on it where that is within `cap` and says enough."""
    bound = 0.0
    for f in range(far.shape[0]):
        most[f] = _largest(far[f])
    for s in range(mixing.shape[0]):
        total = 0.0
        for f in range(far.shape[0]):
            total += abs(mixing[s, f]) * most[f]
        bound = max(bound, total)
    if bound <= cap:
        return bound
    bound = 0.0
    mix(mixing, far, full)
    for s in range(full.shape[0]):
        bound = max(bound, _largest(full[s]))
    return bound


@bare(**LINKED)
def _between(x, step, shift, far, damping, trial, between):
    """Fill the state and the shift of the contacts part of a step away."""
    for a in range(x.shape[0]):
        trial[a] = x[a] + damping * step[a]
    for s in range(shift.shape[0]):
        for j in range(shift.shape[1]):
            between[s, j] = shift[s, j] + damping * far[s, j]


@bare(**LINKED)
def _predict(loads, states, i, past, x):
    """Fill `x` with where case `i` may lie: as the case before, or in line with `past` ones.

    The extrapolation through one, two or three cases is taken that would have told the load best;
    in a series without order that is the case before.
    """
    best, order = np.inf, 1
    for k in range(1, min(past, 3) + 1):
        gap = 0.0
        for a in range(5):
            told = loads[i - 1, a]
            if k == 2:
                told += loads[i - 1, a] - loads[i - 2, a]
            elif k == 3:
                told += 2.0 * loads[i - 1, a] - 3.0 * loads[i - 2, a] + loads[i - 3, a]
            gap += (loads[i, a] - told) ** 2
        if gap < 0.5 * best:
            best, order = gap, k
    for a in range(x.shape[0]):
        x[a] = states[i - 1, a]
        if order == 2:
            x[a] += states[i - 1, a] - states[i - 2, a]
        elif order == 3:
            x[a] += 2.0 * states[i - 1, a] - 3.0 * states[i - 2, a] + states[i - 3, a]


@njit(cache=True, nogil=True, error_model="numpy")
def solve_series(newton, loads, rigid, waves, basis, law, reach, cap, tolerance, limit, chunk):
    """Equilibrium for each load (n, 5) of lengths; warm start inside chunks of `chunk` cases.

    `newton` is the `Entry` of `_newton`, see `newton_entry`.

    `rigid` holds what `loadflow.rolling._kernels.solve_series` takes beside the load, and the
    scale of the rigid unknowns: a cold start goes from the equilibrium with rigid rings. A case
    that fails or is singular from a warm start is solved again from a cold one; what then still
    fails is reached from a larger load in steps.
    """
    arguments, scale = rigid
    n, size = loads.shape[0], basis.shape[2]
    states = np.zeros((n, size))
    residual, iterations = np.zeros(n), np.zeros(n, np.int64)
    converged, singular = np.zeros(n, np.bool_), np.zeros(n, np.bool_)
    rounding = np.zeros(n)
    x, load, condensed = np.zeros(size), np.zeros(5), np.zeros((5, 5))
    whole, lying, told = np.zeros(size), np.zeros(5), np.zeros(6)
    factor = square_room(size)
    moves, changes = np.zeros((_PAIRS, size)), np.zeros((_PAIRS, size))
    kinds = waves.mixing.shape[0] // basis.shape[0]
    rooms = wave_room(waves), tangent_room(waves), newton_room(waves, kinds, size, _PAIRS)
    held = np.int64(0)  # a literal 0 would have the whole iteration compiled a second time
    past = 0  # cases before this one, one after the other, that are solved
    for i in range(n):
        past = past + 1 if i % chunk > 0 and converged[i - 1] and not singular[i - 1] else 0
        ok, res, count, free = False, 0.0, 0, False
        for attempt in range(9):  # warm, cold, then from 1e6 times the load down
            if attempt == 0 and past == 0:
                continue
            times = 1.0 if attempt < 2 else 10.0 ** (8 - attempt)
            for a in range(5):
                whole[a] = times * loads[i, a]
            if attempt == 0:
                _predict(loads, states, i, past, x)
            elif attempt == 1:
                for a in range(5):
                    load[a] = loads[i, a] / scale[a]
                found = rigid_series(load.reshape((1, 5)), *arguments)[0]
                for a in range(5):
                    lying[a] = found[0, a]
            if attempt == 1 or attempt == 2:
                for a in range(size):
                    x[a] = lying[a] / scale[a] if a < 5 else 0.0
            enter(newton, (
                x, whole, waves, basis, law, reach, cap, tolerance, limit, factor,
                condensed, moves, changes, held, attempt == 0, rooms, told,
            ))  # fmt: skip
            ok, res, free, rounding[i] = told[0] > 0.0, told[1], told[3] > 0.0, told[4]
            count, held = count + int(told[2]), int(told[5])
            if ok and (attempt == 1 or (attempt == 0 and not free)):
                break
        for a in range(size):
            states[i, a] = x[a]
        converged[i], residual[i], iterations[i], singular[i] = ok, res, count, free
    return states, converged, residual, iterations, singular, rounding


@njit(cache=True, nogil=True, error_model="numpy")
def stiffness_series(states, waves, law):
    """Tangent (n, 5, 5) of the rigid unknowns, modes eliminated, in each state."""
    n, space, factor = states.shape[0], tangent_room(waves), square_room(states.shape[1])
    stiffness = np.zeros((n, 5, 5))
    for i in range(n):
        _, push, slope, across, slant, _ = evaluate(states[i], waves, law)
        condense(waves, law.power, push, slope, across, slant, space, factor, stiffness[i])
    return stiffness
