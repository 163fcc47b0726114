"""Compiled operators of the reduced film with effects: tilt, asperities, a shell that gives way.

Units and laws are those of `_reduced_kernels`. The gap changes across the width, so that the axial
flow of point k of cell column i is Σ_l D_lk w_l H_l³ ∂p_l, with the slopes ∂p = D (p − p_edge) at
all points l of the rule of Gauss and Lobatto. `film` and `work` are those of `composed.film`.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import DFILL, DLOAD, DP, DSLACK, FILL, LOAD, SLACK, P
from loadflow.journal.models._compile import inner, once
from loadflow.journal.models.composed.kernels._gap_kernels import (
    CUBE,
    DRAG,
    DRAG_SLOPE,
    FLOW,
    FLOW_SLOPE,
    MEAN,
    OPEN,
    narrowest,
)
from loadflow.journal.models.composed.kernels._of_effects import of_shell
from loadflow.journal.models.composed.kernels._shell_growth_kernels import load_of, open_by, respond
from loadflow.journal.models.composed.kernels._shell_step_kernels import follow_place
from loadflow.journal.models.composed.kernels._supply_kernels import (
    FIRST,
    SECOND,
    hold_in_matrix,
    hold_points,
)
from loadflow.numerics.lanes import LANES, larger, magnitude, put, spread, take


@inner
def balance(film, work, wedge, rate):
    """Residual of the cells into the first of the `columns`, after `place`; the largest of it.

    Also fills `work.load`, and `work.slope` for `matrix` and `slopes`.
    """
    nx, wide = work.u.shape
    lanes, ring, weights = film.lanes, film.ring, film.nodes.weights
    m, points, columns = film.nodes.slopes.shape[1], film.nodes.z.size, work.columns
    p, fill, carried, slack = work.state[P], work.state[FILL], work.state[LOAD], work.state[SLACK]
    mean, cube, flows, drags = work.gap[MEAN], work.gap[CUBE], work.face[FLOW], work.face[DRAG]
    opens, squeeze = work.gap[OPEN], work.squeeze
    flow, row, sum_x, sum_y = work.row[0], work.row[1], work.row[2], work.row[3]
    up, up_right = max(wedge, 0.0), min(wedge, 0.0)  # from upstream
    for i in range(nx):
        here, step, pressure = i * wide, ring.width[i], p[i]
        across = 0.0 if ring.groove[i] else step
        for at in range(0, wide, LANES):
            slope = spread(0.0)
            for j in range(m):
                slope = slope + take(lanes.slopes, j * wide + at) * (pressure[j] - ring.p_edge)
            put(work.slope, here + at, slope)
            put(flow, at, slope * take(cube, here + at) * across)
        for at in range(0, wide, LANES):
            grows = take(mean, here + at) * rate + take(opens, here + at) * take(squeeze, here + at)
            held = take(fill, here + at) * grows
            held = (held - take(work.liquid, here + at)) * (ring.slope * step)
            left = held * take(lanes.weights, at) + take(slack, here + at) * take(lanes.inner, at)
            for k in range(points):
                left = left + take(lanes.shares, k * wide + at) * (weights[k] * flow[k])
            put(columns, here + at, left)
    largest = 0.0
    for at in range(0, wide, LANES):
        fx, fy, most, own = spread(0.0), spread(0.0), spread(0.0), take(lanes.weights, at)
        before = spread(0.0)
        for i in range(-1, nx):  # the face behind cell i, and before the next one
            here = (i if i >= 0 else nx - 1) * wide + at
            right = (i + 1 if i + 1 < nx else 0) * wide + at
            rise = (take(p, right) - take(p, here)) * (1.0 / ring.apart[i])
            drag = take(fill, here) * up + take(fill, right) * up_right
            after = (drag * take(drags, here) - take(flows, here) * rise) * own
            if i >= 0:
                left = take(columns, here) + after - before
                put(columns, here, left)
                most = larger(most, magnitude(left))
                fx = fx + take(carried, here) * ring.load_x[i]
                fy = fy + take(carried, here) * ring.load_y[i]
            before = after
        put(row, at, most)
        put(sum_x, at, fx * own)
        put(sum_y, at, fy * own)
    for k in range(m):
        largest = max(largest, row[k])
    if film.held.on:  # first: what a whole column feeds is what it is missing
        largest = hold_points(film, work, FIRST, SECOND, rate)
    if ring.shaped:
        largest = _hold_grooves(film, columns, 0, 1)
    unit, z = ring.area, film.nodes.z
    work.load[:] = 0.0
    for k in range(m):
        work.load[0] += unit * sum_x[k]
        work.load[1] += unit * sum_y[k]
        work.load[2] -= unit * sum_y[k] * z[k]
        work.load[3] += unit * sum_x[k] * z[k]
    return largest


@inner
def slopes_of_balance(film, work, wedge, rate, size):
    """Derivatives of the residual by `size` coordinates into the further columns, after it."""
    nx, wide = work.u.shape
    lanes, ring, weights = film.lanes, film.ring, film.nodes.weights
    points, columns, block = film.nodes.z.size, work.columns, nx * wide
    p, fill, opens = work.state[P], work.state[FILL], work.gap[OPEN]
    flows, drags = work.face[FLOW_SLOPE], work.face[DRAG_SLOPE]
    by_gap, by_turn = work.row[0], work.row[1]
    up, up_right = max(wedge, 0.0), min(wedge, 0.0)
    for i in range(nx):
        here, step, c, s = i * wide, ring.width[i], ring.cos[i], ring.sin[i]
        for at in range(0, wide, LANES):
            wider = take(work.slope, here + at) * take(work.gap_slope, here + at) * -step
            put(by_gap, at, wider)
            put(by_turn, at, wider * take(lanes.z, at))
        for at in range(0, wide, LANES):
            grows = take(fill, here + at) * take(opens, here + at) * (-ring.slope * step * rate)
            grows = grows * take(lanes.weights, at)
            turns = grows * take(lanes.z, at)
            for k in range(points):
                share = take(lanes.shares, k * wide + at)
                grows = grows + share * (weights[k] * by_gap[k])
                if size > 2:
                    turns = turns + share * (weights[k] * by_turn[k])
            put(columns, block + here + at, grows * c)
            put(columns, 2 * block + here + at, grows * s)
            if size > 2:
                put(columns, 3 * block + here + at, turns * -s)
                put(columns, 4 * block + here + at, turns * c)
    for at in range(0, wide, LANES):
        z_at, own = take(lanes.z, at), take(lanes.weights, at)
        before, c_before, s_before = spread(0.0), 0.0, 0.0
        for i in range(-1, nx):  # the face behind cell i, and before the next one
            here = (i if i >= 0 else nx - 1) * wide + at
            right = (i + 1 if i + 1 < nx else 0) * wide + at
            c, s = ring.cos_face[i], ring.sin_face[i]
            rise = (take(p, right) - take(p, here)) * (1.0 / ring.apart[i])
            drag = take(fill, here) * up + take(fill, right) * up_right
            after = (take(flows, here) * rise - drag * take(drags, here)) * own
            if i >= 0:
                x, y = after * c - before * c_before, after * s - before * s_before
                put(columns, block + here, take(columns, block + here) + x)
                put(columns, 2 * block + here, take(columns, 2 * block + here) + y)
                if size > 2:
                    put(columns, 3 * block + here, take(columns, 3 * block + here) - y * z_at)
                    put(columns, 4 * block + here, take(columns, 4 * block + here) + x * z_at)
            before, c_before, s_before = after, c, s
    if film.held.on:
        hold_points(film, work, SECOND, 1 + size, rate)
    if ring.shaped:
        _hold_grooves(film, columns, 1, 5)
    follow_place(film, work, wedge, rate, size)


@once
def magnitudes(film, work, wedge, rate):
    """Magnitude of the largest terms of `balance`, after it: in a cell, and in the load, N."""
    nx, m = film.ring.cos.size, film.nodes.slopes.shape[1]
    p, fill, face, gap = work.state[P], work.state[FILL], work.face, work.gap
    weights, slopes = film.nodes.weights, film.nodes.slopes
    largest, peak = 0.0, 0.0
    for i in range(nx):
        left = i - 1 if i > 0 else nx - 1
        right = i + 1 if i + 1 < nx else 0
        step = film.ring.width[i]
        if film.ring.groove[i]:
            continue
        for k in range(m):
            drags = face[DRAG, left, k] + face[DRAG, i, k]
            flows = face[FLOW, left, k] / film.ring.apart[left]
            flows += face[FLOW, i, k] / film.ring.apart[i]
            total = rate * gap[MEAN, i, k] + abs(work.squeeze[i, k])
            total *= film.ring.slope * step * weights[k] * fill[i, k]
            total += weights[k] * (
                abs(wedge) * drags + flows * max(abs(p[i, k]), abs(p[left, k]), abs(p[right, k]))
            )
            for j in range(weights.size):
                flow = step * weights[j] * gap[CUBE, i, j] * abs(slopes[j, k])
                for n in range(m):
                    total += flow * abs(slopes[j, n]) * (abs(p[i, n]) + abs(film.ring.p_edge))
            largest = max(largest, total + abs(work.state[SLACK, i, k]))
            peak = max(peak, abs(work.state[LOAD, i, k]))
    least = max(narrowest(film, work), film.rough.size)
    lost = 1.0 + 3.0 / max(least, 1e-16)
    pressed = film.ring.area * 2.0 * np.pi * film.nodes.width * peak
    stiff = 0.0
    for a in range(4):
        stiff = max(stiff, abs(work.touch[1 + a, a]))
    return largest * lost, pressed * lost + stiff


@inner
def matrix(film, work, wedge, rate):
    """Derivatives of the residual by the unknowns, after `balance`."""
    nx, wide = work.u.shape
    lanes, ring, nodes, give = film.lanes, film.ring, film.nodes, film.give
    m, points, system, scaled = film.nodes.slopes.shape[1], film.nodes.z.size, work.matrix, work.row
    mean, cube, opens = work.gap[MEAN], work.gap[CUBE], work.gap[OPEN]
    dp, df, slacks = work.state[DP], work.state[DFILL], work.state[DSLACK]
    p, fill, grows = work.state[P], work.state[FILL], work.state[DLOAD]
    flows, drags = work.face[FLOW], work.face[DRAG]
    flow_slopes, drag_slopes = work.face[FLOW_SLOPE], work.face[DRAG_SLOPE]
    up, up_right = max(wedge, 0.0), min(wedge, 0.0)
    for i in range(nx):  # across
        conducts, by = cube[i], dp[i]
        for c in range(m):
            for at in range(0, wide, LANES):
                column = spread(0.0)
                for j in range(points):
                    column = column + take(lanes.pairs, (j * m + c) * wide + at) * conducts[j]
                column = column * by[c]
                if give > 0.0:
                    wider = nodes.weights[c] * work.gap_slope[i, c] * work.slope[i, c]
                    wider *= give * grows[i, c]
                    column = column + take(lanes.shares, c * wide + at) * wider
                put(system.block, (i * m + c) * wide + at, column * ring.width[i])
    if give > 0.0:
        _joined(film, work)
    for at in range(0, wide, LANES):
        own, before, given = take(lanes.weights, at), spread(0.0), 0.5 * give
        for i in range(-1, nx):  # the face behind cell i, and before the next one
            cell, next_cell = i if i >= 0 else nx - 1, i + 1 if i + 1 < nx else 0
            here, right, inverse = cell * wide + at, next_cell * wide + at, 1.0 / ring.apart[i]
            drag, flow = own * take(drags, here), own * take(flows, here) * inverse
            to_left = flow * take(dp, here) + drag * take(df, here) * up
            to_right = drag * take(df, right) * up_right - flow * take(dp, right)
            if give > 0.0:
                rise = (take(p, right) - take(p, here)) * inverse
                dragged = take(fill, here) * up + take(fill, right) * up_right
                wider = dragged * take(drag_slopes, here) - take(flow_slopes, here) * rise
                wider = wider * own * given
                to_left = to_left + wider * take(grows, here)
                to_right = to_right + wider * take(grows, right)
            put(system.left, right, to_left * -1.0)
            put(system.right, here, to_right)
            if i >= 0:
                squeeze = take(mean, here) * rate + take(opens, here) * take(work.squeeze, here)
                held = squeeze * take(df, here)
                if give > 0.0:
                    shell = take(opens, here) * take(grows, here) * (give * rate)
                    held = held + take(fill, here) * shell
                held = held * own * (ring.slope * ring.width[i])
                held = held + take(slacks, here) * take(lanes.inner, at)
                put(scaled, at, held + to_left - before)
                for k in range(at, min(m, at + LANES)):
                    system.block[i, k, k] += scaled[0, k]
            before = to_right
    if ring.shaped:
        for i in range(nx):
            if ring.groove[i]:
                system.left[i], system.right[i], system.block[i] = 0.0, 0.0, 0.0
                for k in range(m):
                    system.block[i, k, k] = 1.0
    if film.held.on:
        hold_in_matrix(film, system)


@inner
def _joined(film, work):
    """Add what the pressure opens at the points of no width where stretches meet to `matrix`."""
    nodes, m, grows = film.nodes, film.nodes.slopes.shape[1], work.state[DLOAD]
    for n in range(nodes.joints.size):
        q, c = m + n, nodes.joints[n]
        for i in range(film.ring.cos.size):
            wider = nodes.weights[q] * work.gap_slope[i, q] * work.slope[i, q]
            wider *= film.give * grows[i, c] * film.ring.width[i]
            for k in range(m):
                work.matrix.block[i, c, k] += nodes.slopes[q, k] * wider


@once
def _hold_grooves(film, columns, first, last):
    """Leave the pressure of grooves as it is in the columns `first` … `last`; the largest."""
    largest = 0.0
    for column in range(first, last):
        for i in range(film.ring.groove.size):
            for k in range(columns.shape[2]):
                if film.ring.groove[i]:
                    columns[column, i, k] = 0.0
                largest = max(largest, abs(columns[column, i, k]))
    return largest


@inner
def carry(film, work, size):
    """Load that each of the first 1 + `size` columns carries into `work.carried`."""
    nx, wide = work.u.shape
    z, weights, columns, carried = film.nodes.z, film.nodes.weights, work.columns, work.carried
    slope, ring, unit, sums = work.state[DLOAD], film.ring, film.ring.area, work.row
    carried[:] = 0.0
    for column in range(1 + size):
        for at in range(0, wide, LANES):
            fx, fy = spread(0.0), spread(0.0)
            for i in range(nx):
                part = take(slope, i * wide + at) * take(columns, (column * nx + i) * wide + at)
                fx, fy = fx + part * ring.load_x[i], fy + part * ring.load_y[i]
            put(sums, at, fx)
            put(sums, wide + at, fy)
        for k in range(film.nodes.slopes.shape[1]):
            x, y = unit * weights[k] * sums[0, k], unit * weights[k] * sums[1, k]
            carried[column, 0] += x
            carried[column, 1] += y
            if size > 2:
                carried[column, 2] -= y * z[k]
                carried[column, 3] += x * z[k]
    if film.yielding.on:
        _carry_touch(film, work, size)
        _carry_growth(film, work, size)


@inner
def _carry_touch(film, work, size):
    """Add what asperities carry more by way of the shell, which the film presses open."""
    nx, m = film.ring.cos.size, film.nodes.slopes.shape[1]
    for i in range(nx):
        for k in range(m):
            slope = work.state[DLOAD, i, k]
            for column in range(1 + size):
                change = slope * work.columns[column, i, k]
                for a in range(size):
                    work.carried[column, a] += work.pressed[a, i, k] * change


@of_shell(lambda film, work, size: None)
def _carry_growth(film, work, size):
    """Add what they carry more by a shell that gives way all over."""
    modes, rub = work.modes, work.modes.rub
    if rub.on[0] > 0.0:
        for column in range(1 + size):
            load_of(work, work.columns, column * work.u.size)
            respond(film, work, modes.other)
            open_by(film, modes.other, modes.change)
            for i in range(rub.touched.size):
                if rub.touched[i]:
                    for k in range(film.nodes.z.size):
                        for a in range(size):
                            more = rub.pushed[a, i, k] * modes.change[i, k]
                            work.carried[column, a] += more
