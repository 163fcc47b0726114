"""Films between rough surfaces, compiled: what flows at a gap, and what asperities carry.

The gap that is left between cut heights is the mean ⟨h_T⟩ [Wu and Zheng 1989]; the flow factors are
those of [Patir and Cheng 1978] where rows of their coefficients are given. The gap is in
clearances, and so is the roughness s.
"""

from __future__ import annotations

from loadflow.numerics.linked import LINKED, njit
from loadflow.tribology import kernels as laws

LEAST = 1e-3  # mean gap over the roughness: valleys stay open under any load
_PRINTED = 1.0  # film parameter down to which φ_x h³ is taken as printed
NO_CONTACT = 12.0  # film parameter above which asperities carry less than rounding
_YIELDS = 60  # Newton steps of `yielded`; about one for each roughness that asperities lift


@njit(cache=True, nogil=True)
def yielded(h, s, give):
    """Gap of the summits where they press a shell open, and its derivative by `h`.

    h is the gap without that; `give` is the growth of the gap, clearances, under the unit K E* of
    asperity pressure. The equation h' = h + give F(h'/s) rises with h' and bends down, so that
    Newton's steps from h go up to its root.
    """
    if give == 0.0 or h > NO_CONTACT * s:
        return h, 1.0
    planes = h
    for _ in range(_YIELDS):
        value, rise = laws.pressure_integral(planes / s)
        step = (h + give * value - planes) / (1.0 - give * rise / s)
        planes += step
        if step <= 1e-15 * s:
            break
    _, rise = laws.pressure_integral(planes / s)
    return planes, 1.0 / (1.0 - give * rise / s)


@njit(cache=True, nogil=True)
def opened(h, yields):
    """Gap of the mean planes where summits press a shell open, and its derivative by `h`.

    `yields` are what the shell gives, roughness and height of the summits; see `yielded`.
    """
    give, s, summits = yields
    if give == 0.0:
        return h, 1.0
    planes, share = yielded(h - summits, s, give)
    return planes + summits, share


@njit(cache=True, nogil=True)
def mean_film(h, s):
    """Mean gap and its derivative by h."""
    mean, share = laws.mean_gap(h / s)
    if mean < LEAST:
        return s * LEAST, 0.0
    return s * mean, share


@njit(nogil=True, **LINKED)
def conductance(h, s, mean, share, rows):
    """φ h³, or ⟨h_T⟩³ without `rows`, and its derivative; mean gap and its derivative are given.

    φ was found at H > 0.5 … 1: below 1 it multiplies ⟨h_T⟩³, to which it is joined there.
    """
    if rows.shape[0] == 0:
        return mean**3, 3.0 * mean**2 * share
    parameter = h / s
    factor, rise = laws.pressure_factor(parameter, rows)
    if parameter >= _PRINTED:
        return factor * h**3, 3.0 * factor * h**2 + rise / s * h**3
    joined, _ = mean_film(_PRINTED * s, s)
    ratio = (_PRINTED * s / joined) ** 3
    return ratio * factor * mean**3, ratio * (3.0 * factor * mean**2 * share + rise / s * mean**3)


@njit(nogil=True, **LINKED)
def dragged(h, s, mean, share, rows, slip):
    """Gap that the shaft drags full, ⟨h_T⟩ + slip σ Φ_s, and its derivative; as `conductance`."""
    if rows.shape[0] == 0 or slip == 0.0:
        return mean, share
    factor, rise = laws.shear_factor(h / s, rows, True)
    return mean + slip * s * factor, share + slip * rise


@njit(nogil=True, **LINKED)
def sheared(h, s, rows):
    """Mean inverse of the gap: φ_f/h with flow factors, 1/⟨h_T⟩ without."""
    if rows.shape[0] == 0:
        return 1.0 / mean_film(h, s)[0]
    return laws.inverse_gap(h / s)[0] / s


@njit(cache=True, nogil=True)
def pressed(
    gap, s, give, weights_around, weights_across, held, reach, lengths, load, stiffness, relief
):
    """Sums over asperities at the nodes of a `gap` (n, rows), in units of K E*.

    `reach` (m, n) times `lengths` (m, rows) are the modes; `held` nodes, grooves, carry none; the
    shell yields by `give`. Fills ∫ F N_j and −∫ F' N_j N_k / s, at the nodes F'/s times their
    weight into `relief` (n, rows) unless that is empty, and returns ∫ F and the narrowest gap of
    those that touch.
    """
    n, rows = gap.shape
    size = load.size
    normal, narrowest = 0.0, NO_CONTACT * s
    load[:] = 0.0
    stiffness[:] = 0.0
    relief[:] = 0.0
    for i in range(n):
        for k in range(rows):
            if gap[i, k] > NO_CONTACT * s or held[i, k]:
                continue
            planes, share = yielded(gap[i, k], s, give)
            value, rise = laws.pressure_integral(planes / s)
            rise *= share
            narrowest = min(narrowest, planes)
            weight = weights_around[i] * weights_across[k]
            if relief.size > 0:
                relief[i, k] = weight * rise / s
            normal += weight * value
            for a in range(size):
                mode = weight * reach[a, i] * lengths[a, k]
                load[a] += mode * value
                for b in range(size):
                    stiffness[a, b] -= mode * rise / s * reach[b, i] * lengths[b, k]
    return normal, narrowest


@njit(cache=True, nogil=True)
def asperity_field(gap, s, give, free, value, slope):
    """Fill pressure of the summits at the nodes of a `gap` (n,), in units of K E*, and its slope.

    Nodes that are not `free` carry none; the shell yields by `give`.
    """
    for i in range(gap.size):
        if free[i] and gap[i] <= NO_CONTACT * s:
            planes, share = yielded(gap[i], s, give)
            pressure, rise = laws.pressure_integral(planes / s)
            value[i], slope[i] = pressure, rise * share / s
