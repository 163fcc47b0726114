"""Compiled operators of the film with few unknowns across the width.

Units and laws are those of `_kernels`. The balance of point k of cell column i, over its width, is

    flux(i + ½) − flux(i − ½) + Δθ H³ Σ stiffness · (p − p_edge) + storage = 0,
    flux = weight · (wedge · F · H − H³ ∂p),   storage = slope · Δθ · weight · (rate · F H − old)

with the cells fixed to the shell. `film` and `work` are those of `reduced_film`.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import DFILL, DLOAD, DP, DSLACK, FILL, LOAD, SLACK, P
from loadflow.journal.film._kernels import apply_law
from loadflow.journal.models._compile import inner
from loadflow.journal.models.reduced_film import (
    DISSIPATION,
    FED,
    FILLED,
    OUTFLOW,
    PEAK,
    SHEAR,
    X,
    Y,
)

NO_GAP = 1e-13  # narrowest gap, in clearances, that is none


@inner
def place(film, work, x, y):
    """Evaluate law and gap at the unknowns and the position (x, y)."""
    apply_law(film.ring.law, film.ring.numbers, film.ring.scale, work.u, work.state)
    for i in range(film.ring.cos.size):
        work.gap[i] = film.ring.base[i] - x * film.ring.cos[i] - y * film.ring.sin[i]
        face = x * film.ring.cos_face[i] + y * film.ring.sin_face[i]
        work.gap_face[i] = film.ring.base_face[i] - face


@inner
def balance(film, work, wedge, rate):
    """Residual of the cells and its derivatives by the position into `columns`, after `place`.

    Returns the largest residual and the load ∫ p (cos θ, sin θ) dA, N.
    """
    nx, m = work.u.shape[0], len(film.lanes)
    axial = film.axial
    p = work.state[P]
    fill = work.state[FILL]
    columns = work.columns
    fx = 0.0
    fy = 0.0
    for i in range(nx):
        base = film.ring.order[i] * m
        c = film.ring.cos[i]
        s = film.ring.sin[i]
        h = work.gap[i]
        step = film.ring.width[i]
        squeeze = film.ring.slope * step
        h3 = step * h * h * h
        slope3 = -3.0 * step * h * h
        load = 0.0
        for k in range(m):
            outflow = 0.0
            for j in range(m):
                outflow += axial.stiffness[k, j] * (p[i, j] - film.ring.p_edge)
            held = squeeze * axial.weights[k]
            by_gap = slope3 * outflow - held * rate * fill[i, k]
            columns[base + k, 0] = (
                h3 * outflow
                + held * (rate * fill[i, k] * h - work.liquid[0, i, k])
                + work.state[SLACK, i, k]
            )
            columns[base + k, 1] = c * by_gap
            columns[base + k, 2] = s * by_gap
            load += axial.weights[k] * work.state[LOAD, i, k]
        fx += load * film.ring.load_x[i]
        fy += load * film.ring.load_y[i]
    for i in range(nx):  # face between cell i and the next one
        right = i + 1 if i + 1 < nx else 0
        base = film.ring.order[i] * m
        base_r = film.ring.order[right] * m
        h = work.gap_face[i]
        by_g = 3.0 * h * h / film.ring.apart[i]
        g = by_g * h / 3.0
        upwind = i if wedge > 0 else right
        for k in range(m):
            w = axial.weights[k]
            rise = p[right, k] - p[i, k]
            flow = wedge * fill[upwind, k]
            q = w * (flow * h - g * rise)
            dq = w * (flow - by_g * rise)
            dx = -dq * film.ring.cos_face[i]
            dy = -dq * film.ring.sin_face[i]
            columns[base + k, 0] += q
            columns[base + k, 1] += dx
            columns[base + k, 2] += dy
            columns[base_r + k, 0] -= q
            columns[base_r + k, 1] -= dx
            columns[base_r + k, 2] -= dy
    largest = 0.0
    for row in range(columns.shape[0]):
        largest = max(largest, abs(columns[row, 0]))
    return largest, film.ring.area * fx, film.ring.area * fy


@inner
def magnitudes(film, work, wedge, rate):
    """Magnitude of the largest terms of `balance`, after it: in a cell, and in the load, N.

    A narrow gap is a difference of numbers near 1, so that what follows from it has fewer digits.
    """
    nx, m = work.u.shape[0], len(film.lanes)
    axial = film.axial
    p = work.state[P]
    fill = work.state[FILL]
    largest, peak, narrow = 0.0, 0.0, 1.0
    for i in range(nx):
        left = i - 1 if i > 0 else nx - 1
        right = i + 1 if i + 1 < nx else 0
        h, h_l, h_r = work.gap[i], work.gap_face[left], work.gap_face[i]
        narrow = min(narrow, h, h_r)
        step = film.ring.width[i]
        around = h_l * h_l * h_l / film.ring.apart[left] + h_r * h_r * h_r / film.ring.apart[i]
        if film.ring.groove[i]:
            continue
        for k in range(m):
            total = film.ring.slope * step * axial.weights[k] * rate * fill[i, k] * h
            total += axial.weights[k] * (
                abs(wedge) * (h_l + h_r)
                + around * max(abs(p[i, k]), abs(p[left, k]), abs(p[right, k]))
            )
            for j in range(m):
                stiffness = step * h * h * h * abs(axial.stiffness[k, j])
                total += stiffness * (abs(p[i, j]) + abs(film.ring.p_edge))
            largest = max(largest, total + abs(work.state[SLACK, i, k]))
            peak = max(peak, abs(work.state[LOAD, i, k]))
    lost = 1.0 + 3.0 / max(narrow, 1e-16)
    return largest * lost, film.ring.area * 2.0 * np.pi * axial.width * peak * lost


@inner
def matrix(film, work, wedge, rate):
    """Band matrix of the derivatives of the residual by the unknowns."""
    nx, m = work.u.shape[0], len(film.lanes)
    axial = film.axial
    band = work.band
    mid = 2 * m
    dp = work.state[DP]
    df = work.state[DFILL]
    band[:] = 0.0
    for i in range(nx):
        base = film.ring.order[i] * m
        h = work.gap[i]
        step = film.ring.width[i]
        squeeze = film.ring.slope * step * rate
        h3 = step * h * h * h
        for k in range(m):
            for j in range(m):
                band[base + k, mid + j - k] = h3 * axial.stiffness[k, j] * dp[i, j]
            held = squeeze * axial.weights[k] * h
            band[base + k, mid] += held * df[i, k] + work.state[DSLACK, i, k]
    for i in range(nx):
        right = i + 1 if i + 1 < nx else 0
        base = film.ring.order[i] * m
        base_r = film.ring.order[right] * m
        shift = base_r - base
        h = work.gap_face[i]
        g = h * h * h / film.ring.apart[i]
        e_l = wedge * h if wedge > 0 else 0.0
        e_r = wedge * h if wedge <= 0 else 0.0
        for k in range(m):
            w = axial.weights[k]
            by_l = w * (e_l * df[i, k] + g * dp[i, k])
            by_r = w * (e_r * df[right, k] - g * dp[right, k])
            band[base + k, mid] += by_l
            band[base + k, mid + shift] += by_r
            band[base_r + k, mid] -= by_r
            band[base_r + k, mid - shift] -= by_l


@inner
def hold_grooves(film, columns):
    """Leave the pressure of grooves as it is, after `balance`; returns the largest residual."""
    m, largest = len(film.lanes), 0.0
    for i in range(film.ring.groove.size):
        base = film.ring.order[i] * m
        for row in range(base, base + m):
            if film.ring.groove[i]:
                columns[row, 0], columns[row, 1], columns[row, 2] = 0.0, 0.0, 0.0
            largest = max(largest, abs(columns[row, 0]))
    return largest


@inner
def hold_grooves_in(ring, band):
    """The same in the band matrix, after `matrix`."""
    m = (band.shape[1] - 1) // 4
    for i in range(ring.groove.size):
        if ring.groove[i]:
            base = ring.order[i] * m
            for row in range(base, base + m):
                for column in range(band.shape[1]):
                    band[row, column] = 0.0
                band[row, 2 * m] = 1.0


@inner
def carried(film, work):
    """Load that each of the columns carries, (fx, fy) of each: a 3 × 2 tuple of scalars."""
    nx, m = work.u.shape[0], len(film.lanes)
    fx0, fx1, fx2, fy0, fy1, fy2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(nx):
        a0, a1, a2 = 0.0, 0.0, 0.0
        base = film.ring.order[i] * m
        for k in range(m):
            w = film.axial.weights[k] * work.state[DLOAD, i, k]
            a0 += w * work.columns[base + k, 0]
            a1 += w * work.columns[base + k, 1]
            a2 += w * work.columns[base + k, 2]
        c = film.ring.load_x[i]
        s = film.ring.load_y[i]
        fx0 += a0 * c
        fx1 += a1 * c
        fx2 += a2 * c
        fy0 += a0 * s
        fy1 += a1 * s
        fy2 += a2 * s
    f = film.ring.area
    return (f * fx0, f * fy0), (f * fx1, f * fy1), (f * fx2, f * fy2)


@inner
def summarise(film, work, x, y, vx, vy, wedge, row):
    """Integrals over the half film into `row`, after `place` at (x, y); units of this module.

    The shaft moves at (vx, vy), clearances per second.
    """
    nx, m = work.u.shape[0], len(film.lanes)
    axial = film.axial
    p = work.state[LOAD]
    peak, dissipation, shear, outflow, liquid, volume = -np.inf, 0.0, 0.0, 0.0, 0.0, 0.0
    half_width = axial.width + axial.end_weight
    for i in range(nx):
        right = i + 1 if i + 1 < nx else 0
        h = work.gap[i]
        step = film.ring.width[i]
        h3 = step * h * h * h
        g = work.gap_face[i] ** 3 / film.ring.apart[i]
        middle, leaves, inside = 0.0, 0.0, film.ring.edge_fill * axial.end_weight
        for k in range(m):
            q = p[i, k] - film.ring.p_edge
            middle += axial.middle[k] * q
            inside += axial.weights[k] * work.state[FILL, i, k]
            dissipation += g * axial.weights[k] * (p[right, k] - p[i, k]) ** 2
            peak = max(peak, p[i, k])
        if film.ring.groove[i]:
            continue
        liquid += step * h * inside
        volume += step * h * half_width
        for k in range(m):
            q = p[i, k] - film.ring.p_edge
            for j in range(m):
                flow = h3 * axial.stiffness[k, j] * (p[i, j] - film.ring.p_edge)
                dissipation += q * flow
                leaves += flow
        peak = max(peak, middle + film.ring.p_edge)
        # what the balance leaves for the end: the slope there is far off where p has a bend nearby
        before = work.gap_face[i - 1 if i > 0 else nx - 1]
        closes = film.ring.slope * step * (vx * film.ring.cos[i] + vy * film.ring.sin[i])
        at_end = axial.end_weight * film.ring.edge_fill
        leaves -= at_end * (wedge * (work.gap_face[i] - before) - closes)
        outflow += max(leaves, 0.0)
        shear += step * half_width / h
    row[X] = x
    row[Y] = y
    row[PEAK] = peak
    row[DISSIPATION] = dissipation
    row[SHEAR] = shear
    row[OUTFLOW] = outflow
    row[FILLED] = liquid / volume
    row[FED] = fed(film, work, wedge) if film.ring.shaped else 0.0


@inner
def fed(film, work, wedge):
    """Flow from the grooves into the half film, less what flows back, after `place`."""
    nx, m = work.u.shape[0], len(film.lanes)
    p = work.state[P]
    fill = work.state[FILL]
    total = 0.0
    for i in range(nx):
        right = i + 1 if i + 1 < nx else 0
        if film.ring.groove[i] == film.ring.groove[right]:
            continue
        h = work.gap_face[i]
        g = h * h * h / film.ring.apart[i]
        upwind = i if wedge > 0 else right
        flow = film.axial.end_weight * film.ring.edge_fill * wedge * h
        for k in range(m):
            rise = p[right, k] - p[i, k]
            flow += film.axial.weights[k] * (wedge * fill[upwind, k] * h - g * rise)
        total += flow if film.ring.groove[i] else -flow
    return total


@inner
def narrowest(film, x, y):
    """Narrowest gap around a shaft at (x, y), in clearances, between the cells, too."""
    return least_around(film.ring, x, y) if film.ring.shaped else 1.0 - np.hypot(x, y)


@inner
def least_around(ring, x, y):
    """Narrowest gap of a shaped bore around a shaft at (x, y), between faces and at them."""
    least = np.inf
    for i in range(ring.cos.size):
        if ring.back[i] == 0.0:
            continue  # a groove; its faces are those of the cells beside it
        left = i - 1 if i > 0 else ring.cos.size - 1
        c, s, c_next, s_next = (
            ring.cos_face[left], ring.sin_face[left], ring.cos_face[i], ring.sin_face[i],
        )  # fmt: skip
        ex, ey = ring.lobe[1, i] + x, ring.lobe[2, i] + y
        reach = max(ex * c + ey * s, ex * c_next + ey * s_next)
        if ex * s < ey * c and ex * s_next > ey * c_next:  # it narrows, then widens
            reach = np.hypot(ex, ey)
        least = min(least, ring.lobe[0, i] - reach)
    return least
