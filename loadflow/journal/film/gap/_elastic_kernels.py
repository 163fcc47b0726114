"""Compiled loops of the elastic shell: what the balance of the film owes to the gap of a cell.

The gap of a cell grows by W (clearances) under pressure. It enters the balance of the cell itself
and of its four neighbours; `stencil` (5, nx, nz) holds those derivatives, in the order of the rows
below, each where the growing cell is.
"""

from __future__ import annotations

from loadflow.journal.film._kernels import CELL3, FILL, H3, E, G, P
from loadflow.journal.film.gap._gap_kernels import cell_terms, resistance
from loadflow.numerics.linked import njit

ITSELF, BEFORE, AFTER, INNER, OUTER = range(5)


@njit(cache=True, nogil=True, error_model="numpy")
def upwind(cell, cell_gap, ex, ey, surfaces, closed, advected, coef, by_x, by_y, blend):
    """Blend the effective gap E of the faces around with that of the cell the flow comes from.

    `advected` (nx + 1, rows) is what the surfaces drag over a face for each Pa of its pressure that
    widens the gap; over the conductance of the face it is a Péclet number Pe. With s = Pe/2 the
    share of the upstream cell is ((1 + s⁴)^¼ − 1)/s: at least 1 − 1/s, so that no pressure rises
    with that downstream of it, and s³/4 on cells that resolve the gap, which keeps their order.

    `blend` (4, nx + 1, rows) is filled with the share, its slope by Pe times Pe, and both gaps.
    """
    nx, rows = ex.shape
    blend[:] = 0.0
    for i in range(nx + 1):
        if not closed and (i == 0 or i == nx):
            continue
        for k in range(rows):
            half = 0.5 * abs(advected[i, k]) / coef[G, i, k]
            share, slope = _upstream_share(half)
            if share == 0.0:
                continue
            at = (i - 1) % nx if advected[i, k] > 0 else i % nx
            c, s = cell[0, at], cell[1, at]
            h = cell_gap[at, k] - ex[at, k] * c - ey[at, k] * s
            up, rise = _dragged(h, surfaces)
            e = coef[E, i, k]
            blend[0, i, k], blend[1, i, k], blend[2, i, k], blend[3, i, k] = share, slope, e, up
            turn = slope * (up - e) / coef[G, i, k]
            coef[E, i, k] = e + share * (up - e)
            for by, turned in ((by_x, c), (by_y, s)):
                change = (1.0 - share) * by[E, i, k] - share * rise * turned
                by[E, i, k] = change - turn * by[G, i, k]


@njit(cache=True, nogil=True, error_model="numpy")
def _dragged(h, surfaces):
    """Effective gap of an even one, ∫H⁻²/∫H⁻³, and its derivative by the gap."""
    w2, w3, d2, d3 = resistance(h, 1.0, surfaces)
    return w2 / w3, (d2 - w2 / w3 * d3) / w3


@njit(cache=True, nogil=True, error_model="numpy")
def _upstream_share(half):
    """Share of the upstream gap at half a Péclet number, and its slope times that number."""
    if half < 1e-3:
        return 0.0, 0.0
    if half > 1e4:
        return 1.0 - 1.0 / half, 1.0 / half
    power = half**4
    root = (1.0 + power) ** 0.25
    share = (root - 1.0) / half
    return share, power / (root**3 * half) - share


