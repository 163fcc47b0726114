"""Compiled loops of the film on a cone, a plane ring or a straight pad."""

from __future__ import annotations

from loadflow.journal.cavitation import DLOAD, LOAD, P
from loadflow.journal.film._kernels import H3, HINV, HM, E, G
from loadflow.numerics.linked import njit


@njit(cache=True, nogil=True)
def between_nodes(basis, width, gap, moved, coef, by):
    """Rows G and E of the gap H = H_0 − Σ_b B_b X_b, and their derivatives by the three X_b.

    Parameters
    ----------
    basis, width, gap : array (3, nx + 1), (nx + 1,), (nx + 1,)
        B_b and H_0 half-way between two nodes along the motion, and their distance; kinks and
        steps of H_0 lie on nodes.
    moved : array (3, nz)
        X_b of each row of nodes.
    coef, by : array (8, nx + 1, nz + 1), (3, 8, nx + 1, nz + 1)
        What is filled.
    """
    for i in range(width.size):
        b0, b1, b2, inverse = basis[0, i], basis[1, i], basis[2, i], 1.0 / width[i]
        for k in range(moved.shape[1]):
            h = gap[i] - moved[0, k] * b0 - moved[1, k] * b1 - moved[2, k] * b2
            square = inverse * h * h
            coef[G, i, k], coef[E, i, k] = square * h, h
            square *= -3.0
            by[0, G, i, k], by[1, G, i, k], by[2, G, i, k] = square * b0, square * b1, square * b2
            by[0, E, i, k], by[1, E, i, k], by[2, E, i, k] = -b0, -b1, -b2


@njit(cache=True, nogil=True)
def around_nodes(basis, width, gap, moved, ends, coef, by):
    """Rows HM and HINV of the cells round nodes, row H3 of their faces across, and derivatives.

    Parameters
    ----------
    basis, width, gap : array (3, nx, 2), (nx, 2), (nx, 2)
        B_b and H_0 in the middle of both halves of a cell, and how wide these are.
    moved, ends : array (3, nz), (3, nz + 1)
        X_b at nodes and half-way between them across, where the faces lie.
    coef, by
        As in `between_nodes`.
    """
    nx, nz = width.shape[0], moved.shape[1]
    for row in (HM, HINV, H3):
        coef[row] = 0.0
    for row in (HM, H3):
        by[:, row] = 0.0
    for i in range(nx):
        for q in range(2):
            b0, b1, b2, w = basis[0, i, q], basis[1, i, q], basis[2, i, q], width[i, q]
            for k in range(nz):
                h = gap[i, q] - moved[0, k] * b0 - moved[1, k] * b1 - moved[2, k] * b2
                coef[HM, i, k] += w * h
                coef[HINV, i, k] += w / h
                by[0, HM, i, k] -= w * b0
                by[1, HM, i, k] -= w * b1
                by[2, HM, i, k] -= w * b2
            for k in range(nz + 1):
                h = gap[i, q] - ends[0, k] * b0 - ends[1, k] * b1 - ends[2, k] * b2
                square = w * h * h
                coef[H3, i, k] += square * h
                square *= 3.0
                by[0, H3, i, k] -= square * b0
                by[1, H3, i, k] -= square * b1
                by[2, H3, i, k] -= square * b2


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
    """Let only the positive part of p − p_cav carry, cut where straight lines between nodes do.

    The trapezoidal rule loses h²/12 of the slope at the cut, which the nodes on both sides of it
    get back. All of it is continuous when the cut passes a node.

    Parameters
    ----------
    closed : bool
        Whether the film runs round.
    p_cav, p_line : float
        Pressure of the ruptured film, and at both ends.
    width : array (nx + 1,)
        Distances between nodes.
    state : array (8, nx, nz)
        Its rows LOAD and DLOAD are changed.
    slope : array (5, nx, nz)
        Filled with the derivatives of LOAD by the pressure of nodes i − 2 … i + 2.
    """
    _, nx, nz = state.shape
    slope[:] = 0.0
    for i in range(nx):
        for k in range(nz):
            p = state[P, i, k] - p_cav
            state[LOAD, i, k] = p_cav + max(p, 0.0)
            state[DLOAD, i, k] = slope[2, i, k] = 1.0 if p > 0.0 else 0.0
    for i in range(nx):
        for k in range(nz):
            p = state[P, i, k] - p_cav
            if p <= 0.0:
                continue
            for side in (-1, 1):
                j, m = i + side, i - side
                if closed:
                    j, m = j % nx, m % nx
                elif j < 0 or j >= nx:
                    continue
                beyond = state[P, j, k] - p_cav
                if beyond >= 0.0:
                    continue
                inner = 0 <= m < nx
                before = state[P, m, k] - p_cav if inner else p_line - p_cav
                h = width[i] if side < 0 else width[i + 1]
                back = width[i + 1] if side < 0 else width[i]
                own = 2.0 * h / (width[i] + width[i + 1])
                other = 2.0 * h / (width[j] + width[j + 1])
                t = p / (p - beyond)
                t_p, t_beyond = (1.0 - t) / (p - beyond), t / (p - beyond)
                # triangle from the cut to the node in place of h p / 2
                state[LOAD, i, k] -= 0.5 * own * p * (1.0 - t)
                slope[2, i, k] -= 0.5 * own * (1.0 - t - p * t_p)
                slope[2 + side, i, k] += 0.5 * own * p * t_beyond
                # slope at the cut, times h: a mean of those of both intervals round the node
                ratio = h / back
                if before < 0.0:
                    ratio, inner = 0.0, False
                    s, s_t, s_p = p - beyond, 0.0, 1.0
                    s_beyond = -1.0
                else:
                    s = (1.0 - t) * ratio * (before - p) + t * (p - beyond)
                    s_t = (p - beyond) - ratio * (before - p)
                    s_p, s_beyond = t - (1.0 - t) * ratio, -t
                s_p += s_t * t_p
                s_beyond += s_t * t_beyond
                s_before = (1.0 - t) * ratio
                own, other = own / 12.0, other / 12.0
                state[LOAD, i, k] += own * (1.0 - t) * s
                slope[2, i, k] += own * ((1.0 - t) * s_p - t_p * s)
                slope[2 + side, i, k] += own * ((1.0 - t) * s_beyond - t_beyond * s)
                state[LOAD, j, k] += other * t * s
                slope[2 - side, j, k] += other * (t * s_p + t_p * s)
                slope[2, j, k] += other * (t * s_beyond + t_beyond * s)
                if inner:
                    slope[2 - side, i, k] += own * (1.0 - t) * s_before
                    slope[2 - 2 * side, j, k] += other * t * s_before


@njit(cache=True, nogil=True)
def carried_by_cut(slope, around, across, area, order, columns, out):
    """As `_kernels.carried_by`, where the load of a node depends on its neighbours as in `cut`."""
    _, nx, nz = slope.shape
    out[:] = 0.0
    for i in range(nx):
        for k in range(nz):
            for m in range(5):
                share = slope[m, i, k] * area[k]
                if share != 0.0:
                    at = order[(i + m - 2) % nx] * nz + k
                    for c in range(columns.shape[0]):
                        change = share * columns[c, at]
                        for j in range(out.shape[1]):
                            out[c, j] += around[j, i] * across[j, k] * change
