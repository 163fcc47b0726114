"""Compiled: stops at the ends of a bearing, where smooth surfaces touch.

A stop begins at a given gap and grows with the square of what is missing of it. It acts where each
arc of the bore is nearest to the shaft, or at the edge of the arc.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.models._compile import once
from loadflow.journal.models._small_systems import fill_upper
from loadflow.journal.models._touch_kernels import push


@once
def stop(side):
    """Add what holds the shaft where it touches a bearing end to `touch` of smooth surfaces."""
    film, work, gap = side.film, side.work, side.stop[0]
    load, stiffness = work.touch[0], work.touch[1:]
    points = film.nodes.z.size
    for end in range(points - film.nodes.ends.size, points):
        z = film.nodes.z[end]
        for k in range(side.arcs.shape[0]):
            wide, x, y, middle, half = side.arcs[k]
            ex, ey = work.centre[0, end] + x, work.centre[1, end] + y
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
    fill_upper(stiffness)
