"""Compiled steps of the rollers' spin under Coulomb friction: exact from event to event."""

from __future__ import annotations

import math

import numpy as np

from loadflow.numerics.linked import LINKED, njit

_GLIDING, _GRIPPING, _RESTING = 0, 1, 2  # states of a roller: slips, at ideal spin, at rest


@njit(nogil=True, error_model="numpy", **LINKED)
def _glide(w, t, m0, slope, damping, inertia):
    """Spin after t under the moment m0 + slope t and viscous damping: exact."""
    z = damping * t / inertia
    if z > 1e-4:
        decay = math.exp(-z)
        first = (1.0 - decay) / z
        second = (1.0 - first) / z
    else:
        decay = 1.0 - z + z * z / 2.0
        first = 1.0 - z / 2.0 + z * z / 6.0
        second = 0.5 - z / 6.0 + z * z / 24.0
    return w * decay + t / inertia * (m0 * first + slope * t * second)


@njit(nogil=True, error_model="numpy", **LINKED)
def _release(t, span, a0, a1, need0, need1):
    """First time after t at which the need exceeds what holds, both linear; `span` if never."""
    first = span
    for sign in (1.0, -1.0):
        left0, left1 = a0 - sign * need0, a1 - sign * need1
        left = left0 + (left1 - left0) * t / span
        if left < 0.0:
            return t
        if left1 < 0.0:
            first = min(first, max(t, span * left0 / (left0 - left1)))
    return first


@njit(nogil=True, error_model="numpy", **LINKED)
def _extremum(w, m0, rise, slope, damping, inertia):
    """Time after which a glide from w is as steep as `rise`, which it is at most once."""
    rate = (m0 - damping * w) / inertia - rise
    lasting = slope - damping * rise  # J w'' = slope - C w'
    if damping * abs(rate) * inertia <= 1e-9 * abs(lasting):
        return -rate * inertia / lasting if rate * lasting < 0.0 else math.inf
    share = lasting / (lasting - damping * rate)
    return -math.log(share) * inertia / damping if 0.0 < share < 1.0 else math.inf


@njit(nogil=True, error_model="numpy", **LINKED)
def _reach(w, t, span, side, line, rise, m0, slope, damping, inertia):
    """First time at which a roller on one side of a line meets it, by bisection; inf if never."""
    now = m0 + slope * t
    high = span
    if side * (line + rise * span - _glide(w, span - t, now, slope, damping, inertia)) > 0.0:
        high = t + _extremum(w, now, rise, slope, damping, inertia)
        if not high < span:
            return math.inf
        if side * (line + rise * high - _glide(w, high - t, now, slope, damping, inertia)) > 0.0:
            return math.inf
    low = t
    while high - low > 1e-14 * span:
        middle = 0.5 * (low + high)
        here = _glide(w, middle - t, now, slope, damping, inertia)
        if side * (line + rise * middle - here) > 0.0:
            low = middle
        else:
            high = middle
    return high


@njit(nogil=True, error_model="numpy", **LINKED)
def _sense(value):
    return 1.0 if value >= 0.0 else -1.0


@njit(nogil=True, error_model="numpy", **LINKED)
def _coulomb_piece(w, state, span, ideal, grip, push, brake, damping, inertia):
    """Spin and state after a piece of time in which all but the state is linear.

    `ideal`, `grip`, `push`, `brake` are pairs of values at both ends; the ideal spin keeps its
    sense.
    """
    (id0, id1), (a0, a1), (b0, b1), (k0, k1) = ideal, grip, push, brake
    rise, turn = (id1 - id0) / span, _sense(id0 + id1)
    t = 0.0
    for _ in range(40):
        if state == _GRIPPING:
            need0 = inertia * rise + damping * id0 - b0 + turn * k0
            need1 = inertia * rise + damping * id1 - b1 + turn * k1
            t = _release(t, span, a0, a1, need0, need1)
            w, r = id0 + rise * t, turn
            s = _sense(need0 + (need1 - need0) * t / span)
        elif state == _RESTING:
            need0, need1 = turn * a0 + b0, turn * a1 + b1
            t = _release(t, span, k0, k1, need0, need1)
            s, r = turn, _sense(need0 + (need1 - need0) * t / span)
        else:
            s, r = _sense(id0 + rise * t - w), _sense(w)
        if t >= span:
            break
        state = _GLIDING
        m0, slope = s * a0 + b0 - r * k0, (s * (a1 - a0) + b1 - b0 - r * (k1 - k0)) / span
        caught = _reach(w, t, span, s, id0, rise, m0, slope, damping, inertia)
        halted = _reach(w, t, span, -r, 0.0, 0.0, m0, slope, damping, inertia)
        if min(caught, halted) > span:
            return _glide(w, span - t, m0 + slope * t, slope, damping, inertia), state
        if caught <= halted:
            t, state = caught, _GRIPPING
            w = id0 + rise * t
        else:
            t, state, w = halted, _RESTING, 0.0
    return w, state


@njit(cache=True, nogil=True, error_model="numpy")
def coulomb_spins(time, ideal, grip, push, brake, damping, inertia, start):
    """Spin of rollers, (n, roller), under J w' = ±grip + push - brake sign(w) - C w.

    The grip pulls toward the ideal spin and holds there, the brake holds at rest. Exact for ideal
    spin and moments that change linearly between the samples: gliding is a closed form, holding
    ends where a line crosses another.
    """
    n, count = grip.shape
    spin = np.empty((n, count))
    for j in range(count):
        w = start[j]
        state = _GRIPPING if w == ideal[0] else _GLIDING
        spin[0, j] = w
        for i in range(n - 1):
            span, id0, id1 = time[i + 1] - time[i], ideal[i], ideal[i + 1]
            cut = id0 / (id0 - id1) if id0 * id1 < 0.0 else 1.0  # where the bearing turns round
            low = 0.0
            while low < 1.0:
                high = cut if low < cut else 1.0
                w, state = _coulomb_piece(
                    w,
                    state,
                    (high - low) * span,
                    _piece(id0, id1, low, high),
                    _piece(grip[i, j], grip[i + 1, j], low, high),
                    _piece(push[i, j], push[i + 1, j], low, high),
                    _piece(brake[i, j], brake[i + 1, j], low, high),
                    damping,
                    inertia,
                )
                low = high
            spin[i + 1, j] = w
    return spin


@njit(nogil=True, error_model="numpy", **LINKED)
def _piece(first, last, low, high):
    """Values at both ends of a piece of an interval."""
    return first + (last - first) * low, first + (last - first) * high
