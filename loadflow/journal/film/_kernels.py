"""Compiled loops of the film: gap coefficients, assembly, integrals.

Everything is written for lengths in units of the shaft radius R, the gap in units of the radial
clearance and pressures in Pa. The balance of a film cell is then ::

    sum of outflows (wedge · F · H − H³ ∂p) + storage = 0,   wedge = 6 η ω / ψ²

which is (3.51) of [Jonuschies 2015] times 12 η / ψ² …. A symmetric gap is solved over half of
the width. On a cone or a plane ring the same balance holds in isothermal coordinates: only the
surface of a cell, `area`, then differs from its width `dz`; it scales what the surface drags along
and stores.

Coefficients of the gap have the shape (8, nx + 1, rows): one row where the gap does not change
along the axis, else one for each row of cells and a last one for the far end.
"""

from __future__ import annotations

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.extending import intrinsic

from loadflow.journal.cavitation import DFILL, DP, DSLACK, FILL, LOAD, SLACK, P

# coefficients of the gap: on the faces around, on the faces across (H3), on cells; CELL3 is ∫H³ of
# cells, from which the faces across of a gap that changes along the axis follow
G, E, H3, HM, COS, SIN, CELL3, HINV = range(8)


@intrinsic
def _call(typing_context, address, numbers, scale, count, u, state):
    """Call a compiled function of a law at its address; arrays by theirs."""
    signature = types.void(*[types.intp] * 2, types.float64, *[types.intp] * 3)

    def code(context, builder, signature, args):
        where, numbers, scale, count, u, state = args
        real = ir.DoubleType()
        kinds = [real.as_pointer(), real, count.type, real.as_pointer(), real.as_pointer()]
        function = ir.FunctionType(ir.IntType(8).as_pointer(), kinds)
        numbers, u, state = (builder.inttoptr(a, kinds[0]) for a in (numbers, u, state))
        builder.call(
            builder.inttoptr(where, function.as_pointer()), [numbers, scale, count, u, state]
        )
        return context.get_dummy_value()

    return signature, code


@njit(cache=True, nogil=True, error_model="numpy")
def apply_law(address, numbers, scale, u, state):
    """Fill `state` (8, nx, nz) from the unknowns `u` (nx, nz) by the law at `address`.

    `numbers` (m,) are those of the law. All arrays are contiguous.
    """
    _call(address, numbers.ctypes.data, scale, u.size, u.ctypes.data, state.ctypes.data)


@njit(cache=True, nogil=True, error_model="numpy")
def gap_coefficients(cos_face, sin_face, w_face, cos_cell, sin_cell, w_cell, stretch, ex, ey, out):
    """Coefficients of the gap H = 1 − ex cos θ − ey sin θ, `out` (8, nx + 1, 1).

    Between two cell centres the flux is taken constant, so that conductance and effective gap are
    G = 1/∫H⁻³, E = G ∫H⁻²; this stays right across steps of the gap. Nodes are given in the
    coordinate a of the Sommerfeld map of strength `stretch` (0: θ = a), densest at θ = 0.
    """
    nf, nq = cos_face.shape
    root = np.sqrt(1.0 - stretch * stretch)
    for i in range(nf):
        i3 = 0.0
        i2 = 0.0
        for q in range(nq):
            d = 1.0 / (1.0 + stretch * cos_face[i, q])
            c = (stretch + cos_face[i, q]) * d
            s = root * sin_face[i, q] * d
            w = w_face[i, q] * root * d
            r = 1.0 / (1.0 - ex * c - ey * s)
            i2 += w * r * r
            i3 += w * r * r * r
        out[G, i, 0] = 1.0 / i3
        out[E, i, 0] = i2 / i3
    for i in range(nf - 1):
        for row in range(H3, HINV + 1):
            out[row, i, 0] = 0.0
        for q in range(nq):
            d = 1.0 / (1.0 + stretch * cos_cell[i, q])
            c = (stretch + cos_cell[i, q]) * d
            s = root * sin_cell[i, q] * d
            w = w_cell[i, q] * root * d
            h = 1.0 - ex * c - ey * s
            out[H3, i, 0] += w * h * h * h
            out[HM, i, 0] += w * h
            out[COS, i, 0] += w * c
            out[SIN, i, 0] += w * s
            out[HINV, i, 0] += w / h


