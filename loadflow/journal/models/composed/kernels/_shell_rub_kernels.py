"""Compiled: how far a shell gives way all over, pressed by a film and by asperities between both.

For a pressure of the film and a place of the shaft the amplitudes a of the modes are those of all
that presses the shell, ``a = P p + R F(a)`` with the forces F of the asperities, found by Newton's
method. To the film it is then a shell that gives way by less, ``(1 - R ∂F/∂a)⁻¹``, and that follows
the shaft where they touch.
"""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import LOAD
from loadflow.journal.models._compile import inner
from loadflow.journal.models._small_systems import eliminate, substitute_into
from loadflow.journal.models.composed.kernels._of_effects import of_shell
from loadflow.journal.models.composed.kernels._shell_growth_kernels import (
    give_back,
    open_by,
    press,
    press_by,
)
from loadflow.journal.models.composed.kernels._touch_kernels import touch_places
from loadflow.numerics.lanes import LANES, put, take

_STEPS, _HALVINGS = 30, 8
_LARGEST = 300.0  # growth by the film alone, clearances: an iteration that has lost its way
_EXACT = 1e-12  # of the amplitudes, what is left of the balance of a shell
_ENOUGH = 1e-9  # the same, beyond which none fit


@of_shell(lambda film, work, q, planes, faces: None)
def give_way(film, work, q, planes, faces):
    """Add to the gaps of points and faces what the pressure makes of the modes, after the law.

    A face grows by the mean of both columns beside it, as in a shell that gives way locally.
    """
    modes = work.modes
    nx, wide = work.u.shape
    for here in range(0, work.u.size, LANES):
        put(modes.change, here, take(work.state[LOAD], here) - film.ring.p_edge)
    press(film, work, modes.amplitude)
    if film.yielding.on:
        _rub(film, work, q)
    open_by(film, modes.amplitude, modes.growth)
    for i in range(nx):
        for at in range(0, wide, LANES):
            here, right = i * wide + at, (i + 1 if i + 1 < nx else 0) * wide + at
            own = take(modes.growth, here)
            put(planes, here, take(planes, here) + own)
            both = (own + take(modes.growth, right)) * 0.5
            put(faces, here, take(faces, here) + both)


@inner
def _rub(film, work, q):
    """Make of the amplitudes by the film alone those by film and asperities; NaN if none fit."""
    amplitude, rub = work.modes.amplitude, work.modes.rub
    size = amplitude.size
    lost, growth = False, work.modes.growth
    open_by(film, amplitude, growth)
    for i in range(growth.shape[0]):
        for k in range(growth.shape[1]):
            lost = lost or not abs(growth[i, k]) <= _LARGEST
    if lost:  # the film goes on as if nothing touched, to come back or to end
        rub.on[0] = 0.0
        rub.share[:] = 0.0
        return
    for j in range(size):
        rub.alone[j] = amplitude[j]
        amplitude[j] += rub.share[j]
    left, largest = _missing(film, work, q)
    for _ in range(_STEPS):
        if not left > _EXACT * largest or not _linearise(film, work):
            break
        substitute_into(rub.matrix, rub.order, rub.step)
        for j in range(size):
            rub.trial[j] = amplitude[j]
            rub.way[j] = rub.step[j]
        share, nearer = 1.0, False
        for _ in range(_HALVINGS):
            for j in range(size):
                amplitude[j] = rub.trial[j] + share * rub.way[j]
            now, largest = _missing(film, work, q)
            nearer = now < left
            if nearer:
                break
            share *= 0.5
        if not nearer:  # than rounding lets it come
            for j in range(size):
                amplitude[j] = rub.trial[j]
            _missing(film, work, q)
            break
        left = now
    fits = left <= _ENOUGH * largest
    touches = False
    for i in range(rub.touched.size):
        touches = touches or rub.touched[i]
    rub.on[0] = 1.0 if fits and touches and _linearise(film, work) else 0.0
    for j in range(size):
        rub.share[j] = amplitude[j] - rub.alone[j] if fits else 0.0
        if not fits:
            amplitude[j] = np.nan
    if rub.on[0] > 0.0:
        for a in range(4):
            for j in range(size):
                rub.by_place[a, j] = 0.0
            press_by(film, work, rub.pushed[a], rub.by_place[a])
            for j in range(size):
                rub.by_place[a, j] *= -1.0
            substitute_into(rub.matrix, rub.order, rub.by_place[a])


@inner
def _missing(film, work, q):
    """Largest of what the amplitudes miss, which is put into `step`, and largest of them."""
    amplitude, rub = work.modes.amplitude, work.modes.rub
    open_by(film, amplitude, work.modes.growth)
    work.normal[0] = touch_places(film, work, q)
    for j in range(amplitude.size):
        rub.step[j] = rub.alone[j] - amplitude[j]
    press_by(film, work, rub.force, rub.step)
    left, largest = 0.0, 0.0
    for j in range(amplitude.size):
        if not abs(rub.step[j]) <= left:
            left = abs(rub.step[j])
        largest = max(largest, abs(amplitude[j]))
    return left, largest


@inner
def _linearise(film, work):
    """Factors of what amplitudes miss by themselves, where asperities touch; False if singular."""
    rub, shapes = work.modes.rub, film.modes.shapes
    size = rub.step.size
    for j in range(size):
        for n in range(size):
            rub.other[n] = 0.0
        give_back(film, work, shapes[j], rub.other)
        for n in range(size):
            rub.matrix[n, j] = -rub.other[n]
        rub.matrix[j, j] += 1.0
    return eliminate(rub.matrix, rub.order)
