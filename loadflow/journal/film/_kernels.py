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

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from loadflow.journal.cavitation import DFILL, DP, DSLACK, FILL, SLACK, P
from loadflow.numerics.linked import bare

_loop = bare(cache=True)

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


@_loop
def apply_law(address, numbers, scale, u, state):
    """Fill `state` (8, nx, nz) from the unknowns `u` (nx, nz) by the law at `address`.

    `numbers` (m,) are those of the law. All arrays are contiguous.
    """
    _call(address, numbers.ctypes.data, scale, u.size, u.ctypes.data, state.ctypes.data)


@_loop
def balance(state, coefs, cells, closed, wedge, edges, growth, groove, out):
    """Add the outflow of each cell in some gaps to `out` (≥ l, nx, nz).

    It is linear in what a gap is told by, `coefs` (l, 8, nx + 1, rows) and `growth` (l, nx, rows),
    so that these may also be derivatives. `cells` are those of `Mesh.cells`, `edges` the pressures
    at the bearing ends and on the inlet line, and the fill there. A groove that reaches a bearing
    end is closed there.
    """
    _, nx, nz = state.shape
    dz, area, gz = cells
    row = 1 if coefs.shape[3] > 1 else 0
    p_edge, p_line, f_line = edges
    p = state[P]
    fill = state[FILL]
    for c in range(coefs.shape[0]):
        coef, mass, field = coefs[c], growth[c], out[c]
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
                    field[left, k] += q
                if closed or i < nx:
                    field[right, k] -= q
        for i in range(nx):
            if not groove[i, 0]:
                field[i, 0] -= coef[H3, i, 0] * gz[0] * (p_edge - p[i, 0])
            for k in range(nz):
                field[i, k] += fill[i, k] * mass[i, row * k] * area[k]
                if k + 1 == nz and groove[i, k]:
                    continue
                g = coef[H3, i, row * (k + 1)] * gz[k + 1]
                q = g * (p[i, k] - (p[i, k + 1] if k + 1 < nz else p_edge))
                field[i, k] += q
                if k + 1 < nz:
                    field[i, k + 1] -= q


@_loop
def largest_terms(state, coef, cells, closed, wedge, edges, mass, fixed):
    """Largest sum of the magnitudes of the terms of a balance in a cell; held cells have none.

    Arguments are those of `balance`, of one gap, `coef` (8, nx + 1, rows) and `mass` (nx, rows).
    """
    _, nx, nz = state.shape
    dz, area, gz = cells
    row = 1 if coef.shape[2] > 1 else 0
    p, largest = state[P], 0.0
    p_edge, p_line = abs(edges[0]), abs(edges[1])
    for i in range(nx):
        left = i - 1 if i > 0 else nx - 1
        right = i + 1 if i < nx - 1 else 0
        for k in range(nz):
            if fixed[i, k]:
                continue
            here = abs(p[i, k])
            before = abs(p[left, k]) if closed or i > 0 else p_line
            after = abs(p[right, k]) if closed or i < nx - 1 else p_line
            around = coef[G, i, row * k] * (before + here)
            around += coef[G, i + 1, row * k] * (here + after)
            below = abs(p[i, k - 1]) if k > 0 else p_edge
            above = abs(p[i, k + 1]) if k < nz - 1 else p_edge
            across = coef[H3, i, row * k] * gz[k] * (below + here)
            across += coef[H3, i, row * (k + 1)] * gz[k + 1] * (here + above)
            drag = abs(wedge) * (coef[E, i, row * k] + coef[E, i + 1, row * k])
            stored = state[FILL, i, k] * abs(mass[i, row * k])
            total = dz[k] * around + across + area[k] * (drag + stored) + abs(state[SLACK, i, k])
            if total > largest or total != total:
                largest = total
    return largest


@_loop
def right_hand_sides(state, fields, moves, around, across, slope, area, opened, order, fixed, out):
    """Write `fields` (l, nx, nz) in solver order, `out` (l, n); cells that are held have none.

    The first, to which the slack of the law is added, is the balance, the next up to `moves` are
    its derivatives by positions. Those by velocities of each mode follow, and are filled here.
    """
    count, nx, nz = fields.shape
    row = 1 if across.shape[1] > 1 else 0
    for i in range(nx):
        base = order[i] * nz
        for k in range(nz):
            squeeze = -slope * state[FILL, i, k] * area[k]
            if opened is not None:
                squeeze *= opened[i, row * k]
            for c in range(count):
                if c >= moves:
                    fields[c, i, k] = squeeze * around[c - moves, i] * across[c - moves, row * k]
                out[c, base + k] = 0.0 if fixed[i, k] else fields[c, i, k]
            if not fixed[i, k]:
                out[0, base + k] += state[SLACK, i, k]


@_loop
def jacobian(state, coef, cells, closed, wedge, mass, order, fixed, kl, ab):
    """Band matrix ∂(balance + slack)/∂u, `ab` (n, width) as in `_band_kernels`.

    The unknown of a cell that is held is multiplied by as much as its column has elsewhere, so that
    no rows are exchanged for it.
    """
    _, nx, nz = state.shape
    dz, area, gz = cells
    row = 1 if coef.shape[2] > 1 else 0
    mid = 2 * kl
    for at in range(ab.shape[0]):
        for place in range(ab.shape[1]):
            ab[at, place] = 0.0
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
                largest = 1.0
                for place in range(kl, 3 * kl + 1):
                    largest = max(largest, abs(ab[at, place]))
                ab[at, mid] = largest


@_loop
def gather(field, order, column):
    """Write `field` (nx, nz) into `column` (n,) in solver order."""
    nx, nz = field.shape
    for i in range(nx):
        for k in range(nz):
            column[order[i] * nz + k] = field[i, k]


@_loop
def load_of(load, around, across, dz, out):
    """∫ p N_j over the film, `out` (l, m), of modes N_j = around_j (l, m, nx) · across_j (m, rows).

    Their factors around come in l sets.
    """
    nx, nz = load.shape
    row = 1 if across.shape[1] > 1 else 0
    for c in range(out.shape[0]):
        for j in range(out.shape[1]):
            out[c, j] = 0.0
            for i in range(nx):
                total = 0.0
                for k in range(nz):
                    total += load[i, k] * dz[k] * across[j, row * k]
                out[c, j] += around[c, j, i] * total


@_loop
def carried_by(slope, around, across, dz, order, columns, out):
    """Change of ∫ p N_j by each of `columns` (l, n) of changes of the unknowns, `out` (l, m)."""
    nx, nz = slope.shape
    row = 1 if across.shape[1] > 1 else 0
    for c in range(columns.shape[0]):
        for j in range(out.shape[1]):
            out[c, j] = 0.0
            for i in range(nx):
                base = order[i] * nz
                total = 0.0
                for k in range(nz):
                    total += slope[i, k] * dz[k] * across[j, row * k] * columns[c, base + k]
                out[c, j] += around[j, i] * total


@_loop
def correct(u, columns, weights, order, kink, most):
    """Subtract Σ weights · columns from `u`; returns the largest change.

    What has been below a `kink` of the law becomes `most` at most.
    """
    nx, nz = u.shape
    largest = 0.0
    for i in range(nx):
        for k in range(nz):
            row = order[i] * nz + k
            change = 0.0
            for j in range(weights.size):
                if weights[j] != 0.0:
                    change += weights[j] * columns[j, row]
            fills = u[i, k] < kink
            u[i, k] -= change
            if fills and u[i, k] > most:
                u[i, k] = most
            largest = max(largest, abs(change))
    return largest
