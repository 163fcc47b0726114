"""Compiled loops of films between rough surfaces: coefficients of the gap, sums of the asperities.

They fill the same rows as their counterparts in `_kernels`, of the mean gap ⟨h_T⟩ that is left
between cut heights [Wu and Zheng 1989], with the flow factors of [Patir and Cheng 1978] where rows
of their coefficients are given. The gap is in clearances, and so is the roughness s.
"""

from __future__ import annotations

from numba import njit

from loadflow.journal.film._kernels import CELL3, COS, H3, HINV, HM, SIN, E, G
from loadflow.tribology import kernels as laws

LEAST = 1e-3  # mean gap over the roughness: valleys stay open under any load
_PRINTED = 1.0  # film parameter down to which φ_x h³ is taken as printed
NO_CONTACT = 12.0  # film parameter above which asperities carry less than rounding


@njit(cache=True, nogil=True)
def mean_film(h, s):
    """Mean gap and its derivative by h."""
    mean, share = laws.mean_gap(h / s)
    if mean < LEAST:
        return s * LEAST, 0.0
    return s * mean, share


@njit(cache=True, nogil=True)
def conductance(h, s, rows):
    """φ h³, or ⟨h_T⟩³ without `rows`, and its derivative.

    φ was found at H > 0.5 … 1: below 1 it multiplies ⟨h_T⟩³, to which it is joined there.
    """
    mean, share = mean_film(h, s)
    if rows.shape[0] == 0:
        return mean**3, 3.0 * mean**2 * share
    parameter = h / s
    factor, rise = laws.pressure_factor(parameter, rows)
    if parameter >= _PRINTED:
        return factor * h**3, 3.0 * factor * h**2 + rise / s * h**3
    joined, _ = mean_film(_PRINTED * s, s)
    ratio = (_PRINTED * s / joined) ** 3
    return ratio * factor * mean**3, ratio * (3.0 * factor * mean**2 * share + rise / s * mean**3)


@njit(cache=True, nogil=True)
def dragged(h, s, rows, slip):
    """Gap that the shaft drags full, ⟨h_T⟩ + slip σ Φ_s, and its derivative."""
    mean, share = mean_film(h, s)
    if rows.shape[0] == 0 or slip == 0.0:
        return mean, share
    factor, rise = laws.shear_factor(h / s, rows, True)
    return mean + slip * s * factor, share + slip * rise


@njit(cache=True, nogil=True)
def sheared(h, s, rows):
    """Mean inverse of the gap: φ_f/h with flow factors, 1/⟨h_T⟩ without."""
    if rows.shape[0] == 0:
        return 1.0 / mean_film(h, s)[0]
    return laws.inverse_gap(h / s)[0] / s


@njit(cache=True, nogil=True)
def gap_coefficients(
    cos_face, sin_face, w_face, cos_cell, sin_cell, w_cell, stretch, ex, ey, s, along, across,
    slip, out, open_share,
):  # fmt: skip
    """Coefficients as `_kernels.gap_coefficients` has them, and the `open_share` (nx, 1) of cells.

    The open share is the derivative of the mean gap by that of the mean planes.
    """
    nf, nq = cos_face.shape
    root = (1.0 - stretch * stretch) ** 0.5
    for i in range(nf):
        i3 = 0.0
        i2 = 0.0
        for q in range(nq):
            d = 1.0 / (1.0 + stretch * cos_face[i, q])
            c = (stretch + cos_face[i, q]) * d
            sine = root * sin_face[i, q] * d
            h = 1.0 - ex * c - ey * sine
            r = w_face[i, q] * root * d / conductance(h, s, along)[0]
            i2 += r * dragged(h, s, along, slip)[0]
            i3 += r
        out[G, i, 0] = 1.0 / i3
        out[E, i, 0] = i2 / i3
    for i in range(nf - 1):
        for row in range(H3, HINV + 1):
            out[row, i, 0] = 0.0
        opened, width = 0.0, 0.0
        for q in range(nq):
            d = 1.0 / (1.0 + stretch * cos_cell[i, q])
            c = (stretch + cos_cell[i, q]) * d
            sine = root * sin_cell[i, q] * d
            w = w_cell[i, q] * root * d
            h = 1.0 - ex * c - ey * sine
            mean, share = mean_film(h, s)
            out[H3, i, 0] += w * conductance(h, s, across)[0]
            out[HM, i, 0] += w * mean
            out[COS, i, 0] += w * c
            out[SIN, i, 0] += w * sine
            out[HINV, i, 0] += w * sheared(h, s, along)
            opened += w * share
            width += w
        open_share[i, 0] = opened / width