@njit(cache=True, nogil=True, error_model="numpy")
def balance(state, coef, dz, area, gz, closed, wedge, p_edge, p_line, f_line, mass, groove, out):
    """Add the outflow of each cell to `out` (nx, nz); linear in `coef` and `mass` (nx, rows).

    A groove that reaches a bearing end is closed there.
    """
    _, nx, nz = state.shape
    row = 1 if coef.shape[2] > 1 else 0
    p = state[P]
    fill = state[FILL]
    for i in range(nx + 1):
        left = i - 1 if i > 0 else nx - 1
        right = i if i < nx else 0
        if closed and i == nx:
            break
        for k in range(nz):
            g = coef[G, i, row * k]
            e = wedge * coef[E, i, row * k]
            p_l, f_l, p_r, f_r = p[left, k], fill[left, k], p[right, k], fill[right, k]
            if not closed:
                if i == 0:
                    p_l, f_l = p_line, f_line
                elif i == nx:
                    p_r, f_r = p_line, f_line
            q = area[k] * e * (f_l if wedge > 0 else f_r) - dz[k] * g * (p_r - p_l)
            if closed or i > 0:
                out[left, k] += q
            if closed or i < nx:
                out[right, k] -= q
    for i in range(nx):
        if not groove[i, 0]:
            out[i, 0] -= coef[H3, i, 0] * gz[0] * (p_edge - p[i, 0])
        for k in range(nz):
            out[i, k] += fill[i, k] * mass[i, row * k] * area[k]
            if k + 1 == nz and groove[i, k]:
                continue
            g = coef[H3, i, row * (k + 1)] * gz[k + 1]
            q = g * (p[i, k] - (p[i, k + 1] if k + 1 < nz else p_edge))
            out[i, k] += q
            if k + 1 < nz:
                out[i, k + 1] -= q


@njit(cache=True, nogil=True, error_model="numpy")
def largest_terms(state, coef, dz, area, gz, closed, wedge, p_edge, p_line, mass, groove):
    """Largest sum of the magnitudes of the terms of `balance` in a cell; grooves have none."""
    _, nx, nz = state.shape
    row = 1 if coef.shape[2] > 1 else 0
    p = state[P]
    fill = state[FILL]
    most = 0.0
    for i in range(nx):
        before = i - 1 if i > 0 else nx - 1
        after = i + 1 if i + 1 < nx else 0
        for k in range(nz):
            if groove[i, k]:
                continue
            p_before = p[before, k] if closed or i > 0 else p_line
            p_after = p[after, k] if closed or i + 1 < nx else p_line
            here = abs(p[i, k])
            total = coef[G, i, row * k] * (abs(p_before) + here)
            total += coef[G, i + 1, row * k] * (abs(p_after) + here)
            dragged = abs(wedge) * (coef[E, i, row * k] + coef[E, i + 1, row * k])
            total = dz[k] * total
            total += area[k] * (dragged + fill[i, k] * abs(mass[i, row * k]))
            low = abs(p[i, k - 1]) if k > 0 else abs(p_edge)
            high = abs(p[i, k + 1]) if k + 1 < nz else abs(p_edge)
            total += coef[H3, i, row * k] * gz[k] * (low + here)
            total += coef[H3, i, row * (k + 1)] * gz[k + 1] * (high + here)
            most = max(most, total + abs(state[SLACK, i, k]))
    return most


@njit(cache=True, nogil=True, error_model="numpy")
def jacobian(state, coef, dz, area, gz, closed, wedge, mass, order, fixed, ab):
    """Band matrix ∂(balance + slack)/∂u in LAPACK's layout, `ab` (n, 3 kl + 1), column by row."""
    _, nx, nz = state.shape
    row = 1 if coef.shape[2] > 1 else 0
    ab[:] = 0.0
    kl = (ab.shape[1] - 1) // 3
    mid = 2 * kl
    dp = state[DP]
    df = state[DFILL]
    for i in range(nx + 1):
        if closed and i == nx:
            break
        left = i - 1 if i > 0 else nx - 1
        right = i if i < nx else 0
        has_l = closed or i > 0
        has_r = closed or i < nx
        shift = (order[right] - order[left]) * nz
        for k in range(nz):
            g = coef[G, i, row * k]
            e = wedge * coef[E, i, row * k]
            e_l = e if wedge > 0 else 0.0
            e_r = e if wedge <= 0 else 0.0
            if has_l:
                col = order[left] * nz + k
                d = area[k] * e_l * df[left, k] + dz[k] * g * dp[left, k]
                ab[col, mid] += d
                if has_r:
                    ab[col, mid + shift] -= d
            if has_r:
                col = order[right] * nz + k
                d = area[k] * e_r * df[right, k] - dz[k] * g * dp[right, k]
                ab[col, mid] -= d
                if has_l:
                    ab[col, mid - shift] += d
    for i in range(nx):
        base = order[i] * nz
        ab[base, mid] += coef[H3, i, 0] * gz[0] * dp[i, 0]
        for k in range(nz):
            ab[base + k, mid] += df[i, k] * mass[i, row * k] * area[k] + state[DSLACK, i, k]
            g = coef[H3, i, row * (k + 1)] * gz[k + 1]
            ab[base + k, mid] += g * dp[i, k]
            if k + 1 < nz:
                ab[base + k, mid + 1] -= g * dp[i, k]
                ab[base + k + 1, mid] += g * dp[i, k + 1]
                ab[base + k + 1, mid - 1] -= g * dp[i, k + 1]
    n = nx * nz
    for i in range(nx):
        for k in range(nz):
            if fixed[i, k]:
                at = order[i] * nz + k
                for col in range(max(0, at - kl), min(n, at + kl + 1)):
                    ab[col, mid + at - col] = 0.0
                ab[at, mid] = 1.0


