"""Compiled growth of the gap of a reduced film by the modes of a shell that gives way all over."""

from __future__ import annotations

from loadflow.journal.cavitation import DLOAD, LOAD
from loadflow.journal.models._compile import inner
from loadflow.journal.models._of_effects import beside
from loadflow.numerics.lanes import LANES, put, spread, take


@beside(lambda film, work, planes, faces: None)
def give_way(film, work, planes, faces):
    """Add to the gaps of points and faces what the pressure makes of the modes, after the law.

    A face grows by the mean of both columns beside it, as in a shell that gives way locally.
    """
    modes = work.modes
    if not film.modes.on:
        return
    nx, wide = work.u.shape
    for here in range(0, work.u.size, LANES):
        put(modes.change, here, take(work.state[LOAD], here) - film.ring.p_edge)
    press(film, work, modes.amplitude)
    open_by(film, modes.amplitude, modes.growth)
    for i in range(nx):
        for at in range(0, wide, LANES):
            here, right = i * wide + at, (i + 1 if i + 1 < nx else 0) * wide + at
            own = take(modes.growth, here)
            put(planes, here, take(planes, here) + own)
            both = (own + take(modes.growth, right)) * 0.5
            put(faces, here, take(faces, here) + both)


@inner
def press(film, work, amplitude):
    """Amplitudes of the modes under the pressure `work.modes.change` (nx, L), Pa."""
    pressed, change, row = film.modes.pressed, work.modes.change, work.modes.row
    size = change.size
    for j in range(pressed.shape[0]):
        total = spread(0.0)
        for here in range(0, size, LANES):
            total = total + take(pressed, j * size + here) * take(change, here)
        put(row, 0, total)
        amplitude[j] = 0.0
        for k in range(LANES):
            amplitude[j] += row[k]


@inner
def open_by(film, amplitude, growth):
    """Growth of the gap (nx, L), clearances, by amplitudes of the modes."""
    shapes, size = film.modes.shapes, growth.size
    for here in range(0, size, LANES):
        total = spread(0.0)
        for j in range(shapes.shape[0]):
            total = total + take(shapes, j * size + here) * amplitude[j]
        put(growth, here, total)


@inner
def load_of(work, columns, begin):
    """Change of the pressure by a column of unknowns, into `work.modes.change`."""
    for here in range(0, work.u.size, LANES):
        put(work.modes.change, here, take(columns, begin + here) * take(work.state[DLOAD], here))


@beside(lambda film, work, column: None)
def _open_all_over(film, work, column):
    """Growth of the gap by the modes, into `work.modes.change`, by a column of unknowns."""
    modes = work.modes
    if film.modes.on:
        load_of(work, work.columns, column * work.u.size)
        press(film, work, modes.other)
        open_by(film, modes.other, modes.change)


@inner
def follow_by(film, work, size):
    """Make of `size` columns of unknowns, behind the residual, the growth of the gap by each."""
    block = work.u.size
    for column in range(1, 1 + size):
        _open_all_over(film, work, column)
        for here in range(column * block, (1 + column) * block, LANES):
            own = take(work.columns, here) * take(work.state[DLOAD], here - column * block)
            more = take(work.modes.change, here - column * block)
            put(work.columns, here, own * film.give + more)


@beside(lambda film, work: 0.0)
def largest_growth(film, work):
    """Largest growth of the gap at the points of a shell that gives way by modes, clearances."""
    largest, p = 0.0, work.state[LOAD]
    for i in range(work.u.shape[0] if film.modes.on else 0):
        for k in range(film.nodes.slopes.shape[1]):
            local = film.give * (p[i, k] - film.ring.p_edge)
            largest = max(largest, local + work.modes.growth[i, k])
    return largest
