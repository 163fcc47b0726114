"""Compiled: points of the reduced film with effects that grooves of a supply hold."""

from __future__ import annotations

import numpy as np

from loadflow.journal.cavitation import DFILL, DP, FILL
from loadflow.journal.film.feed import mismatch_of
from loadflow.journal.models._compile import inner, within
from loadflow.journal.models._small_systems import solve_system
from loadflow.journal.models.composed.kernels._gap_kernels import CUBE, DRAG, FLOW, MEAN, OPEN
from loadflow.journal.models.composed.kernels._thickening_kernels import pressure_at, thickness_at
from loadflow.journal.supply import at_pump

_mismatch, _at_pump = within(mismatch_of), inner(at_pump)

# numbers of NumPy: of one that is written out, numba compiles a kind of its own
FIRST, SECOND = np.arange(2)  # columns
FRESH = np.True_


@inner
def hold_points(film, work, first, last, rate):
    """Leave the pressure of a supply as it is in the columns `first` … `last`; the largest.

    What its points are missing is what their grooves feed, but for what is stored in them.
    """
    nx, m, largest = film.ring.cos.size, film.nodes.slopes.shape[1], 0.0
    fill, mean, columns = work.state[FILL], work.gap[MEAN], work.columns
    opens, squeeze = work.gap[OPEN], work.squeeze
    slots, border = film.feeding.slots, work.border
    if first == 0:
        work.fed[:], border.fed[:] = 0.0, 0.0
    else:
        border.direct[:] = 0.0
    for column in range(first, last):
        for i in range(nx):
            width = film.ring.slope * film.ring.width[i]
            for k in range(m):
                j = film.held.grooves[i, k]
                if j >= 0:
                    flow, slot = columns[column, i, k], slots[j]
                    if column == 0:
                        stored = rate * mean[i, k] + opens[i, k] * squeeze[i, k]
                        stored = stored * fill[i, k] - work.liquid[0, i, k]
                        stored *= width * film.nodes.weights[k]
                        work.fed[j] += flow - stored
                    if slot >= 0 and column == 0:
                        border.fed[slot] += flow
                    elif slot >= 0:
                        border.direct[column, slot] += flow
                    columns[column, i, k] = 0.0
                largest = max(largest, abs(columns[column, i, k]))
    return largest


@inner
def hold_in_matrix(film, system):
    """The same in the derivatives of the residual."""
    m = film.nodes.slopes.shape[1]
    for i in range(film.ring.cos.size):
        for k in range(m):
            if film.held.grooves[i, k] >= 0:
                system.left[i, k], system.right[i, k] = 0.0, 0.0
                for c in range(m):
                    system.block[i, c, k] = 0.0
                system.block[i, k, k] = 1.0


@inner
def answers_of_grooves(film, work, count):
    """Lay unit changes of unknown pressures behind `count` columns; how many there are then."""
    slots = film.feeding.slots
    if film.feeding.table.given.size == 0:
        return count
    for slot in range(film.feeding.table.given.size):
        work.columns[count + slot] = 0.0
    for n in range(film.feeding.points.shape[0]):
        i, k = film.feeding.points[n, 0], film.feeding.points[n, 1]
        work.columns[count + slots[film.held.grooves[i, k]], i, k] = 1.0
    return count + film.feeding.table.given.size


@inner
def unfed(film, work):
    """Largest mismatch of a groove and what feeds it, after `balance`, over the scale."""
    border, feeding, largest = work.border, film.feeding, 0.0
    if feeding.table.given.size > 0:
        for slot in range(border.flow.size):
            border.flow[slot] = border.fed[slot]
        _join(film, work)
        for slot in range(feeding.table.given.size):
            missing = abs(border.missing[slot]) / film.ring.scale
            largest = max(largest, missing) if missing < 1e300 else 1e300
    return largest


@inner
def _join(film, work):
    """Mismatch of the grooves at their flow `border.flow`, in units of the film."""
    border, feeding = work.border, film.feeding
    for j in range(feeding.slots.size):
        slot = feeding.slots[j]
        if slot >= 0:
            border.flow[slot] *= feeding.unit
            i, k = feeding.samples[j, 0], feeding.samples[j, 1]
            border.pressure[slot] = pressure_at(film, work, i, k)
    _mismatch(
        feeding.table, _at_pump, border.pressure, border.flow, film.ring.scale,
        border.missing, border.by_pressure, border.by_flow,
    )  # fmt: skip
    for a in range(border.missing.size):
        for b in range(border.missing.size):
            border.by_flow[a, b] *= feeding.unit


