"""Compiled loops of the reduced film on tilting pads: Newton, and a march through time.

They are those of `_composed_loops` with the tilts of the pads among the unknowns. Grooves of a
known pressure part the pads, so that the columns of the shaft, taken on one pad alone, are those of
its tilt, too: nothing more has to be solved for.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import DLOAD, LOAD
from loadflow.journal.models import composed_film as at
from loadflow.journal.models._compile import inner, once, outer
from loadflow.journal.models._composed_gap_kernels import has_gap, turn
from loadflow.journal.models._composed_kernels import (
    balance,
    magnitudes,
    matrix,
    slopes_of_balance,
)
from loadflow.journal.models._composed_loops import keep
from loadflow.journal.models._integral_kernels import fed, summarise
from loadflow.journal.models._pad_kernels import (
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
from loadflow.journal.models._step_kernels import lay_at, longer_step
from loadflow.journal.models.slow_heat import THIN, lighter, slow_heat
from loadflow.journal.solvers.moving_pads import FLAT, NEAR
from loadflow.numerics.references import refer

_KEPT = 0.3  # share of a gap, or of the tilt of a pad, that a step leaves
_SMALL = 0.03  # tilt of a pad, in clearances, from which it may grow threefold in a step


@once
def _carry(film, work, pads, pad_work, size):
    """Load of each pad beside that of the edge pressure, and what the columns carry on it."""
    nx, m = film.ring.cos.size, film.nodes.slopes.shape[1]
    z, weights, columns, unit = film.nodes.z, film.nodes.weights, work.columns, film.ring.area
    pad_work.load[:] = 0.0
    pad_work.carried[:] = 0.0
    for i in range(nx):
        j = pads.cell[i]
        if film.ring.groove[i]:
            continue
        c, s = unit * film.ring.load_x[i], unit * film.ring.load_y[i]
        load, turned = 0.0, 0.0
        for k in range(m):
            part = weights[k] * (work.state[LOAD, i, k] - film.ring.p_edge)
            load += part
            turned += part * z[k]
        pad_work.load[j, 0] += load * c
        pad_work.load[j, 1] += load * s
        pad_work.load[j, 2] -= turned * s
        pad_work.load[j, 3] += turned * c
        for column in range(1 + size):
            load, turned = 0.0, 0.0
            for k in range(m):
                part = weights[k] * work.state[DLOAD, i, k] * columns[column, i, k]
                load += part
                turned += part * z[k]
            pad_work.carried[j, column, 0] += load * c
            pad_work.carried[j, column, 1] += load * s
            pad_work.carried[j, column, 2] -= turned * s
            pad_work.carried[j, column, 3] += turned * c


@once
def _moments(film, work, pads):
    """Sum of the squared moments of the pads about their pivots, N², over the shaft radius."""
    m, unit, total, moment, last = film.nodes.slopes.shape[1], film.ring.area, 0.0, 0.0, -1
    for i in range(work.u.shape[0]):
        j = pads.cell[i]
        if j != last:
            total, moment, last = total + moment * moment, 0.0, j
        if film.ring.groove[i]:
            continue
        load = 0.0
        for k in range(m):
            load += film.nodes.weights[k] * (work.state[LOAD, i, k] - film.ring.p_edge)
        arm = pads.along[j, 0] * film.ring.load_x[i] + pads.along[j, 1] * film.ring.load_y[i]
        moment += unit * load * arm
    return total + moment * moment


@once
def _steps(film, work, pads, pad_work, load, size, step):
    """Newton step (4,) of the shaft, and those of the tilts, shortened where they are too long.

    A pad follows the shaft so that it has no moment: what the load of a pad changes by its tilt is
    what it changes by the place of the shaft along the tangent.
    """
    system, count = pad_work.system, pad_work.on.size
    step[:] = 0.0
    for j in range(count):
        pad_work.tilts[STEP, j] = 0.0
    for a in range(size):
        system[a, size] = -load[a]
        for b in range(size):
            system[a, b] = 0.0
    for j in range(count):
        ex, ey = pads.along[j, 0], pads.along[j, 1]
        carried, follow = pad_work.carried[j], pad_work.follow[j]
        own = ex * (pad_work.load[j, 0] - carried[0, 0])
        own += ey * (pad_work.load[j, 1] - carried[0, 1])
        follow[0] = own
        for b in range(size):
            follow[1 + b] = ex * carried[1 + b, 0] + ey * carried[1 + b, 1]
        by_tilt = ex * (ex * carried[1, 0] + ey * carried[1, 1])
        by_tilt += ey * (ex * carried[2, 0] + ey * carried[2, 1])
        follow[5] = by_tilt
        for a in range(size):
            system[a, size] += pad_work.load[j, a] - carried[0, a]
            turned = 0.0
            if by_tilt != 0.0:
                turned = (ex * carried[1, a] + ey * carried[2, a]) / by_tilt
            system[a, size] -= turned * own
            for b in range(size):
                system[a, b] += carried[1 + b, a] - turned * follow[1 + b]
    if size > 0 and not solve_system(system, size):
        return
    change, peak = 0.0, film.ring.scale
    for i in range(work.u.shape[0]):
        for k in range(film.nodes.slopes.shape[1]):
            change = max(change, abs(work.columns[0, i, k]))
            peak = max(peak, work.state[LOAD, i, k])
    excess = max(1.0, change / (peak * STEP_LIMIT))
    for a in range(size):
        step[a] = system[a, size]
    for j in range(count):
        follow, moves = pad_work.follow[j], 0.0
        if pad_work.on[j] and follow[5] != 0.0:
            moves = follow[0]
            for b in range(size):
                moves -= follow[1 + b] * step[b]
            moves /= follow[5]
        pad_work.tilts[STEP, j] = moves / excess
    for a in range(size):
        step[a] /= excess


@inner
def _share(film, work, pads, pad_work, step, kept):
    """Share of a step of shaft and tilts that leaves every place of the pads `kept` of its gap.

    Places are cell centres and faces, to the ends of the bearing: the ends of a pad are faces.
    """
    share, ring, tilts = 1.0, film.ring, pad_work.tilts[STEP]
    for i in range(ring.cos.size):
        j = pads.cell[i]
        if j >= 0:
            at = ring.cos[i], ring.sin[i], ring.base[i]
            share = _share_at(film, work, pads.along[j], tilts[j], step, kept, at, share)
        j, at = pads.face[i], (ring.cos_face[i], ring.sin_face[i], ring.base_face[i])
        share = _share_at(film, work, pads.along[j], tilts[j], step, kept, at, share)
    return share


@inner
def _share_at(film, work, along, turns, step, kept, at, share):
    """At most `share`: that of a step which leaves `kept` of the gap at one angle around.

    The pad turns by `turns`; `at`: cosine and sine of the angle, and H of the centred shaft there.
    """
    c, s, base = at
    dx, dy = step[0] + turns * along[0], step[1] + turns * along[1]
    for k in range(film.places.z.size):
        z = film.places.z[k]
        closes = (dx + step[3] * z) * c + (dy - step[2] * z) * s
        gap = base + film.places.depth[k] - work.centre[0, k] * c - work.centre[1, k] * s
        if closes > 0.0 and share * closes > (1.0 - kept) * gap:
            share = max((1.0 - kept) * gap / closes, 0.0)
    return share


@once
def _advance(film, work, pads, pad_work, q, step):
    """Move film, shaft and pads by a Newton step, or by the share of it that leaves a film.

    A pad that tilts the other way has no film, and would stay so.
    """
    m, tilts = film.nodes.slopes.shape[1], pad_work.tilts
    for j in range(pad_work.on.size):
        if tilts[STEP, j] == 0.0:
            continue
        before = lift_of(pads, tilts, NEXT, j, q[0], q[1])
        after = lift_of(pads, tilts, NEXT, j, q[0] + step[0], q[1] + step[1]) + tilts[STEP, j]
        sign = -1.0 if before < 0.0 else 1.0
        most = max(abs(before), _SMALL) / _KEPT
        tilts[STEP, j] += sign * min(max(sign * after, _KEPT * abs(before)), most) - after
    share = _share(film, work, pads, pad_work, step, _KEPT)
    for a in range(4):
        step[a] *= share
    for j in range(pad_work.on.size):
        tilts[STEP, j] *= share
        tilts[NEXT, j] += tilts[STEP, j]
    for i in range(work.u.shape[0]):
        if film.ring.groove[i]:
            continue
        j = pads.cell[i]
        turns = tilts[STEP, j]
        dx, dy = step[0] + turns * pads.along[j, 0], step[1] + turns * pads.along[j, 1]
        for k in range(m):
            change = work.columns[0, i, k] + dx * work.columns[1, i, k] + dy * work.columns[2, i, k]
            if step[2] != 0.0 or step[3] != 0.0:
                change += step[2] * work.columns[3, i, k] + step[3] * work.columns[4, i, k]
            work.u[i, k] -= change
    for a in range(4):
        q[a] += step[a]
    place_on_pads(film, work, pads, pad_work, q, NEXT)


@inner
def _newton(
    film, work, pads, pad_work, q, load, size, speed, lightness, rate, tolerance, max_iterations
):
    """Film, shaft and pads at which `load` (4,) is carried; as `_composed_loops._newton`."""
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
        missing = _moments(film, work, pads)
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
        _carry(film, work, pads, pad_work, columns)
        _steps(film, work, pads, pad_work, load, size, step)
        _advance(film, work, pads, pad_work, q, step)


@once
def _other_pads(work, pads, pad_work, q, reached, speed):
    """Give and take films as `moving_pads.other_pads` says; whether any has changed."""
    sense, changed, count = 1 if speed < 0.0 else 0, False, pad_work.on.size
    spare_state(work, pad_work, True)
    finite = reached[0] - reached[0] == 0.0 and reached[1] - reached[1] == 0.0
    for j in range(count):
        lift = lift_of(pads, pad_work.tilts, NEXT, j, reached[0], reached[1])
        if finite and pad_work.on[j] and abs(lift) < FLAT:
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


@once
def _summed(film, work, pads, pad_work, q, wedge, rate, row):
    """`summarise`, with the drag on pads without a film, but not what these drag along."""
    for i in range(pads.cell.size):
        film.ring.groove[i] = pads.groove[i]
    summarise(film, work, q, wedge, rate, row)
    hold_pads(film, pads, pad_work)
    row[at.FED] = fed(film, work, wedge)


@outer
def solve_on_pads(
    film, work, pads, pad_work, q, size, begin, time, load, line, speed, tolerance, max_iterations,
    accuracy, rows, tilts, warmth, states,
):  # fmt: skip
    """As `_composed_loops.solve` without its slopes; fills `tilts` (n, p), too.

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
                    ahead = _share(film, work, pads, pad_work, work.step, 0.5) == 1.0
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
                    _summed(film, work, pads, pad_work, q, wedge, thin * rate, rows[n])
                    for j in range(count):
                        tilts[n, j] = own[LAST, j]
                changed, held = False, 0
                for j in range(count):
                    gap = 1.0 - q[0] * pads.toward[j, 0] - q[1] * pads.toward[j, 1]
                    held += 1 if gap <= pads.widest[1 if omega < 0.0 else 0] else 0
                for j in range(count if not resting else 0):
                    gap = 1.0 - q[0] * pads.toward[j, 0] - q[1] * pads.toward[j, 1]
                    holds = gap <= pads.widest[1 if omega < 0.0 else 0]
                    if holds != pad_work.on[j] and (holds or held > 1):  # on one it goes sideways
                        put_on(work, pads, pad_work, q, omega, j, holds)
                        changed = True
                if changed:
                    set_out(film, work, pads, pad_work, q, step_before > 0.0)
            elif resting:
                pass
            elif not converged and not other and _other_pads(work, pads, pad_work, q, new, omega):
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
