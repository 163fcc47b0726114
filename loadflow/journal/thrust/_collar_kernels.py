"""Compiled steps of a thrust collar along its axis, one after another, each by Newton."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.thrust._row_kernels import interval, polynomials, summed
from loadflow.numerics.linked import LINKED, bare

Array = NDArray[np.float64]

LOAD, SPEED, SLOPE, LOW, HIGH, COS_FRONT, SIN_FRONT, COS_BACK, SIN_BACK = range(9)
"""Columns of what is given of a step: N, rad/s of a film that carries, rad, smallest and largest
ln(front film/back film), and the wave of a pitch in which each row sees the tilt."""

NEWTON = 12
"""Steps before a bracket is halved."""

MOST_STEPS = 120
"""With those that halve it."""

_CHANGE = 0.7  # largest step of ln(front film/back film)
_FORCE, _DAMPING = 2.0, 3.0  # powers of the gap with which they are nearly constant

_loop = bare(cache=True)
_inner = bare(**LINKED)


@_inner
def _row(parts, frame, gap, slope, cosine, sine, powers):
    """Force over η ω and damping over η of a row, and their slopes by its gap."""
    polynomials(frame, gap, slope, parts.shape[3], powers)
    at, x = interval(frame, math.log(gap), parts.shape[1])
    force, by_log, by_tilt = summed(parts[0], at, x, powers, cosine, sine)
    scale = gap**-_FORCE
    force_slope = scale * ((by_log - _FORCE * force) / gap + by_tilt)
    force *= scale
    damping, by_log, by_tilt = summed(parts[1], at, x, powers, cosine, sine)
    scale = gap**-_DAMPING
    damping_slope = scale * ((by_log - _DAMPING * damping) / gap + by_tilt)
    return force, force_slope, damping * scale, damping_slope


@_inner
def _missing(front, back, frames, play, viscosity, given, place, before, weight, powers):
    """Load that no film carries, N, its slope by the place, and the scale of both.

    The gap grows by `weight` × itself + `before`, m/s.
    """
    gap = play / (1.0 + math.exp(-place))
    rate = weight * gap + before
    f, f_slope, c, c_slope = _row(
        front, frames[0], gap, given[SLOPE], given[COS_FRONT], given[SIN_FRONT], powers
    )
    drag = viscosity[0] * given[SPEED]
    most = drag * f
    pressed = most - viscosity[0] * c * rate
    missing, steep = given[LOAD], 0.0
    if pressed > 0.0:
        missing -= pressed
        steep -= drag * f_slope - viscosity[0] * (c_slope * rate + c * weight)
    f, f_slope, c, c_slope = _row(
        back, frames[1], play - gap, given[SLOPE], given[COS_BACK], given[SIN_BACK], powers
    )
    drag = viscosity[1] * given[SPEED]
    most = max(most, drag * f)
    pressed = drag * f + viscosity[1] * c * rate
    if pressed > 0.0:
        missing += pressed
        steep += viscosity[1] * (c * weight - c_slope * rate) - drag * f_slope
    scale = max(most, abs(given[LOAD]), 1e-9)
    return missing, steep * gap * (play - gap) / play, scale


@_loop
def follow(
    front, back, frames, play, viscosity, given, weights, within, powers, place, residual, steps
):  # fmt: skip
    """Fill places (n,), ln(front film/back film), shares of the force missing, and steps.

    Velocities of the gap are weights (3, n) of the gap now, one and two steps before. What is
    missing grows with the place: Newton keeps between places of either sign, and halves them where
    it does not come to an end. Where even the last place leaves a load, that is it.
    """
    for n in range(given.shape[0]):
        now, low, high = given[n], given[n, LOW], given[n, HIGH]
        low_known, high_known, before, x = False, False, 0.0, 0.0
        if n > 0:
            before = weights[1, n] * play / (1.0 + math.exp(-place[n - 1]))
            x = place[n - 1]
        if n > 1:
            before += weights[2, n] * play / (1.0 + math.exp(-place[n - 2]))
            x += place[n - 1] - place[n - 2]
        x = min(max(x, low), high)
        for count in range(1, MOST_STEPS + 1):
            missing, steep, scale = _missing(
                front, back, frames, play, viscosity, now, x, before, weights[0, n], powers
            )
            share = abs(missing) / scale
            if share < within:
                break
            if (x == low and missing > 0.0) or (x == high and missing < 0.0):
                share = 0.0  # the surfaces touch
                break
            if missing > 0.0:
                high, high_known = x, True
            else:
                low, low_known = x, True
            aim = x - min(max(missing / steep, -_CHANGE), _CHANGE) if steep > 0.0 else np.inf
            if count > NEWTON or not low < aim < high:
                # the bracket is halved where both its ends have been seen
                if missing > 0.0:
                    aim = 0.5 * (low + high) if low_known else low
                else:
                    aim = 0.5 * (low + high) if high_known else high
            if aim == x:
                break
            x = aim
        place[n], residual[n], steps[n] = x, share, count