@njit(cache=True, nogil=True)
def shaped_coefficients(
    face, face_gap, cell, cell_gap, ex, ey, s, along, across, slip, coef, by_x, by_y, open_share
):
    """Coefficients and derivatives as `_kernels.shaped_coefficients` has them, and `open_share`."""
    nx, rows = ex.shape
    for i in range(nx + 1):
        j = min(i, nx - 1)
        for k in range(rows):
            i2, i3, x2, x3, y2, y3 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
            for q in range(2):
                c, sine = face[0, i, q], face[1, i, q]
                h = face_gap[i, q, k] - ex[j, k] * c - ey[j, k] * sine
                flow, flow_rise = conductance(h, s, along)
                drag, drag_rise = dragged(h, s, along, slip)
                w3 = face[2, i, q] / flow
                w2 = w3 * drag
                # derivatives by h; h falls by c and sine
                d3 = -w3 * flow_rise / flow
                d2 = d3 * drag + w3 * drag_rise
                i2 += w2
                i3 += w3
                x2 -= d2 * c
                y2 -= d2 * sine
                x3 -= d3 * c
                y3 -= d3 * sine
            g = 1.0 / i3
            e = i2 * g
            coef[G, i, k], by_x[G, i, k], by_y[G, i, k] = g, -g * g * x3, -g * g * y3
            coef[E, i, k], by_x[E, i, k], by_y[E, i, k] = e, g * (x2 - e * x3), g * (y2 - e * y3)
    for i in range(nx):
        c, sine, w = cell[0, i], cell[1, i], cell[2, i]
        coef[COS, i, 0], coef[SIN, i, 0] = w * c, w * sine
        for k in range(rows):
            h = cell_gap[i, k] - ex[i, k] * c - ey[i, k] * sine
            flow, rise = conductance(h, s, across)
            mean, share = mean_film(h, s)
            coef[CELL3, i, k] = w * flow
            by_x[CELL3, i, k], by_y[CELL3, i, k] = -w * rise * c, -w * rise * sine
            coef[HM, i, k] = w * mean
            by_x[HM, i, k], by_y[HM, i, k] = -w * share * c, -w * share * sine
            coef[HINV, i, k] = w * sheared(h, s, along)
            open_share[i, k] = share


@njit(cache=True, nogil=True)
def pressed(gap, s, weights_around, weights_across, held, reach, lengths, load, stiffness):
    """Sums over asperities at the nodes of a `gap` (n, rows), in units of K E*.

    `reach` (m, n) times `lengths` (m, rows) are the modes; `held` nodes, grooves, carry none.
    Fills ∫ F N_j and −∫ F' N_j N_k / s, and returns ∫ F and the narrowest gap of those that touch.
    """
    n, rows = gap.shape
    size = load.size
    normal, narrowest = 0.0, NO_CONTACT * s
    load[:] = 0.0
    stiffness[:] = 0.0
    for i in range(n):
        for k in range(rows):
            if gap[i, k] > NO_CONTACT * s or held[i, k]:
                continue
            value, rise = laws.pressure_integral(gap[i, k] / s)
            narrowest = min(narrowest, gap[i, k])
            weight = weights_around[i] * weights_across[k]
            normal += weight * value
            for a in range(size):
                mode = weight * reach[a, i] * lengths[a, k]
                load[a] += mode * value
                for b in range(size):
                    stiffness[a, b] -= mode * rise / s * reach[b, i] * lengths[b, k]
    return normal, narrowest
