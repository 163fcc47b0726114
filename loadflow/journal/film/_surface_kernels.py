"""Compiled loops of the film on a cone, a plane ring or a straight pad."""

from __future__ import annotations

from numba import njit

from loadflow.journal.film._kernels import DLOAD, H3, HINV, HM, LOAD, E, G, P


@njit(cache=True, nogil=True)
def between_nodes(basis, weight, gap, moved, coef, by):
    """Rows G and E of the gap H = H_0 − Σ_b B_b X_b, and their derivatives by the three X_b.

    Parameters
    ----------
    basis, weight, gap : array (3, nx + 1, q), (nx + 1, q), (nx + 1, q)
        B_b, weights and H_0 at Gauss points between two nodes along the motion; kinks and steps of
        H_0 lie on nodes, so that the integrals are exact.
    moved : array (3, nz)
        X_b of each row of nodes.
    coef, by : array (8, nx + 1, nz + 1), (3, 8, nx + 1, nz + 1)
        What is filled.
    """
    faces, points = weight.shape
    for k in range(moved.shape[1]):
        x0, x1, x2 = moved[0, k], moved[1, k], moved[2, k]
        if k > 0 and x0 == moved[0, k - 1] and x1 == moved[1, k - 1] and x2 == moved[2, k - 1]:
            for row in (G, E):
                coef[row, :, k] = coef[row, :, k - 1]
                by[:, row, :, k] = by[:, row, :, k - 1]
            continue
        for i in range(faces):
            i2, i3 = 0.0, 0.0
            d20, d21, d22, d30, d31, d32 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
            for q in range(points):
                b0, b1, b2 = basis[0, i, q], basis[1, i, q], basis[2, i, q]
                r = 1.0 / (gap[i, q] - x0 * b0 - x1 * b1 - x2 * b2)
                w2 = weight[i, q] * r * r
                w3 = w2 * r
                w4 = 3.0 * w3 * r
                i2 += w2
                i3 += w3
                w3 *= 2.0
                d20 += w3 * b0
                d21 += w3 * b1
                d22 += w3 * b2
                d30 += w4 * b0
                d31 += w4 * b1
                d32 += w4 * b2
            g = 1.0 / i3
            e = i2 * g
            coef[G, i, k], coef[E, i, k] = g, e
            by[0, G, i, k], by[1, G, i, k], by[2, G, i, k] = -g * g * d30, -g * g * d31, -g * g * d32
            by[0, E, i, k] = g * (d20 - e * d30)
            by[1, E, i, k] = g * (d21 - e * d31)
            by[2, E, i, k] = g * (d22 - e * d32)


@njit(cache=True, nogil=True)
def around_nodes(basis, weight, gap, moved, ends, coef, by):
    """Rows HM and HINV of the cells round nodes, row H3 of their faces across, and derivatives.

    Parameters
    ----------
    basis, weight, gap : array (3, nx, q), (nx, q), (nx, q)
        As in `between_nodes`, inside cells.
    moved, ends : array (3, nz), (3, nz + 1)
        X_b at nodes and half-way between them across, where the faces lie.
    coef, by
        As in `between_nodes`.
    """
    nx, points = weight.shape
    nz = moved.shape[1]
    for k in range(nz):
        x0, x1, x2 = moved[0, k], moved[1, k], moved[2, k]
        for i in range(nx):
            volume, inverse, v0, v1, v2 = 0.0, 0.0, 0.0, 0.0, 0.0
            for q in range(points):
                b0, b1, b2, w = basis[0, i, q], basis[1, i, q], basis[2, i, q], weight[i, q]
                h = gap[i, q] - x0 * b0 - x1 * b1 - x2 * b2
                volume += w * h
                inverse += w / h
                v0 -= w * b0
                v1 -= w * b1
                v2 -= w * b2
            coef[HM, i, k], coef[HINV, i, k] = volume, inverse
            by[0, HM, i, k], by[1, HM, i, k], by[2, HM, i, k] = v0, v1, v2
    for k in range(nz + 1):
        x0, x1, x2 = ends[0, k], ends[1, k], ends[2, k]
        for i in range(nx):
            cube, c0, c1, c2 = 0.0, 0.0, 0.0, 0.0
            for q in range(points):
                b0, b1, b2 = basis[0, i, q], basis[1, i, q], basis[2, i, q]
                h = gap[i, q] - x0 * b0 - x1 * b1 - x2 * b2
                square = weight[i, q] * h * h
                cube += square * h
                c0 -= square * b0
                c1 -= square * b1
                c2 -= square * b2
            coef[H3, i, k] = cube
            by[0, H3, i, k], by[1, H3, i, k], by[2, H3, i, k] = 3.0 * c0, 3.0 * c1, 3.0 * c2


