"""Compiled: a Newton step of a shaft on pads that tilt, each of which follows it without moment."""

from __future__ import annotations

from loadflow.journal.cavitation import DLOAD, LOAD
from loadflow.journal.models._compile import inner
from loadflow.journal.models.composed.kernels._pad_kernels import NEXT, STEP, lift_of

KEPT_ON_PADS = 0.3  # share of a gap, or of the tilt of a pad, that a step leaves
_SMALL = 0.03  # tilt of a pad, in clearances, from which it may grow threefold in a step


@inner
def carry_on_pads(film, work, pads, pad_work, size):
    """Load of each pad beside that of the edge pressure, and what the columns carry on it.

    What touches a pad is among both.
    """
    nx, m = film.ring.cos.size, film.nodes.slopes.shape[1]
    z, weights, columns, unit = film.nodes.z, film.nodes.weights, work.columns, film.ring.area
    pad_work.carried[:] = 0.0
    for j in range(pad_work.on.size):
        for a in range(4):
            pad_work.load[j, a] = pad_work.touch[j, 0, a]
            for b in range(size):
                pad_work.carried[j, 1 + b, a] = -pad_work.touch[j, 1 + a, b]
    for i in range(nx):
        j = pads.cell[i]
        if film.ring.groove[i]:
            continue
        c, s = unit * film.ring.load_x[i], unit * film.ring.load_y[i]
        load, turned = 0.0, 0.0
        for k in range(m):
            part = weights[k] * (work.state[LOAD, i, k] - film.ring.p_edge)
            load += part
            turned += part * z[k]
        pad_work.load[j, 0] += load * c
        pad_work.load[j, 1] += load * s
        pad_work.load[j, 2] -= turned * s
        pad_work.load[j, 3] += turned * c
        for column in range(1 + size):
            load, turned = 0.0, 0.0
            for k in range(m):
                part = weights[k] * work.state[DLOAD, i, k] * columns[column, i, k]
                load += part
                turned += part * z[k]
            pad_work.carried[j, column, 0] += load * c
            pad_work.carried[j, column, 1] += load * s
            pad_work.carried[j, column, 2] -= turned * s
            pad_work.carried[j, column, 3] += turned * c


@inner
def moments_of_pads(film, work, pads, pad_work):
    """Sum of the squared moments of the pads about their pivots, N², over the shaft radius."""
    m, unit, total, moment, last = film.nodes.slopes.shape[1], film.ring.area, 0.0, 0.0, -1
    for i in range(work.u.shape[0]):
        j = pads.cell[i]
        if j != last:
            total, moment, last = total + moment * moment, 0.0, j
            if j >= 0 and pad_work.on[j]:
                moment = pads.along[j, 0] * pad_work.touch[j, 0, 0]
                moment += pads.along[j, 1] * pad_work.touch[j, 0, 1]
        if film.ring.groove[i]:
            continue
        load = 0.0
        for k in range(m):
            load += film.nodes.weights[k] * (work.state[LOAD, i, k] - film.ring.p_edge)
        arm = pads.along[j, 0] * film.ring.load_x[i] + pads.along[j, 1] * film.ring.load_y[i]
        moment += unit * load * arm
    return total + moment * moment


@inner
def condense(work, pads, pad_work, size):
    """What the columns carry on the pads as these follow the shaft, into `work.carried`.

    A pad follows the shaft so that it has no moment: what the load of a pad changes by its tilt is
    what it changes by the place of the shaft along the tangent.
    """
    work.carried[:] = 0.0
    for j in range(pad_work.on.size):
        ex, ey = pads.along[j, 0], pads.along[j, 1]
        carried, follow = pad_work.carried[j], pad_work.follow[j]
        own = ex * (pad_work.load[j, 0] - carried[0, 0])
        own += ey * (pad_work.load[j, 1] - carried[0, 1])
        follow[0] = own
        for b in range(size):
            follow[1 + b] = ex * carried[1 + b, 0] + ey * carried[1 + b, 1]
        by_tilt = ex * (ex * carried[1, 0] + ey * carried[1, 1])
        by_tilt += ey * (ex * carried[2, 0] + ey * carried[2, 1])
        follow[5] = by_tilt if pad_work.on[j] else 0.0
        for a in range(size):
            turned = 0.0
            if follow[5] != 0.0:
                turned = (ex * carried[1, a] + ey * carried[2, a]) / by_tilt
            work.carried[0, a] += carried[0, a] + turned * own
            for b in range(size):
                work.carried[1 + b, a] += carried[1 + b, a] - turned * follow[1 + b]