@njit(cache=True, nogil=True, error_model="numpy")
def gap_stencil(
    state, coef, blend, own_share, face, face_gap, cell, cell_gap, surfaces, dz, gz, closed,
    wedge, ends, storing, groove, thinned, out,
):  # fmt: skip
    """Fill `out` (5, nx, nz) at the state and gap last placed.

    `blend` is that of `upwind`, `own_share` (nx + 1, 2) what the nodes of a face take of the growth
    of their own cell, the rest being that of the other one; `face`, `cell`, their gaps and
    `surfaces` those of `_gap_kernels.shaped_coefficients`, the gaps in place and deformed; `ends`
    are edge pressure, pressure and fill of an inlet line;
    `storing` (Pa) is the squeeze pressure of a growth of the gap in one implicit step; `thinned`
    are conductance and drag of the faces (nx + 1, nz), and conductance of the cells (nx, nz), over
    those of one viscosity.
    """
    _, nx, nz = state.shape
    p_edge, p_line, f_line = ends
    around, dragged, across = thinned
    p, fill = state[P], state[FILL]
    out[:] = 0.0
    for i in range(nx + 1):
        if closed and i == nx:
            break
        left = i - 1 if i > 0 else nx - 1
        right = i if i < nx else 0
        has_left, has_right = closed or i > 0, closed or i < nx
        for k in range(nz):
            p_left, f_left = (p[left, k], fill[left, k]) if has_left else (p_line, f_line)
            p_right, f_right = (p[right, k], fill[right, k]) if has_right else (p_line, f_line)
            drag = wedge * (f_left if wedge > 0 else f_right)
            thin, drags = around[i, k], dragged[i, k]
            g, share, up = coef[G, i, k] / thin, blend[0, i, k], blend[3, i, k]
            e = blend[2, i, k] if share > 0.0 else coef[E, i, k] / drags
            by_left, by_right = 0.0, 0.0
            for side in range(2):
                _, _, by_2, by_3 = resistance(face_gap[i, side, k], face[2, i, side], surfaces)
                by_g, by_e = -g * g * by_3, g * (by_2 - e * by_3)
                if share > 0.0:
                    by_e = (1.0 - share) * by_e - blend[1, i, k] * (up - e) * by_g / g
                flow = dz[k] * (drag * drags * by_e - thin * by_g * (p_right - p_left))
                own = own_share[i, side]
                by_left += flow * (own if side == 0 else 1.0 - own)
                by_right += flow * (own if side == 1 else 1.0 - own)
            if share > 0.0:
                before = wedge > 0
                _, rise = _dragged(cell_gap[left if before else right, k], surfaces)
                rise *= dz[k] * drag * drags * share
                by_left += rise if before else 0.0
                by_right += 0.0 if before else rise
            if not has_left:
                by_right += by_left
            elif not has_right:
                by_left += by_right
            if has_left:
                out[ITSELF, left, k] += by_left
                if has_right:
                    out[AFTER, left, k] -= by_left
                    out[BEFORE, right, k] += by_right
            if has_right:
                out[ITSELF, right, k] -= by_right
    for i in range(nx):
        for k in range(nz):
            _, cubed, _, wider, _, _ = cell_terms(cell_gap[i, k], cell[2, i], surfaces)
            cubed *= across[i, k]
            out[ITSELF, i, k] += fill[i, k] * storing * wider * dz[k]
            if k == 0 and not groove[i, 0]:
                out[ITSELF, i, 0] += cubed * gz[0] * (p[i, 0] - p_edge)
            if k + 1 == nz:
                if not groove[i, k]:
                    out[ITSELF, i, k] += cubed * gz[nz] * (p[i, k] - p_edge)
                continue
            # conductances in series to the cell farther out
            flow = coef[H3, i, k + 1] ** 2 * gz[k + 1] * (p[i, k] - p[i, k + 1])
            flow /= dz[k] + dz[k + 1]
            here = flow * dz[k] * cubed / coef[CELL3, i, k] ** 2
            out[ITSELF, i, k] += here
            out[OUTER, i, k] -= here
            _, cubed, _, _, _, _ = cell_terms(cell_gap[i, k + 1], cell[2, i], surfaces)
            cubed *= across[i, k + 1]
            there = flow * dz[k + 1] * cubed / coef[CELL3, i, k + 1] ** 2
            out[INNER, i, k + 1] += there
            out[ITSELF, i, k + 1] -= there


@njit(cache=True, nogil=True, error_model="numpy")
def add_stencil(stencil, growth, order, fixed, kl, ab):
    """Add what follows from the `growth` (nx, nz) of each gap by its own unknown to the band."""
    _, nx, nz = stencil.shape
    mid = 2 * kl
    for i in range(nx):
        for k in range(nz):
            column = order[i] * nz + k
            for at in range(5):
                j, m = _neighbour(at, i, k, nx)
                if 0 <= m < nz and stencil[at, i, k] != 0.0 and not fixed[j, m]:
                    row = order[j] * nz + m
                    ab[column, mid + row - column] += stencil[at, i, k] * growth[i, k]


@njit(cache=True, nogil=True, error_model="numpy")
def spread(stencil, growth, out):
    """Add the change of the balance by a `growth` (l, nx, nz) of the gaps to `out` (l, nx, nz)."""
    _, nx, nz = stencil.shape
    for line in range(growth.shape[0]):
        for i in range(nx):
            for k in range(nz):
                for at in range(5):
                    j, m = _neighbour(at, i, k, nx)
                    if 0 <= m < nz:
                        out[line, j, m] += stencil[at, i, k] * growth[line, i, k]


@njit(cache=True, nogil=True, error_model="numpy")
def _neighbour(at, i, k, nx):
    """Cell that row `at` of the stencil of cell (i, k) belongs to."""
    if at == BEFORE:
        return (i - 1) % nx, k
    if at == AFTER:
        return (i + 1) % nx, k
    if at == INNER:
        return i, k - 1
    if at == OUTER:
        return i, k + 1
    return i, k
