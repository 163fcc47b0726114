"""Compiled loops of the reduced film on tilting pads: Newton, and a march through time.

They are those of `_loops` with the tilts of the pads among the unknowns. Grooves of a
known pressure part the pads, so that the columns of the shaft, taken on one pad alone, are those of
its tilt, too: nothing more has to be solved for.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import FILL, LOAD
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
    two_steps,
)
from loadflow.journal.models._ring_kernels import factorise, substitute
from loadflow.journal.models._small_systems import solve_system
from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.kernels._balance_kernels import (
    balance,
    magnitudes,
    matrix,
    slopes_of_balance,
)
from loadflow.journal.models.composed.kernels._gap_kernels import DRAG, has_gap, turn
from loadflow.journal.models.composed.kernels._integral_kernels import fed, summarise
from loadflow.journal.models.composed.kernels._loops import keep
from loadflow.journal.models.composed.kernels._pad_kernels import (
    BEFORE,
    LAST,
    NEXT,
    STEP,
    hold_pads,
    lift_of,
    place_on_pads,
    put_on,
    set_out,
    spare_state,
)
from loadflow.journal.models.composed.kernels._pad_step_kernels import (
    KEPT_ON_PADS,
    carry_on_pads,
    condense,
    moments_of_pads,
    move_on_pads,
    share_on_pads,
    turn_pads,
)
from loadflow.journal.models.composed.kernels._step_kernels import lay_at, longer_step
from loadflow.journal.models.slow_heat import THIN, lighter, slow_heat
from loadflow.journal.solvers.motion.moving_pads import FLAT, LATER, NEAR
from loadflow.numerics.references import refer


@once
def _steps(film, work, pads, pad_work, q, load, size, step):
    """Newton step (4,) of the shaft, and those of the tilts, shortened where they are too long."""
    system = pad_work.system
    condense(work, pads, pad_work, max(size, 2))
    step[:] = 0.0
    for j in range(pad_work.on.size):
        pad_work.tilts[STEP, j] = 0.0
    for a in range(size):
        system[a, size] = -(load[a] - work.load[a] + work.carried[0, a])
        for b in range(size):
            system[a, b] = work.carried[1 + b, a]
    if size > 0 and not solve_system(system, size):
        return
    change, peak = 0.0, film.ring.scale
    for i in range(work.u.shape[0]):
        for k in range(film.nodes.slopes.shape[1]):
            change = max(change, abs(work.columns[0, i, k]))
            peak = max(peak, work.state[LOAD, i, k])
    share = 1.0 / max(1.0, change / (peak * STEP_LIMIT))
    for a in range(size):
        step[a] = share * system[a, size]
    turn_pads(pads, pad_work, q, step, share, size)


@once
def _advance(film, work, pads, pad_work, q, step):
    """Move film, shaft and pads by a Newton step, or by the share of it that leaves a film."""
    tilts = pad_work.tilts
    share = share_on_pads(film, work, pads, pad_work, step, KEPT_ON_PADS)
    for a in range(4):
        step[a] *= share
    for j in range(pad_work.on.size):
        tilts[STEP, j] *= share
    move_on_pads(film, work, pads, pad_work, step, 1.0)
    for a in range(4):
        q[a] += step[a]
    place_on_pads(film, work, pads, pad_work, q, NEXT)


@inner
def _newton(
    film, work, pads, pad_work, q, load, size, speed, lightness, rate, tolerance, max_iterations
):
    """Film, shaft and pads at which `load` (4,) is carried; as `_loops._newton`."""
    wedge = 0.5 * film.ring.slope * speed
    flux = (abs(wedge) + film.ring.scale) * film.nodes.widest
    total, step, columns = 0.0, work.step, max(size, 2)
    for a in range(size):
        total += load[a] * load[a]
    force_scale = max(np.sqrt(total), 0.5e-3 * film.ring.scale * film.ring.area)
    turn(film, work, speed, lightness)
    spent = 0
    place_on_pads(film, work, pads, pad_work, q, NEXT)
    while True:
        residual = balance(film, work, wedge, rate) / flux
        missing = moments_of_pads(film, work, pads, pad_work)
        for a in range(size):
            missing += (load[a] - work.load[a]) ** 2
        residual = max(residual, np.sqrt(missing) / force_scale)
        # the largest of the residuals leaves out what is no number; the load does not
        if not abs(work.load[0]) + abs(work.load[1]) < np.inf:
            residual = np.inf
        done = residual < tolerance or spent == max_iterations or not residual < np.inf
        rounding = 0.0
        if not residual < tolerance and (done or spent >= LATE):
            cells, forces = magnitudes(film, work, wedge, rate)
            rounding = rounding_level(max(cells / flux, forces / force_scale))
        answered = is_small(residual, tolerance, min(rounding, COARSEST))
        if answered and not has_gap(film, work):
            residual, answered, done = np.inf, False, True  # closed between two places of the cells
        if done or answered:
            return residual, spent, answered, rounding
        spent += 1
        slopes_of_balance(film, work, wedge, rate, columns)
        matrix(film, work, wedge, rate)
        if not factorise(work.matrix):
            return residual, spent, False, rounding
        substitute(work.matrix, work.columns, 1 + columns)
        carry_on_pads(film, work, pads, pad_work, columns)
        _steps(film, work, pads, pad_work, q, load, size, step)
        _advance(film, work, pads, pad_work, q, step)


@inner
def try_other_pads(work, pads, pad_work, q, reached, speed, near):
    """Give and take films as `moving_pads.other_pads` says; whether any has changed.

    Pads keep theirs up to a share `near` of the widest gap that holds one.
    """
    sense, changed, count = 1 if speed < 0.0 else 0, False, pad_work.on.size
    spare_state(work, pad_work, True)
    wide = near * pads.widest[sense]
    finite = reached[0] - reached[0] == 0.0 and reached[1] - reached[1] == 0.0
    for j in range(count):
        lift = lift_of(pads, pad_work.tilts, NEXT, j, reached[0], reached[1])
        gap = 1.0 - q[0] * pads.toward[j, 0] - q[1] * pads.toward[j, 1]
        if finite and pad_work.on[j] and abs(lift) < FLAT and gap > wide:
            put_on(work, pads, pad_work, q, speed, j, not pad_work.on[j])
            changed = True
    films = 0
    for j in range(count):
        films += 1 if pad_work.on[j] else 0
    for j in range(0 if changed else count):
        gap = 1.0 - q[0] * pads.toward[j, 0] - q[1] * pads.toward[j, 1]
        if not pad_work.on[j] and (films < 2 or gap < pads.widest[sense] + NEAR):
            put_on(work, pads, pad_work, q, speed, j, not pad_work.on[j])
            changed = True
    return changed


@inner
def come_and_go(work, pads, pad_work, q, speed):
    """Give films to pads that one holds at rest, and take those of others; whether any changed."""
    changed, held, sense = False, 0, 1 if speed < 0.0 else 0
    for j in range(pad_work.on.size):
        gap = 1.0 - q[0] * pads.toward[j, 0] - q[1] * pads.toward[j, 1]
        held += 1 if gap <= pads.widest[sense] else 0
    for j in range(pad_work.on.size):
        gap = 1.0 - q[0] * pads.toward[j, 0] - q[1] * pads.toward[j, 1]
        holds = gap <= pads.widest[sense]
        if holds != pad_work.on[j] and (holds or held > 1):  # on one it goes sideways
            put_on(work, pads, pad_work, q, speed, j, holds)
            changed = True
    return changed


@once
def _unfilled(film, work, pads, pad_work):
    """Shear that pads without a film have too much, after `summarise` of an uneven viscosity.

    No more oil goes past them than their narrowest place drags, as on the grid.
    """
    total, drags, fill = 0.0, work.face[DRAG], work.state[FILL]
    for j in range(pad_work.on.size):
        for k in range(0 if pad_work.on[j] else film.nodes.slopes.shape[1]):
            least = np.inf
            for i in range(pads.face.size):
                if pads.face[i] == j:
                    least = min(least, drags[i, k])
            for i in range(pads.cell.size):
                if pads.cell[i] == j and fill[i, k] > 0.0:
                    share = least / (0.5 * (drags[i - 1, k] + drags[i, k]))
                    sheared = work.sheared[i, k] * film.uneven.shear[i, k]
                    total += sheared * (1.0 - share / fill[i, k])
    return total


@inner
def summarise_on_pads(film, work, pads, pad_work, q, wedge, rate, row):
    """`summarise`, with the drag on pads without a film, but not what these drag along."""
    for i in range(pads.cell.size):
        film.ring.groove[i] = pads.groove[i]
    summarise(film, work, q, wedge, rate, row)
    if film.uneven.on:
        row[at.SHEAR] -= _unfilled(film, work, pads, pad_work)
    hold_pads(film, pads, pad_work)
    row[at.FED] = fed(film, work, wedge)


@outer
def solve_on_pads(
    film, work, pads, pad_work, q, size, begin, time, load, line, speed, tolerance, max_iterations,
    accuracy, rows, tilts, warmth, states,
):  # fmt: skip
    """As `_loops.solve` without its slopes; fills `tilts` (n, p), too.

    The pads begin at `pad_work.tilts` of the last time, and, from the third time on, of the one
    before it; those of which `pad_work.on` says so have a film.
    """
    film, work, warmth = refer(film), refer(work), refer(warmth)
    pads, pad_work = refer(pads), refer(pad_work)
    before, new, given, own = work.places[0], work.places[1], work.places[2], pad_work.tilts
    earlier, count, resting = work.places[3], pad_work.on.size, begin == 0
    step_before, step_earlier, thin, light = 0.0, 0.0, states[0, THIN], 1.0
    smallest = SMALLEST if accuracy == np.inf else FINEST
    if warmth.on:
        light = lighter(warmth, states, 0)
    if resting:
        hold_pads(film, pads, pad_work)
    else:
        set_out(film, work, pads, pad_work, q, begin > 1)
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
        other = False  # whether this step is tried on other pads
        while done < 1.0:
            to = 1.0 if done + 1.01 * share > 1.0 else done + share
            step, rate = (to - done) * whole, 0.0
            omega = thin * (speed[last] + to * (speed[n] - speed[last]))
            for a in range(4):
                new[a] = q[a]
                given[a] = load[last, a] + to * (load[n, a] - load[last, a])
            lay_at(work, line, n, to, new, size < 4 and not resting)
            for j in range(count):
                own[NEXT, j] = own[LAST, j]
            if not resting:
                rate, weight, weight_before, ratio = two_steps(step, step_before)
                ahead = False
                if step_before > 0.0:
                    for a in range(4):
                        work.step[a] = ratio * (q[a] - before[a]) if a < size else 0.0
                    for j in range(count):
                        own[STEP, j] = ratio * (own[LAST, j] - own[BEFORE, j])
                    ahead = share_on_pads(film, work, pads, pad_work, work.step, 0.5) == 1.0
                    for a in range(size if ahead else 0):
                        new[a] = q[a] + work.step[a]
                    for j in range(count if ahead else 0):
                        own[NEXT, j] = own[LAST, j] + own[STEP, j]
                predict(work, ratio, ahead, thin * weight, thin * weight_before)
            residual, iterations, converged, rounding = _newton(
                film, work, pads, pad_work, new, given, size, omega, light / (thin * thin),
                thin * rate, tolerance, max_iterations,
            )  # fmt: skip
            spent += iterations
            longer = 2.0 if converged else 0.5
            if converged and accuracy < np.inf and not resting:
                longer = longer_step(film, work, q, size, step, step_before, step_earlier, accuracy)
            taken = longer >= SAFETY
            if taken or resting:
                for a in range(4):
                    earlier[a], before[a], q[a] = before[a], q[a], new[a]
                for j in range(count):
                    own[BEFORE, j], own[LAST, j] = own[LAST, j], own[NEXT, j]
                ahead_of, done = longer * (to - done), to
            if taken:
                keep(work)
                for a in range(2):
                    work.past[a], work.past[2 + a] = work.past[2 + a], work.bend[a]
                step_earlier, step_before, steps = step_before, step, steps + 1
                work.past[4], work.past[5] = step, step_earlier
                share, other = min(ahead_of, 1.0) if to < 1.0 else max(ahead_of, share), False
                work.past[6] = share * whole
                if done >= 1.0:
                    wedge = 0.5 * film.ring.slope * omega
                    summarise_on_pads(film, work, pads, pad_work, q, wedge, thin * rate, rows[n])
                    for j in range(count):
                        tilts[n, j] = own[LAST, j]
                if not resting and come_and_go(work, pads, pad_work, q, omega):
                    set_out(film, work, pads, pad_work, q, step_before > 0.0)
            elif resting:
                pass
            elif not (converged or other or share > LATER) and try_other_pads(
                work, pads, pad_work, q, new, omega, 0.0
            ):
                other = True
                set_out(film, work, pads, pad_work, q, step_before > 0.0)
            elif share > smallest:
                share *= longer
                if other:
                    spare_state(work, pad_work, False)
                other = False
                set_out(film, work, pads, pad_work, q, step_before > 0.0)
            else:
                converged = False
                break
        rows[n, at.STEPS] = steps
        rows[n, at.RESIDUAL] = residual
        rows[n, at.ITERATIONS] = spent
        rows[n, at.CONVERGED] = converged
        rows[n, at.ROUNDING] = rounding
        if not converged:
            for a in range(4):
                rows[n, a] = new[a]
            return n + 1
    return time.size
