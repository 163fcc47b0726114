"""Compiled loops of the reduced film with effects: Newton, and a march through time.

They are those of `_reduced_loops` for a gap that changes across the width, for asperities and for a
shell that gives way; a shaft under a moment has four degrees of freedom.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import FILL, FILLS, LOAD
from loadflow.journal.models._compile import inner, once, outer
from loadflow.journal.models._reduced_loops import (
    COARSEST,
    FINEST,
    LATE,
    SAFETY,
    SMALLEST,
    STEP_LIMIT,
    is_small,
    predict,
    rounding_level,
    shift,
    two_steps,
)
from loadflow.journal.models._ring_kernels import factorise, substitute
from loadflow.journal.models._small_systems import solve_system
from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.kernels._balance_kernels import (
    balance,
    carry,
    magnitudes,
    matrix,
    slopes_of_balance,
)
from loadflow.journal.models.composed.kernels._gap_kernels import (
    MEAN,
    OPEN,
    has_gap,
    narrowest,
    place,
    share_of_step,
    turn,
)
from loadflow.journal.models.composed.kernels._integral_kernels import summarise
from loadflow.journal.models.composed.kernels._shell_growth_kernels import follow_by
from loadflow.journal.models.composed.kernels._shell_step_kernels import EXACT, NEAR, follow_shell
from loadflow.journal.models.composed.kernels._step_kernels import lay_at, leaves_room, longer_step
from loadflow.journal.models.composed.kernels._supply_kernels import (
    FRESH,
    answers_of_grooves,
    displaced_by,
    follow_grooves,
    unfed,
)
from loadflow.journal.models.composed.kernels._thickening_kernels import share_of_rise
from loadflow.journal.models.composed.kernels._touch_kernels import touch
from loadflow.journal.models.slow_heat import THIN, lighter, slow_heat
from loadflow.numerics.lanes import LANES, larger, magnitude, put, spread, take
from loadflow.numerics.references import refer

KEPT = 0.3  # share of the narrowest gap that a step of the shaft leaves
ROOM = 1.0 / 2**20  # share of a step below which an elastic shell has no room for it
MORE = 2  # Newton steps on factors that are there which cost less than one on new factors
WAITS = 100.0  # flows that a point lacks, above which the shaft waits for a rupture with a kink
ALIKE = 0.1  # difference of two rates of which one goes with the factors of the other


@once
def _limited(film, work, q, step):
    """Turn a `step` (4,) from `q` into one of which every place keeps a third of its gap.

    An aligned, eccentric shaft goes along the gap, not along the chord.
    """
    if film.ring.shaped:
        share = share_of_step(film, work, step[0], step[1], step[2], step[3], KEPT)
        for k in range(4):
            step[k] *= share
        return
    x, y = q[0], q[1]
    ratio = np.hypot(x, y)
    if ratio >= 0.5 and step[2] == 0.0 and step[3] == 0.0:
        radial = (x * step[0] + y * step[1]) / ratio
        turn = np.arctan2(y, x)
        turn += max(-0.5, min(0.5, (x * step[1] - y * step[0]) / ratio**2))
        length = max(0.3, min(_farthest(film, ratio, 0.0), ratio + radial))
        dx, dy = length * np.cos(turn) - x, length * np.sin(turn) - y
        inside = True
        for k in range(film.places.z.size):
            ex, ey = work.centre[0, k], work.centre[1, k]
            limit = _farthest(film, np.hypot(ex, ey), film.places.depth[k])
            inside = inside and np.hypot(ex + dx, ey + dy) <= limit * (1.0 + 1e-12)
        if inside:
            step[0], step[1] = dx, dy
            return
    share = share_inside(film, work, step)
    for k in range(4):
        step[k] *= share


@once
def share_inside(film, work, step):
    """Share of a `step` (4,) of which every place of a cylindrical bore keeps part of its gap."""
    share = 1.0
    for k in range(film.places.z.size):
        ex, ey, z = work.centre[0, k], work.centre[1, k], film.places.z[k]
        dx, dy = step[0] + step[3] * z, step[1] - step[2] * z
        limit = _farthest(film, np.hypot(ex, ey), film.places.depth[k])
        square = dx * dx + dy * dy
        if np.hypot(ex + share * dx, ey + share * dy) > limit and square > 0.0:
            along = ex * dx + ey * dy
            room = max(limit * limit - ex * ex - ey * ey, 0.0)
            share = min(share, (np.sqrt(along * along + square * room) - along) / square)
    return share


@inner
def _farthest(film, ratio, depth):
    """Eccentricity ratio up to which a step may lead from `ratio` in a bore `depth` wider."""
    gap, rough = 1.0 + depth - ratio, film.rough
    return ratio + max(min((1.0 - KEPT) * max(gap, rough.size), gap + rough.deepest), 0.0)


@once
def _shaft_step(film, work, load, size, step):
    """Fill the Newton `step` (4,) of a shaft that is to carry `load` (4,), as long as it may be."""
    carry(film, work, size)
    for a in range(size):
        work.system[a, size] = -(load[a] - work.load[a] - work.touch[0, a] + work.carried[0, a])
        for b in range(size):
            work.system[a, b] = work.carried[1 + b, a] - work.touch[1 + a, b]
    if not solve_system(work.system, size):
        return
    change, peak, loads = 0.0, film.ring.scale, work.state[LOAD]
    wide = work.u.shape[1]
    for first in range(0, wide, LANES):
        most, highest, unknown = spread(0.0), spread(peak), take(film.lanes.inner, first)
        for here in range(first, work.u.size, wide):
            most = larger(most, magnitude(take(work.columns, here)))
            highest = larger(highest, take(loads, here) * unknown)
        put(work.row, 0, most)
        put(work.row, wide, highest)
        for k in range(LANES):
            change, peak = max(change, work.row[0, k]), max(peak, work.row[1, k])
    excess = max(1.0, change / (peak * STEP_LIMIT))
    for a in range(size):
        step[a] = work.system[a, size] / excess


@inner
def correct(film, work, step, size, share):
    """Unknowns after a share of a Newton step from `work.trial`.

    What a point takes that fills is no pressure (`FILLS`), and would press a shell open.
    """
    block, kink = work.u.size, film.ring.kink
    for here in range(0, block, LANES):
        change = take(work.columns, here)
        for a in range(size):
            change = change + take(work.columns, (1 + a) * block + here) * step[a]
        put(work.u, here, take(work.trial, here) - change * share)
    if kink > -np.inf:
        most = kink + FILLS * film.ring.scale
        for i in range(work.u.shape[0]):
            for k in range(work.u.shape[1]):
                if work.trial[i, k] < kink:
                    work.u[i, k] = min(work.u[i, k], most)


@once
def _advance(film, work, q, step, size):
    """Move film and shaft by a Newton step, or by the share of it that leaves a film."""
    for i in range(work.u.shape[0]):
        for k in range(work.u.shape[1]):
            work.trial[i, k] = work.u[i, k]
    if film.give == 0.0:
        if size > 0:
            _limited(film, work, q, step)
        share = share_of_rise(film, work, step, size)
        correct(film, work, step, size, share)
        for a in range(4):
            q[a] += share * step[a]
        place(film, work, q)
        return
    gap, share, done = narrowest(film, work), share_of_rise(film, work, step, size), 0.0
    least = max(gap - (1.0 - KEPT) * max(gap, film.rough.size), -film.rough.deepest)
    while True:
        correct(film, work, step, size, share)
        for a in range(4):
            q[a] += (share - done) * step[a]
        done = share
        place(film, work, q)
        if narrowest(film, work) >= least or share < ROOM:
            return
        share *= 0.5


@once
def _newton(film, work, q, load, size, speed, lightness, rate, tolerance, max_iterations):
    """Film and shaft at which `load` (4,) is carried; one implicit step if rate > 0.

    Starts from `work.u` and `q` (4,), of which the first `size` coordinates move, in place. Its
    Reynolds numbers are those at `speed` times `lightness`: at the time scale of the film. Returns
    residual, Newton steps, whether the residual is small by the rule of `convergence`, and its
    rounding level, which is looked at where the tolerance is not met soon.

    Factors that are there take the first step: those of the last time bring a film in motion as
    far as new ones would from there. They go on as long as a few steps at the pace of the last one
    reach the tolerance.

    Where a law has a kink, the shaft waits while points that count as full lack far too much: it
    would follow a load that is not there, and move the rupture to and fro.
    """
    wedge = 0.5 * film.ring.slope * speed
    flux = (abs(wedge) + film.ring.scale) * film.nodes.widest
    total = 0.0
    for a in range(size):
        total += load[a] * load[a]
    force_scale = max(np.sqrt(total), 0.5e-3 * film.ring.scale * film.ring.area)
    step = work.step
    turn(film, work, speed, lightness)
    spent, last = 0, np.inf
    place(film, work, q)
    while True:
        residual = max(balance(film, work, wedge, rate) / flux, unfed(film, work))
        waits = film.ring.kink > -np.inf and residual > WAITS
        touch(film, work, q)
        missing = 0.0
        for a in range(size):
            missing += (load[a] - work.load[a] - work.touch[0, a]) ** 2
        residual = max(residual, np.sqrt(missing) / force_scale)
        # the largest of the residuals leaves out what is no number; the load does not
        if not abs(work.load[0]) + abs(work.load[1]) < np.inf:
            residual = np.inf
        if film.give > 0.0 and not has_gap(film, work):
            residual = np.inf
        done = residual < tolerance or spent == max_iterations or not residual < np.inf
        rounding = 0.0
        if not residual < tolerance and (done or spent >= LATE):
            cells, forces = magnitudes(film, work, wedge, rate)
            rounding = rounding_level(max(cells / flux, forces / force_scale if size else 0.0))
        answered = is_small(residual, tolerance, min(rounding, COARSEST))
        if answered and film.ring.shaped and not has_gap(film, work):
            residual, answered, done = np.inf, False, True  # closed between two places of the cells
        if done or answered:
            return residual, spent, answered, rounding
        spent, columns, fresh = spent + 1, 1, False
        if not (work.kept[0] > 0.0 and residual * (residual / last) ** MORE < tolerance):
            slopes_of_balance(film, work, wedge, rate, size)
            matrix(film, work, wedge, rate)
            work.kept[0] = 0.0
            if not factorise(work.matrix):
                return residual, spent, False, rounding
            work.kept[0], work.kept[1], fresh = 1.0, rate, True
            columns = answers_of_grooves(film, work, 1 + size)
        substitute(work.matrix, work.columns, columns)
        follow_shell(film, work, wedge, rate, columns, NEAR)
        follow_grooves(film, work, wedge, rate, size, fresh)
        last = residual
        step[:] = 0.0
        if size > 0 and not waits:
            _shaft_step(film, work, load, size, step)
        _advance(film, work, q, step, size)


@once
def _finish(film, work, q, speed, size, stiffness, damping):
    """Slopes of the load of a film at rest at `q`.

    `stiffness` and `damping` (size, size) are by position (per clearance) and by velocity
    (clearances per second).
    """
    nx, m = film.ring.cos.size, film.nodes.slopes.shape[1]
    wedge = 0.5 * film.ring.slope * speed
    balance(film, work, wedge, 0.0)
    slopes_of_balance(film, work, wedge, 0.0, size)
    matrix(film, work, wedge, 0.0)
    factorise(work.matrix)
    columns = answers_of_grooves(film, work, 1 + size)
    substitute(work.matrix, work.columns, columns)
    follow_shell(film, work, wedge, 0.0, columns, EXACT)
    follow_grooves(film, work, wedge, 0.0, size, FRESH)
    carry(film, work, size)
    for a in range(size):
        for b in range(size):
            stiffness[a, b] = work.touch[1 + a, b] - work.carried[1 + b, a]
    work.border.direct[:] = 0.0
    follow_by(film, work, size)
    for i in range(nx):
        still = film.ring.groove[i] and not film.held.columns[i]  # a groove between segments
        squeeze = 0.0 if still else film.ring.slope * film.ring.width[i]
        for k in range(m):
            held = -squeeze * film.nodes.weights[k] * work.state[FILL, i, k]
            held *= work.gap[OPEN, i, k]
            modes = (
                film.ring.cos[i],
                film.ring.sin[i],
                -film.nodes.z[k] * film.ring.sin[i],
                film.nodes.z[k] * film.ring.cos[i],
            )
            if film.held.on and film.held.grooves[i, k] >= 0:
                displaced_by(film, work, i, k, held, modes, size)
                held = 0.0
            work.columns[0, i, k] = 0.0
            for a in range(size):  # an elastic shell follows
                work.columns[1 + a, i, k] = held * (modes[a] + work.columns[1 + a, i, k])
    substitute(work.matrix, work.columns, 1 + size)
    follow_shell(film, work, wedge, 0.0, 1 + size, EXACT)
    follow_grooves(film, work, wedge, 0.0, size, FRESH)
    carry(film, work, size)
    for a in range(size):
        for b in range(size):
            damping[a, b] = -work.carried[1 + b, a]


@inner
def keep(work):
    """Make what is current that of the last time."""
    shift(work)
    nx, m = work.u.shape
    for i in range(nx):
        for k in range(m):
            work.liquid[1, i, k] = work.state[FILL, i, k] * work.gap[MEAN, i, k]


@once
def _set_out(film, work, q, begin):
    """Make the film at `q` that of the last time; from the third time on, one before it, too.

    What they hold follows from the unknowns, so that these and the way of the shaft are all that
    there is to going on.
    """
    if begin > 1:
        for i in range(work.u.shape[0]):
            for k in range(work.u.shape[1]):
                work.trial[i, k], work.u[i, k] = work.last[i, k], work.before[i, k]
        work.bend[0], work.bend[1] = work.past[0], work.past[1]
        place(film, work, work.places[0])
        keep(work)
        for i in range(work.u.shape[0]):
            for k in range(work.u.shape[1]):
                work.u[i, k] = work.trial[i, k]
        work.bend[0], work.bend[1] = work.past[2], work.past[3]
    place(film, work, q)
    keep(work)


@outer
def solve(
    film, work, q, size, begin, time, load, line, speed, tolerance, max_iterations, accuracy, rows,
    slopes, warmth, states,
):  # fmt: skip
    """A film at rest, or through time: one function, as compiling takes its time for each.

    With `begin` 0 the film at rest at the first time is sought from `work.u` and `q`, of which the
    first `size` coordinates move; `slopes` (2, s, s) with s > 0 take stiffness and damping as
    `_finish` does. From a later one on implicit steps of second order (BDF2 of variable step) go
    through all times from there: from the film of `work.u` and `q`, at rest at the first time, or
    from that of `work.last` and `q` after that of `work.before` and `work.places[0]`. A step at
    which Newton fails, or whose error is beyond the `accuracy`, a share of the narrowest gap, is
    cut, all that is given interpolated.

    `load` (n, 4), `line` (n, 4) tilt and bend; in motion the tilt is given where `size` is 2.
    Fills `rows` (n, RESULTS), and `states` as `slow_heat` does, and returns how many of them.
    """
    film, work, warmth = refer(film), refer(work), refer(warmth)
    before, new, given, earlier = work.places[0], work.places[1], work.places[2], work.places[3]
    resting = begin == 0
    step_before, step_earlier, thin, light = 0.0, 0.0, states[0, THIN], 1.0
    smallest = SMALLEST if accuracy == np.inf else FINEST
    if warmth.on:
        light = lighter(warmth, states, 0)
    if resting:
        work.kept[0] = 0.0
    else:
        _set_out(film, work, q, begin)
        step_before, step_earlier = work.past[4], work.past[5]
    for n in range(begin, 1 if resting else time.size):
        last = max(n - 1, 0)
        whole = time[n] - time[last]
        if warmth.on and not resting:
            thin = slow_heat(warmth, states, n, whole, speed, rows, at.DISSIPATION, at.NORMAL)
            light = lighter(warmth, states, n)
        share, done, spent, steps = 1.0, 0.0, 0, 0
        if accuracy < np.inf and not resting:
            share = min(work.past[6] / whole, 1.0)
        while done < 1.0:
            to = 1.0 if done + 1.01 * share > 1.0 else done + share
            step, rate = (to - done) * whole, 0.0
            for a in range(4):
                new[a] = q[a]
                given[a] = load[last, a] + to * (load[n, a] - load[last, a])
            lay_at(work, line, n, to, new, size < 4 and not resting)
            if not resting:
                rate, weight, weight_before, ratio = two_steps(step, step_before)
                ahead = False
                if step_before > 0.0:
                    for a in range(size):
                        new[a] = q[a] + ratio * (q[a] - before[a])
                    ahead = film.give > 0.0 or leaves_room(film, work, q, new)
                    if not ahead:
                        for a in range(size):
                            new[a] = q[a]
                predict(work, ratio, ahead, thin * weight, thin * weight_before)
                if not ahead or abs(thin * rate - work.kept[1]) > ALIKE * work.kept[1]:
                    work.kept[0] = 0.0
            omega = thin * (speed[last] + to * (speed[n] - speed[last]))
            residual, iterations, converged, rounding = _newton(
                film, work, new, given, size, omega, light / (thin * thin), thin * rate,
                tolerance, max_iterations,
            )  # fmt: skip
            spent += iterations
            longer = 2.0 if converged else 0.5
            if converged and accuracy < np.inf and not resting:
                longer = longer_step(film, work, q, size, step, step_before, step_earlier, accuracy)
            taken = longer >= SAFETY
            if taken or resting:
                for a in range(4):
                    earlier[a], before[a], q[a] = before[a], q[a], new[a]
                ahead_of, done = longer * (to - done), to
            if taken:
                keep(work)
                for a in range(2):
                    work.past[a], work.past[2 + a] = work.past[2 + a], work.bend[a]
                step_earlier, step_before, steps = step_before, step, steps + 1
                work.past[4], work.past[5] = step, step_earlier
                share = min(ahead_of, 1.0) if to < 1.0 else max(ahead_of, share)
                work.past[6] = share * whole
            elif share > smallest:
                share *= longer
                work.kept[0] = 0.0
            else:
                converged = False
                break
        rows[n, at.RESIDUAL] = residual
        rows[n, at.ITERATIONS] = spent
        rows[n, at.CONVERGED] = converged
        rows[n, at.ROUNDING] = rounding
        rows[n, at.STEPS] = steps
        if not converged:
            for a in range(4):
                rows[n, a] = new[a]
            return n + 1
        if slopes.shape[1] > 0:
            _finish(film, work, q, omega, slopes.shape[1], slopes[0], slopes[1])
        summarise(film, work, q, 0.5 * film.ring.slope * omega, thin * rate, rows[n])
    return time.size
