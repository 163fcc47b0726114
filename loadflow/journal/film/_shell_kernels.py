"""Compiled loops of the elastic shell: what the balance of the film owes to the gap of a cell.

The gap of a cell grows by W (clearances) under pressure. It enters the balance of the cell itself
and of its four neighbours; `stencil` (5, nx, nz) holds those derivatives, in the order of the rows
below, each where the growing cell is.
"""

from __future__ import annotations

from numba import njit

from loadflow.journal.film._gap_kernels import cell_terms, resistance
from loadflow.journal.film._kernels import CELL3, FILL, H3, E, G, P

ITSELF, BEFORE, AFTER, INNER, OUTER = range(5)


@njit(cache=True, nogil=True, error_model="numpy")
def gap_stencil(
    state, coef, face, face_gap, cell, cell_gap, surfaces, dz, gz, closed, wedge, ends, storing,
    groove, out,
):  # fmt: skip
    """Fill `out` (5, nx, nz) at the state and gap last placed.

    `face`, `cell`, their gaps and `surfaces` are those of `_gap_kernels.shaped_coefficients`, the
    gaps in place and deformed; `ends` are edge pressure, pressure and fill of an inlet line;
    `storing` (Pa) is the squeeze pressure of a growth of the gap in one implicit step.
    """
    _, nx, nz = state.shape
    p_edge, p_line, f_line = ends
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
            g, e = coef[G, i, k], coef[E, i, k]
            for side in range(2):
                if not (has_left if side == 0 else has_right):
                    continue
                h, w = face_gap[i, side, k], face[2, i, side]
                _, _, by_2, by_3 = resistance(h, w, surfaces)
                by_g, by_e = -g * g * by_3, g * (by_2 - e * by_3)
                flow = dz[k] * (drag * by_e - by_g * (p_right - p_left))
                if side == 0:
                    out[ITSELF, left, k] += flow
                    if has_right:
                        out[AFTER, left, k] -= flow
                else:
                    out[ITSELF, right, k] -= flow
                    if has_left:
                        out[BEFORE, right, k] += flow
    for i in range(nx):
        for k in range(nz):
            _, cubed, _, wider, _, _ = cell_terms(cell_gap[i, k], cell[2, i], surfaces)
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
            there = flow * dz[k + 1] * cubed / coef[CELL3, i, k + 1] ** 2
            out[INNER, i, k + 1] += there
            out[ITSELF, i, k + 1] -= there


@njit(cache=True, nogil=True, error_model="numpy")
def add_stencil(stencil, growth, order, fixed, ab):
    """Add what follows from the `growth` (nx, nz) of each gap by its own unknown to the band."""
    _, nx, nz = stencil.shape
    mid = 2 * ((ab.shape[1] - 1) // 3)
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
