"""Compiled: where a step of a reduced film with effects leads, and how long the next one may be."""

from __future__ import annotations

import numpy as np

from loadflow.journal.models._compile import once
from loadflow.journal.models._reduced_loops import foreseen, growth
from loadflow.journal.models.composed.kernels._gap_kernels import narrowest, share_of_step


@once
def leaves_room(film, work, q, ahead):
    """Whether every place of a rigid gap keeps half of itself, or of the roughness, `ahead`."""
    if film.ring.shaped:
        way = ahead[0] - q[0], ahead[1] - q[1], ahead[2] - q[2], ahead[3] - q[3]
        return share_of_step(film, work, *way, 0.5) == 1.0
    for k in range(film.places.z.size):
        z, wide = film.places.z[k], 1.0 + film.places.depth[k]
        bx, by = 0.5 * work.bend[0] * z * z, 0.5 * work.bend[1] * z * z
        gap = wide - np.hypot(q[0] + q[3] * z + bx, q[1] - q[2] * z + by)
        next_gap = wide - np.hypot(ahead[0] + ahead[3] * z + bx, ahead[1] - ahead[2] * z + by)
        if next_gap < gap - 0.5 * max(gap, film.rough.size):
            return False
    return True


@once
def lay_at(work, line, n, to, q, given):
    """Bend of the shaft, and its tilt in `q` if that is `given`, between the times n − 1 and n."""
    before = max(n - 1, 0)
    for a in range(2):
        work.bend[a] = line[before, 2 + a] + to * (line[n, 2 + a] - line[before, 2 + a])
        if given:
            q[2 + a] = line[before, a] + to * (line[n, a] - line[before, a])


@once
def longer_step(film, work, q, size, step, step_before, step_earlier, accuracy):
    """How much longer the next step may be than one to the film and place that are there."""
    last, second, third = foreseen(step, step_before, step_earlier)
    left = 0.0
    for a in range(size):
        way = work.places[1, a] - last * q[a]
        left += (way - second * work.places[0, a] - third * work.places[3, a]) ** 2
    narrow = max(narrowest(film, work), film.rough.size)
    return growth(np.sqrt(left), narrow, step, step_before, step_earlier, accuracy)