@njit(cache=True, nogil=True)
def motion(by, factors, across, ends, out):
    """Derivative of the coefficients by a motion: Σ_b factors_b B_b times `across` or `ends`."""
    nf, nz = out.shape[1], across.size
    f0, f1, f2 = factors[0], factors[1], factors[2]
    for row in (G, E, HM):
        for i in range(nf):
            for k in range(nz):
                change = f0 * by[0, row, i, k] + f1 * by[1, row, i, k] + f2 * by[2, row, i, k]
                out[row, i, k] = across[k] * change
    for i in range(nf - 1):
        for k in range(nz + 1):
            change = f0 * by[0, H3, i, k] + f1 * by[1, H3, i, k] + f2 * by[2, H3, i, k]
            out[H3, i, k] = ends[k] * change


@njit(cache=True, nogil=True)
def cut(closed, p_cav, p_line, width, state, slope):
    """Let p − p_cav carry only where it is positive on straight lines between nodes.

    Changes row LOAD of `state` in the nodes beside a zero of p − p_cav, and fills `slope`
    (3, nx, nz): its derivatives by the pressure of the node before, the node itself, that after.
    `width` (nx + 1,) are the distances between nodes.
    """
    nx, nz = state.shape[1], state.shape[2]
    for i in range(nx):
        total = width[i] + width[i + 1]
        for k in range(nz):
            p = state[P, i, k] - p_cav
            slope[0, i, k], slope[1, i, k], slope[2, i, k] = 0.0, 0.0, 0.0
            if p <= 0.0:
                state[LOAD, i, k], state[DLOAD, i, k] = p_cav, 0.0
                continue
            load = 0.0
            for side in range(2):
                j = i - 1 + 2 * side
                share = width[i + side] / total
                if 0 <= j < nx:
                    other = state[P, j, k] - p_cav
                elif closed:
                    other = state[P, (j + nx) % nx, k] - p_cav
                else:
                    other = p_line - p_cav
                if other >= 0.0:
                    load += share * p
                    slope[1, i, k] += share
                else:
                    part = p / (p - other)
                    load += share * p * part
                    slope[1, i, k] += share * (2.0 - part) * part
                    slope[2 * side, i, k] = share * part * part
            state[LOAD, i, k] = p_cav + load


@njit(cache=True, nogil=True)
def carried_by_cut(closed, slope, around, across, area, order, columns, out):
    """As `_kernels.carried_by`, where the load of a node depends on its neighbours as in `cut`."""
    _, nx, nz = slope.shape
    out[:] = 0.0
    for c in range(columns.shape[0]):
        for i in range(nx):
            before, after = order[i - 1] * nz, order[(i + 1) % nx] * nz
            if not closed:
                before = order[max(i - 1, 0)] * nz
                after = order[min(i + 1, nx - 1)] * nz
            base = order[i] * nz
            for k in range(nz):
                change = slope[1, i, k] * columns[c, base + k]
                if closed or i > 0:
                    change += slope[0, i, k] * columns[c, before + k]
                if closed or i + 1 < nx:
                    change += slope[2, i, k] * columns[c, after + k]
                change *= area[k]
                for j in range(out.shape[1]):
                    out[c, j] += around[j, i] * across[j, k] * change