@inner
def turn_pads(pads, pad_work, q, step, share, size):
    """Steps of the tilts beside a `step` (4,) of the shaft from `q`, a share of that of Newton.

    A pad that tilts the other way has no film, and would stay so.
    """
    tilts = pad_work.tilts
    for j in range(pad_work.on.size):
        follow, moves = pad_work.follow[j], 0.0
        if follow[5] != 0.0:
            moves = share * follow[0]
            for b in range(size):
                moves -= follow[1 + b] * step[b]
            moves /= follow[5]
        tilts[STEP, j] = moves
        if moves == 0.0:
            continue
        before = lift_of(pads, tilts, NEXT, j, q[0], q[1])
        after = lift_of(pads, tilts, NEXT, j, q[0] + step[0], q[1] + step[1]) + moves
        sign = -1.0 if before < 0.0 else 1.0
        most = max(abs(before), _SMALL) / KEPT_ON_PADS
        tilts[STEP, j] += sign * min(max(sign * after, KEPT_ON_PADS * abs(before)), most) - after


@inner
def share_on_pads(film, work, pads, pad_work, step, kept):
    """Share of a step of shaft and tilts that leaves every place of the pads `kept` of its gap.

    Places are cell centres and faces, to the ends of the bearing: the ends of a pad are faces.
    """
    share, ring, tilts = 1.0, film.ring, pad_work.tilts[STEP]
    for i in range(ring.cos.size):
        j = pads.cell[i]
        if j >= 0:
            at = ring.cos[i], ring.sin[i], ring.base[i]
            share = _share_at(film, work, pads.along[j], tilts[j], step, kept, at, share)
        j, at = pads.face[i], (ring.cos_face[i], ring.sin_face[i], ring.base_face[i])
        share = _share_at(film, work, pads.along[j], tilts[j], step, kept, at, share)
    return share


@inner
def _share_at(film, work, along, turns, step, kept, at, share):
    """At most `share`: that of a step which leaves `kept` of the gap at one angle around.

    The pad turns by `turns`; `at`: cosine and sine of the angle, and H of the centred shaft there.
    """
    c, s, base = at
    dx, dy = step[0] + turns * along[0], step[1] + turns * along[1]
    for k in range(film.places.z.size):
        z = film.places.z[k]
        closes = (dx + step[3] * z) * c + (dy - step[2] * z) * s
        gap = base + film.places.depth[k] - work.centre[0, k] * c - work.centre[1, k] * s
        if closes > 0.0 and share * closes > (1.0 - kept) * gap:
            share = max((1.0 - kept) * gap / closes, 0.0)
    return share


@inner
def move_on_pads(film, work, pads, pad_work, step, share):
    """Move film and pads, not the shaft, by a share of a Newton step."""
    tilts = pad_work.tilts
    for j in range(pad_work.on.size):
        tilts[NEXT, j] += share * tilts[STEP, j]
    for i in range(work.u.shape[0]):
        if film.ring.groove[i]:
            continue
        j = pads.cell[i]
        turns = tilts[STEP, j]
        dx, dy = step[0] + turns * pads.along[j, 0], step[1] + turns * pads.along[j, 1]
        for k in range(film.nodes.slopes.shape[1]):
            change = work.columns[0, i, k] + dx * work.columns[1, i, k] + dy * work.columns[2, i, k]
            if step[2] != 0.0 or step[3] != 0.0:
                change += step[2] * work.columns[3, i, k] + step[3] * work.columns[4, i, k]
            work.u[i, k] -= share * change
