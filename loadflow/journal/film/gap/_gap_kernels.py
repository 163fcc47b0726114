"""Compiled coefficients of a gap on its mesh, and their derivatives by the position of the shaft.

Between two cell centres the flux is taken constant, so that conductance and effective gap are
G = 1/∫H⁻³, E = G ∫H⁻²; this stays right across steps of the gap. One source serves smooth and
rough surfaces, laminar and turbulent flow: `surfaces` is None, or a pair of which each may be None.
The first is roughness, flow factors along and across the motion, slip, and what the shell yields to
asperities, as `_rough_kernels` takes them; the second the Reynolds numbers of
`_turbulence_kernels`. What is not asked for is not compiled.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.film._kernels import CELL3, COS, H3, HINV, HM, SIN, E, G
from loadflow.journal.film.gap._rough_kernels import (
    conductance,
    dragged,
    mean_film,
    opened,
    sheared,
)
from loadflow.journal.film.gap._turbulence_kernels import ACROSS, ALONG, SHEAR, factor
from loadflow.numerics.convergence import EPS
from loadflow.numerics.linked import LINKED, bare

_loop = bare(cache=True)
_linked = bare(**LINKED)

FLATTEST = 0.99  # stretch of the Sommerfeld map, which ends at 1
_STEP, _WIDEST = 1e-5, 0.1  # least and largest step of differences, over the gap


@_linked
def resistance(h, w, surfaces):
    """Terms w·H⁻² and w·H⁻³ of a node of a face, and their derivatives by h."""
    if surfaces is None:
        r = 1.0 / h
        w2 = w * r * r
        w3 = w2 * r
        return w2, w3, -2.0 * w3, -3.0 * w3 * r
    return _resistance(h, w, surfaces[0], surfaces[1])


@_linked
def _resistance(h, w, rough, regime):
    """`resistance` of rough surfaces, of turbulent flow, or of both."""
    opens = 1.0
    if rough is None:
        flow, rise, drag, drag_rise = h * h * h, 3.0 * h * h, h, 1.0
    else:
        s, along, _, slip, yields = rough
        h, opens = opened(h, yields)
        mean, share = mean_film(h, s)
        flow, rise = conductance(h, s, mean, share, along)
        drag, drag_rise = dragged(h, s, mean, share, along, slip)
    if regime is not None:
        flow, rise = _slowed(flow, rise, h, regime, ALONG)
    w3 = w / flow
    d3 = -w3 * rise * opens / flow
    return w3 * drag, w3, d3 * drag + w3 * drag_rise * opens, d3


@_linked
def _slowed(flow, rise, h, regime, way):
    """Conductance of turbulent flow and its derivative, of those of laminar flow."""
    more, more_rise = factor(h, regime, way)
    return flow / more, (rise - flow * more_rise / more) / more


@_linked
def cell_terms(h, w, surfaces):
    """Of a node of a cell w·H³ and its derivative, w·H and its derivative, w/H; share of open gap.

    The last is the derivative of the mean gap by that of the mean planes.
    """
    if surfaces is None:
        return w * h * h * h, 3.0 * w * h * h, w * h, w, w / h, 1.0
    return _cell_terms(h, w, surfaces[0], surfaces[1])


@_linked
def _cell_terms(h, w, rough, regime):
    """`cell_terms` of rough surfaces, of turbulent flow, or of both."""
    opens = 1.0
    if rough is None:
        flow, rise, mean, share, inverse = h * h * h, 3.0 * h * h, h, 1.0, 1.0 / h
    else:
        s, along, across, _, yields = rough
        h, opens = opened(h, yields)
        mean, share = mean_film(h, s)
        flow, rise = conductance(h, s, mean, share, across)
        share *= opens
        inverse = sheared(h, s, along)
    if regime is not None:
        flow, rise = _slowed(flow, rise, h, regime, ACROSS)
        inverse *= factor(h, regime, SHEAR)[0]
    return w * flow, w * rise * opens, w * mean, w * share, w * inverse, share


@_loop
def gap_coefficients(face, cell, strength, places, surfaces, out, open_share):
    """Coefficients of the gaps H = 1 − ex cos θ − ey sin θ of some places, `out` (l, 8, nx + 1, 1).

    `places` (l, 2) are those of the shaft, ex and ey.
    Nodes are those of `Mesh.trigonometry`, in the coordinate a of the Sommerfeld map whose strength
    is `strength` (0: θ = a) times ex, densest at θ = 0. Rough surfaces also fill the share of open
    gap, `open_share` (nx, 1), that of the last place.
    """
    _, nf, nq = face.shape
    for at in range(places.shape[0]):
        ex, ey = places[at, 0], places[at, 1]
        stretch = min(strength * ex, FLATTEST)
        root = np.sqrt(1.0 - stretch * stretch)
        for i in range(nf):
            i3 = 0.0
            i2 = 0.0
            for q in range(nq):
                d = 1.0 / (1.0 + stretch * face[0, i, q])
                c = (stretch + face[0, i, q]) * d
                s = root * face[1, i, q] * d
                w2, w3, _, _ = resistance(1.0 - ex * c - ey * s, face[2, i, q] * root * d, surfaces)
                i2 += w2
                i3 += w3
            out[at, G, i, 0] = 1.0 / i3
            out[at, E, i, 0] = i2 / i3
        for i in range(nf - 1):
            for row in range(H3, HINV + 1):
                out[at, row, i, 0] = 0.0
            opened, width = 0.0, 0.0
            for q in range(nq):
                d = 1.0 / (1.0 + stretch * cell[0, i, q])
                c = (stretch + cell[0, i, q]) * d
                s = root * cell[1, i, q] * d
                w = cell[2, i, q] * root * d
                cubed, _, mean, w_open, inverse, _ = cell_terms(1.0 - ex * c - ey * s, w, surfaces)
                out[at, H3, i, 0] += cubed
                out[at, HM, i, 0] += mean
                out[at, COS, i, 0] += w * c
                out[at, SIN, i, 0] += w * s
                out[at, HINV, i, 0] += inverse
                opened += w_open
                width += w
            if open_share is not None:
                open_share[i, 0] = opened / width


@_loop
def cylinder_slopes(
    face, cell, strength, polar, roughness, x, y, surfaces, places, beside, coefs, open_share, modes
):
    """Derivatives of the coefficients by the position (x, y), in all of `coefs` but the first.

    By the eccentricity alone where the mesh turns with it (`polar`). Central differences of closed
    forms: the relative error is below 1e-7 for gaps above 1e-5; the step is the one at which what
    it leaves out and what rounding adds are alike. `places` (2 s, 2) and `beside` (2 s, …) are room
    for them; `modes` (1 + s, 2, nx) are cosine and sine of the cells, and theirs.
    """
    ratio = np.hypot(x, y)
    gap = max(1.0 - ratio, roughness)
    step = gap * max(_STEP, min((EPS / max(gap, EPS)) ** (1.0 / 3.0), _WIDEST))
    for at in range(beside.shape[0]):
        places[at, 0], places[at, 1] = (ratio, 0.0) if polar else (x, y)
        places[at, at // 2] += step if at % 2 == 0 else -step
    gap_coefficients(face, cell, strength, places, surfaces, beside, open_share)
    _, rows, nx, _ = coefs.shape
    for at in range(1, coefs.shape[0]):
        for row in range(rows):
            for i in range(nx):
                more, less = beside[2 * at - 2, row, i, 0], beside[2 * at - 1, row, i, 0]
                coefs[at, row, i, 0] = (more - less) / (2.0 * step)
    for at in range(coefs.shape[0]):
        for i in range(nx - 1):
            modes[at, 0, i], modes[at, 1, i] = coefs[at, COS, i, 0], coefs[at, SIN, i, 0]


@_loop
def along_the_gap(x, y, dx, dy, limit):
    """Where a step (dx, dy) of the shaft in a cylinder leads, no farther out than `limit`.

    An eccentric shaft goes along the gap, not along the chord.
    """
    ratio = np.hypot(x, y)
    if ratio < 0.5:
        length = np.hypot(x + dx, y + dy)
        share = min(1.0, limit / length) if length > 0.0 else 1.0
        return share * (x + dx), share * (y + dy)
    radial = (x * dx + y * dy) / ratio
    turn = np.arctan2(y, x) + max(-0.5, min(0.5, (x * dy - y * dx) / ratio**2))
    length = max(0.3, min(limit, ratio + radial))
    return length * np.cos(turn), length * np.sin(turn)


@_loop
def shaped_coefficients(
    face, face_gap, cell, cell_gap, ex, ey, surfaces, coef, by_x, by_y, open_share
):
    """Coefficients of the gap H = H_0 − ex cos θ − ey sin θ and their derivatives by ex and ey.

    `face` (3, nx + 1, 2) and `cell` (3, nx) are cosine, sine and weight of the nodes between cell
    centres and in cells, `face_gap` (nx + 1, 2, rows) and `cell_gap` (nx, rows) H_0 there; ex and
    ey (nx, rows). Each side of a face has a node of its own, so that a step of the gap is exact.
    Rough surfaces also fill the share of open gap, `open_share` (nx, rows).
    """
    nx, rows = ex.shape
    for i in range(nx + 1):
        j = min(i, nx - 1)
        for k in range(rows):
            i2, i3, x2, x3, y2, y3 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
            for q in range(2):
                c, s = face[0, i, q], face[1, i, q]
                h = face_gap[i, q, k] - ex[j, k] * c - ey[j, k] * s
                w2, w3, d2, d3 = resistance(h, face[2, i, q], surfaces)
                # h falls by c and s
                i2 += w2
                i3 += w3
                x2 -= d2 * c
                y2 -= d2 * s
                x3 -= d3 * c
                y3 -= d3 * s
            g = 1.0 / i3
            e = i2 * g
            coef[G, i, k], by_x[G, i, k], by_y[G, i, k] = g, -g * g * x3, -g * g * y3
            coef[E, i, k], by_x[E, i, k], by_y[E, i, k] = e, g * (x2 - e * x3), g * (y2 - e * y3)
    for i in range(nx):
        c, s, w = cell[0, i], cell[1, i], cell[2, i]
        coef[COS, i, 0], coef[SIN, i, 0] = w * c, w * s
        for k in range(rows):
            h = cell_gap[i, k] - ex[i, k] * c - ey[i, k] * s
            cubed, rise, mean, w_open, inverse, share = cell_terms(h, w, surfaces)
            coef[CELL3, i, k], by_x[CELL3, i, k], by_y[CELL3, i, k] = cubed, -rise * c, -rise * s
            coef[HM, i, k], by_x[HM, i, k], by_y[HM, i, k] = mean, -w_open * c, -w_open * s
            coef[HINV, i, k] = inverse
            if open_share is not None:
                open_share[i, k] = share


@_loop
def mode_slopes(by_x, by_y, modes, across, coef, dz, out):
    """Derivatives of `coef`, `out` (m, …), by modes that move the shaft by (m, nx, 2) · across."""
    size, nx, _ = modes.shape
    rows = across.shape[1]
    for mode in range(size):
        for i in range(nx + 1):
            j = min(i, nx - 1)
            for k in range(rows):
                x, y = modes[mode, j, 0] * across[mode, k], modes[mode, j, 1] * across[mode, k]
                for row in (G, E, HM, CELL3):
                    out[mode, row, i, k] = x * by_x[row, i, k] + y * by_y[row, i, k]
        faces_across(coef, dz, True, out[mode])


@_loop
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
