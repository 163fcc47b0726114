"""Compiled asperities of the reduced film with effects: what they carry in the gap that is there.

`film` and `work` are those of `composed.film`, after `_gap_kernels.place`.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import LOAD
from loadflow.journal.models._compile import inner
from loadflow.journal.models._small_systems import fill_upper
from loadflow.journal.models.composed.kernels._of_effects import of_shell
from loadflow.journal.models.composed.kernels._table_kernels import between, of_table


@inner
def opened(yielding, h):
    """Gap where asperities press the shell open, and its derivative by the gap `h` without that."""
    if not yielding.on or h >= yielding.first + yielding.step * (yielding.table.shape[1] - 1):
        return h, 1.0
    return of_table(yielding, 0, h)


@inner
def touch(film, work, q):
    """Load of the asperities and its derivative into `work.touch`, ∫ p_a into `work.normal`."""
    work.touch[:] = 0.0
    if film.rough.size > 0.0 and film.yielding.on:
        work.normal[0] = _touch_shell(film, work, q)
        _touch_follows(film, work)
    elif film.rough.size > 0.0:
        work.normal[0] = _touch_bore(film, work, q)


@inner
def _touch_bore(film, work, q):
    """∫ p_a and `work.touch` in a rigid cylindrical bore, by the table of a line of contact."""
    normal, rough = 0.0, film.rough
    last = rough.table.shape[1] - 2
    load, stiffness = work.touch[0], work.touch[1:]
    for g in range(rough.z.size):
        z, w = rough.z[g], rough.weights[g]
        ex = q[0] + q[3] * z + 0.5 * work.bend[0] * z * z
        ey = q[1] - q[2] * z + 0.5 * work.bend[1] * z * z
        ratio = np.hypot(ex, ey)
        if not ratio > rough.first:
            continue
        place_in = (ratio - rough.first) / rough.step
        i = min(int(place_in), last)
        force, rise = between(rough.table[0], rough.table[1], i, place_in - i, rough.step)
        pressed, _ = between(rough.table[2], rough.table[3], i, place_in - i, rough.step)
        normal += w * pressed
        push(load, stiffness, z, ex / ratio, ey / ratio, w * force, w * rise, w * force / ratio)
    fill_upper(stiffness)
    return normal


@inner
def _touch_shell(film, work, q):
    """∫ p_a and `work.touch` where asperities are asked from place to place."""
    return touch_places(film, work, q)


@of_shell(lambda film, work: None)
def _touch_follows(film, work):
    """Let `work.touch` know that a shell that they press open all over follows the shaft."""
    rub, shapes = work.modes.rub, film.modes.shapes
    if rub.on[0] > 0.0:
        for b in range(4):
            for j in range(shapes.shape[0]):
                by = rub.by_place[b, j]
                for i in range(shapes.shape[1]):
                    if rub.touched[i]:
                        for k in range(film.nodes.z.size):
                            grown = shapes[j, i, k] * by
                            for a in range(4):
                                work.touch[1 + a, b] += rub.pushed[a, i, k] * grown


@inner
def touch_places(film, work, q):
    """∫ p_a and `work.touch` on a shell that is pressed open, in a shaped bore, or beside grooves.

    Between two cell centres the pressure of the film, and so the gap by it, runs straight. Fills
    `work.pressed`, and of a shell that gives way all over what is pressed where, too.
    """
    nx, m = film.ring.cos.size, film.nodes.slopes.shape[1]
    yielding, ring, give, grows = film.yielding, film.ring, film.give, film.uneven.grows
    p, pressed, load, stiffness = work.state[LOAD], work.pressed, work.touch[0], work.touch[1:]
    pressed[:] = 0.0
    load[:] = 0.0
    stiffness[:] = 0.0
    _begin_rubbing(film, work)
    beyond = yielding.first + yielding.step * (yielding.table.shape[1] - 1)
    normal = 0.0
    for g in range(yielding.z.size):
        z = yielding.z[g]
        mid_x = q[0] + q[3] * z + 0.5 * work.bend[0] * z * z
        mid_y = q[1] - q[2] * z + 0.5 * work.bend[1] * z * z
        depth = yielding.depth[g]
        far = 1.0 + depth - np.hypot(mid_x, mid_y) >= beyond
        if far and not (ring.shaped or grows or film.modes.on):
            continue
        there = give * _across(yielding.values[g], p[0], ring.p_edge)
        there += _opened_beside(film, work, g, 0)
        if grows:
            there += film.uneven.beside[0, g]
        for i in range(nx):
            right = i + 1 if i + 1 < nx else 0
            here, there = there, give * _across(yielding.values[g], p[right], ring.p_edge)
            there += _opened_beside(film, work, g, right)
            if grows:
                there += film.uneven.beside[right, g]
            if yielding.grooves[g, i]:
                continue
            step = ring.apart[i]
            wide, ex, ey = depth + ring.lobe[0, i], mid_x + ring.lobe[1, i], mid_y + ring.lobe[2, i]
            edge = wide - ex * ring.cos[i] - ey * ring.sin[i] + here
            other = wide - ex * ring.cos[right] - ey * ring.sin[right] + there
            dip = 0.125 * step * step  # of a gap between two places, at most
            if ring.groove[i]:
                edge = wide - ex * ring.cos_face[i] - ey * ring.sin_face[i] + min(here, 0.0)
            if ring.groove[right]:
                other = wide - ex * ring.cos_face[i] - ey * ring.sin_face[i] + min(there, 0.0)
            if min(edge, other) - dip * (abs(ex) + abs(ey)) >= beyond:
                continue
            total, along_x, along_y = 0.0, 0.0, 0.0
            xx, xy, yy = 0.0, 0.0, 0.0
            high_x, high_y, rise_x, rise_y = 0.0, 0.0, 0.0, 0.0
            high, rises, high_rises, high_high = 0.0, 0.0, 0.0, 0.0
            for n in range(yielding.share.size):
                share, c, s = yielding.share[n], yielding.cos[i, n], yielding.sin[i, n]
                h = wide - ex * c - ey * s + here + share * (there - here)
                if h >= beyond:
                    continue
                value, rise = of_table(yielding, 2, h)
                value, rise = yielding.part[n] * value, yielding.part[n] * rise
                total += value
                along_x += value * c
                along_y += value * s
                high += share * value
                rises += rise
                high_rises += share * rise
                high_high += share * share * rise
                by_x, by_y = rise * c, rise * s
                rise_x += by_x
                rise_y += by_y
                high_x += share * by_x
                high_y += share * by_y
                xx += by_x * c
                xy += by_x * s
                yy += by_y * s
            weight = yielding.weights[g] * step * yielding.unit
            normal += weight * total
            _add_modes(load, z, weight * along_x, weight * along_y)
            _take_modes(stiffness, z, weight * xx, weight * xy, weight * yy)
            low_x, low_y = weight * (rise_x - high_x), weight * (rise_y - high_y)
            high_x, high_y = weight * high_x, weight * high_y
            forces = weight * (total - high), weight * high, low_x, low_y, high_x, high_y
            both = weight * (high_rises - high_high)
            rises = weight * (rises - high_rises) - both, both, weight * high_high
            _press_beside(film, work, g, i, right, z, forces, rises)
            if give > 0.0:
                low_x, low_y = low_x * give, low_y * give
                high_x, high_y = high_x * give, high_y * give
                for k in range(m):
                    value = yielding.values[g, k]
                    _add_modes(pressed[:, i, k], z, value * low_x, value * low_y)
                    _add_modes(pressed[:, right, k], z, value * high_x, value * high_y)
    fill_upper(stiffness)
    return normal


@of_shell(lambda film, work: None)
def _begin_rubbing(film, work):
    """Nothing is pressed yet."""
    rub = work.modes.rub
    for i in range(rub.touched.size):
        if rub.touched[i]:
            rub.own[i], rub.next[i], rub.force[i] = 0.0, 0.0, 0.0
            for a in range(4):
                rub.pushed[a, i] = 0.0
        rub.touched[i] = False


@of_shell(lambda film, work, g, i: 0.0)
def _opened_beside(film, work, g, i):
    """Growth of the gap at a place across by a shell that gives way all over, clearances."""
    total, growth = 0.0, film.yielding.growth[g]
    for k in range(growth.size):
        total += growth[k] * work.modes.growth[i, k]
    return total


@of_shell(lambda film, work, g, i, right, z, forces, rises: None)
def _press_beside(film, work, g, i, right, z, forces, rises):
    """Add what asperities between two cell centres press at the points beside them.

    `forces` are those at both centres, N, and the slopes by the gap there of what pushes the shaft;
    `rises` of the first by the gap at its own centre, at the other, and of the second at its own.
    """
    rub, growth = work.modes.rub, film.yielding.growth[g]
    rub.touched[i], rub.touched[right] = True, True
    for k in range(growth.size):
        value = growth[k]
        rub.force[i, k] += value * forces[0]
        rub.force[right, k] += value * forces[1]
        _add_modes(rub.pushed[:, i, k], z, value * forces[2], value * forces[3])
        _add_modes(rub.pushed[:, right, k], z, value * forces[4], value * forces[5])
        for n in range(growth.size):
            product = value * growth[n]
            rub.own[i, k, n] += product * rises[0]
            rub.next[i, k, n] += product * rises[1]
            rub.own[right, k, n] += product * rises[2]


@inner
def _across(values, pressure, outside):
    """Pressure above that `outside` at a place across, from that at the points."""
    total = 0.0
    for k in range(values.size):
        total += values[k] * (pressure[k] - outside)
    return total


@inner
def push(load, stiffness, z, c, s, force, along, aside):
    """Add a force at `z` that pushes the shaft back from (c, s), and what it rises by there.

    By a motion along that way, and aside, into the lower half of `stiffness` (4, 4).
    """
    _add_modes(load, z, force * c, force * s)
    xx, yy = along * c * c + aside * s * s, along * s * s + aside * c * c
    _take_modes(stiffness, z, -xx, -(along - aside) * c * s, -yy)


@inner
def _add_modes(sums, z, x, y):
    """Add a load at a place `z` along the shaft to forces and moments (4,)."""
    sums[0] += x
    sums[1] += y
    sums[2] -= z * y
    sums[3] += z * x


@inner
def _take_modes(stiffness, z, xx, xy, yy):
    """Take the rise of a load at `z` from the lower half of a stiffness (4, 4)."""
    stiffness[0, 0] -= xx
    stiffness[1, 0] -= xy
    stiffness[1, 1] -= yy
    stiffness[2, 0] += z * xy
    stiffness[2, 1] += z * yy
    stiffness[2, 2] -= z * z * yy
    stiffness[3, 0] -= z * xx
    stiffness[3, 1] -= z * xy
    stiffness[3, 2] += z * z * xy
    stiffness[3, 3] -= z * z * xx
