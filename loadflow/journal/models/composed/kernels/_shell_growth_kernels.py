"""Compiled growth of the gap of a reduced film by the modes of a shell that gives way all over."""

from __future__ import annotations

from loadflow.journal.cavitation import DLOAD, LOAD
from loadflow.journal.models._compile import inner
from loadflow.journal.models._small_systems import substitute_into
from loadflow.journal.models.composed.kernels._of_effects import of_shell
from loadflow.numerics.lanes import LANES, put, spread, take


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


@inner
def press_by(film, work, force, amplitude):
    """Add to the amplitudes what the `force` of asperities (nx, L), N, makes of the modes."""
    rub, rubbed, row = work.modes.rub, film.modes.rubbed, work.modes.row
    nx, wide = work.u.shape
    for j in range(rubbed.shape[0]):
        total = spread(0.0)
        for i in range(nx):
            if rub.touched[i]:
                for here in range(i * wide, (i + 1) * wide, LANES):
                    pressed = take(rubbed, j * nx * wide + here)
                    total = total + pressed * take(force, here)
        put(row, 0, total)
        for k in range(LANES):
            amplitude[j] += row[k]


@inner
def give_back(film, work, growth, amplitude):
    """Add to the amplitudes what the asperities make of a `growth` of the gap (nx, L)."""
    rub = work.modes.rub
    nx, points = rub.touched.size, film.nodes.z.size
    for i in range(nx):
        if rub.touched[i]:
            left, right = i - 1 if i > 0 else nx - 1, i + 1 if i + 1 < nx else 0
            for k in range(points):
                total = 0.0
                for n in range(points):
                    total += rub.own[i, k, n] * growth[i, n]
                    total += rub.next[i, k, n] * growth[right, n]
                    total += rub.next[left, k, n] * growth[left, n]
                rub.change[i, k] = total
    press_by(film, work, rub.change, amplitude)


@inner
def respond(film, work, amplitude):
    """Amplitudes by a change of the film's pressure, `work.modes.change`, Pa, after `give_way`.

    Asperities give back what it opens between them.
    """
    press(film, work, amplitude)
    rub = work.modes.rub
    if rub.on[0] > 0.0:
        for i in range(rub.touched.size):
            for k in range(film.nodes.slopes.shape[1]):
                rub.local[i, k] = film.give * work.modes.change[i, k]
        give_back(film, work, rub.local, amplitude)
        substitute_into(rub.matrix, rub.order, amplitude)


@of_shell(lambda film, work, column: None)
def _open_all_over(film, work, column):
    """Growth of the gap by the modes, into `work.modes.change`, by a column of unknowns."""
    modes = work.modes
    load_of(work, work.columns, column * work.u.size)
    respond(film, work, modes.other)
    if modes.rub.on[0] > 0.0:  # the shell follows the shaft, too
        for j in range(modes.other.size):
            modes.other[j] -= modes.rub.by_place[column - 1, j]
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


@of_shell(lambda film, work: 0.0)
def largest_growth(film, work):
    """Largest growth of the gap at the points of a shell that gives way by modes, clearances."""
    largest, p = 0.0, work.state[LOAD]
    for i in range(work.u.shape[0]):
        for k in range(film.nodes.slopes.shape[1]):
            local = film.give * (p[i, k] - film.ring.p_edge)
            largest = max(largest, local + work.modes.growth[i, k])
    return largest
