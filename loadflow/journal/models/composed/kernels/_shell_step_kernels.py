"""Compiled linear systems of a reduced film in a shell that gives way all over.

The factors of a film know what a shell owes to the pressure of a place itself. With the growth of
the gap by its modes, Φ, their amplitudes by the pressure, P, and the change of the balance by the
growth, J, a step x is that of ``(A + J Φ P) x = b``. Their amplitudes a = P x follow from
``(1 + P A⁻¹ J Φ) a = P A⁻¹ b`` by GMRES [Saad and Schultz 1986]: it takes few steps where the shell
is stiffer than the film, and no more than there are modes. Where asperities touch, P is that of
`_shell_rub_kernels`.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import FILL, P
from loadflow.journal.models._compile import inner, once
from loadflow.journal.models._ring_kernels import substitute
from loadflow.journal.models.composed.kernels._gap_kernels import DRAG_SLOPE, FLOW_SLOPE, OPEN
from loadflow.journal.models.composed.kernels._of_effects import of_shell
from loadflow.journal.models.composed.kernels._shell_growth_kernels import load_of, open_by, respond
from loadflow.numerics.lanes import LANES, put, spread, take

NEAR = 1e-4  # of the amplitudes of a Newton step, what GMRES may leave
EXACT = 1e-10  # the same of slopes that are told


@of_shell(lambda film, work, wedge, rate, count, left: None)
def follow_shell(film, work, wedge, rate, count, left):
    """Let the first `count` columns know what a pressure opens elsewhere, after `substitute`."""
    _follow(film, work, wedge, rate, count, left)


@inner
def _follow(film, work, wedge, rate, count, left):
    """The same: a function by itself, which is called in several places."""
    modes, block = work.modes, work.u.size
    for column in range(count):
        load_of(work, work.columns, column * block)
        respond(film, work, modes.basis[0])
        _krylov(film, work, wedge, rate, left)
        _answer(film, work, wedge, rate, modes.other)
        for here in range(0, block, LANES):
            own = take(work.columns, column * block + here)
            put(work.columns, column * block + here, own - take(modes.column, here))


@of_shell(lambda film, work, wedge, rate, size: None)
def follow_place(film, work, wedge, rate, size):
    """Let `size` columns know how asperities take a shell with the shaft, before `substitute`."""
    rub, block = work.modes.rub, work.u.size
    if rub.on[0] > 0.0:
        for a in range(size):
            open_by(film, rub.by_place[a], work.modes.change)
            _by_growth(film, work, wedge, rate)
            for here in range(0, block, LANES):
                own = take(work.columns, (1 + a) * block + here)
                put(work.columns, (1 + a) * block + here, own + take(work.modes.column, here))


@inner
def _answer(film, work, wedge, rate, amplitude):
    """What the factors make of a growth of the gap by amplitudes of the modes, into `column`."""
    open_by(film, amplitude, work.modes.change)
    _by_growth(film, work, wedge, rate)
    substitute(work.matrix, work.modes.column, 1)


@once
def _krylov(film, work, wedge, rate, left):
    """Amplitudes, into `other`, from those without them, `basis[0]`, but for a share `left`."""
    modes = work.modes
    basis, system, turns, right = modes.basis, modes.system, modes.turns, modes.right
    size, most, steps = basis.shape[1], system.shape[1], 0
    total = 0.0
    for j in range(size):
        total += basis[0, j] * basis[0, j]
    first = np.sqrt(total)
    right[0] = first
    for j in range(size):
        basis[0, j] *= 1.0 / max(first, 1e-300)
        modes.other[j] = 0.0
    while steps < most and abs(right[steps]) > left * first:
        n = steps
        _answer(film, work, wedge, rate, basis[n])
        load_of(work, modes.column, 0)
        respond(film, work, basis[n + 1])
        for j in range(size):
            basis[n + 1, j] += basis[n, j]
        for k in range(n + 1):
            total = 0.0
            for j in range(size):
                total += basis[k, j] * basis[n + 1, j]
            system[k, n] = total
            for j in range(size):
                basis[n + 1, j] -= total * basis[k, j]
        total = 0.0
        for j in range(size):
            total += basis[n + 1, j] * basis[n + 1, j]
        length = np.sqrt(total)
        for j in range(size):
            basis[n + 1, j] *= 1.0 / max(length, 1e-300)
        for k in range(n):
            above, below = system[k, n], system[k + 1, n]
            system[k, n] = turns[0, k] * above + turns[1, k] * below
            system[k + 1, n] = turns[0, k] * below - turns[1, k] * above
        both = max(np.hypot(system[n, n], length), 1e-300)
        turns[0, n], turns[1, n] = system[n, n] / both, length / both
        system[n, n] = both
        right[n + 1] = -turns[1, n] * right[n]
        right[n] *= turns[0, n]
        steps += 1
    for k in range(steps - 1, -1, -1):
        total = right[k]
        for n in range(k + 1, steps):
            total -= system[k, n] * right[n]
        right[k] = total / system[k, k]
        for j in range(size):
            modes.other[j] += right[k] * basis[k, j]


@inner
def _by_growth(film, work, wedge, rate):
    """Change of the residual by a growth of the gap, `change`, clearances, into `column`."""
    nx, wide = work.u.shape
    lanes, ring, weights = film.lanes, film.ring, film.nodes.weights
    points, modes = film.nodes.z.size, work.modes
    growth, column, by_gap = modes.change, modes.column, work.row[0]
    p, fill, opens = work.state[P], work.state[FILL], work.gap[OPEN]
    flows, drags = work.face[FLOW_SLOPE], work.face[DRAG_SLOPE]
    up, up_right = max(wedge, 0.0), min(wedge, 0.0)
    for i in range(nx):
        here = i * wide
        across = 0.0 if ring.groove[i] else ring.width[i]
        for at in range(0, wide, LANES):
            wider = take(work.slope, here + at) * take(work.gap_slope, here + at)
            put(by_gap, at, wider * take(growth, here + at) * across)
        for at in range(0, wide, LANES):
            held = take(fill, here + at) * take(opens, here + at) * take(growth, here + at)
            left = held * take(lanes.weights, at) * (ring.slope * ring.width[i] * rate)
            for k in range(points):
                left = left + take(lanes.shares, k * wide + at) * (weights[k] * by_gap[k])
            put(column, here + at, left)
    for at in range(0, wide, LANES):
        own, before = take(lanes.weights, at), spread(0.0)
        for i in range(-1, nx):  # the face behind cell i, and before the next one
            here = (i if i >= 0 else nx - 1) * wide + at
            right = (i + 1 if i + 1 < nx else 0) * wide + at
            rise = (take(p, right) - take(p, here)) * (1.0 / ring.apart[i])
            drag = take(fill, here) * up + take(fill, right) * up_right
            after = (drag * take(drags, here) - take(flows, here) * rise) * own
            after = after * (take(growth, here) + take(growth, right)) * 0.5
            if i >= 0:
                put(column, here, take(column, here) + after - before)
            before = after
    m = film.nodes.slopes.shape[1]
    for i in range(nx):
        for k in range(wide):
            held_here = ring.groove[i] or k >= m
            if not held_here and film.held.on:
                held_here = film.held.grooves[i, k] >= 0
            if held_here:
                column[0, i, k] = 0.0
