"""Compiled loops of the estimate of what the cells of a film leave out."""

from __future__ import annotations

from numba import njit


@njit(cache=True, nogil=True, error_model="numpy")
def differences(pressure, width, dz, closed, half, p_line, p_edge, on_edges, around, across):
    """Second differences of the pressure of the cells from one to the next, and their sums.

    Parameters
    ----------
    pressure : array (nx, nz)
        Of the cells, Pa.
    width, dz : array (nx,), (nz,)
        Of the cells.
    closed, half : bool
        Whether the film runs round; whether it is symmetric to the first edge across.
    p_line, p_edge : float
        Pressure at both ends around, and across, Pa.
    on_edges : float
        How far beyond the outermost values the ends lie: 1 half a cell, 0 a whole one.
    around, across : array (nx, nz)
        The differences around and across, which are filled.

    Returns
    -------
    tuple of float
        ∫|p − p_edge|, ∫|differences|, the largest pressure and the differences next to it.
    """
    nx, nz = pressure.shape
    whole, bent, peak, row, col = 0.0, 0.0, 0.0, 0, 0
    for i in range(nx):
        for k in range(nz):
            here = pressure[i, k]
            line = p_line + on_edges * (p_line - here)
            edge = p_edge + on_edges * (p_edge - here)
            before = pressure[i - 1, k] if i > 0 else (pressure[nx - 1, k] if closed else line)
            after = pressure[i + 1, k] if i + 1 < nx else (pressure[0, k] if closed else line)
            inner = pressure[i, k - 1] if k > 0 else (here if half else edge)
            outer = pressure[i, k + 1] if k + 1 < nz else edge
            around[i, k] = abs(before + after - 2.0 * here)
            across[i, k] = abs(inner + outer - 2.0 * here)
            area = width[i] * dz[k]
            whole += abs(here - p_edge) * area
            bent += (around[i, k] + across[i, k]) * area
            if here > peak:
                peak, row, col = here, i, k
    along, beside = 0.0, 0.0
    for i in range(row - 1, row + 2):
        for k in range(max(0, col - 1), min(nz, col + 2)):
            along = max(along, around[i % nx, k])
            beside = max(beside, across[i % nx, k])
    return whole, bent, peak, along + beside