@njit(cache=True, nogil=True, error_model="numpy")
def gather(field, order, column):
    """Write `field` (nx, nz) into `column` (n,) in solver order."""
    nx, nz = field.shape
    for i in range(nx):
        for k in range(nz):
            column[order[i] * nz + k] = field[i, k]


@njit(cache=True, nogil=True, error_model="numpy")
def load_of(load, around, across, dz, out):
    """∫ p N_j over the film for modes N_j = around_j (m, nx) · across_j (m, rows), `out` (m,)."""
    nx, nz = load.shape
    row = 1 if across.shape[1] > 1 else 0
    for j in range(out.size):
        out[j] = 0.0
        for i in range(nx):
            total = 0.0
            for k in range(nz):
                total += load[i, k] * dz[k] * across[j, row * k]
            out[j] += around[j, i] * total


@njit(cache=True, nogil=True, error_model="numpy")
def carried_by(slope, around, across, dz, order, columns, out):
    """Change of `load_of` by each of `columns` (l, n) of changes of the unknowns, `out` (l, m)."""
    nx, nz = slope.shape
    row = 1 if across.shape[1] > 1 else 0
    out[:] = 0.0
    for c in range(columns.shape[0]):
        for i in range(nx):
            base = order[i] * nz
            for j in range(out.shape[1]):
                total = 0.0
                for k in range(nz):
                    total += slope[i, k] * dz[k] * across[j, row * k] * columns[c, base + k]
                out[c, j] += around[j, i] * total


@njit(cache=True, nogil=True, error_model="numpy")
def correct(u, columns, weights, order):
    """Subtract Σ weights · columns from `u`; returns the largest change."""
    nx, nz = u.shape
    largest = 0.0
    for i in range(nx):
        for k in range(nz):
            row = order[i] * nz + k
            change = 0.0
            for j in range(weights.size):
                if weights[j] != 0.0:
                    change += weights[j] * columns[j, row]
            u[i, k] -= change
            largest = max(largest, abs(change))
    return largest


@njit(cache=True, nogil=True, error_model="numpy")
def integrals(state, coef, dz, gz, closed, p_edge, p_line, groove):
    """Integrals over the solved film, in the units of this module.

    Returns the largest pressure, the dissipation Σ H³ |∂p|², the shear ∫ 1/H outside grooves, the
    outflow over the bearing ends (where it leaves), and ∫ F H and ∫ H.
    """
    _, nx, nz = state.shape
    row = 1 if coef.shape[2] > 1 else 0
    p = state[LOAD]
    peak = p[0, 0]
    dissipation, shear, outflow, liquid, volume = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(nx + 1):
        if closed and i == nx:
            break
        for k in range(nz):
            p_l = p[i - 1 if i > 0 else nx - 1, k] if closed or i > 0 else p_line
            p_r = p[i, k] if i < nx else p_line
            dissipation += coef[G, i, row * k] * dz[k] * (p_r - p_l) ** 2
    for i in range(nx):
        drop = 0.0 if groove[i, 0] else p[i, 0] - p_edge
        flow = coef[H3, i, 0] * gz[0] * drop
        dissipation += flow * drop
        outflow += max(flow, 0.0)
        for k in range(nz):
            peak = max(peak, p[i, k])
            drop = p[i, k] - (p[i, k + 1] if k + 1 < nz else p_edge)
            if k + 1 == nz and groove[i, k]:
                drop = 0.0
            flow = coef[H3, i, row * (k + 1)] * gz[k + 1] * drop
            dissipation += flow * drop
            if k + 1 == nz:
                outflow += max(flow, 0.0)
            if not groove[i, k]:
                shear += coef[HINV, i, row * k] * dz[k]
            liquid += state[FILL, i, k] * coef[HM, i, row * k] * dz[k]
            volume += coef[HM, i, row * k] * dz[k]
    return peak, dissipation, shear, outflow, liquid, volume


