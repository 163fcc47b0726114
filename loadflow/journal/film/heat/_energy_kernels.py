"""Compiled loops of the energy equation: flows over the faces of cells, and what they dissipate.

Units are those of `_kernels`; its `balance` sums up the same flows.
"""

from __future__ import annotations

from loadflow.journal.cavitation import FILL, LOAD, P
from loadflow.journal.film._kernels import H3, E, G
from loadflow.numerics.linked import njit


@njit(cache=True, nogil=True)
def flows(
    state, coef, dz, area, gz, closed, wedge, p_edge, p_line, f_line, groove, around, across, lost
):
    """Flow over every face, and what the pressure dissipates in every cell.

    Parameters
    ----------
    state : array (8, nx, nz)
        Of the law.
    coef : array (8, nx + 1, nz + 1)
        Coefficients of the gap.
    groove : array of bool (nx, nz)
        Cells of grooves; one that reaches an end is closed there.
    around : array (nx + 1, nz)
        Filled with the flow toward greater angles over the face before each column of cells; the
        last one stays 0 where the film is closed.
    across : array (nx, nz + 1)
        Filled with the flow toward greater z over the face before each cell.
    lost : array (nx, nz)
        Filled with the dissipation by pressure, half of that of a face in either of its cells; all
        of it in the one that is no groove.
    """
    _, nx, nz = state.shape
    p, fill, load = state[P], state[FILL], state[LOAD]
    around[:] = 0.0
    across[:] = 0.0
    lost[:] = 0.0
    for i in range(nx + 1):
        if closed and i == nx:
            break
        left = i - 1 if i > 0 else nx - 1
        right = i if i < nx else 0
        has_l = closed or i > 0
        has_r = closed or i < nx
        for k in range(nz):
            p_l, p_r, f_l, f_r = p_line, p_line, f_line, f_line
            drop = 0.0
            if has_l:
                p_l, f_l = p[left, k], fill[left, k]
                drop += load[left, k]
            else:
                drop += p_line
            if has_r:
                p_r, f_r = p[right, k], fill[right, k]
                drop -= load[right, k]
            else:
                drop -= p_line
            g = coef[G, i, k] * dz[k]
            e = wedge * coef[E, i, k] * area[k]
            around[i, k] = e * (f_l if wedge > 0 else f_r) - g * (p_r - p_l)
            heat = g * drop * drop
            in_l = has_l and not groove[left, k]
            in_r = has_r and not groove[right, k]
            if in_l and in_r:
                lost[left, k] += 0.5 * heat
                lost[right, k] += 0.5 * heat
            elif in_l:
                lost[left, k] += heat
            elif in_r:
                lost[right, k] += heat
    for i in range(nx):
        if not groove[i, 0]:
            g = coef[H3, i, 0] * gz[0]
            across[i, 0] = g * (p_edge - p[i, 0])
            lost[i, 0] += g * (load[i, 0] - p_edge) ** 2
        for k in range(1, nz):
            g = coef[H3, i, k] * gz[k]
            across[i, k] = g * (p[i, k - 1] - p[i, k])
            heat = g * (load[i, k - 1] - load[i, k]) ** 2
            if groove[i, k - 1]:
                lost[i, k] += 0.0 if groove[i, k] else heat
            elif groove[i, k]:
                lost[i, k - 1] += heat
            else:
                lost[i, k - 1] += 0.5 * heat
                lost[i, k] += 0.5 * heat
        if not groove[i, nz - 1]:
            g = coef[H3, i, nz] * gz[nz]
            across[i, nz] = g * (p[i, nz - 1] - p_edge)
            lost[i, nz - 1] += g * (load[i, nz - 1] - p_edge) ** 2
