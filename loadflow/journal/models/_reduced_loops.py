"""Compiled loops of the rung "reduced": Newton, and a march through time.

No step of a loop returns to Python or allocates. Compiling takes most of its time once for each
function that calls `newton`, so there is one.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import FILL, LOAD
from loadflow.journal.film.gap import _gap_kernels
from loadflow.journal.film.gap.gap import KEPT
from loadflow.journal.models._band_kernels import factorise, substitute
from loadflow.journal.models._compile import inner, once, outer
from loadflow.journal.models._reduced_kernels import (
    NO_GAP,
    balance,
    carried,
    hold_grooves,
    hold_grooves_in,
    magnitudes,
    matrix,
    narrowest,
    place,
    summarise,
)
from loadflow.journal.models.reduced_film import (
    CONVERGED,
    DISSIPATION,
    ITERATIONS,
    RESIDUAL,
    ROUNDING,
    STEPS,
    X,
    Y,
)
from loadflow.journal.models.slow_heat import THIN, slow_heat
from loadflow.journal.solvers.motion import step_size
from loadflow.numerics import convergence

STEP_LIMIT = 0.5  # change of the film over its pressure, up to which the shaft goes all the way
LATE = 8  # Newton steps after which a residual is asked whether it is that of rounding
COARSEST = convergence.COARSEST
rounding_level = inner(convergence.rounding_level)
is_small = inner(convergence.is_small)
foreseen, growth = inner(step_size.foreseen), inner(step_size.growth)
SAFETY, SMALLEST, FINEST = step_size.SAFETY, step_size.SMALLEST, step_size.FINEST
along_the_gap = once(_gap_kernels.along_the_gap.py_func)


@inner
def shaft_step(film, work, x, y, gx, gy):
    """Position after a Newton step that carries the missing load (gx, gy).

    A step that changes the film by more than its own pressure is shortened.
    """
    nx, m = work.u.shape
    (ax, ay), (axx, ayx), (axy, ayy) = carried(film, work)
    gx += ax
    gy += ay
    det = axx * ayy - axy * ayx
    if det == 0.0:
        return x, y
    change = 0.0
    peak = film.ring.scale
    for i in range(nx):
        base = film.ring.order[i] * m
        for k in range(m):
            change = max(change, abs(work.columns[base + k, 0]))
            peak = max(peak, work.state[LOAD, i, k])
    excess = max(1.0, change / (peak * STEP_LIMIT))
    scale = -1.0 / (det * excess)
    dx, dy = scale * (ayy * gx - axy * gy), scale * (axx * gy - ayx * gx)
    if film.ring.shaped:
        share = clear(film.ring, work, dx, dy)
        return x + share * dx, y + share * dy
    return along_the_gap(x, y, dx, dy, 1.0 - KEPT * (1.0 - np.hypot(x, y)))


@inner
def clear(ring, work, dx, dy):
    """Share of a step, of which every gap keeps at least a third of its height."""
    share = 1.0
    for i in range(ring.cos.size):
        closes = dx * ring.cos[i] + dy * ring.sin[i]
        if not ring.groove[i] and share * closes > 0.7 * work.gap[i]:
            share = 0.7 * work.gap[i] / closes
        closes = dx * ring.cos_face[i] + dy * ring.sin_face[i]
        if share * closes > 0.7 * work.gap_face[i]:
            share = 0.7 * work.gap_face[i] / closes
    return share


@outer
def newton(film, work, x, y, fx, fy, speed, rate, tolerance, max_iterations):
    """Film and shaft at which the load (fx, fy) is carried; one implicit step if rate > 0.

    Starts from `work.u` and (x, y), where the shaft stays unless `film.free`. Returns position,
    residual, Newton steps, whether the residual is small by the rule of `convergence`, and its
    rounding level, which is looked at where the tolerance is not met soon.
    """
    nx, m = work.u.shape
    wedge = 0.5 * film.ring.slope * speed
    flux = (abs(wedge) + film.ring.scale) * film.axial.widest
    force_scale = max(np.hypot(fx, fy), 0.5e-3 * film.ring.scale * film.ring.area)
    spent = 0
    while True:
        place(film, work, x, y)
        worst, lx, ly = balance(film, work, wedge, rate)
        if film.ring.shaped:
            worst = hold_grooves(film, work.columns)
        residual = worst / flux
        if film.free:
            residual = max(residual, np.hypot(fx - lx, fy - ly) / force_scale)
        done = residual < tolerance or spent == max_iterations or not residual < np.inf
        rounding = 0.0
        if not residual < tolerance and (done or spent >= LATE):
            cells, load = magnitudes(film, work, wedge, rate)
            rounding = rounding_level(max(cells / flux, load / force_scale if film.free else 0.0))
        answered = is_small(residual, tolerance, min(rounding, COARSEST))
        if answered and film.ring.shaped and not narrowest(film, x, y) > NO_GAP:
            residual, answered, done = np.inf, False, True  # closed between two places of the cells
        if done or answered:
            return x, y, residual, spent, answered, rounding
        spent += 1
        matrix(film, work, wedge, rate)
        if film.ring.shaped:
            hold_grooves_in(film.ring, work.band)
        if not factorise(film.lanes, work.band, work.columns.shape[0]):
            return x, y, residual, spent, False, rounding
        substitute(film.lanes, work.band, work.columns)
        dx, dy = 0.0, 0.0
        if film.free:
            x_new, y_new = shaft_step(film, work, x, y, fx - lx, fy - ly)
            dx, dy = x_new - x, y_new - y
            x, y = x_new, y_new
        for i in range(nx):
            base = film.ring.order[i] * m
            for k in range(m):
                row = base + k
                work.u[i, k] -= (
                    work.columns[row, 0] + dx * work.columns[row, 1] + dy * work.columns[row, 2]
                )


@outer
def finish(film, work, x, y, speed, row, stiffness, damping):
    """Results of a film at rest at (x, y): integrals into `row`, and the slopes of the load.

    `stiffness` and `damping` (2, 2) are by position (per clearance) and by velocity (clearances
    per second).
    """
    nx, m = work.u.shape
    place(film, work, x, y)
    wedge = 0.5 * film.ring.slope * speed
    summarise(film, work, x, y, 0.0, 0.0, wedge, row)
    balance(film, work, wedge, 0.0)
    matrix(film, work, wedge, 0.0)
    if film.ring.shaped:
        hold_grooves(film, work.columns)
        hold_grooves_in(film.ring, work.band)
    factorise(film.lanes, work.band, work.columns.shape[0])
    substitute(film.lanes, work.band, work.columns)
    _, by_x, by_y = carried(film, work)
    for i in range(nx):
        base = film.ring.order[i] * m
        squeeze = 0.0 if film.ring.groove[i] else film.ring.slope * film.ring.width[i]
        for k in range(m):
            held = -squeeze * film.axial.weights[k] * work.state[FILL, i, k]
            work.columns[base + k, 0] = 0.0
            work.columns[base + k, 1] = held * film.ring.cos[i]
            work.columns[base + k, 2] = held * film.ring.sin[i]
    substitute(film.lanes, work.band, work.columns)
    _, by_vx, by_vy = carried(film, work)
    for axis in range(2):
        stiffness[axis, 0], stiffness[axis, 1] = -by_x[axis], -by_y[axis]
        damping[axis, 0], damping[axis, 1] = -by_vx[axis], -by_vy[axis]


@inner
def shift(work):
    """Make the unknowns those of the last time, and what were these those of the time before."""
    nx, m = work.u.shape
    for i in range(nx):
        for k in range(m):
            work.before[i, k] = work.last[i, k]
            work.last[i, k] = work.u[i, k]
            work.liquid[2, i, k] = work.liquid[1, i, k]


@inner
def keep(work):
    """Make what is current that of the last time."""
    shift(work)
    nx, m = work.u.shape
    for i in range(nx):
        for k in range(m):
            work.liquid[1, i, k] = work.state[FILL, i, k] * work.gap[i]


@inner
def two_steps(step, before):
    """Rate of an implicit step (BDF2 of variable step), weights of the last two times, and ratio.

    `before` is the step before, 0 at the first: its rule is of first order.
    """
    if before == 0.0:
        return 1.0 / step, 1.0 / step, 0.0, 0.0
    ratio = step / before
    rate = (1.0 + 2.0 * ratio) / (1.0 + ratio) / step
    return rate, (1.0 + ratio) / step, -ratio * ratio / (1.0 + ratio) / step, ratio


@inner
def predict(work, ratio, extrapolate, weight, weight_before):
    """Unknowns to start a step from, and the storage of earlier times."""
    nx, m = work.u.shape
    for i in range(nx):
        for k in range(m):
            last = work.last[i, k]
            work.u[i, k] = last
            if extrapolate:
                work.u[i, k] += ratio * (last - work.before[i, k])
            work.liquid[0, i, k] = (
                weight * work.liquid[1, i, k] + weight_before * work.liquid[2, i, k]
            )


@outer
def march(
    film, work, x, y, time, force, speed, tolerance, max_iterations, accuracy, rows, warmth, states
):
    """Implicit steps of second order (BDF2 of variable step) through all of `time`.

    `work.u` and (x, y) are the film at the first time. A step at which Newton fails, or whose error
    is beyond the `accuracy`, a share of the narrowest gap, is cut, load and speed interpolated.
    Fills `rows` (n, RESULTS), and `states` as `slow_heat` does, and returns
    how many of them.
    """
    place(film, work, x, y)
    keep(work)
    x_before, y_before, x_earlier, y_earlier = x, y, x, y
    wedge = 0.5 * film.ring.slope * states[0, THIN] * speed[0]
    summarise(film, work, x, y, 0.0, 0.0, wedge, rows[0])
    vx, vy = 0.0, 0.0
    step_before, step_earlier, allowed, thin = 0.0, 0.0, np.inf, 1.0
    smallest = SMALLEST if accuracy == np.inf else FINEST
    for n in range(1, time.size):
        whole = time[n] - time[n - 1]
        if warmth.on:
            thin = slow_heat(warmth, states, n, whole, speed, rows, DISSIPATION, -1)
        share, done, spent, steps = min(allowed / whole, 1.0), 0.0, 0, 0
        while done < 1.0:
            at = 1.0 if done + 1.01 * share > 1.0 else done + share
            step = (at - done) * whole
            rate, weight, weight_before, ratio = two_steps(step, step_before)
            x_new, y_new, ahead = x, y, False
            if step_before > 0.0:
                x_ahead = x + ratio * (x - x_before)
                y_ahead = y + ratio * (y - y_before)
                ahead = narrowest(film, x_ahead, y_ahead) > 0.5 * narrowest(film, x, y)
                if ahead:
                    x_new, y_new = x_ahead, y_ahead
            predict(work, ratio, ahead, thin * weight, thin * weight_before)
            x_new, y_new, residual, iterations, converged, rounding = newton(
                film,
                work,
                x_new,
                y_new,
                force[n - 1, 0] + at * (force[n, 0] - force[n - 1, 0]),
                force[n - 1, 1] + at * (force[n, 1] - force[n - 1, 1]),
                thin * (speed[n - 1] + at * (speed[n] - speed[n - 1])),
                thin * rate,
                tolerance,
                max_iterations,
            )
            spent += iterations
            longer = 2.0 if converged else 0.5
            if converged and accuracy < np.inf:
                last, second, third = foreseen(step, step_before, step_earlier)
                left_x = x_new - last * x - second * x_before - third * x_earlier
                left_y = y_new - last * y - second * y_before - third * y_earlier
                left, narrow = np.hypot(left_x, left_y), narrowest(film, x_new, y_new)
                longer = growth(left, narrow, step, step_before, step_earlier, accuracy)
            if longer >= SAFETY:
                keep(work)
                vx = rate * x_new - weight * x - weight_before * x_before
                vy = rate * y_new - weight * y - weight_before * y_before
                x_earlier, y_earlier, x_before, y_before = x_before, y_before, x, y
                x, y = x_new, y_new
                step_earlier, step_before, steps = step_before, step, steps + 1
                share = (
                    min(longer * (at - done), 1.0) if at < 1.0 else max(longer * (at - done), share)
                )
                done = at
            elif share > smallest:
                share *= longer
            else:
                converged = False
                break
        allowed = share * whole if accuracy < np.inf else np.inf
        rows[n, RESIDUAL] = residual
        rows[n, ITERATIONS] = spent
        rows[n, CONVERGED] = converged
        rows[n, ROUNDING] = rounding
        rows[n, STEPS] = steps
        if not converged:
            rows[n, X], rows[n, Y] = x_new, y_new
            return n + 1
        wedge = 0.5 * film.ring.slope * thin * speed[n]
        summarise(film, work, x, y, thin * vx, thin * vy, wedge, rows[n])
    return time.size