@njit(cache=True, nogil=True, error_model="numpy")
def shaped_coefficients(face, face_gap, cell, cell_gap, ex, ey, coef, by_x, by_y):
    """Coefficients of the gap H = H_0 − ex cos θ − ey sin θ and their derivatives by ex and ey.

    `face` (3, nx + 1, 2) and `cell` (3, nx) are cosine, sine and weight of the nodes between cell
    centres and in cells, `face_gap` (nx + 1, 2, rows) and `cell_gap` (nx, rows) H_0 there; ex and
    ey (nx, rows). Each side of a face has a node of its own, so that a step of the gap is exact.
    """
    nx, rows = ex.shape
    for i in range(nx + 1):
        j = min(i, nx - 1)
        for k in range(rows):
            i2, i3, x2, x3, y2, y3 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
            for q in range(2):
                c, s = face[0, i, q], face[1, i, q]
                r = 1.0 / (face_gap[i, q, k] - ex[j, k] * c - ey[j, k] * s)
                w2 = face[2, i, q] * r * r
                w3 = w2 * r
                i2 += w2
                i3 += w3
                x2 += 2.0 * w3 * c
                y2 += 2.0 * w3 * s
                x3 += 3.0 * w3 * r * c
                y3 += 3.0 * w3 * r * s
            g = 1.0 / i3
            e = i2 * g
            coef[G, i, k], by_x[G, i, k], by_y[G, i, k] = g, -g * g * x3, -g * g * y3
            coef[E, i, k], by_x[E, i, k], by_y[E, i, k] = e, g * (x2 - e * x3), g * (y2 - e * y3)
    for i in range(nx):
        c, s, w = cell[0, i], cell[1, i], cell[2, i]
        coef[COS, i, 0], coef[SIN, i, 0] = w * c, w * s
        for k in range(rows):
            h = cell_gap[i, k] - ex[i, k] * c - ey[i, k] * s
            coef[CELL3, i, k] = w * h * h * h
            by_x[CELL3, i, k], by_y[CELL3, i, k] = -3.0 * w * h * h * c, -3.0 * w * h * h * s
            coef[HM, i, k], by_x[HM, i, k], by_y[HM, i, k] = w * h, -w * c, -w * s
            coef[HINV, i, k] = w / h


@njit(cache=True, nogil=True, error_model="numpy")
def mode_slope(by_x, by_y, ax, ay, across, out):
    """Derivative of the coefficients by a mode that moves the shaft by (ax, ay) (nx) · across."""
    nx = ax.size
    rows = across.size
    for i in range(nx + 1):
        j = min(i, nx - 1)
        for k in range(rows):
            x, y = ax[j] * across[k], ay[j] * across[k]
            for row in (G, E, HM, CELL3):
                out[row, i, k] = x * by_x[row, i, k] + y * by_y[row, i, k]


@njit(cache=True, nogil=True, error_model="numpy")
def faces_across(coef, dz, slope, out):
    """Fill row H3 of `out` from CELL3 of `coef`: conductances in series from centre to centre.

    With `slope` the row is the derivative along that of CELL3 in `out`.
    """
    nx, rows = coef.shape[1] - 1, coef.shape[2]
    for i in range(nx):
        if rows == 1:
            out[H3, i, 0] = out[CELL3, i, 0]
            continue
        nz = rows - 1
        out[H3, i, 0] = out[CELL3, i, 0]
        out[H3, i, nz] = out[CELL3, i, nz - 1]
        for k in range(1, nz):
            low, high = coef[CELL3, i, k - 1], coef[CELL3, i, k]
            both = dz[k - 1] + dz[k]
            h3 = both / (dz[k - 1] / low + dz[k] / high)
            if slope:
                change = dz[k - 1] / (low * low) * out[CELL3, i, k - 1]
                change += dz[k] / (high * high) * out[CELL3, i, k]
                h3 *= h3 / both * change
            out[H3, i, k] = h3
