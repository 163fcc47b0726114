"""Compiled operators of the reduced film with effects: tilt, asperities, a shell that gives way.

Units and laws are those of `_reduced_kernels`. The gap changes across the width, so that the axial
flow of point k of cell column i is Σ_l D_lk w_l H_l³ ∂p_l, with the slopes ∂p = D (p − p_edge) at
all points l of the rule of Gauss and Lobatto. `film` and `work` are those of `composed_film`.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import DFILL, DLOAD, DP, DSLACK, FILL, LOAD, SLACK, P
from loadflow.journal.film._rough_kernels import sheared
from loadflow.journal.film._turbulence_kernels import SHEAR, factor
from loadflow.journal.models import composed_film as at
from loadflow.journal.models._compile import inner, once
from loadflow.journal.models._composed_gap_kernels import (
    CUBE,
    DRAG,
    DRAG_SLOPE,
    FLOW,
    FLOW_SLOPE,
    MEAN,
    OPEN,
    PLANES,
    narrowest,
    opened,
    smooth_beyond,
    touch,
)
from loadflow.journal.models._reduced_kernels import hold_grooves_in


@inner
def balance(film, work, wedge, rate):
    """Residual of the cells into the first of the `columns`, after `place`; the largest of it.

    Also fills `work.load`, and `work.slope` for `matrix` and `slopes`.
    """
    nx, m = work.u.shape
    points = film.nodes.z.size
    z, weights, slopes = film.nodes.z, film.nodes.weights, film.nodes.slopes
    p, fill, columns, gap, face = (
        work.state[P], work.state[FILL], work.columns, work.gap, work.face,
    )  # fmt: skip
    fx, fy, mx, my = 0.0, 0.0, 0.0, 0.0
    for i in range(nx):
        base = film.ring.order[i] * m
        step = film.ring.width[i]
        squeeze = film.ring.slope * step
        load, turn = 0.0, 0.0
        for k in range(m):
            held = squeeze * weights[k]
            columns[base + k, 0] = (
                held * (rate * fill[i, k] * gap[MEAN, i, k] - work.liquid[0, i, k])
                + work.state[SLACK, i, k]
            )
            load += weights[k] * work.state[LOAD, i, k]
            turn += weights[k] * work.state[LOAD, i, k] * z[k]
        for k in range(points):
            slope = 0.0
            for j in range(m):
                slope += slopes[k, j] * (p[i, j] - film.ring.p_edge)
            work.slope[i, k] = slope
            flow = step * weights[k] * slope * gap[CUBE, i, k]
            for j in range(m):
                columns[base + j, 0] += slopes[k, j] * flow
        fx += load * film.ring.load_x[i]
        fy += load * film.ring.load_y[i]
        mx -= turn * film.ring.load_y[i]
        my += turn * film.ring.load_x[i]
    for i in range(nx):  # face between cell i and the next one
        right = i + 1 if i + 1 < nx else 0
        base = film.ring.order[i] * m
        base_r = film.ring.order[right] * m
        upwind = i if wedge > 0 else right
        for k in range(m):
            rise = (p[right, k] - p[i, k]) / film.ring.apart[i]
            drag = wedge * fill[upwind, k]
            flow = weights[k] * (drag * face[DRAG, i, k] - face[FLOW, i, k] * rise)
            columns[base + k, 0] += flow
            columns[base_r + k, 0] -= flow
    if film.ring.shaped:
        _hold_grooves(film, columns, 0, 1)
    largest = 0.0
    for row in range(columns.shape[0]):
        largest = max(largest, abs(columns[row, 0]))
    unit = film.ring.area
    work.load[0], work.load[1] = unit * fx, unit * fy
    work.load[2], work.load[3] = unit * mx, unit * my
    return largest


@inner
def slopes_of_balance(film, work, wedge, rate, size):
    """Derivatives of the residual by `size` coordinates into the further columns, after it."""
    nx, m = work.u.shape
    points = film.nodes.z.size
    z, weights, slopes = film.nodes.z, film.nodes.weights, film.nodes.slopes
    p, fill, columns, gap, face = (
        work.state[P], work.state[FILL], work.columns, work.gap, work.face,
    )  # fmt: skip
    for i in range(nx):
        base = film.ring.order[i] * m
        c, s = film.ring.cos[i], film.ring.sin[i]
        step = film.ring.width[i]
        squeeze = film.ring.slope * step
        for k in range(m):
            falls = -squeeze * weights[k] * rate * fill[i, k] * gap[OPEN, i, k]
            columns[base + k, 1] = falls
            columns[base + k, 3] = falls * z[k]
        for k in range(points):
            by_gap = -step * weights[k] * work.slope[i, k] * work.gap_slope[i, k]
            for j in range(m):
                columns[base + j, 1] += slopes[k, j] * by_gap
            if size > 2:
                for j in range(m):
                    columns[base + j, 3] += slopes[k, j] * by_gap * z[k]
        for k in range(m):
            by_gap, by_turn = columns[base + k, 1], columns[base + k, 3]
            columns[base + k, 1] = c * by_gap
            columns[base + k, 2] = s * by_gap
            if size > 2:
                columns[base + k, 3] = -s * by_turn
                columns[base + k, 4] = c * by_turn
    for i in range(nx):  # face between cell i and the next one
        right = i + 1 if i + 1 < nx else 0
        base = film.ring.order[i] * m
        base_r = film.ring.order[right] * m
        upwind = i if wedge > 0 else right
        c, s = film.ring.cos_face[i], film.ring.sin_face[i]
        for k in range(m):
            rise = (p[right, k] - p[i, k]) / film.ring.apart[i]
            drag = wedge * fill[upwind, k]
            by_gap = drag * face[DRAG_SLOPE, i, k] - face[FLOW_SLOPE, i, k] * rise
            by_gap *= -weights[k]
            columns[base + k, 1] += by_gap * c
            columns[base_r + k, 1] -= by_gap * c
            columns[base + k, 2] += by_gap * s
            columns[base_r + k, 2] -= by_gap * s
            if size > 2:
                by_gap *= z[k]
                columns[base + k, 3] -= by_gap * s
                columns[base_r + k, 3] += by_gap * s
                columns[base + k, 4] += by_gap * c
                columns[base_r + k, 4] -= by_gap * c
    if film.ring.shaped:
        _hold_grooves(film, columns, 1, 5)


@once
def magnitudes(film, work, wedge, rate):
    """Magnitude of the largest terms of `balance`, after it: in a cell, and in the load, N."""
    nx, m = work.u.shape
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
            total = film.ring.slope * step * weights[k] * rate * fill[i, k] * gap[MEAN, i, k]
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
    """Band matrix of the derivatives of the residual by the unknowns."""
    nx, m = work.u.shape
    points = film.nodes.z.size
    weights, slopes = film.nodes.weights, film.nodes.slopes
    band, gap, face = work.band, work.gap, work.face
    pairs, block = film.nodes.pairs, work.block
    mid = 2 * m
    dp, df, p = work.state[DP], work.state[DFILL], work.state[P]
    fill, grows = work.state[FILL], work.state[DLOAD]
    give = film.give
    band[:] = 0.0
    for i in range(nx):
        base = film.ring.order[i] * m
        step = film.ring.width[i]
        squeeze = film.ring.slope * step * rate
        for j in range(points):  # one long loop for all pairs of points
            flow = step * gap[CUBE, i, j]
            for pair in range(m * m):
                block[pair] = flow * pairs[j, pair] + (block[pair] if j > 0 else 0.0)
        for k in range(m):
            for n in range(m):
                band[base + k, mid + n - k] = block[k * m + n] * dp[i, n]
        for k in range(m):
            held = squeeze * weights[k]
            band[base + k, mid] += held * gap[MEAN, i, k] * df[i, k] + work.state[DSLACK, i, k]
            if give > 0.0:
                band[base + k, mid] += held * fill[i, k] * gap[OPEN, i, k] * give * grows[i, k]
                wider = step * weights[k] * work.gap_slope[i, k] * work.slope[i, k]
                wider *= give * grows[i, k]
                for n in range(m):
                    band[base + n, mid + k - n] += slopes[k, n] * wider
    for i in range(nx):
        right = i + 1 if i + 1 < nx else 0
        base = film.ring.order[i] * m
        base_r = film.ring.order[right] * m
        shift = base_r - base
        upwind = i if wedge > 0 else right
        step = film.ring.apart[i]
        for k in range(m):
            w = weights[k]
            h = w * wedge * face[DRAG, i, k]
            g = w * face[FLOW, i, k] / step
            by_l = g * dp[i, k]
            by_r = -g * dp[right, k]
            if wedge > 0:
                by_l += h * df[i, k]
            else:
                by_r += h * df[right, k]
            if give > 0.0:
                rise = (p[right, k] - p[i, k]) / step
                drag = wedge * fill[upwind, k] * face[DRAG_SLOPE, i, k]
                wider = 0.5 * give * w * (drag - face[FLOW_SLOPE, i, k] * rise)
                by_l += wider * grows[i, k]
                by_r += wider * grows[right, k]
            band[base + k, mid] += by_l
            band[base + k, mid + shift] += by_r
            band[base_r + k, mid] -= by_r
            band[base_r + k, mid - shift] -= by_l
    if film.ring.shaped:
        hold_grooves_in(film.ring, band)


@once
def _hold_grooves(film, columns, first, last):
    """Leave the pressure of grooves as it is, in the columns from `first` to `last`."""
    m = columns.shape[0] // film.ring.groove.size
    for i in range(film.ring.groove.size):
        if film.ring.groove[i]:
            base = film.ring.order[i] * m
            for row in range(base, base + m):
                for column in range(first, last):
                    columns[row, column] = 0.0


@inner
def carry(film, work, size):
    """Load that each of the first 1 + `size` columns carries into `work.carried`."""
    nx, m = work.u.shape
    z, weights, columns, carried = film.nodes.z, film.nodes.weights, work.columns, work.carried
    slope = work.state[DLOAD]
    carried[:] = 0.0
    unit = film.ring.area
    if size == 2:  # forces alone
        fx0, fx1, fx2, fy0, fy1, fy2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for i in range(nx):
            base = film.ring.order[i] * m
            a, b, d = 0.0, 0.0, 0.0
            for k in range(m):
                part, row = weights[k] * slope[i, k], base + k
                a += part * columns[row, 0]
                b += part * columns[row, 1]
                d += part * columns[row, 2]
            c, s = unit * film.ring.load_x[i], unit * film.ring.load_y[i]
            fx0, fx1, fx2 = fx0 + a * c, fx1 + b * c, fx2 + d * c
            fy0, fy1, fy2 = fy0 + a * s, fy1 + b * s, fy2 + d * s
        carried[0, 0], carried[1, 0], carried[2, 0] = fx0, fx1, fx2
        carried[0, 1], carried[1, 1], carried[2, 1] = fy0, fy1, fy2
    for i in range(nx if size > 2 else 0):
        base = film.ring.order[i] * m
        c, s = unit * film.ring.load_x[i], unit * film.ring.load_y[i]
        for column in range(1 + size):
            load, turn = 0.0, 0.0
            for k in range(m):
                part = weights[k] * slope[i, k] * columns[base + k, column]
                load += part
                turn += part * z[k]
            carried[column, 0] += load * c
            carried[column, 1] += load * s
            carried[column, 2] -= turn * s
            carried[column, 3] += turn * c
    if film.yielding.on:
        _carry_touch(film, work, size)


@once
def _carry_touch(film, work, size):
    """Add what asperities carry more by way of the shell, which the film presses open."""
    nx, m = work.u.shape
    for i in range(nx):
        base = film.ring.order[i] * m
        for k in range(m):
            slope = work.state[DLOAD, i, k]
            for column in range(1 + size):
                change = slope * work.columns[base + k, column]
                for a in range(size):
                    work.carried[column, a] += work.pressed[a, i, k] * change


@inner
def summarise(film, work, q, wedge, row):
    """Integrals over the film into `row`, after `place` at `q`; units of `_reduced_kernels`."""
    nx, m = work.u.shape
    points = film.nodes.z.size
    weights, slopes, fine = film.nodes.weights, film.nodes.slopes, film.nodes.fine
    p, gap, rough = work.state[LOAD], work.gap, film.rough
    far = -1.0 if rough.size == 0.0 else smooth_beyond(rough)
    numbers = (work.numbers[0], work.numbers[1], film.regime.begin, film.regime.end)
    peak, dissipation, shear, outflow = -np.inf, 0.0, 0.0, 0.0
    liquid, volume, highest, grown = 0.0, 0.0, 0, 0.0
    fx, fy, mx, my = 0.0, 0.0, 0.0, 0.0
    for i in range(nx):
        right = i + 1 if i + 1 < nx else 0
        load, turn = 0.0, 0.0
        step = film.ring.width[i]
        for k in range(points):
            slope = 0.0
            for j in range(m):
                slope += slopes[k, j] * (p[i, j] - film.ring.p_edge)
            flow = step * gap[CUBE, i, k] * slope
            dissipation += weights[k] * flow * slope
            inside = film.ring.edge_fill
            if k < m:
                inside = work.state[FILL, i, k]
                rise = p[right, k] - p[i, k]
                conducts = work.face[FLOW, i, k] / film.ring.apart[i]
                dissipation += conducts * weights[k] * rise * rise
                if p[i, k] > peak:
                    peak, highest = p[i, k], i
                load += weights[k] * p[i, k]
                turn += weights[k] * p[i, k] * film.nodes.z[k]
            elif not film.ring.groove[i]:
                outflow += max(-film.nodes.ends[k - m] * flow, 0.0)
            if film.ring.groove[i]:
                continue
            held = weights[k] * step * gap[MEAN, i, k]
            liquid += held * inside
            volume += held
            h = gap[PLANES, i, k]
            if film.yielding.on:
                h = opened(film.yielding, h)[0]
                if k < m:
                    lifted = h - gap[PLANES, i, k]
                    grown = max(grown, film.give * (p[i, k] - film.ring.p_edge) + lifted)
            inverse = sheared(h, rough.size, rough.along) if h <= far else 1.0 / h
            if film.regime.on:
                inverse *= factor(h, numbers, SHEAR)[0]
            shear += weights[k] * step * inverse
        fx += load * film.ring.load_x[i]
        fy += load * film.ring.load_y[i]
        mx -= turn * film.ring.load_y[i]
        my += turn * film.ring.load_x[i]
    for i in range(highest - 1, highest + 2):  # between the points
        for k in range(fine.shape[0]):
            value = film.ring.p_edge
            for j in range(m):
                value += fine[k, j] * (p[i % nx, j] - film.ring.p_edge)
            peak = max(peak, value)
    left = 0.0
    for n in range(film.nodes.highest.shape[0]):
        value = 0.0
        for j in range(m):
            value += film.nodes.highest[n, j] * (p[highest, j] - film.ring.p_edge)
        left = max(left, abs(value))
    for k in range(4):
        row[k] = q[k]
    row[at.PEAK] = peak
    row[at.DISSIPATION] = dissipation
    row[at.SHEAR] = shear
    row[at.OUTFLOW] = outflow
    row[at.FILLED] = liquid / volume
    row[at.LEAST] = narrowest(film, work)
    row[at.GROWTH] = max(grown, film.give * (peak - film.ring.p_edge))
    row[at.NORMAL] = touch(film, work, q)
    unit = film.ring.area
    row[at.MOMENT_X] = unit * mx + work.touch[0, 2]
    row[at.MOMENT_Y] = unit * my + work.touch[0, 3]
    row[at.CONTACT_X] = work.touch[0, 0]
    row[at.CONTACT_Y] = work.touch[0, 1]
    mean = np.hypot(unit * fx + work.touch[0, 0], unit * fy + work.touch[0, 1])
    mean /= (
        2.0 * film.ring.area * film.nodes.width
    )  # beside asperities a film may carry next to nothing
    row[at.HIGHEST] = left / max(peak - film.ring.p_edge, mean, 1e-3 * film.ring.scale)
    row[at.FED] = fed(film, work, wedge) if film.ring.shaped else 0.0


@once
def fed(film, work, wedge):
    """Flow from the grooves into the film, less what flows back, after `place`."""
    nx, m = work.u.shape
    weights, p, fill, face = film.nodes.weights, work.state[P], work.state[FILL], work.face
    total = 0.0
    for i in range(nx):
        right = i + 1 if i + 1 < nx else 0
        if film.ring.groove[i] == film.ring.groove[right]:
            continue
        upwind = i if wedge > 0 else right
        flow = 0.0
        for k in range(m):
            rise = (p[right, k] - p[i, k]) / film.ring.apart[i]
            drag = wedge * fill[upwind, k] * face[DRAG, i, k]
            flow += weights[k] * (drag - face[FLOW, i, k] * rise)
        for k in range(m, film.nodes.z.size):  # the ends, at the pressure of the grooves
            gap = film.ring.base_face[i] - work.centre[0, k] * film.ring.cos_face[i]
            gap -= work.centre[1, k] * film.ring.sin_face[i]
            flow += weights[k] * wedge * film.ring.edge_fill * gap
        total += flow if film.ring.groove[i] else -flow
    return total