@inner
def _flows_by(film, work, wedge, rate, column):
    """Change of the flow of grooves by that of the unknowns in a column, into `border.change`."""
    border, ring, nodes, given = work.border, film.ring, film.nodes, work.columns[column]
    nx, m, flow = ring.cos.size, nodes.slopes.shape[1], work.row[0]
    dp, df, faces = work.state[DP], work.state[DFILL], work.face
    up, up_right = max(wedge, 0.0), min(wedge, 0.0)
    border.change[:] = 0.0
    last = -1
    for n in range(film.feeding.points.shape[0]):
        i, k = film.feeding.points[n, 0], film.feeding.points[n, 1]
        slot = film.feeding.slots[film.held.grooves[i, k]]
        if i != last:
            last = i
            for q in range(nodes.z.size):
                slope = 0.0
                for j in range(m):
                    slope += nodes.slopes[q, j] * dp[i, j] * given[i, j]
                across = 0.0 if ring.groove[i] else ring.width[i] * nodes.weights[q]
                flow[q] = slope * work.gap[CUBE, i, q] * across
        stored = work.gap[MEAN, i, k] * rate + work.gap[OPEN, i, k] * work.squeeze[i, k]
        change = stored * df[i, k] * given[i, k] * ring.slope * ring.width[i] * nodes.weights[k]
        for q in range(nodes.z.size):
            change += nodes.slopes[q, k] * flow[q]
        for way in range(2):  # the face before the cell, and the one behind it
            here = i if way else (i - 1 if i > 0 else nx - 1)
            right = here + 1 if here + 1 < nx else 0
            rise = dp[right, k] * given[right, k] - dp[here, k] * given[here, k]
            drag = df[here, k] * given[here, k] * up + df[right, k] * given[right, k] * up_right
            after = drag * faces[DRAG, here, k] - faces[FLOW, here, k] * rise / ring.apart[here]
            after *= nodes.weights[k]
            change += after if way else -after
        border.change[slot] += change


@inner
def follow_grooves(film, work, wedge, rate, size, fresh):
    """Let the pressures of grooves follow their flow in the columns, after `substitute`.

    Behind the first 1 + `size` are the answers to unit changes of each, after a `fresh` matrix; all
    of these are taken then, else the step alone. Restrictors are linearised at the flow that the
    step of the film leaves.
    """
    count, border, feeding = film.feeding.table.given.size, work.border, film.feeding
    if count == 0:
        return
    nx, m = film.ring.cos.size, film.nodes.slopes.shape[1]
    if fresh:
        for slot in range(count):
            _flows_by(film, work, wedge, rate, 1 + size + slot)
            for other in range(count):
                border.through[slot, other] = border.change[other]
    for column in range(1 + size if fresh else 1):
        _flows_by(film, work, wedge, rate, column)
        if column == 0:
            for slot in range(count):
                border.flow[slot] = border.fed[slot] - border.change[slot]
            _join(film, work)
        for a in range(count):
            at = feeding.first[a]
            slope = border.by_pressure[a] * work.state[DP, at // m, at % m]
            slope *= thickness_at(film, work, at // m, at % m)
            border.system[a, count] = border.missing[a] if column == 0 else 0.0
            for b in range(count):
                border.system[a, b] = slope if a == b else 0.0
                for c in range(count):
                    border.system[a, b] += border.by_flow[a, c] * border.through[b, c]
                if column > 0:
                    flow = border.direct[column, b] - border.change[b]
                    border.system[a, count] += border.by_flow[a, b] * flow
        if not solve_system(border.system, count):
            continue
        for slot in range(count):
            by = border.system[slot, count]
            for i in range(nx):
                for k in range(m):
                    answer = work.columns[1 + size + slot, i, k]
                    work.columns[column, i, k] += by * answer


@inner
def displaced_by(film, work, i, k, held, modes, size):
    """Add what a velocity displaces from a point of a groove to the flow of that, see `_finish`."""
    slot = film.feeding.slots[film.held.grooves[i, k]]
    for a in range(size):
        if slot >= 0:
            work.border.direct[1 + a, slot] += held * modes[a]
