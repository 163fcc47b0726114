"""Compiled gap of the reduced film with effects.

At a position q of the shaft the shell, the mean gap and the conductances of points and faces follow
from law and unknowns; `film` and `work` are those of `composed.film`.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import LOAD
from loadflow.journal.film._kernels import apply_law
from loadflow.journal.film.gap._rough_kernels import conductance, dragged, mean_film
from loadflow.journal.film.gap._turbulence_kernels import ACROSS, ALONG, factor
from loadflow.journal.models._compile import inner, once
from loadflow.journal.models._full_kernels import keep_full
from loadflow.journal.models._reduced_kernels import NO_GAP, least_around
from loadflow.journal.models.composed.kernels._shell_rub_kernels import give_way
from loadflow.journal.models.composed.kernels._thickening_kernels import thicken
from loadflow.journal.models.composed.kernels._touch_kernels import opened
from loadflow.numerics.lanes import LANES, put, take

PLANES, MEAN, OPEN, CUBE = range(4)  # of `work.gap`
FLOW, DRAG, FLOW_SLOPE, DRAG_SLOPE, FACE_PLANES = range(5)  # of `work.face`
_NONE = 1e290
_FAR = 8.5  # film parameter above which the mean gap is that of the mean planes, to rounding


@inner
def place(film, work, q):
    """Evaluate law, shell and gap at the unknowns and the position `q` (4,)."""
    apply_law(film.ring.law, film.ring.numbers, film.ring.scale, work.u, work.state)
    keep_full(film, work)
    thicken(film, work)
    nx, wide = work.u.shape
    z = film.places.z
    for k in range(z.size):
        work.centre[0, k] = q[0] + q[3] * z[k] + 0.5 * work.bend[0] * z[k] * z[k]
        work.centre[1, k] = q[1] - q[2] * z[k] + 0.5 * work.bend[1] * z[k] * z[k]
    give, gap, face, ring = film.give, work.gap, work.face, film.ring
    planes, faces, p = gap[PLANES], face[FACE_PLANES], work.state[LOAD]
    grows, wider, wider_faces = film.uneven.grows, film.uneven.wider, film.uneven.wider_faces
    for at in range(0, wide, LANES):
        z_at, depth = take(film.lanes.z, at), take(film.lanes.depth, at)
        ex = (z_at * (0.5 * work.bend[0]) + q[3]) * z_at + q[0]
        ey = (z_at * (0.5 * work.bend[1]) - q[2]) * z_at + q[1]
        for i in range(nx):
            here = i * wide + at
            h = depth + ring.base[i] - ex * ring.cos[i] - ey * ring.sin[i]
            after = depth + ring.base_face[i] - ex * ring.cos_face[i] - ey * ring.sin_face[i]
            if give > 0.0:
                right = (i + 1 if i + 1 < nx else 0) * wide + at
                given = take(film.lanes.inner, at) * give
                h = h + (take(p, here) - ring.p_edge) * given
                after = after + (0.5 * (take(p, here) + take(p, right)) - ring.p_edge) * given
            if grows:
                h, after = h + take(wider, here), after + take(wider_faces, here)
            put(planes, here, h)
            put(faces, here, after)
    if give > 0.0:
        give_way(film, work, q, planes, faces)
        _join(film, work)
    if film.rough.size > 0.0:
        _rough_gap(film, work)
    else:
        for here in range(0, nx * wide, LANES):
            h, after = take(planes, here), take(faces, here)
            square, square_after = h * h, after * after
            put(gap[MEAN], here, h)
            put(gap[CUBE], here, square * h)
            put(work.gap_slope, here, 3.0 * square)
            put(face[FLOW], here, square_after * after)
            put(face[FLOW_SLOPE], here, 3.0 * square_after)
            put(face[DRAG], here, after)
    if film.regime.on:
        _turbulent_gap(film, work)
    if film.uneven.on:
        _thickened_gap(film, work)


@inner
def _join(film, work):
    """Where stretches meet, points of no width are in the gap of the inner ones at their place."""
    m, planes = film.nodes.slopes.shape[1], work.gap[PLANES]
    for n in range(film.nodes.joints.size):
        for i in range(planes.shape[0]):
            planes[i, m + n] = planes[i, film.nodes.joints[n]]


@once
def _thickened_gap(film, work):
    """Conductances and drag of a liquid of uneven viscosity, from those of one viscosity."""
    nx, m, even = film.ring.cos.size, film.nodes.slopes.shape[1], film.rough.size == 0.0
    gap, face = work.gap, work.face
    for i in range(nx):
        for k in range(film.nodes.z.size):
            gap[CUBE, i, k] /= film.uneven.cells[i, k]
            work.gap_slope[i, k] /= film.uneven.cells[i, k]
        for k in range(m):
            face[FLOW, i, k] /= film.uneven.faces[i, k]
            face[FLOW_SLOPE, i, k] /= film.uneven.faces[i, k]
            face[DRAG, i, k] *= film.uneven.drags[i, k]
            rise = 1.0 if even else face[DRAG_SLOPE, i, k]
            face[DRAG_SLOPE, i, k] = rise * film.uneven.drags[i, k]


@once
def turn(film, work, speed, lightness):
    """Set the Reynolds numbers at a speed, rad/s; `lightness`: as of `newton`."""
    work.numbers[0] = film.regime.reynolds * abs(speed) * lightness
    work.numbers[1] = film.regime.onset * abs(speed) * lightness


@inner
def _turbulent_gap(film, work):
    """Conductances of turbulent flow, from those of laminar flow."""
    nx, m = film.ring.cos.size, film.nodes.slopes.shape[1]
    gap, face = work.gap, work.face
    numbers = (work.numbers[0], work.numbers[1], film.regime.begin, film.regime.end)
    for i in range(nx):
        for k in range(film.nodes.z.size):
            more, rise = factor(gap[PLANES, i, k], numbers, ACROSS)
            gap[CUBE, i, k] /= more
            work.gap_slope[i, k] = (work.gap_slope[i, k] - gap[CUBE, i, k] * rise) / more
        for k in range(m):
            more, rise = factor(face[FACE_PLANES, i, k], numbers, ALONG)
            face[FLOW, i, k] /= more
            face[FLOW_SLOPE, i, k] = (face[FLOW_SLOPE, i, k] - face[FLOW, i, k] * rise) / more


@inner
def smooth_beyond(rough):
    """Gap above which surfaces count as smooth, clearances; none where flow factors reach far."""
    return _FAR * rough.size if rough.along.shape[0] == 0 else np.inf


@inner
def _rough_gap(film, work):
    """Mean gap and conductances between rough surfaces."""
    nx, m = film.ring.cos.size, film.nodes.slopes.shape[1]
    rough, yielding = film.rough, film.yielding
    gap, face, s = work.gap, work.face, rough.size
    far = smooth_beyond(rough)
    if yielding.on:
        far = max(far, yielding.first + yielding.step * (yielding.table.shape[1] - 1))
    for i in range(nx):
        for k in range(film.nodes.z.size):
            h = gap[PLANES, i, k]
            if h > far:
                gap[MEAN, i, k], gap[OPEN, i, k] = h, 1.0
                gap[CUBE, i, k], work.gap_slope[i, k] = h * h * h, 3.0 * h * h
            else:
                opens = 1.0
                if yielding.on:
                    h, opens = opened(yielding, h)
                mean, share = mean_film(h, s)
                flow, rise = conductance(h, s, mean, share, rough.across)
                gap[MEAN, i, k], gap[OPEN, i, k] = mean, share * opens
                gap[CUBE, i, k], work.gap_slope[i, k] = flow, rise * opens
        for k in range(m):
            h = face[FACE_PLANES, i, k]
            if h > far:
                face[FLOW, i, k], face[FLOW_SLOPE, i, k] = h * h * h, 3.0 * h * h
                face[DRAG, i, k], face[DRAG_SLOPE, i, k] = h, 1.0
            else:
                opens = 1.0
                if yielding.on:
                    h, opens = opened(yielding, h)
                mean, share = mean_film(h, s)
                flow, rise = conductance(h, s, mean, share, rough.along)
                face[FLOW, i, k], face[FLOW_SLOPE, i, k] = flow, rise * opens
                drag, rise = dragged(h, s, mean, share, rough.along, rough.slip)
                face[DRAG, i, k], face[DRAG_SLOPE, i, k] = drag, rise * opens


@inner
def has_gap(film, work):
    """Whether every place keeps a gap, between rough surfaces one in which contact is known."""
    left = narrowest(film, work) + film.rough.deepest
    return NO_GAP < left < _NONE  # where no gap is a number, none is found


@inner
def narrowest(film, work):
    """Narrowest gap of the mean planes at points and faces, after `place`; clearances.

    Around a rigid shell it is that between the points, too.
    """
    least = 1e300
    if film.give == 0.0 and film.uneven.grows:
        return _opened_gap(film, _narrowest_grown(film, work))
    if film.give == 0.0:
        for k in range(film.places.z.size):
            least = min(least, _narrowest_at(film, work, k))
        return least
    nx, m = film.ring.cos.size, film.nodes.slopes.shape[1]
    for i in range(nx):
        if not film.ring.groove[i]:
            for k in range(film.nodes.z.size):
                least = min(least, work.gap[PLANES, i, k])
        for k in range(m):
            least = min(least, work.face[FACE_PLANES, i, k])
    return _opened_gap(film, least)


@inner
def _opened_gap(film, gap):
    return opened(film.yielding, gap)[0]


@inner
def _narrowest_at(film, work, k):
    """Narrowest gap around a rigid bore at one of the `places`, but for growth by heat."""
    x, y = work.centre[0, k], work.centre[1, k]
    gap = least_around(film.ring, x, y) if film.ring.shaped else 1.0 - np.hypot(x, y)
    return film.places.depth[k] + gap


@once
def _narrowest_grown(film, work):
    """Narrowest gap of the mean planes where it has grown: between the cells that of a parabola.

    Between the points, where a relief is narrowest, it is less by what it is without growth.
    """
    nx, points, planes, faces = film.ring.cos.size, film.nodes.z.size, work.gap, work.face
    least, at_points, at_all = 1e300, 1e300, 1e300
    for k in range(points):
        for i in range(nx):
            if film.ring.back[i] == 0.0:
                continue  # a groove between segments
            left = i - 1 if i > 0 else nx - 1
            before, h = faces[FACE_PLANES, left, k], planes[PLANES, i, k]
            after = faces[FACE_PLANES, i, k]
            least = min(least, before, h, after)
            bend, slope = before - 2.0 * h + after, 0.5 * (after - before)
            if abs(slope) < bend:
                least = min(least, h - 0.5 * slope * slope / bend)
    for k in range(film.places.z.size):
        at_all = min(at_all, _narrowest_at(film, work, k))
        if k < points:
            at_points = at_all
    return least + at_all - at_points


@inner
def share_of_step(film, work, dx, dy, tilt_x, tilt_y, kept):
    """Share of a step of the shaft of which every place of a rigid shaped gap keeps `kept` of it.

    Of a place narrower than the roughness, that counts in its stead.
    """
    share, ring = 1.0, film.ring
    for i in range(ring.cos.size):
        if ring.back[i] == 0.0:
            continue  # a groove between segments
        for k in range(film.nodes.z.size):
            z = film.nodes.z[k]
            closes = (dx + tilt_y * z) * ring.cos[i] + (dy - tilt_x * z) * ring.sin[i]
            gap = work.gap[PLANES, i, k]
            left = (1.0 - kept) * max(gap, film.rough.size)
            if film.rough.size > 0.0:
                left = max(min(left, gap + film.rough.deepest), 0.0)
            if closes > 0.0 and share * closes > left:
                share = left / closes
    return share
