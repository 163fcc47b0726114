"""Compiled: the gap over pads that tilt, and what a path holds of pads that come and go."""

from __future__ import annotations

import numpy as np

from loadflow.journal.models._compile import inner
from loadflow.journal.models.composed.kernels._gap_kernels import place
from loadflow.journal.models.composed.kernels._loops import keep
from loadflow.journal.solvers.motion.moving_pads import TILT

# of `PadWork.tilts`; a function is compiled for each of Python's integers that it is called with
BEFORE, LAST, NEXT, STEP = np.arange(4)


@inner
def place_on_pads(film, work, pads, pad_work, q, which):
    """Evaluate the film at the position `q` (4,) and the tilts of the time `which`."""
    ring, tilts = film.ring, pad_work.tilts
    for i in range(ring.cos.size):
        j = pads.cell[i]
        if j >= 0:
            along = pads.along[j, 0] * ring.cos[i] + pads.along[j, 1] * ring.sin[i]
            ring.base[i] = pads.base[i] - tilts[which, j] * along
        j = pads.face[i]
        along = pads.along[j, 0] * ring.cos_face[i] + pads.along[j, 1] * ring.sin_face[i]
        ring.base_face[i] = pads.base_face[i] - tilts[which, j] * along
        ring.lobe[1, i] = pads.lobe[0, i] + tilts[which, j] * pads.along[j, 0]
        ring.lobe[2, i] = pads.lobe[1, i] + tilts[which, j] * pads.along[j, 1]
    place(film, work, q)


@inner
def hold_pads(film, pads, pad_work):
    """Make the columns of pads without a film grooves: their pressure stays that of the ends."""
    for i in range(pads.cell.size):
        j = pads.cell[i]
        film.ring.groove[i] = j < 0 or not pad_work.on[j]


@inner
def lift_of(pads, tilts, which, j, x, y):
    """Tilt of a pad against the shaft at (x, y)."""
    return tilts[which, j] + x * pads.along[j, 0] + y * pads.along[j, 1]


@inner
def tilt_at_rest(pads, sense, gap):
    """Tilt of a pad at a gap over its pivot; 0 where no film holds it."""
    if gap > pads.widest[sense]:
        return 0.0
    last = pads.tilts.shape[1] - 1
    at_place = (np.log(max(gap, 1e-12)) - pads.first[sense]) / pads.step[sense]
    at_place = min(max(at_place, 0.0), float(last))
    i = min(int(at_place), last - 1)
    t = at_place - i
    return (1.0 - t) * pads.tilts[sense, i] + t * pads.tilts[sense, i + 1]


@inner
def put_on(work, pads, pad_work, q, speed, j, has_film):
    """Give a pad a film, or take it: at both past times it is as `moving_pads.with_pads` says."""
    if pad_work.on[j] == has_film:
        return
    pad_work.on[j], tilts = has_film, pad_work.tilts
    sense = 1 if speed < 0.0 else 0
    if has_film:
        gap = 1.0 - q[0] * pads.toward[j, 0] - q[1] * pads.toward[j, 1]
        lift = max(tilt_at_rest(pads, sense, gap), TILT)
        lift = -lift if sense == 1 else lift
        tilts[LAST, j] = lift - q[0] * pads.along[j, 0] - q[1] * pads.along[j, 1]
        tilts[BEFORE, j] = tilts[LAST, j]
    else:
        tilts[BEFORE, j], tilts[LAST, j] = 0.0, 0.0
    for i in range(pads.cell.size):
        if pads.cell[i] == j:
            for k in range(work.u.shape[1]):
                work.last[i, k], work.before[i, k] = pads.edge, pads.edge


@inner
def set_out(film, work, pads, pad_work, q, begun):
    """Fill what both past times hold by their unknowns, as `_loops._set_out`.

    `work.last` and `work.before` are these; with `begun` False there is one past time alone.
    """
    hold_pads(film, pads, pad_work)
    for way in range(2 if begun else 1):
        early = begun and way == 0
        for i in range(work.u.shape[0]):
            for k in range(work.u.shape[1]):
                if early:
                    work.trial[i, k], work.u[i, k] = work.last[i, k], work.before[i, k]
                else:
                    work.u[i, k] = work.trial[i, k] if begun else work.last[i, k]
        work.bend[0], work.bend[1] = work.past[0 if early else 2], work.past[1 if early else 3]
        if early:
            place_on_pads(film, work, pads, pad_work, work.places[0], BEFORE)
        else:
            place_on_pads(film, work, pads, pad_work, q, LAST)
        keep(work)


@inner
def spare_state(work, pad_work, away):
    """Put films and tilts of both past times away, or take them back."""
    spare, tilts, kept = pad_work.spare, pad_work.tilts, pad_work.spare_tilts
    for i in range(work.u.shape[0]):
        for k in range(work.u.shape[1]):
            if away:
                spare[0, i, k], spare[1, i, k] = work.before[i, k], work.last[i, k]
            else:
                work.before[i, k], work.last[i, k] = spare[0, i, k], spare[1, i, k]
    for j in range(pad_work.on.size):
        if away:
            pad_work.spare_on[j] = pad_work.on[j]
        else:
            pad_work.on[j] = pad_work.spare_on[j]
        for row in range(BEFORE, NEXT):
            if away:
                kept[row, j] = tilts[row, j]
            else:
                tilts[row, j] = kept[row, j]
