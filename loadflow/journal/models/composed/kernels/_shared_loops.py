"""Compiled loop of one shaft in two reduced films with effects: a march of both through time.

Four coordinates say where the shaft is in both films, and the four moments of these how it bends
and what it rests on turns. Films, shaft and moments are solved by one Newton iteration, with steps,
factors and limits as in `_loops`.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import LOAD
from loadflow.journal.models._compile import inner, once, outer
from loadflow.journal.models._reduced_loops import SMALLEST, STEP_LIMIT, predict, two_steps
from loadflow.journal.models._ring_kernels import factorise, substitute
from loadflow.journal.models._small_systems import solve_system
from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.kernels._balance_kernels import (
    balance,
    matrix,
    slopes_of_balance,
)
from loadflow.journal.models.composed.kernels._gap_kernels import has_gap, narrowest, place, turn
from loadflow.journal.models.composed.kernels._loops import ALIKE, KEPT, MORE, ROOM, keep
from loadflow.journal.models.composed.kernels._seat_kernels import hold, hold_slopes, slide
from loadflow.journal.models.composed.kernels._shared_pad_kernels import (
    begin_tilts,
    carry_side,
    correct_side,
    give_and_take,
    has_room,
    keep_tilts,
    moments_of_side,
    place_side,
    set_out_side,
    share_of_side,
    shorten_side,
    stop_side,
    summarise_side,
    take_back,
    try_others,
)
from loadflow.journal.models.composed.kernels._shell_step_kernels import NEAR, follow_shell
from loadflow.journal.models.composed.kernels._supply_kernels import (
    answers_of_grooves,
    follow_grooves,
    unfed,
)
from loadflow.journal.models.composed.kernels._touch_kernels import touch
from loadflow.journal.models.composed.shared_sides import COORDINATES, SHAFT
from loadflow.journal.models.slow_heat import lighter, slow_heat
from loadflow.journal.solvers.motion.moving_pads import LATER
from loadflow.numerics.references import refer


@inner
def _lay(side, q, unknowns, n, to):
    """Place `q` (4,) of the shaft in a film by its unknowns, between the times n − 1 and n."""
    for a in range(4):
        last, next_ = side.given[n - 1, a], side.given[n, a]
        q[a] = last + to * (next_ - last) - side.slipped[a]
        for b in range(unknowns.size):
            q[a] += side.lies[a, b] * unknowns[b]


@inner
def _move(side, step, share):
    """Step of a film's place by a share of the shaft's."""
    for a in range(4):
        side.work.step[a] = 0.0
        for b in range(step.size):
            side.work.step[a] += share * side.lies[a, b] * step[b]


@once
def _residual(one, other, shared, speed, rate, scale):
    """Largest residual of both films and of what is missing, which is taken off `missing`."""
    residual, total = 0.0, 0.0
    for k in range(2):
        side = one if k == 0 else other
        film, work = side.film, side.work
        wedge = 0.5 * film.ring.slope * side.thin[0] * speed
        flux = (abs(wedge) + film.ring.scale) * film.nodes.widest
        residual = max(residual, balance(film, work, wedge, side.thin[0] * rate) / flux)
        residual = max(residual, unfed(film, work))
        touch(film, work, side.new)
        if side.stop[1] > 0.0:
            stop_side(side)
        total += moments_of_side(side)
        if not abs(work.load[0]) + abs(work.load[1]) < np.inf:
            return np.inf
        if film.give > 0.0 and not has_gap(film, work):
            return np.inf
        for b in range(SHAFT):
            for a in range(4):
                shared.missing[b] -= side.felt[a, b] * (work.load[a] + work.touch[0, a])
    for b in range(shared.missing.size):
        total += shared.missing[b] ** 2
    return max(residual, np.sqrt(total) / scale)


@once
def _solve(one, other, shared, speed, rate, fresh):
    """Newton step of the shaft into `step`, and of both films into their columns; if there is."""
    system, size, many = shared.system, 4, shared.missing.size
    system[:] = 0.0
    for b in range(many):
        system[b, many] = -shared.missing[b]
    hold_slopes(shared, SHAFT)
    for k in range(2):
        side = one if k == 0 else other
        film, work = side.film, side.work
        columns, wedge = 1, 0.5 * film.ring.slope * side.thin[0] * speed
        if fresh:
            slopes_of_balance(film, work, wedge, side.thin[0] * rate, size)
            matrix(film, work, wedge, side.thin[0] * rate)
            work.kept[0] = 0.0
            if not factorise(work.matrix):
                return False
            work.kept[0], work.kept[1], columns = 1.0, side.thin[0] * rate, 1 + size
            columns = answers_of_grooves(film, work, columns)
        substitute(work.matrix, work.columns, columns)
        follow_shell(film, work, wedge, side.thin[0] * rate, columns, NEAR)
        follow_grooves(film, work, wedge, side.thin[0] * rate, size, fresh)
        carry_side(side)
        for c in range(SHAFT):
            for a in range(size):
                if side.felt[a, c] == 0.0:
                    continue
                system[c, many] -= side.felt[a, c] * work.carried[0, a]
                for b in range(size):
                    slope = work.carried[1 + b, a] - work.touch[1 + a, b]
                    for d in range(many):
                        system[c, d] += side.felt[a, c] * slope * side.lies[b, d]
    if not solve_system(system, many):
        return False
    for b in range(many):
        shared.step[b] = system[b, many]
    return True


@once
def _shortened(one, other, shared):
    """Shorten the `step` until films keep part of their gap, and change by their own pressure."""
    share = 1.0
    for k in range(2):
        side = one if k == 0 else other
        film, work = side.film, side.work
        change, peak = 0.0, film.ring.scale
        for i in range(film.ring.cos.size):
            for j in range(film.nodes.slopes.shape[1]):
                change = max(change, abs(work.columns[0, i, j]))
                peak = max(peak, work.state[LOAD, i, j])
        share = min(share, peak * STEP_LIMIT / max(change, 1e-300))
    left = 1.0
    for k in range(2):
        side = one if k == 0 else other
        _move(side, shared.step, share)
        left = min(left, share_of_side(side, share))
    for b in range(shared.step.size):
        shared.step[b] *= share * left
    shorten_side(one, left)
    shorten_side(other, left)


@once
def _advance(one, other, shared):
    """Move films and shaft by the Newton step, or by the share of it that leaves elastic films."""
    share, done = 1.0, 0.0
    for k in range(2):
        side = one if k == 0 else other
        work = side.work
        gap = narrowest(side.film, work)
        work.step[0] = max(
            gap - (1.0 - KEPT) * max(gap, side.film.rough.size), -side.film.rough.deepest
        )
        for i in range(work.u.shape[0]):
            for j in range(work.u.shape[1]):
                work.trial[i, j] = work.u[i, j]
    least_one, least_other = one.work.step[0], other.work.step[0]
    while True:
        open_yet = True
        for k in range(2):
            side = one if k == 0 else other
            film, work = side.film, side.work
            _move(side, shared.step, 1.0)
            correct_side(side, share, done)
            for a in range(4):
                side.new[a] += (share - done) * work.step[a]
            place_side(side)
            if film.give > 0.0:
                least = least_one if k == 0 else least_other
                open_yet = open_yet and narrowest(film, work) >= least
        for b in range(shared.new.size):
            shared.new[b] += (share - done) * shared.step[b]
        done = share
        if open_yet or share < ROOM:
            return
        share *= 0.5


@inner
def _is_open(side):
    """Whether a shaped bore does not close between two places of the cells."""
    return not side.film.ring.shaped or has_gap(side.film, side.work)


@once
def _newton(one, other, shared, n, to, speed, rate, tolerance, max_iterations):
    """Films and shaft that carry the load between two times; residual, steps, whether it is small.

    Starts from the unknowns of both films and `new`.
    """
    total = 0.0
    for k in range(2):
        side = one if k == 0 else other
        for a in range(4):
            side.work.step[a] = 0.0
        thin = side.thin[0]
        turn(side.film, side.work, thin * speed, side.thin[1] / (thin * thin))
        place_side(side)
    for b in range(COORDINATES):
        total += (shared.load[n - 1, b] + to * (shared.load[n, b] - shared.load[n - 1, b])) ** 2
    scale = max(np.sqrt(total), 0.5e-3 * one.film.ring.scale * one.film.ring.area)
    spent, last = 0, np.inf
    while True:
        for b in range(COORDINATES):
            shared.missing[b] = shared.load[n - 1, b]
            shared.missing[b] += to * (shared.load[n, b] - shared.load[n - 1, b])
        for b in range(COORDINATES, SHAFT):
            shared.missing[b] = shared.new[b]
        hold(shared, SHAFT, n, to)
        residual = _residual(one, other, shared, speed, rate, scale)
        if residual < tolerance:
            return residual, spent, _is_open(one) and _is_open(other)
        if spent == max_iterations or not residual < np.inf:
            return residual, spent, False
        kept = one.work.kept[0] > 0.0 and other.work.kept[0] > 0.0
        fresh = not (kept and residual * (residual / last) ** MORE < tolerance)
        spent, last = spent + 1, residual
        if not _solve(one, other, shared, speed, rate, fresh):
            return residual, spent, False
        _shortened(one, other, shared)
        _advance(one, other, shared)


@once
def _set_out(one, other, begin):
    """Make both films those of the last time; from the third time on, others before them, too."""
    for k in range(2):
        side = one if k == 0 else other
        film, work = side.film, side.work
        for a in range(2 if begin > 1 else 1):
            first = begin > 1 and a == 0
            for i in range(work.u.shape[0]):
                for m in range(work.u.shape[1]):
                    if first:
                        work.trial[i, m], work.u[i, m] = work.last[i, m], work.before[i, m]
                    elif begin > 1:
                        work.u[i, m] = work.trial[i, m]
            for b in range(2):
                work.bend[b] = side.past[4 + b] if first else side.past[6 + b]
            for b in range(4):
                side.new[b] = side.past[b] if first else side.place[b]
            place(film, work, side.new)
            keep(work)
        set_out_side(side, begin > 1)


@outer
def follow(first, second, shared, begin, time, speed, tolerance, max_iterations):
    """Steps of both films and of the shaft through all times; returns how many times are done.

    They go on from `begin`: from films at rest at the first time, or from those that are there.
    Steps are those of `_loops.solve`: of second order, cut where Newton fails.
    """
    one, other, shared = refer(first), refer(second), refer(shared)
    _set_out(one, other, begin)
    step_before = shared.steps[0] if begin > 1 else 0.0
    for n in range(begin, time.size):
        whole = time[n] - time[n - 1]
        share, done, spent, tried = 1.0, 0.0, 0, False
        for k in range(2):
            side = one if k == 0 else other
            if side.warmth.on:
                side.thin[0] = slow_heat(
                    side.warmth, side.states, n, whole, speed, side.rows, at.DISSIPATION, at.NORMAL
                )
                side.thin[1] = lighter(side.warmth, side.states, n)
        while done < 1.0:
            to = 1.0 if done + 1.01 * share > 1.0 else done + share
            step = (to - done) * whole
            rate, weight, weight_before, ratio = two_steps(step, step_before)
            omega = speed[n - 1] + to * (speed[n] - speed[n - 1])
            ahead = begun = step_before > 0.0
            if not tried:
                turns = speed[n - 1] + done * (speed[n] - speed[n - 1])
                give_and_take(one, turns, begun)
                give_and_take(other, turns, begun)
            for b in range(shared.new.size):
                shared.new[b] = shared.at[b]
                if ahead:
                    shared.new[b] += ratio * (shared.at[b] - shared.before[b])
            for k in range(2):
                side = one if k == 0 else other
                work = side.work
                _lay(side, side.new, shared.new, n, to)
                for a in range(2):
                    work.bend[a] = side.bend[n - 1, a]
                    work.bend[a] += to * (side.bend[n, a] - side.bend[n - 1, a])
                ahead = ahead and has_room(side, ratio)
            if not ahead:
                for b in range(shared.new.size):
                    shared.new[b] = shared.at[b]
            for k in range(2):
                side = one if k == 0 else other
                work = side.work
                _lay(side, side.new, shared.new, n, to)
                thin = side.thin[0]
                begin_tilts(side, ratio, ahead)
                predict(work, ratio, ahead, thin * weight, thin * weight_before)
                if not ahead or abs(thin * rate - work.kept[1]) > ALIKE * work.kept[1]:
                    work.kept[0] = 0.0
            residual, iterations, converged = _newton(
                one, other, shared, n, to, omega, rate, tolerance, max_iterations
            )
            spent += iterations
            shared.told[0], shared.told[1] = residual, iterations
            if converged:
                for k in range(2):
                    side = one if k == 0 else other
                    keep(side.work)
                    keep_tilts(side)
                    for a in range(4):
                        side.past[a], side.place[a] = side.place[a], side.new[a]
                    for a in range(2):
                        side.past[4 + a], side.past[6 + a] = side.past[6 + a], side.work.bend[a]
                slide(one, other, shared, SHAFT)
                for b in range(shared.new.size):
                    shared.before[b], shared.at[b] = shared.at[b], shared.new[b]
                step_before, share, done, tried = step, min(2.0 * share, 1.0), to, False
                shared.steps[0] = step
                continue
            one.work.kept[0], other.work.kept[0] = 0.0, 0.0
            if not tried and share <= LATER:
                tried = try_others(one, omega, begun)
                tried = try_others(other, omega, begun) or tried
                if tried:
                    continue
            if share <= SMALLEST:
                return n
            share *= 0.5
            take_back(one, tried, begun)
            take_back(other, tried, begun)
            tried = False
        for k in range(2):
            side = one if k == 0 else other
            wedge = 0.5 * side.film.ring.slope * side.thin[0] * omega
            rate_k = side.thin[0] * rate
            summarise_side(side, wedge, rate_k, n)
            side.rows[n, at.RESIDUAL] = residual
            side.rows[n, at.ITERATIONS] = spent
            side.rows[n, at.CONVERGED] = 1.0
    return time.size
