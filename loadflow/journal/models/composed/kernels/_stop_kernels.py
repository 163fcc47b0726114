"""Compiled: stops at the ends of a bearing, where smooth surfaces touch.

A stop begins at a given gap and grows with the square of what is missing of it. It acts where each
arc of the bore is nearest to the shaft, or at the edge of the arc. Pads tilt under it.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.models._compile import inner
from loadflow.journal.models._small_systems import fill_upper
from loadflow.journal.models.composed.kernels._pad_kernels import NEXT
from loadflow.journal.models.composed.kernels._touch_kernels import push


@inner
def stop(side):
    """Add what holds the shaft where it touches a bearing end to `touch` of smooth surfaces."""
    load, stiffness = side.work.touch[0], side.work.touch[1:]
    for k in range(side.arcs.shape[0]):
        _push_back(side, k, 0.0, 0.0, load, stiffness)
    fill_upper(stiffness)


@inner
def stop_on_pads(side):
    """The same on pads that tilt: what each takes into its own `touch`, its load into the other."""
    pads, pad_work, load = side.pads, side.pad_work, side.work.touch[0]
    for j in range(pad_work.on.size):
        own = pad_work.touch[j]
        own[:] = 0.0
        tilt = pad_work.tilts[NEXT, j]
        _push_back(side, j, tilt * pads.along[j, 0], tilt * pads.along[j, 1], own[0], own[1:])
        fill_upper(own[1:])
        for a in range(4):
            load[a] += own[0, a]


@inner
def _push_back(side, k, dx, dy, load, stiffness):
    """Add what an arc holds of a shaft that it sees farther off by (dx, dy)."""
    film, work, gap = side.film, side.work, side.stop[0]
    wide, x, y, middle, half = side.arcs[k]
    points = film.nodes.z.size
    for end in range(points - film.nodes.ends.size, points):
        z = film.nodes.z[end]
        ex, ey = work.centre[0, end] + x + dx, work.centre[1, end] + y + dy
        toward = np.arctan2(ey, ex)
        beside = (toward - middle + np.pi) % (2.0 * np.pi) - np.pi
        beyond = abs(beside) > half  # nearest to an edge of the arc
        if beyond:
            toward = middle + np.copysign(half, beside)
        c, s = np.cos(toward), np.sin(toward)
        reach = ex * c + ey * s
        overlap = gap - (wide + film.places.depth[end] - reach)
        if not overlap > 0.0:
            continue
        force = side.stop[1] * (overlap / gap) ** 2
        along = 2.0 * side.stop[1] * overlap / (gap * gap)
        push(load, stiffness, z, c, s, force, along, 0.0 if beyond else force / reach)
