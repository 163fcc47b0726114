"""Compiled: what the loop of a shaft in two films asks of each, on pads that tilt or not.

Each takes the side of a film first. A pad follows the shaft without moment in each Newton step, so
that the unknowns of the shaft stay those that it has in other bores.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from loadflow.journal.models._compile import inner
from loadflow.journal.models.composed.kernels._balance_kernels import carry
from loadflow.journal.models.composed.kernels._gap_kernels import place, share_of_step
from loadflow.journal.models.composed.kernels._integral_kernels import summarise
from loadflow.journal.models.composed.kernels._loops import KEPT, correct, share_inside
from loadflow.journal.models.composed.kernels._of_effects import where
from loadflow.journal.models.composed.kernels._pad_kernels import (
    BEFORE,
    LAST,
    NEXT,
    STEP,
    place_on_pads,
    set_out,
    spare_state,
)
from loadflow.journal.models.composed.kernels._pad_loops import (
    come_and_go,
    summarise_on_pads,
    try_other_pads,
)
from loadflow.journal.models.composed.kernels._pad_step_kernels import (
    KEPT_ON_PADS,
    carry_on_pads,
    condense,
    moments_of_pads,
    move_on_pads,
    share_on_pads,
    turn_pads,
)
from loadflow.journal.models.composed.kernels._step_kernels import leaves_room
from loadflow.journal.models.composed.kernels._stop_kernels import stop, stop_on_pads
from loadflow.journal.models.composed.shared_sides import PaddedSide

_SIZE = 4  # coordinates of a shaft that tilts
_NEAR = 0.5  # share of the widest gap that holds a pad, up to which it keeps its film


def on_pads(nothing: Callable[..., Any]) -> Callable[[Callable[..., Any]], Any]:
    """Of a function of a `PaddedSide`; `nothing` is it in all others."""
    return where(lambda kind: kind is PaddedSide, nothing)


@inner
def _share_in_bore(film, work):
    """Share of the step of the shaft that leaves a rigid bore part of its gap."""
    step = work.step
    if film.give == 0.0 and film.ring.shaped:
        return share_of_step(film, work, step[0], step[1], step[2], step[3], KEPT)
    return share_inside(film, work, step) if film.give == 0.0 else 1.0


@on_pads(lambda side: place(side.film, side.work, side.new))
def place_side(side):
    """Evaluate the film at the next place of the shaft, and of its pads."""
    if side.pad_work.on.size > 0:
        place_on_pads(side.film, side.work, side.pads, side.pad_work, side.new, NEXT)
    else:
        place(side.film, side.work, side.new)


@on_pads(lambda side: stop(side))
def stop_side(side):
    """Add what holds the shaft where it touches a bearing end."""
    if side.pad_work.on.size > 0:
        stop_on_pads(side)
    else:
        stop(side)


@on_pads(lambda side: 0.0)
def moments_of_side(side):
    """Sum of the squared moments of the pads, N²."""
    if side.pad_work.on.size > 0:
        return moments_of_pads(side.film, side.work, side.pads, side.pad_work)
    return 0.0


@on_pads(lambda side: carry(side.film, side.work, _SIZE))
def carry_side(side):
    """Load that each column carries, as the pads follow the shaft."""
    if side.pad_work.on.size > 0:
        carry_on_pads(side.film, side.work, side.pads, side.pad_work, _SIZE)
        condense(side.work, side.pads, side.pad_work, _SIZE)
    else:
        carry(side.film, side.work, _SIZE)


@on_pads(lambda side, share: _share_in_bore(side.film, side.work))
def share_of_side(side, share):
    """Share of the step of the shaft that leaves part of the gap; pads take theirs, too.

    The step is already a `share` of that of Newton.
    """
    if side.pad_work.on.size > 0:
        pads, pad_work, step = side.pads, side.pad_work, side.work.step
        turn_pads(pads, pad_work, side.new, step, share, _SIZE)
        return share_on_pads(side.film, side.work, pads, pad_work, step, KEPT_ON_PADS)
    return _share_in_bore(side.film, side.work)


@on_pads(lambda side, share: None)
def shorten_side(side, share):
    """Shorten the step of the pads."""
    for j in range(side.pad_work.on.size):
        side.pad_work.tilts[STEP, j] *= share


@on_pads(lambda side, share, done: correct(side.film, side.work, side.work.step, _SIZE, share))
def correct_side(side, share, done):
    """Unknowns after a `share` of a Newton step from `work.trial`, of which some is `done`."""
    work = side.work
    if side.pad_work.on.size > 0:
        move_on_pads(side.film, work, side.pads, side.pad_work, work.step, share - done)
    else:
        correct(side.film, work, work.step, _SIZE, share)


@on_pads(
    lambda side, ratio: (
        side.film.give > 0.0 or leaves_room(side.film, side.work, side.place, side.new)
    )
)
def has_room(side, ratio):
    """Whether a gap keeps half of itself where shaft and pads go on as they came."""
    film, work, tilts = side.film, side.work, side.pad_work.tilts
    if tilts.shape[1] == 0:
        return film.give > 0.0 or leaves_room(film, work, side.place, side.new)
    for a in range(4):
        work.step[a] = side.new[a] - side.place[a]
    for j in range(tilts.shape[1]):
        tilts[STEP, j] = ratio * (tilts[LAST, j] - tilts[BEFORE, j])
    return share_on_pads(film, work, side.pads, side.pad_work, work.step, 0.5) == 1.0


@on_pads(lambda side, ratio, ahead: None)
def begin_tilts(side, ratio, ahead):
    """Tilts from which a step is sought."""
    tilts = side.pad_work.tilts
    for j in range(tilts.shape[1]):
        tilts[NEXT, j] = tilts[LAST, j]
        if ahead:
            tilts[NEXT, j] += ratio * (tilts[LAST, j] - tilts[BEFORE, j])


@on_pads(lambda side: None)
def keep_tilts(side):
    """Make the tilts that are found those of the last time."""
    tilts = side.pad_work.tilts
    for j in range(tilts.shape[1]):
        tilts[BEFORE, j], tilts[LAST, j] = tilts[LAST, j], tilts[NEXT, j]


@on_pads(lambda side, begun: None)
def set_out_side(side, begun):
    """Make film and pads those of the last time, `begun`: after one before it."""
    work = side.work
    if side.pad_work.on.size > 0:
        for a in range(4):
            work.places[0, a], work.past[a] = side.past[a], side.past[4 + a]
        set_out(side.film, work, side.pads, side.pad_work, side.place, begun)
        work.kept[0] = 0.0


@on_pads(lambda side, speed, begun: None)
def give_and_take(side, speed, begun):
    """Give films to pads that one holds at rest, and take those of others."""
    work, pads, pad_work = side.work, side.pads, side.pad_work
    if pad_work.on.size > 0 and come_and_go(work, pads, pad_work, side.place, speed):
        set_out_side(side, begun)


@on_pads(lambda side, speed, begun: False)
def try_others(side, speed, begun):
    """Whether a step that has failed may be tried on other pads, which then have a film."""
    if side.pad_work.on.size == 0:
        return False
    work, pads, pad_work = side.work, side.pads, side.pad_work
    changed = try_other_pads(work, pads, pad_work, side.place, side.new, speed, _NEAR)
    set_out_side(side, begun)
    return changed


@on_pads(lambda side, tried, begun: None)
def take_back(side, tried, begun):
    """Make film and pads those before a step that has failed, `tried`: on others than these."""
    if side.pad_work.on.size > 0:
        if tried:
            spare_state(side.work, side.pad_work, False)
        set_out_side(side, begun)


@on_pads(
    lambda side, wedge, rate, n: summarise(
        side.film, side.work, side.place, wedge, rate, side.rows[n]
    )
)
def summarise_side(side, wedge, rate, n):
    """Integrals over the film, and tilts of the pads, into their rows of a time."""
    film, work, pad_work = side.film, side.work, side.pad_work
    if pad_work.on.size > 0:
        summarise_on_pads(film, work, side.pads, pad_work, side.place, wedge, rate, side.rows[n])
        for j in range(pad_work.on.size):
            side.tilts[n, j] = pad_work.tilts[LAST, j]
    else:
        summarise(film, work, side.place, wedge, rate, side.rows[n])
