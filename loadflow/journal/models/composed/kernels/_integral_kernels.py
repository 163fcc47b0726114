"""Compiled integrals over a reduced film with effects: friction, flows, fill, largest pressure.

`film` and `work` are those of `composed.film`, after `_balance_kernels.balance`.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import FILL, LOAD, P
from loadflow.journal.film.gap._rough_kernels import sheared
from loadflow.journal.film.gap._turbulence_kernels import SHEAR, factor
from loadflow.journal.models._compile import inner, once
from loadflow.journal.models.composed import film as film_
from loadflow.journal.models.composed.kernels._gap_kernels import (
    CUBE,
    DRAG,
    FACE_PLANES,
    FLOW,
    MEAN,
    OPEN,
    PLANES,
    narrowest,
    smooth_beyond,
)
from loadflow.journal.models.composed.kernels._shell_growth_kernels import largest_growth
from loadflow.journal.models.composed.kernels._thickening_kernels import (
    THICK,
    pressure_at,
    thickness_at,
)
from loadflow.journal.models.composed.kernels._touch_kernels import opened
from loadflow.numerics.lanes import LANES, larger, put, spread, take


@inner
def summarise(film, work, q, wedge, rate, row):
    """Integrals over the film into `row`, after `balance` and `touch` at `q`.

    Units are those of `_reduced_kernels`.
    Slopes across are those of the smooth pressure that a law may cut off to carry nothing: a
    polynomial through what is left has slopes everywhere.
    """
    nx, wide = work.u.shape
    lanes, ring, nodes, m = film.lanes, film.ring, film.nodes, film.nodes.slopes.shape[1]
    p, fill, gap, flows = work.state[LOAD], work.state[FILL], work.gap, work.face[FLOW]
    mean, cube, planes, rows = gap[MEAN], gap[CUBE], gap[PLANES], work.row
    plain = film.rough.size == 0.0 and not (film.yielding.on or film.regime.on or film.held.on)
    plain = plain and not (film.uneven.on or film.thickening.on)
    for at in range(0, wide, LANES):
        lost, sheared_at = spread(0.0), spread(0.0)
        liquid_at, volume_at = spread(0.0), spread(0.0)
        weights, own = take(lanes.whole, at), take(lanes.weights, at)
        ends = take(lanes.ends, at) * ring.edge_fill
        for i in range(nx):
            here, right = i * wide + at, (i + 1 if i + 1 < nx else 0) * wide + at
            step, slope = ring.width[i], take(work.slope, here)
            across = 0.0 if ring.groove[i] else step
            flow, rise = take(cube, here) * slope * across, take(p, right) - take(p, here)
            lost = lost + weights * flow * slope
            lost = lost + own * take(flows, here) * rise * rise * (1.0 / ring.apart[i])
            if ring.back[i] == 0.0:  # a groove between segments; in a supply's there is oil
                continue
            held = weights * take(mean, here) * step
            liquid_at = liquid_at + held * (take(fill, here) * take(lanes.inner, at) + ends)
            volume_at = volume_at + held
            if plain:
                sheared_at = sheared_at + weights / take(planes, here) * step
        put(rows, at, lost)
        put(rows, wide + at, sheared_at)
        put(rows, 2 * wide + at, liquid_at)
        put(rows, 3 * wide + at, volume_at)
    dissipation, shear = _lost_more(film, work) - _cut_off(film, work), 0.0
    liquid, volume = 0.0, 0.0
    for k in range(nodes.z.size):
        dissipation, shear = dissipation + rows[0, k], shear + rows[1, k]
        liquid, volume = liquid + rows[2, k], volume + rows[3, k]
    grown = 0.0
    if not plain:
        shear, grown = _uneven(film, work)
    peak, highest = -np.inf, 0
    for i in range(nx):
        for k in range(m):
            if p[i, k] > peak:
                peak, highest = p[i, k], i
    between = spread(peak)
    for i in range(highest - 1, highest + 2):  # between the points
        for at in range(0, lanes.fine.shape[1], LANES):
            value = spread(ring.p_edge)
            for j in range(m):
                share = take(lanes.fine, j * lanes.fine.shape[1] + at)
                value = value + share * (p[i % nx, j] - ring.p_edge)
            between = larger(between, value)
    put(rows, 0, between)
    for k in range(LANES):
        peak = max(peak, rows[0, k])
    left = 0.0
    for n in range(nodes.highest.shape[0]):
        value = 0.0
        for j in range(m):
            value += nodes.highest[n, j] * (p[highest, j] - ring.p_edge)
        left = max(left, abs(value))
    beyond = 0.0
    for n in range(nodes.beyond.shape[0]):
        value = 0.0
        for j in range(m):
            value += nodes.beyond[n, j] * (p[highest, j] - ring.p_edge)
        beyond += abs(value)
    for k in range(4):
        row[k] = q[k]
    row[film_.PEAK] = peak
    row[film_.DISSIPATION] = dissipation
    row[film_.SHEAR] = shear
    row[film_.OUTFLOW] = _outflow(film, work, wedge, rate)
    row[film_.FILLED] = liquid / volume
    row[film_.LEAST] = narrowest(film, work)
    grown = max(grown, film.give * (peak - ring.p_edge))
    row[film_.GROWTH] = max(grown, largest_growth(film, work))
    row[film_.NORMAL] = work.normal[0]
    row[film_.MOMENT_X] = work.load[2] + work.touch[0, 2]
    row[film_.MOMENT_Y] = work.load[3] + work.touch[0, 3]
    row[film_.CONTACT_X] = work.touch[0, 0]
    row[film_.CONTACT_Y] = work.touch[0, 1]
    mean_pressure = np.hypot(work.load[0] + work.touch[0, 0], work.load[1] + work.touch[0, 1])
    mean_pressure /= 2.0 * ring.area * nodes.width
    # beside asperities a film may carry next to nothing
    pressed = max(peak - ring.p_edge, mean_pressure, 1e-3 * ring.scale)
    row[film_.HIGHEST], row[film_.BEYOND] = left / pressed, beyond / pressed
    row[film_.FED] = fed(film, work, wedge) if ring.shaped else 0.0
    for j in range(work.fed.size):
        i, k = film.feeding.samples[j, 0], film.feeding.samples[j, 1]
        row[film_.RESULTS + j] = work.fed[j]
        row[film_.RESULTS + work.fed.size + j] = pressure_at(film, work, i, k)


@once
def _outflow(film, work, wedge, rate):
    """Flow out over the bearing ends, where it is not drawn in there.

    It is what the balance of a column leaves for its end: the slope of the polynomial there is far
    off where the pressure reaches the end with a bend.
    """
    ring, nodes, total = film.ring, film.nodes, 0.0
    first, cube = nodes.z.size - nodes.ends.size, work.gap[CUBE]
    for e in range(nodes.ends.size):
        drawn = nodes.weights[first + e] * ring.edge_fill * wedge
        for i in range(ring.cos.size):
            before = i - 1 if i > 0 else ring.cos.size - 1
            if ring.groove[i] or work.slope[i, first + e] == 0.0:  # the latter beside a pad let go
                continue
            along = work.face[FACE_PLANES, i, first + e] - work.face[FACE_PLANES, before, first + e]
            held = rate * work.gap[MEAN, i, first + e]
            held += work.gap[OPEN, i, first + e] * work.squeeze[i, first + e]
            held *= work.state[FILL, i, first + e]
            held = (held - work.liquid[0, i, first + e]) * ring.slope * ring.width[i]
            flow = drawn * along + nodes.weights[first + e] * held
            for k in range(nodes.z.size):
                slope = nodes.weights[k] * cube[i, k] * work.slope[i, k]
                flow += slope * nodes.end_slopes[k, e] * ring.width[i]
            total -= min(flow, 0.0)
    return total


@inner
def _share_above(here, there, floor):
    """Share of the way to the middle between two points on which a pressure is above `floor`."""
    middle = 0.5 * (here + there)
    if min(here, middle) >= floor:
        return 1.0
    return max(max(here, middle) - floor, 0.0) / max(abs(here - middle), 1e-300)


@inner
def _lost_more(film, work):
    """What the flow by pressure loses more than what drives it tells."""
    total, nodes, ring = 0.0, film.nodes, film.ring
    if film.thickening.on:
        nx, m = ring.cos.size, nodes.slopes.shape[1]
        p, cube, flows = work.state[LOAD], work.gap[CUBE], work.face[FLOW]
        for i in range(nx):
            right = i + 1 if i + 1 < nx else 0
            across = 0.0 if ring.groove[i] else ring.width[i]
            for k in range(nodes.z.size):
                more = thickness_at(film, work, i, k) - 1.0
                slope = work.slope[i, k]
                total += nodes.weights[k] * cube[i, k] * slope * slope * across * more
            for k in range(m):
                both = 0.5 * (work.thick[THICK, i, k] + work.thick[THICK, right, k])
                rise = p[right, k] - p[i, k]
                less = 1.0 / both - 1.0
                total += nodes.weights[k] * flows[i, k] * rise * rise * less / ring.apart[i]
    return total


@once
def _cut_off(film, work):
    """What slopes across lose where the pressure is cut off and carries nothing.

    Between two points it is taken to be straight, so that a point may carry in part.
    """
    ring, nodes, m = film.ring, film.nodes, film.nodes.slopes.shape[1]
    total, first, both = 0.0, film.nodes.z.size - film.nodes.ends.size, nodes.ends.size == 2
    for i in range(ring.cos.size):
        p, load, floor = work.state[P, i], work.state[LOAD, i], -np.inf
        for k in range(m):
            if pressure_at(film, work, i, k) < load[k]:
                floor = load[k]
        if ring.groove[i] or floor == -np.inf:
            continue
        for k in range(nodes.z.size):
            at = k
            for n in range(m if m <= k < first else 0):  # the same place as an inner point
                at = n if nodes.z[n] == nodes.z[k] else at
            if k >= first:
                beside = 0 if nodes.ends[k - first] < 0.0 else m - 1
                carries = _share_above(ring.p_edge, p[beside], floor)
            else:
                low = p[at - 1] if at > 0 else (ring.p_edge if both else p[0])
                high = p[at + 1] if at < m - 1 else ring.p_edge
                carries = _share_above(p[at], low, floor) + _share_above(p[at], high, floor)
                carries *= 0.5
            lost = nodes.weights[k] * work.gap[CUBE, i, k] * work.slope[i, k] ** 2
            total += (1.0 - carries) * lost * ring.width[i]
    return total


@once
def _uneven(film, work):
    """Shear where it is not that of an even gap, and growth of the gap.

    Between rough surfaces, of turbulent flow, beside grooves, of an uneven viscosity; of this one
    also fills `work.sheared`.
    """
    points, m = film.nodes.z.size, film.nodes.slopes.shape[1]
    shear, grown = 0.0, 0.0
    for i in range(film.ring.cos.size):
        if film.ring.groove[i]:
            continue
        for k in range(points):
            inverse, grows = _sheared_at(film, work, i, k)
            grown = max(grown, grows)
            if film.uneven.on:
                inverse *= work.state[FILL, i, k] if k < m else film.ring.edge_fill
            inverse *= thickness_at(film, work, i, k)
            part = film.nodes.weights[k] * film.ring.width[i] * inverse
            if film.uneven.on:
                work.sheared[i, k] = part
                part *= film.uneven.shear[i, k]
            shear += part
    return shear, grown


@inner
def _sheared_at(film, work, i, k):
    """Mean inverse of the gap at a point, with what grooves take of it, and growth of the gap."""
    h, m, rough, grown = work.gap[PLANES, i, k], film.nodes.slopes.shape[1], film.rough, 0.0
    if film.yielding.on:
        h = opened(film.yielding, h)[0]
        if k < m:
            lifted = h - work.gap[PLANES, i, k]
            pressed = work.state[LOAD, i, k] - film.ring.p_edge
            grown = film.give * pressed + lifted
    far = -1.0 if rough.size == 0.0 else smooth_beyond(rough)
    inverse = sheared(h, rough.size, rough.along) if h <= far else 1.0 / h
    if film.regime.on:
        numbers = (work.numbers[0], work.numbers[1], film.regime.begin, film.regime.end)
        inverse *= factor(h, numbers, SHEAR)[0]
    if film.held.on and k < m:
        inverse *= film.held.drags[i, k]
    return inverse, grown


@once
def fed(film, work, wedge):
    """Flow from grooves between segments into the film, less what flows back, after `place`."""
    nx, m = film.ring.cos.size, film.nodes.slopes.shape[1]
    weights, p, fill, face = film.nodes.weights, work.state[P], work.state[FILL], work.face
    total, groove, whole = 0.0, film.ring.groove, film.held.columns
    for i in range(nx):
        right = i + 1 if i + 1 < nx else 0
        feeds = groove[i] and not whole[i]  # a supply counts its flow by itself
        if feeds == (groove[right] and not whole[right]):
            continue
        upwind = i if wedge > 0 else right
        flow = 0.0
        for k in range(m):
            rise = (p[right, k] - p[i, k]) / film.ring.apart[i]
            drag = wedge * fill[upwind, k] * face[DRAG, i, k]
            flow += weights[k] * (drag - face[FLOW, i, k] * rise)
        for k in range(m, film.nodes.z.size):  # the ends, at the pressure of the grooves
            flow += weights[k] * wedge * film.ring.edge_fill * face[FACE_PLANES, i, k]
        total += flow if feeds else -flow
    return total
